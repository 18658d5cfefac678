//! What the range of a recipe takes, seen at once: finding a tissue takes seconds, its values are there. It is shown
//! from the change of the range until the tissue of it is found.

use super::view::SubjectFacts;
use crate::data::RECIPE_COLORS_SRGB;
use crate::document::{Illustration, Look, Recipe, Style, Transfer, TransferPoint};

/// The values that a recipe takes, before its clean-up and wherever they lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// Lowest and highest value, in the subject's own values.
    pub range: [f32; 2],
    /// Colour of the tissue, sRGB.
    pub color_srgb: [u8; 3],
}

impl Taken {
    /// The first recipe of an illustration that takes another range than it did when the tissues that are shown were
    /// found. A recipe that is new takes nothing yet: for it the old picture stays.
    pub fn of(found: &[Recipe], wanted: &[Recipe]) -> Option<Self> {
        wanted.iter().find_map(|recipe| {
            let range = recipe.from.range()?;
            let mut same = found
                .iter()
                .filter(|old| (old.index, &old.name) == (recipe.index, &recipe.name));
            let color = RECIPE_COLORS_SRGB[recipe.index % RECIPE_COLORS_SRGB.len()];
            let is_other = same.any(|old| old.from.range() != Some(range));
            is_other.then(|| Self {
                range,
                color_srgb: recipe.color_srgb.unwrap_or(color),
            })
        })
    }

    /// The transfer function that shows these values and no others, sharp at both ends.
    fn transfer(&self, facts: Option<&SubjectFacts>) -> Transfer {
        let [low, high] = self.range;
        let scan = facts.and_then(|facts| facts.scan.as_ref());
        let [min, max] = scan.map_or([low, high], |scan| scan.value_range);
        let point = |value: f32, opacity: f32| TransferPoint {
            value,
            color_srgb: self.color_srgb,
            opacity,
        };
        // An end at or beyond the last value of the scan is none: the first and the last point go on.
        let from = low.clamp(min, max);
        let to = high.clamp(from, max.max(from));
        let edge = ((to - from) * 2e-3).max((max - min) * 1e-5).max(1e-6);
        let mut points = vec![point(from, 1.0), point(to, 1.0)];
        if low > min {
            points.insert(0, point(from - edge, 0.0));
        }
        if high < max {
            points.push(point(to + edge, 0.0));
        }
        Transfer::Points(points)
    }

    /// The illustration with nothing to be seen but these values. `is_alone`: a tissue is seen alone, which is seen
    /// without templates, so that its values are too.
    pub(super) fn seen_in(
        &self,
        shown: &Illustration,
        is_alone: bool,
        facts: Option<&SubjectFacts>,
    ) -> Illustration {
        let mut seen = shown.clone();
        if is_alone {
            seen.templates.clear();
        }
        seen.look = Look {
            transfer: self.transfer(facts),
            tint: Some(0.0),
            gradient: 0.0,
            segments: Vec::new(),
            style: Style::PLAIN,
            style_preset: None,
            ..seen.look
        };
        seen
    }
}
