//! Title, text and credit over the picture when it is shown alone.

use egui::{FontId, Rect, Ui, UiBuilder, Vec2, vec2};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::{float, widget};
use crate::app::session::{Command, Session};
use crate::app::words::picture;

/// The texts at the foot of the picture, and the way back to the panels.
pub(crate) fn ui(ui: &mut Ui, rect: Rect, session: &Session, commands: &mut Vec<Command>) {
    let button = Rect::from_min_size(rect.right_top() + vec2(-46.0, 12.0), Vec2::splat(34.0));
    let button = widget::sided(rect, button);
    float::float_frame(ui, button);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt("panels")
            .max_rect(button.shrink(3.0)),
    );
    if widget::icon_button(&mut inner, Icon::Close, picture::w().show_panels, true).clicked() {
        commands.push(Command::TogglePanels);
    }
    let illustration = session.illustration();
    let texts = [
        (&illustration.title, theme::strong_font(20.0)),
        (&illustration.legend, FontId::proportional(15.0)),
        (&illustration.credit, FontId::proportional(12.0)),
    ];
    if texts.iter().all(|(text, _)| text.is_empty()) {
        return;
    }
    let palette = Palette::get(ui);
    let width = (rect.width() - 200.0).clamp(200.0, 640.0);
    let galleys: Vec<_> = texts
        .into_iter()
        .filter(|(text, _)| !text.is_empty())
        .map(|(text, font)| ui.painter().layout(text.clone(), font, palette.text, width))
        .collect();
    let height: f32 = galleys.iter().map(|galley| galley.size().y + 4.0).sum();
    let widest = galleys
        .iter()
        .map(|galley| galley.size().x)
        .fold(0.0, f32::max);
    let mut at = rect.center_bottom() - vec2(0.5 * widest, height + 26.0);
    let frame = Rect::from_min_size(at, vec2(widest, height)).expand2(vec2(14.0, 8.0));
    float::float_frame(ui, frame);
    for galley in galleys {
        let step = galley.size().y + 4.0;
        ui.painter().galley(at, galley, palette.text);
        at.y += step;
    }
}
