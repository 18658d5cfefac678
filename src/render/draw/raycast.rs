//! The ray march: the pass that draws the picture, or finds what lies under one pixel.

use super::traced::Traced;
use crate::render::device::bindings::entry;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::{Layouts, RAYS_BINDING, pipeline_layout};
use crate::render::device::pipelines::{PipelineParts, Pipelines, render_pass, render_pipeline};
use crate::render::device::programs::{ProgramId, SubjectShader, module_for};
use crate::render::device::textures::{LINEAR_FORMAT, PICK_FORMAT};
use crate::render::pack::gpu_types::{AskedRays, Frame};
use crate::render::pack::raycast_key::{Finds, RaycastKey};
use bytemuck::Zeroable as _;
use glam::Vec3;

/// The programs of the ray march. Built once per device.
#[derive(Debug)]
pub(crate) struct RaycastPasses {
    /// The modules by program, kind of subject and kinds of templates; each is compiled when it first draws a picture.
    modules: Pipelines<(ProgramId, SubjectShader, Cases), wgpu::ShaderModule>,
    layout: wgpu::PipelineLayout,
    baked_layout: wgpu::PipelineLayout,
    asked_layout: wgpu::PipelineLayout,
    pipelines: Pipelines<RaycastKey, wgpu::RenderPipeline>,
}

impl RaycastPasses {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let common = [&layouts.frame, &layouts.subject, &layouts.scene];
        let with = |pass| [common.as_slice(), &[pass]].concat();
        Self {
            modules: Pipelines::default(),
            layout: pipeline_layout(gpu, "raycast", &common),
            baked_layout: pipeline_layout(gpu, "raycast", &with(&layouts.baked)),
            asked_layout: pipeline_layout(gpu, "raycast", &with(&layouts.rays)),
            pipelines: Pipelines::default(),
        }
    }

    /// The pipeline for a key; made on first use.
    pub(crate) fn pipeline(&self, gpu: &Gpu, key: RaycastKey) -> wgpu::RenderPipeline {
        self.pipelines.get(key, || self.make(gpu, key))
    }

    fn make(&self, gpu: &Gpu, key: RaycastKey) -> wgpu::RenderPipeline {
        let number = |flag: bool| f64::from(u8::from(flag));
        let mut constants = vec![
            ("drawn_kinds", f64::from(key.drawn_kinds)),
            ("has_labels", number(key.has_labels)),
            ("has_grid", number(key.has_grid)),
            ("has_edges", number(key.has_edges)),
            ("has_ghost", number(key.has_ghost)),
            ("has_wires", number(key.has_wires)),
            ("has_shells", number(key.has_shells)),
            ("has_lamp", number(key.has_lamp)),
            ("has_bodies", number(key.has_bodies)),
            key.textures_constant(false),
            ("has_objects", number(key.has_objects)),
        ];
        let program = if key.is_baked {
            ProgramId::RaycastBaked
        } else if key.keeps_tissue() {
            constants.extend(key.align_constants());
            ProgramId::RaycastAligned
        } else {
            ProgramId::Raycast
        };
        let cases = key.cases();
        let make = || module_for(gpu, program, key.subject, cases);
        let module = self.modules.get((program, key.subject, cases), make);
        let layout = match key.finds {
            Finds::Pick | Finds::Event => &self.asked_layout,
            _ if key.is_baked => &self.baked_layout,
            Finds::Picture | Finds::Traced | Finds::Segments => &self.layout,
        };
        let (entry, formats, blend): (_, &[_], _) = match key.finds {
            Finds::Picture => ("draw", &[LINEAR_FORMAT], Some(MEAN)),
            Finds::Traced => ("trace", &Traced::FORMATS, None),
            Finds::Pick => ("pick", &[PICK_FORMAT], None),
            Finds::Segments => ("identify", &[PICK_FORMAT], None),
            Finds::Event => ("meet", &[PICK_FORMAT], None),
        };
        let parts = PipelineParts {
            label: "raycast",
            layout,
            module: &module,
            entry,
            constants: &constants,
            formats,
            blend,
        };
        render_pipeline(gpu, &parts)
    }
}

const MEAN_PART: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::Constant,
    dst_factor: wgpu::BlendFactor::OneMinusConstant,
    operation: wgpu::BlendOperation::Add,
};

/// What is drawn, with the weight of the blend constant, over what is there.
pub(crate) const MEAN: wgpu::BlendState = wgpu::BlendState {
    color: MEAN_PART,
    alpha: MEAN_PART,
};

