use super::catalogue::{ParamKind, ParamValue, TemplateKind};
use super::curve::Curve;
use super::error::DocumentError;
use super::illustration::{
    Align, Background, Camera, Constrain, ConstrainBy, ControlPoints, Label, OpacityMode, Reading,
    SubjectRef, TemplateMode, Transfer, TransferPoint, Window,
};
use super::pointer::{self, join};
use super::resolve_data::{fresh_points, points_listed};
use super::tree::Document;
use super::{MAX_LABELS, MAX_STEPS, MAX_TEMPLATES};
use crate::math::Placement;
use glam::{Quat, Vec3};
use serde_json::{Map, Value, json};

/// Something that is done to a document. Numbers are rounded to four decimals on the way in, as links keep them short.
///
/// A template, label or step is meant by its index in the document's list ([`super::PlacedTemplate::index`]), which
/// counts unknown kinds too. Pointers in the steps follow what is reordered, and vanish with what is removed.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Sets any value by JSON pointer, as it stands (not rounded).
    Set {
        /// Where.
        pointer: String,
        /// What.
        value: Value,
        /// For the menu: “Set key”.
        name: String,
    },
    /// Puts a key back to its default.
    Reset {
        /// Where.
        pointer: String,
        /// For the menu.
        name: String,
    },
    /// Places a new template before the one of that index (or last).
    AddTemplate {
        /// Its index afterwards; larger than the number of templates means last.
        index: usize,
        /// What it does.
        kind: TemplateKind,
        /// Where its cube lies.
        placement: Placement,
    },
    /// Removes a template.
    RemoveTemplate {
        /// Which.
        template: usize,
    },
    /// Places a copy right after a template.
    DuplicateTemplate {
        /// Which.
        template: usize,
    },
    /// Changes when a template acts.
    MoveTemplate {
        /// Which.
        from: usize,
        /// Its index afterwards.
        to: usize,
    },
    /// Sets a parameter.
    SetParam {
        /// Of which template.
        template: usize,
        /// By name.
        param: &'static str,
        /// Of the type that the catalogue says.
        value: ParamValue,
    },
    /// Sets the control points and the cut of an `rbf`.
    SetControlPoints {
        /// Which.
        template: usize,
        /// Template space.
        points: ControlPoints,
    },
    /// Moves, turns or sizes a template.
    SetPlacement {
        /// Which.
        template: usize,
        /// Where its cube lies then.
        placement: Placement,
    },
    /// Lays a template along a curve.
    SetCurve {
        /// Which.
        template: usize,
        /// Template space; none makes it straight.
        curve: Option<Curve>,
    },
    /// Sets how much of a template is done.
    SetAmount {
        /// Which.
        template: usize,
        /// 0 (as if not there) to 1 (as its parameters say).
        amount: f32,
    },
    /// Switches a template on or off.
    SetEnabled {
        /// Which.
        template: usize,
        /// On.
        enabled: bool,
    },
    /// Sets how a template joins the one before it.
    SetMode {
        /// Which.
        template: usize,
        /// How.
        mode: TemplateMode,
    },
    /// Sets what a template leaves alone.
    SetAlign {
        /// Which.
        template: usize,
        /// What.
        align: Align,
    },
    /// Sets what a template's displacement gives way to.
    SetConstrain {
        /// Which.
        template: usize,
        /// What; none takes the constraint away.
        constrain: Option<Constrain>,
    },
    /// Gives a template the author's name.
    RenameTemplate {
        /// Which.
        template: usize,
        /// Empty for none.
        name: String,
    },
    /// Puts a template into a group of the list.
    SetGroup {
        /// Which.
        template: usize,
        /// Name of the group; empty for none.
        group: String,
    },
    /// Puts templates that come from elsewhere before the one of that index (or last).
    InsertTemplates {
        /// Index of the first afterwards; larger than the number of templates means last.
        index: usize,
        /// As in a document.
        templates: Vec<Value>,
    },
    /// Several edits, one after the other, as one step.
    All {
        /// What they do together.
        name: String,
        /// Each sees what the ones before it left.
        edits: Vec<Edit>,
    },
    /// Sets opacity and colour over value. A preset brings its own tint; listed points leave the tint as it is.
    SetTransfer(Transfer),
    /// Lists points in place of a preset, and says how much the segments' own colours tint them.
    SetPoints {
        /// At absolute values, sorted.
        points: Vec<TransferPoint>,
        /// 0 to 1; 0 is not written.
        tint: f32,
    },
    /// Sets the value range of a preset.
    SetWindow(Window),
    /// Sets how opacity follows the deformation.
    SetOpacity(OpacityMode),
    /// Sets what is behind the object.
    SetBackground(Background),
    /// Sets where it is seen from.
    SetCamera(Camera),
    /// Sets the title.
    SetTitle(String),
    /// Sets the caption.
    SetCaption(String),
    /// Sets the credit line.
    SetCredit(String),
    /// Sets the language of the texts.
    SetLang(String),
    /// Shows another subject. What the document said about the one before (segments, revision) goes.
    SetSubject(SubjectRef),
    /// Adds a label at the end.
    AddLabel(Label),
    /// Changes a label.
    SetLabel {
        /// Which.
        label: usize,
        /// What it is then.
        value: Label,
    },
    /// Removes a label.
    RemoveLabel {
        /// Which.
        label: usize,
    },
    /// Adds a step before the one of that index, counted from 0 for the first after step 0.
    AddStep {
        /// Its index afterwards; larger than the number of steps means last.
        index: usize,
        /// The step as JSON: `title`, `caption`, `set`, `seconds`.
        step: Value,
    },
    /// Removes a step.
    RemoveStep {
        /// Which, from 0 for the first after step 0.
        step: usize,
    },
    /// Changes when a step comes.
    MoveStep {
        /// Which.
        from: usize,
        /// Its index afterwards.
        to: usize,
    },
}

