//! What the shell hands in: files, loads piece by piece, answers to what was asked of it.

use std::sync::Arc;

use super::App;
use super::making::OnClipboard;
use super::services::{LabelsExpected, LoadEvent, Message};
use super::state::{self, Gravity};
use super::words::{self, fill};
use crate::data::{Statistics, VolumeBuilder, VolumeSink as _};
use crate::document::{SegmentsRef, SubjectRef};

impl App {
    pub(super) fn take_messages(&mut self) {
        for message in self.services.poll() {
            match message {
                Message::OpenText { text } => self.state.open_text(&text, self.services.as_mut()),
                Message::FileStarted { ticket } => self.state.file_started(ticket),
                Message::AskHost { ticket, host } => {
                    if let Some(load) = self
                        .state
                        .load
                        .as_mut()
                        .filter(|load| load.ticket == ticket)
                    {
                        load.host = Some(host);
                    }
                }
                Message::Load { ticket, event } => {
                    // What still comes from an earlier load is dropped.
                    if self
                        .state
                        .load
                        .as_ref()
                        .is_some_and(|load| load.ticket == ticket)
                    {
                        self.take_load_event(event);
                    }
                }
                Message::Field { key, outcome } => self.take_field(key, *outcome),
                Message::Pasted(text) => self.state.take_pasted(text, self.services.as_mut()),
                Message::Copied(Ok(())) if self.state.making.on_clipboard != OnClipboard::Link => {
                    if let OnClipboard::Templates(number) = self.state.making.on_clipboard {
                        let text = fill(words::making::w().on_clipboard, &[&number]);
                        self.state.say(Gravity::Success, text, "");
                    }
                }
                Message::Copied(Ok(())) => {
                    self.state.copied_at = Some(self.state.now);
                    self.state
                        .say(Gravity::Success, words::said::w().link_on_clipboard, "");
                    let length = self.state.payload.len();
                    if length > state::LONG_LINK {
                        let text = fill(words::said::w().link_long, &[&length]);
                        self.state.say(Gravity::Warning, text, "");
                    }
                }
                Message::Copied(Err(error)) => {
                    self.state
                        .say(Gravity::Error, words::said::w().clipboard_refused, error);
                }
                Message::Saved(Ok(name)) => {
                    self.state
                        .say(Gravity::Success, fill(words::said::w().saved, &[&name]), "")
                }
                Message::Saved(Err(error)) if error.is_empty() => {}
                Message::Saved(Err(error)) => {
                    self.state
                        .say(Gravity::Error, words::said::w().not_saved, error)
                }
                Message::Notice { message, details } => {
                    self.state.say(Gravity::Warning, message, details)
                }
                // For who writes shaders, and so in English, as the compiler's words are.
                #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
                Message::ShadersChanged => {
                    match self
                        .picture
                        .as_mut()
                        .map(|picture| picture.reload_shaders())
                    {
                        Some(Err(error)) => {
                            let text = "A shader does not compile; the last good ones stay";
                            self.state.say(Gravity::Error, text, error.to_string());
                        }
                        Some(Ok(())) => self.state.say(Gravity::Success, "Shaders reloaded", ""),
                        None => {}
                    }
                }
            }
        }
    }

    fn take_load_event(&mut self, event: LoadEvent) {
        match event {
            LoadEvent::Begin(header) => {
                let mut builder = VolumeBuilder::new();
                match builder.begin(&header) {
                    Ok(()) => {
                        self.incoming = Some(builder);
                        self.statistics = Statistics::new();
                    }
                    Err(why) => self.refuse(words::said::w().cannot_be_held, why),
                }
            }
            LoadEvent::Scalars(scalars) => {
                if let Some(builder) = &mut self.incoming {
                    self.statistics.add(&scalars);
                    builder.scalars(scalars);
                }
            }
            LoadEvent::Labels(labels) => {
                if let Some(builder) = &mut self.incoming {
                    builder.labels(labels);
                }
            }
            LoadEvent::Progress { fraction, what } => {
                if let Some(load) = &mut self.state.load {
                    load.fraction = fraction;
                    load.what = what;
                }
            }
            LoadEvent::Coarse => self.show_incoming(),
            LoadEvent::Frames { count } => {
                if let Some(load) = &mut self.state.load {
                    load.frame_count = count;
                }
            }
            LoadEvent::AskRaw(question) => self.state.ask_raw(question, self.services.as_mut()),
            LoadEvent::LabelFile { sha256, labels } => {
                self.incoming_labels.push((sha256, *labels));
            }
            LoadEvent::Done { sha256 } => {
                self.show_incoming();
                let is_file = self.state.load.as_ref().is_some_and(|load| load.is_file);
                self.state.load_done(sha256, self.services.as_mut());
                self.take_labels(is_file);
            }
            LoadEvent::Notice(text) => self.state.say(Gravity::Warning, text, ""),
            LoadEvent::Failed { message, details } => self.refuse(&message, details),
            LoadEvent::Cancelled => {
                self.incoming = None;
                self.state.load_ended();
                self.state
                    .say(Gravity::Info, words::said::w().loading_stopped, "");
            }
        }
    }

