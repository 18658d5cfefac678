//! A clay in the window: it is shaped as far as its strokes are shown, and its captions go with it.

use super::figures::{apart, drawn};
use super::*;
use fabrica::app::{ClayCommand, HandCommand, HeldTool, StrokeWay};
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

/// The strip shows each step with its own strokes, from when the step is shown.
#[test]
fn the_strip_shows_a_clay_grow() {
    let mut window = Window::open(DESK, PULLED);
    window.settle();
    let names = ["Start", "Step 1: Pulled", "Step 2: Pressed"];
    let pictures = |window: &mut Window| names.map(|name| window.step_picture(name));
    // A tile without a picture has corners of another colour.
    let are_drawn = |pictures: &[image::RgbaImage; 3]| pictures.each_ref().map(|p| drawn(p) > 60);
    let first = pictures(&mut window);
    assert_eq!(are_drawn(&first), [true, false, false]);
    window.click("Next step");
    window.steps(PASSAGE);
    window.settle();
    window.look("clay_strip");
    let second = pictures(&mut window);
    assert_eq!(are_drawn(&second), [true, true, false]);
    let horn = apart(&second[0], &second[1]);
    assert!(horn > 20, "a ball has no horn: {horn} pixels apart");
    let kept = apart(&first[0], &second[0]);
    assert!(
        kept < horn / 4,
        "the start stays as it was: {kept} of {horn}"
    );
}

/// A clay of many strokes, small ones around a ball.
fn of_many_strokes(count: usize) -> String {
    let strokes = (0..count).map(|i| {
        let angle = i as f32;
        let [x, y] = [angle.cos(), angle.sin()].map(|part| (500.0 * part) as i32);
        serde_json::json!({ "path": [x, y, 0, 0, 0, 40] })
    });
    let strokes: Vec<_> = strokes.collect();
    let clay = serde_json::json!({ "detail": 0.1, "strokes": strokes });
    serde_json::json!({ "fabrica": 1, "subject": { "clay": clay } }).to_string()
}

/// What is opened is seen at once as it starts, and then as far as its strokes are done; nothing of that is written
/// down.
#[test]
fn a_clay_that_is_opened_grows() {
    let mut window = Window::open(DESK, &of_many_strokes(20));
    let before = window.document().to_json_compact();
    window.settle();
    assert_eq!(window.strokes_asked(), [0, 8, 20]);
    assert!(window.harness.state().is_at_rest());
    assert_eq!(window.document().to_json_compact(), before);
    // Taken back, it is not opened again.
    window.run_command(fabrica::app::Command::Clay(ClayCommand::Remove(19)));
    window.settle();
    assert_eq!(window.strokes_asked(), [0, 8, 20, 19]);
}

