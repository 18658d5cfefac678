//! Opening documents and the subjects that they show.

use std::sync::Arc;

use serde_json::{Value, json};

use super::effect::{Effect, LinkChange};
use super::growing::Growing;
use super::mode::Mode;
use super::notices::Gravity;
use super::session::{Load, LoadOf, STORED_DOCUMENT, Session, payload_of};
use super::ticket::Ticket;
use crate::app::words::fill;
use crate::app::words::messages::w;
use crate::assets::{OtherFile, Want};
use crate::document::figure::Figure;
use crate::document::{
    Clay, Document, Edit, FIGURE_FRONT, Illustration, Notice, NoticeKind, Reading, SubjectRef,
};
use crate::link::{self, Link};

/// True if a subject that was asked for, or is shown, is that of the document.
fn is_of(one: &Option<SubjectRef>, subject: &SubjectRef) -> bool {
    one.as_ref().is_some_and(|one| one.is_same_data(subject))
}

impl Session {
    /// Takes another document in place of the present one, at one of its steps, and shows its notices.
    pub fn open_document(&mut self, document: Document, step: usize) {
        self.keep_work();
        let notices: Vec<String> = document.notices().iter().map(ToString::to_string).collect();
        self.put_down();
        self.withdraw_templates();
        self.link_stale_since = None;
        self.payload = payload_of(&document, &document.illustration().camera);
        self.mode = Mode::at(&document, step);
        self.history.replace(document);
        self.camera = self.shown().camera;
        self.home = self.camera;
        self.revision += 1;
        self.opened += 1;
        self.growing = Some(Growing::default());
        self.is_restored = false;
        self.store(STORED_DOCUMENT, self.link_tail());
        match notices.as_slice() {
            [] => {}
            [one] => self.notify(Gravity::Warning, one.clone(), ""),
            [first, ..] => {
                let more = fill(w().more_notices, &[first, &(notices.len() - 1)]);
                self.notify(Gravity::Warning, more, notices.join("\n"));
            }
        }
        self.load_subject();
    }

    /// Opens a document from JSON or a link; a message tells why where it cannot be opened.
    pub fn open_text(&mut self, text: &str) {
        let trimmed = text.trim_start_matches('\u{feff}').trim();
        if self.paste_templates(trimmed) {
            return;
        }
        match link::document_of(trimmed) {
            Ok(link) => self.open_link(link),
            Err(error) => self.notify(Gravity::Error, fill(w().cannot_be_opened, &[&error]), ""),
        }
    }

    /// Opens the document of a link at the step that the link names; a message tells of a step that is not there.
    pub fn open_link(&mut self, link: Link) {
        let Link { document, step } = link;
        let last = document.step_count();
        self.open_document(document, step);
        if step > last {
            let text = fill(w().step_too_far, &[&step, &last]);
            self.notify(Gravity::Warning, text, "");
        }
    }

    /// Asks for the document's subject unless it is there or on its way.
    pub fn load_subject(&mut self) {
        let (subject, has_more) = self.part_of(self.shown().subject_shown());
        let is_shaped = self.history.is_in_drag() && matches!(subject, SubjectRef::Clay(_));
        let is_sketch = has_more || is_shaped;
        if !is_of(&self.requested, &subject) || (self.is_sketch_requested && !is_sketch) {
            self.given_up = None;
            self.is_sketch_requested = is_sketch;
            self.requested = Some(subject.clone());
            self.effect(Effect::LoadSubject(subject));
        } else {
            self.tell_space();
        }
    }

    /// As much of a subject as is to be asked for now, and whether more of it follows: of a clay that was opened first
    /// its start, then more and more of its strokes. One that begins with a file is read only once, and one that a hand
    /// shapes meanwhile is wanted as it is.
    fn part_of(&mut self, subject: SubjectRef) -> (SubjectRef, bool) {
        let SubjectRef::Clay(clay) = &subject else {
            self.growing = None;
            return (subject, false);
        };
        let all = clay.strokes.len();
        let done = self.strokes_seen_of(clay);
        let now = self.now;
        let is_whole = self.history.is_in_drag() || clay.file().is_some();
        let until = match &mut self.growing {
            Some(growing) if !is_whole => growing.next(done, all, now),
            _ => all,
        };
        if until >= all {
            self.growing = None;
            return (subject, false);
        }
        (SubjectRef::Clay(clay.cut(until as u32)), true)
    }

    /// Strokes of the clay that is seen, if it is this one as far as it goes.
    fn strokes_seen_of(&self, clay: &Clay) -> Option<usize> {
        match &self.shown_subject {
            Some(SubjectRef::Clay(seen)) => {
                let count = seen.strokes.len();
                (seen.strokes_shared(clay) == Some(count)).then_some(count)
            }
            _ => None,
        }
    }

