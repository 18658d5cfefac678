//! The picture of a figure on the GPU.

use super::bricks::BrickBuilder;
use super::textures::{HeldView, SubjectTextures, label_texture};
use super::volume::assemble;
use crate::data::{Grid, Plate, SubjectFrame, Volume, Voxels};
use crate::pictures::smaller_copies;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::textures::{extent, volume_texture};
use crate::render::pack::values::SubjectInfo;
use glam::{DAffine3, UVec3};
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
    frame: SubjectFrame,
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

    /// A subject of this plate, around an empty voxel that stands in where passes bind a volume.
    pub(crate) fn alone(self, gpu: &Gpu, layouts: &Layouts) -> SubjectTextures {
        let volume = Volume {
            has_size: false,
            grid: Grid {
                dims: UVec3::ONE,
                world_from_voxel: DAffine3::IDENTITY,
            },
            voxels: Voxels::U8(vec![0]),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 1.0],
            segmentation: None,
        };
        let values = volume_texture(
            gpu,
            "no values",
            UVec3::ONE,
            wgpu::TextureFormat::R16Float,
            wgpu::TextureUsages::COPY_DST,
        );
        let views = [&values, &label_texture(gpu, UVec3::ONE)].map(HeldView::new);
        let bricks = BrickBuilder::new(UVec3::ONE).bricks;
        let info = SubjectInfo::of_no_values(false);
        let empty = assemble(gpu, layouts, &volume, None, (views, None), bricks, info);
        SubjectTextures {
            frame: self.frame,
            bounds: self.frame.bounds,
            plate: Some(self),
            ..empty
        }
    }
}
