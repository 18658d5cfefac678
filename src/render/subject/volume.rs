//! A volume on the GPU: values, labels and their colours, and where they lie.

use super::bricks::{BRICK, Bricks, WideBricks, labels_in_bricks};
use super::held_view::HeldView;
use super::textures::{
    Bound, MeshTextures, SubjectTextures, VoxelFrame, label_texture, next_stamp,
};
use crate::data::{
    FIRST_MESH_LABEL, Segmentation, Volume, called_as_in, long_axes, stroke_patterns,
    with_mesh_segments,
};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::programs::SubjectShader;
use crate::render::device::textures::write_slices;
use crate::render::pack::gpu_types::Subject;
use crate::render::pack::values::{SubjectInfo, span};
use glam::{Affine3A, DAffine3, UVec3, Vec3};
use std::sync::Arc;

/// Bytes converted and handed to the GPU at a time: small enough that a frame is not missed.
pub(crate) const SLAB_BYTES: usize = 2 << 20;

/// The same volume with other segments, and with these meshes beside it, around the textures that hold it. `volume` is
/// the one that was uploaded.
///
/// # Errors
/// [`RenderError::TooLarge`] if the device does not take so many labels along an axis, or they are not whole.
pub(crate) fn with_labels(
    textures: &SubjectTextures,
    gpu: &Gpu,
    layouts: &Layouts,
    volume: &Volume,
    labels: Option<&Segmentation>,
    meshes: Option<Arc<MeshTextures>>,
) -> Result<SubjectTextures, RenderError> {
    let dims = labels.map_or(UVec3::ONE, |labels| labels.grid.dims);
    let most = gpu.device.limits().max_texture_dimension_3d;
    if dims.max_element() > most || labels.is_some_and(|l| l.labels.len() != l.grid.voxel_count()) {
        return Err(RenderError::TooLarge(format!(
            "{} × {} × {} labels do not fit on this device",
            dims.x, dims.y, dims.z
        )));
    }
    let texture = label_texture(gpu, dims);
    if let Some(labels) = labels {
        let slice = dims.x as usize * dims.y as usize;
        let at_once = (SLAB_BYTES / slice.max(1)).max(1);
        for (i, part) in labels.labels.chunks(at_once * slice).enumerate() {
            let slices = (part.len() / slice) as u32;
            write_slices(gpu, &texture, (i * at_once) as u32, slices, 1, part);
        }
    }
    let views = [Arc::clone(&textures.volume_view), HeldView::new(&texture)];
    let (bricks, info) = (textures.bricks.clone(), textures.info);
    let held = (views, meshes);
    Ok(assemble(gpu, layouts, volume, labels, held, bricks, info))
}

/// Everything that the passes want, around textures that are filled. `info` is complete but for the segments.
pub(crate) fn assemble(
    gpu: &Gpu,
    layouts: &Layouts,
    volume: &Volume,
    labels: Option<&Segmentation>,
    ([volume_view, label_view], meshes): ([Arc<HeldView>; 2], Option<Arc<MeshTextures>>),
    bricks: Bricks,
    mut info: SubjectInfo,
) -> SubjectTextures {
    let grid = &volume.grid;
    let dims = grid.dims.as_vec3();
    let label_grid = labels.map_or(grid, |l| &l.grid);
    // Labels may lie on another grid; both go through world space.
    let subject_from_world = grid.subject_from_voxel() * grid.world_from_voxel.inverse();
    let label_texture_from_voxel = DAffine3::from_scale(label_grid.dims.as_dvec3().recip())
        * DAffine3::from_translation(glam::DVec3::splat(0.5));
    let label_from_rest =
        label_texture_from_voxel * (subject_from_world * label_grid.world_from_voxel).inverse();
    let label_dims = labels.map_or(glam::Vec3::ONE, |labels| labels.grid.dims.as_vec3());
    let frame = grid.frame();
    let mut uniform = Subject {
        texture_from_rest: affine32(&grid.texture_from_subject()).into(),
        label_from_rest: affine32(&label_from_rest).into(),
        dims: dims.extend(0.0).to_array(),
        label_dims: label_dims.extend(0.0).to_array(),
        texture_end: [1.0, 1.0, 1.0, 0.0],
        value_low: volume.value_range[0],
        value_range: span(volume.value_range),
        detail: frame.detail,
        has_labels: u32::from(labels.is_some()),
        ..Subject::default()
    };
    let mut segments = labels.map(|l| l.segments.clone()).unwrap_or_default();
    let mut mesh_segments = Vec::new();
    let mut bounds = frame.bounds;
    let mut wide_bricks = None;
    if let Some(meshes) = &meshes {
        uniform = meshes.place(u32::from(FIRST_MESH_LABEL) - 1, uniform);
        segments = with_mesh_segments(&segments, &meshes.surface);
        mesh_segments = called_as_in(&segments, &meshes.surface);
        bounds = bounds.union(meshes.surface.frame.bounds);
        let brick_from_rest = DAffine3::from_scale(grid.dims.as_dvec3() / f64::from(BRICK))
            * grid.texture_from_subject();
        wide_bricks = WideBricks::new(bricks.dims, &brick_from_rest, meshes.seen_boxes());
    }
    let bound = Bound::new(
        gpu,
        layouts,
        &uniform,
        [&*volume_view, &*label_view],
        meshes.as_deref(),
        &segments,
    );
    info.has_segments = bound.has_colors;
    let up = subject_from_world.inverse().matrix3 * grid.subject_from_voxel().matrix3;
    let rises = [up.x_axis, up.y_axis, up.z_axis].map(|axis| (axis.z / axis.length()).abs());
    let foot_axis = (0..3).fold(0, |best, i| if rises[i] > rises[best] { i } else { best });
    SubjectTextures {
        stamp: next_stamp(),
        shader: match &meshes {
            Some(_) => SubjectShader::Both,
            None => SubjectShader::Volume,
        },
        buffer: bound.buffer,
        volume_view,
        label_view,
        meshes,
        plate: None,
        sampler: layouts.linear_sampler.clone(),
        voxels: VoxelFrame::new(grid.dims, grid.subject_from_voxel()),
        label_voxels: labels
            .map(|l| VoxelFrame::new(l.grid.dims, subject_from_world * l.grid.world_from_voxel)),
        foot_axis: foot_axis as u32,
        axes: labels.map_or([Vec3::Z; 256], |labels| {
            long_axes(labels, &(subject_from_world * labels.grid.world_from_voxel))
        }),
        patterns: labels.map_or([0; 256], stroke_patterns),
        mesh_segments,
        segments,
        bind_group: bound.bind_group,
        bricks,
        wide_bricks,
        label_bricks: labels
            .filter(|labels| labels.grid == *grid)
            .map(|labels| labels_in_bricks(labels, BRICK)),
        info,
        frame,
        bounds,
        uniform,
    }
}

fn affine32(affine: &DAffine3) -> Affine3A {
    affine.as_affine3a()
}
