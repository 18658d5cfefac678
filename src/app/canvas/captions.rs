//! Captions: texts fastened to tissue. Each stands at the side of the picture, with a line to where its tissue is now.

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Color32, Context, FontId, Galley, Pos2, Rect, Role, Sense, Stroke, TextFormat, Ui, Vec2,
    WidgetInfo, vec2,
};
use glam::Vec3;

use super::caption_layout::{CaptionPlace, ROWS, arranged, is_dark, line_start};
use super::projection::Projection;
use crate::app::picture::host::Picture;
use crate::app::session::camera;
use crate::app::session::{Command, Session};
use crate::document::{Background, Camera, Illustration, PlacedTemplate, Recipe, SubjectRef};
use crate::render::{PendingPick, PendingPlaces, RenderError, Studio, View};

/// Captions whose sight is asked for; the others are taken as seen.
const MOST_SEEN: usize = 32;
/// A caption's tissue nearer to the surface than this is on it, subject units.
const SKIN: f32 = 0.02;
/// Width of a text at most: part of the picture's, and points.
const WIDEST: (f32, f32) = (0.27, 190.0);
/// Space between two texts, points.
const GAP: f32 = 5.0;

/// What the places of captions depend on.
#[derive(Clone)]
struct Cause {
    subject: SubjectRef,
    recipes: Vec<Recipe>,
    segments: usize,
    templates: Vec<PlacedTemplate>,
    /// Points of tissue that are followed, rest space: one per caption; and whether that is drawn.
    points: Vec<Vec3>,
    drawn: Vec<bool>,
}

impl Cause {
    fn of(shown: &Illustration, segments: usize) -> Self {
        Self {
            subject: shown.subject.clone(),
            recipes: shown.recipes.clone(),
            segments,
            templates: shown.templates.clone(),
            points: shown.captions.iter().map(|caption| caption.at).collect(),
            drawn: shown
                .captions
                .iter()
                .map(|caption| caption.enabled)
                .collect(),
        }
    }

    /// True if [`Cause::of`] would give an equal value. Copies nothing, since this is asked in every frame.
    fn is_of(&self, shown: &Illustration, segments: usize) -> bool {
        self.segments == segments
            && self.subject == shown.subject
            && self.recipes == shown.recipes
            && self.templates == shown.templates
            && self.points.iter().zip(&self.drawn).eq(shown
                .captions
                .iter()
                .map(|caption| (&caption.at, &caption.enabled)))
    }
}

/// True if the surface that is seen there, `seen_depth` from the eye, lies in front of a caption's place. False if
/// nothing is seen.
fn is_behind(place: Vec3, seen_depth: Option<f32>, eye: Vec3) -> bool {
    seen_depth.is_some_and(|depth| depth + SKIN < place.distance(eye))
}

/// Where the captions' tissue is, asked of the GPU whenever that changes.
#[derive(Default)]
pub(crate) struct Followed {
    known: Option<Cause>,
    /// Subject space; `None`: cut away.
    places: Vec<Option<Vec3>>,
    pending: Option<(Cause, PendingPlaces)>,
    /// The camera that looked whether something lies before each caption.
    sight: Option<Camera>,
    hidden: Vec<bool>,
    /// What lies before which caption, on its way.
    sights: Vec<(usize, PendingPick)>,
}

impl Followed {
    /// Asks, and takes answers.
    pub(crate) fn update(
        &mut self,
        ctx: &Context,
        session: &Session,
        camera: &Camera,
        picture: &mut Picture,
        view: &Projection,
        size: [u32; 2],
    ) {
        self.take_sights(camera);
        if !self.sights.is_empty() {
            ctx.request_repaint();
        }
        let shown = session.shown();
        if let Some((cause, pending)) = &mut self.pending
            && let Some(answer) = pending.poll_now()
        {
            // The picture reports a lost device; with another one the question is asked again.
            if let Ok(places) = answer {
                self.places = places;
                self.known = Some(cause.clone());
                self.sight = None;
            }
            self.pending = None;
            ctx.request_repaint();
        }
        if shown.captions.is_empty() {
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
        } else if self.sight != Some(*camera) && picture.state.is_done {
            self.sight = Some(*camera);
            self.hidden.resize(self.places.len(), false);
            self.ask_sight(shown, picture, view, size);
        }
    }

    fn ask_sight(
        &mut self,
        shown: &Illustration,
        picture: &mut Picture,
        view: &Projection,
        size: [u32; 2],
    ) {
        let scale = size[0] as f32 / view.rect.width().max(1.0);
        self.sights.clear();
        let is_drawn =
            |(index, _): &(usize, _)| shown.captions.get(*index).is_some_and(|c| c.enabled);
        let drawn = self.places.iter().enumerate().filter(is_drawn);
        for (index, place) in drawn.take(MOST_SEEN) {
            let at = place.and_then(|place| view.ui_from_subject(place));
            if let Some(at) = at.filter(|at| view.rect.contains(*at)) {
                let pixel = (at - view.rect.min) * scale;
                // A question that cannot be asked is no reason for a message.
                if let Ok(pending) = picture.pick([pixel.x, pixel.y], size) {
                    self.sights.push((index, pending));
                }
            }
        }
    }

