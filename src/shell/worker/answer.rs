//! What a part posts to the page: an array that begins with a word. `["module", WebAssembly.Module]` comes first, if
//! the page did not send the module; `["field", header as JSON, Float32Array]` or `["field", undefined, why not]` is
//! the answer to a displacement field; `["bent", places, order, notices as JSON, mesh, places before handles move them,
//! regions as JSON]` or `["bent", undefined, why not]` that to a figure, its mesh undefined where it is that of the
//! answer before. The others are the events of a load: [`pieces`] of the subject, such as `["begin", header as JSON]`
//! and `["scalars", typed array]`, `["surface-array", index, array]` for each array of a surface and then
//! `["surface"]`, `["progress", fraction, what]`, `["coarse"]`, `["done", sha256 or null]`, `["notice", text]`,
//! `["label-file", sha256, header as JSON, Uint8Array]`, `["frames", count]`, `["written", Uint8Array]`,
//! `["raw", bytes or undefined, is packed, guess or undefined]`, `["failed", message, details]`, where the owner of the
//! file can mend it followed by the kind of fault, the name of the file, bytes found, bytes expected and the file that
//! is missing; `["cancelled"]`.

use std::sync::Arc;

use glam::Vec2;
use js_sys::{Array, ArrayBuffer, Float32Array, Reflect, Uint8Array, Uint32Array};
use serde_json::Value;
use wasm_bindgen::prelude::*;

use super::header::{field_of, json_of_field, json_of_labels, labels_of};
use super::pieces;
use super::task::{Part, reading_of, text_of_reading};
use crate::assets::{BendAnswer, LoadEvent, RawQuestion};
use crate::data::{Sheet, SheetMesh, SubjectPart, SurfaceArrays};
use crate::document::figure::Figure;
use crate::document::{Reading, figure_from_text, figure_to_text};
use crate::load::{FaultKind, FieldFile, FileFault, LabelFile};

/// What the page gets from a part.
#[derive(Debug)]
pub enum Answer {
    /// The compiled module of a part, for the next worker.
    Module(Part, JsValue),
    /// Something happened to a load.
    Event(LoadEvent),
    /// The file is a displacement field, or should have been one and why it is not.
    Field(Box<Result<FieldFile, String>>),
    /// A figure is bent, or is not.
    Bent(BendAnswer),
}

/// The answers of one worker.
#[derive(Debug, Default)]
pub struct Answers {
    /// The arrays of a surface that have come.
    arrays: SurfaceArrays,
    /// The triangles of the figure that was bent last.
    mesh: Option<Arc<SheetMesh>>,
}

impl Answers {
    /// The answer in a message; none if it is no message of a part, holds something else than its word promises, or is
    /// a piece of a surface. A word that is not known fails the load.
    pub fn take(&mut self, message: &JsValue) -> Option<Answer> {
        let message: &Array = message.dyn_ref()?;
        match message.get(0).as_string()?.as_str() {
            "module" => {
                let part = Part::of_name(&message.get(2).as_string()?)?;
                Some(Answer::Module(part, message.get(1)))
            }
            "field" => {
                let Some(header) = message.get(1).as_string() else {
                    let why = message.get(2).as_string().unwrap_or_default();
                    return Some(Answer::Field(Box::new(Err(why))));
                };
                let header: Value = serde_json::from_str(&header).ok()?;
                let mut field = field_of(&header)?;
                let samples = message.get(2).dyn_ref::<Float32Array>()?.to_vec();
                field.samples = samples.as_chunks::<4>().0.to_vec();
                Some(Answer::Field(Box::new(Ok(field))))
            }
            "bending" => {
                let part = message.get(1).as_f64()? as f32;
                Some(Answer::Bent(BendAnswer::UnderWay(part)))
            }
            "finer" => {
                let lost = || BendAnswer::Lost("the drawing was not drawn finer".to_owned());
                let finer = pieces::unpacked_picture(&message.get(1));
                Some(Answer::Bent(finer.map_or_else(lost, BendAnswer::Finer)))
            }
            "bent" => {
                // One that is not understood must not be waited for.
                let lost = || BendAnswer::Lost("the figure was not bent".to_owned());
                Some(Answer::Bent(self.bent(message).unwrap_or_else(lost)))
            }
            "surface-array" => {
                let index = message.get(1).as_f64()? as u32;
                pieces::put_array(&mut self.arrays, index, &message.get(2))?;
                None
            }
            "surface" => {
                let surface = std::mem::take(&mut self.arrays).into_surface()?;
                let part = SubjectPart::Surface(Arc::new(surface));
                Some(Answer::Event(LoadEvent::Part(part)))
            }
            _ => event_of(message).map(Answer::Event),
        }
    }

