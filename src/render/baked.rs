use super::gpu_types::Baked;
use super::passes::uniform;
use super::programs::module;
use super::subject::{entry, volume_texture};
use super::{Gpu, Readback, RenderError, uniform_buffer};
use crate::math::Aabb;
use glam::{UVec3, Vec3};
use half::f16;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Format of the baked map. Halves: 0.0002 subject units at a displacement of a quarter.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Texels along the longest axis.
const TEXELS_HARDWARE: u32 = 128;
const TEXELS_SOFTWARE: u32 = 96;
/// Texels along the longest axis at most: 256 MiB.
const MOST_TEXELS: u32 = 320;
/// Offset of finite differences, texels: between texels the map is a straight line, so less would show its facets.
const DIFFERENCE_TEXELS: f32 = 0.75;

/// The baking program and what the ray march is told about its layout.
#[derive(Debug)]
pub(super) struct BakePasses {
    module: wgpu::ShaderModule,
    /// Group 3 of the ray march.
    pub layout: wgpu::BindGroupLayout,
    /// By the kinds that occur: software GPUs run every branch.
    pipelines: Mutex<HashMap<u32, Arc<wgpu::ComputePipeline>>>,
}

impl BakePasses {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        Ok(Self {
            module: module(gpu, "bake")?,
            layout: gpu
                .device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                    label: Some("baked"),
                    entries: &[
                        uniform(0),
                        wgpu::BindGroupLayoutEntry {
                            binding: 1,
                            visibility: wgpu::ShaderStages::FRAGMENT,
                            ty: wgpu::BindingType::Texture {
                                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                                view_dimension: wgpu::TextureViewDimension::D3,
                                multisampled: false,
                            },
                            count: None,
                        },
                    ],
                }),
            pipelines: Mutex::new(HashMap::new()),
        })
    }

    fn pipeline(&self, gpu: &Gpu, drawn_kinds: u32) -> Arc<wgpu::ComputePipeline> {
        let mut made = self
            .pipelines
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let made = made.entry(drawn_kinds).or_insert_with(|| {
            Arc::new(
                gpu.device
                    .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                        label: Some("bake"),
                        layout: None,
                        module: &self.module,
                        entry_point: Some("bake"),
                        compilation_options: wgpu::PipelineCompilationOptions {
                            constants: &[("drawn_kinds", f64::from(drawn_kinds))],
                            ..Default::default()
                        },
                        cache: None,
                    }),
            )
        });
        Arc::clone(made)
    }
}

/// The composed map of one list of templates as a texture over the deformed object, made slab by slab.
#[derive(Debug)]
pub(super) struct BakedTexture {
    place: Baked,
    uniform: wgpu::Buffer,
    texture: wgpu::Texture,
    /// Group 3 of the ray march.
    pub group: wgpu::BindGroup,
}

impl BakedTexture {
    /// Over a box of the deformed object, with so many texels along its longest side (as many as suit the device if
    /// `None`); holds nothing until [`BakedTexture::advance`] has made all slabs.
    pub(super) fn new(
        gpu: &Gpu,
        passes: &BakePasses,
        bounds: Aabb,
        texels_along: Option<u32>,
    ) -> Self {
        let along = texels_along.unwrap_or(if gpu.is_software() {
            TEXELS_SOFTWARE
        } else {
            TEXELS_HARDWARE
        });
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
            origin_min: bounds.min.extend(DIFFERENCE_TEXELS * edge).to_array(),
            per_unit: size.recip().extend(0.0).to_array(),
            texels: [width, height, depth, 0],
        };
        let uniform = uniform_buffer(gpu, "baked map", &place);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("baked map"),
            layout: &passes.layout,
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
    pub(super) fn is_whole(&self) -> bool {
        self.place.texels[3] >= self.place.texels[2]
    }

    /// Hands the GPU about so many texels more, at least four slabs; says how many.
    pub(super) fn advance(
        &mut self,
        gpu: &Gpu,
        passes: &BakePasses,
        [templates, fields]: [wgpu::BindingResource<'_>; 2],
        drawn_kinds: u32,
        most_texels: u32,
    ) -> u32 {
        let [width, height, depth, first] = self.place.texels;
        let per_layer = width * height;
        let groups = (most_texels / per_layer / 4)
            .max(1)
            .min(depth.saturating_sub(first).div_ceil(4));
        if groups == 0 {
            return 0;
        }
        gpu.queue
            .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&self.place));
        let pipeline = passes.pipeline(gpu, drawn_kinds);
        let bind = |group: u32, entries: &[wgpu::BindGroupEntry<'_>]| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("bake"),
                layout: &pipeline.get_bind_group_layout(group),
                entries,
            })
        };
        let of_templates = bind(2, &[entry(0, templates), entry(7, fields)]);
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
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
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
        self.place.texels[3] = first + 4 * groups;
        4 * groups * per_layer
    }

    /// Reads it back.
    pub(super) async fn read(&self, gpu: &Gpu) -> Result<BakedMap, RenderError> {
        let [width, height, depth, _] = self.place.texels;
        let pitch = (8 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("baked map"),
            size: u64::from(pitch) * u64::from(height) * u64::from(depth),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(pitch),
                    rows_per_image: Some(height),
                },
            },
            self.texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        let bytes = Readback::start(gpu, buffer).await?;
        let values = bytes
            .chunks_exact(pitch as usize)
            .flat_map(|row| row.chunks_exact(8).take(width as usize))
            .map(|texel| {
                [0, 2, 4, 6].map(|i| match texel.get(i..i + 2) {
                    Some(&[low, high]) => f16::from_le_bytes([low, high]).to_f32(),
                    _ => 0.0,
                })
            })
            .collect();
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
