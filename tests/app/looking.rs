//! Looking, by role and label: the transfer function over the histogram.

use super::*;
use fabrica::data::VolumeBuilder;
use fabrica::document::{Transfer, TransferPoint, Window as ValueWindow, preset};
use fabrica::render::ScaleBar;

// ---------------------------------------------------------------------------------------------------- transfer
// function

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

/// Each preset is offered as a picture of the scan that is open; of another scan there are other pictures.
#[test]
fn presets_are_pictures_of_the_scan() {
    let mut window = Window::open_with(DESK, egui::Theme::Light, Fake::fine(), Some(CUBE));
    window.click("Panel: Look");
    let open_list = |window: &mut Window| {
        window
            .harness
            .get_by_role_and_label(Role::ComboBox, "Colours")
            .click();
        window.steps(2);
    };
    // The field above the name, without its frame.
    let tile = |window: &mut Window, name: &str| {
        let node = window.harness.get_by_role_and_label(Role::Button, name);
        let rect = node.rect();
        let field = rect.with_max_y(rect.top() + 63.0).shrink(8.0);
        assert!(field.width() > 60.0, "a tile: {rect}");
        window.pixels(field)
    };
    let colors = |image: &image::RgbaImage| {
        let all: std::collections::BTreeSet<[u8; 4]> = image.pixels().map(|p| p.0).collect();
        all.len()
    };
    open_list(&mut window);
    let first = tile(&mut window, "Tissue");
    window.look("presets_before");
    window.settle();
    window.look("presets");
    let names = ["Tissue", "CT soft tissue", "CT bone"];
    let of_cube = names.map(|name| tile(&mut window, name));
    assert_eq!(colors(&first), 1, "a plain field while there is no picture");
    for (name, image) in names.iter().zip(&of_cube) {
        let colors = colors(image);
        assert!(colors > 50, "{name}: {colors} colours");
    }
    assert_ne!(of_cube[0], of_cube[1], "each in its own colours");
    // The keyboard reaches each, and takes it.
    let bone = window
        .harness
        .get_by_role_and_label(Role::Button, "CT bone");
    bone.focus();
    window.steps(2);
    window.press(Key::Enter);
    assert_eq!(transfer(&window), Transfer::Preset("ct-bone".to_owned()));
    let is_open = |window: &Window| {
        let all = window.harness.query_all_by_role(Role::Button);
        let mut labels = all.filter_map(|node| node.accesskit_node().label());
        labels.any(|label| label == "CT bone")
    };
    assert!(!is_open(&window), "the list is closed");
    // Another subject: the pictures of the earlier one are gone at once.
    window.settle();
    window.drop_built_in("bar", 32, &"5d".repeat(32));
    open_list(&mut window);
    let now = tile(&mut window, "CT bone");
    assert_ne!(now, of_cube[2], "no picture of another subject");
    window.settle();
    window.look("presets_other");
    let of_bar = tile(&mut window, "CT soft tissue");
    assert!(
        colors(&of_bar) > 50 && of_bar != of_cube[1],
        "its own picture"
    );
}

#[test]
#[ignore = "only drawn to be looked at: cargo xtask look"]
fn the_transfer_function_of_the_head_to_look_at() {
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

// ---------------------------------------------------------------------------------------------------- slices

/// A cube with a piece cut out at its upper corner in front, on the patient's right.
const CUT: &str = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
    { "kind": "cut", "at": [0.3, 0.3, 0.3], "size": [0.4, 0.4, 0.4] } ] }"#;

fn slice_rect(window: &Window, name: &str) -> egui::Rect {
    let label = format!("{name} slice");
    window
        .harness
        .get_by_role_and_label(Role::Image, &label)
        .rect()
}

/// The text of a node for screen readers.
fn text_of(node: &egui_kittest::kittest::AccessKitNode<'_>) -> String {
    node.value().or(node.label()).unwrap_or_default()
}

