//! Why there is no clay.

/// Most triangles of a file.
pub const MAX_FILE_TRIANGLES: usize = 1_000_000;
/// A mesh of more triangles is reduced.
pub const MAX_START_TRIANGLES: usize = 200_000;

/// Why a clay cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ClayError {
    /// Its start is of a kind that this version does not know.
    #[error("this version makes no clay from \"{0}\"")]
    UnknownStart(String),
    /// Its file has not been read.
    #[error("the clay's file is not there")]
    NoFile,
    /// Its file has more triangles than are looked at.
    #[error(
        "a clay is made of at most {MAX_FILE_TRIANGLES} triangles of a file, and there are {0}"
    )]
    ManyTriangles(usize),
    /// The triangles of its file do not become few enough.
    #[error(
        "a clay begins with at most {MAX_START_TRIANGLES} triangles; of the file's {found} no fewer than {left} describe its shape"
    )]
    Irreducible {
        /// Triangles of the file.
        found: usize,
        /// Those that are left.
        left: usize,
    },
    /// It cannot be drawn.
    #[error("{0}")]
    NoSurface(String),
    /// Whoever asked for it asked to stop.
    #[error("stopped")]
    Stopped,
}