    /// The part of the strokes of a clay that is opened which the load under way ends with.
    fn part_under_way(&self) -> f32 {
        let asked = self.growing.and_then(|growing| growing.asked());
        match (asked, self.shown().subject_shown()) {
            (Some(until), SubjectRef::Clay(clay)) if !clay.strokes.is_empty() => {
                until as f32 / clay.strokes.len() as f32
            }
            _ => 1.0,
        }
    }

    /// Asks for the document's subject although it is there.
    pub fn ask_for_subject_again(&mut self) {
        self.requested = None;
        self.load_subject();
    }

    /// True while an object is seen that is not the document's: that is on its way, or cannot be had.
    pub fn shows_earlier_object(&self) -> bool {
        let is_seen = self.view.subject.is_some();
        let subject = &self.illustration().subject;
        // A clay of other strokes is this one still.
        let is_same_clay = |shown: &SubjectRef| shown.is_same_clay(subject);
        let is_it = self.shown_subject.as_ref().is_some_and(is_same_clay);
        is_seen && !is_it && !is_of(&self.shown_subject, subject)
    }

    /// True while another part of a clay's strokes is to be shown than is, or what a hand left is seen as a sketch.
    pub fn awaits_clay(&self) -> bool {
        let is_clay = matches!(self.illustration().subject, SubjectRef::Clay(_));
        let is_shown =
            self.is_as_shown(&self.shown_subject) && !self.outlives(self.is_sketch_shown);
        is_clay && !is_shown && !self.is_as_shown(&self.given_up)
    }

    /// True if what a step has can be drawn of the subject that is shown: not of a clay with other strokes, nor of its
    /// sketch.
    pub fn can_draw(&self, state: &Illustration) -> bool {
        let SubjectRef::Clay(_) = &state.subject else {
            return true;
        };
        let is_of_step = |shown| state.shows(shown);
        !self.is_sketch_shown && self.shown_subject.as_ref().is_some_and(is_of_step)
    }

    /// True of a sketch that no hand goes on shaping.
    fn outlives(&self, is_sketch: bool) -> bool {
        is_sketch && !self.history.is_in_drag()
    }

    /// True if the subject that is asked for is wanted soon: a hand is shaping it, or more of its strokes follow.
    pub fn wants_sketch(&self) -> bool {
        self.is_sketch_requested
    }

    /// True if what is asked for is the sketch that a hand waits for.
    pub fn is_sketch_of_hand(&self) -> bool {
        self.is_sketch_requested && self.growing.is_none()
    }

    /// True if a subject is a clay as far as its strokes are shown.
    fn is_as_shown(&self, subject: &Option<SubjectRef>) -> bool {
        let shown = self.shown();
        subject.as_ref().is_some_and(|subject| shown.shows(subject))
    }

    /// The clay that is being shaped, if that is the load under way.
    pub fn clay_under_way(&self) -> Option<Arc<Clay>> {
        let load = self.load.as_ref()?;
        match self.requested.as_ref()? {
            SubjectRef::Clay(clay) if load.of == LoadOf::Subject => Some(Arc::clone(clay)),
            _ => None,
        }
    }

    /// Asks for a clay as far as its strokes are shown, once nothing else is under way.
    pub fn follow_clay(&mut self) {
        let is_asked =
            self.is_as_shown(&self.requested) && !self.outlives(self.is_sketch_requested);
        if self.load.is_none() && self.awaits_clay() && !is_asked {
            self.load_subject();
        }
    }

    /// How far the load under way is: of a clay of which more follows, a part of the whole.
    pub fn hear_progress(&mut self, fraction: f32, what: String) {
        let part = self.part_under_way();
        if let Some(load) = &mut self.load {
            load.fraction = match load.of {
                LoadOf::Subject => part * fraction,
                _ => fraction,
            };
            load.what = what;
        }
    }

    /// The subject of the load under way is shown, whole or coarsely.
    pub(super) fn load_is_shown(&mut self) {
        let of = self.load.as_ref().map(|load| &load.of);
        let is_asked = matches!(of, Some(LoadOf::Subject));
        self.is_sketch_shown = is_asked && self.is_sketch_requested;
        // A file becomes the document's subject when it is done.
        self.shown_subject = match of {
            Some(LoadOf::Subject) => self.requested.clone(),
            _ => None,
        };
    }

    /// The document's subject is on its way.
    pub fn load_started(&mut self, ticket: Ticket) {
        self.load = Some(Load::new(ticket, "Loading", LoadOf::Subject));
    }

