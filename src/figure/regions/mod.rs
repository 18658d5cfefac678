//! Regions as sets of pixels of the map: floods, polygons and paths, and their clean-up (spec/figures.md, "Regions").

mod fill;
mod flood;
mod map;
mod mask;
mod parts;

pub use fill::Fill;
pub(crate) use fill::add_filled;
pub(crate) use map::Pixels;
pub use map::{Canvas, REST, RegionMap, VOID};
pub use mask::Mask;
