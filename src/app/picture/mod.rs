//! Hosts the renderer: the picture and its slices.

pub(crate) mod host;
pub(crate) mod small;
