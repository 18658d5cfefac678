//! Bricks: blocks of voxels, with the range of values and the labels in each.

use crate::data::Segmentation;
use crate::math::Aabb;
use glam::{DAffine3, DVec3, UVec3};
use half::f16;

/// Voxels along a side of a brick.
pub const BRICK: u32 = 8;

/// Smallest and largest value of each block of 8³ voxels, a border of one voxel included (interpolation reaches so
/// far), normalised as in the texture. Tells without the GPU where something may be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Bricks {
    /// Bricks along each axis.
    pub dims: UVec3,
    /// Smallest and largest, x fastest.
    pub ranges: Vec<[f32; 2]>,
}

/// Bricks of a volume, and as many around them as the meshes beside it reach into.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WideBricks {
    /// Bricks along each axis.
    pub dims: UVec3,
    /// Bricks before the volume's first, along each axis.
    pub before: UVec3,
    /// Which hold something of a mesh, x fastest.
    pub has_mesh: Vec<bool>,
}

/// Wide bricks at most; meshes that reach farther out count as being everywhere.
const MOST_WIDE: u64 = 1 << 21;

impl WideBricks {
    /// Around the bricks of a volume, `brick_from_rest`, with meshes in these boxes of rest space. `None` where they
    /// reach too far.
    pub(crate) fn new(
        bricks: UVec3,
        brick_from_rest: &DAffine3,
        boxes: impl Iterator<Item = Aabb>,
    ) -> Option<Self> {
        let spans: Vec<[DVec3; 2]> = boxes.map(|held| span_of(brick_from_rest, held)).collect();
        let all = [DVec3::ZERO, bricks.as_dvec3()];
        let [low, high] =
            (spans.iter()).fold(all, |[low, high], [a, b]| [low.min(*a), high.max(*b)]);
        let before = -low.floor();
        let dims = high.ceil() + before;
        if dims.element_product() > MOST_WIDE as f64 {
            return None;
        }
        let (dims, before) = (dims.as_uvec3(), before.as_uvec3());
        let mut has_mesh = vec![false; dims.as_u64vec3().element_product() as usize];
        for [low, high] in spans {
            let low = (low.floor() + before.as_dvec3()).as_uvec3();
            let high = (high.ceil() + before.as_dvec3()).as_uvec3().min(dims);
            for z in low.z..high.z {
                for y in low.y..high.y {
                    let row = (dims.x * (y + dims.y * z)) as usize;
                    has_mesh[row + low.x as usize..row + high.x as usize].fill(true);
                }
            }
        }
        Some(Self {
            dims,
            before,
            has_mesh,
        })
    }

    /// The brick of the volume that one of these is, by their indices; `None` around the volume.
    pub(crate) fn of_volume(&self, index: usize, bricks: UVec3) -> Option<usize> {
        let i = index as u32;
        let at = UVec3::new(
            i % self.dims.x,
            i / self.dims.x % self.dims.y,
            i / (self.dims.x * self.dims.y),
        );
        let is_in = at.cmpge(self.before).all() && at.cmplt(self.before + bricks).all();
        let own = at.wrapping_sub(self.before);
        is_in.then(|| (own.x + bricks.x * (own.y + bricks.y * own.z)) as usize)
    }
}

/// The box of a box in another space.
fn span_of(map: &DAffine3, held: Aabb) -> [DVec3; 2] {
    let (middle, half) = (
        (held.min + held.max).as_dvec3() * 0.5,
        held.size().as_dvec3() * 0.5,
    );
    let at = map.transform_point3(middle);
    let m = map.matrix3;
    let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
    [at - reach, at + reach]
}

/// Labels by brick: bit `n` for label `n`.
pub(crate) type LabelSet = [u32; 8];

