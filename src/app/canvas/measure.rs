//! Distances drawn over the picture and the slices, and their list.

use egui::{
    Align2, Color32, Painter, Pos2, Rect, Role, Sense, Stroke, Ui, UiBuilder, Vec2, WidgetInfo,
    vec2,
};
use glam::Vec3;

use crate::app::kit::float::float_frame;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette, over_picture as ink};
use crate::app::kit::widget;
use crate::app::session::{Command, See, Session, Tool, ViewState};
use crate::app::words::{fill, slices::w};

/// The distances that were measured, and the first point of the one under way.
pub(crate) struct Distances<'a> {
    /// Both ends of each, subject space.
    pub lines: &'a [[Vec3; 2]],
    /// The active tool; `Tool::Measure` holds the first point of the distance under way.
    pub tool: Tool,
}

impl<'a> Distances<'a> {
    /// The distances of a session, and its tool.
    pub(crate) fn of(session: &'a Session) -> Self {
        Self {
            lines: session.view.measures.lines(),
            tool: session.tool(),
        }
    }

    /// Draws the distances. `ui_from_subject` gives `None` where a point is not seen; `nearness` 0 to 1 fades.
    pub(crate) fn paint(
        &self,
        painter: &Painter,
        mm_per_unit: f32,
        ui_from_subject: impl Fn(Vec3) -> Option<Pos2>,
        nearness: impl Fn(Vec3) -> f32,
    ) {
        for (i, [a, b]) in self.lines.iter().enumerate() {
            let (Some(from), Some(to)) = (ui_from_subject(*a), ui_from_subject(*b)) else {
                continue;
            };
            let near = 0.3 + 0.7 * nearness(a.midpoint(*b));
            painter.line_segment(
                [from, to],
                Stroke::new(4.0, ink::HALO_DARK.gamma_multiply(near)),
            );
            painter.line_segment([from, to], Stroke::new(1.8, ink::HOT.gamma_multiply(near)));
            for end in [from, to] {
                dot(painter, end, near);
            }
            let text = format!("{} · {}", i + 1, millimetres(*a, *b, mm_per_unit));
            let galley = painter.layout_no_wrap(text, theme::strong_font(12.0), Color32::WHITE);
            let middle = from.lerp(to, 0.5) + vec2(0.0, -14.0);
            let place = Align2::CENTER_CENTER.anchor_size(middle, galley.size());
            painter.rect_filled(
                place.expand2(vec2(5.0, 2.0)),
                4.0,
                Color32::from_black_alpha(185).gamma_multiply(near),
            );
            painter.galley(place.min, galley, Color32::WHITE);
        }
        if let Tool::Measure(Some(first)) = self.tool
            && let Some(at) = ui_from_subject(first)
        {
            dot(painter, at, 1.0);
        }
    }

    /// What to do next, and the list. `corner` is its top left.
    pub(crate) fn list_ui(
        &self,
        ui: &mut Ui,
        corner: Pos2,
        room: Vec2,
        view: &ViewState,
        commands: &mut Vec<Command>,
    ) {
        let Some(mm_per_unit) = view.mm_per_unit() else {
            return;
        };
        if !self.tool.is_measuring() && self.lines.is_empty() {
            return;
        }
        const ROW: f32 = 30.0;
        let head = if self.tool.is_measuring() { ROW } else { 0.0 };
        let fitting = ((room.y - head - 16.0) / ROW).floor().max(0.0) as usize;
        let shown = self.lines.len().min(fitting);
        let size = vec2(262.0_f32.min(room.x), head + shown as f32 * ROW + 10.0);
        let frame = Rect::from_min_size(corner, size);
        float_frame(ui, frame);
        let mut inner = ui.new_child(
            UiBuilder::new()
                .id_salt("distances")
                .max_rect(frame.shrink2(vec2(8.0, 5.0))),
        );
        let ui = &mut inner;
        ui.spacing_mut().item_spacing = vec2(4.0, 0.0);
        let row = |ui: &mut Ui, text: &str, is_weak: bool, button: &str| {
            let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::empty());
            let id = ui.scope_id().with(("distance", text));
            let place = rect.with_max_x(rect.right() - 34.0);
            let label = ui.interact(place, id, Sense::empty());
            label.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
            let palette = Palette::get(ui);
            let color = if is_weak { palette.weak } else { palette.text };
            let font = egui::FontId::proportional(12.5);
            widget::line_text(&ui.painter_at(place), place, 2.0, text, font, color);
            let side = Rect::from_min_max(rect.right_top() - vec2(30.0, 0.0), rect.right_bottom());
            let mut end = ui.new_child(
                UiBuilder::new()
                    .id_salt(button)
                    .max_rect(widget::sided(rect, side)),
            );
            widget::icon_button(&mut end, Icon::Close, button, true).clicked()
        };
        if self.tool.is_measuring() && row(ui, w().measure_hint, true, w().measure_end) {
            commands.push(Command::See(See::ToggleMeasure));
        }
        for (i, [a, b]) in self.lines.iter().enumerate().take(shown) {
            let value = millimetres(*a, *b, mm_per_unit);
            let text = fill(w().distance_n, &[&(i + 1), &value]);
            if row(ui, &text, false, &fill(w().measure_remove, &[&(i + 1)])) {
                commands.push(Command::See(See::RemoveMeasure(i)));
            }
        }
    }
}

fn dot(painter: &Painter, at: Pos2, near: f32) {
    painter.circle_filled(at, 4.5, ink::HALO_DARK.gamma_multiply(near));
    painter.circle_filled(at, 3.0, ink::HOT.gamma_multiply(near));
}

/// The distance of two points in subject space, in millimetres, as text.
fn millimetres(a: Vec3, b: Vec3, mm_per_unit: f32) -> String {
    let mm = f64::from(a.distance(b) * mm_per_unit);
    fill(w().mm, &[&widget::plain(mm, 1)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_in_millimetres() {
        assert_eq!(millimetres(Vec3::ZERO, Vec3::X, 240.04), "240 mm");
    }
}
