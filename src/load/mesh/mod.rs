//! Meshes: OBJ, STL, PLY and GLB in, repaired triangles out.
//!
//! A reader makes a draft of what its file says, corner by corner; `repair` welds, cuts polygons into triangles, drops
//! what is none and turns triangles until neighbours agree; `parts` divides; `measure` counts and measures. Only
//! [`MeshFormat`] and its sniffing are linked where scans are read: they say what it is that came instead.
//!
//! ```
//! use fabrica::load::{self, MemoryFiles};
//! let text = "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
//! let mut files = MemoryFiles::new([("corner.obj", text.as_bytes().to_vec())]);
//! let options = load::MeshOptions::default();
//! let (mesh, _report) = load::read_mesh(&mut files, "corner.obj", &options, &mut |_fraction| true)?;
//! let whole = fabrica::data::measure(&mesh.positions, &mesh.triangles);
//! assert_eq!((whole.triangle_count, whole.vertex_count), (4, 4));
//! assert!((whole.volume_mm3.expect("it is closed") - 1000.0 / 6.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod beside;
mod describe;
mod draft;
mod error;
pub(super) mod format;
mod glb;
mod glb_accessor;
mod glb_json;
mod glb_primitive;
mod input;
mod mtl;
mod obj;
mod options;
mod parts;
mod ply;
mod ply_header;
mod read;
mod repair;
mod report;
mod stl;
mod subject;
#[cfg(test)]
mod tests;
mod textures;
mod turn;
mod weld;

pub use beside::{are_mesh_names, is_mesh_name, mesh_among, names_beside};
pub use describe::{MeshDescription, cubic, describe_mesh};
pub use error::MeshError;
pub use format::MeshFormat;
pub use input::Progress;
pub use options::{Axes, MAX_TRIANGLES, MeshOptions, PartsMode, Units};
pub use read::{MeshOrNot, mesh_or_not, read_mesh};
pub use report::{Aside, MeshReport, Origin, Repair};
pub use subject::{MeshFile, ReadMeshes, read_mesh_subject, read_meshes};
