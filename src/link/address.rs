//! Addresses: finds the payload in an address, and the version that reads the payload.

use super::error::LinkError;
use super::payload::is_whole;
use super::v1;
use crate::document::Document;

/// Characters above which the app advises a document file instead of a link: some programs cut longer addresses.
pub const ADVISED_LENGTH: usize = 2000;

/// The content of an address.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The document that the payload holds.
    pub document: Document,
    /// The step to open it at, from `&step=`; 0 if there is none. May be larger than the number of steps.
    pub step: usize,
}

/// The document's payload, in the newest version. Takes a few milliseconds.
pub fn encode(document: &Document) -> String {
    v1::encode(document)
}

/// The part of an address after the page: `#<payload>`, and `&step=3` unless the step is 0.
pub fn fragment(document: &Document, step: usize) -> String {
    let payload = encode(document);
    match step {
        0 => format!("#{payload}"),
        step => format!("#{payload}&step={step}"),
    }
}

/// Reads a link as [`decode`] does, or a document as JSON; a byte order mark before it is left out.
///
/// # Errors
/// In words: the first fault of the link or of the document.
pub fn document_of(text: &str) -> Result<Link, String> {
    let text = text.trim_start_matches('\u{feff}').trim();
    if !text.starts_with('{') {
        return decode(text).map_err(|error| error.to_string());
    }
    let document = Document::from_json(text).map_err(|error| error.to_string())?;
    Ok(Link { document, step: 0 })
}

/// Reads a whole address, a fragment, a query with `s=`, or a bare payload.
///
/// Total: any text gives a document or an error, in bounded time and memory, and depends on the text alone.
///
/// # Errors
/// The first fault; see [`LinkError`].
pub fn decode(text: &str) -> Result<Link, LinkError> {
    let (payload, rest) = find(text.trim()).ok_or(LinkError::Empty)?;
    Ok(Link {
        document: decode_payload(payload)?,
        step: step_of(rest),
    })
}

/// True if an address holds a payload that is whole. It goes before all else that the address names; what is none may
/// be the mark of a place in a page (`#top`).
pub fn has_payload(text: &str) -> bool {
    find(text.trim()).is_some_and(|(payload, _)| is_whole(payload))
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
        // The step may stand anywhere in the query.
        cut(start).map(|(payload, _)| (payload, query))
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

/// Splits a text at the first character that no payload has.
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
