//! The state of the viewer: the document and its history, the tool, the camera, the load under way, the messages.
//! Other files of this room add what can be done with it.

use super::camera;
use super::clay::{Laid, Together};
use super::clipboard::Clipboard;
use super::command::{GizmoMode, PicturePaper};
use super::effect::{Effect, LinkChange};
use super::files::{FileChoice, RawDraft};
use super::growing::Growing;
use super::hand::HeldTool;
use super::library::Library;
use super::mode::Mode;
use super::notices::{Gravity, Notices, Offer};
use super::selection::Selection;
use super::ticket::Ticket;
use super::tissues::Tissues;
use super::tool::Tool;
use super::tracing::Tracing;
use super::view::ViewState;
use crate::app::words::{fill, messages};
use crate::assets::Want;
use crate::data::Subject;
use crate::data::SubjectFrame;
use crate::document::{
    Autoplay, Camera, Document, DocumentError, Edit, History, Illustration, PlacedTemplate,
    Reading, SubjectRef, TemplateKind,
};
use crate::link;

/// The key under which the last document is kept for the next start.
pub const STORED_DOCUMENT: &str = "document";

/// Seconds in which the camera glides to a standard view.
const GLIDE_SECONDS: f64 = 0.3;

/// What a load brings.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadOf {
    /// The subject that the document names.
    Subject,
    /// A file that the user opened. It becomes the document's subject.
    File,
    /// A file that takes the place of the document's subject, whichever that is.
    Instead,
    /// A picture of which landmarks or outlines are taken over: nothing else of it is kept.
    Reference,
    /// A label volume or the mesh of an object that the document names: the subject stays.
    Beside(Box<Want>),
}

/// A load under way.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Tells this load from others in messages and effects.
    pub ticket: Ticket,
    /// How much of it is done, 0 to 1.
    pub fraction: f32,
    /// The work under way, as the message names it: `Reading`.
    pub what: String,
    /// What the load brings, and what becomes of it.
    pub of: LoadOf,
    /// The host that the load wants to fetch from, while the user is asked.
    pub host: Option<String>,
    /// How the file is read.
    pub reading: Reading,
    /// Volumes in the file, once that is known.
    pub frame_count: u64,
    /// What made the images, once that is known, as DICOM abbreviates it.
    pub modality: Option<String>,
    /// The subject is seen coarsely, until its fine voxels are there.
    pub is_coarse: bool,
}

impl Load {
    /// A load that has just begun.
    pub fn new(ticket: Ticket, what: &str, of: LoadOf) -> Self {
        Self {
            ticket,
            fraction: 0.0,
            what: what.to_owned(),
            of,
            host: None,
            reading: Reading::default(),
            frame_count: 1,
            modality: None,
            is_coarse: false,
        }
    }

    /// The subject becomes the document's when the load is done.
    pub fn is_file(&self) -> bool {
        matches!(self.of, LoadOf::File | LoadOf::Instead)
    }
}

/// The question about a mesh file.
#[derive(Clone, Debug)]
pub struct MeshQuestion {
    /// The load that brought it, which is over but for its end.
    pub(super) load: Load,
    /// SHA-256 of the file's bytes.
    pub(super) sha256: String,
    /// Where its file says that it lies.
    pub(super) frame: SubjectFrame,
}

/// The camera on its way to a standard view or to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glide {
    /// The camera at the start of the glide.
    pub from: Camera,
    /// The camera at the end of the glide.
    pub to: Camera,
    /// When it began, seconds on the clock of the interface.
    pub since: f64,
}

/// A document that was left for a new one.
#[derive(Clone, Debug)]
pub(super) struct Left {
    /// The document as it was left.
    pub document: Document,
    /// Number of the message that offers its templates.
    pub notice: u64,
}

/// A panel that is open, beside the picture or as a drawer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tab {
    /// The catalogue of templates.
    Add,
    /// The list of templates and the selected one.
    Templates,
    /// Segments, and the recipes of those made here.
    Tissues,
    /// Transfer function, colours and background.
    Look,
    /// Title, text, credit, captions.
    Text,
}

