//! What the first bytes of a file say of a picture: nothing is allocated that rests on them alone.

use super::error::PictureError;
use super::limits::{MAX_FILE_BYTES, MAX_PIXELS, MAX_SIDE};

/// Scans of a JPEG at most. Each may go over all pixels and take a few bytes only.
const MAX_SCANS: usize = 256;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
const JPEG: &[u8] = b"\xff\xd8";

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureKind {
    /// Portable Network Graphics.
    Png,
    /// JPEG, baseline or progressive.
    Jpeg,
}

impl PictureKind {
    /// The name of the format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
        }
    }
}

/// What the header of a picture says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureHeader {
    /// What the file is by its first bytes.
    pub kind: PictureKind,
    /// Width and height, pixels, as stored: no orientation is followed.
    pub size: [u32; 2],
    /// Numbers of a pixel: 1 grey, 2 grey and alpha, 3 red, green and blue (or of a palette, or of a JPEG's YCbCr), 4
    /// with alpha, or of inks.
    pub channels: u8,
    /// Bits of each of them.
    pub bits: u8,
}

impl PictureHeader {
    /// Reads the header of a whole file.
    ///
    /// # Errors
    /// [`PictureError`]: no picture, one of a kind that is not read, or one beyond the limits.
    pub fn of(bytes: &[u8]) -> Result<Self, PictureError> {
        let header = if let Some(rest) = bytes.strip_prefix(PNG) {
            png_header(rest).ok_or(PictureError::Broken("PNG"))?
        } else if let Some(rest) = bytes.strip_prefix(JPEG) {
            jpeg_header(rest)?
        } else {
            return Err(PictureError::Unknown);
        };
        if bytes.len() as u64 > MAX_FILE_BYTES {
            let bytes = bytes.len() as u64;
            return Err(PictureError::LargeFile { bytes });
        }
        let size = header.size;
        let [width, height] = size;
        if width == 0 || height == 0 {
            return Err(PictureError::Empty);
        }
        let count = u64::from(width) * u64::from(height);
        if width.max(height) > MAX_SIDE || count > MAX_PIXELS {
            return Err(PictureError::TooLarge { size });
        }
        Ok(header)
    }

    /// What the numbers of a pixel are, in words.
    pub fn channel_names(&self) -> &'static str {
        match (self.kind, self.channels) {
            (_, 1) => "gray",
            (_, 2) => "gray, alpha",
            (PictureKind::Png, 4) => "red, green, blue, alpha",
            (PictureKind::Jpeg, 4) => "inks",
            _ => "red, green, blue",
        }
    }
}

/// What the first chunk of a PNG says.
fn png_header(rest: &[u8]) -> Option<PictureHeader> {
    let number = |at: usize| Some(u32::from_be_bytes(rest.get(at..at + 4)?.try_into().ok()?));
    let header = PictureHeader {
        kind: PictureKind::Png,
        size: [number(8)?, number(12)?],
        bits: rest.get(16).copied().unwrap_or(8),
        channels: match rest.get(17) {
            Some(0) => 1,
            Some(4) => 2,
            Some(6) => 4,
            // Colours, and those of a palette.
            _ => 3,
        },
    };
    (rest.get(4..8)? == b"IHDR").then_some(header)
}

/// What the frame header of a JPEG says, of a kind that is read, with no more scans than are read.
fn jpeg_header(mut rest: &[u8]) -> Result<PictureHeader, PictureError> {
    const BROKEN: PictureError = PictureError::Broken("JPEG");
    let mut header = None;
    let mut scans = 0;
    loop {
        // Behind a scan follow its packed pixels, in which no marker but those of restarts occurs.
        let is_marker =
            |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0x00 | 0x01 | 0xd0..=0xd7 | 0xff);
        let at = match scans {
            0 => rest
                .iter()
                .position(|byte| *byte != 0xff)
                .filter(|at| *at > 0),
            _ => rest.windows(2).position(is_marker).map(|at| at + 1),
        };
        // A file may end without the mark of its end.
        let Some(at) = at else {
            return header.ok_or(BROKEN);
        };
        let marker = rest[at];
        rest = &rest[at + 1..];
        let word = |at: usize| {
            let bytes = rest.get(at..at + 2).ok_or(BROKEN)?;
            Ok(u32::from(u16::from_be_bytes([bytes[0], bytes[1]])))
        };
        match marker {
            0x01 | 0xd0..=0xd8 => continue,
            0xd9 => return header.ok_or(BROKEN),
            0xc0..=0xc2 => {
                if rest.get(2) != Some(&8) {
                    return Err(PictureError::Unsupported("a JPEG of other than 8 bits"));
                }
                header = Some(PictureHeader {
                    kind: PictureKind::Jpeg,
                    size: [word(5)?, word(3)?],
                    bits: 8,
                    channels: *rest.get(7).ok_or(BROKEN)?,
                });
            }
            // Tables, of which those for arithmetic coding come with frames that are refused.
            0xc4 | 0xc8 | 0xcc => {}
            0xc3 | 0xc5..=0xcf => {
                return Err(PictureError::Unsupported(
                    "a JPEG that is neither baseline nor progressive",
                ));
            }
            0xda => {
                scans += 1;
                if header.is_none() {
                    return Err(BROKEN);
                }
                if scans > MAX_SCANS {
                    return Err(PictureError::Unsupported("a JPEG of more than 256 scans"));
                }
            }
            _ => {}
        }
        let length = word(0)?.max(2) as usize;
        match rest.get(length..) {
            Some(after) => rest = after,
            None if header.is_some() => return header.ok_or(BROKEN),
            None => return Err(BROKEN),
        }
    }
}
