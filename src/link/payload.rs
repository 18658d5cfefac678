//! What payloads of every version share: their characters, their checksum, their limit.

use crate::document::MAX_BYTES;

/// The alphabet, by value (RFC 4648, section 5).
pub(super) const ALPHABET: &[u8; 64] =
    b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// Characters of the checksum.
pub(super) const CHECK_LENGTH: usize = 5;

/// CRC-30 (polynomial 0x2030B9C7, as in CDMA) over characters: finds every burst of errors up to 30 bits, so any
/// single wrong character, and all but one in a billion of the rest.
pub(super) fn checksum(text: &str) -> [u8; CHECK_LENGTH] {
    let mut crc = 0x3fff_ffff_u32;
    for byte in text.bytes() {
        for i in (0..8).rev() {
            let bit = (u32::from(byte) >> i) & 1;
            let top = (crc >> 29) & 1;
            crc = (crc << 1) & 0x3fff_ffff;
            if top ^ bit == 1 {
                crc ^= 0x2030_b9c7;
            }
        }
    }
    crc ^= 0x3fff_ffff;
    std::array::from_fn(|i| ALPHABET[(crc >> (24 - 6 * i)) as usize & 63])
}

/// True if the last characters are the checksum of those before.
pub(super) fn is_whole(payload: &str) -> bool {
    payload
        .len()
        .checked_sub(CHECK_LENGTH)
        .and_then(|at| payload.split_at_checked(at))
        .is_some_and(|(text, check)| !text.is_empty() && check.as_bytes() == checksum(text))
}

/// Bytes of a document at most, as links see it.
pub(super) const LIMIT: usize = MAX_BYTES;
