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
    /// The voxels that it begins with have not been read or made.
    #[error("the voxels that the clay begins with are not there")]
    NoVoxels,
    /// The volume has no such segment.
    #[error("the volume that the clay begins with has no segment \"{name}\" ({known})")]
    NoSegment {
        /// The segment that is named.
        name: String,
        /// Those that there are, in words.
        known: String,
    },
    /// The part of a volume that is meant has more triangles than are looked at.
    #[error(
        "the walls of the clay's volume have {0} triangles, and a clay is made of at most {MAX_FILE_TRIANGLES}: a larger detail has fewer"
    )]
    ManyWalls(usize),
    /// It cannot be drawn.
    #[error("{0}")]
    NoSurface(String),
    /// Whoever asked for it asked to stop.
    #[error("stopped")]
    Stopped,
}
