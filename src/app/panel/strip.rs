//! The strip of steps under the picture: a small picture of each, to go there, to order them, to add one; and what
//! plays the lesson.
//!
//! The pictures are drawn while the strip is shown and nothing else is: one at a time, once the picture in the middle
//! is complete and no button is held. Each stays until its step shows something else. Of a clay that grows by steps the
//! picture of a step comes when the step is shown: its strokes are done then.

use std::sync::Arc;

use egui::{
    Align2, Color32, ColorImage, Context, CornerRadius, DragAndDrop, EventFilter, FontId, Id, Key,
    Modifiers, Rect, Role, ScrollArea, Sense, Slider, Stroke, StrokeKind, TextureHandle,
    TextureOptions, Ui, WidgetInfo, pos2, vec2,
};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _};
use crate::app::picture::host::Picture;
use crate::app::session::{Command, Session, StepCommand};
use crate::app::words::{fill, steps::w};
use crate::assets::Bending;
use crate::data::{Pending, poll_once};
use crate::document::{Document, Illustration, SubjectRef};
use crate::render::{Image, RenderError};

/// Width and height of a picture, pixels.
const PICTURE_PX: [u32; 2] = [112, 84];
/// Width of a tile, and height of its picture and of its name, points.
const WIDTH: f32 = 76.0;
const HEIGHT: f32 = 57.0;
const NAME: f32 = 18.0;
const GAP: f32 = 5.0;
/// A place this near to a step is the step, of the way between two.
const NEAR: f32 = 0.06;
/// Window heights below this have no room for the strip, points.
const LEAST_HEIGHT: f32 = 420.0;

/// Height of the strip, points.
pub(crate) fn height() -> f32 {
    theme::control_height() + HEIGHT + NAME + 22.0
}

/// True if the strip is shown in a window of this height.
pub(crate) fn is_shown(session: &Session, window_height: f32) -> bool {
    let is_drawer_open = session.are_drawers && session.tab.is_some();
    session.document().step_count() > 0
        && !session.are_panels_hidden
        && !is_drawer_open
        && window_height >= LEAST_HEIGHT
}

/// A picture that is there, and what it shows; no texture where it could not be drawn.
type Made = (Arc<Illustration>, Option<TextureHandle>);

/// What is being drawn, and the picture on its way.
type Job = (Arc<Illustration>, Pending<Result<Image, RenderError>>);

/// The small pictures of the steps of the open document.
#[derive(Default)]
pub(crate) struct Pictures {
    /// Number of the subject that is shown, with its segments.
    subject: u64,
    /// The document that `states` are of.
    document: Option<Document>,
    /// What each step shows.
    states: Vec<Arc<Illustration>>,
    made: Vec<Made>,
    /// For each step its place in `made`.
    places: Vec<Option<usize>>,
    job: Option<Job>,
    /// The strip was shown in this frame.
    is_wanted: bool,
    /// There is a subject to draw. Without one no picture of a step comes, and none is waited for.
    has_subject: bool,
    /// The step that was last scrolled to.
    seen: Option<usize>,
}

impl Pictures {
    /// True while pictures of a strip that is shown are missing.
    pub(crate) fn is_waiting(&self, session: &Session) -> bool {
        let is_any_missing = || self.job.is_some() || self.next(session).is_some();
        self.is_wanted && self.has_subject && is_any_missing()
    }

    /// The first state that has no picture and can be drawn of the subject that is shown.
    fn next(&self, session: &Session) -> Option<&Arc<Illustration>> {
        let missing = self.states.iter().zip(&self.places);
        let mut missing = missing.filter(|(_, place)| place.is_none());
        missing.find_map(|(state, _)| session.can_draw(state).then_some(state))
    }

    fn of(&self, step: usize) -> Option<&TextureHandle> {
        let place = self.places.get(step).copied().flatten()?;
        self.made.get(place)?.1.as_ref()
    }

