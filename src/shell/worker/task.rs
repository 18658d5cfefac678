//! What a part is asked to do, as a message to its worker: an object with the fields `part` (its name), `module` (its
//! compiled module, if the page has it), `max_dim` and `max_voxels` (the limits of the device), `task` (`true`), and
//! - for the makers of subjects `builtin` (a name), `revision` and `resolution` (voxels along the longest side; without
//!   it the coarse volume comes first, then the fine one),
//! - for the readers of scans and of meshes `builtin` (of a mesh) and `carves`, `files` (pairs of name and `Blob`),
//!   `address`, or `field` (a pair), with `reading` (JSON), `are_segments` (of an address), `labels` (SHA-256 of label
//!   volumes), `has_scan` and `may_be_field`,
//! - for the shaper of clays `clay` (a text) and `meshes` (grids of its tools), with `address` or `files` where it
//!   begins with a file, `format` (the end of a file's name) and `title` where it is to become a file,
//! - for the bender of figures `figure` (a text), `bender` (a number: each has one plate), `rounds`, and `plate` where
//!   it is to be another one from now on.

use std::sync::Arc;

use glam::DVec3;
use js_sys::{Array, Object, Reflect};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;
use web_sys::Blob;

use super::pieces;
use crate::assets::{BendPose, BendRequest, SegmentationsExpected, Want};
use crate::clay::Writing;
use crate::data::{MeshGrids, VolumeLimits};
use crate::document::{
    Clay, MeshAxes, MeshParts, MeshReading, MeshRef, MeshUnits, RawVoxels, Reading, SubjectBox,
    clay_to_text, figure_from_text, figure_to_text, is_drawn_name,
};
use crate::figure::is_figure_name;
use crate::load::{are_mesh_names, is_mesh_name};
use crate::subjects::mesh_names;

/// A program that runs in a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Makes the built-in subjects.
    Subjects,
    /// Reads scans, label volumes and displacement fields.
    Scans,
    /// Reads meshes and prepares them.
    Meshes,
    /// Unpacks pictures, for other parts.
    Pictures,
    /// Reads figures and bends them.
    Figures,
    /// Shapes clays.
    Clay,
}

impl Part {
    /// The name by which web/worker.js finds its files: `fabrica_NAME.js` and `fabrica_NAME_bg.wasm`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Subjects => "subjects",
            Self::Scans => "scans",
            Self::Meshes => "meshes",
            Self::Pictures => "pictures",
            Self::Figures => "figures",
            Self::Clay => "clay",
        }
    }

    /// The part that reads what lies at an address, by its name. If it is something else, the part says so.
    pub fn of_address(address: &str) -> Self {
        let path = address.split(['?', '#']).next().unwrap_or_default();
        if is_figure_name(path) {
            return Self::Figures;
        }
        match is_mesh_name(path) {
            true => Self::Meshes,
            false => Self::Scans,
        }
    }

    /// The part of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        const ALL: [Part; 6] = [
            Part::Subjects,
            Part::Scans,
            Part::Meshes,
            Part::Pictures,
            Part::Figures,
            Part::Clay,
        ];
        ALL.into_iter().find(|part| part.name() == name)
    }
}

/// What a part is to do.
#[derive(Clone, Debug)]
pub enum Task {
    /// Make a built-in subject.
    Subject {
        /// As documents write it.
        name: String,
        /// Which of its revisions, from 1.
        revision: u32,
        /// Voxels along its longest side; `None`: coarse and then fine.
        resolution: Option<u32>,
    },
    /// Read files: a scan, meshes, labels or a displacement field.
    Scan(ScanTask),
    /// Bend a figure, by the bender of this number.
    Bend(u32, BendRequest),
    /// Shape a clay, and read the file that it begins with.
    Clay(ClayTask, Option<ScanTask>),
}

/// The clay that is to be shaped.
#[derive(Clone, Debug)]
pub struct ClayTask {
    /// Its recipe as a text, see [`clay_to_text`].
    pub recipe: String,
    /// The grids of its tools that are meshes, by the keys of their files.
    pub meshes: MeshGrids,
    /// It is still being shaped, and wanted soon.
    pub is_sketch: bool,
    /// The file that it is to become; `None`: the subject.
    pub writing: Option<Writing>,
}

