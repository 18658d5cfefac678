//! One object of a document's tree, read key by key: every type is checked and every fault is named by its pointer.

use crate::document::schema::{Key, Kind, find};
use crate::document::text::json::number_text;
use crate::document::text::pointer::{self, join};
use crate::document::text::{DocumentError, shortened};
use serde_json::{Map, Value};

/// The error for a value of the wrong type or shape.
pub(crate) fn wrong(pointer: &str, expected: &'static str, found: &Value) -> DocumentError {
    let found = match found {
        Value::Null => "null".to_owned(),
        Value::Bool(flag) => flag.to_string(),
        Value::Number(number) => number_text(number),
        Value::String(text) => format!("“{}”", shortened(text, 40)),
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::Object(_) => "an object".to_owned(),
    };
    DocumentError::WrongType {
        pointer: pointer::shortened(pointer),
        expected,
        found,
    }
}

/// One object of the tree.
pub(crate) struct Object<'a> {
    /// JSON pointer to it.
    pub(crate) pointer: String,
    /// The keys that the document gives, with their values.
    pub(crate) map: &'a Map<String, Value>,
    /// The keys that the object may have.
    pub(crate) keys: &'static [Key],
}

/// The map of an object that is missing: every key at its default.
static NOTHING: std::sync::LazyLock<Map<String, Value>> = std::sync::LazyLock::new(Map::new);

impl<'a> Object<'a> {
    /// Takes a value as an object with these keys.
    ///
    /// # Errors
    /// If the value is no object.
    pub(crate) fn new(
        pointer: String,
        value: &'a Value,
        keys: &'static [Key],
    ) -> Result<Self, DocumentError> {
        match value {
            Value::Object(map) => Ok(Self { pointer, map, keys }),
            other => Err(wrong(&pointer, "an object", other)),
        }
    }

    /// The kind of a key. A key that the schema lacks is a fault of the program: tests stop there.
    pub(crate) fn kind(&self, key: &str) -> Kind {
        let found = find(self.keys, key);
        debug_assert!(found.is_some(), "{key} is not in the schema");
        found.map_or(Kind::Text, |key| key.kind)
    }

    /// The object under a key. If the key is missing, every key of the object is at its default.
    pub(crate) fn child(&self, key: &str) -> Result<Self, DocumentError> {
        let (pointer, keys) = (self.at(key), self.kind(key).keys());
        match self.map.get(key) {
            Some(value) => Object::new(pointer, value, keys),
            None => Ok(Self {
                pointer,
                map: &NOTHING,
                keys,
            }),
        }
    }

    /// The objects of a list under a key. Each is checked when its turn comes, so that the first fault is named.
    ///
    /// # Errors
    /// If there is no list, or a longer one than the schema allows.
    pub(crate) fn children(
        &self,
        key: &str,
    ) -> Result<impl Iterator<Item = Result<Self, DocumentError>> + use<'a>, DocumentError> {
        let (pointer, keys) = (self.at(key), self.kind(key).keys());
        let items = self.limited_list(key)?.iter().enumerate();
        Ok(items.map(move |(i, value)| Object::new(join(&pointer, &i.to_string()), value, keys)))
    }

    /// JSON pointer to a key of this object.
    pub(crate) fn at(&self, key: &str) -> String {
        join(&self.pointer, key)
    }

    /// The text under a key.
    pub(crate) fn text(&self, key: &str) -> Result<Option<&'a str>, DocumentError> {
        match self.map.get(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(wrong(&self.at(key), "a text", other)),
        }
    }

    /// The text under a key; empty if the key is missing.
    pub(crate) fn string(&self, key: &str) -> Result<String, DocumentError> {
        Ok(self.text(key)?.unwrap_or_default().to_owned())
    }

    /// The hash under `sha256`, in lower case.
    pub(crate) fn hash(&self) -> Result<Option<String>, DocumentError> {
        match self.text("sha256")? {
            None => Ok(None),
            Some(text) if text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit()) => {
                Ok(Some(text.to_ascii_lowercase()))
            }
            Some(_) => Err(wrong(
                &self.at("sha256"),
                "64 hexadecimal digits",
                &self.map["sha256"],
            )),
        }
    }

    /// The boolean under a key; the schema's default if the key is missing.
    pub(crate) fn flag(&self, key: &str) -> Result<bool, DocumentError> {
        let default = matches!(self.kind(key), Kind::Flag { default: true });
        Ok(self.flag_if_any(key)?.unwrap_or(default))
    }

    /// True or false under a key.
    pub(crate) fn flag_if_any(&self, key: &str) -> Result<Option<bool>, DocumentError> {
        match self.map.get(key) {
            None => Ok(None),
            Some(Value::Bool(flag)) => Ok(Some(*flag)),
            Some(other) => Err(wrong(&self.at(key), "true or false", other)),
        }
    }

    /// The whole number under a key; 0 if the key is missing.
    pub(crate) fn whole(&self, key: &str) -> Result<u64, DocumentError> {
        match self.map.get(key) {
            None => Ok(0),
            Some(value) => value
                .as_u64()
                .ok_or_else(|| wrong(&self.at(key), "a whole number from 0", value)),
        }
    }

    /// The number under a key.
    pub(crate) fn number(&self, key: &str) -> Result<Option<f64>, DocumentError> {
        self.map
            .get(key)
            .map(|value| number(&self.at(key), value))
            .transpose()
    }

    /// The list under a key; empty if the key is missing.
    pub(crate) fn list(&self, key: &str) -> Result<&'a [Value], DocumentError> {
        match self.map.get(key) {
            None => Ok(&[]),
            Some(Value::Array(items)) => Ok(items),
            Some(other) => Err(wrong(&self.at(key), "a list", other)),
        }
    }

    /// The list under a key, of at most as many entries as the schema allows.
    pub(crate) fn limited_list(&self, key: &str) -> Result<&'a [Value], DocumentError> {
        let items = self.list(key)?;
        match self.kind(key) {
            Kind::List { most, what, .. }
            | Kind::OneOrMore { most, what, .. }
            | Kind::Vectors { most, what, .. }
                if items.len() > most =>
            {
                Err(DocumentError::TooMany {
                    pointer: self.at(key),
                    what,
                    found: items.len(),
                    limit: most,
                })
            }
            _ => Ok(items),
        }
    }

    /// The list of `N` numbers under a key; `expected` describes it in the error for anything else.
    pub(crate) fn numbers<const N: usize>(
        &self,
        key: &str,
        expected: &'static str,
    ) -> Result<Option<[f64; N]>, DocumentError> {
        let value = self.map.get(key);
        value
            .map(|value| numbers(&self.at(key), value, expected))
            .transpose()
    }
}

/// A list of `N` numbers.
pub(crate) fn numbers<const N: usize>(
    pointer: &str,
    value: &Value,
    expected: &'static str,
) -> Result<[f64; N], DocumentError> {
    match value {
        Value::Array(items) if items.len() == N => {
            let mut out = [0.0; N];
            for (i, (slot, item)) in out.iter_mut().zip(items).enumerate() {
                *slot = number(&join(pointer, &i.to_string()), item)?;
            }
            Ok(out)
        }
        other => Err(wrong(pointer, expected, other)),
    }
}

/// Reads a finite number. Anything else is an error that names the pointer.
pub(crate) fn number(pointer: &str, value: &Value) -> Result<f64, DocumentError> {
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
