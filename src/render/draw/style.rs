//! The pass that draws an illustrator's look over a traced picture.

use super::raycast::{MEAN, blend_constant};
use super::traced::Traced;
use crate::document::Style;
use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::{Layouts, pipeline_layout};
use crate::render::device::pipelines::{PipelineParts, Pipelines, render_pass, render_pipeline};
use crate::render::device::programs::{ProgramId, module};
use crate::render::device::textures::LINEAR_FORMAT;
use crate::render::pack::style::style_uniform;
use crate::render::subject::textures::SubjectTextures;

/// The pipeline, made when a document first has a style.
#[derive(Debug, Default)]
pub(crate) struct StylePass(Pipelines<(), wgpu::RenderPipeline>);

/// One sample of a styled picture.
pub(super) struct Styled<'a> {
    /// The picture that it is mixed into, from its top left corner.
    pub target: &'a wgpu::TextureView,
    pub traced: &'a Traced,
    pub style: &'a Style,
    pub subject: &'a SubjectTextures,
    /// Width and height of the whole picture, pixels.
    pub size_px: [f32; 2],
    /// Row of the whole picture that the traced pixels begin with.
    pub first_row: u32,
    /// Bind group 0, as for the march; its first row is that of the target.
    pub frame: &'a wgpu::BindGroup,
    /// Bind group 2: the scene.
    pub scene: &'a wgpu::BindGroup,
    /// Width and height of the used part of the target, pixels.
    pub size: [u32; 2],
    /// Weight against what the target holds: 1 overwrites.
    pub weight: f32,
}

impl StylePass {
    /// Adds the way from what was traced to the picture.
    pub(super) fn encode(
        &self,
        gpu: &Gpu,
        layouts: &Layouts,
        encoder: &mut wgpu::CommandEncoder,
        styled: &Styled<'_>,
    ) {
        let pipeline = self.0.get((), || {
            let groups = [
                &layouts.frame,
                &layouts.empty,
                &layouts.scene,
                &layouts.style,
            ];
            let parts = PipelineParts {
                label: "style",
                layout: &pipeline_layout(gpu, "style", &groups),
                module: &module(gpu, ProgramId::Style, Cases::ALL),
                entry: "draw_style",
                constants: &[],
                formats: &[LINEAR_FORMAT],
                blend: Some(MEAN),
            };
            render_pipeline(gpu, &parts)
        });
        let subject = styled.subject;
        let seen = (&subject.axes, &subject.patterns, subject.frame.detail);
        let uniform = style_uniform(styled.style, styled.size_px, seen, styled.first_row);
        let buffer = uniform_buffer(gpu, "style", &uniform);
        let [color, place, surface] = styled
            .traced
            .views()
            .map(wgpu::BindingResource::TextureView);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("style"),
            layout: &layouts.style,
            entries: &[
                entry(0, buffer.as_entire_binding()),
                entry(1, color),
                entry(2, place),
                entry(3, surface),
            ],
        });
        let mut pass = render_pass(encoder, "style", &[styled.target]);
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, styled.frame, &[]);
        pass.set_bind_group(2, styled.scene, &[]);
        pass.set_bind_group(3, &group, &[]);
        pass.set_blend_constant(blend_constant(styled.weight));
        let [width, height] = styled.size.map(|side| side as f32);
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
        pass.set_scissor_rect(0, 0, styled.size[0], styled.size[1]);
        pass.draw(0..3, 0..1);
    }
}
