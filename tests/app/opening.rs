//! Opening, fetching, stopping and saving, and the address bar's part in them.

use super::*;
use fabrica::assets::Source;
use fabrica::data::Grid;

#[test]
fn the_address_follows_what_is_done() {
    let mut window = Window::open(DESK, CUBE);
    assert!(
        window.log.0.borrow().links.is_empty(),
        "opening changes nothing in the address bar"
    );
    let center = window.picture_center();
    window.drag(center, vec2(50.0, 0.0));
    let turned = window
        .log
        .0
        .borrow()
        .links
        .last()
        .cloned()
        .expect("the camera is in the link");
    assert_eq!(
        turned.1,
        LinkChange::Replace,
        "without an entry in the history"
    );
    window.place_peel();
    window.settle();
    let (payload, change) = window
        .log
        .0
        .borrow()
        .links
        .last()
        .cloned()
        .expect("the peel is in the link");
    assert_eq!(change, LinkChange::Push);
    let opened = fabrica::link::decode(&payload).expect("it opens").document;
    assert_eq!(opened, window.document());
    assert_eq!(
        window.log.0.borrow().stored.get("document"),
        Some(&payload),
        "and it is kept for a reload"
    );

    let log = Fake::default();
    log.0
        .borrow_mut()
        .stored
        .insert("document".to_owned(), payload);
    let again = Window::open_with(DESK, egui::Theme::Light, log, None);
    assert_eq!(again.document(), opened, "nothing is lost on reload");
}

#[test]
fn steps_are_walked_and_edited_where_they_are() {
    let document = r#"{ "fabrica": 1, "title": "A cut", "subject": { "builtin": "cube" },
        "templates": [{ "kind": "split", "params": { "amount": 0 } }],
        "steps": [{ "title": "Incision", "caption": "It opens.", "seconds": 0.2, "set": { "/templates/0/params/amount": 0.3 } },
                  { "title": "Wide", "seconds": 0.2, "set": { "/templates/0/params/amount": 0.8, "/camera/distance": 4 } }] }"#;
    let document = fabrica::document::Document::from_json(document).expect("a document");
    let link = fabrica::link::fragment(&document, 1);
    let mut window = Window::open_with(DESK, egui::Theme::Light, Fake::default(), Some(&link));
    assert_eq!(window.harness.state().step(), 1);
    window.harness.get_by_label("Step 1 of 2   Incision");
    let at_one = window.harness.render().expect("a picture");
    window.look("steps_one");

    window.click("Next step");
    window.settle();
    window.harness.get_by_label("Step 2 of 2   Wide");
    let address = |window: &Window| {
        window
            .log
            .0
            .borrow()
            .links
            .last()
            .map(|(link, _)| link.clone())
    };
    assert!(
        address(&window).is_some_and(|link| link.ends_with("&step=2")),
        "the address names the step"
    );
    let at_two = window.harness.render().expect("a picture");
    assert_ne!(at_one, at_two);
    assert!(
        window
            .harness
            .state()
            .document()
            .get("/camera/distance")
            .is_none(),
        "the document is as it was"
    );

    window.press(Key::N);
    window.settle();
    assert_eq!(
        window.harness.state().step(),
        2,
        "what is selected is looked at first"
    );
    window.press(Key::CloseBracket);
    window.settle();
    assert_eq!(window.harness.state().step(), 2, "it is edited there");
    window.harness.get_by_label("Step 2 of 2   Wide");
    assert!(address(&window).is_some_and(|link| link.ends_with("&step=2")));
    let edited = window.document();
    let amount = "/templates/0/params/amount";
    let set = edited.get("/steps/1/set").expect("what the step sets");
    assert!(set[amount].as_f64() > Some(0.8), "the step sets it: {set}");
    for at in [amount, "/steps/0/set"] {
        assert_eq!(edited.get(at), document.get(at), "{at}");
    }
}

#[test]
fn a_broken_link_is_said_and_leaves_a_working_viewer() {
    let window = Window::open_with(
        DESK,
        egui::Theme::Light,
        Fake::default(),
        Some("#Anonsense"),
    );
    assert!(
        window
            .harness
            .query_by_label_contains("cannot be opened")
            .is_some(),
        "a message names the fault"
    );
    assert!(
        window.log.0.borrow().links.is_empty(),
        "the address is left as it is"
    );
    assert!(
        window.harness.query_by_label("Place peel").is_some(),
        "and everything works"
    );
}

