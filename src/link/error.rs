//! Why an address holds no document.

use crate::document::DocumentError;
use thiserror::Error;

/// Why an address holds no document.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LinkError {
    /// There is no payload.
    #[error("the link is empty: nothing stands after its #")]
    Empty,
    /// The text was not made by this program, or is damaged at its beginning.
    #[error("this is not a Fabrica link: “{found}”")]
    Foreign {
        /// The first characters of the text.
        found: String,
    },
    /// The link was made by a later release.
    #[error("the link has version {version}, this program reads up to 1; a newer release opens it")]
    NewerVersion {
        /// The character that names the version.
        version: char,
    },
    /// The end of the payload is missing.
    #[error("the link is cut off: {found} of {expected} characters are there")]
    CutOff {
        /// Number of characters that came.
        found: usize,
        /// Number of characters that the payload says it has.
        expected: usize,
    },
    /// A character was changed on the way.
    #[error("the link is damaged: its checksum does not fit")]
    Damaged,
    /// The payload decodes to more bytes than a document may have.
    #[error("the link holds more than {limit} bytes, which no document has")]
    TooLarge {
        /// Bytes that a document may have.
        limit: usize,
    },
    /// The payload is whole, but it holds no valid document.
    #[error("the link holds no valid document: {0}")]
    Document(#[from] DocumentError),
}
