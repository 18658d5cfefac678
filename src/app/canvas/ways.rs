//! The tools of a selected `sweep` over the picture: the way of each, its keys to be dragged, and its outline where it
//! has come to.

use egui::{Painter, Pos2, Shape, Stroke, Ui};
use glam::Vec3;

use super::points::{Dot, Moved, handle, is_hot};
use super::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::Command;
use crate::app::words::fill;
use crate::app::words::sweep::w;
use crate::data::Grids;
use crate::displace::{FARTHEST, ToolWay, WAY_PARTS};
use crate::document::{Edit, MAX_KEYS, PathKey, PlacedTemplate, SweepTools, TemplateData};
use crate::placed;

/// Points around a way within which a double click adds a key.
const REACH: f32 = 10.0;

fn set(template: &PlacedTemplate, tools: SweepTools) -> Edit {
    Edit::SetTools {
        template: template.index,
        tools,
    }
}

/// The lines, and the handles of the keys; `grids` are those of meshes that are there. True if one of them is under the
/// pointer or held. A double click on a way adds a key there.
pub(crate) fn ui(
    ui: &mut Ui,
    view: &Projection,
    (template, grids): (&PlacedTemplate, &Grids),
    double_click: Option<Pos2>,
    commands: &mut Vec<Command>,
) -> bool {
    let TemplateData::Tools(held) = &template.data else {
        return false;
    };
    let to_ui = |q: Vec3| view.ui_from_subject(template.subject_from_template(q));
    let ways = placed::tool_ways(template, grids);
    for way in ways.iter().flatten() {
        lines_ui(ui, view, way, &to_ui);
    }
    let mut is_over = false;
    for (t, tool) in held.tools.iter().enumerate() {
        for (k, key) in tool.path.iter().enumerate() {
            let Some(spot) = to_ui(key.at) else { continue };
            let name = fill(w().key_of, &[&(k + 1), &(t + 1)]);
            let plane = (template.subject_from_template(key.at), view.back());
            let dot = Dot::full(&name, ink::HANDLE);
            let (response, moved) = handle(ui, view, spot, plane, &dot);
            is_over |= is_hot(&response);
            match moved {
                Some(Moved::To(pos)) => {
                    let limit = Vec3::splat(FARTHEST);
                    let at = template.template_from_subject(pos).clamp(-limit, limit);
                    let mut new = held.clone();
                    new.tools[t].path[k].at = at;
                    commands.push(Command::Drag(set(template, new)));
                }
                // The last key stays: a path has one at least.
                Some(Moved::Removed) if tool.path.len() > 1 => {
                    let mut new = held.clone();
                    new.tools[t].path.remove(k);
                    commands.push(Command::Apply(set(template, new)));
                }
                Some(Moved::Removed) | None => {}
            }
        }
    }
    if !is_over
        && let Some(pos) = double_click
        && let Some((t, k, key)) = key_at(&ways, pos, &to_ui)
        && held.tools[t].path.len() < MAX_KEYS
    {
        let mut new = held.clone();
        new.tools[t].path.insert(k, key);
        commands.push(Command::Apply(set(template, new)));
    }
    is_over
}

/// True if a place in the picture is on the way of a tool.
pub(crate) fn is_near(view: &Projection, template: &PlacedTemplate, pos: Pos2) -> bool {
    let to_ui = |q: Vec3| view.ui_from_subject(template.subject_from_template(q));
    let ways = placed::tool_ways(template, &Grids::default());
    let mut spots = ways.iter().flatten().flat_map(|way| &way.poses);
    spots.any(|pose| to_ui(pose.at).is_some_and(|spot| spot.distance(pos) < REACH))
}

/// The way of a tool and its outline.
fn lines_ui(ui: &Ui, view: &Projection, way: &ToolWay, to_ui: &dyn Fn(Vec3) -> Option<Pos2>) {
    let painter = ui.painter_at(view.rect);
    let drawn = |line: &[Vec3]| -> Option<Vec<Pos2>> { line.iter().map(|q| to_ui(*q)).collect() };
    for line in way.outline.iter().filter_map(|line| drawn(line)) {
        painter.add(Shape::line(
            line.clone(),
            Stroke::new(2.4, ink::HALO_DARK.gamma_multiply(0.35)),
        ));
        painter.add(Shape::line(line, Stroke::new(1.0, ink::HALO_LIGHT)));
    }
    let places: Vec<Vec3> = way.poses.iter().map(|pose| pose.at).collect();
    if let Some(line) = drawn(&places) {
        paint_way(&painter, line);
    }
}

/// A way that a hand can change, over the picture.
pub(crate) fn paint_way(painter: &Painter, line: Vec<Pos2>) {
    for (width, color) in [(4.0, ink::HALO_DARK), (2.0, ink::HANDLE)] {
        painter.add(Shape::line(line.clone(), Stroke::new(width, color)));
    }
}

/// The key that a double click at a place adds: its tool, its place in the path, and the pose that the tool has there.
fn key_at(
    ways: &[Option<ToolWay>],
    pos: Pos2,
    to_ui: &dyn Fn(Vec3) -> Option<Pos2>,
) -> Option<(usize, usize, PathKey)> {
    let mut nearest = (REACH, None);
    for (t, way) in ways.iter().enumerate() {
        for (i, pose) in way.iter().flat_map(|way| way.poses.iter().enumerate()) {
            // Where there is a key none is added.
            if i % WAY_PARTS == 0 {
                continue;
            }
            let away = to_ui(pose.at).map_or(f32::INFINITY, |spot| spot.distance(pos));
            if away < nearest.0 {
                nearest = (away, Some((t, i / WAY_PARTS + 1, *pose)));
            }
        }
    }
    nearest.1
}
