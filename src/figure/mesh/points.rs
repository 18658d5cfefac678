use std::collections::BTreeMap;

use glam::DVec2;

use super::delaunay::Delaunay;

/// How far the corners around a set of points are, in its size: what they take from its hull are triangles with angles
/// of a millionth.
const FAR: f64 = 1e6;
/// Triangles on the border with an angle below this are taken away, 5°.
const LEAST_ANGLE: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// The Delaunay triangulation of a few points, counter-clockwise, without sharp triangles on its border: the sharpest
/// first is taken away, while more than one is left. None if the points lie on a line.
pub(crate) fn triangulated(points: &[DVec2]) -> Vec<[u32; 3]> {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for point in points {
        low = low.min(*point);
        high = high.max(*point);
    }
    let size = (high - low).max_element();
    if points.len() < 3 || size <= 0.0 {
        return Vec::new();
    }
    let mut mesh = Delaunay::new(low - FAR * size, high + FAR * size);
    let index: BTreeMap<u32, u32> = points
        .iter()
        .map(|point| mesh.insert(*point))
        .zip(0..)
        .collect();
    let named = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| index.get(&corner).copied());
        Some([a?, b?, c?])
    };
    let mut triangles: Vec<[u32; 3]> = mesh
        .triangles
        .iter()
        .filter_map(|t| named(&t.corners))
        .collect();
    // The lowest number first, so that they do not depend on how they were found.
    for corners in &mut triangles {
        let least = (0..3).min_by_key(|i| corners[*i]).unwrap_or(0);
        corners.rotate_left(least);
    }
    triangles.sort_unstable();
    while triangles.len() > 1 {
        let Some(sharpest) = sharpest_on_border(points, &triangles) else {
            break;
        };
        triangles.remove(sharpest);
    }
    triangles
}

/// The triangle on the border with the smallest angle, if that is below 5°.
fn sharpest_on_border(points: &[DVec2], triangles: &[[u32; 3]]) -> Option<usize> {
    let mut counts: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let edges = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b)));
    for edge in triangles.iter().flat_map(|t| edges(*t)) {
        *counts.entry(edge).or_default() += 1;
    }
    let mut least = LEAST_ANGLE;
    let mut found = None;
    for (i, triangle) in triangles.iter().enumerate() {
        let is_on_border = edges(*triangle).iter().any(|edge| counts[edge] == 1);
        let angle = least_angle(triangle.map(|corner| points[corner as usize]));
        if is_on_border && angle < least {
            least = angle;
            found = Some(i);
        }
    }
    found
}

fn least_angle(corners: [DVec2; 3]) -> f64 {
    let angle = |i: usize| {
        let (u, v) = (
            corners[(i + 1) % 3] - corners[i],
            corners[(i + 2) % 3] - corners[i],
        );
        libm::atan2(u.perp_dot(v).abs(), u.dot(v))
    };
    angle(0).min(angle(1)).min(angle(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn a_square_has_two_triangles_and_a_line_none() {
        let square = [
            dvec2(0.0, 0.0),
            dvec2(1.0, 0.0),
            dvec2(1.0, 1.1),
            dvec2(0.0, 1.0),
        ];
        assert_eq!(triangulated(&square).len(), 2, "a square");
        let line = [
            dvec2(0.0, 0.0),
            dvec2(1.0, 1.0),
            dvec2(2.0, 2.0),
            dvec2(0.5, 0.5),
        ];
        assert_eq!(triangulated(&line), Vec::<[u32; 3]>::new(), "a line");
    }

    #[test]
    fn slivers_of_the_border_are_taken_away() {
        let flat = [
            dvec2(0.0, 0.0),
            dvec2(1.0, 0.0),
            dvec2(2.0, 0.0),
            dvec2(1.0, -0.01),
            dvec2(1.0, 1.0),
        ];
        let triangles = triangulated(&flat);
        let sharpest = triangles
            .iter()
            .map(|t| least_angle(t.map(|i| flat[i as usize])))
            .fold(9.0, f64::min);
        assert!(sharpest >= LEAST_ANGLE, "{triangles:?}: {sharpest}");
    }
}
