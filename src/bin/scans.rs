//! The part of the page that reads scans and holds their decoders, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica::shell::worker::scans;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

fn main() {
    #[cfg(target_arch = "wasm32")]
    scans::loaded();
}

/// See [`scans::run`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub async fn run(message: JsValue) -> Result<Option<String>, JsValue> {
    scans::run(message).await
}

/// See [`scans::voxels`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub async fn voxels(message: JsValue) -> Result<JsValue, JsValue> {
    scans::voxels(message).await
}
