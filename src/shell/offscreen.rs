//! What the page's scripts may have drawn beside the viewers: a picture as a PNG, and the frame times of this browser.

use std::cell::RefCell;
use std::sync::Arc;

use wasm_bindgen::prelude::*;

use super::web::{open, seconds};
use super::worker::run;
use super::worker::task::{ScanTask, Task};
use crate::data::{Subject, Surface};
use crate::document::{Document, SceneObject, SubjectRef};
use crate::render::{BenchMeshes, BenchPlan, Gpu, GpuOptions, Studio, encode_png};
use crate::subjects::FINE_RESOLUTION;

/// The mesh that is measured.
const MESH: &str = "apple";

/// A subject that was made: its name, its revision and its resolution.
type Made = (String, u32, u32);

thread_local! {
    /// What [`render_png`] draws with, kept for the next call: a subject, and a device that holds it.
    static STUDIO: RefCell<Option<(Made, Studio)>> = const { RefCell::new(None) };
    static STUDIO_GPU: RefCell<Option<Gpu>> = const { RefCell::new(None) };
}

fn words(error: impl std::error::Error) -> JsValue {
    JsValue::from(error.to_string())
}

/// The device that pictures are drawn with beside the viewers', opened when it is first needed and after a loss.
async fn gpu() -> Result<Gpu, JsValue> {
    let held = STUDIO_GPU.with_borrow(Clone::clone);
    if let Some(gpu) = held.filter(|gpu| gpu.lost().is_none()) {
        return Ok(gpu);
    }
    let gpu = Gpu::open(&GpuOptions::default()).await.map_err(words)?;
    STUDIO.set(None);
    STUDIO_GPU.set(Some(gpu.clone()));
    Ok(gpu)
}

/// Draws a document with a built-in subject offscreen and deterministically, as `fabrica render` does, and gives the
/// PNG.
/// `resolution` is the number of voxels along the subject's longest side. For tests and for pictures of other pages.
///
/// # Errors
/// What is wrong with the document, the subject or the device, in words.
#[wasm_bindgen]
pub async fn render_png(
    text: String,
    width: u32,
    height: u32,
    samples: u32,
    resolution: u32,
) -> Result<Vec<u8>, JsValue> {
    let document = open(&text)?;
    let illustration = document.illustration();
    let SubjectRef::Builtin { name, revision } = &illustration.subject else {
        return Err("only built-in subjects can be drawn offscreen".into());
    };
    let gpu = gpu().await?;
    let held = STUDIO.with_borrow(Clone::clone);
    let wanted = (name.clone(), *revision, resolution);
    let studio = match held.filter(|(made, _)| *made == wanted) {
        Some((_, studio)) => studio,
        None => {
            let subject = made(Task::subject(name, *revision, Some(resolution))).await?;
            let studio = Studio::new(&gpu, &subject, true).map_err(words)?;
            STUDIO.set(Some((wanted, studio.clone())));
            studio
        }
    };
    let image = studio.render_image(illustration, [width, height], samples);
    let image = image.await.map_err(words)?;
    encode_png(&image).map_err(words)
}

async fn made(task: Task) -> Result<Subject, String> {
    run::make_subject(&run::known_address(), &task).await
}

async fn made_mesh(task: Task) -> Result<Arc<Surface>, String> {
    let subject = made(task).await?;
    (subject.surface().cloned()).ok_or_else(|| "a mesh was made as something else".to_owned())
}

/// Times frames of the built-in head, apple and scalpel on this browser's adapter, the rows of `fabrica bench` but that
/// of sixteen times as many triangles, and gives the report as JSON and as text: `[json, text]`. `repeats` frames per
/// row count, of pictures `side_px` wide and high and a head of `resolution` voxels along its longest side, in the
/// first `rows` rows; 0 takes what the command does. `on_progress` is called with how much is measured, 0 to 1.
///
/// # Errors
/// What is wrong with the subject or the device, in words.
#[wasm_bindgen]
pub async fn bench(
    repeats: u32,
    side_px: u32,
    resolution: u32,
    rows: u32,
    on_progress: js_sys::Function,
) -> Result<Vec<String>, JsValue> {
    let illustration = Document::new().illustration().clone();
    let SubjectRef::Builtin { name, revision } = &illustration.subject else {
        return Err("an empty document shows a built-in subject".into());
    };
    let mut plan = BenchPlan::default();
    if side_px > 0 {
        plan.size_px = [side_px; 2];
    }
    for (number, given) in [(repeats, &mut plan.repeats), (rows, &mut plan.most_rows)] {
        if number > 0 {
            *given = number as usize;
        }
    }
    let gpu = gpu().await?;
    let resolution = match resolution {
        0 => FINE_RESOLUTION,
        n => n,
    };
    let subject = made(Task::subject(name, *revision, Some(resolution))).await?;
    let mut meshes = None;
    if plan.wants_meshes() {
        let tool = ScanTask::Mesh(SceneObject::BUILTINS[0].to_owned(), false);
        meshes = Some(BenchMeshes {
            surface: made_mesh(Task::subject(MESH, 1, None)).await?,
            // Nobody waits in a page for its preparation, which takes longest of all.
            finer: None,
            tool: made_mesh(Task::Scan(tool)).await?,
        });
    }
    let report = crate::render::bench(
        &gpu,
        (&subject, &illustration.subject),
        meshes.as_ref(),
        plan,
        seconds,
        |part| {
            let _ignored = on_progress.call1(&JsValue::NULL, &JsValue::from_f64(f64::from(part)));
        },
    );
    let report = report.await.map_err(words)?;
    Ok(vec![report.to_json().to_string(), report.to_string()])
}
