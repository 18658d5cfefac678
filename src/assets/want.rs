use crate::document::{FieldRef, Illustration, Reading, SegmentsRef, SubjectRef, TemplateData};

/// The use that a document makes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The subject of the document.
    Subject,
    /// A label volume beside the subject.
    Segments,
    /// A displacement field of a template.
    Field,
}

/// Where the data for a want come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Made by the program, by name.
    Builtin(String),
    /// A file. One without an address is supplied by the reader, who is asked for it by the author's name.
    File {
        /// Address, relative to the document or absolute, as written in the document.
        src: Option<String>,
        /// SHA-256 of its bytes, lower-case hex.
        sha256: Option<String>,
        /// The author's name for the file; may be empty.
        name: String,
    },
}

/// One file or built-in subject that a document needs from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Want {
    /// The use that the document makes of the file.
    pub role: Role,
    /// Where the file or the subject comes from.
    pub source: Source,
    /// Which volume of the file is meant and how bare voxels lie; the default for all but a subject.
    pub reading: Reading,
}

/// The hash of an arrived file is not the one in the document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("another file than the document means: its SHA-256 is {found}, wanted is {wanted}")]
pub struct OtherFile {
    /// SHA-256 in the document.
    pub wanted: String,
    /// SHA-256 of the bytes that came.
    pub found: String,
}

impl Want {
    /// The subject of a document.
    pub fn subject(subject: &SubjectRef) -> Self {
        let source = match subject {
            SubjectRef::Builtin { name } => Source::Builtin(name.clone()),
            SubjectRef::Address {
                src, sha256, name, ..
            } => Source::File {
                src: Some(src.clone()),
                sha256: sha256.clone(),
                name: name.clone(),
            },
            SubjectRef::Supplied { sha256, name, .. } => Source::File {
                src: None,
                sha256: Some(sha256.clone()),
                name: name.clone(),
            },
        };
        Self {
            role: Role::Subject,
            source,
            reading: subject.reading().cloned().unwrap_or_default(),
        }
    }

    /// A label volume; `None` where a document only names segments of the subject's own file.
    pub fn segments(segments: &SegmentsRef) -> Option<Self> {
        let SegmentsRef { src, sha256, .. } = segments;
        Self::file(Role::Segments, src, sha256, "")
    }

    /// A displacement field; `None` where the template names no file.
    pub fn field(field: &FieldRef) -> Option<Self> {
        Self::file(Role::Field, &field.src, &field.sha256, &field.name)
    }

    fn file(role: Role, src: &Option<String>, sha256: &Option<String>, name: &str) -> Option<Self> {
        (src.is_some() || sha256.is_some()).then(|| Self {
            role,
            source: Source::File {
                src: src.clone(),
                sha256: sha256.clone(),
                name: name.to_owned(),
            },
            reading: Reading::default(),
        })
    }

    /// Address of the file, as written in the document; `None` without one.
    pub fn src(&self) -> Option<&str> {
        match &self.source {
            Source::Builtin(_) => None,
            Source::File { src, .. } => src.as_deref(),
        }
    }

    /// SHA-256 that the document gives.
    pub fn sha256(&self) -> Option<&str> {
        match &self.source {
            Source::Builtin(_) => None,
            Source::File { sha256, .. } => sha256.as_deref(),
        }
    }

    /// Accepts a file of this hash, lower-case hex.
    ///
    /// # Errors
    /// [`OtherFile`] with both hashes if the document gives another one.
    pub fn check(&self, found: &str) -> Result<(), OtherFile> {
        match self.sha256() {
            Some(wanted) if !wanted.eq_ignore_ascii_case(found) => Err(OtherFile {
                wanted: wanted.to_owned(),
                found: found.to_owned(),
            }),
            _ => Ok(()),
        }
    }
}

/// Everything that an illustration needs from outside: its subject first, then label volumes, then fields of templates
/// that act.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted(pub Vec<Want>);

impl Wanted {
    /// What this illustration names.
    pub fn of(illustration: &Illustration) -> Self {
        let mut wants = vec![Want::subject(&illustration.subject)];
        wants.extend(illustration.segments.iter().filter_map(Want::segments));
        for template in illustration.templates.iter().filter(|t| t.enabled) {
            if let TemplateData::Field(field) = &template.data
                && let Some(want) = Want::field(field)
                && !wants.contains(&want)
            {
                wants.push(want);
            }
        }
        Self(wants)
    }
}
