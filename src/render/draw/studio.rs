//! Pictures without a window.

use super::identify::{Sighting, identify};
use super::image::Image;
use super::object::object_samples;
use super::paper_shadow::{OnPaper, PaperShadow, SHADOW_SAMPLES};
use super::passes::Passes;
use super::pick::{Pick, PickScene, RayEvent};
use super::picture::PictureJob;
use super::probe::Sample;
use super::rows::{PictureSpec, Taker, band_rows};
use super::slice::{PendingSlice, SliceBoard, SlicePlane, SliceScene, SliceView};
use crate::data::{Grids, Resources, Segment, Subject};
use crate::document::{Background, Clay, Illustration, Light};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::pack::gpu_types::Affine;
use crate::render::pack::values::SubjectInfo;
use crate::render::pack::view::View;
use crate::render::scene::Scene;
use crate::render::stage::baked::BakedMap;
use crate::render::stage::skip_grid::GridCells;
use crate::render::subject::textures::SubjectTextures;
use crate::render::subject::upload::{Upload, fitting};
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// Rays that are read back at a time: each is a row of a texture.
const RAYS_AT_ONCE: usize = 1024;

/// Draws one picture without a window: uploads the subject, draws every sample, reads back. Deterministic on one
/// adapter.
///
/// # Errors
/// What [`RenderError`] lists but shaders.
pub async fn render_image(
    gpu: &Gpu,
    illustration: &Illustration,
    subject: &Subject,
    size_px: [u32; 2],
    samples: u32,
) -> Result<Image, RenderError> {
    let studio = Studio::new(gpu, subject, true)?;
    studio.render_image(illustration, size_px, samples).await
}

/// A device with a subject on it, ready for pictures. What [`render_image`] makes each time, kept for several.
#[derive(Clone, Debug)]
pub struct Studio {
    pub(crate) gpu: Gpu,
    pub(crate) passes: Arc<Passes>,
    pub(crate) subject: Arc<SubjectTextures>,
    pub(crate) wants_grid: bool,
    pub(crate) resources: Resources,
}

impl Studio {
    /// Uploads the subject. `wants_grid` false draws without the skip grid, to measure its gain.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`].
    pub fn new(gpu: &Gpu, subject: &Subject, wants_grid: bool) -> Result<Self, RenderError> {
        let passes = Passes::of(gpu);
        let (fitting, _) = fitting(gpu, subject)?;
        let mut upload = Upload::new(gpu, &fitting)?;
        while !upload.advance(gpu) {
            // Hands the pieces over now and then, so that they do not pile up.
            gpu.queue.submit([]);
        }
        let subject = upload.finish(gpu, &passes.layouts);
        Ok(Self {
            gpu: gpu.clone(),
            passes,
            subject: Arc::new(subject),
            wants_grid,
            resources: Resources::default(),
        })
    }

    /// The same volume, with what has come of the files that illustrations name besides: the samples of their fields.
    pub fn with_resources(self, resources: Resources) -> Self {
        Self { resources, ..self }
    }

    fn scene(&self, illustration: &Illustration, wants_grid: bool) -> Scene {
        let shown = (illustration, &self.resources);
        self.passes
            .scene(&self.gpu, &self.subject, shown, wants_grid)
    }

    /// Makes everything ready for one picture.
    ///
    /// # Errors
    /// [`RenderError::BadSize`], [`RenderError::DeviceLost`].
    pub(crate) fn picture(
        &self,
        illustration: &Illustration,
        size: [u32; 2],
    ) -> Result<PictureJob, RenderError> {
        self.gpu.check()?;
        PictureJob::check_size(&self.gpu, size)?;
        Ok(PictureJob {
            view: View::new(&illustration.camera, size),
            scene: Box::new(self.scene(illustration, self.wants_grid)),
            gpu: self.gpu.clone(),
            passes: Arc::clone(&self.passes),
            subject: Arc::clone(&self.subject),
            size,
            band_rows: band_rows(size[0]),
            is_quick: false,
        })
    }

    /// What the subject is.
    pub fn info(&self) -> SubjectInfo {
        self.subject.info
    }

    /// This studio, drawing with or without the skip grid.
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
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static + use<> {
        self.render_with_progress(illustration, size_px, samples, |_| {})
    }

