//! One panel or dialog each.

pub(crate) mod captions;
pub(crate) mod catalogue;
pub(crate) mod controls;
pub(crate) mod curve;
pub(crate) mod frames;
pub(crate) mod kept;
pub(crate) mod keys;
pub(crate) mod library;
pub(crate) mod look;
pub(crate) mod notice;
mod paint;
pub(crate) mod points;
pub(crate) mod presets;
pub(crate) mod raw;
pub(crate) mod recipe;
mod seek;
pub(crate) mod share;
pub(crate) mod shortcuts;
pub(crate) mod steps;
pub(crate) mod strip;
pub(crate) mod templates;
pub(crate) mod text;
pub(crate) mod tissue;
pub(crate) mod topbar;
pub(crate) mod transfer;
pub(crate) mod transfer_plot;
