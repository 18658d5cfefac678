//! The sheet of keys, made of the table that the keys are read from.

use egui::{Modal, Ui, vec2};

use super::command::{Command, Shortcut, shortcuts};
use super::control;
use super::icon::Icon;
use super::theme::{self, Palette};

/// What the mouse and fingers do in the picture.
const GESTURES: [(&str, &str); 6] = [
    ("Drag", "Turn the object"),
    ("Right drag, two fingers", "Move the picture"),
    ("Wheel, pinch", "Closer, further away"),
    ("Double click", "Turn about the point"),
    ("Ctrl + handle", "Steps of 15°, both sides"),
    ("Alt drag", "Roll"),
];

/// The sheet over everything. Returns true if it is to be closed.
pub(crate) fn ui(ui: &Ui, commands: &mut Vec<Command>) {
    let content = ui.ctx().content_rect().size();
    let frame = egui::Frame::window(ui.style());
    let modal = Modal::new(egui::Id::unique("keys"))
        .frame(frame)
        .show(ui.ctx(), |ui| {
            let is_wide = content.x > 840.0;
            ui.set_width((content.x - 64.0).min(if is_wide { 760.0 } else { 340.0 }));
            control::heading(ui, "Keys and gestures", |ui| {
                if control::icon_button(ui, Icon::Close, "Close the sheet", true).clicked() {
                    commands.push(Command::ToggleKeys);
                }
            });
            control::divider(ui);
            let height = content.y - 150.0;
            egui::ScrollArea::vertical()
                .max_height(height)
                .min_scrolled_height(height)
                .show(ui, |ui| {
                    let mut rows: Vec<(String, &str)> = GESTURES
                        .iter()
                        .map(|(what, does)| ((*what).to_owned(), *does))
                        .collect();
                    let listed = shortcuts();
                    rows.extend(
                        listed
                            .iter()
                            .filter(|s| !s.text.is_empty())
                            .map(|s| (keys_name(ui, s), s.text)),
                    );
                    let half = if is_wide {
                        rows.len().div_ceil(2)
                    } else {
                        rows.len()
                    };
                    ui.horizontal_top(|ui| {
                        for (i, column) in rows.chunks(half).enumerate() {
                            let grid = egui::Grid::new(("keys", i))
                                .num_columns(2)
                                .spacing(vec2(14.0, 2.0))
                                .min_row_height(24.0);
                            grid.show(ui, |ui| {
                                for (keys, does) in column {
                                    let weak = Palette::get(ui).weak;
                                    ui.label(theme::strong(keys.clone()).size(12.0));
                                    ui.label(egui::RichText::new(*does).size(12.5).color(weak));
                                    ui.end_row();
                                }
                            });
                            ui.add_space(20.0);
                        }
                    });
                });
        });
    if modal.should_close() {
        commands.push(Command::ToggleKeys);
    }
}

/// Keys as people write them.
fn keys_name(ui: &Ui, shortcut: &Shortcut) -> String {
    match shortcut.text {
        "Turn the object" => "Arrows".to_owned(),
        _ => ui
            .ctx()
            .format_shortcut(&shortcut.keys)
            .replace("OpenBracket", "[")
            .replace("CloseBracket", "]")
            .replace("Questionmark", "?")
            .replace("PageUp", "Page up")
            .replace("PageDown", "Page down"),
    }
}
