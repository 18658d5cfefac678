//! Title, caption, credit: what stands with the picture.

use egui::{FontId, Label, Rect, TextEdit, Ui, UiBuilder, Vec2, vec2};

use super::command::Command;
use super::control;
use super::floating;
use super::frames;
use super::icon::Icon;
use super::labels;
use super::state::State;
use super::theme::{self, Palette};
use super::words::picture;
use super::words::text::w;
use crate::document::{Edit, SubjectRef};

/// The panel.
pub(crate) fn ui(ui: &mut Ui, state: &mut State, commands: &mut Vec<Command>) {
    let illustration = state.illustration().clone();
    control::heading(ui, w().heading, |_| {});
    let mut field =
        |ui: &mut Ui, name: &str, hint: &str, text: &str, rows: usize, edit: fn(String) -> Edit| {
            let weak = Palette::get(ui).weak;
            let label = ui.label(egui::RichText::new(name).color(weak));
            let mut text = text.to_owned();
            let widget = if rows == 1 {
                TextEdit::singleline(&mut text).align(egui::Align2::LEFT_CENTER)
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
        &illustration.caption,
        4,
        Edit::SetCaption,
    );
    field(
        ui,
        w().credit,
        w().credit_hint,
        &illustration.credit,
        1,
        Edit::SetCredit,
    );
    let mut is_lettering = state.is_lettering;
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
    labels::panel_ui(ui, state, commands);
    if frames::row_ui(ui, state) {
        commands.push(Command::ToggleFrames);
    }
}

/// Title, caption and credit over the picture when it is shown alone, and the way back to the panels.
pub(crate) fn over_picture_ui(ui: &mut Ui, rect: Rect, state: &State, commands: &mut Vec<Command>) {
    let button = Rect::from_min_size(rect.right_top() + vec2(-46.0, 12.0), Vec2::splat(34.0));
    let button = control::sided(rect, button);
    floating::float_frame(ui, button);
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt("panels")
            .max_rect(button.shrink(3.0)),
    );
    if control::icon_button(&mut inner, Icon::Close, picture::w().show_panels, true).clicked() {
        commands.push(Command::TogglePanels);
    }
    let illustration = state.illustration();
    let texts = [
        (&illustration.title, theme::strong_font(20.0)),
        (&illustration.caption, FontId::proportional(15.0)),
        (&illustration.credit, FontId::proportional(12.0)),
    ];
    if texts.iter().all(|(text, _)| text.is_empty()) {
        return;
    }
    let palette = Palette::get(ui);
    let width = (rect.width() - 200.0).clamp(200.0, 640.0);
    let galleys: Vec<_> = texts
        .into_iter()
        .filter(|(text, _)| !text.is_empty())
        .map(|(text, font)| ui.painter().layout(text.clone(), font, palette.text, width))
        .collect();
    let height: f32 = galleys.iter().map(|galley| galley.size().y + 4.0).sum();
    let widest = galleys
        .iter()
        .map(|galley| galley.size().x)
        .fold(0.0, f32::max);
    let mut at = rect.center_bottom() - vec2(0.5 * widest, height + 26.0);
    let frame = Rect::from_min_size(at, vec2(widest, height)).expand2(vec2(14.0, 8.0));
    floating::float_frame(ui, frame);
    for galley in galleys {
        let step = galley.size().y + 4.0;
        ui.painter().galley(at, galley, palette.text);
        at.y += step;
    }
}
