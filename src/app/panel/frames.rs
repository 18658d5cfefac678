//! Which volume of a file that holds several: a small dialog with a slider, which opens by itself when such a file is
//! opened and from the text panel later. The first is shown at once, so that one chooses by looking.

use egui::{Align2, Area, Id, RichText, Slider, Ui, vec2};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::app::session::Command;
use crate::app::session::Session;
use crate::app::words::files::w;
use crate::app::words::fill;
use crate::document::Reading;

/// The row of the text panel that opens the dialog.
pub(crate) fn row_ui(ui: &mut Ui, session: &Session) -> bool {
    let count = session.files.frame_count;
    let Some(reading) = session.illustration().subject.reading() else {
        return false;
    };
    if count < 2 {
        return false;
    }
    ui.add_space(4.0);
    ui.button(fill(w().volume_of, &[&(reading.frame + 1), &count]))
        .clicked()
}

/// The dialog, over the top of the picture, so that the picture stays in view.
pub(crate) fn ui(ui: &Ui, session: &Session, commands: &mut Vec<Command>) {
    if !session.files.is_open {
        return;
    }
    let subject = session.illustration().subject.clone();
    let Some(reading) = subject.reading().cloned() else {
        commands.push(Command::ToggleFrames);
        return;
    };
    let count = session.files.frame_count;
    let mut chosen = None;
    let content = ui.ctx().content_rect();
    let area = Area::new(Id::unique("frames"))
        .anchor(Align2::CENTER_TOP, vec2(0.0, 62.0))
        .constrain_to(content);
    area.show(ui.ctx(), |ui| {
        egui::Frame::window(ui.style()).show(ui, |ui| {
            ui.set_width((content.width() - 48.0).min(340.0));
            widget::heading(ui, &fill(w().volumes, &[&count]), |ui| {
                if widget::icon_button(ui, Icon::Close, w().close_volumes, true).clicked() {
                    commands.push(Command::ToggleFrames);
                }
            });
            let weak = Palette::get(ui).weak;
            ui.label(RichText::new(w().volumes_hint).small().color(weak));
            let shown = reading.frame + 1;
            let held = Id::unique("frame that is held");
            let mut number = ui.data(|data| data.get_temp(held)).unwrap_or(shown);
            widget::row(ui, |ui| {
                let label = ui.label(w().volume);
                ui.spacing_mut().slider_width = (ui.available_width() - 70.0).max(60.0);
                let slider = ui
                    .add(Slider::new(&mut number, 1..=count))
                    .labelled_by(label.id);
                // Loading waits for the hand to be lifted: a volume takes longer than a frame.
                if slider.dragged() {
                    ui.data_mut(|data| data.insert_temp(held, number));
                } else if number != shown {
                    ui.data_mut(|data| data.remove::<u64>(held));
                    chosen = Some(number - 1);
                }
            });
        });
    });
    if let Some(frame) = chosen {
        commands.push(Command::SetSubject(
            subject.with_reading(Reading { frame, ..reading }),
        ));
    }
}
