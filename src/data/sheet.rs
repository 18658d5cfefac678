//! The triangles of a bent figure, as they are drawn.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::volume::Segment;
use crate::math::Aabb;

/// The triangles of a figure at rest. They stay the same while handles move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetMesh {
    /// Places of the vertices at rest, subject space.
    pub rest: Vec<Vec2>,
    /// Per vertex a colour in place of the plate's: straight linear RGB and 1; alpha 0 takes the plate's.
    pub colors: Vec<[f32; 4]>,
    /// Corners of the triangles, counter-clockwise at rest; of two that share a place the first is in front there.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle its region in `regions`.
    pub region_of: Vec<u16>,
    /// Names of the regions.
    pub regions: Vec<String>,
}

/// A bent figure: where its vertices are, and which triangles are in front. Cheap to clone.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Vertices at rest and triangles.
    pub mesh: Arc<SheetMesh>,
    /// Where the vertices are, subject space.
    pub places: Arc<Vec<Vec2>>,
    /// All triangles in the order of drawing, from behind to front.
    pub order: Arc<Vec<u32>>,
    /// Where the vertices are before handles move them, subject space; `None`: where they are at rest.
    pub base: Option<Arc<Vec<Vec2>>>,
}

/// Places at rest nearer to each other than this are one, subject units.
const SAME: f32 = 1e-4;
/// Weights of a triangle's corners may be so much below 0 for a place to be in it: rounding must not open its edges.
const EDGE: f32 = 1e-5;

