//! Runs commands: each changes the session and may return effects.

use std::f32::consts::PI;

use glam::Vec2;

use super::camera;
use super::command::{Command, StepCommand};
use super::effect::{Effect, Focus};
use super::mesh_use::MeshUse;
use super::notices::Gravity;
use super::question::{Place, Question};
use super::selection::Selection;
use super::session::{Session, Tab};
use super::tool::Tool;
use super::view::See;
use crate::app::words::{self, fill};
use crate::displace::Holds;
use crate::document::{Camera, Document, TemplateKind};

/// The key under which it is kept that the first hint was seen.
pub const STORED_HINT: &str = "hint";
/// The key under which it is kept that the reader was told of slow graphics.
pub const STORED_SLOW: &str = "slow";
/// The key under which it is kept whether title and credit are written into saved pictures.
pub const STORED_LETTERING: &str = "lettering";
/// The key under which it is kept whether the title stands over the picture.
pub const STORED_TITLE: &str = "title";

/// Graphics are slow if a whole picture takes longer, seconds.
const SLOW_SECONDS: f32 = 1.0;

impl Session {
    /// Runs a command at the time `now`, seconds on the clock of the interface. Returns the effects for the app, in
    /// order.
    /// A message tells why where something cannot be done.
    pub fn run(&mut self, command: Command, now: f64) -> Vec<Effect> {
        self.now = now;
        // Whoever does something else has not chosen a picture.
        self.view.figure.wants_reference = false;
        match command {
            Command::Undo if self.take_ghost_back() => {}
            Command::Redo if self.lay_ghost_again() => {}
            Command::Undo => self.undo_or_redo(true),
            Command::Redo => self.undo_or_redo(false),
            Command::Apply(edit) => {
                self.close_drags();
                self.apply(&self.with_group(edit), false);
            }
            Command::Drag(edit) => {
                self.close_drags();
                self.apply(&self.with_group(edit), true);
            }
            Command::GoToStep(step) => {
                self.playing = None;
                self.go_to_step(step);
            }
            Command::Step(command) => self.run_step(command),
            Command::WalkStep(forward) => self.walk_step(forward),
            Command::StartPlacing(kind) => self.start_placing(kind),
            Command::PlaceInMiddle => self.use_tool_in_middle(),
            Command::Figure(command) => self.run_figure(command),
            Command::ToggleCaptioning => self.toggle_captioning(),
            Command::UseToolAt(pixel) => self.use_tool_at(pixel),
            Command::LookAtPixel(pixel) => {
                let question =
                    Question::new(Place::Pixel(pixel), |_, found| Command::LookAt(found));
                self.effect(Effect::Ask(question));
            }
            Command::PlaceOn(found) => self.place_on(found),
            Command::PlaceOnOrAtTarget(found) => self.place_on_or_at_target(found),
            Command::PlaceAt { pos, normal } => self.place_at(pos, normal),
            Command::Hand(command) => self.run_hand(command),
            Command::CaptionOn(found) => self.caption_on(found),
            Command::SeedOn(found) => self.seed_on(found),
            Command::AddSeed(pos, value) => {
                if let Some(open) = self.tissues.open {
                    self.add_seed(open, pos, value);
                }
            }
            Command::Measure(pos) => self.measure(pos),
            Command::LookAt(found) => self.look_at(found),
            Command::LayOn(template, found) => self.lay_on(template, found),
            Command::Trace(index, found) => self.trace(index, found),
            Command::Escape => self.escape(),
            Command::Select(index) => self.select(Selection::of_template(index)),
            Command::SelectObject(index) => self.select(Selection::of_object(index)),
            Command::AddTool(tool) => self.ask_place_of_tool(tool),
            Command::SelectAt(pixel) => self.ask_what_to_select(pixel),
            Command::SelectSeen(_, found) => {
                if let Some(object) = found.and_then(|found| found.object) {
                    self.select(Selection::Object(object));
                }
            }
            Command::PlaceCarving(_, found) => self.place_carving(found),
            Command::PlaceTool(tool, found) => self.place_tool(tool, found),
            Command::SelectNext(forward) => self.select_next(forward),
            Command::DeleteSelected if self.take_ghost_back() || self.lift_laid() => {}
            Command::DeleteSelected => self.delete_selected(),
            Command::DuplicateSelected => self.duplicate_selected(),
            Command::Copy => {
                self.copy_templates();
            }
            Command::Cut => self.cut_templates(),
            Command::Paste => self.effect(Effect::Paste),
            Command::Mirror(plane, as_copy) => self.mirror_selected(plane, as_copy),
            Command::LayOnSurface => self.ask_surface_under_selected(),
            Command::FollowSurface => self.ask_surface_along_selected(),
            Command::GroupWithPrevious => self.group_with_previous(),
            Command::LeaveGroup => self.leave_group(),
            Command::ToggleSnap => self.is_snapping = !self.is_snapping,
            Command::Search(text) => self.search = text,
            Command::StartSearch => {
                self.are_panels_hidden = false;
                self.tab = Some(Tab::Add);
                self.effect(Effect::Focus(Focus::Search));
            }
            Command::StartSeeking => self.start_seeking(),
            Command::Seek(sought) => self.seek(sought),
            Command::SeekFirst => self.seek_first(),
            Command::TurnTo(sought, site) => self.turn_to(&sought, site),
            Command::ToggleSelected => self.toggle_selected(),
            Command::ShiftSelected(by) => self.shift_selected(by),
            // The keys are those of the ball while it is in hand.
            Command::NudgeMain(by) if self.tool().ball().is_some() => self.resize_ball(by > 0.0),
            Command::NudgeMain(by) if self.has_hand() => self.resize_held_tool(by > 0.0),
            Command::NudgeMain(hundredths) if self.view.is_figure() => {
                self.turn_of_figure(hundredths);
            }
            Command::NudgeMain(hundredths) => self.nudge_main(hundredths),
            Command::SetGizmo(mode) => self.gizmo = mode,
            Command::View(_) if self.view.is_figure() => {}
            Command::View(view) => self.glide_to(Camera {
                rotate: view.rotation(),
                ..self.camera
            }),
            Command::ResetView => self.glide_to(self.home),
            Command::MoveCamera(camera) => self.move_camera(camera),
            Command::Orbit(x, y) if self.laid().is_some() => self.nudge_laid(x, y),
            Command::Orbit(x, y) => {
                let mut camera = self.camera;
                match self.view.is_figure() {
                    // It is flat: what would turn it moves it. Half a turn is the whole picture.
                    true => camera::shift(&mut camera, Vec2::new(x, y) / PI),
                    false => camera::orbit(&mut camera, Vec2::new(x, y)),
                }
                self.move_camera(camera);
            }
            Command::Zoom(factor) => {
                let mut camera = self.camera;
                camera::zoom(&mut camera, factor);
                self.move_camera(camera);
            }
            Command::SetSubject(subject) => self.choose_subject(subject),
            Command::KeepTemplates => self.keep_templates(),
            Command::Open => self.effect(Effect::OpenFile),
            Command::New => {
                self.keep_work();
                self.start_document(Document::fresh(), "New document".to_owned());
                self.load_subject();
            }
            Command::CopyLink => self.copy_link(),
            Command::SaveDocument => self.save_document(),
            Command::SaveMesh(format) => {
                if self.has_mesh_to_save() {
                    self.effect(Effect::SaveMesh(format));
                }
            }
            Command::SetPictureSize(longer_px) => self.picture_px = longer_px,
            Command::SetPictureDpi(dpi) => self.picture_dpi = dpi,
            Command::SetPicturePaper(paper) => self.picture_paper = paper,
            Command::SavePicture => self.effect(Effect::SavePicture),
            Command::StopSaving => self.effect(Effect::StopSaving),
            Command::CancelLoad => {
                if let Some(load) = &self.load {
                    self.effects.push(Effect::CancelLoad(load.ticket));
                }
            }
            Command::AllowHost => {
                if let Some(load) = &mut self.load
                    && load.host.take().is_some()
                {
                    self.effects.push(Effect::AllowHost(load.ticket));
                }
            }
            Command::AllowFields(notice, host) => {
                self.notices.dismiss(notice);
                self.effect(Effect::AllowFields(host));
            }
            Command::UseMesh(answer) => self.use_mesh(answer),
            Command::Raw(command) => self.run_raw(command),
            Command::See(See::ToggleSlices | See::ToggleGhost) if self.view.is_figure() => {}
            Command::See(See::ToggleWires) if !self.view.is_mesh() => {}
            Command::See(see) => self.run_see(see),
            Command::Tissue(command) => self.run_tissue(command),
            Command::Clay(command) => self.run_clay(command),
            Command::Library(command) => self.run_library(command),
            Command::ToggleKeys => self.is_keys_sheet_open = !self.is_keys_sheet_open,
            Command::ToggleShare => self.toggle_share(),
            Command::CopySnippet(form) => self.copy_snippet(form),
            Command::ToggleFrames => self.files.is_open = !self.files.is_open,
            Command::ToggleMessages => self.is_messages_open = !self.is_messages_open,
            Command::Notify(gravity, message, details) => self.notify(gravity, message, details),
            Command::Dismiss(id) => self.notices.dismiss(id),
            Command::Unfold(id) => self.notices.unfold(id),
            Command::EditCaption(index) => self.edit_caption(index),
            Command::ToggleContrast => self.effect(Effect::ToggleContrast),
            Command::ToggleLettering => {
                self.is_lettering = !self.is_lettering;
                self.store(STORED_LETTERING, yes_or_no(self.is_lettering));
            }
            Command::ToggleTitle => {
                self.has_title = !self.has_title;
                self.store(STORED_TITLE, yes_or_no(self.has_title));
            }
            Command::NextPanel(forward) => self.next_panel(forward),
            Command::PutHintAway => self.put_hint_away(),
            Command::ToggleTheme => self.effect(Effect::ToggleTheme),
            Command::Speak(lang) => {
                words::set_lang(lang);
                self.store(words::STORED_LANGUAGE, lang.tag());
            }
            Command::Scale(factor) => self.effect(Effect::Scale(factor)),
            Command::TogglePanels => {
                self.are_panels_hidden = !self.are_panels_hidden;
                self.tab = None;
            }
        }
        self.take_effects()
    }

