//! Starting a new document: what is left comes back with undo, and its templates can be brought along.

use super::effect::LinkChange;
use super::mode::Mode;
use super::notices::{Gravity, Offer};
use super::selection::Selection;
use super::session::{Left, Session, Tab};
use super::tissues::Tissues;
use super::tool::Tool;
use crate::app::words::messages::w;
use crate::document::{Document, Edit, Outlook, SubjectRef, carried_templates};

impl Session {
    /// Shows another subject. It is of another shape, so that a new document begins; another volume of the file that
    /// is shown stays in its document.
    pub(super) fn choose_subject(&mut self, subject: SubjectRef) {
        if is_same_file(&self.illustration().subject, &subject) {
            self.apply(&Edit::SetSubject(subject), false);
        } else {
            self.start_with(subject);
        }
        self.load_subject();
    }

    /// Begins a new document with a subject, as one step of undo, and offers to bring the templates along. True if
    /// there can be such a document; else a message tells why.
    pub(super) fn start_with(&mut self, subject: SubjectRef) -> bool {
        let edit = Edit::SetSubject(subject);
        match edit.apply(&Document::new()) {
            Ok(document) => {
                let left = self.document().clone();
                let name = edit.name(&left);
                self.start_document(document, name);
                self.offer_templates(left);
                true
            }
            Err(error) => {
                self.notify(Gravity::Error, error.to_string(), "");
                false
            }
        }
    }

    /// Takes a new document in place of the present one, as one step of undo.
    pub(super) fn start_document(&mut self, document: Document, name: String) {
        self.withdraw_templates();
        let outlook = self.outlook();
        self.put_down();
        self.mode = Mode::Author;
        self.playing = None;
        if document != *self.document() {
            self.history.start(document, name, outlook);
        }
        let camera = self.illustration().camera;
        self.take_outlook(Outlook {
            camera,
            home: camera,
        });
        self.is_restored = false;
        self.revision += 1;
        self.touch_link(LinkChange::Push);
    }

    /// Ends whatever is being done with the document that is left.
    pub(super) fn put_down(&mut self) {
        self.glide = None;
        self.selection = Selection::Nothing;
        if self.tool.is_for_authors() {
            self.tool = Tool::Look;
        }
        self.tissues = Tissues {
            counts: std::mem::take(&mut self.tissues.counts),
            ..Tissues::default()
        };
    }

    /// Where one looks at the document from. At a step it is the author's camera: the one that the step turned would be
    /// step 0's.
    fn outlook(&self) -> Outlook {
        let home = self.home;
        let camera = match self.step() {
            0 => self.glide.map_or(self.camera, |glide| glide.to),
            _ => self.illustration().camera,
        };
        Outlook { camera, home }
    }

    fn take_outlook(&mut self, outlook: Outlook) {
        self.camera = outlook.camera;
        self.home = outlook.home;
    }

    /// Takes a change back, or makes it again.
    pub(super) fn undo_or_redo(&mut self, is_undo: bool) {
        self.history.end_drag();
        let (before, step) = (self.document().clone(), self.step());
        let outlook = self.outlook();
        let other = self.history.outlook_mut(is_undo);
        let other = other.map(|kept| std::mem::replace(kept, outlook));
        let did = if is_undo {
            self.history.undo()
        } else {
            self.history.redo()
        };
        if !did {
            return;
        }
        let is_other = other.is_some();
        if let Some(outlook) = other {
            self.withdraw_templates();
            self.put_down();
            self.mode = Mode::Author;
            self.take_outlook(outlook);
        }
        self.close_drags();
        self.document_changed(LinkChange::Push);
        if !is_other {
            self.show_change(&before, step);
        }
        let recipes = &self.history.document().illustration().recipes;
        self.tissues.keep_to(recipes);
        if self.tool().is_for_tissue() && self.tissues.open.is_none() {
            self.take_tool(Tool::Look);
        }
        self.load_subject();
    }

