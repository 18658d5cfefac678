//! Packed frames of DICOM files as plain bytes: JPEG (also lossless), JPEG-LS and JPEG 2000 (PS3.5, annex A.4), each by
//! a library. In the page only the part that reads scans holds them.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// Longest message of a library that is passed on, characters.
const MOST_WORDS: usize = 120;

/// The layout of each frame, from the header of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Image {
    /// Pixels in a row.
    pub(super) columns: u32,
    /// Pixels in a column.
    pub(super) rows: u32,
    /// Numbers of a pixel.
    pub(super) samples: u64,
    /// Bits of a number in an unpacked frame: 8 or 16 here.
    pub(super) bits_allocated: u16,
}

impl Image {
    /// Fails unless a packed frame is of this size.
    fn expect(&self, size: [u32; 2], samples: u64, bytes: usize) -> Result<(), String> {
        let is_right = size == [self.columns, self.rows]
            && samples == self.samples
            && bytes == usize::from(self.bits_allocated / 8);
        if is_right {
            return Ok(());
        }
        Err(format!(
            "its packed image is {} × {} with {samples} samples of {bytes} bytes, not as its header says",
            size[0], size[1]
        ))
    }

    /// The frame, if it has as many bytes as the header asks for.
    fn complete(&self, frame: Vec<u8>) -> Result<Vec<u8>, String> {
        let bits = u64::from(self.rows)
            * u64::from(self.columns)
            * self.samples
            * u64::from(self.bits_allocated);
        if frame.len() as u64 * 8 == bits {
            Ok(frame)
        } else {
            Err("its packed image has another number of pixels than its header says".to_owned())
        }
    }
}

/// A library's error as one short line.
fn shown(error: impl std::fmt::Display) -> String {
    let text = error.to_string();
    let printable = text.chars().filter(|c| !c.is_control());
    printable.take(MOST_WORDS).collect()
}

/// Decodes. A library that panics over damaged bytes has not read the file, and that is all; in the page, where no
/// panic can be caught, it ends the worker, which the page reports.
fn guarded(
    name: &str,
    decode: impl FnOnce() -> Result<Vec<u8>, String>,
) -> Result<Vec<u8>, String> {
    catch_unwind(AssertUnwindSafe(decode))
        .unwrap_or_else(|_| Err(format!("its pixels are damaged {name}")))
}

/// Unpacks a JPEG frame: baseline, extended and lossless.
///
/// # Errors
/// In words: damaged bytes, or another size than the header's.
pub(super) fn jpeg(packed: &[u8], wanted: &Image) -> Result<Vec<u8>, String> {
    guarded("JPEG", || {
        let damaged = |error| format!("its JPEG image cannot be read: {}", shown(error));
        let mut decoder = jpeg_decoder::Decoder::new(packed);
        decoder.read_info().map_err(damaged)?;
        let info = decoder
            .info()
            .ok_or_else(|| "its JPEG image says nothing of itself".to_owned())?;
        let (samples, bytes) = match info.pixel_format {
            jpeg_decoder::PixelFormat::L8 => (1, 1),
            jpeg_decoder::PixelFormat::L16 => (1, 2),
            jpeg_decoder::PixelFormat::RGB24 => (3, 1),
            jpeg_decoder::PixelFormat::CMYK32 => (4, 1),
        };
        let size = [info.width.into(), info.height.into()];
        let bits = wanted.bits_allocated;
        if bits == 16 && bytes == 1 && size == [wanted.columns, wanted.rows] && samples == 1 {
            // Eight bits in sixteen.
            let frame = decoder.decode().map_err(damaged)?;
            return Ok(frame.iter().flat_map(|&byte| [byte, 0]).collect());
        }
        wanted.expect(size, samples, bytes)?;
        let mut frame = decoder.decode().map_err(damaged)?;
        if bytes == 2 {
            // Words come in this machine's order.
            for word in frame.as_chunks_mut::<2>().0 {
                *word = u16::from_ne_bytes(*word).to_le_bytes();
            }
        }
        wanted.complete(frame)
    })
}

