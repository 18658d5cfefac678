//! What lies on the picture and beside it keeps apart: bars, cards, handles, letters.

use super::*;
use egui::Rect;

/// A phone as most people hold it.
const PHONE: Vec2 = Vec2::new(390.0, 844.0);
/// A laptop's window.
const LAPTOP: Vec2 = Vec2::new(1280.0, 800.0);

const LESSON: &str = r#"{ "fabrica": 1, "title": "The way in", "caption": "A cut, and what lies under it.",
    "credit": "Drawn by nobody", "subject": { "builtin": "cube" },
    "templates": [{ "kind": "split", "at": [0, 0, 0.2], "params": { "amount": 0 } }],
    "steps": [{ "title": "Incision", "caption": "It opens a little, just enough to see that there is something below, and what.",
                "seconds": 0.1, "set": { "/templates/0/params/amount": 0.3 } },
              { "title": "Wide", "seconds": 0.1, "set": { "/templates/0/params/amount": 0.8 } }] }"#;

/// Every text that is painted, and where.
fn painted(window: &Window) -> Vec<(String, Rect)> {
    fn collect(shape: &egui::Shape, found: &mut Vec<(String, Rect)>) {
        match shape {
            egui::Shape::Text(text) => {
                found.push((text.galley.text().to_owned(), text.visual_bounding_rect()));
            }
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    for clipped in &window.harness.output().shapes {
        collect(&clipped.shape, &mut found);
    }
    found
}

fn places_of(window: &Window, text: &str) -> Vec<Rect> {
    let all = painted(window);
    all.into_iter()
        .filter(|(found, _)| found == text)
        .map(|(_, rect)| rect)
        .collect()
}

fn rect_of(window: &Window, label: &str) -> Rect {
    window.harness.get_by_label(label).rect()
}

// ---------------------------------------------------------------------------------------------------- lessons

/// The picture alone has one card for a lesson: both buttons of the bar of steps can be pressed, and no text is there
/// twice.
#[test]
fn the_picture_alone_shows_a_lesson_once() {
    for (name, size) in [("alone_lesson", LAPTOP), ("alone_lesson_phone", PHONE)] {
        let mut window = Window::open(size, LESSON);
        window.press(Key::P);
        window.settle();
        window.look(name);
        for text in ["A cut, and what lies under it.", "Drawn by nobody"] {
            assert_eq!(places_of(&window, text).len(), 1, "{name}: {text}");
        }
        let at = rect_of(&window, "Next step").center();
        window.click_at(at);
        window.settle();
        window.look(&format!("{name}_one"));
        assert_eq!(window.harness.state().step(), 1, "{name}");
        assert!(
            places_of(&window, "A cut, and what lies under it.").is_empty(),
            "{name}: the step has a legend of its own"
        );
        let at = rect_of(&window, "Step before").center();
        window.click_at(at);
        window.settle();
        assert_eq!(window.harness.state().step(), 0, "{name}: and back");
    }
}

/// A lesson beside slices: the bar of steps lies under the panes, whatever the step.
#[test]
fn the_bar_of_steps_covers_no_slice() {
    for (name, size) in [("steps_slices", LAPTOP), ("steps_slices_phone", PHONE)] {
        let mut window = Window::open(size, LESSON);
        window.press(Key::V);
        window.settle();
        if size == PHONE {
            window.click("View: Coronal");
            window.settle();
        }
        window.look(name);
        let bar = rect_of(&window, "Next step");
        let pane = window
            .harness
            .get_by_role_and_label(Role::Image, "Coronal slice")
            .rect();
        assert!(pane.bottom() <= bar.top(), "{name}: {pane} {bar}");
        window.click("Next step");
        window.settle();
        window.look(&format!("{name}_one"));
        let same = window
            .harness
            .get_by_role_and_label(Role::Image, "Coronal slice")
            .rect();
        assert_eq!(pane, same, "{name}: the panes stay where they are");
    }
}

/// Who selects a template at a step stays there, and so does who changes it: the step sets what was changed.
#[test]
fn selecting_at_a_step_keeps_its_picture() {
    let mut window = Window::open(LAPTOP, LESSON);
    window.click("Next step");
    window.settle();
    window.click("Next step");
    window.settle();
    window.click("1. Split");
    window.settle();
    window.look("steps_selected");
    assert_eq!(window.harness.state().step(), 2, "by the list");
    assert_eq!(window.harness.state().selected(), Some(0));
    window.press(Key::Escape);
    window.press(Key::N);
    window.settle();
    assert_eq!(window.harness.state().step(), 2, "by the keyboard");
    assert_eq!(window.harness.state().selected(), Some(0));
    let before = window.document();
    window.press(Key::CloseBracket);
    window.settle();
    assert_eq!(window.harness.state().step(), 2, "an edit is the step's");
    let after = window.document();
    let params = |document: &fabrica::document::Document, step: usize| {
        let state = document.at_step(step).expect("a step");
        state.illustration().templates[0].params.clone()
    };
    assert_ne!(params(&before, 2), params(&after, 2));
    assert_eq!(params(&before, 1), params(&after, 1));
    assert_eq!(params(&before, 0), params(&after, 0));
}

// ---------------------------------------------------------------------------------------------------- slices

#[test]
fn slices_stay_in_the_volume() {
    let mut window = Window::open(LAPTOP, CUBE);
    window.press(Key::V);
    window.settle();
    let axial = window
        .harness
        .get_by_role_and_label(Role::Image, "Axial slice")
        .rect();
    window.click_at(axial.left_center() + vec2(4.0, 40.0));
    window.harness.hover_at(Pos2::ZERO);
    window.settle();
    window.look("slices_outside");
    let node = window
        .harness
        .get_by_label_contains(" mm · ")
        .accesskit_node();
    let text = node.value().or(node.label()).unwrap_or_default();
    let x: f32 = text
        .split(',')
        .next()
        .and_then(|n| n.replace('\u{2212}', "-").parse().ok())
        .expect("a number");
    // The cube is 100 mm wide.
    assert!(
        (30.0..50.0).contains(&x),
        "the last slice of the cube: {text}"
    );
    assert!(!text.ends_with("nothing"), "{text}");
}

/// The letter of a side and the position over a slice keep apart, however long the number is.
#[test]
fn letters_and_positions_keep_apart() {
    let mut window = Window::open(vec2(1090.0, 700.0), CUBE);
    window.press(Key::V);
    window.settle();
    let middle = window
        .harness
        .get_by_role_and_label(Role::Image, "Axial slice")
        .rect()
        .center();
    window.click_at(middle + vec2(33.0, 27.0));
    window.look("slice_letters");
    let all = painted(&window);
    let positions: Vec<&(String, Rect)> = all
        .iter()
        .filter(|(text, _)| text.contains(" mm"))
        .collect();
    assert!(positions.len() >= 4, "{positions:?}");
    for (position, place) in positions {
        for (letter, at) in all.iter().filter(|(text, _)| text.len() == 1) {
            assert!(
                !place.intersects(*at),
                "{position} at {place} lies on {letter} at {at}"
            );
        }
    }
}

/// Two clicks are two points, also where the answer to the first is not there before the second comes, or both come in
/// one frame.
#[test]
fn quick_clicks_measure() {
    let button = |pos: Pos2, pressed: bool| egui::Event::PointerButton {
        pos,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::default(),
    };
    for is_one_frame in [false, true] {
        let mut window = Window::open(DESK, CUBE);
        window.press(Key::R);
        let middle = window.picture_center();
        for by in [-30.0, 30.0] {
            let pos = middle + vec2(by, 20.0);
            for pressed in [true, false] {
                window.harness.event(button(pos, pressed));
            }
            if !is_one_frame {
                window.harness.step();
            }
        }
        window.settle();
        window.look(&format!("measured_quickly_{is_one_frame}"));
        assert!(
            window
                .harness
                .query_by_label_contains("Distance 1:")
                .is_some(),
            "both in one frame: {is_one_frame}"
        );
    }
}

// ---------------------------------------------------------------------------------------------------- handles

/// A cube on a phone with a peel that is selected, seen by a camera.
fn peeled(rotate: [f32; 4], side: f32) -> String {
    format!(
        r#"{{ "fabrica": 1, "subject": {{ "builtin": "cube" }}, "camera": {{ "rotate": {rotate:?} }},
        "templates": [ {{ "kind": "peel", "at": [0,0,0.2], "size": [{side},{side},{side}], "params": {{ "progress": 0.3 }} }} ] }}"#
    )
}

