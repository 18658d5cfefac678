//! What the app knows: the document and its history, what is selected, where one looks from, what is being loaded and what
//! was said. Commands change it; panels read it.

use glam::Vec3;

use super::camera;
use super::command::{Command, GizmoMode};
use super::frames::FileChoice;
use super::labels::Labelling;
use super::making::{Making, OnClipboard, placement_on_surface};
use super::services::{LinkChange, SaveFile, Services, Ticket};
use super::steps::Walk;
use super::tissue::Tissues;
use super::view::ViewState;
use super::words;
use crate::document::{
    Camera, Document, Edit, History, Illustration, PlacedTemplate, Reading, SubjectRef,
    TemplateKind,
};
use crate::link;

/// Characters above which a link is better passed on as a file.
pub(crate) const LONG_LINK: usize = 2000;

/// Seconds of rest before the link in the address bar is renewed.
const LINK_DELAY: f64 = 0.35;

/// Seconds in which the camera glides to a standard view.
const GLIDE_SECONDS: f64 = 0.3;

/// How grave a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Gravity {
    /// Something was done.
    Success,
    /// Something to know.
    Info,
    /// Something is not as written.
    Warning,
    /// Something could not be done.
    Error,
}

/// One line that the app says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Said {
    /// Number in the order in which things were said.
    pub id: u64,
    /// How grave.
    pub gravity: Gravity,
    /// One line in plain words.
    pub message: String,
    /// More, on demand; may be empty.
    pub details: String,
    /// Seconds on the clock of the interface when it goes by itself.
    pub until: Option<f64>,
    /// Still shown over the picture.
    pub is_shown: bool,
    /// Its details are unfolded.
    pub is_unfolded: bool,
}

/// A load under way.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Load {
    /// Which.
    pub ticket: Ticket,
    /// 0 to 1.
    pub fraction: f32,
    /// `Reading`.
    pub what: String,
    /// It becomes the document's subject when it is done.
    pub is_file: bool,
    /// It waits for leave to fetch from this host.
    pub host: Option<String>,
    /// How the file is read.
    pub reading: Reading,
    /// Volumes in the file, once that is known.
    pub frame_count: u64,
}

/// The camera on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glide {
    from: Camera,
    to: Camera,
    since: f64,
}

/// Which sheet of panels is open where there is room for one only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tab {
    /// The catalogue.
    Add,
    /// The list and the selected template.
    Templates,
    /// Segments, and what is made here.
    Tissues,
    /// Colours and background.
    Look,
    /// Title, caption, credit.
    Text,
}

/// All of it.
pub(crate) struct State {
    pub history: History,
    /// Where one looks from; joins the document when a link or a file is made, so that undo leaves it alone.
    pub camera: Camera,
    /// The camera that the document came with.
    pub home: Camera,
    pub(super) glide: Option<Glide>,
    /// The step that is shown.
    pub walk: Walk,
    /// Index in the document's `templates`.
    pub selected: Option<usize>,
    /// The kind that the next click on the object places.
    pub placing: Option<TemplateKind>,
    pub gizmo: GizmoMode,
    pub said: Vec<Said>,
    next_said: u64,
    pub load: Option<Load>,
    /// What was said of the last load that failed, until one is done.
    pub(super) load_failure: Option<u64>,
    /// What the subject's file leaves to choose.
    pub files: FileChoice,
    /// What the document shows was loaded (or is on its way).
    pub(super) requested: Option<SubjectRef>,
    pub tab: Option<Tab>,
    /// The tab of the right panel where there is room.
    pub side_tab: Tab,
    pub are_panels_hidden: bool,
    pub is_keys_sheet_open: bool,
    pub is_messages_open: bool,
    /// Payload of the document with the present camera.
    pub payload: String,
    /// The link is older than the document or the camera since this time.
    pub(super) link_stale_since: Option<f64>,
    /// The change that made the link stale was a drag or the camera.
    link_change: LinkChange,
    /// When the link was last copied, for the button's answer.
    pub copied_at: Option<f64>,
    /// A picture is wanted as a file.
    pub wants_picture_file: bool,
    /// A place in the middle of the picture is wanted for the template being placed.
    pub wants_place_in_middle: bool,
    pub theme_toggle: bool,
    pub contrast_toggle: bool,
    /// The panel that was turned to wants the keyboard.
    pub wants_panel_focus: bool,
    /// The first hint is shown.
    pub wants_hint: bool,
    /// Title and credit are written into saved pictures.
    pub is_lettering: bool,
    pub scale_change: Option<f32>,
    /// Labels that are being set.
    pub labelling: Labelling,
    /// Copying, grouping, snapping, searching.
    pub making: Making,
    /// Seconds on the clock of the interface.
    pub now: f64,
    /// Rises with every change of document.
    pub revision: u64,
    /// How one looks besides the camera.
    pub view: ViewState,
    /// What of the tissues is edited or shown.
    pub tissues: Tissues,
}

