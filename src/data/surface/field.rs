//! The field of a surface: signed distances and segments on a grid of voxels. A map to the triangles, never the truth.

use glam::{DAffine3, DVec3, UVec3, Vec3};

use super::triangle::Triangle;
use super::winding::Winding;
use crate::math::Aabb;

/// Voxels along the longest side of the surface's box.
pub const FIELD_VOXELS: u32 = 128;

/// As many in the field of a sketch: of a surface that is shown while it is still being shaped.
const SKETCH_VOXELS: u32 = 64;

/// Voxels of the field around the box, on each side.
pub const FIELD_MARGIN: u32 = 2;

/// How far from triangles the distances are exact, voxels; in a sketch half as far.
const BAND: f32 = 2.0;

/// Side of the blocks in which open surfaces are filled, voxels.
const BLOCK: u32 = 16;

/// So far the winding numbers at a block's corners have to be from the ½ that decides.
const LEAST_MARGIN: f64 = 0.15;

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

/// How much work a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FieldKind {
    /// As pictures are drawn by.
    Whole,
    /// Half as fine along each side, for a surface that is still being shaped: a tenth of the work.
    Sketch,
}

impl FieldKind {
    /// Voxels along the longest side of the surface's box.
    fn voxels(self) -> u32 {
        match self {
            Self::Whole => FIELD_VOXELS,
            Self::Sketch => SKETCH_VOXELS,
        }
    }

    /// How far from triangles the distances are exact, voxels.
    fn band(self) -> f32 {
        match self {
            Self::Whole => BAND,
            Self::Sketch => 0.5 * BAND,
        }
    }
}

/// The voxels of a field around a box, without the margin: their number and the length of their sides. Voxels are as
/// near to cubes as whole numbers of them allow.
pub(super) fn voxels_of(bounds: &Aabb, kind: FieldKind) -> (UVec3, Vec3) {
    let size = bounds.size();
    let longest = size.max_element();
    let count = (size / longest * kind.voxels() as f32)
        .ceil()
        .max(Vec3::ONE)
        .as_uvec3();
    let spacing = size / count.as_vec3();
    // A flat side has voxels all the same.
    let flat = longest / kind.voxels() as f32;
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
    /// How far from triangles the distances are exact, voxels.
    band: f32,
    dims: UVec3,
    spacing: Vec3,
    /// Centre of the first voxel, rest space.
    origin: Vec3,
    triangles: &'a [Triangle],
    /// The nearest triangle known so far, and its distance.
    nearest: Vec<(u32, f32)>,
    /// The run in which each voxel got its triangle, 0 for those near it.
    changed_in: Vec<u8>,
    /// The number of the run that is done now, or was done last.
    run: u8,
    /// The number of the last run along each axis, forth and back; 0: there was none.
    last_run: [[u8; 2]; 3],
}

impl<'a> FieldMaker<'a> {
    /// Begins a field around a box for these triangles.
    pub(super) fn new(bounds: &Aabb, triangles: &'a [Triangle], kind: FieldKind) -> Self {
        let (count, spacing) = voxels_of(bounds, kind);
        let dims = count + 2 * FIELD_MARGIN;
        let origin = bounds.center() - spacing * (dims - 1).as_vec3() * 0.5;
        Self {
            band: kind.band(),
            dims,
            spacing,
            origin,
            triangles,
            nearest: vec![(u32::MAX, f32::INFINITY); dims.element_product() as usize],
            changed_in: vec![0; dims.element_product() as usize],
            run: 0,
            last_run: [[0; 2]; 3],
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
            self.changed_in[index] = self.run;
        }
    }

    /// Exact distances near one triangle.
    pub(super) fn add(&mut self, triangle: u32) {
        let bounds = Aabb::from_points(self.triangles[triangle as usize].0);
        let last = (self.dims - 1).as_vec3();
        let low = ((bounds.min - self.origin) / self.spacing - self.band)
            .ceil()
            .clamp(Vec3::ZERO, last);
        let high = ((bounds.max - self.origin) / self.spacing + self.band)
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
        for is_back in [false, true] {
            self.carry(axis, is_back);
        }
    }

