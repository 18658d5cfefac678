//! What an author does from the first click to the link, with the mouse and with keys alone.

use super::*;

#[test]
fn from_the_first_click_to_the_link() {
    let mut window = Window::open(DESK, CUBE);
    window.look("desk");
    window.place_peel();
    window.look("desk_placed");
    let placed = window.document().illustration().templates[0].clone();
    assert_eq!(placed.kind.spec().name, "peel");
    let up = placed.placement.rotate * glam::Vec3::Z;
    assert!(
        up.y > 0.9,
        "turned to the surface, which looks to the front: {up}"
    );
    assert_eq!(
        window.harness.state().selected(),
        Some(0),
        "what was placed is selected"
    );

    window.click("Copy link");
    window.steps(5);
    let copied = window
        .log
        .0
        .borrow()
        .copied
        .last()
        .cloned()
        .expect("the link was copied");
    let (page, payload) = copied.split_once('#').expect("a page and a payload");
    assert_eq!(page, "https://fabrica.example/");
    let opened = fabrica::link::decode(payload)
        .expect("the link opens")
        .document;
    assert_eq!(opened, window.document(), "the link is the document");
    assert!(
        window
            .harness
            .query_by_label_contains("clipboard")
            .is_some(),
        "and a message tells"
    );
}

#[test]
fn parameters_are_changed_undone_and_redone() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let progress =
        |window: &Window| window.document().illustration().templates[0].number("progress");
    let slider = window.harness.get_by_label("Progress slider").rect();
    window.drag(slider.center(), vec2(0.3 * slider.width(), 0.0));
    let opened = progress(&window);
    assert!(opened > 0.6, "the slider was dragged: {opened}");
    window.click("Undo");
    assert!(
        (progress(&window) - 0.5).abs() < 1e-3,
        "one drag is one step of undo: {}",
        progress(&window)
    );
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!((progress(&window) - opened).abs() < 1e-3, "redone");
    window.click("Reset progress");
    assert!(
        (progress(&window) - 0.5).abs() < 1e-3,
        "back to the default"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert!(
        window.document().illustration().templates.is_empty(),
        "all the way back"
    );
}

#[test]
fn angles_are_shown_in_degrees() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let field = window
        .harness
        .get_by_role_and_label(Role::SpinButton, "Angle");
    assert!(
        field.value().is_some_and(|value| value.contains("180")),
        "a half turn: {:?}",
        field.value()
    );
}

#[test]
fn the_list_orders_hides_duplicates_and_deletes() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "poke" }, { "kind": "peel", "name": "skin" }, { "kind": "twist" } ] }"#;
    let mut window = Window::open(DESK, json);
    let kinds = |window: &Window| -> Vec<&str> {
        window
            .document()
            .illustration()
            .templates
            .iter()
            .map(|t| t.kind.spec().name)
            .collect()
    };
    window.click("2. skin");
    assert_eq!(window.harness.state().selected(), Some(1));
    window.click("Move up: acts earlier");
    assert_eq!(kinds(&window), ["peel", "poke", "twist"]);
    assert_eq!(
        window.harness.state().selected(),
        Some(0),
        "the selection goes with it"
    );
    window.click("Hide 1. skin");
    assert!(!window.document().illustration().templates[0].enabled);
    window.click("Show 1. skin");
    window.click("Duplicate template");
    assert_eq!(kinds(&window), ["peel", "peel", "poke", "twist"]);
    assert_eq!(
        window.harness.state().selected(),
        Some(1),
        "the copy is selected"
    );
    window.click("Combine: Summed");
    assert_eq!(
        window.document().illustration().templates[1].mode,
        TemplateMode::Add
    );
    window.look("desk_list");
    window.click("Delete template");
    window.press(Key::Delete);
    assert_eq!(kinds(&window), ["peel", "twist"]);
}

#[test]
fn an_entry_is_dragged_to_its_place() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "poke" }, { "kind": "peel" }, { "kind": "twist" } ] }"#;
    let mut window = Window::open(DESK, json);
    let first = window.harness.get_by_label("1. Poke").rect().center();
    let last = window.harness.get_by_label("3. Twist").rect().center();
    window.drag(first, last - first + vec2(0.0, 10.0));
    let kinds: Vec<_> = window
        .document()
        .illustration()
        .templates
        .iter()
        .map(|t| t.kind.spec().name)
        .collect();
    assert_eq!(kinds, ["peel", "twist", "poke"]);
}

#[test]
fn the_gizmo_moves_turns_and_sizes() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let placement = |window: &Window| window.document().illustration().templates[0].placement;
    let before = placement(&window);

    let tip = window.harness.get_by_label("Move along x").rect().center();
    window.drag(tip, vec2(60.0, 3.0));
    let moved = placement(&window);
    let by = moved.at - before.at;
    let along = (before.rotate * glam::Vec3::X).dot(by);
    assert!(
        along > 0.02 && by.length() - along < 1e-3,
        "along its own x axis alone: {by}"
    );

    window.click("Handles: Turn");
    let ring = window.harness.get_by_label("Turn about z").rect().center();
    window.drag(ring, vec2(40.0, 40.0));
    let turned = placement(&window);
    assert!(turned.rotate.angle_between(moved.rotate) > 0.1, "turned");
    assert!(turned.at.distance(moved.at) < 1e-3, "in place");

    window.click("Handles: Size");
    let face = window
        .harness
        .get_by_label("Size x at the far end")
        .rect()
        .center();
    let center = window
        .harness
        .get_by_label("Size x at the near end")
        .rect()
        .center();
    window.drag(face, (face - center).normalized() * 40.0);
    let sized = placement(&window);
    assert!(
        sized.size.x > turned.size.x + 0.02,
        "wider: {} to {}",
        turned.size,
        sized.size
    );
    assert!((sized.size.y - turned.size.y).abs() < 1e-4, "and only in x");
    window.look("desk_size");
    for _ in 0..3 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(placement(&window), before, "each drag is one step of undo");
}

