//! Pipelines: of drawing over a whole target and of computing, each made when it is first asked for.

use super::gpu::Gpu;
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// What a pipeline that draws over the whole target is made of.
pub(crate) struct PipelineParts<'a> {
    pub label: &'a str,
    pub layout: &'a wgpu::PipelineLayout,
    pub module: &'a wgpu::ShaderModule,
    pub entry: &'a str,
    pub constants: &'a [(&'a str, f64)],
    /// Formats of the targets, in the order of their locations.
    pub formats: &'a [wgpu::TextureFormat],
    pub blend: Option<wgpu::BlendState>,
}

/// Where corners of triangles come from, for a pipeline that draws triangles of its own.
pub(crate) struct VertexParts<'a> {
    /// The entry point that places a corner.
    pub entry: &'a str,
    /// Bytes from one corner to the next.
    pub stride: u64,
    /// What a corner holds.
    pub attributes: &'a [wgpu::VertexAttribute],
}

/// A pipeline that draws over the whole target.
pub(crate) fn render_pipeline(gpu: &Gpu, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
    render_pipeline_of(gpu, parts, None)
}

/// A pipeline that draws triangles; without corners one that covers the whole target.
pub(crate) fn render_pipeline_of(
    gpu: &Gpu,
    parts: &PipelineParts<'_>,
    corners: Option<&VertexParts<'_>>,
) -> wgpu::RenderPipeline {
    let buffers: Vec<_> = corners
        .iter()
        .map(|corners| {
            Some(wgpu::VertexBufferLayout {
                array_stride: corners.stride,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: corners.attributes,
            })
        })
        .collect();
    let options = wgpu::PipelineCompilationOptions {
        constants: parts.constants,
        ..Default::default()
    };
    let target = |format: &wgpu::TextureFormat| {
        Some(wgpu::ColorTargetState {
            format: *format,
            blend: parts.blend,
            write_mask: wgpu::ColorWrites::ALL,
        })
    };
    let targets: Vec<_> = parts.formats.iter().map(target).collect();
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(parts.label),
            layout: Some(parts.layout),
            vertex: wgpu::VertexState {
                module: parts.module,
                entry_point: Some(corners.map_or("cover", |corners| corners.entry)),
                compilation_options: options.clone(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: parts.module,
                entry_point: Some(parts.entry),
                compilation_options: options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Starts to draw over what targets hold.
pub(crate) fn render_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    targets: &[&wgpu::TextureView],
) -> wgpu::RenderPass<'e> {
    let attachments: Vec<_> = targets
        .iter()
        .map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Load,
                    store: wgpu::StoreOp::Store,
                },
            })
        })
        .collect();
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &attachments,
        ..Default::default()
    })
}

/// A pipeline for a compute entry point with values for its `override` constants; it derives its own layout.
pub(crate) fn compute_pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    entry: &str,
    constants: &[(&str, f64)],
) -> wgpu::ComputePipeline {
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants,
                ..Default::default()
            },
            cache: None,
        })
}

/// Pipelines by what they are made for: software GPUs run every branch, so each document gets programs without what
/// it does not use.
#[derive(Debug)]
pub(crate) struct Pipelines<Key, Pipeline>(Mutex<HashMap<Key, Arc<OnceLock<Pipeline>>>>);

impl<Key, Pipeline> Default for Pipelines<Key, Pipeline> {
    fn default() -> Self {
        Self(Mutex::new(HashMap::new()))
    }
}

impl<Key: Eq + Hash, Pipeline: Clone> Pipelines<Key, Pipeline> {
    /// The pipeline for a key; made on first use. Who asks for another key meanwhile does not wait.
    pub(crate) fn get(&self, key: Key, make: impl FnOnce() -> Pipeline) -> Pipeline {
        let place = Arc::clone(self.all().entry(key).or_default());
        place.get_or_init(make).clone()
    }

    /// The pipeline for a key, if it was made before.
    pub(crate) fn made(&self, key: &Key) -> Option<Pipeline> {
        self.all().get(key).and_then(|place| place.get().cloned())
    }

    fn all(&self) -> MutexGuard<'_, HashMap<Key, Arc<OnceLock<Pipeline>>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