impl Sheet {
    /// True if both are one thing in memory: nothing is compared.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh)
            && Arc::ptr_eq(&self.places, &other.places)
            && Arc::ptr_eq(&self.order, &other.order)
    }

    /// True if both are one sheet, or none.
    pub fn are_same(one: Option<&Self>, other: Option<&Self>) -> bool {
        match (one, other) {
            (Some(one), Some(other)) => one.is_same(other),
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    /// The regions as segments, whose labels count them from 1.
    pub fn segments(&self) -> Vec<Segment> {
        let regions = (1..).zip(&self.mesh.regions);
        let segments = regions.map(|(label, name)| Segment {
            label,
            name: name.clone(),
            color_srgb: None,
        });
        segments.collect()
    }

    /// Box of the bent figure, subject space.
    pub fn bounds(&self) -> Aabb {
        Aabb::from_points(self.places.iter().map(|place| place.extend(0.0)))
    }

    /// Where a place at rest is, subject space: `None` if the figure does not have it, or if something else is in front
    /// of it there.
    pub fn seen(&self, at_rest: Vec3) -> Option<Vec3> {
        let (triangle, place) = self.forward(at_rest.truncate())?;
        let (front, seen) = self.back(place)?;
        // On an edge of two triangles either may be found.
        let is_it = front == triangle || seen.distance(at_rest.truncate()) < SAME;
        is_it.then(|| place.extend(0.0))
    }

    /// The triangle in front that has a place at rest, and where that place is.
    pub fn forward(&self, at_rest: Vec2) -> Option<(usize, Vec2)> {
        let mut triangles = self.mesh.triangles.iter().enumerate();
        triangles.find_map(|(triangle, _)| {
            let weights = self.weights(triangle, &self.mesh.rest, at_rest)?;
            Some((triangle, self.mixed(triangle, &self.places, weights)))
        })
    }

    /// Where a place at rest is before handles move it: contours and a likeness may have carried it. A place that the
    /// figure does not have stays.
    pub fn before_handles(&self, at_rest: Vec2) -> Vec2 {
        let moved = || {
            let base = self.base.as_ref()?;
            let (triangle, _) = self.forward(at_rest)?;
            let weights = self.weights(triangle, &self.mesh.rest, at_rest)?;
            Some(self.mixed(triangle, base, weights))
        };
        moved().unwrap_or(at_rest)
    }

    /// The turn (radians, counter-clockwise) and the scale that a triangle has taken from before handles moved it.
    pub fn motion_of(&self, triangle: usize) -> Option<(f32, f32)> {
        let base = self.base.as_ref().map_or(&self.mesh.rest, |base| base);
        let [a, b, c] = self.corners(triangle, base)?;
        let [p, q, r] = self.corners(triangle, &self.places)?;
        let (from, to) = ([b - a, c - a], [q - p, r - p]);
        let area = from[0].perp_dot(from[1]);
        if area.abs() <= f32::MIN_POSITIVE {
            return None;
        }
        // Columns of the triangle's linear map.
        let x = (to[0] * from[1].y - to[1] * from[0].y) / area;
        let y = (to[1] * from[0].x - to[0] * from[1].x) / area;
        let turn = (x.y - y.x).atan2(x.x + y.y);
        Some((turn, x.perp_dot(y).abs().sqrt()))
    }

    /// The middle of a region at rest, by area; `None` if no triangle belongs to it.
    pub fn middle_of(&self, region: &str) -> Option<Vec2> {
        let (mut sum, mut all) = (Vec2::ZERO, 0.0);
        for triangle in 0..self.mesh.triangles.len() {
            if self.region(triangle) == region
                && let Some([a, b, c]) = self.corners(triangle, &self.mesh.rest)
            {
                let area = (b - a).perp_dot(c - a);
                sum += (a + b + c) * (area / 3.0);
                all += area;
            }
        }
        (all > 0.0).then(|| sum / all)
    }

    /// The triangle that is seen at a place of the bent figure, and which place at rest that is.
    pub fn back(&self, place: Vec2) -> Option<(usize, Vec2)> {
        let mut from_front = self.order.iter().rev();
        from_front.find_map(|triangle| {
            let triangle = *triangle as usize;
            let weights = self.weights(triangle, &self.places, place)?;
            Some((triangle, self.mixed(triangle, &self.mesh.rest, weights)))
        })
    }

    /// Name of the region of a triangle; empty if there is no such triangle.
    pub fn region(&self, triangle: usize) -> &str {
        let region = self.mesh.region_of.get(triangle);
        let name = region.and_then(|region| self.mesh.regions.get(usize::from(*region)));
        name.map_or("", String::as_str)
    }

    fn corners(&self, triangle: usize, places: &[Vec2]) -> Option<[Vec2; 3]> {
        let [a, b, c] = *self.mesh.triangles.get(triangle)?;
        let place = |vertex: u32| places.get(vertex as usize).copied();
        Some([place(a)?, place(b)?, place(c)?])
    }

    fn weights(&self, triangle: usize, places: &[Vec2], at: Vec2) -> Option<[f32; 3]> {
        let [a, b, c] = self.corners(triangle, places)?;
        let area = (b - a).perp_dot(c - a);
        let [u, v] = [
            (b - at).perp_dot(c - at) / area,
            (c - at).perp_dot(a - at) / area,
        ];
        let weights = [u, v, 1.0 - u - v];
        weights
            .iter()
            .all(|weight| *weight >= -EDGE)
            .then_some(weights)
    }

    fn mixed(&self, triangle: usize, places: &[Vec2], weights: [f32; 3]) -> Vec2 {
        let Some([a, b, c]) = self.corners(triangle, places) else {
            return Vec2::ZERO;
        };
        weights[0] * a + weights[1] * b + weights[2] * c
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of two triangles at the left, and one triangle at the right that was brought over it.
    fn sheet() -> Sheet {
        let rest = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [2.0, 0.0],
            [3.0, 0.0],
            [2.0, 1.0],
        ];
        let rest: Vec<Vec2> = rest.map(Vec2::from_array).to_vec();
        let mut places = rest.clone();
        places[4..].iter_mut().for_each(|place| place.x -= 2.0);
        Sheet {
            mesh: Arc::new(SheetMesh {
                colors: vec![[0.0; 4]; rest.len()],
                rest,
                triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6]],
                region_of: vec![0, 0, 1],
                regions: vec!["ground".to_owned(), "flap".to_owned()],
            }),
            places: Arc::new(places),
            order: Arc::new(vec![0, 1, 2]),
            base: None,
        }
    }

    #[test]
    fn motions_and_middles_are_those_of_the_triangles() {
        let mut sheet = sheet();
        let middle = sheet.middle_of("ground").expect("it is there");
        assert!(middle.distance(Vec2::splat(0.5)) < 1e-6, "{middle}");
        assert_eq!(sheet.middle_of("none"), None);
        // The flap is turned by a quarter and doubled.
        let turned = [[0.0, 0.0], [0.0, 2.0], [-2.0, 0.0]].map(Vec2::from_array);
        Arc::make_mut(&mut sheet.places)[4..].copy_from_slice(&turned);
        let (turn, scale) = sheet.motion_of(2).expect("it has an area");
        assert!((turn - std::f32::consts::FRAC_PI_2).abs() < 1e-6 && (scale - 2.0).abs() < 1e-6);
        // What another outline has carried away was there before handles moved it.
        let at = Vec2::new(0.2, 0.1);
        assert_eq!(sheet.before_handles(at), at);
        let base = sheet.mesh.rest.iter().map(|place| *place + Vec2::Y);
        sheet.base = Some(Arc::new(base.collect()));
        assert!(sheet.before_handles(at).distance(at + Vec2::Y) < 1e-6);
        assert_eq!(sheet.before_handles(Vec2::splat(9.0)), Vec2::splat(9.0));
    }

    #[test]
    fn places_go_there_and_back() {
        let sheet = sheet();
        let at = Vec2::new(2.25, 0.25);
        let (triangle, place) = sheet.forward(at).expect("it has the place");
        assert_eq!((triangle, place), (2, Vec2::new(0.25, 0.25)));
        assert_eq!(sheet.region(triangle), "flap");
        assert_eq!(sheet.back(place), Some((2, at)));
        assert_eq!(sheet.back(Vec2::new(2.5, 0.2)), None, "it has left");
        assert_eq!(sheet.forward(Vec2::new(-0.1, 0.5)), None, "outside");
    }

    #[test]
    fn what_is_covered_is_not_seen() {
        let sheet = sheet();
        assert_eq!(sheet.seen(Vec3::new(0.2, 0.3, 0.0)), None, "under the flap");
        let free = Vec3::new(0.9, 0.8, 0.0);
        assert_eq!(sheet.seen(free), Some(free));
        let on_flap = Vec3::new(2.2, 0.3, 0.0);
        assert!(sheet.seen(on_flap).is_some());
    }
}