impl State {
    /// Of a document that was just opened.
    pub(crate) fn new(document: Document) -> Self {
        let camera = document.illustration().camera;
        let payload = make_payload(&document, &camera);
        Self {
            history: History::new(document),
            camera,
            home: camera,
            glide: None,
            walk: Walk::default(),
            selected: None,
            placing: None,
            gizmo: GizmoMode::Move,
            said: Vec::new(),
            next_said: 0,
            load: None,
            load_failure: None,
            files: FileChoice::default(),
            requested: None,
            tab: None,
            side_tab: Tab::Templates,
            are_panels_hidden: false,
            is_keys_sheet_open: false,
            is_messages_open: false,
            payload,
            link_stale_since: None,
            link_change: LinkChange::Replace,
            copied_at: None,
            wants_picture_file: false,
            wants_place_in_middle: false,
            labelling: Labelling::default(),
            theme_toggle: false,
            contrast_toggle: false,
            wants_panel_focus: false,
            wants_hint: false,
            is_lettering: false,
            scale_change: None,
            making: Making::default(),
            now: 0.0,
            revision: 0,
            view: ViewState::default(),
            tissues: Tissues::default(),
        }
    }

    /// The document as it stands, with the camera it was opened with.
    pub(crate) fn document(&self) -> &Document {
        self.history.document()
    }

    /// What the document says, with the camera it was opened with.
    pub(crate) fn illustration(&self) -> &Illustration {
        self.document().illustration()
    }

    /// The document with the present camera: what a link, a file and the picture show.
    ///
    /// At a step it is the author's camera: the one that the step turned would be step 0's.
    pub(crate) fn document_as_seen(&self) -> Document {
        match self.walk.step() {
            0 => with_camera(self.document(), &self.camera),
            _ => self.document().clone(),
        }
    }

    /// What the picture shows: the document, or the step at which one stands.
    pub(crate) fn shown(&self) -> &Illustration {
        self.walk.shown().unwrap_or_else(|| self.illustration())
    }

    /// What the picture shows, from where one looks.
    pub(crate) fn shown_as_seen(&self) -> Illustration {
        Illustration {
            camera: self.camera,
            ..self.shown().clone()
        }
    }

    /// The selected template, if it is one that can be drawn.
    pub(crate) fn selected_template(&self) -> Option<&PlacedTemplate> {
        let index = self.selected?;
        self.illustration()
            .templates
            .iter()
            .find(|t| t.index == index)
    }

    /// Entries of the document's `templates`, unknown kinds included.
    pub(crate) fn template_count(&self) -> usize {
        self.document()
            .get("/templates")
            .and_then(|list| list.as_array())
            .map_or(0, Vec::len)
    }

    // ------------------------------------------------------------------------------------------------ saying

    /// Says one line over the picture; errors and warnings stay until they are put away.
    pub(crate) fn say(
        &mut self,
        gravity: Gravity,
        message: impl Into<String>,
        details: impl Into<String>,
    ) {
        let seconds = match gravity {
            Gravity::Success => Some(3.0),
            Gravity::Info => Some(8.0),
            Gravity::Warning => Some(20.0),
            Gravity::Error => None,
        };
        let (message, details) = (message.into(), details.into());
        // The same again takes the place of the first.
        self.said
            .retain(|said| !(said.is_shown && said.message == message));
        self.said.push(Said {
            id: self.next_said,
            gravity,
            message,
            details,
            until: seconds.map(|s| self.now + s),
            is_shown: true,
            is_unfolded: false,
        });
        self.next_said += 1;
        if self.said.len() > 200 {
            self.said.remove(0);
        }
    }