/// Unpacks a JPEG-LS frame (ITU-T T.87) of one sample per pixel, lossless or nearly so.
///
/// # Errors
/// In words: damaged bytes, colours, or another size than the header's.
pub(super) fn jpeg_ls(packed: &[u8], wanted: &Image) -> Result<Vec<u8>, String> {
    if wanted.samples != 1 {
        return Err("its JPEG-LS image has colours, which are not read in this packing".to_owned());
    }
    guarded("JPEG-LS", || {
        let damaged = |error| format!("its JPEG-LS image cannot be read: {}", shown(error));
        let (pixels, columns, rows) =
            jpegls::decode(packed, wanted.columns, wanted.rows).map_err(damaged)?;
        let frame: Vec<u8> = match wanted.bits_allocated {
            8 if pixels.iter().all(|&pixel| pixel < 256) => {
                pixels.iter().map(|&pixel| pixel as u8).collect()
            }
            16 => pixels
                .iter()
                .flat_map(|pixel| pixel.to_le_bytes())
                .collect(),
            _ => {
                wanted.expect([columns, rows], 1, 2)?;
                Vec::new()
            }
        };
        wanted.complete(frame)
    })
}

/// Unpacks a JPEG 2000 frame. Some pixels come out one unit off, also where nothing was lost: the library counts in
/// 32-bit floats.
///
/// # Errors
/// In words: damaged bytes, or another size than the header's.
pub(super) fn jpeg2000(packed: &[u8], wanted: &Image) -> Result<Vec<u8>, String> {
    use dicom_toolkit_jpeg2000::{DecodeSettings, Image};
    guarded("JPEG 2000", || {
        let damaged = |error| format!("its JPEG 2000 image cannot be read: {}", shown(error));
        let image = Image::new(packed, &DecodeSettings::default()).map_err(damaged)?;
        let depth = image.original_bit_depth();
        if image.width() != wanted.columns
            || image.height() != wanted.rows
            || !(1..=16).contains(&depth)
        {
            return Err(format!(
                "its packed image is {} × {} with {depth} bits, not as its header says",
                image.width(),
                image.height()
            ));
        }
        let raw = image.decode_native().map_err(damaged)?;
        let bytes = usize::from(raw.bytes_per_sample);
        let mut frame = raw.data;
        if wanted.bits_allocated == 16 && bytes == 1 && raw.num_components == 1 {
            frame = frame.iter().flat_map(|&byte| [byte, 0]).collect();
        } else {
            wanted.expect([raw.width, raw.height], raw.num_components.into(), bytes)?;
        }
        // The library shifts signed samples up to be positive; the sign stands in the first header (ITU-T T.800,
        // A.5.1).
        let is_signed = packed.get(42).is_some_and(|sample| sample & 0x80 != 0);
        let shift = 1u16 << (depth - 1);
        match bytes {
            1 if is_signed && wanted.bits_allocated == 8 => {
                frame
                    .iter_mut()
                    .for_each(|byte| *byte = byte.wrapping_sub(shift as u8));
            }
            _ if is_signed => {
                for word in frame.as_chunks_mut::<2>().0 {
                    *word = u16::from_le_bytes(*word).wrapping_sub(shift).to_le_bytes();
                }
            }
            _ => {}
        }
        wanted.complete(frame)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: Image = Image {
        columns: 24,
        rows: 8,
        samples: 1,
        bits_allocated: 16,
    };

    /// A gradient with a flat part, which JPEG-LS packs as runs.
    fn packed_gradient() -> (Vec<u16>, Vec<u8>) {
        let pixels: Vec<u16> = (0..192)
            .map(|i| if i < 60 { 777 } else { 40 * i })
            .collect();
        let mut packed = Vec::new();
        jpegls::encode(&pixels, 24, 8, &mut packed).expect("pixels of 13 bits");
        (pixels, packed)
    }

    #[test]
    fn jpeg_ls_gives_the_pixels_that_were_packed() {
        let (pixels, packed) = packed_gradient();
        let expected: Vec<u8> = pixels.iter().flat_map(|p| p.to_le_bytes()).collect();
        assert_eq!(jpeg_ls(&packed, &SMALL), Ok(expected));
    }

    #[test]
    fn jpeg_ls_that_is_not_as_the_header_says_is_refused() {
        let (_, packed) = packed_gradient();
        for wrong in [
            Image { rows: 9, ..SMALL },
            Image {
                samples: 3,
                ..SMALL
            },
            Image {
                bits_allocated: 8,
                ..SMALL
            },
        ] {
            jpeg_ls(&packed, &wrong).expect_err("another size");
        }
    }

    /// Each byte of a packed image damaged in turn: an image or an error, and never a panic that gets out.
    #[test]
    fn damaged_jpeg_ls_does_no_harm() {
        let (_, packed) = packed_gradient();
        for at in 0..packed.len() {
            for damage in [0, 0x55, 0xff] {
                let mut packed = packed.clone();
                packed[at] = damage;
                if let Ok(frame) = jpeg_ls(&packed, &SMALL) {
                    assert_eq!(frame.len(), 384);
                }
            }
            jpeg_ls(&packed[..at], &SMALL).expect_err("cut off");
        }
    }
}