impl ClayTask {
    /// The task for what a want says of a clay.
    pub fn of(clay: &Clay, want: &Want) -> Self {
        Self {
            recipe: clay_to_text(clay),
            meshes: want.meshes.clone(),
            is_sketch: want.is_sketch,
            writing: None,
        }
    }
}

/// What the parts that read files are to do.
#[derive(Clone, Debug)]
pub enum ScanTask {
    /// Read files that the reader gave.
    Files {
        /// Names and contents, the one that describes the others first.
        files: Vec<(String, Blob)>,
        /// How the file is to be read.
        reading: Reading,
        /// Which of the files may be label volumes.
        segmentations: SegmentationsExpected,
        /// A single file that the reader opened, which is read as a displacement field if it says that it is one.
        may_be_field: bool,
    },
    /// Fetch an address and read the bytes that come.
    Address {
        /// Absolute; the reader agreed to its host.
        address: String,
        /// A label volume is wanted, not a scan.
        are_segments: bool,
        /// How the file is to be read.
        reading: Reading,
    },
    /// Make a built-in subject that is a mesh, or a tool; true for one that a template carves by.
    Mesh(String, bool),
    /// Read a displacement field.
    Field {
        /// Name of the file, which tells its format.
        name: String,
        /// The bytes of the file.
        file: Blob,
    },
}

impl Task {
    /// The task to make a revision of a built-in subject, so many voxels along its longest side; `None`: coarse and
    /// then fine.
    pub fn subject(name: &str, revision: u32, resolution: Option<u32>) -> Self {
        Self::Subject {
            name: name.to_owned(),
            revision,
            resolution,
        }
    }

    /// The program that does it, as far as names tell; a part that finds otherwise hands the task on.
    pub fn part(&self) -> Part {
        match self {
            Self::Bend(..) => Part::Figures,
            Self::Clay(..) => Part::Clay,
            Self::Subject { name, .. } if is_drawn_name(name) => Part::Figures,
            Self::Subject { name, .. } if mesh_names().contains(&name.as_str()) => Part::Meshes,
            Self::Subject { .. } => Part::Subjects,
            Self::Scan(ScanTask::Mesh(..)) => Part::Meshes,
            Self::Scan(ScanTask::Files { files, .. }) => {
                if let [(name, _)] = files.as_slice()
                    && is_figure_name(name)
                {
                    return Part::Figures;
                }
                match are_mesh_names(files.iter().map(|(name, _)| name.as_str())) {
                    true => Part::Meshes,
                    false => Part::Scans,
                }
            }
            Self::Scan(ScanTask::Address {
                address,
                are_segments: false,
                ..
            }) => Part::of_address(address),
            Self::Scan(_) => Part::Scans,
        }
    }

    /// The message for the worker. `module` is the compiled module of the part, if the page has it.
    ///
    /// # Errors
    /// If the browser refuses to set a field of a new object.
    pub fn message(&self, limits: VolumeLimits, module: &JsValue) -> Result<Object, JsValue> {
        let message = Object::new();
        let set = |key: &str, value: &JsValue| Reflect::set(&message, &key.into(), value);
        set("part", &self.part().name().into())?;
        set("module", module)?;
        set("task", &true.into())?;
        set("max_dim", &limits.max_dim.into())?;
        set("max_voxels", &(limits.max_voxels as f64).into())?;
        match self {
            Self::Bend(bender, request) => {
                set("bender", &(*bender).into())?;
                set("figure", &figure_to_text(&request.figure).into())?;
                if let BendPose::Following(rounds) = request.pose {
                    set("rounds", &rounds.into())?;
                }
                set("aside", &(request.pose == BendPose::Aside).into())?;
                set("finer", &(request.pose == BendPose::Finer).into())?;
                if let Some(plate) = &request.plate {
                    set("plate", &pieces::packed_plate(plate))?;
                }
            }
            Self::Clay(clay, file) => {
                set("clay", &clay.recipe.as_str().into())?;
                set("meshes", &pieces::packed_grids(&clay.meshes))?;
                set("sketch", &clay.is_sketch.into())?;
                if let Some(writing) = &clay.writing {
                    set("format", &writing.format.extension().into())?;
                    set("title", &writing.title.as_str().into())?;
                }
                if let Some(file) = file {
                    file.put_into(&message)?;
                }
            }
            Self::Subject {
                name,
                revision,
                resolution,
            } => {
                set("builtin", &name.into())?;
                set("revision", &(*revision).into())?;
                set("resolution", &(*resolution).into())?;
            }
            Self::Scan(task) => task.put_into(&message)?,
        }
        Ok(message)
    }
}

