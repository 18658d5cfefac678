//! What each edit does to the tree.

use super::clay::clay;
use super::edit::Edit;
use super::lists::{insert, list, reorder, take};
use super::number::{color_text, rotation, rounded, rounded_size, rounded_value, vector};
use super::set::set;
use super::value;
use crate::displace::Holds;
use crate::document::limits::{DEFAULT_SUBJECT, MAX_LABELS, MAX_OBJECTS, MAX_TEMPLATES};
use crate::document::model::{
    Align, Background, Camera, Clay, Constrain, ConstrainBy, DRAWN, FIGURE_FRONT, MeshRef,
    OpacityMode, ParamKind, ParamValue, Reading, SubjectBox, SubjectRef, TemplateKind,
    TemplateMode, Transfer, Window,
};
use crate::document::text::DocumentError;
use crate::document::text::pointer::{self, join};
use glam::Quat;
use serde_json::{Value, json};

impl Edit {
    /// Does the edit in a tree. Those that are made of others or need to know the steps are done by
    /// `document::recording`.
    ///
    /// # Errors
    /// If there is no such template or caption, a limit would be passed, or the edit is one of the steps.
    pub(crate) fn change(&self, root: &mut Value) -> Result<(), DocumentError> {
        let template = |i: &usize| format!("/templates/{i}");
        match self {
            Self::Set { pointer, value, .. } => set(root, pointer, value.clone()),
            Self::Reset { pointer, .. } => pointer::remove(root, pointer).map(|_| ()),
            Self::AddTemplate {
                index,
                kind,
                placement,
            } => {
                let mut value = json!({
                    "kind": kind.spec().name,
                    "at": vector(placement.at),
                    "rotate": rotation(placement.rotate),
                    "size": placement.size.to_array().map(rounded_size),
                });
                if kind.facts().holds == Holds::Points {
                    value["params"] = value::fresh_points();
                }
                insert(root, "templates", MAX_TEMPLATES, *index, value)
            }
            Self::RemoveTemplate { template } => take(root, "templates", *template).map(|_| ()),
            Self::DuplicateTemplate { template: i } => {
                let copy = pointer::get(root, &template(i)).cloned().ok_or_else(|| {
                    DocumentError::NotFound {
                        pointer: template(i),
                    }
                })?;
                insert(root, "templates", MAX_TEMPLATES, i + 1, copy)
            }
            Self::MoveTemplate { from, to } => reorder(root, "templates", *from, *to),
            Self::SetParam {
                template: i,
                param,
                value,
            } => {
                let kind = pointer::get(root, &join(&template(i), "kind"))
                    .and_then(Value::as_str)
                    .and_then(TemplateKind::from_name);
                let pointer = format!("{}/params/{param}", template(i));
                let spec = kind
                    .and_then(|kind| kind.spec().params.iter().find(|spec| spec.name == *param))
                    .ok_or_else(|| DocumentError::NotFound {
                        pointer: pointer.clone(),
                    })?;
                let value = match (value, spec.kind) {
                    (ParamValue::Number(value), _) => rounded(*value),
                    (ParamValue::Flag(value), _) => json!(value),
                    (ParamValue::Choice(index), ParamKind::Choice { names }) => {
                        json!(names.get(*index as usize).or(names.first()))
                    }
                    (ParamValue::Choice(index), _) => json!(index),
                    (ParamValue::Vector(value), _) => vector(*value),
                    (ParamValue::Rotation(value), _) => rotation(*value),
                };
                set(root, &pointer, value)
            }
            Self::SetControlPoints {
                template: i,
                points,
            } => {
                let [listed, cut] = value::points_and_cut(points);
                let at = join(&template(i), "params");
                set(root, &join(&at, "points"), listed)?;
                set(root, &join(&at, "cut"), cut)
            }
            Self::SetTools { template: i, tools } => {
                let at = join(&template(i), "params");
                let before = pointer::get(root, &join(&at, "tools")).cloned();
                let mirror = value::mirrors(tools.mirror);
                set(root, &join(&at, "tools"), value::tools(tools, before))?;
                set(root, &join(&at, "mirror"), json!(mirror))
            }
            Self::SetPlacement {
                template: i,
                placement,
            } => {
                let at = template(i);
                set(root, &join(&at, "at"), vector(placement.at))?;
                set(root, &join(&at, "rotate"), rotation(placement.rotate))?;
                let size = placement.size.to_array().map(rounded_size);
                set(root, &join(&at, "size"), json!(size))
            }
            Self::SetCurve { template: i, curve } => {
                let at = join(&template(i), "curve");
                let Some(curve) = curve else {
                    return pointer::remove(root, &at).map(|_| ());
                };
                set(root, &at, value::curve(curve))
            }
            Self::SetAmount {
                template: i,
                amount,
            } => set(root, &join(&template(i), "amount"), rounded(*amount)),
            Self::SetEnabled {
                template: i,
                enabled,
            } => set(root, &join(&template(i), "enabled"), json!(enabled)),
            Self::SetMode { template: i, mode } => {
                let name = TemplateMode::NAMES[*mode as usize];
                set(root, &join(&template(i), "mode"), json!(name))
            }
            Self::SetAlign { template: i, align } => {
                let at = template(i);
                // Set key by key: unknown ones stay.
                let mut put =
                    |key: &str, value: Value| set(root, &format!("{at}/align/{key}"), value);
                match align {
                    Align::Axis => {
                        put("to", json!("axis"))?;
                        for key in ["keep", "depth", "thickness"] {
                            pointer::remove(root, &format!("{at}/align/{key}"))?;
                        }
                        Ok(())
                    }
                    Align::Surface { depth, thickness } => {
                        put("to", json!("surface"))?;
                        put("depth", rounded(*depth))?;
                        put("thickness", rounded(*thickness))?;
                        pointer::remove(root, &format!("{at}/align/keep")).map(|_| ())
                    }
                    Align::Segment { keep, thickness } => {
                        put("to", json!("segment"))?;
                        put("keep", json!(keep))?;
                        put("thickness", rounded(*thickness))?;
                        pointer::remove(root, &format!("{at}/align/depth")).map(|_| ())
                    }
                }
            }
            Self::SetConstrain {
                template: i,
                constrain,
            } => {
                let at = format!("{}/constrain", template(i));
                let Some(Constrain { by, keep }) = constrain else {
                    return pointer::remove(root, &at).map(|_| ());
                };
                let by = ConstrainBy::NAMES[*by as usize];
                set(root, &format!("{at}/by"), json!(by))?;
                set(root, &format!("{at}/keep"), json!(keep))
            }
            Self::RenameTemplate { template: i, name } => {
                set(root, &join(&template(i), "name"), json!(name))
            }
            Self::SetGroup { template: i, group } => {
                set(root, &join(&template(i), "group"), json!(group))
            }
            Self::InsertTemplates { index, templates } => {
                let end = list(root, "templates")?.len();
                let index = (*index).min(end);
                for (offset, value) in templates.iter().enumerate() {
                    insert(
                        root,
                        "templates",
                        MAX_TEMPLATES,
                        index + offset,
                        value.clone(),
                    )?;
                }
                Ok(())
            }
            Self::SetTransfer(transfer) => {
                let value = match transfer {
                    Transfer::Auto => json!("auto"),
                    Transfer::Preset(name) => json!(name),
                    Transfer::Points(points) => value::transfer_points(points),
                };
                if !matches!(transfer, Transfer::Points(_)) {
                    pointer::remove(root, "/look/tint")?;
                }
                set(root, "/look/transfer", value)
            }
            Self::SetPoints { points, tint } => {
                if *tint > 0.0 {
                    set(root, "/look/tint", rounded(*tint))?;
                } else {
                    pointer::remove(root, "/look/tint")?;
                }
                set(root, "/look/transfer", value::transfer_points(points))
            }
            Self::SetWindow(window) => {
                let value = match window {
                    Window::Auto => json!("auto"),
                    Window::Range(range) => json!(range.map(rounded_value)),
                };
                set(root, "/look/window", value)
            }
            Self::SetOpacity(mode) => {
                let name = OpacityMode::NAMES[*mode as usize];
                set(root, "/look/opacity", json!(name))
            }
            Self::SetStyle(preset) => set(root, "/look/style", json!(preset.unwrap_or("none"))),
            Self::SetBackground(background) => {
                let name = match background {
                    Background::None => "none".to_owned(),
                    Background::Color(color) => color_text(*color),
                };
                set(root, "/look/background", json!(name))
            }
            Self::SetCamera(camera) => {
                set(root, "/camera/target", vector(camera.target))?;
                set(
                    root,
                    "/camera/rotate",
                    rotation(written_rotation(root, camera)),
                )?;
                set(root, "/camera/distance", rounded(camera.distance))?;
                set(root, "/camera/fov", rounded(camera.fov_deg))
            }
            Self::SetTitle(text) => set(root, "/title", json!(text)),
            Self::SetLegend(text) => set(root, "/caption", json!(text)),
            Self::SetCredit(text) => set(root, "/credit", json!(text)),
            Self::SetLang(text) => set(root, "/lang", json!(text)),
            Self::SetSubject(subject) => {
                // Segments belong to the file, however it is called and read.
                if !is_same_file(root, subject) {
                    for key in ["segments", "features", "meshes"] {
                        pointer::remove(root, &join("/subject", key))?;
                    }
                }
                let clay_before = pointer::remove(root, "/subject/clay")?;
                for key in [
                    "builtin", "revision", "src", "sha256", "name", "frame", "raw", "units",
                    "axes", "parts", "smooth", "box",
                ] {
                    pointer::remove(root, &join("/subject", key))?;
                }
                if let SubjectRef::Meshes { meshes, bounds } = subject {
                    let meshes: Value = meshes.iter().map(value::mesh).collect();
                    set(root, "/subject/meshes", meshes)?;
                    return set_box(root, *bounds);
                }
                if let SubjectRef::Clay(given) = subject {
                    return set(root, "/subject/clay", clay(given, clay_before.as_ref()));
                }
                let mut put =
                    |key: &str, value: &str| set(root, &join("/subject", key), json!(value));
                match subject {
                    SubjectRef::Builtin { name, revision } => {
                        put("builtin", name)?;
                        match revision {
                            0 | 1 => Ok(()),
                            _ => set(root, "/subject/revision", json!(revision)),
                        }
                    }
                    SubjectRef::Address {
                        src, sha256, name, ..
                    } => {
                        put("src", src)?;
                        if let Some(sha256) = sha256 {
                            put("sha256", sha256)?;
                        }
                        put("name", name)
                    }
                    SubjectRef::Supplied { sha256, name, .. } => {
                        put("sha256", sha256)?;
                        put("name", name)
                    }
                    SubjectRef::Meshes { .. } | SubjectRef::Clay(_) => Ok(()),
                }?;
                match subject.reading() {
                    Some(reading) => {
                        set_reading(root, reading)?;
                        set_box(root, reading.bounds)
                    }
                    None => Ok(()),
                }
            }
            Self::AddStroke { index, stroke } => {
                let index = (*index).min(list(root, STROKES)?.len());
                insert(root, STROKES, Clay::MAX_STROKES, index, stroke.to_value())?;
                follow_counts(root, |shown| if shown > index { shown + 1 } else { shown });
                Ok(())
            }
            Self::RemoveStroke { stroke } => {
                take(root, STROKES, *stroke)?;
                let is_behind = |shown: usize| shown > *stroke;
                follow_counts(root, |shown| shown - usize::from(is_behind(shown)));
                Ok(())
            }
            Self::AddMesh { mesh, box_mm } => add_mesh(root, mesh, *box_mm),
            Self::RemoveMesh { mesh } => {
                let at = format!("/subject/meshes/{mesh}");
                match pointer::remove(root, &at)? {
                    Some(_) => Ok(()),
                    None => Err(DocumentError::NotFound { pointer: at }),
                }
            }
            Self::AddObject { index, object } => {
                insert(root, "objects", MAX_OBJECTS, *index, object.clone())
            }
            Self::RemoveObject { object } => take(root, "objects", *object).map(|_| ()),
            Self::DuplicateObject { object } => {
                let at = format!("/objects/{object}");
                let copy = pointer::get(root, &at).cloned();
                let copy = copy.ok_or(DocumentError::NotFound { pointer: at })?;
                insert(root, "objects", MAX_OBJECTS, object + 1, copy)
            }
            Self::MoveObject { from, to } => reorder(root, "objects", *from, *to),
            Self::PlaceObject { object, placement } => {
                let at = format!("/objects/{object}");
                if pointer::get(root, &at).is_none() {
                    return Err(DocumentError::NotFound { pointer: at });
                }
                set(root, &join(&at, "at"), vector(placement.at))?;
                set(root, &join(&at, "rotate"), rotation(placement.rotate))?;
                set(root, &join(&at, "size"), rounded(placement.size.max(1e-3)))
            }
            Self::AddCaption(caption) => insert(
                root,
                "labels",
                MAX_LABELS,
                usize::MAX,
                value::caption(caption),
            ),
            Self::ReplaceCaption { caption, value } => {
                let at = format!("/labels/{caption}");
                if pointer::get(root, &at).is_none() {
                    return Err(DocumentError::NotFound { pointer: at });
                }
                set(root, &join(&at, "at"), vector(value.at))?;
                set(root, &join(&at, "text"), json!(value.text))?;
                set(root, &join(&at, "enabled"), json!(value.enabled))
            }
            Self::RemoveCaption { caption } => take(root, "labels", *caption).map(|_| ()),
            Self::AddToFigure { list, index, entry } => {
                insert(root, list.key(), list.limit(), *index, entry.clone())
            }
            Self::RemoveFromFigure { list, index } => take(root, list.key(), *index).map(|_| ()),
            Self::MoveInFigure { list, from, to } => reorder(root, list.key(), *from, *to),
            Self::All { .. }
            | Self::AtStep { .. }
            | Self::AddStep { .. }
            | Self::RemoveStep { .. }
            | Self::DuplicateStep { .. }
            | Self::MoveStep { .. } => Err(DocumentError::Refused {
                pointer: "/steps".to_owned(),
            }),
        }
    }
}

