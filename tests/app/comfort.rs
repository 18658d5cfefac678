//! The first hint, contrast, lettering of saved pictures, large screens.

use super::*;

fn stored(window: &Window, key: &str) -> Option<String> {
    window.log.0.borrow().stored.get(key).cloned()
}

#[test]
fn the_first_hint_is_followed_and_does_not_come_again() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), None);
    assert!(
        window.harness.query_by_label("Got it").is_some(),
        "the first visit shows it"
    );
    window.look("hint");
    window.click("Place peel");
    window.press(Key::Enter);
    window.settle();
    window.look("hint_placed");
    assert!(window.harness.query_by_label("Got it").is_some());
    window.click("Copy link");
    window.steps(3);
    assert!(
        window.harness.query_by_label("Got it").is_none(),
        "its last step puts it away"
    );
    assert_eq!(stored(&window, "hint").as_deref(), Some("seen"));

    let phone = vec2(360.0, 640.0);
    let mut window = Window::open_with(phone, egui::Theme::Light, Fake::default(), None);
    window.look("hint_phone");
    window.click("Got it");
    assert!(window.harness.query_by_label("Got it").is_none());
    assert_eq!(stored(&window, "hint").as_deref(), Some("seen"));

    let window = Window::open(DESK, CUBE);
    assert!(
        window.harness.query_by_label("Got it").is_none(),
        "who opens a link comes to look"
    );
}

#[test]
fn high_contrast_is_switched_and_kept() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [ { "kind": "peel" } ] }"#;
    for theme in [egui::Theme::Light, egui::Theme::Dark] {
        let mut window = Window::open_with(DESK, theme, Fake::default(), Some(json));
        window.click("1. Peel");
        window.click("More");
        window.click("High contrast");
        window.steps(3);
        assert_eq!(stored(&window, "contrast").as_deref(), Some("high"));
        window.look(&format!("contrast_{theme:?}"));
        let log = window.log.clone();
        let mut again = Window::open_with(DESK, theme, log, Some(json));
        again.click("More");
        again.click("Usual contrast");
        assert_eq!(stored(&again, "contrast").as_deref(), Some("usual"));
    }
}

#[test]
fn title_and_credit_are_written_into_a_saved_picture() {
    let json = r##"{ "fabrica": 1, "title": "Strata of a cube", "credit": "Drawn by a test", "subject": { "builtin": "cube" } }"##;
    let mut window = Window::open(DESK, json);
    window.save_small_pictures();
    let mut save = |is_lettered: bool| {
        if is_lettered {
            window.click("Panel: Text");
            window.click("Write title, credit and labels into saved pictures");
            assert_eq!(stored(&window, "lettering").as_deref(), Some("yes"));
        }
        window.saved_picture()
    };
    let plain = save(false);
    let lettered = save(true);
    if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
        let path = std::path::Path::new(&folder).join("lettered.png");
        lettered.save(path).expect("a picture to look at");
    }
    let ink = |picture: &image::RgbaImage, rows: std::ops::Range<u32>| {
        let dark = |p: &image::Rgba<u8>| p.0[..3].iter().all(|c| *c < 70);
        rows.flat_map(|y| (0..picture.width()).map(move |x| (x, y)))
            .filter(|&(x, y)| dark(picture.get_pixel(x, y)))
            .count()
    };
    let height = lettered.height();
    for rows in [0..height / 8, height * 9 / 10..height] {
        let (without, with) = (ink(&plain, rows.clone()), ink(&lettered, rows.clone()));
        assert!(with > without + 200, "rows {rows:?}: {without} and {with}");
    }
}

