//! Pairs of triangles of a mesh that meet.
//!
//! Whether two triangles meet is decided with the exact signs of Shewchuk (1997, "Adaptive precision floating-point
//! arithmetic and fast robust geometric predicates", in the crate `robust`): there is no tolerance, and it does not
//! depend on the machine. Which pairs are looked at is decided by a tree of boxes.

use glam::{DVec3, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Pairs that meet are counted up to here. A mesh that lies on itself everywhere has as many as its triangles squared.
pub const MAX_CROSSING: usize = 1_000_000;

/// Triangles in a leaf of the tree. On sheets of 300,000 triangles 2, 4 and 8 took the same time within a tenth.
const LEAF: usize = 4;

/// A triangle of three vertices with finite places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    corners: [u32; 3],
    at: [DVec3; 3],
    least: Vec3,
    greatest: Vec3,
    /// The axis along which it can be looked at without being seen as a line; 3 if there is none.
    axis: usize,
}

impl Face {
    pub(super) fn new(corners: [u32; 3], at: [Vec3; 3]) -> Self {
        let [a, b, c] = at;
        let mut face = Self {
            corners,
            at: at.map(Vec3::as_dvec3),
            least: a.min(b).min(c),
            greatest: a.max(b).max(c),
            axis: 3,
        };
        let is_seen = |axis: &usize| {
            let [a, b, c] = face.at.map(|p| along(p, *axis));
            orient2d(a, b, c) != 0.0
        };
        face.axis = (0..3).find(is_seen).unwrap_or(3);
        face
    }

    pub(super) fn is_flat(&self) -> bool {
        self.axis == 3
    }

    /// Radians, 0 … π/3.
    pub(super) fn smallest_angle(&self) -> f64 {
        let [a, b, c] = self.at;
        let angle = |at: DVec3, p: DVec3, q: DVec3| {
            let [p, q] = [p - at, q - at];
            libm::atan2(p.cross(q).length(), p.dot(q))
        };
        angle(a, b, c).min(angle(b, c, a)).min(angle(c, a, b))
    }

    /// Six times the volume of the tetrahedron that it makes with the origin.
    pub(super) fn six_volumes(&self) -> f64 {
        let [a, b, c] = self.at;
        a.dot(b.cross(c))
    }

    fn overlaps(&self, other: &Self) -> bool {
        overlap(&[self.least, self.greatest], &[other.least, other.greatest])
    }

    /// The side of its plane on which a point lies: the sign says which, 0 is in it.
    fn side(&self, p: DVec3) -> f64 {
        let [a, b, c] = self.at;
        side(a, b, c, p)
    }

    /// True if the segment from `p` to `q`, its ends included, meets the triangle, its edges included.
    fn meets_segment(&self, p: DVec3, q: DVec3) -> bool {
        let [side_p, side_q] = [self.side(p), self.side(q)];
        if is_same_side(side_p, side_q) {
            return false;
        }
        let [a, b, c] = self.at;
        if side_p == 0.0 && side_q == 0.0 {
            let [p, q, a, b, c] = [p, q, a, b, c].map(|p| along(p, self.axis));
            let is_inside =
                |p| is_one_way([orient2d(a, b, p), orient2d(b, c, p), orient2d(c, a, p)]);
            return is_inside(p)
                || is_inside(q)
                || [[a, b], [b, c], [c, a]]
                    .iter()
                    .any(|&[a, b]| meet([p, q], [a, b]));
        }
        // The line goes through the plane in one point, and passes the three edges on the same side if it is inside.
        is_one_way([side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)])
    }

    /// True if they meet elsewhere than in the one vertex or in the edge that they share.
    fn crosses(&self, other: &Self) -> bool {
        let mut shared = [[0; 2]; 3];
        let mut count = 0;
        for (i, corner) in self.corners.iter().enumerate() {
            if let Some(j) = other.corners.iter().position(|other| other == corner) {
                shared[count] = [i, j];
                count += 1;
            }
        }
        match (count, shared) {
            (0, _) => {
                let is_apart = |one: &Self, [a, b, c]: [DVec3; 3]| {
                    let [a, b, c] = [a, b, c].map(|p| one.side(p));
                    is_same_side(a, b) && is_same_side(b, c)
                };
                if is_apart(self, other.at) || is_apart(other, self.at) {
                    return false;
                }
                // Where two triangles meet, an edge of one of them meets the other, also if they lie in one plane.
                let sides = |[a, b, c]: [DVec3; 3]| [[a, b], [b, c], [c, a]];
                sides(other.at)
                    .iter()
                    .any(|&[p, q]| self.meets_segment(p, q))
                    || sides(self.at)
                        .iter()
                        .any(|&[p, q]| other.meets_segment(p, q))
            }
            (1, [[i, j], ..]) => {
                // What they have in common is convex. From the vertex through any other point of it one leaves the
                // first of the two through the edge that lies opposite, and is still in the other.
                let opposite = |at: [DVec3; 3], i: usize| [at[(i + 1) % 3], at[(i + 2) % 3]];
                let [[p, q], [r, s]] = [opposite(self.at, i), opposite(other.at, j)];
                other.meets_segment(p, q) || self.meets_segment(r, s)
            }
            (2, [[i, j], [k, l], _]) => {
                // In two planes they meet in the edge alone. In one plane they lie beside or on each other.
                let [p, q] = [self.at[3 - i - k], other.at[3 - j - l]];
                let [a, b, p2, q2] = [self.at[i], self.at[k], p, q].map(|p| along(p, self.axis));
                self.side(q) == 0.0 && is_same_side(orient2d(a, b, p2), orient2d(a, b, q2))
            }
            _ => true,
        }
    }
}

