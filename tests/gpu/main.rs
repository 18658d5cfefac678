//! Tests that ask a GPU (lavapipe is enough) and draw no window.

mod align;
mod answers;
mod baked;
mod beside;
mod bodies;
mod captions;
mod carve;
mod cli;
mod coarse;
mod describe;
mod exported;
mod fields;
mod figures;
mod grid;
mod icons;
mod images;
mod kept;
mod kinds;
mod load_memory;
mod meshes;
mod objects;
mod print;
mod probes;
mod riding;
mod rigid;
mod shells;
mod slices;
mod splines;
mod style;
mod sweeps;
mod textures;
mod told_apart;
mod tubes;

#[path = "../reference/carved.rs"]
mod carved;
#[path = "../support/data.rs"]
mod data;
#[path = "../support/firm.rs"]
mod firm;
#[path = "../support/gpu.rs"]
mod gpu;
#[path = "../support/long.rs"]
mod long;
#[cfg(target_os = "linux")]
#[path = "../support/memory.rs"]
mod memory;
#[path = "../support/pictures.rs"]
mod picture_files;
#[path = "../../src/bin/xtask/pieces.rs"]
mod pieces;
#[path = "../reference/rbf.rs"]
mod rbf;
#[path = "../reference/mod.rs"]
mod reference;
#[path = "../reference/sweep.rs"]
mod reference_sweep;
#[path = "../support/scans.rs"]
mod scans;
#[path = "../support/scatter.rs"]
mod scatter;
#[path = "../support/segment_files.rs"]
mod segment_files;
#[path = "../support/surfaces.rs"]
mod surfaces;
