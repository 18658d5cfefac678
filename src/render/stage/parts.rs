//! Connected parts of kept tissue, found on the GPU: segments of which each part moves as a whole by itself.

use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::{result_buffer, uniform_buffer};
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::{Pipelines, compute_pipeline};
use crate::render::device::programs::{ProgramId, SubjectShader, module_for};
use crate::render::pack::gpu_types::DistanceJob;
use crate::render::subject::textures::SubjectTextures;
use std::sync::Arc;

/// Rounds of taking the least number along the three axes. Each goes round three corners of a part on its way; what
/// winds more often falls into two parts.
const ROUNDS: usize = 20;

/// The program, compiled when the first document moves connected parts.
#[derive(Debug, Default)]
pub(crate) struct PartPrograms(Pipelines<SubjectShader, Arc<PartPipelines>>);

#[derive(Debug)]
struct PartPipelines {
    mark: wgpu::ComputePipeline,
    spread: wgpu::ComputePipeline,
    count: wgpu::ComputePipeline,
    rank: wgpu::ComputePipeline,
    name: wgpu::ComputePipeline,
}

impl PartPrograms {
    fn get(&self, gpu: &Gpu, subject: SubjectShader) -> Arc<PartPipelines> {
        self.0.get(subject, || {
            let module = module_for(gpu, ProgramId::Parts, subject, Cases::ALL);
            let pipeline = |entry: &str| compute_pipeline(gpu, &module, entry, &[]);
            Arc::new(PartPipelines {
                mark: pipeline("mark_parts"),
                spread: pipeline("spread_parts"),
                count: pipeline("count_parts"),
                rank: pipeline("rank_parts"),
                name: pipeline("name_parts"),
            })
        })
    }

    /// Writes the rank of its part for each sample of the set that a job works on, from 1: the `job.part_count` largest
    /// have one, and 0 stands for the others and for what is outside of the set. `ranks` holds a number for each
    /// sample.
    pub(crate) fn find(
        &self,
        gpu: &Gpu,
        subject: &SubjectTextures,
        job: &DistanceJob,
        ranks: &wgpu::Buffer,
    ) {
        let pipelines = self.get(gpu, subject.shader);
        let [x, y, z, _] = job.coarse;
        let sizes = result_buffer(gpu, "sizes of parts", ranks.size());
        let mut encoder = encoder(gpu);
        let tissue = label_entries(subject);
        let mut run = |pipeline, axis, bindings: &[(u32, &wgpu::Buffer)], tissue, groups| {
            let job = uniform_buffer(gpu, "parts job", &DistanceJob { axis, ..*job });
            let mut entries = vec![entry(0, job.as_entire_binding())];
            let buffers = bindings.iter();
            entries.extend(buffers.map(|(at, buffer)| entry(*at, buffer.as_entire_binding())));
            dispatch(gpu, &mut encoder, pipeline, &entries, tissue, groups);
        };
        let all = [x, y, z].map(|n| n.div_ceil(4));
        run(&pipelines.mark, 0, &[(1, ranks)], Some(&tissue[..]), all);
        for _ in 0..ROUNDS {
            for (axis, across) in [[y, z], [x, z], [x, y]].into_iter().enumerate() {
                let [width, height] = across.map(|n| n.div_ceil(8));
                let groups = [width, height, 1];
                run(&pipelines.spread, axis as u32, &[(1, ranks)], None, groups);
            }
        }
        let both = [(1, ranks), (2, &sizes)];
        run(&pipelines.count, 0, &both, None, all);
        run(&pipelines.rank, 0, &both[1..], None, [1; 3]);
        run(&pipelines.name, 0, &both, None, all);
        gpu.queue.submit([encoder.finish()]);
    }
}

/// What tells the labels at a voxel, in group 1.
fn label_entries(subject: &SubjectTextures) -> Vec<wgpu::BindGroupEntry<'_>> {
    let view = wgpu::BindingResource::TextureView(&subject.label_view);
    let mut entries = vec![entry(3, view)];
    if let Some(meshes) = &subject.meshes
        && subject.shader == SubjectShader::Both
    {
        entries.push(entry(0, subject.buffer.as_entire_binding()));
        entries.extend(meshes.entries());
    }
    entries
}

/// One pass; `tissue` is bound as group 1 where the pass asks for labels.
pub(super) fn dispatch(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::ComputePipeline,
    entries: &[wgpu::BindGroupEntry<'_>],
    tissue: Option<&[wgpu::BindGroupEntry<'_>]>,
    [x, y, z]: [u32; 3],
) {
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(pipeline);
    let groups = tissue.map(|entries| (1, entries));
    for (index, entries) in groups.into_iter().chain([(3, entries)]) {
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("kept tissue"),
            layout: &pipeline.get_bind_group_layout(index),
            entries,
        });
        pass.set_bind_group(index, &group, &[]);
    }
    pass.dispatch_workgroups(x, y, z);
}
