//! The size of a picture, from the first bytes of its file. Its pixels are decoded elsewhere.

use crate::data::{MeshTexture, Wrap};

/// The largest file of a picture, bytes.
pub(super) const MAX_PICTURE_BYTES: u64 = 64 << 20;
/// Pixels along a side, and altogether, at most.
const MAX_SIDE: u32 = 16_384;
const MAX_PIXELS: u64 = 40_000_000;

/// A texture from the bytes of a file; `None` if they are no PNG or JPEG, or one that is too large.
pub(super) fn texture(bytes: Vec<u8>, wrap: [Wrap; 2]) -> Option<MeshTexture> {
    let size = png_size(&bytes).or_else(|| jpeg_size(&bytes))?;
    let [width, height] = size;
    let fits = width.max(height) <= MAX_SIDE
        && width.min(height) > 0
        && u64::from(width) * u64::from(height) <= MAX_PIXELS
        && bytes.len() as u64 <= MAX_PICTURE_BYTES;
    fits.then_some(MeshTexture { bytes, size, wrap })
}

/// Width and height by the first chunk of a PNG.
fn png_size(bytes: &[u8]) -> Option<[u32; 2]> {
    let header = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    let number = |at: usize| Some(u32::from_be_bytes(header.get(at..at + 4)?.try_into().ok()?));
    (header.get(4..8)? == b"IHDR").then_some([number(8)?, number(12)?])
}

/// Width and height by the frame header of a JPEG.
fn jpeg_size(bytes: &[u8]) -> Option<[u32; 2]> {
    let mut rest = bytes.strip_prefix(b"\xff\xd8")?;
    loop {
        // Any number of 0xff may stand before a marker.
        let at = rest.iter().position(|byte| *byte != 0xff)?;
        let (marker, after) = rest.get(at..)?.split_first()?;
        if at == 0 {
            return None;
        }
        let word = |at: usize| Some(u16::from_be_bytes(after.get(at..at + 2)?.try_into().ok()?));
        match marker {
            // Frames of all kinds; 0xc4, 0xc8 and 0xcc are tables.
            0xc0..=0xcf if !matches!(marker, 0xc4 | 0xc8 | 0xcc) => {
                return Some([u32::from(word(5)?), u32::from(word(3)?)]);
            }
            0x01 | 0xd0..=0xd8 => rest = after,
            0xd9 | 0xda => return None,
            _ => rest = after.get(usize::from(word(0)?).max(2)..)?,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
        bytes.extend(width.to_be_bytes());
        bytes.extend(height.to_be_bytes());
        bytes
    }

    #[test]
    fn sizes_come_from_headers() {
        let size = |bytes: &[u8]| texture(bytes.to_vec(), [Wrap::Repeat; 2]).map(|t| t.size);
        assert_eq!(size(&png(256, 128)), Some([256, 128]));
        let jpeg = b"\xff\xd8\xff\xe0\0\x04ab\xff\xff\xc4\0\x02\xff\xc2\0\x0b\x08\0\x40\0\x80\x01";
        assert_eq!(size(jpeg), Some([128, 64]));
        assert_eq!(size(&jpeg[..20]), None, "cut short");
        assert_eq!(size(&png(256, 128)[..20]), None);
        for (width, height) in [(0, 1), (16_385, 1), (10_000, 4_001), (u32::MAX, u32::MAX)] {
            assert_eq!(size(&png(width, height)), None, "{width} × {height}");
        }
        assert_eq!(size(b"GIF89a"), None);
    }
}
