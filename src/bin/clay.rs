//! The part of the page that shapes clays, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica::shell::worker::clay;
#[cfg(target_arch = "wasm32")]
use js_sys::Function;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

fn main() {
    #[cfg(target_arch = "wasm32")]
    clay::loaded();
}

/// See [`clay::run`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub async fn run(message: JsValue, load: Function) -> Result<(), JsValue> {
    clay::run(message, load).await
}