    /// One run along an axis. Lines along the axis have nothing to do with each other; they go side by side, as they
    /// lie in memory. What a voxel had in the run before along the same way was not nearer then, and is not now.
    fn carry(&mut self, axis: usize, is_back: bool) {
        self.run += 1;
        let sides = self.dims.to_array().map(|side| side as usize);
        let (stride, along) = (sides[..axis].iter().product::<usize>(), sides[axis]);
        let before = std::mem::replace(&mut self.last_run[axis][usize::from(is_back)], self.run);
        for first in (0..self.nearest.len()).step_by(stride * along) {
            for i in 1..along {
                let (from, to) = match is_back {
                    false => (i - 1, i),
                    true => (along - i, along - i - 1),
                };
                let [from, to] = [from, to].map(|i| first + i * stride);
                for line in 0..stride {
                    let (triangle, _) = self.nearest[from + line];
                    let is_new = before == 0 || self.changed_in[from + line] > before;
                    if is_new && triangle != u32::MAX && self.nearest[to + line].0 != triangle {
                        self.offer(self.voxel(to + line), triangle);
                    }
                }
            }
        }
    }

    /// Finds what is inside and finishes. `segments` are asked in their order, each of them at voxels near a triangle;
    /// elsewhere once in each region without one if all are closed, else in blocks of voxels. `go_on` is told how far
    /// it is, 0 to 1; false stops it, and gives `None`.
    pub(super) fn finish(
        self,
        segments: &[Winding],
        are_closed: bool,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Option<SurfaceField> {
        let mut sets = Sets {
            segments,
            known: vec![0_u128],
        };
        let alone = (0..segments.len()).map(|k| 1_u128 << (2 * k));
        sets.known.extend(alone);
        let fills = if are_closed {
            self.flooded(&mut sets, go_on)
        } else {
            self.in_blocks(&mut sets, go_on)
        }?;
        let band = self.band * self.spacing.min_element();
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
            sets: sets.known,
        })
    }

    /// The farthest that a triangle between two neighbours may be from the nearer one.
    fn near(&self) -> f32 {
        0.5 * self.spacing.max_element() * 1.001
    }

    fn voxel(&self, index: usize) -> UVec3 {
        let i = index as u32;
        let [width, height, _] = self.dims.to_array();
        UVec3::new(i % width, i / width % height, i / (width * height))
    }

    /// The set of each voxel, by regions without a triangle: all of one is inside of the same closed segments.
    fn flooded(&self, sets: &mut Sets<'_>, go_on: &mut dyn FnMut(f32) -> bool) -> Option<Vec<u8>> {
        let count = self.nearest.len();
        let mut fills = vec![u8::MAX; count];
        let near = self.near();
        let [width, height, depth] = self.dims.to_array();
        let (row, slice) = (width as usize, (width * height) as usize);
        let mut waiting: Vec<usize> = Vec::new();
        for start in 0..count {
            if start % slice == 0 && !go_on(start as f32 / count as f32) {
                return None;
            }
            if fills[start] != u8::MAX {
                continue;
            }
            let set = sets.index_at(self.center(self.voxel(start)));
            fills[start] = set;
            waiting.push(start);
            // Two neighbours that are both farther from all triangles than half their distance have none between them.
            while let Some(index) = waiting.pop() {
                if self.nearest[index].1 <= near {
                    continue;
                }
                let at = self.voxel(index);
                let mut offer = |is_there: bool, neighbour: usize| {
                    if is_there && fills[neighbour] == u8::MAX && self.nearest[neighbour].1 > near {
                        fills[neighbour] = set;
                        waiting.push(neighbour);
                    }
                };
                offer(at.x > 0, index.wrapping_sub(1));
                offer(at.x + 1 < width, index + 1);
                offer(at.y > 0, index.wrapping_sub(row));
                offer(at.y + 1 < height, index + row);
                offer(at.z > 0, index.wrapping_sub(slice));
                offer(at.z + 1 < depth, index + slice);
            }
        }
        Some(fills)
    }

    /// The set of each voxel by blocks: through a hole the winding number changes without a triangle, but evenly.
    fn in_blocks(
        &self,
        sets: &mut Sets<'_>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Option<Vec<u8>> {
        let mut fills = vec![0; self.nearest.len()];
        for z in (0..self.dims.z).step_by(BLOCK as usize) {
            if !go_on(z as f32 / self.dims.z as f32) {
                return None;
            }
            for y in (0..self.dims.y).step_by(BLOCK as usize) {
                for x in (0..self.dims.x).step_by(BLOCK as usize) {
                    self.fill_block(UVec3::new(x, y, z), BLOCK, sets, &mut fills);
                }
            }
        }
        Some(fills)
    }

    /// Fills a block of voxels: at once where no triangle is in it and the winding numbers at its corners agree, else
    /// by its eighths.
    fn fill_block(&self, low: UVec3, side: u32, sets: &mut Sets<'_>, fills: &mut [u8]) {
        if low.cmpge(self.dims).any() {
            return;
        }
        let high = (low + side).min(self.dims);
        if side == 1 {
            fills[self.index(low)] = sets.index_at(self.center(low));
            return;
        }
        let near = self.near();
        let indices = (low.z..high.z).flat_map(|z| {
            (low.y..high.y)
                .flat_map(move |y| (low.x..high.x).map(move |x| self.index(UVec3::new(x, y, z))))
        });
        if indices.clone().all(|index| self.nearest[index].1 > near)
            && let Some(set) = self.set_of_block(low, high - 1, sets)
        {
            indices.for_each(|index| fills[index] = set);
            return;
        }
        let half = side / 2;
        for corner in 0..8 {
            let offset = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2) * half;
            self.fill_block(low + offset, half, sets, fills);
        }
    }

    /// The set of all voxels from `low` to `last`, if those at the corners have one, none of them by little.
    fn set_of_block(&self, low: UVec3, last: UVec3, sets: &mut Sets<'_>) -> Option<u8> {
        let mut common = None;
        for corner in 0..8_u32 {
            let is_last = |axis: u32| corner >> axis & 1 == 1;
            let voxel = UVec3::select(
                glam::BVec3::new(is_last(0), is_last(1), is_last(2)),
                last,
                low,
            );
            let (set, margin) = set_at(sets.segments, self.center(voxel));
            if margin < LEAST_MARGIN || common.is_some_and(|known| known != set) {
                return None;
            }
            common = Some(set);
        }
        common.map(|set| sets.index_of(set))
    }
}

