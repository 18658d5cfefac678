//! Painting tissue with a ball: what a drag adds to a recipe, or takes out of it. A drag is one step of undo.

use glam::Vec3;
use serde_json::Value;

use super::brush::Drag;
use super::found::Found;
use super::line::Line;
use super::notices::Gravity;
use super::session::Session;
use super::tissues::marked_in;
use super::tool::Tool;
use crate::app::words::{fill, tissue};
use crate::document::{
    Edit, Illustration, MAX_BALL_MM, MAX_STROKES, MIN_BALL_MM, Recipe, Stroke,
};

/// Radius of the ball at first, voxels.
const BALL_VOXELS: f64 = 4.0;
/// How much larger a key makes the ball.
const BALL_STEP: f32 = 1.25;

impl Session {
    /// Radius of the ball that paints, mm.
    pub fn ball_mm(&self) -> f32 {
        let voxel_mm = self.view.subject.as_ref().and_then(|facts| facts.voxel_mm());
        let usual = || two_digits((BALL_VOXELS * voxel_mm.unwrap_or(1.0)) as f32);
        self.tissues.brush.radius_mm.unwrap_or_else(usual)
    }

    /// Radius of the ball that paints, subject units.
    pub fn ball_in_units(&self) -> Option<f32> {
        Some(self.ball_mm() / self.view.mm_per_unit()?)
    }

    /// The strokes of the drag under way, or of the last one while the picture does not show it yet.
    pub fn strokes_under_way(&self) -> &[Stroke] {
        let Some(drag) = &self.tissues.brush.drag else {
            return &[];
        };
        let mut recipes = self.illustration().recipes.iter();
        let recipe = recipes.find(|recipe| recipe.index == drag.recipe);
        let strokes = recipe.and_then(|recipe| recipe.paint.get(drag.before..));
        strokes.unwrap_or_default()
    }

    /// What is seen in place of what the document shows: one tissue alone, or the one that is painted in its colour.
    pub fn seen(&self) -> Option<Illustration> {
        let facts = self.view.subject.as_ref();
        let alone = self.tissues.seen_in(self.shown(), facts);
        alone.or_else(|| {
            let Tool::Paint { recipe, .. } = self.tool() else {
                return None;
            };
            let name = self.recipe(recipe)?.name;
            let is_here = facts.is_some_and(|facts| facts.has_segment(&name));
            is_here.then(|| marked_in(self.shown(), &name))
        })
    }

    /// Takes the ball in hand for the recipe that is open, or puts it away.
    pub(super) fn take_ball(&mut self, erases: Option<bool>) {
        let tool = match (erases, self.tissues.open) {
            (Some(erases), Some(recipe)) => Tool::Paint { recipe, erases },
            _ => Tool::Look,
        };
        let is_new = !matches!(self.tool(), Tool::Paint { .. });
        if erases.is_none() && is_new {
            return;
        }
        if is_new {
            // What is painted on has to be seen.
            self.tissues.show_alone(None);
            self.tissues.glimpse = None;
        }
        self.take_tool(tool);
    }

    /// Gives the ball another radius, mm.
    pub(super) fn set_ball(&mut self, radius_mm: f32) {
        if radius_mm.is_finite() {
            let radius_mm = two_digits(radius_mm).clamp(MIN_BALL_MM, MAX_BALL_MM);
            self.tissues.brush.radius_mm = Some(radius_mm);
        }
    }

    /// Makes the ball larger or smaller by a step.
    pub(super) fn resize_ball(&mut self, is_larger: bool) {
        let step = if is_larger { BALL_STEP } else { 1.0 / BALL_STEP };
        self.set_ball(self.ball_mm() * step);
    }

    /// A new drag begins.
    pub(super) fn press_ball(&mut self) {
        self.tissues.brush.drags += 1;
    }

    /// Nothing more is added to the drags so far.
    pub(super) fn close_drags(&mut self) {
        self.tissues.brush.close();
    }

