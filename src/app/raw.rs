//! A file of bare voxels is opened by saying how they lie: sizes, type, byte order, what to skip, voxel size. Filled in
//! from the file's name and length as far as they tell; what is said is kept in the document, so that the same file
//! opens by itself the next time.

use egui::{ComboBox, DragValue, Id, Modal, RichText, Ui};

use super::control;
use super::services::{RawQuestion, Services, Ticket};
use super::state::State;
use super::theme::Palette;
use super::words::files::w;
use super::words::fill;
use crate::document::{Edit, RawVoxels, Reading, SubjectRef};

/// What is being said of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RawDraft {
    /// The load that waits.
    ticket: Ticket,
    byte_len: Option<u64>,
    is_packed: bool,
    voxels: RawVoxels,
}

/// How the bytes that the voxels take compare with those that the file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fit {
    Exact,
    /// Bytes are left over.
    Over(u64),
    /// Bytes are missing.
    Under(u64),
    /// The file is packed, or its length is not known.
    Unknown,
    /// More than can be counted.
    TooLarge,
}

fn byte_count(voxels: &RawVoxels) -> Option<u64> {
    let bits = voxels
        .element
        .trim_start_matches(|c: char| !c.is_ascii_digit());
    let element = bits.parse::<u64>().ok()? / 8;
    voxels
        .size
        .iter()
        .try_fold(element, |n, &side| n.checked_mul(u64::from(side)))?
        .checked_add(voxels.skip_bytes)
}

fn fit(voxels: &RawVoxels, byte_len: Option<u64>, is_packed: bool) -> Fit {
    let Some(needed) = byte_count(voxels) else {
        return Fit::TooLarge;
    };
    match byte_len.filter(|_| !is_packed) {
        None => Fit::Unknown,
        Some(len) if len == needed => Fit::Exact,
        Some(len) if len > needed => Fit::Over(len - needed),
        Some(len) => Fit::Under(needed - len),
    }
}

impl State {
    /// A load asks how the voxels of its file lie. What the document says of its own file is taken without asking if it
    /// fits to the byte.
    pub(crate) fn ask_raw(&mut self, question: RawQuestion, services: &mut dyn Services) {
        let Some(ticket) = self.load.as_ref().map(|load| load.ticket) else {
            return;
        };
        let said = self
            .illustration()
            .subject
            .reading()
            .and_then(|reading| reading.raw.clone());
        let is_fitting =
            |voxels: &RawVoxels| fit(voxels, question.byte_len, question.is_packed) == Fit::Exact;
        if let Some(voxels) = said.clone().filter(is_fitting) {
            self.answer_raw(ticket, voxels, services);
            return;
        }
        let voxels = said.or(question.guess).unwrap_or(RawVoxels {
            size: [256, 256, 128],
            element: "int16",
            big_endian: false,
            spacing_mm: [1.0; 3],
            skip_bytes: 0,
        });
        self.files.raw = Some(RawDraft {
            ticket,
            byte_len: question.byte_len,
            is_packed: question.is_packed,
            voxels,
        });
    }

    fn answer_raw(&mut self, ticket: Ticket, voxels: RawVoxels, services: &mut dyn Services) {
        let reading = Reading {
            frame: 0,
            raw: Some(voxels.clone()),
        };
        match self.load.as_mut().filter(|load| load.ticket == ticket) {
            Some(load) if load.is_file => {
                load.reading = reading;
                services.answer_raw(ticket, &voxels);
            }
            // A file that the document names: what is said of it goes into the document, and it is loaded again.
            Some(_) => {
                let subject = self.illustration().subject.clone().with_reading(reading);
                if !matches!(subject, SubjectRef::Builtin { .. }) {
                    self.apply(&Edit::SetSubject(subject), false);
                    self.load_subject(services);
                }
            }
            None => {}
        }
    }
}

