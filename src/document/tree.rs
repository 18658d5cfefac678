use super::canonical;
use super::error::DocumentError;
use super::illustration::Illustration;
use super::notice::{Notice, NoticeKind};
use super::{FORMAT, MAX_BYTES, json, pointer, resolve, steps};
use serde_json::Value;
use std::sync::Arc;

/// An illustration as plain data: the JSON tree of the contract, whole and valid by construction.
///
/// Unknown keys stay where they are; what stands at its default is left out, so two documents that say the same are
/// equal and are written with the same bytes. Cheap to clone. What it says is resolved once, when it is made.
#[derive(Clone, Debug)]
pub struct Document {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    root: Value,
    illustration: Illustration,
    notices: Vec<Notice>,
    bytes: usize,
}

impl PartialEq for Document {
    fn eq(&self, other: &Self) -> bool {
        self.inner.root == other.inner.root
    }
}

impl Document {
    /// The document that says nothing: the head, untouched.
    pub fn new() -> Self {
        // Built by hand because reading could fail by its type; `tests::the_empty_document_is_one` compares the two.
        Self {
            inner: Arc::new(Inner {
                root: serde_json::json!({ "fabrica": FORMAT }),
                illustration: Illustration::document_default(),
                notices: Vec::new(),
                bytes: r#"{"fabrica":1}"#.len(),
            }),
        }
    }

    /// Reads a document from JSON text of at most 1 MiB.
    ///
    /// # Errors
    /// Whatever is wrong first, named by place; see [`DocumentError`].
    pub fn from_json(text: &str) -> Result<Self, DocumentError> {
        if text.len() > MAX_BYTES {
            return Err(DocumentError::TooLarge {
                found: text.len(),
                limit: MAX_BYTES,
            });
        }
        Self::from_normal(json::read(text)?)
    }

    /// Takes a tree as a document.
    ///
    /// # Errors
    /// As [`Document::from_json`].
    pub fn from_value(mut value: Value) -> Result<Self, DocumentError> {
        json::normalise(&mut value, 0)?;
        Self::from_normal(value)
    }

    /// Takes a tree whose numbers have their one form and whose depth is bounded.
    fn from_normal(mut root: Value) -> Result<Self, DocumentError> {
        let Value::Object(map) = &mut root else {
            return Err(DocumentError::WrongType {
                pointer: String::new(),
                expected: "an object",
                found: match root {
                    Value::Array(_) => "a list",
                    Value::String(_) => "a text",
                    Value::Number(_) => "a number",
                    _ => "a word",
                }
                .to_owned(),
            });
        };
        let (illustration, mut notices) = resolve::resolve(map)?;
        canonical::strip(map);
        notices.extend(steps::check(&root)?);
        if notices.len() > MAX_NOTICES {
            notices.truncate(MAX_NOTICES);
            notices.push(Notice::new("", NoticeKind::More));
        }
        let mut text = String::new();
        json::write_compact(&root, &mut text);
        if text.len() > MAX_BYTES {
            return Err(DocumentError::TooLarge {
                found: text.len(),
                limit: MAX_BYTES,
            });
        }
        Ok(Self {
            inner: Arc::new(Inner {
                root,
                illustration,
                notices,
                bytes: text.len(),
            }),
        })
    }

    /// The document as JSON for people, in canonical order, ended by a newline. Reading it gives an equal document.
    pub fn to_json(&self) -> String {
        let mut text = String::new();
        json::write_pretty(&self.inner.root, 0, &mut text);
        text.push('\n');
        if text.len() > MAX_BYTES {
            // White space alone must not make a document that cannot be read back.
            return self.to_json_compact();
        }
        text
    }

    /// The document as JSON without white space, in canonical order.
    pub fn to_json_compact(&self) -> String {
        let mut text = String::with_capacity(self.inner.bytes);
        json::write_compact(&self.inner.root, &mut text);
        text
    }

    /// Bytes of [`Document::to_json_compact`].
    pub fn byte_count(&self) -> usize {
        self.inner.bytes
    }

    /// What it says, with defaults filled in and values in range.
    pub fn illustration(&self) -> &Illustration {
        &self.inner.illustration
    }

    /// What is kept but not drawn as written.
    pub fn notices(&self) -> &[Notice] {
        &self.inner.notices
    }

    /// The tree.
    pub fn value(&self) -> &Value {
        &self.inner.root
    }

    /// What a JSON pointer points at; nothing is there where a key stands at its default.
    pub fn get(&self, pointer: &str) -> Option<&Value> {
        pointer::get(&self.inner.root, pointer)
    }

    /// The document with one value set. Keys on the way that stand at their default are made; in a list, the index
    /// after the last (or `-`) appends.
    ///
    /// # Errors
    /// If there is no such place, or the document would be wrong with it.
    pub fn with(&self, pointer: &str, value: Value) -> Result<Self, DocumentError> {
        self.edited(|root| pointer::set(root, pointer, value))
    }

    /// The document with one value removed, which for a key means: back to its default.
    ///
    /// # Errors
    /// If the document would be wrong without it.
    pub fn without(&self, pointer: &str) -> Result<Self, DocumentError> {
        self.edited(|root| pointer::remove(root, pointer).map(|_| ()))
    }

    pub(super) fn edited(
        &self,
        edit: impl FnOnce(&mut Value) -> Result<(), DocumentError>,
    ) -> Result<Self, DocumentError> {
        let mut root = self.inner.root.clone();
        edit(&mut root)?;
        Self::from_value(root)
    }

    /// Number of steps after step 0.
    pub fn step_count(&self) -> usize {
        self.inner.illustration.steps.len()
    }

    /// The document as it stands at a step, without its steps. Step 0 is the document itself, step N is step N−1 with
    /// what step N sets.
    ///
    /// # Errors
    /// [`DocumentError::NoSuchStep`].
    pub fn at_step(&self, step: usize) -> Result<Self, DocumentError> {
        Self::from_value(steps::at_step(&self.inner.root, step, self.step_count())?)
    }

    /// What the document says `seconds` into the passage to a step: numbers, vectors, colours and rotations on their
    /// way with a smoothstep ease, the rest as it is at the step.
    ///
    /// # Errors
    /// [`DocumentError::NoSuchStep`].
    pub fn at_time(&self, step: usize, seconds: f32) -> Result<Illustration, DocumentError> {
        let end = self.at_step(step)?;
        let Some(before) = step.checked_sub(1) else {
            return Ok(end.illustration().clone());
        };
        let start = self.at_step(before)?;
        let passage = self.inner.illustration.steps.get(before);
        let total = passage.map_or(0.0, |step| step.seconds);
        let part = if total > 0.0 && seconds.is_finite() {
            (seconds / total).clamp(0.0, 1.0)
        } else {
            1.0
        };
        Ok(steps::blend(
            start.illustration(),
            end.illustration(),
            part * part * (3.0 - 2.0 * part),
        ))
    }
}

impl Default for Document {
    fn default() -> Self {
        Self::new()
    }
}

/// More notices than this help nobody.
pub(super) const MAX_NOTICES: usize = 200;
