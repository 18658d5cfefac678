//! From the tree to what it says: every type checked, every default filled in, every value brought into its range.

use super::catalogue::{ParamKind, ParamSpec, ParamValue, TemplateKind};
use super::error::DocumentError;
use super::illustration::{
    Align, Background, Camera, Constrain, ConstrainBy, Illustration, Label, Look, OpacityMode,
    PlacedTemplate, SegmentLook, Step, TemplateMode, Transfer, TransferPoint, Window,
};
use super::json::{ROOT_KEYS, number_text, shortened};
use super::notice::{Notice, NoticeKind};
use super::object::{Object, wrong};
use super::pointer::join;
use super::{FORMAT, MAX_FIELDS, MAX_KEEP_SETS, MAX_LABELS, MAX_STEPS, MAX_TEMPLATES};
use crate::math::Placement;
use glam::{DQuat, DVec3, Quat, Vec3};
use serde_json::{Map, Value};

/// Places farther out than this are clamped: a subject is one unit long, and floats get coarse.
const MAX_COORDINATE: f64 = 1e4;
/// Range of a template's sides, subject units.
const SIZE_RANGE: [f64; 2] = [1e-4, 1e4];
/// Range of the camera's distance, subject units.
const DISTANCE_RANGE: [f64; 2] = [0.01, 1e3];
/// Range of the field of view, degrees.
const FOV_RANGE: [f64; 2] = [0.1, 170.0];
/// Longest passage to a step, seconds.
const MAX_SECONDS: f64 = 3600.0;
/// Quaternions this near to length 1 were meant so: the editor rounds to four decimals.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Checks a tree and reads what it says.
///
/// # Errors
/// The first thing that is wrong, by pointer.
pub(super) fn resolve(
    root: &Map<String, Value>,
) -> Result<(Illustration, Vec<Notice>), DocumentError> {
    let mut reader = Reader::default();
    version(root)?;
    let illustration = reader.illustration(root)?;
    Ok((illustration, reader.notices))
}

fn version(root: &Map<String, Value>) -> Result<(), DocumentError> {
    let found = root.get("fabrica").ok_or(DocumentError::NoVersion)?;
    let Value::Number(number) = found else {
        return Err(wrong("/fabrica", "the format's number", found));
    };
    match number.as_u64() {
        Some(version) if version == u64::from(FORMAT) => Ok(()),
        Some(version) if version > u64::from(FORMAT) => Err(DocumentError::TooNew {
            found: number_text(number),
        }),
        _ if number.as_f64().is_some_and(|n| n > f64::from(FORMAT)) => Err(DocumentError::TooNew {
            found: number_text(number),
        }),
        _ => Err(wrong("/fabrica", "the format's number", found)),
    }
}

fn written(values: &[f64]) -> String {
    let one = |value: f64| number_text(&super::json::number(value));
    match values {
        [value] => one(*value),
        values => {
            let texts: Vec<String> = values.iter().map(|v| one(*v)).collect();
            format!("[{}]", texts.join(", "))
        }
    }
}

/// `#rgb` or `#rrggbb` as bytes.
pub(super) fn color(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#')?;
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let byte = |from: usize, n: usize| u8::from_str_radix(digits.get(from..from + n)?, 16).ok();
    match digits.len() {
        3 => Some([byte(0, 1)? * 17, byte(1, 1)? * 17, byte(2, 1)? * 17]),
        6 => Some([byte(0, 2)?, byte(2, 2)?, byte(4, 2)?]),
        _ => None,
    }
}

#[derive(Default)]
pub(super) struct Reader {
    notices: Vec<Notice>,
}

impl Reader {
    pub(super) fn note(&mut self, pointer: impl Into<String>, kind: NoticeKind) {
        self.notices.push(Notice::new(pointer, kind));
    }

    pub(super) fn unknown_keys(&mut self, object: &Object<'_>, known: &[&str]) {
        for key in object.map.keys() {
            if self.notices.len() > super::tree::MAX_NOTICES {
                break;
            }
            if !known.contains(&key.as_str()) {
                self.note(
                    super::pointer::shortened(&object.at(key)),
                    NoticeKind::UnknownKey,
                );
            }
        }
    }

