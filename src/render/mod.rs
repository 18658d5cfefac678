//! Layer 4: everything GPU. Opens devices, assembles shader programs, uploads volumes and draws the picture.

mod error;
mod gpu;
pub mod gpu_types;
mod kernel;
mod probe;
pub mod programs;
mod readback;

pub use error::RenderError;
pub use gpu::{Gpu, GpuOptions};
pub use kernel::{Binding, Kernel, result_buffer, storage_buffer, submit_and_read, uniform_buffer};
pub use probe::{Probe, Sample};
pub use readback::Readback;