    /// Takes another document or subject. Pictures of states that are still there stay.
    fn take(&mut self, session: &Session) {
        let subject = session.view.subject_revision;
        let is_same_subject = self.subject == subject;
        let document = session.document();
        // Two handles of one document share its lesson.
        let lesson = |document: &Document| document.lesson().ok().map(std::ptr::from_ref);
        let is_same = |known: &Document| lesson(known) == lesson(document);
        if is_same_subject && self.document.as_ref().is_some_and(is_same) {
            return;
        }
        if !is_same_subject {
            // What a clay looks like its recipe says, which a state has.
            let is_clay = |(of, _): &Made| matches!(of.subject, SubjectRef::Clay(_));
            self.made.retain(is_clay);
            self.job = None;
        }
        self.subject = subject;
        self.document = Some(document.clone());
        self.states.clear();
        if let Ok(lesson) = document.lesson() {
            let steps = 0..=document.step_count();
            let states = steps.filter_map(|step| lesson.at_step(step).ok());
            self.states.extend(states.cloned());
        }
        let states = &self.states;
        self.made
            .retain(|(made, _)| states.iter().any(|state| is_seen_alike(made, state)));
        let is_wanted = |(of, _): &Job| states.iter().any(|s| is_seen_alike(of, s));
        if !self.job.as_ref().is_some_and(is_wanted) {
            self.job = None;
        }
        self.find_places();
    }

    /// Starts the picture of a state. A figure is bent first as that has it, which takes a few frames.
    fn start(
        &mut self,
        state: Arc<Illustration>,
        is_figure: bool,
        picture: &Picture,
        bending: &mut Bending,
    ) {
        let mut sheet = None;
        if is_figure {
            let figure = state.figure.clone().unwrap_or_default();
            match bending.aside(&figure) {
                None => return,
                Some(None) => {
                    self.made.push((state, None));
                    return self.find_places();
                }
                Some(bent) => sheet = bent,
            }
        }
        let work = picture.start_small(&state, sheet, PICTURE_PX);
        self.job = Some((state, work));
    }

    fn find_places(&mut self) {
        let made = &self.made;
        let place =
            |state: &Arc<Illustration>| made.iter().position(|(of, _)| is_seen_alike(of, state));
        self.places = self.states.iter().map(place).collect();
    }

    /// Once per frame, after the strip was shown: takes a picture that is done, or starts the next one.
    pub(crate) fn advance(
        &mut self,
        ctx: &Context,
        session: &Session,
        (picture, bending): (Option<&Picture>, &mut Bending),
        is_held: bool,
    ) {
        if !self.is_wanted {
            self.job = None;
            return;
        }
        let Some(picture) = picture else {
            self.is_wanted = false;
            return;
        };
        self.take(session);
        self.has_subject = session.view.subject.is_some();
        if let Some((of, work)) = &mut self.job {
            if let Some(image) = poll_once(work) {
                let texture = image.ok().map(|image| {
                    let size = image.size.map(|side| side as usize);
                    let pixels = ColorImage::from_rgba_unmultiplied(size, &image.rgba);
                    ctx.load_texture("step", pixels, TextureOptions::LINEAR)
                });
                self.made.push((Arc::clone(of), texture));
                self.job = None;
                self.find_places();
            }
            ctx.request_repaint();
        } else if self.has_subject
            && let Some(state) = self.next(session).cloned()
        {
            let is_idle = picture.state.is_done && !picture.is_waiting();
            let is_still = !session.is_playing() && !is_held;
            if is_idle && is_still && picture.state.has_picture {
                self.start(state, session.view.is_figure(), picture, bending);
            }
            ctx.request_repaint();
        }
    }
}

/// True if two states give the same picture.
fn is_seen_alike(one: &Arc<Illustration>, other: &Arc<Illustration>) -> bool {
    Arc::ptr_eq(one, other)
        || (one.templates == other.templates
            && one.camera == other.camera
            && one.look == other.look
            && one.recipes == other.recipes
            && one.figure == other.figure
            && one.subject == other.subject
            && one.segments == other.segments)
}

/// Nobody looks at the strip in this frame.
pub(crate) fn put_away(pictures: &mut Pictures) {
    pictures.is_wanted = false;
}

