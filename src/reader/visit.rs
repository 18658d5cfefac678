//! A document as one reader sees it.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::Vec2;
use serde_json::{Value, json};

use crate::document::{
    Autoplay, Camera, Control, ControlRange, Document, DocumentError, FIGURE_FRONT, Illustration,
    MAX_STEPS, Turn, Walk, orbit, roll, shift, zoom,
};
use crate::link;

/// How far from the middle of the subject the camera's target may be moved, subject units.
const FARTHEST_TARGET: f32 = 2.0;

/// Where a reader stands in a document, from where she looks, and which values she has moved.
#[derive(Debug)]
pub struct Visit {
    /// As the author made it.
    lesson: Document,
    /// With the values that the reader or the page has set.
    document: Document,
    walk: Walk,
    playing: Option<Autoplay>,
    /// All values that were set, the last one of each pointer: pointer and value.
    moved: Vec<(String, Value)>,
    /// Those of them that were set at this step, which may set them itself.
    held: Vec<(String, Value)>,
    camera: Camera,
    /// The camera was turned by hand since the step was shown.
    is_turned: bool,
    /// The values of the document's controls at this step, in their order.
    control_values: Vec<Value>,
    revision: u64,
}

impl Visit {
    /// Opens a link, a payload or a document as JSON; a link may name a step. A step behind the last is the last.
    ///
    /// # Errors
    /// In words: what is wrong with the link or the document.
    pub fn open(text: &str, step: Option<usize>) -> Result<Self, String> {
        let link::Link {
            document,
            step: linked,
        } = link::document_of(text)?;
        let step = step.unwrap_or(linked).min(document.step_count());
        let mut visit = Self {
            lesson: document.clone(),
            walk: Walk::at(&document, step),
            document,
            playing: None,
            moved: Vec::new(),
            held: Vec::new(),
            camera: Camera::DOCUMENT_DEFAULT,
            is_turned: false,
            control_values: Vec::new(),
            revision: 0,
        };
        visit.camera = visit.shown().camera;
        visit.moved_values();
        Ok(visit)
    }

    /// The document with the values that were set.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// What is to be drawn, apart from the camera.
    pub fn shown(&self) -> &Illustration {
        let walked = self.walk.shown();
        walked.unwrap_or_else(|| self.document.illustration())
    }

    /// What is drawn at the step that is shown or that a passage leads to: texts switch at the start of a passage.
    pub fn bound_for(&self) -> &Illustration {
        let walked = self.walk.bound_for();
        walked.unwrap_or_else(|| self.document.illustration())
    }

    /// From where it is seen.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Grows with every change of what is to be drawn.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The step that is shown, or that a passage leads to.
    pub fn step(&self) -> usize {
        self.walk.step()
    }

    /// True while a passage goes on.
    pub fn is_moving(&self) -> bool {
        self.walk.is_moving()
    }

    /// True if turning, zooming or moving values has led away from what the author shows at this step.
    pub fn has_strayed(&self) -> bool {
        self.is_turned || !self.held.is_empty() || self.document != self.lesson
    }

    /// Where one stands: a whole number is a step, what lies between two is in the passage from one to the other.
    pub fn position(&self) -> f32 {
        self.walk.position()
    }

    /// Goes to a step at the time `now`, seconds: to a neighbour by a passage, unless `is_cut`, further at once. The
    /// step is held within those that there are.
    pub fn go(&mut self, step: usize, now: f64, is_cut: bool) {
        self.playing = None;
        self.walk_to(step, now, is_cut);
    }

    fn walk_to(&mut self, step: usize, now: f64, is_cut: bool) {
        let step = step.min(MAX_STEPS);
        let camera = if !self.held.is_empty() && step == self.walk.step() {
            self.walk = Walk::at(&self.document, step);
            None
        } else {
            let from = (now, self.camera);
            self.walk.go(&self.document, step, from, is_cut)
        };
        if let Some(camera) = camera {
            self.camera = camera;
            self.is_turned = false;
        }
        self.held.clear();
        self.moved_values();
    }

    /// True while the lesson plays by itself.
    pub fn is_playing(&self) -> bool {
        self.playing.is_some()
    }

    /// Begins to play at what is shown at the time `now`, seconds: on to the next step, after the last one from the
    /// start; or stands still.
    pub fn toggle_playing(&mut self, now: f64, is_cut: bool) {
        if self.playing.take().is_some() {
            self.walk.pause();
        } else if self.document.step_count() > 0 {
            let is_paused = self.walk.is_between() && !self.walk.is_moving();
            let (first, is_start) =
                Autoplay::first(self.walk.step(), is_paused, self.document.step_count());
            self.walk_to(first, now, is_cut || is_start);
            self.playing = Some(Autoplay::default());
        }
        self.revision += 1;
    }