/// The state of one viewer.
pub struct Session {
    /// The document and its undo.
    pub history: History,
    /// Where one looks from; joins the document when a link or a file is made, so that undo leaves it alone.
    pub camera: Camera,
    /// The camera that the document came with.
    pub home: Camera,
    pub(super) glide: Option<Glide>,
    pub(super) mode: Mode,
    pub(super) tool: Tool,
    /// The template that a hand is drawing.
    pub(super) drawn: Option<usize>,
    /// The stroke of the clay that a hand is drawing.
    pub(super) drawn_stroke: Option<usize>,
    /// The tool that shapes the clay while it is in hand.
    pub(super) clay_hand: HeldTool,
    /// The tool that draws sweeps, since it was first taken in hand.
    pub(super) sweep_hand: Option<HeldTool>,
    /// The tool of the clay that is laid down.
    pub(super) laid: Option<Laid>,
    /// Strokes of the clay that are laid down.
    pub together: Together,
    /// The selected template or object.
    pub selection: Selection,
    /// What the handles in the picture do.
    pub gizmo: GizmoMode,
    /// Messages to the user, oldest first.
    pub notices: Notices,
    /// The load under way.
    pub load: Option<Load>,
    /// True while the shell reads files of which it is not yet known what they are, and fields.
    pub is_reading: bool,
    /// How hard a pen presses, 0 to 1, of which touches do not tell.
    pub pen: Option<f32>,
    /// How much of the picture for a file is drawn, 0 to 1, while one is made that the user asked for.
    pub saving: Option<f32>,
    /// Number of the message of the last load that failed, until one is done.
    pub(super) load_failure: Option<u64>,
    /// The reader is asked what a mesh file is to be.
    pub(super) mesh_question: Option<MeshQuestion>,
    /// What the subject's file leaves to choose.
    pub files: FileChoice,
    /// The subject that was loaded, or is on its way.
    pub(super) requested: Option<SubjectRef>,
    /// It is a clay that was opened, of which more and more is asked for.
    pub(super) growing: Option<Growing>,
    /// It is wanted as a sketch, as while a hand shapes a clay.
    pub(super) is_sketch_requested: bool,
    /// The subject whose load came to nothing.
    pub(super) given_up: Option<SubjectRef>,
    /// The subject that is seen, as the document names it; `None` while a file is seen that is not yet the document's.
    pub(super) shown_subject: Option<SubjectRef>,
    /// It is seen as a sketch.
    pub(super) is_sketch_shown: bool,
    /// Rises with every document that is opened.
    pub opened: u64,
    /// The document was kept from the last time; nobody asked for it now.
    pub is_restored: bool,
    /// The drawer that is open, where there is no room for panels.
    pub tab: Option<Tab>,
    /// The panel beside the picture, where there is room.
    pub side_tab: Tab,
    /// There is room for drawers only.
    pub are_drawers: bool,
    /// The picture is shown alone.
    pub are_panels_hidden: bool,
    /// True while the sheet of keys lies over the window.
    pub is_keys_sheet_open: bool,
    /// The dialog that shares the illustration is open.
    pub is_share_open: bool,
    /// The list of all messages is open.
    pub is_messages_open: bool,
    /// The link of the document with the present camera, without the step.
    pub payload: String,
    /// Since when the document or the camera is newer than the link.
    pub(super) link_stale_since: Option<f64>,
    /// How the address bar takes the link when it is renewed.
    pub(super) link_change: LinkChange,
    /// When the link was last copied, for the button's answer.
    pub copied_at: Option<f64>,
    /// The first hint is shown.
    pub has_hint: bool,
    /// The reader has been told that the graphics are slow.
    pub has_told_slow: bool,
    /// Title and credit are written into saved pictures.
    pub is_lettering: bool,
    /// Pixels along the longer side of saved pictures; `None`: as many as suit the window.
    pub picture_px: Option<u32>,
    /// Dots per inch that saved pictures are printed with.
    pub picture_dpi: u32,
    /// What saved pictures stand on.
    pub picture_paper: PicturePaper,
    /// The title stands over the picture.
    pub has_title: bool,
    /// Handles go in steps.
    pub is_snapping: bool,
    /// A template of a group moves without the others, while the key for it is held.
    pub is_alone: bool,
    /// The text that the catalogue is searched for.
    pub search: String,
    pub(super) clipboard: Clipboard,
    /// The document that was left for a new one, while its templates may still be brought along.
    pub(super) left: Option<Left>,
    /// The surface along a template, as far as it has been found.
    pub(super) tracing: Option<Tracing>,
    /// Seconds on the clock of the interface.
    pub now: f64,
    /// A lesson plays by itself.
    pub(super) playing: Option<Autoplay>,
    /// The reader wants nothing to move by itself: passages and glides are cuts.
    pub has_less_motion: bool,
    /// The surroundings shape the texts of captions, whatever their script.
    pub has_shaped_texts: bool,
    /// Captions of the illustration that the program's letters cannot set, as far as that was told.
    pub(super) unshaped: usize,
    /// Grows with every change of the illustration that is shown.
    pub revision: u64,
    /// Settings of the view besides the camera: panes, slices, measures.
    pub view: ViewState,
    /// Which recipe is edited and which tissue is shown alone.
    pub tissues: Tissues,
    /// Examples, and documents that were open before.
    pub library: Library,
    /// Effects that wait for the app, in order.
    pub(super) effects: Vec<Effect>,
}