/// The dialog, if a load asks.
pub(crate) fn ui(ui: &Ui, state: &mut State, services: &mut dyn Services) {
    let is_waiting = |draft: &RawDraft| {
        let load = state.load.as_ref();
        load.is_some_and(|load| load.ticket == draft.ticket)
    };
    let Some(mut draft) = state.files.raw.take().filter(is_waiting) else {
        return;
    };
    let (mut is_opened, mut is_cancelled) = (false, false);
    let width = (ui.ctx().content_rect().width() - 48.0).min(380.0);
    let modal = Modal::new(Id::unique("raw"))
        .frame(egui::Frame::window(ui.style()))
        .show(ui.ctx(), |ui| {
            ui.set_width(width);
            control::heading(ui, w().bare, |_| {});
            let weak = Palette::get(ui).weak;
            ui.label(RichText::new(w().bare_hint).small().color(weak));
            ui.add_space(6.0);
            fields_ui(ui, &mut draft.voxels);
            ui.add_space(6.0);
            let fit = fit(&draft.voxels, draft.byte_len, draft.is_packed);
            let palette = Palette::get(ui);
            let (text, color) = match fit {
                Fit::Exact => (w().fits.to_owned(), palette.accent),
                Fit::Over(n) => (fill(w().over, &[&n]), palette.warning),
                Fit::Under(n) => (fill(w().under, &[&n]), palette.danger),
                Fit::Unknown => (w().packed.to_owned(), weak),
                Fit::TooLarge => (w().too_large.to_owned(), palette.danger),
            };
            ui.label(RichText::new(text).color(color));
            ui.add_space(6.0);
            control::row(ui, |ui| {
                let is_possible = !matches!(fit, Fit::Under(_) | Fit::TooLarge);
                is_opened = ui
                    .add_enabled(is_possible, egui::Button::new(w().open))
                    .clicked();
                is_cancelled = ui.button(w().cancel).clicked();
            });
        });
    is_cancelled |= modal.should_close() && !is_opened;
    if is_opened {
        state.answer_raw(draft.ticket, draft.voxels, services);
    } else if is_cancelled {
        services.cancel_load(draft.ticket);
    } else {
        state.files.raw = Some(draft);
    }
}

fn fields_ui(ui: &mut Ui, voxels: &mut RawVoxels) {
    let names = [w().width, w().height, w().depth];
    control::row(ui, |ui| {
        ui.label(w().voxels);
        for (side, name) in voxels.size.iter_mut().zip(names) {
            named(ui, name, |ui| {
                ui.add(DragValue::new(side).range(1..=65_536))
            });
        }
    });
    control::row(ui, |ui| {
        let label = ui.label(w().kind);
        let selected = voxels.element;
        ComboBox::from_id_salt("raw type")
            .selected_text(selected)
            .show_ui(ui, |ui| {
                for element in RawVoxels::ELEMENTS {
                    ui.selectable_value(&mut voxels.element, element, element);
                }
            })
            .response
            .labelled_by(label.id);
        ui.checkbox(&mut voxels.big_endian, w().high_byte_first);
    });
    control::row(ui, |ui| {
        let label = ui.label(w().skip);
        ui.add(DragValue::new(&mut voxels.skip_bytes).range(0..=1_u64 << 40))
            .labelled_by(label.id);
    });
    control::row(ui, |ui| {
        ui.label(w().voxel_size);
        for (edge, name) in voxels.spacing_mm.iter_mut().zip(names) {
            let value = DragValue::new(edge).range(1e-3..=1e3).speed(0.01);
            named(ui, &fill(w().edge, &[&name]), |ui| ui.add(value));
        }
    });
}

/// A control without a text of its own, named for screen readers and on hover.
fn named(ui: &mut Ui, name: &str, add: impl FnOnce(&mut Ui) -> egui::Response) {
    let response = add(ui).on_hover_text(name);
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_label(name.to_owned());
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_held_against_the_file() {
        let voxels = RawVoxels {
            size: [10, 20, 30],
            element: "int16",
            big_endian: false,
            spacing_mm: [1.0; 3],
            skip_bytes: 4,
        };
        assert_eq!(byte_count(&voxels), Some(12_004));
        assert_eq!(fit(&voxels, Some(12_004), false), Fit::Exact);
        assert_eq!(fit(&voxels, Some(12_005), false), Fit::Over(1));
        assert_eq!(fit(&voxels, Some(12_000), false), Fit::Under(4));
        assert_eq!(fit(&voxels, Some(12_000), true), Fit::Unknown);
        let huge = RawVoxels {
            size: [u32::MAX; 3],
            ..voxels
        };
        assert_eq!(fit(&huge, Some(1), false), Fit::TooLarge);
    }
}