    fn walk_step(&mut self, forward: bool) {
        self.playing = None;
        let step = self.step();
        let next = match forward {
            // First to the end of a passage that stands still.
            true if self.is_paused() => step,
            true => step + 1,
            false => step.saturating_sub(1),
        };
        if self.document().step_count() > 0 {
            self.go_to_step(next);
        }
    }

    /// Takes a template in hand that is to be placed, or puts it away.
    pub(super) fn start_placing(&mut self, kind: TemplateKind) {
        self.end_tissues();
        if kind.facts().holds == Holds::Object {
            return self.start_carving(kind);
        }
        self.drawn = None;
        let is_same = self.tool == Tool::Place(kind);
        if kind == TemplateKind::Sweep {
            self.ready_to_sweep();
            self.side_tab = Tab::Templates;
        }
        self.take_tool(if is_same {
            Tool::Look
        } else {
            Tool::Place(kind)
        });
        if self.tab == Some(Tab::Add) {
            self.tab = None;
        }
    }

    fn toggle_captioning(&mut self) {
        if self.tool == Tool::Caption {
            self.take_tool(Tool::Look);
        } else {
            self.take_tool(Tool::Caption);
            self.tab = None;
        }
    }

    /// Closes or ends the topmost thing: one at a time.
    fn escape(&mut self) {
        if self.is_asking_about_mesh() {
            self.use_mesh(MeshUse::Nothing);
        } else if self.is_share_open {
            self.is_share_open = false;
        } else if self.is_keys_sheet_open || self.is_messages_open {
            self.is_keys_sheet_open = false;
            self.is_messages_open = false;
        } else if self.playing.is_some() {
            self.run_step(StepCommand::TogglePlay);
        } else if self.library.is_open {
            self.library.is_open = false;
        } else if matches!(self.tool, Tool::Measure(Some(_))) {
            self.take_tool(Tool::Measure(None));
        } else if !self.view.figure.draft.is_empty() {
            self.view.figure.draft.clear();
        } else if self.drop_ghosts() || self.lift_laid() {
            // Nothing of it is done.
        } else if self.tool != Tool::Look {
            self.take_tool(Tool::Look);
        } else if self.leave_making() {
            // The tissue is not made.
        } else if self.view.expanded.take().is_some() {
            // All views are back.
        } else if !self.search.is_empty() {
            self.search.clear();
        } else if !self.tissues.search.is_empty() {
            self.tissues.search.clear();
        } else if self.tab.is_some() {
            self.tab = None;
        } else if self.are_panels_hidden {
            self.are_panels_hidden = false;
        } else {
            self.selection = Selection::Nothing;
            self.tissues.selected = None;
            self.view.figure.let_go();
        }
    }

