//! Which file or built-in subject is illustrated, and how its file is read.

use super::clay::Clay;
use super::mesh::{MeshRef, SubjectBox};
use super::reading::Reading;
use crate::document::limits::newest_revision;
use std::sync::Arc;

/// How the names of built-in figures begin.
pub(in crate::document) const DRAWN: &str = "drawn-";

/// The subject of a document.
#[derive(Clone, Debug, PartialEq)]
pub enum SubjectRef {
    /// A subject that the program generates.
    Builtin {
        /// `head`, `bar`, `cube`, …
        name: String,
        /// Which of its revisions, from 1; the first where a document names none.
        revision: u32,
    },
    /// A file at an address, relative to the document or absolute.
    Address {
        /// The address, as written in the document.
        src: String,
        /// SHA-256 of its bytes, lower-case hex, if given.
        sha256: Option<String>,
        /// The author's name for it, or empty.
        name: String,
        /// How the file is read.
        reading: Reading,
    },
    /// A file that the reader supplies; its hash tells which file.
    Supplied {
        /// SHA-256 of its bytes, lower-case hex.
        sha256: String,
        /// The author's name for it, or empty.
        name: String,
        /// How the file is read.
        reading: Reading,
    },
    /// Meshes alone.
    Meshes {
        /// In the order of `subject.meshes`; those without a file are left out.
        meshes: Vec<MeshRef>,
        /// The box that gives origin and unit; `None` takes that of all vertices.
        bounds: Option<SubjectBox>,
    },
    /// A clay, which is made by its strokes. Shared, since a recipe may be long.
    Clay(Arc<Clay>),
}

/// True for the name of a built-in figure, whether this version knows it or not.
pub fn is_drawn_name(name: &str) -> bool {
    name.starts_with(DRAWN)
}

impl SubjectRef {
    /// The newest revision of a built-in subject: what a new document shows.
    pub fn newest(name: &str) -> Self {
        Self::Builtin {
            name: name.to_owned(),
            revision: newest_revision(name),
        }
    }

    /// True for a built-in figure: its name begins with `drawn-`, whether this version knows it or not.
    pub fn is_drawn_figure(&self) -> bool {
        matches!(self, Self::Builtin { name, .. } if is_drawn_name(name))
    }

    /// True for what the program makes itself: a built-in subject or a clay.
    pub fn is_made(&self) -> bool {
        matches!(self, Self::Builtin { .. } | Self::Clay(_))
    }

    /// True for what is read from a file, or made of one.
    pub fn has_file(&self) -> bool {
        match self {
            Self::Builtin { .. } => false,
            Self::Clay(clay) => clay.file().is_some(),
            Self::Address { .. } | Self::Supplied { .. } | Self::Meshes { .. } => true,
        }
    }

    /// True if both are clays of one start, however far each is shaped.
    pub fn is_same_clay(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Clay(own), Self::Clay(theirs)) => own.from == theirs.from,
            _ => false,
        }
    }

    /// Whether the subject is a figure, as far as the document tells: the bytes of a file decide for it, so there it is
    /// `None`.
    pub fn is_figure(&self) -> Option<bool> {
        match self {
            Self::Builtin { .. } | Self::Meshes { .. } | Self::Clay(_) => {
                Some(self.is_drawn_figure())
            }
            Self::Address { .. } | Self::Supplied { .. } => None,
        }
    }

    /// How its file is read; `None` for a built-in subject, a clay, and meshes alone, which have a reading each.
    pub fn reading(&self) -> Option<&Reading> {
        match self {
            Self::Builtin { .. } | Self::Meshes { .. } | Self::Clay(_) => None,
            Self::Address { reading, .. } | Self::Supplied { reading, .. } => Some(reading),
        }
    }

    /// Address of its file, or of the first of several; `None` where there is no file, and for one that the reader
    /// supplies.
    pub fn src(&self) -> Option<&str> {
        match self {
            Self::Builtin { .. } | Self::Supplied { .. } => None,
            Self::Clay(clay) => clay.file()?.src,
            Self::Address { src, .. } => Some(src),
            Self::Meshes { meshes, .. } => meshes.first()?.src.as_deref(),
        }
    }

    /// SHA-256 of the file, or of the first of several, that the reader supplies; `None` where there is no file, and
    /// for one with an address.
    pub fn supplied_sha256(&self) -> Option<&str> {
        let first = match self {
            Self::Builtin { .. } | Self::Address { .. } => None,
            Self::Supplied { sha256, .. } => return Some(sha256),
            Self::Meshes { meshes, .. } => meshes.first(),
            Self::Clay(clay) => {
                let file = clay.file().filter(|file| file.src.is_none())?;
                return file.sha256;
            }
        };
        first.filter(|mesh| mesh.src.is_none())?.sha256.as_deref()
    }

    /// True if both are the same data, read in the same way, whatever the author calls them.
    pub fn is_same_data(&self, other: &Self) -> bool {
        let nameless = |subject: &Self| {
            let mut subject = subject.clone();
            match &mut subject {
                Self::Builtin { .. } | Self::Clay(_) => {}
                Self::Address { name, .. } | Self::Supplied { name, .. } => name.clear(),
                // The author's names of several meshes are those of their segments.
                Self::Meshes { meshes, .. } => {
                    if let [one] = meshes.as_mut_slice() {
                        one.name.clear();
                    }
                }
            }
            subject
        };
        nameless(self) == nameless(other)
    }

    /// This subject with another way of reading its file. A built-in subject or a clay stays as it is, and so do meshes
    /// alone.
    #[must_use]
    pub fn with_reading(mut self, new: Reading) -> Self {
        match &mut self {
            Self::Builtin { .. } | Self::Meshes { .. } | Self::Clay(_) => {}
            Self::Address { reading, .. } | Self::Supplied { reading, .. } => *reading = new,
        }
        self
    }
}

/// A label volume that goes with a subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SegmentsRef {
    /// The address of the file, relative to the document or absolute; without one the document only gives names.
    pub src: Option<String>,
    /// SHA-256 of its bytes, lower-case hex, if given.
    pub sha256: Option<String>,
    /// Label numbers and the names of their segments, by number.
    pub names: Vec<(u32, String)>,
}
