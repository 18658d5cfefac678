use thiserror::Error;

/// Why a text is no document, or an edit would make none. Places are JSON pointers (RFC 6901).
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// The text is no JSON.
    #[error("not JSON at line {line}, column {column}{}: {problem}", at(.pointer))]
    Syntax {
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// The value that was being read.
        pointer: String,
        /// What was expected or came.
        problem: &'static str,
    },
    /// NaN, an infinity, or a number that no 64-bit float holds.
    #[error("{pointer}: {found} is not a finite number")]
    NotFinite {
        /// Where.
        pointer: String,
        /// As written, shortened.
        found: String,
    },
    /// A value of the wrong type or shape.
    #[error("{}: expected {expected}, found {found}", place(.pointer))]
    WrongType {
        /// Where.
        pointer: String,
        /// What belongs there.
        expected: &'static str,
        /// What came.
        found: String,
    },
    /// An object names a key twice, so that it could be read in two ways.
    #[error("{pointer}: the key is there twice")]
    DuplicateKey {
        /// Where.
        pointer: String,
    },
    /// A quaternion of length zero turns nothing.
    #[error("{pointer}: a rotation of length 0 has no direction")]
    ZeroRotation {
        /// Where.
        pointer: String,
    },
    /// The number of the format is missing.
    #[error("/fabrica: not a Fabrica document (the format's number is missing)")]
    NoVersion,
    /// Made by a later release.
    #[error(
        "/fabrica: the document has format {found}, this program reads up to {}; a newer release opens it",
        super::FORMAT
    )]
    TooNew {
        /// The document's format, as written.
        found: String,
    },
    /// More entries than a document may have.
    #[error("{pointer}: {found} {what}, at most {limit} are allowed")]
    TooMany {
        /// Where.
        pointer: String,
        /// Of what.
        what: &'static str,
        /// How many came.
        found: usize,
        /// How many may.
        limit: usize,
    },
    /// Longer than a document may be.
    #[error("the document has {found} bytes, at most {limit} are allowed")]
    TooLarge {
        /// Bytes of JSON.
        found: usize,
        /// Bytes allowed.
        limit: usize,
    },
    /// Nested deeper than a document may be.
    #[error("{}: nested deeper than {limit} levels", place(.pointer))]
    TooDeep {
        /// Where, shortened.
        pointer: String,
        /// Levels allowed.
        limit: usize,
    },
    /// A text that is no JSON pointer.
    #[error("“{pointer}” is not a JSON pointer (it starts with / and writes ~ as ~0)")]
    BadPointer {
        /// As it came.
        pointer: String,
    },
    /// A pointer that may not be set.
    #[error("{pointer}: may not be set by a step")]
    Refused {
        /// Where.
        pointer: String,
    },
    /// A pointer to nothing.
    #[error("{pointer}: there is nothing there")]
    NotFound {
        /// Where.
        pointer: String,
    },
    /// A step that the document has not.
    #[error("there is no step {step}: the document has steps 0 to {last}")]
    NoSuchStep {
        /// Asked for.
        step: usize,
        /// The last there is.
        last: usize,
    },
    /// In what a step sets.
    #[error("{pointer}: step {step} makes the document wrong: {source}")]
    Step {
        /// The entry of the step's `set`, or the step.
        pointer: String,
        /// Number of the step, from 1.
        step: usize,
        /// What is wrong then.
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
