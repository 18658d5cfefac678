//! Objects of the scene: put in, selected, changed and removed in the panel of templates.

use super::*;
use fabrica::app::{Command, StepCommand};
use fabrica::document::{ObjectPlacement, SceneObject};
use serde_json::{Value, json};

/// Two tools and a template; the second tool is in the template's group.
const TRAY: &str = r##"{ "fabrica": 1, "subject": { "builtin": "cube" },
    "templates": [ { "kind": "poke", "group": "set", "at": [0.1, 0.4, 0.2] } ],
    "objects": [ { "builtin": "scalpel", "name": "knife", "at": [0.3, 0.6, 0.2] },
        { "builtin": "needle", "name": "needle", "group": "set", "at": [-0.3, 0.6, 0.2], "color": "#3060c0" } ] }"##;

impl Window {
    fn objects(&self) -> Vec<SceneObject> {
        self.document().illustration().objects.clone()
    }

    fn object_names(&self) -> Vec<String> {
        let objects = self.objects().into_iter();
        objects.map(|object| object.name).collect()
    }

    fn placement(&self, index: usize) -> ObjectPlacement {
        self.objects()[index].placement.expect("it is placed")
    }

    fn selected_object(&self) -> Option<usize> {
        self.harness.state().selected_object()
    }

    fn value(&self, pointer: &str) -> Option<Value> {
        self.document().get(pointer).cloned()
    }
}

#[test]
fn a_tool_comes_to_what_the_picture_shows() {
    let mut window = Window::open(DESK, CUBE);
    window.look("objects_none");
    window.click("Add an object");
    window.look("objects_menu");
    for tool in ["Scalpel", "Forceps", "Retractor", "Needle"] {
        window.harness.get_by_role_and_label(Role::Button, tool);
    }
    window.click("Scalpel");
    window.settle();
    assert_eq!(window.object_names(), ["scalpel"]);
    assert_eq!(window.selected_object(), Some(0), "it is selected");
    window.look("objects_one");
    // Its working end stands before the surface in the middle of the picture, and points at it.
    let camera = window.document().illustration().camera;
    let placement = window.placement(0);
    assert_eq!(placement.size, 0.3);
    let [_, _, back] = fabrica::document::axes(camera.rotate);
    let out = placement.rotate * glam::Vec3::Z;
    assert!(out.dot(back) > 0.5, "the handle is on the side of the eye");
    let tip = placement.at - out * 0.15;
    let aside = (tip - camera.target).reject_from(back).length();
    assert!(aside < 0.02, "in the middle of the picture: {aside}");
    let surface = tip.abs().max_element();
    assert!((0.46..0.53).contains(&surface), "at the cube: {tip}");

    // A second one by the keyboard has a name of its own.
    window.run_command(Command::AddTool("scalpel"));
    window.settle();
    assert_eq!(window.object_names(), ["scalpel", "scalpel 2"]);
    window.undo();
    window.undo();
    assert!(window.objects().is_empty(), "each was one step of undo");
    assert_eq!(window.selected_object(), None);
}

#[test]
fn a_tool_goes_to_where_the_camera_looks_if_nothing_is_seen_there() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "camera": { "target": [2, 0, 0.5] } }"#;
    let mut window = Window::open(DESK, json);
    window.run_command(Command::AddTool("needle"));
    window.settle();
    let placement = window.placement(0);
    let tip = placement.at + placement.rotate * glam::Vec3::NEG_Z * 0.15;
    let off = tip.distance(glam::Vec3::new(2.0, 0.0, 0.5));
    assert!(off < 0.02, "{tip}");
}

