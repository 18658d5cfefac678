//! Copy and paste, mirror, group, lay on the surface, snap, search: what an author does with whole templates.

use super::*;

/// Two templates, the first of them named.
const PAIR: &str = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
    { "kind": "peel", "name": "skin", "at": [0.2, 0.5, 0.1], "rotate": [-0.7071, 0, 0, 0.7071], "size": [0.3, 0.3, 0.2] },
    { "kind": "poke", "at": [0.1, 0.4, 0.2] } ] }"#;

fn names(window: &Window) -> Vec<String> {
    let document = window.document();
    let templates = document.illustration().templates.iter();
    templates
        .map(|t| match t.name.as_str() {
            "" => t.kind.spec().name.to_owned(),
            name => name.to_owned(),
        })
        .collect()
}

fn event(window: &mut Window, event: egui::Event) {
    window.harness.event(event);
    window.steps(3);
}

fn copied(window: &Window) -> String {
    let log = window.log.0.borrow();
    log.copied.last().cloned().expect("something was copied")
}

#[test]
fn templates_go_from_one_document_to_another() {
    let mut from = Window::open(DESK, PAIR);
    from.click("1. skin");
    event(&mut from, egui::Event::Copy);
    let text = copied(&from);
    assert!(text.contains("fabrica-templates"), "{text}");
    assert!(
        from.harness
            .query_by_label_contains("On the clipboard: 1")
            .is_some(),
        "a message names it"
    );
    assert_eq!(names(&from), ["skin", "poke"], "copying changes nothing");

    let mut to = Window::open(DESK, CUBE);
    event(&mut to, egui::Event::Paste(text.clone()));
    assert_eq!(names(&to), ["skin"]);
    assert_eq!(to.harness.state().selected(), Some(0));
    assert_eq!(
        to.document().get("/templates/0"),
        from.document().get("/templates/0"),
        "whole"
    );
    to.click("Undo");
    assert!(names(&to).is_empty(), "one step of undo");

    event(&mut from, egui::Event::Cut);
    assert_eq!(names(&from), ["poke"]);
    from.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(names(&from), ["skin", "poke"], "cutting is undone");

    let broken = text.replace("\"peel\"", "3");
    event(&mut to, egui::Event::Paste(broken));
    assert!(
        to.harness
            .query_by_label_contains("cannot be pasted")
            .is_some(),
        "a message names the fault"
    );
}

