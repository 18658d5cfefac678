use super::clock::Clock;
use super::follow::PendingPlaces;
use super::identify::Sighting;
use super::image::{Image, read_picture};
use super::pace::{Pace, Work};
use super::passes::Passes;
use super::pick::{PendingDepths, PendingPick, PickScene};
use super::quality::{WholePicture, least_scale, samples, steady_scale};
use super::raycast::sample_weight;
use super::rows::{PictureSpec, Taker};
use super::slice::{PendingSlice, SliceBoard, SlicePlane, SliceScene, SliceView};
use super::studio::Studio;
use super::targets::{Shot, Targets, fitting_size};
use crate::data::{Grids, Resources, Segment, Segmentation, Sheet, Subject, Surface};
use crate::document::{Camera, Clay, Illustration};
use crate::math::Aabb;
use crate::render::device::bindings::encoder;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::WorkDone;
use crate::render::pack::frame::frame_of;
use crate::render::pack::notice::RenderNotice;
use crate::render::pack::values::SubjectInfo;
use crate::render::pack::view::View;
use crate::render::scene::Scene;
use crate::render::subject::upload::{Upload, fitting, with_segmentation};
use glam::{Vec2, Vec3};
use std::sync::Arc;
use std::task::Waker;

/// Samples per pixel of the finished picture.
const SAMPLES_HARDWARE: u32 = 16;
const SAMPLES_SOFTWARE: u32 = 5;

/// Refining waits so long after the last change, so that a drag is not slowed down by tiles nobody will see, seconds.
const CALM_SECONDS: f64 = 0.12;

/// Where anything at all takes the device longer, seconds, the interface is drawn first and the picture a frame later.
const SLOW_TO_ANSWER: f64 = 0.04;

/// First guesses of the cost of a pixel, seconds; measured from then on.
const FIRST_COST_SOFTWARE: f64 = 2.5e-6;
const FIRST_COST_HARDWARE: f64 = 3.0e-8;

/// A pixel of the baked map is taken to cost so much of one of the formulas until it was measured.
const BAKED_HOPE: f64 = 0.5;

/// State of the picture after [`Renderer::draw`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawState {
    /// Nothing is left to do: no repaint is needed until something changes.
    pub is_done: bool,
    /// Part of the refinement that is done, 0 to 1.
    pub progress: f32,
    /// There is a picture in [`Renderer::output_view`].
    pub has_picture: bool,
    /// That picture is of what was to be shown before: nothing has been drawn since the last change.
    pub is_behind: bool,
    /// A subject is on its way to the GPU: fraction done.
    pub uploading: Option<f32>,
    /// It waits until nobody does anything: no repaint is needed until [`Renderer::draw`] is told so.
    pub is_held: bool,
    /// Seconds that the device takes for a whole picture at rest, of one sample per pixel, as far as was measured.
    pub whole_seconds: Option<f32>,
}

/// Draws progressively: at once at the resolution that holds the frame rate, then, tile by tile, the full picture.
///
/// Call [`Renderer::draw`] once per frame. It never waits for the GPU, keeps at most one submission under way, and
/// hands in no more work than fits the time budget, measured on this device as it goes.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    clock: Clock,
    studio: Option<Studio>,
    subject: Option<Subject>,
    upload: Option<(Upload, Subject)>,
    /// Shown in place of the segments that the subject came with.
    labels: Option<Option<Arc<Segmentation>>>,
    /// What the device has, made smaller where it was too large.
    fitting: Option<Subject>,
    notices: Vec<RenderNotice>,
    illustration: Option<Illustration>,
    resources: Resources,
    scene: Option<Scene>,
    targets: Option<Targets>,
    stage: Stage,
    changed_at: f64,
    /// When somebody last did something, see [`Renderer::hold`].
    held_at: f64,
    /// The picture at rest has changed, and the interface goes first.
    is_after_interface: bool,
    pace: Pace,
    /// Scale of the last quick picture.
    quick_scale: Option<f32>,
    whole: WholePicture,
    /// The quick picture by the formulas could not hold the full resolution.
    is_coarse: bool,
    under_way: Option<UnderWay>,
    generation: u64,
    slices: SliceBoard,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    /// The picture that is shown is not yet the one that should be.
    Stale,
    /// The quick picture is out; sample `sample` is drawn from tile `tile` on.
    Refining {
        sample: u32,
        tile: usize,
    },
    Done,
}

