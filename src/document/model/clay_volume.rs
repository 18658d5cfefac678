//! A clay that begins with what voxels hold: a segment or an isosurface of a volume.

use super::reading::Reading;

/// What of a volume a clay begins with.
#[derive(Clone, Debug, PartialEq)]
pub struct ClayVolume {
    /// Where the voxels come from.
    pub of: VoxelSource,
    /// Which of the voxels are meant.
    pub part: VoxelPart,
    /// True: every wall of every piece. False: the outer wall of the largest piece, filled.
    pub has_all_walls: bool,
}

impl ClayVolume {
    /// Names in documents of the walls that are taken; the first is the default.
    pub(crate) const WALLS: [&'static str; 2] = ["outer", "all"];
}

/// Where the voxels of a [`ClayVolume`] come from.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a clay holds the whole in a box")]
pub enum VoxelSource {
    /// A subject that the program generates.
    Builtin {
        /// As [`SubjectRef::Builtin`](super::SubjectRef::Builtin) has it.
        name: String,
        /// Which of its revisions, from 1.
        revision: u32,
    },
    /// A file with a scan; it has an address, or a hash by which the reader's file is known, or both.
    File {
        /// The address, relative to the document or absolute.
        src: Option<String>,
        /// SHA-256 of its bytes, lower-case hex.
        sha256: Option<String>,
        /// The author's name for it, or empty.
        name: String,
        /// How the file is read.
        reading: Reading,
    },
}

/// The voxels that are meant, of all that a volume has.
#[derive(Clone, Debug, PartialEq)]
pub enum VoxelPart {
    /// Those of the segment of this name.
    Segment(String),
    /// Those of at least this value.
    Iso(f64),
}

/// The file that a clay begins with, as its document names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClayFile<'a> {
    /// The address, relative to the document or absolute.
    pub src: Option<&'a str>,
    /// SHA-256 of its bytes, lower-case hex.
    pub sha256: Option<&'a str>,
    /// The author's name for it, or empty.
    pub name: &'a str,
}
