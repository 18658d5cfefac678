//! The colours of the tools' steel.

/// sRGB colours of steel: brushed, where it is held; polished, where it works; and ground to an edge.
pub(super) const BRUSHED: [u8; 3] = [0xa6, 0xaa, 0xad];
pub(super) const POLISHED: [u8; 3] = [0x7c, 0x89, 0x98];
pub(super) const GROUND: [u8; 3] = [0xc2, 0xcc, 0xd6];
