//! What lies on the picture and on the slices: handles, captions, measures, the bars over them.

pub(crate) mod apart;
pub(crate) mod ball;
pub(crate) mod caption_layout;
pub(crate) mod captions;
pub(crate) mod curve;
pub(crate) mod foot;
pub(crate) mod gizmo;
pub(crate) mod held;
pub(crate) mod hint;
pub(crate) mod lettering;
pub(crate) mod levelling;
pub(crate) mod measure;
pub(crate) mod orientation;
pub(crate) mod panes;
pub(crate) mod points;
pub(crate) mod projection;
pub(crate) mod provisional;
pub(crate) mod saved;
pub(crate) mod slice_plot;
pub(crate) mod slices;
pub(crate) mod snap;
pub(crate) mod steps;
pub(crate) mod title;
pub(crate) mod tools;
pub(crate) mod view_bar;
pub(crate) mod viewport;
