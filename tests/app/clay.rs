//! A clay in the window: it is shaped as far as its strokes are shown, and its captions go with it.

use super::*;
use fabrica::assets::Source;

/// Frames of a short passage, with those until the clay is there, and some more.
const PASSAGE: usize = 24;

/// A horn is pulled up, then pressed aside; the caption stands at the top of the ball.
const PULLED: &str = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05, "tools": [{ "radius": 0.15 }],
    "strokes": [{ "path": [0, 0, 400, 0, 0, 120] }, { "path": [700, 0, 0, -300, 0, 0] }] } },
    "look": { "strokes": 0 }, "labels": [{ "at": [0, 0, 0.5], "text": "Tip" }],
    "steps": [{ "title": "Pulled", "seconds": 0.1, "set": { "/look/strokes": 1 } },
        { "title": "Pressed", "seconds": 0.1, "set": { "/look/strokes": 2 } }] }"#;

impl Window {
    /// Strokes of the clays that were asked for.
    fn strokes_asked(&self) -> Vec<usize> {
        let log = self.log.0.borrow();
        let clays = log.loads.iter().filter_map(|want| match &want.source {
            Source::Clay(clay) => Some(clay.strokes.len()),
            _ => None,
        });
        clays.collect()
    }

    /// How high the caption of the tip stands, points from above.
    fn tip(&self) -> f32 {
        let texts = self.harness.query_all_by_role_and_label(Role::Label, "Tip");
        texts
            .map(|text| text.rect().center().y)
            .fold(f32::MAX, f32::min)
    }
}

#[test]
fn steps_show_a_clay_grow_and_captions_go_with_it() {
    let mut window = Window::open(DESK, PULLED);
    window.settle();
    assert_eq!(window.strokes_asked(), [0]);
    window.look("clay 0");
    let ball = window.tip();
    for (button, strokes) in [("Next step", 1), ("Next step", 2), ("Step before", 1)] {
        window.click(button);
        window.steps(PASSAGE);
        window.settle();
        assert!(window.harness.state().is_at_rest());
        assert_eq!(window.strokes_asked().last(), Some(&strokes));
        window.look(&format!("clay {strokes}"));
        let tip = window.tip();
        assert!(
            tip < ball - 15.0,
            "the tip stands at {tip}, on the ball at {ball}"
        );
    }
    assert_eq!(window.document().illustration().captions[0].at.z, 0.5);
}

/// A caption that is set on pulled tissue is written down where the tissue was in the ball.
#[test]
fn a_caption_is_fastened_to_the_starting_shape() {
    let mut window = Window::open(DESK, &PULLED.replace("\"strokes\": 0", "\"strokes\": 1"));
    window.settle();
    let json = PULLED.replace(r#""labels": [{ "at": [0, 0, 0.5], "text": "Tip" }],"#, "");
    let mut bare = Window::open(DESK, &json.replace("\"strokes\": 0", "\"strokes\": 1"));
    bare.settle();
    bare.click("Panel: Text");
    bare.click("Add a label");
    let up = vec2(0.0, window.tip() - window.picture_center().y);
    // The text stands beside its tissue.
    bare.click_at(bare.picture_center() + up + vec2(0.0, 12.0));
    bare.settle();
    let captions = &bare.document().illustration().captions.clone();
    assert_eq!(captions.len(), 1);
    let at = captions[0].at;
    assert!((at.length() - 0.5).abs() < 0.02 && at.z > 0.4, "{at}");
}

#[test]
fn a_clay_that_cannot_be_made_says_so_once() {
    let text = r#"{ "fabrica": 1, "subject": { "clay": { "from": { "shape": "egg" } } } }"#;
    let mut window = Window::open(DESK, text);
    window.settle();
    window.steps(5);
    assert_eq!(
        window.strokes_asked(),
        [0],
        "it is not asked for again and again"
    );
    let message = window.harness.query_all_by_label_contains("egg");
    assert!(message.count() > 0);
}

/// A corner of 80 mm as a file, and a clay of it whose tip is pulled up; only its hash is known.
const CORNER: &str = "v 0 0 0\nv 80 0 0\nv 0 80 0\nv 0 0 80\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const OF_FILE: &str = r#"{ "fabrica": 1, "subject": { "clay": { "from": { "sha256": "HASH", "name": "Corner", "axes": "ras" },
    "detail": 0.1, "tools": [{ "radius": 0.2 }], "strokes": [{ "path": [-500, -500, 500, 0, 0, 200] }] } },
    "look": { "strokes": 0 }, "steps": [{ "title": "Pulled", "seconds": 0.1, "set": { "/look/strokes": 1 } }] }"#;

/// A mesh file arrives that the reader opened.
fn arrives(window: &mut Window, file: &str) {
    const TICKET: Ticket = Ticket(77);
    let mesh = fabrica::subjects::mesh("apple").expect("a built-in mesh");
    let surface = fabrica::data::Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
    let part = LoadEvent::Part(SubjectPart::Surface(Arc::new(surface)));
    let sha256 = Some(segment_files::hash(file.as_bytes()));
    let log = &mut *window.log.0.borrow_mut();
    log.file_starts(TICKET);
    log.files
        .push(("dropped.obj".to_owned(), file.as_bytes().to_vec()));
    for event in [part, LoadEvent::Done { sha256 }] {
        log.queue.push(Message::Load {
            ticket: TICKET,
            event,
        });
    }
}

#[test]
fn the_file_that_a_clay_waits_for_answers_it() {
    let text = OF_FILE.replace("HASH", &segment_files::hash(CORNER.as_bytes()));
    let mut window = Window::open(DESK, &text);
    window.settle();
    assert_eq!(window.strokes_asked(), [0]);
    let wanted = window.harness.query_all_by_label_contains("Corner");
    assert!(wanted.count() > 0, "the file is asked for by its name");
    // Another one is refused.
    arrives(&mut window, &CORNER.replace("80", "90"));
    window.settle();
    assert_eq!(window.strokes_asked(), [0]);
    arrives(&mut window, CORNER);
    window.settle();
    assert_eq!(window.strokes_asked(), [0, 0]);
    assert!(window.harness.state().is_at_rest());
    let before = window.document().to_json_compact();
    window.click("Next step");
    window.steps(PASSAGE);
    window.settle();
    assert_eq!(window.strokes_asked().last(), Some(&1));
    window.look("clay of a file");
    assert_eq!(
        window.document().to_json_compact(),
        before,
        "nothing was written"
    );
}
