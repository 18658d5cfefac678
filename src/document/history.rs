//! A document with its undo and redo.

use super::model::Camera;
use super::text::DocumentError;
use super::tree::Document;
use super::write::Edit;

/// Most edits that can be undone.
const MAX_ENTRIES: usize = 500;
/// Most bytes of JSON that the edits to undo hold together; the oldest are dropped first.
const MAX_HISTORY_BYTES: usize = 32 << 20;

/// A document with its edits, to undo and to redo. Made once per opened document; an edit costs a copy of the tree.
#[derive(Clone, Debug)]
pub struct History {
    document: Document,
    undo: Vec<Entry>,
    redo: Vec<Entry>,
    /// The target ([`Edit::target`]) of the drag that the last entry of `undo` still takes in.
    drag: Option<String>,
}

/// The document on the other side of an edit, and the name of the edit.
#[derive(Clone, Debug)]
struct Entry {
    document: Document,
    name: String,
    /// Where one looked from, if `document` is another one and not an earlier or later state of the same.
    outlook: Option<Outlook>,
}

/// Where one looks at a document from. Undo leaves it alone, but for steps that start another document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// The camera as the hand left it.
    pub camera: Camera,
    /// The camera that the document came with.
    pub home: Camera,
}

impl History {
    /// Starts with a document and nothing to undo.
    pub fn new(document: Document) -> Self {
        Self {
            document,
            undo: Vec::new(),
            redo: Vec::new(),
            drag: None,
        }
    }

    /// The document after all edits that were not undone.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Replaces the document by another one; edits before that cannot be undone.
    pub fn replace(&mut self, document: Document) {
        *self = Self::new(document);
    }

    /// Does an edit, which is undone by itself. True if it changed anything.
    ///
    /// # Errors
    /// As [`Edit::apply`]; the document stays as it was.
    pub fn apply(&mut self, edit: &Edit) -> Result<bool, DocumentError> {
        self.drag = None;
        let document = edit.apply(&self.document)?;
        if document == self.document {
            return Ok(false);
        }
        self.push(document, edit.name(&self.document), None);
        Ok(true)
    }

    /// Does an edit as part of a drag: successive edits of one target are undone together, until [`History::end_drag`].
    /// True if it changed anything.
    ///
    /// # Errors
    /// As [`Edit::apply`]; the document stays as it was.
    pub fn drag(&mut self, edit: &Edit) -> Result<bool, DocumentError> {
        let target = edit.target();
        if self.drag.as_ref() != Some(&target) {
            let changed = self.apply(edit)?;
            // A drag that has changed nothing yet has made no entry that could grow.
            self.drag = changed.then_some(target);
            return Ok(changed);
        }
        let document = edit.apply(&self.document)?;
        let changed = document != self.document;
        self.document = document;
        if let Some(first) = self.undo.last_mut() {
            // The name describes the whole drag, not its last movement.
            first.name = edit.name(&first.document);
            if first.document == self.document {
                // The drag ended where it began: there is nothing to undo.
                self.undo.pop();
                self.drag = None;
            }
        }
        Ok(changed)
    }

    /// Does an edit as part of the last step of undo, whatever that was. True if it changed anything.
    ///
    /// # Errors
    /// As [`Edit::apply`]; the document stays as it was.
    pub fn amend(&mut self, edit: &Edit) -> Result<bool, DocumentError> {
        if self.undo.is_empty() {
            return self.apply(edit);
        }
        self.drag = None;
        let document = edit.apply(&self.document)?;
        let changed = document != self.document;
        self.document = document;
        self.redo.clear();
        Ok(changed)
    }

    /// Writes down what was found to hold for the present document, and for those to undo and to redo that are meant
    /// too. That is no step of undo. True if the present document changed.
    ///
    /// # Errors
    /// As [`Edit::apply`] on the present document; all stay as they were.
    pub fn tell(
        &mut self,
        edit: &Edit,
        is_meant: impl Fn(&Document) -> bool,
    ) -> Result<bool, DocumentError> {
        self.drag = None;
        let document = edit.apply(&self.document)?;
        let changed = document != self.document;
        self.document = document;
        let others = self.undo.iter_mut().chain(&mut self.redo);
        for entry in others.filter(|entry| is_meant(&entry.document)) {
            // One that has no room for it stays as it is.
            if let Ok(told) = edit.apply(&entry.document) {
                entry.document = told;
            }
        }
        Ok(changed)
    }

    /// The file of the subject is none of a figure, of all documents that are meant: see [`Document::known_in_space`].
    /// That is no step of undo either.
    pub fn tell_space(&mut self, is_meant: impl Fn(&Document) -> bool) {
        self.drag = None;
        let entries = self.undo.iter_mut().chain(&mut self.redo);
        let all = entries.map(|entry| &mut entry.document);
        for document in all.chain([&mut self.document]) {
            if is_meant(document) {
                *document = document.known_in_space();
            }
        }
    }

    /// True while a drag goes on that has changed something.
    pub fn is_in_drag(&self) -> bool {
        self.drag.is_some()
    }

    /// Ends a drag: the next one is undone by itself.
    pub fn end_drag(&mut self) {
        self.drag = None;
    }

    /// Starts another document in place of the present one, which is seen from `outlook`, as one step of undo.
    pub fn start(&mut self, document: Document, name: String, outlook: Outlook) {
        self.drag = None;
        self.push(document, name, Some(outlook));
    }

    /// Where one looked from at the document that [`History::undo`], or [`History::redo`], would bring back in place of
    /// another one. Whoever goes there leaves the present outlook in its place. `None` if the document stays the same
    /// one.
    pub fn outlook_mut(&mut self, is_undo: bool) -> Option<&mut Outlook> {
        let entries = if is_undo {
            &mut self.undo
        } else {
            &mut self.redo
        };
        entries.last_mut()?.outlook.as_mut()
    }

    fn push(&mut self, document: Document, name: String, outlook: Option<Outlook>) {
        let before = std::mem::replace(&mut self.document, document);
        self.undo.push(Entry {
            document: before,
            name,
            outlook,
        });
        self.redo.clear();
        let mut bytes: usize = self.undo.iter().map(|e| e.document.byte_count()).sum();
        let mut too_many = 0;
        while self.undo.len() - too_many > 1
            && (self.undo.len() - too_many > MAX_ENTRIES || bytes > MAX_HISTORY_BYTES)
        {
            bytes -= self.undo[too_many].document.byte_count();
            too_many += 1;
        }
        self.undo.drain(..too_many);
    }

    /// Undoes the last edit. False if there is none.
    pub fn undo(&mut self) -> bool {
        self.drag = None;
        let Some(entry) = self.undo.pop() else {
            return false;
        };
        let after = std::mem::replace(&mut self.document, entry.document);
        self.redo.push(Entry {
            document: after,
            ..entry
        });
        true
    }

    /// Does the last undone edit again. False if there is none.
    pub fn redo(&mut self) -> bool {
        self.drag = None;
        let Some(entry) = self.redo.pop() else {
            return false;
        };
        let before = std::mem::replace(&mut self.document, entry.document);
        self.undo.push(Entry {
            document: before,
            ..entry
        });
        true
    }

    /// Name of the edit that [`History::undo`] would undo, such as “Move peel”.
    pub fn undo_name(&self) -> Option<&str> {
        self.undo.last().map(|entry| entry.name.as_str())
    }

    /// Name of the edit that [`History::redo`] would do again.
    pub fn redo_name(&self) -> Option<&str> {
        self.redo.last().map(|entry| entry.name.as_str())
    }
}