/// Whoever stops it sees what is done, and is asked nothing; the document has all of its strokes.
#[test]
fn a_clay_that_grows_can_be_stopped() {
    let mut window = Window::open(DESK, &of_many_strokes(0));
    window.settle();
    window.log.0.borrow_mut().is_slow = true;
    let text = of_many_strokes(20);
    let message = Message::OpenText { text };
    window.log.0.borrow_mut().queue.push(message);
    window.steps(4);
    assert_eq!(window.strokes_asked(), [0, 8]);
    window.click("Cancel loading");
    window.steps(5);
    assert_eq!(window.strokes_asked(), [0, 8], "no more is asked for");
    assert_eq!(window.strokes().len(), 20);
    window.log.0.borrow_mut().is_slow = false;
    window.run_command(fabrica::app::Command::Clay(ClayCommand::Remove(19)));
    window.settle();
    assert_eq!(window.strokes_asked(), [0, 8, 19], "what changes is done");
    assert!(window.harness.state().is_at_rest());
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

impl Window {
    /// Strokes of the document's clay.
    fn strokes(&self) -> Vec<fabrica::document::ClayStroke> {
        match &self.document().illustration().subject {
            fabrica::document::SubjectRef::Clay(clay) => clay.strokes.clone(),
            other => panic!("{other:?}"),
        }
    }

    /// Waits until the gesture that has just ended is a stroke of so many.
    fn wait_for_strokes(&mut self, count: usize) {
        let patience = clock() + 60.0;
        while clock() < patience && self.strokes().len() != count {
            self.steps(1);
        }
        self.settle();
        assert_eq!(self.strokes().len(), count);
        assert!(self.harness.state().is_at_rest());
    }
}

#[test]
fn a_clay_is_shaped_by_hand() {
    let json = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05 } } }"#;
    let mut window = Window::open(DESK, json);
    window.settle();
    window.click("Shape the clay");
    let middle = window.picture_center();
    window.drag(middle - vec2(60.0, 40.0), vec2(-90.0, -90.0));
    window.wait_for_strokes(1);
    window.look("clay shaped by hand");
    let stroke = window.strokes().remove(0);
    assert_eq!((stroke.mirror, stroke.smooth), ([true, false, false], None));
    let [first, .., last] = &stroke.moves[0].keys[..] else {
        panic!("a way: {stroke:?}")
    };
    // Up and to the left in the picture, which is the patient's right.
    assert!(last.at[2] > first.at[2] + 100 && last.at[0] > first.at[0] + 100);
    assert_eq!(window.strokes_asked().last(), Some(&1), "it is shaped");
    // Another tool, pulled along the normal; all of it is one step of undo.
    window.click("Larger tool");
    window.run_command(fabrica::app::Command::Hand(HandCommand::Hold(HeldTool {
        way: StrokeWay::Push,
        ..HeldTool::default()
    })));
    window.drag(middle, vec2(0.0, -80.0));
    window.wait_for_strokes(2);
    window.look("clay pulled by hand");
    window.undo();
    window.wait_for_strokes(1);
    assert_eq!(window.strokes_asked().last(), Some(&1));
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.wait_for_strokes(2);
    // Over the surface.
    window.run_command(fabrica::app::Command::Hand(HandCommand::Hold(HeldTool {
        way: StrokeWay::Smooth,
        ..HeldTool::default()
    })));
    window.drag(middle, vec2(40.0, 0.0));
    window.wait_for_strokes(3);
    assert_eq!(window.strokes()[2].smooth, Some(50));
    // Beside the clay a drag turns the view.
    let camera = |window: &Window| window.document().illustration().camera;
    let before = camera(&window);
    let height = window.harness.get_by_role(Role::Image).rect().height();
    window.drag(middle - vec2(0.0, 0.47 * height), vec2(60.0, 0.0));
    window.settle();
    assert_eq!(window.strokes().len(), 3);
    assert_ne!(camera(&window), before);
    // The list: one is hidden, one is removed, fewer are shown.
    window.click("Put the tool away");
    window.click("Hide Stroke 2");
    window.settle();
    assert!(window.strokes()[1].is_off);
    window.click("Remove stroke 3");
    window.wait_for_strokes(2);
    // One is selected: the keys of its path are dragged in the picture.
    window.click("Stroke 1");
    window.settle();
    window.look("stroke of a clay");
    let key = |window: &Window| window.strokes()[0].moves[0].keys[0].at;
    let (before, dot) = (key(&window), "Key 1 of tool 1");
    let spot = window.harness.get_by_label(dot).rect().center();
    window.drag(spot, vec2(-30.0, 0.0));
    window.settle();
    assert!(key(&window)[0] > before[0] + 20 && key(&window)[2] == before[2]);
    window.undo();
    assert_eq!(key(&window), before, "one step of undo");
    let show = |strokes: u32| {
        let pointer = "/look/strokes".to_owned();
        let name = String::new();
        let value = Some(serde_json::json!(strokes));
        fabrica::app::Command::Apply(fabrica::document::Edit::put(pointer, value, name))
    };
    window.run_command(show(1));
    window.settle();
    assert_eq!(window.strokes_asked().last(), Some(&1));
    window.press(Key::Escape);
    window.click("Shape the clay");
    let said = window
        .harness
        .query_all_by_label_contains("to the end first");
    assert!(said.count() > 0);
    window.look("strokes of a clay");
}

#[test]
fn a_clay_is_begun_from_the_list_of_subjects() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#,
    );
    window.settle();
    window.click("Subject");
    window.steps(2);
    window.harness.get_by_label("Ring of clay").scroll_to_me();
    window.steps(3);
    window.click("Ring of clay");
    window.settle();
    assert!(window.strokes().is_empty());
    assert_eq!(window.strokes_asked(), [0]);
    window.look("ring of clay");
    let put_away = window.harness.query_by_label("Put the tool away");
    assert!(put_away.is_some(), "the tool is in hand");
    window.press(Key::Escape);
    window.undo();
    assert!(window.document().to_json().contains("cube"));
    assert_eq!(window.log.0.borrow().clays_gone, 1);
}

