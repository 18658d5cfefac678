//! Keys that fit the tool which shapes a clay while they are held and the pointer moves or the wheel turns: F its
//! size, F with Shift its coating, R its turn.

use egui::{Key, Pos2, Ui};

use super::projection::ZOOM_PER_POINT;
use crate::app::session::HeldTool;

/// Degrees that the tool turns per point.
const DEGREES_PER_POINT: f32 = 0.5;

/// What a held key changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fits {
    /// The size of the tool.
    Size,
    /// The width of its coating.
    Coat,
    /// Its turn about its own z axis.
    Turn,
}

impl Fits {
    /// What the keys change that are held now; nothing while somebody types.
    pub(crate) fn held(ui: &Ui) -> Option<Self> {
        if ui.ctx().text_edit_focused() {
            return None;
        }
        ui.input(|i| {
            let modifiers = i.modifiers;
            if modifiers.command || modifiers.ctrl || modifiers.alt {
                None
            } else if i.key_down(Key::F) {
                Some(if modifiers.shift {
                    Self::Coat
                } else {
                    Self::Size
                })
            } else {
                i.key_down(Key::R).then_some(Self::Turn)
            }
        })
    }
}

/// The tool as it was when a key went down, and how far pointer and wheel have gone since. It is always told from
/// there, so that a hand that goes back finds the tool as it was.
#[derive(Debug)]
pub(crate) struct Fitting {
    pub(crate) fits: Fits,
    before: HeldTool,
    /// Where the pointer was, points of the window.
    from: Pos2,
    /// How far the wheel has turned, points.
    wheel: f32,
}

impl Fitting {
    pub(crate) fn new(fits: Fits, before: &HeldTool, from: Pos2) -> Self {
        Self {
            fits,
            before: before.clone(),
            from,
            wheel: 0.0,
        }
    }

    /// Takes in so many points of the wheel.
    pub(crate) fn scroll(&mut self, points: f32) {
        self.wheel += points;
    }

    /// The tool with the pointer here. To the right a length grows by as much as the pointer goes, which is seen in so
    /// many points per subject unit.
    pub(crate) fn fitted(&self, pos: Pos2, points_per_unit: f32) -> HeldTool {
        let way = pos.x - self.from.x;
        let grown =
            |length: f32| (length + way / points_per_unit) * (ZOOM_PER_POINT * self.wheel).exp();
        let before = &self.before;
        match self.fits {
            Fits::Size => before.with_size(grown(before.size)),
            Fits::Coat => before.with_coat(grown(before.coat)),
            Fits::Turn => {
                before.with_turn(before.turn_deg + DEGREES_PER_POINT * (way + self.wheel))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn the_pointer_and_the_wheel_fit_the_tool() {
        let before = HeldTool::default();
        let from = pos2(100.0, 50.0);
        let fitted = |fits, by: f32, wheel: f32| {
            let mut fitting = Fitting::new(fits, &before, from);
            fitting.scroll(wheel);
            fitting.fitted(from + egui::vec2(by, 33.0), 400.0)
        };
        for fits in [Fits::Size, Fits::Coat, Fits::Turn] {
            assert_eq!(
                fitted(fits, 0.0, 0.0),
                before,
                "{fits:?}: back where it was"
            );
        }
        let doubled = fitted(Fits::Size, 40.0, 0.0);
        assert!((doubled.size - 0.2).abs() < 1e-6 && doubled.coat == before.coat);
        let coated = fitted(Fits::Coat, -20.0, 0.0);
        assert!((coated.coat - 0.05).abs() < 1e-6 && coated.size == before.size);
        assert!(fitted(Fits::Size, 0.0, 50.0).size > before.size);
        assert!(fitted(Fits::Size, 0.0, -50.0).size < before.size);
        let [sizes, coats] = HeldTool::RANGES;
        assert_eq!(fitted(Fits::Size, -900.0, 0.0).size, sizes[0]);
        assert_eq!(fitted(Fits::Coat, 900.0, 0.0).coat, coats[1]);
        assert_eq!(fitted(Fits::Turn, 60.0, 0.0).turn_deg, 30.0);
        assert_eq!(
            fitted(Fits::Turn, 400.0, 0.0).turn_deg,
            -160.0,
            "beyond half a turn"
        );
    }
}
