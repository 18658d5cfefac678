//! The dialog that shares an illustration.

use super::*;

const LESSON: &str = r#"{ "fabrica": 1, "title": "A <b>cube</b>", "caption": "Peeled.", "subject": { "builtin": "cube" },
    "templates": [{ "kind": "peel" }], "steps": [{ "title": "One", "set": { "/templates/0/params/progress": 0.2 } }] }"#;

fn opened(size: Vec2, theme: egui::Theme, json: &str) -> Window {
    let mut window = Window::open_with(size, theme, Fake::fine(), Some(json));
    window.settle();
    window.click("More");
    window.click("Share…");
    window.steps(3);
    window
}

fn copied(window: &Window) -> String {
    let log = window.log.0.borrow();
    log.copied.last().cloned().expect("something was copied")
}

/// The QR codes in a picture of the window.
fn codes(window: &mut Window) -> Vec<String> {
    let image = window.harness.render().expect("the window can be drawn");
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut prepared = rqrr::PreparedImage::prepare_from_greyscale(width, height, |x, y| {
        image.get_pixel(x as u32, y as u32)[0]
    });
    let grids = prepared.detect_grids();
    let read = grids.iter().filter_map(|grid| grid.decode().ok());
    read.map(|(_, text)| text).collect()
}

#[test]
fn link_code_and_html_are_shared() {
    for theme in [egui::Theme::Light, egui::Theme::Dark] {
        let mut window = opened(DESK, theme, LESSON);
        window.look(&format!("share_{theme:?}"));
        {
            let mut buttons = window.harness.query_all_by_label("Copy link");
            // The first one is in the bar.
            buttons.nth(1).expect("a button").click();
        }
        window.steps(3);
        let link = copied(&window);
        assert!(link.starts_with("https://fabrica.example/#1"), "{link}");
        assert_eq!(
            codes(&mut window),
            std::slice::from_ref(&link),
            "as seen on the screen"
        );
        for (name, tag) in [
            ("Copy as element", "<fabrica-viewer src="),
            ("Copy as frame", "<iframe src="),
            (
                "Copy as text with link",
                "<p>A &lt;b&gt;cube&lt;/b&gt;. Peeled. Object: cube. ",
            ),
        ] {
            window.click(name);
            let html = copied(&window);
            for part in [
                tag,
                link.as_str(),
                "A &lt;b&gt;cube&lt;/b&gt;",
                "<p>Peeled.</p>",
                "<li><strong>One</strong>",
            ] {
                assert!(html.contains(part), "{name}: “{part}” is not in {html}");
            }
            let is_said = |log: &Fake| {
                log.0
                    .borrow()
                    .said
                    .iter()
                    .any(|text| text.contains("HTML is on the clipboard"))
            };
            assert!(is_said(&window.log), "{name}");
        }
        window.press(Key::Escape);
        assert!(window.harness.query_by_label("Copy as element").is_none());
    }
}

#[test]
fn what_others_cannot_open_and_what_is_long_is_told() {
    let mut phone = opened(vec2(360.0, 640.0), egui::Theme::Light, LESSON);
    phone.look("share_phone");
    assert!(
        phone
            .harness
            .query_by_label_contains("Others cannot open this")
            .is_none()
    );
    let supplied = format!(
        r#"{{ "fabrica": 1, "subject": {{ "sha256": "{}", "name": "CT" }} }}"#,
        "a".repeat(64)
    );
    // The scan never comes.
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(&supplied));
    window.steps(3);
    window.click("More");
    window.click("Share…");
    window
        .harness
        .get_by_label_contains("Others cannot open this");
    // Too long for a code: the words stay where it was.
    let word = |i: u64| {
        format!(
            "{:016x}",
            (i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (i * i * 0x94d0_49bb)
        )
    };
    let labels: Vec<String> = (0..250)
        .map(|i| format!(r#"{{"text":"{}{}"}}"#, word(i), word(i + 999)))
        .collect();
    let long = format!(
        r#"{{ "fabrica": 1, "subject": {{ "builtin": "cube" }}, "labels": [{}] }}"#,
        labels.join(",")
    );
    let mut window = opened(DESK, egui::Theme::Light, &long);
    window.look("share_long");
    window
        .harness
        .get_by_label_contains("too long for a QR code");
    window
        .harness
        .get_by_label_contains("better pass on the document");
    assert!(
        window
            .harness
            .query_by_label("QR code of the link")
            .is_none()
    );
}

/// A picture of a chosen size is saved from the dialog.
#[test]
fn a_picture_has_the_size_that_was_chosen() {
    let mut window = opened(vec2(1280.0, 1100.0), egui::Theme::Light, LESSON);
    window.click("Pixels along the longer side: 1000");
    window.click("Save picture");
    window.watch_saving();
    let log = window.log.0.borrow();
    let file = log.saved.last().expect("the picture");
    let side = |at: usize| u32::from_be_bytes(file.bytes[at..at + 4].try_into().expect("4 bytes"));
    let (width, height) = (side(16), side(20));
    assert_eq!(width.max(height), 1000, "{width} × {height}");
}

/// What stands behind the object in a saved picture is chosen in the dialog: the background, nothing, or a soft shadow
/// on either.
#[test]
fn a_saved_picture_gets_the_paper_that_is_chosen() {
    // Tall enough for the whole dialog: what is scrolled out of view takes no click.
    let mut window = opened(vec2(900.0, 1300.0), egui::Theme::Light, CUBE);
    window.save_small_pictures();
    window.look("share_paper");
    let mut saved = |name: &str| {
        window.click(&format!("Behind the object: {name}"));
        window.press(Key::Escape);
        let picture = window.saved_picture();
        window.click("More");
        window.click("Share…");
        window.steps(3);
        picture
    };
    let [plain, clear, shaded, cast] =
        ["Background", "Nothing", "Shadow", "Shadow alone"].map(&mut saved);
    if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
        let path = std::path::Path::new(&folder).join("shaded.png");
        shaded.save(path).expect("a picture to look at");
    }
    let corner = |image: &image::RgbaImage| image.get_pixel(2, 2).0;
    assert_eq!(corner(&clear), [0; 4]);
    assert_eq!(corner(&cast), [0; 4], "no shadow so far from the object");
    assert_eq!([corner(&plain)[3], corner(&shaded)[3]], [255; 2]);
    assert_eq!(corner(&plain), corner(&shaded));
    let darker = plain.pixels().zip(shaded.pixels());
    let darker = darker.filter(|(plain, shaded)| plain[1] > shaded[1].saturating_add(20));
    let veiled = cast
        .pixels()
        .filter(|pixel| pixel[3] > 20 && pixel[3] < 200);
    let (darker, veiled) = (darker.count(), veiled.count());
    assert!(
        darker > 1000 && veiled > 1000,
        "{darker} darker, {veiled} veiled"
    );
}