impl Session {
    /// The session of a document that was just opened.
    pub fn new(document: Document) -> Self {
        let camera = document.illustration().camera;
        let payload = payload_of(&document, &camera);
        Self {
            history: History::new(document),
            camera,
            home: camera,
            glide: None,
            mode: Mode::default(),
            tool: Tool::default(),
            drawn: None,
            drawn_stroke: None,
            clay_hand: HeldTool::default(),
            sweep_hand: None,
            laid: None,
            together: Together::default(),
            selection: Selection::Nothing,
            gizmo: GizmoMode::Move,
            notices: Notices::default(),
            load: None,
            is_reading: false,
            pen: None,
            saving: None,
            load_failure: None,
            mesh_question: None,
            files: FileChoice::default(),
            requested: None,
            growing: None,
            is_sketch_requested: false,
            given_up: None,
            shown_subject: None,
            is_sketch_shown: false,
            opened: 0,
            is_restored: false,
            tab: None,
            side_tab: Tab::Templates,
            are_drawers: false,
            are_panels_hidden: false,
            is_keys_sheet_open: false,
            is_share_open: false,
            is_messages_open: false,
            payload,
            link_stale_since: None,
            link_change: LinkChange::Replace,
            copied_at: None,
            has_hint: false,
            has_told_slow: false,
            unshaped: 0,
            is_lettering: false,
            picture_px: None,
            picture_dpi: 300,
            picture_paper: PicturePaper::default(),
            has_title: false,
            is_snapping: false,
            is_alone: false,
            search: String::new(),
            clipboard: Clipboard::default(),
            left: None,
            tracing: None,
            now: 0.0,
            playing: None,
            has_less_motion: false,
            has_shaped_texts: false,
            revision: 0,
            view: ViewState::default(),
            tissues: Tissues::default(),
            library: Library::default(),
            effects: Vec::new(),
        }
    }

    /// The document as it stands, with the camera it was opened with.
    pub fn document(&self) -> &Document {
        self.history.document()
    }

    /// The illustration that the document describes, with the camera it was opened with.
    pub fn illustration(&self) -> &Illustration {
        self.document().illustration()
    }

    /// The document with the present camera: what a link, a file and the picture show.
    ///
    /// At a step it is the author's camera: the one that the step turned would be step 0's.
    pub fn document_as_seen(&self) -> Document {
        match self.step() {
            0 => with_camera(self.document(), &self.camera),
            _ => self.document().clone(),
        }
    }

    /// What the picture shows: the document, or the state of its lesson.
    pub fn shown(&self) -> &Illustration {
        self.mode.shown(self.history.document())
    }

    /// What the picture shows, with the present camera.
    pub fn shown_as_seen(&self) -> Illustration {
        Illustration {
            camera: self.camera,
            ..self.shown().clone()
        }
    }

    /// The step that is shown; 0 is the document as it stands.
    pub fn step(&self) -> usize {
        self.mode.step()
    }

    /// The selected template as the picture shows it, if its kind can be drawn.
    pub fn selected_template(&self) -> Option<&PlacedTemplate> {
        self.template(self.selection.template()?)
    }

    /// The template of this index in the document as the picture shows it, if its kind can be drawn.
    pub fn template(&self, index: usize) -> Option<&PlacedTemplate> {
        let mut templates = self.shown().templates.iter();
        templates.find(|template| template.index == index)
    }

    /// Entries of the document's `templates`, unknown kinds included.
    pub fn template_count(&self) -> usize {
        self.document()
            .get("/templates")
            .and_then(|list| list.as_array())
            .map_or(0, Vec::len)
    }

    /// The question how bare voxels lie, while its load waits for the answer.
    pub fn raw_draft(&self) -> Option<&RawDraft> {
        let load = self.load.as_ref()?;
        let draft = self.files.raw.as_ref()?;
        (draft.ticket == load.ticket).then_some(draft)
    }

    // ------------------------------------------------------------------------------------------------ effects

    /// The effects since the last call, in order.
    pub fn take_effects(&mut self) -> Vec<Effect> {
        std::mem::take(&mut self.effects)
    }

    pub(super) fn effect(&mut self, effect: Effect) {
        self.effects.push(effect);
    }

    pub(super) fn store(&mut self, key: &'static str, value: impl Into<String>) {
        self.effect(Effect::Store(key, value.into()));
    }

