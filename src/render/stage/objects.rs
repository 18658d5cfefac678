//! The objects of the scene on the GPU.

use crate::render::device::buffers::uniform_buffer;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::write_slices;
use crate::render::pack::gpu_types::SceneObjects;
use crate::render::pack::objects::DrawnObjects;
use crate::render::pack::stamps::{MadeFrom, Stamp, Stamped};
use crate::render::pack::triangles::MeshTexels;
use crate::render::subject::textures::{MESH_ROW, mesh_texture};

/// Uniform of the objects, and the texture of their meshes.
#[derive(Debug)]
pub(crate) struct ObjectTextures {
    /// Group 2, binding 11.
    pub uniform: wgpu::Buffer,
    /// Group 2, binding 12.
    pub view: wgpu::TextureView,
    /// Stamp of the texture.
    pub stamp: Stamp,
    made_from: MadeFrom<1>,
    meshes: DrawnObjects,
}

impl ObjectTextures {
    /// Of a scene without objects.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            uniform: uniform_buffer(gpu, "objects", &SceneObjects::default()),
            view: mesh_texture(gpu, [1, 1]).create_view(&Default::default()),
            stamp: 0,
            made_from: MadeFrom::default(),
            meshes: DrawnObjects::default(),
        }
    }

    /// Takes over the objects that are drawn. Their meshes are copied to the GPU only where others are drawn than
    /// before.
    pub(crate) fn update(&mut self, gpu: &Gpu, objects: &Stamped<DrawnObjects>) {
        if !self.made_from.is_stale([objects.stamp()]) {
            return;
        }
        let objects = objects.get();
        let bytes = bytemuck::bytes_of(&objects.items);
        gpu.queue.write_buffer(&self.uniform, 0, bytes);
        if !objects.has_meshes_of(&self.meshes) {
            self.view.texture().destroy();
            self.view = texture_of(gpu, objects);
            self.stamp += 1;
        }
        self.meshes = objects.clone();
    }
}

fn texture_of(gpu: &Gpu, objects: &DrawnObjects) -> wgpu::TextureView {
    let mut texels = Vec::new();
    for (mesh, has_pictures) in &objects.meshes {
        MeshTexels::of(mesh, false, *has_pictures).pack_all(mesh, &mut texels);
    }
    let row = MESH_ROW as usize;
    texels.resize(texels.len().next_multiple_of(row).max(row), [0; 4]);
    let texture = mesh_texture(gpu, [MESH_ROW, (texels.len() / row) as u32]);
    write_slices(gpu, &texture, 0, 1, 16, bytemuck::cast_slice(&texels));
    texture.create_view(&Default::default())
}