impl ScanTask {
    fn put_into(&self, message: &Object) -> Result<(), JsValue> {
        let set = |key: &str, value: &JsValue| Reflect::set(message, &key.into(), value);
        match self {
            Self::Files {
                files,
                reading,
                segmentations,
                may_be_field,
            } => {
                let files = files
                    .iter()
                    .map(|(name, blob)| Array::of2(&name.into(), blob));
                set("files", &files.collect::<Array>())?;
                set("reading", &text_of_reading(reading).into())?;
                let hashes: Array = segmentations.sha256.iter().map(JsValue::from).collect();
                set("labels", &hashes)?;
                set("has_scan", &segmentations.has_scan.into())?;
                set("may_be_field", &(*may_be_field).into())?;
            }
            Self::Address {
                address,
                are_segments,
                reading,
            } => {
                set("address", &address.into())?;
                set("are_segments", &(*are_segments).into())?;
                set("reading", &text_of_reading(reading).into())?;
            }
            Self::Mesh(name, carves) => {
                set("builtin", &name.into())?;
                set("carves", &(*carves).into())?;
            }
            Self::Field { name, file } => {
                set("field", &Array::of2(&name.into(), file))?;
            }
        }
        Ok(())
    }

    /// What a message asks for.
    ///
    /// # Errors
    /// If the message is no object.
    pub fn of(message: &JsValue) -> Result<Self, JsValue> {
        let get = |key: &str| Reflect::get(message, &key.into());
        let pair = |value: JsValue| {
            let pair: Array = value.unchecked_into();
            let name = pair.get(0).as_string().unwrap_or_default();
            (name, pair.get(1).unchecked_into::<Blob>())
        };
        if let Some(name) = get("builtin")?.as_string() {
            return Ok(Self::Mesh(name, get("carves")?.is_truthy()));
        }
        let field = get("field")?;
        if field.is_truthy() {
            let (name, file) = pair(field);
            return Ok(Self::Field { name, file });
        }
        let reading = reading_of(&get("reading")?.as_string().unwrap_or_default());
        if let Some(address) = get("address")?.as_string() {
            return Ok(Self::Address {
                address,
                are_segments: get("are_segments")?.is_truthy(),
                reading,
            });
        }
        let files: Array = get("files")?.unchecked_into();
        let hashes: Array = get("labels")?.unchecked_into();
        Ok(Self::Files {
            files: files.iter().map(pair).collect(),
            reading,
            segmentations: SegmentationsExpected {
                sha256: hashes.iter().filter_map(|hash| hash.as_string()).collect(),
                has_scan: get("has_scan")?.is_truthy(),
            },
            may_be_field: get("may_be_field")?.is_truthy(),
        })
    }
}

/// What a message asks the bender of a number for; `None` if it is another task.
///
/// # Errors
/// If the message is no object, or has no figure that can be read.
pub fn bend_of(message: &JsValue) -> Result<Option<(u32, BendRequest)>, JsValue> {
    let get = |key: &str| Reflect::get(message, &key.into());
    let Some(text) = get("figure")?.as_string() else {
        return Ok(None);
    };
    let figure = figure_from_text(&text).map_err(|error| JsValue::from(error.to_string()))?;
    let request = BendRequest {
        plate: pieces::unpacked_plate(&get("plate")?).map(Arc::new),
        figure,
        pose: match get("rounds")?.as_f64() {
            Some(rounds) => BendPose::Following(rounds as u32),
            None if get("aside")?.is_truthy() => BendPose::Aside,
            None if get("finer")?.is_truthy() => BendPose::Finer,
            None => BendPose::AtRest,
        },
    };
    let bender = get("bender")?.as_f64().unwrap_or_default() as u32;
    Ok(Some((bender, request)))
}

/// The limits of the device that a message gives.
///
/// # Errors
/// If the message is no object.
pub fn limits_of(message: &JsValue) -> Result<VolumeLimits, JsValue> {
    let number = |key: &str| {
        Reflect::get(message, &key.into()).map(|value| value.as_f64().unwrap_or_default())
    };
    Ok(VolumeLimits {
        max_dim: number("max_dim")? as u32,
        max_voxels: number("max_voxels")? as u64,
    })
}

