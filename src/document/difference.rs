//! What has to be set in one state of a document to make another of it: JSON pointers and values, as few and as small
//! as the schema allows.

use super::model::TemplateKind;
use super::schema::{
    Key, Kind, LeftOut, ROOT, find, is_fixed, is_of_file, param_default, params_of, style_object,
};
use super::text::pointer::{self, join};
use serde_json::{Map, Value, json};

/// The pointers and values that turn `old` into `new`, both in canonical form and without steps. A key that `new`
/// leaves out is set to its default; where it has none, the whole object that holds it is set.
pub(super) fn difference(old: &Value, new: &Value) -> Vec<(String, Value)> {
    let mut out = Vec::new();
    let nothing = Map::new();
    let [old, new] = [old, new].map(|tree| tree.as_object().unwrap_or(&nothing));
    for name in names(old, new) {
        let key = find(ROOT, name);
        // A root key that has no default stays as it is.
        let _ = entry("", name, [old, new], key, None, &mut out);
    }
    // What of a figure would have to be set as a whole, which no step may do, stays as it is.
    out.retain(|(target, _)| !pointer::keys(target).is_ok_and(|keys| is_fixed(&keys)));
    out
}

/// A key went away that has no default: whoever holds it must be set as a whole.
struct Gone;

type Changes = Vec<(String, Value)>;

/// The keys of either object, in their order.
fn names<'a>(old: &'a Map<String, Value>, new: &'a Map<String, Value>) -> Vec<&'a String> {
    let added = new.keys().filter(|name| !old.contains_key(*name));
    let mut names: Vec<&String> = old.keys().chain(added).collect();
    names.sort();
    names
}

/// One key of two objects. `kind` is that of the template that they belong to.
fn entry(
    at: &str,
    name: &str,
    [old, new]: [&Map<String, Value>; 2],
    key: Option<&'static Key>,
    kind: Option<TemplateKind>,
    out: &mut Changes,
) -> Result<(), Gone> {
    let (before, after) = (old.get(name), new.get(name));
    // A step sets none of the fixed keys.
    if before == after || key.is_some_and(|key| key.is_fixed) {
        return Ok(());
    }
    let pointer = join(at, name);
    let Some(key) = key else {
        out.push((pointer, after.ok_or(Gone)?.clone()));
        return Ok(());
    };
    let is_field = |kind: TemplateKind| kind.facts().holds == crate::displace::Holds::File;
    let stays_away = match key.left_out {
        LeftOut::Optional => true,
        LeftOut::ExceptField => kind.is_some_and(is_field),
        LeftOut::ExceptFile => is_of_file(new),
        LeftOut::OfSource => !new.contains_key("from"),
        LeftOut::AtDefault | LeftOut::Turn | LeftOut::Alone | LeftOut::Never => false,
    };
    if stays_away && after.is_none() {
        return Err(Gone);
    }
    let written = match after {
        Some(value) => value.clone(),
        None => key.kind.default_value().ok_or(Gone)?,
    };
    let length = out.len();
    let part = match (before, key.kind) {
        (Some(before), _) => inside(&pointer, [before, &written], key.kind, kind, out),
        // A pointer to something inside makes the rest of it.
        (None, Kind::Object(_) | Kind::Params) if key.is_made && !stays_away => {
            inside(&pointer, [&json!({}), &written], key.kind, kind, out)
        }
        (None, _) => Err(Gone),
    };
    if part.is_err() {
        out.truncate(length);
        out.push((pointer, written));
    }
    Ok(())
}

/// What lies inside of two values of one kind. An error if the second must be set as a whole.
fn inside(
    at: &str,
    [old, new]: [&Value; 2],
    holds: Kind,
    kind: Option<TemplateKind>,
    out: &mut Changes,
) -> Result<(), Gone> {
    match (old, new, holds) {
        (Value::Object(old), Value::Object(new), Kind::Object(of)) => {
            object(at, [old, new], of, kind, out)
        }
        (old, Value::Object(new), Kind::Style(of)) => {
            object(at, [&style_object(old), new], of, kind, out)
        }
        (Value::Object(old), Value::Object(new), Kind::Params) => {
            let specs = kind.map_or(&[][..], |kind| kind.spec().params);
            for name in names(old, new) {
                let spec = specs.iter().find(|spec| spec.name == *name);
                let Some(spec) = spec else {
                    let key = find(params_of(kind), name);
                    entry(at, name, [old, new], key, kind, out)?;
                    continue;
                };
                let written = match new.get(name) {
                    Some(value) => value.clone(),
                    None => param_default(&spec.kind).ok_or(Gone)?,
                };
                if old.get(name) != new.get(name) {
                    out.push((join(at, name), written));
                }
            }
            Ok(())
        }
        (Value::Object(old), Value::Object(new), Kind::Looks(_)) => {
            if old.keys().any(|name| !new.contains_key(name)) {
                return Err(Gone);
            }
            for (name, value) in new {
                if old.get(name) != Some(value) {
                    out.push((join(at, name), value.clone()));
                }
            }
            Ok(())
        }
        (Value::Array(old), Value::Array(new), Kind::List { of, .. }) => {
            if old.len() != new.len() {
                return Err(Gone);
            }
            for (i, pair) in old.iter().zip(new).enumerate() {
                let at = join(at, &i.to_string());
                let length = out.len();
                if let (Value::Object(old), Value::Object(new)) = pair
                    && let name = new.get("kind").and_then(Value::as_str)
                    && name == old.get("kind").and_then(Value::as_str)
                    && let kind = name.and_then(TemplateKind::from_name)
                    && object(&at, [old, new], of, kind, out).is_ok()
                {
                    continue;
                }
                out.truncate(length);
                if pair.0 != pair.1 {
                    out.push((at, pair.1.clone()));
                }
            }
            Ok(())
        }
        _ => Err(Gone),
    }
}

fn object(
    at: &str,
    [old, new]: [&Map<String, Value>; 2],
    keys: &'static [Key],
    kind: Option<TemplateKind>,
    out: &mut Changes,
) -> Result<(), Gone> {
    for name in names(old, new) {
        entry(at, name, [old, new], find(keys, name), kind, out)?;
    }
    Ok(())
}