#[test]
fn the_menu_copies_and_pastes_without_keys() {
    let mut window = Window::open(vec2(360.0, 640.0), PAIR);
    window.press(Key::N);
    let center = window.picture_center();
    window.harness.hover_at(center);
    window.harness.step();
    let button = egui::PointerButton::Secondary;
    for pressed in [true, false] {
        window.harness.event(egui::Event::PointerButton {
            pos: center,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
    }
    window.steps(3);
    window.look("phone_menu");
    window.click("Copy");
    assert!(copied(&window).contains("\"skin\""));
    window.click("More for this template");
    window.click("Paste");
    assert_eq!(names(&window), ["skin", "skin", "poke"]);
}

#[test]
fn a_mirrored_copy_lies_on_the_other_side() {
    let mut window = Window::open(DESK, PAIR);
    window.click("1. skin");
    window.press(Key::M);
    let document = window.document();
    let [first, second, _] = document.illustration().templates.as_slice() else {
        panic!("three templates: {}", document.to_json());
    };
    let flip = glam::Vec3::new(-1.0, 1.0, 1.0);
    assert_eq!(second.placement.at, first.placement.at * flip);
    let normal = |t: &fabrica::document::PlacedTemplate| t.placement.rotate * glam::Vec3::Z;
    assert!((normal(second) - normal(first) * flip).length() < 1e-3);
    assert_eq!(
        window.harness.state().selected(),
        Some(1),
        "the copy is selected"
    );
    window.look("desk_mirrored");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(names(&window), ["skin", "poke"], "one step of undo");
}

#[test]
fn templates_of_a_group_move_together() {
    let mut window = Window::open(DESK, PAIR);
    window.click("2. Poke");
    window.press_with(Modifiers::COMMAND, Key::G);
    let group = |window: &Window, i: usize| {
        let document = window.document();
        fabrica::document::group_of(&document, i).to_owned()
    };
    assert_eq!([group(&window, 0), group(&window, 1)], ["Group", "Group"]);
    window.look("desk_group");
    let at = |window: &Window| -> Vec<glam::Vec3> {
        let document = window.document();
        let templates = document.illustration().templates.iter();
        templates.map(|t| t.placement.at).collect()
    };
    let before = at(&window);
    let tip = window.harness.get_by_label("Move along x").rect().center();
    window.drag(tip, vec2(50.0, 0.0));
    let after = at(&window);
    let by: Vec<_> = after.iter().zip(&before).map(|(a, b)| *a - *b).collect();
    assert!(by[1].length() > 0.02, "it was moved: {by:?}");
    assert!((by[0] - by[1]).length() < 2e-4, "both alike: {by:?}");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(at(&window), before, "one step of undo");

    // A mirrored copy of a group is a group of its own.
    window.press(Key::M);
    let named = ["skin", "skin, mirrored", "poke", "Poke, mirrored"];
    assert_eq!(names(&window), named);
    let groups: Vec<_> = (0..4).map(|i| group(&window, i)).collect();
    assert_eq!(groups, ["Group", "Group 2", "Group", "Group 2"]);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::G);
    assert_eq!(group(&window, 3), "", "it leaves its group");
}

#[test]
fn a_template_is_laid_on_the_surface_again() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "peel", "at": [0.05, 0.8, 0.1], "rotate": [-0.5, 0.2, 0, 0.84], "size": [0.3, 0.3, 0.2] } ] }"#;
    let mut window = Window::open(DESK, json);
    window.click("1. Peel");
    window.press(Key::L);
    window.settle();
    let placement = window.document().illustration().templates[0].placement;
    let up = placement.rotate * glam::Vec3::Z;
    assert!(up.y > 0.97, "its top looks out of the surface: {up}");
    let top = placement.at + up * placement.size.z * 0.5;
    assert!((top.y - 0.5).abs() < 0.06, "and lies on it: {top}");
    window.press_with(Modifiers::COMMAND, Key::Z);
    let placement = window.document().illustration().templates[0].placement;
    assert_eq!(placement.at.y, 0.8, "undone");
}

#[test]
fn handles_go_in_steps() {
    let mut window = Window::open(DESK, PAIR);
    window.click("2. Poke");
    window.press(Key::K);
    let tip = window.harness.get_by_label("Move along x").rect().center();
    let before = window.document().illustration().templates[1].placement;
    window.drag(tip, vec2(70.0, 0.0));
    let after = window.document().illustration().templates[1].placement;
    let by = (after.at - before.at).length();
    assert!(by > 0.04, "it was moved: {by}");
    assert!(
        (by / 0.05 - (by / 0.05).round()).abs() < 0.01,
        "by whole steps: {by}"
    );
    window.press(Key::S);
    let face = window
        .harness
        .get_by_label("Size x at the far end")
        .rect()
        .center();
    window.drag(face, vec2(33.0, 0.0));
    let side = window.document().illustration().templates[1]
        .placement
        .size
        .x;
    assert!(
        (side / 0.05 - (side / 0.05).round()).abs() < 0.01,
        "a side in whole steps: {side}"
    );
}

