//! The plane of a figure in the window.

use egui::Pos2;
use glam::{Vec2, Vec3};

use crate::app::canvas::projection::Projection;

/// Where a place of the figure's plane is seen.
pub(super) fn seen(view: &Projection, at: Vec2) -> Option<Pos2> {
    view.ui_from_subject(at.extend(0.0))
}

/// The place of the figure's plane under a place of the window.
pub(super) fn place(view: &Projection, pos: Pos2) -> Option<Vec2> {
    let place = view.on_plane(pos, Vec3::ZERO, Vec3::Z)?;
    Some(place.truncate())
}
