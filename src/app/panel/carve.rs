//! The row of a template that carves: the object by which it does.

use egui::Ui;

use crate::app::kit::widget::{self, Named as _};
use crate::app::session::objects::carve_by;
use crate::app::session::{Command, Session};
use crate::app::words::objects::w;
use crate::document::{PlacedTemplate, TemplateData};

/// The name of the object, out of those of the document.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    template: &PlacedTemplate,
    commands: &mut Vec<Command>,
) {
    let TemplateData::Object(held) = &template.data else {
        return;
    };
    widget::row(ui, |ui| {
        widget::row_label(ui, w().carves, w().carves_hint);
        let combo = widget::combo("carved by", &held.name, ui.available_width() - 4.0);
        let shown = combo.show_ui(ui, |ui| {
            for object in &session.illustration().objects {
                let is_chosen = object.name == held.name;
                if ui.selectable_label(is_chosen, &object.name).clicked() {
                    commands.push(Command::Apply(carve_by(template.index, &object.name)));
                }
            }
        });
        shown
            .response
            .named(w().carves)
            .on_hover_text(w().carves_hint);
    });
    if held.found.is_none() {
        let palette = crate::app::kit::theme::Palette::get(ui);
        let text = egui::RichText::new(w().carves_nothing).color(palette.weak);
        ui.add(egui::Label::new(text).wrap());
    }
}
