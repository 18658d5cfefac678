//! The part of the page that reads meshes and prepares them, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica::shell::worker::meshes;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

fn main() {
    #[cfg(target_arch = "wasm32")]
    meshes::loaded();
}

/// See [`meshes::run`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub async fn run(message: JsValue, load: js_sys::Function) -> Result<Option<String>, JsValue> {
    meshes::run(message, load).await
}