/// What the strokes of a clay have left is given back once there is none, also where the next subject cannot be had.
#[test]
fn a_clay_is_let_go_with_its_document() {
    let absent = format!(r#"{{ "sha256": "{}" }}"#, "0".repeat(64));
    let documents = [
        (r#"{ "clay": { "detail": 0.06 } }"#, 0),
        (r#"{ "clay": { "from": { "shape": "cube" } } }"#, 0),
        (r#"{ "builtin": "cube" }"#, 1),
        (r#"{ "clay": { "detail": 0.06 } }"#, 1),
        (&absent, 2),
    ];
    let mut window = Window::open(DESK, r#"{ "fabrica": 1 }"#);
    for (subject, gone) in documents {
        let text = format!(r#"{{ "fabrica": 1, "subject": {subject} }}"#);
        let message = Message::OpenText { text };
        window.log.0.borrow_mut().queue.push(message);
        window.steps(3);
        assert_eq!(window.log.0.borrow().clays_gone, gone, "{subject}");
    }
}

#[test]
fn a_clay_is_begun_with_what_is_shown() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "piggybank" } }"#,
    );
    window.settle();
    for (item, part) in [("Outer surface", "\"iso\""), ("Coins", "\"segment\"")] {
        window.click("Panel: Tissues");
        window.click("Shape it as clay");
        window.steps(2);
        let items = window
            .harness
            .query_all_by_role_and_label(Role::Button, item);
        let item = items.last().expect("an item of the menu");
        item.click();
        window.steps(3);
        window.settle();
        let json = window.document().to_json();
        assert!(json.contains(part) && json.contains("piggybank"), "{json}");
        assert_eq!(window.strokes_asked().last(), Some(&0));
        window.look(&format!("clay of {part}"));
        assert!(window.harness.query_by_label("Put the tool away").is_some());
        window.press(Key::Escape);
        window.press(Key::Z);
        let is_named = window
            .harness
            .query_by_label("Hide the edges of the triangles");
        assert!(is_named.is_some(), "the edges are shown");
        window.settle();
        window.look(&format!("wires of {part}"));
        window.press(Key::Z);
        window.undo();
        assert!(!window.document().to_json().contains("clay"));
        window.settle();
    }
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
    let is_at_rest = window.harness.state().is_at_rest();
    assert!(is_at_rest, "nothing goes on while the file is missing");
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

impl Window {
    /// A clay with a tool of this form in the hand, and the pointer over its middle.
    fn with_clay_tool(form: usize) -> Self {
        let json = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05 } } }"#;
        let mut window = Self::open(DESK, json);
        window.settle();
        window.click("Shape the clay");
        window.run_command(fabrica::app::Command::Hand(HandCommand::Hold(HeldTool {
            form,
            ..HeldTool::default()
        })));
        window.harness.hover_at(window.picture_center());
        window.settle();
        window
    }

    /// Draws a short stroke, and gives the tool that it was made by.
    fn drawn_tool(&mut self) -> fabrica::document::ClayTool {
        let count = self.strokes().len();
        self.drag(self.picture_center(), vec2(-40.0, 0.0));
        self.wait_for_strokes(count + 1);
        let tool = self.strokes()[count].moves[0].tool;
        match &self.document().illustration().subject {
            fabrica::document::SubjectRef::Clay(clay) => clay.tools[tool].clone(),
            other => panic!("{other:?}"),
        }
    }

    /// Goes with the pointer while a key is held, and turns the wheel by so many points.
    fn hold(&mut self, modifiers: Modifiers, key: Key, by: Vec2, wheel: f32) {
        let from = self.picture_center();
        self.harness.hover_at(from);
        self.steps(2);
        self.harness.event(egui::Event::ModifiersChanged(modifiers));
        self.harness.key_down(key);
        self.steps(2);
        self.harness.hover_at(from + by);
        self.steps(2);
        if wheel != 0.0 {
            self.harness.event(egui::Event::MouseWheel {
                unit: egui::MouseWheelUnit::Point,
                delta: vec2(0.0, wheel),
                phase: egui::TouchPhase::Move,
                source: egui::MouseWheelSource::Unknown,
                modifiers,
            });
            self.steps(3);
        }
        self.harness.key_up(key);
        self.harness
            .event(egui::Event::ModifiersChanged(Modifiers::NONE));
        self.settle();
    }
}

#[test]
fn held_keys_size_the_tool_and_its_coating() {
    let mut window = Window::with_clay_tool(0);
    let camera = |window: &Window| window.document().illustration().camera;
    let before = camera(&window);
    let radius = |tool: &fabrica::document::ClayTool| match tool.shape {
        Some(fabrica::document::ToolShape::Ball { radius }) => radius,
        ref other => panic!("{other:?}"),
    };
    let first = window.drawn_tool();
    window.hold(Modifiers::NONE, Key::F, vec2(30.0, 0.0), 0.0);
    let larger = window.drawn_tool();
    assert!(radius(&larger) > radius(&first) + 0.02, "{larger:?}");
    assert_eq!(larger.coat, first.coat);
    window.hold(Modifiers::SHIFT, Key::F, vec2(-15.0, 0.0), 0.0);
    let thinner = window.drawn_tool();
    assert!(thinner.coat < first.coat - 0.01, "{thinner:?}");
    assert_eq!(radius(&thinner), radius(&larger));
    window.hold(Modifiers::NONE, Key::F, Vec2::ZERO, 80.0);
    let wheeled = window.drawn_tool();
    assert!(radius(&wheeled) > radius(&larger), "{wheeled:?}");
    window.hold(Modifiers::SHIFT, Key::F, Vec2::ZERO, 80.0);
    let coated = window.drawn_tool();
    assert!(coated.coat > thinner.coat, "{coated:?}");
    assert_eq!(camera(&window), before, "the view stays");
    let search = window.harness.query_by_label("Put the tool away");
    assert!(search.is_some(), "the keys do nothing else");
}

#[test]
fn a_held_key_turns_the_tool() {
    // A box.
    let mut window = Window::with_clay_tool(3);
    let mut drawn = || {
        window.drawn_tool();
        let turn = window.strokes()[0].moves[0].keys[0].turn;
        window.undo();
        window.wait_for_strokes(0);
        window.hold(Modifiers::NONE, Key::R, vec2(60.0, 0.0), 0.0);
        let vector = glam::Vec3::from_array(turn.map(|degrees| (degrees as f32).to_radians()));
        glam::Quat::from_scaled_axis(vector)
    };
    let [before, after] = [drawn(), drawn()];
    let angle = before.angle_between(after).to_degrees();
    assert!((angle - 30.0).abs() < 2.5, "{angle}: {before} {after}");
    let angle = window.harness.query_all_by_label_contains("Angle");
    assert!(angle.count() > 0, "the panel has it");
}

#[test]
fn shift_on_the_way_keeps_to_an_axis() {
    let mut window = Window::with_clay_tool(0);
    let middle = window.picture_center();
    window.drag_on(middle, vec2(-40.0, 25.0), 4);
    window
        .harness
        .event(egui::Event::ModifiersChanged(Modifiers::SHIFT));
    window.steps(2);
    window.harness.hover_at(middle + vec2(-80.0, 30.0));
    window.steps(2);
    window.harness.drop_at(middle + vec2(-80.0, 30.0));
    window.steps(2);
    window
        .harness
        .event(egui::Event::ModifiersChanged(Modifiers::NONE));
    window.wait_for_strokes(1);
    let stroke = window.strokes().remove(0);
    assert_eq!(stroke.smooth, None);
    let [first, last] = &stroke.moves[0].keys[..] else {
        panic!("a straight way: {stroke:?}")
    };
    assert!(last.at[0] > first.at[0] + 100, "{stroke:?}");
    assert!((last.at[2] - first.at[2]).abs() <= 1, "{stroke:?}");
    // Before the press it smooths.
    window
        .harness
        .event(egui::Event::ModifiersChanged(Modifiers::SHIFT));
    window.drag(middle, vec2(40.0, 0.0));
    window.wait_for_strokes(2);
    assert_eq!(window.strokes()[1].smooth, Some(50));
}

/// On a phone two sliders at the edge of the picture size the tool and its coating; with a mouse there are none.
#[test]
fn fingers_have_sliders_for_size_and_coating() {
    const NAMES: [&str; 2] = ["Size of the tool", "Coating of the tool"];
    let desk = Window::with_clay_tool(0);
    for name in NAMES {
        assert!(desk.harness.query_by_label(name).is_none(), "{name}");
    }
    let json = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05 } } }"#;
    let mut window = Window::open(vec2(390.0, 844.0), json);
    window.settle();
    assert!(window.harness.query_by_label(NAMES[0]).is_none());
    window.run_command(fabrica::app::Command::Clay(ClayCommand::Toggle));
    window.settle();
    window.look("sliders for fingers");
    let first = window.drawn_tool();
    let before = window.document().illustration().camera;
    let [size, coat] = NAMES.map(|name| {
        let slider = window.harness.get_by_role_and_label(Role::Slider, name);
        slider.rect()
    });
    let picture = window.harness.get_by_role(Role::Image).rect();
    for slider in [size, coat] {
        assert!(
            slider.width() >= 44.0 && slider.height() >= 44.0,
            "{slider}"
        );
        assert!(picture.contains_rect(slider), "{slider} in {picture}");
    }
    // The letter of the patient's side stands between them.
    let middle = picture.left_center().y;
    assert!(
        size.bottom() < middle - 10.0 && coat.top() > middle + 10.0,
        "{size} {coat} {middle}"
    );
    // Up is larger.
    let up = |slider: egui::Rect| vec2(0.0, -0.3 * slider.height());
    window.drag_on(size.center(), up(size), 4);
    window.look("slider for fingers held");
    window.harness.drop_at(size.center() + up(size));
    window.drag(coat.center(), -up(coat));
    let fitted = window.drawn_tool();
    let half = |tool: &fabrica::document::ClayTool| {
        let shape = tool.shape.as_ref().expect("a shape");
        shape.half_side()
    };
    assert!(half(&fitted) > half(&first) + 0.05, "{fitted:?}");
    assert!(fitted.coat < first.coat - 0.02, "{fitted:?}");
    assert_eq!(
        window.document().illustration().camera,
        before,
        "the view stays"
    );
    // With the keyboard, too.
    window.harness.get_by_label(NAMES[0]).focus();
    window.steps(2);
    for _ in 0..4 {
        window.press(Key::ArrowDown);
    }
    let smaller = window.drawn_tool();
    assert!(half(&smaller) < half(&fitted), "{smaller:?}");
    window.run_command(fabrica::app::Command::Clay(ClayCommand::Toggle));
    assert!(window.harness.query_by_label(NAMES[0]).is_none());
}

