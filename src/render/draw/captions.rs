//! Where the tissue of captions is in the deformed object, and whether something lies before it.

use super::follow::PendingPlaces;
use super::pick::PendingDepths;
use super::renderer::Renderer;
use super::studio::Studio;
use crate::clay::Way;
use crate::data::{Grids, Sheet};
use crate::document::{Camera, Caption, Clay, Illustration, PlacedTemplate, Recipe, SubjectRef};
use crate::render::device::error::RenderError;
use crate::render::pack::view::View;
use glam::{DVec3, Vec2, Vec3};
use std::sync::Arc;

/// A caption's tissue nearer to the surface than this is on it, subject units.
const SKIN: f32 = 0.02;

/// Where the tissue of a caption is, subject space, and whether something lies before it. `None`: it is cut away.
pub type CaptionPlace = Option<(Vec3, bool)>;

/// What the places of captions depend on.
#[derive(Clone, Debug)]
struct Cause {
    subject: SubjectRef,
    recipes: Vec<Recipe>,
    segments: usize,
    templates: Vec<PlacedTemplate>,
    /// The bent figure that the points lie in, if they lie in one.
    sheet: Option<Sheet>,
    /// The clay whose strokes the captions go with, if the subject is one, and the grids of its tools.
    clay: Option<(Arc<Clay>, Grids)>,
    /// Places of the captions in the document, and points of tissue that are followed, rest space: one per caption; and
    /// whether that is drawn.
    at: Vec<Vec3>,
    points: Vec<Vec3>,
    drawn: Vec<bool>,
}

impl Cause {
    fn of(
        shown: &Illustration,
        segments: usize,
        sheet: Option<&Sheet>,
        clay: Option<(&Arc<Clay>, &Grids)>,
    ) -> Self {
        Self {
            subject: shown.subject.clone(),
            recipes: shown.recipes.clone(),
            segments,
            templates: shown.templates.clone(),
            sheet: sheet.cloned(),
            clay: clay.map(|(clay, grids)| (Arc::clone(clay), grids.clone())),
            at: shown.captions.iter().map(|caption| caption.at).collect(),
            points: tissue(shown, clay),
            drawn: shown
                .captions
                .iter()
                .map(|caption| caption.enabled)
                .collect(),
        }
    }

    /// True if [`Cause::of`] would give an equal value. Copies nothing, since this is asked in every frame.
    fn is_of(
        &self,
        shown: &Illustration,
        segments: usize,
        sheet: Option<&Sheet>,
        clay: Option<(&Arc<Clay>, &Grids)>,
    ) -> bool {
        let is_same_clay = match (&self.clay, clay) {
            (Some((own, made)), Some((shown, grids))) => Arc::ptr_eq(own, shown) && made == grids,
            (own, shown) => own.is_none() && shown.is_none(),
        };
        is_same_clay
            && Sheet::are_same(self.sheet.as_ref(), sheet)
            && self.segments == segments
            && self.subject == shown.subject
            && self.recipes == shown.recipes
            && self.templates == shown.templates
            && self.at.iter().zip(&self.drawn).eq(shown
                .captions
                .iter()
                .map(|caption| (&caption.at, &caption.enabled)))
    }
}

/// Where the tissue of captions is in the untouched subject. Captions of a clay stand in its starting shape, and go
/// with the strokes of the clay that is drawn.
fn tissue(shown: &Illustration, clay: Option<(&Arc<Clay>, &Grids)>) -> Vec<Vec3> {
    let at = shown.captions.iter().map(|caption| caption.at);
    let Some((clay, grids)) = clay else {
        return at.collect();
    };
    let mut vertices: Vec<_> = at.map(|at| (at.as_dvec3(), DVec3::ZERO)).collect();
    Way::of(clay, grids).forward(&mut vertices);
    vertices.into_iter().map(|(pos, _)| pos.as_vec3()).collect()
}

/// True if the surface that is seen there, `seen_depth` from the eye, lies in front of a caption's place. False if
/// nothing is seen.
fn is_behind(place: Vec3, seen_depth: Option<f32>, eye: Vec3) -> bool {
    seen_depth.is_some_and(|depth| depth + SKIN < place.distance(eye))
}

/// The pixel of a place (subject space), if it is in the picture.
fn pixel_in_picture(view: &View, place: Vec3) -> Option<Vec2> {
    let pixel = view.pixel_from_subject(place)?;
    let is_in = pixel.cmpge(Vec2::ZERO).all() && pixel.cmple(view.size_px).all();
    is_in.then_some(pixel)
}

/// Where the captions' tissue is, asked of the GPU whenever that changes.
#[derive(Debug, Default)]
pub struct FollowedCaptions {
    known: Option<Cause>,
    /// Subject space; `None`: cut away.
    places: Vec<Option<Vec3>>,
    pending: Option<(Cause, PendingPlaces)>,
    /// The camera that looked whether something lies before each caption.
    sight: Option<Camera>,
    hidden: Vec<bool>,
    /// How far away the surfaces before these captions are, on their way.
    sights: Option<(Vec<usize>, PendingDepths)>,
}

