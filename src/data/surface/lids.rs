//! Lids: triangles that close the holes of an open body where its winding number is ½ (spec/surfaces.md, "Inside and
//! outside").
//!
//! ```text
//!     rim o-----o rim        a hole is cut into triangles between its corners, those are parted until they are small
//!          \ . /             beside the hole, and each new corner is moved to where |w| = ½
//! ```

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::triangle::Triangle;
use super::winding::Winding;
use crate::data::mesh::edges::{by_edge, sides};
use crate::data::mesh::polygon::{MAX_CORNERS, triangulate};
use crate::math::Aabb;

/// Sides of the triangles of a lid, but for those along the rim: so many across it, unless they are shorter than so
/// many voxels of the field.
const SIDES_ACROSS: f32 = 12.0;
const LONGEST_SIDE: f32 = 2.0;
/// Holes of a segment at most; one with more stays open, as does one with a hole of too many corners.
const MAX_HOLES: usize = 4096;
/// Triangles that are tried for all lids of a surface; where they are used up, holes stay open. They bound the time.
pub(super) const MAX_TRIANGLES: usize = 20_000;
/// How far a corner is moved at most, as a part of the hole's width.
const FARTHEST: f32 = 0.4;
/// How often sides are parted at most: each time they become half as long.
const MAX_PARTINGS: usize = 8;
/// How far from ½ the winding number in the middle of a lid's triangles may be, and for which share of them. Where it
/// is farther, the hole is not that of a body: a sheet by itself has none.
const MAX_OFF: f64 = 0.12;
const LEAST_SHARE: f64 = 0.9;
/// How far beside a lid the number is asked, voxels of the field.
const ASIDE: f32 = 0.05;

/// What closes the holes of a segment.
#[derive(Debug, Default)]
pub(super) struct Lids {
    /// Rest space; fronts are outside, as those of the triangles around the hole are.
    pub(super) triangles: Vec<Triangle>,
    /// Unit normals at the corners of each.
    pub(super) normals: Vec<[Vec3; 3]>,
    /// True if no hole is left.
    pub(super) close_all: bool,
}

/// Closes the holes of a segment, given its triangles, their winding number and the side of a voxel of the field.
/// `left` is how many triangles may be tried, and is made less by those that were.
pub(super) fn lids_of(
    triangles: &[Triangle],
    winding: &Winding,
    voxel: f32,
    left: &mut usize,
) -> Lids {
    let (places, indexed) = welded(triangles);
    let Some(holes) = holes_of(&indexed) else {
        return Lids::default();
    };
    let mut lids = Lids {
        close_all: true,
        ..Lids::default()
    };
    for hole in holes {
        let rim = hole.iter().map(|&index| places[index as usize]).collect();
        match Lid::over(rim, winding, voxel, left) {
            Some(lid) => lid.add_to(&mut lids),
            None => lids.close_all = false,
        }
    }
    lids
}

/// The places of triangles' corners, each once, and the triangles by them.
fn welded(triangles: &[Triangle]) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut places = Vec::new();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let indexed = triangles.iter().map(|triangle| {
        triangle.0.map(|corner| {
            // −0 is 0.
            let key = (corner + 0.0).to_array().map(f32::to_bits);
            *known.entry(key).or_insert_with(|| {
                places.push(corner);
                places.len() as u32 - 1
            })
        })
    });
    let indexed = indexed.collect();
    (places, indexed)
}

/// The holes between triangles: their corners, in the turn that closes them. `None` where there are too many.
fn holes_of(triangles: &[[u32; 3]]) -> Option<Vec<Vec<u32>>> {
    // Sides that no triangle has the other way, turned round: where each leads to.
    let mut ways: HashMap<u32, Vec<u32>> = HashMap::new();
    for edge in by_edge(&sides(triangles)) {
        let forward = edge.iter().filter(|side| side.is_forward).count();
        let back = edge.len() - forward;
        let [low, high] = edge[0].edge;
        let (from, to) = if forward > back {
            (high, low)
        } else {
            (low, high)
        };
        for _ in 0..forward.abs_diff(back) {
            ways.entry(from).or_default().push(to);
        }
    }
    let mut starts: Vec<u32> = ways.keys().copied().collect();
    starts.sort_unstable();
    let mut holes = Vec::new();
    for start in starts {
        // Wherever the way comes to a place that it has passed, the loop since then is a hole.
        let mut path = vec![start];
        while let Some(&last) = path.last() {
            let Some(next) = ways.get_mut(&last).and_then(Vec::pop) else {
                break;
            };
            match path.iter().position(|&passed| passed == next) {
                Some(at) => {
                    let hole = path.split_off(at);
                    path.push(next);
                    if hole.len() >= 3 {
                        holes.push(hole);
                    }
                }
                None => path.push(next),
            }
            if holes.len() > MAX_HOLES || path.len() > MAX_CORNERS {
                return None;
            }
        }
    }
    Some(holes)
}

