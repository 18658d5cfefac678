//! The sheet of keys, made of the table that the keys are read from.

use egui::{Modal, Ui, vec2};

use super::command::{Command, shortcuts};
use super::control;
use super::icon::Icon;
use super::theme::{self, Palette};

/// What the mouse and fingers do in the picture.
const GESTURES: [(&str, &str); 6] = [
    ("Drag", "Turn the object"),
    ("Right or Shift drag, two fingers", "Move the picture"),
    ("Wheel, pinch", "Closer, further away"),
    ("Double click", "Turn about the point"),
    ("Ctrl while turning or sizing", "Steps of 15°, both sides"),
    ("Alt drag", "Roll"),
];

/// The sheet over everything. Returns true if it is to be closed.
pub(crate) fn ui(ui: &Ui, commands: &mut Vec<Command>) {
    let content = ui.ctx().content_rect().size();
    let modal = Modal::new(egui::Id::unique("keys")).show(ui.ctx(), |ui| {
        let is_wide = content.x > 720.0;
        ui.set_width((content.x - 64.0).min(if is_wide { 640.0 } else { 340.0 }));
        control::heading(ui, "Keys and gestures", |ui| {
            if control::icon_button(ui, Icon::Close, "Close the sheet", true).clicked() {
                commands.push(Command::ToggleKeys);
            }
        });
        control::divider(ui);
        egui::ScrollArea::vertical()
            .max_height(content.y - 160.0)
            .show(ui, |ui| {
                let mut rows: Vec<(String, &str)> = GESTURES
                    .iter()
                    .map(|(what, does)| ((*what).to_owned(), *does))
                    .collect();
                rows.extend(shortcuts().iter().filter(|s| !s.text.is_empty()).map(|s| {
                    let keys = match s.text {
                        "Turn the object" => "Arrows".to_owned(),
                        _ => ui.ctx().format_shortcut(&s.keys),
                    };
                    (keys, s.text)
                }));
                let half = if is_wide {
                    rows.len().div_ceil(2)
                } else {
                    rows.len()
                };
                ui.horizontal_top(|ui| {
                    for (i, column) in rows.chunks(half).enumerate() {
                        egui::Grid::new(("keys", i))
                            .num_columns(2)
                            .spacing(vec2(14.0, 6.0))
                            .show(ui, |ui| {
                                for (keys, does) in column {
                                    let weak = Palette::get(ui).weak;
                                    ui.label(theme::strong(keys.clone()).size(12.5));
                                    ui.label(egui::RichText::new(*does).color(weak));
                                    ui.end_row();
                                }
                            });
                        ui.add_space(24.0);
                    }
                });
            });
    });
    if modal.should_close() {
        commands.push(Command::ToggleKeys);
    }
}
