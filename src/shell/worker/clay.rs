//! The part that shapes clays.

use std::sync::Arc;

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use super::answer::post;
use super::fault;
use super::task::Part;
use crate::assets::LoadEvent;
use crate::document::clay_from_text;
use crate::shell::clays::{ClayDesk, make_clay};

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js.
///
/// # Errors
/// If the message is no task, or the page cannot take the answer.
pub fn run(message: JsValue) -> Result<(), JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message, Part::Clay)?;
    let text = Reflect::get(&message, &"clay".into())?;
    let clay = clay_from_text(&text.as_string().unwrap_or_default());
    let clay = clay.map_err(|error| JsValue::from(error.to_string()))?;
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    make_clay(&mut ClayDesk::default(), &Arc::new(clay), &mut post);
    Ok(())
}
