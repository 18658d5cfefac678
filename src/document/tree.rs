//! The document: the JSON tree, whole and valid.

use super::lesson::Lesson;
use super::limits::{DEFAULT_SUBJECT, FORMAT, MAX_BYTES, MAX_NOTICES};
use super::model::{Illustration, SubjectRef};
use super::read::resolve;
use super::text::{DocumentError, Notice, NoticeKind, json, pointer};
use super::write::{Edit, json as writing, set};
use super::{canonical, recording, steps};
use serde_json::Value;
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// An illustration as plain data: the JSON tree of the contract, whole and valid by construction.
///
/// Unknown keys stay where they are; keys at their default are left out, so two documents that mean the same are equal
/// and are written with the same bytes. Cheap to clone. Its illustration is resolved once, when the document is made.
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
    /// Made when a step is first shown: most documents of a history never are.
    lesson: OnceLock<Result<Lesson, DocumentError>>,
    /// A subject whose file is known to be none of a figure, whatever stands beside it.
    in_space: Option<SubjectRef>,
}

impl PartialEq for Document {
    fn eq(&self, other: &Self) -> bool {
        self.inner.root == other.inner.root
    }
}

impl Document {
    /// The empty document: the head, undeformed.
    pub fn new() -> Self {
        // Built by hand because reading could fail by its type; `tests::the_empty_document_is_one` compares the two.
        Self {
            inner: Arc::new(Inner {
                root: serde_json::json!({ "fabrica": FORMAT }),
                illustration: Illustration::document_default(),
                notices: Vec::new(),
                bytes: r#"{"fabrica":1}"#.len(),
                lesson: OnceLock::new(),
                in_space: None,
            }),
        }
    }

    /// The document that an author begins with: the head in its newest revision, undeformed.
    pub fn fresh() -> Self {
        let subject = SubjectRef::newest(DEFAULT_SUBJECT);
        Edit::SetSubject(subject)
            .apply(&Self::new())
            .unwrap_or_default()
    }

    /// True for a document in which nothing was made yet: an empty one, or one that an author begins with.
    pub fn is_blank(&self) -> bool {
        *self == Self::new() || *self == Self::fresh()
    }

    /// Reads a document from JSON text of at most 1 MiB.
    ///
    /// # Errors
    /// The first fault, named by its place; see [`DocumentError`].
    pub fn from_json(text: &str) -> Result<Self, DocumentError> {
        if text.len() > MAX_BYTES {
            return Err(DocumentError::TooLarge {
                found: text.len(),
                limit: MAX_BYTES,
            });
        }
        Self::from_normal(json::read(text)?, None)
    }

    /// Makes a document of a JSON tree.
    ///
    /// # Errors
    /// As [`Document::from_json`].
    pub fn from_value(value: Value) -> Result<Self, DocumentError> {
        Self::from_tree(value, None)
    }

    fn from_tree(mut value: Value, in_space: Option<SubjectRef>) -> Result<Self, DocumentError> {
        json::normalise(&mut value, 0)?;
        Self::from_normal(value, in_space)
    }

