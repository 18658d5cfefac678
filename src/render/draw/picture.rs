use super::image::{Image, read_picture};
use super::passes::Passes;
use super::raycast::{March, encode_march, frame_group, sample_weight};
use super::rows::{MOST_PX, Rows, Taker};
use super::sheet::DrawnSheet;
use super::style::Styled;
use super::tiles::tiles_of;
use super::traced::Traced;
use crate::data::Resources;
use crate::document::{Illustration, Style};
use crate::render::device::bindings::encoder;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::WorkDone;
use crate::render::device::textures::{LINEAR_FORMAT, OUTPUT_FORMAT, Target};
use crate::render::pack::frame::frame_of;
use crate::render::pack::gpu_types::{Frame, Resolve};
use crate::render::pack::raycast_key::RaycastKey;
use crate::render::pack::style::style_margin;
use crate::render::pack::view::View;
use crate::render::scene::Scene;
use crate::render::subject::plate::PlateTexture;
use crate::render::subject::textures::SubjectTextures;
use std::sync::Arc;

/// Tiles handed to the GPU before it is waited for: seconds at most on a software GPU.
const BATCH_TILES: usize = 64;
/// The same on a software GPU with nobody else to wait for it. Lavapipe 22.3 loses 2.4 MiB with every batch: 600 MiB
/// with the smaller ones of a picture of 8,192 × 8,192 pixels.
const SOFTWARE_BATCH_TILES: usize = 256;

/// Everything for one picture, so that drawing it borrows nothing.
pub(crate) struct PictureJob {
    pub gpu: Gpu,
    pub passes: Arc<Passes>,
    pub subject: Arc<SubjectTextures>,
    /// On the heap, as the futures that own a job are moved and a browser's stack is small.
    pub scene: Box<Scene>,
    pub view: View,
    pub size: [u32; 2],
    /// Rows that are drawn at once, from 1.
    pub band_rows: u32,
    /// True for a picture as the viewer draws it while something moves.
    pub is_quick: bool,
}

/// Rows of a picture that are drawn at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    /// The row of the picture that it begins with.
    pub first: u32,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

impl Band {
    /// With so many rows more on either side, as far as there are any in a picture of this height.
    fn with_margin(self, margin: u32, height: u32) -> Self {
        let first = self.first.saturating_sub(margin);
        let end = (self.first + self.size[1] + margin).min(height);
        Self {
            first,
            size: [self.size[0], end - first],
        }
    }
}

impl PictureJob {
    /// Fails if a picture of this size cannot be drawn on this device.
    pub(crate) fn check_size(gpu: &Gpu, size: [u32; 2]) -> Result<(), RenderError> {
        let max = MOST_PX.min(gpu.device.limits().max_texture_dimension_2d);
        if size.iter().any(|&side| side == 0 || side > max) {
            return Err(RenderError::BadSize {
                width: size[0],
                height: size[1],
                max,
            });
        }
        Ok(())
    }

    /// Takes over another illustration of the subject, as after an edit.
    pub(crate) fn show(&mut self, shown: (&Illustration, &Resources)) {
        self.passes
            .update(&self.gpu, &mut self.scene, &self.subject, shown);
    }

    /// From now on drawn from the baked map, as while something moves.
    pub(crate) fn bake(&mut self, texels_along: Option<u32>) {
        self.is_quick = true;
        self.passes
            .bake(&self.gpu, &mut self.scene, texels_along, u32::MAX);
    }

    /// The uniform of a sample for targets that begin with this row of the picture.
    fn frame(&self, first_row: u32, index: u32) -> Frame {
        let detail = self.subject.frame.detail;
        let frame = Frame {
            first_row: first_row as f32,
            ..frame_of(&self.view, &self.view, self.scene.bounds(), detail, index)
        };
        if self.is_quick {
            frame.of_what_moves()
        } else {
            frame
        }
    }

