use crate::load::LoadError;

/// Why a file gave no mesh: what was expected, what was found, and where. One line each, in plain words, file name
/// last.
///
/// No variant holds text out of comments or headers, where patients' names stand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The file itself could not be read, or is none that is read.
    #[error(transparent)]
    File(#[from] LoadError),
    /// A line of a text cannot be understood.
    #[error("line {line}: {what} ({name})")]
    Line {
        /// Name of the file, as given.
        name: String,
        /// Line number, from 1.
        line: u64,
        /// What was expected there, and what was found.
        what: String,
    },
    /// Bytes cannot be understood.
    #[error("at byte {offset}: {what} ({name})")]
    Byte {
        /// Name of the file, as given.
        name: String,
        /// Bytes before that place, unpacked.
        offset: u64,
        /// What was expected there, and what was found.
        what: String,
    },
    /// The file's description of itself cannot be, or asks for what is not read.
    #[error("{what} ({name})")]
    Content {
        /// Name of the file, as given.
        name: String,
        /// What is wrong, with the number of the element.
        what: String,
    },
    /// Nothing to draw.
    #[error("there is no triangle: {found} ({name})")]
    NoTriangle {
        /// Name of the file, as given.
        name: String,
        /// What was found instead.
        found: String,
    },
    /// More triangles than can be drawn.
    #[error("{count} triangles so far are more than the {limit} that can be opened ({name})")]
    TooManyTriangles {
        /// Name of the file, as given.
        name: String,
        /// Triangles counted until then.
        count: u64,
        /// Triangles that can be opened.
        limit: u64,
    },
    /// More vertices, normals or texture coordinates than the triangles that can be drawn could use.
    #[error("{count} {what} so far are more than {limit} triangles can use ({name})")]
    TooManyValues {
        /// Name of the file, as given.
        name: String,
        /// What there is too much of.
        what: &'static str,
        /// How many were counted until then.
        count: u64,
        /// Triangles that can be opened.
        limit: u64,
    },
    /// A mesh that is a point.
    #[error("the mesh has no size: all its vertices lie at one place ({name})")]
    NoSize {
        /// Name of the file, as given.
        name: String,
    },
}

impl From<MeshError> for LoadError {
    fn from(error: MeshError) -> Self {
        match error {
            MeshError::File(error) => error,
            other => Self::Mesh {
                message: other.to_string(),
            },
        }
    }
}
