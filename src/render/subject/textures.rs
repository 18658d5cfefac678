//! A subject on the GPU in the form that every pass reads, whatever the kind of subject.

use super::bricks::{Bricks, LabelSet, WideBricks};
use super::held_view::HeldView;
use super::plate::PlateTexture;
use crate::data::{FIRST_MESH_LABEL, Segment, SubjectFrame, Surface, SurfaceSegment};
use crate::math::Aabb;
use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::programs::SubjectShader;
use crate::render::device::textures::{extent, volume_texture, write_slices};
use crate::render::pack::gpu_types::Subject;
use crate::render::pack::stamps::Stamp;
use crate::render::pack::triangles::texels_of_textures;
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
    /// The bricks of a volume and of the meshes beside it; `None` where there are none.
    pub wide_bricks: Option<WideBricks>,
    /// Labels by brick, where they lie on the grid of the values.
    pub label_bricks: Option<Vec<LabelSet>>,
    /// Where the untouched subject lies, and how fine it is.
    pub frame: SubjectFrame,
    /// Box of everything that is untouched, subject space: meshes may reach out of the volume that they lie beside.
    pub bounds: Aabb,
    /// The uniform, as uploaded.
    pub uniform: Subject,
    /// The buffer that holds `uniform` on the GPU.
    pub buffer: wgpu::Buffer,
    /// Scalars, labels and how the scalars are read: what passes make from them by computing.
    /// The same scalars may have other labels.
    pub volume_view: Arc<HeldView>,
    pub label_view: Arc<HeldView>,
    /// Its meshes, alone or beside a volume.
    pub meshes: Option<Arc<MeshTextures>>,
    /// The picture of a figure.
    pub plate: Option<PlateTexture>,
    pub sampler: wgpu::Sampler,
    /// Where the voxels of the scalars lie. On these voxels, or on `label_voxels`, distances to kept tissue are made.
    pub voxels: VoxelFrame,
    /// Where the voxels of the labels lie.
    pub label_voxels: Option<VoxelFrame>,
    /// Axis of `voxels` that runs from foot to head.
    pub foot_axis: u32,
    /// The long axes of its segments, rest space: see [`crate::data::long_axes`].
    pub axes: [Vec3; 256],
    /// The patterns of their strokes: see [`crate::data::stroke_patterns`].
    pub patterns: [u8; 256],
    /// Named segments of the subject.
    pub segments: Vec<Segment>,
    /// What the segments of meshes are; none of a volume.
    pub mesh_segments: Vec<SurfaceSegment>,
}

impl SubjectTextures {
    /// True if places have segments: labels of voxels, or meshes.
    pub(crate) fn has_segments(&self) -> bool {
        self.uniform.has_labels != 0 || self.meshes.is_some()
    }

    /// Bytes of the values and the labels, and of the meshes: their field, tree and triangles. Their pictures are
    /// counted apart, by [`SubjectTextures::texture_bytes`].
    pub(crate) fn bytes(&self) -> u64 {
        let beside = match &self.meshes {
            Some(meshes) if self.shader == SubjectShader::Both => {
                meshes.depths.bytes() + meshes.fills.bytes()
            }
            _ => 0,
        };
        let texels = self
            .meshes
            .as_ref()
            .map_or(0, |meshes| meshes.texels.bytes());
        self.volume_view.bytes() + self.label_view.bytes() + beside + texels - self.texture_bytes()
    }

    /// Bytes of the pictures on triangles.
    pub(crate) fn texture_bytes(&self) -> u64 {
        let meshes = self.meshes.as_ref();
        meshes.map_or(0, |meshes| {
            16 * u64::from(texels_of_textures(&meshes.surface))
        })
    }
}

/// Meshes on the GPU, alone or beside a volume.
#[derive(Debug)]
pub(crate) struct MeshTextures {
    /// What is there.
    pub surface: Arc<Surface>,
    /// Depths under the surface on the field's grid.
    pub depths: Arc<HeldView>,
    /// Which set of segments fills each of its voxels, its margin left out.
    pub fills: Arc<HeldView>,
    /// Tree, triangles and sets.
    pub texels: Arc<HeldView>,
    /// Bricks of the field's voxels that hold triangles or the inside of a segment.
    pub seen_bricks: Vec<bool>,
    /// Segments by brick of the voxels of `fills`.
    pub label_bricks: Vec<LabelSet>,
}

impl MeshTextures {
    /// Their bindings in group 1, in order.
    pub(crate) fn entries(&self) -> [wgpu::BindGroupEntry<'_>; 3] {
        let view = |view| wgpu::BindingResource::TextureView(view);
        [
            entry(5, view(&self.texels)),
            entry(6, view(&self.depths)),
            entry(7, view(&self.fills)),
        ]
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
        ];
        if self.shader != SubjectShader::Mesh {
            entries.push(entry(3, view(&self.label_view)));
        }
        if let Some(meshes) = &self.meshes {
            entries.extend(meshes.entries());
        }
        entries
    }
}

/// Colours of labels: those of a volume, and behind them those of the segments of meshes.
const PALETTE: u32 = FIRST_MESH_LABEL as u32 + 64;

/// Texels in a row of the texture of a mesh, as in shaders/subject/mesh.wgsl.
pub(crate) const MESH_ROW: u32 = 4096;

/// A byte per voxel: the number of its segment, or of what fills it.
pub(crate) fn label_texture(gpu: &Gpu, dims: UVec3) -> wgpu::Texture {
    let format = wgpu::TextureFormat::R8Uint;
    volume_texture(gpu, "labels", dims, format, wgpu::TextureUsages::COPY_DST)
}

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
    /// Of the uniform, the textures of scalars, of labels and of meshes, and the segments, whose colours are looked
    /// up by label.
    pub(crate) fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        uniform: &Subject,
        [volume_view, label_view]: [&wgpu::TextureView; 2],
        meshes: Option<&MeshTextures>,
        segments: &[Segment],
    ) -> Self {
        let mut colors = [[0u8; 4]; PALETTE as usize];
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
                has_colors |= segment.label < FIRST_MESH_LABEL;
            }
        }
        let palette = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("palette"),
            size: extent(UVec3::new(PALETTE, 1, 1)),
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
        let no_mesh = mesh_texture(gpu, [1, 1]).create_view(&Default::default());
        let view = wgpu::BindingResource::TextureView;
        let mesh_entries = meshes.map_or_else(
            || {
                [
                    entry(5, view(&no_mesh)),
                    entry(6, view(volume_view)),
                    entry(7, view(label_view)),
                ]
            },
            MeshTextures::entries,
        );
        let [texels, depths, fills] = mesh_entries;
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("subject"),
            layout: &layouts.subject,
            entries: &[
                entry(0, buffer.as_entire_binding()),
                entry(1, view(volume_view)),
                entry(2, wgpu::BindingResource::Sampler(&layouts.linear_sampler)),
                entry(3, view(label_view)),
                entry(4, view(&palette_view)),
                texels,
                depths,
                fills,
            ],
        });
        Self {
            buffer,
            bind_group,
            has_colors,
        }
    }
}