    // ------------------------------------------------------------------------------------------------ messages

    /// Shows one line over the picture; errors stay until they are put away.
    pub fn notify(
        &mut self,
        gravity: Gravity,
        message: impl Into<String>,
        details: impl Into<String>,
    ) {
        self.notices
            .add(self.now, gravity, message.into(), details.into());
    }

    /// A displacement field of the document lies on another host: a message offers to fetch it.
    pub fn ask_for_fields(&mut self, host: &str) {
        let text = fill(messages::w().fetch_field, &[&host]);
        let offer = Offer::FetchFields(host.to_owned());
        self.notices.offer(self.now, offer, text);
    }

    // ------------------------------------------------------------------------------------------------ the tool

    /// The active tool; there is always exactly one.
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// True if drags over the picture move a tool that shapes the clay or draws a sweep.
    pub fn has_hand(&self) -> bool {
        self.tool == Tool::Clay || self.is_sweeping()
    }

    /// True if drags over the picture draw a sweep.
    pub fn is_sweeping(&self) -> bool {
        self.tool == Tool::Place(TemplateKind::Sweep)
    }

    /// The tool that a hand moves over the picture: that of sweeps while they are drawn, else that of the clay.
    pub fn hand(&self) -> &HeldTool {
        let swept = self.sweep_hand.as_ref().filter(|_| self.is_sweeping());
        swept.unwrap_or(&self.clay_hand)
    }

    /// Takes a tool in hand, in place of the one before.
    pub fn take_tool(&mut self, tool: Tool) {
        let changes_picture = |tool: Tool| tool.ball().is_some() || tool == Tool::Clay;
        if changes_picture(self.tool) || changes_picture(tool) {
            // The tissue that is painted is marked; a clay is shaped as it is without templates.
            self.revision += 1;
        }
        self.drop_ghosts();
        self.lift_laid();
        self.tool = tool;
    }

    /// Other things are done than with tissues: everything is shown, and clicks add no more seeds.
    pub fn end_tissues(&mut self) {
        if self.tool.is_for_tissue() {
            self.take_tool(Tool::Look);
        }
        let tissues = &mut self.tissues;
        (tissues.making, tissues.selected) = (None, None);
        let is_seen = tissues.alone.is_some() || tissues.glimpse.is_some();
        if is_seen {
            tissues.show_alone(None);
            tissues.glimpse = None;
            self.revision += 1;
        }
    }

    // ------------------------------------------------------------------------------------------------ the lesson

    /// Goes to a step. Nothing is selected at first, and no tool of authors is active, for a step is looked at.
    pub(super) fn go_to_step(&mut self, step: usize) {
        self.go(step, self.has_less_motion);
    }

    /// Goes to a step, by a passage to a neighbour unless `is_cut`.
    pub(super) fn go(&mut self, step: usize, is_cut: bool) {
        self.glide = None;
        self.selection = Selection::Nothing;
        self.view.figure.let_go();
        if self.tool.is_for_authors() {
            self.take_tool(Tool::Look);
        }
        let document = self.history.document();
        let now = (self.now, self.camera);
        if let Some(camera) = self.mode.go(document, step, now, is_cut) {
            self.camera = camera;
        }
        self.revision += 1;
        self.touch_link(LinkChange::Push);
    }

    // ------------------------------------------------------------------------------------------------ the camera

    /// The camera was moved by hand: a glide under way ends, the link is renewed when the camera rests.
    pub(super) fn move_camera(&mut self, camera: Camera) {
        self.camera = camera;
        self.glide = None;
        self.touch_link(LinkChange::Replace);
    }

    pub(super) fn glide_to(&mut self, to: Camera) {
        if self.has_less_motion {
            return self.move_camera(to);
        }
        self.glide = Some(Glide {
            from: self.camera,
            to,
            since: self.now,
        });
        self.touch_link(LinkChange::Replace);
    }

    /// Puts the camera where its glide has come to. True while the glide goes on.
    pub(super) fn advance_glide(&mut self) -> bool {
        let Some(glide) = self.glide else {
            return false;
        };
        let t = ((self.now - glide.since) / GLIDE_SECONDS).clamp(0.0, 1.0) as f32;
        self.camera = camera::between(&glide.from, &glide.to, t);
        if t >= 1.0 {
            self.camera = glide.to;
            self.glide = None;
        }
        true
    }

    // ------------------------------------------------------------------------------------------------ changes

    /// Notes that the link no longer describes the picture.
    pub(super) fn touch_link(&mut self, change: LinkChange) {
        if self.link_stale_since.is_none() {
            self.link_change = LinkChange::Replace;
        }
        if change == LinkChange::Push {
            self.link_change = LinkChange::Push;
        }
        self.link_stale_since = Some(self.now);
    }

