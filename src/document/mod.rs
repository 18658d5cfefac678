//! Layer 1: the illustration as plain data. Knows no GPU, window, file format, address, clock or thread.
//!
//! A [`Document`] is the JSON tree of spec/contract.md, kept whole (unknown keys too) and valid by construction; edits
//! go to the tree by JSON pointer. An [`Illustration`] is what it says: typed, defaults filled in, values clamped.
//! The renderer and the panels read the second and never the first.

mod catalogue;
mod illustration;

pub use catalogue::{
    MAX_PARAM_FLOATS, ParamKind, ParamSpec, ParamValue, TemplateKind, TemplateSpec,
};
pub use illustration::{
    Align, Background, Camera, Illustration, Label, Look, OpacityMode, PlacedTemplate, Step,
    SubjectRef, TemplateMode, Transfer, TransferPoint, Window,
};
