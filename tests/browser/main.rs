//! What only a real browser has: the first picture from a link, resize, history, files dropped, refusal and loss of the
//! GPU.
//!
//! `cargo xtask test` builds the page and sets up Chromium and Xvfb first. Pictures are left in target/e2e.

mod accessible;
mod assets;
mod author;
mod compare;
#[path = "../support/data.rs"]
mod data;
mod embed;
mod faults;
mod figures;
mod files;
mod film;
mod frame;
mod hand;
mod harness;
mod lesson;
mod library;
#[path = "../support/long.rs"]
mod long;
mod making;
mod marks;
mod meshes;
mod native;
mod page;
mod parts;
mod passage;
mod path;
#[path = "../support/pictures.rs"]
mod picture_files;
mod plates;
mod presenting;
mod rounds;
mod running;
#[path = "../support/segment_files.rs"]
mod segment_files;
mod server;
mod shaping;
mod size;
mod slices;
mod slow;
#[path = "../support/surfaces.rs"]
mod surfaces;
mod tissue;

use compare::{difference, drawn_pixels, object_part};
use data::data_folder;
use fabrica::document::{Document, TemplateKind};
use fabrica::link;
use fabrica::render::{Gpu, GpuOptions, Studio, View};
use hand::drop_files;
use harness::{Gpu as BrowserGpu, from_base64, with_browser};
use long::{is_long, long_or};

/// Size of the page in these tests, CSS pixels: wide enough for the panels, small enough for a software GPU.
const PAGE: (u32, u32) = (780, 420);

const WHITE: [u8; 3] = [255; 3];

/// A cube with nothing placed: quick to draw.
const PLAIN: &str = r#"{"fabrica":1,"subject":{"builtin":"cube"}}"#;

/// A peel on the side of the head.
const PEEL: &str = r#"{"fabrica":1,"title":"Scalp","templates":[{"kind":"peel","at":[0,0.1,0.3],"size":[0.5,0.4,0.2],"params":{"progress":0.2}}]}"#;

fn payload(json: &str) -> String {
    link::encode(&Document::from_json(json).expect("a good document"))
}