/// A lid that is being made.
struct Lid {
    /// The rim first.
    places: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    rim: usize,
}

impl Lid {
    /// The lid over a hole; `None` where none fits, or no triangles are left to try.
    fn over(rim: Vec<Vec3>, winding: &Winding, voxel: f32, left: &mut usize) -> Option<Self> {
        if rim.len() > *left {
            return None;
        }
        let wide: Vec<DVec3> = rim.iter().map(|place| place.as_dvec3()).collect();
        let index = |corner: usize| corner as u32;
        let mut lid = Self {
            triangles: triangulate(&wide)
                .into_iter()
                .map(|corners| corners.map(index))
                .collect(),
            rim: rim.len(),
            places: rim,
        };
        let width = lid.width();
        let longest = (width / SIDES_ACROSS).max(LONGEST_SIDE * voxel);
        for _ in 0..MAX_PARTINGS {
            if !lid.part(longest, winding, width) {
                break;
            }
            if lid.triangles.len() > *left {
                *left = 0;
                return None;
            }
        }
        *left -= lid.triangles.len();
        let good = lid.triangles.iter().filter(|corners| {
            let triangle = Triangle(corners.map(|i| lid.places[i as usize]));
            let middle = triangle.0.iter().sum::<Vec3>() / 3.0;
            let aside = triangle.area_normal().normalize_or_zero() * (ASIDE * voxel);
            let both = [middle - aside, middle + aside].map(|place| winding.at(place));
            // Across a triangle the number changes its sign.
            both[0] * both[1] > 0.0 && both.iter().all(|w| (w.abs() - 0.5).abs() <= MAX_OFF)
        });
        let good = good.count() as f64;
        (good >= LEAST_SHARE * lid.triangles.len() as f64).then_some(lid)
    }

    /// The longest side of the rim's box.
    fn width(&self) -> f32 {
        Aabb::from_points(self.places.iter().copied())
            .size()
            .max_element()
    }

    fn is_rim(&self, a: u32, b: u32) -> bool {
        let (a, b) = (a.min(b) as usize, a.max(b) as usize);
        b < self.rim && (b - a == 1 || (a == 0 && b + 1 == self.rim))
    }

    /// Parts the sides that are longer than `longest` in their middles. False if there was none.
    fn part(&mut self, longest: f32, winding: &Winding, width: f32) -> bool {
        let normals = self.normals();
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        for corners in self.triangles.clone() {
            for [a, b] in sides_of(corners) {
                let [from, to] = [a, b].map(|i| self.places[i as usize]);
                let key = [a.min(b), a.max(b)];
                if from.distance(to) <= longest || self.is_rim(a, b) || middles.contains_key(&key) {
                    continue;
                }
                middles.insert(key, self.places.len() as u32);
                let out = (normals[a as usize] + normals[b as usize]).normalize_or_zero();
                self.places
                    .push(moved_to_half(winding, (from + to) * 0.5, out, width));
            }
        }
        if middles.is_empty() {
            return false;
        }
        let parted = self.triangles.iter().flat_map(|&corners| {
            let middle = |[a, b]: [u32; 2]| middles.get(&[a.min(b), a.max(b)]).copied();
            parts_of(corners, sides_of(corners).map(middle))
        });
        self.triangles = parted.collect();
        true
    }

    /// Unit normals at the corners, each by the areas around it.
    fn normals(&self) -> Vec<Vec3> {
        let mut sums = vec![Vec3::ZERO; self.places.len()];
        for corners in &self.triangles {
            let normal = Triangle(corners.map(|i| self.places[i as usize])).area_normal();
            for &corner in corners {
                sums[corner as usize] += normal;
            }
        }
        sums.into_iter().map(Vec3::normalize_or_zero).collect()
    }

    fn add_to(&self, lids: &mut Lids) {
        let normals = self.normals();
        for corners in &self.triangles {
            lids.triangles
                .push(Triangle(corners.map(|i| self.places[i as usize])));
            lids.normals.push(corners.map(|i| normals[i as usize]));
        }
    }
}