/// The strip: a row that plays the lesson and changes the list, and the steps.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    pictures: &mut Pictures,
    commands: &mut Vec<Command>,
) {
    pictures.is_wanted = true;
    ui.add_space(3.0);
    row_ui(ui, session, commands);
    ui.add_space(2.0);
    let shown = session.step();
    let has_moved = pictures.seen.replace(shown) != Some(shown);
    let area = ScrollArea::horizontal().id_salt("steps").auto_shrink(false);
    area.show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            tiles_ui(ui, session, pictures, has_moved, commands);
        });
    });
}

/// Play, the place in the lesson, and what is done with the step that is shown.
fn row_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let mut step = |command: StepCommand| commands.push(Command::Step(command));
    let (shown, count) = (session.step(), session.document().step_count());
    let side = theme::control_height();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.set_height(side);
        let (icon, name) = match session.is_playing() {
            true => (Icon::Stop, w().stop),
            false => (Icon::Play, w().play),
        };
        if widget::icon_button(ui, icon, name, true).clicked() {
            step(StepCommand::TogglePlay);
        }
        let buttons = 4.0 * (side + 4.0) + 12.0;
        ui.spacing_mut().slider_width = (ui.available_width() - buttons).max(40.0);
        let mut position = session.position();
        let slider = Slider::new(&mut position, 0.0..=count as f32).show_value(false);
        let slider = ui.add(slider.smart_aim(false)).named(w().scrub);
        if slider.on_hover_text(w().scrub).changed() {
            // Whoever comes near to a step wants the step.
            let nearest = position.round();
            let is_near = (position - nearest).abs() < NEAR;
            step(StepCommand::Scrub(if is_near { nearest } else { position }));
        }
        ui.add_space(4.0);
        let is_other = session.is_view_other();
        let button = widget::icon_button(ui, Icon::Picture, w().update, is_other);
        if button.on_hover_text(w().update_hint).clicked() {
            step(StepCommand::Update);
        }
        if widget::icon_button(ui, Icon::Copy, w().duplicate, true).clicked() {
            step(StepCommand::Duplicate(shown));
        }
        if widget::icon_button(ui, Icon::Trash, w().delete, shown > 0).clicked() {
            step(StepCommand::Delete(shown));
        }
        let add = widget::icon_button(ui, Icon::Plus, w().add, true);
        if add.on_hover_text(w().add_hint).clicked() {
            step(StepCommand::Add);
        }
    });
}

/// A step that is being dragged, by its number.
#[derive(Clone, Copy)]
struct DraggedStep(usize);

fn tile_id(step: usize) -> Id {
    Id::unique(("tile of a step", step))
}

fn tiles_ui(
    ui: &mut Ui,
    session: &Session,
    pictures: &Pictures,
    has_moved: bool,
    commands: &mut Vec<Command>,
) {
    let count = session.document().step_count();
    let shown = session.step();
    let mut drop_at = None;
    for step in 0..=count {
        let rect = tile_ui(ui, session, step, pictures.of(step), commands);
        if has_moved && step == shown {
            ui.scroll_to_rect(rect, None);
        }
        if let (Some(dragged), Some(pointer)) = (
            DragAndDrop::payload::<DraggedStep>(ui.ctx()),
            ui.input(|i| i.pointer.interact_pos()),
        ) && rect.expand2(vec2(0.5 * GAP, 40.0)).contains(pointer)
        {
            // Nothing comes before the start.
            let is_after = pointer.x > rect.center().x || step == 0;
            let x = match is_after {
                true => rect.right() + 0.5 * GAP,
                false => rect.left() - 0.5 * GAP,
            };
            let stroke = Stroke::new(2.5, Palette::get(ui).accent);
            ui.painter().vline(x, rect.y_range(), stroke);
            let gap = step + usize::from(is_after);
            // Taking the step out first moves everything behind it up by one.
            drop_at = Some((dragged.0, if gap > dragged.0 { gap - 1 } else { gap }));
        }
    }
    if ui.input(|i| i.pointer.any_released())
        && let Some((from, to)) = drop_at
    {
        DragAndDrop::clear_payload(ui.ctx());
        if from != to {
            commands.push(Command::Step(StepCommand::Move { from, to }));
        }
    }
}