    /// Ends the drag under way, so that the next change is a new step of undo.
    pub fn end_drag(&mut self) {
        self.history.end_drag();
        self.rest_laid();
    }

    /// Changes what is shown, as a part of a drag or as one step of undo: the document, at a step above 0 what that
    /// sets. True if the document took the change; else a message tells why.
    pub fn apply(&mut self, edit: &Edit, is_drag: bool) -> bool {
        let before = self.entry_count();
        let is_done = self.apply_to_document(&self.at_step_shown(edit), is_drag);
        if is_done {
            self.tell_of_steps(edit, before);
        }
        is_done
    }

    /// Changes the document itself, whatever step is shown. True if the document took the change; else a message tells
    /// why.
    pub(super) fn apply_to_document(&mut self, edit: &Edit, is_drag: bool) -> bool {
        let result = if is_drag {
            self.history.drag(edit)
        } else {
            self.history.apply(edit)
        };
        self.applied(result, is_drag)
    }

    /// Changes the document as a part of the last step of undo. True if the document took the change; else a message
    /// tells why.
    pub(super) fn amend(&mut self, edit: &Edit) -> bool {
        let result = self.history.amend(&self.at_step_shown(edit));
        self.applied(result, false)
    }

    /// True if the figure that is shown changes from frame to frame: in a passage, and while a handle is dragged.
    pub fn is_passing(&self) -> bool {
        self.mode.is_moving() || (self.view.is_figure() && self.history.is_in_drag())
    }

    pub(super) fn applied(&mut self, result: Result<bool, DocumentError>, is_drag: bool) -> bool {
        match result {
            Ok(_) => {
                self.document_changed(if is_drag {
                    LinkChange::Replace
                } else {
                    LinkChange::Push
                });
                true
            }
            Err(error) => {
                self.notify(Gravity::Error, error.to_string(), "");
                false
            }
        }
    }

    pub(super) fn document_changed(&mut self, change: LinkChange) {
        self.playing = None;
        self.mode.rest(self.history.document());
        self.revision += 1;
        if self.tool == Tool::Clay && self.clay().is_none() {
            self.take_tool(Tool::Look);
        }
        let is_gone = match self.selection {
            Selection::Nothing => false,
            Selection::Template(index) => index >= self.template_count(),
            Selection::Object(index) => index >= self.object_count(),
            Selection::Stroke(index) => self.clay().is_none_or(|clay| index >= clay.strokes.len()),
        };
        if is_gone {
            self.selection = Selection::Nothing;
        }
        let listed = self.shown().figure.as_ref();
        let count = listed.map_or(0, |figure| figure.handles.len());
        self.view.figure.handles.retain(|index| *index < count);
        self.touch_link(change);
    }

    // ------------------------------------------------------------------------------------------------ the subject

    /// Another subject is shown. Distances and the crosshair stay where it fills the same box.
    pub fn set_subject(&mut self, subject: &Subject) {
        let before = self.shown_subject.take();
        self.load_is_shown();
        let both = self.shown_subject.as_ref().zip(before.as_ref());
        let is_same_clay = both.is_some_and(|(now, before)| now.is_same_clay(before));
        if !self.view.set_subject(subject, is_same_clay) && self.tool.is_measuring() {
            self.tool = Tool::Measure(None);
        }
    }
}

fn with_camera(document: &Document, camera: &Camera) -> Document {
    if document.illustration().camera == *camera {
        return document.clone();
    }
    let edit = Edit::SetCamera(*camera);
    edit.apply(document).unwrap_or_else(|_| document.clone())
}

/// The link of a document with another camera.
pub(super) fn payload_of(document: &Document, camera: &Camera) -> String {
    link::encode(&with_camera(document, camera))
}

#[cfg(test)]
impl Session {
    /// For unit tests: with a document and a scan of eight voxels of these sides, mm, with segments by labels and
    /// names, if there are any.
    pub(super) fn with_scan(json: &str, voxel_mm: f64, segments: &[(u16, &str)]) -> Self {
        use crate::data::{Segmentation, Volume, Voxels};
        let segmentation = Segmentation::cube(2, voxel_mm, |_| 0, segments);
        let mut session = Self::new(Document::from_json(json).expect("a valid document"));
        session.set_subject(&Subject::from(Volume {
            has_size: true,
            grid: segmentation.grid,
            voxels: Voxels::U8(vec![0; 8]),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 0.0],
            segmentation: Some(segmentation).filter(|all| !all.segments.is_empty()),
        }));
        session
    }
}