    /// Puts a line away that is true no more.
    pub(crate) fn unsay(&mut self, message: &str) {
        for said in self.said.iter_mut().filter(|said| said.message == message) {
            said.is_shown = false;
        }
    }

    /// Seconds until the first of the shown lines goes by itself.
    pub(crate) fn seconds_to_next_expiry(&self) -> Option<f64> {
        let shown = self.said.iter().filter(|said| said.is_shown);
        shown
            .filter_map(|said| said.until)
            .map(|until| until - self.now)
            .min_by(f64::total_cmp)
    }

    // ------------------------------------------------------------------------------------------------ time

    /// Goes with the clock: glides the camera, puts old lines away, renews the link. True if it wants to be called again at once.
    pub(crate) fn advance(&mut self, now: f64, services: &mut dyn Services) -> bool {
        self.now = now;
        for said in &mut self.said {
            if said.until.is_some_and(|until| until <= now) && !said.is_unfolded {
                said.is_shown = false;
            }
        }
        if self.copied_at.is_some_and(|at| now - at > 2.0) {
            self.copied_at = None;
        }
        if self
            .link_stale_since
            .is_some_and(|since| now - since >= LINK_DELAY)
        {
            self.renew_link(services);
        }
        let is_walking = self.walk.is_moving();
        if is_walking {
            if let Some(camera) = self.walk.advance(self.history.document(), now) {
                self.camera = camera;
            }
            self.revision += 1;
        }
        let Some(glide) = self.glide else {
            return is_walking;
        };
        let t = ((now - glide.since) / GLIDE_SECONDS).clamp(0.0, 1.0) as f32;
        self.camera = camera::between(&glide.from, &glide.to, t);
        if t >= 1.0 {
            self.camera = glide.to;
            self.glide = None;
        }
        true
    }

    /// Seconds until [`Self::advance`] has something to do although nothing else happens.
    pub(crate) fn seconds_to_next_deed(&self) -> Option<f64> {
        let link = self
            .link_stale_since
            .map(|since| since + LINK_DELAY - self.now);
        let copied = self.copied_at.map(|at| at + 2.0 - self.now);
        [link, copied, self.seconds_to_next_expiry()]
            .into_iter()
            .flatten()
            .map(|seconds| seconds.max(0.0) + 0.01)
            .min_by(f64::total_cmp)
    }

    /// The camera was moved by hand: a glide under way ends, the link is renewed when it rests.
    pub(crate) fn camera_moved(&mut self) {
        self.glide = None;
        self.touch_link(LinkChange::Replace);
    }

    /// Turns the look to a point of the object, from the same side.
    pub(crate) fn look_at(&mut self, target: Vec3) {
        self.glide_to(Camera {
            target,
            ..self.camera
        });
    }

    fn glide_to(&mut self, to: Camera) {
        self.glide = Some(Glide {
            from: self.camera,
            to,
            since: self.now,
        });
        self.touch_link(LinkChange::Replace);
    }

    fn touch_link(&mut self, change: LinkChange) {
        if self.link_stale_since.is_none() {
            self.link_change = LinkChange::Replace;
        }
        if change == LinkChange::Push {
            self.link_change = LinkChange::Push;
        }
        self.link_stale_since = Some(self.now);
    }

    fn renew_link(&mut self, services: &mut dyn Services) {
        self.link_stale_since = None;
        let camera = match self.walk.step() {
            0 => self.glide.map_or(self.camera, |glide| glide.to),
            _ => self.illustration().camera,
        };
        self.payload = make_payload(self.document(), &camera);
        services.set_link(&self.link_tail(), self.link_change);
        services.store(STORED_DOCUMENT, &self.link_tail());
    }

    /// What stands behind the `#` of the link: the payload, and the step one stands at.
    pub(super) fn link_tail(&self) -> String {
        match self.walk.step() {
            0 => self.payload.clone(),
            step => format!("{}&step={step}", self.payload),
        }
    }