    pub(super) fn unknown_value(&mut self, pointer: String, found: &str, instead: &str) {
        self.note(
            pointer,
            NoticeKind::UnknownValue {
                found: shortened(found, 40),
                instead: instead.to_owned(),
            },
        );
    }

    pub(super) fn clamp<const N: usize>(
        &mut self,
        pointer: impl FnOnce() -> String,
        values: [f64; N],
        range: [f64; 2],
    ) -> [f64; N] {
        let drawn = values.map(|v| v.clamp(range[0], range[1]));
        self.clamped(pointer, values, drawn)
    }

    /// Says so if what is drawn is not what is written.
    pub(super) fn clamped<const N: usize>(
        &mut self,
        pointer: impl FnOnce() -> String,
        values: [f64; N],
        drawn: [f64; N],
    ) -> [f64; N] {
        if drawn != values {
            // Ranges are 32-bit floats: what is only off by their rounding (π written in full) is in range.
            let rounding =
                |(v, d): (&f64, &f64)| (v - d).abs() <= d.abs() * f64::from(f32::EPSILON);
            if !values.iter().zip(&drawn).all(rounding) {
                self.note(
                    pointer(),
                    NoticeKind::Clamped {
                        found: written(&values),
                        drawn: written(&drawn.map(|d| super::plain_f64(d as f32))),
                    },
                );
            }
        }
        drawn
    }

    fn scalar(
        &mut self,
        object: &Object<'_>,
        key: &str,
        default: f64,
        range: [f64; 2],
    ) -> Result<f32, DocumentError> {
        let value = object.number(key)?.unwrap_or(default);
        let [value] = self.clamp(|| object.at(key), [value], range);
        Ok(value as f32)
    }

    fn vector(
        &mut self,
        object: &Object<'_>,
        key: &str,
        default: Vec3,
        range: [f64; 2],
    ) -> Result<Vec3, DocumentError> {
        match object.numbers(key, "a list of three numbers")? {
            None => Ok(default),
            Some(values) => {
                let values = self.clamp(|| object.at(key), values, range);
                Ok(DVec3::from_array(values).as_vec3())
            }
        }
    }

    fn rotation(&mut self, object: &Object<'_>, key: &str) -> Result<Quat, DocumentError> {
        let Some(values) =
            object.numbers(key, "a quaternion, a list of four numbers x, y, z, w")?
        else {
            return Ok(Quat::IDENTITY);
        };
        // Scaled first, so that no square overflows or vanishes.
        let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if largest == 0.0 {
            return Err(DocumentError::ZeroRotation {
                pointer: object.at(key),
            });
        }
        let length = DQuat::from_array(values.map(|v| v / largest)).length() * largest;
        if (length - 1.0).abs() > UNIT_TOLERANCE {
            self.note(object.at(key), NoticeKind::Normalised);
        }
        let unit = values.map(|v| v / largest / (length / largest));
        Ok(DQuat::from_array(unit).as_quat())
    }

