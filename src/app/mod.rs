//! Layer 5: the viewer. Panels read the session, commands change it, and the surroundings are reached by `Services`.
//! The rooms `words` and [`session`] build with the feature `session` alone, without egui and without a GPU; the rest
//! is the feature `app`.
//!
//! | room | holds | imports |
//! |---|---|---|
//! | `words` | every text of the interface in every language, a table per panel | |
//! | `session` | the document with its history, selection, camera, loads, messages; commands | `words` |
//! | `kit` | widgets, theme, drawn icons, floating frames | `session` |
//! | `picture` | the renderer in the window, its textures, questions to it | `session` |
//! | `canvas` | what lies on the picture: handles, captions, slices, measures, bars | `kit`, `picture` |
//! | `panel` | one panel or dialog each | `kit`, `picture` |
//! | `services`, `arrivals`, `fields` | what the shell does for the app, and what comes back | all |
//! | `provisional`, `window_title` | what the picture still waits for; the name of the window | all |
//! | `recents` | pictures of recent documents | all |
//! | `window` | the app itself: input becomes commands, commands change the session | all |
//!
//! Nothing here knows where it runs. The picture is drawn when something changed; at rest nothing repaints.

pub mod session;
#[cfg_attr(
    not(feature = "app"),
    allow(dead_code, reason = "the panels use most of the texts")
)]
mod words;

#[cfg(feature = "app")]
mod arrivals;
#[cfg(feature = "app")]
mod canvas;
#[cfg(feature = "app")]
mod dropped;
#[cfg(feature = "app")]
mod fields;
#[cfg(feature = "app")]
mod kit;
#[cfg(feature = "app")]
mod layout;
#[cfg(feature = "app")]
mod panel;
#[cfg(feature = "app")]
mod picture;
#[cfg(feature = "app")]
mod provisional;
#[cfg(feature = "app")]
mod recents;
#[cfg(feature = "app")]
mod saving;
#[cfg(feature = "app")]
mod services;
#[cfg(feature = "app")]
mod window;
#[cfg(feature = "app")]
mod window_title;

#[cfg(feature = "app")]
pub use self::canvas::lettering::{Lettering, lettering};
#[cfg(feature = "app")]
pub use self::canvas::vectors::escaped;
#[cfg(feature = "app")]
pub use self::picture::host::gpu_of;
#[cfg(feature = "app")]
pub use self::services::{
    MeshToSave, Message, MissingDocument, SavedTo, Services, SetText, TextOver, TextToSet,
    WhyMissing,
};
pub use self::session::{
    ClayCommand, Command, GizmoMode, HandCommand, HeldTool, LinkChange, Pane, PicturePaper,
    STORED_DOCUMENT, SaveFile, See, Shipped, StandardView, StepCommand, StrokeWay, Ticket,
    TissueCommand, Tool,
};
#[cfg(feature = "app")]
pub use self::window::{App, Start};
pub use self::words::Lang;
pub use crate::assets::{LoadEvent, RawQuestion, SegmentationsExpected};
