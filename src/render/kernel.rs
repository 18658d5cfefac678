use super::programs::compile;
use super::{Gpu, Readback, RenderError};

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
    /// `@group`.
    pub group: u32,
    /// `@binding`.
    pub binding: u32,
    /// What is bound.
    pub resource: wgpu::BindingResource<'a>,
}

impl Kernel {
    /// Compiles an entry point of a program of the table.
    ///
    /// # Errors
    /// [`RenderError::Shader`] names file and line; [`RenderError::NoSuchProgram`].
    pub async fn new(gpu: &Gpu, program: &str, entry: &str) -> Result<Self, RenderError> {
        Self::with_constants(gpu, program, entry, &[]).await
    }

    /// As [`Kernel::new`], with values for the program's `override` constants.
    ///
    /// # Errors
    /// As [`Kernel::new`].
    pub async fn with_constants(
        gpu: &Gpu,
        program: &str,
        entry: &str,
        constants: &[(&str, f64)],
    ) -> Result<Self, RenderError> {
        let (name, module) = compile(gpu, program).await?;
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

/// A uniform buffer with these contents.
pub fn uniform_buffer<T: bytemuck::NoUninit>(gpu: &Gpu, label: &str, contents: &T) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM;
    filled_buffer(gpu, label, bytemuck::bytes_of(contents), usage)
}

/// A read-only storage buffer with these contents (compute only).
pub fn storage_buffer<T: bytemuck::NoUninit>(
    gpu: &Gpu,
    label: &str,
    contents: &[T],
) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE;
    filled_buffer(gpu, label, bytemuck::cast_slice(contents), usage)
}

/// Written through the queue and not mapped at creation: on a device that was just lost, mapping ends the program.
fn filled_buffer(gpu: &Gpu, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let alignment = wgpu::COPY_BUFFER_ALIGNMENT;
    let size = (bytes.len() as u64)
        .next_multiple_of(alignment)
        .max(alignment);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let whole = bytes.len() as u64 - bytes.len() as u64 % alignment;
    let (head, tail) = bytes.split_at(whole as usize);
    gpu.queue.write_buffer(&buffer, 0, head);
    if !tail.is_empty() {
        let mut last = [0; wgpu::COPY_BUFFER_ALIGNMENT as usize];
        for (to, from) in last.iter_mut().zip(tail) {
            *to = *from;
        }
        gpu.queue.write_buffer(&buffer, whole, &last);
    }
    buffer
}

/// A storage buffer for results of `size` bytes (compute only).
pub fn result_buffer(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

/// Submits the encoder's work and reads a buffer with `COPY_SRC` usage back.
pub fn submit_and_read(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    source: &wgpu::Buffer,
) -> Readback {
    let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: source.size(),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    encoder.copy_buffer_to_buffer(source, 0, &staging, 0, source.size());
    gpu.queue.submit([encoder.finish()]);
    Readback::start(gpu, staging)
}
