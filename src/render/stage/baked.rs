//! The composed map of a list of templates as a texture, for pictures while the camera moves.

use crate::math::Aabb;
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::pipelines::{Pipelines, compute_pipeline};
use crate::render::device::programs::{ProgramId, module};
use crate::render::device::textures::{read_half_texels, volume_texture};
use crate::render::pack::gpu_types::Baked;
use crate::render::stage::held::HeldTextures;
use glam::{UVec3, Vec3};

/// Format of the baked map. Halves: 0.0002 subject units at a displacement of a quarter.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Texels along the longest axis.
const TEXELS_HARDWARE: u32 = 128;
const TEXELS_SOFTWARE: u32 = 96;

/// Texels along the longest axis at most: 256 MiB.
const MOST_TEXELS: u32 = 320;

/// Offset of finite differences, texels: between texels the map is a straight line, so less would show its facets.
const DIFFERENCE_TEXELS: f32 = 0.75;

/// The compute program that samples the composed map.
#[derive(Debug, Default)]
pub(crate) struct BakePrograms {
    /// By the kinds that occur: software GPUs run every branch.
    pipelines: Pipelines<u32, wgpu::ComputePipeline>,
}

impl BakePrograms {
    fn pipeline(&self, gpu: &Gpu, drawn_kinds: u32) -> wgpu::ComputePipeline {
        let constants = [("drawn_kinds", f64::from(drawn_kinds))];
        self.pipelines.get(drawn_kinds, || {
            let module = module(gpu, ProgramId::Bake, Cases::of_kinds(drawn_kinds));
            compute_pipeline(gpu, &module, "bake", &constants)
        })
    }
}

/// The composed map of one list of templates as a texture over the deformed object, made slab by slab.
#[derive(Debug)]
pub(crate) struct BakedTexture {
    place: Baked,
    uniform: wgpu::Buffer,
    texture: wgpu::Texture,
    /// Group 3 of the ray march.
    pub group: wgpu::BindGroup,
}

impl BakedTexture {
    /// Gives its memory back to the device.
    pub(crate) fn destroy(&self) {
        self.uniform.destroy();
        self.texture.destroy();
    }

