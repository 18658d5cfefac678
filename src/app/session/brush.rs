//! The ball that paints tissue, and the drag under way.

use super::line::Line;

/// The ball that paints, and the drag under way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Brush {
    /// Radius of the ball as it was chosen, mm.
    pub(super) radius_mm: Option<f32>,
    /// Drags that were begun. Each has its number.
    pub drags: usize,
    /// The number of the last drag that nothing more is added to.
    pub(super) closed: usize,
    pub(super) drag: Option<Drag>,
}

/// What one drag has painted so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drag {
    pub(super) number: usize,
    /// Index in `subject.features` of the recipe.
    pub(super) recipe: usize,
    /// Strokes of the recipe before the drag.
    pub(super) before: usize,
    /// Strokes of the drag.
    pub(super) count: usize,
    pub(super) radius_mm: f32,
    pub(super) line: Line,
}

impl Brush {
    /// Nothing more is added to the drags so far.
    pub(super) fn close(&mut self) {
        (self.closed, self.drag) = (self.drags, None);
    }
}

/// The answer to a question of a drag: the number of the drag, and whether it erases, as one number.
pub fn drag_code(number: usize, erases: bool) -> usize {
    2 * number + usize::from(erases)
}
