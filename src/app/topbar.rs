//! The bar along the top: what is shown, undo, files, and the link.

use egui::{CornerRadius, Ui};

use super::command::Command;
use super::control::{self, capitalized};
use super::icon::Icon;
use super::state::{LONG_LINK, State};
use super::theme::{self, Palette};
use crate::document::SubjectRef;

/// What a subject is called in the interface.
pub(crate) fn subject_name(subject: &SubjectRef) -> String {
    let or = |name: &str, otherwise: &str| {
        if name.is_empty() {
            otherwise.to_owned()
        } else {
            name.to_owned()
        }
    };
    match subject {
        SubjectRef::Builtin { name } => capitalized(name),
        SubjectRef::Address { name, .. } => or(name, "Scan from an address"),
        SubjectRef::Supplied { name, .. } => or(name, "Own scan"),
    }
}

/// The bar. `is_narrow` leaves words out.
pub(crate) fn ui(ui: &mut Ui, state: &State, is_narrow: bool, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        if !is_narrow {
            ui.add(egui::Label::new(
                theme::strong("Fabrica").size(16.0).color(palette.text),
            ));
            ui.add_space(10.0);
        }
        subject_ui(ui, state, commands);
        if !is_narrow
            && control::labelled_button(ui, Icon::Folder, "Open", false, true)
                .on_hover_text("Open a scan (NIfTI) or a document. It stays on this machine.")
                .clicked()
        {
            commands.push(Command::Open);
        }
        ui.add_space(if is_narrow { 0.0 } else { 8.0 });
        let undo = state.history.undo_name().map(str::to_owned);
        let redo = state.history.redo_name().map(str::to_owned);
        let name = undo
            .as_ref()
            .map_or("Undo".to_owned(), |what| format!("Undo: {what}"));
        let response = control::icon_button(ui, Icon::Undo, &name, undo.is_some());
        if response.accessible_name("Undo").clicked() {
            commands.push(Command::Undo);
        }
        let name = redo
            .as_ref()
            .map_or("Redo".to_owned(), |what| format!("Redo: {what}"));
        let response = control::icon_button(ui, Icon::Redo, &name, redo.is_some());
        if response.accessible_name("Redo").clicked() {
            commands.push(Command::Redo);
        }

        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            more_menu(ui, state, is_narrow, commands);
            let is_copied = state.copied_at.is_some();
            let (icon, text) = match (is_copied, is_narrow) {
                (true, _) => (Icon::Check, "Copied"),
                (false, true) => (Icon::Link, "Link"),
                (false, false) => (Icon::Link, "Copy link"),
            };
            let button = control::labelled_button(ui, icon, text, true, true);
            let length = state.payload.len();
            let hint = format!("The link holds the whole illustration: {length} characters");
            if button
                .accessible_name("Copy link")
                .on_hover_text(hint)
                .clicked()
            {
                commands.push(Command::CopyLink);
            }
            if !is_narrow {
                link_length_ui(ui, length, commands);
            }
        });
    });
}

/// How long the link is, and what to do if it is long.
fn link_length_ui(ui: &mut Ui, length: usize, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    if length > LONG_LINK {
        let text = theme::strong(format!("{length} characters"))
            .size(12.0)
            .color(palette.warning);
        let advice = "Some programs cut links as long as this: better save the document as a file";
        if ui
            .add(egui::Button::new(text).frame(false))
            .on_hover_text(advice)
            .clicked()
        {
            commands.push(Command::SaveDocument);
        }
    } else {
        let text = egui::RichText::new(format!("{length} characters"))
            .size(12.0)
            .color(palette.weak);
        ui.label(text).on_hover_text("Length of the link");
    }
    ui.add_space(4.0);
}

/// Which subject: the built-in ones, and opening one's own.
fn subject_ui(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let current = &state.illustration().subject;
    let shown = control::combo("subject", &subject_name(current), 112.0).show_ui(ui, |ui| {
        for name in crate::subjects::names() {
            let subject = SubjectRef::Builtin {
                name: (*name).to_owned(),
            };
            if ui
                .selectable_label(*current == subject, capitalized(name))
                .clicked()
                && *current != subject
            {
                commands.push(Command::SetSubject(subject));
            }
        }
        ui.separator();
        if ui.button("Open a file…").clicked() {
            commands.push(Command::Open);
            ui.close();
        }
    });
    shown
        .response
        .accessible_name("Subject")
        .on_hover_text("What is shown");
}

fn more_menu(ui: &mut Ui, state: &State, is_narrow: bool, commands: &mut Vec<Command>) {
    let button = control::icon_button(ui, Icon::More, "More", true);
    egui::Popup::menu(&button).show(|ui| {
        ui.set_min_width(210.0);
        let mut item = |ui: &mut Ui, icon: Icon, text: &str, command: Command| {
            if menu_item(ui, icon, text) {
                commands.push(command);
                ui.close();
            }
        };
        if is_narrow {
            item(ui, Icon::Folder, "Open a file", Command::Open);
        }
        item(ui, Icon::Plus, "New document", Command::New);
        item(ui, Icon::Download, "Save document", Command::SaveDocument);
        item(ui, Icon::Picture, "Save picture", Command::SavePicture);
        ui.separator();
        item(ui, Icon::Eye, "Picture alone", Command::TogglePanels);
        item(ui, Icon::Contrast, "Light or dark", Command::ToggleTheme);
        item(ui, Icon::Plus, "Larger", Command::Scale(1.15));
        item(ui, Icon::Reset, "Smaller", Command::Scale(1.0 / 1.15));
        ui.separator();
        item(ui, Icon::Info, "Messages", Command::ToggleMessages);
        item(ui, Icon::Help, "Keys and gestures", Command::ToggleKeys);
        if is_narrow {
            ui.separator();
            let length = state.payload.len();
            let weak = Palette::get(ui).weak;
            ui.label(
                egui::RichText::new(format!("Link: {length} characters"))
                    .small()
                    .color(weak),
            );
        }
    });
}

/// A row of a menu with an icon. True if it was taken.
fn menu_item(ui: &mut Ui, icon: Icon, text: &str) -> bool {
    let palette = Palette::get(ui);
    let size = egui::vec2(ui.available_width(), 30.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), text));
    if response.hovered() {
        ui.painter()
            .rect_filled(rect, CornerRadius::same(5), palette.hover);
    }
    control::focus_ring(ui, &response, rect);
    let icon_rect = egui::Rect::from_center_size(
        rect.left_center() + egui::vec2(16.0, 0.0),
        egui::Vec2::splat(18.0),
    );
    icon.paint(ui.painter(), icon_rect, palette.weak);
    let at = rect.left_center() + egui::vec2(34.0, 0.0);
    let font = egui::TextStyle::Body.resolve(ui.style());
    ui.painter()
        .text(at, egui::Align2::LEFT_CENTER, text, font, palette.text);
    response.clicked()
}
