//! The sheet of keys, made of the table that the keys are read from.

use egui::{Modal, Ui, vec2};

use super::shortcuts::{Shortcut, shortcuts};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::session::Command;
use crate::app::words::authoring;
use crate::app::words::keys::w;
use crate::app::words::slices;

/// What the mouse and fingers do in the picture.
fn gestures() -> [(&'static str, &'static str); 11] {
    let w = w();
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
    ]
}

/// The sheet of keys over everything. Returns true if the sheet is to be closed.
pub(crate) fn ui(ui: &Ui, commands: &mut Vec<Command>) {
    let content = ui.ctx().content_rect().size();
    let frame = egui::Frame::window(ui.style());
    let modal = Modal::new(egui::Id::unique("keys"))
        .frame(frame)
        .show(ui.ctx(), |ui| {
            let is_wide = content.x > 840.0;
            ui.set_width((content.x - 64.0).min(if is_wide { 760.0 } else { 340.0 }));
            widget::heading(ui, w().heading, |ui| {
                if widget::icon_button(ui, Icon::Close, w().close, true).clicked() {
                    commands.push(Command::ToggleKeys);
                }
            });
            widget::divider(ui);
            let height = content.y - 150.0;
            egui::ScrollArea::vertical()
                .auto_shrink([false, true])
                .max_height(height)
                .min_scrolled_height(height)
                .show(ui, |ui| {
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
        });
    if modal.should_close() {
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
