//! Meshes as values, and what can be measured of them.

pub(crate) mod edges;
mod measure;
pub(crate) mod polygon;
#[cfg(test)]
pub(crate) mod testing;
mod value;

pub use measure::{Measure, measure, pieces, volume, winding_number};
pub use value::{Coloring, Corners, Mesh, MeshMaterial, MeshPart, MeshTexture, NO_INDEX, Wrap};
