//! Control points of an `rbf` over the picture and in the panel: dragged, added, removed; the cut that parts them;
//! lines that bend along.
//!
//! A point is a ring where the tissue was and a dot where it goes. Dragging the dot takes the tissue along, the ring
//! stays. The dot of a point that the map misses is hollow: light inside.

use egui::{Key, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo};
use glam::{Vec2 as Flat, Vec3};

use crate::app::canvas::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::Command;
use crate::app::words::fill;
use crate::app::words::points::w;
use crate::document::{
    ControlPoint, ControlPoints, Edit, MAX_POINTS, PlacedTemplate, TemplateData,
};
use crate::placed;

/// Points around a dot within which it is taken.
const REACH: f32 = 11.0;
/// Points of a step by the arrow keys.
const KEY_STEP: f32 = 4.0;
/// How far from the middle control points are kept, template units.
const FARTHEST: f32 = 4.0;

fn points_of(template: &PlacedTemplate) -> Option<&ControlPoints> {
    match &template.data {
        TemplateData::Points(points) => Some(points),
        _ => None,
    }
}

fn set(template: &PlacedTemplate, points: ControlPoints) -> Edit {
    Edit::SetControlPoints {
        template: template.index,
        points,
    }
}

fn within(q: Vec3) -> Vec3 {
    q.clamp(Vec3::splat(0.5 - FARTHEST), Vec3::splat(0.5 + FARTHEST))
}

/// The handles of a selected `rbf`. True if one of them is under the pointer or held.
pub(crate) fn ui(
    ui: &mut Ui,
    view: &Projection,
    template: &PlacedTemplate,
    double_click: Option<egui::Pos2>,
    commands: &mut Vec<Command>,
) -> bool {
    let Some(points) = points_of(template) else {
        return false;
    };
    let placement = template.placement;
    let to_ui = |q: Vec3| view.ui_from_subject(template.subject_from_template(q));
    let painter = ui.painter_at(view.rect);
    for line in placed::bent_lattice(template) {
        let line: Option<Vec<_>> = line
            .into_iter()
            .map(|pos| view.ui_from_subject(pos))
            .collect();
        if let Some(line) = line {
            painter.add(Shape::line(
                line.clone(),
                Stroke::new(2.4, ink::HALO_DARK.gamma_multiply(0.35)),
            ));
            painter.add(Shape::line(line, Stroke::new(1.0, ink::HALO_LIGHT)));
        }
    }
    let cut: Vec<_> = points
        .cut
        .iter()
        .filter_map(|p| to_ui(p.extend(0.5)))
        .collect();
    painter.add(Shape::line(cut.clone(), Stroke::new(4.0, ink::HALO_DARK)));
    painter.add(Shape::line(cut, Stroke::new(2.0, ink::HANDLE)));
    let mut is_over = false;
    let mut changed: Option<ControlPoints> = None;
    for (i, place) in points.cut.iter().enumerate() {
        let q = place.extend(0.5);
        let name = fill(w().cut_place, &[&(i + 1)]);
        let Some(spot) = to_ui(q) else { continue };
        let (response, moved) = handle(
            ui,
            view,
            spot,
            (template.subject_from_template(q), view.back()),
            &Dot::full(&name, ink::HANDLE),
        );
        is_over |= is_hot(&response);
        if let Some(Moved::To(pos)) = moved {
            let to = within(template.template_from_subject(pos));
            let mut new = points.clone();
            new.cut[i] = Flat::new(to.x, to.y);
            changed = Some(new);
        } else if let Some(Moved::Removed) = moved {
            let mut new = points.clone();
            new.cut.remove(i);
            changed = Some(new);
        }
    }
    let missed = placed::missed_points(template);
    for (i, point) in points.points.iter().enumerate() {
        let source = point.at + point.shift;
        let (Some(to), Some(from)) = (to_ui(point.at), to_ui(source)) else {
            continue;
        };
        if point.shift != Vec3::ZERO {
            painter.line_segment([from, to], Stroke::new(3.6, ink::HALO_DARK));
            painter.line_segment([from, to], Stroke::new(1.6, ink::HALO_LIGHT));
            painter.circle_stroke(from, 4.5, Stroke::new(3.4, ink::HALO_DARK));
            painter.circle_stroke(from, 4.5, Stroke::new(1.6, ink::HALO_LIGHT));
        }
        let name = fill(w().point, &[&(i + 1)]);
        let lack = missed.iter().find(|missed| missed.point == i);
        let told = lack.map(|lack| fill(w().missed, &[&(i + 1), &format!("{:.3}", lack.by)]));
        let dot = match &told {
            Some(told) => Dot::hollow(&name, told, ink::X),
            None => Dot::full(&name, ink::X),
        };
        let plane = (template.subject_from_template(point.at), view.back());
        let (response, moved) = handle(ui, view, to, plane, &dot);
        is_over |= is_hot(&response);
        let mut new = points.clone();
        match moved {
            Some(Moved::To(pos)) => {
                let at = within(template.template_from_subject(pos));
                new.points[i] = ControlPoint {
                    at,
                    shift: source - at,
                };
                changed = Some(new);
            }
            Some(Moved::Removed) => {
                new.points.remove(i);
                changed = Some(new);
            }
            None => {}
        }
    }
    if !is_over
        && let Some(pos) = double_click
        && points.points.len() < MAX_POINTS
        && let Some(pos) = view.on_plane(pos, placement.at, view.back())
    {
        let mut new = points.clone();
        new.points.push(ControlPoint {
            at: within(template.template_from_subject(pos)),
            shift: Vec3::ZERO,
        });
        commands.push(Command::Apply(set(template, new)));
    }
    if let Some(new) = changed {
        commands.push(Command::Drag(set(template, new)));
    }
    is_over
}