    fn illustration(&mut self, root: &Map<String, Value>) -> Result<Illustration, DocumentError> {
        let root = Object {
            pointer: String::new(),
            map: root,
        };
        self.unknown_keys(&root, ROOT_KEYS);
        let subject_object = root.child("subject")?;
        let subject = self.subject(&subject_object)?;
        let subject_revision = self.revision(&subject_object)?;
        let segments = self.segments(&subject_object)?;
        let features = self.features(&subject_object)?;
        let mut templates = Vec::new();
        let items = root.limited_list("templates", "templates", MAX_TEMPLATES)?;
        for (index, value) in items.iter().enumerate() {
            let object = Object::new(join("/templates", &index.to_string()), value)?;
            templates.extend(self.template(index, &object)?);
        }
        let is_field = |t: &&PlacedTemplate| t.kind == TemplateKind::Field && t.enabled;
        if let Some(over) = templates.iter().filter(is_field).nth(MAX_FIELDS) {
            let what = "more than four fields are";
            self.note(
                format!("/templates/{}", over.index),
                NoticeKind::NotDrawn { what },
            );
        }
        let sets = keep_sets(&templates).len();
        if sets > MAX_KEEP_SETS {
            return Err(DocumentError::TooMany {
                pointer: "/templates".to_owned(),
                what: "different sets of kept tissue",
                found: sets,
                limit: MAX_KEEP_SETS,
            });
        }
        let look = self.look(&root.child("look")?)?;
        let camera = self.camera(&root.child("camera")?)?;
        let mut labels = Vec::new();
        for (index, value) in root
            .limited_list("labels", "labels", MAX_LABELS)?
            .iter()
            .enumerate()
        {
            let object = Object::new(join("/labels", &index.to_string()), value)?;
            self.unknown_keys(&object, &["at", "text"]);
            labels.push(Label {
                at: self.vector(&object, "at", Vec3::ZERO, [-MAX_COORDINATE, MAX_COORDINATE])?,
                text: object.string("text")?,
            });
        }
        let mut steps = Vec::new();
        for (index, value) in root
            .limited_list("steps", "steps", MAX_STEPS)?
            .iter()
            .enumerate()
        {
            let object = Object::new(join("/steps", &index.to_string()), value)?;
            steps.push(self.step(&object)?);
        }
        Ok(Illustration {
            title: root.string("title")?,
            caption: root.string("caption")?,
            credit: root.string("credit")?,
            lang: root.string("lang")?,
            subject,
            subject_revision,
            segments,
            features,
            templates,
            look,
            camera,
            labels,
            steps,
        })
    }

    fn template(
        &mut self,
        index: usize,
        object: &Object<'_>,
    ) -> Result<Option<PlacedTemplate>, DocumentError> {
        self.unknown_keys(
            object,
            &[
                "kind",
                "name",
                "group",
                "at",
                "rotate",
                "size",
                "params",
                "amount",
                "enabled",
                "mode",
                "align",
                "constrain",
                "curve",
            ],
        );
        let placement = Placement {
            at: self.vector(
                object,
                "at",
                Placement::DOCUMENT_DEFAULT.at,
                [-MAX_COORDINATE, MAX_COORDINATE],
            )?,
            rotate: self.rotation(object, "rotate")?,
            size: self.vector(object, "size", Placement::DOCUMENT_DEFAULT.size, SIZE_RANGE)?,
        };
        let name = object.string("name")?;
        // Which templates belong together in the list; nothing that is drawn depends on it.
        object.string("group")?;
        let amount = self.scalar(object, "amount", 1.0, [0.0, 1.0])?;
        let enabled = object.flag("enabled")?.unwrap_or(true);
        let mode = match object.text("mode")? {
            None | Some("compose") => TemplateMode::Compose,
            Some("add") => TemplateMode::Add,
            Some(other) => {
                self.unknown_value(object.at("mode"), other, "compose");
                TemplateMode::Compose
            }
        };
        let align = self.align(&object.child("align")?)?;
        let mut constrain = None;
        if object.map.contains_key("constrain") {
            let object = object.child("constrain")?;
            self.unknown_keys(&object, &["by", "keep"]);
            let keep = keep(&object)?;
            let by = match object.text("by")? {
                None | Some("displacement") => Some(ConstrainBy::Displacement),
                Some("coordinate") => Some(ConstrainBy::Coordinate),
                Some("rigid") => Some(ConstrainBy::Rigid),
                Some(other) => {
                    self.unknown_value(object.at("by"), other, "nothing");
                    None
                }
            };
            constrain = by.map(|by| Constrain { by, keep });
        }
        let params = object.child("params")?;
        let kind_name = object.text("kind")?.unwrap_or_default();
        let Some(kind) = TemplateKind::from_name(kind_name) else {
            let kind = NoticeKind::UnknownTemplate {
                kind: shortened(kind_name, 40),
            };
            let at = match object.map.get("kind") {
                Some(_) => object.at("kind"),
                None => object.pointer.clone(),
            };
            self.note(at, kind);
            return Ok(None);
        };
        let spec = kind.spec();
        let data = self.data(kind, object, &params)?;
        let others: &[&str] = match kind {
            TemplateKind::Rbf => &["points", "cut"],
            TemplateKind::Field => &["src", "sha256", "name"],
            _ => &[],
        };
        for key in params.map.keys() {
            let is_known =
                spec.params.iter().any(|p| p.name == key) || others.contains(&key.as_str());
            if !is_known {
                let at = super::pointer::shortened(&params.at(key));
                self.note(at, NoticeKind::UnknownParam { kind: spec.name });
            }
        }
        let values: Result<Vec<_>, _> = spec
            .params
            .iter()
            .map(|param| self.param(&params, param))
            .collect();
        let values = values?;
        // A layer is all that is moved of the box.
        let layer = spec.params.iter().position(|param| param.name == "depth");
        let layer = match layer.and_then(|i| values.get(i)) {
            Some(ParamValue::Number(depth)) => *depth,
            _ => 1.0,
        };
        let curve = self.curve(object, placement.size, layer)?;
        Ok(Some(PlacedTemplate {
            index,
            kind,
            name,
            placement,
            curve,
            params: values,
            amount,
            enabled,
            mode,
            align,
            constrain,
            data,
        }))
    }

