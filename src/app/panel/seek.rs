//! The search over tissues and captions, in the panel of tissues: what it finds is turned to.

use egui::{Label, RichText, Ui, vec2};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{Palette, control_height};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::{Command, Session, Sought, TissueCommand};
use crate::app::words::tissue::w;
use crate::app::words::{fill, in_sentence};

/// The field; Enter turns to the first that is found.
pub(super) fn field_ui(
    ui: &mut Ui,
    session: &Session,
    wants_focus: bool,
    commands: &mut Vec<Command>,
) {
    let mut text = session.tissues.search.clone();
    let id = egui::Id::unique("search of tissues");
    let search = |text: String| Command::Tissue(TissueCommand::Search(text));
    widget::row(ui, |ui| {
        let has_text = !text.is_empty();
        let width = ui.available_width() - if has_text { 34.0 } else { 0.0 };
        let edit = egui::TextEdit::singleline(&mut text)
            .hint_text(w().search_hint)
            .desired_width(width)
            .min_size(vec2(0.0, control_height()))
            .align(egui::Align2::LEFT_CENTER)
            .char_limit(60)
            .id(id);
        // Asked for before the field is shown: the field then takes letters typed in this very frame, and tells its
        // name.
        if wants_focus {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let response = ui.add(edit).named(w().search);
        if response.changed() {
            commands.push(search(text));
        }
        // In a slow frame the keyboard comes and goes again.
        let has_left = response.lost_focus() || (wants_focus && !response.has_focus());
        if has_left && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
            commands.push(Command::SeekFirst);
        }
        if has_text && widget::icon_button(ui, Icon::Close, w().clear_search, true).clicked() {
            commands.push(search(String::new()));
        }
    });
}

/// The captions among what was found, a row each, and a sentence where nothing was.
pub(super) fn captions_ui(
    ui: &mut Ui,
    session: &Session,
    found: &[Sought],
    commands: &mut Vec<Command>,
) {
    if found.is_empty() {
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(RichText::new(w().found_nothing).color(weak)).wrap());
    }
    for sought in found {
        let Sought::Caption(index) = sought else {
            continue;
        };
        let Some(caption) = session.shown().captions.get(*index) else {
            continue;
        };
        let text = caption.text.trim();
        ui.push_id(("caption that was found", index), |ui| {
            let hint = fill(w().turn_to, &[&in_sentence(text)]);
            let row = widget::labelled_button(ui, Icon::Text, text, false, true);
            if row.on_hover_text(hint).clicked() {
                commands.push(Command::Seek(sought.clone()));
            }
        });
    }
}
