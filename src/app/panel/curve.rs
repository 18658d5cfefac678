//! The rows of the selected template for the curve it lies along.

use egui::Ui;

use crate::app::kit::icon::Icon;
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::Command;
use crate::app::words::curve::w;
use crate::document::{Curve, Edit, PlacedTemplate};

/// Along the surface, straight, round.
pub(crate) fn ui(ui: &mut Ui, template: &PlacedTemplate, commands: &mut Vec<Command>) {
    let set = |curve: Option<Curve>| {
        Command::Apply(Edit::SetCurve {
            template: template.index,
            curve,
        })
    };
    widget::row(ui, |ui| {
        widget::row_label(ui, w().curve, w().hint);
        let follow = ui.button(w().follow).on_hover_text(w().follow_hint);
        if follow.clicked() {
            commands.push(Command::FollowSurface);
        }
        let is_curved = template.curve.is_some();
        if widget::icon_button(ui, Icon::Close, w().straight, is_curved).clicked() {
            commands.push(set(None));
        }
    });
    if let Some(curve) = &template.curve {
        widget::row(ui, |ui| {
            widget::row_label(ui, w().round, w().round_hint);
            let mut is_spline = curve.is_spline;
            let response = ui.checkbox(&mut is_spline, "").named(w().round);
            if response.on_hover_text(w().round_hint).changed() {
                let curve = Curve {
                    is_spline,
                    ..curve.clone()
                };
                commands.push(set(Some(curve)));
            }
        });
    }
}
