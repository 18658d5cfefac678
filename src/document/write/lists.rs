//! Entries of the document's lists: inserting, removing, moving. Pointers in steps and controls follow their entries.

use crate::document::text::DocumentError;
use crate::document::text::pointer;
use serde_json::{Value, json};

/// A list of the document; created if the key is missing. `key` is `templates`, or `figure/handles` for a list inside.
pub(crate) fn list<'a>(
    root: &'a mut Value,
    key: &'static str,
) -> Result<&'a mut Vec<Value>, DocumentError> {
    let not_found = || DocumentError::NotFound {
        pointer: format!("/{key}"),
    };
    let mut value = root;
    for (i, name) in key.split('/').enumerate() {
        let map = value.as_object_mut().ok_or_else(not_found)?;
        let is_last = i == key.matches('/').count();
        let missing = || if is_last { json!([]) } else { json!({}) };
        value = map.entry(name).or_insert_with(missing);
    }
    value.as_array_mut().ok_or_else(not_found)
}

/// Inserts a value before the entry of an index, or last; pointers in steps follow the entries that move up.
pub(crate) fn insert(
    root: &mut Value,
    key: &'static str,
    limit: usize,
    index: usize,
    value: Value,
) -> Result<(), DocumentError> {
    let items = list(root, key)?;
    if items.len() >= limit {
        return Err(DocumentError::TooMany {
            pointer: format!("/{key}"),
            what: key.rsplit('/').next().unwrap_or(key),
            found: items.len() + 1,
            limit,
        });
    }
    let index = index.min(items.len());
    items.insert(index, value);
    rewrite(root, key, |i| Some(if i < index { i } else { i + 1 }));
    Ok(())
}

/// Removes an entry; pointers in steps follow the entries that move down, and those to the entry itself go.
pub(crate) fn take(
    root: &mut Value,
    key: &'static str,
    index: usize,
) -> Result<Value, DocumentError> {
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

/// Moves an entry; pointers in steps follow.
pub(super) fn reorder(
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

/// Rewrites the pointers in all steps and controls after entries of a list have moved: `moved` gives the new index of
/// an old one, or `None` if the entry is gone, and its pointers with it.
fn rewrite(root: &mut Value, key: &str, moved: impl Fn(usize) -> Option<usize>) {
    let head = format!("/{key}/");
    let followed = |target: String| {
        let Some(rest) = target.strip_prefix(&head) else {
            return Some(target);
        };
        let (entry, inside) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
        let Some(index) = pointer::index(entry) else {
            return Some(target);
        };
        Some(format!("{head}{}{inside}", moved(index)?))
    };
    if let Some(Value::Array(steps)) = root.get_mut("steps") {
        for step in steps {
            let Some(Value::Object(set)) = step.get_mut("set") else {
                continue;
            };
            let old = std::mem::take(set);
            let pairs = old.into_iter();
            set.extend(pairs.filter_map(|(target, value)| Some((followed(target)?, value))));
        }
    }
    if let Some(Value::Array(controls)) = root.get_mut("controls") {
        controls.retain_mut(|control| {
            let Some(Value::String(target)) = control.get_mut("pointer") else {
                return true;
            };
            let new = followed(std::mem::take(target));
            let is_there = new.is_some();
            *target = new.unwrap_or_default();
            is_there
        });
    }
}
