//! Which tissues are edited, shown alone or for a moment, the recipes of those that are made here, and the edits that
//! change them.

use glam::{Quat, Vec3};
use serde_json::Value;

use super::brush::Brush;
use super::found::Found;
use super::taken::Taken;
use super::view::SubjectFacts;
use crate::document::{
    Align, CleanStep, Constrain, Edit, Illustration, PlacedTemplate, Recipe, RecipeSource,
    SegmentLook, TemplateKind, color_text, pointer,
};
use crate::math::Placement;

/// Seconds for which the picture of a tissue is shown whose name was clicked.
pub(super) const GLIMPSE_SECONDS: f64 = 1.2;
/// Seconds at most, with those in which it is drawn.
pub(super) const MOST_GLIMPSE_SECONDS: f64 = 20.0;
/// Gaps of bone that are closed where voxels are fine enough, mm.
const CLOSE_MM: f64 = 2.0;

/// What of the tissues is being edited or shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tissues {
    /// Index in `subject.features` of the recipe that is open for editing.
    pub open: Option<usize>,
    /// Index in `subject.features` of the recipe that is being made: Escape leaves it unmade.
    pub making: Option<usize>,
    /// Name of the segment that is shown alone.
    pub alone: Option<String>,
    /// Name of the segment that was shown alone before: it stays until the one of `alone` is found.
    pub(super) alone_before: Option<String>,
    /// Name of the segment that is chosen in the list.
    pub selected: Option<String>,
    /// The segment that is shown alone for a moment.
    pub glimpse: Option<Glimpse>,
    /// The text that tissues and captions are searched for.
    pub search: String,
    /// Name of the segment whose look is edited.
    pub look: Option<String>,
    /// Voxels of each recipe's segment, as last counted.
    pub counts: Vec<u64>,
    /// How far the work under way is, 0 to 1.
    pub progress: Option<f32>,
    /// The segments that are shown are not yet those that the document describes.
    pub is_behind: bool,
    /// The work was stopped before they were.
    pub is_stopped: bool,
    /// What the range of a recipe takes, until the tissue of it is found.
    pub taken: Option<Taken>,
    /// The picture is complete.
    pub is_drawn: bool,
    /// The ball that paints.
    pub brush: Brush,
}

/// A segment that is shown alone for a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Glimpse {
    /// Name of the segment.
    pub name: String,
    /// On the clock of the interface, seconds.
    pub since: f64,
    /// When its picture became complete, on the same clock.
    pub drawn: Option<f64>,
}

/// Something done with tissues.
#[derive(Clone, Debug, PartialEq)]
pub enum TissueCommand {
    /// Makes a tissue of this name, or of one like it that is free, by a range of values.
    Make(String, [f32; 2]),
    /// Gives the recipe of this index this name, or one like it that is free.
    Rename(usize, String),
    /// Removes the recipe of this index, and what templates and the look say of its tissue.
    Remove(usize),
    /// Opens the recipe of this index for editing, or closes the one that is open.
    Open(Option<usize>),
    /// Shows the segment of this name alone, or all again.
    Alone(Option<String>),
    /// Chooses the segment of this name, and shows it for a moment.
    Select(String),
    /// Searches tissues and captions for a text.
    Search(String),
    /// Opens the look of the segment of this name for editing, or closes it.
    Look(Option<String>),
    /// Clicks add seeds to the recipe that is open, or not.
    Seed(bool),
    /// Makes a tissue of this name, or of one like it that is free, that is only painted, and takes the ball in hand.
    MakeByHand(String),
    /// Takes the ball in hand that paints, or with `true` the one that erases, or puts it away.
    Ball(Option<bool>),
    /// Gives the ball this radius, mm.
    BallRadius(f32),
    /// A drag with the ball begins.
    PressBall,
    /// Goes on with a drag (its [`drag_code`](super::brush::drag_code)) to what the picture has under the hand.
    PaintOn(usize, Option<Found>),
    /// Goes on with a drag to a point of rest space.
    PaintAt(usize, Vec3),
    /// Takes the last stroke of the open recipe away, or with `true` all of them.
    DropStrokes(bool),
    /// Stops finding tissues; those found before stay.
    Stop,
    /// Goes on after a stop.
    Find,
}

impl Tissues {
    /// The illustration in place of the shown one: a segment alone, or what a range takes. `None` while everything is
    /// shown, also while the segment is not found yet.
    pub fn seen_in(
        &self,
        shown: &Illustration,
        facts: Option<&SubjectFacts>,
    ) -> Option<Illustration> {
        let is_here = |name: &&String| facts.is_some_and(|facts| facts.has_segment(name));
        let glimpse = self.glimpse.as_ref().map(|glimpse| &glimpse.name);
        if let Some(name) = glimpse.filter(is_here) {
            return Some(alone_in(shown, name));
        }
        if let Some(taken) = &self.taken {
            return Some(taken.seen_in(shown, self.alone.is_some(), facts));
        }
        let mut alone = [self.alone.as_ref()?].into_iter().chain(&self.alone_before);
        Some(alone_in(shown, alone.find(is_here)?))
    }

    /// Shows a segment alone, or all again.
    pub(super) fn show_alone(&mut self, name: Option<String>) {
        let before = std::mem::replace(&mut self.alone, name);
        if self.alone.is_none() {
            self.alone_before = None;
        } else if before != self.alone {
            self.alone_before = before;
        }
    }

