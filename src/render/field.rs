use super::Gpu;
use super::subject::volume_texture;
use crate::document::{FieldSamples, MAX_FIELDS, PlacedTemplate, TemplateData};
use glam::UVec3;

/// Samples of the fields that act, in their order, as far as they are there: as many as are drawn.
pub(super) fn acting_fields<'a>(
    templates: impl Iterator<Item = &'a PlacedTemplate>,
) -> Vec<FieldSamples> {
    let samples = templates.filter_map(|template| match &template.data {
        TemplateData::Field(field) => field.samples.clone(),
        _ => None,
    });
    samples.take(MAX_FIELDS).collect()
}

/// The samples of all fields of a document on the GPU, one behind the other along z. Built when a field comes or goes.
#[derive(Debug)]
pub(super) struct FieldTexture {
    /// Group 2, binding 7.
    pub(super) view: wgpu::TextureView,
    samples: Vec<FieldSamples>,
}

impl FieldTexture {
    /// Of no field.
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self::of(gpu, Vec::new())
    }

    /// Of these templates; `None` if it would be the same.
    pub(super) fn update(&self, gpu: &Gpu, placed: &[PlacedTemplate]) -> Option<Self> {
        let samples = acting_fields(placed.iter().filter(|t| t.acting().enabled));
        (samples != self.samples).then(|| Self::of(gpu, samples))
    }

    fn of(gpu: &Gpu, samples: Vec<FieldSamples>) -> Self {
        let mut size = [1, 1, 0];
        for FieldSamples(field) in &samples {
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
        for FieldSamples(field) in &samples {
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
        Self {
            view: texture.create_view(&Default::default()),
            samples,
        }
    }
}
