//! The part that holds the decoders of pictures. It does no task of its own: other parts call it, in their worker.

use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;

use crate::pictures;

/// Width, height, whether it is of inks, and the pixels of a picture; see [`pictures::Picture`].
///
/// # Errors
/// In words: why the file gives no picture.
pub fn decode(packed: &[u8]) -> Result<Array, JsValue> {
    let picture = pictures::decode(packed).map_err(|error| error.to_string())?;
    let [width, height] = picture.size;
    let pixels = Uint8Array::from(picture.pixels.as_flattened());
    Ok(Array::of4(
        &width.into(),
        &height.into(),
        &picture.is_of_inks.into(),
        &pixels,
    ))
}