    /// Goes on with a passage, or with a lesson that plays, to the time `now`, seconds. True while a passage is under
    /// way.
    pub fn advance(&mut self, now: f64, is_cut: bool) -> bool {
        if self.walk.is_moving() {
            if let Some(camera) = self.walk.advance(&self.document, now) {
                self.camera = camera;
                self.is_turned = false;
            }
            self.revision += 1;
        }
        if let Some(mut playing) = self.playing {
            let (step, steps) = (self.walk.step(), &self.document.illustration().steps);
            let turn = playing.turn(step, self.walk.is_moving(), steps, now);
            self.playing = Some(playing).filter(|_| turn != Turn::Ends);
            if turn == Turn::GoesOn {
                self.walk_to(step + 1, now, is_cut);
            }
        }
        self.walk.is_moving()
    }

    /// How long a lesson that plays still stays at its step, seconds.
    pub fn seconds_to_next_step(&self, now: f64) -> Option<f64> {
        let steps = &self.document.illustration().steps;
        self.playing?.seconds_left(self.walk.step(), steps, now)
    }

    /// Stands still at a place between steps: 1.5 is the middle of the passage from step 1 to step 2.
    pub fn scrub(&mut self, position: f32) {
        let position = if position.is_finite() { position } else { 0.0 };
        self.playing = None;
        self.held.clear();
        if let Some(camera) = self.walk.scrub(&self.document, position) {
            self.camera = camera;
            self.is_turned = false;
        }
        self.moved_values();
    }

    /// Sets one value of what is shown, by its JSON pointer. It stays set in the steps that do not set it themselves.
    /// The camera stays, unless that is what is set.
    ///
    /// # Errors
    /// [`DocumentError`]: what is wrong with the pointer or the value; nothing is changed then.
    pub fn set(&mut self, pointer: &str, value: Value) -> Result<(), DocumentError> {
        let document = self.document.with(pointer, value.clone())?;
        let step = self.walk.step();
        let mut held = self.held.clone();
        put_last(&mut held, pointer, value.clone());
        let mut walk = Walk::at(&document, step);
        if step > 0 {
            let mut state = document.at_step(step)?;
            for (pointer, value) in &held {
                state = state.with(pointer, value.clone())?;
            }
            walk.show(Arc::new(state.illustration().clone()));
        }
        put_last(&mut self.moved, pointer, value);
        (self.document, self.walk, self.held, self.playing) = (document, walk, held, None);
        if pointer.starts_with("/camera") {
            self.camera = self.shown().camera;
        }
        self.moved_values();
        Ok(())
    }

    /// The camera as the document has it.
    pub fn view(&self) -> Value {
        let camera = &self.camera;
        let rotate = self.shown().written_rotation(camera.rotate);
        json!({
            "target": camera.target.to_array(),
            "rotate": rotate.to_array(),
            "distance": camera.distance,
            "fov": camera.fov_deg,
        })
    }

    /// What the reader has made of the lesson and where she stands in it, for [`Visit::resume`]. On the way to a step
    /// it is that step, with its own camera.
    pub fn stand(&self) -> Value {
        let is_moving = self.is_moving();
        json!({
            "position": if is_moving { self.step() as f32 } else { self.position() },
            "view": (!is_moving).then(|| self.view()),
            "turned": self.is_turned,
            "playing": self.is_playing(),
            "moved": self.moved,
            "held": self.held.len(),
        })
    }

    /// Brings a visit of the same lesson that was just opened to where another one stood; what does not fit is left
    /// out.
    pub fn resume(&mut self, stand: &Value) {
        let moved = stand["moved"].as_array().map_or(&[][..], Vec::as_slice);
        let held = stand["held"].as_u64().unwrap_or(0) as usize;
        let (before, held) = moved.split_at(moved.len().saturating_sub(held));
        self.set_all(before);
        self.scrub(stand["position"].as_f64().unwrap_or(0.0) as f32);
        self.set_all(held);
        let view = &stand["view"];
        if let (false, Ok(posed)) = (view.is_null(), self.document.with("/camera", view.clone())) {
            self.camera = posed.illustration().camera;
            self.is_turned = stand["turned"] == true;
        }
        self.playing = (stand["playing"] == true).then(Autoplay::default);
        self.revision += 1;
    }

    fn set_all(&mut self, values: &[Value]) {
        for pair in values {
            if let Some(pointer) = pair[0].as_str() {
                let _does_not_fit = self.set(pointer, pair[1].clone());
            }
        }
    }

