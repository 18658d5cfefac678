//! The bar of a lesson at the foot of the picture: the step that is shown, its legend, back and forth.

use egui::{FontId, Rect, Role, Ui, UiBuilder, WidgetInfo, vec2};

use crate::app::canvas::view_bar;
use crate::app::kit::float;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::session::Command;
use crate::app::session::Session;
use crate::app::words::keys::w;

/// Points that the ball of axes and the way home take at the left, and at the foot of the picture.
const BESIDE_THE_BALL: f32 = 148.0;
const ABOVE_THE_BALL: f32 = 112.0;

/// Title and legend of the step that is shown.
fn texts(session: &Session) -> (&str, &str) {
    let illustration = session.document().illustration();
    let step = session.step().checked_sub(1);
    match step.and_then(|index| illustration.steps.get(index)) {
        Some(step) => (&step.title, &step.legend),
        None => (&illustration.title, &illustration.legend),
    }
}

/// Number of the step, number of steps, and the title where there is one.
fn heading(number: usize, count: usize, title: &str) -> String {
    if title.is_empty() {
        format!("{number} / {count}")
    } else {
        format!("{number} / {count}   {title}")
    }
}

/// The step that is shown, for readers who cannot see it. Nothing without steps.
pub(crate) fn spoken(session: &Session) -> Option<String> {
    let count = session.document().step_count();
    let (title, legend) = texts(session);
    (count > 0).then(|| format!("{}. {legend}", heading(session.step(), count, title)))
}

/// The bar at the foot of the picture: back, number and title, forth, and the legend. Nothing without steps.
pub(crate) fn ui(ui: &mut Ui, picture: Rect, session: &Session, commands: &mut Vec<Command>) {
    let steps = &session.document().illustration().steps;
    if steps.is_empty() || picture.height() < 220.0 {
        return;
    }
    let palette = Palette::get(ui);
    let number = session.step();
    let (title, legend) = texts(session);
    // Beside the ball of axes where there is room for both, else above it.
    let free = if picture.width() > 620.0 {
        picture.with_min_x(picture.left() + BESIDE_THE_BALL)
    } else {
        picture.with_max_y(picture.bottom() - ABOVE_THE_BALL)
    };
    let free = free.with_max_x(free.right() - view_bar::column_width(picture));
    let width = (free.width() - 16.0).min(560.0);
    let text_width = width - 28.0;
    let legend = (!legend.is_empty()).then(|| {
        ui.painter().layout(
            legend.to_owned(),
            FontId::proportional(14.0),
            palette.text,
            text_width,
        )
    });
    let legend_height = legend.as_ref().map_or(0.0, |galley| galley.size().y + 6.0);
    let height = 44.0 + legend_height.min(0.3 * picture.height());
    let bar = Rect::from_min_size(
        free.center_bottom() - vec2(0.5 * width, height + 14.0),
        vec2(width, height),
    );
    float::float_frame(ui, bar);
    let row = Rect::from_min_size(bar.min, vec2(width, 44.0)).shrink2(vec2(8.0, 6.0));
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
    let heading = heading(number, steps.len(), title);
    inner.allocate_ui(vec2(row.width() - 76.0, row.height()), |ui| {
        ui.centered_and_justified(|ui| {
            let response = ui.add(egui::Label::new(theme::strong(heading.clone())).truncate());
            // Read out when the step changes.
            response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &heading));
        });
    });
    inner.with_layout(widget::against(), |ui| {
        let is_last = number >= steps.len();
        if widget::icon_button(ui, Icon::Next, w().next_step, !is_last).clicked() {
            commands.push(Command::GoToStep(number + 1));
        }
    });
    if let Some(galley) = legend {
        let at = bar.left_top() + vec2(14.0, 42.0);
        ui.painter_at(bar).galley(at, galley, palette.text);
    }
}