#[derive(Debug)]
struct UnderWay {
    done: WorkDone,
    started: f64,
    pixels: u32,
    work: Work,
    /// These are the last tiles of a sample.
    ends_sample: bool,
    checks: u32,
}

impl Renderer {
    /// Cheap: programs are compiled when the first picture is drawn.
    pub fn new(gpu: Gpu, clock: Clock) -> Self {
        let cost = if gpu.is_software() {
            FIRST_COST_SOFTWARE
        } else {
            FIRST_COST_HARDWARE
        };
        Self {
            gpu,
            clock,
            studio: None,
            subject: None,
            upload: None,
            labels: None,
            fitting: None,
            notices: Vec::new(),
            illustration: None,
            resources: Resources::default(),
            scene: None,
            targets: None,
            stage: Stage::Stale,
            changed_at: f64::NEG_INFINITY,
            held_at: f64::NEG_INFINITY,
            is_after_interface: false,
            pace: Pace::new([cost, BAKED_HOPE * cost, 1.5 * cost, 0.05 * cost]),
            quick_scale: None,
            whole: WholePicture::default(),
            is_coarse: false,
            under_way: None,
            generation: 0,
            slices: SliceBoard::default(),
        }
    }

    /// The device it draws on.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Shows another subject as soon as it is on the GPU ([`Renderer::draw`] brings it there piece by piece); until
    /// then the old one stays. The subject is kept, so that a lost device can be recovered from.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if the subject is not whole.
    pub fn set_subject(&mut self, subject: Subject) -> Result<(), RenderError> {
        self.gpu.check()?;
        let (fitting, reduction) = fitting(&self.gpu, &subject)?;
        self.notices.extend(reduction.map(RenderNotice::Reduced));
        self.upload = Some((Upload::new(&self.gpu, &fitting)?, fitting));
        self.subject = Some(subject);
        self.labels = None;
        Ok(())
    }

    /// Shows the subject with other segments than it came with, from when it is on the GPU on; for
    /// [`Renderer::set_subject`]'s last subject.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if the device does not take them.
    pub fn set_segmentation(
        &mut self,
        labels: Option<Arc<Segmentation>>,
    ) -> Result<(), RenderError> {
        self.labels = Some(labels);
        match self.upload {
            Some(_) => Ok(()),
            None => self.take_segmentations(),
        }
    }

    fn take_segmentations(&mut self) -> Result<(), RenderError> {
        match self.labels.is_some() {
            true => self.make_subject_anew(),
            false => Ok(()),
        }
    }

    /// Makes what is around the values anew: segments and meshes.
    fn make_subject_anew(&mut self) -> Result<(), RenderError> {
        if let (Some(studio), Some(fitting)) = (&mut self.studio, &self.fitting) {
            let labels = match &self.labels {
                Some(labels) => labels.as_deref(),
                None => fitting
                    .values()
                    .and_then(|volume| volume.segmentation.as_ref()),
            };
            let (gpu, layouts) = (&self.gpu, &studio.passes.layouts);
            let subject = with_segmentation(&studio.subject, gpu, layouts, fitting, labels)?;
            studio.subject = Arc::new(subject);
            self.scene = None;
            self.slices.forget();
            self.touch();
        }
        Ok(())
    }

    /// Shows these meshes beside the volume from when it is on the GPU on; call it every frame. Does nothing where they
    /// are shown, or where another renderer has the subject. Meshes that the device does not take are left out, with a
    /// notice.
    pub fn set_meshes(&mut self, meshes: Option<&Arc<Surface>>) {
        let shown = match (&self.upload, &self.fitting) {
            (None, Some(fitting @ Subject::Space(_))) => fitting.clone(),
            _ => return,
        };
        if shown.surface().map(Arc::as_ptr) == meshes.map(Arc::as_ptr) {
            return;
        }
        self.fitting = Some(shown.with_meshes(meshes.cloned()));
        self.subject = (self.subject.take()).map(|subject| subject.with_meshes(meshes.cloned()));
        if let Err(error) = self.make_subject_anew() {
            self.notices
                .push(RenderNotice::MeshesTooLarge(error.to_string()));
        }
    }

