//! The picture in the middle: the renderer, the texture that egui shows, and the questions to the GPU that wait
//! for an answer. The only file of this room that uses wgpu.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;
use std::task::Wake;
use std::time::Duration;

use eframe::egui_wgpu::RenderState;
use glam::Vec2;

use crate::app::session::{Command, Found, Place, Question};
use crate::data::{Pending, Resources, Segment, Segmentation, Sheet, Subject, Surface, poll_once};
use crate::document::{Background, Camera, Illustration};
use crate::math::Aabb;
use crate::render::{
    Clock, DrawState, FollowedCaptions, Gpu, Image, PendingPick, PendingSlice, Pick, PictureSpec,
    RenderError, RenderNotice, Renderer, SlicePlane, SliceView, SubjectInfo, Taker, View,
};

/// A picture for a file, in the making.
struct FileJob {
    /// The bytes of the file.
    picture: Pending<Result<Vec<u8>, RenderError>>,
    /// How much of it is drawn, 0 to 1.
    progress: Rc<Cell<f32>>,
}

/// Work that takes longer is asked for.
const PATIENCE: Duration = Duration::from_secs(1);

/// Asks for a frame when it is woken.
struct Repaint(egui::Context);

impl Wake for Repaint {
    fn wake(self: Arc<Self>) {
        self.0.request_repaint();
    }
}

/// The renderer with what the interface needs around it. Built once per window.
pub(crate) struct Picture {
    renderer: Renderer,
    render_state: RenderState,
    texture: Option<egui::TextureId>,
    generation: u64,
    /// What egui shows of each slice, with the number of its texture.
    slices: Vec<Option<(egui::TextureId, u64)>>,
    /// The untouched object, drawn over the other while somebody wants it.
    ghost: Option<Renderer>,
    ghost_texture: Option<(egui::TextureId, u64)>,
    clock: Clock,
    questions: Vec<(Question, PendingPick)>,
    file: Option<FileJob>,
    /// The picture as it was shown, on its way back.
    read_back: Option<Pending<Result<Image, RenderError>>>,
    /// As of the last frame.
    pub(crate) state: DrawState,
}

/// The device that egui draws with.
pub fn gpu_of(render_state: &RenderState) -> Gpu {
    Gpu::from_parts(
        render_state.device.clone(),
        render_state.queue.clone(),
        render_state.adapter.get_info(),
    )
}

impl Picture {
    /// On the device that egui draws with: `gpu` is that one, if it is known already.
    pub(crate) fn new(render_state: &RenderState, gpu: Option<Gpu>, clock: Clock) -> Self {
        let gpu = gpu.unwrap_or_else(|| gpu_of(render_state));
        Self {
            renderer: Renderer::new(gpu, clock),
            render_state: render_state.clone(),
            texture: None,
            generation: 0,
            slices: Vec::new(),
            ghost: None,
            ghost_texture: None,
            clock,
            questions: Vec::new(),
            file: None,
            read_back: None,
            state: DrawState {
                is_done: false,
                progress: 0.0,
                has_picture: false,
                is_behind: true,
                uploading: None,
                is_held: false,
                whole_seconds: None,
            },
        }
    }

    /// Takes the shaders from their files again.
    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    pub(crate) fn reload_shaders(&mut self) -> Result<(), RenderError> {
        self.state.is_done = false;
        self.renderer.reload_shaders()
    }

    pub(crate) fn gpu(&self) -> &Gpu {
        self.renderer.gpu()
    }

    /// Shows another subject; it is uploaded while the old one stays.
    pub(crate) fn set_subject(&mut self, subject: Subject) -> Result<(), RenderError> {
        self.state.is_done = false;
        self.state.uploading = Some(0.0);
        self.renderer.set_subject(subject)
    }

    /// Shows the same subject with other segments.
    pub(crate) fn set_segmentation(
        &mut self,
        labels: Option<Arc<Segmentation>>,
    ) -> Result<(), RenderError> {
        self.state.is_done = false;
        self.renderer.set_segmentation(labels)
    }

