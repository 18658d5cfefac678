//! Leaves out what stands at its default, so that documents that say the same are the same tree.

use super::catalogue::{ParamKind, ParamSpec, TemplateKind};
use serde_json::{Map, Value};

/// Strips defaults. The tree has been checked: what has another shape than expected is an unknown key and stays.
pub(super) fn strip(root: &mut Map<String, Value>) {
    for key in ["title", "caption", "credit", "lang"] {
        drop_if(root, key, is_text(""));
    }
    if let Some(Value::Object(subject)) = root.get_mut("subject") {
        drop_if(subject, "name", is_text(""));
        drop_if(subject, "frame", is_number(0.0));
        if let Some(Value::Object(raw)) = subject.get_mut("raw") {
            drop_if(raw, "size", is_numbers(&[1.0; 3]));
            drop_if(raw, "type", is_text("uint8"));
            drop_if(raw, "order", is_text("little"));
            drop_if(raw, "spacing", is_numbers(&[1.0; 3]));
            drop_if(raw, "skip", is_number(0.0));
        }
        if let Some(Value::Object(segments)) = subject.get_mut("segments") {
            drop_if(segments, "names", is_empty);
        }
        for_each(subject, "segments", |segments| {
            drop_if(segments, "names", is_empty);
        });
        drop_if(subject, "segments", is_empty);
        for_each(subject, "features", |feature| {
            drop_if(feature, "name", is_text(""));
            drop_if(feature, "clean", is_empty);
        });
        drop_if(subject, "features", is_empty);
        if subject.len() == 1 {
            drop_if(subject, "builtin", is_text(super::DEFAULT_SUBJECT));
        }
    }
    for_each(root, "templates", template);
    if let Some(Value::Object(look)) = root.get_mut("look") {
        drop_if(look, "transfer", is_text("auto"));
        drop_if(look, "window", is_text("auto"));
        drop_if(look, "opacity", is_text("constancy"));
        drop_if(look, "gradient", is_number(0.0));
        drop_if(look, "segments", is_empty);
        drop_if(look, "background", is_text("#ffffff"));
    }
    if let Some(Value::Object(camera)) = root.get_mut("camera") {
        drop_if(camera, "target", is_numbers(&[0.0; 3]));
        drop_if(camera, "rotate", is_numbers(&IDENTITY));
        drop_if(camera, "distance", is_number(2.5));
        drop_if(camera, "fov", is_number(30.0));
    }
    for_each(root, "labels", |label| {
        drop_if(label, "at", is_numbers(&[0.0; 3]));
        drop_if(label, "text", is_text(""));
    });
    for_each(root, "steps", |step| {
        drop_if(step, "title", is_text(""));
        drop_if(step, "caption", is_text(""));
        drop_if(step, "set", is_empty);
        drop_if(step, "seconds", is_number(1.0));
    });
    for key in ["subject", "templates", "look", "camera", "labels", "steps"] {
        drop_if(root, key, is_empty);
    }
}

const IDENTITY: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

fn template(template: &mut Map<String, Value>) {
    drop_if(template, "name", is_text(""));
    drop_if(template, "group", is_text(""));
    // A field without a place lies where its file says: there a default is no default.
    if template.get("kind").and_then(Value::as_str) != Some("field") {
        drop_if(template, "at", is_numbers(&[0.0; 3]));
        drop_if(template, "rotate", is_numbers(&IDENTITY));
        drop_if(template, "size", is_numbers(&[0.5; 3]));
    }
    drop_if(template, "amount", is_number(1.0));
    drop_if(template, "enabled", |value| value == &Value::Bool(true));
    drop_if(template, "mode", is_text("compose"));
    if let Some(Value::Object(align)) = template.get_mut("align") {
        drop_if(align, "depth", is_number(0.02));
        drop_if(align, "thickness", is_number(0.01));
        drop_if(align, "to", is_text("axis"));
    }
    drop_if(template, "align", is_empty);
    let kind = template
        .get("kind")
        .and_then(Value::as_str)
        .and_then(TemplateKind::from_name);
    if let (Some(kind), Some(Value::Object(params))) = (kind, template.get_mut("params")) {
        for spec in kind.spec().params {
            drop_if(params, spec.name, |value| is_param_default(spec, value));
        }
        if kind == TemplateKind::Rbf {
            drop_if(params, "points", is_empty);
            drop_if(params, "cut", is_empty);
        }
        if kind == TemplateKind::Field {
            drop_if(params, "name", is_text(""));
        }
    }
    drop_if(template, "params", is_empty);
    super::curve::strip(template);
}

fn is_param_default(spec: &ParamSpec, value: &Value) -> bool {
    match spec.kind {
        ParamKind::Number { default, .. } | ParamKind::Count { default, .. } => {
            is_number(default)(value)
        }
        ParamKind::Flag { default } => value == &Value::Bool(default),
        ParamKind::Choice { names } => value.as_str() == names.first().copied(),
        ParamKind::Vector { default, .. } => is_numbers(&default)(value),
        ParamKind::Rotation => is_numbers(&IDENTITY)(value),
    }
}

fn drop_if(map: &mut Map<String, Value>, key: &str, is_default: impl Fn(&Value) -> bool) {
    if map.get(key).is_some_and(is_default) {
        map.remove(key);
    }
}

fn for_each(map: &mut Map<String, Value>, key: &str, strip: impl Fn(&mut Map<String, Value>)) {
    if let Some(Value::Array(items)) = map.get_mut(key) {
        for item in items {
            if let Value::Object(item) = item {
                strip(item);
            }
        }
    }
}

fn is_text(default: &str) -> impl Fn(&Value) -> bool {
    move |value| value.as_str() == Some(default)
}

/// Defaults are 32-bit floats, and what is drawn is; what rounds to the default is the default.
fn is_number(default: f32) -> impl Fn(&Value) -> bool {
    move |value| value.is_number() && value.as_f64().map(|v| v as f32) == Some(default)
}

fn is_numbers(default: &[f32]) -> impl Fn(&Value) -> bool {
    move |value| match value {
        Value::Array(items) => {
            items.len() == default.len() && items.iter().zip(default).all(|(v, d)| is_number(*d)(v))
        }
        _ => false,
    }
}

fn is_empty(value: &Value) -> bool {
    match value {
        Value::Array(items) => items.is_empty(),
        Value::Object(map) => map.is_empty(),
        _ => false,
    }
}
