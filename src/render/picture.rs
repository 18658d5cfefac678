use super::baked::BakedMap;
use super::follow::Follower;
use super::gpu_types::{Frame, Resolve};
use super::grid::GridCells;
use super::object::object_samples;
use super::passes::{LINEAR_FORMAT, OUTPUT_FORMAT, PICK_FORMAT, Passes};
use super::scene::{Prepared, frame_of};
use super::slice::{PendingSlice, SliceBoard, SlicePasses, SlicePlane, SliceScene, SliceView};
use super::subject::{SubjectTextures, Upload, entry, reduced_to_fit};
use super::{Gpu, Readback, RenderError, Sample, SubjectInfo, View, WorkDone, uniform_buffer};
use crate::data::{Segment, Volume};
use crate::document::Illustration;
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// Side of the squares a picture is drawn in, pixels: short enough that a weak GPU answers in time.
pub(super) const TILE: u32 = 64;
/// Pixels handed to the GPU before it is waited for: seconds at most on a software GPU.
const BATCH_PIXELS: u32 = 64 * TILE * TILE;

/// A finished picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// sRGB with straight alpha, rows from the top.
    pub rgba: Vec<u8>,
}

/// PNG bytes of a picture (sRGB).
///
/// # Errors
/// [`RenderError::Png`].
pub fn encode_png(image: &Image) -> Result<Vec<u8>, RenderError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.size[0], image.size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image.rgba)?;
    writer.finish()?;
    Ok(bytes)
}

/// Draws one picture without a window: uploads the volume, draws every sample, reads back. Deterministic on one adapter.
///
/// # Errors
/// What [`RenderError`] lists but shaders.
pub async fn render_image(
    gpu: &Gpu,
    illustration: &Illustration,
    volume: &Volume,
    size_px: [u32; 2],
    samples: u32,
) -> Result<Image, RenderError> {
    let studio = Studio::new(gpu, volume, true)?;
    studio.render_image(illustration, size_px, samples).await
}

/// A device with a volume on it, ready for pictures. What [`render_image`] makes each time, kept for several.
#[derive(Clone, Debug)]
pub struct Studio {
    pub(super) gpu: Gpu,
    pub(super) passes: Arc<Passes>,
    pub(super) subject: Arc<SubjectTextures>,
    pub(super) wants_grid: bool,
}

impl Studio {
    /// Uploads the volume. `wants_grid` false draws without the grid over the deformed space, to measure what it gains.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`].
    pub fn new(gpu: &Gpu, volume: &Volume, wants_grid: bool) -> Result<Self, RenderError> {
        let passes = Passes::new(gpu)?;
        let smaller = reduced_to_fit(gpu, volume)?;
        let volume = smaller.as_ref().map_or(volume, |(small, _)| small);
        let mut upload = Upload::new(gpu, volume)?;
        while !upload.advance(gpu, volume) {
            // Hands the slabs over now and then, so that they do not pile up.
            gpu.queue.submit([]);
        }
        let subject = upload.finish(gpu, &passes, volume);
        Ok(Self {
            gpu: gpu.clone(),
            passes: Arc::new(passes),
            subject: Arc::new(subject),
            wants_grid,
        })
    }

    /// What the volume is.
    pub fn info(&self) -> SubjectInfo {
        self.subject.info
    }

    /// The same volume, drawn with or without the grid.
    pub fn with_grid(&self, wants_grid: bool) -> Self {
        Self {
            wants_grid,
            ..self.clone()
        }
    }

    /// Draws one picture. The future owns what it needs.
    ///
    /// # Errors
    /// [`RenderError::BadSize`], [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub fn render_image(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        samples: u32,
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static {
        let shot = Shot::new(self, illustration, size_px);
        async move { shot?.develop(samples.max(1)).await }
    }