    fn bent(&mut self, message: &Array) -> Option<BendAnswer> {
        if message.get(1).is_undefined() {
            let why = message.get(2).as_string().unwrap_or_default();
            return Some(BendAnswer::Failed(why));
        }
        if let Some(mesh) = pieces::unpacked_mesh(&message.get(4)) {
            self.mesh = Some(Arc::new(mesh));
        }
        let notices: Value = serde_json::from_str(&message.get(3).as_string()?).ok()?;
        let notices = notices.as_array()?.iter();
        let notices = notices.map(|notice| notice.as_str().map(str::to_owned));
        Some(BendAnswer::Bent {
            sheet: Sheet {
                mesh: Arc::clone(self.mesh.as_ref()?),
                places: Arc::new(pieces::unpacked_places(&message.get(1))?),
                order: Arc::new(message.get(2).dyn_ref::<Uint32Array>()?.to_vec()),
                base: pieces::unpacked_places(&message.get(5)).map(Arc::new),
            },
            regions: match message.get(6).as_string() {
                Some(text) => Some(figure_from_text(&text).ok()?.regions),
                None => None,
            },
            notices: notices.collect::<Option<_>>()?,
        })
    }
}

impl Answer {
    /// True for the last answer of the worker.
    pub fn is_last(&self) -> bool {
        match self {
            Self::Module(..) | Self::Bent(_) => false,
            Self::Field(_) => true,
            Self::Event(event) => matches!(
                event,
                LoadEvent::Done { .. }
                    | LoadEvent::Failed { .. }
                    | LoadEvent::Cancelled
                    | LoadEvent::AskRaw(_)
            ),
        }
    }
}

/// In the worker: answers on their way to the page.
pub mod post {
    use super::*;
    use crate::shell::worker::fault::scope;

    fn send(message: &Array, moved: Option<ArrayBuffer>) -> Result<(), JsValue> {
        match moved {
            Some(buffer) => scope().post_message_with_transfer(message, &Array::of1(&buffer)),
            None => scope().post_message(message),
        }
    }

    /// Posts this part's compiled module, unless the task came with it.
    ///
    /// # Errors
    /// If the page cannot take the message.
    pub fn module_unless_known(task: &JsValue, part: Part) -> Result<(), JsValue> {
        if Reflect::get(task, &"module".into())?.is_truthy() {
            return Ok(());
        }
        let module = wasm_bindgen::module();
        send(
            &Array::of3(&"module".into(), &module, &part.name().into()),
            None,
        )
    }

    /// Posts a displacement field, or why there is none.
    ///
    /// # Errors
    /// If the page cannot take the message.
    pub fn field(outcome: &Result<FieldFile, String>) -> Result<(), JsValue> {
        match outcome {
            Ok(field) => {
                let samples = Float32Array::from(field.samples.as_flattened());
                let header = json_of_field(field).to_string();
                let message = Array::of3(&"field".into(), &header.into(), &samples);
                send(&message, Some(samples.buffer()))
            }
            Err(why) => send(
                &Array::of3(&"field".into(), &JsValue::UNDEFINED, &why.into()),
                None,
            ),
        }
    }

