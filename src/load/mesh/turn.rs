//! Triangles turned until neighbours agree about which side is the front.

use glam::{DVec3, Vec3};

use crate::data::NO_INDEX;
use crate::data::mesh::edges::{by_edge, sides};

/// What was turned.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Turned {
    /// For each triangle, whether it is to be turned over.
    pub(super) is_turned: Vec<bool>,
    /// Edges of two triangles across which they disagreed.
    pub(super) disagreed: u64,
    /// Edges across which they will disagree still.
    pub(super) disagree: u64,
}

/// Finds out which triangles to turn over, so that no two disagree across an edge of two triangles: of what hangs
/// together over such edges the part that is smaller by area is turned, of two equal ones the one without the first
/// triangle. Edges of more than two triangles bind nothing.
pub(super) fn turn(positions: &[Vec3], triangles: &[[u32; 3]]) -> Turned {
    // Two triangles agree across their edge if they go along it in opposite directions.
    let mut links: Vec<[(u32, bool); 3]> = vec![[(NO_INDEX, false); 3]; triangles.len()];
    let mut shared = Vec::new();
    for edge in by_edge(&sides(triangles)) {
        let [a, b] = edge else { continue };
        let disagrees = a.is_forward == b.is_forward;
        shared.push(([a.triangle, b.triangle], disagrees));
        for [from, to] in [[a, b], [b, a]] {
            let links = &mut links[from.triangle as usize];
            if let Some(free) = links.iter_mut().find(|(other, _)| *other == NO_INDEX) {
                *free = (to.triangle, disagrees);
            }
        }
    }
    let area = |triangle: u32| {
        let [a, b, c] = triangles[triangle as usize].map(|i| positions[i as usize].as_dvec3());
        (b - a).cross(c - a).length()
    };
    let mut is_turned = vec![false; triangles.len()];
    let mut is_seen = vec![false; triangles.len()];
    for first in 0..triangles.len() as u32 {
        if is_seen[first as usize] {
            continue;
        }
        is_seen[first as usize] = true;
        // What hangs together with the first, nearest first.
        let mut patch = vec![first];
        let mut areas = [0.0; 2];
        let mut done = 0;
        while let Some(&triangle) = patch.get(done) {
            done += 1;
            let turned = is_turned[triangle as usize];
            areas[usize::from(turned)] += area(triangle);
            for (other, disagrees) in links[triangle as usize] {
                if other != NO_INDEX && !is_seen[other as usize] {
                    is_seen[other as usize] = true;
                    is_turned[other as usize] = turned != disagrees;
                    patch.push(other);
                }
            }
        }
        if areas[1] > areas[0] {
            for triangle in patch {
                is_turned[triangle as usize] ^= true;
            }
        }
    }
    let (mut disagreed, mut disagree) = (0, 0);
    for ([a, b], disagrees) in shared {
        let is_one_turned = is_turned[a as usize] != is_turned[b as usize];
        disagreed += u64::from(disagrees);
        disagree += u64::from(disagrees != is_one_turned);
    }
    Turned {
        is_turned,
        disagreed,
        disagree,
    }
}

/// Twice the area of a triangle as a vector out of its front.
pub(super) fn face_normal([a, b, c]: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of `n` squares around an axis, its cross direction turned by `half_turns` half turns on the way.
    fn band(n: u32, half_turns: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mut positions = Vec::new();
        for i in 0..n {
            let around = i as f32 / n as f32 * std::f32::consts::TAU;
            let twist = around * 0.5 * half_turns as f32;
            let out = Vec3::new(around.cos(), around.sin(), 0.0);
            let cross = (out * twist.sin() + Vec3::Z * twist.cos()) * 0.3;
            positions.extend([out - cross, out + cross]);
        }
        let mut triangles = Vec::new();
        for i in 0..n {
            let [a, b] = [2 * i, 2 * i + 1];
            let [mut c, mut d] = [2 * ((i + 1) % n), 2 * ((i + 1) % n) + 1];
            if i + 1 == n && half_turns % 2 == 1 {
                std::mem::swap(&mut c, &mut d);
            }
            triangles.extend([[a, b, c], [b, d, c]]);
        }
        (positions, triangles)
    }

    #[test]
    fn the_smaller_part_is_turned() {
        let (positions, mut triangles) = band(12, 0);
        let agreed = turn(&positions, &triangles);
        assert_eq!((agreed.disagreed, agreed.disagree), (0, 0));
        assert!(!agreed.is_turned.contains(&true), "nothing to do");
        // The first five of 24 are wrong: they are turned, though they come first.
        for triangle in &mut triangles[..5] {
            triangle.swap(1, 2);
        }
        let mended = turn(&positions, &triangles);
        assert_eq!((mended.disagreed, mended.disagree), (2, 0));
        let expected: Vec<bool> = (0..24).map(|i| i < 5).collect();
        assert_eq!(mended.is_turned, expected);
        // Nineteen wrong: the five agree with none but are fewer.
        for triangle in &mut triangles {
            triangle.swap(1, 2);
        }
        assert_eq!(turn(&positions, &triangles).is_turned, expected);
    }

    #[test]
    fn area_decides_and_not_number() {
        // One large triangle and two small ones beside it, which disagree with it.
        let positions: Vec<Vec3> = [[0, 0], [8, 0], [0, 8], [-1, 0], [-1, 1]]
            .map(|[x, y]| Vec3::new(x as f32, y as f32, 0.0))
            .to_vec();
        let triangles = [[0, 2, 4], [0, 4, 3], [0, 2, 1]];
        let found = turn(&positions, &triangles);
        assert_eq!((found.disagreed, found.disagree), (1, 0));
        assert_eq!(found.is_turned, [true, true, false]);
    }

    #[test]
    fn a_moebius_strip_disagrees_somewhere_for_ever() {
        let (positions, triangles) = band(12, 1);
        let found = turn(&positions, &triangles);
        assert!(found.disagree >= 1, "{found:?}");
        let (positions, triangles) = band(12, 2);
        assert_eq!(
            turn(&positions, &triangles).disagree,
            0,
            "a full turn has two sides"
        );
    }

    #[test]
    fn edges_of_three_triangles_bind_nothing() {
        let positions: Vec<Vec3> = [[0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, -1, 0]]
            .map(|p: [i32; 3]| Vec3::from_array(p.map(|x| x as f32)))
            .to_vec();
        let found = turn(&positions, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
        assert_eq!((found.disagreed, found.disagree), (0, 0));
    }
}
