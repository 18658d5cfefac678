//! Why a command failed.

use std::io;
use std::path::Path;

use crate::assets::{OtherFile, Role, Want};
use crate::clay::ClayError;
use crate::data::BuildError;
use crate::document::{DocumentError, MAX_BYTES};
use crate::link::{LinkError, TooLongForQr};
use crate::load::{LoadError, MeshError};
use crate::render::RenderError;
use crate::subjects::SubjectError;

/// Why a command failed. One line each.
#[derive(Debug, thiserror::Error)]
pub(super) enum CliError {
    #[error("{path}: {source}")]
    Read { path: String, source: io::Error },
    #[error("{path}: larger than a document may be ({MAX_BYTES} bytes)")]
    TooLong { path: String },
    #[error("{path}: not a text in UTF-8")]
    NotUtf8 { path: String },
    #[error("{path}: {source}")]
    Document { path: String, source: DocumentError },
    #[error("{path}: {source}")]
    Link { path: String, source: LinkError },
    #[error("there is no file {path}, and no link that begins so: {source}")]
    NeitherFileNorLink { path: String, source: LinkError },
    #[error(transparent)]
    Step(DocumentError),
    #[error("{0}")]
    Field(String),
    #[error("subject: {0}")]
    Subject(#[from] MissingSubject),
    #[error("{0} [{1}]")]
    Load(LoadError, String),
    #[error("{0} [{1}]")]
    Mesh(MeshError, String),
    #[error(transparent)]
    Qr(#[from] TooLongForQr),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error("{path}: {source}; nothing was written")]
    Write { path: String, source: io::Error },
    #[error("{path}: stopped; nothing was written")]
    Stopped { path: String },
    #[error("{path}, line {line}: expected {expected}, found “{found}”")]
    Numbers {
        path: String,
        line: usize,
        expected: &'static str,
        found: String,
    },
    #[error("ray {ray}: its direction has no length")]
    NoDirection { ray: usize },
    #[error("standard output: {0}")]
    Output(io::Error),
    #[error("{0}")]
    Window(String),
    #[error("{0}")]
    Usage(&'static str),
}

/// Why a document's subject is not there.
#[derive(Debug, thiserror::Error)]
pub(super) enum MissingSubject {
    /// An address that is no local file.
    #[error(
        "the subject is at {src}; this program reads local files only: fetch it and give it by --subject FILE"
    )]
    Remote {
        /// As written in the document.
        src: String,
    },
    /// A file that the reader is to supply.
    #[error("the document needs the file {name} (SHA-256 {sha256}): give it by --subject FILE")]
    Wanted {
        /// What the author called it.
        name: String,
        /// SHA-256 of the file's bytes, lower-case hex.
        sha256: String,
    },
    /// A label volume at an address that is no local file.
    #[error(
        "the label volume is at {src}; this program reads local files only: fetch it and name the file"
    )]
    RemoteSegments {
        /// As written in the document.
        src: String,
    },
    /// Another file than the document means.
    #[error("{path} is {other}")]
    OtherFile {
        /// Path of the file that was given.
        path: String,
        /// The hash that the document wants, and the one that the file has.
        other: OtherFile,
    },
    /// No such built-in subject in this version.
    #[error(transparent)]
    Builtin(#[from] SubjectError),
    /// The clay cannot be made.
    #[error(transparent)]
    Clay(#[from] ClayError),
    /// The file cannot be read.
    #[error("{source} [{path}]")]
    File {
        /// Path of the file.
        path: String,
        /// The error of the reader.
        source: LoadError,
    },
    /// The file was read but holds no volume.
    #[error("{source} [{path}]")]
    Build {
        /// The file or subject.
        path: String,
        /// What is missing or wrong in the file.
        source: BuildError,
    },
}

impl MissingSubject {
    /// The error for an address on the network.
    pub(super) fn remote(want: &Want) -> Self {
        let src = want.src().unwrap_or_default().chars().take(200).collect();
        match want.role {
            Role::Segments => Self::RemoteSegments { src },
            _ => Self::Remote { src },
        }
    }

    /// The error for a file that the reader is to supply.
    pub(super) fn wanted(want: &Want) -> Self {
        Self::Wanted {
            name: match want.name() {
                "" => "without a name".to_owned(),
                name => format!("“{name}”"),
            },
            sha256: want.sha256().unwrap_or_default().to_owned(),
        }
    }

    /// The error for a file with another hash than the one in the document.
    pub(super) fn other(path: &Path, other: OtherFile) -> Self {
        Self::OtherFile {
            path: path.display().to_string(),
            other,
        }
    }
}
