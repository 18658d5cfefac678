use super::probe::Sample;
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::{result_buffer, storage_buffer, submit_and_read};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::Pipelines;
use crate::render::device::programs::{ProgramId, compile_for};
use crate::render::pack::raycast_key::RaycastKey;
use crate::render::scene::Scene;
use crate::render::subject::textures::SubjectTextures;
use glam::Vec3;

/// Points of one dispatch, as in the plain probe.
const CHUNK: usize = 1 << 18;

/// The pipelines of probes by what they are made for. Built once per device.
pub(crate) type ObjectProbes = Pipelines<RaycastKey, wgpu::ComputePipeline>;

/// What the object has at points, alignment and constraints counted.
pub(crate) async fn object_samples(
    gpu: &Gpu,
    probes: &ObjectProbes,
    subject: &SubjectTextures,
    scene: &Scene,
    points: &[Vec3],
) -> Result<Vec<Sample>, RenderError> {
    let key = scene.key();
    let name = ProgramId::Object.program().name;
    let pipeline = match probes.made(&key) {
        Some(pipeline) => pipeline,
        None => {
            let module = compile_for(gpu, ProgramId::Object, subject.shader, key.cases()).await?;
            probes.get(key, || object_pipeline(gpu, &module, "probe_object", &key))
        }
    };
    let groups = object_groups(gpu, &pipeline, subject, scene);
    let mut samples = Vec::with_capacity(points.len());
    for chunk in points.chunks(CHUNK) {
        let padded: Vec<[f32; 4]> = chunk.iter().map(|p| [p.x, p.y, p.z, 0.0]).collect();
        let input = storage_buffer(gpu, "probe points", &padded);
        let output = result_buffer(gpu, "probe results", 16 * chunk.len() as u64);
        let points_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(name),
            layout: &pipeline.get_bind_group_layout(3),
            entries: &[
                entry(0, input.as_entire_binding()),
                entry(1, output.as_entire_binding()),
            ],
        });
        let mut encoder = encoder(gpu);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(name),
                timestamp_writes: None,
            });
            pass.set_pipeline(&pipeline);
            for (index, group) in (1..).zip(&groups) {
                pass.set_bind_group(index, group, &[]);
            }
            pass.set_bind_group(3, &points_group, &[]);
            pass.dispatch_workgroups(chunk.len().div_ceil(64) as u32, 1, 1);
        }
        let bytes = submit_and_read(gpu, encoder, &output).await?;
        let results: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        samples.extend(results.into_iter().map(|[x, y, z, a]| Sample {
            pos_in_rest: Vec3::new(x, y, z),
            continuity: a,
        }));
    }
    if let Some(message) = gpu.take_errors().into_iter().next() {
        return Err(RenderError::Refused {
            pass: "object probe",
            message,
        });
    }
    Ok(samples)
}

/// A compute entry point that asks what the object has, made for what a document uses.
pub(crate) fn object_pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    name: &'static str,
    key: &RaycastKey,
) -> wgpu::ComputePipeline {
    let [mode, constraints, kept_by] = key.align_constants();
    let constants = [
        ("drawn_kinds", f64::from(key.drawn_kinds)),
        mode,
        constraints,
        kept_by,
    ];
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module,
            entry_point: Some(name),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            cache: None,
        })
}

/// Groups 1 and 2 of such a pipeline: the subject, and the templates with what they leave alone.
pub(crate) fn object_groups(
    gpu: &Gpu,
    pipeline: &wgpu::ComputePipeline,
    subject: &SubjectTextures,
    scene: &Scene,
) -> [wgpu::BindGroup; 2] {
    let group = |index: u32, entries: &[wgpu::BindGroupEntry<'_>]| {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("object"),
            layout: &pipeline.get_bind_group_layout(index),
            entries,
        })
    };
    let kept_textures = scene.kept_textures();
    let mut entries = vec![
        entry(0, scene.templates().as_entire_binding()),
        entry(5, kept_textures.uniform.as_entire_binding()),
        entry(6, wgpu::BindingResource::TextureView(&kept_textures.view)),
        entry(
            14,
            wgpu::BindingResource::TextureView(&kept_textures.shares.view),
        ),
    ];
    entries.extend(scene.held().entries());
    [group(1, &subject.kept_entries()), group(2, &entries)]
}
