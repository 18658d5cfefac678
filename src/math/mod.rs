//! Layer 0: spaces, placements, boxes, colours and float functions that give the same bits everywhere.

mod aabb;
mod bent;
pub mod borders;
mod color;
pub mod columns;
mod linear;
mod number;
mod placement;
mod polyline;
mod similarity;
pub mod space;

pub use aabb::Aabb;
pub use bent::{Bent, NotBent, OnLine};
pub use color::{linear_from_srgb, mix_srgb, srgb_from_linear};
pub(crate) use linear::Solver;
pub use number::{hex, plain_f64, round_to};
pub use placement::Placement;
pub use polyline::{simplified, simplified_by, winding};
pub use similarity::{Screw, Similarity, smooth_path};
