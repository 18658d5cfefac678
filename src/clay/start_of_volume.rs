//! What a clay is before its first stroke where it begins with a segment or an isosurface of a volume
//! (spec/sweepers.md, B, “From a volume”). Nothing here depends on what a device can hold: the full grid is averaged to
//! voxels as fine as the clay's detail asks for, so that the mesh is the same everywhere.

use std::ops::Range;

use glam::{DVec3, USizeVec3, Vec3};

use super::error::{ClayError, MAX_FILE_TRIANGLES, MAX_START_TRIANGLES};
use super::march::{Cells, Field, Walls};
use super::mesh::{ClayMesh, Vertex};
use super::shaping::Shaping;
use super::space::Space;
use super::start_of_file::give_normals;
use super::walls::keep_largest;
use crate::data::{Grid, Segmentation, Volume};
use crate::document::{Clay, ClayVolume, VoxelPart};

/// How often the share of a segment is smoothed along each axis.
const PASSES: u32 = 3;
/// The share of a voxel that the segment fills.
const FULL: u64 = 1 << 12;
/// As much when it is smoothed: [1 2 1] is not divided by 4, so that the numbers stay whole.
const SMOOTHED: i64 = (FULL as i64) << (2 * 3 * PASSES);
/// Layers of free voxels around what is meant: as far as the share is smoothed, and one that is empty.
const MARGIN: usize = PASSES as usize + 1;
/// Names of segments that a message lists.
const MOST_NAMES: usize = 40;

/// Parts of the work that are done when the voxels are averaged, when there are triangles, and when short edges are
/// gone.
const AVERAGED: f32 = 0.3;
const MARCHED: f32 = 0.5;
const COLLAPSED: f32 = 0.8;

impl Shaping {
    /// The clay of a segment or an isosurface before its first stroke; `meant` is the part of the volume that its
    /// document names. Takes seconds for a large volume. `go_on` hears how far it is, 0 to 1, and stops it by `false`.
    ///
    /// # Errors
    /// [`ClayError`], where there is no such part, where it has too many triangles, or it was stopped.
    pub fn of_volume(
        clay: &Clay,
        meant: &ClayVolume,
        volume: &Volume,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Self, ClayError> {
        let meant_voxels = Meant::of(&meant.part, volume)?;
        let blocks = Blocks::around(&meant_voxels, clay.detail)?;
        let mut shares = meant_voxels.shares(&blocks, &mut |part| go_on(AVERAGED * part))?;
        let gone = match meant.has_all_walls {
            true => 0,
            false => keep_largest(&mut shares.is_inside, blocks.dims),
        };
        let field = Field {
            dims: blocks.dims,
            values: &shares.values,
            is_inside: &shares.is_inside,
        };
        let cells = Cells::new();
        let found = field.count(&cells);
        if found == 0 {
            return Err(meant_voxels.too_thin(clay.detail));
        }
        if found > MAX_FILE_TRIANGLES {
            return Err(ClayError::ManyWalls(found));
        }
        let marched = field.walls(&cells, &mut |part| {
            go_on(AVERAGED + (MARCHED - AVERAGED) * part)
        });
        let walls = marched.ok_or(ClayError::Stopped)?;
        drop(shares);
        let nothing = || ClayError::NoSurface("the clay's volume has no surface".to_owned());
        let (mesh, space) = blocks.mesh(walls).ok_or_else(nothing)?;
        let mut shaping = Self::of(mesh, space, clay.detail);
        shaping.collapse_all(clay.detail);
        if !go_on(COLLAPSED) {
            return Err(ClayError::Stopped);
        }
        shaping.reduce(found, &mut |part| {
            go_on(COLLAPSED + (1.0 - COLLAPSED) * part)
        })?;
        // Without the free places of what is gone.
        let (vertices, triangles, _) = shaping.mesh.compact();
        let left = triangles.len();
        let surface = ClayMesh::new(vertices, triangles).ok_or_else(nothing)?;
        let mut start = Self::of(surface, space, clay.detail);
        start.start_notices = notices(gone, found, left);
        Ok(start)
    }
}

/// Voxels of a volume, and which of them are meant.
enum Meant<'a> {
    Labels {
        name: &'a str,
        segmentation: &'a Segmentation,
        has: Box<[bool; 256]>,
    },
    Values {
        iso: f64,
        volume: &'a Volume,
    },
}

