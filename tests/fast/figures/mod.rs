//! Figures: regions, meshes, handles, the solve, and drawings.

mod common;
mod drawn;
mod follow;
mod holding;
mod limits;
#[cfg(target_os = "linux")]
mod memory;
mod mesh;
mod probe;
mod reference;
mod regions;
mod solve;
mod svg;
