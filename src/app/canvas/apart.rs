//! Handles that keep apart: each takes the first of its places that is far enough from those that are taken.

use egui::{Pos2, Rect, Vec2, vec2};

/// Least distance between the middles of two handles, points: fingers tell no nearer ones apart.
pub(crate) const APART: f32 = 24.0;
/// Lengths of the stems on which a handle may stand, points, and directions in which they are tried.
const STEMS: [f32; 5] = [30.0, 42.0, 54.0, 66.0, 90.0];
const DIRECTIONS: u8 = 16;

/// The middles of the handles that have their place.
#[derive(Debug, Default)]
pub(crate) struct Apart {
    taken: Vec<Pos2>,
}

impl Apart {
    /// Takes a place, whatever is there.
    pub(crate) fn take(&mut self, at: Pos2) {
        self.taken.push(at);
    }

    /// True if nothing that has its place is too near.
    pub(crate) fn is_free(&self, at: Pos2) -> bool {
        self.taken.iter().all(|taken| taken.distance(at) >= APART)
    }

    /// Takes the first of these places that is free.
    pub(crate) fn take_first(&mut self, places: impl IntoIterator<Item = Pos2>) -> Option<Pos2> {
        let place = places.into_iter().find(|place| self.is_free(*place))?;
        self.take(place);
        Some(place)
    }
}

/// The places on stems around a point, the shortest stems first: down and to the right first, where there is neither an
/// arrow nor a square in most views. Only those within a rectangle.
pub(crate) fn on_stems(foot: Pos2, within: Rect) -> impl Iterator<Item = Pos2> {
    let turned = |turn: u8| {
        // To both sides by turns.
        let step = f32::from(turn.div_ceil(2)) * if turn.is_multiple_of(2) { 1.0 } else { -1.0 };
        let angle = step * std::f32::consts::TAU / f32::from(DIRECTIONS);
        Vec2::angled(angle + vec2(0.6, 0.8).angle())
    };
    STEMS
        .into_iter()
        .flat_map(move |length| (0..DIRECTIONS).map(move |turn| foot + turned(turn) * length))
        .filter(move |place| within.contains(*place))
}

/// The places of a handle that may be drawn out along a direction: where it belongs, then ever further out.
pub(crate) fn drawn_out(at: Pos2, direction: Vec2) -> impl Iterator<Item = Pos2> {
    let count: u8 = if direction == Vec2::ZERO { 1 } else { 6 };
    (0..count).map(move |i| at + direction * (0.5 * APART * f32::from(i)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn what_comes_later_makes_way() {
        let mut apart = Apart::default();
        let at = pos2(100.0, 100.0);
        let within = Rect::from_center_size(at, Vec2::splat(200.0));
        apart.take(at);
        assert_eq!(apart.take_first([at + vec2(10.0, 0.0)]), None);
        let out = apart.take_first(drawn_out(at + vec2(10.0, 0.0), vec2(1.0, 0.0)));
        assert_eq!(out, Some(at + vec2(34.0, 0.0)));
        for _ in 0..8 {
            let place = apart.take_first(on_stems(at, within));
            assert!(place.is_some_and(|place| within.contains(place)));
        }
        for (i, one) in apart.taken.iter().enumerate() {
            for other in &apart.taken[..i] {
                assert!(one.distance(*other) >= APART, "{one} {other}");
            }
        }
    }
}