    /// True while a question about captions is open.
    pub(crate) fn is_waiting(&self) -> bool {
        !self.sights.is_empty()
    }

    /// Takes answers about the surface in front of captions: a surface nearer to the eye than the tissue hides the
    /// caption.
    fn take_sights(&mut self, camera: &Camera) {
        let eye = camera.target + camera::axes(camera.rotate)[2] * camera.distance;
        let (places, hidden) = (&self.places, &mut self.hidden);
        self.sights.retain_mut(|(index, pending)| {
            let Some(answer) = pending.poll_now() else {
                return true;
            };
            let place = places.get(*index).copied().flatten();
            // The picture reports a lost device.
            if let (Ok(pick), Some(place), Some(hidden)) = (answer, place, hidden.get_mut(*index)) {
                *hidden = is_behind(place, pick.map(|pick| pick.depth), eye);
            }
            false
        });
    }

    /// The captions of an illustration with their places in a picture, as far as they are in it: index, place,
    /// whether something lies before it.
    fn in_picture(&self, shown: &Illustration, view: &Projection) -> Vec<(usize, Pos2, bool)> {
        let captions = shown.captions.iter().enumerate();
        captions
            .filter(|(_, caption)| caption.enabled && !caption.text.trim().is_empty())
            .filter_map(|(index, _)| {
                let place = self.places.get(index).copied().flatten()?;
                let at = view.ui_from_subject(place)?;
                let hidden = self.hidden.get(index).copied().unwrap_or_default();
                view.rect.contains(at).then_some((index, at, hidden))
            })
            .collect()
    }

    /// Where each caption of the document is, for a picture that is saved.
    pub(crate) fn places(&self) -> Vec<CaptionPlace> {
        let hidden = self.hidden.iter().copied().chain(std::iter::repeat(false));
        let places = self.places.iter().zip(hidden);
        places
            .map(|(place, hidden)| Some(((*place)?, hidden)))
            .collect()
    }

    /// Draws them over the picture. A click on a text goes to its field.
    pub(crate) fn ui(
        &self,
        ui: &Ui,
        view: &Projection,
        free: Rect,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        let shown = session.shown();
        let marks = self.in_picture(shown, view);
        let (ink, ground) = colors(&shown.look.background);
        let painter = ui.painter_at(view.rect);
        let widest = (WIDEST.0 * view.rect.width()).min(WIDEST.1);
        let galleys: Vec<Arc<Galley>> = marks
            .iter()
            .map(|&(index, _, _)| {
                let job = job(&shown.captions[index].text, 13.0, widest, ink);
                painter.layout_job(job)
            })
            .collect();
        let sizes: Vec<Vec2> = galleys.iter().map(|galley| galley.size()).collect();
        let points: Vec<Pos2> = marks.iter().map(|&(_, at, _)| at).collect();
        let places = arranged(&points, &sizes, GAP, free);
        let texts: Vec<String> = marks
            .iter()
            .map(|&(index, _, _)| shown.captions[index].text.clone())
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
            let id = ui.scope_id().with(("caption in the picture", index));
            let response = ui.interact(rect.expand(3.0), id, Sense::click());
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &texts[i]));
            if response.clicked() {
                chosen = Some(index);
            }
        }
        // In a picture alone there is no field to go to.
        if let Some(index) = chosen.filter(|_| !session.are_panels_hidden) {
            commands.push(Command::EditCaption(index));
        }
    }
}

/// Where each caption of an illustration is in a picture of that size, for lettering it: see
/// [`super::lettering::letter`].
///
/// # Errors
/// Those of the renderer.
pub async fn caption_places(
    studio: &Studio,
    illustration: &Illustration,
    size_px: [u32; 2],
) -> Result<Vec<CaptionPlace>, RenderError> {
    let points: Vec<Vec3> = illustration
        .captions
        .iter()
        .map(|caption| caption.at)
        .collect();
    let places = studio.follow_points(illustration, &points).await?;
    let view = View::new(&illustration.camera, size_px);
    let mut captions = Vec::with_capacity(places.len());
    for (index, place) in places.into_iter().enumerate() {
        let is_drawn = illustration
            .captions
            .get(index)
            .is_some_and(|caption| caption.enabled);
        let place = place.filter(|_| is_drawn);
        let pixel = place.and_then(|place| view.pixel_from_subject(place));
        let pick = match pixel.filter(|_| index < MOST_SEEN) {
            Some(pixel) => studio.pick(illustration, size_px, pixel).await?,
            None => None,
        };
        let depth = pick.map(|pick| pick.depth);
        captions.push(place.map(|place| (place, is_behind(place, depth, view.eye()))));
    }
    Ok(captions)
}

/// Colours of the letters and of the halo behind them, chosen for the background.
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

/// A caption's text in a few rows.
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