impl<'a> Meant<'a> {
    fn of(part: &'a VoxelPart, volume: &'a Volume) -> Result<Self, ClayError> {
        let name = match part {
            VoxelPart::Iso(iso) => return Ok(Self::Values { iso: *iso, volume }),
            VoxelPart::Segment(name) => name,
        };
        let segmentation = volume.segmentation.as_ref();
        let segments = segmentation.map_or(&[][..], |all| &all.segments);
        // Where segments overlap, one name has several labels.
        let mut has = Box::new([false; 256]);
        for segment in segments.iter().filter(|segment| segment.name == *name) {
            if let Some(has) = has.get_mut(usize::from(segment.label)) {
                *has = true;
            }
        }
        match segmentation.filter(|_| has.contains(&true)) {
            Some(segmentation) => Ok(Self::Labels {
                name,
                segmentation,
                has,
            }),
            None => {
                let names: Vec<&str> = segments.iter().map(|s| s.name.as_str()).collect();
                let known = match names.len() {
                    0 => "it has none".to_owned(),
                    n if n > MOST_NAMES => format!("it has {n} others"),
                    _ => format!("there are {}", names.join(", ")),
                };
                // A hostile name is not repeated at length.
                let name = name.chars().take(MOST_NAMES).collect();
                Err(ClayError::NoSegment { name, known })
            }
        }
    }

    fn grid(&self) -> &'a Grid {
        match self {
            Self::Labels { segmentation, .. } => &segmentation.grid,
            Self::Values { volume, .. } => &volume.grid,
        }
    }

    /// The value of a voxel; `None` for what is no number.
    fn value(volume: &Volume, index: usize) -> Option<f64> {
        let stored = f64::from(volume.voxels.get(index)?);
        let value = stored * f64::from(volume.slope) + f64::from(volume.intercept);
        value.is_finite().then_some(value)
    }

    fn has(&self, index: usize) -> bool {
        match self {
            Self::Labels {
                segmentation, has, ..
            } => {
                let label = segmentation.labels.get(index);
                label.is_some_and(|label| has[usize::from(*label)])
            }
            Self::Values { iso, volume } => {
                Self::value(volume, index).is_some_and(|value| value >= *iso)
            }
        }
    }

    /// What is meant, for who finds that it is not there.
    fn nothing(&self) -> ClayError {
        ClayError::NoSurface(match self {
            Self::Labels { name, .. } => format!("no voxel is of the segment \"{name}\""),
            Self::Values { iso, volume } => {
                let [least, greatest] = volume.value_range;
                format!(
                    "nowhere do values pass {iso}, from which the clay is meant to begin: they lie between {least} and {greatest}"
                )
            }
        })
    }

    /// Averaged, nothing of it is left.
    fn too_thin(&self, detail: f64) -> ClayError {
        let what = match self {
            Self::Labels { name, .. } => format!("the segment \"{name}\""),
            Self::Values { iso, .. } => format!("what has a value from {iso} on"),
        };
        ClayError::NoSurface(format!(
            "{what} is too thin for a clay of detail {detail}: a smaller detail may hold it"
        ))
    }

    /// The values whose surface is the start, on the grid of the blocks.
    fn shares(
        &self,
        blocks: &Blocks,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Shares, ClayError> {
        match self {
            Self::Labels { .. } => {
                let whole = blocks.factor.element_product() as u64;
                let mut shares = blocks.each(go_on, |voxels| {
                    let count = voxels.filter(|index| self.has(*index)).count();
                    // No more than FULL.
                    (count as u64 * FULL / whole) as u32
                })?;
                for axis in 0..3 {
                    let stride: usize = blocks.dims.to_array()[..axis].iter().product();
                    for _ in 0..PASSES {
                        smooth(&mut shares, blocks.dims[axis], stride);
                    }
                }
                // Of twice the numbers, whose half is odd so: none lies on the surface.
                let over = |share: u32| 2 * i64::from(share) - SMOOTHED + 1;
                let is_inside = shares.iter().map(|share| over(*share) > 0).collect();
                let values = shares.into_iter().map(|share| over(share) as f32);
                Ok(Shares {
                    values: values.collect(),
                    is_inside,
                })
            }
            Self::Values { iso, volume } => {
                let over = blocks.each(go_on, |voxels| {
                    let (mut sum, mut count) = (0.0, 0_u32);
                    for value in voxels.filter_map(|index| Self::value(volume, index)) {
                        sum += value;
                        count += 1;
                    }
                    match count {
                        0 => f64::NEG_INFINITY,
                        _ => sum / f64::from(count) - iso,
                    }
                })?;
                let is_inside = over.iter().map(|over| *over >= 0.0).collect();
                Ok(Shares {
                    values: over.into_iter().map(|over| over as f32).collect(),
                    is_inside,
                })
            }
        }
    }
}

/// As those of a [`Field`].
struct Shares {
    values: Vec<f32>,
    is_inside: Vec<bool>,
}

/// The whole blocks of voxels about what is meant, each of which becomes one voxel.
struct Blocks {
    grid: Grid,
    /// Voxels of the grid in a block, along each axis.
    factor: USizeVec3,
    /// The first block among those of the grid, which begin at its first voxel.
    first: DVec3,
    /// Blocks along each axis.
    dims: USizeVec3,
    /// For each axis the voxels of each block that lie in the grid.
    ranges: [Vec<Range<usize>>; 3],
}

