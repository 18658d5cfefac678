//! From the bytes of a file to pixels.

use std::io::Cursor;

use super::error::PictureError;
use super::header::{PictureHeader, PictureKind};
use super::limits::MAX_PIXELS;
use super::picture::Picture;

/// Bytes that a decoder may take beside the pixels that it returns.
const MAX_WORK_BYTES: usize = 64 << 20;

/// Unpacks a PNG (all kinds; 16 bits rounded to 8, of an animation the default image) or a JPEG (baseline, progressive;
/// grey, colours, inks). The header is checked before pixels are allocated, and an orientation in the file is not
/// followed.
///
/// # Errors
/// [`PictureError`].
pub fn decode(bytes: &[u8]) -> Result<Picture, PictureError> {
    let header = PictureHeader::of(bytes)?;
    match header.kind {
        PictureKind::Png => png(bytes, header.size),
        PictureKind::Jpeg => jpeg(bytes, header.size),
    }
}

/// Pixels that the sides of a picture within the limits come to.
fn pixel_count([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

fn png(bytes: &[u8], size: [u32; 2]) -> Result<Picture, PictureError> {
    let broken = |_: png::DecodingError| PictureError::Broken("PNG");
    let limits = png::Limits {
        bytes: MAX_WORK_BYTES,
    };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    // Palettes, fewer bits and transparent colours become full channels.
    decoder.set_transformations(png::Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (color, depth) = reader.output_color_type();
    let width = match depth {
        png::BitDepth::Eight => 1,
        png::BitDepth::Sixteen => 2,
        _ => return Err(PictureError::Broken("PNG")),
    };
    let samples = color.samples();
    let mut raw = vec![0; pixel_count(size) * samples * width];
    let frame = reader.next_frame(&mut raw).map_err(broken)?;
    if [frame.width, frame.height] != size || frame.buffer_size() != raw.len() {
        return Err(PictureError::Broken("PNG"));
    }
    if width == 2 {
        let rounded = raw.as_chunks::<2>().0.iter();
        let rounded = rounded.map(|pair| {
            let value = u32::from(u16::from_be_bytes(*pair));
            ((value * 255 + 32_767) / 65_535) as u8
        });
        raw = rounded.collect();
    }
    let pixels = match samples {
        1 => raw.iter().map(|&v| [v, v, v, 255]).collect(),
        2 => (raw.as_chunks().0.iter())
            .map(|&[v, a]| [v, v, v, a])
            .collect(),
        3 => opaque(&raw),
        _ => raw.as_chunks().0.to_vec(),
    };
    Ok(Picture {
        size,
        pixels,
        is_of_inks: false,
    })
}

/// Pixels of three channels each.
fn opaque(raw: &[u8]) -> Vec<[u8; 4]> {
    let pixels = raw.as_chunks().0.iter();
    pixels.map(|&[r, g, b]| [r, g, b, 255]).collect()
}

fn jpeg(bytes: &[u8], size: [u32; 2]) -> Result<Picture, PictureError> {
    use jpeg_decoder::PixelFormat;
    let broken = |error: jpeg_decoder::Error| match error {
        jpeg_decoder::Error::Unsupported(_) => PictureError::Unsupported("this kind of JPEG"),
        _ => PictureError::Broken("JPEG"),
    };
    let mut decoder = jpeg_decoder::Decoder::new(bytes);
    decoder.set_max_decoding_buffer_size(4 * MAX_PIXELS as usize);
    decoder.read_info().map_err(broken)?;
    let info = decoder.info().ok_or(PictureError::Broken("JPEG"))?;
    if [u32::from(info.width), u32::from(info.height)] != size {
        return Err(PictureError::Broken("JPEG"));
    }
    let samples = match info.pixel_format {
        PixelFormat::L8 => 1,
        PixelFormat::RGB24 => 3,
        PixelFormat::CMYK32 => 4,
        PixelFormat::L16 => return Err(PictureError::Unsupported("a JPEG of 16 bits")),
    };
    let raw = decoder.decode().map_err(broken)?;
    if raw.len() != pixel_count(size) * samples {
        return Err(PictureError::Broken("JPEG"));
    }
    let pixels = match samples {
        1 => raw.iter().map(|&v| [v, v, v, 255]).collect(),
        3 => opaque(&raw),
        _ => (raw.as_chunks().0.iter())
            .map(|&inks| of_inks(inks))
            .collect(),
    };
    Ok(Picture {
        size,
        pixels,
        is_of_inks: samples == 4,
    })
}

/// The colour of inks on white paper: each takes its part of the light.
fn of_inks([cyan, magenta, yellow, black]: [u8; 4]) -> [u8; 4] {
    let left = |ink: u8| {
        let light = u32::from(255 - ink) * u32::from(255 - black);
        ((light + 127) / 255) as u8
    };
    [left(cyan), left(magenta), left(yellow), 255]
}
