//! Events of a load on its way, from whatever thread or worker it runs in.

use crate::data::SubjectPart;
use crate::document::RawVoxels;
use crate::load::{FileFault, LabelFile};

/// Which files hold labels of the subject: files that are opened are taken as its segments where they are among these,
/// or where they look like labels and a scan is shown.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SegmentationsExpected {
    /// SHA-256 of files, lower-case hex.
    pub sha256: Vec<String>,
    /// A scan from a file is shown.
    pub has_scan: bool,
}

/// What happens to a load, in this order; `Part` to `Coarse` may repeat, each time finer.
#[derive(Debug)]
pub enum LoadEvent {
    /// A piece of the subject.
    Part(SubjectPart),
    /// How far it is.
    Progress {
        /// Part of the work that is done, 0 to 1.
        fraction: f32,
        /// What is being done: `Reading` or `Generating`.
        what: String,
    },
    /// The pieces so far make a whole coarse subject, which may be shown. The pieces of a finer one follow.
    Coarse,
    /// A label volume that was wanted, opened beside the scan, or opened for the one that is shown. It comes before the
    /// pieces of the scan.
    LabelFile(Box<LabelFile>),
    /// The file holds several volumes, of which the wanted one comes. Told before `Done`.
    Frames {
        /// Number of volumes in the file.
        count: u64,
    },
    /// What made the images, as DICOM abbreviates it: at most 16 capitals, digits and underlines. Told before `Done`.
    Modality(String),
    /// The file does not say how its voxels lie. The load waits for the answer.
    AskRaw(RawQuestion),
    /// The file that was asked for in place of the subject: the mesh of a clay.
    Written(Vec<u8>),
    /// The subject is whole.
    Done {
        /// SHA-256 of the file's bytes, lower-case hex; `None` for a built-in subject.
        sha256: Option<String>,
    },
    /// Something was not as expected but the subject is usable.
    Notice(String),
    /// There will be no subject.
    Failed {
        /// One line in plain words.
        message: String,
        /// More, shown on demand; may be empty.
        details: String,
        /// What is wrong with the file, for its owner; `None` where the message says that best.
        fault: Option<FileFault>,
    },
    /// Stopped by the user.
    Cancelled,
}

/// A file that may hold bare voxels, as far as its name and length tell.
#[derive(Clone, Debug, PartialEq)]
pub struct RawQuestion {
    /// Length of the file, bytes; `None` if it is not known.
    pub byte_len: Option<u64>,
    /// The file is packed by gzip, so that its length does not tell the number of voxels.
    pub is_packed: bool,
    /// A guess from its name and length.
    pub guess: Option<RawVoxels>,
}
