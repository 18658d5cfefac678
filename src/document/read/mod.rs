//! From the JSON tree to the typed illustration.

mod clay;
mod control;
mod curve;
mod data;
mod figure;
mod illustration;
mod light;
mod look;
mod mesh;
mod object;
mod reader;
mod recipe;
mod style;
mod subject;
mod surface;
mod template;
mod tools;

pub use clay::clay_from_text;
pub use figure::figure_from_text;
pub(super) use illustration::resolve;
