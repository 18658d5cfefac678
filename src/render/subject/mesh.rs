//! Meshes on the GPU: their field, their segments on the field's voxels, and tree and triangles in one texture.

use super::bricks::{BRICK, Bricks, labels_in_bricks};
use super::textures::{
    Bound, HeldView, MESH_ROW, MeshTextures, SubjectTextures, VoxelFrame, label_texture,
    mesh_texture, next_stamp,
};
use crate::data::{Surface, SurfaceField};
use crate::math::Aabb;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::programs::SubjectShader;
use crate::render::device::textures::{volume_texture, write_slices};
use crate::render::pack::gpu_types::Subject;
use crate::render::pack::triangles::{pack_triangles, texels_of};
use crate::render::pack::values::SubjectInfo;
use glam::{DAffine3, UVec3};
use half::f16;
use std::sync::Arc;

impl MeshTextures {
    /// Hands meshes over in one piece: their texels are a copy of what is there.
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
        let field = &surface.field;
        let depth_texture = volume_texture(
            gpu,
            "depths",
            field.dims,
            wgpu::TextureFormat::R16Float,
            wgpu::TextureUsages::COPY_DST,
        );
        let depths: Vec<u16> = (field.depths.iter())
            .map(|&depth| f16::from_f32(depth).to_bits())
            .collect();
        let bytes = bytemuck::cast_slice(&depths);
        write_slices(gpu, &depth_texture, 0, field.dims.z, 2, bytes);
        let segmentation = &surface.segmentation;
        let fill_texture = label_texture(gpu, segmentation.grid.dims);
        let slices = segmentation.grid.dims.z;
        write_slices(gpu, &fill_texture, 0, slices, 1, &segmentation.labels);
        let texels = packed(surface);
        let rows = (texels.len() / MESH_ROW as usize) as u32;
        let mesh = mesh_texture(gpu, [MESH_ROW, rows]);
        write_slices(gpu, &mesh, 0, 1, 16, bytemuck::cast_slice(&texels));
        let [depths, fills, texels] = [&depth_texture, &fill_texture, &mesh].map(HeldView::new);
        Ok(Self {
            surface: Arc::clone(surface),
            depths,
            fills,
            texels,
            seen_bricks: seen_bricks(field),
        })
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
            triangles_at: 2 * surface.tree.nodes.len() as u32,
            sets_at: texels_of(surface),
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
    pub(crate) fn alone(self, gpu: &Gpu, layouts: &Layouts) -> SubjectTextures {
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
            label_bricks: Some(labels_in_bricks(segmentation, BRICK)),
            frame: surface.frame,
            bounds: surface.frame.bounds,
            uniform,
            volume_view,
            label_view,
            meshes: Some(Arc::new(self)),
            sampler: layouts.linear_sampler.clone(),
            voxels: VoxelFrame::new(field.dims, field.rest_from_voxel),
            label_voxels: Some(VoxelFrame::new(own.dims, field.rest_from_inner_voxel())),
            foot_axis: 2,
            mesh_segments: surface.segments.clone(),
            segments,
        }
    }
}

/// Texels of a mesh's texture: those of its triangles, and behind them its sets of segments.
fn texel_count(surface: &Surface) -> usize {
    texels_of(surface) as usize + surface.field.sets.len()
}

/// The texels of the mesh, whole rows of them, as shaders/subject/mesh.wgsl reads them.
fn packed(surface: &Surface) -> Vec<[u32; 4]> {
    let count = texel_count(surface).next_multiple_of(MESH_ROW as usize);
    let mut texels = Vec::with_capacity(count);
    pack_triangles(surface, &mut texels);
    for &set in &surface.field.sets {
        texels.push(std::array::from_fn(|word| (set >> (32 * word)) as u32));
    }
    texels.resize(count, [0; 4]);
    texels
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

/// Bricks that hold triangles or the inside of a segment.
fn seen_bricks(field: &SurfaceField) -> Vec<bool> {
    let count = bricks_of(field);
    let mut seen = vec![false; count.element_product() as usize];
    let spacing = field.rest_from_voxel.matrix3;
    // A triangle nearer to a voxel's middle than this may lie in the voxel.
    let near = (spacing.x_axis + spacing.y_axis + spacing.z_axis).length() as f32;
    let mut index = 0;
    for z in 0..field.dims.z {
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
    seen
}
