//! The part of the page that holds the decoders of pictures, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica::shell::worker::pictures;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

fn main() {}

/// See [`pictures::decode`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub fn decode(packed: &[u8]) -> Result<js_sys::Array, JsValue> {
    pictures::decode(packed)
}
