//! Preparations on the GPU before a picture can be drawn, each with its own inputs and its own programs.

pub(crate) mod baked;
pub(crate) mod bodies;
mod body_bricks;
pub(crate) mod held;
pub(crate) mod inputs;
pub(crate) mod kept;
pub(crate) mod look;
pub(crate) mod objects;
pub(crate) mod parts;
pub(crate) mod programs;
pub(crate) mod rigid;
pub(crate) mod shares;
pub(crate) mod sheet;
pub(crate) mod skip_grid;
pub(crate) mod templates;
