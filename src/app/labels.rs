//! Labels: texts fastened to tissue. Each stands at the side of the picture, with a line to where its tissue is now.

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, Context, FontId, Galley, Pos2, Rect, Role, Sense, Stroke, TextEdit,
    TextFormat, Ui, Vec2, WidgetInfo, vec2,
};
use glam::Vec3;
use std::sync::Arc;

use super::camera::Projection;
use super::command::Command;
use super::control::{self, Named as _};
use super::icon::Icon;
use super::lettering::{LabelPlace, is_dark};
use super::picture::{PickFor, Picture};
use super::state::{State, Tab};
use super::theme::{self, Palette};
use super::words::{fill, labels::w};
use crate::document::{
    Background, Camera, Edit, FeatureRecipe, Illustration, Label, PlacedTemplate, SubjectRef,
};
use crate::render::{PendingPlaces, RenderError, Studio, View};

/// Labels whose sight is asked for; the others are taken as seen.
const MOST_SEEN: usize = 32;
/// Nearer to the surface than this (subject units) a label is on it.
const SKIN: f32 = 0.02;
/// Width of a text at most: part of the picture's, and points.
const WIDEST: (f32, f32) = (0.27, 190.0);
/// Half the width of the part of a picture that labels fill, of its height at most.
const BROADEST: f32 = 0.85;
/// Space between two texts, points.
const GAP: f32 = 5.0;
/// Rows that a text has at most.
pub(super) const ROWS: usize = 4;

/// What an author is about with labels.
#[derive(Debug, Default)]
pub(crate) struct Labelling {
    /// The next click in the picture sets one.
    pub is_placing: bool,
    /// The field of this one wants the keyboard.
    pub wants_focus: Option<usize>,
}

impl State {
    /// A label for tissue at a point of rest space, to be named next.
    pub(crate) fn add_label(&mut self, at: Vec3) {
        self.labelling.is_placing = false;
        let index = self.illustration().labels.len();
        let text = fill(w().label_n, &[&(index + 1)]);
        if self.apply_checked(&Edit::AddLabel(Label { at, text }), false) {
            self.labelling.wants_focus = Some(index);
            self.are_panels_hidden = false;
            self.side_tab = Tab::Text;
            self.tab = self.tab.map(|_| Tab::Text);
        }
    }

    /// Starts or ends setting a label.
    pub(crate) fn toggle_labelling(&mut self) {
        self.placing = None;
        self.tissues.is_seeding = false;
        self.labelling.is_placing = !self.labelling.is_placing;
        if self.labelling.is_placing {
            self.leave_steps();
            self.tab = None;
        }
    }
}

// ---------------------------------------------------------------------------------------------------- the panel

/// The list of labels in the panel of texts.
pub(crate) fn panel_ui(ui: &mut Ui, state: &mut State, commands: &mut Vec<Command>) {
    let labels = state.illustration().labels.clone();
    control::heading(ui, w().heading, |ui| {
        let name = w().add;
        if control::icon_button(ui, Icon::Plus, name, true).clicked() {
            commands.push(Command::ToggleLabelling);
        }
    });
    if labels.is_empty() {
        let weak = Palette::get(ui).weak;
        let hint = egui::RichText::new(w().none).small().color(weak);
        ui.add(egui::Label::new(hint).wrap());
    }
    for (index, label) in labels.iter().enumerate() {
        ui.push_id(("label", index), |ui| {
            control::row(ui, |ui| {
                let mut text = label.text.clone();
                let id = egui::Id::unique(("text of label", index));
                // Before the field is shown: it says its name.
                let wants_focus = state.labelling.wants_focus == Some(index);
                if wants_focus {
                    state.labelling.wants_focus = None;
                    ui.memory_mut(|memory| memory.request_focus(id));
                    select_all(ui, id, &label.text);
                }
                let edit = TextEdit::singleline(&mut text)
                    .id(id)
                    .align(Align2::LEFT_CENTER)
                    .min_size(vec2(0.0, theme::control_height()))
                    .desired_width(ui.available_width() - theme::control_height() - 8.0);
                let response = ui.add(edit).named(fill(w().text_n, &[&(index + 1)]));
                if wants_focus {
                    response.scroll_to_me(None);
                }
                if response.changed() {
                    let value = Label { at: label.at, text };
                    commands.push(Command::Drag(Edit::SetLabel {
                        label: index,
                        value,
                    }));
                }
                let remove = fill(w().remove, &[&label.text]);
                if control::icon_button(ui, Icon::Trash, &remove, true).clicked() {
                    commands.push(Command::Apply(Edit::RemoveLabel { label: index }));
                }
            });
        });
    }
    ui.add_space(6.0);
}