    /// Over a box of the deformed object, with so many texels along its longest side (as many as suit the device if
    /// `None`, and no fewer than `least`); holds nothing until [`BakedTexture::advance`] has made all slabs.
    pub(crate) fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        bounds: Aabb,
        texels_along: Option<u32>,
        least: u32,
    ) -> Self {
        let usual = if gpu.is_software() {
            TEXELS_SOFTWARE
        } else {
            TEXELS_HARDWARE
        };
        let along = texels_along.unwrap_or(usual.max(least));
        let limit = gpu
            .device
            .limits()
            .max_texture_dimension_3d
            .min(MOST_TEXELS);
        let along = along.clamp(2, limit) as f32;
        let size = bounds.size().max(Vec3::splat(1e-3));
        let edge = size.max_element() / along;
        let texels = (size / edge)
            .ceil()
            .clamp(Vec3::splat(2.0), Vec3::splat(along));
        let [width, height, depth] = texels.as_uvec3().to_array();
        let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let format = FORMAT;
        let texture = volume_texture(gpu, "baked map", texels.as_uvec3(), format, usage);
        let place = Baked {
            origin_min: bounds.min.extend(0.0).to_array(),
            per_unit: size.recip().extend(0.0).to_array(),
            texels: [width, height, depth, 0],
            map_step: DIFFERENCE_TEXELS * edge,
            first_slab: 0,
            padding: [0; 2],
        };
        let uniform = uniform_buffer(gpu, "baked map", &place);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("baked map"),
            layout: &layouts.baked,
            entries: &[
                entry(0, uniform.as_entire_binding()),
                entry(
                    1,
                    wgpu::BindingResource::TextureView(&texture.create_view(&Default::default())),
                ),
            ],
        });
        Self {
            place,
            uniform,
            texture,
            group,
        }
    }

    /// All slabs are made, or on their way on the GPU.
    pub(crate) fn is_whole(&self) -> bool {
        self.place.first_slab >= self.place.texels[2]
    }

    /// Hands the GPU about so many texels more, at least four slabs; says how many.
    pub(crate) fn advance(
        &mut self,
        gpu: &Gpu,
        programs: &BakePrograms,
        (templates, held): (&wgpu::Buffer, &HeldTextures),
        drawn_kinds: u32,
        most_texels: u32,
    ) -> u32 {
        let [width, height, depth, _] = self.place.texels;
        let first = self.place.first_slab;
        let per_layer = width * height;
        let groups = (most_texels / per_layer / 4)
            .max(1)
            .min(depth.saturating_sub(first).div_ceil(4));
        if groups == 0 {
            return 0;
        }
        gpu.queue
            .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&self.place));
        let pipeline = programs.pipeline(gpu, drawn_kinds);
        let bind = |group: u32, entries: &[wgpu::BindGroupEntry<'_>]| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("bake"),
                layout: &pipeline.get_bind_group_layout(group),
                entries,
            })
        };
        let mut entries = vec![entry(0, templates.as_entire_binding())];
        entries.extend(held.entries());
        let of_templates = bind(2, &entries);
        let of_pass = bind(
            3,
            &[
                entry(0, self.uniform.as_entire_binding()),
                entry(
                    1,
                    wgpu::BindingResource::TextureView(
                        &self.texture.create_view(&Default::default()),
                    ),
                ),
            ],
        );
        let mut encoder = encoder(gpu);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("bake"),
                timestamp_writes: None,
            });
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(2, &of_templates, &[]);
            pass.set_bind_group(3, &of_pass, &[]);
            pass.dispatch_workgroups(width.div_ceil(4), height.div_ceil(4), groups);
        }
        gpu.queue.submit([encoder.finish()]);
        self.place.first_slab = first + 4 * groups;
        4 * groups * per_layer
    }

    /// Copies the baked map to main memory.
    pub(crate) async fn read(&self, gpu: &Gpu) -> Result<BakedMap, RenderError> {
        let [width, height, depth, _] = self.place.texels;
        let values = read_half_texels(gpu, &self.texture).await?;
        Ok(BakedMap {
            origin_min: Vec3::from_slice(&self.place.origin_min[..3]),
            size: Vec3::from_slice(&self.place.per_unit[..3]).recip(),
            texels: UVec3::new(width, height, depth),
            values,
        })
    }
}

/// A baked map, read back: for tests and whoever wants to know how far it is from the exact one.
#[derive(Clone, Debug)]
pub struct BakedMap {
    /// Lowest corner, subject space.
    pub origin_min: Vec3,
    /// Sides of the box, subject units.
    pub size: Vec3,
    /// Texels along each axis; the first lies half a texel inside.
    pub texels: UVec3,
    /// xyz: from a point of the deformed object to where it was, subject units; w: continuity, -1 to 1. x fastest.
    pub values: Vec<[f32; 4]>,
}

impl BakedMap {
    /// As the ray march reads it, interpolated; `None` outside the box.
    pub fn at(&self, pos: Vec3) -> Option<[f32; 4]> {
        let place = (pos - self.origin_min) / self.size;
        if !(place.cmpge(Vec3::ZERO).all() && place.cmple(Vec3::ONE).all()) {
            return None;
        }
        let last = self.texels - 1;
        let at = (place * self.texels.as_vec3() - 0.5).clamp(Vec3::ZERO, last.as_vec3());
        let low = at.floor().as_uvec3().min(last.saturating_sub(UVec3::ONE));
        let part = at - low.as_vec3();
        let mut sum = [0.0; 4];
        for corner in 0..8u32 {
            let step = UVec3::new(corner & 1, (corner >> 1) & 1, corner >> 2);
            let [x, y, z] = (low + step).to_array();
            let weights = Vec3::select(step.cmpeq(UVec3::ONE), part, 1.0 - part);
            let weight = weights.element_product();
            let index = x + self.texels.x * (y + self.texels.y * z);
            for (sum, value) in sum.iter_mut().zip(self.values.get(index as usize)?) {
                *sum += weight * value;
            }
        }
        Some(sum)
    }
}
