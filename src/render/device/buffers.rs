//! Buffers with contents, and their way back.

use super::gpu::Gpu;
use super::readback::Readback;

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

/// A buffer of vertices.
pub(crate) fn vertex_buffer<T: bytemuck::NoUninit>(
    gpu: &Gpu,
    label: &str,
    contents: &[T],
) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::VERTEX;
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