    /// Posts how much of a figure is bent, 0 to 1.
    ///
    /// # Errors
    /// If the page cannot take the message.
    pub fn bending(part: f32) -> Result<(), JsValue> {
        send(&Array::of2(&"bending".into(), &part.into()), None)
    }

    /// Posts a figure that is bent, or why it is not. Its triangles go along where they are others than `known`.
    ///
    /// # Errors
    /// If the page cannot take the message.
    pub fn bent(answer: &BendAnswer, known: Option<&Arc<SheetMesh>>) -> Result<(), JsValue> {
        let message = Array::of1(&"bent".into());
        match answer {
            BendAnswer::Bent {
                sheet,
                regions,
                notices,
            } => {
                let packed = |places: &[Vec2]| Float32Array::from(bytemuck::cast_slice(places));
                message.push(&packed(&sheet.places));
                message.push(&Uint32Array::from(sheet.order.as_slice()));
                message.push(&serde_json::json!(notices).to_string().into());
                message.push(&match known {
                    Some(known) if Arc::ptr_eq(known, &sheet.mesh) => JsValue::UNDEFINED,
                    _ => pieces::packed_mesh(&sheet.mesh),
                });
                message.push(&match &sheet.base {
                    Some(base) => packed(base).into(),
                    None => JsValue::UNDEFINED,
                });
                if let Some(regions) = regions {
                    let figure = Figure {
                        regions: regions.clone(),
                        ..Figure::default()
                    };
                    message.push(&figure_to_text(&figure).into());
                }
            }
            BendAnswer::Failed(why) | BendAnswer::Lost(why) => {
                message.push(&JsValue::UNDEFINED);
                message.push(&why.into());
            }
            BendAnswer::Finer(picture) => {
                let (picture, pixels) = pieces::packed_picture(picture);
                return send(&Array::of2(&"finer".into(), &picture), Some(pixels));
            }
            BendAnswer::UnderWay(_) | BendAnswer::Stopped => return Ok(()),
        }
        send(&message, None)
    }