/// The exact sign of the volume of a tetrahedron.
fn side(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    // Plates and cubes have many of these, and 0 is what takes longest to be sure of: 300,000 triangles of a plane take
    // 4 s without this line.
    if (a.cmpeq(b) & a.cmpeq(c) & a.cmpeq(d)).any() {
        return 0.0;
    }
    let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    });
    orient3d(a, b, c, d)
}

/// A point as it is seen along an axis.
fn along(p: DVec3, axis: usize) -> Coord<f64> {
    match axis {
        0 => Coord { x: p.y, y: p.z },
        1 => Coord { x: p.z, y: p.x },
        _ => Coord { x: p.x, y: p.y },
    }
}

/// True if both are above 0 or both below.
fn is_same_side(a: f64, b: f64) -> bool {
    (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0)
}

/// True if none is below 0, or none above.
fn is_one_way(signs: [f64; 3]) -> bool {
    signs.iter().all(|&s| s >= 0.0) || signs.iter().all(|&s| s <= 0.0)
}

/// True if two segments of a plane meet, their ends included.
fn meet([p, q]: [Coord<f64>; 2], [a, b]: [Coord<f64>; 2]) -> bool {
    let [from_p, from_q] = [orient2d(a, b, p), orient2d(a, b, q)];
    let [from_a, from_b] = [orient2d(p, q, a), orient2d(p, q, b)];
    // On the line of the segment: on it, if within its box.
    let is_on = |p: Coord<f64>, [a, b]: [Coord<f64>; 2]| {
        let is_within = |x: f64, a: f64, b: f64| a.min(b) <= x && x <= a.max(b);
        is_within(p.x, a.x, b.x) && is_within(p.y, a.y, b.y)
    };
    (from_p == 0.0 && is_on(p, [a, b]))
        || (from_q == 0.0 && is_on(q, [a, b]))
        || (from_a == 0.0 && is_on(a, [p, q]))
        || (from_b == 0.0 && is_on(b, [p, q]))
        || ((from_p > 0.0) != (from_q > 0.0)
            && (from_a > 0.0) != (from_b > 0.0)
            && [from_p, from_q, from_a, from_b]
                .iter()
                .all(|&sign| sign != 0.0))
}

/// True if two boxes have a point in common.
fn overlap([least, greatest]: &[Vec3; 2], [other_least, other_greatest]: &[Vec3; 2]) -> bool {
    least.cmple(*other_greatest).all() && other_least.cmple(*greatest).all()
}

/// A node of the tree: a box around triangles that lie one after the other.
struct Node {
    bounds: [Vec3; 2],
    first: usize,
    end: usize,
    /// The second of its two nodes, the first of which follows it; 0 of a leaf.
    second: usize,
}

