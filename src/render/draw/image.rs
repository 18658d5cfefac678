//! A finished picture, and its way back from the GPU.

use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::{read_texture, row_pitch};

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
    let mut encoder = png::Encoder::new(&mut bytes, image.size[0], image.size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image.rgba)?;
    writer.finish()?;
    Ok(bytes)
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
