use super::error::RenderError;
use super::gpu::Gpu;
use super::programs::{ProgramId, compile};

/// A compute entry point, compiled once; used to prepare (grids) and to ask for values (probes). The picture itself
/// never needs one.
#[derive(Debug)]
pub struct Kernel {
    name: &'static str,
    pipeline: wgpu::ComputePipeline,
}

/// One resource of a [`Kernel`] call.
#[derive(Debug)]
pub struct Binding<'a> {
    /// Number in `@group`.
    pub group: u32,
    /// Number in `@binding`, within the group.
    pub binding: u32,
    /// The buffer or texture that is bound there.
    pub resource: wgpu::BindingResource<'a>,
}

impl Kernel {
    /// Compiles an entry point of a program of the table.
    ///
    /// # Errors
    /// [`RenderError::Shader`] names file and line.
    pub async fn new(gpu: &Gpu, program: ProgramId, entry: &str) -> Result<Self, RenderError> {
        Self::with_constants(gpu, program, entry, &[]).await
    }

    /// As [`Kernel::new`], with values for the program's `override` constants.
    ///
    /// # Errors
    /// As [`Kernel::new`].
    pub async fn with_constants(
        gpu: &Gpu,
        program: ProgramId,
        entry: &str,
        constants: &[(&str, f64)],
    ) -> Result<Self, RenderError> {
        let name = program.program().name;
        let module = compile(gpu, program).await?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: None,
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants,
                    ..Default::default()
                },
                cache: None,
            });
        match scope.pop().await {
            Some(error) => Err(RenderError::Refused {
                pass: name,
                message: error.to_string(),
            }),
            None => Ok(Self { name, pipeline }),
        }
    }

    /// Adds one dispatch to the encoder. Bindings that the entry point does not use must not be given.
    pub fn encode(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bindings: &[Binding<'_>],
        workgroups: [u32; 3],
    ) {
        let mut groups: Vec<u32> = bindings.iter().map(|b| b.group).collect();
        groups.sort_unstable();
        groups.dedup();
        let made: Vec<(u32, wgpu::BindGroup)> = groups
            .into_iter()
            .map(|group| {
                let entries: Vec<wgpu::BindGroupEntry<'_>> = bindings
                    .iter()
                    .filter(|b| b.group == group)
                    .map(|b| wgpu::BindGroupEntry {
                        binding: b.binding,
                        resource: b.resource.clone(),
                    })
                    .collect();
                let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some(self.name),
                    layout: &self.pipeline.get_bind_group_layout(group),
                    entries: &entries,
                });
                (group, bind_group)
            })
            .collect();
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(self.name),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        for (group, bind_group) in &made {
            pass.set_bind_group(*group, bind_group, &[]);
        }
        pass.dispatch_workgroups(workgroups[0], workgroups[1], workgroups[2]);
    }
}