fn sides_of([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// A triangle parted at the middles of some of its sides: those from its first corner to the second, to the third, and
/// back.
fn parts_of([a, b, c]: [u32; 3], middles: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    match middles {
        [None, None, None] => vec![[a, b, c]],
        [Some(ab), Some(bc), Some(ca)] => {
            vec![[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        }
        [Some(ab), None, None] => vec![[a, ab, c], [ab, b, c]],
        [Some(ab), Some(bc), None] => vec![[ab, b, bc], [a, ab, bc], [a, bc, c]],
        // The others are these, turned.
        [first, second, third] => parts_of([b, c, a], [second, third, first]),
    }
}

/// The place nearest to another along `out` where |w| = ½, or that place where there is none near it. |w| falls along
/// `out`. `width` is that of the hole.
fn moved_to_half(winding: &Winding, place: Vec3, out: Vec3, width: f32) -> Vec3 {
    let over_half = |t: f32| winding.precisely_at(place + out * t).abs() - 0.5;
    let here = over_half(0.0);
    let first = FARTHEST / 16.0 * width;
    let away = if here > 0.0 { first } else { -first };
    let (mut near, mut far) = ((0.0, here), (away, over_half(away)));
    while (far.1 > 0.0) == (here > 0.0) {
        if far.0.abs() >= FARTHEST * width {
            return place;
        }
        near = far;
        far = (2.0 * far.0, over_half(2.0 * far.0));
    }
    for _ in 0..10 {
        let middle = 0.5 * (near.0 + far.0);
        let value = over_half(middle);
        if (value > 0.0) == (here > 0.0) {
            near = (middle, value);
        } else {
            far = (middle, value);
        }
    }
    // Through a triangle the number jumps: no lid is there.
    if (near.1 - far.1).abs() > 0.25 {
        return place;
    }
    place + out * (0.5 * (near.0 + far.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::surface::testing::soup;

    /// A tube around the z axis, open at both ends; its radius grows from 0.2 by 0.1.
    fn tube(around: u32) -> Vec<Triangle> {
        let place = |i: u32, z: f32| {
            let angle = i as f32 / around as f32 * std::f32::consts::TAU;
            ((0.25 + 0.1 * z) * Vec3::new(angle.cos(), angle.sin(), 0.0)).with_z(z)
        };
        (0..around)
            .flat_map(|i| {
                let [a, b] = [i, (i + 1) % around].map(|i| place(i, -0.5));
                let [c, d] = [i, (i + 1) % around].map(|i| place(i, 0.5));
                [Triangle([a, b, d]), Triangle([a, d, c])]
            })
            .collect()
    }

    #[test]
    fn both_ends_of_a_tube_are_closed() {
        let tube = tube(40);
        let winding = Winding::new(&tube);
        let few = lids_of(&tube, &winding, 1.0 / 128.0, &mut 200);
        assert!(
            !few.close_all && few.triangles.is_empty(),
            "no time for them"
        );
        let mut left = MAX_TRIANGLES;
        let lids = lids_of(&tube, &winding, 1.0 / 128.0, &mut left);
        assert!(lids.close_all);
        assert_eq!(left + lids.triangles.len(), MAX_TRIANGLES);
        assert_eq!(lids.triangles.len(), lids.normals.len());
        assert!(lids.triangles.len() > 300, "{}", lids.triangles.len());
        for (triangle, normals) in lids.triangles.iter().zip(&lids.normals) {
            let middle = triangle.0.iter().sum::<Vec3>() / 3.0;
            let off = (winding.precisely_at(middle).abs() - 0.5).abs();
            assert!(off < 0.005, "{middle}: {off}");
            let out = middle.z.signum();
            assert!(triangle.area_normal().z * out > 0.0, "fronts are outside");
            assert!(normals.iter().all(|normal| normal.z * out > 0.5));
        }
        let all: Vec<Triangle> = [&tube[..], &lids.triangles].concat();
        let (_, indexed) = welded(&all);
        assert_eq!(
            holes_of(&indexed),
            Some(Vec::new()),
            "nothing is open any more"
        );
    }

    #[test]
    fn holes_that_meet_in_a_corner_are_told_apart() {
        // A fan of four squares around a corner, two opposite ones missing: its outline passes the corner twice.
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 6]];
        let mut sizes: Vec<usize> = holes_of(&triangles)
            .expect("few")
            .iter()
            .map(Vec::len)
            .collect();
        sizes.sort_unstable();
        assert_eq!(sizes, [4, 4]);
    }

    #[test]
    fn sheets_and_soups_have_no_lid() {
        let soup: Vec<Triangle> = soup(200, 3).into_iter().map(Triangle).collect();
        let lids = lids_of(&soup, &Winding::new(&soup), 1.0 / 128.0, &mut 5000);
        assert!(!lids.close_all);
        assert!(lids.triangles.len() < 20, "{}", lids.triangles.len());
        let many: Vec<Triangle> = (0..5000)
            .map(|i| Triangle([Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p + i as f32 * Vec3::Z)))
            .collect();
        let lids = lids_of(&many, &Winding::new(&many), 1.0 / 128.0, &mut 5000);
        assert!(!lids.close_all && lids.triangles.is_empty());
    }

    #[test]
    fn triangles_are_parted_without_a_gap() {
        let corners = [0, 1, 2];
        for mask in 0..8_u32 {
            let middles = [3, 4, 5].map(|i| (mask >> (i - 3) & 1 == 1).then_some(i));
            let parts = parts_of(corners, middles);
            assert_eq!(parts.len() as u32, 1 + mask.count_ones());
            // Sides inside come both ways, the others once.
            let all = sides(&parts);
            let open = by_edge(&all).filter(|edge| edge.len() == 1).count();
            assert_eq!(open as u32, 3 + mask.count_ones(), "{parts:?}");
        }
    }
}
