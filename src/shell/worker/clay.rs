//! The part that shapes clays.

use std::cell::RefCell;
use std::sync::Arc;

use js_sys::{Array, Function, Promise, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;

use super::answer::post;
use super::blobs::{BlobFiles, fetch, name_of, not_fetched};
use super::fault;
use super::other;
use super::pieces::{unpacked, unpacked_grids};
use super::task::{Part, ScanTask, text_of_reading};
use crate::assets::LoadEvent;
use crate::clay::{MeshFormat, Writing};
use crate::data::{SubjectSink as _, VolumeBuilder};
use crate::document::{Clay, ClayVolume, VoxelSource, clay_from_text};
use crate::load::mesh_among;
use crate::shell::clays::{
    ClayDesk, Purpose, make_clay, make_clay_of_file, make_clay_of_volume, whole,
};

thread_local! {
    /// What the last clay's strokes left: a worker rests between strokes.
    static DESK: RefCell<ClayDesk> = RefCell::default();
}

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js. `load` gives a promise of another part's functions by its name.
///
/// # Errors
/// If the message is no task, or the page cannot take the answer.
pub async fn run(message: JsValue, load: Function) -> Result<(), JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message, Part::Clay)?;
    let text = Reflect::get(&message, &"clay".into())?;
    let clay = clay_from_text(&text.as_string().unwrap_or_default());
    let clay = Arc::new(clay.map_err(|error| JsValue::from(error.to_string()))?);
    let meshes = unpacked_grids(&Reflect::get(&message, &"meshes".into())?);
    let word = |key: &str| Reflect::get(&message, &key.into()).map(|word| word.as_string());
    let format = word("format")?.and_then(|end| MeshFormat::of_extension(&end));
    let title = word("title")?.unwrap_or_default();
    let is_sketch = Reflect::get(&message, &"sketch".into())?.is_truthy();
    let purpose = match format {
        Some(format) => Purpose::Write(Writing { format, title }),
        None if is_sketch => Purpose::Sketch,
        None => Purpose::Show,
    };
    DESK.with_borrow_mut(|desk| desk.take_meshes(&meshes));
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    if clay.file().is_none() {
        DESK.with_borrow_mut(|desk| make_clay(desk, &clay, &purpose, &mut post));
        return Ok(());
    }
    if let Some(meant) = clay.volume() {
        return of_scan(&clay, meant, (&message, &load), &purpose).await;
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
    DESK.with_borrow_mut(|desk| {
        make_clay_of_file(desk, &clay, (&mut files, &name), &purpose, &mut post)
    });
    Ok(())
}

/// Shapes a clay that begins with a part of a scan. The part that reads scans reads it, in this worker.
async fn of_scan(
    clay: &Arc<Clay>,
    meant: &ClayVolume,
    (message, load): (&JsValue, &Function),
    purpose: &Purpose,
) -> Result<(), JsValue> {
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    // A file that the document names by its hash is known before it is looked at.
    if DESK.with_borrow(|desk| desk.begun(clay, || None)).is_some() {
        DESK.with_borrow_mut(|desk| make_clay(desk, clay, purpose, &mut post));
        return Ok(());
    }
    if let VoxelSource::File { reading, .. } = &meant.of {
        Reflect::set(message, &"reading".into(), &text_of_reading(reading).into())?;
    }
    let read = other::call(load, Part::Scans, "voxels", message).await?;
    let read: Promise = read.unchecked_into();
    // Without one the reader has told why.
    let Ok(read) = JsFuture::from(read).await?.dyn_into::<Array>() else {
        return Ok(());
    };
    let name = read.get(0).as_string().unwrap_or_default();
    let sha256 = read.get(1).dyn_ref::<Uint8Array>().map(Uint8Array::to_vec);
    let sha256 = sha256.and_then(|hash| hash.try_into().ok());
    let mut builder = VolumeBuilder::new();
    for piece in read.get(2).unchecked_into::<Array>().iter() {
        let piece: Array = piece.unchecked_into();
        let word = piece.get(0).as_string().unwrap_or_default();
        let part = unpacked(&word, &piece.get(1)).ok_or("a piece of another kind")?;
        builder.take(part)?;
    }
    match whole(builder, &name) {
        Ok(volume) => DESK.with_borrow_mut(|desk| {
            make_clay_of_volume(desk, clay, (&volume, &name), sha256, purpose, &mut post);
        }),
        Err(error) => post::event(LoadEvent::Failed {
            message: error.to_string(),
            details: String::new(),
            fault: error.fault(),
        })?,
    }
    Ok(())
}
