//! The textures that a window's picture is drawn into.

use super::raycast::{March, encode_march, frame_group};
use super::sheet::DrawnSheet;
use super::studio::Studio;
use super::style::Styled;
use super::tiles::tiles_of;
use super::traced::Traced;
use crate::render::device::bindings::encoder;
use crate::render::device::gpu::Gpu;
use crate::render::device::textures::{LINEAR_FORMAT, OUTPUT_FORMAT, Target};
use crate::render::pack::gpu_types::{Frame, Resolve};
use crate::render::pack::raycast_key::RaycastKey;
use crate::render::scene::Scene;
use crate::render::subject::plate::PlateTexture;
use std::cell::OnceCell;

/// Most pixels of a drawn picture. A screen with more pixels shows a smaller picture, enlarged. A 4K screen has fewer
/// pixels than this limit.
const MAX_PIXELS: f32 = 9.0e6;

/// The accumulated picture in linear light, and the picture that the window shows. Both pictures have the same size.
#[derive(Debug)]
pub(crate) struct Targets {
    pub size: [u32; 2],
    pub linear: Target,
    pub output: Target,
    /// What the pixels show, once a style wants to know it.
    traced: OnceCell<Traced>,
    /// One sample of a figure, once there is one.
    layer: OnceCell<Target>,
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
    /// These are the last tiles of a sample. A style, which looks at the pixels around each, is drawn only then.
    pub ends_sample: bool,
}

impl Targets {
    pub(crate) fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self {
            size,
            linear: Target::new(gpu, "linear", size, LINEAR_FORMAT),
            output: Target::new(gpu, "output", size, OUTPUT_FORMAT),
            traced: OnceCell::new(),
            layer: OnceCell::new(),
            tiles: tiles_of(size),
        }
    }

    /// Gives the memory of the pictures back. A browser would do so late.
    pub(crate) fn destroy(self) {
        self.linear.texture.destroy();
        self.output.texture.destroy();
        if let Some(traced) = self.traced.get() {
            traced.destroy();
        }
        if let Some(layer) = self.layer.get() {
            layer.texture.destroy();
        }
    }

    /// Hands a drawing to the GPU.
    pub(crate) fn draw(&self, studio: &Studio, scene: &Scene, shot: &Shot<'_>) {
        let (gpu, passes) = (&studio.gpu, &studio.passes);
        let mut encoder = encoder(gpu);
        let frame = frame_group(gpu, &passes.layouts, &shot.frame);
        if let Some(plate) = &studio.subject.plate {
            self.draw_sheet(studio, scene, (shot, plate), (&mut encoder, &frame));
            self.resolve(studio, scene, shot, shot.shown, encoder);
            return;
        }
        let traced = scene.style().map(|style| {
            let traced = self.traced.get_or_init(|| Traced::new(gpu, self.size));
            (style, traced)
        });
        let plain = [&self.linear.view];
        let views = traced.map(|(_, traced)| traced.views());
        encode_march(
            &mut encoder,
            &March {
                targets: views.as_ref().map_or(&plain, |views| views.as_slice()),
                pipeline: &passes.raycast.pipeline(gpu, shot.key),
                frame: &frame,
                subject: &studio.subject.bind_group,
                scene: &scene.bindings,
                pass: shot.baked,
                viewport: shot.viewport,
                tiles: shot.tiles,
                weight: shot.weight,
            },
        );
        let whole = [[0, 0, self.size[0], self.size[1]]];
        let mut shown = shot.shown;
        if let Some((style, traced)) = traced {
            if !shot.ends_sample {
                gpu.queue.submit([encoder.finish()]);
                return;
            }
            shown = &whole;
            let styled = Styled {
                target: &self.linear.view,
                traced,
                style,
                subject: &studio.subject,
                size_px: shot.frame.size_px,
                first_row: 0,
                frame: &frame,
                scene: &scene.bindings,
                size: shot.viewport,
                weight: shot.weight,
            };
            passes
                .style
                .encode(gpu, &passes.layouts, &mut encoder, &styled);
        }
        self.resolve(studio, scene, shot, shown, encoder);
    }

    /// Adds a sample of a figure; of one that has no sheet yet, an empty one.
    fn draw_sheet(
        &self,
        studio: &Studio,
        scene: &Scene,
        (shot, plate): (&Shot<'_>, &PlateTexture),
        (encoder, frame): (&mut wgpu::CommandEncoder, &wgpu::BindGroup),
    ) {
        let (gpu, passes) = (&studio.gpu, &studio.passes);
        let make = || Target::new(gpu, "figure", self.size, LINEAR_FORMAT);
        let layer = self.layer.get_or_init(make);
        let drawn = DrawnSheet {
            target: &self.linear.view,
            buffers: scene.sheet(),
            plate,
            frame,
            size: shot.viewport,
            tiles: shot.tiles,
            weight: shot.weight,
        };
        passes
            .sheet
            .encode(gpu, &passes.layouts, encoder, layer, &drawn);
    }

    /// Shows what is accumulated, and hands all to the GPU.
    fn resolve(
        &self,
        studio: &Studio,
        scene: &Scene,
        shot: &Shot<'_>,
        shown: &[[u32; 4]],
        mut encoder: wgpu::CommandEncoder,
    ) {
        let (gpu, passes) = (&studio.gpu, &studio.passes);
        let resolve = Resolve {
            scale: shot.scale,
            end: shot.end,
            background: scene.background(),
            is_unlit: u32::from(studio.subject.plate.is_some()),
            ..Default::default()
        };
        passes.resolve.encode(
            gpu,
            &passes.layouts,
            &mut encoder,
            &resolve,
            [&self.linear.view, &self.output.view],
            shown,
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