impl Window {
    /// How many thin lines there are in the picture whose strongest part is red, green or blue: those of the planes of
    /// mirror images.
    fn lines_of_planes(&self) -> [usize; 3] {
        fn count(shape: &egui::Shape, counts: &mut [usize; 3]) {
            match shape {
                egui::Shape::LineSegment { stroke, .. } if stroke.width == 1.0 => {
                    let [r, g, b, _] = stroke.color.to_array();
                    let parts = [r, g, b];
                    let others = |i: usize| (0..3).filter(move |j| *j != i).map(move |j| parts[j]);
                    for i in 0..3 {
                        if others(i).all(|other| parts[i] > other.saturating_add(25)) {
                            counts[i] += 1;
                        }
                    }
                }
                egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| count(shape, counts)),
                _ => {}
            }
        }
        let mut counts = [0; 3];
        for clipped in &self.harness.output().shapes {
            count(&clipped.shape, &mut counts);
        }
        counts
    }
}

/// Each plane of mirror images is drawn while the clay is worked on, and in no other picture.
#[test]
fn planes_of_symmetry_are_shown() {
    let mut window = Window::with_clay_tool(0);
    window.look("plane of symmetry");
    let [x, none_of_y, none_of_z] = window.lines_of_planes();
    assert!(
        x > 30 && none_of_y < 4 && none_of_z < 4,
        "{x} {none_of_y} {none_of_z}"
    );
    for axis in ["y", "z"] {
        window.click(&format!("Mirror across {axis}"));
    }
    window.look("three planes of symmetry");
    let all = window.lines_of_planes();
    assert!(all.iter().all(|count| *count > 30), "{all:?}");
    window.save_small_pictures();
    let saved = window.saved_picture();
    // Presented, the picture stands alone.
    window.press(Key::P);
    assert!(window.lines_of_planes().iter().all(|count| *count < 4));
    window.press(Key::P);
    for axis in ["y", "z"] {
        window.click(&format!("Mirror across {axis}"));
    }
    window
        .harness
        .get_all_by_label("Mirror across x")
        .next()
        .expect("a switch")
        .click();
    window.steps(3);
    assert!(window.lines_of_planes().iter().all(|count| *count < 4));
    let bare = window.saved_picture();
    assert!(bare == saved, "no saved picture has them");
    window.press(Key::Escape);
    assert!(window.lines_of_planes().iter().all(|count| *count < 4));
}