/// What a step is called in the strip.
fn title_of(session: &Session, step: usize) -> (String, String) {
    let Some(index) = step.checked_sub(1) else {
        return (w().start.to_owned(), w().start.to_owned());
    };
    let steps = &session.illustration().steps;
    let title = steps.get(index).map_or("", |step| step.title.trim());
    let number = fill(w().step_n, &[&step]);
    match title {
        "" => (step.to_string(), number),
        title => (format!("{step}  {title}"), format!("{number}: {title}")),
    }
}

/// One step; returns its rectangle.
fn tile_ui(
    ui: &mut Ui,
    session: &Session,
    step: usize,
    picture: Option<&TextureHandle>,
    commands: &mut Vec<Command>,
) -> Rect {
    let palette = Palette::get(ui);
    let count = session.document().step_count();
    let is_shown = session.step() == step;
    let (_, rect) = ui.allocate_space(vec2(WIDTH, HEIGHT + NAME));
    // A finger that drags scrolls the strip.
    let sense = match step > 0 && !session.are_drawers {
        true => Sense::click_and_drag(),
        false => Sense::click(),
    };
    let response = ui.interact(rect, tile_id(step), sense);
    let (title, name) = title_of(session, step);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, ui.is_enabled(), is_shown, &name));
    if ui.is_rect_visible(rect) {
        let (fill, stroke) = match (is_shown, response.hovered()) {
            (true, _) => (palette.accent_wash, Stroke::new(1.5, palette.accent)),
            (false, true) => (palette.hover, Stroke::new(1.0, palette.weak)),
            (false, false) => (palette.raised, Stroke::new(1.0, palette.line)),
        };
        let field = rect.with_max_y(rect.top() + HEIGHT).shrink(3.0);
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        painter.rect(
            rect,
            CornerRadius::same(6),
            fill,
            stroke,
            StrokeKind::Inside,
        );
        painter.rect_filled(field, CornerRadius::same(4), palette.sunken);
        if let Some(picture) = picture {
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(picture.id(), field, uv, Color32::WHITE);
        }
        let (font, color) = match is_shown {
            true => (theme::strong_font(11.0), palette.accent),
            false => (FontId::proportional(11.0), palette.text),
        };
        let job = egui::text::LayoutJob {
            wrap: egui::text::TextWrapping::truncate_at_width(WIDTH - 8.0),
            ..egui::text::LayoutJob::simple_singleline(title, font, color)
        };
        let galley = painter.layout_job(job);
        let middle = pos2(rect.center().x, rect.bottom() - 0.5 * NAME - 1.0);
        let at = Align2::CENTER_CENTER.anchor_size(middle, galley.size());
        painter.galley(at.min, galley, color);
        widget::focus_ring(ui, &response, rect);
    }
    let mut go = |command: Command, to: usize| {
        commands.push(command);
        ui.memory_mut(|memory| memory.request_focus(tile_id(to)));
    };
    if response.clicked() {
        go(Command::GoToStep(step), step);
    }
    if response.dragged() && step > 0 {
        DragAndDrop::set_payload(ui.ctx(), DraggedStep(step));
    }
    if response.has_focus() {
        // The arrows walk along the strip, with a modifier they take the step along.
        ui.memory_mut(|memory| {
            let filter = EventFilter {
                horizontal_arrows: true,
                ..EventFilter::default()
            };
            memory.set_focus_lock_filter(response.id, filter);
        });
        for (key, by) in [(Key::ArrowLeft, -1_isize), (Key::ArrowRight, 1)] {
            let to = step.saturating_add_signed(by).min(count);
            let takes = ui.input_mut(|i| i.consume_key(Modifiers::COMMAND, key));
            if takes && step > 0 && to > 0 && to != step {
                go(Command::Step(StepCommand::Move { from: step, to }), to);
            } else if !takes && ui.input_mut(|i| i.consume_key(Modifiers::NONE, key)) && to != step
            {
                go(Command::GoToStep(to), to);
            }
        }
    }
    response.on_hover_text(name);
    rect
}
