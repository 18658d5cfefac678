//! Layer 1: the illustration as plain data. Knows no GPU, window, file format, address, clock or thread.
//!
//! A [`Document`] is the JSON tree of spec/contract.md, kept whole (unknown keys too) and valid by construction; edits
//! go to the tree by JSON pointer. An [`Illustration`] is what it says: typed, defaults filled in, values clamped.
//! The renderer and the panels read the second and never the first.
//!
//! ```
//! use fabrica::document::{Document, Edit, History, TemplateKind};
//! use fabrica::math::Placement;
//!
//! let document = Document::from_json(r#"{ "fabrica": 1, "title": "Scalp", "x-note": "kept" }"#)?;
//! assert_eq!(document.notices()[0].to_string(), "/x-note: this version does not know this key; it is kept");
//!
//! let mut history = History::new(document);
//! history.apply(&Edit::AddTemplate { index: 0, kind: TemplateKind::Peel, placement: Placement::DOCUMENT_DEFAULT })?;
//! assert_eq!(history.document().to_json_compact(), r#"{"fabrica":1,"title":"Scalp","templates":[{"kind":"peel"}],"x-note":"kept"}"#);
//! assert_eq!(history.undo_name(), Some("Add peel"));
//! history.undo();
//! assert!(history.document().illustration().templates.is_empty());
//! # Ok::<(), fabrica::document::DocumentError>(())
//! ```
//!
//! # Additions to the contract
//!
//! Keys that the contract does not name. Each has a default that leaves the picture as the contract says, and is left out of documents and
//! links where it stands at it.
//!
//! | key | values | meaning |
//! |---|---|---|
//! | `/templates/i/amount` | 0 … 1, default 1 | how much the template does, of what its parameters say |
//! | `/templates/i/curve` | `{ "points": [[x, z], …], "spline": true }`, 2 to 9 points in template space | the top of the template lies along this line (dissertation, section 5.3), from x = 0 at its first point to x = 1 at its last, in proportion to its length: round through the points (Catmull-Rom, drawn as 16 pieces), or straight from each to the next if `spline` is false. Heights stand on its mitred normals, y stays straight, beyond its ends it goes straight on, and the template is as long as the line. Where it is bent more sharply than that, nothing is moved. `[[0, 1], [1, 1]]` is the straight box |
//! | `/templates/i/group` | text | templates of one name are selected and moved together; the picture does not ask for it |
//! | `/templates/i/constrain/by` | `rigid` | the segments in `keep` move as a whole, by the rigid motion that comes nearest (least squares) to what the template would do to them; other tissue goes over into that motion close to them, and none is drawn through them (dissertation, section 5.7.2) |
//! | `/look/gradient` | 0 … 1, default 0 | how far opacity follows the steepness of the value, with its correction at cuts (section 6.2.5): at 1 even tissue is clear and borders stay |
//! | `/look/tint` | 0 … 1, default the preset's own, 0 with listed points | how far segments keep their own colours over the transfer function |
//! | `/subject/features` | list | tissues made here, as the recipes that make them |
//! | `/subject/frame`, `/subject/raw` | whole number; object | which picture of a file with several; how a file without a header is laid out |
//! | `/subject/segments` | also a list | several label volumes beside one scan |
//! | `/look/segments` | object, by name of segment | segments drawn as bodies of their own: `{ "brain": 1, "skull": { "opacity": 0.3, "color": "#eadfc4" } }`. A number is an opacity: 1 solid, 0 hidden, between them as opaque as a layer of 0.05 units is then. Where segments overlap, the one that the subject lists first decides. Opacities and colours ease from step to step ([`SegmentLook`]) |

mod authoring;
mod canonical;
mod catalogue;
mod curve;
mod edit;
mod error;
mod feature;
mod history;
mod illustration;
mod json;
mod notice;
mod object;
pub mod pointer;
mod preset;
mod resolve;
mod resolve_data;
mod resolve_subject;
mod steps;
#[cfg(test)]
mod tests;
mod tree;

pub use authoring::{
    Plane, free_group_name, group_of, groups, mirror, mirrored, templates_from_text,
    templates_to_text,
};
pub use catalogue::{
    MAX_PARAM_FLOATS, ParamKind, ParamSpec, ParamValue, TemplateKind, TemplateSpec,
};
pub use curve::{Curve, MAX_CURVE};
pub use edit::Edit;
#[cfg(feature = "app")]
pub(crate) use edit::hex;
pub use error::DocumentError;
pub use feature::{
    CleanStep, FeatureRecipe, FeatureSource, MAX_CLEAN_MM, MAX_CLEAN_STEPS, MAX_FEATURES,
    MAX_SEEDS, MAX_SMOOTH_MM,
};
pub use history::History;
pub use illustration::{
    Align, Background, Camera, Constrain, ConstrainBy, ControlPoint, ControlPoints, FieldRef,
    FieldSamples, Illustration, Label, Look, OpacityMode, PlacedTemplate, RawVoxels, Reading,
    SampledField, SegmentLook, SegmentsRef, Step, SubjectRef, TemplateData, TemplateMode, Transfer,
    TransferPoint, Window,
};
pub use json::MAX_DEPTH;
pub use notice::{Notice, NoticeKind};
pub use preset::{PRESETS, Preset, PresetSubject, preset, presets};
pub use resolve::{keep_set, keep_sets};
pub use tree::Document;

/// The format's number that this version reads and writes.
pub const FORMAT: u32 = 1;
/// Templates in a document at most.
pub const MAX_TEMPLATES: usize = 32;
/// Different sets of kept tissue (`align`, `constrain`) in a document at most.
pub const MAX_KEEP_SETS: usize = 4;
/// Label volumes beside a subject at most.
pub const MAX_LABEL_FILES: usize = 8;
/// Control points of an `rbf` at most.
pub const MAX_POINTS: usize = 64;
/// Fields of a document that are drawn at most.
pub const MAX_FIELDS: usize = 4;
/// Places on the cut of an `rbf` at most.
pub const MAX_CUT: usize = 16;
/// Labels in a document at most.
pub const MAX_LABELS: usize = 256;
/// Steps in a document at most.
pub const MAX_STEPS: usize = 100;
/// Bytes of a document's JSON at most.
pub const MAX_BYTES: usize = 1 << 20;
/// The subject of a document that names none.
pub const DEFAULT_SUBJECT: &str = "head";
/// The subjects that the program generates, or will in a later release.
pub const BUILTIN_SUBJECTS: [&str; 8] = [
    "bar",
    "cube",
    "tomato",
    "piggybank",
    "head",
    "hand",
    "torso",
    "knee",
];

/// A 32-bit float as the 64-bit float that prints the same: 0.1, not 0.10000000149011612.
pub fn plain_f64(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}