/// The line about the point under the crosshair or the pointer.
fn readout(window: &Window) -> String {
    let node = window.harness.get_by_label_contains(" mm · ");
    text_of(&node.accesskit_node())
}

#[test]
fn slices_are_linked_by_their_crosshair_and_say_what_is_there() {
    let mut window = Window::open(FOUR, CUT);
    assert!(window.harness.query_by_label("Axial slice").is_none());
    window.press(Key::V);
    window.settle();
    window.look("slices");
    let [axial, coronal, sagittal] =
        ["Axial", "Coronal", "Sagittal"].map(|name| slice_rect(&window, name));
    assert!(axial.right() < sagittal.left() && axial.bottom() < coronal.top());
    assert!(
        readout(&window).starts_with("0, 0, 0 "),
        "{}",
        readout(&window)
    );

    // Right of the middle in an axial slice is the patient's left: x falls.
    window.click_at(axial.center() + vec2(40.0, 0.0));
    window.harness.hover_at(Pos2::ZERO);
    window.settle();
    let text = readout(&window);
    let x: f32 = text
        .split(',')
        .next()
        .and_then(|n| n.replace('\u{2212}', "-").parse().ok())
        .expect("a number");
    assert!(x < -5.0, "{text}");
    assert!(text.contains("value"), "inside the cube: {text}");

    // The same way back by the keyboard; the pane was clicked, so it has it.
    window.press_with(Modifiers::SHIFT, Key::ArrowLeft);
    window.settle();
    assert_ne!(readout(&window), text, "ten voxels to the left");
    // Page up scrolls the slice and moves no template.
    window.press(Key::PageUp);
    window.settle();
    assert!(!readout(&window).contains(", 0 "), "{}", readout(&window));

    // In the cut there is nothing: up and to the left in the coronal slice, once it runs through it.
    let sagittal_front = sagittal.center() - vec2(0.3 * sagittal.width() * 0.8, 0.0);
    window.click_at(sagittal_front);
    let corner = coronal.center() - vec2(0.18, 0.18) * coronal.size().min_elem();
    window.click_at(corner);
    window.harness.hover_at(Pos2::ZERO);
    window.settle();
    window.look("slices_cut");
    assert!(
        readout(&window).ends_with("nothing"),
        "{}",
        readout(&window)
    );

    // One pane alone, and all of them again.
    window.click("Axial alone");
    window.settle();
    assert!(window.harness.query_by_label("Coronal slice").is_none());
    window.press(Key::Escape);
    window.settle();
    assert!(window.harness.query_by_label("Coronal slice").is_some());
    window.press(Key::V);
    assert!(window.harness.query_by_label("Axial slice").is_none());
}