    /// A file that the user opened is on its way and will be the subject.
    pub fn file_started(&mut self, ticket: Ticket) {
        let of = match std::mem::take(&mut self.view.figure.wants_reference) {
            true => LoadOf::Reference,
            false => LoadOf::File,
        };
        self.load = Some(Load::new(ticket, "Reading", of));
    }

    /// A file is on its way that takes the place of the document's subject, which is not asked for then.
    pub fn instead_started(&mut self, ticket: Ticket) {
        let is_other = |effect: &Effect| !matches!(effect, Effect::LoadSubject(_));
        self.effects.retain(is_other);
        self.load = Some(Load::new(ticket, "Reading", LoadOf::Instead));
    }

    /// A label volume or the mesh of an object is on its way.
    pub fn beside_started(&mut self, ticket: Ticket, want: Want) {
        self.load = Some(Load::new(ticket, "Loading", LoadOf::Beside(Box::new(want))));
    }

    /// What is wrong with the file of a load, by the hash of its bytes: the document asks for another one. A file that
    /// replaces a subject which is shown, or which nobody asked for in this session, is no answer to the document and
    /// always right.
    pub fn other_file(&self, load: &Load, found: &str) -> Option<OtherFile> {
        let subject = &self.illustration().subject;
        let is_answer = match load.of {
            LoadOf::Subject => true,
            LoadOf::File => self.waits_for_file() && subject.supplied_sha256().is_some(),
            LoadOf::Instead | LoadOf::Reference | LoadOf::Beside(_) => false,
        };
        let check = Want::subject(subject).check(found);
        check.err().filter(|_| is_answer)
    }

    /// The document's own file could not be had, and was asked for in this session: a file that is opened answers.
    pub(super) fn waits_for_file(&self) -> bool {
        let subject = &self.illustration().subject;
        // A clay was asked for as far as its strokes were shown.
        let is_it = |asked: &SubjectRef| asked.is_same_data(subject) || asked.is_same_clay(subject);
        let is_here = self.requested.as_ref().is_some_and(is_it);
        let is_file = subject.has_file();
        let figure = self.illustration().figure.as_ref();
        let has_work = self.template_count() > 0 || figure.is_some_and(|f| *f != Figure::default());
        let is_asked_for = !self.is_restored || has_work;
        !is_here && is_file && is_asked_for
    }

    /// Tells that a file is not the one that the document means, with both hashes.
    pub fn notify_other_file(&mut self, other: &OtherFile) {
        let details = fill(w().other_file_details, &[&other.wanted, &other.found]);
        self.notify(Gravity::Error, w().wrong_file, details);
    }

    /// There will be no volume of the load under way: it is stopped, and a message tells why.
    pub fn refuse_load(&mut self, message: &str, details: String) {
        if let Some(load) = &self.load {
            self.effects.push(Effect::CancelLoad(load.ticket));
        }
        let is_beside = self.is_loading_beside();
        self.load_ended();
        self.notify(Gravity::Error, message, details);
        if !is_beside {
            self.load_failure = self.notices.all().last().map(|notice| notice.id);
        }
    }

    fn is_loading_beside(&self) -> bool {
        let load = self.load.as_ref();
        load.is_some_and(|load| matches!(load.of, LoadOf::Beside(_)))
    }

    /// The load is over. A file that the document waited for becomes its subject; any other begins a new document. Both
    /// are one step of undo, and true is returned then.
    pub fn load_done(&mut self, sha256: Option<String>) -> bool {
        let Some(load) = self.load.take() else {
            return false;
        };
        if matches!(load.of, LoadOf::Beside(_)) {
            return false;
        }
        if load.of != LoadOf::Subject {
            self.is_sketch_requested = false;
        }
        // A message that the load failed is no longer true.
        if let Some(failure) = self.load_failure.take() {
            self.notices.dismiss(failure);
        }
        self.files.loaded(load.frame_count, load.is_file());
        let Some(sha256) = sha256.filter(|_| load.is_file()) else {
            return false;
        };
        let is_instead = load.of == LoadOf::Instead;
        if is_instead && let Err(other) = Want::subject(&self.illustration().subject).check(&sha256)
        {
            let details = fill(w().other_file_details, &[&other.wanted, &other.found]);
            self.notify(Gravity::Warning, w().other_file, details);
        } else if let Some(wanted) = self.illustration().subject.supplied_sha256() {
            if *wanted == sha256 && self.wants_other_frame(&load.reading) {
                self.ask_for_subject_again();
                return false;
            }
            if *wanted == sha256 {
                self.requested = Some(self.illustration().subject.clone());
                self.shown_subject.clone_from(&self.requested);
                return false;
            }
        }
        let is_answer = is_instead || self.waits_for_file();
        if is_answer && let SubjectRef::Clay(clay) = &self.illustration().subject {
            // What was read for itself becomes what the clay begins with.
            let clay = clay.with_file(None, Some(sha256));
            let edit = Edit::SetSubject(SubjectRef::Clay(Arc::new(clay)));
            let is_step = self.apply(&edit, false);
            self.load_subject();
            return is_step;
        }
        let subject = SubjectRef::Supplied {
            sha256,
            name: String::new(),
            reading: load.reading,
        };
        self.requested = Some(subject.clone());
        self.shown_subject = Some(subject.clone());
        if !is_answer {
            return self.start_with(subject);
        }
        let edit = Edit::SetSubject(subject);
        let edit = match is_instead {
            true => self.with_its_segments(edit),
            false => edit,
        };
        self.apply(&edit, false)
    }

