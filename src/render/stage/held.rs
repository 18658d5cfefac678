//! What templates hold besides numbers, on the GPU: sampled displacements, the grids of objects that carve, the steps
//! of sweeps.

use std::sync::Arc;

use crate::data::{Carver, DistanceGrid, FieldSamples, Resources};
use crate::document::{MAX_FIELDS, PlacedTemplate};
use crate::render::device::bindings::entry;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::{volume_texture, write_slices};
use crate::render::pack::gpu_types::{acting_carvers, acting_sweeps};
use crate::render::pack::laid::Laid;
use crate::render::pack::stamps::{MadeFrom, Stamp, Stamped};
use crate::render::subject::textures::flat_texture;
use glam::UVec3;

/// Texels in a row of the texture of grids, as in shaders/displace/carve.wgsl.
const CARVER_ROW: usize = 4096;
/// Texels in a row of the texture of sweeps, as in shaders/displace/tools.wgsl.
const SWEEP_ROW: usize = 1024;

/// What the templates that act hold, as far as it is there.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldData {
    /// Samples of fields, in the order of the templates, as many as are drawn.
    fields: Vec<FieldSamples>,
    /// Grids of objects, each once, in the order in which templates first carve by them.
    carvers: Vec<Arc<Carver>>,
    /// Grids of the tools of sweeps.
    grids: Laid,
    /// Steps of sweeps, in the order of the templates.
    sweeps: Vec<[f32; 4]>,
}

/// Two are equal if they share their data in memory.
impl PartialEq for HeldData {
    fn eq(&self, other: &Self) -> bool {
        self.sweeps == other.sweeps && self.grids == other.grids && self.has_files_of(other)
    }
}

impl HeldData {
    /// True if both share their fields and grids in memory.
    fn has_files_of(&self, other: &Self) -> bool {
        let pairs = self.carvers.iter().zip(&other.carvers);
        self.fields == other.fields
            && self.carvers.len() == other.carvers.len()
            && pairs.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
    }

    /// What the templates of a document hold.
    pub(crate) fn of(templates: &[PlacedTemplate], resources: &Resources) -> Self {
        let acting = templates.iter().filter(|t| t.acting().enabled);
        let samples = acting.filter_map(|template| resources.field(template).cloned());
        Self {
            fields: samples.take(MAX_FIELDS).collect(),
            carvers: acting_carvers(templates, resources),
            grids: Laid::of(templates, resources),
            sweeps: acting_sweeps(templates, resources),
        }
    }
}

/// The textures of what templates hold.
#[derive(Debug)]
pub(crate) struct HeldTextures {
    /// Group 2, binding 7: the samples of all fields, one behind the other along z.
    fields: wgpu::TextureView,
    /// Group 2, binding 13: the nodes of all grids, one behind the other.
    carvers: wgpu::TextureView,
    /// Group 2, binding 15: the grids of tools, and the steps of all sweeps, one behind the other.
    sweeps: wgpu::TextureView,
    /// Stamp of the textures.
    pub stamp: Stamp,
    made_from: MadeFrom<1>,
    /// What they were made of.
    made_of: HeldData,
}

impl HeldTextures {
    /// The textures of a document whose templates hold nothing.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self::of(gpu, &HeldData::default())
    }

    /// Takes over what templates hold; it is on its way to the GPU when this returns.
    pub(crate) fn update(&mut self, gpu: &Gpu, held: &Stamped<HeldData>) {
        if self.made_from.is_stale([held.stamp()]) {
            let new = held.get();
            // A path that is dragged uploads no file again.
            if !self.made_of.has_files_of(new) {
                self.fields.texture().destroy();
                self.carvers.texture().destroy();
                self.fields = fields_of(gpu, &new.fields);
                self.carvers = carvers_of(gpu, &new.carvers);
            }
            if self.made_of.sweeps != new.sweeps || self.made_of.grids != new.grids {
                self.sweeps.texture().destroy();
                self.sweeps = sweeps_of(gpu, new);
            }
            self.made_of = new.clone();
            self.stamp += 1;
        }
    }

    /// The textures of this, for a single use.
    pub(crate) fn of(gpu: &Gpu, held: &HeldData) -> Self {
        Self {
            fields: fields_of(gpu, &held.fields),
            carvers: carvers_of(gpu, &held.carvers),
            sweeps: sweeps_of(gpu, held),
            stamp: 0,
            made_from: MadeFrom::default(),
            made_of: held.clone(),
        }
    }

    /// All textures as entries of group 2, of every program that displaces.
    pub(crate) fn entries(&self) -> [wgpu::BindGroupEntry<'_>; 3] {
        let view = wgpu::BindingResource::TextureView;
        [
            entry(7, view(&self.fields)),
            entry(13, view(&self.carvers)),
            entry(15, view(&self.sweeps)),
        ]
    }

    /// Gives the memory back to the device.
    pub(crate) fn destroy(&self) {
        self.fields.texture().destroy();
        self.carvers.texture().destroy();
        self.sweeps.texture().destroy();
    }
}

fn fields_of(gpu: &Gpu, samples: &[FieldSamples]) -> wgpu::TextureView {
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

fn carvers_of(gpu: &Gpu, carvers: &[Arc<Carver>]) -> wgpu::TextureView {
    let mut texels: Vec<u32> = Vec::new();
    for carver in carvers {
        texels.extend(&carver.texels);
    }
    let width = if texels.is_empty() { 1 } else { CARVER_ROW };
    texels.resize(texels.len().next_multiple_of(width).max(1), 0);
    let size = [width as u32, (texels.len() / width) as u32];
    let texture = flat_texture(gpu, "carvers", size, wgpu::TextureFormat::R32Uint);
    write_slices(gpu, &texture, 0, 1, 4, bytemuck::cast_slice(&texels));
    texture.create_view(&Default::default())
}

fn sweeps_of(gpu: &Gpu, held: &HeldData) -> wgpu::TextureView {
    let mut texels: Vec<[f32; 4]> = held.grids.grids().flat_map(DistanceGrid::texels).collect();
    texels.extend(&held.sweeps);
    let width = if texels.is_empty() { 1 } else { SWEEP_ROW };
    texels.resize(texels.len().next_multiple_of(width).max(1), [0.0; 4]);
    let size = [width as u32, (texels.len() / width) as u32];
    let texture = flat_texture(gpu, "sweeps", size, wgpu::TextureFormat::Rgba32Float);
    write_slices(gpu, &texture, 0, 1, 16, bytemuck::cast_slice(&texels));
    texture.create_view(&Default::default())
}
