//! One object of a document's tree, read key by key with every type checked and every fault named by its pointer.

use serde_json::{Map, Value};

use super::error::DocumentError;
use super::json::{number_text, shortened};
use super::pointer::join;

pub(super) fn wrong(pointer: &str, expected: &'static str, found: &Value) -> DocumentError {
    let found = match found {
        Value::Null => "null".to_owned(),
        Value::Bool(flag) => flag.to_string(),
        Value::Number(number) => number_text(number),
        Value::String(text) => format!("“{}”", shortened(text, 40)),
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::Object(_) => "an object".to_owned(),
    };
    DocumentError::WrongType {
        pointer: super::pointer::shortened(pointer),
        expected,
        found,
    }
}

/// One object of the tree and where it is.
pub(super) struct Object<'a> {
    pub(super) pointer: String,
    pub(super) map: &'a Map<String, Value>,
}

/// Stands for an object that is not there: everything at its default.
static NOTHING: std::sync::LazyLock<Map<String, Value>> = std::sync::LazyLock::new(Map::new);

impl<'a> Object<'a> {
    pub(super) fn new(pointer: String, value: &'a Value) -> Result<Self, DocumentError> {
        match value {
            Value::Object(map) => Ok(Self { pointer, map }),
            other => Err(wrong(&pointer, "an object", other)),
        }
    }

    pub(super) fn child(&self, key: &str) -> Result<Self, DocumentError> {
        let pointer = self.at(key);
        match self.map.get(key) {
            Some(value) => Object::new(pointer, value),
            None => Ok(Self {
                pointer,
                map: &NOTHING,
            }),
        }
    }

    pub(super) fn at(&self, key: &str) -> String {
        join(&self.pointer, key)
    }

    pub(super) fn text(&self, key: &str) -> Result<Option<&'a str>, DocumentError> {
        match self.map.get(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(wrong(&self.at(key), "a text", other)),
        }
    }

    pub(super) fn string(&self, key: &str) -> Result<String, DocumentError> {
        Ok(self.text(key)?.unwrap_or_default().to_owned())
    }

    pub(super) fn flag(&self, key: &str) -> Result<Option<bool>, DocumentError> {
        match self.map.get(key) {
            None => Ok(None),
            Some(Value::Bool(flag)) => Ok(Some(*flag)),
            Some(other) => Err(wrong(&self.at(key), "true or false", other)),
        }
    }

    pub(super) fn number(&self, key: &str) -> Result<Option<f64>, DocumentError> {
        self.map
            .get(key)
            .map(|value| number(&self.at(key), value))
            .transpose()
    }

    pub(super) fn list(&self, key: &str) -> Result<&'a [Value], DocumentError> {
        match self.map.get(key) {
            None => Ok(&[]),
            Some(Value::Array(items)) => Ok(items),
            Some(other) => Err(wrong(&self.at(key), "a list", other)),
        }
    }

    pub(super) fn limited_list(
        &self,
        key: &str,
        what: &'static str,
        limit: usize,
    ) -> Result<&'a [Value], DocumentError> {
        let items = self.list(key)?;
        if items.len() > limit {
            return Err(DocumentError::TooMany {
                pointer: self.at(key),
                what,
                found: items.len(),
                limit,
            });
        }
        Ok(items)
    }

    pub(super) fn numbers<const N: usize>(
        &self,
        key: &str,
        expected: &'static str,
    ) -> Result<Option<[f64; N]>, DocumentError> {
        let Some(value) = self.map.get(key) else {
            return Ok(None);
        };
        let pointer = self.at(key);
        match value {
            Value::Array(items) if items.len() == N => {
                let mut out = [0.0; N];
                for (i, (slot, item)) in out.iter_mut().zip(items).enumerate() {
                    *slot = number(&join(&pointer, &i.to_string()), item)?;
                }
                Ok(Some(out))
            }
            other => Err(wrong(&pointer, expected, other)),
        }
    }
}

pub(super) fn number(pointer: &str, value: &Value) -> Result<f64, DocumentError> {
    match value {
        Value::Number(number) => match number.as_f64() {
            Some(float) if float.is_finite() => Ok(float),
            _ => Err(DocumentError::NotFinite {
                pointer: pointer.to_owned(),
                found: number.to_string(),
            }),
        },
        other => Err(wrong(pointer, "a number", other)),
    }
}
