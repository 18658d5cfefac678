//! The bar along the top: what is shown, undo, files, and the link.

use egui::{CornerRadius, Ui};

use super::command::Command;
use super::control::{self, Named as _};
use super::icon::Icon;
use super::state::{LONG_LINK, State};
use super::theme::{self, Palette};
use super::words::bar::w;
use super::words::{self, Lang, fill, names};
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
        SubjectRef::Builtin { name } => names::subject(name),
        SubjectRef::Address { name, .. } => or(name, w().scan_from_address),
        SubjectRef::Supplied { name, .. } => or(name, w().own_scan),
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
            && control::labelled_button(ui, Icon::Folder, w().open, false, true)
                .on_hover_text(w().open_hint)
                .clicked()
        {
            commands.push(Command::Open);
        }
        ui.add_space(if is_narrow { 0.0 } else { 8.0 });
        let undo = state.history.undo_name().map(str::to_owned);
        let redo = state.history.redo_name().map(str::to_owned);
        let name = undo.as_ref().map_or_else(
            || w().undo.to_owned(),
            |what| fill(w().undo_what, &[&names::deed(what)]),
        );
        let response = control::icon_button(ui, Icon::Undo, &name, undo.is_some());
        if response.accessible_name(w().undo).clicked() {
            commands.push(Command::Undo);
        }
        let name = redo.as_ref().map_or_else(
            || w().redo.to_owned(),
            |what| fill(w().redo_what, &[&names::deed(what)]),
        );
        let response = control::icon_button(ui, Icon::Redo, &name, redo.is_some());
        if response.accessible_name(w().redo).clicked() {
            commands.push(Command::Redo);
        }

        ui.with_layout(control::against(), |ui| {
            more_menu(ui, state, is_narrow, commands);
            let is_copied = state.copied_at.is_some();
            let (icon, text) = match (is_copied, is_narrow) {
                (true, _) => (Icon::Check, w().copied),
                (false, true) => (Icon::Link, w().link),
                (false, false) => (Icon::Link, w().copy_link),
            };
            let button = control::labelled_button(ui, icon, text, true, true);
            let length = state.payload.len();
            let hint = fill(w().link_hint, &[&length]);
            if button
                .accessible_name(w().copy_link)
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
        let text = theme::strong(fill(w().characters, &[&length]))
            .size(12.0)
            .color(palette.warning);
        let advice = w().link_is_long;
        if ui
            .add(egui::Button::new(text).frame(false))
            .on_hover_text(advice)
            .clicked()
        {
            commands.push(Command::SaveDocument);
        }
    } else {
        let text = egui::RichText::new(fill(w().characters, &[&length]))
            .size(12.0)
            .color(palette.weak);
        ui.label(text).on_hover_text(w().link_length);
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
                .selectable_label(*current == subject, names::subject(name))
                .clicked()
                && *current != subject
            {
                commands.push(Command::SetSubject(subject));
            }
        }
        ui.separator();
        if ui.button(w().open_file_more).clicked() {
            commands.push(Command::Open);
            ui.close();
        }
    });
    shown
        .response
        .named(w().subject)
        .on_hover_text(w().subject_hint);
}

fn more_menu(ui: &mut Ui, state: &State, is_narrow: bool, commands: &mut Vec<Command>) {
    let button = control::icon_button(ui, Icon::More, w().more, true);
    egui::Popup::menu(&button).show(|ui| {
        ui.set_min_width(264.0);
        let mut item = |ui: &mut Ui, icon: Icon, text: &str, command: Command| {
            if menu_item(ui, icon, text) {
                commands.push(command);
                ui.close();
            }
        };
        if is_narrow {
            item(ui, Icon::Folder, w().open_file, Command::Open);
        }
        item(ui, Icon::Plus, w().new_document, Command::New);
        item(ui, Icon::Download, w().save_document, Command::SaveDocument);
        item(ui, Icon::Picture, w().save_picture, Command::SavePicture);
        ui.separator();
        item(ui, Icon::Eye, w().picture_alone, Command::TogglePanels);
        item(ui, Icon::Contrast, w().theme, Command::ToggleTheme);
        let contrast = if theme::has_contrast() {
            w().usual_contrast
        } else {
            w().high_contrast
        };
        item(ui, Icon::Look, contrast, Command::ToggleContrast);
        item(ui, Icon::Plus, w().larger, Command::Scale(1.15));
        item(ui, Icon::Reset, w().smaller, Command::Scale(1.0 / 1.15));
        ui.separator();
        ui.label(
            egui::RichText::new(w().language)
                .small()
                .color(Palette::get(ui).weak),
        );
        let languages = Lang::OFFERED.map(|lang| {
            let name = lang.own_name();
            let is_drawn = theme::can_draw(ui, name);
            (lang, if is_drawn { name } else { lang.plain_name() })
        });
        if let Some(lang) = control::segmented(ui, w().language, &languages, words::lang()) {
            commands.push(Command::Speak(lang));
        }
        ui.separator();
        let mut item = |ui: &mut Ui, icon: Icon, text: &str, command: Command| {
            if menu_item(ui, icon, text) {
                commands.push(command);
                ui.close();
            }
        };
        item(ui, Icon::Info, w().messages, Command::ToggleMessages);
        item(ui, Icon::Help, w().keys, Command::ToggleKeys);
        if is_narrow {
            ui.separator();
            let length = state.payload.len();
            let weak = Palette::get(ui).weak;
            ui.label(
                egui::RichText::new(fill(w().link_of, &[&length]))
                    .small()
                    .color(weak),
            );
        }
    });
}

/// A row of a menu with an icon. True if it was taken.
pub(crate) fn menu_item(ui: &mut Ui, icon: Icon, text: &str) -> bool {
    let palette = Palette::get(ui);
    let size = egui::vec2(ui.available_width(), theme::control_height().max(30.0));
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
    icon.paint(ui.painter(), control::sided(rect, icon_rect), palette.weak);
    let font = egui::TextStyle::Body.resolve(ui.style());
    control::line_text(ui.painter(), rect, 34.0, text, font, palette.text);
    response.clicked()
}
