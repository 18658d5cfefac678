//! Fabrica opens a scan the way a medical illustrator would, and every illustration is a link.
//!
//! The layers, bottom to top; a room imports only rooms above it in this list:
//!
//! | room | layer | holds |
//! |---|---|---|
//! | [`math`] | 0 | spaces, placements, boxes, deterministic float functions |
//! | [`document`] | 1 | the illustration: plain data, edits, validity, undo |
//! | [`link`] | 2 | document to URL fragment and back |
//! | [`data`] | 2 | volumes: voxels, spacing, orientation, statistics |
//! | [`load`] | 3 | files in, volumes out |
//! | [`subjects`] | 3 | the built-in subjects, generated |
//! | [`displace`] | 3 | what a template reaches and where it is grabbed; the formulas are WGSL |
//! | `render` | 4 | everything GPU |
//! | `app` | 5 | the viewer's panels and commands |
//! | `shell` | 6 | windows, files, command line, page |

#![cfg_attr(
    target_arch = "wasm32",
    allow(
        clippy::arc_with_non_send_sync,
        reason = "what threads share natively has one thread in the page"
    )
)]

pub mod math;

pub mod document;

pub mod data;
pub mod link;

pub mod displace;
pub mod load;
pub mod subjects;

#[cfg(feature = "render")]
pub mod render;

#[cfg(feature = "app")]
pub mod app;

#[cfg(feature = "app")]
pub mod shell;
