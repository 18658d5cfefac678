//! Opening files of bare voxels: whether the user has to be asked how they lie, and what the answer does.

use super::effect::Effect;
use super::files::{Fit, RawCommand, RawDraft, fit};
use super::session::Session;
use super::ticket::Ticket;
use crate::assets::RawQuestion;
use crate::document::{Edit, RawVoxels, Reading};

impl Session {
    /// A load asks how the voxels of its file lie. An answer that the document has for its own file is taken without
    /// asking if it fits to the byte.
    pub fn ask_raw(&mut self, question: RawQuestion) {
        let Some(ticket) = self.load.as_ref().map(|load| load.ticket) else {
            return;
        };
        let reading = self.illustration().subject.reading();
        let written = reading.and_then(|reading| reading.raw.clone());
        let is_fitting =
            |voxels: &RawVoxels| fit(voxels, question.byte_len, question.is_packed) == Fit::Exact;
        if let Some(voxels) = written.clone().filter(is_fitting) {
            self.answer_raw(ticket, voxels);
            return;
        }
        let voxels = written.or(question.guess).unwrap_or(RawVoxels {
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

    pub(super) fn run_raw(&mut self, command: RawCommand) {
        if self.raw_draft().is_none() {
            return;
        }
        match command {
            RawCommand::Change(voxels) => {
                if let Some(draft) = &mut self.files.raw {
                    draft.voxels = voxels;
                }
            }
            RawCommand::Open => {
                if let Some(draft) = self.files.raw.take() {
                    self.answer_raw(draft.ticket, draft.voxels);
                }
            }
            RawCommand::Cancel => {
                if let Some(draft) = self.files.raw.take() {
                    self.effect(Effect::CancelLoad(draft.ticket));
                }
            }
        }
    }

    fn answer_raw(&mut self, ticket: Ticket, voxels: RawVoxels) {
        let reading = Reading {
            frame: 0,
            raw: Some(voxels.clone()),
            ..Reading::default()
        };
        match self.load.as_mut().filter(|load| load.ticket == ticket) {
            Some(load) if load.is_file() => {
                load.reading = reading;
                self.effect(Effect::AnswerRaw(ticket, voxels));
            }
            // A file that the document names: the answer goes into the document, and the file is loaded again.
            Some(_) => {
                let subject = self.illustration().subject.clone().with_reading(reading);
                if !subject.is_made() {
                    self.apply(&Edit::SetSubject(subject), false);
                    self.load_subject();
                }
            }
            None => {}
        }
    }
}