#[test]
fn a_tool_is_turned_about_the_line_of_sight() {
    let mut window = Window::with_clay_tool(3);
    window.choose("What a drag does", "Turn in view");
    // Near the edge of the ball, where the normal leaves the line of sight.
    let from = window.picture_center() + vec2(0.0, -90.0);
    window.drag(from, vec2(60.0, 0.0));
    window.wait_for_strokes(1);
    let turn = window.strokes()[0].moves[0].keys[1].turn;
    let [x, y, z] = turn.map(i32::abs);
    assert!(
        y > 20 && x <= 1 && z <= 1,
        "from the front it is y: {turn:?}"
    );
    window.look("clay turned about the line of sight");
    window.undo();
    window.wait_for_strokes(0);
}

/// Up pulls, from inside the clay; with Alt it pushes, from outside, wherever on the way the key goes down.
#[test]
fn alt_turns_push_and_pull_over() {
    let mut window = Window::with_clay_tool(0);
    window.run_command(fabrica::app::Command::Hand(HandCommand::Hold(HeldTool {
        way: StrokeWay::Push,
        ..HeldTool::default()
    })));
    let (middle, by) = (window.picture_center(), vec2(0.0, -60.0));
    let alt = |window: &mut Window, modifiers| {
        window
            .harness
            .event(egui::Event::ModifiersChanged(modifiers));
        window.steps(2);
    };
    // The viewer stands at the front, where y is positive.
    let mut drawn = |alt_before: bool, alt_after: bool| {
        if alt_before {
            alt(&mut window, Modifiers::ALT);
        }
        window.drag_on(middle, by, 4);
        if alt_after != alt_before {
            let modifiers = if alt_after {
                Modifiers::ALT
            } else {
                Modifiers::NONE
            };
            alt(&mut window, modifiers);
        }
        window.harness.drop_at(middle + by);
        window.steps(2);
        alt(&mut window, Modifiers::NONE);
        window.wait_for_strokes(1);
        let stroke = window.strokes().remove(0);
        window.undo();
        window.wait_for_strokes(0);
        let [from, to] = &stroke.moves[0].keys[..] else {
            panic!("a way: {stroke:?}")
        };
        [from.at[1], to.at[1] - from.at[1]]
    };
    let [inside, pulled] = drawn(false, false);
    assert!(inside < 500 && pulled > 100, "{inside} {pulled}");
    for (before, after) in [(true, true), (false, true)] {
        let [outside, pushed] = drawn(before, after);
        assert!(outside > 550 && pushed == -pulled, "{outside} {pushed}");
    }
    assert_eq!(drawn(true, false), [inside, pulled], "Alt was let go");
}