    /// Draws one picture from the baked map, with so many texels along its longest side: what is shown while the camera moves, where
    /// that is faster. Alignment and constraints are not in it. The future owns what it needs.
    ///
    /// # Errors
    /// As [`Studio::render_image`].
    pub fn render_baked(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        samples: u32,
        texels_along: Option<u32>,
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static {
        let shot = Shot::new(self, illustration, size_px);
        async move {
            let mut shot = shot?;
            shot.bake(texels_along);
            shot.develop(samples.max(1)).await
        }
    }

    /// The map of an illustration baked with so many texels along its longest side, read back.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn bake(
        &self,
        illustration: &Illustration,
        texels_along: Option<u32>,
    ) -> Result<BakedMap, RenderError> {
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, false);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        prepared.bake(&self.gpu, &self.passes, texels_along, u32::MAX);
        match prepared.baked() {
            Some(baked) => baked.read(&self.gpu).await,
            None => Err(RenderError::NoSubject),
        }
    }

    /// The grid over the deformed space of an illustration, as the ray march will read it; `None` for a studio without one.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn grid_cells(
        &self,
        illustration: &Illustration,
    ) -> Result<Option<GridCells>, RenderError> {
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, self.wants_grid);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        match prepared.grid() {
            Some(grid) => Ok(Some(grid.read(&self.gpu).await?)),
            None => Ok(None),
        }
    }

    /// Its named segments.
    pub fn segments(&self) -> &[Segment] {
        &self.subject.segments
    }

    /// What the object has at points of subject space when alignment and constraints count: where that material was at rest, and the
    /// composed continuity along its path, below 0 where there is nothing.
    ///
    /// # Errors
    /// [`RenderError::Shader`], [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn probe_object(
        &self,
        illustration: &Illustration,
        points: &[Vec3],
    ) -> Result<Vec<Sample>, RenderError> {
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, false);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        object_samples(&self.gpu, &self.subject, &prepared, points).await
    }

    /// Where points of the rest (rest space) are in the deformed object, subject space; `None` where their tissue is cut away.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn follow_points(
        &self,
        illustration: &Illustration,
        points_in_rest: &[Vec3],
    ) -> Result<Vec<Option<Vec3>>, RenderError> {
        if points_in_rest.is_empty() {
            return Ok(Vec::new());
        }
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, false);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        let mut follower = Follower::default();
        follower
            .find(&self.gpu, &self.subject, &prepared, points_in_rest)?
            .await
    }

    /// Distances as made for an illustration, read back: voxels along each axis, all slabs counted, and per voxel the four sets' signed
    /// distances. The first slab is smoothed; behind it lie the exact ones if there are constraints, and then the depth under the
    /// outer surface if a template is aligned to that. For tests and whoever wants to look.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn distances(
        &self,
        illustration: &Illustration,
    ) -> Result<([u32; 3], Vec<[f32; 4]>), RenderError> {
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, false);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        prepared.features().read(&self.gpu).await
    }

    /// What is at a point of the picture (pixels, origin top left). The future owns what it needs.
    pub fn pick(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        pixel: Vec2,
    ) -> impl Future<Output = Result<Option<Pick>, RenderError>> + 'static {
        let reading = self.start_pick(illustration, size_px, pixel);
        async move { reading?.await }
    }

    /// Draws one slice of the deformed object. The future owns what it needs.
    ///
    /// # Errors
    /// [`RenderError::BadSize`], [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub fn slice_image(
        &self,
        illustration: &Illustration,
        view: &SliceView,
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static {
        let reading = self.with_slices(illustration, |scene| {
            let mut board = SliceBoard::default();
            board.draw(0, view, scene)?;
            board.read(0, scene.gpu)
        });
        let gpu = self.gpu.clone();
        async move {
            let image = reading?.await?;
            match gpu.take_errors().into_iter().next() {
                Some(message) => Err(RenderError::Refused {
                    pass: "slice",
                    message,
                }),
                None => Ok(image),
            }
        }
    }

    /// What the deformed object has at each pixel of a slice, row by row from the top. The future owns what it needs.
    ///
    /// # Errors
    /// [`RenderError::BadSize`], [`RenderError::DeviceLost`].
    pub fn read_slice(
        &self,
        illustration: &Illustration,
        plane: &SlicePlane,
        size_px: [u32; 2],
    ) -> Result<PendingSlice, RenderError> {
        self.with_slices(illustration, |scene| scene.read(plane, size_px))
    }

    fn with_slices<T>(
        &self,
        illustration: &Illustration,
        run: impl FnOnce(&SliceScene<'_>) -> Result<T, RenderError>,
    ) -> Result<T, RenderError> {
        self.gpu.check()?;
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, false);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        run(&SliceScene {
            gpu: &self.gpu,
            passes: &SlicePasses::new(&self.gpu, &self.passes)?,
            subject: &self.subject,
            prepared: &prepared,
        })
    }

    pub(super) fn start_pick(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        pixel: Vec2,
    ) -> Result<PendingPick, RenderError> {
        let mut prepared = Prepared::new(&self.gpu, &self.passes, &self.subject, self.wants_grid);
        prepared.update(&self.gpu, &self.passes, &self.subject, illustration);
        let view = View::new(&illustration.camera, size_px);
        let has_labels = self.subject.uniform.label_dims[3] > 0.5;
        Ok(encode_pick(
            &self.gpu,
            &self.passes,
            &self.subject,
            &prepared,
            &view,
            pixel,
            has_labels,
        ))
    }
}