    /// Shows the subject that another renderer on the same device shows; the subject is on the device once.
    pub fn share_subject(&mut self, other: &Self) {
        let is_same = match (&self.studio, &other.studio) {
            (Some(mine), Some(theirs)) => Arc::ptr_eq(&mine.subject, &theirs.subject),
            (None, None) => true,
            _ => false,
        };
        if !is_same {
            self.studio = other.studio.clone();
            self.scene = None;
            self.slices.forget();
            self.touch();
        }
    }

    /// Shows this illustration from the next [`Renderer::draw`] on. Cheap; call it every frame.
    pub fn set_illustration(&mut self, illustration: &Illustration) {
        if let Some(shown) = &self.illustration
            && shown.templates == illustration.templates
            && shown.look == illustration.look
            && shown.camera == illustration.camera
            && shown.subject == illustration.subject
            && shown.objects == illustration.objects
        {
            return;
        }
        self.illustration = Some(illustration.clone());
        self.touch();
    }

    /// Draws illustrations with what has come of the files that they name, from the next [`Renderer::draw`] on: the
    /// samples of their fields and the meshes of their objects.
    pub fn set_resources(&mut self, resources: Resources) {
        if resources.fields != self.resources.fields
            || !resources.has_objects_of(&self.resources)
            || !Sheet::are_same(resources.sheet.as_ref(), self.sheet())
        {
            self.touch();
        }
        self.resources = resources;
    }

    /// The bent figure that is drawn, if the subject is one.
    pub fn sheet(&self) -> Option<&Sheet> {
        self.resources.sheet.as_ref()
    }

    /// The recipe of the subject, if it is a clay, and the grids of tools.
    pub fn clay(&self) -> Option<(&Arc<Clay>, &Grids)> {
        let clay = self.resources.clay.as_ref()?;
        Some((clay, &self.resources.grids))
    }

    /// Looks from elsewhere than the illustration says, until that is set again.
    pub fn set_camera(&mut self, camera: &Camera) {
        if let Some(shown) = &mut self.illustration
            && shown.camera != *camera
        {
            shown.camera = *camera;
            self.touch();
        }
    }

    fn touch(&mut self) {
        // What moves is drawn in every frame.
        let is_first = (self.clock)() - self.changed_at > CALM_SECONDS;
        self.is_after_interface = is_first && self.pace.shortest() > SLOW_TO_ANSWER;
        self.stage = Stage::Stale;
        self.changed_at = (self.clock)();
    }

    /// Somebody does something: tiles wait as after a change, so that the answer has not to wait for them.
    pub fn hold(&mut self) {
        self.held_at = (self.clock)();
    }

    /// Wakes as soon as the work under way is done. False if there is none, or if [`Renderer::draw`] has to be called
    /// to find out (natively).
    pub fn wake_when_done(&self, waker: &Waker) -> bool {
        let under_way = self.under_way.as_ref();
        under_way.is_some_and(|work| work.done.wake_when_done(waker))
    }

    /// One frame's work: `size_px` is the size of the picture in device pixels, `budget_seconds` what the GPU may
    /// spend on it. `is_moving` says that more changes are about to come (a drag, an animation): then nothing is
    /// refined.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`] (then [`Renderer::recover`]), [`RenderError::Refused`].
    pub fn draw(
        &mut self,
        size_px: [u32; 2],
        budget_seconds: f32,
        is_moving: bool,
    ) -> Result<DrawState, RenderError> {
        self.gpu.check()?;
        let polled = self.gpu.device.poll(wgpu::PollType::Poll);
        // The loss is reported while polling.
        self.gpu.check()?;
        if let Err(why) = polled {
            return Err(RenderError::Refused {
                pass: "frame",
                message: why.to_string(),
            });
        }
        if let Some(message) = self.gpu.take_errors().into_iter().next() {
            return Err(RenderError::Refused {
                pass: "picture",
                message,
            });
        }
        let budget = f64::from(budget_seconds).max(1e-3);
        self.advance_upload(budget)?;
        self.measure();
        let size = fitting_size(&self.gpu, size_px);
        if self.targets.as_ref().is_none_or(|t| t.size != size) && size.iter().all(|&s| s > 0) {
            self.make_targets(size);
        }
        let mut is_held = false;
        if self.prepare() && self.targets.is_some() {
            // Two submissions in line would show every change a frame late; a resize cannot wait, its picture is empty.
            let is_blank = self.generation_is_blank();
            if self.under_way.is_none() || is_blank {
                match self.stage {
                    Stage::Stale if self.is_after_interface && !is_blank => {
                        self.is_after_interface = false;
                    }
                    Stage::Stale => self.draw_quick(budget),
                    Stage::Refining { sample, tile } if !is_moving || self.is_calm() => {
                        if !self.bake(budget) {
                            self.refine(sample, tile, budget);
                        }
                    }
                    Stage::Refining { .. } => is_held = true,
                    Stage::Done => {}
                }
            }
        }
        Ok(DrawState {
            is_held,
            ..self.state()
        })
    }