    /// A message offers the templates of the document that was left, if there are any.
    fn offer_templates(&mut self, left: Document) {
        if carried_templates(&left, self.document(), &[]).is_some() {
            let text = w().new_for_subject.to_owned();
            let notice = self.notices.offer(self.now, Offer::KeepTemplates, text);
            self.left = Some(Left {
                document: left,
                notice,
            });
        }
    }

    /// What was offered is of a document before the last, or is no longer wanted.
    pub(super) fn withdraw_templates(&mut self) {
        if let Some(left) = self.left.take() {
            self.notices.dismiss(left.notice);
        }
    }

    /// Brings the templates of the document that was left into the present one, as one step of undo.
    pub(super) fn keep_templates(&mut self) {
        let Some(left) = self.left.take() else {
            return;
        };
        self.notices.dismiss(left.notice);
        let facts = self.view.subject.as_ref();
        let segments = facts.into_iter().flat_map(|facts| facts.segments.values());
        let segments: Vec<&str> = segments.map(String::as_str).collect();
        let edit = carried_templates(&left.document, self.document(), &segments);
        if edit.is_some_and(|edit| self.apply(&edit, false)) {
            self.side_tab = Tab::Templates;
        }
    }
}

/// True if two subjects are the same or revisions of one, or are read from the same file.
fn is_same_file(one: &SubjectRef, other: &SubjectRef) -> bool {
    match (one, other) {
        (SubjectRef::Supplied { sha256: a, .. }, SubjectRef::Supplied { sha256: b, .. }) => a == b,
        (SubjectRef::Address { src: a, .. }, SubjectRef::Address { src: b, .. }) => a == b,
        // Revisions of one subject have the same segments.
        (SubjectRef::Builtin { name: a, .. }, SubjectRef::Builtin { name: b, .. }) => a == b,
        _ => one == other,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Command, Effect, Gravity, Load, LoadOf, Selection, Session, Ticket};
    use super::*;
    use crate::document::Reading;

    const PEELED: &str = r#"{ "fabrica": 1, "title": "Scalp", "subject": { "builtin": "head" },
        "camera": { "distance": 2.0 }, "labels": [{ "at": [0, 0, 0.4], "text": "Frontal bone" }],
        "templates": [{ "kind": "peel", "at": [0, 0, 0.4] }] }"#;

    fn session_of(json: &str) -> Session {
        let mut session = Session::new(Document::new());
        session.open_document(Document::from_json(json).expect("a document"), 0);
        session.take_effects();
        session
    }

    fn cube() -> SubjectRef {
        SubjectRef::Builtin {
            name: "cube".to_owned(),
            revision: 1,
        }
    }

    fn offers(session: &Session) -> usize {
        let shown = session.notices.shown();
        shown.filter(|notice| notice.offer.is_some()).count()
    }

    fn open_file(session: &mut Session, digit: &str) {
        session.file_started(Ticket(5));
        session.load_done(Some(digit.repeat(64)));
    }

    #[test]
    fn a_subject_starts_a_document_and_undo_brings_the_old_one_back() {
        for is_file in [false, true] {
            let mut session = session_of(PEELED);
            session.run(Command::Orbit(0.5, 0.2), 0.0);
            session.run(Command::Select(Some(0)), 0.0);
            let (before, camera) = (session.document().clone(), session.camera);
            match is_file {
                false => drop(session.run(Command::SetSubject(cube()), 0.0)),
                true => open_file(&mut session, "a"),
            }
            let now = session.illustration();
            assert!(now.templates.is_empty() && now.captions.is_empty() && now.title.is_empty());
            assert_eq!(session.camera, Document::new().illustration().camera);
            assert_eq!(session.selection, Selection::Nothing);
            session.run(Command::Orbit(0.1, 0.1), 0.0);
            let turned = session.camera;
            let effects = session.run(Command::Undo, 0.0);
            assert!(
                matches!(&effects[..], [Effect::LoadSubject(_)]),
                "{effects:?}"
            );
            assert_eq!(*session.document(), before, "one step");
            assert_eq!((session.camera, session.home.distance), (camera, 2.0));
            assert_eq!(offers(&session), 0, "nothing was left");
            session.run(Command::Redo, 0.0);
            assert!(session.illustration().templates.is_empty());
            assert_eq!(session.camera, turned);
        }
    }

    #[test]
    fn a_newer_revision_of_a_subject_leaves_all_else() {
        let mut session = session_of(&PEELED.replace("head", "torso"));
        let revision = |session: &Session| match &session.illustration().subject {
            SubjectRef::Builtin { revision, .. } => *revision,
            _ => 0,
        };
        let before = session.illustration().clone();
        assert_eq!(revision(&session), 1, "a document that names none");
        let effects = session.run(Command::SetSubject(SubjectRef::newest("torso")), 0.0);
        assert!(matches!(&effects[..], [Effect::LoadSubject(_)]));
        let now = session.illustration();
        assert_eq!(
            (&now.templates, &now.captions),
            (&before.templates, &before.captions)
        );
        assert_eq!((revision(&session), offers(&session)), (2, 0));
        session.run(Command::Undo, 0.0);
        assert_eq!(*session.illustration(), before, "one step");
    }

    #[test]
    fn templates_are_offered_and_come_along_as_one_step() {
        let mut session = session_of(PEELED);
        open_file(&mut session, "a");
        assert_eq!(offers(&session), 1);
        session.advance(1e4);
        assert_eq!(offers(&session), 1, "it waits for the answer");
        session.run(Command::KeepTemplates, 0.0);
        assert_eq!((session.template_count(), offers(&session)), (1, 0));
        assert!(session.illustration().captions.is_empty());
        assert!(matches!(
            session.illustration().subject,
            SubjectRef::Supplied { .. }
        ));
        session.run(Command::KeepTemplates, 0.0);
        assert_eq!(session.template_count(), 1, "once");
        session.run(Command::Undo, 0.0);
        assert_eq!(session.template_count(), 0);
        assert!(matches!(
            session.illustration().subject,
            SubjectRef::Supplied { .. }
        ));
        // Of an empty document nothing is offered.
        open_file(&mut session, "b");
        assert_eq!(offers(&session), 0);
    }

    #[test]
    fn a_new_document_is_undone() {
        let mut session = session_of(PEELED);
        let before = session.document().clone();
        session.run(Command::New, 0.0);
        assert_eq!(*session.document(), Document::fresh());
        assert_eq!(offers(&session), 0);
        session.run(Command::Undo, 0.0);
        assert_eq!(*session.document(), before);
        assert_eq!(session.camera.distance, 2.0);
    }

    /// The author's name for a scan makes it no other scan.
    #[test]
    fn a_named_scan_gives_way_to_another_one() {
        let mut session = session_of(PEELED);
        open_file(&mut session, "a");
        let SubjectRef::Supplied {
            sha256, reading, ..
        } = session.illustration().subject.clone()
        else {
            panic!("the file");
        };
        let name = "CT head".to_owned();
        let named = SubjectRef::Supplied {
            sha256,
            name,
            reading,
        };
        session.run(Command::Apply(Edit::SetSubject(named)), 0.0);
        session.file_started(Ticket(9));
        let load = Load::new(Ticket(9), "Reading", LoadOf::File);
        assert!(session.other_file(&load, &"b".repeat(64)).is_none());
        session.load_done(Some("b".repeat(64)));
        let subject = &session.illustration().subject;
        assert!(matches!(subject, SubjectRef::Supplied { name, .. } if name.is_empty()));
        let effects = session.run(Command::Undo, 0.0);
        assert!(
            matches!(&effects[..], [Effect::LoadSubject(_)]),
            "{effects:?}"
        );
        let effects = session.run(Command::Undo, 0.0);
        assert!(effects.is_empty(), "only its name is undone: {effects:?}");
    }

    #[test]
    fn another_volume_of_the_file_stays_in_its_document() {
        let mut session = session_of(PEELED);
        open_file(&mut session, "a");
        session.run(Command::KeepTemplates, 0.0);
        let reading = Reading {
            frame: 3,
            ..Reading::default()
        };
        let other = session.illustration().subject.clone().with_reading(reading);
        session.run(Command::SetSubject(other), 0.0);
        assert_eq!(session.template_count(), 1);
    }

    /// A document that waits for its file keeps everything when that is opened, and when another file takes its place
    /// because the user said so.
    #[test]
    fn a_file_that_a_document_waits_for_starts_none() {
        let asking = |subject: &str| {
            let json = PEELED.replace(r#"{ "builtin": "head" }"#, subject);
            let mut session = session_of(&json);
            session.load_started(Ticket(1));
            session.refuse_load("not here", String::new());
            session
        };
        let hash = format!(r#"{{ "sha256": "{}" }}"#, "a".repeat(64));
        let mut session = asking(&hash);
        open_file(&mut session, "a");
        assert_eq!((session.template_count(), offers(&session)), (1, 0));
        let mut session = asking(&hash);
        session.file_started(Ticket(2));
        let load = Load::new(Ticket(2), "Reading", LoadOf::File);
        assert!(session.other_file(&load, &"b".repeat(64)).is_some());
        let mut session = asking(r#"{ "src": "https://scans.example/a.nii" }"#);
        open_file(&mut session, "b");
        assert_eq!((session.template_count(), offers(&session)), (1, 0));
        let mut session = session_of(PEELED);
        session.instead_started(Ticket(3));
        session.load_done(Some("b".repeat(64)));
        assert_eq!((session.template_count(), offers(&session)), (1, 0));
        let last = session.notices.all().last().map(|notice| notice.gravity);
        assert_ne!(last, Some(Gravity::Error));
    }

    #[test]
    fn a_figure_beside_a_scan_does_not_turn_it() {
        let json = r#"{ "fabrica": 1, "subject": { "src": "a.nii" }, "figure": { "detail": 800 },
            "camera": { "rotate": [0, 0, 0.7071, 0.7071] } }"#;
        let plain = json.replace(r#""figure": { "detail": 800 },"#, "");
        let [mut session, wanted] =
            [json, plain.as_str()].map(|json| Session::with_scan(json, 1.0, &[]));
        session.shown_subject = Some(session.illustration().subject.clone());
        let apart = |session: &Session, rotate| session.camera.rotate.angle_between(rotate);
        assert!(apart(&session, wanted.camera.rotate) > 1.0, "it may be one");
        session.tell_space();
        assert!(apart(&session, wanted.camera.rotate) < 3e-3);
        let told = session.notices.all().last();
        let told = told.map(|notice| notice.message.clone());
        assert!(
            told.as_ref()
                .is_some_and(|told| told.starts_with("/figure")),
            "{told:?}"
        );
        // What is written of a camera is what a document without the figure would have.
        let written = session.document_as_seen();
        assert_eq!(written, *session.document());
        session.run(Command::Orbit(0.5, 0.2), 0.0);
        let written = session.document_as_seen().without("/figure");
        let written = written.expect("a document");
        assert!(apart(&session, written.illustration().camera.rotate) < 3e-3);
    }

    #[test]
    fn a_figure_of_an_earlier_visit_waits_for_its_plate() {
        for (rest, waits) in [("", false), (r#""handles": [{ "at": [0, 0] }]"#, true)] {
            let hash = "a".repeat(64);
            let json = format!(
                r#"{{ "fabrica": 1, "subject": {{ "sha256": "{hash}" }}, "figure": {{ {rest} }} }}"#
            );
            let mut session = session_of(&json);
            session.is_restored = true;
            session.load_started(Ticket(1));
            session.refuse_load("not here", String::new());
            session.file_started(Ticket(2));
            let load = Load::new(Ticket(2), "Reading", LoadOf::File);
            let other = session.other_file(&load, &"b".repeat(64));
            assert_eq!(other.is_some(), waits, "{json}");
        }
    }

    #[test]
    fn a_label_file_that_came_with_the_scan_goes_with_it() {
        let mut session = session_of(PEELED);
        let before = session.document().clone();
        session.file_started(Ticket(5));
        assert!(session.load_done(Some("a".repeat(64))), "a step of undo");
        session.add_label_file(&"b".repeat(64), true);
        assert_eq!(session.illustration().segments.len(), 1);
        session.run(Command::Undo, 0.0);
        assert_eq!(*session.document(), before);
    }
}
