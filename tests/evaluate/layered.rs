//! Section 7.6.2: what a layered representation makes of a surface, a distance field, a depth map or six of them, each
//! against the triangles that it was sampled from.

use crate::scatter::Random;
use fabrica::data::Surface;
use glam::{UVec3, Vec2, Vec3};

/// A representation sampled from a surface over its cube of side 1.2 about the origin.
pub(crate) enum Layered {
    /// n³ distances, positive inside.
    Field { n: u32, texels: Vec<f32> },
    /// Depth maps of n² texels, each seen along an axis from one of the cube's sides.
    Maps { n: u32, maps: Vec<DepthMap> },
}

/// How far a surface lies behind a side of the cube.
pub(crate) struct DepthMap {
    /// The axis that it looks along.
    axis: usize,
    /// True if it looks from the far end back.
    is_back: bool,
    texels: Vec<f32>,
}

/// Half the side of the cube that is sampled, subject units.
const HALF: f32 = 0.6;

impl Layered {
    /// A distance field of n³ texels, exact at their centres.
    pub(crate) fn field(surface: &Surface, n: u32) -> Self {
        let texels = (0..n * n * n)
            .map(|i| surface.depth_at(center(UVec3::new(i % n, i / n % n, i / n / n), n)))
            .collect();
        Self::Field { n, texels }
    }

    /// The depth map from above, which looks along −z.
    pub(crate) fn depth_map(surface: &Surface, n: u32) -> Self {
        let maps = vec![DepthMap::new(surface, n, 2, true)];
        Self::Maps { n, maps }
    }

    /// The depth maps from all six sides.
    pub(crate) fn cube(surface: &Surface, n: u32) -> Self {
        let sides = (0..3).flat_map(|axis| [(axis, false), (axis, true)]);
        let maps = sides
            .map(|(axis, is_back)| DepthMap::new(surface, n, axis, is_back))
            .collect();
        Self::Maps { n, maps }
    }

    /// Bytes of its textures, with 32-bit floats.
    pub(crate) fn bytes(&self) -> usize {
        4 * match self {
            Self::Field { texels, .. } => texels.len(),
            Self::Maps { maps, .. } => maps.iter().map(|map| map.texels.len()).sum(),
        }
    }

    /// L at a place: positive inside. Of several maps the one nearest to 0, positive where all are (equation 7.7).
    ///
    /// Differs from the source: equation 7.6 has the plane behind the surface, here it lies before it, so the sign is
    /// the other way round.
    pub(crate) fn value(&self, place: Vec3) -> f32 {
        match self {
            Self::Field { n, texels } => between(*n, texels, place),
            Self::Maps { n, maps } => {
                let mut nearest = f32::INFINITY;
                let mut is_inside = true;
                for map in maps {
                    let value = map.value(*n, place);
                    is_inside &= value > 0.0;
                    nearest = nearest.min(value.abs());
                }
                if is_inside { nearest } else { -nearest }
            }
        }
    }
}

/// Centre of a texel of the cube.
fn center(texel: UVec3, n: u32) -> Vec3 {
    ((texel.as_vec3() + 0.5) / n as f32 * 2.0 - 1.0) * HALF
}

/// Linear between the eight texels around a place.
fn between(n: u32, texels: &[f32], place: Vec3) -> f32 {
    let last = (n - 1) as f32;
    let at = ((place / HALF * 0.5 + 0.5) * n as f32 - 0.5).clamp(Vec3::ZERO, Vec3::splat(last));
    let low = at.floor().min(Vec3::splat(last - 1.0));
    let part = at - low;
    let low = low.as_uvec3();
    (0..8u32)
        .map(|corner| {
            let step = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
            let weight = Vec3::select(step.cmpgt(UVec3::ZERO), part, 1.0 - part).element_product();
            let cell = low + step;
            weight * texels[(cell.x + n * (cell.y + n * cell.z)) as usize]
        })
        .sum()
}

impl DepthMap {
    fn new(surface: &Surface, n: u32, axis: usize, is_back: bool) -> Self {
        let mut way = Vec3::ZERO;
        way[axis] = if is_back { -2.0 * HALF } else { 2.0 * HALF };
        let texels = (0..n * n)
            .map(|i| {
                let [u, v] =
                    [i % n, i / n].map(|j| ((j as f32 + 0.5) / n as f32 * 2.0 - 1.0) * HALF);
                let mut from = Vec3::ZERO;
                from[(axis + 1) % 3] = u;
                from[(axis + 2) % 3] = v;
                let from = from - way * 0.5;
                // Where nothing is met the depth is that of the far side.
                first_part(surface, from, from + way).map_or(2.0 * HALF, |part| part * 2.0 * HALF)
            })
            .collect();
        Self {
            axis,
            is_back,
            texels,
        }
    }

