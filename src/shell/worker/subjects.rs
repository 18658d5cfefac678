//! The part that makes the built-in subjects.

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use super::answer::post;
use super::fault;
use super::task::{Part, limits_of};
use crate::assets::LoadEvent;
use crate::shell::loading::{make_subject, resolutions, slabs_in_turn};

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js.
///
/// # Errors
/// If the message is no task.
pub fn run(message: JsValue) -> Result<(), JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message, Part::Subjects)?;
    let get = |key: &str| Reflect::get(&message, &key.into());
    let name = get("builtin")?.as_string().unwrap_or_default();
    let revision = get("revision")?.as_f64().map_or(1, |n| n as u32);
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    let both = resolutions(limits_of(&message)?);
    let one = get("resolution")?
        .as_f64()
        .map(|resolution| [resolution as u32]);
    let wanted = one.as_ref().map_or(both.as_slice(), |one| one.as_slice());
    make_subject((&name, revision), wanted, slabs_in_turn, &mut post);
    Ok(())
}
