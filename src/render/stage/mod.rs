//! What is made on the GPU before a picture can be drawn, each from its own inputs and by its own programs.

pub(crate) mod baked;
pub(crate) mod bodies;
pub(crate) mod fields;
pub(crate) mod inputs;
pub(crate) mod kept;
pub(crate) mod look;
pub(crate) mod programs;
pub(crate) mod rigid;
pub(crate) mod skip_grid;
pub(crate) mod templates;
