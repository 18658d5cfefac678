//! A mesh prepared to be drawn, asked and kept.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};

use super::carver::Carver;
use super::field::{FIELD_MARGIN, FieldKind, FieldMaker, SurfaceField, times_inside, voxels_of};
use super::grid::DistanceGrid;
use super::lids::{MAX_TRIANGLES, lids_of};
use super::normals::corner_normals;
use super::textures::{SurfaceTextures, placed};
use super::tree::{Tree, in_order};
use super::triangle::Triangle;
use super::winding::Winding;
use crate::data::frame::SubjectFrame;
use crate::data::mesh::edges::{by_edge, sides};
use crate::data::mesh::pieces;
use crate::data::{Coloring, Grid, Mesh, MeshPart, NO_INDEX, Segment, Segmentation};
use crate::math::{Aabb, linear_from_srgb, srgb_from_linear};

/// Segments of one surface at most; the parts beyond them belong to the last one.
pub const MAX_SURFACE_SEGMENTS: usize = 64;

/// Marks the owner of a triangle that is part of a lid: what closes the hole of an open body.
pub(super) const LID: u8 = 128;

/// Colour where a file gives none, sRGB.
pub const PLAIN_SRGB: [u8; 3] = [0xd8, 0xcd, 0xbd];

/// How far vertices may lie beyond a box that a document gives, as a multiple of its longest side.
const MAX_BEYOND: f64 = 100.0;

/// Triangles of a piece that are asked for the winding number around them.
const SAMPLES_OF_PIECE: usize = 64;

/// A mesh in subject space, with all that drawing and asking it needs. Rests on the mesh alone: templates, camera and
/// look change nothing of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Where it lies and how fine the field is.
    pub frame: SubjectFrame,
    /// The triangles, rest space, in the order of the tree's leaves; fronts as spec/surfaces.md has them.
    pub triangles: Vec<Triangle>,
    /// Unit normals at the corners of each triangle.
    pub normals: Vec<[Vec3; 3]>,
    /// Colours at the corners of each triangle, sRGB.
    pub colors: Vec<[[u8; 3]; 3]>,
    /// Pictures on the triangles, which `colors` are multiplied by; `None` if there are none.
    pub textures: Option<SurfaceTextures>,
    /// The segment of each triangle, an index into `segments`; with 128 added if the triangle is part of a lid.
    pub owners: Vec<u8>,
    /// The tree over the triangles.
    pub tree: Tree,
    /// Distances and segments on a grid.
    pub field: SurfaceField,
    /// What the segments are, in their order.
    pub segments: Vec<SurfaceSegment>,
    /// The segments on the field's voxels, without its margin; overlaps have labels of their own.
    pub segmentation: Segmentation,
    /// What a template `carve` reads of it; `None` of a surface that no template carves by.
    pub carver: Option<Arc<Carver>>,
    /// Of the mesh of a tool its grid of distances; of a clay those of itself after the strokes (the numbers) that its
    /// tools are made of.
    pub grids: Vec<(u32, Arc<DistanceGrid>)>,
}

/// What a named part of the mesh is, apart from its triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceSegment {
    /// Its name, which no other segment has.
    pub name: String,
    /// True if every edge has as many triangles one way as the other.
    pub is_closed: bool,
    /// Mean colour by area, sRGB.
    pub mean_srgb: [u8; 3],
    /// Opacity of one crossing by the file, mean by area, 0 to 1.
    pub opacity: f32,
}

/// Why a mesh makes no surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceError {
    /// All its vertices lie at one place, or it has no triangle.
    NoSize,
    /// Vertices lie farther from the box that gives the unit than the picture reaches.
    FarFromBox,
    /// It was stopped.
    Stopped,
}

impl std::fmt::Display for SurfaceError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::NoSize => "the mesh has no size",
            Self::FarFromBox => "the mesh lies a hundred times the box's size away from `subject.box`, or is that large",
            Self::Stopped => "stopped",
        })
    }
}

impl std::error::Error for SurfaceError {}

