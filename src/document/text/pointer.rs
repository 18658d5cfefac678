//! JSON pointers (RFC 6901) into a document.

use super::error::DocumentError;
use serde_json::Value;

/// Appends a key to a pointer.
pub fn join(pointer: &str, key: &str) -> String {
    format!("{pointer}/{}", key.replace('~', "~0").replace('/', "~1"))
}

/// The first 120 characters of a pointer, for a message.
pub(crate) fn shortened(pointer: &str) -> String {
    super::shortened::shortened(pointer, 120)
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
pub(crate) fn index(key: &str) -> Option<usize> {
    let plain = key == "0" || (!key.starts_with('0') && !key.is_empty());
    (plain && key.len() <= 6 && key.bytes().all(|b| b.is_ascii_digit()))
        .then(|| key.parse().ok())
        .flatten()
}

/// The value that a pointer points at; `None` where a key stands at its default.
pub(crate) fn get<'a>(root: &'a Value, pointer: &str) -> Option<&'a Value> {
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

/// Removes the value that a pointer points at and returns it, if it was there.
///
/// # Errors
/// [`DocumentError::BadPointer`].
pub(crate) fn remove(root: &mut Value, pointer: &str) -> Result<Option<Value>, DocumentError> {
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
}
