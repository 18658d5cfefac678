//! Title, caption, credit: what stands with the picture.

use egui::{Label, TextEdit, Ui};

use super::{captions, controls, steps};
use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::app::panel::frames;
use crate::app::session::Command;
use crate::app::session::{Focus, Session};
use crate::app::words::text::w;
use crate::document::{Edit, SubjectRef};

/// Draws the panel: title, text, credit and captions of the document.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    focus: &mut Option<Focus>,
    commands: &mut Vec<Command>,
) {
    steps::ui(ui, session, commands);
    steps::first_ui(ui, session, commands);
    if session.step() > 0 {
        // What is changed at a step stands together; the texts of the document follow.
        captions::ui(ui, session, focus, commands);
    }
    let illustration = session.illustration();
    widget::heading(ui, w().heading, |_| {});
    let title_id = egui::Id::unique("title of the document");
    // Nothing keeps the focus in a frame with a press or a click elsewhere, as the one that led here.
    if *focus == Some(Focus::Title)
        && ui.input(|i| i.pointer.any_pressed() || i.pointer.any_released())
    {
        ui.ctx().request_repaint();
    } else if focus.take_if(|focus| *focus == Focus::Title).is_some() {
        // Asked for before the field is shown, so that a screen reader speaks the field's name.
        ui.memory_mut(|memory| memory.request_focus(title_id));
    }
    let mut field =
        |ui: &mut Ui, name: &str, hint: &str, text: &str, rows: usize, edit: fn(String) -> Edit| {
            let weak = Palette::get(ui).weak;
            let label = ui.label(egui::RichText::new(name).color(weak));
            let mut text = text.to_owned();
            let mut widget = if rows == 1 {
                TextEdit::singleline(&mut text).align(egui::Align2::LEFT_CENTER)
            } else {
                TextEdit::multiline(&mut text)
            };
            if name == w().title {
                widget = widget.id(title_id);
            }
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
        w().title,
        w().title_hint,
        &illustration.title,
        1,
        Edit::SetTitle,
    );
    field(
        ui,
        w().caption,
        w().caption_hint,
        &illustration.legend,
        4,
        Edit::SetLegend,
    );
    field(
        ui,
        w().credit,
        w().credit_hint,
        &illustration.credit,
        1,
        Edit::SetCredit,
    );
    let mut has_title = session.has_title;
    ui.horizontal_wrapped(|ui| {
        if ui.checkbox(&mut has_title, w().show_title).changed() {
            commands.push(Command::ToggleTitle);
        }
    });
    let mut is_lettering = session.is_lettering;
    ui.horizontal_wrapped(|ui| {
        if ui.checkbox(&mut is_lettering, w().lettering).changed() {
            commands.push(Command::ToggleLettering);
        }
    });
    ui.add_space(6.0);
    if let SubjectRef::Supplied {
        sha256,
        name,
        reading,
    } = &illustration.subject
    {
        let weak = Palette::get(ui).weak;
        let label = ui.label(egui::RichText::new(w().scan_name).color(weak));
        let mut text = name.clone();
        let widget = TextEdit::singleline(&mut text)
            .align(egui::Align2::LEFT_CENTER)
            .hint_text(w().scan_name_example)
            .desired_width(f32::INFINITY);
        if ui.add(widget).labelled_by(label.id).changed() {
            let subject = SubjectRef::Supplied {
                sha256: sha256.clone(),
                name: text,
                reading: reading.clone(),
            };
            commands.push(Command::Drag(Edit::SetSubject(subject)));
        }
        let hint = w().scan_stays;
        ui.add(Label::new(egui::RichText::new(hint).small().color(weak)).wrap());
    }
    if session.step() == 0 {
        captions::ui(ui, session, focus, commands);
    }
    controls::ui(ui, session, commands);
    if frames::row_ui(ui, session) {
        commands.push(Command::ToggleFrames);
    }
}