    /// L = d − H: how far a place lies behind the surface that the map sees (equation 7.6).
    fn value(&self, n: u32, place: Vec3) -> f32 {
        let seen = Vec2::new(place[(self.axis + 1) % 3], place[(self.axis + 2) % 3]);
        let last = (n - 1) as f32;
        let at = ((seen / HALF * 0.5 + 0.5) * n as f32 - 0.5).clamp(Vec2::ZERO, Vec2::splat(last));
        let low = at.floor().min(Vec2::splat(last - 1.0));
        let part = at - low;
        let low = low.as_uvec2();
        let texel = |x: u32, y: u32| self.texels[(low.x + x + n * (low.y + y)) as usize];
        let row = |y: u32| texel(0, y) * (1.0 - part.x) + texel(1, y) * part.x;
        let depth = row(0) * (1.0 - part.y) + row(1) * part.y;
        let along = place[self.axis];
        let distance = if self.is_back {
            HALF - along
        } else {
            along + HALF
        };
        distance - depth
    }
}

/// Where on the way between two places the first triangle is met, 0 to 1.
pub(crate) fn first_part(surface: &Surface, from: Vec3, to: Vec3) -> Option<f32> {
    let mut nearest = f32::INFINITY;
    surface
        .tree
        .crossings(&surface.triangles, from, to, |_, part, _| {
            nearest = nearest.min(part)
        });
    nearest.is_finite().then_some(nearest)
}

/// How a representation's surface differs from the triangles.
#[derive(Debug)]
pub(crate) struct SurfaceError {
    /// Mean distance along the rays that both meet within [`NEAR`], subject units.
    pub(crate) mean: f64,
    /// Share of all rays that only one of them meets, or that they meet farther apart.
    pub(crate) wrong: f64,
}

/// Farther apart than this the two surfaces are different ones, subject units.
const NEAR: f32 = 0.02;

/// Straight rays towards the middle from random places around: all sides, or only from above (0.8 of the way up).
pub(crate) fn rays(count: usize, is_from_above: bool) -> Vec<(Vec3, Vec3)> {
    let mut random = Random(41);
    std::iter::from_fn(|| Some((random.vector(-1.0, 1.0), random.vector(-0.35, 0.35))))
        .filter(|(from, _)| (0.3..1.0).contains(&from.length_squared()))
        .map(|(from, to)| (from.normalize() * 0.95, to))
        .filter(|(from, _)| !is_from_above || from.z > 0.76)
        .take(count)
        .map(|(from, to)| (from, from + (to - from).normalize() * 1.9))
        .collect()
}

/// Compares by even steps of 1/1024 with halving, which lose nothing of the representation itself.
pub(crate) fn error_of(
    layered: &Layered,
    surface: &Surface,
    rays: &[(Vec3, Vec3)],
) -> SurfaceError {
    let (mut sum, mut both, mut wrong) = (0.0, 0, 0);
    for &(from, to) in rays {
        let length = from.distance(to);
        let found = first_inside(layered, from, to).map(|part| part * length);
        let right = first_part(surface, from, to).map(|part| part * length);
        match (found, right) {
            (Some(found), Some(right)) if (found - right).abs() < NEAR => {
                sum += f64::from((found - right).abs());
                both += 1;
            }
            (None, None) => {}
            _ => wrong += 1,
        }
    }
    SurfaceError {
        mean: sum / f64::from(both.max(1)),
        wrong: f64::from(wrong) / rays.len() as f64,
    }
}

/// Where on the way between two places L first turns positive, 0 to 1.
fn first_inside(layered: &Layered, from: Vec3, to: Vec3) -> Option<f32> {
    let place = |part: f32| from.lerp(to, part);
    let steps = (from.distance(to) * 1024.0).ceil();
    let at = |i: f32| i / steps;
    let found = (0..=steps as u32).find(|&i| {
        let place = place(at(i as f32));
        // Beyond the cube nothing was sampled.
        place.abs().max_element() < HALF && layered.value(place) > 0.0
    })?;
    let (mut low, mut high) = (at((found as f32 - 1.0).max(0.0)), at(found as f32));
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        if layered.value(place(middle)) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}
