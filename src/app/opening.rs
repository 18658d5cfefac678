//! Opening documents and the subjects that they show.

use super::services::{Services, Ticket};
use super::state::{Gravity, Load, STORED_DOCUMENT, State, make_payload};
use super::steps::Walk;
use super::words::fill;
use super::words::said::w;
use crate::document::{Document, Edit, Reading, SubjectRef};
use crate::link;
use serde_json::{Value, json};

impl State {
    /// Takes another document in place of the present one, at one of its steps, and says what of it is not as written.
    pub(crate) fn open_document(
        &mut self,
        document: Document,
        step: usize,
        services: &mut dyn Services,
    ) {
        let notices: Vec<String> = document.notices().iter().map(ToString::to_string).collect();
        self.glide = None;
        self.selected = None;
        self.placing = None;
        self.tissues.open = None;
        self.tissues.is_seeding = false;
        self.labelling = Default::default();
        self.tissues.alone = None;
        self.link_stale_since = None;
        self.payload = make_payload(&document, &document.illustration().camera);
        self.walk = Walk::at(&document, step);
        self.history.replace(document);
        self.camera = self.shown().camera;
        self.home = self.camera;
        self.revision += 1;
        services.store(STORED_DOCUMENT, &self.link_tail());
        match notices.as_slice() {
            [] => {}
            [one] => self.say(Gravity::Warning, one.clone(), ""),
            [first, ..] => {
                let more = fill(w().more_notices, &[first, &(notices.len() - 1)]);
                self.say(Gravity::Warning, more, notices.join("\n"));
            }
        }
        self.load_subject(services);
    }

    /// Opens a document from JSON or a link, or says what is wrong with it.
    pub(crate) fn open_text(&mut self, text: &str, services: &mut dyn Services) {
        let trimmed = text.trim_start_matches('\u{feff}').trim();
        if self.paste_templates(trimmed) {
            return;
        }
        let result = if trimmed.starts_with('{') {
            Document::from_json(trimmed)
                .map(|document| (document, 0))
                .map_err(|error| error.to_string())
        } else {
            link::decode(trimmed)
                .map(|link| (link.document, link.step))
                .map_err(|error| error.to_string())
        };
        match result {
            Ok((document, step)) => {
                let last = document.step_count();
                self.open_document(document, step, services);
                if step > last {
                    let text = fill(w().step_too_far, &[&step, &last]);
                    self.say(Gravity::Warning, text, "");
                }
            }
            Err(error) => self.say(Gravity::Error, fill(w().cannot_be_opened, &[&error]), ""),
        }
    }

    /// Asks for the document's subject unless it is there or on its way.
    pub(crate) fn load_subject(&mut self, services: &mut dyn Services) {
        let subject = self.illustration().subject.clone();
        if self.requested.as_ref() == Some(&subject) {
            return;
        }
        let ticket = services.load_subject(&subject);
        self.requested = Some(subject);
        self.load = Some(Load {
            ticket,
            fraction: 0.0,
            what: "Loading".to_owned(),
            is_file: false,
            host: None,
            reading: Reading::default(),
            frame_count: 1,
        });
    }

    /// A file that the user opened is on its way and will be the subject.
    pub(crate) fn file_started(&mut self, ticket: Ticket) {
        self.load = Some(Load {
            ticket,
            fraction: 0.0,
            what: "Reading".to_owned(),
            is_file: true,
            host: None,
            reading: Reading::default(),
            frame_count: 1,
        });
    }

    /// The load is over. A file becomes the subject of the document, as one step of undo.
    pub(crate) fn load_done(&mut self, sha256: Option<String>, services: &mut dyn Services) {
        let Some(load) = self.load.take() else {
            return;
        };
        // What was said to be missing is there.
        let failure = self.load_failure.take();
        if let Some(said) = self.said.iter_mut().find(|said| Some(said.id) == failure) {
            said.is_shown = false;
        }
        self.files.loaded(load.frame_count, load.is_file);
        let Some(sha256) = sha256.filter(|_| load.is_file) else {
            return;
        };
        if let SubjectRef::Supplied { sha256: wanted, .. } = &self.illustration().subject {
            if *wanted == sha256 && self.wants_other_frame(&load.reading) {
                self.requested = None;
                self.load_subject(services);
                return;
            }
            if *wanted == sha256 {
                self.requested = Some(self.illustration().subject.clone());
                return;
            }
            if self.template_count() > 0 {
                self.say(
                    Gravity::Info,
                    w().other_file,
                    fill(w().other_file_details, &[wanted, &sha256]),
                );
            }
        }
        let subject = SubjectRef::Supplied {
            sha256,
            name: String::new(),
            reading: load.reading,
        };
        self.requested = Some(subject.clone());
        self.apply(&Edit::SetSubject(subject), false);
    }

    /// The document names a label volume beside its scan, behind those that it names already.
    pub(crate) fn add_label_file(&mut self, sha256: &str) {
        let at = "/subject/segments";
        let mut list = match self.document().get(at) {
            None => Vec::new(),
            Some(Value::Array(list)) => list.clone(),
            Some(one) => vec![one.clone()],
        };
        list.push(json!({ "sha256": sha256 }));
        // A document may hold one by itself, as the first versions wrote it.
        let value = match list.len() {
            1 => list.remove(0),
            _ => Value::from(list),
        };
        let edit = Edit::Set {
            pointer: at.to_owned(),
            value,
            name: "Add segments".to_owned(),
        };
        self.apply(&edit, false);
    }

    /// The load came to nothing; the document keeps its subject.
    pub(crate) fn load_ended(&mut self) {
        if let Some(load) = self.load.take()
            && !load.is_file
        {
            self.requested = None;
        }
    }
}