impl FollowedCaptions {
    /// Takes answers and asks anew. `shown` is what the renderer draws, `camera` where it looks from and `size_px` the
    /// size of its picture; `is_done` says that the picture is complete. True if it wants to be called again soon.
    pub fn update(
        &mut self,
        renderer: &mut Renderer,
        (shown, camera): (&Illustration, &Camera),
        size_px: [u32; 2],
        is_done: bool,
    ) -> bool {
        self.take_sights(&View::new(camera, size_px));
        let mut is_waiting = self.is_waiting();
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
            is_waiting = true;
        }
        if shown.captions.is_empty() {
            *self = Self::default();
            return is_waiting;
        }
        let segments = renderer.segments().len();
        let sheet = renderer.sheet().cloned();
        let clay = renderer
            .clay()
            .map(|(clay, grids)| (Arc::clone(clay), grids.clone()));
        let clay = clay.as_ref().map(|(clay, grids)| (clay, grids));
        let is_known = |cause: &Cause| cause.is_of(shown, segments, sheet.as_ref(), clay);
        if self.pending.is_some() {
            is_waiting = true;
        } else if !self.known.as_ref().is_some_and(is_known) {
            let cause = Cause::of(shown, segments, sheet.as_ref(), clay);
            if sheet.is_none() && cause.templates.iter().all(|t| !t.acting().enabled) {
                self.places = cause.points.iter().copied().map(Some).collect();
                self.known = Some(cause);
                self.sight = None;
            } else if let Ok(pending) = renderer.follow_points(&cause.points) {
                self.pending = Some((cause, pending));
                is_waiting = true;
            }
        } else if self.sight != Some(*camera) && is_done {
            self.sight = Some(*camera);
            self.hidden.resize(self.places.len(), false);
            self.ask_sight(renderer, shown, &View::new(camera, size_px), size_px);
        }
        is_waiting
    }

    fn ask_sight(
        &mut self,
        renderer: &mut Renderer,
        shown: &Illustration,
        view: &View,
        size_px: [u32; 2],
    ) {
        let placed = self.places.iter().zip(&shown.captions).enumerate();
        let asked = placed.filter_map(|(index, (place, caption))| {
            let place = place.filter(|_| caption.enabled)?;
            Some((index, pixel_in_picture(view, place)?))
        });
        let (captions, pixels): (Vec<usize>, Vec<Vec2>) = asked.unzip();
        // A question that cannot be asked is no reason for a message.
        self.sights = (!pixels.is_empty())
            .then(|| renderer.depths(&pixels, size_px).ok())
            .flatten()
            .map(|pending| (captions, pending));
    }

    /// True while places are asked for that are not known.
    pub fn is_asking(&self) -> bool {
        self.pending.is_some()
    }

    /// True while it is asked what lies before captions.
    pub fn is_waiting(&self) -> bool {
        self.sights.is_some()
    }

    /// Takes answers about the surface in front of captions: a surface nearer to the eye than the tissue hides the
    /// caption.
    fn take_sights(&mut self, view: &View) {
        let Some((captions, pending)) = &mut self.sights else {
            return;
        };
        let Some(answer) = pending.poll_now() else {
            return;
        };
        // The picture reports a lost device.
        for (&index, depth) in captions.iter().zip(answer.unwrap_or_default()) {
            let place = self.places.get(index).copied().flatten();
            if let (Some(place), Some(hidden)) = (place, self.hidden.get_mut(index)) {
                *hidden = is_behind(place, depth, view.eye());
            }
        }
        self.sights = None;
    }

    /// Where a caption of the document is, as far as that is known.
    pub fn place(&self, index: usize) -> CaptionPlace {
        let place = self.places.get(index).copied().flatten()?;
        let is_hidden = self.hidden.get(index).copied().unwrap_or_default();
        Some((place, is_hidden))
    }

    /// Where each caption of the document is, as far as that is known.
    pub fn places(&self) -> Vec<CaptionPlace> {
        (0..self.places.len())
            .map(|index| self.place(index))
            .collect()
    }
}

/// Where each caption of an illustration is in a picture of that size, for lettering it.
///
/// # Errors
/// Those of the renderer.
pub async fn caption_places(
    studio: &Studio,
    illustration: &Illustration,
    size_px: [u32; 2],
) -> Result<Vec<CaptionPlace>, RenderError> {
    let points = tissue(illustration, studio.clay());
    let places = studio.follow_points(illustration, &points).await?;
    let view = View::new(&illustration.camera, size_px);
    let drawn = |(place, caption): (Option<Vec3>, &Caption)| place.filter(|_| caption.enabled);
    let places: Vec<Option<Vec3>> = places
        .into_iter()
        .zip(&illustration.captions)
        .map(drawn)
        .collect();
    let pixel = |place: &Option<Vec3>| pixel_in_picture(&view, (*place)?);
    let pixels: Vec<Vec2> = places.iter().filter_map(pixel).collect();
    let depths = match pixels.is_empty() {
        true => Vec::new(),
        false => studio.depths(illustration, size_px, &pixels).await?,
    };
    let mut depths = depths.into_iter();
    let captions = places.iter().map(|place| {
        let depth = pixel(place).and_then(|_| depths.next()).flatten();
        Some(((*place)?, is_behind((*place)?, depth, view.eye())))
    });
    Ok(captions.collect())
}