    /// The document tells from now on that its subject is a figure, if it is one and the file alone told it: its camera
    /// looks at the front of the plate. This is no step of undo, and holds for all steps with this subject.
    pub fn tell_figure(&mut self) {
        if !self.view.is_figure() || self.illustration().is_of_figure() {
            return;
        }
        let edit = Edit::Set {
            pointer: "/figure".to_owned(),
            value: json!({}),
            name: "Open a picture".to_owned(),
        };
        let subject = self.illustration().subject.clone();
        let result = self.history.tell(&edit, |document| {
            let illustration = document.illustration();
            illustration.subject == subject && !illustration.is_of_figure()
        });
        self.applied(result, false);
        // Where the document could not be changed, its camera means what it meant.
        if self.illustration().is_of_figure() {
            for camera in [&mut self.camera, &mut self.home] {
                camera.rotate *= FIGURE_FRONT;
            }
        }
    }

    /// A `figure` stands beside a subject whose file, as it turns out, is none of a figure: it is named, and the camera
    /// is that of a document without it from now on. This is no step of undo.
    pub fn tell_space(&mut self) {
        let subject = self.illustration().subject.clone();
        let is_seen = self.view.subject.is_some() && !self.shows_earlier_object();
        let is_known = is_seen && subject.is_figure().is_none() && !self.view.is_figure();
        if !is_known || !self.illustration().is_of_figure() {
            return;
        }
        self.history.tell_space(|document| {
            let illustration = document.illustration();
            illustration.subject == subject && illustration.is_of_figure()
        });
        self.document_changed(LinkChange::Replace);
        for camera in [&mut self.camera, &mut self.home] {
            camera.rotate *= FIGURE_FRONT.inverse();
        }
        let what = "a subject that is no figure";
        let notice = Notice::new("/figure", NoticeKind::Beside { what });
        self.notify(Gravity::Warning, notice.to_string(), "");
    }

    /// The change to another subject, but with the segments and recipes of the present one.
    fn with_its_segments(&self, change: Edit) -> Edit {
        let at = "/subject";
        let changed = change.apply(self.document()).ok();
        let Some(mut value) = changed.and_then(|document| document.get(at).cloned()) else {
            return change;
        };
        for key in ["segments", "features", "meshes"] {
            if let Some(kept) = self.document().get(&format!("{at}/{key}")) {
                value[key] = kept.clone();
            }
        }
        Edit::Set {
            pointer: at.to_owned(),
            value,
            name: change.name(self.document()),
        }
    }

    /// The document names a label volume beside its scan, behind those that it names already. `is_with_scan`:
    /// it came with the scan, and both are one step of undo.
    pub fn add_label_file(&mut self, sha256: &str, is_with_scan: bool) {
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
        if is_with_scan {
            self.amend(&edit);
        } else {
            self.apply(&edit, false);
        }
    }

    /// The load came to nothing; the document keeps its subject.
    pub fn load_ended(&mut self) {
        if let Some(load) = self.load.take()
            && load.of == LoadOf::Subject
        {
            // What came to nothing is not asked for again by itself, nor is more of it.
            self.given_up = match (self.requested.take(), self.growing.take()) {
                (Some(_), Some(_)) => Some(self.shown().subject_shown()),
                (asked, _) => asked,
            };
        }
    }

    /// A load brought the file whose hash the document waits for. True if the document wants it read in another way, or
    /// made a clay.
    fn wants_other_frame(&self, loaded: &Reading) -> bool {
        let subject = &self.illustration().subject;
        let is_clay = matches!(subject, SubjectRef::Clay(_));
        is_clay || !subject.is_made() && Want::subject(subject).reading != *loaded
    }
}
