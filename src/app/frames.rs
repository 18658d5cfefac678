//! Which volume of a file that holds several: a small dialog with a slider, which opens by itself when such a file is
//! opened and from the text panel later. The first is shown at once, so that one chooses by looking.

use egui::{Align2, Area, Id, RichText, Slider, Ui, vec2};

use super::command::Command;
use super::control;
use super::icon::Icon;
use super::raw::RawDraft;
use super::state::State;
use super::theme::Palette;
use super::words::files::w;
use super::words::fill;
use crate::document::Reading;

/// What the subject's file leaves to choose.
#[derive(Clone, Debug, Default)]
pub(crate) struct FileChoice {
    /// Volumes in the file that is shown; 0 where that was not told.
    pub frame_count: u64,
    /// The dialog with the slider is open.
    pub is_open: bool,
    /// Where the slider is held, from 1, while it is dragged.
    held: Option<u64>,
    /// What a file of bare voxels was asked for.
    pub raw: Option<RawDraft>,
}

impl FileChoice {
    /// A file was loaded that holds so many volumes; `is_new` if the user just opened it.
    pub(crate) fn loaded(&mut self, frame_count: u64, is_new: bool) {
        self.frame_count = frame_count;
        self.is_open = frame_count > 1 && (is_new || self.is_open);
        self.held = None;
    }
}

impl State {
    /// A load brought a file whose hash the document waits for. True if the document wants another of its volumes.
    pub(crate) fn wants_other_frame(&self, loaded: &Reading) -> bool {
        self.illustration()
            .subject
            .reading()
            .is_some_and(|wanted| wanted != loaded)
    }
}

/// The row of the text panel that opens the dialog.
pub(crate) fn row_ui(ui: &mut Ui, state: &State) -> bool {
    let count = state.files.frame_count;
    let Some(reading) = state.illustration().subject.reading() else {
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
pub(crate) fn ui(ui: &Ui, state: &mut State, commands: &mut Vec<Command>) {
    if !state.files.is_open {
        return;
    }
    let subject = state.illustration().subject.clone();
    let Some(reading) = subject.reading().cloned() else {
        state.files.is_open = false;
        return;
    };
    let count = state.files.frame_count;
    let mut chosen = None;
    let content = ui.ctx().content_rect();
    let area = Area::new(Id::unique("frames"))
        .anchor(Align2::CENTER_TOP, vec2(0.0, 62.0))
        .constrain_to(content);
    area.show(ui.ctx(), |ui| {
        egui::Frame::window(ui.style()).show(ui, |ui| {
            ui.set_width((content.width() - 48.0).min(340.0));
            control::heading(ui, &fill(w().volumes, &[&count]), |ui| {
                if control::icon_button(ui, Icon::Close, w().close_volumes, true).clicked() {
                    state.files.is_open = false;
                }
            });
            let weak = Palette::get(ui).weak;
            ui.label(RichText::new(w().volumes_hint).small().color(weak));
            let shown = reading.frame + 1;
            let mut number = state.files.held.unwrap_or(shown);
            control::row(ui, |ui| {
                let label = ui.label(w().volume);
                ui.spacing_mut().slider_width = (ui.available_width() - 70.0).max(60.0);
                let slider = ui
                    .add(Slider::new(&mut number, 1..=count))
                    .labelled_by(label.id);
                // Loading waits for the hand to be lifted: a volume takes longer than a frame.
                if slider.dragged() {
                    state.files.held = Some(number);
                } else if number != shown {
                    state.files.held = None;
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
