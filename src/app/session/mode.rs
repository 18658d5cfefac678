//! Which state of a document is shown: that of its start, or of a step or a passage of its lesson.

use crate::document::{Camera, Document, Illustration, Walk};

/// Where one stands in the lesson of a document. What is edited is what is shown.
#[derive(Debug, Default)]
pub enum Mode {
    /// The document as it stands is shown and edited.
    #[default]
    Author,
    /// A step above 0 is shown, or a passage between steps is under way.
    Lesson(Walk),
}

impl Mode {
    /// The mode in which a document opens at a step.
    pub fn at(document: &Document, step: usize) -> Self {
        match step.min(document.step_count()) {
            0 => Self::Author,
            step => Self::Lesson(Walk::at(document, step)),
        }
    }

    /// Number of the step that is shown, or that a passage leads to; 0 is the document as it stands.
    pub fn step(&self) -> usize {
        match self {
            Self::Author => 0,
            Self::Lesson(walk) => walk.step(),
        }
    }

    /// True while a passage between two steps goes on.
    pub fn is_moving(&self) -> bool {
        matches!(self, Self::Lesson(walk) if walk.is_moving())
    }

    /// The illustration that the picture shows: the document's, or its state at the step of the lesson.
    pub fn shown<'a>(&'a self, document: &'a Document) -> &'a Illustration {
        match self {
            Self::Author => document.illustration(),
            Self::Lesson(walk) => walk.shown().unwrap_or_else(|| document.illustration()),
        }
    }

    /// True in the middle of a passage, whether it goes on or stands still.
    pub fn is_between(&self) -> bool {
        matches!(self, Self::Lesson(walk) if walk.is_between())
    }

    /// Where one stands in the lesson: see [`Walk::position`].
    pub fn position(&self) -> f32 {
        match self {
            Self::Author => 0.0,
            Self::Lesson(walk) => walk.position(),
        }
    }

    /// Goes to a step: see [`Walk::go`]. A passage starts at the time `now` (seconds) and at the camera `from`.
    pub fn go(
        &mut self,
        document: &Document,
        step: usize,
        (now, from): (f64, Camera),
        is_cut: bool,
    ) -> Option<Camera> {
        let mut walk = self.take_walk();
        let camera = walk.go(document, step, (now, from), is_cut);
        self.settle(walk);
        camera
    }

    /// Stands still at a place of the lesson: see [`Walk::scrub`].
    pub fn scrub(&mut self, document: &Document, position: f32) -> Option<Camera> {
        let mut walk = self.take_walk();
        let camera = walk.scrub(document, position);
        self.settle(walk);
        camera
    }

    /// A passage that goes on stands still.
    pub fn pause(&mut self) {
        if let Self::Lesson(walk) = self {
            walk.pause();
        }
    }

    /// Rests at the step that is shown or under way to, as the document has it now.
    pub fn rest(&mut self, document: &Document) {
        *self = Self::at(document, self.step());
    }

    fn take_walk(&mut self) -> Walk {
        match std::mem::take(self) {
            Self::Author => Walk::default(),
            Self::Lesson(walk) => walk,
        }
    }

    /// Advances a passage to the time `now`, seconds. Returns the camera of that time if the passage moves the camera.
    pub fn advance(&mut self, document: &Document, now: f64) -> Option<Camera> {
        match std::mem::take(self) {
            Self::Author => None,
            Self::Lesson(mut walk) => {
                let camera = walk.advance(document, now);
                self.settle(walk);
                camera
            }
        }
    }

    /// Stays in the lesson while a step or a passage is shown; at rest on step 0 the author's mode is back.
    fn settle(&mut self, walk: Walk) {
        if walk.step() > 0 || walk.is_between() {
            *self = Self::Lesson(walk);
        }
    }
}
