/// Why a sink for volumes refuses the pieces of other subjects.
pub(super) const NO_VOLUME: &str = "this is no volume";

/// Why a file gave no volume: what was expected, what was found, and where. One line each, in plain words, file name
/// last.
///
/// No variant holds text out of the file's descriptive fields, where patients' names stand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// A file that is needed is not among those given: the other half of a pair, a slice of a list.
    #[error("{needed} is needed beside {name}, but was not given")]
    MissingFile {
        /// The file that asks for it.
        name: String,
        /// The file that is missing.
        needed: String,
    },
    /// The file could not be opened or read.
    #[error("cannot read at byte {offset}: {message} ({name})")]
    Io {
        /// Name of the file, as given.
        name: String,
        /// Bytes read before, unpacked if the file is packed.
        offset: u64,
        /// The message of the operating system.
        message: String,
    },
    /// Nothing in the file.
    #[error("the file is empty ({name})")]
    Empty {
        /// Name of the file, as given.
        name: String,
    },
    /// Neither content nor name is one of the formats known.
    #[error(
        "not a volume file that Fabrica knows (NIfTI, NRRD, MetaImage, DICOM): it begins with {begins} ({name})"
    )]
    UnknownFormat {
        /// Name of the file, as given.
        name: String,
        /// The first bytes of the file, as hexadecimal.
        begins: String,
    },
    /// A format, or a part of one, that is known and not read.
    #[error("{what} ({name})")]
    Unsupported {
        /// Name of the file, as given.
        name: String,
        /// What the file is, and what the user may do instead.
        what: String,
    },
    /// Another kind of file, which holds no scan.
    #[error("{what} ({name})")]
    NoScan {
        /// Name of the file, as given.
        name: String,
        /// What the file is, and what the user may do instead.
        what: &'static str,
        /// The kind of file, as people call it.
        kind: FaultKind,
    },
    /// A header field holds something that cannot be.
    #[error("{field} at byte {offset} of the header should be {expected}, but is {found} ({name})")]
    Header {
        /// Name of the file, as given.
        name: String,
        /// The field, by the name that the format gives it.
        field: &'static str,
        /// Where it stands, bytes from the start.
        offset: u64,
        /// What the field should hold, in plain words.
        expected: String,
        /// What the field holds, in plain words.
        found: String,
    },
    /// A line of a text header cannot be understood.
    #[error(
        "line {line} of the header: \"{field}\" should be {expected}, but is \"{found}\" ({name})"
    )]
    HeaderLine {
        /// Name of the file, as given.
        name: String,
        /// Line number from 1; 0 if the field is missing.
        line: usize,
        /// Name of the field in the header.
        field: String,
        /// What the field should hold, in plain words.
        expected: String,
        /// What the field holds, shortened.
        found: String,
    },
    /// The packed data are damaged.
    #[error("the {codec} data are damaged after {offset} unpacked bytes: {message} ({name})")]
    Damaged {
        /// Name of the file, as given.
        name: String,
        /// gzip, zlib or bzip2.
        codec: &'static str,
        /// Bytes unpacked before the damage was noticed.
        offset: u64,
        /// The message of the decoder.
        message: String,
    },
    /// The file ends before its voxels do.
    #[error(
        "the file ends too early: its header promises {expected} bytes, {found} are there ({name})"
    )]
    Truncated {
        /// Name of the file, as given.
        name: String,
        /// Bytes that the header asks for, unpacked.
        expected: u64,
        /// Bytes that came, or can be there at most.
        found: u64,
    },
    /// There are more bytes than the header explains, in a format where that means a wrong picture.
    #[error(
        "at least {extra} bytes more than the header explains: the voxels would be shifted ({name})"
    )]
    TooLong {
        /// Name of the file, as given.
        name: String,
        /// Bytes left over (at least).
        extra: u64,
    },
    /// The header asks for more voxels than the limit of [`super::ReadOptions`].
    #[error("{voxels} voxels are more than the {limit} that can be opened ({name})")]
    TooLarge {
        /// Name of the file, as given.
        name: String,
        /// Voxels asked for, capped at `u64::MAX`.
        voxels: u64,
        /// Voxels that can be opened.
        limit: u64,
    },
    /// The asked frame of a series is not there.
    #[error("volume {} was asked for, the file has {count} ({name})", .asked.saturating_add(1))]
    NoSuchFrame {
        /// Name of the file, as given.
        name: String,
        /// Frame asked for, from 0.
        asked: u64,
        /// Number of frames in the file.
        count: u64,
    },
    /// The receiver cannot take the subject.
    #[error("{message} ({name})")]
    Refused {
        /// Name of the file, as given.
        name: String,
        /// The message of the receiver.
        message: String,
    },
    /// A file that gave no mesh.
    #[error("{message}")]
    Mesh {
        /// What was expected, what was found, and where, with the name of the file.
        message: String,
    },
    /// A file that gave no figure.
    #[error("{message} ({name})")]
    Figure {
        /// Name of the file, as given.
        name: String,
        /// What was expected, what was found, and where.
        message: String,
    },
    /// The user stopped it, or the receiver gave up.
    #[error("stopped before the file was read")]
    Cancelled,
    /// A file that is no displacement field.
    #[error("not a displacement field: {what} ({name})")]
    NotField {
        /// Name of the file, as given.
        name: String,
        /// What is wrong with the file.
        what: String,
    },
    /// A label volume holds something that is no label.
    #[error("not a label volume: {what} ({name})")]
    NotLabels {
        /// Name of the file, as given.
        name: String,
        /// What it holds instead.
        what: String,
    },
}

impl LoadError {
    /// The error of the file that was read, for the message of a receiver that takes no more of it.
    pub(super) fn refused(name: &str) -> impl FnOnce(String) -> Self {
        move |message| Self::Refused {
            name: name.to_owned(),
            message,
        }
    }
}

/// What the owner of a file would call its fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// The file is a photo or a drawing.
    Picture,
    /// The file is a surface model.
    Surface,
    /// The file is an archive, in which a scan may be.
    Archive,
    /// The file is no scan in a format that is read.
    Unknown,
    /// The file has no bytes.
    Empty,
    /// The file ends too early.
    CutShort,
    /// The packed data are damaged, which may mean that the file ends too early.
    Damaged,
    /// The system does not let the file be read.
    Unreadable,
    /// Another file goes with this one.
    Lacks,
    /// The header holds what cannot be.
    Header,
    /// The file holds more voxels than can be opened.
    TooLarge,
}

impl FaultKind {
    /// Each kind with its word in messages between threads.
    pub const WORDS: [(Self, &'static str); 11] = [
        (Self::Picture, "picture"),
        (Self::Surface, "surface"),
        (Self::Archive, "archive"),
        (Self::Unknown, "unknown"),
        (Self::Empty, "empty"),
        (Self::CutShort, "cut-short"),
        (Self::Damaged, "damaged"),
        (Self::Unreadable, "unreadable"),
        (Self::Lacks, "lacks"),
        (Self::Header, "header"),
        (Self::TooLarge, "too-large"),
    ];
}
