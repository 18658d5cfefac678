use super::image::{Image, read_picture};
use super::passes::Passes;
use super::raycast::{March, encode_march, frame_group};
use super::tiles::tiles_of;
use crate::render::device::bindings::encoder;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::WorkDone;
use crate::render::device::textures::{LINEAR_FORMAT, OUTPUT_FORMAT, Target};
use crate::render::pack::frame::frame_of;
use crate::render::pack::gpu_types::Resolve;
use crate::render::pack::raycast_key::RaycastKey;
use crate::render::pack::view::View;
use crate::render::scene::Scene;
use crate::render::subject::textures::SubjectTextures;
use std::sync::Arc;

/// Tiles handed to the GPU before it is waited for: seconds at most on a software GPU.
const BATCH_TILES: usize = 64;

/// Everything for one picture, so that drawing it borrows nothing.
pub(crate) struct PictureJob {
    pub gpu: Gpu,
    pub passes: Arc<Passes>,
    pub subject: Arc<SubjectTextures>,
    /// On the heap, as the futures that own a job are moved and a browser's stack is small.
    pub scene: Box<Scene>,
    pub view: View,
    pub size: [u32; 2],
}

impl PictureJob {
    /// Fails if a picture of this size cannot be drawn on this device.
    pub(crate) fn check_size(gpu: &Gpu, size: [u32; 2]) -> Result<(), RenderError> {
        let max = gpu.device.limits().max_texture_dimension_2d;
        if size.iter().any(|&side| side == 0 || side > max) {
            return Err(RenderError::BadSize {
                width: size[0],
                height: size[1],
                max,
            });
        }
        Ok(())
    }

    /// From now on drawn from the baked map.
    pub(crate) fn bake(&mut self, texels_along: Option<u32>) {
        self.passes
            .bake(&self.gpu, &mut self.scene, texels_along, u32::MAX);
    }

    /// Marches one ray for each pixel: sample `index`, which is mixed into those before. `key` tells the program,
    /// `baked` is the group of the baked map if that program reads it. `on_batch` hears how many tiles each batch had.
    pub(super) async fn march(
        &self,
        target: &wgpu::TextureView,
        (key, baked): (RaycastKey, Option<&wgpu::BindGroup>),
        index: u32,
        mut on_batch: impl FnMut(usize),
    ) -> Result<(), RenderError> {
        let pipeline = self.passes.raycast.pipeline(&self.gpu, key);
        let detail = self.subject.frame.detail;
        let frame = frame_of(&self.view, &self.view, self.scene.bounds(), detail, index);
        let frame_group = frame_group(&self.gpu, &self.passes.layouts, &frame);
        for batch in tiles_of(self.size).chunks(BATCH_TILES) {
            let mut encoder = encoder(&self.gpu);
            encode_march(
                &mut encoder,
                &March {
                    target,
                    pipeline: &pipeline,
                    frame: &frame_group,
                    subject: &self.subject.bind_group,
                    scene: &self.scene.bindings,
                    pass: baked,
                    viewport: self.size,
                    tiles: batch,
                    weight: 1.0 / (index + 1) as f32,
                },
            );
            self.gpu.queue.submit([encoder.finish()]);
            WorkDone::start(&self.gpu).await?;
            self.gpu.check()?;
            on_batch(batch.len());
        }
        Ok(())
    }

    /// Draws it, from the start each time, and reports after each batch how much of it is drawn, 0 to 1.
    pub(crate) async fn draw(
        &self,
        samples: u32,
        on_progress: impl Fn(f32),
    ) -> Result<Image, RenderError> {
        let linear = Target::new(&self.gpu, "linear", self.size, LINEAR_FORMAT);
        let output = Target::new(&self.gpu, "image", self.size, OUTPUT_FORMAT);
        let baked = self.scene.baked();
        let key = match baked {
            Some(_) => self.scene.baked_key(),
            None => self.scene.key(),
        };
        let (mut drawn, all) = (0, tiles_of(self.size).len() * samples as usize);
        for index in 0..samples {
            let group = baked.map(|baked| &baked.group);
            self.march(&linear.view, (key, group), index, |count| {
                drawn += count;
                on_progress(drawn as f32 / all as f32);
            })
            .await?;
        }
        let mut encoder = encoder(&self.gpu);
        let [width, height] = self.size.map(|side| side as f32);
        let resolve = Resolve {
            scale: [1.0 / width, 1.0 / height],
            end: [1.0; 2],
            background: self.scene.background(),
            is_straight: 1,
            padding: [0; 3],
        };
        self.passes.resolve.encode(
            &self.gpu,
            &self.passes.layouts,
            &mut encoder,
            &resolve,
            [&linear.view, &output.view],
            &[[0, 0, self.size[0], self.size[1]]],
        );
        let reading = read_picture(&self.gpu, encoder, &output.texture);
        let image = reading.await?;
        if let Some(message) = self.gpu.take_errors().into_iter().next() {
            return Err(RenderError::Refused {
                pass: "picture",
                message,
            });
        }
        Ok(image)
    }
}
