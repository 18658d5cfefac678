//! Tests that need no GPU and no page: documents, links, readers, built-in subjects, and the text of the source itself.

mod clays;
#[path = "../support/data.rs"]
mod data;
mod describe;
#[path = "../../src/bin/xtask/examples.rs"]
mod examples;
#[path = "../reference/figure.rs"]
mod figure_reference;
mod figures;
mod gallery;
#[path = "../../src/bin/xtask/house.rs"]
mod house;
mod icons;
#[path = "../../src/bin/xtask/imports.rs"]
mod imports;
mod inside;
mod islands;
mod layers;
mod layout;
mod links;
mod load;
mod load_dicom;
mod load_formats;
mod load_hostile;
#[path = "../support/long.rs"]
mod long;
#[cfg(target_os = "linux")]
#[path = "../support/memory.rs"]
mod memory;
mod meshes;
#[path = "../../src/bin/xtask/palette.rs"]
mod palette;
#[path = "../support/pictures.rs"]
mod picture_files;
mod pictures;
#[path = "../../src/bin/xtask/pieces.rs"]
mod pieces;
mod prose;
mod recipes;
#[path = "../support/scans.rs"]
mod scans;
#[path = "../support/scatter.rs"]
mod scatter;
mod shaders;
mod strokes;
mod subjects;
#[path = "../support/surfaces.rs"]
mod surfaces;
