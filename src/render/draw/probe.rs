use crate::data::Resources;
use crate::document::Illustration;
use crate::render::device::bindings::encoder;
use crate::render::device::buffers::{
    result_buffer, storage_buffer, submit_and_read, uniform_buffer,
};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::kernel::{Binding, Kernel};
use crate::render::device::programs::ProgramId;
use crate::render::pack::gpu_types::Templates;
use crate::render::stage::held::{HeldData, HeldTextures};
use glam::Vec3;

/// Points of one dispatch: 65,535 workgroups of 64 is the limit everywhere; a quarter of a million keeps a software GPU
/// from being asked for seconds at a time.
const CHUNK: usize = 1 << 18;

/// The result of the map at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where the material was before any template acted, rest space.
    pub pos_in_rest: Vec3,
    /// The composed continuity (spec/templates.md): below 0 there is a gap. 1 without templates.
    pub continuity: f32,
}

/// Evaluates the inverse map of a document at any points. Built once per device; compiling takes longer than asking.
///
/// The formulas exist in WGSL only, so whoever needs a value (tests, labels, the command line) asks here.
#[derive(Debug)]
pub struct Probe {
    gpu: Gpu,
    kernel: Kernel,
}

impl Probe {
    /// Compiles the program.
    ///
    /// # Errors
    /// [`RenderError::Shader`] with file and line.
    pub async fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        Ok(Self {
            gpu: gpu.clone(),
            kernel: Kernel::new(gpu, ProgramId::Probe, "probe").await?,
        })
    }

    /// One sample per point (deformed subject space), in order, for any number of points. A field whose samples are not
    /// among the resources is at rest.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn samples(
        &self,
        illustration: &Illustration,
        resources: &Resources,
        points: &[Vec3],
    ) -> Result<Vec<Sample>, RenderError> {
        let placed = &illustration.templates;
        let held = HeldTextures::of(&self.gpu, &HeldData::of(placed, resources));
        let templates = Templates::pack(placed, resources);
        self.ask(&templates, &held, points).await
    }

    /// As [`Probe::samples`], for templates that are packed already; fields among them are at rest.
    ///
    /// # Errors
    /// As [`Probe::samples`].
    pub async fn samples_of(
        &self,
        templates: &Templates,
        points: &[Vec3],
    ) -> Result<Vec<Sample>, RenderError> {
        let held = HeldTextures::new(&self.gpu);
        self.ask(templates, &held, points).await
    }

    async fn ask(
        &self,
        templates: &Templates,
        held: &HeldTextures,
        points: &[Vec3],
    ) -> Result<Vec<Sample>, RenderError> {
        let templates = uniform_buffer(&self.gpu, "probe templates", templates);
        let mut samples = Vec::with_capacity(points.len());
        for chunk in points.chunks(CHUNK) {
            let padded: Vec<[f32; 4]> = chunk.iter().map(|p| [p.x, p.y, p.z, 0.0]).collect();
            let input = storage_buffer(&self.gpu, "probe points", &padded);
            let output = result_buffer(&self.gpu, "probe results", 16 * chunk.len() as u64);
            let mut encoder = encoder(&self.gpu);
            let bind = |group, binding, buffer| Binding {
                group,
                binding,
                resource: wgpu::Buffer::as_entire_binding(buffer),
            };
            let of_held = held.entries().map(|entry| Binding {
                group: 2,
                binding: entry.binding,
                resource: entry.resource,
            });
            let [fields, carvers, sweeps] = of_held;
            let bindings = [
                bind(2, 0, &templates),
                fields,
                carvers,
                sweeps,
                bind(3, 0, &input),
                bind(3, 1, &output),
            ];
            let groups = [chunk.len().div_ceil(64) as u32, 1, 1];
            self.kernel
                .encode(&self.gpu, &mut encoder, &bindings, groups);
            let bytes = submit_and_read(&self.gpu, encoder, &output).await?;
            let results: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
            samples.extend(results.into_iter().map(|[x, y, z, a]| Sample {
                pos_in_rest: Vec3::new(x, y, z),
                continuity: a,
            }));
        }
        Ok(samples)
    }
}