#[test]
fn a_stroke_is_moved_in_the_list() {
    let mut window = Window::open(DESK, PULLED);
    window.settle();
    let before = window.document().to_json_compact();
    let height = |window: &Window, i: usize| window.strokes()[i].moves[0].keys[0].at[2];
    window.click("Stroke 1");
    window.settle();
    window.look("stroke to be moved");
    window.click("Move stroke 1 up: it acts later");
    window.settle();
    assert_eq!([height(&window, 0), height(&window, 1)], [0, 400]);
    let shown = window.document().illustration().look.strokes;
    assert_eq!(shown, Some(0), "as many are shown");
    window.press(Key::PageDown);
    window.settle();
    assert_eq!([height(&window, 0), height(&window, 1)], [400, 0]);
    window.undo();
    window.undo();
    window.settle();
    assert_eq!(window.document().to_json_compact(), before);
}

/// The selected stroke has rows for form, size and coating of its tool, and for its mirror images: each is one step of
/// undo, and the strokes behind it are done again.
#[test]
fn the_tool_of_a_stroke_is_changed() {
    let mut window = Window::open(DESK, &PULLED.replace("\"strokes\": 0", "\"strokes\": 2"));
    window.settle();
    let before = window.document().to_json_compact();
    let tool = |window: &Window, stroke: usize| match &window.document().illustration().subject {
        fabrica::document::SubjectRef::Clay(clay) => {
            clay.tools[clay.strokes[stroke].moves[0].tool].clone()
        }
        other => panic!("{other:?}"),
    };
    let other = tool(&window, 1);
    assert!(
        window.harness.query_by_label("Tool 1").is_none(),
        "none is selected"
    );
    window.click("Stroke 1");
    window.settle();
    window.look("tool of a stroke");
    let asked = window.strokes_asked().len();
    window.type_into("Size", "0.3");
    window.settle();
    assert_eq!(
        tool(&window, 0).shape.map(|shape| shape.half_side()),
        Some(0.3)
    );
    assert_eq!(tool(&window, 1), other, "the other stroke keeps its tool");
    assert_eq!(window.strokes_asked()[asked..], [2], "both are done again");
    window.type_into("Coating", "0.25");
    window.choose("Tool 1", "Ring");
    window.click("Mirror across z");
    window.settle();
    window.look("tool of a stroke changed");
    let ring = fabrica::document::ClayTool {
        shape: Some(fabrica::document::ToolShape::Torus {
            ring: 0.225,
            radius: 0.075,
        }),
        coat: 0.25,
    };
    assert_eq!(tool(&window, 0), ring);
    assert_eq!(window.strokes()[0].mirror, [false, false, true]);
    // From the last to the first.
    window.undo();
    assert_eq!(window.strokes()[0].mirror, [false; 3]);
    window.undo();
    assert_eq!(
        tool(&window, 0).shape.map(|shape| shape.half_side()),
        Some(0.3)
    );
    window.undo();
    assert_eq!(tool(&window, 0).coat, other.coat);
    window.undo();
    window.settle();
    assert_eq!(window.document().to_json_compact(), before);
    // A slider that is dragged is one step as well.
    let slider = window
        .harness
        .get_by_role_and_label(Role::Slider, "Size slider");
    let rect = slider.rect();
    window.drag(rect.center(), vec2(0.2 * rect.width(), 0.0));
    assert_ne!(tool(&window, 0), other);
    assert_eq!(tool(&window, 1), other);
    window.undo();
    assert_eq!(window.document().to_json_compact(), before);
}