    /// The values of the document's controls at this step, in their order: numbers, or true and false.
    pub fn control_values(&self) -> &[Value] {
        &self.control_values
    }

    /// Back to what the author shows at this step: view and values.
    pub fn reset(&mut self) {
        let step = self.walk.step();
        self.document = self.lesson.clone();
        self.walk = Walk::at(&self.document, step);
        self.moved.clear();
        self.held.clear();
        self.playing = None;
        self.camera = self.shown().camera;
        self.is_turned = false;
        self.moved_values();
    }

    /// The file has told that the subject is a figure, which the document did not: from now on it does.
    pub fn tell_figure(&mut self) {
        if self.document.illustration().is_of_figure() {
            return;
        }
        let told = |document: &Document| document.with("/figure", json!({}));
        let (Ok(lesson), Ok(document)) = (told(&self.lesson), told(&self.document)) else {
            return;
        };
        self.walk = Walk::at(&document, self.walk.step());
        (self.lesson, self.document) = (lesson, document);
        self.camera.rotate *= FIGURE_FRONT;
        self.moved_values();
    }

    /// The file has told that the subject is no figure, though one stands beside it: the camera is that of a document
    /// without it from now on.
    pub fn tell_space(&mut self) {
        let shown = self.document.illustration();
        if shown.subject.is_figure().is_some() || !shown.is_of_figure() {
            return;
        }
        self.lesson = self.lesson.known_in_space();
        self.document = self.document.known_in_space();
        self.walk = Walk::at(&self.document, self.walk.step());
        self.camera.rotate *= FIGURE_FRONT.inverse();
        self.moved_values();
    }

    /// Turns the object under the hand: radians to the right and down. A figure is flat, and is moved instead: by the
    /// whole picture for half a turn.
    pub fn turn(&mut self, right: f32, down: f32) {
        if self.document.illustration().is_of_figure() {
            return self.shift(right / PI, down / PI);
        }
        if right.is_finite() && down.is_finite() {
            orbit(&mut self.camera, Vec2::new(right, down));
            self.moved_camera();
        }
    }

    /// Comes closer by a factor above 1, goes away by one below.
    pub fn zoom(&mut self, factor: f32) {
        zoom(&mut self.camera, factor);
        self.moved_camera();
    }

    /// Moves the object in the picture: parts of the picture's shorter side to the right and down.
    pub fn shift(&mut self, right: f32, down: f32) {
        if !(right.is_finite() && down.is_finite()) {
            return;
        }
        let camera = &mut self.camera;
        shift(camera, Vec2::new(right, down));
        camera.target = camera.target.clamp(
            glam::Vec3::splat(-FARTHEST_TARGET),
            glam::Vec3::splat(FARTHEST_TARGET),
        );
        self.moved_camera();
    }

    /// Rolls a figure under the hand, radians, a clockwise picture for positive. What lies in space is only turned.
    pub fn roll(&mut self, angle: f32) {
        if angle.is_finite() && self.document.illustration().is_of_figure() {
            roll(&mut self.camera, angle);
            self.moved_camera();
        }
    }

    /// The document, its step or the values that are held are others now. States of steps are resolved here, not in
    /// each frame.
    fn moved_values(&mut self) {
        self.revision += 1;
        let controls = &self.document.illustration().controls;
        if controls.is_empty() {
            return self.control_values.clear();
        }
        let state = self.document.at_step(self.walk.step());
        let state = state.as_ref().unwrap_or(&self.document);
        let value = |control: &Control| {
            let held = self.held.iter().find(|(at, _)| *at == control.pointer);
            let value = held.map(|(_, value)| value).or(state.get(&control.pointer));
            value.cloned().unwrap_or_else(|| match control.range {
                ControlRange::Flag(default) => json!(default),
                ControlRange::Number { default, .. } => json!(default),
            })
        };
        self.control_values = controls.iter().map(value).collect();
    }

    fn moved_camera(&mut self) {
        self.is_turned = true;
        self.revision += 1;
    }
}

/// Keeps a value as the last one that was set.
fn put_last(values: &mut Vec<(String, Value)>, pointer: &str, value: Value) {
    values.retain(|(other, _)| other != pointer);
    values.push((pointer.to_owned(), value));
}

#[cfg(test)]
mod tests {
    use super::*;