/// How a file is to be read, as JSON.
pub fn text_of_reading(reading: &Reading) -> String {
    let raw = reading.raw.as_ref().map(|raw| {
        json!({
            "size": raw.size, "element": raw.element, "big_endian": raw.big_endian,
            "spacing_mm": raw.spacing_mm, "skip_bytes": raw.skip_bytes,
        })
    });
    let bounds = reading
        .bounds
        .map(|bounds| json!([bounds.min_mm.to_array(), bounds.max_mm.to_array()]));
    let meshes: Vec<Value> = reading.meshes.iter().map(|mesh| {
        json!({
            "src": mesh.src, "sha256": mesh.sha256, "name": mesh.name, "mesh": value_of_mesh(&mesh.reading),
        })
    }).collect();
    json!({
        "frame": reading.frame, "raw": raw, "mesh": value_of_mesh(&reading.mesh), "bounds": bounds, "meshes": meshes,
        "carves": reading.carves, "sweeps": reading.sweeps,
    })
    .to_string()
}

fn value_of_mesh(reading: &MeshReading) -> Value {
    json!({
        "units": reading.units.map(MeshUnits::name), "axes": reading.axes.map(MeshAxes::name),
        "parts": reading.parts.name(), "smooth_deg": reading.smooth_deg,
    })
}

/// How a file is to be read, from [`text_of_reading`]; nothing in particular if the text is not from there.
pub fn reading_of(text: &str) -> Reading {
    let value: Value = serde_json::from_str(text).unwrap_or_default();
    Reading {
        frame: value.get("frame").and_then(Value::as_u64).unwrap_or(0),
        raw: value.get("raw").and_then(raw_of),
        mesh: value.get("mesh").map(mesh_of).unwrap_or_default(),
        bounds: value.get("bounds").and_then(bounds_of),
        carves: value.get("carves").and_then(Value::as_bool) == Some(true),
        sweeps: value.get("sweeps").and_then(Value::as_bool) == Some(true),
        meshes: value
            .get("meshes")
            .and_then(Value::as_array)
            .map_or_else(Vec::new, |list| {
                list.iter()
                    .enumerate()
                    .map(|(index, mesh)| mesh_ref_of(index, mesh))
                    .collect()
            }),
    }
}

fn bounds_of(value: &Value) -> Option<SubjectBox> {
    let corner = |index: usize| {
        let number = |axis: usize| value.get(index)?.get(axis)?.as_f64();
        Some(DVec3::new(number(0)?, number(1)?, number(2)?))
    };
    Some(SubjectBox {
        min_mm: corner(0)?,
        max_mm: corner(1)?,
    })
}

fn mesh_ref_of(index: usize, value: &Value) -> MeshRef {
    let text = |key: &str| value.get(key).and_then(Value::as_str).map(str::to_owned);
    MeshRef {
        index,
        src: text("src"),
        sha256: text("sha256"),
        name: text("name").unwrap_or_default(),
        reading: value.get("mesh").map(mesh_of).unwrap_or_default(),
    }
}

fn mesh_of(value: &Value) -> MeshReading {
    let text = |key: &str| value.get(key).and_then(Value::as_str).unwrap_or_default();
    let smooth = value.get("smooth_deg").and_then(Value::as_f64);
    MeshReading {
        units: MeshUnits::from_name(text("units")),
        axes: MeshAxes::from_name(text("axes")),
        parts: MeshParts::from_name(text("parts")).unwrap_or_default(),
        smooth_deg: smooth.map(|degrees| degrees as f32),
    }
}

fn raw_of(value: &Value) -> Option<RawVoxels> {
    let element = value.get("element")?.as_str()?;
    let size = value.get("size")?.as_array()?.iter();
    let size: Option<Vec<u32>> = size.map(|n| u32::try_from(n.as_u64()?).ok()).collect();
    let spacing = value.get("spacing_mm")?.as_array()?.iter();
    let spacing: Option<Vec<f64>> = spacing.map(Value::as_f64).collect();
    Some(RawVoxels {
        size: size?.try_into().ok()?,
        element: RawVoxels::ELEMENTS
            .into_iter()
            .find(|known| *known == element)?,
        big_endian: value.get("big_endian")?.as_bool()?,
        spacing_mm: spacing?.try_into().ok()?,
        skip_bytes: value.get("skip_bytes")?.as_u64()?,
    })
}