/// Four decimals, which for a subject of 25 cm is 0.025 mm.
pub(super) fn rounded(value: f32) -> Value {
    json!((f64::from(value) * 1e4).round() / 1e4)
}

/// Sides of a template: never rounded to nothing.
fn rounded_size(value: f32) -> Value {
    rounded(value.max(1e-4))
}

/// Voxel values have any scale: four decimals, or five digits where these are finer.
fn rounded_value(value: f32) -> Value {
    let value = f64::from(value);
    if value == 0.0 || value.abs() >= 1.0 {
        json!((value * 1e4).round() / 1e4)
    } else {
        json!(format!("{value:.4e}").parse::<f64>().unwrap_or(value))
    }
}

pub(super) fn vector(v: Vec3) -> Value {
    Value::from(v.to_array().map(rounded).to_vec())
}

fn rotation(q: Quat) -> Value {
    // One of the two quaternions of a rotation, so that the identity is always the default.
    let q = if q.w < 0.0 { -q } else { q };
    Value::from(q.to_array().map(rounded).to_vec())
}

/// `#rrggbb`.
pub(crate) fn hex(color_srgb: [u8; 3]) -> String {
    let [r, g, b] = color_srgb;
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn listed(points: &[TransferPoint]) -> Value {
    points
        .iter()
        .map(|point| {
            json!({
                "value": rounded_value(point.value),
                "color": hex(point.color_srgb),
                "opacity": rounded(point.opacity),
            })
        })
        .collect()
}

impl Edit {
    /// The document with the edit done.
    ///
    /// # Errors
    /// If there is no such template, label or step, or a limit would be passed.
    pub fn apply(&self, document: &Document) -> Result<Document, DocumentError> {
        document.edited(|root| self.change(root))
    }

    fn change(&self, root: &mut Value) -> Result<(), DocumentError> {
        let template = |i: &usize| format!("/templates/{i}");
        match self {
            Self::Set { pointer, value, .. } => pointer::set(root, pointer, value.clone()),
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
                if *kind == TemplateKind::Rbf {
                    value["params"] = fresh_points();
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
                pointer::set(root, &pointer, value)
            }
            Self::SetControlPoints {
                template: i,
                points,
            } => {
                let [listed, cut] = points_listed(points);
                let at = join(&template(i), "params");
                pointer::set(root, &join(&at, "points"), listed)?;
                pointer::set(root, &join(&at, "cut"), cut)
            }
            Self::SetPlacement {
                template: i,
                placement,
            } => {
                let at = template(i);
                pointer::set(root, &join(&at, "at"), vector(placement.at))?;
                pointer::set(root, &join(&at, "rotate"), rotation(placement.rotate))?;
                let size = placement.size.to_array().map(rounded_size);
                pointer::set(root, &join(&at, "size"), json!(size))
            }
            Self::SetCurve { template: i, curve } => {
                let at = join(&template(i), "curve");
                let Some(curve) = curve else {
                    return pointer::remove(root, &at).map(|_| ());
                };
                pointer::set(root, &at, curve.value())
            }
            Self::SetAmount {
                template: i,
                amount,
            } => pointer::set(root, &join(&template(i), "amount"), rounded(*amount)),
            Self::SetEnabled {
                template: i,
                enabled,
            } => pointer::set(root, &join(&template(i), "enabled"), json!(enabled)),
            Self::SetMode { template: i, mode } => {
                let name = match mode {
                    TemplateMode::Compose => "compose",
                    TemplateMode::Add => "add",
                };
                pointer::set(root, &join(&template(i), "mode"), json!(name))
            }
            Self::SetAlign { template: i, align } => {
                let at = template(i);
                // Set key by key: unknown ones stay.
                let mut set = |key: &str, value: Value| {
                    pointer::set(root, &format!("{at}/align/{key}"), value)
                };
                match align {
                    Align::Axis => {
                        set("to", json!("axis"))?;
                        for key in ["keep", "depth", "thickness"] {
                            pointer::remove(root, &format!("{at}/align/{key}"))?;
                        }
                        Ok(())
                    }
                    Align::Surface { depth, thickness } => {
                        set("to", json!("surface"))?;
                        set("depth", rounded(*depth))?;
                        set("thickness", rounded(*thickness))?;
                        pointer::remove(root, &format!("{at}/align/keep")).map(|_| ())
                    }
                    Align::Segment { keep, thickness } => {
                        set("to", json!("segment"))?;
                        set("keep", json!(keep))?;
                        set("thickness", rounded(*thickness))?;
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
                let by = match by {
                    ConstrainBy::Displacement => "displacement",
                    ConstrainBy::Coordinate => "coordinate",
                    ConstrainBy::Rigid => "rigid",
                };
                pointer::set(root, &format!("{at}/by"), json!(by))?;
                pointer::set(root, &format!("{at}/keep"), json!(keep))
            }
            Self::RenameTemplate { template: i, name } => {
                pointer::set(root, &join(&template(i), "name"), json!(name))
            }
            Self::SetGroup { template: i, group } => {
                pointer::set(root, &join(&template(i), "group"), json!(group))
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
            Self::All { edits, .. } => edits.iter().try_for_each(|edit| edit.change(root)),
            Self::SetTransfer(transfer) => {
                let value = match transfer {
                    Transfer::Auto => json!("auto"),
                    Transfer::Preset(name) => json!(name),
                    Transfer::Points(points) => listed(points),
                };
                if !matches!(transfer, Transfer::Points(_)) {
                    pointer::remove(root, "/look/tint")?;
                }
                pointer::set(root, "/look/transfer", value)
            }
            Self::SetPoints { points, tint } => {
                if *tint > 0.0 {
                    pointer::set(root, "/look/tint", rounded(*tint))?;
                } else {
                    pointer::remove(root, "/look/tint")?;
                }
                pointer::set(root, "/look/transfer", listed(points))
            }
            Self::SetWindow(window) => {
                let value = match window {
                    Window::Auto => json!("auto"),
                    Window::Range(range) => json!(range.map(rounded_value)),
                };
                pointer::set(root, "/look/window", value)
            }
            Self::SetOpacity(mode) => {
                let name = match mode {
                    OpacityMode::Constancy => "constancy",
                    OpacityMode::Mass => "mass",
                    OpacityMode::None => "none",
                };
                pointer::set(root, "/look/opacity", json!(name))
            }
            Self::SetBackground(background) => {
                let name = match background {
                    Background::None => "none".to_owned(),
                    Background::Color(color) => hex(*color),
                };
                pointer::set(root, "/look/background", json!(name))
            }
            Self::SetCamera(camera) => {
                pointer::set(root, "/camera/target", vector(camera.target))?;
                pointer::set(root, "/camera/rotate", rotation(camera.rotate))?;
                pointer::set(root, "/camera/distance", rounded(camera.distance))?;
                pointer::set(root, "/camera/fov", rounded(camera.fov_deg))
            }
            Self::SetTitle(text) => pointer::set(root, "/title", json!(text)),
            Self::SetCaption(text) => pointer::set(root, "/caption", json!(text)),
            Self::SetCredit(text) => pointer::set(root, "/credit", json!(text)),
            Self::SetLang(text) => pointer::set(root, "/lang", json!(text)),
            Self::SetSubject(subject) => {
                // Segments belong to the file, however it is called and read.
                if !is_same_file(root, subject) {
                    pointer::remove(root, "/subject/segments")?;
                    pointer::remove(root, "/subject/features")?;
                }
                for key in [
                    "builtin", "revision", "src", "sha256", "name", "frame", "raw",
                ] {
                    pointer::remove(root, &join("/subject", key))?;
                }
                let mut set = |key: &str, value: &str| {
                    pointer::set(root, &join("/subject", key), json!(value))
                };
                match subject {
                    SubjectRef::Builtin { name } => set("builtin", name),
                    SubjectRef::Address {
                        src, sha256, name, ..
                    } => {
                        set("src", src)?;
                        if let Some(sha256) = sha256 {
                            set("sha256", sha256)?;
                        }
                        set("name", name)
                    }
                    SubjectRef::Supplied { sha256, name, .. } => {
                        set("sha256", sha256)?;
                        set("name", name)
                    }
                }?;
                match subject.reading() {
                    Some(reading) => set_reading(root, reading),
                    None => Ok(()),
                }
            }
            Self::AddLabel(label) => {
                insert(root, "labels", MAX_LABELS, usize::MAX, label_value(label))
            }
            Self::SetLabel { label, value } => {
                let at = format!("/labels/{label}");
                if pointer::get(root, &at).is_none() {
                    return Err(DocumentError::NotFound { pointer: at });
                }
                pointer::set(root, &join(&at, "at"), vector(value.at))?;
                pointer::set(root, &join(&at, "text"), json!(value.text))
            }
            Self::RemoveLabel { label } => take(root, "labels", *label).map(|_| ()),
            Self::AddStep { index, step } => insert(root, "steps", MAX_STEPS, *index, step.clone()),
            Self::RemoveStep { step } => take(root, "steps", *step).map(|_| ()),
            Self::MoveStep { from, to } => reorder(root, "steps", *from, *to),
        }
    }

    /// What the edit does, for the menu, as seen from the document before it: “Move peel”.
    pub fn name(&self, document: &Document) -> String {
        let name_of = |i: &usize| {
            let key = |key: &str| {
                document
                    .get(&format!("/templates/{i}/{key}"))
                    .and_then(Value::as_str)
                    .filter(|name| !name.is_empty())
            };
            let name = key("name").or_else(|| key("kind")).unwrap_or("template");
            super::json::shortened(name, 32)
        };
        match self {
            Self::Set { name, .. } | Self::Reset { name, .. } => name.clone(),
            Self::AddTemplate { kind, .. } => format!("Add {}", kind.spec().name),
            Self::RemoveTemplate { template } => format!("Remove {}", name_of(template)),
            Self::DuplicateTemplate { template } => format!("Duplicate {}", name_of(template)),
            Self::MoveTemplate { from, .. } => format!("Reorder {}", name_of(from)),
            Self::SetParam {
                template, param, ..
            } => format!("Change {param} of {}", name_of(template)),
            Self::SetControlPoints { template, .. } => {
                format!("Change points of {}", name_of(template))
            }
            Self::SetPlacement {
                template,
                placement,
            } => {
                let before = document
                    .illustration()
                    .templates
                    .iter()
                    .find(|t| t.index == *template)
                    .map(|t| t.placement);
                let verb = match before {
                    Some(b) if b.rotate == placement.rotate && b.size == placement.size => "Move",
                    Some(b) if b.at == placement.at && b.size == placement.size => "Turn",
                    Some(b) if b.rotate == placement.rotate => "Resize",
                    _ => "Place",
                };
                format!("{verb} {}", name_of(template))
            }
            Self::SetCurve {
                template,
                curve: None,
            } => format!("Straighten {}", name_of(template)),
            Self::SetCurve { template, .. } => format!("Bend {}", name_of(template)),
            Self::SetAmount { template, .. } => format!("Change amount of {}", name_of(template)),
            Self::SetEnabled { template, enabled } => {
                format!(
                    "{} {}",
                    if *enabled { "Show" } else { "Hide" },
                    name_of(template)
                )
            }
            Self::SetMode { template, .. } => format!("Change mode of {}", name_of(template)),
            Self::SetAlign { template, .. } => format!("Change alignment of {}", name_of(template)),
            Self::SetConstrain { template, .. } => {
                format!("Change constraint of {}", name_of(template))
            }
            Self::RenameTemplate { template, .. } => format!("Rename {}", name_of(template)),
            Self::SetGroup { template, group } if group.is_empty() => {
                format!("Ungroup {}", name_of(template))
            }
            Self::SetGroup { template, .. } => format!("Group {}", name_of(template)),
            Self::InsertTemplates { .. } => "Paste templates".to_owned(),
            Self::All { name, .. } => name.clone(),
            Self::SetTransfer(_) | Self::SetPoints { .. } => "Change colours".to_owned(),
            Self::SetWindow(_) => "Change window".to_owned(),
            Self::SetOpacity(_) => "Change opacity mode".to_owned(),
            Self::SetBackground(_) => "Change background".to_owned(),
            Self::SetCamera(_) => "Turn the view".to_owned(),
            Self::SetTitle(_) => "Change title".to_owned(),
            Self::SetCaption(_) => "Change caption".to_owned(),
            Self::SetCredit(_) => "Change credit".to_owned(),
            Self::SetLang(_) => "Change language".to_owned(),
            Self::SetSubject(_) => "Change subject".to_owned(),
            Self::AddLabel(_) => "Add label".to_owned(),
            Self::SetLabel { .. } => "Change label".to_owned(),
            Self::RemoveLabel { .. } => "Remove label".to_owned(),
            Self::AddStep { .. } => "Add step".to_owned(),
            Self::RemoveStep { .. } => "Remove step".to_owned(),
            Self::MoveStep { .. } => "Reorder steps".to_owned(),
        }
    }

    /// What is edited: successive edits of one target in one drag are one step.
    pub fn target(&self) -> String {
        match self {
            Self::Set { pointer, .. } | Self::Reset { pointer, .. } => pointer.clone(),
            Self::SetParam {
                template, param, ..
            } => format!("/templates/{template}/params/{param}"),
            Self::SetControlPoints { template, .. } => format!("/templates/{template}/points"),
            Self::SetPlacement { template, .. } => format!("/templates/{template}/placement"),
            Self::SetCurve { template, .. } => format!("/templates/{template}/curve"),
            Self::SetAmount { template, .. } => format!("/templates/{template}/amount"),
            Self::SetEnabled { template, .. } => format!("/templates/{template}/enabled"),
            Self::SetMode { template, .. } => format!("/templates/{template}/mode"),
            Self::SetAlign { template, .. } => format!("/templates/{template}/align"),
            Self::SetConstrain { template, .. } => format!("/templates/{template}/constrain"),
            Self::RenameTemplate { template, .. } => format!("/templates/{template}/name"),
            Self::MoveTemplate { from, to } => format!("/templates/{from}/to/{to}"),
            Self::AddTemplate { index, .. } => format!("/templates/{index}/add"),
            Self::RemoveTemplate { template } => format!("/templates/{template}/remove"),
            Self::DuplicateTemplate { template } => format!("/templates/{template}/duplicate"),
            Self::SetGroup { template, .. } => format!("/templates/{template}/group"),
            Self::InsertTemplates { index, .. } => format!("/templates/{index}/paste"),
            Self::All { name, edits } => {
                let first = edits.first().map(Self::target).unwrap_or_default();
                format!("{first} {name}")
            }
            Self::SetTransfer(_) | Self::SetPoints { .. } => "/look/transfer".to_owned(),
            Self::SetWindow(_) => "/look/window".to_owned(),
            Self::SetOpacity(_) => "/look/opacity".to_owned(),
            Self::SetBackground(_) => "/look/background".to_owned(),
            Self::SetCamera(_) => "/camera".to_owned(),
            Self::SetTitle(_) => "/title".to_owned(),
            Self::SetCaption(_) => "/caption".to_owned(),
            Self::SetCredit(_) => "/credit".to_owned(),
            Self::SetLang(_) => "/lang".to_owned(),
            Self::SetSubject(_) => "/subject".to_owned(),
            Self::AddLabel(_) => "/labels/-".to_owned(),
            Self::SetLabel { label, .. } => format!("/labels/{label}"),
            Self::RemoveLabel { label } => format!("/labels/{label}/remove"),
            Self::AddStep { index, .. } => format!("/steps/{index}/add"),
            Self::RemoveStep { step } => format!("/steps/{step}/remove"),
            Self::MoveStep { from, to } => format!("/steps/{from}/to/{to}"),
        }
    }
}

/// True if the document's subject is the same file as this one.
fn is_same_file(root: &Value, subject: &SubjectRef) -> bool {
    let text = |key| {
        pointer::get(root, &join("/subject", key))
            .and_then(Value::as_str)
            .unwrap_or_default()
    };
    match subject {
        SubjectRef::Builtin { .. } => false,
        SubjectRef::Address { src, .. } => text("src") == src,
        SubjectRef::Supplied { sha256, .. } => {
            text("src").is_empty() && text("sha256").eq_ignore_ascii_case(sha256)
        }
    }
}

fn set_reading(root: &mut Value, reading: &Reading) -> Result<(), DocumentError> {
    if reading.frame > 0 {
        pointer::set(root, "/subject/frame", json!(reading.frame))?;
    }
    let Some(raw) = &reading.raw else {
        return Ok(());
    };
    let mut value = json!({ "size": raw.size, "type": raw.element });
    let mut set = |key: &str, to: Value| value[key] = to;
    if raw.big_endian {
        set("order", json!("big"));
    }
    if raw.spacing_mm != [1.0; 3] {
        set("spacing", json!(raw.spacing_mm));
    }
    if raw.skip_bytes > 0 {
        set("skip", json!(raw.skip_bytes));
    }
    pointer::set(root, "/subject/raw", value)
}

fn label_value(label: &Label) -> Value {
    json!({ "at": vector(label.at), "text": label.text })
}

/// A list of the document, made if it is not there.
fn list<'a>(root: &'a mut Value, key: &'static str) -> Result<&'a mut Vec<Value>, DocumentError> {
    let not_found = || DocumentError::NotFound {
        pointer: join("", key),
    };
    let map = root.as_object_mut().ok_or_else(not_found)?;
    let value = map.entry(key).or_insert_with(|| json!([]));
    value.as_array_mut().ok_or_else(not_found)
}

fn insert(
    root: &mut Value,
    key: &'static str,
    limit: usize,
    index: usize,
    value: Value,
) -> Result<(), DocumentError> {
    let items = list(root, key)?;
    if items.len() >= limit {
        return Err(DocumentError::TooMany {
            pointer: join("", key),
            what: key,
            found: items.len() + 1,
            limit,
        });
    }
    let index = index.min(items.len());
    items.insert(index, value);
    rewrite(root, key, |i| Some(if i < index { i } else { i + 1 }));
    Ok(())
}

fn take(root: &mut Value, key: &'static str, index: usize) -> Result<Value, DocumentError> {
    let items = list(root, key)?;
    if index >= items.len() {
        return Err(DocumentError::NotFound {
            pointer: format!("/{key}/{index}"),
        });
    }
    let value = items.remove(index);
    rewrite(root, key, |i| match i.cmp(&index) {
        std::cmp::Ordering::Less => Some(i),
        std::cmp::Ordering::Equal => None,
        std::cmp::Ordering::Greater => Some(i - 1),
    });
    Ok(value)
}

fn reorder(
    root: &mut Value,
    key: &'static str,
    from: usize,
    to: usize,
) -> Result<(), DocumentError> {
    let items = list(root, key)?;
    if from >= items.len() || to >= items.len() {
        return Err(DocumentError::NotFound {
            pointer: format!("/{key}/{}", from.max(to)),
        });
    }
    let value = items.remove(from);
    items.insert(to, value);
    rewrite(root, key, |i| {
        Some(if i == from {
            to
        } else if from < i && i <= to {
            i - 1
        } else if to <= i && i < from {
            i + 1
        } else {
            i
        })
    });
    Ok(())
}

/// Lets the pointers of all steps follow entries of a list that went elsewhere; those to a removed entry go.
fn rewrite(root: &mut Value, key: &str, moved: impl Fn(usize) -> Option<usize>) {
    let Some(Value::Array(steps)) = root.get_mut("steps") else {
        return;
    };
    for step in steps {
        let Some(Value::Object(set)) = step.get_mut("set") else {
            continue;
        };
        let old = std::mem::replace(set, Map::new());
        for (target, value) in old {
            let keys = pointer::keys(&target).unwrap_or_default();
            let index = match keys.as_slice() {
                [first, second, ..] if first == key => pointer::index(second),
                _ => None,
            };
            match index.map(&moved) {
                None => {
                    set.insert(target, value);
                }
                Some(None) => {}
                Some(Some(index)) => {
                    let head = join(&join("", key), &index.to_string());
                    let target = keys.iter().skip(2).fold(head, |p, key| join(&p, key));
                    set.insert(target, value);
                }
            }
        }
    }
}
