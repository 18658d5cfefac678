//! A line at the head of the picture while that is not yet what the document describes.

use egui::{CornerRadius, FontId, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};

use crate::app::kit::theme::Palette;

/// The line; `top` is where the part of the picture begins that nothing else takes, points. Clicks go through to the
/// picture.
pub(crate) fn ui(ui: &Ui, picture: Rect, top: f32, text: &str) {
    let palette = Palette::get(ui);
    let font = FontId::proportional(12.0);
    let width = (picture.width() - 48.0).max(80.0);
    let galley = ui
        .painter()
        .layout(text.to_owned(), font, palette.text, width);
    let size = galley.size() + vec2(20.0, 10.0);
    let card = Rect::from_center_size(picture.center_top(), size);
    let card = card.translate(vec2(0.0, top - card.top()));
    let painter = ui.painter_at(picture);
    let stroke = Stroke::new(1.0, palette.line);
    let corners = CornerRadius::same(8);
    painter.rect(card, corners, palette.float, stroke, StrokeKind::Inside);
    painter.galley(card.min + vec2(10.0, 5.0), galley, palette.text);
    let id = ui.scope_id().with("provisional");
    let response = ui.interact(card, id, Sense::empty());
    response.widget_info(|| WidgetInfo::labeled(Role::Status, true, text));
}