/// Where the surroundings set texts, as a page does, captions are theirs in every script, as long as nothing of the
/// interface lies over them; and so are the letters of saved pictures that the window's fonts cannot set.
#[test]
fn captions_are_given_to_surroundings_that_set_texts() {
    const LETTERS: &str = r#"{ "fabrica": 1, "title": "A cube", "subject": { "builtin": "cube" }, "labels": [
        { "at": [0.3, 0.49, 0.3], "text": "Upper corner" }, { "at": [-0.3, 0.49, -0.3], "text": "עצם" },
        { "at": [0, 0, 0], "text": "Not at this step", "enabled": false }, { "at": [0, 9, 0], "text": "Far away" } ] }"#;
    let seen = |window: &Window| -> Vec<(usize, String, bool)> {
        let log = window.log.0.borrow();
        let texts = log.over.iter();
        texts
            .map(|over| (over.caption, over.text.clone(), over.at.is_some()))
            .collect()
    };
    let is_warned = |window: &Window| {
        let log = window.log.0.borrow();
        log.said
            .iter()
            .any(|said| said.contains("Arabic or Hebrew"))
    };
    let log = Fake::default();
    log.0.borrow_mut().has_other_letters = true;
    let own = Window::open_with(DESK, egui::Theme::Light, log, Some(LETTERS));
    assert!(own.harness.query_by_label("Upper corner").is_some());
    assert!(is_warned(&own) && seen(&own).is_empty());

    let log = Fake::default();
    let size = vec2(70.0, 18.0);
    log.0.borrow_mut().has_other_letters = true;
    log.0.borrow_mut().sets_texts = Some(size);
    let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(LETTERS));
    let expected = |[first, second]: [bool; 2]| {
        vec![
            (0, "Upper corner".to_owned(), first),
            (1, "עצם".to_owned(), second),
            (3, "Far away".to_owned(), false),
        ]
    };
    assert_eq!(seen(&window), expected([true, true]));
    assert!(!is_warned(&window), "they are set rightly");
    assert!(
        window.harness.query_by_label("Upper corner").is_none(),
        "the canvas has not the same text once more"
    );
    let picture = window.harness.get_by_role(egui::Role::Image).rect();
    for over in &window.log.0.borrow().over {
        let whole = over.at.map(|at| egui::Rect::from_min_size(at, size));
        let is_in = whole.is_none_or(|whole| picture.contains_rect(whole));
        assert!(is_in && !over.is_light && over.letters > 8.0, "{over:?}");
    }
    // What lies over a text has the text under it.
    window.press(Key::Questionmark);
    window.steps(2);
    assert_eq!(seen(&window), expected([false, false]));
    assert!(window.harness.query_by_label("Upper corner").is_some());
    window.press(Key::Escape);
    window.steps(3);
    assert_eq!(seen(&window), expected([true, true]));
    // A click on a text of theirs goes to its field.
    window.harness.state_mut().edit_caption(1);
    window.steps(3);
    let field = window
        .harness
        .get_by_role_and_label(egui::Role::TextInput, "Text of label 2");
    assert!(field.is_focused());
    window.harness.state_mut().edit_caption(77);
    window.press(Key::Escape);

    window.click("Write title, credit and labels into saved pictures");
    window.save_small_pictures();
    let lettered = window.saved_picture();
    let log = window.log.0.borrow();
    let set = log.set.borrow();
    let texts: Vec<&str> = set.iter().map(|set| set.text.as_str()).collect();
    assert_eq!(texts, ["עצם"], "the window's fonts do for the others");
    let is_ink = |x: u32, y: u32| lettered.get_pixel(x, y).0 == [0x1f, 0x24, 0x26, 255];
    let is_block = |x: u32, y: u32| (0..200).step_by(20).all(|right| is_ink(x + right, y));
    let rows = 0..lettered.height();
    let blocks = rows.filter(|y| (0..lettered.width() - 200).any(|x| is_block(x, *y)));
    assert_eq!(blocks.count(), 30, "the letters that were handed over");
}

/// A frame that takes a second lies between press and release of a short click; a finger that rests is still a finger
/// that rests.
#[test]
fn clicks_count_on_slow_devices() {
    let mut window = Window::open(DESK, CUBE);
    let at = window
        .harness
        .get_by_label("Panel: Tissues")
        .rect()
        .center();
    let now = |window: &Window| window.harness.ctx.input(|i| i.time);
    let is_open = |window: &Window| window.harness.query_by_label("Make a tissue").is_some();
    let button = |pressed| egui::Event::PointerButton {
        pos: at,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let frame = |window: &mut Window, time: f64, events: &[egui::Event]| {
        let input = window.harness.input_mut();
        input.time = Some(time);
        input.events.extend_from_slice(events);
        window.harness.step();
    };
    window.harness.hover_at(at);
    window.steps(2);
    // Held for a second and more while frames are quick: not a click.
    let mut time = now(&window);
    frame(&mut window, time + 0.02, &[button(true)]);
    for i in 1..60 {
        frame(&mut window, time + 0.02 * f64::from(i + 1), &[]);
    }
    frame(&mut window, time + 1.22, &[button(false)]);
    window.steps(2);
    assert!(!is_open(&window), "it was held");
    time = now(&window);
    frame(&mut window, time + 0.02, &[button(true)]);
    frame(&mut window, time + 1.1, &[]);
    frame(&mut window, time + 2.2, &[button(false)]);
    window.steps(2);
    assert!(is_open(&window), "it was clicked");
}

/// Whoever comes to the texts with the mouse types the title at once, also where the click is over within one frame;
/// a title that is there already stays.
#[test]
fn the_title_is_typed_at_once() {
    let typed = |json: &str, is_slow: bool| {
        let mut window = Window::open(DESK, json);
        let at = window.harness.get_by_label("Panel: Text").rect().center();
        if is_slow {
            window.harness.hover_at(at);
            window.harness.step();
            for pressed in [true, false] {
                window.harness.event(egui::Event::PointerButton {
                    pos: at,
                    button: egui::PointerButton::Primary,
                    pressed,
                    modifiers: Modifiers::NONE,
                });
            }
            window.harness.step();
        } else {
            window.click_at(at);
        }
        window.harness.event(egui::Event::Text("Skull".to_owned()));
        window.steps(3);
        window.document().illustration().title.clone()
    };
    assert_eq!(typed(CUBE, false), "Skull");
    assert_eq!(typed(CUBE, true), "Skull");
    let titled = CUBE.replace("{ ", r#"{ "title": "Bone", "#);
    assert_eq!(typed(&titled, false), "Bone");
}

/// A drawer begins at its top, wherever the one before it was scrolled to.
#[test]
fn each_drawer_begins_at_its_top() {
    let peeled =
        r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [{ "kind": "peel" }] }"#;
    let mut window = Window::open(vec2(390.0, 844.0), peeled);
    window.click("Select Peel");
    window.steps(2);
    window.click("Templates");
    window.steps(5);
    window.harness.hover_at(egui::pos2(195.0, 650.0));
    window.harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, -400.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.steps(20);
    window.click("Text");
    window.steps(5);
    assert!(
        window.harness.query_by_label("Title").is_some(),
        "the first field is in the drawer"
    );
}
