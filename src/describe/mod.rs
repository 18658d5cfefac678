//! A picture in words, for who cannot see it: what was done to the object, what was left alone, from where one looks,
//! and which segments are in sight. In four languages, without a window and without a GPU; what the picture shows is
//! measured elsewhere and comes as [`Measured`].
//!
//! Names of segments are never inflected, since files and authors bring names of any gender and number: they stand in
//! lists after a colon.
//!
//! ```
//! use fabrica::describe::{Lang, Measured, describe};
//! use fabrica::document::Document;
//!
//! let text = r#"{ "fabrica": 1, "title": "Scalp", "templates": [{ "kind": "peel", "params": { "progress": 0.8 },
//!     "align": { "to": "segment", "keep": ["bone"] } }] }"#;
//! let document = Document::from_json(text)?;
//! let words = describe(&document, 0, &Measured::default(), Lang::English)?;
//! let expected = "Scalp. Object: head. The layer is peeled back, 80 %. Left in place: bone. Seen from the front.";
//! assert_eq!(words.text(), expected);
//! # Ok::<(), fabrica::document::DocumentError>(())
//! ```

mod lang;
mod names;
mod operations;
mod sight;
mod snippet;
#[cfg(test)]
mod tests;
mod text;
mod view;

pub use lang::{Lang, Line};
pub use names::{has_patient, segment, subject};
pub use operations::{Extent, Operation};
pub use sight::{Seen, Sight};
pub use snippet::{Snippet, snippet};
pub use text::{Description, Measured, describe, describe_shown};
pub use view::{Sides, seen_from, side_letters};