    /// Goes on with the segments that are being made, and shows them when they are there.
    pub(super) fn advance_tissue(&mut self, ui: &egui::Ui) {
        let is_dragging = ui.input(|i| i.pointer.any_down());
        self.look_after_labels();
        let made = self.tissue.advance(self.state.shown(), is_dragging);
        if self.tissue.is_behind(self.state.shown()) {
            ui.ctx().request_repaint();
        }
        self.state.tissues.progress = self.tissue.progress();
        let Some(made) = made else {
            return;
        };
        self.state.tissues.counts.clone_from(&self.tissue.counts);
        for notice in made.notices {
            self.state.say(Gravity::Warning, notice, "");
        }
        let segments = made.labels.as_ref().map_or(&[][..], |l| &l.segments);
        self.state.view.set_segments(segments);
        self.state.revision += 1;
        let shown = self
            .picture
            .as_mut()
            .map(|picture| picture.set_labels(made.labels));
        if let Some(Err(error)) = shown {
            let text = words::said::w().does_not_fit;
            self.state.say(Gravity::Error, text, error.to_string());
        }
    }

    /// Tells the shell which label volumes the document names, and the reader which of them nobody has opened.
    fn look_after_labels(&mut self) {
        let illustration = self.state.illustration();
        let named = &illustration.segments;
        let is_file = !matches!(illustration.subject, SubjectRef::Builtin { .. });
        let expected = LabelsExpected {
            sha256: named.iter().filter_map(|s| s.sha256.clone()).collect(),
            has_scan: is_file && self.state.view.subject.is_some(),
        };
        if expected != self.labels_expected {
            self.services.expect_labels(&expected);
            self.labels_expected = expected;
        }
        let is_here = self.state.load.is_none() && self.state.view.subject.is_some();
        if is_here && self.has_said_labels != *named {
            self.has_said_labels.clone_from(named);
            let text = words::tissue::w().labels_wanted;
            if is_file && self.tissue.lacks_files(self.state.illustration()) {
                // It stays until it is not true any more.
                self.state.say(Gravity::Error, text, "");
            } else {
                self.state.unsay(text);
            }
        }
    }

    /// Label volumes that came with the load that is done: the document names them from now on.
    fn take_labels(&mut self, is_file: bool) {
        for (sha256, labels) in std::mem::take(&mut self.incoming_labels) {
            let names: Vec<&str> = labels.segments.iter().map(|s| s.name.as_str()).collect();
            let names = names.join(", ");
            self.tissue.add_file(sha256.clone(), labels);
            let is_new = |named: &SegmentsRef| named.sha256.as_ref() != Some(&sha256);
            if is_file && self.state.illustration().segments.iter().all(is_new) {
                self.state.add_label_file(&sha256);
                let text = fill(words::tissue::w().labels_taken, &[&names]);
                self.state.say(Gravity::Success, text, "");
            }
        }
        self.has_said_labels.clear();
    }

    /// There will be no volume of this load.
    fn refuse(&mut self, message: &str, details: String) {
        self.incoming = None;
        self.incoming_labels.clear();
        if let Some(load) = &self.state.load {
            self.services.cancel_load(load.ticket);
        }
        self.state.load_ended();
        self.state.say(Gravity::Error, message, details);
        self.state.load_failure = self.state.said.last().map(|said| said.id);
    }

    /// What has come is whole: it is shown.
    fn show_incoming(&mut self) {
        let Some(builder) = self.incoming.take() else {
            return;
        };
        match builder.finish() {
            Ok(volume) => {
                let histogram = self.statistics.histogram(volume.slope, volume.intercept);
                self.transfer.set_histogram(histogram);
                self.state.view.set_subject(&volume);
                self.fields.set_subject(volume.grid);
                let volume = Arc::new(volume);
                let spacing = volume.grid.spacing_mm();
                self.state.tissues.voxel_cm3 = spacing.element_product() / 1000.0;
                self.tissue.set_volume(Arc::clone(&volume));
                let shown = self
                    .picture
                    .as_mut()
                    .map(|picture| picture.set_subject(volume));
                if let Some(Err(error)) = shown {
                    self.refuse(words::said::w().does_not_fit, error.to_string());
                }
            }
            Err(error) => self.refuse(words::said::w().incomplete, error.to_string()),
        }
    }
}
