//! Loads off the frame loop: a Web Worker with the same program reads files and makes subjects, and posts slabs to the page.
//!
//! A message to the page is an array: `["begin", header as JSON]`, `["scalars", typed array]`, `["labels", Uint8Array]`,
//! `["progress", fraction, what]`, `["coarse"]`, `["done", sha256 or null]`, `["notice", text]`,
//! `["label-file", sha256, header as JSON, Uint8Array]`, `["frames", count]`, `["raw", bytes or undefined, is packed, guess or undefined]`, `["failed", message, details]`,
//! `["cancelled"]`. Arrays travel without being copied again. One worker does one load; to
//! cancel it is to end it.

use std::collections::BTreeSet;
use std::io::{self, Read};

use glam::{DAffine3, UVec3};
use js_sys::{Array, Reflect, Uint8Array};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{
    Blob, DedicatedWorkerGlobalScope, FileReaderSync, MessageEvent, Worker, WorkerOptions,
    WorkerType,
};

use super::loading::{make_subject, read_file, slabs_in_turn, take_labels};
use crate::app::{LabelsExpected, LoadEvent, RawQuestion};
use crate::data::{Grid, LabelVolume, Segment, Volume, VolumeLimits, Voxels};
use crate::document::{Document, Edit, Reading, SubjectRef};
use crate::load::{FileHandle, FileSet, main_name};

/// Bytes of a file that are in memory at a time.
const CHUNK_BYTES: usize = 4 << 20;

/// What is to be loaded.
pub(super) enum Task {
    /// A built-in subject.
    Builtin(String),
    /// A file that the reader gave, first, and those beside it.
    Files(Vec<(String, Blob)>, Option<String>, Reading, LabelsExpected),
    /// An address that may be fetched, and the expected hash.
    Address(String, Option<String>, Reading),
}

/// A load under way. Ends when dropped.
pub(super) struct WorkerLoad {
    worker: Worker,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(web_sys::Event)>,
}

