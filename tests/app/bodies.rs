//! Bodies of meshes and their layers, in the panel of the look.

use super::*;
use fabrica::app::{Command, StepCommand};
use fabrica::data::Surface;
use fabrica::document::{BodyKind, Layer, SurfaceLook};
use serde_json::json;

/// Far away, since lavapipe draws it.
const APPLE: &str =
    r#"{ "fabrica": 1, "subject": { "builtin": "apple" }, "camera": { "distance": 20 } }"#;

/// Opens a document about the apple. The tests are about panels and do not wait for the picture.
fn open(theme: egui::Theme, log: Fake, json: &str) -> Window {
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(DESK, theme, log, Some(json));
    window.bring_apple();
    window
}

fn open_apple(json: &str) -> Window {
    open(egui::Theme::Light, Fake::default(), json)
}

impl Window {
    /// The apple arrives.
    fn bring_apple(&mut self) {
        let mesh = fabrica::subjects::mesh("apple").expect("a built-in mesh");
        let surface = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
        {
            let log = &mut *self.log.0.borrow_mut();
            let ticket = Ticket(log.next_ticket);
            let part = LoadEvent::Part(SubjectPart::Surface(Arc::new(surface)));
            let done = LoadEvent::Done { sha256: None };
            let events = [part, done].map(|event| Message::Load { ticket, event });
            log.queue.extend(events);
        }
        self.steps(4);
    }
}

fn surface(window: &Window) -> SurfaceLook {
    window.document().illustration().look.surface.clone()
}

fn layer_names(layers: &[Layer]) -> Vec<&str> {
    layers.iter().map(|layer| layer.name.as_str()).collect()
}

#[test]
fn bodies_of_a_mesh_are_chosen_in_the_panel() {
    let mut window = open_apple(APPLE);
    window.click("Panel: Look");
    assert!(
        window
            .harness
            .query_by_label("Opacity: Keep mass")
            .is_none(),
        "what is about values is not offered"
    );
    assert!(window.harness.query_by_label("Thickness").is_none());
    window.look("bodies");
    window.click("Body: Thick");
    assert_eq!(surface(&window).body, BodyKind::Thick);
    window.type_into("Thickness", "0.1");
    assert_eq!(surface(&window).thickness, 0.1);
    window.look("bodies_thick");
    window.type_into("Gloss", "60");
    assert_eq!(surface(&window).gloss, 0.6);
    let slider = window.harness.get_by_label("Gloss slider").rect();
    window.drag(slider.center(), vec2(-20.0, 0.0));
    assert!(surface(&window).gloss < 0.6);
    window.undo();
    assert_eq!(surface(&window).gloss, 0.6, "a drag is one step");
    for _ in 0..3 {
        window.undo();
    }
    assert_eq!(window.document().get("/look"), None, "as it was");

    // A scan has no bodies.
    let mut window = Window::open(DESK, CUBE);
    window.click("Panel: Look");
    assert!(window.harness.query_by_label("Body: Thick").is_none());
    assert!(window.harness.query_by_label("Add a layer").is_none());
}

#[test]
fn layers_are_added_changed_and_removed() {
    let mut window = open_apple(APPLE);
    window.click("Panel: Look");
    let own = surface(&window).layers;
    assert_eq!(layer_names(&own), ["skin", "flesh", "core"]);
    window.click("Add a layer");
    let layers = surface(&window).layers;
    assert_eq!(layer_names(&layers), ["skin", "flesh", "core", "Layer 4"]);
    assert_eq!(layers[..3], own[..], "its own are the document's now");
    assert!(layers[3].depth > layers[2].depth);
    window.look("bodies_layers");
    window.click("Remove flesh");
    assert_eq!(
        layer_names(&surface(&window).layers),
        ["skin", "core", "Layer 4"]
    );
    window.undo();
    window.undo();
    assert_eq!(window.document().get("/look"), None);

    // A key of another version stays with its layer.
    let json = r##"{ "fabrica": 1, "subject": { "builtin": "apple" }, "camera": { "distance": 20 },
        "look": { "layers": [ { "depth": 0.2, "name": "pulp", "x-note": 1 }, { "name": "rind", "color": "#b8433a" } ] } }"##;
    let mut window = open_apple(json);
    window.click("Panel: Look");
    assert_eq!(layer_names(&surface(&window).layers), ["rind", "pulp"]);
    window.click("Name of layer 2");
    window.press_with(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text("flesh".to_owned()));
    window.steps(2);
    window.press(Key::Tab);
    let slider = window.harness.get_all_by_label("Grain slider").last();
    let slider = slider.expect("one for each layer").rect();
    window.drag(slider.center(), vec2(20.0, 0.0));
    let first = window.document().get("/look/layers/0").cloned();
    let first = first.expect("a layer");
    assert_eq!(
        (&first["name"], &first["x-note"]),
        (&json!("flesh"), &json!(1))
    );
    assert!(first["grain"].as_f64().is_some_and(|grain| grain > 0.2));
    window.undo();
    assert_eq!(window.document().get("/look/layers/0/grain"), None);
}

#[test]
fn a_step_changes_bodies_and_layers() {
    let mut window = open_apple(APPLE);
    window.run_command(Command::Step(StepCommand::Add));
    window.click("Panel: Look");
    window.click("Body: Hollow");
    window.click("Remove core");
    let document = window.document();
    let at = |step: usize| {
        let document = document.at_step(step).expect("a step");
        let surface = document.illustration().look.surface.clone();
        (surface.body, surface.layers.len())
    };
    assert_eq!((at(0), at(1)), ((BodyKind::Auto, 3), (BodyKind::Hollow, 2)));
    window.undo();
    window.undo();
    assert!(window.document().get("/steps/0/set").is_none());
}

#[test]
fn bodies_have_words_in_other_languages() {
    for (tag, look, labels) in [
        (
            "de",
            "Bereich: Aussehen",
            ["Körper: Schale", "Schicht hinzufügen"],
        ),
        (
            "es",
            "Panel: Aspecto",
            ["Cuerpo: Grueso", "Añadir una capa"],
        ),
    ] {
        let log = Fake::default();
        log.store_value("language", tag);
        let mut window = open(egui::Theme::Dark, log, APPLE);
        window.click(look);
        for label in labels {
            assert!(window.harness.query_by_label(label).is_some(), "{label}");
        }
        window.look(&format!("bodies_{tag}"));
    }
}
