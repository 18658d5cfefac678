//! Rigid motions of segments that move as a whole, found on the GPU after each change of a template.

use super::feature::FeatureTextures;
use super::gpu_types::{Features, MAX_TEMPLATES};
use super::programs::module;
use super::subject::{SubjectTextures, entry};
use super::{Gpu, RenderError, result_buffer};
use std::collections::HashMap;
use std::mem::offset_of;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Bytes of the motions of all groups.
const BYTES: u64 = 48 * MAX_TEMPLATES as u64;

/// The program, compiled when the first document asks for it; one pipeline per set of template kinds.
#[derive(Debug, Default)]
pub(super) struct RigidPasses {
    module: OnceLock<wgpu::ShaderModule>,
    pipelines: Mutex<HashMap<u32, wgpu::ComputePipeline>>,
}

impl RigidPasses {
    fn pipeline(&self, gpu: &Gpu, kinds: u32) -> Result<wgpu::ComputePipeline, RenderError> {
        if self.module.get().is_none() {
            let _set_already = self.module.set(module(gpu, "rigid")?);
        }
        let mut made = self
            .pipelines
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let pipeline = made.entry(kinds).or_insert_with(|| {
            gpu.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some("rigid"),
                    layout: None,
                    module: self.module.wait(),
                    entry_point: Some("fit"),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &[("drawn_kinds", f64::from(kinds))],
                        ..Default::default()
                    },
                    cache: None,
                })
        });
        Ok(pipeline.clone())
    }

    /// Finds the motions and writes them behind the other features. On its way to the GPU when this returns; nothing is read back.
    pub(super) fn make(
        &self,
        gpu: &Gpu,
        kinds: u32,
        subject: &SubjectTextures,
        templates: &wgpu::Buffer,
        features: &FeatureTextures,
        fields: &wgpu::TextureView,
    ) -> Result<(), RenderError> {
        let pipeline = self.pipeline(gpu, kinds)?;
        let motions = result_buffer(gpu, "rigid motions", BYTES);
        let view = wgpu::BindingResource::TextureView;
        let groups = [
            vec![
                entry(0, subject.buffer.as_entire_binding()),
                entry(2, wgpu::BindingResource::Sampler(&subject.sampler)),
                entry(3, view(&subject.label_view)),
            ],
            vec![
                entry(0, templates.as_entire_binding()),
                entry(5, features.uniform.as_entire_binding()),
                entry(6, view(&features.view)),
                entry(7, view(fields)),
            ],
            vec![entry(0, motions.as_entire_binding())],
        ];
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            for (i, entries) in groups.iter().enumerate() {
                let index = i as u32 + 1;
                let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("rigid"),
                    layout: &pipeline.get_bind_group_layout(index),
                    entries,
                });
                pass.set_bind_group(index, &group, &[]);
            }
            pass.dispatch_workgroups(MAX_TEMPLATES as u32, 1, 1);
        }
        let offset = offset_of!(Features, motions) as u64;
        encoder.copy_buffer_to_buffer(&motions, 0, &features.uniform, offset, BYTES);
        gpu.queue.submit([encoder.finish()]);
        Ok(())
    }
}
