//! What the pixels of a picture show, as a style wants to know it.

use crate::render::device::gpu::Gpu;
use crate::render::device::textures::{LINEAR_FORMAT, PICK_FORMAT, SURFACE_FORMAT, Target};

/// The targets of the entry `trace` of pass/raycast.wgsl.
#[derive(Debug)]
pub(crate) struct Traced {
    color: Target,
    place: Target,
    surface: Target,
}

impl Traced {
    /// Formats of the targets, in the order of their locations: 32 bytes for each pixel, as many as WebGPU grants.
    pub(super) const FORMATS: [wgpu::TextureFormat; 3] =
        [LINEAR_FORMAT, PICK_FORMAT, SURFACE_FORMAT];

    pub(super) fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let [color, place, surface] = ["traced colour", "traced place", "traced surface"];
        let [color_format, place_format, surface_format] = Self::FORMATS;
        Self {
            color: Target::new(gpu, color, size, color_format),
            place: Target::new(gpu, place, size, place_format),
            surface: Target::new(gpu, surface, size, surface_format),
        }
    }

    /// In the order of their locations.
    pub(super) fn views(&self) -> [&wgpu::TextureView; 3] {
        [&self.color.view, &self.place.view, &self.surface.view]
    }

    /// Gives the memory back. A browser would do so late.
    pub(super) fn destroy(&self) {
        for target in [&self.color, &self.place, &self.surface] {
            target.texture.destroy();
        }
    }
}