/// The pairs of triangles that meet, up to [`MAX_CROSSING`]. None of them is flat.
pub(super) fn crossing(faces: &[Face]) -> usize {
    let mut faces = faces.to_vec();
    let mut nodes = Vec::with_capacity(2 * faces.len() / LEAF + 1);
    build(&mut faces, 0, &mut nodes);
    let mut count = 0;
    // Pairs of nodes whose triangles are to be compared; a node with itself at first.
    let mut to_do: Vec<[usize; 2]> = Vec::new();
    if !nodes.is_empty() {
        to_do.push([0, 0]);
    }
    while let Some([i, j]) = to_do.pop() {
        let [a, b] = [&nodes[i], &nodes[j]];
        if i == j && a.second > 0 {
            to_do.extend([[i + 1, i + 1], [a.second, a.second], [i + 1, a.second]]);
            continue;
        }
        if !overlap(&a.bounds, &b.bounds) {
            continue;
        }
        let [is_a_leaf, is_b_leaf] = [a.second == 0, b.second == 0];
        if is_a_leaf && is_b_leaf {
            for one in a.first..a.end {
                let others = if i == j {
                    one + 1..a.end
                } else {
                    b.first..b.end
                };
                for other in others {
                    let [one, other] = [&faces[one], &faces[other]];
                    count += usize::from(one.overlaps(other) && one.crosses(other));
                }
            }
            if count >= MAX_CROSSING {
                return MAX_CROSSING;
            }
        } else if is_b_leaf || (!is_a_leaf && a.end - a.first >= b.end - b.first) {
            to_do.extend([[i + 1, j], [a.second, j]]);
        } else {
            to_do.extend([[i, j + 1], [i, b.second]]);
        }
    }
    count
}

