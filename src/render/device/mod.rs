//! The device and what talks to it: buffers, textures, bindings, programs, readback. Nothing here knows of documents
//! or subjects.

#[cfg(any(test, target_arch = "wasm32"))]
pub(crate) mod bare;
pub(crate) mod bindings;
pub(crate) mod buffers;
pub(crate) mod cases;
pub(crate) mod error;
pub(crate) mod gpu;
pub(crate) mod kernel;
pub(crate) mod layouts;
pub(crate) mod pipelines;
pub mod programs;
pub(crate) mod readback;
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
pub(crate) mod reload;
pub(crate) mod textures;
