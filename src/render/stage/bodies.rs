//! Segments that are drawn as bodies of their own, on the GPU: solid, see-through or hidden, whatever their values say.

use super::body_bricks::fillings;
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::{storage_buffer, uniform_buffer};
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::compute_pipeline;
use crate::render::device::programs::{ProgramId, module};
use crate::render::device::textures::volume_texture;
use crate::render::pack::gpu_types::{BODY_BRICK, BODY_NOTHING, BODY_ROW, Bodies};
use crate::render::pack::stamps::{MadeFrom, Stamp, Stamped};
use crate::render::subject::bricks::LabelSet;
use crate::render::subject::textures::SubjectTextures;
use glam::UVec3;
use std::sync::OnceLock;

/// Voxels of the shares at most, four bytes each: labels on a finer grid are read every second or third voxel. Of each
/// axis there are fewer than 1024 bricks then, as no texture is longer than 2048 texels.
const MOST_VOXELS: u64 = 1 << 25;

/// The compute program that shares places out to bodies; compiled when the first document draws any.
#[derive(Debug, Default)]
pub(crate) struct BodyProgram(OnceLock<wgpu::ComputePipeline>);

impl BodyProgram {
    fn get(&self, gpu: &Gpu) -> &wgpu::ComputePipeline {
        self.0.get_or_init(|| {
            let module = module(gpu, ProgramId::Bodies, Cases::ALL);
            compute_pipeline(gpu, &module, "share_bodies", &[])
        })
    }
}

/// Bindings 8 and 9 of the scene.
#[derive(Debug)]
pub(crate) struct BodyTextures {
    pub uniform: wgpu::Buffer,
    pub view: wgpu::TextureView,
    /// Stamp of the texture.
    pub stamp: Stamp,
    dims: UVec3,
    /// Which of its bricks hold shares; the others are zero.
    is_written: Vec<bool>,
    /// What fills the bricks, and the stamp of the subject and the labels of bodies that it was found for: another
    /// opacity or colour of a body leaves it.
    filled: Option<(Stamp, LabelSet, Vec<u32>)>,
    made_from: MadeFrom<2>,
}

impl BodyTextures {
    /// Textures that draw no segment as a body.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            uniform: uniform_buffer(gpu, "bodies", &Bodies::NONE),
            view: texture_of(gpu, UVec3::ONE),
            stamp: 0,
            dims: UVec3::ONE,
            is_written: Vec::new(),
            filled: None,
            made_from: MadeFrom::default(),
        }
    }

    /// Takes over which segments are bodies. The work is on its way to the GPU when this returns.
    pub(crate) fn update(
        &mut self,
        gpu: &Gpu,
        program: &BodyProgram,
        subject: &SubjectTextures,
        bodies: &Stamped<Bodies>,
    ) {
        if self.made_from.is_stale([subject.stamp, bodies.stamp()]) {
            gpu.queue
                .write_buffer(&self.uniform, 0, bytemuck::bytes_of(bodies.get()));
            if bodies.get().is_any() {
                self.make(gpu, program.get(gpu), subject, bodies.get());
            }
        }
    }

    fn make(
        &mut self,
        gpu: &Gpu,
        pipeline: &wgpu::ComputePipeline,
        subject: &SubjectTextures,
        bodies: &Bodies,
    ) {
        let [x, y, z, _] = subject.uniform.label_dims.map(|n| n as u32);
        let fine = UVec3::new(x, y, z).max(UVec3::ONE);
        let dims = (1..)
            .map(|factor| fine.map(|n| n.div_ceil(factor)))
            .find(|dims| dims.as_u64vec3().element_product() <= MOST_VOXELS)
            .unwrap_or(UVec3::ONE);
        if self.dims != dims {
            self.view = texture_of(gpu, dims);
            self.stamp += 1;
            self.dims = dims;
            self.is_written.clear();
        }
        let bricks = self.bricks_to_write(subject, [fine, dims], bodies);
        if bricks.is_empty() {
            return;
        }
        let list = storage_buffer(gpu, "bricks of bodies", &bricks);
        let device = &gpu.device;
        let group = |index, entries: &[wgpu::BindGroupEntry<'_>]| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("bodies"),
                layout: &pipeline.get_bind_group_layout(index),
                entries,
            })
        };
        let shares = group(
            3,
            &[
                entry(0, self.uniform.as_entire_binding()),
                entry(1, wgpu::BindingResource::TextureView(&self.view)),
                entry(2, list.as_entire_binding()),
            ],
        );
        let labels = group(
            1,
            &[
                entry(0, subject.buffer.as_entire_binding()),
                entry(3, wgpu::BindingResource::TextureView(&subject.label_view)),
            ],
        );
        let mut encoder = encoder(gpu);
        {
            let mut work = encoder.begin_compute_pass(&Default::default());
            work.set_pipeline(pipeline);
            work.set_bind_group(1, &labels, &[]);
            work.set_bind_group(3, &shares, &[]);
            let number = bricks.len() as u32;
            work.dispatch_workgroups(number.min(BODY_ROW), number.div_ceil(BODY_ROW), 1);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Bricks with shares, and those that had some and have none any more, as the shader takes them: where they lie and
    /// what fills them.
    fn bricks_to_write(
        &mut self,
        subject: &SubjectTextures,
        [labels, shares]: [UVec3; 2],
        bodies: &Bodies,
    ) -> Vec<[u32; 2]> {
        let drawn = bodies.labels();
        let found_before = self.filled.take();
        let is_same =
            |filled: &(Stamp, LabelSet, Vec<u32>)| (filled.0, filled.1) == (subject.stamp, drawn);
        let (.., fillings) = self
            .filled
            .insert(found_before.filter(is_same).unwrap_or_else(|| {
                let sets = subject.label_bricks.as_deref();
                (
                    subject.stamp,
                    drawn,
                    fillings(sets, [labels, shares], &drawn),
                )
            }));
        self.is_written.resize(fillings.len(), false);
        let dims = shares.map(|n| n.div_ceil(BODY_BRICK));
        let mut bricks = Vec::new();
        for (i, (&filling, was_written)) in (0..).zip(fillings.iter().zip(&mut self.is_written)) {
            let has_any = filling != BODY_NOTHING;
            if std::mem::replace(was_written, has_any) || has_any {
                let (x, y, z) = (i % dims.x, i / dims.x % dims.y, i / (dims.x * dims.y));
                bricks.push([x | y << 10 | z << 20, filling]);
            }
        }
        bricks
    }
}

fn texture_of(gpu: &Gpu, dims: UVec3) -> wgpu::TextureView {
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let usage = wgpu::TextureUsages::STORAGE_BINDING;
    volume_texture(gpu, "bodies", dims, format, usage).create_view(&Default::default())
}
