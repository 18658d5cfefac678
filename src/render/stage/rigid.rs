//! Rigid motions of segments that move as a whole, found on the GPU after each change of a template.

use super::held::HeldTextures;
use super::inputs::Inputs;
use super::kept::KeptTextures;
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::{result_buffer, uniform_buffer};
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::{Pipelines, compute_pipeline};
use crate::render::device::programs::{ProgramId, SubjectShader, module_for};
use crate::render::pack::gpu_types::{Kept, Lattice, MAX_MOTIONS, MAX_TEMPLATES};
use crate::render::pack::kept::KeptTissue;
use crate::render::pack::stamps::MadeFrom;
use crate::render::subject::textures::SubjectTextures;
use glam::Vec3;
use std::mem::offset_of;

/// Bytes of what is found: the motions and the seams, to the end of the uniform.
const BYTES: u64 = (size_of::<Kept>() - offset_of!(Kept, motions)) as u64;

/// Places for each group from which its longest displacement is climbed to.
const STARTS: u32 = 64;
const CLIMB_STARTS: u64 = MAX_TEMPLATES as u64 * STARTS as u64 * size_of::<[f32; 4]>() as u64;

/// Cells along the longest side of the box that the deformed object lies in.
const CELLS: f32 = 48.0;

/// The program, compiled when the first document with such a segment is drawn; one pipeline per set of template kinds.
#[derive(Debug, Default)]
pub(crate) struct RigidPrograms {
    pipelines: Pipelines<(u32, SubjectShader), wgpu::ComputePipeline>,
}

impl RigidPrograms {
    fn pipeline(&self, gpu: &Gpu, kinds: u32, subject: SubjectShader) -> wgpu::ComputePipeline {
        self.pipelines.get((kinds, subject), || {
            let module = module_for(gpu, ProgramId::Rigid, subject, Cases::of_kinds(kinds));
            compute_pipeline(gpu, &module, "fit", &[("drawn_kinds", f64::from(kinds))])
        })
    }
}

/// Stamps of the inputs from which the motions of a document were found last. The motions themselves lie on the GPU, in
/// [`Kept::motions`].
#[derive(Debug, Default)]
pub(crate) struct RigidMotions(MadeFrom<5>);

impl RigidMotions {
    /// Finds the motions anew if an input has changed. The work is submitted when this returns; nothing is read back.
    pub(crate) fn update(
        &mut self,
        gpu: &Gpu,
        programs: &RigidPrograms,
        inputs: &Inputs,
        subject: &SubjectTextures,
        templates: &wgpu::Buffer,
        (kept_textures, held): (&KeptTextures, &HeldTextures),
    ) {
        let is_stale = self.0.is_stale([
            inputs.subject,
            inputs.templates.stamp(),
            inputs.held.stamp(),
            inputs.kept.stamp(),
            inputs.bounds.stamp(),
        ]);
        if !is_stale || !inputs.kept().is_some_and(KeptTissue::needs_fit) {
            return;
        }
        let pipeline = programs.pipeline(gpu, inputs.templates.get().drawn_kinds(), subject.shader);
        let motions = result_buffer(gpu, "rigid motions", BYTES);
        let view = wgpu::BindingResource::TextureView;
        let bounds = *inputs.bounds.get();
        let side = bounds.size().max_element() / CELLS;
        let lattice = |dispatch| Lattice {
            corner: bounds.min.extend(0.0).to_array(),
            cells: (bounds.size() / side)
                .ceil()
                .max(Vec3::ONE)
                .as_uvec3()
                .extend(0)
                .to_array(),
            side,
            count: 0,
            dispatch,
            padding: 0,
        };
        let climb_starts = result_buffer(gpu, "starts of climbs", CLIMB_STARTS);
        let mut of_templates = vec![
            entry(0, templates.as_entire_binding()),
            entry(5, kept_textures.uniform.as_entire_binding()),
            entry(6, view(&kept_textures.view)),
        ];
        of_templates.extend(held.entries());
        let groups = [subject.kept_entries(), of_templates];
        let mut encoder = encoder(gpu);
        // Where displacements are longest first, then the rest, which begins there.
        for (dispatch, workgroups) in [
            (0, [MAX_TEMPLATES as u32, STARTS, 1]),
            (1, [MAX_MOTIONS as u32, 1, 1]),
        ] {
            let lattice = uniform_buffer(gpu, "deformed box", &lattice(dispatch));
            let found = vec![
                entry(0, motions.as_entire_binding()),
                entry(1, lattice.as_entire_binding()),
                entry(2, climb_starts.as_entire_binding()),
            ];
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            for (i, entries) in groups.iter().chain([&found]).enumerate() {
                let index = i as u32 + 1;
                let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("rigid"),
                    layout: &pipeline.get_bind_group_layout(index),
                    entries,
                });
                pass.set_bind_group(index, &group, &[]);
            }
            let [x, y, z] = workgroups;
            pass.dispatch_workgroups(x, y, z);
        }
        let offset = offset_of!(Kept, motions) as u64;
        encoder.copy_buffer_to_buffer(&motions, 0, &kept_textures.uniform, offset, BYTES);
        gpu.queue.submit([encoder.finish()]);
    }
}
