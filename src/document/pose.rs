//! The way between two poses of a figure.
//!
//! What changes the matrices of the solve is that of the end from the start of the passage on, so that they are
//! factored once: `rigidity`, `fixed`, `only`, what a handle holds and how far around, `enabled`, points and strength
//! of the context. So is a turn that was open or becomes so, and whatever is no number.

use super::model::figure::{Context, Contour, Figure, Handle, Hold, Region};
use glam::DVec2;

/// The figure between two others. A missing one is a figure as it is.
pub(super) fn blend_figure(
    start: Option<&Figure>,
    end: Option<&Figure>,
    part: f32,
) -> Option<Figure> {
    if part >= 1.0 || start == end {
        return end.cloned();
    }
    let (nothing, part) = (Figure::default(), f64::from(part));
    let start = start.unwrap_or(&nothing);
    let mut out = end.cloned().unwrap_or_default();
    out.reach = mix(start.reach, out.reach, part);
    for (before, region) in start.regions.iter().zip(&mut out.regions) {
        blend_region(before, region, part);
    }
    for (before, handle) in start.handles.iter().zip(&mut out.handles) {
        blend_handle(before, handle, part);
    }
    if let (Some(before), Some(context)) = (&start.context, &mut out.context) {
        blend_context(before, context, part);
    }
    for (before, contour) in start.contours.iter().zip(&mut out.contours) {
        blend_contour(before, contour, part);
    }
    Some(out).filter(|figure| *figure != nothing)
}

fn blend_region(start: &Region, out: &mut Region, part: f64) {
    if start.name == out.name {
        out.order = mix(start.order, out.order, part);
    }
}

/// A handle that held something of another kind is itself at once.
fn blend_handle(start: &Handle, out: &mut Handle, part: f64) {
    match (&start.hold, &mut out.hold) {
        (Hold::Point(_), Hold::Point(_)) | (Hold::Region(_), Hold::Region(_)) => {}
        (Hold::Line { to: a, .. }, Hold::Line { to: b, .. }) => {
            if let (Some(a), Some(b)) = (a, b) {
                blend_points(a, b, part);
            }
        }
        _ => return,
    }
    let motion = &mut out.motion;
    motion.by = start.motion.by.lerp(motion.by, part);
    motion.scale = mix(start.motion.scale, motion.scale, part);
    if let (Some(a), Some(b)) = (start.motion.turn, motion.turn) {
        motion.turn = Some(mix(a, b, part));
    }
}

fn blend_context(start: &Context, out: &mut Context, part: f64) {
    out.amount = mix(start.amount, out.amount, part);
    if let (Some(a), Some(b)) = (&start.like, &mut out.like) {
        blend_points(a, b, part);
    }
}

fn blend_contour(start: &Contour, out: &mut Contour, part: f64) {
    if start.region != out.region {
        return;
    }
    out.amount = mix(start.amount, out.amount, part);
    blend_points(&start.like, &mut out.like, part);
    blend_points(&start.keep, &mut out.keep, part);
}

/// Lists of one length; others switch.
fn blend_points(start: &[DVec2], out: &mut [DVec2], part: f64) {
    if start.len() == out.len() {
        for (a, b) in start.iter().zip(out) {
            *b = a.lerp(*b, part);
        }
    }
}

fn mix(a: f64, b: f64, part: f64) -> f64 {
    a + (b - a) * part
}
