//! Bars that float over the picture: what the next click is for, and the commonest commands of the selected template.

use egui::{Color32, CornerRadius, Rect, Sense, Stroke, Ui, UiBuilder, pos2, vec2};

use super::command::{Command, GizmoMode};
use super::control;
use super::icon::Icon;
use super::making;
use super::state::State;
use super::theme::{self, Palette};
use super::words::picture::w;
use crate::document::PlacedTemplate;

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

/// The bar at the head of the picture, of a width where there is room for it.
pub(super) fn bar_rect(rect: Rect, width: f32) -> Rect {
    let height = theme::control_height() + 12.0;
    let center = pos2(rect.center().x, rect.top() + 10.0 + 0.5 * height);
    Rect::from_center_size(center, vec2(width.min(rect.width() - 12.0), height))
}

/// Floating over the picture: what the handles do, and the commonest commands of the selected template.
pub(super) fn tools_ui(
    ui: &mut Ui,
    rect: Rect,
    state: &State,
    template: &PlacedTemplate,
    commands: &mut Vec<Command>,
) {
    let bar = bar_rect(rect, 372.0);
    let width = bar.width();
    float_frame(ui, bar);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt("tools")
            .max_rect(bar.shrink2(vec2(6.0, 6.0)))
            .layout(control::along()),
    );
    let ui = &mut inner;
    ui.spacing_mut().item_spacing.x = 2.0;
    let side = theme::control_height();
    // Where a thumb needs room the menu has the rest.
    let is_short = width < 340.0 || theme::is_touch();
    let buttons = if is_short { 3.0 } else { 5.0 };
    let choice = (width - 12.0 - buttons * (side + 2.0) - 8.0).max(60.0);
    let handles = GizmoMode::ALL.map(|mode| (mode, gizmo_name(mode)));
    ui.allocate_ui(vec2(choice, side), |ui| {
        if let Some(mode) = control::segmented(ui, w().handles, &handles, state.gizmo) {
            commands.push(Command::SetGizmo(mode));
        }
    });
    ui.add_space(6.0);
    let (eye, eye_name) = if template.enabled {
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
        if control::icon_button(ui, icon, name, true).clicked() {
            commands.push(command);
        }
    }
    let more = control::icon_button(ui, Icon::More, super::words::making::w().actions, true);
    egui::Popup::menu(&more).show(|ui| making::menu_ui(ui, state, commands));
}

/// What the next click is for, over the picture, with a button for its middle and one to leave it. Of the texts the first is for little room.
pub(super) fn asking_ui(
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
    let wanted = control::text_width(ui, text, font.clone());
    let font = theme::strong_font((13.5 * room / wanted.max(1.0)).clamp(9.0, 13.5));
    let width = control::text_width(ui, text, font.clone());
    let bar = bar_rect(rect, width + buttons + 40.0);
    float_frame(ui, bar);
    control::line_text(ui.painter(), bar, 14.0, text, font, palette.text);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .max_rect(bar.shrink2(vec2(6.0, 6.0)))
            .layout(control::against()),
    );
    if control::icon_button(&mut inner, Icon::Close, cancel, true).clicked() {
        commands.push(Command::Escape);
    }
    if inner.button(middle).on_hover_text(w().enter).clicked() {
        commands.push(Command::PlaceInMiddle);
    }
}

/// What a kind of handle is called.
fn gizmo_name(mode: GizmoMode) -> &'static str {
    match mode {
        GizmoMode::Move => w().r#move,
        GizmoMode::Turn => w().turn,
        GizmoMode::Size => w().size,
    }
}
