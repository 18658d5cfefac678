//! At the bottom of the picture: the ball of axes, the way back home, standard views, slices, the ghost, distances.

use egui::{Rect, Ui, UiBuilder, Vec2, vec2};

use crate::app::canvas::orientation;
use crate::app::canvas::projection::Projection;
use crate::app::kit::float::float_frame;
use crate::app::kit::icon::Icon;
use crate::app::kit::menu::menu_item;
use crate::app::kit::theme;
use crate::app::kit::widget;
use crate::app::session::Command;
use crate::app::session::See;
use crate::app::session::Session;
use crate::app::session::StandardView;
use crate::app::words::{picture, slices};

/// Points of a picture's height below which its buttons lie in a row along its foot.
pub(crate) const LOW: f32 = 330.0;

/// Side of a button with its frame, points.
fn button() -> f32 {
    (theme::control_height() + 4.0).max(34.0)
}

/// Width at the right edge of a picture that the buttons take, points; nothing where they lie along its foot.
pub(crate) fn column_width(picture: Rect) -> f32 {
    if picture.height() < LOW {
        0.0
    } else {
        button() + 20.0
    }
}

/// Points that the ball of axes and the way home take at the left of the picture.
const BESIDE_THE_BALL: f32 = 148.0;
/// Points of width up to which a card and the ball have no room beside each other.
const NARROW: f32 = 620.0;

/// True if a card at the foot of the part of the window that shows the object lies under the panes, not over the
/// picture: where slices are shown, and in narrow windows, where it would cover the object.
pub(crate) fn is_card_under(area: Rect, session: &Session) -> bool {
    session.view.is_split || area.width() <= NARROW
}

/// The part of the window that shows the object at whose foot a card may lie: all of it under the panes; over the
/// picture between the ball of axes and the buttons.
pub(crate) fn above_foot(area: Rect, session: &Session) -> Rect {
    if is_card_under(area, session) {
        return area;
    }
    let free = area.with_min_x(area.left() + BESIDE_THE_BALL);
    free.with_max_x(free.right() - column_width(area))
}

/// The part of a picture that texts over it may fill: beside the buttons and above the ball of axes.
pub(crate) fn beside(picture: Rect) -> Rect {
    let foot = if picture.height() < LOW {
        button() + 24.0
    } else {
        128.0
    };
    let mut area = picture.shrink2(vec2(14.0, 12.0));
    area.max.x -= column_width(picture);
    area.max.y -= foot;
    area
}

/// The part of the panes over which messages may lie: the buttons and the ball of axes stay within reach.
pub(crate) fn for_messages(panes: Rect) -> Rect {
    match panes.width() <= NARROW {
        true => beside(panes),
        false => panes.shrink2(vec2(150.0, 22.0)),
    }
}

/// All of it, in the corners of a rectangle.
pub(crate) fn corner_ui(
    ui: &mut Ui,
    rect: Rect,
    view: &Projection,
    session: &Session,
    commands: &mut Vec<Command>,
) {
    if rect.height() < 140.0 {
        return;
    }
    // Over an open drawer there is room for a row of buttons only.
    let is_low = rect.height() < LOW;
    let center = rect.left_bottom() + vec2(62.0, -62.0);
    let home = if is_low {
        rect.left_bottom() + vec2(12.0, -12.0) + 0.5 * button() * vec2(1.0, -1.0)
    } else {
        // A figure has no sides to look from.
        if !session.view.is_figure() {
            commands.extend(orientation::ball_ui(ui, view, center));
        }
        center + vec2(64.0, 47.0 - 0.5 * button())
    };
    let home = Rect::from_center_size(home, Vec2::splat(button()));
    if button_ui(ui, home, Icon::Home, picture::w().back_to_first, false).clicked() {
        commands.push(Command::ResetView);
    }

    let w = slices::w();
    let seen = &session.view;
    let corner = rect.right_bottom() - vec2(12.0 + 0.5 * button(), 12.0 + 0.5 * button());
    let spot = |i: f32| {
        let step = i * (button() + 4.0);
        let center = corner
            - if is_low {
                vec2(step, 0.0)
            } else {
                vec2(0.0, step)
            };
        Rect::from_center_size(center, Vec2::splat(button()))
    };
    if seen.is_figure() {
        return;
    }
    let (text, is_on) = match seen.is_split {
        true => (w.hide, true),
        false => (w.show, false),
    };
    if button_ui(ui, spot(0.0), Icon::Panes, text, is_on).clicked() {
        commands.push(Command::See(See::ToggleSlices));
    }
    let (text, is_on) = match session.tool().is_measuring() {
        true => (w.measure_end, true),
        false => (w.measure, false),
    };
    if button_ui(ui, spot(1.0), Icon::Ruler, text, is_on).clicked() {
        commands.push(Command::See(See::ToggleMeasure));
    }
    let (text, is_on) = match seen.has_ghost {
        true => (w.ghost_hide, true),
        false => (w.ghost_show, false),
    };
    if button_ui(ui, spot(2.0), Icon::Ghost, text, is_on).clicked() {
        commands.push(Command::See(See::ToggleGhost));
    }
    if seen.is_mesh() {
        let (text, is_on) = match seen.has_wires {
            true => (w.wires_hide, true),
            false => (w.wires_show, false),
        };
        if button_ui(ui, spot(4.0), Icon::Wires, text, is_on).clicked() {
            commands.push(Command::See(See::ToggleWires));
        }
    }
    let views = button_ui(ui, spot(3.0), Icon::Cube, w.views, false);
    egui::Popup::menu(&views).show(|ui| {
        ui.set_min_width(220.0);
        for (i, side) in StandardView::ALL.into_iter().enumerate() {
            let text = format!("{}   {}", orientation::side_hint(side), i + 1);
            if menu_item(ui, Icon::Cube, &text) {
                commands.push(Command::View(side));
                ui.close();
            }
        }
        if menu_item(
            ui,
            Icon::Home,
            &format!("{}   0", picture::w().back_to_first),
        ) {
            commands.push(Command::ResetView);
            ui.close();
        }
    });
}

fn button_ui(ui: &mut Ui, rect: Rect, icon: Icon, name: &str, is_on: bool) -> egui::Response {
    float_frame(ui, rect);
    let mut inner = ui.new_child(UiBuilder::new().id_salt(name).max_rect(rect.shrink(2.0)));
    widget::icon_button_sized(&mut inner, icon, name, true, is_on, button() - 4.0)
}
