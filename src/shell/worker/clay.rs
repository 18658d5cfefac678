//! The part that shapes clays.

use std::cell::RefCell;
use std::sync::Arc;

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use super::answer::post;
use super::blobs::{BlobFiles, fetch, name_of, not_fetched};
use super::fault;
use super::pieces::unpacked_grids;
use super::task::{Part, ScanTask};
use crate::assets::LoadEvent;
use crate::document::clay_from_text;
use crate::load::mesh_among;
use crate::shell::clays::{ClayDesk, NO_SCANS, make_clay, make_clay_of_file};

thread_local! {
    /// What the last clay's strokes left: a worker rests between strokes.
    static DESK: RefCell<ClayDesk> = RefCell::default();
}

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js.
///
/// # Errors
/// If the message is no task, or the page cannot take the answer.
pub async fn run(message: JsValue) -> Result<(), JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message, Part::Clay)?;
    let text = Reflect::get(&message, &"clay".into())?;
    let clay = clay_from_text(&text.as_string().unwrap_or_default());
    let clay = Arc::new(clay.map_err(|error| JsValue::from(error.to_string()))?);
    let meshes = unpacked_grids(&Reflect::get(&message, &"meshes".into())?);
    DESK.with_borrow_mut(|desk| desk.take_meshes(&meshes));
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    if clay.file().is_none() {
        DESK.with_borrow_mut(|desk| make_clay(desk, &clay, &mut post));
        return Ok(());
    }
    if clay.volume().is_some() {
        // Not even fetched.
        return post::event(LoadEvent::Failed {
            message: NO_SCANS.to_owned(),
            details: String::new(),
            fault: None,
        });
    }
    let (mut files, name) = match ScanTask::of(&message)? {
        ScanTask::Address { address, .. } => match fetch(&address).await {
            Ok(blob) => {
                let name = name_of(&address);
                (BlobFiles::new(vec![(name.clone(), blob)]).await?, name)
            }
            Err(error) => return post::event(not_fetched("mesh", &address, &error)),
        },
        ScanTask::Files { files, .. } => {
            let first = files.first().map(|file| file.0.clone());
            let (mut files, names) = BlobFiles::of_all(files).await?;
            let name = mesh_among(&mut files, &names).or(first);
            (files, name.unwrap_or_default())
        }
        ScanTask::Mesh(..) | ScanTask::Field { .. } => return Err("a clay without a file".into()),
    };
    DESK.with_borrow_mut(|desk| make_clay_of_file(desk, &clay, (&mut files, &name), &mut post));
    Ok(())
}
