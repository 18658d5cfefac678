//! What a picture may have (spec/figures.md, "The source").

/// The largest file of a picture, bytes.
pub const MAX_FILE_BYTES: u64 = 64 << 20;
/// Pixels along a side at most.
pub const MAX_SIDE: u32 = 16_384;
/// Pixels of a picture at most.
pub const MAX_PIXELS: u64 = 40_000_000;
