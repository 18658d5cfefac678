//! A volume on the GPU: values, labels and their colours, and where they lie.

use super::bricks::{BRICK, Bricks, LabelSet, labels_in_bricks};
use crate::data::{Segment, Segmentation, SubjectFrame, Volume};
use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::textures::{extent, volume_texture, write_slices};
use crate::render::pack::gpu_types::Subject;
use crate::render::pack::stamps::Stamp;
use crate::render::pack::values::{SubjectInfo, span};
use glam::{Affine3A, DAffine3, DVec3, UVec3, Vec3};
use std::sync::atomic::{AtomicU64, Ordering};

/// Bytes converted and handed to the GPU at a time: small enough that a frame is not missed.
pub(crate) const SLAB_BYTES: usize = 2 << 20;

/// A volume on the GPU. Built once per subject.
#[derive(Debug)]
pub(crate) struct SubjectTextures {
    /// Stamp of this subject alone, above 0; later subjects have larger stamps.
    pub stamp: Stamp,
    /// Bind group 1: volume, labels and their uniform.
    pub bind_group: wgpu::BindGroup,
    /// Value ranges by brick, of values normalised to 0 to 1.
    pub bricks: Bricks,
    /// The window that presets take by default, and the span of the values.
    pub info: SubjectInfo,
    /// Labels by brick, where they lie on the grid of the values.
    pub label_bricks: Option<Vec<LabelSet>>,
    /// Where the untouched subject lies, and how fine it is.
    pub frame: SubjectFrame,
    /// The uniform, as uploaded.
    pub uniform: Subject,
    /// The buffer that holds `uniform` on the GPU.
    pub buffer: wgpu::Buffer,
    /// Scalars, labels and how the scalars are read: what is made from them by computing.
    pub volume_view: wgpu::TextureView,
    pub label_view: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
    /// Where the voxels of the scalars lie.
    pub voxels: VoxelFrame,
    /// Where the voxels of the labels lie.
    pub label_voxels: Option<VoxelFrame>,
    /// Axis of the volume's grid that runs from foot to head.
    pub foot_axis: u32,
    /// Named segments of the subject.
    pub segments: Vec<Segment>,
}

/// Where the voxels of a grid lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct VoxelFrame {
    /// Voxels along each axis.
    pub dims: UVec3,
    /// Between their centres along each axis, subject units.
    pub spacing: Vec3,
    /// Rest space from voxel indices.
    pub rest_from_voxel: DAffine3,
}

impl VoxelFrame {
    fn new(dims: UVec3, rest_from_voxel: DAffine3) -> Self {
        let m = rest_from_voxel.matrix3;
        Self {
            dims,
            spacing: DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length()).as_vec3(),
            rest_from_voxel,
        }
    }

    /// Texture space (outer edges at 0 and 1) from rest space.
    pub(crate) fn texture_from_rest(&self) -> DAffine3 {
        DAffine3::from_scale(self.dims.as_dvec3().recip())
            * DAffine3::from_translation(DVec3::splat(0.5))
            * self.rest_from_voxel.inverse()
    }
}

impl SubjectTextures {
    /// The same values with other segments. `volume` is the one that was uploaded.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if the device does not take so many labels along an axis, or they are not whole.
    pub(crate) fn with_labels(
        &self,
        gpu: &Gpu,
        layouts: &Layouts,
        volume: &Volume,
        labels: Option<&Segmentation>,
    ) -> Result<Self, RenderError> {
        let dims = labels.map_or(UVec3::ONE, |labels| labels.grid.dims);
        let most = gpu.device.limits().max_texture_dimension_3d;
        if dims.max_element() > most
            || labels.is_some_and(|l| l.labels.len() != l.grid.voxel_count())
        {
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
        let views = [
            self.volume_view.clone(),
            texture.create_view(&Default::default()),
        ];
        let (bricks, info) = (self.bricks.clone(), self.info);
        Ok(assemble(gpu, layouts, volume, labels, views, bricks, info))
    }
}

pub(crate) fn label_texture(gpu: &Gpu, dims: UVec3) -> wgpu::Texture {
    let format = wgpu::TextureFormat::R8Uint;
    volume_texture(gpu, "labels", dims, format, wgpu::TextureUsages::COPY_DST)
}

/// Everything that the passes want, around textures that are filled. `info` is complete but for the segments.
pub(crate) fn assemble(
    gpu: &Gpu,
    layouts: &Layouts,
    volume: &Volume,
    labels: Option<&Segmentation>,
    [volume_view, label_view]: [wgpu::TextureView; 2],
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
    let uniform = Subject {
        texture_from_rest: affine32(&grid.texture_from_subject()).into(),
        label_from_rest: affine32(&label_from_rest).into(),
        dims: dims.extend(0.0).to_array(),
        label_dims: label_dims.extend(0.0).to_array(),
        texture_end: [1.0, 1.0, 1.0, 0.0],
        value_low: volume.value_range[0],
        value_range: span(volume.value_range),
        detail: frame.detail,
        has_labels: u32::from(labels.is_some()),
    };
    let mut colors = [[0u8; 4]; 256];
    let mut has_segments = false;
    for segment in labels.into_iter().flat_map(|l| &l.segments) {
        if let (Some(slot), Some([r, g, b])) = (
            colors.get_mut(usize::from(segment.label)),
            segment.color_srgb,
        ) {
            // Of segments that overlap, the first that is listed gives its color.
            if *slot == [0; 4] {
                *slot = [r, g, b, 255];
            }
            has_segments = true;
        }
    }
    let palette = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("palette"),
        size: extent(UVec3::new(256, 1, 1)),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    write_slices(gpu, &palette, 0, 1, 4, bytemuck::cast_slice(&colors));
    let buffer = uniform_buffer(gpu, "subject", &uniform);
    let palette_view = palette.create_view(&Default::default());
    let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("subject"),
        layout: &layouts.subject,
        entries: &[
            entry(0, buffer.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&volume_view)),
            entry(2, wgpu::BindingResource::Sampler(&layouts.linear_sampler)),
            entry(3, wgpu::BindingResource::TextureView(&label_view)),
            entry(4, wgpu::BindingResource::TextureView(&palette_view)),
        ],
    });
    info.has_segments = has_segments;
    let up = subject_from_world.inverse().matrix3 * grid.subject_from_voxel().matrix3;
    let rises = [up.x_axis, up.y_axis, up.z_axis].map(|axis| (axis.z / axis.length()).abs());
    let foot_axis = (0..3).fold(0, |best, i| if rises[i] > rises[best] { i } else { best });
    static SUBJECTS: AtomicU64 = AtomicU64::new(0);
    SubjectTextures {
        stamp: 1 + SUBJECTS.fetch_add(1, Ordering::Relaxed),
        buffer,
        volume_view,
        label_view,
        sampler: layouts.linear_sampler.clone(),
        voxels: VoxelFrame::new(grid.dims, grid.subject_from_voxel()),
        label_voxels: labels
            .map(|l| VoxelFrame::new(l.grid.dims, subject_from_world * l.grid.world_from_voxel)),
        foot_axis: foot_axis as u32,
        segments: labels.map(|l| l.segments.clone()).unwrap_or_default(),
        bind_group,
        bricks,
        label_bricks: labels
            .filter(|labels| labels.grid == *grid)
            .map(|labels| labels_in_bricks(labels, BRICK)),
        info,
        frame,
        uniform,
    }
}

fn affine32(affine: &DAffine3) -> Affine3A {
    affine.as_affine3a()
}
