//! JSON pointers (RFC 6901) into a document, with one addition: a pointer to a key that stands at its default makes it.

use super::catalogue::{ParamKind, TemplateKind};
use super::error::DocumentError;
use super::json;
use serde_json::{Value, json};

/// Appends a key to a pointer.
pub fn join(pointer: &str, key: &str) -> String {
    format!("{pointer}/{}", key.replace('~', "~0").replace('/', "~1"))
}

/// A pointer to read in a message: at most 120 characters.
pub(super) fn shortened(pointer: &str) -> String {
    json::shortened(pointer, 120)
}

/// The keys of a pointer.
///
/// # Errors
/// [`DocumentError::BadPointer`].
pub fn keys(pointer: &str) -> Result<Vec<String>, DocumentError> {
    let bad = || DocumentError::BadPointer {
        pointer: shortened(pointer),
    };
    if pointer.is_empty() {
        return Ok(Vec::new());
    }
    let rest = pointer.strip_prefix('/').ok_or_else(bad)?;
    rest.split('/')
        .map(|key| {
            let mut plain = String::with_capacity(key.len());
            let mut chars = key.chars();
            while let Some(c) = chars.next() {
                plain.push(match (c, c == '~') {
                    (_, true) => match chars.next() {
                        Some('0') => '~',
                        Some('1') => '/',
                        _ => return Err(bad()),
                    },
                    (c, false) => c,
                });
            }
            Ok(plain)
        })
        .collect()
}

/// Index into an array: decimal digits without leading zeros.
pub(super) fn index(key: &str) -> Option<usize> {
    let plain = key == "0" || (!key.starts_with('0') && !key.is_empty());
    (plain && key.len() <= 6 && key.bytes().all(|b| b.is_ascii_digit()))
        .then(|| key.parse().ok())
        .flatten()
}

/// Reads what a pointer points at; nothing is there where a key stands at its default.
pub(super) fn get<'a>(root: &'a Value, pointer: &str) -> Option<&'a Value> {
    let mut value = root;
    for key in keys(pointer).ok()? {
        value = match value {
            Value::Object(map) => map.get(&key)?,
            Value::Array(items) => items.get(index(&key)?)?,
            _ => return None,
        };
    }
    Some(value)
}

/// Sets what a pointer points at. Objects and lists on the way that stand at their default are made; in a list the
/// index after the last, or `-`, appends.
///
/// # Errors
/// [`DocumentError::BadPointer`], [`DocumentError::NotFound`].
pub(super) fn set(root: &mut Value, pointer: &str, new: Value) -> Result<(), DocumentError> {
    let keys = keys(pointer)?;
    let not_found = || DocumentError::NotFound {
        pointer: shortened(pointer),
    };
    let mut value = root;
    // Which parameters have a default depends on the kind of the template on the way.
    let mut kind = None;
    for depth in 0..keys.len() {
        if depth == 2 && keys[0] == "templates" {
            kind = value
                .get("kind")
                .and_then(Value::as_str)
                .and_then(TemplateKind::from_name);
        }
        let key = keys[depth].as_str();
        let is_last = depth + 1 == keys.len();
        value = match value {
            Value::Object(map) => {
                if !is_last && !map.contains_key(key) {
                    let default = default_at(&keys[..=depth], kind).ok_or_else(not_found)?;
                    map.insert(key.to_owned(), default);
                }
                map.entry(key.to_owned()).or_insert(Value::Null)
            }
            Value::Array(items) => {
                let i = if key == "-" {
                    items.len()
                } else {
                    index(key).ok_or_else(not_found)?
                };
                if i == items.len() && is_last {
                    items.push(Value::Null);
                }
                items.get_mut(i).ok_or_else(not_found)?
            }
            _ => return Err(not_found()),
        };
    }
    *value = new;
    Ok(())
}

/// What stands at a path when the document says nothing: lists, objects and vectors of known keys.
fn default_at(keys: &[String], kind: Option<TemplateKind>) -> Option<Value> {
    let path: Vec<&str> = keys.iter().map(String::as_str).collect();
    Some(match path.as_slice() {
        ["templates" | "labels" | "steps"] | ["subject", "features"] => json!([]),
        ["subject" | "look" | "camera"]
        | ["subject", "segments"]
        | ["subject", "segments", "names"] => json!({}),
        ["camera", "target"] | ["templates" | "labels", _, "at"] => json!([0, 0, 0]),
        ["camera", "rotate"] | ["templates", _, "rotate"] => json!([0, 0, 0, 1]),
        ["templates", _, "size"] => json!([0.5, 0.5, 0.5]),
        ["templates", _, "params" | "align" | "constrain" | "curve"] | ["steps", _, "set"] => {
            json!({})
        }
        ["templates", _, "params", name] => {
            let spec = kind?.spec().params.iter().find(|p| p.name == *name)?;
            match spec.kind {
                ParamKind::Vector { default, .. } => json!(default.map(super::plain_f64)),
                ParamKind::Rotation => json!([0, 0, 0, 1]),
                _ => return None,
            }
        }
        _ => return None,
    })
}

/// Removes what a pointer points at and gives it back, if it was there.
///
/// # Errors
/// [`DocumentError::BadPointer`].
pub(super) fn remove(root: &mut Value, pointer: &str) -> Result<Option<Value>, DocumentError> {
    let mut keys = keys(pointer)?;
    let Some(last) = keys.pop() else {
        return Ok(None);
    };
    let mut value = root;
    for key in &keys {
        let next = match value {
            Value::Object(map) => map.get_mut(key),
            Value::Array(items) => index(key).and_then(|i| items.get_mut(i)),
            _ => None,
        };
        match next {
            Some(next) => value = next,
            None => return Ok(None),
        }
    }
    Ok(match value {
        Value::Object(map) => map.remove(&last),
        Value::Array(items) => index(&last)
            .filter(|i| *i < items.len())
            .map(|i| items.remove(i)),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_escaped() {
        assert_eq!(keys("/a~1b/~0c").expect("a pointer"), ["a/b", "~c"]);
        assert_eq!(join("", "a/b~"), "/a~1b~0");
        for bad in ["a", "/~", "/~2", "/a~"] {
            assert!(keys(bad).is_err(), "{bad} is no pointer");
        }
    }

    #[test]
    fn setting_makes_what_stands_at_its_default() {
        let mut root = json!({"templates": [{"kind": "pull"}]});
        set(&mut root, "/camera/target/1", json!(0.2)).expect("set");
        set(&mut root, "/templates/0/params/offset/2", json!(0.1)).expect("set");
        set(&mut root, "/templates/0/size/0", json!(1)).expect("set");
        set(&mut root, "/labels/-", json!({"text": "a"})).expect("set");
        set(&mut root, "/look/background", json!("none")).expect("set");
        super::json::normalise(&mut root, 0).expect("shallow");
        assert_eq!(
            root,
            json!({
                "templates": [{"kind": "pull", "params": {"offset": [0, 0, 0.1]}, "size": [1, 0.5, 0.5]}],
                "camera": {"target": [0, 0.2, 0]}, "labels": [{"text": "a"}], "look": {"background": "none"},
            })
        );
        for nowhere in [
            "/templates/1/at",
            "/templates/x",
            "/templates/00/at",
            "/unknown/key",
            "/templates/0/params/none/0",
            "/templates/0/kind/a",
        ] {
            assert!(
                set(&mut root, nowhere, json!(0)).is_err(),
                "{nowhere} is not there"
            );
        }
    }
}
