//! Meshes on the GPU: their field, their segments on the field's voxels, and tree and triangles in one texture.

use super::bricks::{BRICK, Bricks, LabelSet, labels_in_bricks};
use super::held_view::HeldView;
use super::textures::{
    Bound, MESH_ROW, MeshTextures, SubjectTextures, VoxelFrame, label_texture, mesh_texture,
    next_stamp,
};
use crate::data::{Surface, SurfaceField, long_axes, stroke_patterns};
use crate::math::Aabb;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::programs::SubjectShader;
use crate::render::device::textures::{volume_texture, write_rows, write_slices};
use crate::render::pack::gpu_types::Subject;
use crate::render::pack::triangles::{MeshTexels, texels_of, texels_of_textures, triangles_at};
use crate::render::pack::values::SubjectInfo;
use glam::{DAffine3, UVec3};
use half::f16;
use std::ops::Range;
use std::sync::Arc;

/// Slices of the field that are handed over at once: a few milliseconds' work.
const SLICES_AT_ONCE: u32 = 8;

/// A mesh on its way to the GPU, piece by piece.
#[derive(Debug)]
pub(crate) struct MeshUpload {
    surface: Arc<Surface>,
    depth_texture: wgpu::Texture,
    label_texture: wgpu::Texture,
    mesh_texture: wgpu::Texture,
    next_slice: u32,
    seen_bricks: Vec<bool>,
    label_bricks: Option<Vec<LabelSet>>,
    texels: MeshTexels,
    /// Texels that make no whole row yet.
    row: Vec<[u32; 4]>,
    next_row: u32,
}

impl MeshUpload {
    /// Makes the textures.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] with the number of triangles, if the device does not take them.
    pub(crate) fn new(gpu: &Gpu, surface: &Arc<Surface>) -> Result<Self, RenderError> {
        let limits = gpu.device.limits();
        let rows = texel_count(surface).div_ceil(MESH_ROW as usize);
        if rows > limits.max_texture_dimension_2d as usize
            || limits.max_texture_dimension_2d < MESH_ROW
        {
            return Err(RenderError::TooLarge(format!(
                "{} triangles do not fit on this device",
                surface.triangles.len()
            )));
        }
        let depth_texture = volume_texture(
            gpu,
            "depths",
            surface.field.dims,
            wgpu::TextureFormat::R16Float,
            wgpu::TextureUsages::COPY_DST,
        );
        let bricks = bricks_of(&surface.field).element_product() as usize;
        Ok(Self {
            surface: Arc::clone(surface),
            depth_texture,
            label_texture: label_texture(gpu, surface.segmentation.grid.dims),
            mesh_texture: mesh_texture(gpu, [MESH_ROW, rows as u32]),
            next_slice: 0,
            seen_bricks: vec![false; bricks],
            label_bricks: None,
            texels: MeshTexels::of(surface, true, true),
            row: Vec::new(),
            next_row: 0,
        })
    }