/// The sets of segments that occur.
struct Sets<'a> {
    segments: &'a [Winding],
    known: Vec<u128>,
}

impl Sets<'_> {
    /// The index of the set of segments that a place is inside of.
    fn index_at(&mut self, place: Vec3) -> u8 {
        self.index_of(set_at(self.segments, place).0)
    }

    /// The index of a set. One that is met for the first time is added; where there are too many, its first segment
    /// stands for it.
    fn index_of(&mut self, set: u128) -> u8 {
        if let Some(index) = self.known.iter().position(|&known| known == set) {
            return index as u8;
        }
        if self.known.len() < usize::from(u8::MAX) {
            self.known.push(set);
            return (self.known.len() - 1) as u8;
        }
        1 + (set.trailing_zeros() / 2) as u8
    }
}

/// How often a place is inside of each segment: a set. And how far the winding numbers are from those at which it
/// changes.
fn set_at(segments: &[Winding], place: Vec3) -> (u128, f64) {
    let (mut set, mut margin) = (0_u128, 0.5_f64);
    for (k, segment) in segments.iter().enumerate() {
        if segment.bounds().contains(place) {
            let winding = segment.at(place).abs();
            let times = winding.round().min(3.0);
            margin = margin.min(0.5 - (winding - times).abs());
            set |= (times as u128) << (2 * k);
        }
    }
    (set, margin)
}