#[test]
fn one_thing_is_selected_at_a_time_and_keys_act_on_it() {
    let mut window = Window::open(DESK, TRAY);
    window.click("1. Poke");
    assert_eq!(window.harness.state().selected(), Some(0));
    window.click("Object 1: knife");
    let selected = |window: &Window| {
        let app = window.harness.state();
        (app.selected(), app.selected_object())
    };
    assert_eq!(selected(&window), (None, Some(0)));
    window.look("objects_selected");
    // Next and before go through both lists.
    for wanted in [(None, Some(1)), (Some(0), None), (None, Some(0))] {
        window.press(Key::N);
        assert_eq!(selected(&window), wanted);
    }
    window.press_with(Modifiers::SHIFT, Key::N);
    assert_eq!(selected(&window), (Some(0), None));
    window.click("Object 1: knife");

    window.press(Key::H);
    assert!(!window.objects()[0].enabled, "hidden");
    window.press(Key::H);
    assert!(window.objects()[0].enabled, "shown");
    let before = window.placement(0).at;
    window.press(Key::CloseBracket);
    let pushed = window.placement(0).at - before;
    let wanted = glam::Vec3::new(0.0, 0.0, -0.015);
    assert!(
        (pushed - wanted).length() < 1e-4,
        "towards its end: {pushed}"
    );
    window.press(Key::OpenBracket);
    assert_eq!(window.placement(0).at, before, "and back");
    window.press(Key::D);
    assert_eq!(window.object_names(), ["knife", "knife 2", "needle"]);
    assert_eq!(selected(&window), (None, Some(1)), "the copy");
    window.press(Key::PageDown);
    assert_eq!(window.object_names(), ["knife", "needle", "knife 2"]);
    assert_eq!(selected(&window), (None, Some(2)));
    window.press(Key::Delete);
    assert_eq!(window.object_names(), ["knife", "needle"]);
    assert_eq!(selected(&window), (None, Some(1)), "the one in its place");
    window.press(Key::Backspace);
    assert_eq!(window.object_names(), ["knife"]);
    for _ in 0..4 {
        window.undo();
    }
    assert_eq!(window.object_names(), ["knife", "needle"]);
    window.press(Key::Escape);
    assert_eq!(selected(&window), (None, None));
    window.press(Key::Delete);
    assert_eq!(
        window.object_names(),
        ["knife", "needle"],
        "nothing to remove"
    );
}

#[test]
fn the_panel_changes_everything_about_an_object() {
    let mut window = Window::open(DESK, TRAY);
    window.click("Object 2: needle");
    window.type_into("Position x", "0.25");
    assert_eq!(window.placement(1).at.x, 0.25);
    window.type_into("Rotation z", "90");
    let x = window.placement(1).rotate * glam::Vec3::X;
    assert!((x - glam::Vec3::Y).length() < 1e-3, "turned: {x}");
    window.type_into("Size", "0.5");
    assert_eq!(window.placement(1).size, 0.5);
    window.type_into("Opacity", "40");
    window.type_into("Gloss", "80");
    assert_eq!(window.value("/objects/1/opacity"), Some(json!(0.4)));
    assert_eq!(window.value("/objects/1/gloss"), Some(json!(0.8)));
    window.click("The colours of its own");
    assert_eq!(window.value("/objects/1/color"), None, "the file's again");
    window.undo();
    assert_eq!(window.value("/objects/1/color"), Some(json!("#3060c0")));
    window.click("Hide Object 2: needle");
    assert!(!window.objects()[1].enabled);
    window.click("Name");
    window.press_with(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text("suture".to_owned()));
    window.steps(3);
    assert_eq!(window.object_names(), ["knife", "suture"]);
    window.click("Move the object up");
    assert_eq!(window.object_names(), ["suture", "knife"]);
    window.click("Duplicate object");
    assert_eq!(window.object_names(), ["suture", "suture 2", "knife"]);
    window.click("Delete object");
    assert_eq!(window.object_names(), ["suture", "knife"]);
    for _ in 0..10 {
        window.undo();
    }
    let first = Document::from_json(TRAY).expect("a document");
    assert_eq!(window.document().get("/objects"), first.get("/objects"));
}

#[test]
fn a_drag_over_a_number_is_one_step_of_undo() {
    let mut window = Window::open_with(DESK, egui::Theme::Light, Fake::fine(), Some(TRAY));
    window.click("Object 1: knife");
    let before = window.placement(0);
    let field = window.harness.get_by_label("Position y").rect().center();
    window.drag(field, vec2(40.0, 0.0));
    assert!(window.placement(0).at.y > before.at.y);
    let slider = window.harness.get_by_label("Size slider").rect();
    window.drag(slider.center(), vec2(12.0, 0.0));
    assert_ne!(window.placement(0).size, before.size);
    window.undo();
    assert_eq!(window.placement(0).size, before.size);
    window.undo();
    assert_eq!(window.placement(0), before);
}