#[test]
fn the_catalogue_is_searched() {
    let mut window = Window::open(DESK, CUBE);
    window.press(Key::Slash);
    window.steps(2);
    window.harness.event(egui::Event::Text("retra".to_owned()));
    window.steps(3);
    window.look("desk_search");
    assert!(window.harness.query_by_label("Place retractor").is_some());
    assert!(window.harness.query_by_label("Place peel").is_none());
    window.press(Key::Enter);
    assert!(
        window.harness.query_by_label("Cancel placing").is_some(),
        "Enter places what was found"
    );
    window.press(Key::Enter);
    window.settle();
    assert_eq!(names(&window), ["retractor"], "and again, in the middle");
    assert!(
        window.harness.query_by_label("Place peel").is_some(),
        "all are back"
    );
}

/// What pressing a key sends, and what it writes. As one frame's events: the harness would give each a frame of its
/// own.
fn typed(key: Key, letter: &str) -> impl Iterator<Item = egui::Event> {
    let pressed = egui::Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    let text = (!letter.is_empty()).then(|| egui::Event::Text(letter.to_owned()));
    std::iter::once(pressed).chain(text)
}

/// In one frame as in many: none of the letters does what it does as a key.
#[test]
fn words_typed_at_once_are_searched_for() {
    let mut window = Window::open(
        DESK,
        r#"{"fabrica":1,"subject":{"builtin":"cube"},"templates":[{"kind":"poke"}]}"#,
    );
    window.press(Key::N);
    let keys = [Key::Slash, Key::H, Key::A, Key::R].into_iter();
    for (key, letter) in keys.zip(["/", "h", "a", "r"]) {
        window.harness.input_mut().events.extend(typed(key, letter));
    }
    window.steps(3);
    window.harness.event(egui::Event::Text("m".to_owned()));
    window.steps(3);
    let field = window
        .harness
        .get_by_role_and_label(Role::TextInput, "Search");
    assert_eq!(field.value().as_deref(), Some("harm"));
    assert!(window.document().illustration().templates[0].enabled);
}

/// The key of the search, a word and Enter: in one frame, or with a frame anywhere between them.
#[test]
fn a_word_and_enter_start_placing_however_slow_frames_are() {
    let word = [
        (Key::Slash, "/"),
        (Key::T, "t"),
        (Key::W, "w"),
        (Key::I, "i"),
        (Key::Enter, ""),
    ];
    for frame_after in 1..=word.len() {
        let mut window = Window::open(DESK, CUBE);
        for keys in [&word[..frame_after], &word[frame_after..]] {
            let events = keys.iter().flat_map(|(key, letter)| typed(*key, letter));
            window.harness.input_mut().events.extend(events);
            window.steps(1);
        }
        window.steps(3);
        assert!(
            window.harness.query_by_label("Cancel placing").is_some(),
            "{frame_after} keys in the first frame"
        );
    }
}

