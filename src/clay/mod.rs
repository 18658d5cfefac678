//! Layer 4: clay, a closed surface that tools shape stroke by stroke (after Angelidis, Wyvill and Cani, *Sweepers*;
//! what is meant exactly stands in spec/sweepers.md, B). The document holds the recipe; the mesh is made from it here.

mod bench;
mod body;
mod check;
mod error;
mod field;
mod march;
mod mend;
mod mesh;
mod motion;
mod refine;
mod roomy;
mod shaping;
mod smooth;
mod space;
mod start;
mod start_of_file;
mod start_of_volume;
mod walls;
mod way;
mod write;

pub use bench::{ClayBench, bench_clay};
pub use body::SEGMENT;
pub use check::{Check, LastStroke, MAX_CROSSING, mesh_sha256};
pub use error::{ClayError, MAX_FILE_TRIANGLES, MAX_START_TRIANGLES};
pub use motion::LeftOut;
pub use refine::{MAX_TRIANGLES, Work};
pub use shaping::{Shaped, Shaping};
pub use space::Space;
pub use way::Way;
pub use write::{Export, Form, MeshFormat, Writing};

#[cfg(test)]
mod suite;
#[cfg(test)]
mod tests;
