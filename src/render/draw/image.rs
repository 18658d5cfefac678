//! A finished picture, and its way back from the GPU.

use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::{read_texture, row_pitch};

const METERS_PER_INCH: f32 = 0.0254;

/// A finished picture in main memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// sRGB with straight alpha, rows from the top.
    pub rgba: Vec<u8>,
}

/// PNG bytes of a picture (sRGB).
///
/// # Errors
/// [`RenderError::Png`].
pub fn encode_png(image: &Image) -> Result<Vec<u8>, RenderError> {
    let mut bytes = Vec::new();
    let mut writer = png_encoder(&mut bytes, image.size, None).write_header()?;
    writer.write_image_data(&image.rgba)?;
    writer.finish()?;
    Ok(bytes)
}

/// An encoder of a PNG file of a picture (sRGB with straight alpha) that is printed with so many dots per inch.
pub(super) fn png_encoder<W: std::io::Write>(
    out: W,
    [width, height]: [u32; 2],
    dpi: Option<f32>,
) -> png::Encoder<'static, W> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_pixel_dims(dpi.map(|dpi| {
        let per_meter = (dpi / METERS_PER_INCH).round() as u32;
        png::PixelDimensions {
            xppu: per_meter,
            yppu: per_meter,
            unit: png::Unit::Meter,
        }
    }));
    encoder
}

/// The picture of a PNG file, with 8 bits per channel.
///
/// # Errors
/// [`RenderError::NotPng`].
pub fn decode_png(bytes: &[u8]) -> Result<Image, RenderError> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    // Colours with alpha out of whatever the file has, but gray stays gray.
    let to_color = png::Transformations::normalize_to_color8();
    decoder.set_transformations(to_color | png::Transformations::ALPHA);
    let mut reader = decoder.read_info()?;
    let mut rgba = vec![0; reader.output_buffer_size().unwrap_or_default()];
    let info = reader.next_frame(&mut rgba)?;
    rgba.truncate(info.buffer_size());
    if info.color_type == png::ColorType::GrayscaleAlpha {
        let pixels = rgba.chunks_exact(2);
        rgba = pixels.flat_map(|p| [p[0], p[0], p[0], p[1]]).collect();
    }
    Ok(Image {
        size: [info.width, info.height],
        rgba,
    })
}

/// Starts reading a picture of four bytes per pixel after the encoder's work.
pub(crate) fn read_picture(
    gpu: &Gpu,
    encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
) -> impl Future<Output = Result<Image, RenderError>> + use<> {
    let size = [texture.width(), texture.height()];
    let pitch = row_pitch(4 * size[0]);
    let reading = read_texture(gpu, encoder, texture, pitch);
    async move {
        let bytes = reading.await?;
        let rows = bytes.chunks_exact(pitch as usize);
        let rgba = rows
            .flat_map(|row| row.iter().take(4 * size[0] as usize))
            .copied()
            .collect();
        Ok(Image { size, rgba })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_come_back_from_png() {
        let image = Image {
            size: [3, 2],
            rgba: (0..24).map(|i| i * 9).collect(),
        };
        let bytes = encode_png(&image).expect("a small picture");
        assert_eq!(decode_png(&bytes).expect("a PNG"), image);
        assert!(decode_png(&bytes[..40]).is_err(), "cut short");
    }

    #[test]
    fn palettes_and_gray_become_colours() {
        let encoded = |color: png::ColorType, palette: Option<&[u8]>, data: &[u8]| {
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
            encoder.set_color(color);
            encoder.set_depth(png::BitDepth::Eight);
            if let Some(palette) = palette {
                encoder.set_palette(palette);
            }
            let mut writer = encoder.write_header().expect("a header");
            writer.write_image_data(data).expect("two pixels");
            writer.finish().expect("a file");
            decode_png(&bytes).expect("a PNG").rgba
        };
        let palette = encoded(png::ColorType::Indexed, Some(&[1, 2, 3, 4, 5, 6]), &[1, 0]);
        assert_eq!(palette, [4, 5, 6, 255, 1, 2, 3, 255]);
        let gray = encoded(png::ColorType::Grayscale, None, &[7, 8]);
        assert_eq!(gray, [7, 7, 7, 255, 8, 8, 8, 255]);
    }
}
