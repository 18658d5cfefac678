//! The part that reads scans, label volumes and displacement fields.

use std::collections::BTreeSet;

use js_sys::{Array, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::Blob;

use super::answer::post;
use super::blobs::BlobFiles;
use super::fault::{self, scope, text_of};
use super::task::{ScanTask, limits_of};
use crate::assets::{LoadEvent, SegmentationsExpected};
use crate::data::VolumeLimits;
use crate::document::Reading;
use crate::load::{is_field, main_name, read_field};
use crate::shell::loading::{make_mesh, read_file, read_segments, take_segmentations};

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js.
///
/// # Errors
/// If the message is no task, or the page cannot take the answer.
#[wasm_bindgen]
pub async fn run(message: JsValue) -> Result<(), JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message)?;
    let limits = limits_of(&message)?;
    match ScanTask::of(&message)? {
        ScanTask::Mesh(name, carves) => {
            make_mesh(&name, carves, &mut |event: LoadEvent| {
                post::event(event).is_ok()
            });
            Ok(())
        }
        ScanTask::Field { name, file } => post_field(name, file).await,
        ScanTask::Address {
            address,
            are_segments,
            reading,
        } => {
            let name = address.rsplit('/').next().unwrap_or_default();
            let name = name.split(['?', '#']).next().unwrap_or_default().to_owned();
            match fetch(&address).await {
                Ok(blob) => {
                    let mut files = vec![(name.clone(), blob)];
                    // What cannot be had is named by the reader of meshes.
                    for src in reading
                        .meshes
                        .iter()
                        .skip(1)
                        .filter_map(|mesh| mesh.src.clone())
                    {
                        files.extend(fetch(&src).await.ok().map(|blob| (src, blob)));
                    }
                    let mut files = BlobFiles::new(files).await?;
                    if are_segments {
                        let mut post = |event: LoadEvent| post::event(event).is_ok();
                        read_segments(&mut files, &name, &mut post);
                    } else {
                        read(&mut files, &name, limits, &reading);
                    }
                    Ok(())
                }
                Err(error) => post::event(LoadEvent::Failed {
                    message: format!(
                        "The {} could not be fetched from {address}",
                        if are_segments { "label volume" } else { "scan" }
                    ),
                    details: format!(
                        "{} The server may be down, or may not let other pages read its files (CORS).",
                        text_of(&error)
                    ),
                    fault: None,
                }),
            }
        }
        ScanTask::Files {
            files,
            reading,
            segmentations,
            may_be_field,
        } => {
            if may_be_field && let [(name, blob)] = files.as_slice() {
                let mut only = BlobFiles::new(files.clone()).await?;
                if is_field(&mut only, name) {
                    return post_field(name.clone(), blob.clone()).await;
                }
            }
            read_files(files, limits, &reading, &segmentations).await
        }
    }
}

async fn post_field(name: String, file: Blob) -> Result<(), JsValue> {
    let mut files = BlobFiles::new(vec![(name.clone(), file)]).await?;
    post::field(&read_field(&mut files, &name).map_err(|error| error.to_string()))
}

fn read(files: &mut BlobFiles, name: &str, limits: VolumeLimits, reading: &Reading) {
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    read_file(files, name, limits, reading, &mut post);
}

/// Reads files that were opened together: label volumes, and then the scan.
async fn read_files(
    mut files: Vec<(String, Blob)>,
    limits: VolumeLimits,
    reading: &Reading,
    segmentations: &SegmentationsExpected,
) -> Result<(), JsValue> {
    let name = files.first().map(|f| f.0.clone()).unwrap_or_default();
    // Files from several folders may be called alike.
    let mut names = BTreeSet::new();
    for (index, (name, _)) in files.iter_mut().enumerate() {
        if !names.insert(name.clone()) {
            *name = format!("{index}/{name}");
        }
    }
    let names = files.iter().map(|(name, _)| name.clone()).collect();
    let mut files = BlobFiles::new(files).await?;
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    let rest = take_segmentations(&mut files, names, segmentations, &mut post);
    let Some(first) = rest.first().cloned() else {
        return post::event(LoadEvent::Done { sha256: None });
    };
    files.retain(|name| rest.iter().any(|other| other == name));
    let name = if rest.contains(&name) { name } else { first };
    let name = main_name(&mut files, &name);
    read(&mut files, &name, limits, reading);
    Ok(())
}

/// Fetches an address into the browser's own store of bytes, which is not this program's memory.
async fn fetch(address: &str) -> Result<Blob, JsValue> {
    let response = JsFuture::from(scope().fetch_with_str(address)).await?;
    let response: web_sys::Response = response.unchecked_into();
    if !response.ok() {
        let text = format!("The server answered {}.", response.status());
        return Err(text.into());
    }
    let total = response
        .headers()
        .get("content-length")?
        .and_then(|n| n.parse::<f64>().ok());
    let parts = Array::new();
    let Some(body) = response.body() else {
        return Ok(JsFuture::from(response.blob()?).await?.unchecked_into());
    };
    let reader: web_sys::ReadableStreamDefaultReader = body.get_reader().unchecked_into();
    let (mut come, mut told) = (0.0, 0.0);
    loop {
        let chunk = JsFuture::from(reader.read()).await?;
        if Reflect::get(&chunk, &"done".into())?.is_truthy() {
            break;
        }
        let bytes: Uint8Array = Reflect::get(&chunk, &"value".into())?.unchecked_into();
        come += f64::from(bytes.length());
        parts.push(&bytes);
        let fraction = total.map_or(0.0, |total| (come / total.max(1.0)).min(1.0));
        if come - told > 1e6 {
            told = come;
            let event = LoadEvent::Progress {
                fraction: fraction as f32 * 0.5,
                what: "Fetching".to_owned(),
            };
            post::event(event)?;
        }
    }
    Blob::new_with_u8_array_sequence(&parts)
}
