//! Faults in a worker, and errors of the browser as text.

use js_sys::Array;
use wasm_bindgen::prelude::*;
use web_sys::DedicatedWorkerGlobalScope;

/// What the page tells the reader of a part that panicked; web/worker.js says the same of one that could not be loaded.
const STOPPED: &str = "The background thread that loads scans stopped because of a fault";

/// The global scope of the worker that this runs in.
pub fn scope() -> DedicatedWorkerGlobalScope {
    js_sys::global().unchecked_into()
}

/// From now on the text of a panic goes to the page as the failure of the task. The panic itself ends the worker.
pub fn report_panics() {
    std::panic::set_hook(Box::new(|info| {
        let message = Array::of3(&"failed".into(), &STOPPED.into(), &info.to_string().into());
        let _page_is_gone = scope().post_message(&message);
    }));
}

/// An error of the browser as text.
pub fn text_of(error: &JsValue) -> String {
    error
        .dyn_ref::<js_sys::Error>()
        .map(|e| String::from(e.message()))
        .or_else(|| error.as_string())
        .unwrap_or_else(|| format!("{error:?}"))
}
