//! The part that reads figures and bends them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use js_sys::Function;
use wasm_bindgen::prelude::*;

use super::answer::post;
use super::blobs::{BlobFiles, fetch, name_of, not_fetched};
use super::fault::{self, text_of};
use super::task::{Part, ScanTask, bend_of};
use super::unpacking::unpacked;
use crate::assets::{BendAnswer, BendRequest, LoadEvent};
use crate::data::SheetMesh;
use crate::document::Reading;
use crate::figure::{FigureFile, ReadPlate, plate_of_drawing, plate_of_picture};
use crate::load::{LoadError, LoadReport};
use crate::pictures::{orientation, upright};
use crate::shell::bending::{Desk, make_figure};
use crate::shell::figures::{figure_bytes, figure_file, hand_over};
use crate::shell::loading::PostingSink;

/// A bender, and the triangles that the page has of it.
#[derive(Default)]
struct Served {
    desk: Desk,
    mesh: Option<Arc<SheetMesh>>,
}

thread_local! {
    /// By their numbers: a worker has one, but where there are no workers all stand in the page itself.
    static SERVED: RefCell<BTreeMap<u32, Served>> = const { RefCell::new(BTreeMap::new()) };
}

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
    post::module_unless_known(&message, Part::Figures)?;
    if let Some((bender, request)) = bend_of(&message)? {
        return bend(bender, request).map(|()| None);
    }
    match ScanTask::of(&message)? {
        ScanTask::Mesh(name, _) => {
            let mut post = |event: LoadEvent| post::event(event).is_ok();
            make_figure(&name, &mut post);
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
                    let files = BlobFiles::new(vec![(name.clone(), blob)]).await?;
                    read(files, &name, &reading, &load).await
                }
                Err(error) => post::event(not_fetched("picture", &address, &error)).map(|()| None),
            }
        }
        ScanTask::Files { files, reading, .. } => {
            let name = files.first().map(|f| f.0.clone()).unwrap_or_default();
            let (files, _) = BlobFiles::of_all(files).await?;
            read(files, &name, &reading, &load).await
        }
        _ => Ok(Some(Part::Scans.name().to_owned())),
    }
}

/// Lets go of a bender that nobody asks any more. One in a worker ends with it.
pub fn dismiss(bender: u32) {
    SERVED.with_borrow_mut(|all| all.remove(&bender));
}

fn bend(bender: u32, request: BendRequest) -> Result<(), JsValue> {
    SERVED.with_borrow_mut(|all| {
        let served = all.entry(bender).or_default();
        let mut tell = |part: f32| post::bending(part).is_ok();
        let answer = served.desk.answer(request, &mut tell);
        post::bent(&answer, served.mesh.as_ref())?;
        if let BendAnswer::Bent { sheet, .. } = answer {
            served.mesh = Some(sheet.mesh);
        }
        Ok(())
    })
}

/// Reads a figure; the name of the part that reads scans if the file is none.
async fn read(
    mut files: BlobFiles,
    name: &str,
    reading: &Reading,
    load: &Function,
) -> Result<Option<String>, JsValue> {
    let file = figure_file(&mut files, name).ok().flatten();
    let Some(file) = file.filter(|_| reading.raw.is_none()) else {
        return Ok(Some(Part::Scans.name().to_owned()));
    };
    let mut post = |event: LoadEvent| post::event(event).is_ok();
    let mut sink = PostingSink::new(&mut post);
    let mut report = LoadReport::default();
    let outcome = match plate(&mut files, name, file, load, &mut report).await {
        Ok(read) => hand_over(read, name, &mut sink, &mut report),
        Err(error) => Err(error),
    };
    sink.end(outcome, &report, None);
    Ok(None)
}

async fn plate(
    files: &mut BlobFiles,
    name: &str,
    file: FigureFile,
    load: &Function,
    report: &mut LoadReport,
) -> Result<ReadPlate, LoadError> {
    let bytes = figure_bytes(files, name, report)?;
    let read = match file {
        FigureFile::Picture => match unpacked(&bytes, load).await {
            Ok(picture) => Ok(plate_of_picture(upright(picture, orientation(&bytes)))),
            Err(error) => Err(text_of(&error)),
        },
        FigureFile::Drawing => plate_of_drawing(&bytes).map_err(|error| error.to_string()),
    };
    read.map_err(|message| LoadError::Figure {
        name: name.to_owned(),
        message,
    })
}
