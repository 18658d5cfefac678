//! One row of a menu: an icon and a text.

use egui::{CornerRadius, Ui};

use super::icon::Icon;
use super::theme::{self, Palette};
use super::widget;

/// A row of a menu with an icon. True if it was taken.
pub(crate) fn menu_item(ui: &mut Ui, icon: Icon, text: &str) -> bool {
    let palette = Palette::get(ui);
    let size = egui::vec2(ui.available_width(), theme::control_height().max(30.0));
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), text));
    if response.hovered() {
        ui.painter()
            .rect_filled(rect, CornerRadius::same(5), palette.hover);
    }
    widget::focus_ring(ui, &response, rect);
    let icon_rect = egui::Rect::from_center_size(
        rect.left_center() + egui::vec2(16.0, 0.0),
        egui::Vec2::splat(18.0),
    );
    icon.paint(ui.painter(), widget::sided(rect, icon_rect), palette.weak);
    let font = egui::TextStyle::Body.resolve(ui.style());
    widget::line_text(ui.painter(), rect, 34.0, text, font, palette.text);
    response.clicked()
}