impl Drop for WorkerLoad {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

/// Starts a load; `on_event` is called as its events arrive.
pub(super) fn start(
    worker_address: &str,
    task: &Task,
    limits: VolumeLimits,
    on_event: impl Fn(LoadEvent) + Clone + 'static,
) -> Result<WorkerLoad, JsValue> {
    let options = WorkerOptions::new();
    options.set_type(WorkerType::Module);
    let worker = Worker::new_with_options(worker_address, &options)?;
    let for_error = on_event.clone();
    let on_message = Closure::new(move |event: MessageEvent| {
        if let Some(event) = event_of(&event.data()) {
            on_event(event);
        }
    });
    let on_error = Closure::new(move |_: web_sys::Event| {
        for_error(LoadEvent::Failed {
            message: "This browser did not start the background thread that loads scans".to_owned(),
            details: "Workers of this page may be blocked: by an extension, by the content policy of a page that embeds the viewer, or because worker.js is not beside fabrica.js.".to_owned(),
        });
    });
    worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
    let message = js_sys::Object::new();
    let set = |key: &str, value: &JsValue| Reflect::set(&message, &key.into(), value);
    set("module", &wasm_bindgen::module())?;
    set("max_dim", &limits.max_dim.into())?;
    set("max_voxels", &(limits.max_voxels as f64).into())?;
    match task {
        Task::Builtin(name) => {
            set("builtin", &name.into())?;
        }
        Task::Files(files, expected, reading, labels) => {
            let list = Array::new();
            for (name, blob) in files {
                list.push(&Array::of2(&name.into(), blob));
            }
            set("files", &list)?;
            set("has_scan", &labels.has_scan.into())?;
            let hashes: Array = labels.sha256.iter().map(JsValue::from).collect();
            set("labels", &hashes)?;
            set("expected", &expected.clone().into())?;
            set("reading", &text_of_reading(reading).into())?;
        }
        Task::Address(address, expected, reading) => {
            set("address", &address.into())?;
            set("expected", &expected.clone().into())?;
            set("reading", &text_of_reading(reading).into())?;
        }
    }
    worker.post_message(&message)?;
    Ok(WorkerLoad {
        worker,
        _on_message: on_message,
        _on_error: on_error,
    })
}

/// How a file is to be read, as the document of which it would be the subject.
fn text_of_reading(reading: &Reading) -> String {
    let subject = SubjectRef::Supplied {
        sha256: "0".repeat(64),
        name: String::new(),
        reading: reading.clone(),
    };
    let document = Edit::SetSubject(subject).apply(&Document::new());
    document.map_or_else(|_nothing_said| String::new(), |d| d.to_json_compact())
}

fn reading_of(text: &str) -> Reading {
    Document::from_json(text)
        .ok()
        .and_then(|document| document.illustration().subject.reading().cloned())
        .unwrap_or_default()
}

// ---------------------------------------------------------------------------------------------------- in the worker

/// Does the load that the page asked for; called by web/worker.js.
///
/// # Errors
/// If the message is not one of the page's, or an address cannot be fetched.
#[wasm_bindgen]
pub async fn worker_task(message: JsValue) -> Result<(), JsValue> {
    let get = |key: &str| Reflect::get(&message, &key.into());
    let scope: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    let limits = VolumeLimits {
        max_dim: get("max_dim")?.as_f64().unwrap_or_default() as u32,
        max_voxels: get("max_voxels")?.as_f64().unwrap_or_default() as u64,
    };
    let mut post = |event: LoadEvent| post_event(&scope, event).is_ok();
    let expected = get("expected")?.as_string();
    let reading = reading_of(&get("reading")?.as_string().unwrap_or_default());
    if let Some(name) = get("builtin")?.as_string() {
        make_subject(&name, limits, slabs_in_turn, &mut post);
    } else if let Some(address) = get("address")?.as_string() {
        let name = address.rsplit('/').next().unwrap_or_default();
        let name = name.split(['?', '#']).next().unwrap_or_default().to_owned();
        match fetch(&scope, &address).await {
            Ok(blob) => {
                let mut files = BlobFiles(vec![(name.clone(), blob)]);
                let expected = expected.as_deref();
                read_file(&mut files, &name, expected, limits, &reading, &mut post);
            }
            Err(error) => {
                post(LoadEvent::Failed {
                    message: format!("The scan could not be fetched from {address}"),
                    details: format!(
                        "{} The server may be down, or may not let other pages read its files (CORS).",
                        text_of(&error)
                    ),
                });
            }
        }
    } else {
        let list: Array = get("files")?.unchecked_into();
        let mut files: Vec<(String, Blob)> = list
            .iter()
            .map(|pair| {
                let pair: Array = pair.unchecked_into();
                let name = pair.get(0).as_string().unwrap_or_default();
                (name, pair.get(1).unchecked_into())
            })
            .collect();
        let name = files.first().map(|f| f.0.clone()).unwrap_or_default();
        // Files from several folders may be called alike.
        let mut names = BTreeSet::new();
        for (index, (name, _)) in files.iter_mut().enumerate() {
            if !names.insert(name.clone()) {
                *name = format!("{index}/{name}");
            }
        }
        let names = files.iter().map(|(name, _)| name.clone()).collect();
        let mut files = BlobFiles(files);
        let hashes: Array = get("labels")?.unchecked_into();
        let labels = LabelsExpected {
            sha256: hashes.iter().filter_map(|hash| hash.as_string()).collect(),
            has_scan: get("has_scan")?.is_truthy(),
        };
        let rest = take_labels(&mut files, names, &labels, &mut post);
        let Some(first) = rest.first().cloned() else {
            post(LoadEvent::Done { sha256: None });
            return Ok(());
        };
        files.0.retain(|(name, _)| rest.contains(name));
        let name = if rest.contains(&name) { name } else { first };
        let name = main_name(&mut files, &name);
        let expected = expected.as_deref();
        read_file(&mut files, &name, expected, limits, &reading, &mut post);
    }
    Ok(())
}

/// An error as text.
pub(super) fn text_of(error: &JsValue) -> String {
    error
        .dyn_ref::<js_sys::Error>()
        .map(|e| String::from(e.message()))
        .or_else(|| error.as_string())
        .unwrap_or_else(|| format!("{error:?}"))
}

/// Fetches an address into the browser's own store of bytes, which is not this program's memory.
async fn fetch(scope: &DedicatedWorkerGlobalScope, address: &str) -> Result<Blob, JsValue> {
    let response = JsFuture::from(scope.fetch_with_str(address)).await?;
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
            post_event(scope, event)?;
        }
    }
    Blob::new_with_u8_array_sequence(&parts)
}

struct BlobFiles(Vec<(String, Blob)>);

impl FileSet for BlobFiles {
    fn names(&mut self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }

    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        let found = self.0.iter().find(|(n, _)| n == name);
        let (_, blob) = found.ok_or(io::ErrorKind::NotFound)?;
        let reader = FileReaderSync::new().map_err(|e| io::Error::other(text_of(&e)))?;
        Ok(FileHandle {
            byte_len: Some(blob.size() as u64),
            read: Box::new(BlobReader {
                blob: blob.clone(),
                reader,
                chunk: Vec::new(),
                at: 0,
                next: 0.0,
            }),
        })
    }
}

struct BlobReader {
    blob: Blob,
    reader: FileReaderSync,
    chunk: Vec<u8>,
    at: usize,
    next: f64,
}

