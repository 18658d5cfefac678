//! Fabrica opens a scan the way a medical illustrator would, and every illustration is a link.
//!
//! The layers, bottom to top; a room imports only rooms above it in this list:
//!
//! | room | layer | holds |
//! |---|---|---|
//! | [`math`] | 0 | spaces, placements, boxes, deterministic float functions |
//! | [`pictures`] | 1 | the pixels of PNG and JPEG files, and smaller copies of them |
//! | [`displace`] | 1 | the kinds of templates and all that is known of each; the formulas are WGSL |
//! | [`document`] | 2 | the illustration: plain data, edits, validity, undo |
//! | [`link`] | 3 | document to URL fragment and back |
//! | [`data`] | 3 | subjects: voxels, spacing, orientation, segments, statistics |
//! | [`load`] | 4 | files in, subjects out |
//! | [`subjects`] | 4 | the built-in subjects, generated |
//! | [`placed`] | 4 | what a placed template reaches, where it is grabbed, its icon |
//! | [`describe`] | 4 | a picture in words, for who cannot see it |
//! | [`clay`] | 4 | clay: strokes that shape a mesh, and the mesh that follows them |
//! | [`figure`] | 4 | flat pictures that bend: regions, outlines, meshes, the solve |
//! | [`assets`] | 5 | what a document needs from outside, and what has come of it |
//! | `render` | 5 | everything GPU |
//! | `app` | 6 | the viewer's panels and commands |
//! | `reader` | 6 | the lesson's viewer, without an editor |
//! | `shell` | 7 | windows, files, command line, page |
//!
//! # Glossary
//!
//! One word for one thing, in Rust, in WGSL and in comments. The keys of the document keep the names that old links
//! use.
//!
//! | word | means |
//! |---|---|
//! | subject | what is illustrated: a volume, with meshes beside it or not, meshes alone, a clay, or a figure |
//! | volume | scalars on an oriented grid of voxels; never a subject in general |
//! | segmentation | a volume of label numbers, with the segments that they stand for |
//! | label | a number in a segmentation |
//! | segment | a named part of the subject |
//! | recipe | how a segment is made from the values of the scan (`subject.features` in the document) |
//! | kept | tissue that `align` or `constrain` leaves alone |
//! | body | a segment that `look.segments` draws as solid, see-through or hidden |
//! | caption | text fastened to a point of tissue (`labels` in the document) |
//! | legend | the text under the picture (`caption` in the document and in a step) |
//! | template | a displacement map of the catalogue, placed in the subject by its kind, box and parameters |
//! | scene | everything that is ready to be drawn: GPU resources, bindings, revision |
//! | skip grid | the grid over the deformed space that lets rays leap over what is empty |
//! | embed | `<fabrica-viewer>` in somebody's page |
//! | figure | a 2D subject, drawn as a sheet of triangles; never an embed |
//! | plate | the flat picture that a figure bends |
//! | sheet | the triangles of a bent figure |
//! | clay | a subject whose document holds the strokes that shape it, and no mesh |
//!
//! # Imports
//!
#![doc = include_str!("imports.md")]
#![cfg_attr(
    target_arch = "wasm32",
    allow(
        clippy::arc_with_non_send_sync,
        reason = "what threads share natively has one thread in the page"
    )
)]

pub mod math;

pub mod displace;
pub mod pictures;

pub mod document;

pub mod data;
pub mod link;

pub mod clay;
pub mod describe;
pub mod figure;
pub mod load;
pub mod placed;
pub mod subjects;

pub mod assets;

#[cfg(feature = "render")]
pub mod render;

#[cfg(feature = "session")]
pub mod app;

#[cfg(feature = "reader")]
pub mod reader;

#[cfg(any(feature = "app", feature = "reader", feature = "parts"))]
pub mod shell;
