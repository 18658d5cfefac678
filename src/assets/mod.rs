//! Layer 5: the files that a document needs from outside, and those that have arrived. No files, no network and no GPU
//! here: the shell fetches and reads, the app and the renderer use the result.
//!
//! [`Wanted::of`] lists the subject, the label volumes and the displacement fields that an illustration names. The
//! shell hands the data for a want to [`Assets::take`], which refuses a file of another hash. The renderer gets them as
//! [`Resources`](crate::data::Resources). The window, the page and the commands all go this way, so that a
//! document opens alike in each of them.
//!
//! ```
//! use fabrica::assets::{Role, Wanted};
//! use fabrica::document::Document;
//!
//! let text = r#"{ "fabrica": 1, "subject": { "builtin": "head", "segments": [{ "src": "parts.nii.gz" }] } }"#;
//! let wanted = Wanted::of(Document::from_json(text)?.illustration()).0;
//! assert_eq!(wanted[1].role, Role::Segments);
//! assert_eq!(wanted[1].src(), Some("parts.nii.gz"));
//! # Ok::<(), fabrica::document::DocumentError>(())
//! ```

mod bend;
mod events;
mod naming;
mod news;
mod store;
mod tissue_work;
mod want;

pub use bend::{BendAnswer, BendPose, BendRequest, Bending, FOLLOWING};
pub use events::{LoadEvent, RawQuestion, SegmentationsExpected};
pub use news::ResourceNews;
pub use store::{Assets, Data};
pub use tissue_work::TissueWork;
pub use want::{OtherFile, Role, Source, Want, Wanted, tool_files};
