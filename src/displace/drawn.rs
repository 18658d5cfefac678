//! What the sweeps of a document have, as bits of `drawn_kinds` above those of kinds: programs leave out the rest.

/// Tools that are grids of distances.
pub const DRAWN_GRIDS: u32 = 1 << 31;
/// Tools that are ellipsoids.
pub const DRAWN_ELLIPSOIDS: u32 = 1 << 30;
/// Tools that are curves, of straight pieces.
pub const DRAWN_PIECES: u32 = 1 << 29;
/// A tool alone that is no curve: neither another nor an image of it comes into its reach.
pub const DRAWN_ALONE: u32 = 1 << 28;
/// Tools that act together, or a curve.
pub const DRAWN_TOGETHER: u32 = 1 << 27;
/// Such tools that ask for so many fields that several share a turn of a loop.
pub const DRAWN_CROWDED: u32 = 1 << 26;
/// All that sweeps may have.
pub const DRAWN_OF_SWEEPS: u32 =
    DRAWN_GRIDS | DRAWN_ELLIPSOIDS | DRAWN_PIECES | DRAWN_ALONE | DRAWN_TOGETHER | DRAWN_CROWDED;
