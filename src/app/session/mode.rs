//! Whether a document is edited or its lesson is walked.

use super::walk::Walk;
use crate::document::{Camera, Document, Illustration};

/// Who uses the viewer: the author of the document, or a student who walks through the steps of its lesson.
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

    /// Goes to a step, by a passage that starts at the time `now` (seconds) and at the camera `from`. A step that is no
    /// neighbour is shown at once; its camera is returned if it differs from that of the step before.
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
        if walk.step() > 0 || walk.is_moving() {
            *self = Self::Lesson(walk);
        }
    }
}