    /// Forgets the recipes that are not in the document any more.
    pub(super) fn keep_to(&mut self, recipes: &[Recipe]) {
        let is_there = |index: &usize| recipes.iter().any(|recipe| recipe.index == *index);
        self.open = self.open.filter(is_there);
        if self.making.is_some_and(|index| !is_there(&index)) {
            self.making = None;
            self.show_alone(None);
        }
    }
}

/// Everything but a segment is cut away. The segment itself is seen although the look hides it.
fn alone_in(shown: &Illustration, name: &str) -> Illustration {
    let placement = Placement {
        at: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        size: Vec3::splat(2.5),
    };
    let cut = PlacedTemplate {
        align: Align::Segment {
            keep: vec![name.to_owned()],
            thickness: 0.01,
        },
        ..PlacedTemplate::new(TemplateKind::Cut, placement)
    };
    let mut alone = Illustration {
        templates: vec![cut],
        ..shown.clone()
    };
    let is_hidden = |opacity: f32| opacity <= 0.0;
    let looks = &mut alone.look.segments;
    looks.retain(|look| look.name != name || !is_hidden(look.opacity));
    alone
}

/// A tissue is drawn as a body, so that it is seen where it is painted; others are drawn as the scan has them, or
/// hidden.
pub(super) fn marked_in(shown: &Illustration, name: &str) -> Illustration {
    let mut marked = shown.clone();
    let looks = &mut marked.look.segments;
    let own = looks.iter().find(|look| look.name == name);
    let color_srgb = own.and_then(|look| look.color_srgb);
    looks.retain(|look| look.name != name && look.opacity <= 0.0);
    looks.push(SegmentLook {
        color_srgb,
        ..SegmentLook::solid(name)
    });
    marked
}

/// A length, mm, for the recipe of a new tissue: two voxels, or one where two would be longer than [`CLOSE_MM`].
/// Rounded up to three digits, so that it reaches as far.
pub(super) fn close_mm(voxel_mm: f64) -> f32 {
    let voxels = if 2.0 * voxel_mm > CLOSE_MM { 1.0 } else { 2.0 };
    length_mm(voxels, voxel_mm)
}

/// Millimetres of a number of voxels, rounded up to three digits.
pub fn length_mm(voxels: f64, voxel_mm: f64) -> f32 {
    let mm = voxels * voxel_mm;
    if mm.abs() < 1e-9 {
        return 0.0;
    }
    let unit = 10.0_f64.powf(mm.abs().log10().floor() - 2.0);
    // What is a whole number but for its last digits stays.
    (((mm / unit).abs() - 1e-6).ceil() * unit).copysign(mm) as f32
}

/// What a new tissue is cleaned up by.
pub(super) fn first_steps(voxel_mm: f64) -> Vec<CleanStep> {
    vec![
        CleanStep::Close(close_mm(voxel_mm)),
        CleanStep::Largest(1),
        CleanStep::Fill,
    ]
}

/// The first of "bone", "bone 2", "bone 3" … that is free.
pub(super) fn free_name(wanted: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let (mut base, mut number) = (wanted, 1_u32);
    if let Some((before, behind)) = wanted.rsplit_once(' ')
        && let Ok(n) = behind.parse()
    {
        (base, number) = (before, n);
    }
    let mut name = wanted.to_owned();
    while is_taken(&name) {
        number = number.saturating_add(1);
        name = format!("{base} {number}");
    }
    name
}

/// The edit that draws a tissue with this opacity and colour, or (`None`) by the transfer function.
pub fn set_look(tissue: &str, look: Option<(f32, Option<[u8; 3]>)>) -> Edit {
    let pointer = pointer::join("/look/segments", tissue);
    let name = format!("Draw {tissue}");
    let value = look.map(|(opacity, color)| {
        let opacity = Value::from((f64::from(opacity) * 100.0).round() / 100.0);
        match color {
            None => opacity,
            Some(color) => serde_json::json!({ "opacity": opacity, "color": color_text(color) }),
        }
    });
    Edit::put(pointer, value, name)
}

/// Edits of what templates keep: `change` gives the new names where they change.
pub(super) fn keep_edits(
    templates: &[PlacedTemplate],
    change: impl Fn(&[String]) -> Option<Vec<String>>,
) -> Vec<Edit> {
    let mut edits = Vec::new();
    for template in templates {
        let index = template.index;
        if let Align::Segment { keep, thickness } = &template.align
            && let Some(keep) = change(keep)
        {
            let thickness = *thickness;
            edits.push(Edit::SetAlign {
                template: index,
                align: Align::Segment { keep, thickness },
            });
        }
        if let Some(Constrain { by, keep }) = &template.constrain
            && let Some(keep) = change(keep)
        {
            edits.push(Edit::SetConstrain {
                template: index,
                constrain: Some(Constrain { by: *by, keep }),
            });
        }
    }
    edits
}

/// The recipe with another range of values.
pub fn with_range(recipe: &Recipe, range: [f32; 2]) -> Recipe {
    let mut new = recipe.clone();
    match &mut new.from {
        RecipeSource::Threshold { range: old } | RecipeSource::Grow { range: old, .. } => {
            *old = range;
        }
        RecipeSource::Nothing => {}
    }
    new
}

/// The recipe growing from other seeds, rest space.
pub fn with_seeds(recipe: &Recipe, seeds: Vec<Vec3>) -> Recipe {
    let Some(range) = recipe.from.range() else {
        return recipe.clone();
    };
    Recipe {
        from: RecipeSource::Grow { seeds, range },
        ..recipe.clone()
    }
}