    /// Goes to a step; nothing is selected or placed there, for a step is looked at.
    fn go_to_step(&mut self, step: usize) {
        self.glide = None;
        self.selected = None;
        self.placing = None;
        let document = self.history.document();
        if let Some(camera) = self.walk.go(document, step, self.now, self.camera) {
            self.camera = camera;
        }
        self.revision += 1;
        self.touch_link(LinkChange::Push);
    }

    /// Back from the steps to the document as it stands, which is what is edited.
    pub(super) fn leave_steps(&mut self) {
        if self.walk.step() > 0 || self.walk.is_moving() {
            self.walk = Walk::default();
            self.revision += 1;
            self.touch_link(LinkChange::Replace);
        }
    }

    // ------------------------------------------------------------------------------------------------ commands

    /// Does it. What cannot be done is said.
    pub(crate) fn run(&mut self, command: Command, services: &mut dyn Services) {
        match command {
            Command::Undo => self.undo_or_redo(true, services),
            Command::Redo => self.undo_or_redo(false, services),
            Command::Apply(edit) => self.apply(&self.with_group(edit), false),
            Command::Drag(edit) => self.apply(&self.with_group(edit), true),
            Command::GoToStep(step) => self.go_to_step(step),
            Command::WalkStep(forward) => {
                let step = self.walk.step();
                let next = if forward {
                    step + 1
                } else {
                    step.saturating_sub(1)
                };
                if self.document().step_count() > 0 {
                    self.go_to_step(next);
                }
            }
            Command::StartPlacing(kind) => {
                self.end_tissues();
                self.leave_steps();
                self.view.measures.is_on = false;
                self.placing = if self.placing == Some(kind) {
                    None
                } else {
                    Some(kind)
                };
                if self.tab == Some(Tab::Add) {
                    self.tab = None;
                }
            }
            Command::PlaceInMiddle => {
                self.wants_place_in_middle = self.placing.is_some() || self.labelling.is_placing;
            }
            Command::ToggleLabelling => self.toggle_labelling(),
            Command::Escape => self.escape(),
            Command::Select(index) => {
                self.selected = index;
                self.placing = None;
                if index.is_some() {
                    self.leave_steps();
                    self.side_tab = Tab::Templates;
                }
            }
            Command::SelectNext(forward) => self.select_next(forward),
            Command::DeleteSelected => {
                if let Some(template) = self.selected {
                    self.apply(&Edit::RemoveTemplate { template }, false);
                    let count = self.template_count();
                    self.selected = count.checked_sub(1).map(|last| template.min(last));
                }
            }
            Command::DuplicateSelected => {
                if let Some(template) = self.selected
                    && self.apply_checked(&Edit::DuplicateTemplate { template }, false)
                {
                    self.selected = Some(template + 1);
                }
            }
            Command::Copy => {
                self.copy_templates(services);
            }
            Command::Cut => self.cut_templates(services),
            Command::Paste => services.paste_text(),
            Command::Mirror(plane, as_copy) => self.mirror_selected(plane, as_copy),
            Command::LayOnSurface => self.making.wants_surface = self.selected,
            Command::FollowSurface => self.making.wants_curve = self.selected,
            Command::GroupWithPrevious => self.group_with_previous(),
            Command::LeaveGroup => self.leave_group(),
            Command::ToggleSnap => self.making.is_snapping = !self.making.is_snapping,
            Command::Search(text) => self.making.search = text,
            Command::StartSearch => {
                self.making.wants_search = true;
                self.are_panels_hidden = false;
                self.tab = Some(Tab::Add);
            }
            Command::ToggleSelected => {
                if let Some(template) = self.selected_template() {
                    let edit = Edit::SetEnabled {
                        template: template.index,
                        enabled: !template.enabled,
                    };
                    self.apply(&edit, false);
                }
            }
            Command::ShiftSelected(by) => self.shift_selected(by),
            Command::NudgeMain(hundredths) => self.nudge_main(hundredths),
            Command::SetGizmo(mode) => self.gizmo = mode,
            Command::View(view) => self.glide_to(Camera {
                rotate: view.rotation(),
                ..self.camera
            }),
            Command::ResetView => self.glide_to(self.home),
            Command::Orbit(x, y) => {
                camera::orbit(&mut self.camera, egui::vec2(x, y));
                self.camera_moved();
            }
            Command::Zoom(factor) => {
                camera::zoom(&mut self.camera, factor);
                self.camera_moved();
            }
            Command::SetSubject(subject) => {
                self.apply(&Edit::SetSubject(subject), false);
                self.load_subject(services);
            }
            Command::Open => services.open_file(),
            Command::New => {
                self.open_document(Document::new(), 0, services);
                self.touch_link(LinkChange::Push);
            }
            Command::CopyLink => self.copy_link(services),
            Command::SaveDocument => {
                let document = self.document_as_seen();
                services.save_file(SaveFile {
                    name: format!("{}.json", self.file_stem()),
                    mime: "application/json",
                    bytes: document.to_json().into_bytes(),
                });
            }
            Command::SavePicture => self.wants_picture_file = true,
            Command::CancelLoad => {
                if let Some(load) = &self.load {
                    services.cancel_load(load.ticket);
                }
            }
            Command::AllowHost => {
                if let Some(load) = &mut self.load
                    && load.host.take().is_some()
                {
                    services.allow_host(load.ticket);
                }
            }
            Command::See(see) => self.view.run(see),
            Command::Tissue(command) => {
                self.tissues.run(command);
                self.revision += 1;
            }
            Command::ToggleKeys => self.is_keys_sheet_open = !self.is_keys_sheet_open,
            Command::ToggleFrames => self.files.is_open = !self.files.is_open,
            Command::ToggleMessages => self.is_messages_open = !self.is_messages_open,
            Command::ToggleContrast => self.contrast_toggle = true,
            Command::ToggleLettering => {
                self.is_lettering = !self.is_lettering;
                let kept = if self.is_lettering { "yes" } else { "no" };
                services.store(super::STORED_LETTERING, kept);
            }
            // Which panels there are depends on the room for them: the app does it.
            Command::NextPanel(_) => {}
            Command::PutHintAway => self.put_hint_away(services),
            Command::ToggleTheme => self.theme_toggle = true,
            Command::Speak(lang) => {
                words::set_lang(lang);
                services.store(words::STORED_LANGUAGE, lang.tag());
            }
            Command::Scale(factor) => self.scale_change = Some(factor),
            Command::TogglePanels => {
                self.are_panels_hidden = !self.are_panels_hidden;
                self.tab = None;
            }
        }
    }

