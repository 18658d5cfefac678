//! The subject on the GPU: one file for each kind of subject.

pub(crate) mod bricks;
pub(crate) mod reduce;
pub(crate) mod upload;
pub(crate) mod volume;
