//! What an `rbf` interpolates.

use glam::{Vec2, Vec3};

/// Control points of an `rbf`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlPoints {
    /// The pairs of points, at most `document::MAX_POINTS`.
    pub points: Vec<ControlPoint>,
    /// A line in the x-y plane of the box that divides it in two; its ends go straight on. Fewer than two points divide
    /// nothing. At most `document::MAX_CUT` points.
    pub cut: Vec<Vec2>,
}

/// One control point of an `rbf`, template space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Position of the point.
    pub at: Vec3,
    /// The inverse displacement at this point: the tissue seen at `at` comes from `at + shift`.
    pub shift: Vec3,
}