    /// Other things are being done than with tissues: everything is shown, and clicks are for others.
    pub(crate) fn end_tissues(&mut self) {
        self.tissues.is_seeding = false;
        if self.tissues.alone.take().is_some() {
            self.revision += 1;
        }
    }

    /// Ends the drag under way, so that the next change is a new step of undo.
    pub(crate) fn end_drag(&mut self) {
        self.history.end_drag();
    }

    pub(crate) fn apply(&mut self, edit: &Edit, is_drag: bool) {
        self.apply_checked(edit, is_drag);
    }

    /// True if the document took it.
    pub(super) fn apply_checked(&mut self, edit: &Edit, is_drag: bool) -> bool {
        let result = if is_drag {
            self.history.drag(edit)
        } else {
            self.history.apply(edit)
        };
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
                self.say(Gravity::Error, error.to_string(), "");
                false
            }
        }
    }

    fn document_changed(&mut self, change: LinkChange) {
        self.leave_steps();
        self.revision += 1;
        if self
            .selected
            .is_some_and(|index| index >= self.template_count())
        {
            self.selected = None;
        }
        self.touch_link(change);
    }

    fn undo_or_redo(&mut self, is_undo: bool, services: &mut dyn Services) {
        self.history.end_drag();
        let did = if is_undo {
            self.history.undo()
        } else {
            self.history.redo()
        };
        if did {
            self.document_changed(LinkChange::Push);
            self.load_subject(services);
        }
    }

    fn escape(&mut self) {
        if self.is_keys_sheet_open || self.is_messages_open {
            self.is_keys_sheet_open = false;
            self.is_messages_open = false;
        } else if self.placing.is_some() {
            self.placing = None;
        } else if self.labelling.is_placing {
            self.labelling.is_placing = false;
        } else if self.tissues.is_seeding {
            self.tissues.is_seeding = false;
        } else if self.view.escape() {
            // It dropped what was being measured, or went back to all views.
        } else if !self.making.search.is_empty() {
            self.making.search.clear();
        } else if self.tab.is_some() {
            self.tab = None;
        } else if self.are_panels_hidden {
            self.are_panels_hidden = false;
        } else {
            self.selected = None;
        }
    }

    fn select_next(&mut self, forward: bool) {
        let count = self.template_count();
        if count == 0 {
            return;
        }
        self.leave_steps();
        let step = if forward { 1 } else { count - 1 };
        self.selected = Some(match self.selected {
            Some(index) => (index + step) % count,
            None if forward => 0,
            None => count - 1,
        });
        self.side_tab = Tab::Templates;
    }

    fn shift_selected(&mut self, by: i8) {
        let Some(from) = self.selected else {
            return;
        };
        let to = from.saturating_add_signed(isize::from(by));
        if to != from && to < self.template_count() {
            self.move_template(from, to);
        }
    }

    /// Moves an entry of the list; the selection goes with it.
    pub(crate) fn move_template(&mut self, from: usize, to: usize) {
        if self.apply_checked(&Edit::MoveTemplate { from, to }, false) {
            self.selected = Some(to);
        }
    }

    fn nudge_main(&mut self, hundredths: f32) {
        use crate::document::{ParamKind, ParamValue};
        let Some(template) = self.selected_template() else {
            return;
        };
        let spec = template.kind.spec();
        let Some(param) = spec.main_param else {
            return;
        };
        let (kind, value) = (&spec.params[param].kind, template.params[param]);
        let value = match (kind, value) {
            (
                ParamKind::Number { min, max, .. } | ParamKind::Count { min, max, .. },
                ParamValue::Number(value),
            ) => ParamValue::Number((value + (max - min) * hundredths / 100.0).clamp(*min, *max)),
            (_, ParamValue::Vector(v)) => {
                ParamValue::Vector(v + v.normalize_or(Vec3::Z) * hundredths / 100.0)
            }
            _ => return,
        };
        let edit = Edit::SetParam {
            template: template.index,
            param: spec.params[param].name,
            value,
        };
        self.apply(&edit, true);
    }

    /// Puts a new template of the kind being placed onto the object, and selects it. `normal` points out of the object.
    pub(crate) fn place(&mut self, pos: Vec3, normal: Vec3) {
        let Some(kind) = self.placing.take() else {
            return;
        };
        let placement = placement_on_surface(kind, pos, normal, &self.camera);
        let index = self.template_count();
        if self.apply_checked(
            &Edit::AddTemplate {
                index,
                kind,
                placement,
            },
            false,
        ) {
            self.selected = Some(index);
            self.side_tab = Tab::Templates;
        }
    }

    fn copy_link(&mut self, services: &mut dyn Services) {
        self.making.on_clipboard = OnClipboard::Link;
        // The last of its three steps.
        self.put_hint_away(services);
        self.renew_link(services);
        let page = services.page_address();
        let page = page.split('#').next().unwrap_or_default();
        services.copy_text(format!("{page}#{}", self.link_tail()));
    }

    /// File name without an ending, out of the title.
    pub(crate) fn file_stem(&self) -> String {
        let title = &self.illustration().title;
        let mut stem: String = title
            .chars()
            .map(|c| {
                if c.is_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '-'
                }
            })
            .take(60)
            .collect();
        while stem.contains("--") {
            stem = stem.replace("--", "-");
        }
        match stem.trim_matches('-') {
            "" => "fabrica".to_owned(),
            stem => stem.to_owned(),
        }
    }
}

/// Under which the last document is kept for the next start.
pub const STORED_DOCUMENT: &str = "document";

fn with_camera(document: &Document, camera: &Camera) -> Document {
    if document.illustration().camera == *camera {
        return document.clone();
    }
    let edit = Edit::SetCamera(*camera);
    edit.apply(document).unwrap_or_else(|_| document.clone())
}

pub(super) fn make_payload(document: &Document, camera: &Camera) -> String {
    link::encode(&with_camera(document, camera))
}