    fn is_calm(&self) -> bool {
        (self.clock)() - self.changed_at.max(self.held_at) > CALM_SECONDS
    }

    /// The picture: Rgba8Unorm, sRGB-encoded, premultiplied after encoding. Made anew when the size changes; see
    /// [`Renderer::output_generation`].
    pub fn output_view(&self) -> Option<&wgpu::TextureView> {
        self.targets.as_ref().map(|t| &t.output.view)
    }

    /// Copies the picture to a texture of its size and format, such as that of a canvas.
    pub fn copy_output(&self, to: &wgpu::Texture) {
        if let Some(targets) = &self.targets {
            let mut encoder = encoder(&self.gpu);
            let from = targets.output.texture.as_image_copy();
            encoder.copy_texture_to_texture(from, to.as_image_copy(), to.size());
            self.gpu.queue.submit([encoder.finish()]);
        }
    }

    /// True if the next movement is drawn from the baked map, as far as that is faster.
    pub fn has_baked(&self) -> bool {
        self.scene.as_ref().is_some_and(|p| p.baked().is_some())
    }

    /// Counts the textures that [`Renderer::output_view`] has had.
    pub fn output_generation(&self) -> u64 {
        self.generation
    }

    /// Size of the picture, pixels; smaller than asked for where a screen has more pixels than can be drawn in time.
    pub fn output_size(&self) -> Option<[u32; 2]> {
        self.targets.as_ref().map(|t| t.size)
    }