impl Blocks {
    /// Those about the voxels that are meant, none smaller than half the detail; the longest side of the box of these
    /// voxels is the unit.
    fn around(meant: &Meant<'_>, detail: f64) -> Result<Self, ClayError> {
        let grid = *meant.grid();
        let dims = grid.dims.as_usizevec3();
        let (mut least, mut most) = (dims, USizeVec3::ZERO);
        let (mut index, mut count) = (0, 0);
        for z in 0..dims.z {
            for y in 0..dims.y {
                for x in 0..dims.x {
                    if meant.has(index) {
                        let at = USizeVec3::new(x, y, z);
                        (least, most) = (least.min(at), most.max(at));
                        count += 1;
                    }
                    index += 1;
                }
            }
        }
        let is_all = count == index && matches!(meant, Meant::Values { .. });
        if count == 0 || is_all {
            return Err(meant.nothing());
        }
        let spacing = grid.spacing_mm();
        let unit = ((most - least + 1).as_dvec3() * spacing).max_element();
        let wanted = (spacing.recip() * (0.5 * detail * unit)).ceil();
        // A number that is none becomes 0.
        let factor = wanted.as_usizevec3().clamp(USizeVec3::ONE, dims);
        let (low, high) = (least / factor, most / factor);
        let ranges = [0, 1, 2].map(|axis| {
            let [low, high, factor, dim] = [low, high, factor, dims].map(|v| v[axis]);
            let block = |k: usize| {
                // Blocks before the grid have no voxels.
                let begin = (low + k).checked_sub(MARGIN).map(|block| block * factor);
                begin.map_or(0..0, |begin| begin.min(dim)..(begin + factor).min(dim))
            };
            (0..high - low + 1 + 2 * MARGIN).map(block).collect()
        });
        Ok(Self {
            grid,
            factor,
            first: low.as_dvec3() - DVec3::splat(MARGIN as f64),
            dims: high - low + 1 + 2 * MARGIN,
            ranges,
        })
    }

    /// What is made of the voxels of each block, x fastest.
    fn each<T>(
        &self,
        go_on: &mut dyn FnMut(f32) -> bool,
        make: impl Fn(&mut dyn Iterator<Item = usize>) -> T,
    ) -> Result<Vec<T>, ClayError> {
        let [nx, ny] = [self.grid.dims.x as usize, self.grid.dims.y as usize];
        let mut made = Vec::with_capacity(self.dims.element_product());
        for (layer, z) in self.ranges[2].iter().enumerate() {
            for y in &self.ranges[1] {
                for x in &self.ranges[0] {
                    let rows = z
                        .clone()
                        .flat_map(|z| y.clone().map(move |y| nx * (y + ny * z)));
                    let mut voxels = rows.flat_map(|row| row + x.start..row + x.end);
                    made.push(make(&mut voxels));
                }
            }
            if !go_on((layer + 1) as f32 / self.dims.z as f32) {
                return Err(ClayError::Stopped);
            }
        }
        Ok(made)
    }

    /// Walls in the space of the clay that they are, with the mean normals of their triangles.
    fn mesh(&self, walls: Walls) -> Option<(ClayMesh, Space)> {
        let factor = self.factor.as_dvec3();
        let to_mm = |place: &DVec3| {
            let voxel = (place + self.first + 0.5) * factor - 0.5;
            self.grid.world_from_voxel.transform_point3(voxel).as_vec3()
        };
        let positions: Vec<Vec3> = walls.places.iter().map(to_mm).collect();
        let space = Space::around(&positions)?;
        let mut triangles = walls.triangles;
        if self.grid.world_from_voxel.matrix3.determinant() < 0.0 {
            triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
        let vertices = positions.iter().map(|pos| Vertex {
            pos: space.from_mm(*pos),
            normal: Vec3::Z,
        });
        let mut mesh = ClayMesh::new(vertices.collect(), triangles)?;
        give_normals(&mut mesh);
        Some((mesh, space))
    }
}

/// Sums neighbours along an axis by [1 2 1], nothing beyond the ends. `stride`: from one value along the axis to the
/// next, `count` values.
fn smooth(values: &mut [u32], count: usize, stride: usize) {
    let mut before = vec![0; stride];
    for lines in values.chunks_exact_mut(count * stride) {
        before.fill(0);
        for i in 0..count {
            let (row, rest) = lines[i * stride..].split_at_mut(stride);
            for (k, value) in row.iter_mut().enumerate() {
                let own = *value;
                *value = before[k] + 2 * own + rest.get(k).copied().unwrap_or(0);
                before[k] = own;
            }
        }
    }
}

/// What was done to the voxels' surface, in words.
fn notices(gone: usize, found: usize, left: usize) -> Vec<String> {
    let mut lines = Vec::new();
    if gone > 0 {
        lines.push(format!(
            "the clay is the outer wall of the largest piece; smaller pieces that are left out: {gone}"
        ));
    }
    if found > MAX_START_TRIANGLES {
        lines.push(format!(
            "the volume's {found} triangles were reduced to {left}: a clay begins with at most {MAX_START_TRIANGLES}"
        ));
    }
    lines
}