    /// Marches one ray for each pixel of a band into the top of the targets: sample `index`, which is mixed into those
    /// before. `key` tells the program, `baked` is the group of the baked map if that program reads it. `on_batch`
    /// hears how many pixels each batch had, and may stop it.
    pub(super) async fn march(
        &self,
        targets: &[&wgpu::TextureView],
        band: Band,
        (key, baked): (RaycastKey, Option<&wgpu::BindGroup>),
        index: u32,
        mut on_batch: impl FnMut(u64) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let pipeline = self.passes.raycast.pipeline(&self.gpu, key);
        let frame = self.frame(band.first, index);
        let frame_group = frame_group(&self.gpu, &self.passes.layouts, &frame);
        let batch_tiles = match self.gpu.is_software() && self.gpu.waits() {
            true => SOFTWARE_BATCH_TILES,
            false => BATCH_TILES,
        };
        for batch in tiles_of(band.size).chunks(batch_tiles) {
            let mut encoder = encoder(&self.gpu);
            encode_march(
                &mut encoder,
                &March {
                    targets,
                    pipeline: &pipeline,
                    frame: &frame_group,
                    subject: &self.subject.bind_group,
                    scene: &self.scene.bindings,
                    pass: baked,
                    viewport: band.size,
                    tiles: batch,
                    weight: sample_weight(index),
                },
            );
            self.gpu.queue.submit([encoder.finish()]);
            WorkDone::start(&self.gpu).await?;
            self.gpu.check()?;
            on_batch(batch.iter().map(|tile| u64::from(tile[2] * tile[3])).sum())?;
        }
        Ok(())
    }

