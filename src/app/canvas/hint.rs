//! The first hint: three steps to an illustration, on the picture, until they are done or put away. Not shown again.

use egui::{FontId, Rect, Role, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use crate::app::canvas::tools::bar_bottom;
use crate::app::canvas::view_bar;
use crate::app::kit::float;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::session::Session;
use crate::app::session::{Command, LibraryCommand};
use crate::app::words::authoring::w;
use crate::app::words::library;
use crate::document::{ParamKind, ParamValue, PlacedTemplate};

/// The card: beside the ball of axes, or where there is no room at the head of the picture. Nothing while something
/// else wants the place. Returns where it lies at the foot of the picture.
pub(crate) fn ui(
    ui: &mut Ui,
    picture: Rect,
    session: &Session,
    commands: &mut Vec<Command>,
) -> Option<Rect> {
    let has_steps = session.document().step_count() > 0;
    if !session.has_hint || has_steps || session.are_panels_hidden || session.tab.is_some() {
        return None;
    }
    let palette = Palette::get(ui);
    let width = (picture.width() - 16.0).min(330.0);
    let is_narrow = picture.width() < 560.0;
    let has_one = session.template_count() > 0;
    let is_opened = session.shown().templates.iter().any(is_opened);
    let lines = [
        (
            w().hint_choose,
            session.tool().placing().is_some() || has_one,
        ),
        (theme::by_hand([w().hint_place, w().tap_place]), is_opened),
        (w().hint_link, false),
    ];
    let galleys = lines.map(|(text, is_done)| {
        let color = if is_done { palette.weak } else { palette.text };
        let font = FontId::proportional(13.0);
        let painter = ui.painter();
        (
            painter.layout(text.to_owned(), font, color, width - 52.0),
            is_done,
        )
    });
    let text_height: f32 = galleys.iter().map(|(g, _)| g.size().y + 5.0).sum();
    let head = theme::control_height() + 14.0;
    let height = text_height + head + 8.0;
    // The words go before the button.
    let foot = theme::control_height() + 12.0;
    let has_examples = 2.0 * (height + foot) <= picture.height();
    let height = if has_examples { height + foot } else { height };
    if 2.0 * height > picture.height() {
        return None;
    }
    let corner = if is_narrow {
        let top = bar_bottom(picture, session).map_or(picture.top() + 8.0, |bar| bar + 6.0);
        pos2(picture.center().x + 0.5 * width, top + height)
    } else {
        picture.right_bottom() - vec2(view_bar::column_width(picture), 14.0)
    };
    let card = Rect::from_min_max(corner - vec2(width, height), corner);
    float::float_frame(ui, card);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt("hint")
            .max_rect(card.shrink2(vec2(12.0, 6.0))),
    );
    widget::heading(&mut inner, w().hint_title, |ui| {
        if widget::labelled_button(ui, Icon::Check, w().hint_done, false, true).clicked() {
            commands.push(Command::PutHintAway);
        }
    });
    if has_examples {
        let row = card.shrink2(vec2(12.0, 10.0));
        let row = row.with_min_y(row.bottom() - theme::control_height());
        let builder = UiBuilder::new().id_salt("hint of examples").max_rect(row);
        let mut ui = ui.new_child(builder.layout(widget::along()));
        let text = library::w().or_example;
        if widget::labelled_button(&mut ui, Icon::Book, text, false, true).clicked() {
            commands.push(Command::Library(LibraryCommand::Toggle));
        }
    }
    let mut y = card.top() + head;
    for (i, (galley, is_done)) in galleys.into_iter().enumerate() {
        let row = Rect::from_min_size(pos2(card.left() + 12.0, y), vec2(width - 24.0, 0.0))
            .with_max_y(y + galley.size().y);
        let number = Rect::from_min_size(row.min - vec2(0.0, 1.0), vec2(18.0, 18.0));
        let number = widget::sided(row, number);
        if is_done {
            Icon::Check.paint(ui.painter(), number, palette.accent);
        } else {
            let text = (i + 1).to_string();
            let font = theme::strong_font(13.0);
            let align = egui::Align2::CENTER_CENTER;
            ui.painter()
                .text(number.center(), align, text, font, palette.accent);
        }
        let response = ui.interact(row, ui.scope_id().with(("hint", i)), egui::Sense::empty());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, galley.text()));
        let at = row.min + vec2(26.0, 0.0);
        let spot = widget::sided(row, Rect::from_min_size(at, galley.size()));
        y += galley.size().y + 5.0;
        ui.painter().galley(spot.min, galley, palette.text);
    }
    (!is_narrow).then_some(card)
}

/// True if the main parameter is no longer what a new template has; a template without one is as open as it gets.
fn is_opened(template: &PlacedTemplate) -> bool {
    let spec = template.kind.spec();
    let Some(param) = spec.main_param else {
        return true;
    };
    let now = template.params.get(param);
    let at_first = match spec.params[param].kind {
        ParamKind::Number { default, .. } | ParamKind::Count { default, .. } => {
            ParamValue::Number(default)
        }
        ParamKind::Vector { default, .. } => ParamValue::Vector(default.into()),
        ParamKind::Flag { .. } | ParamKind::Choice { .. } | ParamKind::Rotation => return true,
    };
    now != Some(&at_first)
}
