//! Title, caption, credit: what stands with the picture.

use egui::{Label, TextEdit, Ui};

use super::command::Command;
use super::control;
use super::state::State;
use super::theme::Palette;
use crate::document::{Edit, SubjectRef};

/// The panel.
pub(crate) fn ui(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let illustration = state.illustration();
    control::heading(ui, "Text", |_| {});
    let mut field =
        |ui: &mut Ui, name: &str, hint: &str, text: &str, rows: usize, edit: fn(String) -> Edit| {
            let weak = Palette::get(ui).weak;
            let label = ui.label(egui::RichText::new(name).color(weak));
            let mut text = text.to_owned();
            let widget = if rows == 1 {
                TextEdit::singleline(&mut text)
            } else {
                TextEdit::multiline(&mut text)
            };
            let widget = widget
                .hint_text(hint)
                .desired_rows(rows)
                .desired_width(f32::INFINITY);
            let response = ui.add(widget).labelled_by(label.id);
            if response.changed() {
                commands.push(Command::Drag(edit(text)));
            }
            ui.add_space(4.0);
        };
    field(
        ui,
        "Title",
        "Craniotomy",
        &illustration.title,
        1,
        Edit::SetTitle,
    );
    field(
        ui,
        "Caption",
        "What the picture shows",
        &illustration.caption,
        4,
        Edit::SetCaption,
    );
    field(
        ui,
        "Credit",
        "Your name, where the scan is from",
        &illustration.credit,
        1,
        Edit::SetCredit,
    );
    if let SubjectRef::Supplied { sha256, name } = &illustration.subject {
        let weak = Palette::get(ui).weak;
        let label = ui.label(egui::RichText::new("Name of the scan").color(weak));
        let mut text = name.clone();
        let widget = TextEdit::singleline(&mut text)
            .hint_text("CT head")
            .desired_width(f32::INFINITY);
        if ui.add(widget).labelled_by(label.id).changed() {
            let subject = SubjectRef::Supplied {
                sha256: sha256.clone(),
                name: text,
            };
            commands.push(Command::Drag(Edit::SetSubject(subject)));
        }
        let hint = "The scan stays on this machine. Whoever opens the link is asked for the file; the name tells which.";
        ui.add(Label::new(egui::RichText::new(hint).small().color(weak)).wrap());
    }
}
