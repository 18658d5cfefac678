//! The field of a surface: signed distances and segments on a grid of voxels. A map to the triangles, never the truth.

use glam::{DAffine3, DVec3, UVec3, Vec3};

use super::triangle::Triangle;
use super::winding::Winding;
use crate::math::Aabb;

/// Voxels along the longest side of the surface's box.
pub const FIELD_VOXELS: u32 = 128;

/// Voxels of the field around the box, on each side.
pub const FIELD_MARGIN: u32 = 2;

/// How far from triangles the distances are exact, voxels.
const BAND: f32 = 2.0;

/// Distances on a grid, x fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceField {
    /// Voxels along each axis, the margin counted.
    pub dims: UVec3,
    /// Rest space from voxel indices, the centre of the first voxel at 0.
    pub rest_from_voxel: DAffine3,
    /// Distance of each voxel's centre to the nearest triangle, subject units, below 0 where no segment is inside. Near
    /// triangles exact; farther away at most what it is, and at least nine tenths of it.
    pub depths: Vec<f32>,
    /// The set of segments that each voxel's centre is inside of, an index into `sets`; 0 for none.
    pub fills: Vec<u8>,
    /// Sets of segments: how often a place is inside of each, see [`times_inside`]. The first is empty; then each
    /// segment once, alone; then those that occur.
    pub sets: Vec<u128>,
}

impl SurfaceField {
    /// Rest space from the voxels without the margin.
    pub fn rest_from_inner_voxel(&self) -> DAffine3 {
        self.rest_from_voxel * DAffine3::from_translation(DVec3::splat(FIELD_MARGIN.into()))
    }
}

/// How often a place is inside of a segment by its set: 0 to 3, two bits for each segment.
pub fn times_inside(set: u128, segment: usize) -> u8 {
    (set >> (2 * segment) & 3) as u8
}

/// The voxels of a field around a box, without the margin: their number and the length of their sides. Voxels are as
/// near to cubes as whole numbers of them allow.
pub(super) fn voxels_of(bounds: &Aabb) -> (UVec3, Vec3) {
    let size = bounds.size();
    let longest = size.max_element();
    let count = (size / longest * FIELD_VOXELS as f32)
        .ceil()
        .max(Vec3::ONE)
        .as_uvec3();
    let spacing = size / count.as_vec3();
    // A flat side has voxels all the same.
    let flat = longest / FIELD_VOXELS as f32;
    (
        count,
        Vec3::select(
            size.cmplt(Vec3::splat(1e-6 * longest)),
            Vec3::splat(flat),
            spacing,
        ),
    )
}

/// A field that is being made.
pub(super) struct FieldMaker<'a> {
    dims: UVec3,
    spacing: Vec3,
    /// Centre of the first voxel, rest space.
    origin: Vec3,
    triangles: &'a [Triangle],
    /// The nearest triangle known so far, and its distance.
    nearest: Vec<(u32, f32)>,
}

impl<'a> FieldMaker<'a> {
    /// Begins a field around a box for these triangles.
    pub(super) fn new(bounds: &Aabb, triangles: &'a [Triangle]) -> Self {
        let (count, spacing) = voxels_of(bounds);
        let dims = count + 2 * FIELD_MARGIN;
        let origin = bounds.center() - spacing * (dims - 1).as_vec3() * 0.5;
        Self {
            dims,
            spacing,
            origin,
            triangles,
            nearest: vec![(u32::MAX, f32::INFINITY); dims.element_product() as usize],
        }
    }

    fn index(&self, voxel: UVec3) -> usize {
        (voxel.x + self.dims.x * (voxel.y + self.dims.y * voxel.z)) as usize
    }

    fn center(&self, voxel: UVec3) -> Vec3 {
        self.origin + voxel.as_vec3() * self.spacing
    }

    fn offer(&mut self, voxel: UVec3, triangle: u32) {
        let place = self.center(voxel);
        let distance = self.triangles[triangle as usize]
            .nearest_point(place)
            .distance(place);
        let index = self.index(voxel);
        if distance < self.nearest[index].1 {
            self.nearest[index] = (triangle, distance);
        }
    }

    /// Exact distances near one triangle.
    pub(super) fn add(&mut self, triangle: u32) {
        let bounds = Aabb::from_points(self.triangles[triangle as usize].0);
        let last = (self.dims - 1).as_vec3();
        let low = ((bounds.min - self.origin) / self.spacing - BAND)
            .ceil()
            .clamp(Vec3::ZERO, last);
        let high = ((bounds.max - self.origin) / self.spacing + BAND)
            .floor()
            .clamp(Vec3::ZERO, last);
        let (low, high) = (low.as_uvec3(), high.as_uvec3());
        for z in low.z..=high.z {
            for y in low.y..=high.y {
                for x in low.x..=high.x {
                    self.offer(UVec3::new(x, y, z), triangle);
                }
            }
        }
    }

