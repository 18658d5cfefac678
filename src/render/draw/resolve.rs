use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::{Layouts, pipeline_layout};
use crate::render::device::pipelines::{PipelineParts, render_pass, render_pipeline};
use crate::render::device::programs::{ProgramId, module};
use crate::render::device::textures::OUTPUT_FORMAT;
use crate::render::pack::gpu_types::Resolve;

/// The pass from the accumulated picture (linear light) to the one that is shown (sRGB).
#[derive(Debug)]
pub(crate) struct ResolvePass(wgpu::RenderPipeline);

impl ResolvePass {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let empty = &layouts.empty;
        let groups = [empty, empty, empty, &layouts.resolve];
        let parts = PipelineParts {
            label: "resolve",
            layout: &pipeline_layout(gpu, "resolve", &groups),
            module: &module(gpu, ProgramId::Resolve, Cases::ALL),
            entry: "encode",
            constants: &[],
            formats: &[OUTPUT_FORMAT],
            blend: None,
        };
        Self(render_pipeline(gpu, &parts))
    }

    /// Adds the way from the linear picture to the shown one.
    pub(crate) fn encode(
        &self,
        gpu: &Gpu,
        layouts: &Layouts,
        encoder: &mut wgpu::CommandEncoder,
        resolve: &Resolve,
        [source, target]: [&wgpu::TextureView; 2],
        tiles: &[[u32; 4]],
    ) {
        let buffer = uniform_buffer(gpu, "resolve", resolve);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("resolve"),
            layout: &layouts.resolve,
            entries: &[
                entry(0, buffer.as_entire_binding()),
                entry(1, wgpu::BindingResource::TextureView(source)),
                entry(2, wgpu::BindingResource::Sampler(&layouts.linear_sampler)),
            ],
        });
        let mut pass = render_pass(encoder, "resolve", &[target]);
        pass.set_pipeline(&self.0);
        pass.set_bind_group(3, &group, &[]);
        for &[x, y, w, h] in tiles {
            pass.set_scissor_rect(x, y, w, h);
            pass.draw(0..3, 0..1);
        }
    }
}