/// Middles of all handles that are shown.
fn handles(window: &Window) -> Vec<(String, Pos2)> {
    let nodes = window.harness.root().children_recursive();
    nodes
        .filter(|node| node.accesskit_node().role() == Role::GraphicsObject)
        .map(|node| {
            let name = node.accesskit_node().label().unwrap_or_default();
            (name, node.rect().center())
        })
        .collect()
}

/// A finger is as wide as 24 points: no two handles are nearer to each other, from wherever one looks.
#[test]
fn handles_keep_apart() {
    let mut views = Vec::new();
    for (x, y) in [
        (0.0, 0.0),
        (0.0, 1.2),
        (0.7, 0.4),
        (-0.5, 0.9),
        (1.5, 0.0),
        (0.3, 2.4),
    ] {
        let turn = glam::Quat::from_rotation_z(x) * glam::Quat::from_rotation_x(y);
        views.push(turn.to_array());
    }
    for (number, rotate) in views.into_iter().enumerate() {
        for side in [0.2, 0.7] {
            let mut window = Window::open(PHONE, &peeled(rotate, side));
            window.press(Key::N);
            for mode in ["Move", "Size"] {
                window.click(&format!("Handles: {mode}"));
                window.settle();
                window.look(&format!("handles_{number}_{side}_{mode}"));
                let handles = handles(&window);
                assert!(handles.len() >= 4, "{mode}: {handles:?}");
                assert!(handles.iter().any(|(name, _)| name == "Drag progress"));
                for (i, (one, at)) in handles.iter().enumerate() {
                    for (other, there) in &handles[..i] {
                        let apart = at.distance(*there);
                        assert!(
                            apart >= 23.9,
                            "view {number}, side {side}: {one} and {other} are {apart} apart"
                        );
                    }
                }
            }
        }
    }
}

