//! The clay: the tool that shapes it, how many of its strokes are shown, and the list of them.

use egui::{Label, RichText, Ui};
use serde_json::json;

use crate::app::kit::entry::EntryRow;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Named as _, NumberRow};
use crate::app::session::{ClayCommand, ClayHand, Command, Session, Tool};
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
        hand_ui(ui, &session.clay_hand, commands);
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

/// The tool in the hand; the bar over the picture has its way and its form.
fn hand_ui(ui: &mut Ui, hand: &ClayHand, commands: &mut Vec<Command>) {
    let mut new = hand.clone();
    let [sizes, coats] = ClayHand::RANGES;
    let rows = [
        (w().size, w().size_hint, &mut new.size, sizes),
        (w().coat, w().coat_hint, &mut new.coat, coats),
    ];
    for (name, summary, value, range) in rows {
        let row = NumberRow {
            name,
            summary,
            value: f64::from(*value),
            default: Some(0.1),
            range: range.map(f64::from),
            unit: "",
            decimals: 3,
        };
        if let Some(change) = row.ui_logarithmic(ui) {
            *value = *change.value() as f32;
        }
    }
    let whole = |(name, summary), value: f32, most: f64, unit| NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: Some(0.0),
        range: [-most, most],
        unit,
        decimals: 0,
    };
    let depth = whole((w().depth, w().depth_hint), hand.depth * 100.0, 100.0, " %");
    if let Some(change) = depth.ui(ui) {
        new.depth = *change.value() as f32 / 100.0;
    }
    let turn = whole((w().angle, w().angle_hint), hand.turn_deg, 180.0, "°");
    if let Some(change) = turn.ui(ui) {
        new.turn_deg = *change.value() as f32;
    }
    widget::row(ui, |ui| {
        widget::row_label(ui, w().mirrors, w().mirror_hint);
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let named = fill(w().mirror, &[&name.to_lowercase()]);
            let response = ui.checkbox(&mut new.mirror[axis], name).named(&named);
            response.on_hover_text(w().mirror_hint);
        }
    });
    if new != *hand {
        commands.push(Command::Clay(ClayCommand::Hold(new)));
    }
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
