//! The canonical form: keys at their default are left out, so that documents that mean the same are the same tree.

use super::limits::DEFAULT_SUBJECT;
use super::model::{ParamKind, ParamSpec, TemplateKind};
use super::schema::{Key, Kind, LeftOut, ROOT, is_of_file, params_of};
use crate::displace::Holds;
use serde_json::{Map, Value, json};

/// Leaves out the keys that stand at their default. The tree has been checked: a value of another shape than the schema
/// says belongs to an unknown kind of template or is not read, and stays.
pub(super) fn strip(root: &mut Map<String, Value>) {
    object(root, ROOT, None);
}

/// Strips an object with these keys. `kind` is that of the template that it belongs to.
fn object(map: &mut Map<String, Value>, keys: &'static [Key], kind: Option<TemplateKind>) {
    let own_kind = keys.iter().find(|key| matches!(key.kind, Kind::Template));
    let own_kind = own_kind.and_then(|key| map.get(key.name)?.as_str());
    let kind = kind.or(own_kind.and_then(TemplateKind::from_name));
    let is_of_file = is_of_file(map);
    let has_from = map.contains_key("from");
    let holds_no_point = !map.contains_key("at");
    for key in keys {
        let Some(value) = map.get_mut(key.name) else {
            continue;
        };
        inside(value, key.kind, kind);
        let is_left_out = match key.left_out {
            LeftOut::AtDefault | LeftOut::Turn => true,
            LeftOut::ExceptField => kind.is_none_or(|kind| kind.facts().holds != Holds::File),
            LeftOut::ExceptFile => !is_of_file,
            LeftOut::OfSource => has_from,
            LeftOut::Alone | LeftOut::Never | LeftOut::Optional => false,
        };
        let is_still = key.left_out == LeftOut::Turn && holds_no_point && is_exactly(value, 0.0);
        if is_left_out && is_default(value, key.kind) || is_still {
            map.remove(key.name);
        }
    }
    for key in keys.iter().filter(|key| key.left_out == LeftOut::Alone) {
        if map.len() == 1 && map.get(key.name).is_some_and(|v| is_default(v, key.kind)) {
            map.remove(key.name);
        }
    }
}

/// Strips the objects that a value holds.
fn inside(value: &mut Value, holds: Kind, kind: Option<TemplateKind>) {
    if let (Value::Object(map), Kind::Style(of)) = (&mut *value, holds) {
        object(map, of, kind);
        // A preset that nothing is changed of is its name.
        if map.len() == 1
            && let Some(preset) = map.remove("preset")
        {
            *value = preset;
        }
        return;
    }
    match (value, holds) {
        (Value::Object(map), Kind::Object(of) | Kind::OneOrMore { of, .. }) => {
            object(map, of, kind);
        }
        (
            Value::Array(items),
            Kind::List { of, .. } | Kind::FirstOf { of, .. } | Kind::OneOrMore { of, .. },
        ) => {
            for map in items.iter_mut().filter_map(Value::as_object_mut) {
                object(map, of, kind);
            }
        }
        (Value::Object(segments), Kind::Looks(of)) => {
            for map in segments.values_mut().filter_map(Value::as_object_mut) {
                object(map, of, kind);
            }
        }
        (Value::Object(params), Kind::Params) => {
            for spec in kind.map_or(&[][..], |kind| kind.spec().params) {
                if params
                    .get(spec.name)
                    .is_some_and(|value| is_param_default(value, spec))
                {
                    params.remove(spec.name);
                }
            }
            object(params, params_of(kind), kind);
        }
        _ => {}
    }
}

/// True if a value is what a missing key of this kind means.
fn is_default(value: &Value, kind: Kind) -> bool {
    match kind {
        Kind::Text | Kind::Limited { .. } => value.as_str() == Some(""),
        Kind::Builtin => value.as_str() == Some(DEFAULT_SUBJECT),
        Kind::Name(names) => value.as_str() == names.first().copied(),
        Kind::Background => value.as_str() == Some("#ffffff"),
        Kind::Transfer(_) | Kind::Window => value.as_str() == Some("auto"),
        Kind::Style(_) => value.as_str() == Some("none") || is_empty_object(value),
        Kind::Flag { default } => value == &Value::Bool(default),
        Kind::Whole => is_number(value, 0.0),
        Kind::Number { default, .. } | Kind::Count { default, .. } => {
            is_number(value, default as f32)
        }
        Kind::Exact { default, .. } => is_exactly(value, default),
        Kind::Turn => value.is_null(),
        Kind::Rigidity => is_exactly(value, 1.0) || value == &json!([1, 1]),
        Kind::Behind => value.as_str() == Some("none"),
        Kind::Point { .. } => value == &json!([0, 0]),
        Kind::Vector { default, .. } => is_numbers(value, &default.map(|v| v as f32)),
        Kind::Rotation => is_numbers(value, &IDENTITY),
        Kind::Pairs { .. }
        | Kind::Triples { .. }
        | Kind::Points { .. }
        | Kind::Vectors { .. }
        | Kind::Path { .. }
        | Kind::Wholes { .. }
        | Kind::Segments
        | Kind::List { .. }
        | Kind::FirstOf { .. } => is_empty_list(value),
        Kind::Labels | Kind::Looks(_) | Kind::Object(_) | Kind::Params | Kind::Set => {
            is_empty_object(value)
        }
        Kind::OneOrMore { .. } => is_empty_list(value) || is_empty_object(value),
        Kind::Format
        | Kind::Address
        | Kind::Hash
        | Kind::Template
        | Kind::Tool
        | Kind::Color
        | Kind::Shape
        | Kind::Range
        | Kind::Box => false,
    }
}

const IDENTITY: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

fn is_param_default(value: &Value, spec: &ParamSpec) -> bool {
    match spec.kind {
        ParamKind::Number { default, .. } | ParamKind::Count { default, .. } => {
            is_number(value, default)
        }
        ParamKind::Flag { default } => value == &Value::Bool(default),
        ParamKind::Choice { names } => value.as_str() == names.first().copied(),
        ParamKind::Vector { default, .. } => is_numbers(value, &default),
        ParamKind::Rotation => is_numbers(value, &IDENTITY),
    }
}

/// What is drawn are 32-bit floats: a number that rounds to the default is the default.
fn is_number(value: &Value, default: f32) -> bool {
    value.is_number() && value.as_f64().map(|v| v as f32) == Some(default)
}

/// Where 64-bit floats count.
fn is_exactly(value: &Value, default: f64) -> bool {
    value.is_number() && value.as_f64() == Some(default)
}

fn is_numbers(value: &Value, default: &[f32]) -> bool {
    value.as_array().is_some_and(|items| {
        items.len() == default.len() && items.iter().zip(default).all(|(v, d)| is_number(v, *d))
    })
}

fn is_empty_list(value: &Value) -> bool {
    value.as_array().is_some_and(Vec::is_empty)
}

fn is_empty_object(value: &Value) -> bool {
    value.as_object().is_some_and(Map::is_empty)
}
