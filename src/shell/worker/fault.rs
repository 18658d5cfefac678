//! Faults in a worker, and errors of the browser as text.

use std::cell::RefCell;

use js_sys::{Array, Reflect};
use wasm_bindgen::prelude::*;
use web_sys::DedicatedWorkerGlobalScope;

/// What the page tells the reader of a part that panicked; web/worker.js says the same of one that could not be loaded.
const STOPPED: &str = "The background thread that loads scans stopped because of a fault";

thread_local! {
    /// Takes the answers in place of the worker's own scope, where there is no worker (web/inline.js).
    static SCOPE: RefCell<Option<JsValue>> = const { RefCell::new(None) };
}

/// From now on answers go to whom the message of a task names, if it names anybody.
pub fn heed_scope(message: &JsValue) {
    let scope = Reflect::get(message, &"scope".into()).ok();
    SCOPE.set(scope.filter(JsValue::is_object));
}

/// The global scope of the worker that this runs in, or what stands for it.
pub fn scope() -> DedicatedWorkerGlobalScope {
    let other = SCOPE.with_borrow(Clone::clone);
    other
        .unwrap_or_else(|| js_sys::global().into())
        .unchecked_into()
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
