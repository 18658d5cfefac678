//! A pen over the picture: how hard it presses, and the palm that rests beside it.

use egui::{Event, TouchDeviceId, TouchId, TouchPhase};

/// Seconds after which a hand that has lifted its pen is one with fingers again.
const NEAR: f64 = 0.5;

/// The touches that are down, in the order in which they came, and which of them are pens. A touch is a pen's once it
/// has told a force between none and all of it: browsers tell 0 or 1 of fingers. Of a pen that is no touch the shell
/// tells.
#[derive(Debug, Default)]
pub(crate) struct Pen {
    touches: Vec<((TouchDeviceId, TouchId), Option<f32>)>,
    /// How hard a pen presses that is no touch.
    told: Option<f32>,
    /// When the last pen was lifted, seconds on the clock of the interface.
    lifted_at: Option<f64>,
}

impl Pen {
    /// Takes in what touches did in this frame, and how hard a pen presses that is none.
    pub(crate) fn hear(&mut self, events: &[Event], told: Option<f32>, now: f64) {
        if told.is_none() && self.told.is_some() {
            self.lifted_at = Some(now);
        }
        self.told = told;
        for event in events {
            let Event::Touch {
                device_id,
                id,
                phase,
                force,
                ..
            } = event
            else {
                continue;
            };
            let key = (*device_id, *id);
            let at = self.touches.iter().position(|(known, _)| *known == key);
            if matches!(phase, TouchPhase::End | TouchPhase::Cancel) {
                if at.is_some_and(|at| self.touches.remove(at).1.is_some()) {
                    self.lifted_at = Some(now);
                }
                continue;
            }
            let before = at.and_then(|at| self.touches[at].1);
            let told = force.filter(|force| force.is_finite());
            let is_pen = |force: &f32| before.is_some() || (*force > 0.0 && *force < 1.0);
            let force = told.filter(is_pen).map(|force| force.clamp(0.0, 1.0));
            match at {
                Some(at) => self.touches[at].1 = force.or(before),
                None => self.touches.push((key, force)),
            }
        }
    }

    /// How hard the pen presses that moves the pointer, 0 to 1. `None` of a finger and of a mouse.
    pub(crate) fn force(&self) -> Option<f32> {
        self.told.or_else(|| self.touches.first()?.1)
    }

    /// True while something else than a pen touches, and a pen does too or has just been lifted.
    pub(crate) fn has_palm(&self, now: f64) -> bool {
        let is_near = self.told.is_some()
            || self.touches.iter().any(|(_, force)| force.is_some())
            || self.lifted_at.is_some_and(|at| now - at < NEAR);
        is_near && self.touches.iter().any(|(_, force)| force.is_none())
    }

    /// True while it is the palm that moves the pointer.
    pub(crate) fn is_palm_pointing(&self, now: f64) -> bool {
        self.has_palm(now) && self.force().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(id: u64, phase: TouchPhase, force: Option<f32>) -> Event {
        Event::Touch {
            device_id: TouchDeviceId(1),
            id: TouchId(id),
            phase,
            pos: egui::Pos2::ZERO,
            force,
        }
    }

    #[test]
    fn a_pen_tells_how_hard_it_presses() {
        let mut pen = Pen::default();
        assert_eq!(pen.force(), None, "a mouse");
        pen.hear(&[touch(7, TouchPhase::Start, Some(0.0))], None, 0.0);
        assert_eq!(pen.force(), None, "as browsers say of fingers");
        pen.hear(&[touch(7, TouchPhase::Move, Some(0.25))], None, 0.1);
        assert_eq!(pen.force(), Some(0.25));
        for (told, heard) in [(Some(1.0), 1.0), (Some(f32::NAN), 1.0), (None, 1.0)] {
            pen.hear(&[touch(7, TouchPhase::Move, told)], None, 0.2);
            assert_eq!(pen.force(), Some(heard));
        }
        pen.hear(&[touch(7, TouchPhase::End, Some(0.0))], None, 0.3);
        assert_eq!(pen.force(), None);
        for force in [Some(1.0), Some(0.0), Some(f32::INFINITY), None] {
            let mut finger = Pen::default();
            finger.hear(&[touch(1, TouchPhase::Start, force)], None, 0.0);
            assert_eq!(finger.force(), None, "{force:?}");
        }
    }

    #[test]
    fn a_palm_is_known_by_the_pen_beside_it() {
        let mut pen = Pen::default();
        pen.hear(&[touch(1, TouchPhase::Start, None)], None, 0.0);
        assert!(!pen.has_palm(0.0), "a finger alone");
        pen.hear(&[touch(1, TouchPhase::End, None)], None, 0.1);
        pen.hear(&[touch(2, TouchPhase::Start, Some(0.4))], None, 1.0);
        assert!(!pen.has_palm(1.0), "a pen alone");
        pen.hear(&[touch(3, TouchPhase::Start, None)], None, 1.1);
        assert!(pen.has_palm(1.1) && !pen.is_palm_pointing(1.1));
        pen.hear(&[touch(2, TouchPhase::End, None)], None, 2.0);
        assert!(pen.is_palm_pointing(2.4));
        assert!(!pen.has_palm(2.6), "the pen is away");
    }

    #[test]
    fn a_pen_may_be_told_of_beside_the_touches() {
        let mut pen = Pen::default();
        pen.hear(&[], Some(0.3), 0.0);
        assert_eq!(pen.force(), Some(0.3));
        pen.hear(&[touch(1, TouchPhase::Start, None)], Some(0.4), 0.1);
        assert_eq!(pen.force(), Some(0.4));
        assert!(pen.has_palm(0.1) && !pen.is_palm_pointing(0.1));
        pen.hear(&[], None, 0.2);
        assert_eq!(pen.force(), None);
        assert!(pen.is_palm_pointing(0.3) && !pen.has_palm(0.8));
    }
}