#[test]
fn loading_shows_its_progress_and_is_stopped() {
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let ticket = Ticket(log.0.borrow().next_ticket);
    let event = LoadEvent::Progress {
        fraction: 0.42,
        what: "Generating".to_owned(),
    };
    log.0
        .borrow_mut()
        .queue
        .push(Message::Load { ticket, event });
    window.steps(3);
    assert!(
        window
            .harness
            .query_by_label_contains("Generating 42")
            .is_some(),
        "how far it is"
    );
    window.look("desk_loading");
    window.click("Cancel loading");
    assert_eq!(log.0.borrow().cancelled, [ticket]);
    window.steps(3);
    assert!(
        window.harness.query_by_label_contains("stopped").is_some(),
        "and a message tells"
    );
    let late = LoadEvent::Failed {
        message: "late".to_owned(),
        details: String::new(),
        fault: None,
    };
    log.0.borrow_mut().queue.push(Message::Load {
        ticket,
        event: late,
    });
    window.steps(3);
    assert!(
        window.harness.query_by_label("late").is_none(),
        "what comes after is dropped"
    );
}

#[test]
fn another_host_is_asked_about_before_it_is_fetched_from() {
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let json = r#"{ "fabrica": 1, "subject": { "src": "https://scans.example/a.nii.gz" } }"#;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(json));
    let ticket = Ticket(log.0.borrow().next_ticket);
    log.0.borrow_mut().queue.push(Message::AskHost {
        ticket,
        host: "scans.example".to_owned(),
    });
    window.steps(3);
    assert!(
        window
            .harness
            .query_by_label_contains("scans.example")
            .is_some(),
        "names the host"
    );
    assert!(log.0.borrow().allowed.is_empty());
    window.click("Fetch");
    assert_eq!(log.0.borrow().allowed, [ticket]);
}

#[test]
fn a_field_on_another_host_is_asked_about() {
    let log = Fake::default();
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "field", "params": { "src": "https://fields.example/a.nrrd" } },
        { "kind": "field", "params": { "src": "https://fields.example/b.nrrd" } },
        { "kind": "field", "params": { "src": "https://other.example/c.nrrd" } } ] }"#;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(json));
    let asked = || log.0.borrow().fields.len();
    assert_eq!(asked(), 3, "each once");
    let question =
        |host: &str| format!("This document displaces tissue by a file from {host}. Fetch it?");
    let is_asked = |window: &Window, host: &str| {
        let found = window.harness.query_all_by_label(&question(host)).count();
        assert!(found <= 1, "one question about {host}");
        found == 1
    };
    assert!(is_asked(&window, "fields.example") && is_asked(&window, "other.example"));
    assert!(log.0.borrow().field_hosts.is_empty());
    // The newest message stands lowest; the first host's is above it.
    let buttons = window.harness.query_all_by_label("Fetch");
    let first = buttons.map(|button| button.rect().center());
    let first = first.min_by(|a, b| a.y.total_cmp(&b.y)).expect("a button");
    window.click_at(first);
    window.steps(3);
    assert_eq!(log.0.borrow().field_hosts, ["fields.example"]);
    assert_eq!(asked(), 5, "both of that host again, and no other");
    assert!(!is_asked(&window, "fields.example") && is_asked(&window, "other.example"));
}

/// A file of the user's that was read: the bar, under a hash.
fn file_arrives(log: &Fake, ticket: Ticket, before_done: Option<LoadEvent>) {
    let log = &mut *log.0.borrow_mut();
    fabrica::subjects::generate("bar", 32, &mut Queue(log, ticket)).expect("a built-in subject");
    let sha256 = Some("ab".repeat(32));
    let events = before_done.into_iter().chain([LoadEvent::Done { sha256 }]);
    for event in events {
        log.queue.push(Message::Load { ticket, event });
    }
}