/// The turn of a camera as a document has it: a figure's camera is not turned where it looks at the figure from the
/// front.
fn written_rotation(root: &Value, camera: &Camera) -> Quat {
    let subject = |key: &str| root.get("subject").and_then(|subject| subject.get(key));
    let has_file = subject("src").or(subject("sha256")).is_some();
    let is_figure = match subject("builtin").and_then(Value::as_str) {
        _ if subject("clay").is_some() => false,
        Some(name) => name.starts_with(DRAWN),
        None => has_file && root.get("figure").is_some(),
    };
    match is_figure {
        true => camera.rotate * FIGURE_FRONT.inverse(),
        false => camera.rotate,
    }
}

/// Where the strokes of a clay stand.
const STROKES: &str = "subject/clay/strokes";

/// Changes how many strokes the document and its steps show, where they say so.
fn follow_counts(root: &mut Value, followed: impl Fn(usize) -> usize) {
    let follow = |count: &mut Value| {
        if let Some(shown) = count.as_u64().and_then(|shown| usize::try_from(shown).ok()) {
            *count = json!(followed(shown));
        }
    };
    if let Some(count) = root.pointer_mut("/look/strokes") {
        follow(count);
    }
    let steps = root.get_mut("steps").and_then(Value::as_array_mut);
    for step in steps.into_iter().flatten() {
        let count = step
            .get_mut("set")
            .and_then(|set| set.get_mut("/look/strokes"));
        if let Some(count) = count {
            follow(count);
        }
    }
}

