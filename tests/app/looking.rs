//! Looking, by role and label: the transfer function over the histogram.

use super::*;
use fabrica::document::{Transfer, TransferPoint, Window as ValueWindow, preset};

impl Window {
    fn double_click_at(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        self.harness.step();
        // A step takes a quarter of a second, which is too long between two clicks.
        let start = self.harness.ctx.input(|i| i.time);
        for i in 0..4 {
            if i % 2 == 0 {
                self.harness.drag_at(pos);
            } else {
                self.harness.drop_at(pos);
            }
            self.harness.input_mut().time = Some(start + 0.02 * f64::from(i + 1));
            self.harness.step();
        }
        self.harness.input_mut().time = None;
        self.settle();
    }
}

// ---------------------------------------------------------------------------------------------------- transfer function

fn point_at(window: &Window, number: usize) -> Pos2 {
    let label = format!("Point {number}:");
    window.harness.get_by_label_contains(&label).rect().center()
}

fn points(window: &Window) -> Vec<TransferPoint> {
    match window.document().illustration().look.transfer.clone() {
        Transfer::Points(points) => points,
        other => panic!("listed points, not {other:?}"),
    }
}

fn transfer(window: &Window) -> Transfer {
    window.document().illustration().look.transfer.clone()
}

#[test]
fn a_presets_points_are_dragged_and_become_listed_ones() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Panel: Look");
    window.look("transfer");
    let own = preset("tissue").expect("the preset of built-in subjects");
    let [low, high] = own.window.expect("it has a window");
    let before = own.points[2];
    let from = point_at(&window, 3);
    window.drag(from, vec2(12.0, 30.0));
    window.look("transfer_dragged");
    let after = points(&window);
    assert_eq!(after.len(), own.points.len());
    let absolute = low + before.value * (high - low);
    assert!(after[2].value > absolute, "to the right: {:?}", after[2]);
    assert!(after[2].opacity < 1.0, "and down: {:?}", after[2]);
    assert!(
        (after[1].value - (low + own.points[1].value * (high - low))).abs() < 0.1,
        "the others stay where the window had them"
    );
    let tint = window.document().illustration().look.tint;
    assert_eq!(tint, Some(1.0), "the segments' colours stay");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(transfer(&window), Transfer::Auto, "the drag was one step");
    assert_eq!(window.document().illustration().look.tint, None);
}

#[test]
fn points_come_by_double_click_and_go_by_delete_or_by_being_drawn_out() {
    let mut window = Window::open(
        DESK,
        r##"{ "fabrica": 1, "subject": { "builtin": "cube" }, "look": { "transfer": [
            { "value": -500, "color": "#ff0000", "opacity": 0 }, { "value": 500, "color": "#0000ff", "opacity": 1 } ] } }"##,
    );
    window.click("Panel: Look");
    let (first, last) = (point_at(&window, 1), point_at(&window, 2));
    // Far from the line: above its middle.
    let spot = first + vec2(0.35 * (last.x - first.x), -0.9 * (first.y - last.y));
    window.double_click_at(spot);
    window.look("transfer_added");
    let three = points(&window);
    assert_eq!(three.len(), 3);
    assert!((three[1].value + 150.0).abs() < 15.0, "{:?}", three[1]);
    assert!((three[1].opacity - 0.81).abs() < 0.05, "{:?}", three[1]);
    let [red, _, blue] = three[1].color_srgb;
    assert!(red > blue && blue > 100, "mixed: {:?}", three[1]);

    // It has the keyboard now.
    window.press(Key::ArrowUp);
    window.press(Key::ArrowRight);
    let moved = points(&window)[1];
    let was = three[1];
    assert!(moved.opacity > was.opacity, "{was:?} {moved:?}");
    assert!(moved.value > was.value, "{was:?} {moved:?}");
    window.press(Key::Delete);
    assert_eq!(points(&window).len(), 2, "Delete is for the point");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(points(&window).len(), 3);

    let middle = point_at(&window, 2);
    window.drag(middle, vec2(0.0, 400.0));
    assert_eq!(points(&window).len(), 2, "drawn out of the field");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(points(&window)[1], moved, "as one step of undo");

    // A click on the line adds one that changes nothing.
    let on_line = {
        let (a, b) = (point_at(&window, 2), point_at(&window, 3));
        // Half way in value the opacity is half way too, and heights are square roots.
        let part = 0.5 * (moved.opacity + 1.0);
        let height = (last.y - first.y) * part.sqrt();
        Pos2::new(0.5 * (a.x + b.x), first.y + height)
    };
    window.click_at(on_line);
    let four = points(&window);
    assert_eq!(four.len(), 4);
    assert!((four[2].opacity - 0.5 * (moved.opacity + 1.0)).abs() < 0.02);
}

