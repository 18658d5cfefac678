//! The frame behind controls that float over the picture.

use egui::{Color32, CornerRadius, Rect, Sense, Stroke, Ui};

use super::theme::Palette;

/// Behind controls that float over the picture; takes the clicks that miss them.
pub(crate) fn float_frame(ui: &Ui, rect: Rect) {
    let palette = Palette::get(ui);
    ui.interact(
        rect,
        ui.scope_id()
            .with(("float", rect.min.x as i32, rect.min.y as i32)),
        // Keeps clicks from the picture below; no place for the keyboard to stop.
        Sense::CLICK | Sense::DRAG,
    );
    let shadow = egui::Shadow {
        offset: [0, 2],
        blur: 8,
        spread: 0,
        color: Color32::from_black_alpha(40),
    };
    ui.painter()
        .add(shadow.as_shape(rect, CornerRadius::same(8)));
    ui.painter().rect(
        rect,
        CornerRadius::same(8),
        palette.float,
        Stroke::new(1.0, palette.line),
        egui::StrokeKind::Inside,
    );
}