    fn param(
        &mut self,
        params: &Object<'_>,
        spec: &ParamSpec,
    ) -> Result<ParamValue, DocumentError> {
        let key = spec.name;
        if !params.map.contains_key(key) {
            return Ok(spec.kind.default_value());
        }
        Ok(match spec.kind {
            ParamKind::Number { default, min, max } => ParamValue::Number(self.scalar(
                params,
                key,
                f64::from(default),
                [f64::from(min), f64::from(max)],
            )?),
            ParamKind::Count { default, min, max } => {
                let value = params.number(key)?.unwrap_or(f64::from(default));
                let drawn = (value + 0.5).floor().clamp(f64::from(min), f64::from(max));
                let [drawn] = self.clamped(|| params.at(key), [value], [drawn]);
                ParamValue::Number(drawn as f32)
            }
            ParamKind::Flag { default } => ParamValue::Flag(params.flag(key)?.unwrap_or(default)),
            ParamKind::Choice { names } => {
                let name = params.text(key)?.unwrap_or_default();
                match names.iter().position(|known| *known == name) {
                    Some(i) => ParamValue::Choice(i as u32),
                    None => {
                        let instead = names.first().copied().unwrap_or_default();
                        self.unknown_value(params.at(key), name, instead);
                        ParamValue::Choice(0)
                    }
                }
            }
            ParamKind::Vector {
                default,
                min,
                max,
                max_length,
            } => {
                let values = params
                    .numbers(key, "a list of three numbers")?
                    .unwrap_or(default.map(f64::from));
                let drawn = if max_length.is_finite() {
                    // The length rules: components in range are scaled with the rest, so that the direction stays.
                    let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                    let length = if largest == 0.0 {
                        0.0
                    } else {
                        (DVec3::from_array(values) / largest).length() * largest
                    };
                    let limit = f64::from(max_length);
                    if length > limit {
                        values.map(|v| v / length * limit)
                    } else {
                        values
                    }
                } else {
                    values.map(|v| v.clamp(f64::from(min), f64::from(max)))
                };
                let drawn = self.clamped(|| params.at(key), values, drawn);
                ParamValue::Vector(DVec3::from_array(drawn).as_vec3())
            }
            ParamKind::Rotation => ParamValue::Rotation(self.rotation(params, key)?),
        })
    }

    fn align(&mut self, object: &Object<'_>) -> Result<Align, DocumentError> {
        self.unknown_keys(object, &["to", "keep", "depth", "thickness"]);
        let depth = self.scalar(object, "depth", 0.02, [0.0, 10.0])?;
        let thickness = self.scalar(object, "thickness", 0.01, [0.0, 10.0])?;
        let keep = keep(object)?;
        Ok(match object.text("to")? {
            None | Some("axis") => Align::Axis,
            Some("surface") => Align::Surface { depth, thickness },
            Some("segment") => Align::Segment { keep, thickness },
            Some(other) => {
                self.unknown_value(object.at("to"), other, "axis");
                Align::Axis
            }
        })
    }