/// What is typed next replaces the text.
fn select_all(ui: &Ui, id: egui::Id, text: &str) {
    let mut edit = egui::widgets::text_edit::TextEditState::load(ui.ctx(), id).unwrap_or_default();
    let end = egui::text::CCursor::new(text.chars().count());
    let all = egui::text::CCursorRange::two(egui::text::CCursor::new(0), end);
    edit.cursor.set_char_range(Some(all));
    edit.store(ui.ctx(), id);
}

// ---------------------------------------------------------------------------------------------------- where they are

/// What places of labels depend on.
#[derive(Clone)]
struct Cause {
    subject: SubjectRef,
    features: Vec<FeatureRecipe>,
    segments: usize,
    templates: Vec<PlacedTemplate>,
    /// Rest space.
    points: Vec<Vec3>,
}

impl Cause {
    fn of(shown: &Illustration, segments: usize) -> Self {
        Self {
            subject: shown.subject.clone(),
            features: shown.features.clone(),
            segments,
            templates: shown.templates.clone(),
            points: shown.labels.iter().map(|label| label.at).collect(),
        }
    }

    /// True if it is what [`Cause::of`] would be; copies nothing, since it is asked every frame.
    fn is_of(&self, shown: &Illustration, segments: usize) -> bool {
        self.segments == segments
            && self.subject == shown.subject
            && self.features == shown.features
            && self.templates == shown.templates
            && self
                .points
                .iter()
                .eq(shown.labels.iter().map(|label| &label.at))
    }
}

/// True if what is seen so far from the eye lies before a label's place; nothing seen: nothing does.
fn is_behind(place: Vec3, seen_depth: Option<f32>, eye: Vec3) -> bool {
    seen_depth.is_some_and(|depth| depth + SKIN < place.distance(eye))
}

/// Where the labels' tissue is, asked of the GPU whenever that changes.
#[derive(Default)]
pub(crate) struct Followed {
    known: Option<Cause>,
    /// Subject space; `None`: cut away.
    places: Vec<Option<Vec3>>,
    pending: Option<(Cause, PendingPlaces)>,
    /// Whether something lies before each label, as seen by this camera.
    sight: Option<Camera>,
    hidden: Vec<bool>,
}

impl Followed {
    /// Asks, and takes answers.
    pub(crate) fn update(
        &mut self,
        ctx: &Context,
        state: &State,
        picture: &mut Picture,
        view: &Projection,
        size: [u32; 2],
    ) {
        let shown = state.shown();
        if let Some((cause, pending)) = &mut self.pending
            && let Some(answer) = pending.poll_now()
        {
            // A lost device is said by the picture; with another one it is asked again.
            if let Ok(places) = answer {
                self.places = places;
                self.known = Some(cause.clone());
                self.sight = None;
            }
            self.pending = None;
            ctx.request_repaint();
        }
        if shown.labels.is_empty() {
            *self = Self::default();
            return;
        }
        let segments = picture.segments().len();
        let is_known = |cause: &Cause| cause.is_of(shown, segments);
        if self.pending.is_some() {
            ctx.request_repaint();
        } else if !self.known.as_ref().is_some_and(is_known) {
            let cause = Cause::of(shown, segments);
            if cause.templates.iter().all(|t| !t.acting().enabled) {
                self.places = cause.points.iter().copied().map(Some).collect();
                self.known = Some(cause);
                self.sight = None;
            } else if let Ok(pending) = picture.follow_points(&cause.points) {
                self.pending = Some((cause, pending));
                ctx.request_repaint();
            }
        } else if self.sight != Some(state.camera) && picture.state.is_done {
            self.sight = Some(state.camera);
            self.hidden.resize(self.places.len(), false);
            self.ask_sight(picture, view, size);
        }
    }

    fn ask_sight(&self, picture: &mut Picture, view: &Projection, size: [u32; 2]) {
        let scale = size[0] as f32 / view.rect.width().max(1.0);
        for (index, place) in self.places.iter().enumerate().take(MOST_SEEN) {
            let at = place.and_then(|place| view.ui_from_subject(place));
            if let Some(at) = at.filter(|at| view.rect.contains(*at)) {
                let pixel = (at - view.rect.min) * scale;
                // No reason for a message.
                _ = picture.ask(PickFor::Sight(index), [pixel.x, pixel.y], size);
            }
        }
    }

    /// What is seen where a label is lies so far from the eye (subject units); nothing: nothing is before it.
    pub(crate) fn seen(&mut self, index: usize, depth: Option<f32>, eye: Vec3) {
        let place = self.places.get(index).copied().flatten();
        if let (Some(place), Some(hidden)) = (place, self.hidden.get_mut(index)) {
            *hidden = is_behind(place, depth, eye);
        }
    }

