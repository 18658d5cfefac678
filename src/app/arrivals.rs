//! Takes in everything that the shell hands over: opened files, loads piece by piece, answers to requests.

use std::sync::Arc;

use crate::app::picture::host::Picture;
use crate::app::services::{Message, SavedTo};
use crate::app::session::{Gravity, Load, LoadOf, Shipped, Taken};
use crate::app::window::App;
use crate::app::words::{self, fill};
use crate::assets::{Data, LoadEvent, Role, SegmentationsExpected, Want};
use crate::data::{Subject, SubjectBuilder, SubjectSink as _};
use crate::document::{SegmentsRef, SubjectRef};

impl App {
    pub(crate) fn take_messages(&mut self) {
        for message in self.services.poll() {
            match message {
                Message::OpenText { text } => self.session.open_text(&text),
                Message::FileStarted { ticket } => self.session.file_started(ticket),
                Message::AskHost { ticket, host } => {
                    if let Some(load) = self
                        .session
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
                        .session
                        .load
                        .as_ref()
                        .is_some_and(|load| load.ticket == ticket)
                    {
                        self.take_load_event(event);
                    }
                }
                Message::Field { want, outcome } => self.take_field(want, *outcome),
                Message::AskFieldHost { want, host } => {
                    self.session.ask_for_fields(&host);
                    self.fields_elsewhere.push((host, want));
                }
                Message::Bent(answer) => self.bending.take(answer),
                Message::Shipped { file, outcome } => match (file, outcome) {
                    (Shipped::Examples, outcome) => {
                        let outcome = outcome.as_deref().map_err(Clone::clone);
                        self.session.library.take_list(outcome);
                    }
                    (Shipped::ExamplePictures, Ok(png)) => self.example_pictures.take(png),
                    // The cards say enough without pictures.
                    (Shipped::ExamplePictures, Err(_)) => {}
                },
                Message::Pasted(text) => self.session.take_pasted(text),
                Message::Copied(outcome) => self.session.copied(outcome),
                Message::Saved(Ok(place)) => {
                    let text = words::messages::w();
                    let line = match place {
                        SavedTo::Downloads(name) => fill(text.saved_in_downloads, &[&name]),
                        SavedTo::Path(path) => fill(text.saved, &[&path.display()]),
                    };
                    self.session.notify(Gravity::Success, line, "");
                }
                Message::Saved(Err(error)) if error.is_empty() => {}
                Message::Saved(Err(error)) => {
                    self.session
                        .notify(Gravity::Error, words::messages::w().not_saved, error)
                }
                Message::Notice { message, details } => {
                    self.session.notify(Gravity::Warning, message, details)
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
                            self.session.notify(Gravity::Error, text, error.to_string());
                        }
                        Some(Ok(())) => {
                            self.session
                                .notify(Gravity::Success, "Shaders reloaded", "")
                        }
                        None => {}
                    }
                }
            }
        }
        if self.opened != self.session.opened {
            self.opened = self.session.opened;
            self.assets.forget_addresses();
            self.fields_asked.clear();
            self.fields_elsewhere.clear();
        }
    }

    fn take_load_event(&mut self, event: LoadEvent) {
        match event {
            LoadEvent::Part(part) => {
                if let Err(why) = self.incoming.take(part) {
                    self.refuse(words::messages::w().cannot_be_held, why);
                }
            }
            LoadEvent::Progress { fraction, what } => {
                self.session.hear_progress(fraction, what);
            }
            // Of a scan nothing can be taken over.
            LoadEvent::Coarse if self.is_reference() => {}
            LoadEvent::Coarse => {
                self.show_incoming();
                if let Some(load) = &mut self.session.load {
                    load.is_coarse = true;
                }
            }
            // Files go to whoever asked for them.
            LoadEvent::Written(_) => {}
            LoadEvent::Frames { count } => {
                if let Some(load) = &mut self.session.load {
                    load.frame_count = count;
                }
            }
            LoadEvent::Modality(code) => {
                if let Some(load) = &mut self.session.load {
                    load.modality = Some(code);
                }
            }
            LoadEvent::AskRaw(question) => self.session.ask_raw(question),
            LoadEvent::LabelFile(file) => self.incoming_labels.push(*file),
            LoadEvent::Done { sha256 } => {
                if self.is_reference() {
                    return self.end_reference();
                }
                let load = self.session.load.clone();
                let other = load
                    .as_ref()
                    .zip(sha256.as_ref())
                    .and_then(|(load, found)| self.session.other_file(load, found));
                if let Some(other) = other {
                    let text = words::messages::w();
                    let hashes = [&other.wanted, &other.found];
                    let details = fill(text.other_file_details, &[hashes[0], hashes[1]]);
                    return self.refuse(text.wrong_file, details);
                }
                if self.takes_mesh(sha256.as_deref()) {
                    return self.session.load_ended();
                }
                if sha256
                    .as_ref()
                    .is_some_and(|sha256| self.holds_back(sha256))
                {
                    return;
                }
                self.end_load(sha256);
            }
            LoadEvent::Notice(text) => self.session.notify(Gravity::Warning, text, ""),
            LoadEvent::Failed {
                message,
                details,
                fault,
            } => match fault {
                Some(fault) => {
                    let details = [message, details].join("\n");
                    self.refuse(&words::faults::text(&fault), details.trim_end().to_owned());
                }
                None => self.refuse(&message, details),
            },
            LoadEvent::Cancelled => {
                self.drop_incoming();
                self.session.load_ended();
                self.session
                    .notify(Gravity::Info, words::messages::w().loading_stopped, "");
            }
        }
    }

    fn is_reference(&self) -> bool {
        let load = self.session.load.as_ref();
        load.is_some_and(|load| load.of == LoadOf::Reference)
    }

    /// A picture has come of which places are to be taken over.
    fn end_reference(&mut self) {
        let whole = std::mem::take(&mut self.incoming).finish();
        self.drop_incoming();
        self.session.load_ended();
        let subject = whole.and_then(Result::ok).map(|(subject, _)| subject);
        match subject.as_ref().and_then(Subject::plate) {
            Some(plate) => self.session.set_reference(Arc::clone(plate)),
            None => {
                let text = words::figure::w().no_picture;
                self.session.notify(Gravity::Error, text, "");
            }
        }
    }

    /// Shows what a load brought that is done, and makes it the document's if it is a file that the reader opened.
    pub(crate) fn end_load(&mut self, sha256: Option<String>) {
        let load = self.session.load.clone();
        self.show_incoming();
        let is_step = self.session.load_done(sha256);
        self.session.tell_figure();
        self.session.tell_space();
        if let Some(load) = load {
            self.take_segmentations(&load.of, is_step);
        }
    }

    /// Goes on with the segments that are being made, and shows them when they are there.
    pub(crate) fn advance_tissue(&mut self, ui: &egui::Ui) {
        let is_dragging = ui.input(|i| i.pointer.any_down());
        self.look_after_files_beside();
        self.tissue.set_edited(self.session.tissues.open.is_some());
        let shown = self.session.shown();
        let made = self
            .tissue
            .advance(&self.assets, &self.resources, shown, is_dragging);
        let shown = self.session.shown();
        let is_behind = self.tissue.is_behind(&self.assets, shown);
        let is_stopped = self.tissue.is_stopped(&self.assets, shown);
        let taken = Taken::of(self.tissue.found(), &shown.recipes).filter(|_| is_behind);
        let is_done = |picture: &Picture| picture.state.is_done;
        let tissues = &mut self.session.tissues;
        tissues.progress = self.tissue.progress();
        (tissues.is_behind, tissues.is_stopped) = (is_behind, is_stopped);
        if taken != std::mem::replace(&mut tissues.taken, taken) {
            self.session.revision += 1;
        }
        if is_behind {
            ui.ctx().request_repaint();
        }
        tissues.is_drawn = self.picture.as_ref().is_none_or(is_done);
        let Some(made) = made else {
            return;
        };
        self.session.tissues.counts.clone_from(&self.tissue.counts);
        for notice in made.notices {
            self.session.notify(Gravity::Warning, notice, "");
        }
        self.tell_segments();
        self.inside.set_labels(made.segmentation.as_deref());
        let shown = self
            .picture
            .as_mut()
            .map(|picture| picture.set_segmentation(made.segmentation));
        if let Some(Err(error)) = shown {
            let text = words::messages::w().does_not_fit;
            self.session.notify(Gravity::Error, text, error.to_string());
        }
    }

    /// Asks for label volumes, meshes and objects that the document names by an address, tells the shell which label
    /// volumes it names by a hash, and the reader which of those nobody has opened.
    fn look_after_files_beside(&mut self) {
        let illustration = self.session.illustration();
        let named = illustration.segments.clone();
        let is_file = !illustration.subject.is_made();
        let expected = SegmentationsExpected {
            sha256: named.iter().filter_map(|s| s.sha256.clone()).collect(),
            has_scan: is_file && self.session.view.subject.is_some(),
        };
        if expected != self.labels_expected {
            self.services.expect_segmentations(&expected);
            self.labels_expected = expected;
        }
        let is_here = self.session.load.is_none() && self.session.view.subject.is_some();
        if !is_here {
            return;
        }
        let has_new_tools = match &self.session.shown().subject {
            SubjectRef::Clay(clay) => self.assets.has_new_tools(clay),
            _ => false,
        };
        if has_new_tools && !self.session.awaits_clay() {
            // The clay is shaped again, with the tools that have come.
            self.session.ask_for_subject_again();
            return;
        }
        let mut missing = self.assets.missing(self.session.shown());
        if let Some(want) = missing.iter().find(|want| self.can_be_fetched(want)) {
            let want = want.clone();
            let ticket = self.services.load(&want);
            self.session.beside_started(ticket, want);
        } else if self.reported_segments != named {
            self.reported_segments = named;
            missing.retain(|want| want.role == Role::Segments);
            let text = words::tissue::w().labels_wanted;
            if is_file && missing.iter().any(|want| want.sha256().is_some()) {
                // It stays until it is not true any more.
                self.session.notify(Gravity::Error, text, "");
            } else {
                self.session.notices.withdraw(text);
            }
        }
    }

    fn can_be_fetched(&self, want: &Want) -> bool {
        let is_known = match want.role {
            Role::Segments => want.src().is_some(),
            // One that only the reader has is asked for once, so that the reader is told.
            Role::Object | Role::Mesh | Role::Tool => true,
            Role::Subject | Role::Field => false,
        };
        is_known && !self.assets.is_refused(want)
    }

    /// True while a label volume, a mesh or an object is still to be asked for.
    pub(crate) fn wants_beside(&self) -> bool {
        let missing = self.assets.missing(self.session.shown());
        self.session.view.subject.is_some() && missing.iter().any(|want| self.can_be_fetched(want))
    }

    /// Takes the label volumes that came with the load that is done. The document names those that the reader opened
    /// from now on. `is_step`: the load's scan was a step of undo, which its label volumes are a part of.
    fn take_segmentations(&mut self, of: &LoadOf, is_step: bool) {
        for file in std::mem::take(&mut self.incoming_labels) {
            if let LoadOf::Beside(want) = of {
                if let Err(other) = self.assets.take(want, Data::Segments(file)) {
                    self.session.notify_other_file(&other);
                }
                continue;
            }
            let segments = file.segmentation.segments.iter();
            let names: Vec<&str> = segments.map(|s| s.name.as_str()).collect();
            let (names, sha256) = (names.join(", "), file.sha256.clone());
            self.assets.give(Data::Segments(file));
            let is_new = |named: &SegmentsRef| named.sha256.as_ref() != Some(&sha256);
            let is_file = matches!(of, LoadOf::File | LoadOf::Instead);
            if is_file && self.session.illustration().segments.iter().all(is_new) {
                self.session.add_label_file(&sha256, is_step);
                let text = fill(words::tissue::w().labels_taken, &[&names]);
                self.session.notify(Gravity::Success, text, "");
            }
        }
        self.reported_segments.clear();
    }

    /// Takes the mesh of an object or those beside the subject that a load has brought, and lets go of a file that the
    /// user opened if it turns out to be one that they wait for. False if the load is about something else.
    fn takes_mesh(&mut self, sha256: Option<&str>) -> bool {
        let Some(load) = &self.session.load else {
            return false;
        };
        match &load.of {
            LoadOf::Beside(want) if matches!(want.role, Role::Object | Role::Mesh | Role::Tool) => {
                let whole = std::mem::take(&mut self.incoming).finish();
                let Some(Ok((Subject::Mesh(mesh), _))) = whole else {
                    self.assets.refuse(want);
                    let text = match want.role {
                        Role::Mesh => words::messages::w().no_mesh,
                        Role::Tool => words::messages::w().no_tool,
                        _ => words::messages::w().no_object,
                    };
                    self.session.notify(Gravity::Error, text, "");
                    return true;
                };
                let sha256 = sha256.map(str::to_owned);
                if let Err(other) = self.assets.take(want, Data::Object { mesh, sha256 }) {
                    self.session.notify_other_file(&other);
                }
                true
            }
            LoadOf::File => {
                let shown = self.session.shown();
                let missing = self.assets.missing(shown);
                let waits = |want: &&Want| {
                    let is_one = matches!(want.role, Role::Object | Role::Tool);
                    is_one && want.sha256().is_some() && want.sha256() == sha256
                };
                let mut beside = shown.meshes_beside.iter();
                let is_beside =
                    beside.any(|mesh| mesh.sha256.is_some() && mesh.sha256.as_deref() == sha256);
                // The shell knows the file from now on; the document says how it is to be read.
                match missing.iter().find(waits) {
                    Some(want) => self.assets.ask_again(want),
                    None if is_beside => self.assets.ask_for_meshes_again(),
                    None => return false,
                }
                self.incoming = SubjectBuilder::default();
                true
            }
            _ => false,
        }
    }

    /// Throws away the pieces of a load that ends early. A file beside the subject is not asked for again.
    fn drop_incoming(&mut self) {
        self.incoming = SubjectBuilder::default();
        self.incoming_labels.clear();
        if let Some(LoadOf::Beside(want)) = self.session.load.as_ref().map(|load| &load.of) {
            self.assets.refuse(want);
        }
    }

    /// There will be no subject of this load.
    fn refuse(&mut self, message: &str, details: String) {
        self.drop_incoming();
        self.session.refuse_load(message, details);
    }

    /// Shows the volume of a load whose pieces are all there.
    fn show_incoming(&mut self) {
        let Some(whole) = std::mem::take(&mut self.incoming).finish() else {
            return;
        };
        match whole {
            Ok((subject, histogram)) => {
                self.transfer.set_histogram(histogram);
                let is_file = self.session.load.as_ref().is_some_and(Load::is_file);
                self.is_other_uploading |= is_file || self.session.shows_earlier_object();
                let own = subject.values().and_then(|v| v.segmentation.as_ref());
                self.inside.set_labels(own);
                self.session.set_subject(&subject);
                let load = self.session.load.as_ref();
                let modality = load.and_then(|load| load.modality.clone());
                self.session.view.set_modality(modality);
                let data = Data::Subject {
                    subject: subject.clone(),
                    sha256: None,
                };
                let clay = self.session.clay_under_way();
                self.assets.give_subject(data, clay);
                self.tissue.restart();
                let shown = self
                    .picture
                    .as_mut()
                    .map(|picture| picture.set_subject(subject));
                if let Some(Err(error)) = shown {
                    self.refuse(words::messages::w().does_not_fit, error.to_string());
                }
            }
            Err(error) => self.refuse(words::messages::w().incomplete, error.to_string()),
        }
    }
}
