//! What is told about the step that is shown: its title and caption, how long it takes, notes for the teacher.

use egui::{Align2, Label, RichText, TextEdit, Ui};
use serde_json::Value;

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, NumberRow};
use crate::app::session::{Command, Session, StepCommand};
use crate::app::words::{fill, steps::w};
use crate::document::{Edit, Step};

/// The fields of the step that is shown; nothing at the start.
pub(crate) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let (shown, count) = (session.step(), session.document().step_count());
    let Some(index) = shown.checked_sub(1) else {
        return;
    };
    let Some(step) = session.illustration().steps.get(index) else {
        return;
    };
    widget::heading(ui, &fill(w().step_n, &[&shown]), |ui| {
        let mut to = |ui: &mut Ui, icon, name, to: usize, is_there| {
            if widget::icon_button(ui, icon, name, is_there).clicked() {
                let command = StepCommand::Move { from: shown, to };
                commands.push(Command::Step(command));
            }
        };
        to(ui, Icon::Next, w().later, shown + 1, shown < count);
        to(ui, Icon::Previous, w().earlier, index, shown > 1);
    });
    let weak = Palette::get(ui).weak;
    let hint = RichText::new(fill(w().edits_here, &[&shown])).small();
    ui.add(Label::new(hint.color(weak)).wrap());
    ui.add_space(4.0);
    let set = |key: &str, value: Value, name: &str| Edit::Set {
        pointer: format!("/steps/{index}/{key}"),
        value,
        name: name.to_owned(),
    };
    let mut text = |ui: &mut Ui, [name, hint]: [&str; 2], (key, value): (&str, &str), rows| {
        let label = ui.label(RichText::new(name).color(weak));
        let mut text = value.to_owned();
        let field = match rows {
            1 => TextEdit::singleline(&mut text).align(Align2::LEFT_CENTER),
            _ => TextEdit::multiline(&mut text),
        };
        let field = field
            .id(egui::Id::unique(("field of a step", key, index)))
            .hint_text(hint)
            .desired_rows(rows)
            .desired_width(f32::INFINITY);
        if ui.add(field).labelled_by(label.id).changed() {
            let edit = set(key, text.into(), "Change step");
            commands.push(Command::Drag(edit));
        }
        ui.add_space(4.0);
    };
    text(ui, [w().title, w().title_hint], ("title", &step.title), 1);
    text(
        ui,
        [w().caption, w().caption_hint],
        ("caption", &step.legend),
        3,
    );
    text(ui, [w().notes, w().notes_hint], ("notes", &step.notes), 3);
    let hint = RichText::new(w().notes_are_in_link).small();
    ui.add(Label::new(hint.color(weak)).wrap());
    ui.add_space(4.0);
    let rows = [
        (
            "seconds",
            w().seconds,
            w().seconds_hint,
            step.seconds,
            1.0,
            60.0,
        ),
        (
            "hold",
            w().hold,
            w().hold_hint,
            step.hold_seconds,
            Step::DEFAULT_HOLD,
            120.0,
        ),
    ];
    for (key, name, summary, value, default, most) in rows {
        let row = NumberRow {
            name,
            summary,
            value: f64::from(value),
            default: Some(f64::from(default)),
            range: [0.0, f64::from(value).max(most)],
            unit: " s",
            decimals: 1,
        };
        if let Some(change) = row.ui(ui) {
            let edit = |seconds: f64| {
                let tenths = (seconds * 10.0).round() / 10.0;
                set(key, tenths.into(), "Change length of step")
            };
            commands.push(widget::command(change.map(edit)));
        }
    }
    widget::divider(ui);
}

/// How a lesson is begun, where there is none.
pub(crate) fn first_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    if session.document().step_count() > 0 {
        return;
    }
    widget::heading(ui, w().heading, |ui| {
        let add = widget::icon_button(ui, Icon::Plus, w().add, true);
        if add.on_hover_text(w().none).clicked() {
            commands.push(Command::Step(StepCommand::Add));
        }
    });
    widget::divider(ui);
}
