//! A subject on the GPU in the form that every pass reads, whatever the kind of subject.

use super::bricks::{Bricks, LabelSet};
use crate::data::{Segment, SubjectFrame, SurfaceSegment};
use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::programs::SubjectShader;
use crate::render::device::textures::{extent, write_slices};
use crate::render::pack::gpu_types::Subject;
use crate::render::pack::stamps::Stamp;
use crate::render::pack::values::SubjectInfo;
use glam::{DAffine3, DVec3, UVec3, Vec3};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A subject on the GPU, as every pass takes it. Built once per subject.
#[derive(Debug)]
pub(crate) struct SubjectTextures {
    /// Stamp of this subject alone, above 0; later subjects have larger stamps.
    pub stamp: Stamp,
    /// The shader file that answers for this kind of subject what lies at a place.
    pub shader: SubjectShader,
    /// Bind group 1: volume, labels and their uniform.
    pub bind_group: wgpu::BindGroup,
    /// Value ranges by brick, of values normalised to 0 to 1.
    pub bricks: Bricks,
    /// The window that presets take by default, and the span of the values.
    pub info: SubjectInfo,
    /// Bricks in which something is seen whatever the look is, where that does not follow from values.
    pub seen_bricks: Option<Vec<bool>>,
    /// Labels by brick, where they lie on the grid of the values.
    pub label_bricks: Option<Vec<LabelSet>>,
    /// Where the untouched subject lies, and how fine it is.
    pub frame: SubjectFrame,
    /// The uniform, as uploaded.
    pub uniform: Subject,
    /// The buffer that holds `uniform` on the GPU.
    pub buffer: wgpu::Buffer,
    /// Scalars, labels and how the scalars are read: what passes make from them by computing.
    /// The same scalars may have other labels.
    pub volume_view: Arc<HeldView>,
    pub label_view: Arc<HeldView>,
    /// Tree and triangles of a mesh.
    pub mesh_view: Option<Arc<HeldView>>,
    pub sampler: wgpu::Sampler,
    /// Where the voxels of the scalars lie. On these voxels, or on `label_voxels`, distances to kept tissue are made.
    pub voxels: VoxelFrame,
    /// Where the voxels of the labels lie.
    pub label_voxels: Option<VoxelFrame>,
    /// Axis of `voxels` that runs from foot to head.
    pub foot_axis: u32,
    /// Named segments of the subject.
    pub segments: Vec<Segment>,
    /// What the segments of a mesh are; none of a volume.
    pub mesh_segments: Vec<SurfaceSegment>,
}

/// A view of a whole texture, which is given back to the device when nobody holds the view any more. A browser would
/// give it back late.
#[derive(Debug)]
pub(crate) struct HeldView(wgpu::TextureView);

impl HeldView {
    pub(crate) fn new(texture: &wgpu::Texture) -> Arc<Self> {
        Arc::new(Self(texture.create_view(&Default::default())))
    }
}

impl Drop for HeldView {
    fn drop(&mut self) {
        self.0.texture().destroy();
    }
}

impl HeldView {
    /// Bytes of the texture.
    fn bytes(&self) -> u64 {
        let texture = self.0.texture();
        let texels = texture.size();
        let texel = texture.format().block_copy_size(None).unwrap_or(0);
        [
            texels.width,
            texels.height,
            texels.depth_or_array_layers,
            texel,
        ]
        .into_iter()
        .map(u64::from)
        .product()
    }
}

impl std::ops::Deref for HeldView {
    type Target = wgpu::TextureView;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl SubjectTextures {
    /// Bytes of the values and the labels.
    pub(crate) fn bytes(&self) -> u64 {
        self.volume_view.bytes() + self.label_view.bytes()
    }
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
    pub(crate) fn new(dims: UVec3, rest_from_voxel: DAffine3) -> Self {
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

/// A stamp that no subject has had.
pub(crate) fn next_stamp() -> Stamp {
    static SUBJECTS: AtomicU64 = AtomicU64::new(0);
    1 + SUBJECTS.fetch_add(1, Ordering::Relaxed)
}

impl SubjectTextures {
    /// The bindings of group 1 in compute passes that ask what is kept at a place.
    pub(crate) fn kept_entries(&self) -> Vec<wgpu::BindGroupEntry<'_>> {
        let view = |view| wgpu::BindingResource::TextureView(view);
        let mut entries = vec![
            entry(0, self.buffer.as_entire_binding()),
            entry(2, wgpu::BindingResource::Sampler(&self.sampler)),
            entry(3, view(&self.label_view)),
        ];
        if let Some(mesh) = &self.mesh_view {
            entries.push(entry(1, view(&self.volume_view)));
            entries.push(entry(5, view(mesh)));
        }
        entries
    }
}

/// Texels in a row of the texture of a mesh, as in shaders/subject/mesh.wgsl.
pub(crate) const MESH_ROW: u32 = 4096;

/// The texture of a mesh's tree and triangles.
pub(crate) fn mesh_texture(gpu: &Gpu, size: [u32; 2]) -> wgpu::Texture {
    flat_texture(gpu, "mesh", size, wgpu::TextureFormat::Rgba32Uint)
}

/// A texture of whole numbers that the processor writes.
pub(crate) fn flat_texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: extent(UVec3::new(width, height, 1)),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// What group 1 holds of a subject of any kind, around textures that are filled.
pub(crate) struct Bound {
    /// The uniform's buffer.
    pub buffer: wgpu::Buffer,
    /// Group 1.
    pub bind_group: wgpu::BindGroup,
    /// A segment has a colour.
    pub has_colors: bool,
}

impl Bound {
    /// Of the uniform, the textures of scalars, of labels and of triangles, and the segments, whose colours are looked
    /// up by label.
    pub(crate) fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        uniform: &Subject,
        [volume_view, label_view]: [&wgpu::TextureView; 2],
        mesh_view: Option<&wgpu::TextureView>,
        segments: &[Segment],
    ) -> Self {
        let mut colors = [[0u8; 4]; 256];
        let mut has_colors = false;
        for segment in segments {
            if let (Some(slot), Some([r, g, b])) = (
                colors.get_mut(usize::from(segment.label)),
                segment.color_srgb,
            ) {
                // Of segments that overlap, the first that is listed gives its color.
                if *slot == [0; 4] {
                    *slot = [r, g, b, 255];
                }
                has_colors = true;
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
        let buffer = uniform_buffer(gpu, "subject", uniform);
        let palette_view = palette.create_view(&Default::default());
        let no_mesh = mesh_view
            .is_none()
            .then(|| mesh_texture(gpu, [1, 1]).create_view(&Default::default()));
        let mesh_view = mesh_view.or(no_mesh.as_ref()).unwrap_or(label_view);
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("subject"),
            layout: &layouts.subject,
            entries: &[
                entry(0, buffer.as_entire_binding()),
                entry(1, wgpu::BindingResource::TextureView(volume_view)),
                entry(2, wgpu::BindingResource::Sampler(&layouts.linear_sampler)),
                entry(3, wgpu::BindingResource::TextureView(label_view)),
                entry(4, wgpu::BindingResource::TextureView(&palette_view)),
                entry(5, wgpu::BindingResource::TextureView(mesh_view)),
            ],
        });
        Self {
            buffer,
            bind_group,
            has_colors,
        }
    }
}