#[test]
fn a_displacement_field_that_is_opened_becomes_a_template() {
    use fabrica::load::{MemoryFiles, read_field};
    let mut window = Window::open(DESK, CUBE);
    let table = "0 0 0 2 0 0\n10 0 0 2 0 0\n0 10 0 2 0 0\n0 0 10 2 0 0\n10 10 10 2 0 0\n";
    let mut files = MemoryFiles::new([("nodes.csv", table.as_bytes().to_vec())]);
    let field = read_field(&mut files, "nodes.csv").expect("a table");
    let hash = field.sha256.clone();
    let send = |window: &mut Window, outcome| {
        let outcome = Box::new(outcome);
        let mut log = window.log.0.borrow_mut();
        log.queue.push(Message::Field {
            want: None,
            outcome,
        });
        drop(log);
        window.settle();
    };
    send(&mut window, Ok(field.clone()));
    let document = window.document();
    let template = &document.illustration().templates[0];
    assert_eq!(template.kind.spec().name, "field");
    let size = document.get("/templates/0/size");
    assert!(size.is_some(), "it lies where the file says: {document:?}");
    let found = document.get("/templates/0/params/sha256");
    assert_eq!(found.and_then(|v| v.as_str()), Some(hash.as_str()));
    // The same again fills the template that is there; what is none is refused in words.
    send(&mut window, Ok(field));
    send(&mut window, Err("it has 2 numbers per sample".to_owned()));
    assert_eq!(window.document().illustration().templates.len(), 1);
    let message = "The displacement field cannot be used";
    assert!(
        window.harness.query_by_label_contains(message).is_some(),
        "{message}"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert!(
        window.document().illustration().templates.is_empty(),
        "undone"
    );
}

#[test]
fn control_points_are_dragged_added_and_cut_apart() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [ { "kind": "rbf", "size": [0.8, 0.8, 0.8], "params": { "points": [
            { "at": [0.7, 0.9, 0.7], "move": [0, 0, -0.2] }, { "at": [0.2, 0.5, 0.2] } ] } } ] }"#,
    );
    let points = |window: &Window| {
        let document = window.document();
        let value = document.get("/templates/0/params/points").cloned();
        value.unwrap_or_default()
    };
    window.click("1. Points");
    window.settle();
    let before = points(&window);
    let dot = window
        .harness
        .get_by_label("Control point 1")
        .rect()
        .center();
    // A double click beside it makes another: its first click does not put the template away.
    window.double_click_at(dot + vec2(60.0, 40.0));
    assert_eq!(points(&window).as_array().map(Vec::len), Some(3));
    // It goes again by the key that takes a template away where no dot has the keyboard.
    let third = window.harness.get_by_label("Control point 3").rect();
    window.click_at(third.center());
    window.press(Key::Delete);
    window.settle();
    assert_eq!(points(&window), before);
    window.drag(dot, vec2(30.0, 20.0));
    let after = points(&window);
    assert_ne!(before, after, "the dot was dragged");
    assert_eq!(before[1], after[1], "and no other");
    // The tissue went along: where it came from stayed.
    for axis in 0..3 {
        let source = |v: &serde_json::Value| {
            let number = |key: &str| v[0][key][axis].as_f64().unwrap_or(0.0);
            number("at") + number("move")
        };
        assert!(
            (source(&before) - source(&after)).abs() < 2e-3,
            "{before} {after}"
        );
    }
    window.click("Add a control point");
    window.click("Lengthen the cut");
    assert_eq!(points(&window).as_array().map(Vec::len), Some(3));
    assert!(window.document().get("/templates/0/params/cut").is_some());
    assert!(window.harness.query_by_label("Cut, place 2").is_some());
    window.look("control_points");
    for _ in 0..3 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(points(&window), before, "each was one step of undo");
}

#[test]
fn a_sweep_is_drawn_on_the_object() {
    let mut window = Window::open(DESK, CUBE);
    let before = window.document();
    window.take_sweep();
    let from = window.picture_center();
    window.drag(from, vec2(90.0, -40.0));
    let template = window.wait_for_sweep();
    let document = window.document();
    let count = document.illustration().templates.len();
    assert_eq!(count, 1, "one gesture is one template");
    let path = &swept_tool(&template).path;
    assert!((2..8).contains(&path.len()), "few keys: {path:?}");
    // Its ends lie where the hand was.
    for (key, name) in [
        (0, "Key 1 of tool 1".to_owned()),
        (path.len() - 1, format!("Key {} of tool 1", path.len())),
    ] {
        let spot = window.harness.get_by_label(name.as_str()).rect().center();
        let hand = if key == 0 {
            from
        } else {
            from + vec2(90.0, -40.0)
        };
        assert!(spot.distance(hand) < 5.0, "{name}: {spot} and {hand}");
    }
    window.look("sweep_drawn");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(
        window.document().to_json(),
        before.to_json(),
        "one step of undo"
    );
    // A click without a way presses, as before; beside the object a drag draws nothing.
    let height = window.harness.get_by_role(Role::Image).rect().height();
    window.take_sweep();
    window.drag(from - vec2(0.0, 0.46 * height), vec2(60.0, 0.0));
    window.settle();
    assert!(window.document().illustration().templates.is_empty());
    assert!(
        window.harness.query_by_label("Cancel placing").is_some(),
        "still placing"
    );
    window.click_at(from);
    window.settle();
    assert_eq!(window.document().illustration().templates.len(), 1);
}

