//! Layer 4: clay, a closed surface that tools shape stroke by stroke (after Angelidis, Wyvill and Cani, *Sweepers*;
//! what is meant exactly stands in spec/sweepers.md, B). The document holds the recipe; the mesh is made from it here.
//!
//! ```
//! use fabrica::clay::{Check, Shaping};
//! use fabrica::document::{Document, SubjectRef};
//! // A ball pulls a horn out of a larger one.
//! let document = Document::from_json(r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.1,
//!     "tools": [{ "radius": 0.15 }], "strokes": [{ "path": [0, 0, 400, 0, 0, 300] }] } } }"#).expect("a document");
//! let SubjectRef::Clay(clay) = &document.illustration().subject else { panic!("a clay") };
//! let mut shaping = Shaping::new(clay).expect("a ball");
//! shaping.stroke(clay, &mut |_| true).expect("nobody stops it");
//! let check = Check::of_clay(&shaping.shaped());
//! assert!(check.is_two_manifold() && check.pieces == 1 && check.crossing == 0);
//! ```
//!
//! A stroke on its way through the files:
//!
//! | file | does |
//! |---|---|
//! | `start` | makes the ball, cube, plate or torus that the first stroke meets |
//! | `start_of_file`, `mend` | the same of the triangles of a file, once they are closed surfaces |
//! | `start_of_volume`, `walls`, `march` | the same of a part of a scan: its outer wall, by marching cubes |
//! | `motion`, `field` | divide the stroke into steps, and carry a place and a normal through one of them |
//! | `shaping` | takes the vertices in reach through all steps, and counts what was left out |
//! | `refine`, `mesh` | split, collapse and flip the edges behind each step |
//! | `smooth` | does strokes that smooth |
//! | `kept` | keeps earlier states as differences |
//! | `way` | carries captions with the same flow, forwards and back |
//! | `body`, `space`, `write` | give the mesh in millimetres, to be drawn and as files |
//! | `check`, `bench` | say whether the promises are kept, and at what cost |
//!
//! # Differs from the source
//!
//! - A stroke is the limit of the paper's sub-steps (section 3.2), the flow of the weighted velocities: a stroke that
//!   is cut in two gives the same shape, and that nothing folds is a theorem, where the paper has a conjecture
//!   (appendix A). Steps are counted by travel and coating, and none of the paper's bounds for them is used: (1) and
//!   4.2 take too small a box where a tool grows, (3) too few steps where a thin coating lies in a wide one.
//! - Edges flip as well, and neither splits nor collapses go on below a part of the detail: in the paper they can
//!   chase each other and leave slivers (section 5.1). A new vertex lies in the middle of the cubic through the ends;
//!   the formula that is printed puts it twice as far out.
//! - One equation in time, n′ = −(∇V)ᵀn, carries the normals of all motions; the paper has a comatrix for each.
//! - A tool that is a mesh or baked clay is a grid of distances, not a partition of space (section 5.2). There is no
//!   grid of fixed space for the vertices, and so no wall at its end.
//! - The same recipe gives the same bits everywhere: sums, products and roots in 64 bits, functions of `libm`, one
//!   order.
//! - Not in the paper: strokes that smooth, recipes, clay from files and scans. Not here: holes that open, parts that
//!   join, painting.

mod bench;
mod body;
mod check;
mod error;
mod field;
mod kept;
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
pub use kept::States;
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
