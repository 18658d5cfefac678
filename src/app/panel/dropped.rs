//! Asks what a mesh file is to be that was opened while a subject is shown.

use egui::{Label, RichText, Ui};

use crate::app::kit::dialog;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::app::session::{Command, MeshUse, Session};
use crate::app::words::objects::w;

/// The dialog, while there is something to ask.
pub(crate) fn ui(ui: &Ui, session: &Session, commands: &mut Vec<Command>) {
    if !session.is_asking_about_mesh() {
        return;
    }
    let names = (w().what_is_it, w().leave_it);
    let is_closed = dialog::is_closed(ui, "dropped mesh", names, 380.0, |ui| {
        let answers = [
            (
                MeshUse::Subject,
                Icon::Cube,
                w().as_subject,
                w().as_subject_hint,
                true,
            ),
            (
                MeshUse::Part,
                Icon::Layers,
                w().as_part,
                w().as_part_hint,
                session.can_take_mesh(),
            ),
            (
                MeshUse::Object,
                Icon::Plus,
                w().as_object,
                w().as_object_hint,
                session.can_take_object(),
            ),
            (
                MeshUse::Tool,
                Icon::Brush,
                w().as_tool,
                w().as_tool_hint,
                session.can_take_tool(),
            ),
        ];
        // Room for the ring around what has the keyboard.
        ui.add_space(3.0);
        let shown = answers
            .into_iter()
            .filter(|answer| answer.0 != MeshUse::Tool || !session.view.is_figure());
        for (answer, icon, text, hint, is_possible) in shown {
            let button = widget::labelled_button(ui, icon, text, false, is_possible);
            // The keyboard begins at the first answer.
            if answer == MeshUse::Subject && ui.memory(|memory| memory.focused().is_none()) {
                button.request_focus();
            }
            if button.clicked() {
                commands.push(Command::UseMesh(answer));
            }
            let weak = Palette::get(ui).weak;
            ui.add(Label::new(RichText::new(hint).small().color(weak)).wrap());
            ui.add_space(8.0);
        }
    });
    if is_closed {
        commands.push(Command::UseMesh(MeshUse::Nothing));
    }
}