/// True if the document's subject is the file of `subject`.
fn is_same_file(root: &Value, subject: &SubjectRef) -> bool {
    let text = |key| {
        pointer::get(root, &join("/subject", key))
            .and_then(Value::as_str)
            .unwrap_or_default()
    };
    match subject {
        // Revisions of one subject have the same segments.
        SubjectRef::Builtin { name, .. } => {
            text("builtin") == name && pointer::get(root, "/subject/clay").is_none()
        }
        SubjectRef::Clay(_) => false,
        // Whatever else is said of them, they are other files.
        SubjectRef::Meshes { .. } => false,
        SubjectRef::Address { src, .. } => text("src") == src,
        SubjectRef::Supplied { sha256, .. } => {
            text("src").is_empty() && text("sha256").eq_ignore_ascii_case(sha256)
        }
    }
}

/// Writes how the subject's file is read.
fn set_reading(root: &mut Value, reading: &Reading) -> Result<(), DocumentError> {
    if reading.frame > 0 {
        set(root, "/subject/frame", json!(reading.frame))?;
    }
    if let Some(raw) = &reading.raw {
        set(root, "/subject/raw", value::raw(raw))?;
    }
    for (key, value) in value::mesh_reading(&reading.mesh) {
        set(root, &join("/subject", key), value)?;
    }
    Ok(())
}

/// Writes the box of a subject of meshes, if there is one.
fn set_box(root: &mut Value, box_mm: Option<SubjectBox>) -> Result<(), DocumentError> {
    let Some(b) = box_mm else {
        return Ok(());
    };
    let numbers = [b.min_mm.to_array(), b.max_mm.to_array()].concat();
    set(root, "/subject/box", json!(numbers))
}

/// Adds a mesh behind those that are there. A document that names no subject shows the head, and goes on to. `box_mm`
/// is the box that a subject of meshes has so far; written where none is, it keeps everything where it stands.
fn add_mesh(
    root: &mut Value,
    mesh: &MeshRef,
    box_mm: Option<SubjectBox>,
) -> Result<(), DocumentError> {
    let has = |root: &Value, key| pointer::get(root, &join("/subject", key)).is_some();
    let sources = ["builtin", "src", "sha256", "meshes", "clay"];
    if !sources.into_iter().any(|key| has(root, key)) {
        set(root, "/subject/builtin", json!(DEFAULT_SUBJECT))?;
    }
    set_box(root, box_mm.filter(|_| !has(root, "box")))?;
    set(root, "/subject/meshes/-", value::mesh(mesh))
}