/// A replay that is stopped midway: the document has all of its strokes, and what undo brings is shown.
#[test]
fn a_stopped_replay_loses_nothing() {
    let json = PULLED.replace("\"strokes\": 0", "\"strokes\": 2");
    let mut window = Window::open(DESK, &json);
    window.settle();
    let (before, shown) = (window.document().to_json_compact(), window.tip());
    window.click("Stroke 1");
    window.log.0.borrow_mut().is_slow = true;
    window.click("Move stroke 1 up: it acts later");
    window.steps(3);
    let moved = window.document().to_json_compact();
    assert_ne!(moved, before);
    window.click("Cancel loading");
    window.steps(5);
    assert_eq!(
        window.document().to_json_compact(),
        moved,
        "all strokes are there"
    );
    window.log.0.borrow_mut().is_slow = false;
    window.settle();
    assert_eq!(window.strokes_asked(), [2, 2], "it is not asked for again");
    window.undo();
    window.settle();
    assert_eq!(window.document().to_json_compact(), before);
    assert!((window.tip() - shown).abs() < 0.5, "it is shown as it was");
    assert!(window.harness.state().is_at_rest());
    // And redone it is what it would have been.
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.settle();
    assert_eq!(window.document().to_json_compact(), moved);
    assert_eq!(window.strokes_asked().last(), Some(&2));
}

#[test]
fn strokes_are_laid_down_and_done_together() {
    let mut window = Window::with_clay_tool(0);
    let middle = window.picture_center();
    window.press(Key::J);
    window.lay(middle, vec2(-40.0, -30.0));
    window.lay(middle - vec2(60.0, 30.0), vec2(-40.0, 0.0));
    assert!(window.strokes().is_empty(), "nothing is done yet");
    window.look("strokes laid down");
    let keys = |window: &Window, of: &str| window.harness.query_all_by_label_contains(of).count();
    assert!(keys(&window, "of tool 1") >= 2, "the handles of the first");
    assert!(keys(&window, "of tool 2") >= 2, "and of the second");
    // A handle is dragged; the last one is taken back, and drawn again.
    let spot = window
        .harness
        .get_by_label("Key 2 of tool 1")
        .rect()
        .center();
    window.drag(spot, vec2(0.0, -20.0));
    let moved = window
        .harness
        .get_by_label("Key 2 of tool 1")
        .rect()
        .center();
    assert!(moved.y < spot.y - 10.0, "{moved} {spot}");
    window.undo();
    assert_eq!(keys(&window, "of tool 2"), 0);
    window.lay(middle - vec2(60.0, 30.0), vec2(-40.0, 0.0));
    assert!(keys(&window, "of tool 2") >= 2, "laid down again");
    window.press(Key::Enter);
    window.wait_for_strokes(1);
    assert_eq!(window.strokes()[0].moves.len(), 2);
    assert_eq!(keys(&window, "of tool"), 0);
    window.look("strokes done together");
    window.undo();
    window.wait_for_strokes(0);
    // Buttons do the same.
    window.lay(middle, vec2(-40.0, -30.0));
    window.lay(middle + vec2(0.0, 60.0), vec2(40.0, 0.0));
    window.click("Take back what was laid down last");
    assert_eq!(keys(&window, "of tool 2"), 0);
    window.click("Do what is laid down as one stroke");
    window.wait_for_strokes(1);
    window.lay(middle, vec2(-40.0, -30.0));
    window.press(Key::Escape);
    assert_eq!(keys(&window, "of tool"), 0, "dropped");
    window.click("Together");
    window.drag(middle, vec2(-40.0, -30.0));
    window.wait_for_strokes(2);
}