    /// Fraction done, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        let slices = self.next_slice as f32 / self.surface.field.dims.z.max(1) as f32;
        0.3 * slices + 0.7 * self.texels.progress()
    }

    /// Converts and hands over the next piece. True when all is handed over.
    pub(crate) fn advance(&mut self, gpu: &Gpu) -> bool {
        let surface = &*self.surface;
        let field = &surface.field;
        if self.next_slice < field.dims.z {
            let slices = SLICES_AT_ONCE.min(field.dims.z - self.next_slice);
            let slice = (field.dims.x * field.dims.y) as usize;
            let start = self.next_slice as usize * slice;
            let depths: Vec<u16> = field.depths[start..start + slices as usize * slice]
                .iter()
                .map(|&depth| f16::from_f32(depth).to_bits())
                .collect();
            let bytes = bytemuck::cast_slice(&depths);
            write_slices(gpu, &self.depth_texture, self.next_slice, slices, 2, bytes);
            see_bricks(
                field,
                self.next_slice..self.next_slice + slices,
                &mut self.seen_bricks,
            );
            self.next_slice += slices;
            return false;
        }
        let segmentation = &surface.segmentation;
        if self.label_bricks.is_none() {
            let slices = segmentation.grid.dims.z;
            write_slices(gpu, &self.label_texture, 0, slices, 1, &segmentation.labels);
            self.label_bricks = Some(labels_in_bricks(segmentation, BRICK));
            return false;
        }
        let is_more = self.texels.pack_next(surface, &mut self.row);
        let row = MESH_ROW as usize;
        if !is_more {
            self.row
                .resize(self.row.len().next_multiple_of(row), [0; 4]);
        }
        let whole = self.row.len() / row;
        if whole > 0 {
            let rows = self.next_row..self.next_row + whole as u32;
            self.next_row = rows.end;
            let texels = &self.row[..whole * row];
            write_rows(
                gpu,
                &self.mesh_texture,
                rows,
                16,
                bytemuck::cast_slice(texels),
            );
            self.row.drain(..whole * row);
        }
        !is_more
    }

    /// The meshes, once [`MeshUpload::advance`] said that all is handed over.
    pub(crate) fn finish(self) -> MeshTextures {
        let views = [&self.depth_texture, &self.label_texture, &self.mesh_texture];
        let [depths, fills, texels] = views.map(HeldView::new);
        MeshTextures {
            surface: self.surface,
            depths,
            fills,
            texels,
            seen_bricks: self.seen_bricks,
            label_bricks: self.label_bricks.unwrap_or_default(),
        }
    }
}

impl MeshTextures {
    /// Hands meshes over in one piece.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] with the number of triangles, if the device does not take them.
    pub(crate) fn new(gpu: &Gpu, surface: &Arc<Surface>) -> Result<Self, RenderError> {
        let mut upload = MeshUpload::new(gpu, surface)?;
        while !upload.advance(gpu) {}
        Ok(upload.finish())
    }

    /// Adds to a subject's uniform where the meshes lie. Their first segment has the label after `labels_before`.
    pub(crate) fn place(&self, labels_before: u32, uniform: Subject) -> Subject {
        let surface = &self.surface;
        let (field, grid) = (&surface.field, &surface.segmentation.grid);
        let field_voxels = VoxelFrame::new(field.dims, field.rest_from_voxel);
        let fill_voxels = VoxelFrame::new(grid.dims, field.rest_from_inner_voxel());
        let affine = |affine: DAffine3| affine.as_affine3a().into();
        Subject {
            field_from_rest: affine(field_voxels.texture_from_rest()),
            fill_from_rest: affine(fill_voxels.texture_from_rest()),
            field_dims: field.dims.as_vec3().extend(0.0).to_array(),
            fill_dims: grid.dims.as_vec3().extend(0.0).to_array(),
            mesh_min: surface.frame.bounds.min.extend(0.0).to_array(),
            mesh_max: surface.frame.bounds.max.extend(0.0).to_array(),
            node_count: surface.tree.nodes.len() as u32,
            triangles_at: triangles_at(surface),
            sets_at: texels_of(surface),
            textures_at: match surface.textures {
                Some(_) => textures_at(surface),
                None => 0,
            },
            field_detail: surface.frame.detail,
            labels_before,
            ..uniform
        }
    }

    /// The boxes of its bricks that hold something, rest space.
    pub(crate) fn seen_boxes(&self) -> impl Iterator<Item = Aabb> {
        let field = &self.surface.field;
        let count = bricks_of(field);
        let place = |voxel: UVec3| {
            let at = voxel.as_dvec3() - 0.5;
            field.rest_from_voxel.transform_point3(at).as_vec3()
        };
        let seen = (0..).zip(&self.seen_bricks).filter(|(_, seen)| **seen);
        seen.map(move |(i, _): (u32, _)| {
            let brick = UVec3::new(i % count.x, i / count.x % count.y, i / (count.x * count.y));
            Aabb::from_points([place(brick * BRICK), place((brick + 1) * BRICK)])
        })
    }