#[test]
fn objects_and_templates_of_a_group_move_together() {
    let mut window = Window::open(DESK, TRAY);
    let template = |window: &Window| window.document().illustration().templates[0].placement.at;
    let (at, needle) = (template(&window), window.placement(1).at);
    window.click("Object 2: needle");
    window.type_into("Position z", "0.3");
    let by = glam::Vec3::new(0.0, 0.0, 0.1);
    assert!((window.placement(1).at - needle - by).length() < 1e-4);
    assert!(
        (template(&window) - at - by).length() < 1e-4,
        "the template"
    );
    window.undo();
    assert_eq!((template(&window), window.placement(1).at), (at, needle));
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::G);
    window.type_into("Position z", "0.3");
    assert_eq!(template(&window), at, "it left the group");
}

#[test]
fn a_step_moves_a_tool_and_brings_another() {
    let mut window = Window::open(DESK, TRAY);
    window.run_command(Command::Step(StepCommand::Add));
    window.settle();
    window.click("Object 1: knife");
    window.type_into("Position z", "0.5");
    window.type_into("Opacity", "50");
    window.run_command(Command::AddTool("forceps"));
    window.settle();
    assert_eq!(window.selected_object(), Some(2));
    window.click("Object 2: needle");
    window.click("Delete object");
    assert_eq!(window.selected_object(), None, "it stays, switched off");
    let at_step = |window: &Window, step: usize| {
        let document = window.document().at_step(step).expect("a step");
        let objects = &document.illustration().objects;
        let shown = objects.iter().filter(|object| object.enabled);
        let told = |o: &SceneObject| {
            let z = o.placement.map_or(0.0, |p| p.at.z);
            (o.name.clone(), z, o.opacity)
        };
        shown.map(told).collect::<Vec<_>>()
    };
    let first = at_step(&window, 0);
    let names: Vec<&str> = first.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["knife", "needle"]);
    assert_eq!((first[0].1, first[0].2), (0.2, 1.0), "as it was");
    let second = at_step(&window, 1);
    let names: Vec<&str> = second.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["knife", "forceps"]);
    assert_eq!((second[0].1, second[0].2), (0.5, 0.5));
    window.look("objects_step");
    for _ in 0..4 {
        window.undo();
    }
    assert_eq!(at_step(&window, 1), first, "each was one step of undo");
}

/// Those whose letters the tests have.
#[test]
fn the_panel_speaks_other_languages() {
    for (tag, heading, add, tool, name) in [
        (
            "de",
            "Gegenstände",
            "Gegenstand hinzufügen",
            "Pinzette",
            "Pinzette",
        ),
        ("es", "Objetos", "Añadir un objeto", "Pinzas", "pinzas"),
    ] {
        let log = Fake::default();
        log.store_value("language", tag);
        let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(CUBE));
        assert!(window.harness.query_by_label(heading).is_some(), "{tag}");
        window.click(add);
        window
            .harness
            .get_by_role_and_label(Role::Button, tool)
            .click();
        window.settle();
        assert_eq!(window.object_names(), [name]);
        window.look(&format!("objects_{tag}"));
    }
}

/// A tool comes from the shell, is drawn, and is moved, turned and sized by its handles.
#[test]
fn a_tool_is_dragged_by_its_handles() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "objects": [
        { "builtin": "scalpel", "name": "knife", "at": [0, -0.8, 0], "size": 0.5 } ] }"#;
    let mut window = Window::open(DESK, json);
    window.settle();
    window.look("objects_tool");
    let placed = |window: &Window| {
        let placement = window.document().illustration().objects[0].placement;
        placement.expect("it has a place")
    };
    let before = placed(&window);
    // A dot stands for it until it is selected.
    window.click("Select knife");
    window.settle();
    window.look("objects_handles");
    let start = window.harness.get_by_label("Move freely").rect().center();
    window.drag(start, egui::vec2(60.0, 0.0));
    window.settle();
    let moved = placed(&window);
    assert!(moved.at.distance(before.at) > 0.05, "{moved:?}");
    assert_eq!((moved.rotate, moved.size), (before.rotate, before.size));
    window.undo();
    assert_eq!(placed(&window), before);
    assert_eq!(window.harness.state().selected_object(), Some(0));
}