pub(crate) enum Moved {
    /// Where the point goes, subject space.
    To(Vec3),
    Removed,
}

/// How a dot looks and what it is called.
pub(crate) struct Dot<'a> {
    /// Its own among the dots of a template.
    name: &'a str,
    /// What is said of it where it is pointed at or read aloud.
    told: &'a str,
    color: egui::Color32,
    is_hollow: bool,
}

impl<'a> Dot<'a> {
    /// A full dot that is told by its name.
    pub(crate) fn full(name: &'a str, color: egui::Color32) -> Self {
        Self {
            name,
            told: name,
            color,
            is_hollow: false,
        }
    }

    /// A hollow dot of which more is told than its name.
    pub(crate) fn hollow(name: &'a str, told: &'a str, color: egui::Color32) -> Self {
        Self {
            told,
            is_hollow: true,
            ..Self::full(name, color)
        }
    }
}

/// One dot: dragged in a plane (a point of it and its normal), moved by the arrow keys, taken away by Delete.
pub(crate) fn handle(
    ui: &Ui,
    view: &Projection,
    spot: egui::Pos2,
    (pos, normal): (Vec3, Vec3),
    dot: &Dot<'_>,
) -> (Response, Option<Moved>) {
    let id = ui.scope_id().with(("rbf", dot.name));
    let response = ui.interact(
        Rect::from_center_size(spot, Vec2::splat(2.0 * REACH)),
        id,
        Sense::click_and_drag(),
    );
    response.widget_info(|| WidgetInfo::labeled(Role::GraphicsObject, true, dot.told));
    if dot.is_hollow {
        response.clone().on_hover_text(dot.told);
    }
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let painter = ui.painter_at(view.rect);
    let color = if is_hot(&response) || response.has_focus() {
        ink::HOT
    } else {
        dot.color
    };
    if dot.is_hollow {
        // Light inside, and not clear: the dot of the point that is met may lie right under it.
        painter.circle_filled(spot, 7.0, ink::HALO_LIGHT.to_opaque());
        painter.circle_stroke(spot, 5.0, Stroke::new(2.6, color));
    } else {
        painter.circle(spot, 6.0, color, Stroke::new(2.0, ink::HALO_LIGHT));
    }
    painter.circle_stroke(spot, 7.2, Stroke::new(1.0, ink::HALO_DARK));
    let mut by = response.drag_delta();
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(egui::Id::unique(FOCUSED), id));
        ui.memory_mut(|memory| {
            let filter = egui::EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..Default::default()
            };
            memory.set_focus_lock_filter(id, filter);
        });
        let pressed = |key| ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, key));
        for (key, step) in [
            (Key::ArrowLeft, Vec2::new(-1.0, 0.0)),
            (Key::ArrowRight, Vec2::new(1.0, 0.0)),
            (Key::ArrowUp, Vec2::new(0.0, -1.0)),
            (Key::ArrowDown, Vec2::new(0.0, 1.0)),
        ] {
            if pressed(key) {
                by += step * KEY_STEP;
            }
        }
        if pressed(Key::Delete) || pressed(Key::Backspace) {
            return (response, Some(Moved::Removed));
        }
    }
    let moved = (by != Vec2::ZERO)
        .then(|| view.on_plane(spot + by, pos, normal))
        .flatten();
    (response, moved.map(Moved::To))
}

/// Under this name is kept which dot had the keyboard last.
const FOCUSED: &str = "dot with the keyboard";

/// True if a dot has the keyboard: Delete is for it then.
pub(crate) fn has_keyboard(ui: &Ui) -> bool {
    let last = ui.data(|data| data.get_temp::<egui::Id>(egui::Id::unique(FOCUSED)));
    last.is_some() && last == ui.memory(|memory| memory.focused())
}

/// True if a dot is under the pointer or held.
pub(crate) fn is_hot(response: &Response) -> bool {
    response.hovered() || response.dragged()
}
