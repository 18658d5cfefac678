use super::limits::{MAX_FILE_BYTES, MAX_PIXELS, MAX_SIDE};

/// Why a file gave no picture, in plain words. No variant holds words of the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// Another format, or none.
    #[error("neither PNG nor JPEG")]
    Unknown,
    /// Its header cannot be understood, or its bytes cannot be unpacked.
    #[error("the {0} is cut short or broken")]
    Broken(&'static str),
    /// A kind of the format that is not read.
    #[error("{0} is not read")]
    Unsupported(&'static str),
    /// A side of 0 pixels.
    #[error("it has no pixels")]
    Empty,
    /// A larger file than is opened.
    #[error("{bytes} bytes are more than the {MAX_FILE_BYTES} that a picture may have")]
    LargeFile {
        /// Bytes of the file.
        bytes: u64,
    },
    /// More pixels than are opened.
    #[error("{0} × {1} pixels are too many: {MAX_SIDE} along a side and {MAX_PIXELS} in all are the most", size[0], size[1])]
    TooLarge {
        /// Width and height by the header, pixels.
        size: [u32; 2],
    },
}