    /// Notices about the subject and the document shown; each is returned once.
    pub(crate) fn take_notices(&mut self) -> Vec<RenderNotice> {
        self.renderer.take_notices()
    }

    /// Value range, window and preset of the volume shown.
    pub(crate) fn subject_info(&self) -> Option<SubjectInfo> {
        self.renderer.subject_info()
    }

    /// The named segments of the volume shown.
    pub(crate) fn segments(&self) -> &[Segment] {
        self.renderer.segments()
    }

    /// Shows these meshes beside the volume; to be called in every frame.
    pub(crate) fn set_meshes(&mut self, meshes: Option<&Arc<Surface>>) {
        self.renderer.set_meshes(meshes);
    }

    /// Draws with what has come of the files that the document names.
    pub(crate) fn set_resources(&mut self, resources: Resources) {
        self.renderer.set_resources(resources);
    }

    /// Takes another illustration or camera to be drawn.
    pub(crate) fn set(&mut self, illustration: &Illustration, camera: &Camera) {
        let mut seen = illustration.clone();
        seen.camera = *camera;
        self.renderer.set_illustration(&seen);
    }

    /// Draws as much as fits into the budget and gives the texture to show.
    pub(crate) fn draw(
        &mut self,
        size_px: [u32; 2],
        budget_seconds: f32,
        is_moving: bool,
    ) -> Result<Option<egui::TextureId>, RenderError> {
        self.state = self.renderer.draw(size_px, budget_seconds, is_moving)?;
        let generation = self.renderer.output_generation();
        if let Some(view) = self.renderer.output_view()
            && (self.texture.is_none() || generation != self.generation)
        {
            self.generation = generation;
            let device = &self.render_state.device;
            let filter = wgpu::FilterMode::Linear;
            let mut painter = self.render_state.renderer.write();
            match self.texture {
                Some(id) => painter.update_egui_texture_from_wgpu_texture(device, view, filter, id),
                None => self.texture = Some(painter.register_native_texture(device, view, filter)),
            }
        }
        Ok(self.texture.filter(|_| self.state.has_picture))
    }

    /// Somebody does something: the finer picture waits for a moment.
    pub(crate) fn hold(&mut self) {
        self.renderer.hold();
    }

    /// Repaints as soon as the work under way is done, and not before. False where that has to be asked every frame.
    pub(crate) fn repaint_when_done(&self, ctx: &egui::Context) -> bool {
        let waker = Arc::new(Repaint(ctx.clone())).into();
        let will_wake = self.ghost.is_none() && self.renderer.wake_when_done(&waker);
        if will_wake {
            // A device that is lost wakes nobody.
            ctx.request_repaint_after(PATIENCE);
        }
        will_wake
    }

    /// The texture of a slice, brought up to date. None until there is something to show.
    pub(crate) fn slice(
        &mut self,
        slot: usize,
        view: &SliceView,
    ) -> Result<Option<egui::TextureId>, RenderError> {
        if !self.renderer.draw_slice(slot, view)? {
            return Ok(None);
        }
        if self.slices.len() <= slot {
            self.slices.resize(slot + 1, None);
        }
        let (Some((texture, generation)), Some(shown)) =
            (self.renderer.slice_view(slot), self.slices.get_mut(slot))
        else {
            return Ok(None);
        };
        Ok(Some(registered(
            &self.render_state,
            texture,
            generation,
            shown,
        )))
    }

    /// Starts reading the numbers of a slice.
    pub(crate) fn read_slice(
        &mut self,
        plane: &SlicePlane,
        size_px: [u32; 2],
    ) -> Result<PendingSlice, RenderError> {
        self.renderer.read_slice(plane, size_px)
    }

