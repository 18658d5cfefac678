//! Bricks: blocks of voxels, with the range of values and the labels in each.

use crate::data::Segmentation;
use glam::UVec3;
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
    use glam::{DAffine3, DMat3};

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
}
