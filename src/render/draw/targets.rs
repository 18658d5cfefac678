//! The textures that a window's picture is drawn into.

use super::raycast::{March, encode_march, frame_group};
use super::studio::Studio;
use super::tiles::tiles_of;
use crate::render::device::bindings::encoder;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::{LINEAR_FORMAT, OUTPUT_FORMAT, Target};
use crate::render::pack::gpu_types::{Frame, Resolve};
use crate::render::pack::raycast_key::RaycastKey;
use crate::render::scene::Scene;

/// Most pixels of a drawn picture. A screen with more pixels shows a smaller picture, enlarged. A 4K screen has fewer
/// pixels than this limit.
const MAX_PIXELS: f32 = 9.0e6;

/// The accumulated picture in linear light, and the picture that the window shows. Both pictures have the same size.
#[derive(Debug)]
pub(crate) struct Targets {
    pub size: [u32; 2],
    pub linear: Target,
    pub output: Target,
    /// Tiles that cover the picture, in the order in which they are drawn.
    pub tiles: Vec<[u32; 4]>,
}

/// The input of one drawing into the targets.
pub(crate) struct Shot<'a> {
    pub key: RaycastKey,
    pub frame: Frame,
    /// Bind group of the baked map, if the program of `key` reads the baked map.
    pub baked: Option<&'a wgpu::BindGroup>,
    /// Width and height, in pixels, of the part of the accumulated picture that is in use. The part starts at the top
    /// left of the picture.
    pub viewport: [u32; 2],
    /// Tiles of the accumulated picture that are drawn.
    pub tiles: &'a [[u32; 4]],
    /// Weight of the new picture against the picture that is already in the target; 1 overwrites the target.
    pub weight: f32,
    /// Factor that turns an output pixel into a texture coordinate, as in [`Resolve`].
    pub scale: [f32; 2],
    /// Largest texture coordinate in use, as in [`Resolve`].
    pub end: [f32; 2],
    /// Tiles of the shown picture that are drawn.
    pub shown: &'a [[u32; 4]],
}

impl Targets {
    pub(crate) fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self {
            size,
            linear: Target::new(gpu, "linear", size, LINEAR_FORMAT),
            output: Target::new(gpu, "output", size, OUTPUT_FORMAT),
            tiles: tiles_of(size),
        }
    }

    /// Hands a drawing to the GPU.
    pub(crate) fn draw(&self, studio: &Studio, scene: &Scene, shot: &Shot<'_>) {
        let (gpu, passes) = (&studio.gpu, &studio.passes);
        let mut encoder = encoder(gpu);
        encode_march(
            &mut encoder,
            &March {
                target: &self.linear.view,
                pipeline: &passes.raycast.pipeline(gpu, shot.key),
                frame: &frame_group(gpu, &passes.layouts, &shot.frame),
                subject: &studio.subject.bind_group,
                scene: &scene.bindings,
                pass: shot.baked,
                viewport: shot.viewport,
                tiles: shot.tiles,
                weight: shot.weight,
            },
        );
        let resolve = Resolve {
            scale: shot.scale,
            end: shot.end,
            background: scene.background(),
            ..Default::default()
        };
        passes.resolve.encode(
            gpu,
            &passes.layouts,
            &mut encoder,
            &resolve,
            [&self.linear.view, &self.output.view],
            shot.shown,
        );
        gpu.queue.submit([encoder.finish()]);
    }
}

/// The size of the picture that is drawn for a screen of the given size, pixels. The picture is smaller than the screen
/// if the screen has more than `MAX_PIXELS` pixels or is longer than the largest texture of the GPU.
pub(crate) fn fitting_size(gpu: &Gpu, size: [u32; 2]) -> [u32; 2] {
    let max_side = gpu.device.limits().max_texture_dimension_2d as f32;
    let [width, height] = size.map(|side| side as f32);
    let scale = (MAX_PIXELS / (width * height).max(1.0))
        .sqrt()
        .min(max_side / width.max(height).max(1.0))
        .min(1.0);
    if scale >= 1.0 {
        size
    } else {
        [width, height].map(|side| (side * scale).floor().max(1.0) as u32)
    }
}
