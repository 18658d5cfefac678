//! The list of regions, from front to back.

use egui::{Label, RichText, Ui};

use super::material;
use crate::app::kit::entry::EntryRow;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::app::session::figure::{FigureCommand, region_edit};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;

pub(super) fn list_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let figure = &session.view.figure;
    let has_region = figure.region.is_some();
    widget::heading(ui, w().regions, |ui| {
        let moves = [(Icon::Down, w().behind, -1), (Icon::Up, w().front, 1)];
        for (icon, name, by) in moves {
            if widget::icon_button(ui, icon, name, has_region).clicked() {
                commands.push(Command::ShiftSelected(by));
            }
        }
    });
    if figure.regions.is_empty() {
        let text = RichText::new(w().no_regions).color(Palette::get(ui).weak);
        ui.add(Label::new(text).wrap());
    }
    let drawn = figure.sheet.as_ref().map(|sheet| &sheet.mesh.regions);
    for (index, region) in figure.regions.iter().enumerate().rev() {
        let is_selected = figure.region.as_ref() == Some(&region.name);
        let is_empty = drawn.is_some_and(|drawn| !drawn.contains(&region.name));
        let note = match (region.hide, is_empty) {
            (true, _) => w().hidden,
            (false, true) => w().nothing_left,
            (false, false) => material::name(region.rigidity),
        };
        let row = EntryRow {
            id: ("region", index),
            name: &region.name,
            title: &region.name,
            note,
            is_selected,
            has_grip: false,
            group: None,
            is_shown: Some(!region.hide),
        };
        let entry = row.ui(ui);
        if entry.is_toggled {
            let edit = region_edit(session, &region.name, "hide", (!region.hide).into());
            commands.push(Command::Apply(edit));
        }
        if entry.response.clicked() {
            let chosen = (!is_selected).then(|| region.name.clone());
            commands.push(Command::Figure(FigureCommand::SelectRegion(chosen)));
        }
    }
}
