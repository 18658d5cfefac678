//! The sheet of keys, made of the table that the keys are read from.

use egui::{Ui, vec2};

use super::shortcuts::{Shortcut, shortcuts};
use crate::app::kit::dialog;
use crate::app::kit::theme::{self, Palette};
use crate::app::session::Command;
use crate::app::words::keys::w;
use crate::app::words::slices;
use crate::app::words::{authoring, clay};

/// What the mouse and fingers do in the picture.
fn gestures() -> [(&'static str, &'static str); 15] {
    let (w, c) = (w(), clay::w());
    [
        (w.drag, w.turn_object),
        (w.pan, w.pan_does),
        (w.wheel, w.wheel_does),
        (slices::w().level_drag, slices::w().level_does),
        (w.double_click, w.double_click_does),
        (w.right_click, w.right_click_does),
        (w.handle, authoring::w().step_handles),
        (w.alt_handle, authoring::w().both_sides),
        (w.shift_handle, authoring::w().alone),
        (w.alt_drag, w.alt_drag_does),
        (w.ball, w.ball_does),
        (c.key_size, c.key_size_does),
        (c.key_turn, c.key_turn_does),
        (c.key_over, c.key_over_does),
        (c.key_act, c.act),
    ]
}

/// The sheet of keys over everything.
pub(crate) fn ui(ui: &Ui, commands: &mut Vec<Command>) {
    let is_wide = ui.ctx().content_rect().width() > 840.0;
    let widest = if is_wide { 760.0 } else { 340.0 };
    let names = (w().heading, w().close);
    let is_closed = dialog::is_closed(ui, "keys", names, widest, |ui| {
        let mut rows: Vec<(String, &str)> = gestures()
            .into_iter()
            .map(|(what, does)| (what.to_owned(), does))
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
    if is_closed {
        commands.push(Command::ToggleKeys);
    }
}

/// Keys as people write them.
fn keys_name(ui: &Ui, shortcut: &Shortcut) -> String {
    match shortcut.command {
        Command::Orbit(..) => w().arrows.to_owned(),
        _ => ui
            .ctx()
            .format_shortcut(&shortcut.keys)
            .replace("OpenBracket", "[")
            .replace("CloseBracket", "]")
            .replace("Questionmark", "?")
            .replace("PageUp", w().page_up)
            .replace("PageDown", w().page_down),
    }
}
