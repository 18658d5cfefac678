//! Pictures, slices, picks and probes of a scene.

pub(crate) mod bench;
pub(crate) mod captions;
pub(crate) mod clock;
pub(crate) mod follow;
pub(crate) mod identify;
pub(crate) mod image;
pub(crate) mod object;
pub(crate) mod pace;
pub(crate) mod paper_shadow;
pub(crate) mod passes;
pub(crate) mod pick;
pub(crate) mod picture;
pub(crate) mod probe;
pub(crate) mod quality;
pub(crate) mod raycast;
pub(crate) mod renderer;
pub(crate) mod resolve;
pub(crate) mod rows;
pub(crate) mod sheet;
pub(crate) mod slice;
pub(crate) mod studio;
pub(crate) mod style;
pub(crate) mod targets;
pub(crate) mod tiles;
pub(crate) mod traced;
