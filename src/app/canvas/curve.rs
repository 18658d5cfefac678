//! A template along a curve, in the picture: its line, and its points to be dragged.

use egui::Ui;
use glam::{Vec2 as Flat, Vec3};

use super::points::{Dot, Moved, handle, is_hot};
use super::projection::Projection;
use super::ways::paint_way;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::Command;
use crate::app::words::curve::w;
use crate::app::words::fill;
use crate::document::{Curve, Edit, PlacedTemplate};

/// Points are kept this near to the box, template units.
const FARTHEST: f32 = 9.0;
/// A plane that is seen more edge-on than this (sine) cannot be dragged in.
const EDGE_ON: f32 = 0.35;

fn set(template: &PlacedTemplate, curve: Option<Curve>) -> Edit {
    Edit::SetCurve {
        template: template.index,
        curve,
    }
}

/// The line and the handles of its points. True if one of them is under the pointer or held.
pub(crate) fn ui(
    ui: &mut Ui,
    view: &Projection,
    template: &PlacedTemplate,
    commands: &mut Vec<Command>,
) -> bool {
    let Some(curve) = &template.curve else {
        return false;
    };
    let placement = template.placement;
    let place = |p: Flat| placement.subject_from_template(Vec3::new(p.x, 0.5, p.y));
    if let Some(bent) = template.bent() {
        let line: Option<Vec<_>> = bent
            .beside(0.0)
            .into_iter()
            .map(|p| view.ui_from_subject(place(p)))
            .collect();
        let painter = ui.painter_at(view.rect);
        paint_way(&painter, line.unwrap_or_default());
    }
    // In the plane that is bent; where that is seen edge-on, out of the surface and into it.
    let [normal, out] = [Vec3::Y, Vec3::Z].map(|axis| placement.rotate * axis);
    let is_edge_on = normal.dot(view.back()).abs() < EDGE_ON;
    let plane = if is_edge_on { view.back() } else { normal };
    let mut is_over = false;
    for (i, point) in curve.points.iter().enumerate() {
        let pos = place(*point);
        let Some(spot) = view.ui_from_subject(pos) else {
            continue;
        };
        let name = fill(w().point, &[&(i + 1)]);
        let (response, moved) =
            handle(ui, view, spot, (pos, plane), &Dot::full(&name, ink::HANDLE));
        is_over |= is_hot(&response);
        let mut new = curve.clone();
        match moved {
            Some(Moved::To(to)) => {
                let to = if is_edge_on {
                    pos + out * (to - pos).dot(out)
                } else {
                    to
                };
                let q = placement.template_from_subject(to);
                let limit = Flat::splat(FARTHEST);
                new.points[i] = Flat::new(q.x, q.z).clamp(-limit, limit);
                // A line that cannot be laid along is not taken: the last one stays.
                if new.bent(placement.size).is_ok() {
                    commands.push(Command::Drag(set(template, Some(new))));
                }
            }
            Some(Moved::Removed) => {
                new.points.remove(i);
                let rest = (new.points.len() > 1).then_some(new);
                commands.push(Command::Apply(set(template, rest)));
            }
            None => {}
        }
    }
    is_over
}
