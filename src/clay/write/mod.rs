//! Meshes into files: STL, OBJ, PLY and GLB, as bytes.
//!
//! Each file is in the units and axes that its format has where a file says nothing (spec/surfaces.md), so that
//! `crate::load` and other programs read it without being told:
//!
//! | format | unit | axes |
//! |---|---|---|
//! | STL, PLY | millimetre | x right, y anterior, z superior (RAS+), as in memory |
//! | OBJ | millimetre | x left, y up, z forward: (−x, z, y) |
//! | GLB | metre | the same |
//!
//! Positions in millimetres come back bit for bit (but for the sign of 0), those of a GLB to the last bit of a float.
//! What a file holds depends on the mesh and the title alone.

mod export;
mod files;
mod format;
mod glb;
mod obj;
mod ply;
mod stl;
#[cfg(test)]
mod testing;
mod title;

pub use export::{Export, Form};
pub use format::{MeshFormat, Writing};