impl Window {
    /// Draws a way that is laid down: it lies there once the picture has said where the hand was.
    fn lay(&mut self, from: Pos2, by: Vec2) {
        self.drag(from, by);
        self.settle();
    }

    /// The middle of a handle of the tool that is laid down.
    fn handle(&self, name: &str) -> Pos2 {
        self.harness.get_by_label(name).rect().center()
    }
}

#[test]
fn a_form_is_drawn_and_taken_in_hand() {
    let mut window = Window::with_clay_tool(0);
    let shapes = |window: &Window| {
        let document = window.document();
        let fabrica::document::SubjectRef::Clay(clay) = &document.illustration().subject else {
            panic!("a clay")
        };
        let tools = clay.tools.iter().filter_map(|tool| tool.shape.as_ref());
        tools.map(|shape| shape.points().len()).collect::<Vec<_>>()
    };
    let draw = || {
        fabrica::app::Command::Hand(HandCommand::Hold(HeldTool {
            way: StrokeWay::Form,
            ..HeldTool::default()
        }))
    };
    window.run_command(draw());
    let middle = window.picture_center();
    window.drag(middle - vec2(80.0, 0.0), vec2(160.0, -40.0));
    window.settle();
    // It takes the place of the ball that no stroke has used.
    let [drawn] = shapes(&window)[..] else {
        panic!("one tool: {:?}", shapes(&window))
    };
    assert!((2..10).contains(&drawn), "a curve of few points: {drawn}");
    assert!(window.strokes().is_empty());
    window.harness.hover_at(middle);
    window.settle();
    window.look("form drawn");
    window.drag(middle, vec2(0.0, -60.0));
    window.wait_for_strokes(1);
    window.look("form drawn that has acted");
    assert_eq!(shapes(&window), [drawn]);
    window.undo();
    window.undo();
    assert_eq!(shapes(&window), [0], "the stroke, then the tool");
}

#[test]
fn a_tool_is_laid_down_and_its_handles_act() {
    let mut window = Window::with_clay_tool(3);
    let hand = |acts| {
        fabrica::app::Command::Hand(HandCommand::Hold(HeldTool {
            way: StrokeWay::Place,
            form: 3,
            mirror: [false; 3],
            acts,
            ..HeldTool::default()
        }))
    };
    window.run_command(hand(false));
    window.click_at(window.picture_center());
    window.settle();
    window.look("tool laid down");
    const FREE: &str = "Move freely";
    let before = window.handle(FREE);
    window.drag(before, vec2(0.0, -40.0));
    let lifted = window.handle(FREE);
    assert!(lifted.y < before.y - 30.0, "{before} {lifted}");
    window.press(Key::ArrowUp);
    assert!(window.handle(FREE).y < lifted.y - 1.0);
    assert!(window.strokes().is_empty(), "it is only placed");
    // Each drag is one stroke, whatever the handles do.
    window.click("Handles act");
    window.drag(window.handle(FREE), vec2(-30.0, 0.0));
    window.wait_for_strokes(1);
    window.look("tool laid down that has acted");
    window.press(Key::T);
    window.drag(window.handle("Turn about z"), vec2(25.0, 0.0));
    window.wait_for_strokes(2);
    let turned = window.strokes()[1].moves[0].keys[1].turn;
    assert_ne!(turned, [0; 3]);
    window.press(Key::S);
    window.press(Key::CloseBracket);
    window.wait_for_strokes(3);
    assert_eq!(window.strokes()[2].moves[0].keys[1].percent, 115);
    window.undo();
    window.wait_for_strokes(2);
    window.press(Key::Escape);
    assert!(window.harness.query_by_label("Handles act").is_none());
    // With the others it holds what is in it.
    window.run_command(hand(false));
    window.press(Key::J);
    window.click_at(window.picture_center());
    window.run_command(fabrica::app::Command::Hand(HandCommand::Hold(
        HeldTool::default(),
    )));
    window.drag(window.picture_center() + vec2(0.0, 60.0), vec2(60.0, 0.0));
    window.press(Key::Enter);
    window.wait_for_strokes(3);
    let stroke = window.strokes().remove(2);
    assert_eq!(stroke.moves.len(), 2);
    assert_eq!(stroke.moves[0].keys.len(), 1, "it stays");
}
