//! A mesh file that is opened while a subject is shown: the reader says what it is to be.

use super::*;
use fabrica::data::Surface;
use fabrica::document::ObjectSource;

const TICKET: Ticket = Ticket(77);

/// A mesh file arrives that the reader opened.
fn arrives(window: &mut Window, sha256: &str) {
    let mesh = fabrica::subjects::mesh("apple").expect("a built-in mesh");
    let surface = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
    {
        let log = &mut *window.log.0.borrow_mut();
        log.file_starts(TICKET);
        let part = LoadEvent::Part(SubjectPart::Surface(Arc::new(surface)));
        let sha256 = Some(sha256.to_owned());
        let events = [part, LoadEvent::Done { sha256 }];
        let events = events.map(|event| Message::Load {
            ticket: TICKET,
            event,
        });
        log.queue.extend(events);
    }
    window.steps(6);
}

fn hash(byte: &str) -> String {
    byte.repeat(32)
}

/// The cube far away, so that little is drawn; later loads are answered by nobody.
fn open() -> Window {
    let json =
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "camera": { "distance": 20 } }"#;
    let mut window = Window::open(DESK, json);
    window.log.0.borrow_mut().is_slow = true;
    window.steps(1);
    window
}

const QUESTION: &str = "What is this mesh?";

fn is_asked(window: &Window) -> bool {
    window.harness.query_by_label(QUESTION).is_some()
}

#[test]
fn a_mesh_becomes_the_subject_by_a_click() {
    let mut window = open();
    arrives(&mut window, &hash("0a"));
    assert!(is_asked(&window));
    window.look("dropped_mesh");
    assert_eq!(
        window.document().get("/subject/builtin"),
        Some(&"cube".into())
    );
    window.click("The subject");
    window.steps(3);
    assert!(!is_asked(&window));
    let wanted = serde_json::json!(hash("0a"));
    assert_eq!(window.document().get("/subject/sha256"), Some(&wanted));
    window.undo();
    assert_eq!(
        window.document().get("/subject/builtin"),
        Some(&"cube".into())
    );
}

#[test]
fn a_mesh_becomes_an_object_by_the_keyboard() {
    let mut window = open();
    arrives(&mut window, &hash("0b"));
    // The keyboard begins at the first answer.
    window.press(Key::Tab);
    window.press(Key::Tab);
    window.press(Key::Space);
    assert!(!is_asked(&window));
    let objects = window.document().illustration().objects.clone();
    assert_eq!(objects.len(), 1);
    let ObjectSource::File { sha256, .. } = &objects[0].source else {
        panic!("a file: {:?}", objects[0]);
    };
    assert_eq!(*sha256, Some(hash("0b")));
    assert_eq!(
        (objects[0].name.as_str(), objects[0].placement),
        ("object", None)
    );
    assert_eq!(window.harness.state().selected_object(), Some(0));
    window.harness.get_by_label("It lies where its file says.");
    window.click("Place it freely");
    assert!(
        window.document().illustration().objects[0]
            .placement
            .is_some()
    );
    window.undo();
    window.undo();
    assert!(window.document().illustration().objects.is_empty());
}

#[test]
fn a_mesh_becomes_the_tool_of_a_sweep() {
    let mut window = open();
    let before = window.document();
    arrives(&mut window, &hash("0d"));
    window.click("A tool in hand");
    assert!(!is_asked(&window));
    assert_eq!(window.document(), before, "nothing is swept yet");
    window.drag(window.picture_center(), vec2(40.0, 0.0));
    let document = window.document();
    let tool = document.get("/templates/0/params/tools/0");
    let tool = tool.expect("a sweep of one tool");
    assert_eq!(
        (&tool["shape"], &tool["sha256"]),
        (&"mesh".into(), &hash("0d").into())
    );
    window.undo();
    assert_eq!(window.document(), before);
}

#[test]
fn escape_leaves_a_mesh() {
    let mut window = open();
    let before = window.document();
    arrives(&mut window, &hash("0c"));
    assert!(is_asked(&window));
    window.press(Key::Escape);
    assert!(!is_asked(&window));
    assert_eq!(window.document(), before);
    arrives(&mut window, &hash("0c"));
    window.click("Leave it");
    assert!(!is_asked(&window));
    assert_eq!(window.document(), before);
}

#[test]
fn a_second_mesh_becomes_a_part_of_the_subject() {
    let mut window = open();
    arrives(&mut window, &hash("0a"));
    window.click("The subject");
    window.steps(3);
    arrives(&mut window, &hash("0b"));
    window.click("A part of the subject");
    let document = window.document();
    let wanted = serde_json::json!([{ "sha256": hash("0b") }]);
    assert_eq!(document.get("/subject/meshes"), Some(&wanted));
    let bounds = document.get("/subject/box").and_then(|b| b.as_array());
    assert_eq!(bounds.map(Vec::len), Some(6), "so that nothing moves");
    window.undo();
    assert_eq!(window.document().get("/subject/meshes"), None);
    assert_eq!(window.document().get("/subject/box"), None);
}

/// Beside a scan a mesh is drawn with it, and its segments are tissues.
#[test]
fn a_mesh_lies_beside_a_scan() {
    let mut window = open();
    arrives(&mut window, &hash("0b"));
    window.click("A part of the subject");
    window.steps(3);
    let document = window.document();
    let wanted = serde_json::json!([{ "sha256": hash("0b") }]);
    assert_eq!(document.get("/subject/meshes"), Some(&wanted));
    assert_eq!(document.get("/subject/box"), None, "the cube's box decides");
    assert_eq!(document.get("/subject/builtin"), Some(&"cube".into()));
    let (want, ticket) = {
        let log = window.log.0.borrow();
        let want = log.loads.last().expect("it is asked for").clone();
        (want, Ticket(log.next_ticket))
    };
    assert_eq!(want.role, fabrica::assets::Role::Mesh);
    let bounds = want.reading.bounds.expect("the cube's box");
    assert!(bounds.middle_mm().length() < 1e-9, "from its centre");
    let mesh = fabrica::subjects::mesh("apple").expect("a built-in mesh");
    let within = Some([bounds.min_mm, bounds.max_mm]);
    let surface = Surface::of(&[(&mesh, None)], within, &mut |_| true).expect("it has a size");
    let names: Vec<String> = surface.segments.iter().map(|s| s.name.clone()).collect();
    let events = [
        LoadEvent::Part(SubjectPart::Surface(Arc::new(surface))),
        LoadEvent::Done {
            sha256: Some(hash("0b")),
        },
    ];
    let events = events.map(|event| Message::Load { ticket, event });
    window.log.0.borrow_mut().queue.extend(events);
    window.steps(6);
    let drawn = window.harness.state().segment_names();
    for name in &names {
        assert!(drawn.contains(name), "{name} is none of {drawn:?}");
    }
    window.click("Panel: Tissues");
    window.harness.get_by_label("body");
    window.look("mesh_beside");
    window.undo();
    window.steps(3);
    let drawn = window.harness.state().segment_names();
    assert!(!drawn.contains(&names[0]), "{drawn:?}");
}

#[test]
fn the_file_that_the_document_waits_for_needs_no_question() {
    let json = format!(
        r#"{{ "fabrica": 1, "subject": {{ "sha256": "{}" }}, "camera": {{ "distance": 20 }} }}"#,
        hash("0d")
    );
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(&json));
    arrives(&mut window, &hash("0d"));
    assert!(!is_asked(&window));
}