#[test]
fn templates_are_placed_and_moved_in_slices() {
    let mut window = Window::open(FOUR, CUBE);
    window.click("Slices beside the picture");
    window.settle();
    let axial = slice_rect(&window, "Axial");
    window.click("Place cut");
    window.click_at(axial.center() - vec2(50.0, 0.0));
    window.settle();
    let template = window.document().illustration().templates[0].clone();
    let at = template.placement.at;
    assert!(
        at.x > 0.05 && at.y.abs() < 0.02 && at.z.abs() < 0.02,
        "{at}"
    );
    let outwards = template.placement.rotate * glam::Vec3::Z;
    assert!(outwards.x > 0.99, "it looks out of the object: {outwards}");
    window.look("slices_placed");
    // It is taken by its dot and moved within the slice; the drag is one step of undo.
    let dot = window
        .harness
        .get_all_by_label("Move Cut in the slice")
        .next()
        .expect("the first pane has it")
        .rect()
        .center();
    window.drag(dot, vec2(0.0, 30.0));
    let moved = window.document().illustration().templates[0].placement.at;
    assert!(
        moved.y < at.y - 0.03 && (moved.z - at.z).abs() < 1e-4,
        "down is posterior: {at} {moved}"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    let back = window.document().illustration().templates[0].placement.at;
    assert!(back.distance(at) < 1e-4);
}

#[test]
fn a_phone_shows_one_pane_with_tabs() {
    let mut window = Window::open(Vec2::new(360.0, 740.0), CUT);
    window.click("Slices beside the picture");
    window.settle();
    assert!(
        window.harness.query_by_label("Axial slice").is_none(),
        "the picture first"
    );
    window.click("View: Coronal");
    window.settle();
    window.look("slices_phone");
    let pane = slice_rect(&window, "Coronal");
    assert!(pane.width() > 350.0 && pane.height() > 400.0, "{pane}");
    window.click_at(pane.center() + vec2(60.0, -40.0));
    assert!(!readout(&window).starts_with("0, "), "{}", readout(&window));
    window.click("View: Picture");
    window.settle();
    assert!(window.harness.query_by_label("Coronal slice").is_none());
}

#[test]
fn an_amount_is_set_shown_and_taken_back() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
            { "kind": "peel", "at": [0, 0, 0.4], "size": [0.6, 0.6, 0.3], "amount": 0.5 } ] }"#,
    );
    window.click("1. Peel");
    window.press(Key::B);
    window.settle();
    window.look("ghost");
    window
        .harness
        .get_by_role_and_label(Role::Slider, "Overall slider")
        .focus();
    window.steps(2);
    window.press(Key::ArrowRight);
    let amount = window.document().illustration().templates[0].amount;
    assert!(amount > 0.5, "{amount}");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.document().illustration().templates[0].amount, 0.5);
    window.click("End the comparison");
    window.settle();
    window.look("ghost_off");
}

#[test]
fn a_scale_bar_and_letters_of_sides_are_switched_on_and_saved() {
    // Tall enough for the whole panel: what is scrolled out of view takes no click.
    let mut window = Window::open(Vec2::new(900.0, 1300.0), CUBE);
    window.save_small_pictures();
    let plain = window.saved_picture();
    window.click("Panel: Look");
    window.click("Scale bar");
    window.click("Letters of the patient's sides");
    let shown = window.document().illustration().clone();
    assert!(shown.look.scale_bar && shown.look.sides);
    window.look("marks");
    let marked = window.saved_picture();
    if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
        let path = std::path::Path::new(&folder).join("marked.png");
        marked.save(path).expect("a picture to look at");
    }
    // The bar is the longest dark run of a row that was not there before, at the lower right.
    let (width, height) = marked.dimensions();
    let is_new = |x: u32, y: u32| marked.get_pixel(x, y)[0] < 120 && plain.get_pixel(x, y)[0] > 200;
    let longest = |y: u32| {
        let mut runs = vec![0_u32];
        for x in width / 2..width {
            match is_new(x, y) {
                true => *runs.last_mut().expect("there is one") += 1,
                false => runs.push(0),
            }
        }
        runs.into_iter().max().unwrap_or(0)
    };
    let found = (height * 3 / 4..height).map(longest).max().unwrap_or(0);
    let mut cube = VolumeBuilder::new();
    fabrica::subjects::generate("cube", 32, &mut cube).expect("a cube");
    let mm_per_unit = cube.finish().expect("whole").grid.mm_per_unit();
    let bar = ScaleBar::of(&shown.camera, [width, height], mm_per_unit).expect("a bar");
    let off = (found as f32 - bar.length_px).abs();
    assert!(off <= 2.0, "{found} pixels in the picture, {bar:?}");
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::COMMAND, Key::Z);
    let look = window.document().illustration().look.clone();
    assert!(!look.scale_bar && !look.sides, "two steps of undo");
}

