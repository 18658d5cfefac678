//! The pass that draws a bent figure.

use super::raycast::{MEAN, blend_constant};
use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::{Layouts, pipeline_layout};
use crate::render::device::pipelines::{
    PipelineParts, Pipelines, VertexParts, render_pass, render_pipeline, render_pipeline_of,
};
use crate::render::device::programs::{ProgramId, module};
use crate::render::device::textures::{LINEAR_FORMAT, Target};
use crate::render::pack::gpu_types::{Sheet, SheetCorner};
use crate::render::stage::sheet::SheetBuffers;
use crate::render::subject::plate::PlateTexture;

/// The pipelines: that of the triangles, and that of what they come to. Made when a figure is first drawn.
#[derive(Debug, Default)]
pub(crate) struct SheetPass(Pipelines<(), [wgpu::RenderPipeline; 2]>);

/// One sample of a figure.
pub(super) struct DrawnSheet<'a> {
    /// The picture that it is mixed into, from its top left corner.
    pub target: &'a wgpu::TextureView,
    /// The triangles; none before it is known how the figure is bent.
    pub buffers: Option<&'a SheetBuffers>,
    pub plate: &'a PlateTexture,
    /// Bind group 0, as for the march.
    pub frame: &'a wgpu::BindGroup,
    /// Width and height of the used part of the target, pixels.
    pub size: [u32; 2],
    /// Parts of the target that are drawn: left, top, width, height.
    pub tiles: &'a [[u32; 4]],
    /// Weight against what the target holds: 1 overwrites.
    pub weight: f32,
}

/// Of premultiplied colours the nearer over the farther.
const OVER: wgpu::BlendState = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;

impl SheetPass {
    /// Adds the drawing of a sample. `layer` is as large as the used part of the target.
    pub(super) fn encode(
        &self,
        gpu: &Gpu,
        layouts: &Layouts,
        encoder: &mut wgpu::CommandEncoder,
        layer: &Target,
        drawn: &DrawnSheet<'_>,
    ) {
        let [triangles, lay] = self.0.get((), || pipelines(gpu, layouts));
        let plate = drawn.plate;
        let uniform = Sheet {
            half_size: plate.half_size,
            texels: plate.texels.map(|side| side as f32),
            viewport: drawn.size.map(|side| side as f32),
            levels: plate.levels,
            padding: 0,
        };
        let buffer = uniform_buffer(gpu, "sheet", &uniform);
        let group = |view: &wgpu::TextureView| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("sheet"),
                layout: &layouts.sheet,
                entries: &[
                    entry(0, buffer.as_entire_binding()),
                    entry(1, wgpu::BindingResource::TextureView(view)),
                ],
            })
        };
        let [width, height] = drawn.size.map(|side| side as f32);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("sheet"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &layer.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&triangles);
        pass.set_bind_group(0, drawn.frame, &[]);
        pass.set_bind_group(3, &group(&plate.view), &[]);
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
        if let Some(buffers) = drawn.buffers.filter(|buffers| buffers.count > 0) {
            pass.set_vertex_buffer(0, buffers.corners.slice(..));
            for &[x, y, w, h] in drawn.tiles {
                pass.set_scissor_rect(x, y, w, h);
                pass.draw(0..buffers.count, 0..1);
            }
        }
        drop(pass);
        let mut pass = render_pass(encoder, "sheet", &[drawn.target]);
        pass.set_pipeline(&lay);
        pass.set_bind_group(3, &group(&layer.view), &[]);
        pass.set_blend_constant(blend_constant(drawn.weight));
        for &[x, y, w, h] in drawn.tiles {
            pass.set_scissor_rect(x, y, w, h);
            pass.draw(0..3, 0..1);
        }
    }
}

fn pipelines(gpu: &Gpu, layouts: &Layouts) -> [wgpu::RenderPipeline; 2] {
    let empty = &layouts.empty;
    let groups = [&layouts.frame, empty, empty, &layouts.sheet];
    let module = module(gpu, ProgramId::Sheet, Cases::ALL);
    let parts = PipelineParts {
        label: "sheet",
        layout: &pipeline_layout(gpu, "sheet", &groups),
        module: &module,
        entry: "draw_sheet",
        constants: &[],
        formats: &[LINEAR_FORMAT],
        blend: Some(OVER),
    };
    let corners = VertexParts {
        entry: "place_corner",
        stride: size_of::<SheetCorner>() as u64,
        attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x2, 2 => Float32x2, 3 => Float32x4, 4 => Float32x4],
    };
    let groups = [empty, empty, empty, &layouts.sheet];
    let lay = PipelineParts {
        layout: &pipeline_layout(gpu, "sheet", &groups),
        entry: "lay",
        blend: Some(MEAN),
        ..parts
    };
    [
        render_pipeline_of(gpu, &parts, Some(&corners)),
        render_pipeline(gpu, &lay),
    ]
}
