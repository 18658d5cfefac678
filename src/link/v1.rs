//! Version 1: `1`, the number of characters of the code, the code, the checksum.
//!
//! The number is written in groups of five bits, lowest first, the sixth bit saying that more follow. The code is the
//! canonical JSON of the document without its opening, through [`super::model`], in base 64.

use super::error::LinkError;
use super::model;
use super::payload::{ALPHABET, CHECK_LENGTH, LIMIT, checksum, is_whole};
use crate::document::Document;
use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use std::sync::LazyLock;

/// How payloads of this version begin.
pub(super) const VERSION: char = '1';

/// The model after the priming text. Built once (some milliseconds, 6 MB), cloned per link.
static PRIMED: LazyLock<model::Model> = LazyLock::new(model::Model::new);

pub(super) fn encode(document: &Document) -> String {
    let text = document.to_json_compact();
    // Every document of format 1 begins with the opening; see the order of keys in `document::schema`.
    let rest = text.strip_prefix(model::OPENING).unwrap_or("}");
    let code = URL_SAFE_NO_PAD.encode(model::compress(PRIMED.clone(), rest.as_bytes()));
    let mut payload = String::with_capacity(code.len() + 12);
    payload.push(VERSION);
    let mut length = code.len();
    loop {
        let more = if length >= 32 { 32 } else { 0 };
        payload.push(char::from(ALPHABET[(length & 31) | more]));
        length >>= 5;
        if more == 0 {
            break;
        }
    }
    payload.push_str(&code);
    let check = checksum(&payload);
    payload.extend(check.map(char::from));
    payload
}

/// Reads a payload that begins with [`VERSION`] and holds characters of the alphabet only.
pub(super) fn decode(payload: &str) -> Result<Document, LinkError> {
    let code = code_of(payload)?;
    let code = URL_SAFE_NO_PAD
        .decode(code)
        .map_err(|_not_base64| LinkError::Damaged)?;
    let room = LIMIT - model::OPENING.len();
    let rest = model::decompress(PRIMED.clone(), &code, room).map_err(|broken| match broken {
        model::Broken::TooLarge => LinkError::TooLarge { limit: LIMIT },
        model::Broken::Short => LinkError::Damaged,
    })?;
    let rest = String::from_utf8(rest).map_err(|_not_utf8| LinkError::Damaged)?;
    Ok(Document::from_json(&format!("{}{rest}", model::OPENING))?)
}

/// The code between the length and the checksum, after both were checked.
fn code_of(payload: &str) -> Result<&str, LinkError> {
    let bytes = payload.as_bytes();
    let cut_off = |expected| LinkError::CutOff {
        found: payload.len(),
        expected,
    };
    let mut length = 0_usize;
    let mut at = 1;
    loop {
        let Some(byte) = bytes.get(at) else {
            return Err(cut_off(at + 1 + CHECK_LENGTH));
        };
        let value = ALPHABET
            .iter()
            .position(|letter| letter == byte)
            .ok_or(LinkError::Damaged)?;
        // Five groups of five bits hold a larger number than the length of any document.
        if at > 5 {
            return Err(LinkError::Damaged);
        }
        length |= (value & 31) << (5 * (at - 1));
        at += 1;
        if value & 32 == 0 {
            break;
        }
    }
    let expected = at + length + CHECK_LENGTH;
    if payload.len() < expected {
        return Err(cut_off(expected));
    }
    if payload.len() > expected || !is_whole(payload) {
        return Err(LinkError::Damaged);
    }
    payload.get(at..at + length).ok_or(LinkError::Damaged)
}
