//! What can be measured of triangles: pieces, edges, rims, volume, winding number.

use glam::{DVec3, Vec3};

use super::edges::{Sets, by_edge, sides};
use super::value::NO_INDEX;

/// What a set of triangles is.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Number of triangles.
    pub triangle_count: usize,
    /// Vertices that they use.
    pub vertex_count: usize,
    /// Parts that hang together over vertices.
    pub piece_count: usize,
    /// True if every edge has as many triangles one way as the other.
    pub is_closed: bool,
    /// Edges of one triangle.
    pub open_edge_count: u64,
    /// Edges of more than two triangles.
    pub crowded_edge_count: u64,
    /// Rims: what edges of one triangle form that hang together over vertices.
    pub rim_count: usize,
    /// Least and greatest coordinates, mm.
    pub bounds_mm: [DVec3; 2],
    /// The volume inside, mm³, negative if it is inside out; of closed ones only.
    pub volume_mm3: Option<f64>,
}

/// Measures triangles of these positions, mm.
pub fn measure(positions: &[Vec3], triangles: &[[u32; 3]]) -> Measure {
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let mut is_used = vec![false; positions.len()];
    for &index in triangles.iter().flatten() {
        let position = positions[index as usize].as_dvec3();
        bounds = [bounds[0].min(position), bounds[1].max(position)];
        is_used[index as usize] = true;
    }
    let (mut open, mut crowded, mut is_closed) = (0, 0, true);
    let mut rims = Sets::new(positions.len());
    let mut is_on_rim = vec![false; positions.len()];
    for edge in by_edge(&sides(triangles)) {
        let forward = edge.iter().filter(|side| side.is_forward).count();
        is_closed &= 2 * forward == edge.len();
        crowded += u64::from(edge.len() > 2);
        if let [side] = edge {
            open += 1;
            let [a, b] = side.edge;
            rims.join(a, b);
            is_on_rim[a as usize] = true;
            is_on_rim[b as usize] = true;
        }
    }
    let rim_count = (0..positions.len() as u32)
        .filter(|&index| is_on_rim[index as usize] && rims.find(index) == index)
        .count();
    let (_, piece_count) = pieces(positions.len(), triangles);
    let center = (bounds[0] + bounds[1]) * 0.5;
    Measure {
        triangle_count: triangles.len(),
        vertex_count: is_used.iter().filter(|used| **used).count(),
        piece_count,
        is_closed,
        open_edge_count: open,
        crowded_edge_count: crowded,
        rim_count,
        bounds_mm: bounds,
        volume_mm3: is_closed.then(|| volume(positions, triangles, center)),
    }
}

/// The piece of each triangle, numbered in the order of their first triangles, and how many there are.
pub fn pieces(position_count: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, usize) {
    let mut sets = Sets::new(position_count);
    for &[a, b, c] in triangles {
        sets.join(a, b);
        sets.join(b, c);
    }
    let mut number = vec![NO_INDEX; position_count];
    let mut count = 0;
    let of_triangle = triangles.iter().map(|&[a, _, _]| {
        let number = &mut number[sets.find(a) as usize];
        if *number == NO_INDEX {
            *number = count;
            count += 1;
        }
        *number
    });
    let of_triangle = of_triangle.collect();
    (of_triangle, count as usize)
}

/// Sum of the signed tetrahedra over triangles: the volume inside a closed surface, positive if fronts are outside.
/// `center` is any place near it, which keeps the digits.
pub fn volume(positions: &[Vec3], triangles: &[[u32; 3]], center: DVec3) -> f64 {
    let six = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3() - center);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}

/// Generalised winding number of triangles at a place, mm: 1 inside a closed surface, 0 outside, between the two near
/// the hole of an open one.
///
/// Jacobson, Kavan, Sorkine-Hornung 2013, equation 5: the sum of the signed solid angles (van Oosterom, Strackee 1983)
/// over 4π.
pub fn winding_number<'a>(
    positions: &[Vec3],
    triangles: impl IntoIterator<Item = &'a [u32; 3]>,
    place: DVec3,
) -> f64 {
    let halves = triangles.into_iter().map(|triangle| {
        let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3() - place);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        // The half of the solid angle.
        a.dot(b.cross(c)).atan2(below)
    });
    halves.sum::<f64>() / std::f64::consts::TAU
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;

    #[test]
    fn a_cube_is_closed_and_has_its_volume() {
        let (positions, triangles) = cube();
        let far: Vec<Vec3> = positions
            .iter()
            .map(|p| *p * 2.0 + Vec3::splat(1000.0))
            .collect();
        let all = measure(&far, &triangles);
        assert_eq!(
            (all.triangle_count, all.vertex_count, all.piece_count),
            (12, 8, 1)
        );
        assert!(all.is_closed && all.open_edge_count == 0 && all.rim_count == 0);
        assert_eq!(all.volume_mm3, Some(8.0));
        let inside_out: Vec<[u32; 3]> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        assert_eq!(measure(&far, &inside_out).volume_mm3, Some(-8.0));
    }

    #[test]
    fn holes_have_edges_and_rims() {
        let (positions, triangles) = cube();
        let open = measure(&positions, &triangles[2..]);
        assert_eq!((open.open_edge_count, open.rim_count), (4, 1));
        assert!(!open.is_closed && open.volume_mm3.is_none());
        // Bottom and top: two rims; one triangle of each of two sides that meet in an edge: one.
        let tube = measure(&positions, &triangles[4..]);
        assert_eq!((tube.open_edge_count, tube.rim_count), (8, 2));
        let lone = measure(&positions, &triangles[..1]);
        assert_eq!((lone.open_edge_count, lone.vertex_count), (3, 3));
    }

    #[test]
    fn edges_of_four_triangles_may_be_closed() {
        // Two cubes that share an edge: closed, as the edge has two triangles each way.
        let (positions, triangles) = cube();
        let mut both = positions.clone();
        let mut number: Vec<u32> = Vec::new();
        for position in &positions {
            let moved = *position + Vec3::new(1.0, 1.0, 0.0);
            let same = positions.iter().position(|other| *other == moved);
            number.push(same.unwrap_or(both.len()) as u32);
            if same.is_none() {
                both.push(moved);
            }
        }
        let mut all = triangles.clone();
        all.extend(triangles.iter().map(|t| t.map(|i| number[i as usize])));
        let found = measure(&both, &all);
        assert_eq!((found.crowded_edge_count, found.piece_count), (1, 1));
        assert_eq!(found.volume_mm3, Some(2.0));
    }

    #[test]
    fn winding_numbers_tell_inside_from_outside() {
        let (positions, triangles) = cube();
        let at = |triangles: &[[u32; 3]], p| winding_number(&positions, triangles, p);
        let inside = DVec3::new(0.3, 0.6, 0.2);
        assert!((at(&triangles, inside) - 1.0).abs() < 1e-12);
        assert!(at(&triangles, DVec3::splat(1.5)).abs() < 1e-12);
        // Without its bottom a cube's middle sees five sixths of it.
        let open = at(&triangles[2..], DVec3::splat(0.5));
        assert!((open - 5.0 / 6.0).abs() < 1e-12, "{open}");
    }
}
