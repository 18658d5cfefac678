//! The transfer function of a document on the GPU.

use crate::document::OpacityMode;
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::gpu::Gpu;
use crate::render::pack::gpu_types::{Look, MeshLook, TABLE_FORMAT};
use crate::render::pack::look::{TABLE_SIZE, TransferTable};
use crate::render::pack::stamps::{MadeFrom, Stamped};
use crate::render::subject::textures::SubjectTextures;

/// Uniform and table of the transfer function.
#[derive(Debug)]
pub(crate) struct LookTable {
    /// Group 2, binding 1.
    pub uniform: wgpu::Buffer,
    /// Group 2, binding 10.
    pub mesh_uniform: wgpu::Buffer,
    /// Group 2, binding 2.
    pub view: wgpu::TextureView,
    table: wgpu::Texture,
    made_from: MadeFrom<2>,
    mesh_made_from: MadeFrom<1>,
}

const SIZE: wgpu::Extent3d = wgpu::Extent3d {
    width: TABLE_SIZE as u32,
    height: 1,
    depth_or_array_layers: 1,
};

impl LookTable {
    /// Shows nothing until [`LookTable::update`].
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let table = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("transfer table"),
            size: SIZE,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TABLE_FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        Self {
            uniform: uniform_buffer(gpu, "look", &Look::default()),
            mesh_uniform: uniform_buffer(gpu, "mesh look", &MeshLook::default()),
            view: table.create_view(&Default::default()),
            table,
            made_from: MadeFrom::default(),
            mesh_made_from: MadeFrom::default(),
        }
    }

    /// Takes over how the segments of a mesh are drawn.
    pub(crate) fn update_mesh(&mut self, gpu: &Gpu, look: &Stamped<MeshLook>) {
        if self.mesh_made_from.is_stale([look.stamp()]) {
            let bytes = bytemuck::bytes_of(look.get());
            gpu.queue.write_buffer(&self.mesh_uniform, 0, bytes);
        }
    }

    /// Takes over the look; how the table is read depends on the values of the subject.
    pub(crate) fn update(
        &mut self,
        gpu: &Gpu,
        subject: &SubjectTextures,
        look: &Stamped<Option<(TransferTable, OpacityMode)>>,
    ) {
        let is_stale = self.made_from.is_stale([subject.stamp, look.stamp()]);
        let Some((table, mode)) = look.get().as_ref().filter(|_| is_stale) else {
            return;
        };
        let uniform = table.uniform(*mode, &subject.info);
        gpu.queue
            .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        gpu.queue.write_texture(
            self.table.as_image_copy(),
            bytemuck::cast_slice(&table.texels()),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(8 * TABLE_SIZE as u32),
                rows_per_image: Some(1),
            },
            SIZE,
        );
    }
}