impl Read for BlobReader {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.at == self.chunk.len() {
            if self.next >= self.blob.size() {
                return Ok(0);
            }
            let end = (self.next + CHUNK_BYTES as f64).min(self.blob.size());
            let read = self
                .blob
                .slice_with_f64_and_f64(self.next, end)
                .and_then(|piece| self.reader.read_as_array_buffer(&piece))
                .map_err(|error| io::Error::other(text_of(&error)))?;
            self.chunk = Uint8Array::new(&read).to_vec();
            self.at = 0;
            self.next = end;
        }
        let n = out.len().min(self.chunk.len() - self.at);
        if let (Some(to), Some(from)) = (out.get_mut(..n), self.chunk.get(self.at..self.at + n)) {
            to.copy_from_slice(from);
        }
        self.at += n;
        Ok(n)
    }
}

// ---------------------------------------------------------------------------------------------------- events as messages

fn post_event(scope: &DedicatedWorkerGlobalScope, event: LoadEvent) -> Result<(), JsValue> {
    let message = Array::new();
    let push = |value: &JsValue| {
        message.push(value);
    };
    let mut moved: Option<js_sys::ArrayBuffer> = None;
    match event {
        LoadEvent::Begin(header) => {
            push(&"begin".into());
            push(&json_of(&header).to_string().into());
        }
        LoadEvent::Scalars(voxels) => {
            push(&"scalars".into());
            let array: JsValue = match &voxels {
                Voxels::U8(v) => Uint8Array::from(v.as_slice()).into(),
                Voxels::I16(v) => js_sys::Int16Array::from(v.as_slice()).into(),
                Voxels::U16(v) => js_sys::Uint16Array::from(v.as_slice()).into(),
                Voxels::F32(v) => js_sys::Float32Array::from(v.as_slice()).into(),
            };
            moved = Some(Reflect::get(&array, &"buffer".into())?.unchecked_into());
            push(&array);
        }
        LoadEvent::Labels(labels) => {
            push(&"labels".into());
            let array = Uint8Array::from(labels.as_slice());
            moved = Some(array.buffer());
            push(&array);
        }
        LoadEvent::LabelFile { sha256, labels } => {
            push(&"label-file".into());
            push(&sha256.into());
            push(&json_of_labels(&labels).to_string().into());
            let array = Uint8Array::from(labels.labels.as_slice());
            moved = Some(array.buffer());
            push(&array);
        }
        LoadEvent::Progress { fraction, what } => {
            push(&"progress".into());
            push(&fraction.into());
            push(&what.into());
        }
        LoadEvent::Coarse => push(&"coarse".into()),
        LoadEvent::Frames { count } => {
            push(&"frames".into());
            push(&(count as f64).into());
        }
        LoadEvent::AskRaw(question) => {
            push(&"raw".into());
            push(&question.byte_len.map(|n| n as f64).into());
            push(&question.is_packed.into());
            let guess = question.guess.map(|raw| {
                text_of_reading(&Reading {
                    frame: 0,
                    raw: Some(raw),
                })
            });
            push(&guess.into());
        }
        LoadEvent::Done { sha256 } => {
            push(&"done".into());
            push(&sha256.into());
        }
        LoadEvent::Notice(text) => {
            push(&"notice".into());
            push(&text.into());
        }
        LoadEvent::Failed { message, details } => {
            push(&"failed".into());
            push(&message.into());
            push(&details.into());
        }
        LoadEvent::Cancelled => push(&"cancelled".into()),
    }
    match moved {
        Some(buffer) => scope.post_message_with_transfer(&message, &Array::of1(&buffer)),
        None => scope.post_message(&message),
    }
}

fn event_of(message: &JsValue) -> Option<LoadEvent> {
    let message: &Array = message.dyn_ref()?;
    let text = |index: u32| message.get(index).as_string().unwrap_or_default();
    Some(match text(0).as_str() {
        "begin" => match serde_json::from_str(&text(1))
            .ok()
            .as_ref()
            .and_then(volume_of)
        {
            Some(header) => LoadEvent::Begin(Box::new(header)),
            None => LoadEvent::Failed {
                message: "The background thread said something that the page does not understand"
                    .to_owned(),
                details:
                    "fabrica.js and worker.js may be of different versions: load the page again."
                        .to_owned(),
            },
        },
        "scalars" => LoadEvent::Scalars(voxels_of(&message.get(1))?),
        "labels" => LoadEvent::Labels(message.get(1).dyn_ref::<Uint8Array>()?.to_vec()),
        "label-file" => {
            let header: Value = serde_json::from_str(&text(2)).ok()?;
            let mut labels = labels_of(&header)?;
            labels.labels = message.get(3).dyn_ref::<Uint8Array>()?.to_vec();
            LoadEvent::LabelFile {
                sha256: text(1),
                labels: Box::new(labels),
            }
        }
        "progress" => LoadEvent::Progress {
            fraction: message.get(1).as_f64()? as f32,
            what: text(2),
        },
        "coarse" => LoadEvent::Coarse,
        "frames" => LoadEvent::Frames {
            count: message.get(1).as_f64()? as u64,
        },
        "raw" => LoadEvent::AskRaw(RawQuestion {
            byte_len: message.get(1).as_f64().map(|n| n as u64),
            is_packed: message.get(2).is_truthy(),
            guess: reading_of(&text(3)).raw,
        }),
        "done" => LoadEvent::Done {
            sha256: message.get(1).as_string(),
        },
        "notice" => LoadEvent::Notice(text(1)),
        "failed" => LoadEvent::Failed {
            message: text(1),
            details: text(2),
        },
        "cancelled" => LoadEvent::Cancelled,
        _ => return None,
    })
}

