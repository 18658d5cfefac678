//! Walking the steps of a lesson: the step that is shown, and the passage to the next.

use std::sync::Arc;

use super::lesson::{Lesson, eased};
use super::model::{Camera, Illustration};
use super::tree::Document;
use super::turn::between;

/// Where one stands in the steps of the document. Step 0 is the document as it stands.
#[derive(Debug, Default)]
pub struct Walk {
    step: usize,
    /// What is shown at a step above 0, or in the middle of a passage.
    shown: Option<Arc<Illustration>>,
    passage: Option<Box<Passage>>,
}

/// The way to a step, from a step at rest or from the middle of another passage.
#[derive(Debug)]
struct Passage {
    /// The step that was left.
    before: usize,
    /// Where in the lesson it began; see [`Walk::position`].
    at: f32,
    /// What was shown when it began, and what is shown when it is over.
    ends: [Arc<Illustration>; 2],
    /// It leads to an earlier step: what cannot go over by and by stays as it is until the end.
    is_backwards: bool,
    /// When it began, seconds on the clock of the interface; `None` while it stands still.
    since: Option<f64>,
    /// How much of its time is over, 0 to 1.
    part: f32,
    /// How far it leads, in seconds of undisturbed passages: that of a whole passage is as long as it takes.
    way: f64,
    /// The same of the passage that its way is a part of.
    whole: f64,
    /// How far the way from the step that was left to its beginning is, in the same seconds.
    behind: f64,
    /// The cameras at both ends, if the step turns the camera at all.
    cameras: Option<[Camera; 2]>,
}

impl Passage {
    fn shown(&self) -> Illustration {
        let [start, end] = &self.ends;
        match self.is_backwards {
            true => Lesson::between(end, start, 1.0 - self.part),
            false => Lesson::between(start, end, self.part),
        }
    }

    fn camera(&self) -> Option<Camera> {
        let [from, to] = self.cameras?;
        Some(between(&from, &to, self.part))
    }

    /// How long it takes, seconds.
    ///
    /// It begins and ends slowly, also where the whole passage is fast. In `way` seconds it would be nowhere faster
    /// than that is at its fastest, but near the ends faster than that is there: a colour that changes most near its
    /// end would jump. In so many seconds no place is passed faster than the whole passage passes it.
    fn seconds(&self) -> f64 {
        (self.way * self.whole).sqrt()
    }

    /// How far the way is that is done, and the way that is left, in seconds of undisturbed passages.
    fn done_and_left(&self) -> [f64; 2] {
        let done = f64::from(eased(self.part));
        [done * self.way, (1.0 - done) * self.way]
    }
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

    /// What is shown in place of the document at the step where it stands or that it is under way to.
    pub fn bound_for(&self) -> Option<&Illustration> {
        match &self.passage {
            Some(passage) => Some(&passage.ends[1]),
            None => self.shown(),
        }
    }

    /// True in the middle of a passage, whether it goes on or stands still.
    pub fn is_between(&self) -> bool {
        self.passage.is_some()
    }

    /// True while a passage goes on.
    pub fn is_moving(&self) -> bool {
        self.passage.as_ref().is_some_and(|p| p.since.is_some())
    }

    /// Where one stands: the number of the step, in a passage between those of its ends.
    pub fn position(&self) -> f32 {
        let to = self.step as f32;
        match &self.passage {
            Some(passage) => passage.at + (to - passage.at) * passage.part,
            None => to,
        }
    }

