//! The outline of a tool that shapes a clay, where it stands, with its mirror images.

use egui::{Color32, Painter, Pos2, Shape, Stroke};
use glam::Vec3;

use super::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::HeldTool;
use crate::data::Grids;
use crate::displace::images_of;
use crate::document::ToolShape;
use crate::math::Similarity;

/// The lines of a tool that stands so, subject space. `grids`: those of meshes that are there.
pub(super) fn placed_outline(grids: &Grids, shape: &ToolShape, pose: Similarity) -> Vec<Vec<Vec3>> {
    let (turn, place) = (pose.turn.as_quat(), pose.place.as_vec3());
    let placed = |p: &Vec3| place + pose.scale as f32 * (turn * *p);
    let lines = grids.outline(shape);
    let lines = lines.iter().map(|line| line.iter().map(placed).collect());
    lines.collect()
}

/// Draws the lines of a tool, and those of its mirror images.
pub(super) fn paint_outline(
    painter: &Painter,
    view: &Projection,
    outline: &[Vec<Vec3>],
    mirror: [bool; 3],
    color: Color32,
) {
    for image in images(mirror) {
        for line in outline.iter().filter_map(|line| seen(view, line, image)) {
            let halo = Stroke::new(2.8, ink::HALO_DARK.gamma_multiply(0.4));
            painter.add(Shape::line(line.clone(), halo));
            painter.add(Shape::line(line, Stroke::new(1.2, color)));
        }
    }
}

/// Where the image of a line is seen; `None` where a part of it lies behind the eye.
pub(super) fn seen(view: &Projection, line: &[Vec3], image: Vec3) -> Option<Vec<Pos2>> {
    let spots = line.iter().map(|p| view.ui_from_subject(image * *p));
    spots.collect()
}

/// Sides of the box around the tool in a hand, subject units.
pub(super) fn sides_of_tool(grids: &Grids, hand: &HeldTool) -> Vec3 {
    let lines = grids.outline(&hand.shape()).into_iter().flatten();
    2.0 * lines.fold(Vec3::ZERO, |far, p| far.max(p.abs()))
}

/// Signs of the axes of a tool and of its mirror images.
pub(super) fn images(mirror: [bool; 3]) -> impl Iterator<Item = Vec3> {
    images_of(mirror).into_iter().map(|signs| signs.as_vec3())
}
