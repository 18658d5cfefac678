//! Whether a document is edited or its lesson is walked.

use super::walk::Walk;
use crate::document::{Camera, Document, Illustration};

/// Who looks: the author at the document, or a student at the steps of its lesson.
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

    /// The step that is shown or under way to; 0 is the document as it stands.
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

    /// What the picture shows: the document, or the state of its lesson.
    pub fn shown<'a>(&'a self, document: &'a Document) -> &'a Illustration {
        match self {
            Self::Author => document.illustration(),
            Self::Lesson(walk) => walk.shown().unwrap_or_else(|| document.illustration()),
        }
    }

    /// Goes to a step, from a camera. Returns the camera that is taken at once.
    pub fn go(
        &mut self,
        document: &Document,
        step: usize,
        now: f64,
        from: Camera,
    ) -> Option<Camera> {
        let mut walk = match std::mem::take(self) {
            Self::Author => Walk::default(),
            Self::Lesson(walk) => walk,
        };
        let camera = walk.go(document, step, now, from);
        self.settle(walk);
        camera
    }

    /// Goes on with a passage; returns its camera, if it has one.
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

    /// Back at the document as it stands, the lesson is over.
    fn settle(&mut self, walk: Walk) {
        if walk.step() > 0 || walk.is_moving() {
            *self = Self::Lesson(walk);
        }
    }
}