    /// Mixes a sample of a band into the samples before: with this style, of what was traced from row `first_row` of
    /// the picture on.
    fn draw_style(
        &self,
        band: Band,
        index: u32,
        target: &wgpu::TextureView,
        (traced, style, first_row): (&Traced, &Style, u32),
    ) {
        let (gpu, layouts) = (&self.gpu, &self.passes.layouts);
        let mut encoder = encoder(gpu);
        let styled = Styled {
            target,
            traced,
            style,
            subject: &self.subject,
            size_px: self.view.size_px.to_array(),
            first_row,
            frame: &frame_group(gpu, layouts, &self.frame(band.first, index)),
            scene: &self.scene.bindings,
            size: band.size,
            weight: sample_weight(index),
        };
        self.passes
            .style
            .encode(gpu, layouts, &mut encoder, &styled);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Mixes a sample of a band of a figure into the samples before.
    fn draw_sheet(
        &self,
        band: Band,
        index: u32,
        target: &wgpu::TextureView,
        (layer, plate): (&Target, &PlateTexture),
    ) {
        let (gpu, layouts) = (&self.gpu, &self.passes.layouts);
        let mut encoder = encoder(gpu);
        let drawn = DrawnSheet {
            target,
            buffers: self.scene.sheet(),
            plate,
            frame: &frame_group(gpu, layouts, &self.frame(band.first, index)),
            size: band.size,
            tiles: &[[0, 0, band.size[0], band.size[1]]],
            weight: sample_weight(index),
        };
        let pass = &self.passes.sheet;
        pass.encode(gpu, layouts, &mut encoder, layer, &drawn);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Draws it, from the start each time, band by band from the top, and hands each band over once it is done: no more
    /// than one is in memory, however large the picture is. Each pixel comes out the same to the bit whatever the
    /// bands' height is.
    pub(crate) async fn draw_rows(
        &self,
        samples: u32,
        taker: &mut impl Taker,
    ) -> Result<(), RenderError> {
        let [width, height] = self.size;
        let rows = self.band_rows.clamp(1, height);
        let band_size = [width, rows];
        let linear = Target::new(&self.gpu, "linear", band_size, LINEAR_FORMAT);
        let output = Target::new(&self.gpu, "image", band_size, OUTPUT_FORMAT);
        let baked = self.scene.baked();
        let key = match baked {
            Some(_) => self.scene.baked_key(),
            None => self.scene.key(),
        };
        let group = baked.map(|baked| &baked.group);
        let bands = (0..height).step_by(rows as usize).map(|first| Band {
            first,
            size: [width, rows.min(height - first)],
        });
        let style = self.scene.style();
        let margin = style.map_or(0, |style| style_margin(style, self.size));
        let traced = style.map(|_| Traced::new(&self.gpu, [width, rows + 2 * margin]));
        let plate = self.subject.plate.as_ref();
        let layer = plate.map(|_| Target::new(&self.gpu, "figure", band_size, LINEAR_FORMAT));
        let marched = |band: &Band| band.with_margin(margin, height);
        let all_rows: u32 = bands.clone().map(|band| marched(&band).size[1]).sum();
        let all = f64::from(width) * f64::from(all_rows) * f64::from(samples);
        let mut drawn = 0;
        for band in bands {
            let first = band.first;
            for index in 0..samples {
                if let (Some(plate), Some(layer)) = (plate, &layer) {
                    self.draw_sheet(band, index, &linear.view, (layer, plate));
                    WorkDone::start(&self.gpu).await?;
                    self.gpu.check()?;
                    drawn += u64::from(width * band.size[1]);
                    taker.progress((drawn as f64 / all) as f32)?;
                    continue;
                }
                let views = traced.as_ref().map(Traced::views);
                let plain = [&linear.view];
                let targets = views.as_ref().map_or(plain.as_slice(), |views| views);
                let marched = marched(&band);
                self.march(targets, marched, (key, group), index, |pixels| {
                    drawn += pixels;
                    taker.progress((drawn as f64 / all) as f32)
                })
                .await?;
                if let (Some(style), Some(traced)) = (style, &traced) {
                    let parts = (traced, style, marched.first);
                    self.draw_style(band, index, &linear.view, parts);
                }
            }
            let mut encoder = encoder(&self.gpu);
            let resolve = Resolve {
                scale: band_size.map(|side| 1.0 / side as f32),
                end: [1.0; 2],
                background: self.scene.background(),
                is_straight: 1,
                is_unlit: u32::from(plate.is_some()),
                padding: [0; 2],
            };
            self.passes.resolve.encode(
                &self.gpu,
                &self.passes.layouts,
                &mut encoder,
                &resolve,
                [&linear.view, &output.view],
                &[[0, 0, width, band.size[1]]],
            );
            let mut rgba = read_picture(&self.gpu, encoder, &output.texture)
                .await?
                .rgba;
            rgba.truncate(4 * width as usize * band.size[1] as usize);
            if let Some(message) = self.gpu.take_errors().into_iter().next() {
                return Err(RenderError::Refused {
                    pass: "picture",
                    message,
                });
            }
            taker.take(Rows { first, rgba })?;
        }
        Ok(())
    }

    /// Draws it whole, and reports after each batch how much of it is drawn, 0 to 1.
    pub(crate) async fn draw(
        &self,
        samples: u32,
        on_progress: impl Fn(f32),
    ) -> Result<Image, RenderError> {
        let mut whole = Whole {
            rgba: Vec::new(),
            on_progress,
        };
        self.draw_rows(samples, &mut whole).await?;
        Ok(Image {
            size: self.size,
            rgba: whole.rgba,
        })
    }
}

/// Takes a picture as one.
struct Whole<P> {
    rgba: Vec<u8>,
    on_progress: P,
}

impl<P: Fn(f32)> Taker for Whole<P> {
    fn progress(&mut self, part: f32) -> Result<(), RenderError> {
        (self.on_progress)(part);
        Ok(())
    }

    fn take(&mut self, rows: Rows) -> Result<(), RenderError> {
        self.rgba.extend(rows.rgba);
        Ok(())
    }
}
