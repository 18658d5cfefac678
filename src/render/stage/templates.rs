//! The templates of a document on the GPU.

use crate::render::device::buffers::uniform_buffer;
use crate::render::device::gpu::Gpu;
use crate::render::pack::gpu_types::Templates;
use crate::render::pack::stamps::{MadeFrom, Stamped};

/// The uniform of the templates that act.
#[derive(Debug)]
pub(crate) struct TemplateBuffer {
    /// Group 2, binding 0.
    pub uniform: wgpu::Buffer,
    made_from: MadeFrom<1>,
}

impl TemplateBuffer {
    /// The buffer of a document without templates.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            uniform: uniform_buffer(gpu, "templates", &Templates::NONE),
            made_from: MadeFrom::default(),
        }
    }

    /// Takes over the templates.
    pub(crate) fn update(&mut self, gpu: &Gpu, templates: &Stamped<Templates>) {
        if self.made_from.is_stale([templates.stamp()]) {
            gpu.queue
                .write_buffer(&self.uniform, 0, bytemuck::bytes_of(templates.get()));
        }
    }
}