    /// A subject of these meshes alone.
    pub(crate) fn alone(mut self, gpu: &Gpu, layouts: &Layouts) -> SubjectTextures {
        let surface = Arc::clone(&self.surface);
        let (field, segmentation) = (&surface.field, &surface.segmentation);
        let uniform = self.place(0, uniform_of(&surface));
        let segments = segmentation.segments.clone();
        let (volume_view, label_view) = (Arc::clone(&self.depths), Arc::clone(&self.fills));
        let bound = Bound::new(
            gpu,
            layouts,
            &uniform,
            [&volume_view, &label_view],
            Some(&self),
            &segments,
        );
        let own = segmentation.grid;
        SubjectTextures {
            stamp: next_stamp(),
            shader: SubjectShader::Mesh,
            bind_group: bound.bind_group,
            buffer: bound.buffer,
            bricks: Bricks {
                dims: bricks_of(field),
                ranges: Vec::new(),
            },
            wide_bricks: None,
            info: SubjectInfo::of_no_values(bound.has_colors),
            label_bricks: Some(std::mem::take(&mut self.label_bricks)),
            frame: surface.frame,
            bounds: surface.frame.bounds,
            uniform,
            volume_view,
            label_view,
            meshes: Some(Arc::new(self)),
            plate: None,
            sampler: layouts.linear_sampler.clone(),
            voxels: VoxelFrame::new(field.dims, field.rest_from_voxel),
            label_voxels: Some(VoxelFrame::new(own.dims, field.rest_from_inner_voxel())),
            foot_axis: 2,
            axes: long_axes(segmentation, &field.rest_from_inner_voxel()),
            patterns: stroke_patterns(segmentation),
            mesh_segments: surface.segments.clone(),
            segments,
        }
    }
}

/// Texels of a mesh's texture: those of its triangles, behind them its sets of segments, then its pictures.
fn texel_count(surface: &Surface) -> usize {
    textures_at(surface) as usize + texels_of_textures(surface) as usize
}

/// The texel at which the pictures begin, if there are any.
fn textures_at(surface: &Surface) -> u32 {
    texels_of(surface) + surface.field.sets.len() as u32
}

/// The uniform of a subject of meshes alone, but for where they lie.
fn uniform_of(surface: &Surface) -> Subject {
    let (field, labels) = (&surface.field, surface.segmentation.grid.dims);
    let field_voxels = VoxelFrame::new(field.dims, field.rest_from_voxel);
    let label_voxels = VoxelFrame::new(labels, field.rest_from_inner_voxel());
    let affine = |affine: DAffine3| affine.as_affine3a().into();
    Subject {
        texture_from_rest: affine(field_voxels.texture_from_rest()),
        label_from_rest: affine(label_voxels.texture_from_rest()),
        dims: field.dims.as_vec3().extend(0.0).to_array(),
        label_dims: labels.as_vec3().extend(0.0).to_array(),
        texture_end: [1.0, 1.0, 1.0, 0.0],
        value_low: 0.0,
        value_range: 1.0,
        detail: surface.frame.detail,
        has_labels: 1,
        ..Subject::default()
    }
}

fn bricks_of(field: &SurfaceField) -> UVec3 {
    (field.dims + BRICK - 1) / BRICK
}

/// Marks the bricks that hold triangles or the inside of a segment, by some slices of the field.
fn see_bricks(field: &SurfaceField, slices: Range<u32>, seen: &mut [bool]) {
    let count = bricks_of(field);
    let spacing = field.rest_from_voxel.matrix3;
    // A triangle nearer to a voxel's middle than this may lie in the voxel.
    let near = (spacing.x_axis + spacing.y_axis + spacing.z_axis).length() as f32;
    let mut index = (slices.start * field.dims.x * field.dims.y) as usize;
    for z in slices {
        for y in 0..field.dims.y {
            for x in 0..field.dims.x {
                if field.depths[index] >= -near {
                    let brick = UVec3::new(x, y, z) / BRICK;
                    let at = brick.x + count.x * (brick.y + count.y * brick.z);
                    seen[at as usize] = true;
                }
                index += 1;
            }
        }
    }
}