    /// Draws the untouched object as seen by a camera, on a clear background. It shares the subject with the picture.
    pub(crate) fn draw_ghost(
        &mut self,
        illustration: &Illustration,
        camera: &Camera,
        size_px: [u32; 2],
        (budget_seconds, is_moving): (f32, bool),
    ) -> Result<Option<egui::TextureId>, RenderError> {
        let ghost = self
            .ghost
            .get_or_insert_with(|| Renderer::new(self.renderer.gpu().clone(), self.clock));
        ghost.share_subject(&self.renderer);
        let mut untouched = illustration.clone();
        untouched.templates.clear();
        untouched.look.background = Background::None;
        untouched.camera = *camera;
        ghost.set_illustration(&untouched);
        let state = ghost.draw(size_px, budget_seconds, is_moving)?;
        self.state.is_done &= state.is_done;
        let generation = ghost.output_generation();
        Ok(match ghost.output_view() {
            Some(view) if state.has_picture => Some(registered(
                &self.render_state,
                view,
                generation,
                &mut self.ghost_texture,
            )),
            _ => None,
        })
    }

    /// Nobody wants the ghost any more: what it holds on the device is given back.
    pub(crate) fn drop_ghost(&mut self) {
        self.ghost = None;
    }

    /// Asks for the surface at a pixel of the picture; the caller polls the answer.
    pub(crate) fn pick(
        &mut self,
        pos_px: [f32; 2],
        size_px: [u32; 2],
    ) -> Result<PendingPick, RenderError> {
        self.renderer.pick(Vec2::from_array(pos_px), size_px)
    }

    /// Asks a question about the picture in the window, `size_px` pixels large, or about the view that the question
    /// brings along. After such a view the caller has to set the picture's own view again.
    pub(crate) fn ask(&mut self, question: Question, size_px: [u32; 2]) -> Result<(), RenderError> {
        let [width, height] = size_px.map(|side| side as f32);
        self.questions
            .retain(|(earlier, _)| !question.replaces(earlier));
        let pending = match &question.place {
            Place::Pixel(pixel) => self.pick(*pixel, size_px)?,
            Place::Middle => self.pick([0.5 * width, 0.5 * height], size_px)?,
            Place::Beside(sight, pos) => {
                self.set(&sight.illustration, &sight.camera);
                let size_px = [SIGHT_PX; 2];
                let view = View::new(&sight.camera, size_px);
                let pixel = view.pixel_from_subject(*pos).unwrap_or_default();
                self.pick(pixel.into(), size_px)?
            }
        };
        self.questions.push((question, pending));
        Ok(())
    }

    /// The commands that answers have become.
    pub(crate) fn answers(&mut self) -> Vec<Result<Command, RenderError>> {
        let mut answers = Vec::new();
        self.questions.retain_mut(|(question, pending)| {
            let Some(answer) = pending.poll_now() else {
                return true;
            };
            answers.push(answer.map(|pick| (question.reply)(question.index, pick.map(found))));
            false
        });
        answers
    }

    /// Brings up to date where captions are. True if that wants another frame.
    pub(crate) fn follow_captions(
        &mut self,
        followed: &mut FollowedCaptions,
        shown: (&Illustration, &Camera),
        size_px: [u32; 2],
    ) -> bool {
        let is_done = self.state.is_done;
        followed.update(&mut self.renderer, shown, size_px, is_done)
    }

