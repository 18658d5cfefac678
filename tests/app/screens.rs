//! Windows of every size: desks, phones, themes, names of controls, rest.

use super::*;

/// The head as a visitor sees it; drawn only to be looked at, since it takes its time on a software device.
#[test]
#[ignore = "only drawn to be looked at: cargo xtask look"]
fn the_head_to_look_at() {
    let json = r#"{ "fabrica": 1, "templates": [ { "kind": "peel", "at": [0.02,0.24,0.2],
        "rotate": [0,0.7071,0.7071,0], "size": [0.36,0.3,0.2], "params": { "progress": 0.6 } } ] }"#;
    for (name, size, theme) in [
        ("head", DESK, egui::Theme::Light),
        ("head_dark", DESK, egui::Theme::Dark),
        ("head_phone", vec2(360.0, 740.0), egui::Theme::Light),
    ] {
        let mut window = Window::open_with(size, theme, Fake::default(), Some(json));
        window.settle();
        window.look(name);
        if size == DESK {
            window.click("1. Peel");
        } else {
            window.press(Key::N);
        }
        window.look(&format!("{name}_selected"));
    }
}

#[test]
fn a_phone_has_drawers() {
    let mut window = Window::open(vec2(360.0, 740.0), CUBE);
    window.look("phone");
    assert!(
        window.harness.query_by_label("Place peel").is_none(),
        "the picture is alone"
    );
    window.click("Add");
    window.look("phone_add");
    window.click("Place peel");
    assert!(
        window.harness.query_by_label("Place flap").is_none(),
        "the drawer makes room for the picture"
    );
    window.look("phone_placing");
    let center = window.picture_center();
    window.click_at(center);
    assert_eq!(window.document().illustration().templates.len(), 1);
    window.look("phone_placed");
    window.click("Templates");
    assert!(window.harness.query_by_label("Progress slider").is_some());
    window.look("phone_templates");
    window.click("Look");
    window.look("phone_look");
    let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(360.0, 740.0));
    for name in [
        "Copy link",
        "More",
        "Undo",
        "Redo",
        "Add",
        "Templates",
        "Look",
        "Text",
    ] {
        let rect = window
            .harness
            .get_by_role_and_label(Role::Button, name)
            .rect();
        assert!(
            screen.expand(0.5).contains_rect(rect),
            "{name} is on the screen: {rect}"
        );
        assert!(
            rect.width().min(rect.height()) >= 40.0,
            "{name} is large enough for a thumb: {rect}"
        );
    }
}

/// What a thumb or a small window meets, in every language, to be looked at.
#[test]
#[ignore = "only drawn to be looked at: cargo xtask look"]
fn small_screens_to_look_at() {
    let json = r#"{ "fabrica": 1, "title": "Cube", "subject": { "builtin": "cube" },
        "templates": [ { "kind": "peel", "at": [0,0,0.2], "size": [0.8,0.8,0.6], "params": { "progress": 0.6 } },
        { "kind": "retractor", "at": [0,0.4,0], "rotate": [-0.7,0,0,0.7], "size": [0.4,0.4,0.3] } ] }"#;
    for (lang, theme) in [("de", egui::Theme::Light), ("es", egui::Theme::Dark)] {
        let log = Fake::default();
        log.store_value("language", lang);
        let mut window = Window::open_with(vec2(360.0, 640.0), theme, log, Some(json));
        window.press(Key::N);
        window.look(&format!("small_{lang}"));
        window.press(Key::V);
        window.settle();
        window.look(&format!("small_{lang}_slices"));
        window.press(Key::V);
        for i in 0..4 {
            window.press(Key::E);
            window.steps(8);
            window.look(&format!("small_{lang}_panel{i}"));
        }
    }
    let log = Fake::default();
    log.store_value("contrast", "high");
    log.store_value("language", "de");
    let size = vec2(780.0, 480.0);
    let mut window = Window::open_with(size, egui::Theme::Dark, log, Some(json));
    window.press(Key::N);
    window.look("tight_contrast");
    window.press(Key::V);
    window.settle();
    window.look("tight_contrast_slices");
}

#[test]
fn the_dark_theme_and_the_look_panel() {
    let json = r##"{ "fabrica": 1, "subject": { "builtin": "cube" }, "look": { "background": "#15181a" },
        "templates": [ { "kind": "peel", "at": [0,0,0.2], "size": [0.8,0.8,0.6] } ] }"##;
    let mut window = Window::open_with(DESK, egui::Theme::Dark, Fake::default(), Some(json));
    window.look("dark");
    window.click("Panel: Look");
    window.click("Background: Paper");
    window.look("dark_look");
    let look = window.document().illustration().look.clone();
    assert_eq!(
        look.background,
        fabrica::document::Background::Color([246, 241, 231])
    );
    window.click("Opacity: Keep mass");
    assert_eq!(
        window.document().illustration().look.opacity,
        fabrica::document::OpacityMode::Mass
    );
    window.click("Panel: Text");
    window.look("dark_text");
    window.harness.get_by_label("Title").focus();
    window.steps(2);
    window.harness.get_by_label("Title").type_text("Dh?");
    window.steps(3);
    assert_eq!(
        window.document().illustration().title,
        "Dh?",
        "letters belong to the field, not to the keys"
    );
    assert_eq!(window.document().illustration().templates.len(), 1);
}