/// The tool of a second gesture is put into the sweep of the first by one click, and goes where it went.
#[test]
fn a_drawn_tool_is_added_to_the_sweep_before() {
    let mut window = Window::open(DESK, CUBE);
    let from = window.picture_center();
    for way in [vec2(90.0, -40.0), vec2(-70.0, -30.0)] {
        window.take_sweep();
        window.drag(from, way);
        window.wait_for_sweep();
    }
    let apart = window.document();
    assert_eq!(apart.illustration().templates.len(), 2);
    let end = |window: &Window, name: &str| window.harness.get_by_label(name).rect().center();
    let was = end(&window, "Key 1 of tool 1");
    window
        .harness
        .get_by_label("Put its tools into template 1")
        .scroll_to_me();
    window.steps(3);
    window.click("Put its tools into template 1");
    window.settle();
    let document = window.document();
    let templates = &document.illustration().templates;
    let fabrica::document::TemplateData::Tools(held) = &templates[0].data else {
        panic!("a sweep: {templates:?}")
    };
    assert_eq!((templates.len(), held.tools.len()), (1, 2));
    let is = end(&window, "Key 1 of tool 2");
    assert!(was.distance(is) < 3.0, "{was} and {is}");
    window.undo();
    assert_eq!(window.document(), apart, "one step of undo");
}

impl Window {
    /// Takes the tool in hand that draws a sweep.
    fn take_sweep(&mut self) {
        // It may stand below the end of what is seen of the catalogue.
        self.harness.get_by_label("Place sweep").scroll_to_me();
        self.steps(3);
        self.click("Place sweep");
    }

    /// Waits until a drag has become a sweep, which puts the tool away, and gives the last sweep.
    fn wait_for_sweep(&mut self) -> fabrica::document::PlacedTemplate {
        let patience = clock() + 60.0;
        while clock() < patience && self.harness.query_by_label("Cancel placing").is_some() {
            self.steps(1);
        }
        let document = self.document();
        let templates = &document.illustration().templates;
        templates.last().cloned().expect("a sweep")
    }
}

/// The only tool of a sweep.
fn swept_tool(template: &fabrica::document::PlacedTemplate) -> &fabrica::document::SweepTool {
    let fabrica::document::TemplateData::Tools(held) = &template.data else {
        panic!("a sweep: {template:?}")
    };
    &held.tools[0]
}

#[test]
fn a_sweep_is_drawn_by_any_form_in_any_way() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "camera": { "distance": 10 } }"#,
    );
    window.take_sweep();
    window.look("sweep_in_hand");
    window.choose("Form of the tool", "Block");
    window.choose("What a drag does", "Push, pull");
    let middle = window.picture_center();
    window.harness.hover_at(middle);
    window.steps(8);
    window.look("sweep_over_the_object");
    window.drag(middle, vec2(0.0, -70.0));
    let template = window.wait_for_sweep();
    let tool = swept_tool(&template);
    assert_eq!(tool.shape.as_ref().map(|shape| shape.name()), Some("box"));
    // The front of the cube is seen: what is pulled comes to the viewer.
    let ends =
        [&tool.path[0], &tool.path[1]].map(|key| template.placement.subject_from_template(key.at));
    let gone = ends[1] - ends[0];
    let back = window.document().illustration().camera.rotate * glam::Vec3::Y;
    let pulled = gone.dot(back);
    assert!(
        pulled > 0.1 && gone.distance(pulled * back) < 0.01,
        "{gone} along {back}"
    );
    window.look("sweep_pulled");
    // A curve that is drawn is a tool, and changes nothing by itself.
    window.take_sweep();
    window.choose("Form of the tool", "Draw the form…");
    let before = window.document().to_json();
    window.drag(middle - vec2(60.0, 30.0), vec2(120.0, 60.0));
    window.steps(8);
    window.look("sweep_form_in_hand");
    assert_eq!(window.document().to_json(), before);
    window.choose("What a drag does", "Move");
    window.drag(middle, vec2(0.0, 60.0));
    let template = window.wait_for_sweep();
    let shape = swept_tool(&template).shape.clone();
    assert!(shape.is_some_and(|shape| shape.points().len() >= 2));
    window.look("sweep_by_a_drawn_form");
    for _ in 0..2 {
        window.undo();
    }
    assert!(window.document().illustration().templates.is_empty());
}