/// Which labels lie in each brick of a grid of `dims` voxels; the labels have to lie on it too.
pub(crate) fn labels_in_bricks(labels: &Segmentation, brick: u32) -> Vec<LabelSet> {
    let dims = labels.grid.dims.as_usizevec3();
    let brick = brick as usize;
    let count = [dims.x, dims.y, dims.z].map(|n| n.div_ceil(brick));
    let mut sets = vec![[0; 8]; count.iter().product()];
    for (row, voxels) in labels.labels.chunks_exact(dims.x.max(1)).enumerate() {
        let first = ((row / dims.y / brick) * count[1] + row % dims.y / brick) * count[0];
        for (part, set) in voxels.chunks(brick).zip(sets.iter_mut().skip(first)) {
            for &label in part {
                set[usize::from(label >> 5)] |= 1 << (label & 31);
            }
        }
    }
    sets
}

/// Bricks of a volume that comes slice by slice.
#[derive(Debug)]
pub(crate) struct BrickBuilder {
    voxels: UVec3,
    pub bricks: Bricks,
    slice: Vec<[f32; 2]>,
    row: Vec<[f32; 2]>,
}

const NOTHING: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

fn join(into: &mut [f32; 2], other: [f32; 2]) {
    into[0] = into[0].min(other[0]);
    into[1] = into[1].max(other[1]);
}

/// Bricks that a coordinate belongs to: its own, and the neighbour that it borders on.
fn owners(coordinate: u32, count: u32) -> impl Iterator<Item = u32> {
    let own = coordinate / BRICK;
    let below = (coordinate.is_multiple_of(BRICK) && own > 0).then(|| own - 1);
    let above = (coordinate % BRICK == BRICK - 1 && own + 1 < count).then_some(own + 1);
    [Some(own), below, above].into_iter().flatten()
}

impl BrickBuilder {
    pub(crate) fn new(voxels: UVec3) -> Self {
        let dims = UVec3::new(
            voxels.x.div_ceil(BRICK),
            voxels.y.div_ceil(BRICK),
            voxels.z.div_ceil(BRICK),
        );
        let count = dims.as_u64vec3().element_product() as usize;
        Self {
            voxels,
            bricks: Bricks {
                dims,
                ranges: vec![NOTHING; count],
            },
            slice: vec![NOTHING; (dims.x * dims.y) as usize],
            row: vec![NOTHING; dims.x as usize],
        }
    }

    /// Takes the next slice, half floats from 0 to 1.
    pub(crate) fn add_slice(&mut self, z: u32, texels: &[u16]) {
        let dims = self.bricks.dims;
        self.slice.fill(NOTHING);
        for (y, row) in texels.chunks_exact(self.voxels.x as usize).enumerate() {
            for (brick, range) in self.row.iter_mut().enumerate() {
                let start = (brick * BRICK as usize).saturating_sub(1);
                let end = ((brick + 1) * BRICK as usize + 1).min(row.len());
                // Half floats from 0 to 1 sort as their bits do.
                let (mut low, mut high) = (u16::MAX, 0);
                for &bits in row.get(start..end).unwrap_or_default() {
                    low = low.min(bits);
                    high = high.max(bits);
                }
                *range = [f16::from_bits(low).to_f32(), f16::from_bits(high).to_f32()];
            }
            for by in owners(y as u32, dims.y) {
                let start = (by * dims.x) as usize;
                for (into, &range) in self.slice.iter_mut().skip(start).zip(&self.row) {
                    join(into, range);
                }
            }
        }
        for bz in owners(z, dims.z) {
            let start = (bz * dims.x * dims.y) as usize;
            for (into, &range) in self.bricks.ranges.iter_mut().skip(start).zip(&self.slice) {
                join(into, range);
            }
        }
    }
}