/// A file of eight bits a voxel and no segments, as many a CT is kept.
fn bytes_arrive(log: &Fake, ticket: Ticket, before_done: Option<LoadEvent>) {
    let log = &mut *log.0.borrow_mut();
    let grid = Grid {
        dims: glam::UVec3::splat(8),
        world_from_voxel: glam::DAffine3::IDENTITY,
    };
    let voxels: Vec<u8> = (0..512).map(|i| (i / 2) as u8).collect();
    let header = Volume {
        has_size: true,
        grid,
        voxels: Voxels::U8(Vec::new()),
        slope: 1.0,
        intercept: 0.0,
        value_range: [0.0, 0.0],
        segmentation: None,
    };
    let mut queue = Queue(log, ticket);
    for part in [
        SubjectPart::header(header),
        SubjectPart::Scalars(Voxels::U8(voxels)),
    ] {
        queue.take(part).expect("it is taken");
    }
    let sha256 = Some("cd".repeat(32));
    let events = before_done.into_iter().chain([LoadEvent::Done { sha256 }]);
    for event in events {
        log.queue.push(Message::Load { ticket, event });
    }
}

#[test]
fn one_of_several_volumes_is_chosen_and_taken_back() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let ticket = Ticket(99);
    log.file_starts(ticket);
    window.steps(2);
    file_arrives(&log, ticket, Some(LoadEvent::Frames { count: 20 }));
    window.settle();
    let frame = |window: &Window| {
        let subject = window.document().illustration().subject.clone();
        subject.reading().map(|reading| reading.frame)
    };
    assert_eq!(frame(&window), Some(0), "the first is shown");
    window
        .harness
        .get_by_role_and_label(Role::Slider, "Volume")
        .focus();
    window.steps(2);
    window.harness.key_press(egui::Key::ArrowRight);
    window.steps(3);
    assert_eq!(frame(&window), Some(1), "one further");
    let asked = log.0.borrow().loads.last().cloned();
    assert_eq!(
        asked.map(|want| want.reading.frame),
        Some(1),
        "and it is loaded"
    );
    window.click("Undo");
    window.steps(3);
    assert_eq!(frame(&window), Some(0), "and back");
}

/// A file that tells what made its images is called by that, whatever its values look like.
#[test]
fn the_modality_of_a_file_is_told() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let told = |window: &mut Window, code: Option<&str>| {
        let ticket = Ticket(99);
        log.file_starts(ticket);
        window.steps(2);
        let event = code.map(|code| LoadEvent::Modality(code.to_owned()));
        bytes_arrive(&log, ticket, event);
        window.settle();
        window.click("About this scan");
        let facts: Vec<String> = window
            .harness
            .get_all_by_role(Role::Label)
            .filter_map(|node| node.accesskit_node().value())
            .collect();
        window.press(egui::Key::Escape);
        window.click("Panel: Look");
        let colours = window
            .harness
            .get_by_role_and_label(Role::ComboBox, "Colours");
        (facts, colours.accesskit_node().value().unwrap_or_default())
    };
    let (facts, colours) = told(&mut window, Some("CT"));
    let at = facts.iter().position(|line| line == "Modality");
    assert_eq!(facts[at.expect("a line of its own") + 1], "CT", "{facts:?}");
    assert_eq!(colours, "Automatic (CT)");
    let (facts, colours) = told(&mut window, None);
    assert!(!facts.iter().any(|line| line == "Modality"), "{facts:?}");
    assert_eq!(colours, "Automatic (scan)", "the next file tells nothing");
}

#[test]
fn bare_voxels_are_opened_by_what_one_says_of_them() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let ticket = Ticket(99);
    let question = RawQuestion {
        byte_len: Some(4 * 3 * 2),
        is_packed: false,
        guess: Some(RawVoxels {
            size: [4, 3, 2],
            element: "uint8",
            big_endian: false,
            spacing_mm: [1.0; 3],
            skip_bytes: 0,
        }),
    };
    log.file_starts(ticket);
    {
        let queue = &mut log.0.borrow_mut().queue;
        queue.push(Message::Load {
            ticket,
            event: LoadEvent::AskRaw(question),
        });
    }
    window.steps(3);
    window
        .harness
        .get_by_label("The size fits the file to the byte");
    window
        .harness
        .get_by_role_and_label(Role::CheckBox, "High byte first")
        .click();
    window.steps(2);
    // "Open" also stands in the bar above, behind the dialog.
    let buttons = window
        .harness
        .get_all_by_role_and_label(Role::Button, "Open");
    buttons.last().expect("the dialog's").click();
    window.steps(2);
    let answered = log.0.borrow().answered_raw.clone();
    assert_eq!(answered.len(), 1, "one answer");
    assert!(answered[0].1.big_endian, "as the answer was");
    file_arrives(&log, ticket, None);
    window.settle();
    let subject = window.document().illustration().subject.clone();
    let raw = subject.reading().and_then(|reading| reading.raw.clone());
    assert_eq!(raw.as_ref(), Some(&answered[0].1), "kept in the document");
    let json = window.document().to_json_compact();
    assert!(
        json.contains(r#""raw":{"size":[4,3,2],"order":"big"}"#),
        "{json}"
    );
}