#[test]
fn keys_of_tools_are_dragged_added_and_removed() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [ { "kind": "sweep", "size": [0.8, 0.8, 0.8], "params": { "mirror": "x", "tools": [
            { "radius": 0.1, "path": [[0.3, 0.5, 1.1], [0.4, 0.6, 0.7]] }, { "shape": "torus", "path": [[0.7, 0.3, 0.9]] } ] } } ] }"#,
    );
    let path = |window: &Window, tool: usize| {
        let document = window.document();
        let value = document.get(&format!("/templates/0/params/tools/{tool}/path"));
        value.cloned().unwrap_or_default()
    };
    window.click("1. Sweep");
    window.settle();
    window.look("tools_of_a_sweep");
    let before = path(&window, 0);
    let dot = |window: &Window, name: &str| window.harness.get_by_label(name).rect().center();
    let [first, second] = ["Key 1 of tool 1", "Key 2 of tool 1"].map(|name| dot(&window, name));
    // The first of six moves begins the drag.
    let moved = vec2(24.0, 18.0);
    window.drag(second, 1.2 * moved);
    let after = path(&window, 0);
    assert_eq!(before[0], after[0], "no other key");
    assert_ne!(before[1], after[1], "the dot was dragged");
    let [now, hand] = [dot(&window, "Key 2 of tool 1"), second + moved];
    assert!(
        now.distance(hand) < 1.0,
        "from {second} to {now}, not {hand}"
    );
    // A double click on the way adds a key there, which changes no way.
    let middle = first.lerp(now, 0.5);
    window.double_click_at(middle);
    assert_eq!(path(&window, 0).as_array().map(Vec::len), Some(3));
    // It lies at a sixteenth of the way.
    let added = dot(&window, "Key 2 of tool 1");
    let off = added.distance(middle);
    assert!(
        off < first.distance(now) / 16.0,
        "{added} of {first} and {now}"
    );
    // Delete takes a key away, the last one stays.
    for (name, tool, left) in [("Key 2 of tool 1", 0, 2), ("Key 1 of tool 2", 1, 1)] {
        let spot = dot(&window, name);
        window.click_at(spot);
        window.press(Key::Delete);
        window.settle();
        assert_eq!(
            path(&window, tool).as_array().map(Vec::len),
            Some(left),
            "{name}"
        );
    }
    assert_eq!(window.document().illustration().templates.len(), 1);
    for _ in 0..3 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(path(&window, 0), before, "each was one step of undo");
}

/// The colour that the middle of a dot has: that of the last full circle that is painted there.
fn middle_of(window: &Window, dot: &str) -> egui::Color32 {
    fn collect(shape: &egui::Shape, at: Pos2, found: &mut Option<egui::Color32>) {
        match shape {
            egui::Shape::Circle(circle) => {
                let is_there = circle.center.distance(at) < 0.5;
                if is_there && circle.fill != egui::Color32::TRANSPARENT {
                    *found = Some(circle.fill);
                }
            }
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|s| collect(s, at, found)),
            _ => {}
        }
    }
    let at = window.harness.get_by_label(dot).rect().center();
    let mut found = None;
    for clipped in &window.harness.output().shapes {
        collect(&clipped.shape, at, &mut found);
    }
    found.expect("a dot is painted")
}

