//! The list of captions in the panel of texts.

use egui::{Align2, TextEdit, Ui, vec2};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::{Command, Focus, Session};
use crate::app::words::{captions::w, fill, steps};
use crate::document::{Caption, Edit};

/// Draws the list of captions, a row each, with buttons to add and to remove one.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    focus: &mut Option<Focus>,
    commands: &mut Vec<Command>,
) {
    let captions = &session.shown().captions;
    widget::heading(ui, w().heading, |ui| {
        let name = w().add;
        if widget::icon_button(ui, Icon::Plus, name, true).clicked() {
            commands.push(Command::ToggleCaptioning);
        }
    });
    if captions.is_empty() {
        let weak = Palette::get(ui).weak;
        let hint = egui::RichText::new(w().none).small().color(weak);
        ui.add(egui::Label::new(hint).wrap());
    }
    for (index, caption) in captions.iter().enumerate() {
        ui.push_id(("caption", index), |ui| {
            widget::row(ui, |ui| {
                let mut text = caption.text.clone();
                let id = egui::Id::unique(("text of caption", index));
                // Asked for before the field is shown, so that a screen reader speaks the field's name.
                let wants_focus = *focus == Some(Focus::Caption(index));
                if wants_focus {
                    *focus = None;
                    ui.memory_mut(|memory| memory.request_focus(id));
                    select_all(ui, id, &caption.text);
                }
                let edit = TextEdit::singleline(&mut text)
                    .id(id)
                    .align(Align2::LEFT_CENTER)
                    .min_size(vec2(0.0, theme::control_height()))
                    .desired_width(ui.available_width() - 2.0 * (theme::control_height() + 8.0));
                let response = ui.add(edit).named(fill(w().text_n, &[&(index + 1)]));
                if wants_focus {
                    response.scroll_to_me(None);
                }
                if response.changed() {
                    let value = Caption {
                        text,
                        ..caption.clone()
                    };
                    commands.push(Command::Drag(Edit::ReplaceCaption {
                        caption: index,
                        value,
                    }));
                }
                let (icon, show) = match caption.enabled {
                    true => (Icon::Eye, steps::w().hide_caption),
                    false => (Icon::EyeOff, steps::w().show_caption),
                };
                let show = format!("{show}: {}", caption.text);
                if widget::icon_button(ui, icon, &show, true).clicked() {
                    let value = Caption {
                        enabled: !caption.enabled,
                        ..caption.clone()
                    };
                    commands.push(Command::Apply(Edit::ReplaceCaption {
                        caption: index,
                        value,
                    }));
                }
                let remove = fill(w().remove, &[&caption.text]);
                if widget::icon_button(ui, Icon::Trash, &remove, true).clicked() {
                    commands.push(Command::Apply(Edit::RemoveCaption { caption: index }));
                }
            });
        });
    }
    words_ui(ui, session, commands);
    ui.add_space(6.0);
}

/// The texts of a drawing that are no captions yet, each a button that makes one of it.
fn words_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let captions = &session.shown().captions;
    let plate = session.view.figure.plate.as_ref();
    let words = plate.map_or(&[][..], |plate| &plate.words);
    let is_caption = |text: &str| captions.iter().any(|caption| caption.text == text);
    let mut left = words
        .iter()
        .filter(|word| !is_caption(&word.text))
        .peekable();
    if left.peek().is_none() {
        return;
    }
    widget::heading(ui, w().of_drawing, |_| {});
    let weak = Palette::get(ui).weak;
    let hint = egui::RichText::new(w().of_drawing_hint).small().color(weak);
    ui.add(egui::Label::new(hint).wrap());
    ui.horizontal_wrapped(|ui| {
        for word in left {
            let button = ui
                .button(&word.text)
                .named(fill(w().take_word, &[&word.text]));
            if button.clicked() {
                commands.push(Command::Apply(Edit::AddCaption(Caption {
                    at: word.at.extend(0.0),
                    text: word.text.clone(),
                    enabled: true,
                })));
            }
        }
    });
}

/// The next letter that is typed replaces the whole text.
fn select_all(ui: &Ui, id: egui::Id, text: &str) {
    let mut edit = egui::widgets::text_edit::TextEditState::load(ui.ctx(), id).unwrap_or_default();
    let end = egui::text::CCursor::new(text.chars().count());
    let all = egui::text::CCursorRange::two(egui::text::CCursor::new(0), end);
    edit.cursor.set_char_range(Some(all));
    edit.store(ui.ctx(), id);
}