/// On a phone the bar of tools lies over nothing: the picture begins under it, also over an open drawer.
#[test]
fn a_phones_tools_hide_no_picture() {
    let mut window = Window::open(PHONE, &peeled([0.0, 0.0, 0.0, 1.0], 0.7));
    window.press(Key::N);
    window.settle();
    window.look("phone_tools");
    let check = |window: &Window| {
        let picture = window.harness.get_by_role(Role::Image).rect();
        let tools = rect_of(window, "Handles: Move");
        assert!(
            picture.top() >= tools.bottom(),
            "the picture {picture} begins under the tools {tools}"
        );
    };
    check(&window);
    window.click("Templates");
    window.settle();
    window.look("phone_tools_drawer");
    check(&window);
    let (_, knob) = handles(&window)
        .into_iter()
        .find(|(name, _)| name == "Drag progress")
        .expect("the knob is in the picture");
    window.drag(knob, vec2(-20.0, -20.0));
    let before = fabrica::document::Document::from_json(&peeled([0.0, 0.0, 0.0, 1.0], 0.7));
    let before = before.expect("valid").illustration().templates[0]
        .params
        .clone();
    assert_ne!(
        window.document().illustration().templates[0].params,
        before,
        "and can be dragged"
    );
}

// ---------------------------------------------------------------------------------------------------- cards

