//! The part that reads scans, label volumes and displacement fields.

use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;
use web_sys::Blob;

use super::answer::post;
use super::blobs::{BlobFiles, fetch, name_of, not_fetched};
use super::fault;
use super::pieces::packed;
use super::task::{Part, ScanTask, limits_of};
use crate::assets::{LoadEvent, SegmentationsExpected};
use crate::data::{SubjectPart, SubjectSink, VolumeLimits};
use crate::document::Reading;
use crate::load::{LoadReport, is_field, main_name, read_field};
use crate::shell::clays::{READING, read_voxels};
use crate::shell::figures::figure_file;
use crate::shell::loading::{
    PostingSink, is_mesh_file, read_scan_file, read_segments, take_segmentations,
};

/// Called once when the part has been loaded.
pub fn loaded() {
    fault::report_panics();
}

/// Does the task of a message; called by web/worker.js. Returns the name of the part that the task is for, if it is for
/// another one: a file may be called like a scan and be a mesh.
///
/// # Errors
/// If the message is no task, or the page cannot take the answer.
pub async fn run(message: JsValue) -> Result<Option<String>, JsValue> {
    fault::heed_scope(&message);
    post::module_unless_known(&message, Part::Scans)?;
    let limits = limits_of(&message)?;
    match ScanTask::of(&message)? {
        ScanTask::Mesh(..) => Ok(Some(Part::Meshes.name().to_owned())),
        ScanTask::Field { name, file } => post_field(name, file).await.map(|()| None),
        ScanTask::Address {
            address,
            are_segments,
            reading,
        } => {
            let name = name_of(&address);
            match fetch(&address).await {
                Ok(blob) => {
                    let mut files = BlobFiles::new(vec![(name.clone(), blob)]).await?;
                    if are_segments {
                        let mut post = |event: LoadEvent| post::event(event).is_ok();
                        read_segments(&mut files, &name, &mut post);
                        return Ok(None);
                    }
                    read(&mut files, &name, limits, &reading)
                }
                Err(error) => {
                    let what = if are_segments { "label volume" } else { "scan" };
                    post::event(not_fetched(what, &address, &error)).map(|()| None)
                }
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
                    return post_field(name.clone(), blob.clone()).await.map(|()| None);
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

/// Reads a scan; the name of the part that reads meshes or figures if it is one.
fn read(
    files: &mut BlobFiles,
    name: &str,
    limits: VolumeLimits,
    reading: &Reading,
) -> Result<Option<String>, JsValue> {
    if reading.raw.is_none() && figure_file(files, name).is_ok_and(|file| file.is_some()) {
        return Ok(Some(Part::Figures.name().to_owned()));
    }
    if is_mesh_file(files, name, reading).unwrap_or(false) {
        return Ok(Some(Part::Meshes.name().to_owned()));
    }
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    read_scan_file(files, name, limits, reading, &mut post);
    Ok(None)
}

/// Reads files that were opened together: label volumes, and then the scan.
async fn read_files(
    files: Vec<(String, Blob)>,
    limits: VolumeLimits,
    reading: &Reading,
    segmentations: &SegmentationsExpected,
) -> Result<Option<String>, JsValue> {
    let name = files.first().map(|f| f.0.clone()).unwrap_or_default();
    let (mut files, names) = BlobFiles::of_all(files).await?;
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    let rest = take_segmentations(&mut files, names, segmentations, &mut post);
    let Some(first) = rest.first().cloned() else {
        post::event(LoadEvent::Done { sha256: None })?;
        return Ok(None);
    };
    files.retain(|name| rest.iter().any(|other| other == name));
    let name = if rest.contains(&name) { name } else { first };
    let name = main_name(&mut files, &name);
    read(&mut files, &name, limits, reading)
}

/// Reads the scan that a clay begins with, whole, for the part that shapes it, which calls this in its own worker with
/// the message that it was given. Returns the file's name, its hash as bytes, and the pieces as pairs of
/// [`packed`]; nothing if the scan cannot be read, which the page has then been told.
///
/// # Errors
/// If the message names no scan, or the page cannot take an answer.
pub async fn voxels(message: JsValue) -> Result<JsValue, JsValue> {
    fault::heed_scope(&message);
    let (mut files, name, reading) = match ScanTask::of(&message)? {
        ScanTask::Address {
            address, reading, ..
        } => {
            let name = name_of(&address);
            match fetch(&address).await {
                Ok(blob) => {
                    let files = BlobFiles::new(vec![(name.clone(), blob)]).await?;
                    (files, name, reading)
                }
                Err(error) => {
                    post::event(not_fetched("scan", &address, &error))?;
                    return Ok(JsValue::UNDEFINED);
                }
            }
        }
        ScanTask::Files { files, reading, .. } => {
            let first = files.first().map(|file| file.0.clone()).unwrap_or_default();
            let (mut files, _) = BlobFiles::of_all(files).await?;
            let name = main_name(&mut files, &first);
            (files, name, reading)
        }
        ScanTask::Mesh(..) | ScanTask::Field { .. } => return Err("a clay without a scan".into()),
    };
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    let mut packing = Packing {
        sink: PostingSink::new(&mut post),
        pieces: Array::new(),
    };
    let mut report = LoadReport::default();
    let outcome = read_voxels((&mut files, &name), &reading, &mut packing, &mut report);
    let Packing { sink, pieces } = packing;
    if outcome.is_err() {
        sink.end(outcome, &report, None);
        return Ok(JsValue::UNDEFINED);
    }
    for warning in &report.warnings {
        post(LoadEvent::Notice(warning.to_string()));
    }
    let hash = report.sha256.map(|hash| Uint8Array::from(&hash[..]));
    Ok(Array::of3(&name.into(), &hash.into(), &pieces).into())
}

/// Takes a scan to pieces that another program can take.
struct Packing<'a> {
    sink: PostingSink<'a>,
    pieces: Array,
}

impl SubjectSink for Packing<'_> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        let (word, held) = packed(part).map_err(|error| fault::text_of(&error))?;
        self.pieces.push(&Array::of2(&word.into(), &held));
        Ok(())
    }

    fn progress(&mut self, fraction: f32) -> bool {
        self.sink.progress(READING * fraction)
    }
}
