//! The rows of the selected template for its control points.

use egui::Ui;
use glam::{Vec2, Vec3};

use crate::app::kit::icon::Icon;
use crate::app::kit::{theme, widget};
use crate::app::session::Command;
use crate::app::words::fill;
use crate::app::words::points::w;
use crate::document::{
    ControlPoint, ControlPoints, Edit, MAX_CUT, MAX_POINTS, PlacedTemplate, TemplateData,
};

/// How many points, one more, and the cut.
pub(crate) fn ui(ui: &mut Ui, template: &PlacedTemplate, commands: &mut Vec<Command>) {
    let TemplateData::Points(points) = &template.data else {
        return;
    };
    let set = |points: ControlPoints| {
        Command::Apply(Edit::SetControlPoints {
            template: template.index,
            points,
        })
    };
    widget::row(ui, |ui| {
        let text = fill(w().count, &[&points.points.len()]);
        widget::row_label(ui, &text, w().how);
        if widget::icon_button(ui, Icon::Plus, w().add, points.points.len() < MAX_POINTS).clicked()
        {
            let mut new = points.clone();
            // Beside the point added last, so that the new one can be grabbed.
            let turn = new.points.len() as f32 * 2.4;
            let at = Vec3::new(0.5 + 0.2 * turn.cos(), 0.5 + 0.2 * turn.sin(), 0.5);
            new.points.push(ControlPoint {
                at,
                shift: Vec3::ZERO,
            });
            commands.push(set(new));
        }
    });
    widget::row(ui, |ui| {
        widget::row_label(ui, w().cut, w().cut_how);
        if widget::icon_button(ui, Icon::Plus, w().cut_add, points.cut.len() < MAX_CUT).clicked() {
            let mut new = points.clone();
            match new.cut.as_slice() {
                [.., before, last] => {
                    let next = *last + (*last - *before) * 0.5;
                    new.cut.push(next);
                }
                _ => new.cut = vec![Vec2::new(0.5, 0.2), Vec2::new(0.5, 0.8)],
            }
            commands.push(set(new));
        }
        if widget::icon_button(ui, Icon::Close, w().cut_remove, !points.cut.is_empty()).clicked() {
            let mut new = points.clone();
            new.cut.clear();
            commands.push(set(new));
        }
    });
    let weak = theme::Palette::get(ui).weak;
    ui.label(egui::RichText::new(w().how).size(11.5).color(weak));
}
