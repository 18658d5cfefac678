use super::super::delaunay::Delaunay;

/// Cosine of the angle between fixed edges below which their point is acute, 60°.
const COS_ACUTE: f64 = 0.5;

/// The points at which two fixed edges meet at less than 60°.
pub(super) fn acute_points(mesh: &Delaunay) -> Vec<bool> {
    let is_acute = |point: u32| {
        let at = mesh.point(point);
        let mut directions = Vec::new();
        for (t, i) in mesh.around(point) {
            let triangle = mesh.triangle(t);
            for (edge, end) in [((i + 2) % 3, (i + 1) % 3), ((i + 1) % 3, (i + 2) % 3)] {
                let direction = (mesh.point(triangle.corners[end]) - at).normalize_or_zero();
                if triangle.fixed[edge] && directions.last() != Some(&direction) {
                    directions.push(direction);
                }
            }
        }
        let n = directions.len();
        let is_sharp = |i: usize| {
            let (a, b) = (directions[i], directions[(i + 1) % n]);
            a != b && a.dot(b) > COS_ACUTE
        };
        n > 1 && (0..n).any(is_sharp)
    };
    (0..mesh.points.len() as u32).map(is_acute).collect()
}