    /// The labels of an illustration with their places in a picture, as far as they are in it: index, place, whether something
    /// lies before it.
    fn in_picture(&self, shown: &Illustration, view: &Projection) -> Vec<(usize, Pos2, bool)> {
        let labels = shown.labels.iter().enumerate();
        labels
            .filter(|(_, label)| !label.text.trim().is_empty())
            .filter_map(|(index, _)| {
                let place = self.places.get(index).copied().flatten()?;
                let at = view.ui_from_subject(place)?;
                let hidden = self.hidden.get(index).copied().unwrap_or_default();
                view.rect.contains(at).then_some((index, at, hidden))
            })
            .collect()
    }

    /// Where each label of the document is, for a picture that is saved.
    pub(crate) fn places(&self) -> Vec<LabelPlace> {
        let hidden = self.hidden.iter().copied().chain(std::iter::repeat(false));
        let places = self.places.iter().zip(hidden);
        places
            .map(|(place, hidden)| Some(((*place)?, hidden)))
            .collect()
    }

    /// Draws them over the picture. A click on a text goes to its field.
    pub(crate) fn ui(&self, ui: &Ui, view: &Projection, free: Rect, state: &mut State) {
        let shown = state.shown();
        let marks = self.in_picture(shown, view);
        let (ink, ground) = colors(&shown.look.background);
        let painter = ui.painter_at(view.rect);
        let widest = (WIDEST.0 * view.rect.width()).min(WIDEST.1);
        let galleys: Vec<Arc<Galley>> = marks
            .iter()
            .map(|&(index, _, _)| {
                let job = job(&shown.labels[index].text, 13.0, widest, ink);
                painter.layout_job(job)
            })
            .collect();
        let sizes: Vec<Vec2> = galleys.iter().map(|galley| galley.size()).collect();
        let points: Vec<Pos2> = marks.iter().map(|&(_, at, _)| at).collect();
        let places = arranged(&points, &sizes, GAP, free);
        let texts: Vec<String> = marks
            .iter()
            .map(|&(index, _, _)| shown.labels[index].text.clone())
            .collect();
        let mut chosen = None;
        for (i, (&(index, at, is_hidden), galley)) in marks.iter().zip(galleys).enumerate() {
            let rect = places[i];
            let fade = if is_hidden { 0.55 } else { 1.0 };
            let (ink, ground) = (ink.gamma_multiply(fade), ground.gamma_multiply(fade));
            let from = line_start(rect, at, 4.0);
            painter.line_segment([from, at], Stroke::new(3.0, ground));
            painter.line_segment([from, at], Stroke::new(1.2, ink));
            painter.circle_filled(at, 4.0, ground);
            if is_hidden {
                painter.circle_stroke(at, 2.4, Stroke::new(1.2, ink));
            } else {
                painter.circle_filled(at, 2.6, ink);
            }
            painter.rect_filled(rect.expand2(vec2(4.0, 2.0)), 4.0, ground);
            painter.galley(rect.min, galley, ink);
            let id = ui.scope_id().with(("label in the picture", index));
            let response = ui.interact(rect.expand(3.0), id, Sense::click());
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &texts[i]));
            if response.clicked() {
                chosen = Some(index);
            }
        }
        // Where steps are walked, there is no field to go to.
        if let Some(index) = chosen.filter(|_| !state.are_panels_hidden && state.walk.step() == 0) {
            state.labelling.wants_focus = Some(index);
            state.side_tab = Tab::Text;
            if state.tab.is_some() {
                state.tab = Some(Tab::Text);
            }
        }
    }
}

/// Where each label of an illustration is in a picture of that size, for lettering it: see [`super::letter`].
///
/// # Errors
/// What the renderer says when it is asked.
pub async fn label_places(
    studio: &Studio,
    illustration: &Illustration,
    size_px: [u32; 2],
) -> Result<Vec<LabelPlace>, RenderError> {
    let points: Vec<Vec3> = illustration.labels.iter().map(|label| label.at).collect();
    let places = studio.follow_points(illustration, &points).await?;
    let view = View::new(&illustration.camera, size_px);
    let mut labels = Vec::with_capacity(places.len());
    for (index, place) in places.into_iter().enumerate() {
        let pixel = place.and_then(|place| view.pixel_from_subject(place));
        let pick = match pixel.filter(|_| index < MOST_SEEN) {
            Some(pixel) => studio.pick(illustration, size_px, pixel).await?,
            None => None,
        };
        let depth = pick.map(|pick| pick.depth);
        labels.push(place.map(|place| (place, is_behind(place, depth, view.eye()))));
    }
    Ok(labels)
}

