use glam::{DVec2, Vec2};

use super::state::FigureView;
use crate::document::figure::{Handle, Hold};
use crate::math::simplified;

/// Less than this is no move, subject units.
pub(super) const NO_MOVE: f32 = 1e-4;

/// The place at rest that stands for what a handle holds: a pin's point, a region's middle, a line's first point.
/// `None` while the figure is not bent yet, or has no such region.
fn held_place(view: &FigureView, handle: &Handle) -> Option<Vec2> {
    match &handle.hold {
        Hold::Point(at) => Some(at.as_vec2()),
        Hold::Region(name) => view.sheet.as_ref()?.middle_of(name),
        Hold::Line { points, .. } => Some(points.first()?.as_vec2()),
    }
}

/// Where a place at rest is before handles move it.
fn before_handles(view: &FigureView, at: Vec2) -> DVec2 {
    let sheet = view.sheet.as_ref();
    sheet
        .map_or(at, |sheet| sheet.before_handles(at))
        .as_dvec2()
}

/// Where a handle is seen: where it takes the place that it holds.
pub fn handle_place(view: &FigureView, handle: &Handle) -> Option<Vec2> {
    match &handle.hold {
        Hold::Line { to: Some(to), .. } => to.first().map(|to| to.as_vec2()),
        _ => {
            let start = before_handles(view, held_place(view, handle)?);
            Some((start + handle.motion.by).as_vec2())
        }
    }
}

/// Where the points of a line are seen: where it takes them.
pub fn line_places(view: &FigureView, handle: &Handle) -> Vec<Vec2> {
    let Hold::Line { points, to } = &handle.hold else {
        return Vec::new();
    };
    if let Some(to) = to {
        return to.iter().map(|to| to.as_vec2()).collect();
    }
    let Some(start) = held_place(view, handle).map(|at| before_handles(view, at)) else {
        return Vec::new();
    };
    let motion = &handle.motion;
    let turn = DVec2::from_angle(motion.turn.unwrap_or(0.0)) * motion.scale;
    let carried = |point: &DVec2| {
        let before = before_handles(view, point.as_vec2());
        (start + motion.by + turn.rotate(before - start)).as_vec2()
    };
    points.iter().map(carried).collect()
}

/// The turn (radians, counter-clockwise) and the scale that the figure has where a handle holds it; what its document
/// gives where that is known.
pub fn handle_motion(view: &FigureView, handle: &Handle) -> (f64, f64) {
    let found = || {
        let sheet = view.sheet.as_ref()?;
        let (triangle, _) = sheet.forward(held_place(view, handle)?)?;
        Some(f64::from(sheet.motion_of(triangle)?.0))
    };
    let turn = handle.motion.turn.or_else(found);
    (turn.unwrap_or(0.0), handle.motion.scale)
}

/// The corners of a line that was drawn by hand that miss none of its places by more than `off`, or if there are more
/// than `most` by twice that, and so on.
pub(super) fn thinned(line: &[Vec2], off: f32, most: usize) -> Vec<Vec2> {
    let mut off = off;
    loop {
        let corners = simplified(line, off);
        if corners.len() <= most {
            return corners;
        }
        off *= 2.0;
    }
}