    /// Goes to a step from what is shown now: to a neighbour by a passage, unless `is_cut`, further at once. A passage
    /// that stands still goes on if it leads there. Returns the camera that is taken at once.
    ///
    /// A passage that begins in the middle of another leads back to where that came from, or over the rest of that and
    /// its own way, and takes its time for it: nothing changes faster than in an undisturbed passage.
    pub fn go(
        &mut self,
        document: &Document,
        step: usize,
        (now, from): (f64, Camera),
        is_cut: bool,
    ) -> Option<Camera> {
        let step = step.min(document.step_count());
        let position = self.position();
        let before = std::mem::replace(&mut self.step, step);
        let camera_at = |step| state_at(document, step).map(|state| state.camera);
        let turns = camera_at(before) != camera_at(step);
        // A step that does not turn the camera leaves it where the student has turned it, but a turn is completed.
        let is_turning = self.passage.as_ref().is_some_and(|p| p.cameras.is_some());
        let end = camera_at(step).filter(|_| turns || is_turning);
        if is_cut || step.abs_diff(before) > 1 {
            let is_elsewhere = step != before || self.passage.is_some();
            self.passage = None;
            self.shown = shown_at(document, step);
            return end.filter(|_| is_elsewhere);
        }
        if step == before && self.passage.as_ref().is_none_or(|p| p.since.is_some()) {
            return None;
        }
        let steps = &document.illustration().steps;
        let later = steps.get(step.max(before).saturating_sub(1));
        let own = later.map_or(0.0, |step| f64::from(step.seconds));
        let mut next = Passage {
            before,
            at: position,
            ends: [
                self.shown.take().or_else(|| state_at(document, before))?,
                state_at(document, step)?,
            ],
            is_backwards: step < before,
            since: Some(now),
            part: 0.0,
            way: own,
            whole: own,
            behind: 0.0,
            cameras: end.map(|end| [from, end]),
        };
        if let Some(passage) = &self.passage {
            let [done, left] = passage.done_and_left();
            if step == before {
                // The rest of a passage that stood still.
                next.before = passage.before;
                next.is_backwards = passage.is_backwards;
                (next.way, next.behind) = (left, done + passage.behind);
                next.whole = passage.whole;
            } else if step == passage.before {
                (next.way, next.behind) = (done + passage.behind, left);
                next.whole = passage.whole;
            } else {
                // Both ways are gone at once, each of them as slowly as it would be by itself.
                (next.way, next.behind) = (left + own, left);
                let seconds = (left * passage.whole).sqrt() + own;
                next.whole = (seconds * seconds / next.way.max(f64::MIN_POSITIVE))
                    .max(passage.whole)
                    .max(own);
            }
        }
        self.shown = Some(Arc::clone(&next.ends[0]));
        self.passage = Some(Box::new(next));
        None
    }

    /// Stands still at a place of the lesson: a whole number is a step, what lies between two is in the passage from
    /// one to the other. Returns the camera of that place, if any step turns the camera.
    pub fn scrub(&mut self, document: &Document, position: f32) -> Option<Camera> {
        let count = document.step_count();
        let position = position.clamp(0.0, count as f32);
        let states = 0..=count;
        let first = state_at(document, 0)?.camera;
        let turns = states
            .filter_map(|step| state_at(document, step))
            .any(|state| state.camera != first);
        let step = position.ceil() as usize;
        let part = position + 1.0 - step as f32;
        self.step = step;
        self.passage = None;
        self.shown = shown_at(document, step);
        let end = state_at(document, step)?;
        if part >= 1.0 || step == 0 {
            return turns.then_some(end.camera);
        }
        let start = state_at(document, step - 1)?;
        let steps = &document.illustration().steps;
        let seconds = steps.get(step - 1);
        let seconds = seconds.map_or(0.0, |step| f64::from(step.seconds));
        let passage = Passage {
            before: step - 1,
            at: (step - 1) as f32,
            cameras: turns.then_some([start.camera, end.camera]),
            ends: [start, end],
            is_backwards: false,
            since: None,
            part,
            way: seconds,
            whole: seconds,
            behind: 0.0,
        };
        let camera = passage.camera();
        self.shown = Some(Arc::new(passage.shown()));
        self.passage = Some(Box::new(passage));
        camera
    }

    /// Shows something else at the step where it stands or that it was under way to, as long as it stays there.
    pub fn show(&mut self, shown: Arc<Illustration>) {
        self.passage = None;
        self.shown = Some(shown);
    }

    /// A passage that goes on stands still.
    pub fn pause(&mut self) {
        if let Some(passage) = &mut self.passage {
            passage.since = None;
        }
    }