/// Puts triangles in the order of the tree and adds its nodes. Halves are of equal number, so it is 20 deep at most.
fn build(faces: &mut [Face], first: usize, nodes: &mut Vec<Node>) {
    if faces.is_empty() {
        return;
    }
    let mut bounds = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    let mut middles = bounds;
    // Halved first, so that the sum is finite.
    let middle = |face: &Face| face.least * 0.5 + face.greatest * 0.5;
    for face in faces.iter() {
        bounds = [bounds[0].min(face.least), bounds[1].max(face.greatest)];
        middles = [middles[0].min(middle(face)), middles[1].max(middle(face))];
    }
    let at = nodes.len();
    nodes.push(Node {
        bounds,
        first,
        end: first + faces.len(),
        second: 0,
    });
    if faces.len() <= LEAF {
        return;
    }
    let extent = middles[1] * 0.5 - middles[0] * 0.5;
    let axis = extent.max_position();
    let half = faces.len() / 2;
    faces.select_nth_unstable_by(half, |a, b| {
        let by_middle = middle(a)[axis].total_cmp(&middle(b)[axis]);
        by_middle.then(a.corners.cmp(&b.corners))
    });
    let (left, right) = faces.split_at_mut(half);
    build(left, first, nodes);
    nodes[at].second = nodes.len();
    build(right, first + half, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::check::testing::*;

    /// Whole numbers without a pattern, the same on every run: Steele and others' splitmix64.
    struct Random(u64);

    impl Random {
        fn below(&mut self, end: u64) -> u64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (x ^ (x >> 31)) % end
        }

        fn unit(&mut self) -> Vec3 {
            Vec3::from_array([0; 3].map(|_| self.below(1 << 24) as f32 / (1 << 24) as f32))
        }
    }

    fn count(positions: &[Vec3], triangles: &[[u32; 3]]) -> usize {
        let face = |&corners: &[u32; 3]| Face::new(corners, corners.map(|i| positions[i as usize]));
        crossing(&triangles.iter().map(face).collect::<Vec<_>>())
    }

    /// The pairs that meet of a triangle with the corners 0, 1 and 2 and another.
    fn pair(first: [[f32; 3]; 3], more: &[[f32; 3]], second: [u32; 3]) -> usize {
        let mut positions = places(first);
        positions.extend(more.iter().copied().map(Vec3::from_array));
        let found = count(&positions, &[[0, 1, 2], second]);
        // Whichever comes first and is begun anywhere.
        let [a, b, c] = second;
        assert_eq!(count(&positions, &[[b, a, c], [2, 0, 1]]), found);
        found
    }

    const FLOOR: [[f32; 3]; 3] = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.]];

    #[test]
    fn strangers_cross_touch_or_lie_on_each_other() {
        let stranger = |corners: [[f32; 3]; 3]| pair(FLOOR, &corners, [3, 4, 5]);
        // Through the middle, past the long side, and above.
        assert_eq!(stranger([[1., 1., -1.], [1., 1., 1.], [1.5, 1., 1.]]), 1);
        assert_eq!(stranger([[3., 3., -1.], [3., 3., 1.], [3.5, 3., 1.]]), 0);
        assert_eq!(stranger([[1., 1., 1e-30], [1., 2., 1.], [1.5, 1., 1.]]), 0);
        // A corner on the face, on an edge, on a corner.
        assert_eq!(stranger([[1., 1., 0.], [1., 2., 1.], [1.5, 1., 1.]]), 1);
        assert_eq!(stranger([[2., 2., 0.], [1., 2., 1.], [1.5, 1., 1.]]), 1);
        assert_eq!(stranger([[0., 0., 0.], [1., 2., 1.], [1.5, 1., 1.]]), 1);
        // An edge across an edge.
        assert_eq!(stranger([[2., -1., -1.], [2., 1., 1.], [2., -9., 9.]]), 1);
        // In one plane: inside, around, over an edge, along an edge, beside, and beside within the box.
        assert_eq!(stranger([[1., 1., 0.], [2., 1., 0.], [1., 2., 0.]]), 1);
        assert_eq!(
            stranger([[-9., -9., 0.], [30., -9., 0.], [-9., 30., 0.]]),
            1
        );
        assert_eq!(stranger([[1., 1., 0.], [9., 8., 0.], [8., 9., 0.]]), 1);
        assert_eq!(stranger([[1., 0., 0.], [2., 0., 0.], [1., -1., 0.]]), 1);
        assert_eq!(stranger([[5., 0., 0.], [9., 0., 0.], [5., 4., 0.]]), 0);
        assert_eq!(stranger([[3., 3., 0.], [4., 3., 0.], [4., 4., 0.]]), 0);
    }

    #[test]
    fn of_neighbours_only_what_they_do_not_share_counts() {
        let corner = |p, q| pair(FLOOR, &[p, q], [0, 3, 4]);
        // One corner in common: away, up from it, through the face, onto the face, in the plane beside and on it.
        assert_eq!(corner([-1., 0., 0.], [-1., -1., 1.]), 0);
        assert_eq!(corner([1., 1., 1.], [1., 1., 2.]), 0);
        assert_eq!(corner([1., 1., -1.], [1., 1., 1.]), 1);
        assert_eq!(corner([9., 9., -1.], [9., 9., 1.]), 1);
        assert_eq!(corner([1., 1., 0.], [1., 1., 1.]), 1);
        assert_eq!(corner([-1., 1., 0.], [-1., 2., 0.]), 0);
        assert_eq!(corner([-1., 1., 0.], [1., 1., 0.]), 1);
        // Along the same edge without sharing its other end.
        assert_eq!(corner([2., 0., 0.], [0., -1., 0.]), 1);

        let edge = |p| pair(FLOOR, &[p], [1, 0, 3]);
        // One edge in common: unfolded, upright, sharply folded, folded onto each other.
        assert_eq!(edge([1., -1., 0.]), 0);
        assert_eq!(edge([1., 0., 1.]), 0);
        assert_eq!(edge([1., 1., 1e-30]), 0);
        assert_eq!(edge([1., 1., 0.]), 1);
        assert_eq!(edge([9., 9., 0.]), 1);
        // The same three corners.
        assert_eq!(count(&tetrahedron(), &[[0, 1, 2], [1, 0, 2]]), 1);
    }

    type Whole = [i64; 3];

    fn minus(a: Whole, b: Whole) -> Whole {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn cross(a: Whole, b: Whole) -> Whole {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    }

    fn dot(a: Whole, b: Whole) -> i64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    /// The other way to decide: two convex sets of whole numbers, a triangle and a triangle or segment, are apart if an
    /// axis parts them, out of those that can.
    fn are_apart(one: &[Whole], other: &[Whole]) -> bool {
        let edges = |of: &[Whole]| -> Vec<Whole> {
            (0..of.len())
                .map(|i| minus(of[(i + 1) % of.len()], of[i]))
                .collect()
        };
        let [e, f] = [edges(one), edges(other)];
        let normals: Vec<Whole> = [&e, &f]
            .map(|e| cross(e[0], e[1]))
            .into_iter()
            .filter(|n| *n != [0; 3])
            .collect();
        let mut axes = normals.clone();
        for &a in e.iter().chain(&f) {
            axes.extend(f.iter().map(|&b| cross(a, b)));
            axes.extend(normals.iter().map(|&n| cross(n, a)));
        }
        axes.iter().any(|&axis| {
            let range = |of: &[Whole]| {
                let along = of.iter().map(|&p| dot(axis, p));
                along.clone().min().zip(along.max()).expect("corners")
            };
            let [(a, b), (c, d)] = [range(one), range(other)];
            b < c || d < a
        })
    }

    #[test]
    fn meeting_agrees_with_separating_axes_in_whole_numbers() {
        let mut random = Random(7);
        let mut met = [[0; 2]; 3];
        for _ in 0..60_000 {
            let [[a, b, c], [d, e, f]] =
                [0; 2].map(|_| [0; 3].map(|_| [0; 3].map(|_| random.below(5) as i64)));
            let count = random.below(3) as usize;
            let second = [[d, e, f], [a, e, f], [a, b, f]][count];
            let float = |p: Whole| Vec3::from_array(p.map(|x| x as f32));
            let indices = [[3, 4, 5], [0, 4, 5], [0, 1, 5]][count];
            let one = Face::new([0, 1, 2], [a, b, c].map(float));
            let other = Face::new(indices, second.map(float));
            if one.is_flat() || other.is_flat() {
                assert!(
                    [[a, b, c], second]
                        .iter()
                        .any(|&[a, b, c]| cross(minus(b, a), minus(c, a)) == [0; 3])
                );
                continue;
            }
            // From a shared corner the triangle is drawn out far beyond the other's opposite edge.
            let far = |p: Whole| [0, 1, 2].map(|i| a[i] + 10_000 * (p[i] - a[i]));
            let expected = match count {
                0 => !are_apart(&[a, b, c], &second),
                1 => !are_apart(&[a, far(b), far(c)], &[e, f]),
                _ => {
                    let [n, m] = [c, f].map(|p| cross(minus(b, a), minus(p, a)));
                    cross(n, m) == [0; 3] && dot(n, m) > 0
                }
            };
            let found = one.overlaps(&other) && one.crosses(&other);
            assert_eq!(
                found, expected,
                "{a:?} {b:?} {c:?} with {second:?}, {count} shared"
            );
            assert_eq!(one.crosses(&other), other.crosses(&one));
            met[count][usize::from(found)] += 1;
        }
        assert!(
            met.as_flattened().iter().all(|&count| count > 400),
            "too few of a kind: {met:?}"
        );
    }

    #[test]
    fn the_tree_finds_all_pairs_of_a_random_mesh() {
        let mut random = Random(1);
        let positions: Vec<Vec3> = (0..900).map(|_| random.unit()).collect();
        let mut triangles = Vec::new();
        while triangles.len() < 1500 {
            let [a, b, c] = [0; 3].map(|_| random.below(900) as u32);
            // Long ones and short ones, many of them with corners in common.
            let is_near = (positions[a as usize] - positions[b as usize]).length() < 0.2;
            if a != b && b != c && c != a && (is_near || triangles.len() % 10 == 0) {
                triangles.push([a, b, c]);
            }
        }
        let faces: Vec<Face> = triangles
            .iter()
            .map(|&t| Face::new(t, t.map(|i| positions[i as usize])))
            .collect();
        let pairs = (0..faces.len()).flat_map(|i| (0..i).map(move |j| [i, j]));
        let expected = pairs.filter(|&[i, j]| faces[i].crosses(&faces[j])).count();
        assert!(expected > 10_000, "{expected}");
        assert_eq!(count(&positions, &triangles), expected);
    }

    #[test]
    fn a_pile_of_triangles_ends() {
        assert_eq!(count(&tetrahedron(), &vec![[0, 1, 2]; 3000]), MAX_CROSSING);
        assert_eq!(count(&[], &[]), 0);
    }
}
