//! Setting a value by JSON pointer, with one addition to RFC 6901: keys on the way that stand at their default are
//! made.

use crate::document::model::TemplateKind;
use crate::document::schema;
use crate::document::text::DocumentError;
use crate::document::text::pointer::{index, keys, shortened};
use serde_json::Value;

/// Sets the value that a pointer points at. Objects, lists and vectors on the way that stand at their default are made;
/// in a list the index after the last, or `-`, appends. A style that is the name of its preset becomes an object.
///
/// # Errors
/// [`DocumentError::BadPointer`], [`DocumentError::NotFound`].
pub(crate) fn set(root: &mut Value, pointer: &str, new: Value) -> Result<(), DocumentError> {
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
                    let default =
                        schema::default_at(&keys[..=depth], kind).ok_or_else(not_found)?;
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
        if !is_last && value.is_string() && keys[..=depth] == ["look", "style"] {
            *value = Value::Object(schema::style_object(value));
        }
    }
    *value = new;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::text::json;
    use serde_json::json;

    #[test]
    fn setting_makes_what_stands_at_its_default() {
        let mut root = json!({"templates": [{"kind": "pull"}]});
        set(&mut root, "/camera/target/1", json!(0.2)).expect("set");
        set(&mut root, "/templates/0/params/offset/2", json!(0.1)).expect("set");
        set(&mut root, "/templates/0/size/0", json!(1)).expect("set");
        set(&mut root, "/labels/-", json!({"text": "a"})).expect("set");
        set(&mut root, "/look/background", json!("none")).expect("set");
        json::normalise(&mut root, 0).expect("shallow");
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