#[test]
fn a_missed_control_point_is_hollow_and_says_by_how_much() {
    let open = |at: &str, more: &str| {
        let json = format!(
            r#"{{ "fabrica": 1, "subject": {{ "builtin": "cube" }}, "templates": [ {{ "kind": "rbf", "size": [0.8, 0.8, 0.8], {more} "params": {{ "points": [
                {{ "at": [0.7, 0.9, 0.7], "move": [0, 0, -0.2] }}, {{ "at": {at} }}, {{ "at": [0.2, 0.5, 0.2] }} ] }} }} ] }}"#
        );
        let mut window = Window::open(DESK, &json);
        window.click("1. Points");
        window.settle();
        window
    };
    // At the place of the first point, which is met: its dot lies right under that of the second.
    let missed = open("[0.7, 0.9, 0.7]", "");
    let name = "Control point 2, missed by 0.160 subject units";
    let full = middle_of(&missed, "Control point 3");
    let (hollow, [r, g, b]) = (middle_of(&missed, name), [full.r(), full.g(), full.b()]);
    assert_ne!(hollow, full, "another colour than {r} {g} {b}");
    assert!(hollow.is_opaque(), "the dot under it does not show through");
    assert!(hollow.g() > g && hollow.b() > b, "light inside: {hollow:?}");
    assert!(missed.harness.query_by_label("Control point 1").is_some());
    assert!(missed.harness.query_by_label("Control point 2").is_none());
    // Apart from it, or where the template is switched off, it is as full as the others.
    for (at, more) in [
        ("[0.7, 0.9, 0.4]", ""),
        ("[0.7, 0.9, 0.7]", r#""enabled": false,"#),
    ] {
        let met = open(at, more);
        let all = ["Control point 1", "Control point 2", "Control point 3"];
        let colors = all.map(|name| middle_of(&met, name));
        assert_eq!(colors, [full; 3], "{at} {more}");
    }
}

#[test]
fn a_template_follows_the_surface_and_is_straight_again() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "tomato" }, "templates": [
        { "kind": "peel", "at": [0, 0, 0.3], "size": [0.6, 0.4, 0.3] } ] }"#;
    let mut window = Window::open(DESK, json);
    window.click("1. Peel");
    window.settle();
    assert!(window.harness.query_by_label("Curve point 1").is_none());
    window.click("Follow the surface");
    window.settle();
    let document = window.document();
    let template = document.illustration().templates[0].clone();
    let curve = template.curve.clone().expect("it lies along a curve");
    assert_eq!(curve.points.len(), 7, "{curve:?}");
    // A tomato is round: the middle is the highest, and its top stands a little over the skin everywhere.
    let heights: Vec<f32> = curve.points.iter().map(|p| p.y).collect();
    assert!(
        heights[3] > heights[0] + 0.1 && heights[3] > heights[6] + 0.1,
        "{heights:?}"
    );
    assert!(
        template.bent().expect("bent").size().x > 0.6,
        "as long as the line"
    );
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    window.look("along_a_curve");
    // Its points are dragged; in this view out of the surface.
    let dot = window.harness.get_by_label("Curve point 4").rect().center();
    window.drag(dot, vec2(0.0, -30.0));
    let dragged = window.document().illustration().templates[0].curve.clone();
    let dragged = dragged.expect("still a curve");
    assert!(dragged.points[3].y > heights[3] + 0.02, "{dragged:?}");
    assert_eq!(dragged.points[1], curve.points[1], "and no other");
    let round = window
        .harness
        .get_by_role_and_label(egui::accesskit::Role::CheckBox, "Round");
    round.click();
    window.steps(3);
    let is_spline = window.document().get("/templates/0/curve/spline").cloned();
    assert_eq!(is_spline, Some(false.into()));
    window.click("Make it straight");
    assert_eq!(window.document().get("/templates/0/curve"), None);
    for _ in 0..3 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    let back = window.document().illustration().templates[0].curve.clone();
    assert_eq!(back, Some(curve), "each was one step of undo");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.document().get("/templates/0/curve"), None);
}
