//! The list of handles, and everything about the one that was selected last.

use egui::{Label, RichText, Ui};
use glam::DVec2;

use crate::app::kit::entry::{self, EntryRow};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, NumberRow};
use crate::app::session::figure::{
    FigureCommand, FigureTool, HandleKey, handle_edit, handle_motion,
};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;
use crate::app::words::{fill, names};
use crate::document::figure::{Handle, Hold, SCALE_RANGE};

pub(super) fn list_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let figure = session.figure();
    widget::heading(ui, w().handles, |ui| {
        let has_some = !figure.handles.is_empty();
        if widget::icon_button(ui, Icon::Reset, w().all_back, has_some).clicked() {
            commands.push(Command::Figure(FigureCommand::Rest(None)));
        }
        if widget::icon_button(ui, Icon::Pin, w().add_pin, true).clicked() {
            commands.push(Command::Figure(FigureCommand::Take(FigureTool::Pin)));
        }
    });
    if figure.handles.is_empty() {
        let text = RichText::new(w().start).color(Palette::get(ui).weak);
        ui.add(Label::new(text).wrap());
    }
    for (index, handle) in figure.handles.iter().enumerate() {
        let name = names::handle(index, handle);
        let note = match &handle.hold {
            Hold::Region(region) => fill(w().holds, &[region]),
            _ => String::new(),
        };
        let row = EntryRow {
            id: ("handle", index),
            name: &name,
            title: &name,
            note: &note,
            is_selected: session.view.figure.handles.contains(&index),
            has_grip: false,
            group: None,
            is_shown: Some(handle.enabled),
        };
        let entry = row.ui(ui);
        if entry.is_toggled {
            let edit = handle_edit(index, HandleKey::Enabled(!handle.enabled));
            commands.push(Command::Apply(edit));
        }
        if entry.response.clicked() {
            let adds = ui.input(|i| i.modifiers.shift || i.modifiers.command);
            let select = FigureCommand::SelectHandle(Some(index), adds);
            commands.push(Command::Figure(select));
        }
    }
}

pub(super) fn selected_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let figure = session.figure();
    let chosen = session.view.figure.handles.last();
    let Some((index, handle)) = chosen.and_then(|i| Some((*i, figure.handles.get(*i)?))) else {
        return;
    };
    widget::divider(ui);
    widget::heading(ui, &names::handle(index, handle), |ui| {
        if widget::icon_button(ui, Icon::Trash, w().delete_handle, true).clicked() {
            commands.push(Command::DeleteSelected);
        }
        if widget::icon_button(ui, Icon::Reset, w().back, true).clicked() {
            commands.push(Command::Figure(FigureCommand::Rest(Some(index))));
        }
    });
    let name = handle.name.as_deref().unwrap_or_default();
    let hints = ("", w().handle_name_hint);
    if let Some(name) = entry::name_row(ui, ("handle name", index), name, hints) {
        commands.push(Command::Drag(handle_edit(index, HandleKey::Name(name))));
    }
    if !matches!(handle.hold, Hold::Line { to: Some(_), .. }) {
        motion_ui(ui, session, (index, handle), commands);
    }
    if !matches!(handle.hold, Hold::Region(_)) {
        let row = NumberRow {
            name: w().radius,
            summary: w().radius_hint,
            value: handle.radius,
            default: Some(0.01),
            range: [0.001, 0.2],
            unit: "",
            decimals: 3,
        };
        if let Some(change) = row.ui_logarithmic(ui) {
            let edit = |radius| handle_edit(index, HandleKey::Radius(radius));
            commands.push(widget::command(change.map(edit)));
        }
    }
}

/// Where a handle takes what it holds.
fn motion_ui(
    ui: &mut Ui,
    session: &Session,
    (index, handle): (usize, &Handle),
    commands: &mut Vec<Command>,
) {
    let motion = &handle.motion;
    let mut send = |ui: &mut Ui, row: NumberRow<'_>, key: &dyn Fn(f64) -> HandleKey| {
        if let Some(change) = row.ui(ui) {
            let edit = |value| handle_edit(index, key(value));
            commands.push(widget::command(change.map(edit)));
        }
    };
    let row = |name, summary, value, default| NumberRow {
        name,
        summary,
        value,
        default,
        range: [-1.0, 1.0],
        unit: "",
        decimals: 3,
    };
    let by = motion.by;
    let x = row(w().move_x, w().move_hint, by.x, Some(0.0));
    send(ui, x, &|x| HandleKey::Move(DVec2::new(x, by.y)));
    let y = row(w().move_y, w().move_hint, by.y, Some(0.0));
    send(ui, y, &|y| HandleKey::Move(DVec2::new(by.x, y)));
    let (turn, scale) = handle_motion(&session.view.figure, handle);
    let turned = NumberRow {
        range: [-720.0, 720.0],
        unit: "°",
        decimals: 1,
        ..row(w().turn, w().turn_hint, turn.to_degrees(), None)
    };
    send(ui, turned, &|degrees| {
        HandleKey::Turn(Some(degrees.to_radians()))
    });
    if matches!(handle.hold, Hold::Point(_)) {
        let mut is_open = motion.turn.is_none();
        if ui.checkbox(&mut is_open, w().turn_open).clicked() {
            let turn = (!is_open).then_some(turn);
            commands.push(Command::Apply(handle_edit(index, HandleKey::Turn(turn))));
        }
    }
    let row = NumberRow {
        range: SCALE_RANGE,
        decimals: 2,
        ..row(w().scale, w().scale_hint, scale, Some(1.0))
    };
    if let Some(change) = row.ui_logarithmic(ui) {
        let edit = |scale| handle_edit(index, HandleKey::Scale(scale));
        commands.push(widget::command(change.map(edit)));
    }
}
