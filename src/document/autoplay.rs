//! A lesson that plays by itself: it stays at each step for a while, walks to the next, and ends at the last.

use super::model::Step;

/// A lesson that plays.
#[derive(Clone, Copy, Debug, Default)]
pub struct Autoplay {
    /// When it came to the step, seconds; `None` on the way.
    since: Option<f64>,
}

/// What a lesson that plays does now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// It is on the way to a step.
    Walks,
    /// It stays at a step for so many seconds more.
    Stays(f64),
    /// It begins to walk to the next step.
    GoesOn,
    /// The last step is shown.
    Ends,
}

impl Autoplay {
    /// The step to walk to when a lesson begins to play, and whether that is a cut: the end of a passage that stood
    /// still, the next step, or after the last one the start. `step` is shown, or a passage leads to it.
    pub fn first(step: usize, is_between: bool, count: usize) -> (usize, bool) {
        match step {
            step if is_between => (step, false),
            step if step < count => (step + 1, false),
            _ => (0, true),
        }
    }

    /// What is due at the time `now`, seconds. `step` is shown, or a passage that goes on leads to it (`is_moving`).
    pub fn turn(&mut self, step: usize, is_moving: bool, steps: &[Step], now: f64) -> Turn {
        if is_moving {
            self.since = None;
            return Turn::Walks;
        }
        if step >= steps.len() {
            return Turn::Ends;
        }
        self.since.get_or_insert(now);
        match self.seconds_left(step, steps, now) {
            Some(left) if left > 0.0 => Turn::Stays(left),
            _ => Turn::GoesOn,
        }
    }

    /// How long it still stays at a step, seconds; `None` on the way.
    pub fn seconds_left(&self, step: usize, steps: &[Step], now: f64) -> Option<f64> {
        let own = step.checked_sub(1).and_then(|index| steps.get(index));
        let hold = own.map_or(Step::DEFAULT_HOLD, |step| step.hold_seconds);
        Some(self.since? + f64::from(hold) - now)
    }
}
