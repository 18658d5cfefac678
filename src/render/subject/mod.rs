//! The subject on the GPU: one file for each kind of subject.

pub(crate) mod bricks;
mod figure;
mod held_view;
mod mesh;
pub(crate) mod plate;
mod reduce;
pub(crate) mod textures;
pub(crate) mod upload;
mod volume;
mod volume_upload;
