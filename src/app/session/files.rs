//! What a subject's file leaves to choose: which of its volumes, and how bare voxels lie.

use super::ticket::Ticket;
use crate::document::RawVoxels;

/// What the subject's file leaves to choose.
#[derive(Clone, Debug, Default)]
pub struct FileChoice {
    /// Volumes in the file that is shown; 0 where that is not known.
    pub frame_count: u64,
    /// The dialog with the choice among them is open.
    pub is_open: bool,
    /// What the user is asked about a file of bare voxels.
    pub raw: Option<RawDraft>,
}

impl FileChoice {
    /// A file of so many volumes was loaded; `is_new` if the user just opened it.
    pub fn loaded(&mut self, frame_count: u64, is_new: bool) {
        self.frame_count = frame_count;
        self.is_open = frame_count > 1 && (is_new || self.is_open);
    }
}

/// How the voxels of a file lie, as far as the user has filled it in.
#[derive(Clone, Debug, PartialEq)]
pub struct RawDraft {
    /// The load that waits.
    pub ticket: Ticket,
    /// Length of the file in bytes, if that is known.
    pub byte_len: Option<u64>,
    /// The file is packed, so that its length does not tell the number of voxels.
    pub is_packed: bool,
    /// The answer so far.
    pub voxels: RawVoxels,
}

/// What the user does with the question how bare voxels lie.
#[derive(Clone, Debug, PartialEq)]
pub enum RawCommand {
    /// Replaces the answer so far.
    Change(RawVoxels),
    /// Opens the file as the answer says.
    Open,
    /// Stops the load that waits for the answer.
    Cancel,
}

impl RawDraft {
    /// How the answer fits the file.
    pub fn fit(&self) -> Fit {
        fit(&self.voxels, self.byte_len, self.is_packed)
    }
}

/// How the bytes that the voxels take compare with those that the file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// The file has just as many bytes as the voxels take.
    Exact,
    /// So many bytes are left over.
    Over(u64),
    /// So many bytes are missing.
    Under(u64),
    /// The file is packed, or its length is not known.
    Unknown,
    /// More than can be counted.
    TooLarge,
}

fn byte_count(voxels: &RawVoxels) -> Option<u64> {
    let bits = voxels
        .element
        .trim_start_matches(|c: char| !c.is_ascii_digit());
    let element = bits.parse::<u64>().ok()? / 8;
    voxels
        .size
        .iter()
        .try_fold(element, |n, &side| n.checked_mul(u64::from(side)))?
        .checked_add(voxels.skip_bytes)
}

/// Compares an answer with the length of the file, bytes.
pub(super) fn fit(voxels: &RawVoxels, byte_len: Option<u64>, is_packed: bool) -> Fit {
    let Some(needed) = byte_count(voxels) else {
        return Fit::TooLarge;
    };
    match byte_len.filter(|_| !is_packed) {
        None => Fit::Unknown,
        Some(len) if len == needed => Fit::Exact,
        Some(len) if len > needed => Fit::Over(len - needed),
        Some(len) => Fit::Under(needed - len),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_held_against_the_file() {
        let voxels = RawVoxels {
            size: [10, 20, 30],
            element: "int16",
            big_endian: false,
            spacing_mm: [1.0; 3],
            skip_bytes: 4,
        };
        assert_eq!(byte_count(&voxels), Some(12_004));
        assert_eq!(fit(&voxels, Some(12_004), false), Fit::Exact);
        assert_eq!(fit(&voxels, Some(12_005), false), Fit::Over(1));
        assert_eq!(fit(&voxels, Some(12_000), false), Fit::Under(4));
        assert_eq!(fit(&voxels, Some(12_000), true), Fit::Unknown);
        let huge = RawVoxels {
            size: [u32::MAX; 3],
            ..voxels
        };
        assert_eq!(fit(&huge, Some(1), false), Fit::TooLarge);
    }
}
