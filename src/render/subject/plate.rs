//! The picture of a figure on the GPU.

use super::held_view::HeldView;
use crate::data::{Plate, SubjectFrame};
use crate::pictures::smaller_copies;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::extent;
use glam::UVec3;
use std::sync::Arc;

/// The pixels of a plate and their smaller copies.
#[derive(Debug)]
pub(crate) struct PlateTexture {
    pub view: Arc<HeldView>,
    /// Half of the plate's width and height, subject units.
    pub half_size: [f32; 2],
    /// Width and height, texels.
    pub texels: [u32; 2],
    /// The texture and its smaller copies.
    pub levels: u32,
    /// Where the plate lies, and how fine it is.
    pub frame: SubjectFrame,
}

impl PlateTexture {
    /// Hands a plate over in one piece.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if the device takes no texture of this size.
    pub(crate) fn new(gpu: &Gpu, plate: &Plate) -> Result<Self, RenderError> {
        let texels = plate.picture.size;
        let most = gpu.device.limits().max_texture_dimension_2d;
        if texels.iter().any(|side| *side > most || *side == 0) {
            return Err(RenderError::TooLarge(format!(
                "{} × {} pixels do not fit on this device",
                texels[0], texels[1]
            )));
        }
        let copies = smaller_copies(plate.picture.clone());
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("plate"),
            size: extent(UVec3::new(texels[0], texels[1], 1)),
            mip_level_count: copies.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (level, copy) in (0..).zip(&copies) {
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level: level,
                    origin: wgpu::Origin3d::ZERO,
                    aspect: wgpu::TextureAspect::All,
                },
                bytemuck::cast_slice(&copy.pixels),
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * copy.size[0]),
                    rows_per_image: None,
                },
                extent(UVec3::new(copy.size[0], copy.size[1], 1)),
            );
        }
        Ok(Self {
            view: HeldView::new(&texture),
            half_size: plate.half_size().as_vec2().to_array(),
            texels,
            levels: copies.len() as u32,
            frame: plate.frame(),
        })
    }
}
