//! Pictures for other parts, unpacked by the part that holds the decoders.

use js_sys::{Array, Function, Promise, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;

use super::task::Part;
use crate::pictures::Picture;

/// Has a picture unpacked. `load` gives a promise of another part's functions by its name.
///
/// # Errors
/// In words: why the file gives no picture, or that the part could not be loaded.
pub(super) async fn unpacked(packed: &[u8], load: &Function) -> Result<Picture, JsValue> {
    let part: Promise = load
        .call1(&JsValue::NULL, &Part::Pictures.name().into())?
        .unchecked_into();
    let part = JsFuture::from(part).await?;
    let decode: Function = Reflect::get(&part, &"decode".into())?.unchecked_into();
    let found = decode.call1(&part, &Uint8Array::from(packed))?;
    let found: Array = found.dyn_into()?;
    let side = |index: u32| found.get(index).as_f64().unwrap_or_default() as u32;
    let pixels: Uint8Array = found.get(3).dyn_into()?;
    Ok(Picture {
        size: [side(0), side(1)],
        pixels: pixels.to_vec().as_chunks().0.to_vec(),
        is_of_inks: found.get(2).is_truthy(),
    })
}
