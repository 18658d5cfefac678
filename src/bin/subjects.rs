//! The part of the page that makes the built-in subjects, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica::shell::worker::subjects;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

fn main() {
    #[cfg(target_arch = "wasm32")]
    subjects::loaded();
}

/// See [`subjects::run`].
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
pub fn run(message: JsValue) -> Result<(), JsValue> {
    subjects::run(message)
}
