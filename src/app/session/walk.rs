//! Walking the steps of a lesson: the step that is shown, and the passage to the next.

use std::sync::Arc;

use super::camera;
use crate::document::{Camera, Document, Illustration};

/// Where one stands in the steps of the document. Step 0 is the document as it stands.
#[derive(Debug, Default)]
pub struct Walk {
    step: usize,
    /// What is shown at a step above 0, or in the middle of a passage.
    shown: Option<Arc<Illustration>>,
    passage: Option<Passage>,
}

/// The way from one step to its neighbour.
#[derive(Debug)]
struct Passage {
    /// The later of the two, whose entry has the length of the passage.
    later: usize,
    is_backwards: bool,
    /// When it began, seconds on the clock of the interface.
    since: f64,
    /// How long it takes.
    seconds: f64,
    /// The cameras at both ends, if the step turns the camera at all.
    cameras: Option<(Camera, Camera)>,
}

impl Walk {
    /// Opened at a step: no passage, the step's own camera.
    pub fn at(document: &Document, step: usize) -> Self {
        let step = step.min(document.step_count());
        Self {
            step,
            shown: shown_at(document, step),
            passage: None,
        }
    }

    /// The step that is shown or under way to.
    pub fn step(&self) -> usize {
        self.step
    }

    /// What is shown in place of the document as it stands.
    pub fn shown(&self) -> Option<&Illustration> {
        self.shown.as_deref()
    }

    /// True while a passage goes on.
    pub fn is_moving(&self) -> bool {
        self.passage.is_some()
    }

    /// Goes to a step: to a neighbour by the passage between them, further at once. Returns the camera that is taken at
    /// once.
    pub fn go(
        &mut self,
        document: &Document,
        step: usize,
        now: f64,
        from: Camera,
    ) -> Option<Camera> {
        let step = step.min(document.step_count());
        if step == self.step {
            return None;
        }
        let before = std::mem::replace(&mut self.step, step);
        let camera_at = |step| match shown_at(document, step) {
            Some(shown) => shown.camera,
            None => document.illustration().camera,
        };
        let (start, end) = (camera_at(before), camera_at(step));
        // A step that does not turn the camera leaves it where the student has turned it.
        let cameras = (start != end).then_some((from, end));
        if step.abs_diff(before) > 1 {
            self.passage = None;
            self.shown = shown_at(document, step);
            return cameras.map(|(_, end)| end);
        }
        let later = step.max(before);
        let steps = &document.illustration().steps;
        let seconds = steps
            .get(later - 1)
            .map_or(0.0, |step| f64::from(step.seconds));
        self.passage = Some(Passage {
            later,
            is_backwards: step < before,
            since: now,
            seconds,
            cameras,
        });
        None
    }

    /// Goes on to a time, seconds on the clock of the interface; returns the camera of the passage, if it has one.
    pub fn advance(&mut self, document: &Document, now: f64) -> Option<Camera> {
        let passage = self.passage.as_ref()?;
        let past = (now - passage.since).max(0.0);
        if past >= passage.seconds {
            let end = passage.cameras.map(|(_, end)| end);
            self.passage = None;
            self.shown = shown_at(document, self.step);
            return end;
        }
        let at = if passage.is_backwards {
            passage.seconds - past
        } else {
            past
        };
        if let Ok(shown) = document.at_time(passage.later, at as f32) {
            self.shown = Some(Arc::new(shown));
        }
        let part = (past / passage.seconds) as f32;
        passage
            .cameras
            .map(|(from, end)| camera::between(&from, &end, part))
    }
}

/// The state of the lesson at a step; nothing where that is the document itself.
fn shown_at(document: &Document, step: usize) -> Option<Arc<Illustration>> {
    if step == 0 {
        return None;
    }
    let state = document.lesson().ok()?.at_step(step).ok()?;
    Some(Arc::clone(state))
}