/// Everything for one picture, so that drawing it borrows nothing.
pub(super) struct Shot {
    gpu: Gpu,
    passes: Arc<Passes>,
    subject: Arc<SubjectTextures>,
    prepared: Prepared,
    view: View,
    size: [u32; 2],
}

impl Shot {
    pub(super) fn new(
        studio: &Studio,
        illustration: &Illustration,
        size: [u32; 2],
    ) -> Result<Self, RenderError> {
        studio.gpu.check()?;
        let max = studio.gpu.device.limits().max_texture_dimension_2d;
        if size.iter().any(|&side| side == 0 || side > max) {
            return Err(RenderError::BadSize {
                width: size[0],
                height: size[1],
                max,
            });
        }
        let mut prepared = Prepared::new(
            &studio.gpu,
            &studio.passes,
            &studio.subject,
            studio.wants_grid,
        );
        prepared.update(&studio.gpu, &studio.passes, &studio.subject, illustration);
        Ok(Self {
            view: View::new(&illustration.camera, size),
            gpu: studio.gpu.clone(),
            passes: Arc::clone(&studio.passes),
            subject: Arc::clone(&studio.subject),
            prepared,
            size,
        })
    }

    /// From now on drawn from the baked map.
    pub(super) fn bake(&mut self, texels_along: Option<u32>) {
        self.prepared
            .bake(&self.gpu, &self.passes, texels_along, u32::MAX);
    }

