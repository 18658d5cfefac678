//! Layer 6: windows, files, the command line and the page. The only room that knows where it runs.

#[cfg(target_arch = "wasm32")]
pub mod web;

#[cfg(not(target_arch = "wasm32"))]
pub mod files;
