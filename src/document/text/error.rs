//! Why a text is no document, or an edit would make none.

use crate::document::limits::FORMAT;
use thiserror::Error;

/// Why a text is no document, or an edit would make none. Places are JSON pointers (RFC 6901).
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// The text is no JSON.
    #[error("not JSON at line {line}, column {column}{}: {problem}", at(.pointer))]
    Syntax {
        /// Line, counted from 1.
        line: usize,
        /// Column, counted from 1 in characters.
        column: usize,
        /// JSON pointer to the value that was being read.
        pointer: String,
        /// What the parser expected, or what it found instead.
        problem: &'static str,
    },
    /// NaN, an infinity, or a number that no 64-bit float holds.
    #[error("{pointer}: {found} is not a finite number")]
    NotFinite {
        /// JSON pointer to the place.
        pointer: String,
        /// The number as the document has it, shortened.
        found: String,
    },
    /// A value of the wrong type or shape.
    #[error("{}: expected {expected}, found {found}", place(.pointer))]
    WrongType {
        /// JSON pointer to the place.
        pointer: String,
        /// Description of the value that belongs there.
        expected: &'static str,
        /// Description of the value that was found.
        found: String,
    },
    /// An object names a key twice, so that its meaning is not clear.
    #[error("{pointer}: the key is there twice")]
    DuplicateKey {
        /// JSON pointer to the place.
        pointer: String,
    },
    /// A quaternion of length zero turns nothing.
    #[error("{pointer}: a rotation of length 0 has no direction")]
    ZeroRotation {
        /// JSON pointer to the place.
        pointer: String,
    },
    /// A box without a side above 0 gives no unit of length.
    #[error("{pointer}: the box has no size")]
    NoSize {
        /// JSON pointer to the place.
        pointer: String,
    },
    /// The number of the format is missing.
    #[error("/fabrica: not a Fabrica document (the format's number is missing)")]
    NoVersion,
    /// The document was made by a later release.
    #[error(
        "/fabrica: the document has format {found}, this program reads up to {}; a newer release opens it",
        FORMAT
    )]
    TooNew {
        /// The document's format, as written.
        found: String,
    },
    /// More entries than a document may have.
    #[error("{pointer}: {found} {what}, at most {limit} are allowed")]
    TooMany {
        /// JSON pointer to the place.
        pointer: String,
        /// The entries' name, such as “templates”.
        what: &'static str,
        /// Number of entries that the document has.
        found: usize,
        /// Number of entries that the list may have.
        limit: usize,
    },
    /// Fewer entries than a list needs.
    #[error("{pointer}: {found} {what}, at least {least} are needed")]
    TooFew {
        /// JSON pointer to the list.
        pointer: String,
        /// The entries' name, such as “points”.
        what: &'static str,
        /// Number of entries that the document has.
        found: usize,
        /// Number of entries that the list must have.
        least: usize,
    },
    /// Two lists that go together are not equally long.
    #[error("{pointer}: {found} points, but `points` has {expected}")]
    UnequalLengths {
        /// JSON pointer to the list that goes with `points`.
        pointer: String,
        /// Number of its entries.
        found: usize,
        /// Number of entries of `points`.
        expected: usize,
    },
    /// A region has the name of one before it, or one that means something else.
    #[error("{pointer}: “{name}” is taken; regions have names of their own")]
    TakenName {
        /// JSON pointer to the region's name, or to the region if it has none.
        pointer: String,
        /// The name, shortened.
        name: String,
    },
    /// Longer than a document may be.
    #[error("the document has {found} bytes, at most {limit} are allowed")]
    TooLarge {
        /// Bytes of the document as JSON.
        found: usize,
        /// Bytes that a document may have.
        limit: usize,
    },
    /// Nested deeper than a document may be.
    #[error("{}: nested deeper than {limit} levels", place(.pointer))]
    TooDeep {
        /// JSON pointer to the place, shortened.
        pointer: String,
        /// Levels that a document may have.
        limit: usize,
    },
    /// A text that is no JSON pointer.
    #[error("“{pointer}” is not a JSON pointer (it starts with / and writes ~ as ~0)")]
    BadPointer {
        /// The text that is no pointer, shortened.
        pointer: String,
    },
    /// A pointer that may not be set.
    #[error("{pointer}: may not be set by a step")]
    Refused {
        /// JSON pointer to the place.
        pointer: String,
    },
    /// A pointer to a value that is missing.
    #[error("{pointer}: there is nothing there")]
    NotFound {
        /// JSON pointer to the place.
        pointer: String,
    },
    /// A step that the document does not have.
    #[error("there is no step {step}: the document has steps 0 to {last}")]
    NoSuchStep {
        /// The step that was asked for.
        step: usize,
        /// The last step of the document.
        last: usize,
    },
    /// A step makes the document wrong.
    #[error("{pointer}: step {step} makes the document wrong: {source}")]
    Step {
        /// JSON pointer to the entry of the step's `set`, or to the step.
        pointer: String,
        /// Number of the step, from 1.
        step: usize,
        /// The fault of the document at that step.
        source: Box<DocumentError>,
    },
}

fn at(pointer: &str) -> String {
    if pointer.is_empty() {
        String::new()
    } else {
        format!(", in {pointer}")
    }
}

fn place(pointer: &str) -> &str {
    if pointer.is_empty() {
        "the document"
    } else {
        pointer
    }
}
