//! Functions of another part, which the page's script loads into the same worker.

use js_sys::{Function, Promise, Reflect};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;

use super::task::Part;

/// Calls a function of another part by its name. `load` gives a promise of another part's functions by its name.
///
/// # Errors
/// In words: what the function says, or that the part could not be loaded.
pub(super) async fn call(
    load: &Function,
    part: Part,
    name: &str,
    argument: &JsValue,
) -> Result<JsValue, JsValue> {
    let functions: Promise = load
        .call1(&JsValue::NULL, &part.name().into())?
        .unchecked_into();
    let functions = JsFuture::from(functions).await?;
    let function: Function = Reflect::get(&functions, &name.into())?.unchecked_into();
    function.call1(&functions, argument)
}