    /// Draws it, from the start each time.
    pub(super) async fn develop(&self, samples: u32) -> Result<Image, RenderError> {
        let linear = Target::new(&self.gpu, "linear", self.size, LINEAR_FORMAT);
        let output = Target::new(&self.gpu, "image", self.size, OUTPUT_FORMAT);
        let baked = self.prepared.baked();
        let key = match baked {
            Some(_) => self.prepared.baked_key(),
            None => self.prepared.key(false),
        };
        let pipeline = self.passes.raycast(&self.gpu, key);
        let tiles = tiles_of(self.size);
        for index in 0..samples {
            let frame = frame_of(
                &self.view,
                self.prepared.bounds,
                &self.subject,
                index,
                false,
            );
            let frame_group = frame_group(&self.gpu, &self.passes, &frame);
            for batch in tiles.chunks((BATCH_PIXELS / (TILE * TILE)) as usize) {
                let mut encoder = encoder(&self.gpu);
                encode_march(
                    &mut encoder,
                    &March {
                        target: &linear.view,
                        pipeline: &pipeline,
                        frame: &frame_group,
                        subject: &self.subject.bind_group,
                        scene: &self.prepared.scene.bind_group,
                        baked: baked.map(|baked| &baked.group),
                        viewport: self.size,
                        tiles: batch,
                        weight: 1.0 / (index + 1) as f32,
                    },
                );
                self.gpu.queue.submit([encoder.finish()]);
                WorkDone::start(&self.gpu).await?;
                self.gpu.check()?;
            }
        }
        let mut encoder = encoder(&self.gpu);
        let [width, height] = self.size.map(|side| side as f32);
        let resolve = Resolve {
            scale: [1.0 / width, 1.0 / height, 1.0, 1.0],
            background: self.prepared.background,
            flags: [1, 0, 0, 0],
        };
        encode_resolve(
            &self.gpu,
            &self.passes,
            &mut encoder,
            &resolve,
            &linear.view,
            &output.view,
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

/// Starts reading a picture of four bytes per pixel after the encoder's work.
pub(super) fn read_picture(
    gpu: &Gpu,
    encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
) -> impl Future<Output = Result<Image, RenderError>> + use<> {
    let size = [texture.width(), texture.height()];
    let pitch = (size[0] * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let reading = read_texture(gpu, encoder, texture, pitch);
    async move {
        let bytes = reading.await?;
        let rows = bytes.chunks_exact(pitch as usize);
        let rgba = rows
            .flat_map(|row| row.iter().take(4 * size[0] as usize))
            .copied()
            .collect();
        Ok(Image { size, rgba })
    }
}

/// Starts reading a whole texture after the encoder's work. Rows are `pitch` bytes apart.
pub(super) fn read_texture(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    pitch: u32,
) -> Readback {
    let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(pitch) * u64::from(texture.height()),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(pitch),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    Readback::start(gpu, staging)
}

/// A texture to draw into.
#[derive(Debug)]
pub(super) struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Target {
    pub(super) fn new(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width: size[0].max(1),
                height: size[1].max(1),
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        Self {
            view: texture.create_view(&Default::default()),
            texture,
        }
    }
}

pub(super) fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&Default::default())
}

/// Tiles (x, y, width, height) that cover a picture, from its middle outwards: what is looked at comes first.
pub(super) fn tiles_of(size: [u32; 2]) -> Vec<[u32; 4]> {
    let mut tiles = Vec::new();
    for y in (0..size[1]).step_by(TILE as usize) {
        for x in (0..size[0]).step_by(TILE as usize) {
            tiles.push([x, y, TILE.min(size[0] - x), TILE.min(size[1] - y)]);
        }
    }
    let [width, height] = size;
    tiles.sort_by_key(|&[x, y, w, h]| {
        let dx = i64::from(2 * x + w) - i64::from(width);
        let dy = i64::from(2 * y + h) - i64::from(height);
        dx * dx + dy * dy
    });
    tiles
}

/// Group 0 of one frame.
pub(super) fn frame_group(gpu: &Gpu, passes: &Passes, frame: &Frame) -> wgpu::BindGroup {
    let buffer = uniform_buffer(gpu, "frame", frame);
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout: &passes.frame_layout,
        entries: &[entry(0, buffer.as_entire_binding())],
    })
}

/// One ray march pass.
pub(super) struct March<'a> {
    pub target: &'a wgpu::TextureView,
    pub pipeline: &'a wgpu::RenderPipeline,
    pub frame: &'a wgpu::BindGroup,
    pub subject: &'a wgpu::BindGroup,
    pub scene: &'a wgpu::BindGroup,
    /// For pipelines that draw from the baked map.
    pub baked: Option<&'a wgpu::BindGroup>,
    /// Pixels of the target in use, from its top left.
    pub viewport: [u32; 2],
    pub tiles: &'a [[u32; 4]],
    /// Weight against what the target holds: 1 overwrites.
    pub weight: f32,
}

/// Adds a ray march to the encoder.
pub(super) fn encode_march(encoder: &mut wgpu::CommandEncoder, march: &March<'_>) {
    let mut pass = render_pass(encoder, "raycast", march.target);
    pass.set_pipeline(march.pipeline);
    pass.set_bind_group(0, march.frame, &[]);
    pass.set_bind_group(1, march.subject, &[]);
    pass.set_bind_group(2, march.scene, &[]);
    if let Some(baked) = march.baked {
        pass.set_bind_group(3, baked, &[]);
    }
    let weight = f64::from(march.weight);
    pass.set_blend_constant(wgpu::Color {
        r: weight,
        g: weight,
        b: weight,
        a: weight,
    });
    let [width, height] = march.viewport.map(|side| side as f32);
    pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
    for &[x, y, w, h] in march.tiles {
        pass.set_scissor_rect(x, y, w, h);
        pass.draw(0..3, 0..1);
    }
}

pub(super) fn render_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    target: &wgpu::TextureView,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    })
}