#[test]
fn an_opened_file_becomes_the_subject_by_its_hash() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    window
        .harness
        .get_by_role_and_label(Role::Button, "Open")
        .click();
    window.steps(3);
    assert_eq!(log.0.borrow().dialogs, 1);
    let ticket = Ticket(99);
    {
        let log = &mut *log.0.borrow_mut();
        log.file_starts(ticket);
        fabrica::subjects::generate("bar", 32, &mut Queue(log, ticket))
            .expect("a built-in subject");
        let sha256 = Some("ab".repeat(32));
        log.queue.push(Message::Load {
            ticket,
            event: LoadEvent::Done { sha256 },
        });
    }
    window.settle();
    match &window.document().illustration().subject {
        SubjectRef::Supplied { sha256, name, .. } => {
            assert_eq!(*sha256, "ab".repeat(32));
            assert!(name.is_empty(), "never the file's own name");
        }
        other => panic!("the reader's file, not {other:?}"),
    }
    window.click("Undo");
    window.settle();
    assert_eq!(
        window.document().illustration().subject,
        SubjectRef::Builtin {
            name: "cube".to_owned(),
            revision: 1
        }
    );
    let last = log.0.borrow().loads.last().cloned();
    assert_eq!(
        last.map(|want| want.source),
        Some(Source::Builtin {
            name: "cube".to_owned(),
            revision: 1,
        }),
        "and the cube is there again"
    );
}

/// A scan of another shape begins a new document; its templates are a button away, and undo brings all of the old back.
#[test]
fn an_opened_scan_starts_a_document_and_may_keep_the_templates() {
    let log = Fake::default();
    let json = r#"{ "fabrica": 1, "title": "A cube", "subject": { "builtin": "cube" },
        "labels": [{ "at": [0, 0, 0.4], "text": "Lid" }], "templates": [{ "kind": "split" }] }"#;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(json));
    let before = window.document();
    let ticket = Ticket(99);
    log.file_starts(ticket);
    window.steps(2);
    file_arrives(&log, ticket, None);
    window.settle();
    let illustration = window.document().illustration().clone();
    assert!(illustration.templates.is_empty() && illustration.captions.is_empty());
    assert!(illustration.title.is_empty());
    window.look("keep_templates");
    window.click("Keep my templates");
    assert_eq!(window.document().illustration().templates.len(), 1);
    assert!(window.document().illustration().captions.is_empty());
    assert!(window.harness.query_by_label("Keep my templates").is_none());
    window.click("Undo");
    assert!(window.document().illustration().templates.is_empty());
    window.click("Undo");
    window.settle();
    assert_eq!(window.document(), before);
}

/// The parts of a built-in subject at a number of voxels along it, and how that is ended.
fn subject_arrives(log: &Fake, name: &str, resolution: u32, end: LoadEvent) {
    let log = &mut *log.0.borrow_mut();
    let ticket = Ticket(log.next_ticket);
    fabrica::subjects::generate(name, resolution, &mut Queue(log, ticket)).expect("built in");
    log.queue.push(Message::Load { ticket, event: end });
}

#[test]
fn a_picture_that_waits_for_something_says_for_what() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let says = |window: &Window, text: &str| {
        let line = window.harness.query_by_role(Role::Status);
        line.is_some_and(|line| {
            line.accesskit_node()
                .label()
                .is_some_and(|l| l.contains(text))
        })
    };
    assert!(
        window.harness.query_by_role(Role::Status).is_none(),
        "whole"
    );
    log.0.borrow_mut().is_slow = true;
    window
        .harness
        .state_mut()
        .run(fabrica::app::Command::SetSubject(SubjectRef::Builtin {
            name: "bar".to_owned(),
            revision: 1,
        }));
    window.settle();
    assert!(
        says(&window, "Earlier picture"),
        "the cube under another name"
    );
    window.look("provisional_earlier");
    subject_arrives(&log, "bar", 16, LoadEvent::Coarse);
    window.settle();
    window.steps(30);
    assert!(says(&window, "Coarse for now"));
    window.look("provisional_coarse");
    subject_arrives(&log, "bar", 32, LoadEvent::Done { sha256: None });
    log.0.borrow_mut().is_slow = false;
    window.settle();
    assert!(
        window.harness.query_by_role(Role::Status).is_none(),
        "whole again"
    );
}

