//! The part of the page that reads figures and bends them, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica::shell::worker::figures;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

fn main() {
    #[cfg(target_arch = "wasm32")]
    figures::loaded();
}

/// See [`figures::run`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub async fn run(message: JsValue, load: js_sys::Function) -> Result<Option<String>, JsValue> {
    figures::run(message, load).await
}

/// See [`figures::dismiss`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub fn dismiss(bender: u32) {
    figures::dismiss(bender);
}