    /// Carries the nearest triangles away from the surface, along an axis and back: fast sweeping (Zhao 2005), with
    /// triangles in place of numbers.
    pub(super) fn sweep(&mut self, axis: usize) {
        let ends = self.dims.to_array();
        let mut across = ends;
        across[axis] = 1;
        let each_line = |mut visit: Box<dyn FnMut(UVec3) + '_>| {
            for z in 0..across[2] {
                for y in 0..across[1] {
                    for x in 0..across[0] {
                        visit(UVec3::new(x, y, z));
                    }
                }
            }
        };
        let mut lines = Vec::with_capacity((across[0] * across[1] * across[2]) as usize);
        each_line(Box::new(|start| lines.push(start)));
        for start in lines {
            let at = |i: u32| {
                let mut voxel = start.to_array();
                voxel[axis] = i;
                UVec3::from_array(voxel)
            };
            let steps = (1..ends[axis]).map(|i| (i - 1, i));
            let back = (1..ends[axis]).rev().map(|i| (i, i - 1));
            for (from, to) in steps.chain(back) {
                let (triangle, _) = self.nearest[self.index(at(from))];
                if triangle != u32::MAX && self.nearest[self.index(at(to))].0 != triangle {
                    self.offer(at(to), triangle);
                }
            }
        }
    }

    /// Finds what is inside and finishes. `segments` are asked in their order, `each` of them at voxels near a triangle
    /// and once in each region without one. `go_on` is told how far it is, 0 to 1; false stops it, and gives `None`.
    pub(super) fn finish(
        self,
        segments: &[Winding],
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Option<SurfaceField> {
        let count = self.nearest.len();
        let mut sets = vec![0_u128];
        sets.extend((0..segments.len()).map(|k| 1_u128 << (2 * k)));
        let mut fills = vec![u8::MAX; count];
        let far = 0.5 * self.spacing.max_element() * 1.001;
        let [width, height, depth] = self.dims.to_array();
        let mut waiting: Vec<usize> = Vec::new();
        for start in 0..count {
            if start % (width * height) as usize == 0 && !go_on(start as f32 / count as f32) {
                return None;
            }
            if fills[start] != u8::MAX {
                continue;
            }
            let voxel = UVec3::new(
                start as u32 % width,
                start as u32 / width % height,
                start as u32 / (width * height),
            );
            let set = set_at(segments, self.center(voxel), &mut sets);
            fills[start] = set;
            waiting.push(start);
            // Two neighbours that are both farther from all triangles than half their distance have none between them.
            while let Some(index) = waiting.pop() {
                if self.nearest[index].1 <= far {
                    continue;
                }
                let i = index as u32;
                let at = UVec3::new(i % width, i / width % height, i / (width * height));
                let mut offer = |is_there: bool, neighbour: usize| {
                    if is_there && fills[neighbour] == u8::MAX && self.nearest[neighbour].1 > far {
                        fills[neighbour] = set;
                        waiting.push(neighbour);
                    }
                };
                let (row, slice) = (width as usize, (width * height) as usize);
                offer(at.x > 0, index.wrapping_sub(1));
                offer(at.x + 1 < width, index + 1);
                offer(at.y > 0, index.wrapping_sub(row));
                offer(at.y + 1 < height, index + row);
                offer(at.z > 0, index.wrapping_sub(slice));
                offer(at.z + 1 < depth, index + slice);
            }
        }
        let band = BAND * self.spacing.min_element();
        let depths = self
            .nearest
            .iter()
            .zip(&fills)
            .map(|(&(_, distance), &fill)| {
                // Sweeps may miss the nearest triangle far away, where they find one that is little farther.
                let distance = if distance > band {
                    0.9 * distance
                } else {
                    distance
                };
                if fill == 0 { -distance } else { distance }
            });
        Some(SurfaceField {
            dims: self.dims,
            rest_from_voxel: DAffine3::from_translation(self.origin.as_dvec3())
                * DAffine3::from_scale(DVec3::from(self.spacing)),
            depths: depths.collect(),
            fills,
            sets,
        })
    }
}

/// The index of the set of segments that a place is inside of. A set that is met for the first time is added; where
/// there are too many, the place counts as inside of the first of its segments alone.
fn set_at(segments: &[Winding], place: Vec3, sets: &mut Vec<u128>) -> u8 {
    let mut set = 0_u128;
    for (k, segment) in segments.iter().enumerate() {
        if segment.bounds().contains(place) {
            let times = segment.at(place).abs().round().min(3.0) as u128;
            set |= times << (2 * k);
        }
    }
    if let Some(index) = sets.iter().position(|&known| known == set) {
        return index as u8;
    }
    if sets.len() < usize::from(u8::MAX) {
        sets.push(set);
        return (sets.len() - 1) as u8;
    }
    1 + (set.trailing_zeros() / 2) as u8
}