/// A document that is not at its address is no reason to have no viewer, and takes no place of the last one.
#[test]
fn a_document_that_is_not_there_is_told_in_a_working_viewer() {
    let cases = [
        (WhyMissing::Answer(404), "no document at this address"),
        (WhyMissing::Answer(500), "server did not give"),
        (
            WhyMissing::Unreachable("offline".to_owned()),
            "could not be fetched",
        ),
        (WhyMissing::TooLong, "too long"),
    ];
    for (why, words) in cases {
        let log = Fake::default();
        let kept = fabrica::link::encode(&Document::from_json(CUBE).expect("a document"));
        log.store_value("document", &kept);
        let address = "https://fabrica.example/missing.json".to_owned();
        log.0.borrow_mut().missing = Some(MissingDocument { address, why });
        log.0.borrow_mut().is_slow = true;
        let window = Window::open_with(DESK, egui::Theme::Light, log.clone(), None);
        assert!(window.harness.query_by_label_contains(words).is_some());
        assert_eq!(window.document(), Document::fresh());
        assert!(window.harness.query_by_label("Place peel").is_some());
        assert_eq!(log.0.borrow().stored.get("document"), Some(&kept));
        assert!(log.0.borrow().links.is_empty(), "the address stays");
    }
}

#[test]
fn the_window_and_the_picture_bear_the_title() {
    let mut window = Window::open(DESK, CUBE);
    let title = |window: &Window| window.log.0.borrow().title.clone();
    assert_eq!(title(&window), "Fabrica");
    let edit = fabrica::document::Edit::SetTitle("A cube, cut".to_owned());
    let app = window.harness.state_mut();
    app.run(fabrica::app::Command::Apply(edit));
    window.steps(3);
    assert_eq!(title(&window), "A cube, cut \u{2013} Fabrica");
    let over = |window: &Window| {
        let (role, title) = (Role::Heading, "A cube, cut");
        window
            .harness
            .query_by_role_and_label(role, title)
            .is_some()
    };
    assert!(!over(&window), "only where it is wished");
    window.click("Panel: Text");
    window.click("Show the title over the picture");
    assert!(over(&window));
    window.look("title_over");
    let kept = window.log.0.borrow().stored.get("title").cloned();
    assert_eq!(kept.as_deref(), Some("yes"));
    window.click("Undo");
    assert_eq!(title(&window), "Fabrica");
    assert!(!over(&window));
}

#[test]
fn a_file_that_is_no_scan_is_called_what_it_is() {
    let log = Fake::default();
    let json = r#"{ "fabrica": 1, "subject": { "src": "photo.gif" } }"#;
    log.0.borrow_mut().files = vec![("photo.gif".to_owned(), b"GIF89a\x01\0\x01\0".to_vec())];
    let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(json));
    let line = "photo.gif is an image, not a scan";
    assert!(window.harness.query_by_label(line).is_some());
    window.click("Details");
    let technical = window.harness.query_by_label_contains("not a volume file");
    assert!(technical.is_some(), "the technical words are a button away");
    window.look("no_scan");
}