/// Of letters and of what is behind them, as the background wants it.
fn colors(background: &Background) -> (Color32, Color32) {
    if is_dark(*background) {
        (Color32::WHITE, Color32::from_black_alpha(190))
    } else {
        (
            Color32::from_rgb(0x1f, 0x24, 0x26),
            Color32::from_white_alpha(215),
        )
    }
}

/// A label's text in a few rows.
fn job(text: &str, size: f32, widest: f32, color: Color32) -> LayoutJob {
    let format = TextFormat::simple(FontId::proportional(size), color);
    let mut job = LayoutJob::single_section(text.trim().to_owned(), format);
    job.wrap = TextWrapping {
        max_width: widest,
        max_rows: ROWS,
        ..TextWrapping::default()
    };
    job
}

/// Where a label's line begins: in the middle of the side that faces its tissue.
pub(super) fn line_start(text: Rect, at: Pos2, gap: f32) -> Pos2 {
    if text.center().x < at.x {
        text.right_center() + vec2(gap, 0.0)
    } else {
        text.left_center() - vec2(gap, 0.0)
    }
}

/// Places for texts of these sizes: each in a column at the side of the area that is nearer to its point, as high as the point where there
/// is room, none over another, and in the order of the points, so that no lines cross within a column.
pub(super) fn arranged(points: &[Pos2], sizes: &[Vec2], gap: f32, area: Rect) -> Vec<Rect> {
    // In a very wide picture the object fills the middle, and lines across all the rest would be long.
    let half = (0.5 * area.width()).min(BROADEST * area.height());
    let middle = area.center().x;
    let area = area.with_min_x(middle - half).with_max_x(middle + half);
    let mut places = vec![Rect::NOTHING; points.len()];
    for is_left in [true, false] {
        let mut column: Vec<usize> = (0..points.len())
            .filter(|&i| (points[i].x < area.center().x) == is_left)
            .collect();
        column.sort_by(|&a, &b| points[a].y.total_cmp(&points[b].y));
        let mut next = area.top();
        let mut tops = Vec::with_capacity(column.len());
        for &i in &column {
            let top = (points[i].y - 0.5 * sizes[i].y).max(next);
            tops.push(top);
            next = top + sizes[i].y + gap;
        }
        // What would hang out below moves up, and what is above it in its way.
        let mut floor = area.bottom();
        for (&i, top) in column.iter().zip(&mut tops).rev() {
            *top = top.min(floor - sizes[i].y);
            floor = *top - gap;
        }
        for (&i, top) in column.iter().zip(tops) {
            let left = if is_left {
                area.left()
            } else {
                area.right() - sizes[i].x
            };
            places[i] = Rect::from_min_size(Pos2::new(left, top), sizes[i]);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stand_beside_each_other() {
        let area = Rect::from_min_size(Pos2::new(10.0, 20.0), vec2(400.0, 300.0));
        let points: Vec<Pos2> = (0..14)
            .map(|i| Pos2::new(if i % 3 == 0 { 100.0 } else { 300.0 }, 280.0 - i as f32))
            .collect();
        let sizes: Vec<Vec2> = (0..14).map(|i| vec2(60.0 + i as f32, 16.0)).collect();
        let places = arranged(&points, &sizes, GAP, area);
        for (i, a) in places.iter().enumerate() {
            assert!(area.contains_rect(*a), "{i}: {a:?}");
            assert_eq!(a.size(), sizes[i]);
            let overlaps = places[i + 1..].iter().filter(|b| a.intersects(**b));
            assert_eq!(overlaps.count(), 0, "{i}");
            for (j, b) in places
                .iter()
                .enumerate()
                .filter(|(j, _)| i % 3 == 0 && j % 3 == 0)
            {
                assert_eq!(a.top() < b.top(), points[i].y < points[j].y, "lines cross");
            }
        }
        // Alone, a text is as high as its point.
        let alone = arranged(&points[..1], &sizes[..1], GAP, area);
        assert!((alone[0].center().y - points[0].y).abs() < 1e-3);
        assert!(arranged(&[], &[], GAP, area).is_empty());
        // In a wide picture they stay with the object.
        let wide = Rect::from_min_size(Pos2::ZERO, vec2(4000.0, 300.0));
        let points = [Pos2::new(1900.0, 100.0), Pos2::new(2100.0, 100.0)];
        let places = arranged(&points, &sizes[..2], GAP, wide);
        assert!(
            places[0].left() > 1700.0 && places[1].right() < 2300.0,
            "{places:?}"
        );
    }
}