/// Bind group 0: camera and sampling of one frame.
pub(crate) fn frame_group(gpu: &Gpu, layouts: &Layouts, frame: &Frame) -> wgpu::BindGroup {
    let buffer = uniform_buffer(gpu, "frame", frame);
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout: &layouts.frame,
        entries: &[entry(0, buffer.as_entire_binding())],
    })
}

/// Rays of subject space (origin, unit direction) as shaders read them. The last ray fills the rows behind it: a GPU
/// shades pixels in fours, and a software one marches those beside the picture as far as the others. A ray of zeros
/// would take it half a minute.
fn asked_rays(rays: &[(Vec3, Vec3)]) -> AskedRays {
    let mut asked = AskedRays::zeroed();
    let last = rays.last().into_iter().cycle();
    let slots = asked.items.chunks_exact_mut(2);
    for (slots, (origin, dir)) in slots.zip(rays.iter().chain(last)) {
        slots[0] = origin.extend(0.0).to_array();
        slots[1] = dir.extend(0.0).to_array();
    }
    asked
}

/// Bind group 3 of picks: the rays of [`asked_rays`].
pub(crate) fn rays_group(gpu: &Gpu, layouts: &Layouts, rays: &[(Vec3, Vec3)]) -> wgpu::BindGroup {
    let asked = asked_rays(rays);
    let buffer = uniform_buffer(gpu, "rays", &asked);
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("rays"),
        layout: &layouts.rays,
        entries: &[entry(RAYS_BINDING, buffer.as_entire_binding())],
    })
}

/// The weight of sample `index`, from 0, so that the target holds the mean of all so far.
pub(crate) fn sample_weight(index: u32) -> f32 {
    1.0 / (index + 1) as f32
}

/// The blend constant of [`MEAN`] for this weight against what the target holds: 1 overwrites.
pub(crate) fn blend_constant(weight: f32) -> wgpu::Color {
    let weight = f64::from(weight);
    wgpu::Color {
        r: weight,
        g: weight,
        b: weight,
        a: weight,
    }
}

/// One ray march pass.
pub(crate) struct March<'a> {
    pub targets: &'a [&'a wgpu::TextureView],
    pub pipeline: &'a wgpu::RenderPipeline,
    pub frame: &'a wgpu::BindGroup,
    pub subject: &'a wgpu::BindGroup,
    pub scene: &'a wgpu::BindGroup,
    /// Group 3: the baked map, or the rays that are asked, for pipelines that read either.
    pub pass: Option<&'a wgpu::BindGroup>,
    /// Width and height of the used part of the target, pixels from its top left corner.
    pub viewport: [u32; 2],
    pub tiles: &'a [[u32; 4]],
    /// Weight against what the target holds: 1 overwrites.
    pub weight: f32,
}

/// Adds a ray march to the encoder.
pub(crate) fn encode_march(encoder: &mut wgpu::CommandEncoder, march: &March<'_>) {
    let mut pass = begin_march(encoder, march);
    for &tile in march.tiles {
        draw_tile(&mut pass, tile);
    }
}

fn draw_tile(pass: &mut wgpu::RenderPass<'_>, [x, y, width, height]: [u32; 4]) {
    pass.set_scissor_rect(x, y, width, height);
    pass.draw(0..3, 0..1);
}

fn begin_march<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    march: &March<'_>,
) -> wgpu::RenderPass<'e> {
    let mut pass = render_pass(encoder, "raycast", march.targets);
    pass.set_pipeline(march.pipeline);
    pass.set_bind_group(0, march.frame, &[]);
    pass.set_bind_group(1, march.subject, &[]);
    pass.set_bind_group(2, march.scene, &[]);
    if let Some(group) = march.pass {
        pass.set_bind_group(3, group, &[]);
    }
    pass.set_blend_constant(blend_constant(march.weight));
    let [width, height] = march.viewport.map(|side| side as f32);
    pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
    pass
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::pack::gpu_types::MAX_ASKED_RAYS;

    #[test]
    fn every_row_has_a_direction() {
        let rays = [(Vec3::ZERO, Vec3::X), (Vec3::ONE, Vec3::NEG_Y)];
        let asked = asked_rays(&rays).items;
        assert_eq!(asked.len(), 2 * MAX_ASKED_RAYS);
        assert_eq!(asked[..2], [[0.0; 4], [1.0, 0.0, 0.0, 0.0]]);
        let rest = asked[2..].chunks_exact(2);
        assert!(
            rest.into_iter()
                .all(|ray| ray == [[1.0, 1.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0]])
        );
    }
}