/// What loads is told above the card of three steps.
#[test]
fn a_load_does_not_cover_the_three_steps() {
    for (name, size) in [("hint_loading", LAPTOP), ("hint_loading_phone", PHONE)] {
        let log = Fake::default();
        log.0.borrow_mut().is_slow = true;
        let mut window = Window::open_with(size, egui::Theme::Light, log, None);
        window.steps(3);
        window.look(name);
        let load = rect_of(&window, "Cancel loading");
        for text in ["Three steps", "Copy the link: it holds everything."] {
            let place = places_of(&window, text)[0];
            // The button is at the end of the line that tells of the load.
            assert!(
                !load.expand2(vec2(400.0, 4.0)).intersects(place),
                "{name}: {load} on {text} at {place}"
            );
        }
        let button = rect_of(&window, "Got it");
        for (text, place) in painted(&window) {
            assert!(
                text == "Got it" || !button.intersects(place.shrink(1.0)) || text.is_empty(),
                "{name}: Got it at {button} covers {text} at {place}"
            );
        }
    }
}

/// The second of the three steps asks to drag the knob: it is not done before that.
#[test]
fn the_second_step_is_done_when_the_knob_was_dragged() {
    let mut window = Window::open_with(DESK, egui::Theme::Light, Fake::default(), None);
    window.click("Place peel");
    window.press(Key::Enter);
    window.settle();
    let is_open = |window: &Window| places_of(window, "2").len() == 1;
    assert!(is_open(&window), "placed, but not yet opened");
    let (_, knob) = handles(&window)
        .into_iter()
        .find(|(name, _)| name == "Drag progress")
        .expect("the knob");
    window.drag(knob, vec2(-25.0, -25.0));
    assert!(!is_open(&window), "opened");
}

#[test]
fn the_menu_is_as_wide_as_its_words() {
    for size in [LAPTOP, PHONE] {
        let mut window = Window::open(size, CUBE);
        window.click("More");
        window.steps(3);
        window.look("more_menu");
        let row = rect_of(&window, "Save picture");
        assert!(row.width() <= 320.0, "{row}");
        for lang in fabrica_languages() {
            let cell = rect_of(&window, &format!("Language: {lang}"));
            assert!(
                cell.width() > 40.0 && cell.right() <= row.right() + 0.5,
                "{lang}: {cell}"
            );
        }
    }
}

fn fabrica_languages() -> [&'static str; 3] {
    ["English", "Deutsch", "Español"]
}

/// The bar that scrolls the sheet of keys stands at its edge, beside the words.
#[test]
fn the_sheet_of_keys_scrolls_at_its_edge() {
    let mut window = Window::open(vec2(940.0, 500.0), CUBE);
    window.harness.event(egui::Event::Text("?".to_owned()));
    window.harness.key_press(Key::Questionmark);
    window.steps(4);
    window.look("keys_sheet");
    let close = rect_of(&window, "Close the sheet");
    window
        .harness
        .hover_at(close.center() + vec2(-200.0, 120.0));
    window.steps(20);
    window.look("keys_sheet_hover");
    let is_heading = |shape: &egui::Shape| match shape {
        egui::Shape::Text(text) => text.galley.text() == "Keys and gestures",
        _ => false,
    };
    let shapes = &window.harness.output().shapes;
    let bars: Vec<Rect> = shapes
        .iter()
        .skip_while(|clipped| !is_heading(&clipped.shape))
        .filter_map(|clipped| match &clipped.shape {
            egui::Shape::Rect(shape) => Some(shape.rect),
            _ => None,
        })
        .filter(|rect| rect.width() < 12.0 && rect.height() > 60.0)
        .collect();
    assert!(!bars.is_empty(), "a bar to scroll by");
    for bar in bars {
        assert!(bar.right() >= close.right() - 8.0, "{bar} under {close}");
    }
}

#[test]
fn the_handles_of_a_peel_are_all_there_from_aslant() {
    let turn = glam::Quat::from_rotation_z(0.6) * glam::Quat::from_rotation_x(0.5);
    let mut window = Window::open(LAPTOP, &peeled(turn.to_array(), 0.7));
    window.press(Key::N);
    window.settle();
    let names: Vec<String> = handles(&window).into_iter().map(|(name, _)| name).collect();
    for name in [
        "Drag progress",
        "Move freely",
        "Move along x",
        "Move along y",
        "Move along z",
    ] {
        assert!(names.iter().any(|found| found == name), "{name}: {names:?}");
    }
}