    /// Goes on with a drag ([`drag_code`]) to what the picture has under the hand.
    pub(super) fn paint_on(&mut self, code: usize, found: Option<Found>) {
        let Some(found) = found else {
            return;
        };
        // What this drag has painted or dug out is not what the hand follows: the ball would climb on itself.
        if let (Some(drag), Some(mm_per_unit)) = (&self.tissues.brush.drag, self.view.mm_per_unit())
            && drag.number == code / 2
        {
            let radius = drag.radius_mm / mm_per_unit;
            let detail = self.view.subject.as_ref().map_or(0.0, |facts| facts.detail);
            let off = (drag.line.distance(found.pos_in_rest) - radius).abs();
            if off < (1.5 * detail).max(0.15 * radius) {
                return;
            }
        }
        self.paint_at(code, found.pos_in_rest);
    }

    /// Goes on with a drag ([`drag_code`]) to a point of rest space.
    pub(super) fn paint_at(&mut self, code: usize, pos: Vec3) {
        let (number, erases) = (code / 2, code % 2 == 1);
        let Tool::Paint { recipe: index, .. } = self.tool() else {
            return;
        };
        let (Some(recipe), Some(mm_per_unit)) = (self.recipe(index), self.view.mm_per_unit()) else {
            return;
        };
        if number <= self.tissues.brush.closed || !pos.is_finite() {
            return;
        }
        let is_same = |drag: &Drag| drag.number == number;
        let mut drag = match self.tissues.brush.drag.take().filter(is_same) {
            Some(mut drag) => {
                // Something else was done with the strokes meanwhile.
                if recipe.paint.len() != drag.before + drag.count || drag.recipe != index {
                    return self.close_drags();
                }
                if !drag.line.push(pos) {
                    self.tissues.brush.drag = Some(drag);
                    return;
                }
                drag
            }
            None => {
                let radius_mm = self.ball_mm();
                Drag {
                    number,
                    recipe: index,
                    before: recipe.paint.len(),
                    count: 0,
                    radius_mm,
                    line: Line::new(pos, radius_mm / mm_per_unit),
                }
            }
        };
        let strokes = drag.line.strokes(erases, drag.radius_mm);
        if drag.before + strokes.len() > MAX_STROKES {
            self.tissues.brush.closed = number;
            let text = fill(tissue::w().no_more_strokes, &[&MAX_STROKES]);
            self.notify(Gravity::Info, text, "");
            return;
        }
        let is_first = drag.count == 0;
        drag.count = strokes.len();
        let before = recipe.paint[..drag.before].iter();
        let all: Vec<Value> = before.chain(&strokes).map(Stroke::to_value).collect();
        let verb = if erases { "Erase" } else { "Paint" };
        let edit = set_strokes(&recipe, all, format!("{verb} {}", recipe.name));
        let did = match is_first {
            true => self.apply(&edit, false),
            false => self.amend(&edit),
        };
        if did {
            self.tissues.brush.drag = Some(drag);
        }
    }

    /// Takes the last stroke of the recipe that is open away, or all of them.
    pub(super) fn drop_strokes(&mut self, all: bool) {
        let open = self.tissues.open.and_then(|index| self.recipe(index));
        let Some(recipe) = open.filter(|recipe| !recipe.paint.is_empty()) else {
            return;
        };
        self.close_drags();
        let count = if all { 0 } else { recipe.paint.len() - 1 };
        let rest = recipe.paint[..count].iter().map(Stroke::to_value).collect();
        let edit = set_strokes(&recipe, rest, format!("Remove strokes of {}", recipe.name));
        self.apply(&edit, false);
    }
}

/// The edit that gives a recipe other strokes.
fn set_strokes(recipe: &Recipe, strokes: Vec<Value>, name: String) -> Edit {
    let pointer = format!("/subject/features/{}/paint", recipe.index);
    // Where nothing else makes the tissue, an empty list keeps it.
    match strokes.is_empty() && recipe.from.range().is_some() {
        true => Edit::Reset { pointer, name },
        false => Edit::Set {
            pointer,
            value: Value::from(strokes),
            name,
        },
    }
}

/// A length with two digits.
fn two_digits(mm: f32) -> f32 {
    let mm = f64::from(mm.max(MIN_BALL_MM));
    let unit = 10.0_f64.powf(mm.log10().floor() - 1.0);
    // By hundredths, which is as fine as a ball gets.
    (((mm / unit).round() * unit * 1e4).round() / 1e4) as f32
}
