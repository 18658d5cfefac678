//! The state of the viewer and its commands, without a window and without a device.
//!
//! Input makes [`Command`]s. [`Session::run`] runs one and returns [`Effect`]s, which the app carries out. A
//! [`Question`] goes to the picture, and its answer is a command again. One [`Tool`] is active at a time; [`Mode`]
//! tells the author from the lesson.
//!
//! | file | holds |
//! |---|---|
//! | `tool`, `mode`, `walk` | the active tool; author or lesson; the steps of a lesson |
//! | `selection`, `selecting`, `grouping` | what is selected, and what is done with it and its group |
//! | `objects`, `bodies` | objects of the scene; what meshes are made of |
//! | `mesh_use`, `dropped` | what a mesh file is to be |
//! | `command`, `effect`, `question`, `found`, `sought`, `ticket` | what goes in and out |
//! | `camera`, `shape`, `tracing`, `measures` | cameras, boxes of new templates, surfaces, distances |
//! | `line`, `brush` | the way of a hand, and the ball that paints along it |
//! | `notices`, `view`, `tissues`, `taken` | other parts of the state |
//! | `files`, `clipboard`, `library`, `small_picture` | files, and what is kept beside the document |
//! | `session` | the state itself |
//! | `run`, `using`, `surface`, `templates`, `opening`, `starting`, `raw` | what can be done with it |
//! | `steps`, `playing` | recording the steps of a lesson, and playing them |
//! | `figure` | making a figure: its regions and handles |
//! | `clay`, `shaping` | the tool that shapes a clay, and what its strokes become |
//! | `together`, `placing` | strokes that are laid down and done as one; a tool that is moved by handles |
//! | `making`, `painting` | what can be done with tissues |
//! | `seeking` | the search for a structure by name |
//! | `lending`, `link`, `clock` | examples and recent documents; the link; what goes on by itself |

mod bodies;
pub mod brush;
pub mod camera;
mod clay;
mod clipboard;
mod clock;
mod command;
mod drawing;
mod dropped;
mod effect;
pub mod figure;
mod files;
mod found;
mod gesture;
mod grouping;
mod growing;
mod hand;
mod lending;
mod library;
mod line;
mod link;
mod making;
mod measures;
mod mesh_use;
mod mode;
mod notices;
pub mod objects;
mod opening;
mod painting;
mod placing;
mod playing;
mod question;
mod raw;
mod run;
mod seeking;
mod selecting;
mod selection;
#[expect(
    clippy::module_inception,
    reason = "the room is named for the type that this file holds"
)]
mod session;
pub mod shape;
mod shaping;
mod small_picture;
mod sought;
mod starting;
mod steps;
mod strokes;
mod surface;
mod taken;
mod templates;
mod ticket;
pub mod tissues;
mod together;
mod tool;
mod tracing;
mod using;
mod view;

#[cfg(test)]
mod recording_tests;
#[cfg(test)]
mod tests;

pub use self::camera::StandardView;
pub use self::clay::{ClayCommand, Ghost, Pose, StrokeChange, Together};
pub use self::clipboard::{Clipboard, Copied};
pub use self::command::{Command, GizmoMode, PicturePaper, StepCommand};
pub use self::effect::{Effect, Focus, LinkChange, SaveFile};
pub use self::files::{FileChoice, Fit, RawCommand, RawDraft};
pub use self::found::Found;
pub use self::gesture::curve;
pub use self::hand::{HandCommand, HeldTool, StrokeWay, Touch};
pub use self::library::{
    Example, Library, LibraryCommand, LibraryPage, Listing, Recent, RecentChange, STORED_RECENT,
    Shipped, changed_recent,
};
pub use self::measures::Measures;
pub use self::mesh_use::MeshUse;
pub use self::mode::Mode;
pub use self::notices::{Gravity, Notice, Notices, Offer};
pub use self::objects::PlacedObject;
pub use self::question::{Place, Question, Sight};
pub use self::run::{STORED_HINT, STORED_LETTERING, STORED_SLOW, STORED_TITLE};
pub use self::selection::Selection;
pub use self::session::{Load, LoadOf, MeshQuestion, STORED_DOCUMENT, Session, Tab};
pub use self::small_picture::{
    STORED_PICTURE, STORED_RECENT_PICTURES, SmallPicture, changed_pictures, picture_of,
};
pub use self::sought::Sought;
pub use self::strokes::{with_key_at, without_key};
pub use self::taken::Taken;
pub use self::ticket::Ticket;
pub use self::tissues::{TissueCommand, Tissues};
pub use self::tool::Tool;
pub use self::view::{Pane, ScanFacts, See, SubjectFacts, ViewState};
