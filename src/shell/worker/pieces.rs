//! Pieces of a subject in messages: a word for the kind of the piece, and what it holds. A new piece is one more arm in
//! each of the two functions here; what is heavy in it travels as a typed array, which is moved and not copied.

use js_sys::{Float32Array, Int16Array, Uint8Array, Uint16Array};
use serde_json::Value;
use wasm_bindgen::prelude::*;

use super::header::{json_of, volume_of};
use crate::data::{SubjectPart, Voxels};

/// The word of a piece, and what it holds.
pub fn packed(part: SubjectPart) -> (&'static str, JsValue) {
    match part {
        SubjectPart::Volume(header) => ("begin", json_of(&header).to_string().into()),
        SubjectPart::Scalars(voxels) => ("scalars", array_of(&voxels)),
        SubjectPart::Labels(labels) => ("labels", Uint8Array::from(labels.as_slice()).into()),
    }
}

/// A piece from [`packed`]; none if there is no such word, or if it goes with other contents.
pub fn unpacked(word: &str, held: &JsValue) -> Option<SubjectPart> {
    Some(match word {
        "begin" => SubjectPart::header(volume_of(&json(held)?)?),
        "scalars" => SubjectPart::Scalars(voxels_of(held)?),
        "labels" => SubjectPart::Labels(held.dyn_ref::<Uint8Array>()?.to_vec()),
        _ => return None,
    })
}

fn json(text: &JsValue) -> Option<Value> {
    serde_json::from_str(&text.as_string()?).ok()
}

fn array_of(voxels: &Voxels) -> JsValue {
    match voxels {
        Voxels::U8(v) => Uint8Array::from(v.as_slice()).into(),
        Voxels::I16(v) => Int16Array::from(v.as_slice()).into(),
        Voxels::U16(v) => Uint16Array::from(v.as_slice()).into(),
        Voxels::F32(v) => Float32Array::from(v.as_slice()).into(),
    }
}

fn voxels_of(array: &JsValue) -> Option<Voxels> {
    if let Some(a) = array.dyn_ref::<Uint8Array>() {
        return Some(Voxels::U8(a.to_vec()));
    }
    if let Some(a) = array.dyn_ref::<Int16Array>() {
        return Some(Voxels::I16(a.to_vec()));
    }
    if let Some(a) = array.dyn_ref::<Uint16Array>() {
        return Some(Voxels::U16(a.to_vec()));
    }
    array
        .dyn_ref::<Float32Array>()
        .map(|a| Voxels::F32(a.to_vec()))
}