    const LESSON: &str = r#"{ "fabrica": 1, "title": "Opening", "subject": { "builtin": "cube" },
        "templates": [{ "kind": "split", "params": { "amount": 0 } }, { "kind": "twist" }],
        "steps": [{ "set": { "/templates/0/params/amount": 0.3 }, "seconds": 2 },
                  { "set": { "/camera/distance": 1.5 } }] }"#;
    const AMOUNT: &str = "/templates/0/params/amount";

    fn amount(visit: &Visit) -> f64 {
        let spec = visit.shown().templates[0].kind.spec();
        let index = spec.params.iter().position(|p| p.name == "amount");
        match visit.shown().templates[0].params[index.expect("an amount")] {
            crate::document::ParamValue::Number(value) => f64::from(value),
            _ => panic!("a number"),
        }
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-6
    }

    #[test]
    fn texts_switch_at_the_start_of_a_passage() {
        let json = r##"{ "fabrica": 1, "title": "Whole", "labels": [{ "text": "a" }],
            "steps": [{ "set": { "/title": "Open", "/labels/0/text": "b" }, "seconds": 2 }] }"##;
        let mut visit = Visit::open(json, None).expect("a document");
        let told = |visit: &Visit| {
            let bound = visit.bound_for();
            (bound.title.clone(), bound.captions[0].text.clone())
        };
        assert_eq!(told(&visit), ("Whole".to_owned(), "a".to_owned()));
        visit.go(1, 10.0, false);
        assert_eq!(visit.shown().title, "Whole", "nothing was drawn yet");
        assert_eq!(told(&visit), ("Open".to_owned(), "b".to_owned()));
        while visit.advance(20.0, false) {}
        assert_eq!(told(&visit), ("Open".to_owned(), "b".to_owned()));
        visit.go(0, 30.0, false);
        assert_eq!(told(&visit), ("Whole".to_owned(), "a".to_owned()));
    }

    #[test]
    fn steps_are_walked_and_the_camera_stays_where_no_step_turns_it() {
        let mut visit = Visit::open(LESSON, None).expect("a document");
        visit.turn(0.5, 0.1);
        let turned = *visit.camera();
        assert!(visit.has_strayed());
        visit.go(1, 10.0, false);
        assert!(visit.advance(11.0, false) && near(amount(&visit), 0.15));
        assert!(
            near(f64::from(visit.position()), 0.5),
            "halfway: {}",
            visit.position()
        );
        assert!(!visit.advance(12.5, false) && near(amount(&visit), 0.3));
        assert_eq!(*visit.camera(), turned, "the step leaves the camera alone");
        visit.go(2, 13.0, true);
        assert!(!visit.is_moving());
        assert!(near(f64::from(visit.camera().distance), 1.5));
        visit.go(99, 14.0, true);
        assert_eq!(visit.step(), 2, "the last one");
    }

    #[test]
    fn a_value_is_moved_at_any_step_and_taken_back() {
        let mut visit = Visit::open(LESSON, Some(1)).expect("a document");
        let camera = *visit.camera();
        visit.set(AMOUNT, json!(0.1)).expect("a number");
        assert!(near(amount(&visit), 0.1), "over what the step sets");
        assert_eq!(*visit.camera(), camera);
        visit.go(0, 0.0, true);
        assert!(near(amount(&visit), 0.1), "it stays set");
        visit.go(1, 0.0, true);
        assert!(near(amount(&visit), 0.3), "the step sets its own");
        visit.reset();
        assert!(!visit.has_strayed());
        visit.go(0, 0.0, true);
        assert!(near(amount(&visit), 0.0));
    }

    #[test]
    fn a_visit_is_resumed_where_another_one_stood() {
        let mut visit = Visit::open(LESSON, None).expect("a document");
        visit.set(AMOUNT, json!(0.1)).expect("a number");
        visit.go(1, 0.0, true);
        let again = |visit: &Visit| {
            let stand = serde_json::from_str(&visit.stand().to_string()).expect("JSON");
            let mut again = Visit::open(LESSON, None).expect("a document");
            again.resume(&stand);
            for key in ["position", "turned", "playing", "moved", "held"] {
                assert_eq!(again.stand()[key], visit.stand()[key], "{key}");
            }
            let [one, other] = [&again, visit].map(|visit| visit.camera());
            assert!(one.rotate.angle_between(other.rotate) < 3e-3);
            assert!((one.distance - other.distance).abs() < 1e-5);
            assert_eq!(again.document(), visit.document());
            again
        };
        let mut resumed = again(&visit);
        assert!(near(amount(&resumed), 0.3), "the step sets its own");
        resumed.go(0, 0.0, true);
        assert!(near(amount(&resumed), 0.1), "the value stays set");

        visit.set(AMOUNT, json!(0.2)).expect("a number");
        visit.turn(0.5, 0.1);
        let resumed = again(&visit);
        assert!(near(amount(&resumed), 0.2) && resumed.has_strayed());
        visit.scrub(1.5);
        again(&visit);
        visit.toggle_playing(0.0, true);
        assert!(again(&visit).is_playing());

        // On the way it is the step that the passage leads to.
        visit.go(1, 0.0, false);
        assert!(visit.advance(0.5, false));
        let stand = visit.stand();
        let mut resumed = Visit::open(LESSON, None).expect("a document");
        resumed.resume(&stand);
        assert_eq!((resumed.step(), resumed.is_moving()), (1, false));
        // What is none of this lesson changes nothing.
        let mut other = Visit::open(LESSON, None).expect("a document");
        for text in [
            "null",
            r#"{"moved":[7,["x",1]],"held":9,"view":{"fov":"wide"},"position":-3}"#,
        ] {
            other.resume(&serde_json::from_str(text).expect("JSON"));
            assert!(!other.has_strayed() && other.step() == 0, "{text}");
        }
    }

    #[test]
    fn a_figure_beside_a_scan_does_not_turn_it() {
        let json = r#"{ "fabrica": 1, "subject": { "src": "a.nii" }, "figure": { "detail": 800 },
            "camera": { "rotate": [0, 0, 0.7071, 0.7071] },
            "steps": [{ "set": { "/camera/rotate": [0.7071, 0, 0, 0.7071] }, "seconds": 0 }] }"#;
        let plain = json.replace(r#""figure": { "detail": 800 },"#, "");
        let mut visit = Visit::open(json, None).expect("a document");
        let mut wanted = Visit::open(&plain, None).expect("a document");
        let apart = |one: &Visit, other: &Visit| {
            let [one, other] = [one, other].map(|visit| visit.camera().rotate);
            one.angle_between(other)
        };
        assert!(apart(&visit, &wanted) > 1.0, "it may be a figure");
        visit.tell_space();
        assert!(apart(&visit, &wanted) < 3e-3);
        for visit in [&mut visit, &mut wanted] {
            visit.go(1, 0.0, true);
        }
        assert!(apart(&visit, &wanted) < 3e-3, "at the step too");
        let written = |visit: &Visit| visit.shown().written_rotation(visit.camera().rotate);
        assert!(written(&visit).angle_between(written(&wanted)) < 3e-3);
    }

    #[test]
    fn a_figure_is_rolled_and_what_lies_in_space_is_not() {
        let angle_of = |json: &str, roll: f32| {
            let mut visit = Visit::open(json, None).expect("a document");
            let before = visit.camera().rotate;
            visit.roll(roll);
            assert_eq!(visit.has_strayed(), visit.camera().rotate != before);
            before.angle_between(visit.camera().rotate)
        };
        let figure = r#"{ "fabrica": 1, "subject": { "builtin": "drawn-arm" } }"#;
        assert!((angle_of(figure, 0.5) - 0.5).abs() < 3e-3);
        assert!(angle_of(figure, f32::NAN) < 3e-3);
        assert!(angle_of(LESSON, 0.5) < 3e-3);
    }

    #[test]
    fn every_place_between_steps_can_be_shown() {
        let mut visit = Visit::open(LESSON, None).expect("a document");
        for (place, wanted) in [
            (0.5, 0.15),
            (1.0, 0.3),
            (0.0, 0.0),
            (9.0, 0.3),
            (f32::NAN, 0.0),
        ] {
            visit.scrub(place);
            assert!(near(amount(&visit), wanted), "{place}: {}", amount(&visit));
        }
        visit.scrub(1.5);
        let distance = visit.camera().distance;
        assert!(distance > 1.5 && distance < 2.5, "{distance}");
        assert_eq!((visit.step(), visit.position()), (2, 1.5));
    }

    #[test]
    fn wrong_values_change_nothing() {
        let mut visit = Visit::open(LESSON, Some(1)).expect("a document");
        let revision = visit.revision();
        for (pointer, value) in [
            (AMOUNT, json!("wide")),
            ("/templates/9/params/amount", json!(1)),
            ("no pointer", json!(1)),
            ("/steps/0/set", json!(7)),
        ] {
            assert!(visit.set(pointer, value).is_err(), "{pointer}");
        }
        visit.turn(f32::NAN, 0.0);
        visit.shift(f32::INFINITY, 0.0);
        assert_eq!(visit.revision(), revision);
        visit.zoom(f32::NAN);
        assert!(visit.camera().distance.is_finite());
        for text in ["", "#", "{", r#"{"fabrica":2}"#, "#aGVsbG8"] {
            assert!(Visit::open(text, None).is_err(), "{text}");
        }
    }
}
