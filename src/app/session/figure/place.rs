use glam::{DVec2, Vec2};

use super::state::FigureView;
use crate::document::figure::{Handle, Hold};

/// Less than this is no move, subject units.
pub(super) const NO_MOVE: f32 = 1e-4;

/// Where the place that a handle holds is before handles move it: a pin's point, a region's middle, a line's first
/// point. `None` while the figure is not bent yet, or has no such region.
fn anchor(view: &FigureView, handle: &Handle) -> Option<DVec2> {
    let at = match &handle.hold {
        Hold::Point(at) => at.as_vec2(),
        Hold::Region(name) => view.sheet.as_ref()?.middle_of(name)?,
        Hold::Line { points, .. } => points.first()?.as_vec2(),
    };
    let sheet = view.sheet.as_ref();
    Some(
        sheet
            .map_or(at, |sheet| sheet.before_handles(at))
            .as_dvec2(),
    )
}

/// Where a handle is seen: where it takes the place that it holds.
pub fn handle_place(view: &FigureView, handle: &Handle) -> Option<Vec2> {
    match &handle.hold {
        Hold::Line { to: Some(to), .. } => to.first().map(|to| to.as_vec2()),
        _ => Some((anchor(view, handle)? + handle.motion.by).as_vec2()),
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
    let Some(start) = anchor(view, handle) else {
        return Vec::new();
    };
    let motion = &handle.motion;
    let turn = DVec2::from_angle(motion.turn.unwrap_or(0.0)) * motion.scale;
    let carried = |point: &DVec2| {
        let sheet = view.sheet.as_ref();
        let at = point.as_vec2();
        let before = sheet.map_or(at, |sheet| sheet.before_handles(at));
        (start + motion.by + turn.rotate(before.as_dvec2() - start)).as_vec2()
    };
    points.iter().map(carried).collect()
}

/// The turn (radians, counter-clockwise) and the scale that the figure has where a handle holds it; what its document
/// gives where that is known.
pub fn handle_motion(view: &FigureView, handle: &Handle) -> (f64, f64) {
    let found = || {
        let sheet = view.sheet.as_ref()?;
        let at = match &handle.hold {
            Hold::Point(at) => at.as_vec2(),
            Hold::Region(name) => sheet.middle_of(name)?,
            Hold::Line { points, .. } => points.first()?.as_vec2(),
        };
        let (triangle, _) = sheet.forward(at)?;
        Some(f64::from(sheet.motion_of(triangle)?.0))
    };
    let turn = handle.motion.turn.or_else(found);
    (turn.unwrap_or(0.0), handle.motion.scale)
}

/// The corners of a line that was drawn by hand that miss none of its places by more than `off`, or if there are more
/// than `most` by twice that, and so on (Douglas-Peucker).
pub(super) fn thinned(line: &[Vec2], off: f32, most: usize) -> Vec<Vec2> {
    let mut off = off;
    loop {
        let mut kept = vec![false; line.len()];
        let mut open = vec![(0, line.len().saturating_sub(1))];
        while let Some((first, last)) = open.pop() {
            (kept[first], kept[last]) = (true, true);
            let (from, to) = (line[first], line[last]);
            let distance = |i: &usize| distance_to_segment(line[*i], [from, to]);
            let inner = first + 1..last;
            let far = inner.max_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(far) = far.filter(|far| distance(far) > off) {
                open.extend([(first, far), (far, last)]);
            }
        }
        let corners: Vec<Vec2> = line
            .iter()
            .zip(&kept)
            .filter_map(|(at, is_kept)| is_kept.then_some(*at))
            .collect();
        if corners.len() <= most {
            return corners;
        }
        off *= 2.0;
    }
}

fn distance_to_segment(at: Vec2, [from, to]: [Vec2; 2]) -> f32 {
    let along = to - from;
    let part = (at - from).dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
    at.distance(from + along * part.clamp(0.0, 1.0))
}
