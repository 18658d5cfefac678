//! Textures that programs read and draw into.

use super::bindings::encoder;
use super::error::RenderError;
use super::gpu::Gpu;
use super::readback::Readback;
use glam::UVec3;
use half::f16;
use std::ops::Range;

/// Format of the accumulated picture: linear light, premultiplied, blendable everywhere.
pub(crate) const LINEAR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of the shown picture.
pub(crate) const OUTPUT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Format of what a pick reads.
pub(crate) const PICK_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// Format of the normal and the segment of what a pixel shows.
pub(crate) const SURFACE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

/// A texture of three dimensions that programs read; `usage` is what else is done with it.
pub(crate) fn volume_texture(
    gpu: &Gpu,
    label: &str,
    dims: UVec3,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: extent(dims),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | usage,
        view_formats: &[],
    })
}

pub(crate) fn extent(dims: UVec3) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width: dims.x,
        height: dims.y,
        depth_or_array_layers: dims.z,
    }
}

pub(crate) fn write_slices(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    first: u32,
    slices: u32,
    texel_bytes: u32,
    bytes: &[u8],
) {
    let (width, height) = (texture.width(), texture.height());
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d {
                x: 0,
                y: 0,
                z: first,
            },
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * texel_bytes),
            rows_per_image: Some(height),
        },
        wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: slices,
        },
    );
}

/// Writes some rows of a texture of two dimensions.
pub(crate) fn write_rows(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    rows: Range<u32>,
    texel_bytes: u32,
    bytes: &[u8],
) {
    let width = texture.width();
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d {
                x: 0,
                y: rows.start,
                z: 0,
            },
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * texel_bytes),
            rows_per_image: None,
        },
        extent(UVec3::new(width, rows.len() as u32, 1)),
    );
}

/// A texture to draw into.
#[derive(Debug)]
pub(crate) struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Target {
    pub(crate) fn new(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width: size[0].max(1),
                height: size[1].max(1),
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        Self {
            view: texture.create_view(&Default::default()),
            texture,
        }
    }
}

/// Bytes from one row to the next of a texture that is read back, for rows of so many bytes.
pub(crate) fn row_pitch(row_bytes: u32) -> u32 {
    row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

/// Starts reading a whole texture of two or three dimensions after the encoder's work. Rows are `pitch` bytes apart
/// ([`row_pitch`]), slices follow each other.
pub(crate) fn read_texture(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    pitch: u32,
) -> Readback {
    let rows = u64::from(texture.height()) * u64::from(texture.depth_or_array_layers());
    let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(pitch) * rows,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(pitch),
                rows_per_image: Some(texture.height()),
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    Readback::start(gpu, staging)
}

/// Reads all texels of a texture of four 16-bit floats each, x fastest.
///
/// # Errors
/// [`RenderError::DeviceLost`], [`RenderError::Refused`].
pub(crate) async fn read_half_texels(
    gpu: &Gpu,
    texture: &wgpu::Texture,
) -> Result<Vec<[f32; 4]>, RenderError> {
    let pitch = row_pitch(8 * texture.width());
    let bytes = read_texture(gpu, encoder(gpu), texture, pitch).await?;
    let rows = bytes.chunks_exact(pitch as usize);
    let texels = rows.flat_map(|row| row.as_chunks::<8>().0.iter().take(texture.width() as usize));
    let half = |low, high| f16::from_le_bytes([low, high]).to_f32();
    let values =
        texels.map(|&[a, b, c, d, e, f, g, h]| [half(a, b), half(c, d), half(e, f), half(g, h)]);
    Ok(values.collect())
}
