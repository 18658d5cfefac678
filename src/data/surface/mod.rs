//! Surfaces: meshes prepared to be drawn, asked and kept. Triangles stay as they are; a tree finds them, a field leads
//! to them, and the generalised winding number says what is inside (spec/surfaces.md, "Inside and outside").

mod arrays;
mod carver;
mod carving;
mod field;
mod grid;
mod gridding;
mod lids;
mod normals;
mod parted;
mod rims;
#[cfg(test)]
pub(crate) mod testing;
mod textures;
mod tree;
mod triangle;
mod whole;
mod winding;

pub use arrays::SurfaceArrays;
pub use carver::{CARVER_MARGIN, Carver, CarverLevel};
pub use field::{FIELD_MARGIN, FIELD_VOXELS, SurfaceField, times_inside};
pub use grid::{DistanceGrid, Grids, MeshGrids, share_grids};
pub use textures::{SurfacePicture, SurfaceTextures};
pub use tree::{Tree, TreeNode};
pub use triangle::{Nearest, Triangle};
pub use whole::{MAX_SURFACE_SEGMENTS, PLAIN_SRGB, Surface, SurfaceError, SurfaceSegment};
