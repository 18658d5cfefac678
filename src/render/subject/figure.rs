//! A figure on the GPU: its plate, where a volume would be.

use super::bricks::BrickBuilder;
use super::held_view::HeldView;
use super::plate::PlateTexture;
use super::textures::{SubjectTextures, label_texture};
use super::volume::assemble;
use crate::data::{Grid, Volume, Voxels};
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::textures::volume_texture;
use crate::render::pack::values::SubjectInfo;
use glam::{DAffine3, UVec3};

impl PlateTexture {
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
