use super::bricks::BrickBuilder;
use super::held_view::HeldView;
use super::textures::{MeshTextures, SubjectTextures, label_texture};
use super::volume::{SLAB_BYTES, assemble};
use crate::data::{Surface, Volume, Voxels};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::textures::{volume_texture, write_slices};
use crate::render::pack::values::{Normalise, SubjectInfo};
use glam::UVec3;
use half::f16;
use std::sync::Arc;

/// A volume on its way to the GPU, slab by slab.
#[derive(Debug)]
pub(crate) struct VolumeUpload {
    volume: Arc<Volume>,
    meshes: Option<Arc<MeshTextures>>,
    volume_texture: wgpu::Texture,
    label_texture: wgpu::Texture,
    next_slice: u32,
    next_label_slice: u32,
    scale: Normalise,
    bricks: BrickBuilder,
    scratch: Vec<u16>,
}

impl VolumeUpload {
    /// Makes the textures. The volume must fit ([`super::reduce::reduced_to_fit`]) and be whole.
    /// Meshes beside it are handed over at once.
    pub(crate) fn new(
        gpu: &Gpu,
        volume: &Arc<Volume>,
        meshes: Option<&Arc<Surface>>,
    ) -> Result<Self, RenderError> {
        let count = volume.grid.voxel_count();
        if volume.voxels.len() != count || count == 0 {
            return Err(RenderError::TooLarge(format!(
                "{} voxels came of {count}",
                volume.voxels.len()
            )));
        }
        let label_dims = match &volume.segmentation {
            Some(labels) if labels.labels.len() == labels.grid.voxel_count() => labels.grid.dims,
            _ => UVec3::ONE,
        };
        let meshes = meshes.map(|meshes| MeshTextures::new(gpu, meshes));
        Ok(Self {
            volume: Arc::clone(volume),
            meshes: meshes.transpose()?.map(Arc::new),
            volume_texture: volume_texture(
                gpu,
                "volume",
                volume.grid.dims,
                wgpu::TextureFormat::R16Float,
                wgpu::TextureUsages::COPY_DST,
            ),
            label_texture: label_texture(gpu, label_dims),
            next_slice: 0,
            next_label_slice: 0,
            scale: Normalise::of(volume),
            bricks: BrickBuilder::new(volume.grid.dims),
            scratch: Vec::new(),
        })
    }

    /// Fraction done, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        self.next_slice as f32 / self.volume_texture.depth_or_array_layers().max(1) as f32
    }

    /// Converts and hands over the next slab. True when all is handed over.
    pub(crate) fn advance(&mut self, gpu: &Gpu) -> bool {
        let volume = &self.volume;
        let dims = volume.grid.dims;
        let slice = dims.x as usize * dims.y as usize;
        if self.next_slice < dims.z {
            let slices =
                (SLAB_BYTES / (2 * slice).max(1)).clamp(1, (dims.z - self.next_slice) as usize);
            let start = self.next_slice as usize * slice;
            self.scratch.clear();
            convert(
                &volume.voxels,
                start,
                slices * slice,
                self.scale,
                &mut self.scratch,
            );
            for (i, z_slice) in self.scratch.chunks_exact(slice).enumerate() {
                self.bricks.add_slice(self.next_slice + i as u32, z_slice);
            }
            write_slices(
                gpu,
                &self.volume_texture,
                self.next_slice,
                slices as u32,
                2,
                bytemuck::cast_slice(&self.scratch),
            );
            self.next_slice += slices as u32;
            return false;
        }
        let depth = self.label_texture.depth_or_array_layers();
        if let Some(labels) = &volume.segmentation
            && self.next_label_slice < depth
            && labels.grid.dims.z == depth
        {
            let slice = labels.grid.dims.x as usize * labels.grid.dims.y as usize;
            let slices =
                (SLAB_BYTES / slice.max(1)).clamp(1, (depth - self.next_label_slice) as usize);
            let start = self.next_label_slice as usize * slice;
            if let Some(part) = labels.labels.get(start..start + slices * slice) {
                let at = self.next_label_slice;
                write_slices(gpu, &self.label_texture, at, slices as u32, 1, part);
            }
            self.next_label_slice += slices as u32;
            return false;
        }
        true
    }

    /// The subject, once [`VolumeUpload::advance`] said that all is handed over.
    pub(crate) fn finish(self, gpu: &Gpu, layouts: &Layouts) -> SubjectTextures {
        let volume = &self.volume;
        let labels = volume
            .segmentation
            .as_ref()
            .filter(|l| l.labels.len() == l.grid.voxel_count());
        let views = [&self.volume_texture, &self.label_texture].map(HeldView::new);
        let info = SubjectInfo::of(volume);
        assemble(
            gpu,
            layouts,
            volume,
            labels,
            (views, self.meshes.clone()),
            self.bricks.bricks,
            info,
        )
    }
}

/// Appends normalised half floats.
fn convert(voxels: &Voxels, start: usize, count: usize, scale: Normalise, out: &mut Vec<u16>) {
    fn run<T: Copy>(
        all: &[T],
        start: usize,
        count: usize,
        to: impl Fn(T) -> f32,
        out: &mut Vec<u16>,
    ) {
        let part = all.get(start..start + count).unwrap_or_default();
        out.extend(part.iter().map(|&v| f16::from_f32(to(v)).to_bits()));
    }
    match voxels {
        Voxels::U8(v) => run(v, start, count, |x| scale.apply(f32::from(x)), out),
        Voxels::I16(v) => run(v, start, count, |x| scale.apply(f32::from(x)), out),
        Voxels::U16(v) => run(v, start, count, |x| scale.apply(f32::from(x)), out),
        Voxels::F32(v) => run(v, start, count, |x| scale.apply(x), out),
    }
}
