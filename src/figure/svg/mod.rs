//! Drawings: the filled shapes of an SVG as regions, and bent drawings as SVG (spec/figures.md, "The source",
//! "Regions", "Labels, steps, link, files out").
//!
//! usvg resolves styles, units, references and basic shapes; of its result only paths are used. It keeps coordinates in
//! 32 bits; from there on they have 64.

mod error;
mod expansion;
mod intricacy;
mod limits;
mod paint;
mod path;
mod raster;
mod read;
mod styles;
mod words;
mod write;

pub use error::SvgError;
pub(super) use limits::DRAWN_SIDE;
pub use path::{Outline, Segment};
pub use raster::MAX_DRAWN_SIDE;
pub use read::{Drawing, Shape};
pub use words::Word;
pub use write::{Label, bent};
