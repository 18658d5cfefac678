//! Layer 0: spaces, placements, boxes and float functions that give the same bits everywhere.

mod aabb;
mod bent;
mod placement;
pub mod space;

pub use aabb::Aabb;
pub use bent::{Bent, Laid, NotBent};
pub use placement::Placement;
