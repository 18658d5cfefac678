//! Sampled displacements on the GPU.

use crate::data::{FieldSamples, Resources};
use crate::document::{MAX_FIELDS, PlacedTemplate};
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::volume_texture;
use crate::render::pack::stamps::{MadeFrom, Stamp, Stamped};
use glam::UVec3;

/// Samples of the fields that act, in their order, as far as they are there: as many as are drawn.
pub(crate) fn acting_fields(
    templates: &[PlacedTemplate],
    resources: &Resources,
) -> Vec<FieldSamples> {
    let acting = templates.iter().filter(|t| t.acting().enabled);
    let samples = acting.filter_map(|template| resources.field(template).cloned());
    samples.take(MAX_FIELDS).collect()
}

/// The samples of all fields of a document on the GPU, one behind the other along z.
#[derive(Debug)]
pub(crate) struct FieldTexture {
    /// Group 2, binding 7.
    pub view: wgpu::TextureView,
    /// Stamp of the texture.
    pub stamp: Stamp,
    made_from: MadeFrom<1>,
}

impl FieldTexture {
    /// The texture of a document without fields.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self::of(gpu, &[])
    }

    /// Takes over the fields that act; they are on their way to the GPU when this returns.
    pub(crate) fn update(&mut self, gpu: &Gpu, fields: &Stamped<Vec<FieldSamples>>) {
        if self.made_from.is_stale([fields.stamp()]) {
            self.view = texture_of(gpu, fields.get());
            self.stamp += 1;
        }
    }

    /// The texture of these fields, for a single use.
    pub(crate) fn of(gpu: &Gpu, samples: &[FieldSamples]) -> Self {
        Self {
            view: texture_of(gpu, samples),
            stamp: 0,
            made_from: MadeFrom::default(),
        }
    }
}

fn texture_of(gpu: &Gpu, samples: &[FieldSamples]) -> wgpu::TextureView {
    let mut size = [1, 1, 0];
    for FieldSamples(field) in samples {
        size[0] = size[0].max(field.dims[0]);
        size[1] = size[1].max(field.dims[1]);
        size[2] += field.dims[2];
    }
    let format = wgpu::TextureFormat::Rgba16Float;
    let usage = wgpu::TextureUsages::COPY_DST;
    // Of no field, there is a texture all the same.
    let size = UVec3::from(size).max(UVec3::ONE);
    let texture = volume_texture(gpu, "fields", size, format, usage);
    let mut z = 0;
    for FieldSamples(field) in samples {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                origin: wgpu::Origin3d { x: 0, y: 0, z },
                ..texture.as_image_copy()
            },
            bytemuck::cast_slice(&field.texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(8 * field.dims[0]),
                rows_per_image: Some(field.dims[1]),
            },
            wgpu::Extent3d {
                width: field.dims[0],
                height: field.dims[1],
                depth_or_array_layers: field.dims[2],
            },
        );
        z += field.dims[2];
    }
    texture.create_view(&Default::default())
}