#[test]
fn the_picture_alone_has_its_texts_and_a_way_back() {
    let json = r#"{ "fabrica": 1, "title": "A cube", "caption": "Strata and a ball", "subject": { "builtin": "cube" } }"#;
    let mut window = Window::open(DESK, json);
    window.press(Key::P);
    window.settle();
    window.look("alone");
    assert!(
        window.harness.query_by_label("Copy link").is_none(),
        "no panels"
    );
    window.click("Show the panels");
    assert!(
        window.harness.query_by_label("Copy link").is_some(),
        "and back"
    );
}

#[test]
fn every_control_has_a_name() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "move" }, { "kind": "slices" }, { "kind": "split" }, { "kind": "cut" }, { "kind": "pull", "mode": "add" } ] }"#;
    let mut window = Window::open(DESK, json);
    let check = |window: &Window, place: &str| {
        let interactive = [
            Role::Button,
            Role::CheckBox,
            Role::Slider,
            Role::SpinButton,
            Role::TextInput,
            Role::ComboBox,
            Role::RadioButton,
            Role::ListItem,
            Role::ColorWell,
        ];
        for node in window.harness.root().children_recursive() {
            let node = node.accesskit_node();
            if interactive.contains(&node.role()) {
                let name = node.label().unwrap_or_default();
                assert!(
                    !name.trim().is_empty(),
                    "{place}: a {:?} without a name, {:?}",
                    node.role(),
                    node.bounding_box()
                );
            }
        }
    };
    check(&window, "start");
    for entry in ["1. Move", "2. Slices", "3. Split", "4. Cut", "5. Pull"] {
        window.click(entry);
        if window.harness.query_by_label("Unfold placement").is_some() {
            window.click("Unfold placement");
        }
        check(&window, entry);
    }
    window.look("desk_inspector");
    for tab in ["Panel: Look", "Panel: Text"] {
        window.click(tab);
        check(&window, tab);
    }
}

/// A device that is a hundred times slower than this one, and one that is a thousand times faster.
#[test]
fn slow_graphics_are_told_of_once() {
    const TOLD: &str = "Slow graphics: pictures come in steps";
    fn slow() -> f64 {
        clock() * 100.0
    }
    fn fast() -> f64 {
        clock() * 1e-3
    }
    let open = |clock: fn() -> f64, log: &Fake| {
        log.0.borrow_mut().clock = Some(clock);
        log.0.borrow_mut().said.clear();
        let size = vec2(780.0, 420.0);
        Window::open_with(size, egui::Theme::Light, log.clone(), Some(CUBE));
        // The message itself may have gone by meanwhile.
        let said = &log.0.borrow().said;
        said.iter().any(|line| line == TOLD)
    };
    assert!(!open(fast, &Fake::default()), "there is nothing to tell");
    let log = Fake::default();
    assert!(open(slow, &log), "it is told");
    assert!(!open(slow, &log), "once");
}

#[test]
fn at_rest_nothing_repaints() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    window.settle();
    // Messages go by; then there is silence.
    let patience = clock() + 240.0;
    while clock() < patience {
        window.harness.step();
        let delay = window.harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
        if delay > std::time::Duration::from_secs(1) {
            window.look("desk_icons");
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    panic!("still repainting");
}

#[test]
fn a_drawer_is_scrolled_by_a_finger() {
    let mut window = Window::open(vec2(360.0, 640.0), CUBE);
    // From the first touch on, drags scroll what they do not hold.
    for phase in [egui::TouchPhase::Start, egui::TouchPhase::End] {
        window.harness.event(egui::Event::Touch {
            device_id: egui::TouchDeviceId(1),
            id: egui::TouchId(1),
            phase,
            pos: pos2(5.0, 200.0),
            force: None,
        });
        window.steps(2);
    }
    window.click("Look");
    window.steps(10);
    let height = |window: &Window| {
        let button = window.harness.get_by_label("Background: Paper");
        button.rect().center().y
    };
    let look = window.document().illustration().look.clone();
    // On a name, and on the plot between its points.
    for from in [pos2(30.0, 378.0), pos2(230.0, 480.0)] {
        let before = height(&window);
        window.drag(from, vec2(0.0, -120.0));
        let moved = before - height(&window);
        assert!(moved > 60.0, "from {from}: {moved}");
        window.drag(pos2(from.x, 330.0), vec2(0.0, 240.0));
    }
    assert_eq!(
        window.document().illustration().look,
        look,
        "and nothing else"
    );
}