    /// Reads the picture that is shown at this moment (premultiplied where the background is transparent).
    ///
    /// # Errors
    /// [`RenderError::NoSubject`] before the first picture, [`RenderError::DeviceLost`].
    pub fn read_output(&self) -> impl Future<Output = Result<Image, RenderError>> + 'static {
        let reading = self
            .targets
            .as_ref()
            .map(|t| read_picture(&self.gpu, encoder(&self.gpu), &t.output.texture));
        async move {
            match reading {
                Some(picture) => picture.await,
                None => Err(RenderError::NoSubject),
            }
        }
    }

    /// What the subject is, once one is on the GPU.
    pub fn subject_info(&self) -> Option<SubjectInfo> {
        self.studio.as_ref().map(|s| s.info())
    }

    /// Box of the deformed object as it was last drawn, subject space.
    pub fn bounds(&self) -> Option<Aabb> {
        self.scene.as_ref().map(Scene::bounds)
    }

    /// The named segments of the subject, once one is on the GPU.
    pub fn segments(&self) -> &[Segment] {
        self.studio.as_ref().map_or(&[], |s| s.segments())
    }

    /// Notices since the last call (a subject was made coarser, …).
    pub fn take_notices(&mut self) -> Vec<RenderNotice> {
        std::mem::take(&mut self.notices)
    }

    /// The surface under a pixel of the picture with the present settings (origin top left, of a picture of `size_px`).
    ///
    /// # Errors
    /// [`RenderError::NoSubject`], [`RenderError::DeviceLost`].
    pub fn pick(&mut self, pixel: Vec2, size_px: [u32; 2]) -> Result<PendingPick, RenderError> {
        self.with_picks(size_px, |picks| picks.pick(pixel))
    }

    /// Asks how far from the eye the surface is under each of at least one pixel (origin top left), in one pass.
    ///
    /// # Errors
    /// [`RenderError::NoSubject`], [`RenderError::DeviceLost`].
    pub fn depths(
        &mut self,
        pixels: &[Vec2],
        size_px: [u32; 2],
    ) -> Result<PendingDepths, RenderError> {
        self.with_picks(size_px, |picks| picks.depths(pixels))
    }

    fn with_picks<T>(
        &mut self,
        size_px: [u32; 2],
        ask: impl FnOnce(&PickScene<'_>) -> T,
    ) -> Result<T, RenderError> {
        self.gpu.check()?;
        if !self.prepare() {
            return Err(RenderError::NoSubject);
        }
        match (&self.studio, &self.scene, &self.illustration) {
            (Some(studio), Some(scene), Some(illustration)) => Ok(ask(&PickScene {
                gpu: &self.gpu,
                passes: &studio.passes,
                subject: &studio.subject,
                scene,
                view: &View::new(&illustration.camera, size_px),
            })),
            _ => Err(RenderError::NoSubject),
        }
    }

    /// Where points of rest space are in the object with the present settings.
    ///
    /// # Errors
    /// [`RenderError::NoSubject`], [`RenderError::DeviceLost`], [`RenderError::Refused`].
    pub fn follow_points(&mut self, points_in_rest: &[Vec3]) -> Result<PendingPlaces, RenderError> {
        self.gpu.check()?;
        if !self.prepare() {
            return Err(RenderError::NoSubject);
        }
        match (&self.studio, &self.scene) {
            (Some(studio), Some(scene)) => {
                let follower = &studio.passes.follower;
                Ok(follower.find(&self.gpu, &studio.subject, scene, points_in_rest))
            }
            _ => Err(RenderError::NoSubject),
        }
    }

    /// Brings the slice of a slot (0, 1, …; each has its own texture) up to date with the last settings; nothing is
    /// drawn if nothing changed. True if [`Renderer::slice_view`] has a picture of it.
    ///
    /// # Errors
    /// [`RenderError::BadSize`], [`RenderError::DeviceLost`].
    pub fn draw_slice(&mut self, slot: usize, view: &SliceView) -> Result<bool, RenderError> {
        if !self.ready_for_slices()? {
            return Ok(false);
        }
        if let (Some(studio), Some(scene)) = (&self.studio, &self.scene) {
            let scene = SliceScene {
                gpu: &self.gpu,
                passes: &studio.passes.slices,
                subject: &studio.subject,
                scene,
            };
            self.slices.draw(slot, view, &scene)?;
            return Ok(true);
        }
        Ok(false)
    }

    /// The picture of a slot (Rgba8Unorm, sRGB-encoded, opaque), and a number that changes when its texture is another.
    pub fn slice_view(&self, slot: usize) -> Option<(&wgpu::TextureView, u64)> {
        self.slices.view(slot)
    }

    /// What the deformed object has at each pixel of a slice, row by row from the top.
    ///
    /// # Errors
    /// [`RenderError::NoSubject`], [`RenderError::BadSize`], [`RenderError::DeviceLost`].
    pub fn read_slice(
        &mut self,
        plane: &SlicePlane,
        size_px: [u32; 2],
    ) -> Result<PendingSlice, RenderError> {
        if !self.ready_for_slices()? {
            return Err(RenderError::NoSubject);
        }
        match (&self.studio, &self.scene) {
            (Some(studio), Some(scene)) => SliceScene {
                gpu: &self.gpu,
                passes: &studio.passes.slices,
                subject: &studio.subject,
                scene,
            }
            .read(plane, size_px),
            _ => Err(RenderError::NoSubject),
        }
    }

    fn ready_for_slices(&mut self) -> Result<bool, RenderError> {
        self.gpu.check()?;
        Ok(self.prepare())
    }

    /// A finished picture of the subject on the GPU, independent of the picture in the window: for small pictures of
    /// other states. Of a figure it shows `sheet`, if there is one, in place of that in the window. `on_progress` hears
    /// how much of the picture is drawn, 0 to 1. The future owns its resources and may be polled once per frame; who
    /// drops it stops the work.
    pub fn render_image<P: Fn(f32) + 'static>(
        &self,
        (illustration, sheet): (&Illustration, Option<Sheet>),
        size_px: [u32; 2],
        samples: u32,
        on_progress: P,
    ) -> impl Future<Output = Result<Image, RenderError>> + 'static + use<P> {
        let mut resources = self.resources.clone();
        resources.sheet = sheet.or(resources.sheet);
        let started = self
            .studio
            .as_ref()
            .map(|studio| studio.clone().with_resources(resources))
            .map(|studio| studio.render_with_progress(illustration, size_px, samples, on_progress));
        async move {
            match started {
                Some(picture) => picture.await,
                None => Err(RenderError::NoSubject),
            }
        }
    }

    /// A finished picture as in [`Renderer::render_image`], handed over by rows from the top: see
    /// [`Studio::render_rows`].
    pub fn render_rows<T: Taker + 'static>(
        &self,
        illustration: &Illustration,
        spec: PictureSpec,
        taker: T,
    ) -> impl Future<Output = Result<T, RenderError>> + 'static + use<T> {
        let resources = self.resources.clone();
        let started = self.studio.as_ref().map(|studio| {
            let studio = studio.clone().with_resources(resources);
            studio.render_rows(illustration, spec, None, taker)
        });
        async move {
            match started {
                Some(picture) => picture.await,
                None => Err(RenderError::NoSubject),
            }
        }
    }

    /// What each pixel of a picture of the subject shows: see [`Studio::identify`].
    pub fn identify(
        &self,
        illustration: &Illustration,
        size_px: [u32; 2],
    ) -> impl Future<Output = Result<Sighting, RenderError>> + 'static + use<> {
        let resources = self.resources.clone();
        let studio = self.studio.as_ref();
        let started = studio.map(|studio| {
            let studio = studio.clone().with_resources(resources);
            studio.identify(illustration, size_px)
        });
        async move {
            match started {
                Some(sighting) => sighting.await,
                None => Err(RenderError::NoSubject),
            }
        }
    }

    /// Goes on with another device after the old one was lost: the kept subject is uploaded again, and the same picture
    /// comes back.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if the new device takes less.
    pub fn recover(&mut self, gpu: Gpu) -> Result<(), RenderError> {
        let subject = self.subject.take();
        let labels = self.labels.take();
        let illustration = self.illustration.take();
        let resources = std::mem::take(&mut self.resources);
        let generation = self.generation;
        *self = Self {
            generation,
            illustration,
            resources,
            ..Self::new(gpu, self.clock)
        };
        match subject {
            Some(subject) => {
                self.set_subject(subject)?;
                self.labels = labels;
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Gives back what only this renderer holds on the device: its picture and what the scene is made of. A browser
    /// frees such things late unless it is told. All of it is made anew where something is drawn.
    pub fn destroy_own(&mut self) {
        if let Some(targets) = self.targets.take() {
            targets.destroy();
        }
        self.scene = None;
        (self.stage, self.under_way) = (Stage::Stale, None);
        self.slices.forget();
    }

    /// Lets go of a subject that was shared, too.
    pub fn forget_shared_subject(&mut self) {
        self.destroy_own();
        self.studio = None;
    }

    /// Bytes that the values and labels of the subject take on the device.
    pub fn subject_bytes(&self) -> u64 {
        self.studio
            .as_ref()
            .map_or(0, |s| s.subject.bytes() + s.subject.texture_bytes())
    }

    /// Brings the next pieces of a subject to the GPU.
    fn advance_upload(&mut self, budget: f64) -> Result<(), RenderError> {
        let Some((mut upload, fitting)) = self.upload.take() else {
            return Ok(());
        };
        let start = (self.clock)();
        loop {
            if upload.advance(&self.gpu) {
                let passes = Passes::of(&self.gpu);
                let subject = upload.finish(&self.gpu, &passes.layouts);
                self.studio = Some(Studio {
                    gpu: self.gpu.clone(),
                    passes,
                    subject: Arc::new(subject),
                    wants_grid: true,
                    resources: Resources::default(),
                });
                self.fitting = Some(fitting);
                self.scene = None;
                self.slices.forget();
                self.touch();
                return self.take_segmentations();
            }
            if (self.clock)() - start > budget {
                // Hands over what has piled up.
                self.gpu.queue.submit([]);
                self.upload = Some((upload, fitting));
                return Ok(());
            }
        }
    }

    /// Takes the shaders from their files again, for whoever is changing them. With an error all stays as it was.
    ///
    /// # Errors
    /// [`RenderError::Shader`] with file and line.
    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    pub fn reload_shaders(&mut self) -> Result<(), RenderError> {
        crate::render::device::programs::check_programs()?;
        self.gpu.forget_shared();
        if let Some(studio) = &mut self.studio {
            studio.passes = Passes::of(&self.gpu);
        }
        self.scene = None;
        self.slices.forget();
        self.touch();
        Ok(())
    }

    /// Learns from the last submission how long a pixel takes.
    fn measure(&mut self) {
        let Some(work) = &mut self.under_way else {
            return;
        };
        work.checks += 1;
        if !work.done.is_done() {
            return;
        }
        let done_at = work.done.done_at();
        let elapsed = done_at.unwrap_or_else(self.clock) - work.started;
        // A time that the device told is exact, whenever it was looked at.
        let checks = work.checks.max(if done_at.is_some() { 2 } else { 0 });
        self.pace.learn(elapsed, work.pixels, checks, work.work);
        if work.work == Work::Refine {
            self.whole.took(elapsed, work.ends_sample);
        }
        self.under_way = None;
    }

    fn make_targets(&mut self, size: [u32; 2]) {
        self.targets = Some(Targets::new(&self.gpu, size));
        self.generation += 1;
        self.stage = Stage::Stale;
    }

    /// True while a new output texture has nothing in it.
    fn generation_is_blank(&self) -> bool {
        self.stage == Stage::Stale && self.drawn_generation() != self.generation
    }

    fn drawn_generation(&self) -> u64 {
        match &self.scene {
            Some(scene) => scene.drawn_generation,
            None => 0,
        }
    }

    /// Brings the scene up to date. False if there is nothing to draw yet.
    fn prepare(&mut self) -> bool {
        let (Some(studio), Some(illustration)) = (&self.studio, &self.illustration) else {
            return false;
        };
        let scene = self.scene.get_or_insert_with(|| {
            Scene::new(&self.gpu, &studio.passes.layouts, studio.wants_grid)
        });
        let passes = &studio.passes;
        let shown = (illustration, &self.resources);
        if passes.update(&self.gpu, scene, &studio.subject, shown) {
            self.stage = Stage::Stale;
            self.notices.extend(scene.take_notices());
        }
        true
    }

    /// The whole picture at the resolution that fits the budget.
    fn draw_quick(&mut self, budget: f64) {
        let (Some(studio), Some(illustration), Some(targets), Some(scene)) = (
            &self.studio,
            &self.illustration,
            &self.targets,
            &mut self.scene,
        ) else {
            return;
        };
        let [width, height] = targets.size.map(|side| side as f32);
        // The baked map, if there is one and the frame times so far show that it is faster on this device.
        let is_faster = self.pace.cost(Work::QuickBaked) < self.pace.cost(Work::Quick);
        let baked = scene.baked().filter(|_| is_faster);
        let (work, key) = match baked {
            Some(_) => (Work::QuickBaked, scene.baked_key()),
            None => (Work::Quick, scene.key()),
        };
        let affordable = self.pace.affordable(budget, work);
        let affordable = (affordable as f32 / (width * height)).sqrt();
        let scale = steady_scale(affordable, self.quick_scale, least_scale(targets.size));
        self.quick_scale = Some(scale);
        let small = targets
            .size
            .map(|side| ((side as f32 * scale).round() as u32).clamp(1, side));
        let view = View::new(&illustration.camera, small);
        let finished = View::new(&illustration.camera, targets.size);
        let detail = studio.subject.frame.detail;
        let frame = frame_of(&view, &finished, scene.bounds(), detail, 0).of_what_moves();
        let [small_width, small_height] = small.map(|side| side as f32);
        let shot = Shot {
            key,
            frame,
            baked: baked.map(|baked| &baked.group),
            viewport: small,
            tiles: &[[0, 0, small[0], small[1]]],
            weight: 1.0,
            scale: [
                small_width / (width * width),
                small_height / (height * height),
            ],
            end: [(small_width - 0.5) / width, (small_height - 0.5) / height],
            shown: &[[0, 0, targets.size[0], targets.size[1]]],
            ends_sample: true,
        };
        targets.draw(studio, scene, &shot);
        scene.drawn_generation = self.generation;
        self.stage = Stage::Refining { sample: 0, tile: 0 };
        self.is_coarse = self.pace.affordable(budget, Work::Quick) < f64::from(width * height);
        self.follow(small[0] * small[1], work);
    }

    /// The next tiles of the full picture, as many as fit the budget.
    fn refine(&mut self, sample: u32, first: usize, budget: f64) {
        let (Some(studio), Some(illustration), Some(targets), Some(scene)) =
            (&self.studio, &self.illustration, &self.targets, &self.scene)
        else {
            return;
        };
        let affordable = self.pace.affordable(budget, Work::Refine);
        if first == 0 {
            self.whole.begins();
        }
        let mut pixels = 0;
        let mut end = first;
        while let Some(&[_, _, w, h]) = targets.tiles.get(end) {
            if end > first && f64::from(pixels) >= affordable {
                break;
            }
            pixels += w * h;
            end += 1;
        }
        let tiles = targets.tiles.get(first..end).unwrap_or_default();
        let ends_sample = end >= targets.tiles.len();
        let view = View::new(&illustration.camera, targets.size);
        let detail = studio.subject.frame.detail;
        let frame = frame_of(&view, &view, scene.bounds(), detail, sample);
        let [width, height] = targets.size.map(|side| side as f32);
        let shot = Shot {
            key: scene.key(),
            frame,
            baked: None,
            viewport: targets.size,
            tiles,
            weight: sample_weight(sample),
            scale: [1.0 / width, 1.0 / height],
            end: [1.0; 2],
            shown: tiles,
            ends_sample,
        };
        targets.draw(studio, scene, &shot);
        self.stage = if end < targets.tiles.len() {
            Stage::Refining { sample, tile: end }
        } else if sample + 1 < self.samples() {
            Stage::Refining {
                sample: sample + 1,
                tile: 0,
            }
        } else {
            Stage::Done
        };
        self.follow(pixels, Work::Refine);
        if let Some(work) = &mut self.under_way {
            work.ends_sample = ends_sample;
        }
    }

    /// Bakes on where the next movement would gain by it: the formulas are too slow for the full resolution. True if
    /// it had anything to do.
    fn bake(&mut self, budget: f64) -> bool {
        let (Some(studio), Some(scene)) = (&self.studio, &mut self.scene) else {
            return false;
        };
        if !self.is_coarse || !scene.may_bake() || scene.baked().is_some() {
            return false;
        }
        let affordable = self
            .pace
            .affordable(budget, Work::Bake)
            .min(f64::from(u32::MAX));
        let texels = studio
            .passes
            .bake(&self.gpu, scene, None, affordable as u32);
        if scene.baked().is_some() {
            // Compiled now, while nobody waits for it.
            studio.passes.raycast.pipeline(&self.gpu, scene.baked_key());
            self.pace.hope_for_baked(BAKED_HOPE);
        }
        self.follow(texels, Work::Bake);
        true
    }

    fn follow(&mut self, pixels: u32, work: Work) {
        self.under_way = Some(UnderWay {
            done: WorkDone::timed(&self.gpu, Some(self.clock)),
            started: (self.clock)(),
            pixels,
            work,
            ends_sample: false,
            checks: 0,
        });
    }

    fn samples(&self) -> u32 {
        if let Some(chosen) = self.gpu.samples() {
            return chosen;
        }
        let usual = match self.gpu.is_software() {
            true => SAMPLES_SOFTWARE,
            false => SAMPLES_HARDWARE,
        };
        samples(usual, self.whole.seconds())
    }

    fn state(&self) -> DrawState {
        let has_scene = self.studio.is_some() && self.illustration.is_some();
        let progress = match (self.stage, &self.targets) {
            (Stage::Done, _) => 1.0,
            (Stage::Refining { sample, tile }, Some(targets)) => {
                (sample as f32 + tile as f32 / targets.tiles.len().max(1) as f32)
                    / self.samples() as f32
            }
            _ => 0.0,
        };
        DrawState {
            is_done: self.upload.is_none()
                && self.under_way.is_none()
                && (!has_scene || self.stage == Stage::Done || self.targets.is_none()),
            progress,
            has_picture: self.targets.is_some() && self.drawn_generation() == self.generation,
            is_behind: self.stage == Stage::Stale,
            uploading: self.upload.as_ref().map(|(upload, _)| upload.progress()),
            is_held: false,
            whole_seconds: self.whole.seconds().map(|seconds| seconds as f32),
        }
    }
}
