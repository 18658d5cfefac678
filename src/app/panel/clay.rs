//! The clay: the tool that shapes it, how many of its strokes are shown, and the list of them.

use egui::{Label, RichText, Ui};
use serde_json::json;

use super::{hand, stroke};
use crate::app::kit::entry::EntryRow;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, NumberRow};
use crate::app::session::{ClayCommand, Command, Session, Tool};
use crate::app::words::clay::w;
use crate::app::words::{fill, names};
use crate::document::{Clay, ClayStroke, Edit};

/// Rows of the list that are made at most: those at its end.
const ROWS: usize = 200;

/// The section of a clay, if the subject is one.
pub(crate) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(clay) = session.clay() else {
        return;
    };
    widget::heading(ui, w().heading, |_| {});
    let is_held = session.tool() == Tool::Clay;
    // While the tool is in hand the bar over the picture puts it away.
    if is_held {
        hand::ui(ui, session.hand(), commands);
        bake_ui(ui, commands);
    } else if widget::labelled_button(ui, Icon::Brush, w().shape, true, true).clicked() {
        commands.push(Command::Clay(ClayCommand::Toggle));
    }
    detail_ui(ui, clay, commands);
    if clay.strokes.is_empty() {
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(RichText::new(w().none).small().color(weak)).wrap());
    } else {
        shown_ui(ui, session, clay, commands);
        list_ui(ui, session, clay, commands);
    }
    widget::divider(ui);
}

fn bake_ui(ui: &mut Ui, commands: &mut Vec<Command>) {
    let bake = widget::labelled_button(ui, Icon::Copy, w().bake, false, true);
    if bake.on_hover_text(w().bake_hint).clicked() {
        commands.push(Command::Clay(ClayCommand::Bake));
    }
}

fn detail_ui(ui: &mut Ui, clay: &Clay, commands: &mut Vec<Command>) {
    let row = NumberRow {
        name: w().detail,
        summary: w().detail_hint,
        value: clay.detail,
        default: Some(Clay::default().detail),
        range: Clay::DETAIL,
        unit: "",
        decimals: 3,
    };
    if let Some(change) = row.ui_logarithmic(ui) {
        let edit = |detail: f64| Edit::Set {
            pointer: "/subject/clay/detail".to_owned(),
            value: json!((detail * 1e3).round() / 1e3),
            name: "Change detail".to_owned(),
        };
        commands.push(widget::command(change.map(edit)));
    }
}

/// How many strokes are shown.
fn shown_ui(ui: &mut Ui, session: &Session, clay: &Clay, commands: &mut Vec<Command>) {
    let all = clay.strokes.len();
    let row = NumberRow {
        name: w().shown,
        summary: w().shown_hint,
        value: session.strokes_shown() as f64,
        default: Some(all as f64),
        range: [0.0, all as f64],
        unit: "",
        decimals: 0,
    };
    if let Some(change) = row.ui(ui) {
        let edit = |shown: f64| {
            // All of them, those that come later too.
            let is_less = (shown as usize) < all;
            let value = is_less.then(|| json!(shown.round() as u64));
            Edit::put(
                "/look/strokes".to_owned(),
                value,
                "Change strokes shown".to_owned(),
            )
        };
        commands.push(widget::command(change.map(edit)));
    }
}

/// The strokes, the last first.
fn list_ui(ui: &mut Ui, session: &Session, clay: &Clay, commands: &mut Vec<Command>) {
    let strokes = clay.strokes.iter().enumerate().rev();
    for (i, stroke) in strokes.take(ROWS) {
        ui.push_id(("stroke", i), |ui| {
            ui.horizontal(|ui| {
                let name = fill(w().stroke, &[&(i + 1)]);
                let remove = fill(w().remove, &[&(i + 1)]);
                ui.with_layout(widget::against(), |ui| {
                    if widget::icon_button(ui, Icon::Trash, &remove, true).clicked() {
                        commands.push(Command::Clay(ClayCommand::Remove(i)));
                    }
                    let is_selected = session.selection.stroke() == Some(i);
                    if is_selected {
                        shift_ui(ui, i, clay.strokes.len(), commands);
                    }
                    let note = note_of(clay, stroke);
                    let row = EntryRow {
                        id: ("stroke", i),
                        name: &name,
                        title: &name,
                        note: &note,
                        is_selected,
                        has_grip: false,
                        group: None,
                        is_shown: Some(!stroke.is_off),
                    };
                    let done = row.ui(ui);
                    if done.is_toggled {
                        commands.push(Command::Clay(ClayCommand::Switch(i)));
                    } else if done.response.clicked() {
                        commands.push(Command::Clay(ClayCommand::Select(i)));
                    }
                });
            });
            if session.selection.stroke() == Some(i) {
                stroke::ui(ui, clay, (i, stroke), commands);
            }
        });
    }
}

/// Buttons that move the selected stroke in the list, in which the last one stands on top.
fn shift_ui(ui: &mut Ui, index: usize, count: usize, commands: &mut Vec<Command>) {
    let buttons = [
        (Icon::Down, w().earlier, 1, index > 0),
        (Icon::Up, w().later, -1, index + 1 < count),
    ];
    for (icon, name, by, is_enabled) in buttons {
        let name = fill(name, &[&(index + 1)]);
        if widget::icon_button(ui, icon, &name, is_enabled).clicked() {
            commands.push(Command::ShiftSelected(by));
        }
    }
}

/// What a stroke does, and with which tool.
fn note_of(clay: &Clay, stroke: &ClayStroke) -> String {
    let does = match stroke.smooth {
        Some(_) => w().smoothed,
        None => w().swept,
    };
    let tools = stroke
        .moves
        .iter()
        .filter_map(|one| clay.tools.get(one.tool));
    let shapes = tools.filter_map(|tool| tool.shape.as_ref());
    let names: Vec<&str> = shapes.map(names::tool_shape).collect();
    match names.is_empty() {
        true => does.to_owned(),
        false => format!("{} · {does}", names.join(", ")),
    }
}
