//! A lesson that plays by itself: it walks to the next step, stays there, and walks on until the last.

use super::effect::LinkChange;
use super::session::Session;
use crate::document::{Autoplay, Turn};

impl Session {
    /// True while the lesson plays by itself.
    pub fn is_playing(&self) -> bool {
        self.playing.is_some()
    }

    /// True in the middle of a passage that stands still.
    pub fn is_paused(&self) -> bool {
        self.mode.is_between() && !self.mode.is_moving()
    }

    /// Where one stands in the lesson: a whole number is a step, what lies between two is in a passage.
    pub fn position(&self) -> f32 {
        self.mode.position()
    }

    /// Begins to play at what is shown now, after the last step at the start again; or stops there.
    pub(super) fn toggle_playing(&mut self) {
        if self.playing.take().is_some() {
            self.mode.pause();
            return;
        }
        let (step, count) = (self.step(), self.document().step_count());
        if count == 0 {
            return;
        }
        match Autoplay::first(step, self.mode.is_between(), count) {
            (first, true) => self.go(first, true),
            (next, false) => self.go_to_step(next),
        }
        self.playing = Some(Autoplay::default());
    }

    /// Stands still at a place of the lesson.
    pub(super) fn scrub(&mut self, position: f32) {
        self.playing = None;
        self.glide = None;
        // Where nothing is to move by itself, a place between two steps is a step too.
        let position = match self.has_less_motion {
            true => position.round(),
            false => position,
        };
        if let Some(camera) = self.mode.scrub(self.history.document(), position) {
            self.camera = camera;
        }
        self.revision += 1;
        self.touch_link(LinkChange::Replace);
    }

    /// How long it still stays at the step, seconds; `None` while nothing plays or it is on the way.
    pub(super) fn seconds_to_next_step(&self) -> Option<f64> {
        self.playing?
            .seconds_left(self.step(), &self.illustration().steps, self.now)
    }

    /// Goes on to the next step when it is time. True if a passage begins.
    pub(super) fn advance_playing(&mut self) -> bool {
        let Some(playing) = &mut self.playing else {
            return false;
        };
        let step = self.mode.step();
        let steps = &self.history.document().illustration().steps;
        match playing.turn(step, self.mode.is_moving(), steps, self.now) {
            Turn::Walks | Turn::Stays(_) => false,
            Turn::GoesOn => {
                self.go_to_step(step + 1);
                // The history of the page holds where the reader went, not where the lesson went by itself.
                self.link_change = LinkChange::Replace;
                true
            }
            Turn::Ends => {
                self.playing = None;
                false
            }
        }
    }
}