#[test]
fn documents_and_pictures_are_saved() {
    let mut window = Window::open(
        vec2(900.0, 600.0),
        r#"{ "fabrica": 1, "title": "A cube, cut", "subject": { "builtin": "cube" } }"#,
    );
    window.press_with(Modifiers::COMMAND, Key::S);
    {
        let log = window.log.0.borrow();
        let file = log.saved.last().expect("the document");
        assert_eq!(file.name, "a-cube-cut.json");
        let text = String::from_utf8(file.bytes.clone()).expect("text");
        assert_eq!(
            Document::from_json(&text).expect("a document"),
            window.document()
        );
    }
    window.click("More");
    window.look("more_menu");
    window.click("Save picture");
    let patience = clock() + 120.0;
    while clock() < patience && window.log.0.borrow().saved.len() < 2 {
        window.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let log = window.log.0.borrow();
    let file = log.saved.last().expect("the picture");
    assert_eq!(
        (file.name.as_str(), file.mime),
        ("a-cube-cut.png", "image/png")
    );
    assert_eq!(file.bytes.get(1..4), Some(b"PNG".as_slice()), "a PNG");
}

impl Window {
    /// Steps until a picture is saved, and shows what was seen meanwhile: how far the work was, in the order of frames.
    pub(crate) fn watch_saving(&mut self) -> Vec<f64> {
        let before = self.log.0.borrow().saved.len();
        let patience = clock() + 120.0;
        let mut seen = Vec::new();
        while clock() < patience && self.log.0.borrow().saved.len() == before {
            self.harness.step();
            let work = self.harness.query_by_label("Saving the picture…");
            seen.extend(work.and_then(|work| work.accesskit_node().numeric_value()));
        }
        seen
    }
}

#[test]
fn saving_a_picture_tells_how_far_it_is_and_where_the_file_went() {
    let mut window = Window::open(
        vec2(900.0, 600.0),
        r#"{ "fabrica": 1, "title": "A cube, cut", "subject": { "builtin": "cube" } }"#,
    );
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let seen = window.watch_saving();
    assert!(seen.len() >= 2 && seen.is_sorted(), "{seen:?}");
    assert!(
        seen.iter().all(|part| (0.0..=1.0).contains(part)),
        "{seen:?}"
    );
    assert!(seen.last() > seen.first(), "it went on: {seen:?}");
    window.steps(3);
    assert!(
        window
            .harness
            .query_by_label("Saving the picture…")
            .is_none()
    );
    window
        .harness
        .get_by_label("a-cube-cut.png is in this browser's downloads");
}

#[test]
fn saving_a_picture_can_be_stopped() {
    let mut window = Window::open(vec2(900.0, 600.0), CUBE);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    window.look("saving");
    window.click("Stop saving");
    window
        .harness
        .get_by_label("Saving was stopped; no file was made");
    window.settle();
    assert!(window.log.0.borrow().saved.is_empty(), "no file was made");
    // The next one is made as if nothing had been.
    window.save_small_pictures();
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    window.watch_saving();
    assert_eq!(window.log.0.borrow().saved.len(), 1);
}

/// A script that asks for the picture cannot be told that somebody stopped it.
#[test]
fn a_picture_for_a_script_is_not_offered_to_be_stopped() {
    let mut window = Window::open(vec2(900.0, 600.0), CUBE);
    window.harness.state_mut().ask_for_picture();
    assert_eq!(window.watch_saving(), [0.0; 0]);
    assert_eq!(window.log.0.borrow().saved.len(), 1);
}

#[test]
fn a_picture_saved_from_a_phone_ends_where_the_object_does() {
    let mut window = Window::open(vec2(390.0, 844.0), CUBE);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    window.watch_saving();
    let log = window.log.0.borrow();
    let file = log.saved.last().expect("a picture");
    let picture = image::load_from_memory(&file.bytes)
        .expect("a PNG")
        .to_rgba8();
    if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
        let path = std::path::Path::new(&folder).join("saved_from_a_phone.png");
        picture.save(path).expect("a picture to look at");
    }
    let ground = *picture.get_pixel(0, 0);
    let rows = (0..picture.height())
        .filter(|y| (0..picture.width()).any(|x| *picture.get_pixel(x, *y) != ground));
    let filled = rows.count() as f32 / picture.height() as f32;
    assert!(filled > 0.6, "{filled} of the rows show the object");
}

/// From the drop of a file to the first answer of its reader, the window is not at rest and says that it loads.
#[test]
fn a_file_being_looked_at_is_waited_for() {
    let mut window = Window::open(DESK, CUBE);
    assert!(window.harness.state().is_at_rest(), "the cube is shown");
    assert!(window.harness.query_by_label("Loading").is_none());
    window.log.0.borrow_mut().is_reading = true;
    window.steps(2);
    assert!(!window.harness.state().is_at_rest(), "a file is on its way");
    window.harness.get_by_label("Loading");
    window.log.0.borrow_mut().is_reading = false;
    window.steps(2);
    assert!(window.harness.state().is_at_rest(), "it was none of ours");
    assert!(window.harness.query_by_label("Loading").is_none());
}