#[test]
fn the_window_has_handles_on_the_axis() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "look": { "window": [-500, 700] } }"#,
    );
    window.click("Panel: Look");
    let plot = window
        .harness
        .get_by_label("Opacity and colour over value")
        .rect();
    // The axis between two points of the preset, whose places in the window are known.
    let own = preset("tissue").expect("the preset of built-in subjects");
    let (a, b) = (point_at(&window, 1), point_at(&window, 5));
    let part = own.points[4].value - own.points[0].value;
    let per_value = (b.x - a.x) / (1200.0 * part);
    let end = Pos2::new(a.x + 1200.0 * per_value, plot.top() + 12.0);
    window.drag(end, vec2(-200.0 * per_value, 0.0));
    let ValueWindow::Range([low, high]) = window.document().illustration().look.window else {
        panic!("a window of its own");
    };
    assert!(
        (low + 500.0).abs() < 0.5 && (high - 500.0).abs() < 15.0,
        "{low} {high}"
    );
    // The bar moves both.
    let bar = Pos2::new(a.x + 500.0 * per_value, plot.top() + 12.0);
    window.drag(bar, vec2(100.0 * per_value, 0.0));
    let ValueWindow::Range([moved, end]) = window.document().illustration().look.window else {
        panic!("a window of its own");
    };
    assert!((moved - low - 100.0).abs() < 15.0, "{moved}");
    assert!(
        (end - high - (moved - low)).abs() < 1.0,
        "as wide as before"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::COMMAND, Key::Z);
    let range = window.document().illustration().look.window;
    assert_eq!(range, ValueWindow::Range([-500.0, 700.0]));
}

#[test]
fn a_preset_is_taken_from_its_group() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Panel: Look");
    window
        .harness
        .get_by_role_and_label(Role::ComboBox, "Colours")
        .click();
    window.steps(3);
    window.look("transfer_presets");
    window.click("CT bone");
    assert_eq!(transfer(&window), Transfer::Preset("ct-bone".to_owned()));
    // A preset takes the tint of the points before it away.
    let from = point_at(&window, 2);
    window.drag(from, vec2(0.0, -20.0));
    assert_eq!(window.document().illustration().look.tint, None);
}

#[test]
fn the_transfer_function_of_the_head_to_look_at() {
    if std::env::var_os("FABRICA_LOOK_AT").is_none() {
        println!("FABRICA_LOOK_AT is not set: nobody looks, nothing is drawn");
        return;
    }
    for (name, size, theme) in [
        ("transfer_head", DESK, egui::Theme::Light),
        ("transfer_head_dark", DESK, egui::Theme::Dark),
        (
            "transfer_phone",
            Vec2::new(360.0, 740.0),
            egui::Theme::Light,
        ),
    ] {
        let json = r#"{ "fabrica": 1, "look": { "transfer": "ct-muscle-bone" } }"#;
        let mut window = Window::open_with(size, theme, Fake::default(), Some(json));
        window.click(if size == DESK { "Panel: Look" } else { "Look" });
        let at = point_at(&window, 4);
        window.click_at(at);
        window.look(name);
    }
}
