//! Pictures for other parts, unpacked by the part that holds the decoders.

use js_sys::{Array, Function, Uint8Array};
use wasm_bindgen::prelude::*;

use super::other;
use super::task::Part;
use crate::pictures::Picture;

/// Has a picture unpacked. `load` gives a promise of another part's functions by its name.
///
/// # Errors
/// In words: why the file gives no picture, or that the part could not be loaded.
pub(super) async fn unpacked(packed: &[u8], load: &Function) -> Result<Picture, JsValue> {
    let packed = Uint8Array::from(packed);
    let found = other::call(load, Part::Pictures, "decode", &packed).await?;
    let found: Array = found.dyn_into()?;
    let side = |index: u32| found.get(index).as_f64().unwrap_or_default() as u32;
    let pixels: Uint8Array = found.get(3).dyn_into()?;
    Ok(Picture {
        size: [side(0), side(1)],
        pixels: pixels.to_vec().as_chunks().0.to_vec(),
        is_of_inks: found.get(2).is_truthy(),
    })
}
