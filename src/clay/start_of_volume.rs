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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::check::Check;
    use crate::clay::shaping::Shaped;
    use crate::clay::suite::{ball, place, stroke};
    use crate::data::Voxels;
    use crate::document::{ClayStart, VoxelSource};
    use glam::{DAffine3, UVec3};
    use std::f64::consts::PI;

    /// A volume with these labels in voxels of 1 mm, and no values.
    fn labelled(n: u32, label: impl Fn(DVec3) -> u8) -> Volume {
        let segments = [(1, "lump"), (2, "other")];
        let middle = 0.5 * f64::from(n - 1);
        let about = |voxel: UVec3| label(voxel.as_dvec3() - middle);
        let segmentation = Segmentation::cube(n, 1.0, about, &segments);
        Volume {
            grid: segmentation.grid,
            voxels: Voxels::U8(Vec::new()),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 0.0],
            segmentation: Some(segmentation),
            has_size: true,
        }
    }

    fn clay_of(part: VoxelPart, has_all_walls: bool, detail: f64) -> Clay {
        Clay {
            from: ClayStart::Volume(Box::new(ClayVolume {
                of: VoxelSource::Builtin {
                    name: "head".to_owned(),
                    revision: 1,
                },
                part,
                has_all_walls,
            })),
            detail,
            ..Clay::default()
        }
    }

    fn lump(detail: f64) -> Clay {
        clay_of(VoxelPart::Segment("lump".to_owned()), false, detail)
    }

    fn begin(clay: &Clay, volume: &Volume) -> Result<Shaping, ClayError> {
        let meant = clay.volume().unwrap();
        Shaping::of_volume(clay, meant, volume, &mut |_| true)
    }

    /// A start that is closed and two-manifold.
    fn begun(clay: &Clay, volume: &Volume) -> (Shaping, Shaped, Check) {
        let start = begin(clay, volume).unwrap();
        let shaped = start.shaped();
        let found = Check::of(&shaped.positions, &shaped.triangles, None);
        assert!(found.is_two_manifold(), "{}", found.lines());
        assert_eq!(found.border_edges, 0, "{}", found.lines());
        (start, shaped, found)
    }

    fn volume_mm(shaped: &Shaped, found: &Check) -> f64 {
        found.volume.unwrap() * shaped.space.mm_per_unit.powi(3)
    }

    #[test]
    fn a_ball_of_voxels_is_a_ball() {
        let volume = labelled(40, |at| u8::from(at.length() < 15.0));
        let labels = &volume.segmentation.as_ref().unwrap().labels;
        let count = labels.iter().filter(|label| **label == 1).count() as f64;
        for detail in [0.03, 0.1] {
            let (start, shaped, found) = begun(&lump(detail), &volume);
            assert_eq!((found.euler, found.pieces, found.crossing), (2, 1, 0));
            let volume_mm = volume_mm(&shaped, &found);
            // By σ²/r of σ² = 1.5 voxels the filter makes it smaller.
            let voxel = if detail < 0.05 { 1.0 } else { 2.0 };
            let smaller = 1.0 - 3.0 * 1.5 * (voxel / 15.0_f64).powi(2);
            let off = volume_mm / (count * smaller);
            assert!((off - 1.0).abs() < 0.04, "{volume_mm} of {count}, {off}");
            let middle = shaped.space.middle_mm;
            assert!(middle.distance(DVec3::splat(19.5)) < 0.05, "{middle}");
            assert!((shaped.space.mm_per_unit - 30.0).abs() < 1.0);
            for (pos, normal) in shaped.positions.iter().zip(&shaped.normals) {
                let out = pos.normalize_or_zero().dot(*normal);
                assert!(out > 0.9, "{normal} at {pos}");
            }
            assert_eq!(start.notices(), [""; 0]);
            let again = begin(&lump(detail), &volume).unwrap().shaped();
            assert_eq!(shaped, again, "bit for bit");
        }
        let finer = begun(&lump(0.03), &volume).2.triangles;
        let coarser = begun(&lump(0.1), &volume).2.triangles;
        assert!(finer > 2 * coarser, "{finer} and {coarser}");
    }

    #[test]
    fn strokes_shape_it_as_any_other_clay() {
        let volume = labelled(30, |at| u8::from(at.length() < 10.0));
        let mut clay = lump(0.06);
        clay.tools = vec![ball(0.1, 0.1)];
        clay.strokes = vec![stroke(&[[0, 0, 440], [0, 0, 640]].map(place))];
        let mut start = begin(&clay, &volume).unwrap();
        start.stroke(&clay, &mut |_| true).unwrap();
        assert!(start.left_out().is_empty());
        let shaped = start.shaped();
        let found = Check::of(&shaped.positions, &shaped.triangles, None);
        assert!(found.is_two_manifold(), "{}", found.lines());
        assert_eq!((found.euler, found.border_edges), (2, 0));
        let top = shaped.positions.iter().map(|pos| pos.z);
        assert!(top.reduce(f32::max).unwrap() > 0.6, "it is pulled");
    }

    #[test]
    fn of_several_pieces_the_largest_is_taken_and_hollows_are_filled() {
        let two = |at: DVec3| {
            let [large, small] = [DVec3::X * -9.0, DVec3::X * 11.0];
            u8::from(at.distance(large) < 9.0 || at.distance(small) < 6.0)
        };
        let volume = labelled(44, two);
        let (start, shaped, found) = begun(&lump(0.05), &volume);
        assert_eq!((found.euler, found.pieces), (2, 1));
        assert!(
            shaped.space.middle_mm.x < 16.0,
            "{}",
            shaped.space.middle_mm
        );
        let said = start.notices();
        assert!(said.len() == 1 && said[0].ends_with(": 1"), "{said:?}");
        let all = clay_of(VoxelPart::Segment("lump".to_owned()), true, 0.05);
        let (start, _, found) = begun(&all, &volume);
        assert_eq!((found.euler, found.pieces), (4, 2));
        assert_eq!(start.notices(), [""; 0]);

        let shell = |at: DVec3| u8::from((9.0..16.0).contains(&at.length()));
        let volume = labelled(40, shell);
        let (_, filled, of_filled) = begun(&lump(0.05), &volume);
        assert_eq!((of_filled.euler, of_filled.pieces), (2, 1));
        let (_, hollow, of_hollow) = begun(&all, &volume);
        assert_eq!((of_hollow.euler, of_hollow.pieces), (4, 2));
        let taken = volume_mm(&filled, &of_filled) - volume_mm(&hollow, &of_hollow);
        let wanted = 4.0 / 3.0 * PI * 9.0_f64.powi(3);
        assert!((taken / wanted - 1.0).abs() < 0.1, "{taken} for {wanted}");
    }

    #[test]
    fn what_reaches_the_border_is_closed_there() {
        let volume = labelled(12, |_| 1);
        let (_, shaped, found) = begun(&lump(0.1), &volume);
        assert_eq!((found.euler, found.pieces), (2, 1));
        assert!((shaped.space.mm_per_unit - 12.0).abs() < 0.05);
        // Of values too, of which half the grid has enough.
        let mut volume = labelled(12, |_| 0);
        let values = (0..12 * 12 * 12).map(|i| i % 12 * 10);
        volume.voxels = Voxels::I16(values.collect());
        volume.slope = 2.0;
        volume.intercept = -100.0;
        let of = |iso| clay_of(VoxelPart::Iso(iso), false, 0.1);
        let (_, shaped, found) = begun(&of(0.0), &volume);
        assert_eq!((found.euler, found.pieces), (2, 1));
        let least = shaped.positions_mm().into_iter().map(|pos| pos.x);
        let least = least.reduce(f32::min).unwrap();
        assert!((least - 5.0).abs() < 0.02, "where the value is: {least}");
        assert!((shaped.space.mm_per_unit - 12.0).abs() < 0.05);
    }

    #[test]
    fn an_isosurface_lies_where_its_value_lies() {
        let mut volume = labelled(40, |_| 0);
        let at = |i: u32| UVec3::new(i % 40, i / 40 % 40, i / 1600).as_dvec3() - 19.5;
        let values = (0..40 * 40 * 40).map(|i| (1000.0 - 40.0 * at(i).length()).round() as i16);
        volume.voxels = Voxels::I16(values.collect());
        volume.value_range = [-400.0, 965.0];
        let of = |iso| clay_of(VoxelPart::Iso(iso), false, 0.05);
        let (_, shaped, found) = begun(&of(600.0), &volume);
        assert_eq!((found.euler, found.pieces), (2, 1));
        for pos in shaped.positions_mm() {
            let radius = pos.as_dvec3().distance(DVec3::splat(19.5));
            assert!((radius - 10.0).abs() < 0.2, "{radius}");
        }
        // No such surface: refused in a line.
        for iso in [1e9, -1e9, f64::MAX, 966.0, -2000.0] {
            let error = begin(&of(iso), &volume).unwrap_err().to_string();
            assert!(error.contains("between -400 and 965"), "{error}");
            assert!(!error.contains('\n'), "{error}");
        }
        let mut holes = volume.clone();
        let no_number = |i: u32| if at(i).x > 2.0 { f32::NAN } else { 1.0 };
        holes.voxels = Voxels::F32((0..40 * 40 * 40).map(no_number).collect());
        let (_, _, found) = begun(&of(0.5), &holes);
        assert_eq!(
            (found.euler, found.pieces),
            (2, 1),
            "what is no number is outside"
        );
    }

    #[test]
    fn oblique_mirrored_and_uneven_grids_keep_their_millimetres() {
        let mut volume = labelled(40, |_| 0);
        let middle = DVec3::new(3.0, -20.0, 100.0);
        // Thin slices along x, mirrored in y, turned about z.
        let world_from_voxel = DAffine3::from_translation(middle)
            * DAffine3::from_rotation_z(0.3)
            * DAffine3::from_scale(DVec3::new(0.5, -1.0, 1.0))
            * DAffine3::from_translation(DVec3::splat(-19.5));
        let segmentation = volume.segmentation.as_mut().unwrap();
        segmentation.grid.world_from_voxel = world_from_voxel;
        for (i, label) in segmentation.labels.iter_mut().enumerate() {
            let voxel = UVec3::new(i as u32 % 40, i as u32 / 40 % 40, i as u32 / 1600);
            let at = world_from_voxel.transform_point3(voxel.as_dvec3());
            *label = u8::from(at.distance(middle) < 8.0);
        }
        let (_, shaped, found) = begun(&lump(0.1), &volume);
        assert_eq!((found.euler, found.pieces), (2, 1));
        let found = volume_mm(&shaped, &found) / (4.0 / 3.0 * PI * 512.0);
        assert!(
            found > 0.85 && found < 1.02,
            "its outside is outside: {found}"
        );
        assert!(shaped.space.middle_mm.distance(middle) < 0.1);
    }

    #[test]
    fn what_is_not_there_is_named() {
        let volume = labelled(20, |at| u8::from(at == DVec3::splat(0.5)));
        let of = |name: &str| clay_of(VoxelPart::Segment(name.to_owned()), false, 0.05);
        let said = |clay: &Clay| begin(clay, &volume).unwrap_err().to_string();
        for (name, part) in [
            ("skull", "no segment \"skull\" (there are lump, other)"),
            ("other", "no voxel is of the segment \"other\""),
            ("lump", "\"lump\" is too thin for a clay of detail 0.05"),
        ] {
            let line = said(&of(name));
            assert!(line.contains(part), "{line}");
        }
        let mut bare = volume.clone();
        bare.segmentation = None;
        let error = begin(&of("lump"), &bare).unwrap_err().to_string();
        assert!(error.contains("it has none"), "{error}");
        let long = said(&of(&"x".repeat(1000)));
        assert!(long.len() < 200, "{long}");
        // Where segments overlap, the overlap is of both.
        let mut volume = labelled(30, |at| match at.length() < 9.0 {
            true => 1 + u8::from(at.x > 0.0),
            false => 0,
        });
        let segmentation = volume.segmentation.as_mut().unwrap();
        let mut both = segmentation.segments[0].clone();
        both.label = 2;
        segmentation.segments.push(both);
        let (_, shaped, _) = begun(&of("lump"), &volume);
        assert!(
            (shaped.space.mm_per_unit - 18.0).abs() < 1.0,
            "all of the ball"
        );
        // It is stopped where it is asked to stop.
        for most in [0.0, 0.4, 0.7] {
            let clay = of("lump");
            let meant = clay.volume().unwrap();
            let stopped = Shaping::of_volume(&clay, meant, &volume, &mut |part| part < most);
            assert_eq!(stopped.unwrap_err(), ClayError::Stopped);
        }
    }
}
