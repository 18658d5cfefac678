//! Steps of the handles when they snap.

/// Degrees of a turn.
pub(crate) const TURN_DEG: f32 = 15.0;
/// Subject units of a move, and of a side of the box.
pub(crate) const LENGTH: f32 = 0.05;
/// Part of the range of a main parameter.
pub(crate) const PARAM: f32 = 0.05;

/// The multiple of `step` that is nearest to `value`.
pub(crate) fn nearest(value: f32, step: f32) -> f32 {
    (value / step).round() * step
}