    /// Posts the events of a load. Samples are moved to the page, not copied.
    ///
    /// # Errors
    /// If the page cannot take the message.
    pub fn event(event: LoadEvent) -> Result<(), JsValue> {
        let message = Array::new();
        let push = |value: &JsValue| {
            message.push(value);
        };
        let mut moved: Option<ArrayBuffer> = None;
        match event {
            LoadEvent::Part(SubjectPart::Surface(surface)) => {
                let arrays = pieces::packed_surface(&surface);
                drop(surface);
                for (index, array) in arrays.into_iter().enumerate() {
                    let buffer = match ArrayBuffer::is_view(&array) {
                        true => Some(Reflect::get(&array, &"buffer".into())?.unchecked_into()),
                        false => None,
                    };
                    let index = (index as u32).into();
                    send(&Array::of3(&"surface-array".into(), &index, &array), buffer)?;
                }
                push(&"surface".into());
            }
            LoadEvent::Part(part) => {
                let (word, held) = pieces::packed(part)?;
                push(&word.into());
                if ArrayBuffer::is_view(&held) {
                    moved = Some(Reflect::get(&held, &"buffer".into())?.unchecked_into());
                }
                push(&held);
            }
            LoadEvent::LabelFile(file) => {
                push(&"label-file".into());
                push(&file.sha256.into());
                let mut header = json_of_labels(&file.segmentation);
                header["numbers"] = file.numbers.into();
                push(&header.to_string().into());
                let array = Uint8Array::from(file.segmentation.labels.as_slice());
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
            LoadEvent::Modality(code) => {
                push(&"modality".into());
                push(&code.into());
            }
            LoadEvent::AskRaw(question) => {
                push(&"raw".into());
                push(&question.byte_len.map(|n| n as f64).into());
                push(&question.is_packed.into());
                let raw = question.guess;
                push(
                    &raw.map(|raw| {
                        text_of_reading(&Reading {
                            frame: 0,
                            raw: Some(raw),
                            ..Reading::default()
                        })
                    })
                    .into(),
                );
            }
            LoadEvent::Written(bytes) => {
                push(&"written".into());
                let array = Uint8Array::from(bytes.as_slice());
                moved = Some(array.buffer());
                push(&array);
            }
            LoadEvent::Done { sha256 } => {
                push(&"done".into());
                push(&sha256.into());
            }
            LoadEvent::Notice(text) => {
                push(&"notice".into());
                push(&text.into());
            }
            LoadEvent::Failed {
                message,
                details,
                fault,
            } => {
                push(&"failed".into());
                push(&message.into());
                push(&details.into());
                if let Some(fault) = fault {
                    let mut words = FaultKind::WORDS.iter();
                    let word = words.find(|(kind, _)| *kind == fault.kind);
                    push(&word.map(|(_, word)| *word).into());
                    push(&fault.name.into());
                    push(&(fault.bytes[0] as f64).into());
                    push(&(fault.bytes[1] as f64).into());
                    push(&fault.needed.into());
                }
            }
            LoadEvent::Cancelled => push(&"cancelled".into()),
        }
        send(&message, moved)
    }
}

/// The fault that ends a message of a failure, if there is one.
fn fault_of(message: &Array) -> Option<FileFault> {
    let text = |index: u32| message.get(index).as_string();
    let count = |index: u32| message.get(index).as_f64().map(|n| n as u64);
    let word = text(3)?;
    Some(FileFault {
        kind: FaultKind::WORDS.iter().find(|(_, w)| *w == word)?.0,
        name: text(4)?,
        bytes: [count(5)?, count(6)?],
        needed: text(7)?,
    })
}

fn event_of(message: &Array) -> Option<LoadEvent> {
    let text = |index: u32| message.get(index).as_string().unwrap_or_default();
    Some(match text(0).as_str() {
        "label-file" => {
            let header: Value = serde_json::from_str(&text(2)).ok()?;
            let mut segmentation = labels_of(&header)?;
            segmentation.labels = message.get(3).dyn_ref::<Uint8Array>()?.to_vec();
            let numbers = header.get("numbers")?.as_array()?.iter();
            let numbers = numbers.map(|n| u16::try_from(n.as_u64()?).ok());
            LoadEvent::LabelFile(Box::new(LabelFile {
                sha256: text(1),
                segmentation,
                numbers: numbers.collect::<Option<_>>()?,
            }))
        }
        "progress" => LoadEvent::Progress {
            fraction: message.get(1).as_f64()? as f32,
            what: text(2),
        },
        "coarse" => LoadEvent::Coarse,
        "frames" => LoadEvent::Frames {
            count: message.get(1).as_f64()? as u64,
        },
        "modality" => LoadEvent::Modality(text(1)),
        "raw" => LoadEvent::AskRaw(RawQuestion {
            byte_len: message.get(1).as_f64().map(|n| n as u64),
            is_packed: message.get(2).is_truthy(),
            guess: reading_of(&text(3)).raw,
        }),
        "written" => LoadEvent::Written(message.get(1).dyn_into::<Uint8Array>().ok()?.to_vec()),
        "done" => LoadEvent::Done {
            sha256: message.get(1).as_string(),
        },
        "notice" => LoadEvent::Notice(text(1)),
        "failed" => LoadEvent::Failed {
            message: text(1),
            details: text(2),
            fault: fault_of(message),
        },
        "cancelled" => LoadEvent::Cancelled,
        word => match pieces::unpacked(word, &message.get(1)) {
            Some(part) => LoadEvent::Part(part),
            None => LoadEvent::Failed {
                message: "The background thread sent a message that the page does not understand"
                    .to_owned(),
                details:
                    "fabrica.js and worker.js may be of different versions: load the page again."
                        .to_owned(),
                fault: None,
            },
        },
    })
}
