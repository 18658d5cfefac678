//! Layer 1: the illustration as plain data. Knows no GPU, window, file format, address, clock or thread.
//!
//! A [`Document`] is the JSON tree of spec/contract.md, kept whole (unknown keys too) and valid by construction; edits
//! change the tree by JSON pointer. An [`Illustration`] is what the tree means: typed, defaults filled in, values
//! clamped. The renderer and the panels read the illustration and never the tree.
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
//! let text = r#"{"fabrica":1,"title":"Scalp","templates":[{"kind":"peel"}],"x-note":"kept"}"#;
//! assert_eq!(history.document().to_json_compact(), text);
//! assert_eq!(history.undo_name(), Some("Add peel"));
//! history.undo();
//! assert!(history.document().illustration().templates.is_empty());
//! # Ok::<(), fabrica::document::DocumentError>(())
//! ```
//!
//! # How the room is built
//!
//! Files import only from files before them: `limits` <- `model` (plain types, no JSON) and `text` (JSON, pointers,
//! errors, notices) <- `schema` (every fixed key once) <- `read` and `write` <- `pose` <- `canonical`, `steps`,
//! `blend` <- `difference` <- `recording`, `lesson`, `turn` <- `tree` <- `naming`, `walk`, `autoplay` <- `history`,
//! `authoring` <- `carry`.
//!
#![doc = include_str!("reference.md")]

mod authoring;
mod autoplay;
mod blend;
mod canonical;
mod carry;
mod difference;
mod history;
mod lesson;
mod limits;
mod model;
mod naming;
mod pose;
mod read;
mod recording;
#[cfg(test)]
mod reference;
mod schema;
mod steps;
#[cfg(test)]
mod tests;
mod text;
mod tree;
mod turn;
mod walk;
mod write;

pub use crate::math::plain_f64;
pub use authoring::{
    Plane, free_group_name, group_of, groups, mirror, mirrored, object_group_of,
    templates_from_text, templates_to_text,
};
pub use autoplay::{Autoplay, Turn};
pub use carry::carried_templates;
pub use history::{History, Outlook};
pub use lesson::Lesson;
pub use limits::{
    BUILTIN_SUBJECTS, DEFAULT_SUBJECT, DRAWN_FIGURES, FORMAT, MAX_ALT, MAX_BALL_MM, MAX_BYTES,
    MAX_CARVERS, MAX_CLEAN_MM, MAX_CLEAN_STEPS, MAX_CONTROLS, MAX_CURVE, MAX_CUT, MAX_DEPTH,
    MAX_FIELDS, MAX_KEEP_SETS, MAX_LABEL_FILES, MAX_LABELS, MAX_LAYERS, MAX_MESHES, MAX_OBJECTS,
    MAX_POINTS, MAX_RECIPES, MAX_SEEDS, MAX_SMOOTH_MM, MAX_STEPS, MAX_STROKE_PLACES, MAX_STROKES,
    MAX_TEMPLATES, MIN_BALL_MM, newest_revision,
};
pub use model::figure;
pub use model::{
    Align, Background, BodyKind, Camera, Caption, Clay, ClayFile, ClayKey, ClayMove, ClayShape,
    ClayStart, ClayStroke, ClayTool, ClayVolume, CleanStep, Constrain, ConstrainBy, Control,
    ControlPoint, ControlPoints, ControlRange, Curve, FIGURE_FRONT, FieldRef, FoundObject, Ghost,
    GhostBy, Hatch, HatchBy, Illustration, Layer, Light, Look, MAX_GRIDS, MAX_KEYS,
    MAX_PARAM_FLOATS, MAX_TOOLS, MeshAxes, MeshParts, MeshReading, MeshRef, MeshUnits, NotCarving,
    ObjectPlacement, ObjectRef, ObjectSource, OpacityMode, Outline, PRESETS, ParamKind, ParamSpec,
    ParamValue, PathKey, PlacedTemplate, Preset, PresetSubject, RawVoxels, Reading, Recipe,
    RecipeSource, STYLE_PRESETS, SceneObject, SegmentLook, SegmentSurface, SegmentsRef, Step,
    Stipple, Stroke, Style, StylePreset, SubjectBox, SubjectRef, SurfaceChange, SurfaceLook,
    SweepTool, SweepTools, TemplateData, TemplateKind, TemplateMode, TemplateSpec, Tone, ToolFile,
    ToolShape, Transfer, TransferPoint, VoxelPart, VoxelSource, Window, is_drawn_name, keep_set,
    keep_sets, needs_shaping, preset, presets, style_preset,
};
pub use read::{clay_from_text, figure_from_text};
pub use text::{DocumentError, Notice, NoticeKind, pointer};
pub use tree::Document;
pub use turn::{DISTANCE_RANGE, axes, between, orbit, roll, shift, zoom};
pub use walk::Walk;
#[cfg(any(feature = "app", feature = "session"))]
pub(crate) use write::color_text;
pub use write::{Edit, FigureList, clay_to_text, figure_to_text};