fn voxels_of(array: &JsValue) -> Option<Voxels> {
    if let Some(a) = array.dyn_ref::<Uint8Array>() {
        return Some(Voxels::U8(a.to_vec()));
    }
    if let Some(a) = array.dyn_ref::<js_sys::Int16Array>() {
        return Some(Voxels::I16(a.to_vec()));
    }
    if let Some(a) = array.dyn_ref::<js_sys::Uint16Array>() {
        return Some(Voxels::U16(a.to_vec()));
    }
    array
        .dyn_ref::<js_sys::Float32Array>()
        .map(|a| Voxels::F32(a.to_vec()))
}

fn json_of_grid(grid: &Grid) -> Value {
    json!({ "dims": grid.dims.to_array(), "world_from_voxel": grid.world_from_voxel.to_cols_array() })
}

fn grid_of(value: &Value) -> Option<Grid> {
    let dims: Vec<u32> = value
        .get("dims")?
        .as_array()?
        .iter()
        .filter_map(|n| u32::try_from(n.as_u64()?).ok())
        .collect();
    let columns: Vec<f64> = value
        .get("world_from_voxel")?
        .as_array()?
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    Some(Grid {
        dims: UVec3::from_array(dims.try_into().ok()?),
        world_from_voxel: DAffine3::from_cols_array(&columns.try_into().ok()?),
    })
}

/// All but the labels themselves.
fn json_of_labels(labels: &LabelVolume) -> Value {
    let segments: Vec<Value> = labels
        .segments
        .iter()
        .map(|s| json!([s.label, s.name, s.color_srgb]))
        .collect();
    json!({ "grid": json_of_grid(&labels.grid), "segments": segments })
}

fn labels_of(value: &Value) -> Option<LabelVolume> {
    Some(LabelVolume {
        grid: grid_of(value.get("grid")?)?,
        labels: Vec::new(),
        segments: value
            .get("segments")?
            .as_array()?
            .iter()
            .filter_map(segment_of)
            .collect(),
    })
}

fn json_of(header: &Volume) -> Value {
    let kind = match &header.voxels {
        Voxels::U8(_) => "u8",
        Voxels::I16(_) => "i16",
        Voxels::U16(_) => "u16",
        Voxels::F32(_) => "f32",
    };
    let labels = header.labels.as_ref().map(json_of_labels);
    json!({
        "grid": json_of_grid(&header.grid), "kind": kind, "slope": header.slope, "intercept": header.intercept,
        "value_range": header.value_range, "labels": labels,
    })
}

fn volume_of(value: &Value) -> Option<Volume> {
    let number = |value: &Value| value.as_f64().map(|x| x as f32);
    let range = value.get("value_range")?.as_array()?;
    let labels = match value.get("labels") {
        Some(labels) if !labels.is_null() => Some(labels_of(labels)?),
        _ => None,
    };
    Some(Volume {
        grid: grid_of(value.get("grid")?)?,
        voxels: match value.get("kind")?.as_str()? {
            "u8" => Voxels::U8(Vec::new()),
            "i16" => Voxels::I16(Vec::new()),
            "u16" => Voxels::U16(Vec::new()),
            _ => Voxels::F32(Vec::new()),
        },
        slope: number(value.get("slope")?)?,
        intercept: number(value.get("intercept")?)?,
        value_range: [
            number(range.first()?).unwrap_or_default(),
            number(range.get(1)?).unwrap_or_default(),
        ],
        labels,
    })
}

fn segment_of(value: &Value) -> Option<Segment> {
    let color = value.get(2)?.as_array().and_then(|c| {
        let bytes: Vec<u8> = c
            .iter()
            .filter_map(|n| u8::try_from(n.as_u64()?).ok())
            .collect();
        bytes.try_into().ok()
    });
    Some(Segment {
        label: u16::try_from(value.get(0)?.as_u64()?).ok()?,
        name: value.get(1)?.as_str()?.to_owned(),
        color_srgb: color,
    })
}
