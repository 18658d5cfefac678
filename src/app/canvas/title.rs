//! The title at the head of the picture, where it is wished; title, text and credit at its foot when it is shown alone.

use std::sync::Arc;

use egui::{FontId, Galley, Rect, Role, Sense, Ui, UiBuilder, Vec2, WidgetInfo, vec2};

use super::tools::bar_bottom;
use crate::app::canvas::view_bar;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::{float, widget};
use crate::app::session::{Command, Session};
use crate::app::words::picture;

/// The title at the head of the picture, if it is wished there. Returns where the rest of the picture begins, points
/// from the top of the window.
pub(crate) fn head_ui(ui: &Ui, picture: Rect, session: &Session) -> f32 {
    let top = bar_bottom(picture, session).map_or(picture.top() + 30.0, |bar| bar + 8.0);
    let title = session.illustration().title.trim();
    // Alone, the picture has its title at the foot.
    if !session.has_title || title.is_empty() || session.are_panels_hidden {
        return top;
    }
    let color = Palette::get(ui).text;
    let width = (picture.width() - 48.0).max(80.0);
    let font = theme::strong_font(18.0);
    let galley = ui.painter().layout(title.to_owned(), font, color, width);
    let card = Rect::from_center_size(picture.center_top(), galley.size() + vec2(24.0, 10.0));
    let card = card.translate(vec2(0.0, top - card.top()));
    let painter = ui.painter_at(picture);
    painter.rect_filled(card, 8.0, Palette::get(ui).float);
    painter.galley(card.min + vec2(12.0, 5.0), galley, color);
    let response = ui.interact(card, ui.scope_id().with("title"), Sense::empty());
    response.widget_info(|| WidgetInfo::labeled(Role::Heading, true, title));
    card.bottom() + 6.0
}

/// The way back to the panels.
pub(crate) fn way_back_ui(ui: &mut Ui, rect: Rect, commands: &mut Vec<Command>) {
    let side = theme::control_height() + 6.0;
    let corner = rect.right_top() + vec2(-12.0 - side, 12.0);
    let button = Rect::from_min_size(corner, Vec2::splat(side));
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
}

/// The texts of the document that are not empty, as wide as there is room for.
fn galleys(ui: &Ui, area: Rect, session: &Session) -> Vec<Arc<Galley>> {
    let free = view_bar::above_foot(area, session);
    let width = (free.width() - 40.0).clamp(160.0, 640.0);
    let illustration = session.illustration();
    let texts = [
        (&illustration.title, theme::strong_font(20.0)),
        (&illustration.legend, FontId::proportional(15.0)),
        (&illustration.credit, FontId::proportional(12.0)),
    ];
    let color = Palette::get(ui).text;
    texts
        .into_iter()
        .filter(|(text, _)| !text.is_empty())
        .map(|(text, font)| ui.painter().layout(text.clone(), font, color, width))
        .collect()
}

/// Where the card of title, legend and credit lies in the part of the window that shows the object: over the foot of
/// the picture, or under the panes (`is_card_under`). None without texts.
pub(crate) fn place(ui: &Ui, area: Rect, session: &Session) -> Option<Rect> {
    let galleys = galleys(ui, area, session);
    let height: f32 = galleys.iter().map(|galley| galley.size().y + 4.0).sum();
    let widths = galleys.iter().map(|galley| galley.size().x);
    let size = vec2(widths.reduce(f32::max)?, height) + vec2(28.0, 16.0);
    let is_under = view_bar::is_card_under(area, session);
    let below = if is_under { 8.0 } else { 18.0 };
    let free = view_bar::above_foot(area, session);
    let corner = free.center_bottom() - vec2(0.5 * size.x, size.y + below);
    Some(Rect::from_min_size(corner, size))
}

/// The card at its place.
pub(crate) fn ui(ui: &Ui, area: Rect, card: Rect, session: &Session) {
    float::float_frame(ui, card);
    let mut at = card.min + vec2(14.0, 8.0);
    for galley in galleys(ui, area, session) {
        let step = galley.size().y + 4.0;
        ui.painter().galley(at, galley, Palette::get(ui).text);
        at.y += step;
    }
}