    /// As [`Studio::render_image`]; `on_progress` hears how much of the picture is drawn, 0 to 1.
    pub(crate) fn render_with_progress<P: Fn(f32) + 'static>(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        samples: u32,
        on_progress: P,
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static + use<P> {
        let job = self.picture(illustration, size_px);
        async move { job?.draw(samples.max(1), on_progress).await }
    }

    /// Draws one picture from the top and hands its rows over as they are done; gives the taker back. No more than some
    /// rows are in memory at once, `rows_at_once` or as many as are drawn well. The pixels are those of
    /// [`Studio::render_image`], to the bit; a shadow is made of a small picture that is drawn first. The future owns
    /// what it needs.
    ///
    /// # Errors
    /// As [`Studio::render_image`], and what the taker returns.
    pub fn render_rows<T: Taker + 'static>(
        &self,
        illustration: &Illustration,
        spec: PictureSpec,
        rows_at_once: Option<u32>,
        mut taker: T,
    ) -> impl Future<Output = Result<T, RenderError>> + 'static + use<T> {
        let PictureSpec {
            size_px,
            samples,
            has_shadow,
        } = spec;
        let look = &illustration.look;
        let (background, light) = (
            look.background,
            look.light.unwrap_or(Light::DOCUMENT_DEFAULT),
        );
        let (job, small) = if has_shadow {
            let mut clear = illustration.clone();
            clear.look.background = Background::None;
            let small = self.render_image(&clear, PaperShadow::small_size(size_px), SHADOW_SAMPLES);
            (self.picture(&clear, size_px), Some(small))
        } else {
            (self.picture(illustration, size_px), None)
        };
        async move {
            let mut job = job?;
            job.band_rows = rows_at_once.unwrap_or(job.band_rows);
            let samples = samples.max(1);
            let Some(small) = small else {
                job.draw_rows(samples, &mut taker).await?;
                return Ok(taker);
            };
            let shadow = PaperShadow::new(&small.await?, size_px, background, &light);
            let mut on_paper = OnPaper { taker, shadow };
            job.draw_rows(samples, &mut on_paper).await?;
            Ok(on_paper.taker)
        }
    }

    /// Draws one picture from the baked map, with so many texels along its longest side, as the viewer does
    /// while the camera moves, where that is faster. The baked map holds no alignment and no constraints. The future
    /// owns its resources.
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
        let job = self.picture(illustration, size_px);
        async move {
            let mut job = job?;
            job.bake(texels_along);
            job.draw(samples.max(1), |_| {}).await
        }
    }

    /// Draws one picture from the exact map as the viewer does while the camera moves, in all of its pixels. The future
    /// owns its resources.
    ///
    /// # Errors
    /// As [`Studio::render_image`].
    pub fn render_quick(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        samples: u32,
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static {
        let job = self.picture(illustration, size_px);
        async move {
            let mut job = job?;
            job.is_quick = true;
            job.draw(samples.max(1), |_| {}).await
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
        let mut scene = self.scene(illustration, false);
        self.passes
            .bake(&self.gpu, &mut scene, texels_along, u32::MAX);
        match scene.baked() {
            Some(baked) => baked.read(&self.gpu).await,
            None => Err(RenderError::NoSubject),
        }
    }

    /// The skip grid of an illustration, as the ray march will read it; `None` for a studio
    /// without one.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn grid_cells(
        &self,
        illustration: &Illustration,
    ) -> Result<Option<GridCells>, RenderError> {
        let scene = self.scene(illustration, self.wants_grid);
        match scene.grid() {
            Some(grid) => Ok(Some(grid.read(&self.gpu).await?)),
            None => Ok(None),
        }
    }

    /// The recipe of the subject, if it is a clay, and the grids of tools.
    pub fn clay(&self) -> Option<(&Arc<Clay>, &Grids)> {
        let clay = self.resources.clay.as_ref()?;
        Some((clay, &self.resources.grids))
    }

    /// What the labels of [`Studio::identify`] stand for: the segments of the subject, or the regions of a figure.
    pub fn sighted(&self) -> Vec<Segment> {
        let sheet = self.resources.sheet.as_ref();
        match sheet.filter(|_| self.subject.plate.is_some()) {
            Some(sheet) => sheet.segments(),
            None => self.segments().to_vec(),
        }
    }

    /// Named segments of the subject.
    pub fn segments(&self) -> &[Segment] {
        &self.subject.segments
    }

    /// What the object has at points of subject space when alignment and constraints count: where that material was
    /// at rest, and the composed continuity along its path, below 0 where there is nothing.
    ///
    /// # Errors
    /// [`RenderError::Shader`], [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn probe_object(
        &self,
        illustration: &Illustration,
        points: &[Vec3],
    ) -> Result<Vec<Sample>, RenderError> {
        let scene = self.scene(illustration, false);
        object_samples(
            &self.gpu,
            &self.passes.probes,
            &self.subject,
            &scene,
            points,
        )
        .await
    }

    /// Where points of the rest (rest space) are in the deformed object, subject space; `None` where their tissue is
    /// cut away.
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
        let scene = self.scene(illustration, false);
        self.passes
            .follower
            .find(&self.gpu, &self.subject, &scene, points_in_rest)
            .await
    }

    /// Distances as made for an illustration, read back: voxels along each axis, all slabs counted, and per voxel the
    /// four sets' signed distances. The first slab is smoothed; behind it lie the exact ones if there are
    /// constraints, and then the depth under the outer surface if a template is aligned to that. For tests and
    /// whoever wants to look.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn distances(
        &self,
        illustration: &Illustration,
    ) -> Result<([u32; 3], Vec<[f32; 4]>), RenderError> {
        let scene = self.scene(illustration, false);
        scene.kept_textures().read(&self.gpu).await
    }

    /// What was found of the map as a whole for an illustration, read back: four for each enabled template, at the
    /// place of the first of its group. Of segments that move as a whole the motions of the four sets, subject space to
    /// rest space; of what gives way by its coordinate, the longest displacement in the first number of the first. For
    /// tests and whoever wants to look.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn motions(&self, illustration: &Illustration) -> Result<Vec<Affine>, RenderError> {
        let scene = self.scene(illustration, false);
        scene.kept_textures().read_motions(&self.gpu).await
    }

    /// The surface at a point of the picture (pixels, origin top left). The future owns its resources.
    pub fn pick(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        pixel: Vec2,
    ) -> impl Future<Output = Result<Option<Pick>, RenderError>> + 'static {
        self.with_picks(illustration, size_px, |picks| picks.pick(pixel))
    }

    /// How far from the eye the surface is under each of at least one pixel (origin top left), subject units; `None`
    /// where there is nothing. All are asked in one pass. The future owns its resources.
    pub fn depths(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        pixels: &[Vec2],
    ) -> impl Future<Output = Result<Vec<Option<f32>>, RenderError>> + 'static {
        self.with_picks(illustration, size_px, |picks| picks.depths(pixels))
    }

    /// Where each ray of subject space (origin, unit direction) turns more than half opaque, by what draws the picture
    /// at rest; `None` for one that does not.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub async fn events(
        &self,
        illustration: &Illustration,
        rays: &[(Vec3, Vec3)],
    ) -> Result<Vec<Option<RayEvent>>, RenderError> {
        let mut events = Vec::with_capacity(rays.len());
        for some in rays.chunks(RAYS_AT_ONCE) {
            let asked = self.with_picks(illustration, [1; 2], |picks| picks.events(some));
            events.extend(asked.await?);
        }
        Ok(events)
    }

    /// What each pixel of a picture shows: the object or not, and which of its segments. The future owns what it needs.
    ///
    /// # Errors
    /// As [`Studio::render_image`].
    pub fn identify(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
    ) -> impl Future<Output = Result<Sighting, RenderError>> + 'static + use<> {
        let job = self.picture(illustration, size_px);
        async move { identify(&job?).await }
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
        let scene = self.scene(illustration, false);
        run(&SliceScene {
            gpu: &self.gpu,
            passes: &self.passes.slices,
            subject: &self.subject,
            scene: &scene,
        })
    }

    fn with_picks<T>(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
        ask: impl FnOnce(&PickScene<'_>) -> T,
    ) -> T {
        ask(&PickScene {
            gpu: &self.gpu,
            passes: &self.passes,
            subject: &self.subject,
            scene: &self.scene(illustration, self.wants_grid),
            view: &View::new(&illustration.camera, size_px),
        })
    }
}