#[test]
fn distances_are_measured_on_the_surface_and_in_slices() {
    let mut window = Window::open(FOUR, CUBE);
    window.press(Key::Num1);
    window.settle();
    window.press(Key::R);
    let middle = window.picture_center();
    window.click_at(middle - vec2(40.0, 0.0));
    window.click_at(middle + vec2(40.0, 0.0));
    window.settle();
    let text = |window: &Window| {
        let node = window.harness.get_by_label_contains("Distance 1:");
        text_of(&node.accesskit_node())
    };
    let on_surface = text(&window);
    assert!(on_surface.ends_with(" mm"), "{on_surface}");
    window.look("measured");
    window.press(Key::V);
    window.settle();
    let axial = slice_rect(&window, "Axial");
    window.click_at(axial.center());
    window.click_at(axial.center() + vec2(30.0, 0.0));
    window.settle();
    window.look("measured_slices");
    assert!(
        window
            .harness
            .query_by_label_contains("Distance 2:")
            .is_some()
    );
    window.press(Key::Escape);
    assert!(window.harness.query_by_label("End measuring").is_none());
    window.click("Remove distance 1");
    assert_ne!(text(&window), on_surface);
    assert!(
        window
            .harness
            .query_by_label_contains("Distance 2:")
            .is_none()
    );
}

#[test]
#[ignore = "only drawn to be looked at: cargo xtask look"]
fn slices_of_the_head_to_look_at() {
    let json = r#"{ "fabrica": 1, "templates": [
        { "kind": "flap", "at": [0.05, 0.28, 0.25], "rotate": [-0.7071068, 0, 0, 0.7071068], "size": [0.4, 0.4, 0.3] },
        { "kind": "cut", "at": [-0.25, 0, 0.2], "size": [0.3, 0.3, 0.3] } ] }"#;
    for (name, size, theme) in [
        ("head_slices", Vec2::new(1280.0, 800.0), egui::Theme::Light),
        (
            "head_slices_dark",
            Vec2::new(1280.0, 800.0),
            egui::Theme::Dark,
        ),
    ] {
        let mut window = Window::open_with(size, theme, Fake::default(), Some(json));
        window.press(Key::V);
        window.settle();
        let axial = slice_rect(&window, "Axial");
        window.click_at(axial.center() + vec2(30.0, -40.0));
        window.settle();
        window.look(name);
        if theme == egui::Theme::Dark {
            window
                .harness
                .get_all_by_label("Slices in colour")
                .next()
                .expect("a button")
                .click();
            window.settle();
            window.look("head_slices_colour");
            window.press(Key::V);
            window.press(Key::B);
            window.settle();
            window.look("head_ghost");
        }
    }
}

// --------------------------------------------------------------------------------------------- window and level

impl Window {
    fn drag_with(&mut self, button: egui::PointerButton, from: Pos2, by: egui::Vec2) {
        let press = |pos, pressed| egui::Event::PointerButton {
            pos,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.harness.hover_at(from);
        self.harness.step();
        self.harness.event(press(from, true));
        self.harness.step();
        for i in 1..=6 {
            self.harness.hover_at(from + by * (i as f32 / 6.0));
            self.harness.step();
        }
        self.look("levelling");
        self.harness.event(press(from + by, false));
        self.settle();
    }
}

#[test]
fn a_right_drag_over_a_slice_changes_window_and_level() {
    let shown = |window: &Window| match window.document().illustration().look.window {
        ValueWindow::Range(range) => Some(range),
        ValueWindow::Auto => None,
    };
    let width = |[from, to]: [f32; 2]| to - from;
    let mut window = Window::open(FOUR, CUBE);
    window.press(Key::V);
    window.settle();
    let middle = slice_rect(&window, "Axial").center();
    let untouched = window.document();
    window.drag_with(egui::PointerButton::Secondary, middle, vec2(40.0, 0.0));
    let wider = shown(&window).expect("a window of its own");
    window.drag_with(egui::PointerButton::Secondary, middle, vec2(0.0, 40.0));
    let raised = shown(&window).expect("a window of its own");
    assert!(
        raised[0] > wider[0] && raised[1] > wider[1],
        "{wider:?} {raised:?}"
    );
    assert!((width(raised) - width(wider)).abs() < 1e-2 * width(wider));
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(shown(&window), Some(wider), "a drag is one step of undo");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.document(), untouched);
    // With its key a plain drag does the same; without it the plain drag moves the crosshair.
    window.press(Key::W);
    window.drag_with(egui::PointerButton::Primary, middle, vec2(40.0, 0.0));
    let by_key = shown(&window).expect("a window of its own");
    assert!((width(by_key) - width(wider)).abs() < 1e-2 * width(wider));
    window.press(Key::Escape);
    window.drag_with(egui::PointerButton::Primary, middle, vec2(40.0, 0.0));
    assert_eq!(shown(&window), Some(by_key));
}

