//! Layer 6: windows, files, the command line and the page. The only room that knows where it runs.

#[cfg(all(target_arch = "wasm32", feature = "reader"))]
mod address;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
mod mirror;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
pub mod offscreen;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
mod page;
#[cfg(all(target_arch = "wasm32", feature = "reader", not(feature = "app")))]
pub mod reader;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
mod texts;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
pub mod web;
#[cfg(all(target_arch = "wasm32", feature = "reader"))]
mod wished;
#[cfg(target_arch = "wasm32")]
pub mod worker;

pub mod bending;
pub mod clays;
pub mod figures;
pub mod loading;
pub mod meshes;

#[cfg(not(target_arch = "wasm32"))]
pub mod native;

#[cfg(not(target_arch = "wasm32"))]
pub mod command_line;
#[cfg(not(target_arch = "wasm32"))]
pub mod files;