    fn run_see(&mut self, see: See) {
        let view = &mut self.view;
        match see {
            See::ToggleSlices => {
                view.is_split = !view.is_split;
                view.expanded = None;
            }
            See::Expand(pane) => view.expanded = pane,
            See::ToggleSliceColors => view.has_slice_colors = !view.has_slice_colors,
            See::Cross(pos) => view.set_cross(pos),
            See::ReadCross(read) => view.cross_read = read,
            See::ToggleGhost => view.has_ghost = !view.has_ghost,
            See::ToggleWires => {
                view.has_wires = !view.has_wires;
                // The picture is another one.
                self.revision += 1;
            }
            See::ToggleMeasure => {
                let is_on = self.tool.is_measuring();
                self.take_tool(if is_on {
                    Tool::Look
                } else {
                    Tool::Measure(None)
                });
            }
            See::ToggleLevel => {
                let is_on = self.tool.is_levelling();
                self.take_tool(if is_on { Tool::Look } else { Tool::Level });
                // There is nothing to drag over without slices.
                self.view.is_split |= !is_on;
            }
            See::RemoveMeasure(index) => view.measures.remove(index),
        }
    }

    /// Turns to the next panel, or the one before, and gives it the keyboard.
    fn next_panel(&mut self, forward: bool) {
        const PANELS: [Tab; 5] = [Tab::Add, Tab::Templates, Tab::Tissues, Tab::Look, Tab::Text];
        // The catalogue has a place of its own where there is room.
        let panels = &PANELS[usize::from(!self.are_drawers)..];
        let current = if self.are_drawers {
            self.tab
        } else {
            Some(self.side_tab)
        };
        let at = panels.iter().position(|tab| Some(*tab) == current);
        let count = panels.len();
        let next = match (at, forward) {
            (Some(at), true) => (at + 1) % count,
            (Some(at), false) => (at + count - 1) % count,
            (None, true) => 0,
            (None, false) => count - 1,
        };
        self.are_panels_hidden = false;
        self.side_tab = panels[next];
        self.tab = self.are_drawers.then_some(panels[next]);
        self.effect(Effect::Focus(Focus::Panel));
    }

    /// The device takes so many seconds for a whole picture, as far as was measured. Where that is long the reader is
    /// told, once for all: the picture comes in steps, and that is no fault.
    pub fn take_pace(&mut self, whole_seconds: Option<f32>) {
        let slow = whole_seconds.filter(|seconds| *seconds > SLOW_SECONDS);
        let Some(seconds) = slow.filter(|_| !self.has_told_slow && !self.are_panels_hidden) else {
            return;
        };
        self.has_told_slow = true;
        self.store(STORED_SLOW, "told");
        let w = words::messages::w();
        let seconds = words::localized(format!("{seconds:.1}"));
        self.notify(Gravity::Info, w.slow, fill(w.slow_details, &[&seconds]));
    }

    /// The first hint was read or followed to its end: it does not come again.
    pub(super) fn put_hint_away(&mut self) {
        if std::mem::take(&mut self.has_hint) {
            self.store(STORED_HINT, "seen");
        }
    }
}

/// A wish as it is kept for the next start.
fn yes_or_no(is_wished: bool) -> &'static str {
    if is_wished { "yes" } else { "no" }
}