/// A whole grid's bricks at once (tests).
#[cfg(test)]
fn bricks_of(grid: &crate::data::Grid, texels: &[u16]) -> Bricks {
    let mut builder = BrickBuilder::new(grid.dims);
    let slice = (grid.dims.x * grid.dims.y) as usize;
    for (z, part) in texels.chunks_exact(slice).enumerate() {
        builder.add_slice(z as u32, part);
    }
    builder.bricks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Grid;
    use glam::{DMat3, Vec3};

    #[test]
    fn bricks_hold_their_border() {
        let dims = UVec3::new(19, 17, 10);
        let grid = Grid {
            dims,
            world_from_voxel: DAffine3::from_mat3(DMat3::IDENTITY),
        };
        let texel = |x: u32, y: u32, z: u32| ((x * 7 + y * 31 + z * 101) % 257) as f32 / 256.0;
        let mut texels = Vec::new();
        for z in 0..dims.z {
            for y in 0..dims.y {
                for x in 0..dims.x {
                    texels.push(f16::from_f32(texel(x, y, z)).to_bits());
                }
            }
        }
        let bricks = bricks_of(&grid, &texels);
        assert_eq!(bricks.dims, UVec3::new(3, 3, 2));
        for (i, range) in bricks.ranges.iter().enumerate() {
            let i = i as u32;
            let brick = UVec3::new(i % 3, (i / 3) % 3, i / 9);
            let mut expected = NOTHING;
            let start = (brick * BRICK).saturating_sub(UVec3::ONE);
            let end = (brick * BRICK + BRICK + 1).min(dims);
            for z in start.z..end.z {
                for y in start.y..end.y {
                    for x in start.x..end.x {
                        let v = f16::from_f32(texel(x, y, z)).to_f32();
                        join(&mut expected, [v, v]);
                    }
                }
            }
            assert_eq!(*range, expected, "brick {brick}");
        }
    }

    #[test]
    fn bricks_know_their_labels() {
        let dims = UVec3::new(10, 9, 3);
        let mut labels = vec![0; 270];
        labels[9 + 10 * 8 + 90] = 200;
        labels[0] = 3;
        let volume = Segmentation {
            grid: Grid {
                dims,
                world_from_voxel: DAffine3::IDENTITY,
            },
            labels,
            segments: Vec::new(),
        };
        let sets = labels_in_bricks(&volume, 8);
        assert_eq!(sets.len(), 4, "two by two by one bricks");
        assert_eq!(sets[0][0], 0b1001, "air and label 3");
        assert_eq!(sets[3][6], 1 << (200 - 192), "in the last brick");
        assert_eq!(sets[1][6] | sets[2][6], 0, "and in no other");
    }

    #[test]
    fn wide_bricks_reach_as_far_as_meshes() {
        let bricks = UVec3::new(4, 3, 2);
        let held = |min: Vec3, max: Vec3| Aabb { min, max };
        let boxes = [
            held(Vec3::new(-1.5, 0.2, 0.2), Vec3::new(-0.5, 0.4, 0.4)),
            held(Vec3::new(3.2, 2.2, 2.5), Vec3::new(3.4, 2.4, 2.6)),
        ];
        let wide = WideBricks::new(bricks, &DAffine3::IDENTITY, boxes.into_iter()).expect("small");
        assert_eq!(
            (wide.dims, wide.before),
            (UVec3::new(6, 3, 3), UVec3::new(2, 0, 0))
        );
        let at = |x: usize, y: usize, z: usize| x + 6 * (y + 3 * z);
        let has: Vec<usize> = (0..54).filter(|&i| wide.has_mesh[i]).collect();
        assert_eq!(has, [at(0, 0, 0), at(1, 0, 0), at(5, 2, 2)]);
        assert_eq!(wide.of_volume(at(2, 0, 0), bricks), Some(0));
        assert_eq!(wide.of_volume(at(5, 2, 1), bricks), Some(23));
        assert_eq!(wide.of_volume(at(1, 0, 0), bricks), None);
        assert_eq!(wide.of_volume(at(5, 2, 2), bricks), None);
        let far = [held(Vec3::splat(-300.0), Vec3::ZERO)];
        assert_eq!(
            WideBricks::new(bricks, &DAffine3::IDENTITY, far.into_iter()),
            None
        );
    }
}
