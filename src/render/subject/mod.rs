//! What is illustrated, on the GPU: one file for each kind.

pub(crate) mod bricks;
pub(crate) mod reduce;
pub(crate) mod upload;
pub(crate) mod volume;