    fn look(&mut self, object: &Object<'_>) -> Result<Look, DocumentError> {
        self.unknown_keys(
            object,
            &[
                "transfer",
                "window",
                "tint",
                "opacity",
                "gradient",
                "segments",
                "background",
            ],
        );
        let transfer = match object.map.get("transfer") {
            None => Transfer::Auto,
            Some(Value::String(name)) if name == "auto" => Transfer::Auto,
            Some(Value::String(name)) if super::preset(name).is_some() => {
                Transfer::Preset(name.clone())
            }
            Some(Value::String(name)) => {
                self.unknown_value(object.at("transfer"), name, "auto");
                Transfer::Auto
            }
            Some(Value::Array(items)) => self.points(&object.at("transfer"), items)?,
            Some(other) => {
                return Err(wrong(
                    &object.at("transfer"),
                    "a preset's name or a list of points",
                    other,
                ));
            }
        };
        let window = match object.map.get("window") {
            None => Window::Auto,
            Some(Value::String(name)) => {
                if name != "auto" {
                    self.unknown_value(object.at("window"), name, "auto");
                }
                Window::Auto
            }
            Some(_) => match object.numbers("window", "“auto” or a list of two numbers")? {
                None => Window::Auto,
                Some(values) => {
                    let limit = f64::from(f32::MAX) / 4.0;
                    let [a, b] = values.map(|v| v.clamp(-limit, limit) as f32);
                    let (low, mut high) = (a.min(b), a.max(b));
                    // A window has a width: at least what the floats at this place can tell apart.
                    let least = low.abs().max(high.abs()).max(1e-3) * 1e-5;
                    high = high.max(low + least);
                    let drawn = [f64::from(low), f64::from(high)];
                    let drawn = self.clamped(|| object.at("window"), values, drawn);
                    Window::Range(drawn.map(|v| v as f32))
                }
            },
        };
        let tint = match object.map.contains_key("tint") {
            true => Some(self.scalar(object, "tint", 0.0, [0.0, 1.0])?),
            false => None,
        };
        let opacity = match object.text("opacity")? {
            None | Some("constancy") => OpacityMode::Constancy,
            Some("mass") => OpacityMode::Mass,
            Some("none") => OpacityMode::None,
            Some(other) => {
                self.unknown_value(object.at("opacity"), other, "constancy");
                OpacityMode::Constancy
            }
        };
        let gradient = self.scalar(object, "gradient", 0.0, [0.0, 1.0])?;
        let segments = self.segment_looks(&object.child("segments")?)?;
        let background = match object.text("background")? {
            None => Background::Color([255; 3]),
            Some("none") => Background::None,
            Some(text) => Background::Color(color(text).unwrap_or_else(|| {
                self.unknown_value(object.at("background"), text, "#ffffff");
                [255; 3]
            })),
        };
        Ok(Look {
            transfer,
            window,
            tint,
            opacity,
            gradient,
            segments,
            background,
        })
    }

    /// `{ "brain": 1, "skull": { "opacity": 0.3, "color": "#eadfc4" } }`: a number is an opacity.
    fn segment_looks(&mut self, object: &Object<'_>) -> Result<Vec<SegmentLook>, DocumentError> {
        let mut looks = Vec::new();
        for (name, value) in object.map {
            let (opacity, color_srgb) = match value {
                Value::Number(_) => (self.scalar(object, name, 1.0, [0.0, 1.0])?, None),
                _ => {
                    let look = Object::new(object.at(name), value)?;
                    self.unknown_keys(&look, &["opacity", "color"]);
                    let color_srgb = look.text("color")?.and_then(|text| {
                        let found = color(text);
                        if found.is_none() {
                            self.unknown_value(look.at("color"), text, "#ffffff");
                        }
                        found
                    });
                    let opacity = self.scalar(&look, "opacity", 1.0, [0.0, 1.0])?;
                    (opacity, color_srgb)
                }
            };
            looks.push(SegmentLook {
                name: name.clone(),
                opacity,
                color_srgb,
            });
        }
        Ok(looks)
    }