/// Two fingers that go together over a slice do what the right button does, in one step of undo.
#[test]
fn two_fingers_over_a_slice_change_window_and_level() {
    let shown = |window: &Window| match window.document().illustration().look.window {
        ValueWindow::Range(range) => Some(range),
        ValueWindow::Auto => None,
    };
    let mut window = Window::open(FOUR, CUBE);
    window.press(Key::V);
    window.settle();
    let untouched = window.document();
    let middle = slice_rect(&window, "Axial").center();
    let drag = |window: &mut Window, by: Vec2| {
        // The first finger is the pointer too, as the window's system and the page tell it.
        let fingers = |window: &mut Window, part: f32, phase: egui::TouchPhase| {
            let first = middle + vec2(-25.0, 0.0) + by * part;
            window.harness.event(egui::Event::PointerMoved(first));
            if phase != egui::TouchPhase::Move {
                let pressed = phase == egui::TouchPhase::Start;
                window.harness.event(egui::Event::PointerButton {
                    pos: first,
                    button: egui::PointerButton::Primary,
                    pressed,
                    modifiers: Modifiers::NONE,
                });
            }
            for (id, beside) in [(1, 0.0), (2, 50.0)] {
                window.harness.event(egui::Event::Touch {
                    device_id: egui::TouchDeviceId(1),
                    id: egui::TouchId::from(id),
                    phase,
                    pos: first + vec2(beside, 0.0),
                    force: None,
                });
            }
            window.harness.step();
        };
        fingers(window, 0.0, egui::TouchPhase::Start);
        for i in 1..=8 {
            fingers(window, i as f32 / 8.0, egui::TouchPhase::Move);
        }
        fingers(window, 1.0, egui::TouchPhase::End);
        window.settle();
        shown(window).expect("a window of its own")
    };
    let width = |[from, to]: [f32; 2]| to - from;
    let raised = drag(&mut window, vec2(0.0, 40.0));
    let wider = drag(&mut window, vec2(40.0, 0.0));
    assert!(width(wider) > 1.1 * width(raised), "{raised:?} {wider:?}");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(shown(&window), Some(raised), "a drag is one step of undo");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.document(), untouched);
}

/// What is known of the scan stands in one place, in the words of the field.
#[test]
fn the_facts_of_the_scan_are_told() {
    let mut window = Window::open(DESK, CUBE);
    window.click("About this scan");
    window.look("about_scan");
    let told: Vec<String> = window
        .harness
        .get_all_by_role(Role::Label)
        .filter_map(|node| node.accesskit_node().value())
        .collect();
    let side = RESOLUTION.to_string();
    let voxels = format!("{side} × {side} × {side}");
    let spacing = fabrica_number(100.0 / f64::from(RESOLUTION));
    for line in [
        voxels,
        format!("{spacing} × {spacing} × {spacing} mm"),
        "100 × 100 × 100 mm".to_owned(),
    ] {
        assert!(told.contains(&line), "{line} in {told:?}");
    }
}

/// A number with at most three decimals, as the window writes it.
fn fabrica_number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
