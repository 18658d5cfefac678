//! The states of a document at its steps, and the passages between them.

use super::blend::blend;
use super::model::{Illustration, Step, SubjectRef};
use super::read::resolve;
use super::steps;
use super::text::{DocumentError, json};
use serde_json::Value;
use std::sync::Arc;

/// What a document means at each of its steps. Resolved once per document, when the first step is shown; a moment of a
/// passage only blends two states.
#[derive(Debug)]
pub struct Lesson {
    /// One state per step, step 0 first; none of them has steps of its own.
    states: Vec<Arc<Illustration>>,
    /// Length of the passage to each step after step 0, seconds.
    seconds: Vec<f32>,
}

impl Lesson {
    /// Walks the steps of a checked tree and resolves the document at each of them. The file of the subject `in_space`
    /// is none of a figure.
    ///
    /// # Errors
    /// None that a document would not have had when it was made.
    pub(super) fn new(
        root: &Value,
        steps: &[Step],
        in_space: Option<&SubjectRef>,
    ) -> Result<Self, DocumentError> {
        let mut states = Vec::with_capacity(steps.len() + 1);
        steps::walk(root, |state| {
            let mut state = state.clone();
            json::normalise(&mut state, 0)?;
            let map = state.as_object().ok_or(DocumentError::NoVersion)?;
            let (mut illustration, _notices) = resolve(map)?;
            illustration.learn_space(in_space);
            states.push(Arc::new(illustration));
            Ok(())
        })?;
        Ok(Self {
            states,
            seconds: steps.iter().map(|step| step.seconds).collect(),
        })
    }

    /// The illustration at a step, after the passage to it.
    ///
    /// # Errors
    /// [`DocumentError::NoSuchStep`].
    pub fn at_step(&self, step: usize) -> Result<&Arc<Illustration>, DocumentError> {
        self.states.get(step).ok_or(DocumentError::NoSuchStep {
            step,
            last: self.states.len().saturating_sub(1),
        })
    }

    /// The illustration `seconds` into the passage to a step: numbers, vectors, colours and rotations on their way with
    /// a smoothstep ease, everything else as it is at the step. There is no passage to step 0.
    ///
    /// # Errors
    /// [`DocumentError::NoSuchStep`].
    pub fn at(&self, step: usize, seconds: f32) -> Result<Illustration, DocumentError> {
        let end = self.at_step(step)?;
        let Some(before) = step.checked_sub(1) else {
            return Ok(end.as_ref().clone());
        };
        let start = self.at_step(before)?;
        let total = self.seconds.get(before).copied().unwrap_or(0.0);
        let part = if total > 0.0 && seconds.is_finite() {
            (seconds / total).clamp(0.0, 1.0)
        } else {
            1.0
        };
        Ok(Self::between(start, end, part))
    }

    /// What a passage shows once this part of its time is over (0 to 1), eased like [`Lesson::at`]. What cannot go over
    /// by and by is as it is at the end.
    pub fn between(start: &Illustration, end: &Illustration, part: f32) -> Illustration {
        blend(start, end, eased(part))
    }
}

/// How much of a passage is done after this part of its time: it begins and ends slowly.
pub(super) fn eased(part: f32) -> f32 {
    part * part * (3.0 - 2.0 * part)
}
