//! The triangles of a bent figure on the GPU.

use crate::data::Sheet;
use crate::render::device::buffers::{index_buffer, vertex_buffer};
use crate::render::device::gpu::Gpu;
use crate::render::pack::gpu_types::SheetCorner;

/// Vertices and triangles of a sheet.
#[derive(Debug)]
pub(crate) struct SheetBuffers {
    /// What is drawn.
    pub sheet: Sheet,
    /// A [`SheetCorner`] per vertex.
    pub corners: wgpu::Buffer,
    /// Corners of the triangles in the order of drawing.
    pub indices: wgpu::Buffer,
    /// How many indices there are.
    pub count: u32,
}

impl SheetBuffers {
    pub(crate) fn new(gpu: &Gpu, sheet: &Sheet) -> Self {
        let mesh = &sheet.mesh;
        let rest = mesh.rest.iter().zip(sheet.places.iter()).zip(&mesh.colors);
        let corners: Vec<SheetCorner> = rest
            .map(|((rest, place), color)| SheetCorner {
                rest: rest.to_array(),
                place: place.to_array(),
                color: *color,
            })
            .collect();
        let in_order = sheet.order.iter();
        let triangles = in_order.filter_map(|triangle| mesh.triangles.get(*triangle as usize));
        let indices: Vec<u32> = triangles.flatten().copied().collect();
        Self {
            corners: vertex_buffer(gpu, "sheet", &corners),
            indices: index_buffer(gpu, "sheet", &indices),
            count: indices.len() as u32,
            sheet: sheet.clone(),
        }
    }

    /// Gives the memory back. A browser would do so late.
    pub(crate) fn destroy(&self) {
        self.corners.destroy();
        self.indices.destroy();
    }
}
