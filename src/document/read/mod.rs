//! From the JSON tree to the typed illustration.

mod control;
mod curve;
mod data;
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

pub(super) use illustration::resolve;