    /// Goes on to a time, seconds on the clock of the interface; returns the camera of the passage, if it has one.
    pub fn advance(&mut self, document: &Document, now: f64) -> Option<Camera> {
        let passage = self.passage.as_mut()?;
        let past = (now - passage.since?).max(0.0);
        let seconds = passage.seconds();
        if past >= seconds {
            let end = passage.cameras.map(|[_, end]| end);
            self.passage = None;
            self.shown = shown_at(document, self.step);
            return end;
        }
        passage.part = (past / seconds) as f32;
        self.shown = Some(Arc::new(passage.shown()));
        passage.camera()
    }
}

/// The state of the lesson at a step; nothing where that is the document itself.
fn shown_at(document: &Document, step: usize) -> Option<Arc<Illustration>> {
    if step == 0 {
        return None;
    }
    state_at(document, step)
}

/// The state of the lesson at a step.
fn state_at(document: &Document, step: usize) -> Option<Arc<Illustration>> {
    let state = document.lesson().ok()?.at_step(step).ok()?;
    Some(Arc::clone(state))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::ParamValue;

    /// Each step takes a second.
    const LESSON: &str = r#"{ "fabrica": 1, "subject": { "builtin": "cube" },
        "templates": [{ "kind": "peel", "params": { "progress": 0 } }],
        "steps": [{ "set": { "/templates/0/params/progress": 1 } }, { "set": { "/camera/fov": 40 } },
            { "set": { "/templates/0/params/progress": 0.4 } }] }"#;

    /// A frame, seconds.
    const FRAME: f64 = 0.01;

    struct Lesson {
        document: Document,
        walk: Walk,
        now: f64,
    }

    impl Lesson {
        fn new() -> Self {
            let document = Document::from_json(LESSON).expect("a document");
            Self {
                walk: Walk::at(&document, 0),
                document,
                now: 0.0,
            }
        }

        /// What pictures may make of a value: most of it happens near its end, or near its start.
        fn looks(&self) -> [f32; 2] {
            let illustration = self.document.illustration();
            let template = &self.walk.shown().unwrap_or(illustration).templates[0];
            let mut params = template.kind.spec().params.iter();
            let index = params.position(|param| param.name == "progress");
            let ParamValue::Number(value) = template.params[index.expect("a progress")] else {
                panic!("a number");
            };
            [value.powi(8), (1.0 - value).powi(8)]
        }

        fn go(&mut self, step: usize) {
            let from = (self.now, Camera::DOCUMENT_DEFAULT);
            self.walk.go(&self.document, step, from, false);
        }

        /// Goes on for so long; the largest change from one frame to the next of each look.
        fn advance(&mut self, seconds: f64) -> [f32; 2] {
            let mut most = [0.0_f32; 2];
            for _ in 0..(seconds / FRAME).round() as usize {
                let before = self.looks();
                self.now += FRAME;
                self.walk.advance(&self.document, self.now);
                let after = self.looks();
                most = std::array::from_fn(|k| most[k].max((after[k] - before[k]).abs()));
            }
            most
        }
    }

    #[test]
    fn nothing_changes_faster_than_in_an_undisturbed_passage() {
        let mut lesson = Lesson::new();
        let mut most = [0.0_f32; 2];
        for step in [1, 0] {
            lesson.go(step);
            let found = lesson.advance(1.1);
            most = std::array::from_fn(|k| most[k].max(found[k]));
        }
        assert!(most.iter().all(|most| *most > 0.02), "{most:?}");
        for moment in 1..20 {
            let moment = 0.05 * f64::from(moment);
            // Turned round, and round again; from a place where it stood still, to either side.
            for (start, first, second) in [(0, 1, 0), (1, 0, 1)] {
                let mut lesson = Lesson::new();
                lesson.walk = Walk::at(&lesson.document, start);
                lesson.go(first);
                lesson.advance(moment);
                lesson.go(second);
                let once = lesson.advance(0.3);
                lesson.go(first);
                let again = lesson.advance(2.0);
                assert!(!lesson.walk.is_moving(), "it has come to its end");
                let mut found = [once, again].concat();
                for to in [0, 1] {
                    lesson.walk.scrub(&lesson.document, moment as f32);
                    lesson.go(to);
                    found.extend(lesson.advance(2.0));
                }
                for (k, found) in found.iter().enumerate() {
                    let most = most[k % 2];
                    assert!(*found < 1.02 * most, "{k} at {moment}: {found}, {most}");
                }
            }
        }
    }
}