    fn points(&mut self, pointer: &str, items: &[Value]) -> Result<Transfer, DocumentError> {
        let mut points = Vec::with_capacity(items.len());
        for (i, value) in items.iter().enumerate() {
            let object = Object::new(join(pointer, &i.to_string()), value)?;
            self.unknown_keys(&object, &["value", "color", "opacity"]);
            let color_srgb = match object.text("color")? {
                None => [255; 3],
                Some(text) => color(text).unwrap_or_else(|| {
                    self.unknown_value(object.at("color"), text, "#ffffff");
                    [255; 3]
                }),
            };
            let limit = f64::from(f32::MAX) / 4.0;
            points.push(TransferPoint {
                value: self.scalar(&object, "value", 0.0, [-limit, limit])?,
                color_srgb,
                opacity: self.scalar(&object, "opacity", 0.0, [0.0, 1.0])?,
            });
        }
        points.sort_by(|a, b| a.value.total_cmp(&b.value));
        Ok(Transfer::Points(points))
    }

    fn camera(&mut self, object: &Object<'_>) -> Result<Camera, DocumentError> {
        self.unknown_keys(object, &["target", "rotate", "distance", "fov"]);
        let default = Camera::DOCUMENT_DEFAULT;
        Ok(Camera {
            target: self.vector(
                object,
                "target",
                default.target,
                [-MAX_COORDINATE, MAX_COORDINATE],
            )?,
            rotate: self.rotation(object, "rotate")?,
            distance: self.scalar(
                object,
                "distance",
                f64::from(default.distance),
                DISTANCE_RANGE,
            )?,
            fov_deg: self.scalar(object, "fov", f64::from(default.fov_deg), FOV_RANGE)?,
        })
    }

    fn step(&mut self, object: &Object<'_>) -> Result<Step, DocumentError> {
        self.unknown_keys(object, &["title", "caption", "set", "seconds"]);
        // Only its shape: what it sets is checked where the steps are walked.
        object.child("set")?;
        Ok(Step {
            title: object.string("title")?,
            caption: object.string("caption")?,
            seconds: self.scalar(object, "seconds", 1.0, [0.0, MAX_SECONDS])?,
        })
    }
}

/// The different sets of names that templates keep or give way to, each sorted, in the order in which they first occur; empty ones
/// keep nothing and do not count.
pub fn keep_sets(templates: &[PlacedTemplate]) -> Vec<Vec<String>> {
    let mut sets: Vec<Vec<String>> = Vec::new();
    for template in templates {
        let aligned = match &template.align {
            Align::Segment { keep, .. } => Some(keep),
            Align::Axis | Align::Surface { .. } => None,
        };
        let constrained = template.constrain.as_ref().map(|c| &c.keep);
        for keep in aligned.into_iter().chain(constrained) {
            let set = keep_set(keep);
            if !set.is_empty() && !sets.contains(&set) {
                sets.push(set);
            }
        }
    }
    sets
}

/// The names of one set, sorted, each once.
pub fn keep_set(keep: &[String]) -> Vec<String> {
    let mut set = keep.to_vec();
    set.sort();
    set.dedup();
    set
}

/// Names or numbers of segments, numbers as text.
fn keep(object: &Object<'_>) -> Result<Vec<String>, DocumentError> {
    let pointer = object.at("keep");
    object
        .list("keep")?
        .iter()
        .enumerate()
        .map(|(i, value)| match value {
            Value::String(name) => Ok(name.clone()),
            Value::Number(number) if number.as_u64().is_some() => Ok(number.to_string()),
            other => Err(wrong(
                &join(&pointer, &i.to_string()),
                "a segment's name or number",
                other,
            )),
        })
        .collect()
}
