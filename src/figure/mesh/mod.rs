//! The triangle mesh of a figure: Delaunay triangles that keep outlines as edges, and the sheets that they hang
//! together in (spec/figures.md, "The mesh").

mod constrain;
mod delaunay;
mod grid;
mod points;
mod refine;
mod sheets;
mod triangulate;

pub use grid::{Grid, weights};
pub(crate) use points::triangulated;
pub(crate) use sheets::hanging_together;
pub use sheets::{Mesh, Part, Tissue};
