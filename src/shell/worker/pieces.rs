//! Pieces of a subject in messages: a word for the kind of the piece, and what it holds. A new piece is one more arm in
//! each of the two functions here; what is heavy in it travels as a typed array, which is moved and not copied.

use std::sync::Arc;

use js_sys::{Array, Float32Array, Float64Array, Int16Array, Uint8Array, Uint16Array, Uint32Array};
use serde_json::Value;
use wasm_bindgen::prelude::*;

use super::header::{json_of, volume_of};
use crate::data::{SubjectPart, Surface, SurfaceArrays, Voxels};

/// The word of a piece, and what it holds.
pub fn packed(part: SubjectPart) -> (&'static str, JsValue) {
    match part {
        SubjectPart::Volume(header) => ("begin", json_of(&header).to_string().into()),
        SubjectPart::Scalars(voxels) => ("scalars", array_of(&voxels)),
        SubjectPart::Labels(labels) => ("labels", Uint8Array::from(labels.as_slice()).into()),
        SubjectPart::Surface(surface) => ("surface", packed_surface(&surface)),
    }
}

/// A piece from [`packed`]; none if there is no such word, or if it goes with other contents.
pub fn unpacked(word: &str, held: &JsValue) -> Option<SubjectPart> {
    Some(match word {
        "begin" => SubjectPart::header(volume_of(&json(held)?)?),
        "scalars" => SubjectPart::Scalars(voxels_of(held)?),
        "labels" => SubjectPart::Labels(held.dyn_ref::<Uint8Array>()?.to_vec()),
        "surface" => SubjectPart::Surface(Arc::new(unpacked_surface(held)?)),
        _ => return None,
    })
}

/// The arrays of a surface, in their order.
fn packed_surface(surface: &Surface) -> JsValue {
    let arrays = SurfaceArrays::of(surface);
    let packed: [JsValue; 8] = [
        serde_json::json!(arrays.names).to_string().into(),
        Float64Array::from(arrays.places.as_slice()).into(),
        Float32Array::from(arrays.numbers.as_slice()).into(),
        Uint32Array::from(arrays.indices.as_slice()).into(),
        Uint8Array::from(arrays.bytes.as_slice()).into(),
        Float32Array::from(arrays.carver_numbers.as_slice()).into(),
        Uint32Array::from(arrays.carver_levels.as_slice()).into(),
        Uint32Array::from(arrays.carver_texels.as_slice()).into(),
    ];
    packed.iter().collect::<Array>().into()
}

fn unpacked_surface(held: &JsValue) -> Option<Surface> {
    let held = held.dyn_ref::<Array>()?;
    let names = json(&held.get(0))?;
    let arrays = SurfaceArrays {
        names: (names.as_array()?.iter())
            .map(|name| name.as_str().map(str::to_owned))
            .collect::<Option<_>>()?,
        places: held.get(1).dyn_into::<Float64Array>().ok()?.to_vec(),
        numbers: held.get(2).dyn_into::<Float32Array>().ok()?.to_vec(),
        indices: held.get(3).dyn_into::<Uint32Array>().ok()?.to_vec(),
        bytes: held.get(4).dyn_into::<Uint8Array>().ok()?.to_vec(),
        carver_numbers: held.get(5).dyn_into::<Float32Array>().ok()?.to_vec(),
        carver_levels: held.get(6).dyn_into::<Uint32Array>().ok()?.to_vec(),
        carver_texels: held.get(7).dyn_into::<Uint32Array>().ok()?.to_vec(),
    };
    arrays.surface()
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
