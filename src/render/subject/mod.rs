//! The subject on the GPU: one file for each kind of subject.

pub(crate) mod bricks;
mod mesh;
mod reduce;
pub(crate) mod textures;
pub(crate) mod upload;
mod volume;
mod volume_upload;
