//! Bars at the head of the picture: what the next click is for, and the commonest commands of the selected template.

use egui::{Rect, Ui, UiBuilder, pos2, vec2};

use crate::app::kit::float::float_frame;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::{template_menu, widget};
use crate::app::session::{Command, GizmoMode, Session, Tool};
use crate::app::words::authoring;
use crate::app::words::picture::w;

/// The bar at the head of the picture, of a width where there is room for it.
fn bar_rect(rect: Rect, width: f32) -> Rect {
    let height = theme::control_height() + 12.0;
    let center = pos2(rect.center().x, rect.top() + 10.0 + 0.5 * height);
    Rect::from_center_size(center, vec2(width.min(rect.width() - 12.0), height))
}

/// Draws the frame of that bar and gives what goes into it, from left to right, with the width of the bar.
pub(super) fn head_bar(ui: &mut Ui, rect: Rect, width: f32, id_salt: &str) -> (Ui, f32) {
    let bar = bar_rect(rect, width);
    float_frame(ui, bar);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt(id_salt)
            .max_rect(bar.shrink2(vec2(6.0, 6.0)))
            .layout(widget::along()),
    );
    inner.spacing_mut().item_spacing.x = 2.0;
    (inner, bar.width())
}

/// Where the bar at the head of the picture ends, points from the top of the window; `None` while there is no bar.
pub(crate) fn bar_bottom(rect: Rect, session: &Session) -> Option<f32> {
    let has_bar = session.tool().wants_place()
        || session.tool().ball().is_some()
        || session.tool() == Tool::Clay
        || session.selected_template().is_some()
        || session.selected_object().is_some();
    has_bar.then(|| bar_rect(rect, 0.0).bottom())
}

/// Floating over the picture: what the handles do, and the commonest commands of what is selected.
pub(crate) fn tools_ui(
    ui: &mut Ui,
    rect: Rect,
    session: &Session,
    is_enabled: bool,
    commands: &mut Vec<Command>,
) {
    let (mut inner, width) = head_bar(ui, rect, 372.0, "tools");
    let ui = &mut inner;
    let side = theme::control_height();
    // Where a thumb needs room the menu has the rest.
    let is_short = width < 340.0 || theme::is_touch();
    let buttons = if is_short { 3.0 } else { 5.0 };
    let choice = (width - 12.0 - buttons * (side + 2.0) - 8.0).max(60.0);
    let handles = GizmoMode::ALL.map(|mode| (mode, gizmo_name(mode)));
    ui.allocate_ui(vec2(choice, side), |ui| {
        if let Some(mode) = widget::segmented(ui, w().handles, &handles, session.gizmo) {
            commands.push(Command::SetGizmo(mode));
        }
    });
    ui.add_space(6.0);
    let (eye, eye_name) = if is_enabled {
        (Icon::Eye, w().hide)
    } else {
        (Icon::EyeOff, w().show)
    };
    let all = [
        (eye, eye_name, Command::ToggleSelected),
        (Icon::Copy, w().duplicate, Command::DuplicateSelected),
        (Icon::Trash, w().delete, Command::DeleteSelected),
        (Icon::Close, w().deselect, Command::Select(None)),
    ];
    for (icon, name, command) in all.into_iter().skip(if is_short { 2 } else { 0 }) {
        if widget::icon_button(ui, icon, name, true).clicked() {
            commands.push(command);
        }
    }
    let more = widget::icon_button(ui, Icon::More, authoring::w().actions, true);
    egui::Popup::menu(&more).show(|ui| template_menu::ui(ui, session, commands));
}

/// What the next click is for, over the picture, with a button for its middle and one to leave it. Of the texts the
/// first is for little room.
pub(crate) fn asking_ui(
    ui: &mut Ui,
    rect: Rect,
    [short, long]: [&str; 2],
    cancel: &str,
    commands: &mut Vec<Command>,
) {
    ui.ctx().set_cursor_icon(egui::CursorIcon::Crosshair);
    let palette = Palette::get(ui);
    let is_narrow = rect.width() < 420.0;
    let text = if is_narrow { short } else { long };
    let middle = if is_narrow {
        w().middle
    } else {
        w().in_the_middle
    };
    let middle_width = if is_narrow { 76.0 } else { 118.0 };
    let buttons = middle_width + theme::control_height();
    // Letters shrink where a language needs more room than there is.
    let room = bar_rect(rect, f32::INFINITY).width() - buttons - 40.0;
    let font = theme::strong_font(13.5);
    let wanted = widget::text_width(ui, text, font.clone());
    let font = theme::strong_font((13.5 * room / wanted.max(1.0)).clamp(9.0, 13.5));
    let width = widget::text_width(ui, text, font.clone());
    let bar = bar_rect(rect, width + buttons + 40.0);
    float_frame(ui, bar);
    widget::line_text(ui.painter(), bar, 14.0, text, font, palette.text);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .max_rect(bar.shrink2(vec2(6.0, 6.0)))
            .layout(widget::against()),
    );
    if widget::icon_button(&mut inner, Icon::Close, cancel, true).clicked() {
        commands.push(Command::Escape);
    }
    if inner.button(middle).on_hover_text(w().enter).clicked() {
        commands.push(Command::PlaceInMiddle);
    }
}

/// What a kind of handle is called.
pub(super) fn gizmo_name(mode: GizmoMode) -> &'static str {
    match mode {
        GizmoMode::Move => w().r#move,
        GizmoMode::Turn => w().turn,
        GizmoMode::Size => w().size,
    }
}