#[test]
fn the_main_parameter_is_dragged_in_the_picture() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let value = |window: &Window| match window.document().illustration().templates[0].params[0] {
        ParamValue::Number(value) => value,
        other => panic!("a number, not {other:?}"),
    };
    let camera = window.document().illustration().camera;
    let handle = window.harness.get_by_label("Drag progress").rect().center();
    window.drag(handle, vec2(50.0, 0.0));
    assert!(
        value(&window) > 0.52,
        "dragged open along x: {}",
        value(&window)
    );
    assert_eq!(
        window.document().illustration().camera,
        camera,
        "the camera stays"
    );
    let further = window.harness.get_by_label("Drag progress").rect().center();
    assert!(
        further.x > handle.x + 20.0,
        "the handle goes with the hand: {handle} to {further}"
    );
}

#[test]
fn the_whole_path_by_keys_alone() {
    let mut window = Window::open(DESK, CUBE);
    window.harness.get_by_label("Place retractor").focus();
    window.steps(2);
    window.press(Key::Enter);
    window.press(Key::Enter);
    window.settle();
    assert_eq!(
        window.document().illustration().templates.len(),
        1,
        "Enter places it in the middle"
    );
    let amount = |window: &Window| window.document().illustration().templates[0].number("amount");
    let before = amount(&window);
    window.press(Key::OpenBracket);
    assert!(amount(&window) < before, "closed a little");
    window.press(Key::CloseBracket);
    window.press(Key::CloseBracket);
    assert!(amount(&window) > before, "opened");
    let rotate = window.document().illustration().camera.rotate;
    window.press(Key::ArrowLeft);
    assert!(
        window.document().illustration().camera.rotate != rotate,
        "an arrow turns the object"
    );
    window.press(Key::D);
    assert_eq!(
        window.document().illustration().templates.len(),
        2,
        "duplicated"
    );
    window.press(Key::Delete);
    window.press(Key::H);
    assert!(
        !window.document().illustration().templates[0].enabled,
        "hidden"
    );
    window.press(Key::Num6);
    window.settle();
    let back = window.document().illustration().camera.rotate * glam::Vec3::Y;
    assert!(back.z < -0.99, "from below: {back}");
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::L);
    assert_eq!(window.log.0.borrow().copied.len(), 1, "the link is copied");
    window.press(Key::Questionmark);
    assert!(
        window
            .harness
            .query_by_label("A smaller or larger ball")
            .is_some(),
        "the ball has keys too"
    );
    assert!(
        window.harness.query_by_label("Keys and gestures").is_some(),
        "the sheet of keys"
    );
    window.look("desk_keys");
    window.press(Key::Escape);
    assert!(
        window.harness.query_by_label("Keys and gestures").is_none(),
        "and away again"
    );
}

#[test]
fn the_camera_turns_moves_zooms_and_goes_home() {
    let mut window = Window::open(DESK, CUBE);
    let camera = |window: &Window| window.document().illustration().camera;
    let home = camera(&window);
    let center = window.picture_center();
    window.drag(center, vec2(120.0, 40.0));
    let turned = camera(&window);
    assert!(turned.rotate.angle_between(home.rotate) > 0.5, "turned");
    assert_eq!(turned.target, home.target);
    window.harness.hover_at(center);
    window.harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.settle();
    assert!(camera(&window).distance < turned.distance, "closer");
    window.click("View: Left");
    window.settle();
    let back = camera(&window).rotate * glam::Vec3::Y;
    assert!(back.x < -0.99, "from the patient's left: {back}");
    window.click("Back to the first view");
    window.settle();
    assert!(
        camera(&window).rotate.angle_between(home.rotate) < 1e-3,
        "home"
    );
    assert!(window.document().illustration().templates.is_empty());
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert!(
        camera(&window).rotate.angle_between(home.rotate) < 1e-3,
        "undo leaves the camera alone"
    );
}

/// What a template leaves alone is chosen in its panel, by a list of the subject's segments, and undone step by step.
#[test]
fn tissue_is_left_alone_by_check_boxes() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let get = |window: &Window, key: &str| {
        let pointer = format!("/templates/0/{key}");
        window.document().get(&pointer).cloned()
    };
    window.click("Keep in place: Tissue");
    assert_eq!(get(&window, "align/to"), Some("segment".into()));
    let before = get(&window, "align/keep");
    window
        .harness
        .get_by_label("Keep in place: ball")
        .click_accesskit();
    window.settle();
    window.look("keep");
    let keep = get(&window, "align/keep").expect("a set");
    assert_ne!(Some(&keep), before.as_ref(), "the box changes the set");
    assert!(
        keep.as_array()
            .is_some_and(|names| names.contains(&"ball".into())),
        "{keep}"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&window, "align/keep"), before, "one step back");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&window, "align"), None, "nothing is kept by default");

    window.click("Keep in place: What lies deep");
    assert_eq!(get(&window, "align/to"), Some("surface".into()));
    window
        .harness
        .get_by_label("Protect: Weaker")
        .click_accesskit();
    window.settle();
    window.look("protect");
    assert_eq!(get(&window, "constrain/by"), Some("coordinate".into()));
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&window, "constrain"), None);
}
