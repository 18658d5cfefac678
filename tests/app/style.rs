//! An illustrator's style, in the panel of the look.

use super::*;
use fabrica::app::{Command, StepCommand};
use fabrica::document::{HatchBy, Style, style_preset};
use serde_json::{Value, json};

/// As high as the panel is long.
const HIGH: Vec2 = vec2(900.0, 1500.0);

fn open() -> Window {
    let mut window = Window::open(HIGH, CUBE);
    window.click("Panel: Look");
    window
}

impl Window {
    /// Takes a style from the list.
    fn choose_style(&mut self, title: &str) {
        self.choose("Drawn as", title);
    }

    fn style(&self) -> Style {
        self.document().illustration().look.style
    }

    fn written_style(&self) -> Value {
        let document = self.document();
        document.get("/look/style").cloned().unwrap_or_default()
    }

    /// What the list says.
    fn style_title(&self) -> String {
        let list = self
            .harness
            .get_by_role_and_label(Role::ComboBox, "Drawn as");
        list.value().unwrap_or_default()
    }
}

#[test]
fn a_style_is_chosen_changed_and_undone() {
    let mut window = open();
    assert_eq!(window.style_title(), "Plain");
    window.choose_style("Ink");
    assert_eq!(window.written_style(), json!("ink"));
    assert_eq!(window.style_title(), "Ink");
    assert!(
        window.harness.query_by_label("Creases").is_none(),
        "it is folded"
    );
    window.click("Unfold the style");
    window.look("style");
    window.type_into("Outline", "3.5");
    let changed = json!({ "preset": "ink", "outline": { "width": 3.5 } });
    assert_eq!(window.written_style(), changed);
    assert_eq!(window.style_title(), "Ink, changed");
    window.click("Direction: Curvature");
    assert_eq!(window.style().hatch.by, HatchBy::Curvature);
    window.click("Shades: 4");
    assert_eq!(window.style().tone.levels, 4);
    window.type_into("Stroke gap", "8");
    assert_eq!(window.style().hatch.spacing, 8.0);
    let slider = window.harness.get_by_label("Creases slider").rect();
    window.drag(slider.center(), vec2(-20.0, 0.0));
    assert!(window.style().outline.creases < 0.7);
    window.look("style_changed");
    // Each of them is a step, the drag too.
    for _ in 0..4 {
        window.undo();
    }
    assert_eq!(window.written_style(), changed);
    window.click("Reset outline");
    assert_eq!(window.style(), style_preset("ink").expect("a preset").style);
    assert_eq!(window.style_title(), "Ink");
    // Another preset brings its own.
    window.type_into("Outline", "3.5");
    window.choose_style("Atlas");
    assert_eq!(window.written_style(), json!("atlas"));
    window.choose_style("Plain");
    assert_eq!(window.written_style(), Value::Null);
    assert_eq!(window.document().get("/look"), None);
    window.undo();
    assert_eq!(window.written_style(), json!("atlas"));
}

#[test]
fn a_style_of_ones_own_begins_with_what_is_turned_up() {
    let mut window = open();
    window.click("Unfold the style");
    for hidden in ["Creases", "Shades: 3", "Stroke gap", "Dot size"] {
        let found = window.harness.query_by_label(hidden);
        assert!(found.is_none(), "{hidden} changes nothing that is drawn");
    }
    window.type_into("Dots", "40");
    assert_eq!(window.style().stipple.strength, 0.4);
    assert_eq!(window.style_title(), "Own");
    window.type_into("Dot size", "2");
    window.type_into("Ghosting", "30");
    window.click("Ghosted: Far away");
    let wanted = json!({ "stipple": { "strength": 0.4, "size": 2 }, "ghost": { "by": "cut", "strength": 0.3 } });
    assert_eq!(window.written_style(), wanted);

    // A document's line that is wider than the slider goes stays as it is.
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "look": { "style": { "outline": { "width": 15 } } } }"#;
    let mut window = Window::open(HIGH, json);
    window.click("Panel: Look");
    window.click("Unfold the style");
    window.steps(4);
    assert_eq!(window.style().outline.width, 15.0);
}

#[test]
fn a_step_has_a_style() {
    let mut window = open();
    window.run_command(Command::Step(StepCommand::Add));
    window.choose_style("Pencil");
    let document = window.document();
    assert_eq!(document.get("/look"), None, "step 0 stays as it is");
    assert_eq!(
        document.get("/steps/0/set"),
        Some(&json!({ "/look/style": "pencil" }))
    );
    window.undo();
    assert!(window.document().get("/steps/0/set").is_none());
}

/// The light is put by its ball, by the arrow keys, or by numbers, and taken back to that of a document without one.
#[test]
fn the_light_is_turned() {
    let mut window = open();
    let light = |window: &Window| window.document().illustration().look.light;
    assert_eq!(light(&window), None);
    window.click("Unfold the light");
    window.type_into("Turned", "90");
    let from = light(&window).expect("a light").from;
    assert!(from.x > 0.7 && from.z.abs() < 0.01, "{from}");
    window.type_into("Raised", "0");
    let from = light(&window).expect("a light").from;
    assert!(from.x > 0.999, "{from}");
    window.type_into("Softness", "20");
    window.look("light from the right");
    assert_eq!(light(&window).expect("a light").soft, 0.2);
    // The middle of the ball is the viewer.
    window.click("Direction of the light");
    let from = light(&window).expect("a light").from;
    assert!(from.z > 0.99, "{from}");
    window.press(Key::ArrowUp);
    let raised = light(&window).expect("a light").from;
    assert!((0.05..0.12).contains(&(raised.y - from.y)), "{raised}");
    window.undo();
    assert_eq!(light(&window).expect("a light").from, from);
    window.click("Light as ever");
    assert_eq!(light(&window), None);
    window.undo();
    assert_eq!(light(&window).expect("a light").soft, 0.2);
}
