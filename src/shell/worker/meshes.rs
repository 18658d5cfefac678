//! The part that reads meshes and prepares them to be drawn.

use js_sys::Function;
use wasm_bindgen::prelude::*;

use super::answer::post;
use super::blobs::{BlobFiles, fetch, name_of, not_fetched};
use super::fault::{self, text_of};
use super::task::{Part, ScanTask};
use super::unpacking::unpacked;
use crate::assets::LoadEvent;
use crate::document::Reading;
use crate::load::{LoadError, LoadReport, mesh_among, names_beside, read_meshes};
use crate::shell::loading::{PostingSink, is_mesh_file};
use crate::shell::meshes::{Finishing, box_of, make_mesh, mesh_files};

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js. `load` gives a promise of another part's functions by its name.
/// Returns the name of the part that the task is for, if it is for another one.
///
/// # Errors
/// If the message is no task, or the page cannot take the answer.
pub async fn run(message: JsValue, load: Function) -> Result<Option<String>, JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message, Part::Meshes)?;
    match ScanTask::of(&message)? {
        ScanTask::Mesh(name, carves) => {
            let mut post = |event: LoadEvent| post::event(event).is_ok();
            make_mesh(&name, carves, &mut post);
            Ok(None)
        }
        ScanTask::Address {
            address,
            are_segments: false,
            reading,
        } => {
            let name = name_of(&address);
            match fetch(&address).await {
                Ok(blob) => {
                    let files = vec![(name.clone(), blob)];
                    let files = with_beside(files, &address, &reading).await?;
                    read(files, &name, &reading, &load).await
                }
                Err(error) => post::event(not_fetched("mesh", &address, &error)).map(|()| None),
            }
        }
        ScanTask::Files { files, reading, .. } => {
            let first = files.first().map(|f| f.0.clone()).unwrap_or_default();
            let (mut files, names) = BlobFiles::of_all(files).await?;
            let name = mesh_among(&mut files, &names).unwrap_or(first);
            read(files, &name, &reading, &load).await
        }
        _ => Ok(Some(Part::Scans.name().to_owned())),
    }
}

/// What lies at an address, with the other meshes of its document and what an OBJ asks for beside it. What cannot be
/// had is named by the reader.
async fn with_beside(
    mut files: Vec<(String, web_sys::Blob)>,
    address: &str,
    reading: &Reading,
) -> Result<BlobFiles, JsValue> {
    let others = reading.meshes.iter().skip(1);
    let others: Vec<String> = others.filter_map(|mesh| mesh.src.clone()).collect();
    let mut from: Vec<(String, String)> = files
        .iter()
        .map(|(name, _)| (name.clone(), address.to_owned()))
        .collect();
    for src in others {
        if let Ok(blob) = fetch(&src).await {
            files.push((src.clone(), blob));
            from.push((src.clone(), src));
        }
    }
    // A library is asked for by a mesh, a picture by a library.
    let mut held = BlobFiles::new(files.clone()).await?;
    while let Some((name, address)) = from.pop() {
        for beside in names_beside(&mut held, &name) {
            if files.iter().any(|(known, _)| *known == beside) {
                continue;
            }
            let path = String::from(js_sys::encode_uri_component(&beside));
            let address = web_sys::Url::new_with_base(&path, &address);
            let Some(address) = address.ok().map(|url| url.href()) else {
                continue;
            };
            if let Ok(blob) = fetch(&address).await {
                files.push((beside.clone(), blob));
                held = BlobFiles::new(files.clone()).await?;
                from.push((beside, address));
            }
        }
    }
    Ok(held)
}

/// Reads and prepares the meshes of a subject; the name of the part that reads scans if the file is none.
async fn read(
    mut files: BlobFiles,
    name: &str,
    reading: &Reading,
    load: &Function,
) -> Result<Option<String>, JsValue> {
    if matches!(is_mesh_file(&mut files, name, reading), Ok(false)) {
        return Ok(Some(Part::Scans.name().to_owned()));
    }
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    let mut sink = PostingSink::new(&mut post);
    let mut report = LoadReport::default();
    let outcome = prepare(&mut files, name, reading, load, &mut sink, &mut report).await;
    sink.end(outcome, &report, None);
    Ok(None)
}

async fn prepare(
    files: &mut BlobFiles,
    name: &str,
    reading: &Reading,
    load: &Function,
    sink: &mut PostingSink<'_>,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let meshes = mesh_files(files, name, reading, report)?;
    let mut read = read_meshes(files, &meshes, sink, report)?;
    while let Some(packed) = read.next_packed() {
        let outcome = unpacked(packed, load).await;
        read.unpacked(outcome.map_err(|error| text_of(&error)), report);
    }
    let mut finishing = Finishing::new(sink, reading.carves, reading.sweeps);
    read.prepare(box_of(reading), finishing.sink(), report)
}