    /// Starts drawing the picture once more for a file, in place of one that is being drawn. `rows` takes it, tells its
    /// progress, and becomes the bytes of the file by `finish`. With `has_shadow` the object throws a soft shadow on
    /// its background.
    pub(crate) fn start_file<T: Taker + 'static>(
        &mut self,
        illustration: &Illustration,
        (size_px, has_shadow): ([u32; 2], bool),
        (rows, progress): (Result<T, RenderError>, Rc<Cell<f32>>),
        finish: fn(T) -> Result<Vec<u8>, RenderError>,
    ) {
        let spec = PictureSpec {
            size_px,
            samples: FILE_SAMPLES,
            has_shadow,
        };
        let drawing = rows.map(|rows| self.renderer.render_rows(illustration, spec, rows));
        self.file = Some(FileJob {
            picture: Box::pin(async move { finish(drawing?.await?) }),
            progress,
        });
    }

    /// Starts drawing a small picture of the subject, beside the one that is shown; of a figure as `sheet` has it.
    pub(crate) fn start_small(
        &self,
        illustration: &Illustration,
        sheet: Option<Sheet>,
        size_px: [u32; 2],
    ) -> Pending<Result<Image, RenderError>> {
        let (renderer, samples) = (&self.renderer, SMALL_SAMPLES);
        Box::pin(renderer.render_image((illustration, sheet), size_px, samples, |_| {}))
    }

    /// The bytes of the picture's file once they are there.
    pub(crate) fn poll_file(&mut self) -> Option<Result<Vec<u8>, RenderError>> {
        let bytes = poll_once(&mut self.file.as_mut()?.picture)?;
        self.file = None;
        Some(bytes)
    }

    /// How much of the picture for a file is drawn, 0 to 1; none while none is asked for.
    pub(crate) fn file_progress(&self) -> Option<f32> {
        self.file.as_ref().map(|file| file.progress.get())
    }

    /// Stops drawing the picture for a file.
    pub(crate) fn stop_file(&mut self) {
        self.file = None;
    }

    /// Starts reading the picture back that is shown at this moment.
    pub(crate) fn start_reading(&mut self) {
        self.read_back = Some(Box::pin(self.renderer.read_output()));
    }

    /// Forgets the picture that is being read back.
    pub(crate) fn stop_reading(&mut self) {
        self.read_back = None;
    }

    /// A picture is being read back.
    pub(crate) fn is_reading(&self) -> bool {
        self.read_back.is_some()
    }

    /// The picture that was read back, once it is there.
    pub(crate) fn poll_reading(&mut self) -> Option<Result<Image, RenderError>> {
        let image = poll_once(self.read_back.as_mut()?)?;
        self.read_back = None;
        Some(image)
    }

    /// Width and height of the picture that is shown, pixels.
    pub(crate) fn size_px(&self) -> Option<[u32; 2]> {
        self.renderer.output_size()
    }

    /// Box of the deformed object as it was last drawn, subject space.
    pub(crate) fn bounds(&self) -> Option<Aabb> {
        self.renderer.bounds()
    }

    /// The GPU is busy with something that the interface waits for.
    pub(crate) fn is_waiting(&self) -> bool {
        !self.questions.is_empty() || self.file.is_some()
    }
}

/// The texture under egui's name; made known anew if the texture is another than in the frame before.
fn registered(
    render_state: &RenderState,
    view: &wgpu::TextureView,
    generation: u64,
    shown: &mut Option<(egui::TextureId, u64)>,
) -> egui::TextureId {
    let (device, filter) = (&render_state.device, wgpu::FilterMode::Linear);
    match shown {
        Some((id, known)) if *known == generation => *id,
        Some((id, known)) => {
            *known = generation;
            let mut painter = render_state.renderer.write();
            painter.update_egui_texture_from_wgpu_texture(device, view, filter, *id);
            *id
        }
        None => {
            let mut painter = render_state.renderer.write();
            let id = painter.register_native_texture(device, view, filter);
            *shown = Some((id, generation));
            id
        }
    }
}

/// Samples per pixel of a saved picture.
const FILE_SAMPLES: u32 = 4;
/// Samples per pixel of a small picture.
const SMALL_SAMPLES: u32 = 4;
/// Pixels of the view of its own that a question may name.
const SIGHT_PX: u32 = 256;

/// What a pick found, in the session's terms.
pub(crate) fn found(pick: Pick) -> Found {
    Found {
        pos: pick.pos_in_subject,
        normal: pick.normal,
        pos_in_rest: pick.pos_in_rest,
        value: pick.value,
        segment: pick.segment,
        object: pick.object,
    }
}
