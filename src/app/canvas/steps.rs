//! The bar of a lesson at the foot of the picture or under the slices: the step that is shown, its legend, back and
//! forth.

use std::sync::Arc;

use egui::{FontId, Galley, Rect, Role, Ui, UiBuilder, WidgetInfo, vec2};

use crate::app::canvas::view_bar;
use crate::app::kit::float;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::session::Command;
use crate::app::session::Session;
use crate::app::words::fill;
use crate::app::words::keys::w;

/// Widest bar over a picture, and under panes, points.
const WIDEST: f32 = 560.0;
const WIDEST_UNDER_PANES: f32 = 900.0;
/// Height of the row of buttons, and what the bar has around its text, points.
const ROW: f32 = 44.0;
const MARGIN: f32 = 14.0;

/// Title and legend of a step; of the document where it is 0.
fn texts(session: &Session, step: usize) -> (&str, &str) {
    let illustration = session.document().illustration();
    let step = step.checked_sub(1);
    match step.and_then(|index| illustration.steps.get(index)) {
        Some(step) => (&step.title, &step.legend),
        None => (&illustration.title, &illustration.legend),
    }
}

/// Number of the step (0 is the start), number of steps, and the title where there is one.
fn heading(number: usize, count: usize, title: &str) -> String {
    let place = match number {
        0 if count == 1 => w().start_of_one.to_owned(),
        0 => fill(w().start_of, &[&count]),
        _ => fill(w().step_of, &[&number, &count]),
    };
    if title.is_empty() {
        place
    } else {
        format!("{place}   {title}")
    }
}

/// The step that is shown, for readers who cannot see it. Nothing without steps.
pub(crate) fn spoken(session: &Session) -> Option<String> {
    let count = session.document().step_count();
    let (title, legend) = texts(session, session.step());
    (count > 0).then(|| format!("{}. {legend}", heading(session.step(), count, title)))
}

/// A text of the bar; none where it is empty.
fn galley(ui: &Ui, text: &str, size: f32, bar_width: f32) -> Option<Arc<Galley>> {
    let width = bar_width - 2.0 * MARGIN;
    let (font, color) = (FontId::proportional(size), Palette::get(ui).text);
    let layout = |text: &str| ui.painter().layout(text.to_owned(), font, color, width);
    (!text.is_empty()).then(|| layout(text))
}

/// The credit, where the panels that tell it are not there.
fn credit(ui: &Ui, session: &Session, width: f32) -> Option<Arc<Galley>> {
    let credit = &session.illustration().credit;
    galley(ui, credit, 12.0, width).filter(|_| session.are_panels_hidden)
}

/// Where the bar lies in the part of the window that shows the object: over the foot of the picture; or under the panes
/// (`is_card_under`), always as high as the longest legend needs, so that the panes stay as they are. None without
/// steps.
pub(crate) fn place(ui: &Ui, area: Rect, session: &Session) -> Option<Rect> {
    let count = session.document().step_count();
    if count == 0 || area.height() < 220.0 {
        return None;
    }
    let is_under = view_bar::is_card_under(area, session);
    let free = view_bar::above_foot(area, session);
    let widest = match is_under {
        true => WIDEST_UNDER_PANES,
        false => WIDEST,
    };
    let width = (free.width() - 16.0).min(widest);
    let shown = if is_under {
        0..=count
    } else {
        session.step()..=session.step()
    };
    let height_of =
        |galley: Option<Arc<Galley>>| galley.map_or(0.0, |galley| galley.size().y + 6.0);
    let legends = shown.map(|step| height_of(galley(ui, texts(session, step).1, 14.0, width)));
    let text = legends.fold(0.0, f32::max) + height_of(credit(ui, session, width));
    let height = ROW + text.min(0.3 * area.height());
    let below = if is_under { 8.0 } else { MARGIN };
    let corner = free.center_bottom() - vec2(0.5 * width, height + below);
    Some(Rect::from_min_size(corner, vec2(width, height)))
}

/// The bar: back, number and title, forth, and the legend.
pub(crate) fn ui(ui: &mut Ui, bar: Rect, session: &Session, commands: &mut Vec<Command>) {
    let count = session.document().step_count();
    let number = session.step();
    let (title, legend) = texts(session, number);
    let width = bar.width();
    float::float_frame(ui, bar);
    let row = Rect::from_min_size(bar.min, vec2(width, ROW)).shrink2(vec2(8.0, 6.0));
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt("steps")
            .max_rect(row)
            .layout(widget::along()),
    );
    let back = widget::icon_button(&mut inner, Icon::Previous, w().step_before, number > 0);
    if back.clicked() {
        commands.push(Command::GoToStep(number.saturating_sub(1)));
    }
    let heading = heading(number, count, title);
    inner.allocate_ui(vec2(row.width() - 76.0, row.height()), |ui| {
        ui.centered_and_justified(|ui| {
            let response = ui.add(egui::Label::new(theme::strong(heading.clone())).truncate());
            // Read out when the step changes.
            response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &heading));
        });
    });
    inner.with_layout(widget::against(), |ui| {
        // A passage that stands still goes on to its end.
        let is_last = number >= count && !session.is_paused();
        if widget::icon_button(ui, Icon::Next, w().next_step, !is_last).clicked() {
            commands.push(Command::WalkStep(true));
        }
    });
    let painter = ui.painter_at(bar);
    let mut at = bar.left_top() + vec2(MARGIN, ROW - 2.0);
    let texts = [galley(ui, legend, 14.0, width), credit(ui, session, width)];
    for galley in texts.into_iter().flatten() {
        let step = galley.size().y + 6.0;
        painter.galley(at, galley, Palette::get(ui).text);
        at.y += step;
    }
}

#[cfg(test)]
mod tests {
    use super::heading;

    #[test]
    fn a_single_step_is_told_as_one() {
        assert_eq!(heading(0, 1, ""), "Start, one step follows");
        assert_eq!(heading(0, 3, "Skull"), "Start, 3 steps follow   Skull");
        assert_eq!(heading(1, 1, ""), "Step 1 of 1");
    }
}
