//! Layer 2: a document as the fragment of an address, and back.
//!
//! A payload is made of `A-Z a-z 0-9 - _` only: one character for the version, then what that version says, then five
//! characters of checksum over all before them. Each version has its file, and every version that was ever released
//! stays readable.
//!
//! ```
//! use fabrica::document::Document;
//! use fabrica::link;
//!
//! let document = Document::from_json(r#"{ "fabrica": 1, "subject": { "builtin": "bar" }, "templates": [{ "kind": "peel" }] }"#)?;
//! let address = format!("https://example.org/lesson{}", link::fragment(&document, 2));
//! let read = link::decode(&format!("{address}&from=course-7"))?;
//! assert_eq!((read.document, read.step), (document, 2));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod model;
mod v1;

use crate::document::{Document, DocumentError, MAX_BYTES};
use thiserror::Error;

/// Above this many characters the app advises a document file: some programs cut longer addresses.
pub const ADVISED_LENGTH: usize = 2000;

/// What an address holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The illustration.
    pub document: Document,
    /// The step to open it at, from `&step=`; 0 if it says none. May be larger than there are steps.
    pub step: usize,
}

/// Why an address holds no document.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LinkError {
    /// No payload at all.
    #[error("the link is empty: nothing stands after its #")]
    Empty,
    /// Not made by this program, or damaged at its beginning.
    #[error("this is not a Fabrica link: “{found}”")]
    Foreign {
        /// How it begins.
        found: String,
    },
    /// Made by a later release.
    #[error("the link has version {version}, this program reads up to 1; a newer release opens it")]
    NewerVersion {
        /// The version's character.
        version: char,
    },
    /// The end is missing.
    #[error("the link is cut off: {found} of {expected} characters are there")]
    CutOff {
        /// Characters that came.
        found: usize,
        /// Characters that it says it has.
        expected: usize,
    },
    /// Some character is another one than was written.
    #[error("the link is damaged: its checksum does not fit")]
    Damaged,
    /// Decodes to more than a document may be.
    #[error("the link holds more than {limit} bytes, which no document has")]
    TooLarge {
        /// Bytes allowed.
        limit: usize,
    },
    /// Whole, but what it holds is no document.
    #[error("the link holds no valid document: {0}")]
    Document(#[from] DocumentError),
}

/// The document's payload, in the newest version. Takes a few milliseconds.
pub fn encode(document: &Document) -> String {
    v1::encode(document)
}

/// What goes behind a page's address: `#<payload>`, and `&step=3` unless the step is 0.
pub fn fragment(document: &Document, step: usize) -> String {
    let payload = encode(document);
    match step {
        0 => format!("#{payload}"),
        step => format!("#{payload}&step={step}"),
    }
}

/// Reads a whole address, a fragment, a query with `s=`, or a bare payload.
///
/// Total: any text gives a document or an error, in bounded time and memory, and depends on the text alone.
///
/// # Errors
/// What is wrong with it; see [`LinkError`].
pub fn decode(text: &str) -> Result<Link, LinkError> {
    let (payload, rest) = find(text.trim()).ok_or(LinkError::Empty)?;
    Ok(Link {
        document: decode_payload(payload)?,
        step: step_of(rest),
    })
}

/// True if an address says anything that is meant as a payload: a page opened without one shows its own start.
pub fn has_payload(text: &str) -> bool {
    find(text.trim()).is_some()
}

/// The payload in a text, and what follows it.
fn find(text: &str) -> Option<(&str, &str)> {
    let (before, fragment) = match text.split_once('#') {
        Some((before, fragment)) => (before, Some(fragment)),
        None => (text, None),
    };
    let query = before.split_once('?').map(|(_, query)| query);
    let from_query = query.and_then(|query| {
        let start = query.split('&').find_map(|pair| pair.strip_prefix("s="))?;
        // The rest of the query may hold the step.
        let at = start.as_ptr() as usize - query.as_ptr() as usize;
        cut(query.get(at..)?)
    });
    let from_fragment = fragment.and_then(cut);
    let bare = (fragment.is_none() && query.is_none() && !text.contains([':', '/', '.']))
        .then(|| cut(text))
        .flatten();
    // A page may use its fragment for something else (`#top`), as long as the query holds the payload.
    match (from_fragment, from_query) {
        (Some(fragment), Some(query)) if !is_whole(fragment.0) => Some(query),
        (Some(fragment), _) => Some(fragment),
        (None, query) => query.or(bare),
    }
}

/// Up to the first character that no payload has.
fn cut(text: &str) -> Option<(&str, &str)> {
    let end = text
        .find(|c: char| !(c.is_ascii_alphanumeric() || matches!(c, '-' | '_')))
        .unwrap_or(text.len());
    (end > 0).then(|| text.split_at(end))
}

fn step_of(rest: &str) -> usize {
    rest.split(['&', '#'])
        .find_map(|pair| {
            let digits = pair.strip_prefix("step=")?;
            let end = digits
                .find(|c: char| !c.is_ascii_digit())
                .unwrap_or(digits.len());
            digits.get(..end.min(6))?.parse().ok()
        })
        .unwrap_or(0)
}

fn decode_payload(payload: &str) -> Result<Document, LinkError> {
    match payload.chars().next() {
        None => Err(LinkError::Empty),
        Some(v1::VERSION) => v1::decode(payload),
        // Every version ends alike, so a whole link of a later one can be told from a foreign text.
        Some(version) if version.is_ascii_digit() && is_whole(payload) => {
            Err(LinkError::NewerVersion { version })
        }
        Some(_) => Err(LinkError::Foreign {
            found: match payload.get(..16) {
                Some(start) => format!("{start}…"),
                None => payload.to_owned(),
            },
        }),
    }
}

/// The alphabet, by value (RFC 4648, section 5).
const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// Characters of the checksum.
const CHECK_LENGTH: usize = 5;

/// CRC-30 (polynomial 0x2030B9C7, as in CDMA) over characters: finds every burst of errors up to 30 bits, so any
/// single wrong character, and all but one in a billion of the rest.
fn checksum(text: &str) -> [u8; CHECK_LENGTH] {
    let mut crc = 0x3fff_ffff_u32;
    for byte in text.bytes() {
        for i in (0..8).rev() {
            let bit = (u32::from(byte) >> i) & 1;
            let top = (crc >> 29) & 1;
            crc = (crc << 1) & 0x3fff_ffff;
            if top ^ bit == 1 {
                crc ^= 0x2030_b9c7;
            }
        }
    }
    crc ^= 0x3fff_ffff;
    std::array::from_fn(|i| ALPHABET[(crc >> (24 - 6 * i)) as usize & 63])
}

/// True if the last characters are the checksum of those before.
fn is_whole(payload: &str) -> bool {
    payload
        .len()
        .checked_sub(CHECK_LENGTH)
        .and_then(|at| payload.split_at_checked(at))
        .is_some_and(|(text, check)| !text.is_empty() && check.as_bytes() == checksum(text))
}

/// Bytes of a document at most, as links see it.
const LIMIT: usize = MAX_BYTES;