impl Surface {
    /// Prepares a mesh alone. `smooth_degrees` is the crease angle; `None` takes the file's own normals. `go_on` is
    /// told how far it is, 0 to 1, and stops it by `false`.
    ///
    /// # Errors
    /// [`SurfaceError`].
    pub fn new(
        mesh: &Mesh,
        smooth_degrees: Option<f32>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Self, SurfaceError> {
        Self::of(&[(mesh, smooth_degrees)], None, go_on)
    }

    /// As [`Surface::new`], of several meshes, each with its crease angle; no two parts of theirs have one name.
    /// `within` takes the place of the box of all vertices: least and greatest coordinates, mm, RAS+. Its middle is the
    /// origin, and its longest side the unit.
    ///
    /// # Errors
    /// [`SurfaceError`].
    pub fn of(
        meshes: &[(&Mesh, Option<f32>)],
        within: Option<[DVec3; 2]>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Self, SurfaceError> {
        Self::with_field(meshes, within, FieldKind::Whole, go_on)
    }

    /// As [`Surface::of`], of meshes that are still being shaped: its field is half as fine along each side, and made
    /// in a tenth of the time. Triangles, normals and colours are the same.
    ///
    /// # Errors
    /// [`SurfaceError`].
    pub fn sketch_of(
        meshes: &[(&Mesh, Option<f32>)],
        within: Option<[DVec3; 2]>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Self, SurfaceError> {
        Self::with_field(meshes, within, FieldKind::Sketch, go_on)
    }

    fn with_field(
        meshes: &[(&Mesh, Option<f32>)],
        within: Option<[DVec3; 2]>,
        kind: FieldKind,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Self, SurfaceError> {
        let mesh = &joined(meshes);
        let (grid, subject_from_world) = grid_of(mesh, within, kind)?;
        let frame = frame_of(&grid, subject_from_world * grid.world_from_voxel);
        let mut triangles: Vec<Triangle> = mesh
            .triangles
            .iter()
            .map(|&triangle| {
                let place = |c: Vec3| subject_from_world.transform_point3(c.as_dvec3()).as_vec3();
                Triangle(mesh.corners_of(triangle).map(place))
            })
            .collect();
        let each = |&(mesh, smooth): &(&Mesh, Option<f32>)| corner_normals(mesh, smooth);
        let mut normals: Vec<_> = meshes.iter().flat_map(each).collect();
        let mut colors: Vec<_> = meshes.iter().flat_map(|(m, _)| corner_colors(m)).collect();
        let mut textures = SurfaceTextures::of(meshes);
        let (segments, mut owners) = segments_of(mesh, &colors, textures.as_ref(), &triangles);
        let mut stop_at = |part: f32| {
            if go_on(part) {
                Ok(())
            } else {
                Err(SurfaceError::Stopped)
            }
        };
        stop_at(0.1)?;
        let mut windings = windings_of(&triangles, &owners, segments.len());
        let turned = turn_outwards(
            mesh,
            &mut triangles,
            &mut normals,
            &mut colors,
            &owners,
            &windings,
        );
        for triangle in turned {
            textures
                .iter_mut()
                .for_each(|textures| textures.swap(triangle));
        }
        stop_at(0.2)?;
        let voxel = frame.detail;
        let (mut are_closed, mut left) = (true, MAX_TRIANGLES);
        for (k, segment) in segments.iter().enumerate().filter(|(_, s)| !s.is_closed) {
            let mut own = of_segment(&triangles, &owners, k);
            let lids = lids_of(&own, &windings[k], voxel, &mut left);
            are_closed &= lids.close_all;
            own.extend(&lids.triangles);
            windings[k] = Winding::new(&own);
            owners.extend(lids.triangles.iter().map(|_| LID | k as u8));
            colors.extend(lids.triangles.iter().map(|_| [segment.mean_srgb; 3]));
            for _ in &lids.triangles {
                textures.iter_mut().for_each(SurfaceTextures::push_plain);
            }
            triangles.extend(lids.triangles);
            normals.extend(lids.normals);
            stop_at(0.25)?;
        }

        let tree = Tree::new(&triangles);
        triangles = in_order(&tree.order, &triangles);
        normals = in_order(&tree.order, &normals);
        colors = in_order(&tree.order, &colors);
        owners = in_order(&tree.order, &owners);
        textures = textures.map(|textures| textures.in_order(&tree.order));
        stop_at(0.3)?;

        let mut maker = FieldMaker::new(&frame.bounds, &triangles, kind);
        for triangle in 0..triangles.len() as u32 {
            maker.add(triangle);
            if triangle % 4096 == 0 {
                stop_at(0.3 + 0.2 * triangle as f32 / triangles.len() as f32)?;
            }
        }
        for pass in 0..6 {
            maker.sweep(pass % 3);
            stop_at(0.5 + 0.05 * pass as f32)?;
        }
        let field = maker
            .finish(&windings, are_closed, &mut |part| go_on(0.8 + 0.2 * part))
            .ok_or(SurfaceError::Stopped)?;
        let segmentation = segmentation_of(grid, &field, &segments);
        Ok(Self {
            frame,
            triangles,
            normals,
            colors,
            textures,
            owners,
            tree,
            field,
            segments,
            segmentation,
            carver: None,
            grids: Vec::new(),
        })
    }

    /// The segment of a triangle: an index into `segments`.
    pub fn segment_of(&self, triangle: usize) -> usize {
        usize::from(self.owners[triangle] & !LID)
    }

    /// True if a triangle is not the file's: if it is part of a lid.
    pub fn is_lid(&self, triangle: usize) -> bool {
        self.owners[triangle] >= LID
    }

    /// Names the segment of a surface that has one.
    pub(in crate::data) fn name_only_segment(&mut self, name: &str) {
        for segment in &mut self.segments {
            segment.name = name.to_owned();
        }
        for segment in &mut self.segmentation.segments {
            segment.name = name.to_owned();
        }
    }

    /// The segments that a place of rest space is inside of, bit `k` for segment `k`: by the nearest voxel, and by the
    /// triangles on the way to its centre.
    pub fn inside_of(&self, place: Vec3) -> u64 {
        let field = &self.field;
        let voxel = field
            .rest_from_voxel
            .inverse()
            .transform_point3(place.as_dvec3());
        let last = field.dims.as_dvec3() - 1.0;
        if voxel.cmplt(DVec3::splat(-0.5)).any() || voxel.cmpgt(last + 0.5).any() {
            return 0;
        }
        let nearest = voxel.round().clamp(DVec3::ZERO, last);
        let center = field.rest_from_voxel.transform_point3(nearest).as_vec3();
        let v = nearest.as_uvec3();
        let index = v.x + field.dims.x * (v.y + field.dims.y * v.z);
        let set = field.sets[usize::from(field.fills[index as usize])];
        let mut times: [i32; MAX_SURFACE_SEGMENTS] =
            std::array::from_fn(|segment| i32::from(times_inside(set, segment)));
        // Who comes from the front of a triangle was outside of it, once less than behind it.
        self.tree
            .crossings(&self.triangles, place, center, |triangle, _, is_front| {
                times[self.segment_of(triangle)] += if is_front { -1 } else { 1 };
            });
        let inside = times.iter().zip(0..).filter(|(times, _)| **times > 0);
        inside.fold(0, |all, (_, k)| all | 1 << k)
    }

    /// The first segment that a place of rest space is inside of, an index into `segments`.
    pub fn segment_at(&self, place: Vec3) -> Option<usize> {
        let inside = self.inside_of(place);
        (inside != 0).then(|| inside.trailing_zeros() as usize)
    }

    /// Distance of a place of rest space to the triangles of a segment, lids left out, subject units; infinite if it
    /// has none.
    pub fn distance_to(&self, segment: usize, place: Vec3) -> f32 {
        let is_own = |triangle: usize| usize::from(self.owners[triangle]) == segment;
        self.tree
            .nearest(&self.triangles, place, f32::INFINITY, is_own)
            .map_or(f32::INFINITY, |nearest| nearest.distance)
    }

    /// Distance of a place of rest space to the nearest triangle, subject units, positive inside; of several segments
    /// the greatest (spec/surfaces.md, `depth`).
    pub fn depth_at(&self, place: Vec3) -> f32 {
        let inside = self.inside_of(place);
        if inside == 0 {
            let nearest = self
                .tree
                .nearest(&self.triangles, place, f32::INFINITY, |i| !self.is_lid(i));
            return nearest.map_or(f32::NEG_INFINITY, |nearest| -nearest.distance);
        }
        (0..self.segments.len())
            .filter(|k| inside >> k & 1 == 1)
            .map(|k| self.distance_to(k, place))
            .fold(0.0, f32::max)
    }
}

/// All triangles, parts and materials of several meshes. Normals, colours and textures at corners are left out.
fn joined(meshes: &[(&Mesh, Option<f32>)]) -> Mesh {
    let mut all = Mesh::default();
    for (mesh, _) in meshes {
        let (place, triangle) = (all.positions.len() as u32, all.triangles.len());
        let material = all.materials.len() as u32;
        all.positions.extend(&mesh.positions);
        let moved = mesh.triangles.iter();
        all.triangles
            .extend(moved.map(|corners| corners.map(|index| index + place)));
        all.parts.extend(mesh.parts.iter().map(|part| MeshPart {
            name: part.name.clone(),
            triangles: part.triangles.start + triangle..part.triangles.end + triangle,
        }));
        let material_of = |index: usize| match mesh.material_of.get(index) {
            None | Some(&NO_INDEX) => NO_INDEX,
            Some(own) => own + material,
        };
        all.material_of
            .extend((0..mesh.triangles.len()).map(material_of));
        all.materials.extend(&mesh.materials);
    }
    all
}

/// Where a surface lies and how fine it is, by its grid without margin and subject space from the grid's voxels.
pub(super) fn frame_of(grid: &Grid, subject_from_voxel: DAffine3) -> SubjectFrame {
    let corner = |voxel: DVec3| subject_from_voxel.transform_point3(voxel).as_vec3();
    let world_from_subject = grid.world_from_voxel * subject_from_voxel.inverse();
    let spacing = DVec3::from(
        subject_from_voxel
            .matrix3
            .to_cols_array_2d()
            .map(DVec3::from)
            .map(DVec3::length),
    );
    SubjectFrame {
        bounds: Aabb {
            min: corner(DVec3::splat(-0.5)),
            max: corner(grid.dims.as_dvec3() - 0.5),
        },
        mm_per_unit: world_from_subject.matrix3.x_axis.length(),
        middle_mm: world_from_subject.translation,
        detail: spacing.min_element() as f32,
    }
}

/// The grid of the field without its margin, and subject space from millimetres, by the box of the vertices or by
/// another one.
fn grid_of(
    mesh: &Mesh,
    within: Option<[DVec3; 2]>,
    kind: FieldKind,
) -> Result<(Grid, DAffine3), SurfaceError> {
    let used = mesh.triangles.iter().flatten();
    let places = used.map(|&index| mesh.positions[index as usize].as_dvec3());
    let (min, max) = places.fold(
        (DVec3::INFINITY, DVec3::NEG_INFINITY),
        |(min, max), place| (min.min(place), max.max(place)),
    );
    let longest = (max - min).max_element();
    if longest <= 0.0 || !longest.is_finite() {
        return Err(SurfaceError::NoSize);
    }
    let [low, high] = within.unwrap_or([min, max]);
    let unit_mm = (high - low).max_element();
    if (min - low).abs().max((max - high).abs()).max_element() > MAX_BEYOND * unit_mm {
        return Err(SurfaceError::FarFromBox);
    }
    let origin = (low + high) * 0.5;
    let half = ((max - min) * 0.5 / unit_mm).as_vec3();
    let bounds = Aabb {
        min: -half,
        max: half,
    };
    // Voxels are so small that the longest side of the vertices has as many of them in any unit.
    let (dims, spacing) = voxels_of(&bounds, kind);
    let spacing_mm = spacing.as_dvec3() * unit_mm;
    let first = (min + max) * 0.5 - spacing_mm * (dims - 1).as_dvec3() * 0.5;
    let grid = Grid {
        dims,
        world_from_voxel: DAffine3::from_translation(first) * DAffine3::from_scale(spacing_mm),
    };
    let subject_from_world =
        DAffine3::from_scale(DVec3::splat(1.0 / unit_mm)) * DAffine3::from_translation(-origin);
    Ok((grid, subject_from_world))
}

/// Colours of the corners by what the file gives (spec/surfaces.md, "The colour of a point").
fn corner_colors(mesh: &Mesh) -> Vec<[[u8; 3]; 3]> {
    let material_of = |triangle: usize| {
        let index = mesh.material_of.get(triangle).copied().unwrap_or(NO_INDEX);
        mesh.materials.get(index as usize)
    };
    let srgb = |linear: Vec3| {
        linear
            .to_array()
            .map(|value| srgb_from_linear(f64::from(value)))
    };
    let one = |triangle: usize, corner: usize| {
        let vertex = mesh
            .colors
            .as_ref()
            .and_then(|colors| colors.get(triangle, corner));
        let material = material_of(triangle)
            .filter(|m| m.has_color)
            .map(|m| m.color);
        let has_picture = placed(mesh, triangle).is_some();
        match (mesh.coloring, vertex, material) {
            // The colour that the picture is multiplied by.
            (Coloring::First, ..) | (_, None, None) if has_picture => [255; 3],
            (Coloring::Product, Some(vertex), Some(material)) => srgb(vertex * material),
            (_, Some(color), _) | (_, None, Some(color)) => srgb(color),
            (_, None, None) => PLAIN_SRGB,
        }
    };
    (0..mesh.triangles.len())
        .map(|triangle| std::array::from_fn(|corner| one(triangle, corner)))
        .collect()
}

/// The segments of a mesh, and the segment of each triangle.
fn segments_of(
    mesh: &Mesh,
    colors: &[[[u8; 3]; 3]],
    textures: Option<&SurfaceTextures>,
    triangles: &[Triangle],
) -> (Vec<SurfaceSegment>, Vec<u8>) {
    let mut segments = Vec::new();
    let mut segment_of = vec![0; mesh.triangles.len()];
    let count = mesh.parts.len().clamp(1, MAX_SURFACE_SEGMENTS);
    for k in 0..count {
        let end = if k + 1 == count {
            mesh.parts.len()
        } else {
            k + 1
        };
        let parts = mesh.parts.get(k..end).unwrap_or_default();
        let range = match parts {
            [first, .., last] => first.triangles.start..last.triangles.end,
            [one] => one.triangles.clone(),
            [] => 0..mesh.triangles.len(),
        };
        segment_of[range.clone()].fill(k as u8);
        let is_closed = by_edge(&sides(&mesh.triangles[range.clone()]))
            .all(|edge| 2 * edge.iter().filter(|side| side.is_forward).count() == edge.len());
        let (mut color, mut opacity, mut area) = (Vec3::ZERO, 0.0, 0.0_f32);
        for triangle in range {
            let share = triangles[triangle].area_normal().length();
            let [a, b, c] = colors[triangle].map(|srgb| Vec3::from(srgb.map(linear_from_srgb)));
            let index = mesh.material_of.get(triangle).copied().unwrap_or(NO_INDEX);
            let own = mesh
                .materials
                .get(index as usize)
                .map_or(1.0, |m| m.opacity);
            let mut mean = (a + b + c) / 3.0;
            if let Some(textures) = textures {
                mean *= textures.mean_over(triangle);
            }
            color += mean * share;
            opacity += own * share;
            area += share;
        }
        let mean = color / area.max(f32::MIN_POSITIVE);
        segments.push(SurfaceSegment {
            name: parts
                .first()
                .map_or("surface", |part| &part.name)
                .to_owned(),
            is_closed,
            mean_srgb: mean
                .to_array()
                .map(|value| srgb_from_linear(f64::from(value))),
            opacity: if area > 0.0 { opacity / area } else { 1.0 },
        });
    }
    (segments, segment_of)
}

fn of_segment(triangles: &[Triangle], owners: &[u8], segment: usize) -> Vec<Triangle> {
    let all = triangles.iter().zip(owners);
    let own = all.filter(|(_, owner)| usize::from(**owner) == segment);
    own.map(|(triangle, _)| *triangle).collect()
}

fn windings_of(triangles: &[Triangle], owners: &[u8], count: usize) -> Vec<Winding> {
    (0..count)
        .map(|k| Winding::new(&of_segment(triangles, owners, k)))
        .collect()
}

/// Turns pieces over that are inside out: those around which the winding number, mean of both sides and by area, is
/// below -¼. Returns their triangles.
fn turn_outwards(
    mesh: &Mesh,
    triangles: &mut [Triangle],
    normals: &mut [[Vec3; 3]],
    colors: &mut [[[u8; 3]; 3]],
    owners: &[u8],
    windings: &[Winding],
) -> Vec<usize> {
    let mut turned = Vec::new();
    let (piece_of, count) = pieces(mesh.positions.len(), &mesh.triangles);
    let mut of_piece = vec![Vec::new(); count];
    for (triangle, &piece) in piece_of.iter().enumerate() {
        of_piece[piece as usize].push(triangle);
    }
    for piece in of_piece {
        let stride = piece.len().div_ceil(SAMPLES_OF_PIECE).max(1);
        let (mut sum, mut area) = (0.0, 0.0);
        for &triangle in piece.iter().step_by(stride) {
            let Triangle([a, b, c]) = triangles[triangle];
            let share = f64::from(triangles[triangle].area_normal().length());
            let winding = &windings[usize::from(owners[triangle])];
            sum += share * winding.at((a + b + c) / 3.0);
            area += share;
        }
        if sum < -0.25 * area {
            for &triangle in &piece {
                triangles[triangle].0.swap(1, 2);
                normals[triangle].swap(1, 2);
                normals[triangle] = normals[triangle].map(|normal| -normal);
                colors[triangle].swap(1, 2);
            }
            turned.extend(piece);
        }
    }
    turned
}

/// The segments on the field's voxels, without its margin.
pub(super) fn segmentation_of(
    grid: Grid,
    field: &SurfaceField,
    segments: &[SurfaceSegment],
) -> Segmentation {
    let (dims, wide) = (grid.dims, field.dims);
    let mut labels = Vec::with_capacity(grid.voxel_count());
    for z in 0..dims.z {
        for y in 0..dims.y {
            let row = FIELD_MARGIN + wide.x * (y + FIELD_MARGIN + wide.y * (z + FIELD_MARGIN));
            labels.extend(&field.fills[row as usize..(row + dims.x) as usize]);
        }
    }
    let named = field
        .sets
        .iter()
        .zip(0_u16..)
        .skip(1)
        .flat_map(|(&set, label)| {
            let held = segments
                .iter()
                .enumerate()
                .filter(move |(k, _)| times_inside(set, *k) > 0);
            held.map(move |(_, segment)| Segment {
                label,
                name: segment.name.clone(),
                color_srgb: Some(segment.mean_srgb),
            })
        });
    Segmentation {
        grid,
        labels,
        segments: named.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::MeshPart;
    use crate::data::mesh::testing::cube;
    use crate::data::surface::testing::Random;

    fn surface(mesh: &Mesh) -> Surface {
        Surface::new(mesh, None, &mut |_| true).expect("it has a size")
    }

    fn part(name: &str, triangles: std::ops::Range<usize>) -> MeshPart {
        MeshPart {
            name: name.to_owned(),
            triangles,
        }
    }

    /// A ball of radius 50 mm about a place, `n` steps from pole to pole.
    fn ball(at: Vec3, n: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for i in 0..=n {
            let up = i as f32 / n as f32 * std::f32::consts::PI;
            for j in 0..2 * n {
                let round = j as f32 / n as f32 * std::f32::consts::PI;
                let (x, y) = (up.sin() * round.cos(), up.sin() * round.sin());
                positions.push(at + 50.0 * Vec3::new(x, y, -up.cos()));
            }
        }
        for i in 0..n {
            for j in 0..2 * n {
                let at = |i: u32, j: u32| i * 2 * n + j % (2 * n);
                let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                if i > 0 {
                    triangles.push([a, b, d]);
                }
                if i + 1 < n {
                    triangles.push([b, c, d]);
                }
            }
        }
        // Poles are one vertex each.
        for triangle in &mut triangles {
            for index in triangle {
                if *index < 2 * n {
                    *index = 0;
                } else if *index >= n * 2 * n {
                    *index = n * 2 * n;
                }
            }
        }
        triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        (positions, triangles)
    }

    #[test]
    fn a_cube_knows_its_inside_and_its_depth() {
        let (positions, triangles) = cube();
        let inside_out = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        for triangles in [triangles, inside_out] {
            let mesh = Mesh {
                positions: positions.clone(),
                triangles,
                parts: vec![part("cube", 0..12)],
                ..Mesh::default()
            };
            let cube = surface(&mesh);
            assert!(cube.segments[0].is_closed);
            let mut random = Random(4);
            for _ in 0..500 {
                let place = random.place() * 0.6;
                let out = place.abs() - 0.5;
                let exact = out.max(Vec3::ZERO).length() + out.max_element().min(0.0);
                assert!((cube.depth_at(place) + exact).abs() < 1e-5, "{place}");
            }
            // Fronts are outside, however the file had them.
            for (triangle, normals) in cube.triangles.iter().zip(&cube.normals) {
                let middle = triangle.0.iter().sum::<Vec3>() / 3.0;
                assert!(triangle.area_normal().dot(middle) > 0.0);
                assert!(normals[0].dot(middle) > 0.0);
            }
        }
    }

    #[test]
    fn overlapping_parts_are_told_apart() {
        let (mut positions, mut triangles) = ball(Vec3::ZERO, 12);
        let first = triangles.len();
        let (more, others) = ball(Vec3::new(40.0, 0.0, 0.0), 12);
        let offset = positions.len() as u32;
        triangles.extend(others.iter().map(|t| t.map(|i| i + offset)));
        positions.extend(more);
        let mesh = Mesh {
            parts: vec![
                part("left", 0..first),
                part("right", first..triangles.len()),
            ],
            positions,
            triangles,
            ..Mesh::default()
        };
        let balls = surface(&mesh);
        let mm = balls.frame.mm_per_unit as f32;
        let middle = balls.frame.middle_mm.as_vec3();
        let at = |x: f32, y: f32| balls.segment_at((Vec3::new(x, y, 0.1) - middle) / mm);
        assert_eq!(at(-45.0, 0.0), Some(0));
        assert_eq!(at(20.0, 0.0), Some(0), "both: the first decides");
        assert_eq!(at(85.0, 0.0), Some(1));
        assert_eq!(at(20.0, 60.0), None);
        let names: Vec<_> = (balls.segmentation.segments.iter())
            .map(|s| (s.label, s.name.as_str()))
            .collect();
        assert_eq!(
            names,
            [(1, "left"), (2, "right"), (3, "left"), (3, "right")]
        );
        let site = balls.segmentation.site_of("right").expect("it is there");
        assert!(
            (site.centroid.x - (40.0 - middle.x) / mm).abs() < 0.01,
            "{site:?}"
        );
    }

    #[test]
    fn the_field_is_never_farther_than_the_triangles() {
        let (positions, triangles) = ball(Vec3::new(5.0, 6.0, 7.0), 20);
        let mesh = Mesh {
            parts: vec![part("ball", 0..triangles.len())],
            positions,
            triangles,
            ..Mesh::default()
        };
        let all = &mut |_| true;
        let whole = surface(&mesh);
        let sketch = Surface::sketch_of(&[(&mesh, None)], None, all).expect("it has a size");
        assert_eq!(sketch.triangles, whole.triangles);
        assert_eq!(sketch.normals, whole.normals);
        assert!(sketch.field.depths.len() * 7 < whole.field.depths.len());
        for (ball, every) in [(&whole, 97), (&sketch, 13)] {
            is_never_farther(ball, every);
        }
    }

    /// Asks a ball of half a unit's radius at every so many voxels.
    fn is_never_farther(ball: &Surface, every: usize) {
        let field = &ball.field;
        let mut index = 0;
        for z in 0..field.dims.z {
            for y in 0..field.dims.y {
                for x in 0..field.dims.x {
                    if index % every == 0 {
                        let voxel = DVec3::new(x.into(), y.into(), z.into());
                        let place = field.rest_from_voxel.transform_point3(voxel).as_vec3();
                        let exact = ball
                            .tree
                            .nearest(&ball.triangles, place, 9.0, |_| true)
                            .expect("one")
                            .distance;
                        let own = field.depths[index];
                        assert!(own.abs() <= exact + 1e-6 && own.abs() >= 0.89 * exact);
                        let away = place.length();
                        assert!(own > 0.0 || away > 0.496, "{place}");
                        assert!(own < 0.0 || away < 0.5, "{place}");
                    }
                    index += 1;
                }
            }
        }
    }

    #[test]
    fn an_open_body_is_full_up_to_its_lid() {
        // Half a ball, open at the top, where a flat lid closes it.
        let n = 24;
        let (positions, triangles) = ball(Vec3::ZERO, n);
        let is_low = |triangle: &[u32; 3]| {
            let height = |&index: &u32| positions[index as usize].z;
            triangle.iter().all(|index| height(index) < 0.1)
        };
        let triangles: Vec<_> = triangles.into_iter().filter(is_low).collect();
        let mesh = Mesh {
            parts: vec![part("bowl", 0..triangles.len())],
            positions,
            triangles,
            ..Mesh::default()
        };
        let bowl = surface(&mesh);
        assert!(!bowl.segments[0].is_closed);
        let mm = bowl.frame.mm_per_unit as f32;
        let middle = bowl.frame.middle_mm.as_vec3();
        let (mut filled, mut random) = (0, Random(9));
        for _ in 0..2000 {
            let place = random.place() * 60.0;
            // Chords of 24 steps lie half a millimetre under the ball.
            let far = place.length() - 50.0;
            if (-0.6..0.1).contains(&far) || place.z.abs() < 0.1 {
                continue;
            }
            let is_filled = far < 0.0 && place.z < 0.0;
            filled += u32::from(is_filled);
            let found = bowl.segment_at((place - middle) / mm);
            assert_eq!(found.is_some(), is_filled, "{place}");
        }
        assert!(filled > 200, "{filled}");
    }

    #[test]
    fn a_mesh_without_size_is_refused_and_a_flat_one_is_not() {
        let flat = |scale: f32| Mesh {
            positions: [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * scale).to_vec(),
            triangles: vec![[0, 1, 2]],
            parts: vec![part("flat", 0..1)],
            ..Mesh::default()
        };
        let no_size = Surface::new(&flat(0.0), None, &mut |_| true);
        assert_eq!(no_size, Err(SurfaceError::NoSize));
        assert_eq!(
            Surface::new(&Mesh::default(), None, &mut |_| true),
            Err(SurfaceError::NoSize)
        );
        let sheet = surface(&flat(3.0));
        assert!(!sheet.segments[0].is_closed);
        assert_eq!(sheet.segment_at(Vec3::ZERO), None);
        assert!((sheet.depth_at(Vec3::new(-0.25, -0.25, 0.1)) + 0.1).abs() < 1e-6);
    }

    #[test]
    fn preparing_can_be_stopped() {
        let (positions, triangles) = ball(Vec3::ZERO, 6);
        let mesh = Mesh {
            positions,
            triangles,
            ..Mesh::default()
        };
        let mut told = Vec::new();
        let stopped = Surface::new(&mesh, None, &mut |part| {
            told.push(part);
            part < 0.5
        });
        assert_eq!(stopped, Err(SurfaceError::Stopped));
        assert!(told.is_sorted(), "{told:?}");
    }
}
