//! Window and level by hand, as in every viewer of DICOM: a drag over a slice to the right widens the window of values
//! that greys are spread over, to the left narrows it; a drag down raises it (the slice grows darker), up lowers it.

use egui::{PointerButton, Response, Ui, Vec2};

use crate::app::kit::widget;
use crate::app::session::{Command, Session};
use crate::document::{Edit, Window};

/// Natural logarithm of the window's growth per point of a drag, and the part of its width that it is raised by.
const GROWTH_PER_POINT: f32 = 0.006;
const RAISE_PER_POINT: f32 = 0.004;
/// Narrowest and widest window, of the range of the scan's values.
const NARROWEST: f32 = 1e-3;
const WIDEST: f32 = 2.0;

/// How far a hand drags the window over a slice in this frame, points: the right button or two fingers at any time,
/// and a plain drag while the tool for it is active. None while it drags something else.
pub(crate) fn drag(ui: &Ui, response: &Response, session: &Session) -> Option<Vec2> {
    let fingers = ui.input(|i| i.multi_touch());
    if let Some(touch) = fingers.filter(|touch| response.rect.contains(touch.center_pos)) {
        return Some(touch.translation_delta);
    }
    let is_shifted = ui.input(|i| i.modifiers.shift);
    let is_held = response.dragged_by(PointerButton::Secondary)
        || session.tool().is_levelling() && response.dragged_by(PointerButton::Primary);
    (is_held && !is_shifted).then(|| response.drag_delta())
}

/// The command that a drag makes of the window of values that is shown. None for a drag that goes nowhere.
pub(crate) fn command(by: Vec2, shown: [f32; 2], value_range: [f32; 2]) -> Option<Command> {
    let window = dragged(by, shown, value_range);
    (by != Vec2::ZERO).then_some(Command::Drag(Edit::SetWindow(Window::Range(window))))
}

/// Width and level of a window of values, as viewers of scans abbreviate both in every language.
pub(crate) fn in_words([from, to]: [f32; 2]) -> String {
    let decimals = if to - from > 50.0 { 0 } else { 3 };
    let shown = |value: f32| widget::plain(f64::from(value), decimals);
    format!("W {} · L {}", shown(to - from), shown(0.5 * (from + to)))
}

/// A window of values after a drag, in points to the right and down.
fn dragged(by: Vec2, [from, to]: [f32; 2], [low, high]: [f32; 2]) -> [f32; 2] {
    let span = (high - low).max(1e-6);
    let width = (to - from).max(NARROWEST * span);
    let middle = 0.5 * (from + to) + by.y * RAISE_PER_POINT * width;
    let width = width * (by.x * GROWTH_PER_POINT).exp();
    let width = width.clamp(NARROWEST * span, WIDEST * span);
    let middle = middle.clamp(low, high);
    [middle - 0.5 * width, middle + 0.5 * width]
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    const VALUES: [f32; 2] = [-1000.0, 3000.0];

    #[test]
    fn a_drag_widens_to_the_right_and_raises_downwards() {
        let shown = [-160.0, 240.0];
        let [from, to] = dragged(vec2(100.0, 0.0), shown, VALUES);
        assert!((to - from) > 1.5 * 400.0 && (from + to - 80.0).abs() < 1e-2);
        let [from, to] = dragged(vec2(0.0, 50.0), shown, VALUES);
        assert!(
            (to - from - 400.0).abs() < 1e-2 && from > shown[0],
            "{from} {to}"
        );
        assert!(command(Vec2::ZERO, shown, VALUES).is_none());
    }

    #[test]
    fn a_window_stays_within_reason() {
        for by in [-1e4, 1e4] {
            for shown in [[-160.0, 240.0], [5.0, 5.0], [-1e5, 1e5]] {
                let [from, to] = dragged(vec2(by, by), shown, VALUES);
                let width = to - from;
                assert!((3.9..=8001.0).contains(&width), "{shown:?}: {from} to {to}");
                assert!((VALUES[0]..=VALUES[1]).contains(&(0.5 * (from + to))));
            }
        }
    }
}
