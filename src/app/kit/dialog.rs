//! A dialog over everything: a heading, a button that closes it, and content that scrolls where the window is low.

use egui::{Modal, Ui};

use super::icon::Icon;
use super::widget;

/// Shows a dialog. `id` tells it from others, `close` names its button, `widest` is its width where the window has
/// room, points. True if it is to be closed: by the button, by Escape or by a click beside it.
pub(crate) fn is_closed(
    ui: &Ui,
    id: &'static str,
    (heading, close): (&str, &str),
    widest: f32,
    content: impl FnOnce(&mut Ui),
) -> bool {
    let window = ui.ctx().content_rect().size();
    let frame = egui::Frame::window(ui.style());
    let mut is_closed = false;
    let modal = Modal::new(egui::Id::unique(id))
        .frame(frame)
        .show(ui.ctx(), |ui| {
            ui.set_width((window.x - 64.0).min(widest));
            widget::heading(ui, heading, |ui| {
                is_closed = widget::icon_button(ui, Icon::Close, close, true).clicked();
            });
            widget::divider(ui);
            let height = window.y - 150.0;
            egui::ScrollArea::vertical()
                .auto_shrink([false, true])
                .max_height(height)
                .min_scrolled_height(height)
                .show(ui, content);
        });
    is_closed || modal.should_close()
}