    /// Takes a tree whose numbers have their one form and whose depth is bounded.
    fn from_normal(mut root: Value, in_space: Option<SubjectRef>) -> Result<Self, DocumentError> {
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
        let (mut illustration, mut notices) = resolve(map)?;
        illustration.learn_space(in_space.as_ref());
        canonical::strip(map);
        notices.extend(steps::check(&root)?);
        if notices.len() > MAX_NOTICES {
            notices.truncate(MAX_NOTICES);
            notices.push(Notice::new("", NoticeKind::More));
        }
        let mut text = String::new();
        writing::write_compact(&root, &mut text);
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
                lesson: OnceLock::new(),
                in_space,
            }),
        })
    }

    /// The document once it is known that the file of its subject is none of a figure: a `figure` beside it is kept,
    /// and means nothing for the camera.
    pub fn known_in_space(&self) -> Self {
        let subject = self.inner.illustration.subject.clone();
        let known = Self::from_tree(self.inner.root.clone(), Some(subject));
        known.unwrap_or_else(|_| self.clone())
    }

    /// An edit as the tree takes it, which does not know what the file is.
    fn for_tree<'a>(&self, edit: &'a Edit) -> Cow<'a, Edit> {
        match self.inner.illustration.is_in_space {
            true => Cow::Owned(edit.seen_as_figure()),
            false => Cow::Borrowed(edit),
        }
    }

    /// The document as JSON for people, in canonical order, ended by a newline. Reading it gives an equal document.
    pub fn to_json(&self) -> String {
        let mut text = String::new();
        writing::write_pretty(&self.inner.root, 0, &mut text);
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
        writing::write_compact(&self.inner.root, &mut text);
        text
    }

    /// Length of [`Document::to_json_compact`] in UTF-8, bytes.
    pub fn byte_count(&self) -> usize {
        self.inner.bytes
    }

    /// What the document means: defaults filled in, values in range.
    pub fn illustration(&self) -> &Illustration {
        &self.inner.illustration
    }

    /// Notices about values that are kept but not drawn as written.
    pub fn notices(&self) -> &[Notice] {
        &self.inner.notices
    }

    /// The JSON tree of the document.
    pub fn value(&self) -> &Value {
        &self.inner.root
    }

    /// The value that a JSON pointer points at; `None` where a key stands at its default.
    pub fn get(&self, pointer: &str) -> Option<&Value> {
        pointer::get(&self.inner.root, pointer)
    }

    /// The document with one value set. Keys on the way that stand at their default are made; in a list, the index
    /// after the last (or `-`) appends.
    ///
    /// # Errors
    /// If there is no such place, or the document would be wrong with it.
    pub fn with(&self, pointer: &str, value: Value) -> Result<Self, DocumentError> {
        self.edited(|root| set(root, pointer, value))
    }

    /// The document with one value removed, which for a key means: back to its default.
    ///
    /// # Errors
    /// If the document would be wrong without it.
    pub fn without(&self, pointer: &str) -> Result<Self, DocumentError> {
        self.edited(|root| pointer::remove(root, pointer).map(|_| ()))
    }

    fn edited(
        &self,
        edit: impl FnOnce(&mut Value) -> Result<(), DocumentError>,
    ) -> Result<Self, DocumentError> {
        let mut root = self.inner.root.clone();
        edit(&mut root)?;
        Self::from_tree(root, self.inner.in_space.clone())
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
        let state = steps::at_step(&self.inner.root, step, self.step_count())?;
        Self::from_tree(state, self.inner.in_space.clone())
    }

    /// A step that comes after another one and shows what an edit of that one's state makes of it: its entry of
    /// `steps`, which sets only what differs.
    ///
    /// # Errors
    /// [`DocumentError::NoSuchStep`], and as [`Edit::apply`].
    pub fn step_after(&self, step: usize, edit: &Edit) -> Result<Value, DocumentError> {
        recording::step_after(&self.inner.root, step, &self.for_tree(edit))
    }

    /// What the document means at each of its steps, resolved when it is first asked for. Copies of a document share
    /// it.
    ///
    /// # Errors
    /// None that the document would not have had when it was made.
    pub fn lesson(&self) -> Result<&Lesson, DocumentError> {
        let inner = &self.inner;
        let make = || {
            let in_space = inner.in_space.as_ref();
            Lesson::new(&inner.root, &inner.illustration.steps, in_space)
        };
        inner
            .lesson
            .get_or_init(make)
            .as_ref()
            .map_err(Clone::clone)
    }

    /// What the document means `seconds` into the passage to a step; see [`Lesson::at`].
    ///
    /// # Errors
    /// [`DocumentError::NoSuchStep`].
    pub fn at_time(&self, step: usize, seconds: f32) -> Result<Illustration, DocumentError> {
        self.lesson()?.at(step, seconds)
    }
}

impl Default for Document {
    fn default() -> Self {
        Self::new()
    }
}

impl Edit {
    /// The document with the edit done.
    ///
    /// # Errors
    /// If there is no such template, caption or step, or a limit would be passed.
    pub fn apply(&self, document: &Document) -> Result<Document, DocumentError> {
        let edit = document.for_tree(self);
        document.edited(|root| recording::apply(root, &edit))
    }
}
