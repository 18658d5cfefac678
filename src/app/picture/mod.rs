//! Hosts the renderer: the picture, its slices and the icons of the catalogue.

pub(crate) mod catalogue_icons;
pub(crate) mod host;
pub(crate) mod pending;