/// Adds the way from the linear picture to the shown one.
pub(super) fn encode_resolve(
    gpu: &Gpu,
    passes: &Passes,
    encoder: &mut wgpu::CommandEncoder,
    resolve: &Resolve,
    source: &wgpu::TextureView,
    target: &wgpu::TextureView,
    tiles: &[[u32; 4]],
) {
    let buffer = uniform_buffer(gpu, "resolve", resolve);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("resolve"),
        layout: &passes.resolve_layout,
        entries: &[
            entry(0, buffer.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(source)),
            entry(2, wgpu::BindingResource::Sampler(&passes.linear_sampler)),
        ],
    });
    let mut pass = render_pass(encoder, "resolve", target);
    pass.set_pipeline(passes.resolve());
    pass.set_bind_group(3, &group, &[]);
    for &[x, y, w, h] in tiles {
        pass.set_scissor_rect(x, y, w, h);
        pass.draw(0..3, 0..1);
    }
}

/// What is under a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Where the surface is, subject space (deformed).
    pub pos_in_subject: Vec3,
    /// Unit normal towards the eye, subject space.
    pub normal: Vec3,
    /// Where it was before any template acted.
    pub pos_in_rest: Vec3,
    /// Value of the volume there.
    pub value: f32,
    /// Label of the segment there, if the subject has segments and it belongs to one.
    pub segment: Option<u16>,
    /// Distance from the eye, subject units.
    pub depth: f32,
}

/// A pick on its way back. Await it, or ask once per frame.
#[derive(Debug)]
pub struct PendingPick {
    reading: Readback,
    has_labels: bool,
}

impl PendingPick {
    /// The answer if it has come; does not wait. `Some(Ok(None))`: there is nothing under the pixel.
    pub fn poll_now(&mut self) -> Option<Result<Option<Pick>, RenderError>> {
        let has_labels = self.has_labels;
        self.reading
            .poll_now()
            .map(|bytes| bytes.map(|b| read_pick(&b, has_labels)))
    }
}

impl Future for PendingPick {
    type Output = Result<Option<Pick>, RenderError>;

    fn poll(
        mut self: std::pin::Pin<&mut Self>,
        context: &mut std::task::Context<'_>,
    ) -> std::task::Poll<Self::Output> {
        let has_labels = self.has_labels;
        std::pin::Pin::new(&mut self.reading)
            .poll(context)
            .map(|bytes| bytes.map(|b| read_pick(&b, has_labels)))
    }
}

fn read_pick(bytes: &[u8], has_labels: bool) -> Option<Pick> {
    let floats: Vec<f32> = bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let quad = |i: usize| -> Option<[f32; 4]> {
        floats.get(4 * i..4 * i + 4).and_then(|q| q.try_into().ok())
    };
    let ([x, y, z, depth], [nx, ny, nz, label], [rx, ry, rz, value]) =
        (quad(0)?, quad(1)?, quad(2)?);
    (depth >= 0.0).then_some(Pick {
        pos_in_subject: Vec3::new(x, y, z),
        normal: Vec3::new(nx, ny, nz),
        pos_in_rest: Vec3::new(rx, ry, rz),
        value,
        segment: (has_labels && label > 0.5).then_some(label as u16),
        depth,
    })
}

/// Marches one ray and starts reading what it found.
pub(super) fn encode_pick(
    gpu: &Gpu,
    passes: &Passes,
    subject: &SubjectTextures,
    prepared: &Prepared,
    view: &View,
    pixel: Vec2,
    has_labels: bool,
) -> PendingPick {
    let frame = Frame {
        pick: [pixel.x, pixel.y, 0.0, 0.0],
        ..frame_of(view, prepared.bounds, subject, 0, false)
    };
    let target = Target::new(gpu, "pick", [4, 1], PICK_FORMAT);
    let pipeline = passes.raycast(gpu, prepared.key(true));
    let mut encoder = encoder(gpu);
    encode_march(
        &mut encoder,
        &March {
            target: &target.view,
            pipeline: &pipeline,
            frame: &frame_group(gpu, passes, &frame),
            subject: &subject.bind_group,
            scene: &prepared.scene.bind_group,
            baked: None,
            viewport: [4, 1],
            tiles: &[[0, 0, 4, 1]],
            weight: 1.0,
        },
    );
    PendingPick {
        reading: read_texture(
            gpu,
            encoder,
            &target.texture,
            wgpu::COPY_BYTES_PER_ROW_ALIGNMENT,
        ),
        has_labels,
    }
}
