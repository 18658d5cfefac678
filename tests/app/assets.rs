//! The files that a document names: found, named and refused as in the commands and on the page.

use super::*;
use fabrica::app::Command;
use fabrica::assets::Role;

/// The pictures are small: the tests look at the panels and the messages.
const SMALL: Vec2 = Vec2::new(780.0, 360.0);

/// A window over files that are there.
fn open(json: &str) -> Window {
    let log = Fake::default();
    log.0.borrow_mut().files = files();
    Window::open_with(SMALL, egui::Theme::Light, log, Some(json))
}

fn files() -> Vec<(String, Vec<u8>)> {
    let files = segment_files::files().into_iter();
    files
        .map(|(name, bytes)| (name.to_owned(), bytes))
        .collect()
}

fn shows(window: &Window, part: &str) -> bool {
    let mut found = window.harness.query_all_by_label_contains(part);
    found.next().is_some()
}

/// True if every part stands in the list of all messages, which keeps those that go by themselves.
fn has_told(window: &mut Window, parts: &[&str]) -> bool {
    let toggle = |window: &mut Window| {
        let app = window.harness.state_mut();
        app.run(Command::ToggleMessages);
        window.steps(3);
    };
    toggle(window);
    let is_told = parts.iter().all(|part| shows(window, part));
    toggle(window);
    is_told
}

/// A file that the user opened, or that takes the subject's place, is read.
fn arrives(window: &Window, name: &str, ticket: Ticket) {
    window.log.0.borrow_mut().read(name, Role::Subject, ticket);
}

/// The same as in a command (tests/gpu/cli.rs) and on the page (tests/browser/assets.rs).
#[test]
fn label_volumes_open_as_in_a_command() {
    for case in segment_files::cases() {
        let document = serde_json::json!({ "fabrica": 1, "subject": case.subject });
        let mut window = open(&document.to_string());
        window.settle();
        let parts: Vec<&str> = case.says.iter().map(String::as_str).collect();
        assert!(has_told(&mut window, &parts), "{}: {parts:?}", case.name);
        // An error stays over the picture, with the hashes behind a button.
        assert_eq!(shows(&window, "Details"), case.is_error, "{}", case.name);
        window.click("Panel: Tissues");
        let is_there = |name: &str| shows(&window, &format!("Show {name} alone"));
        for name in case.segments {
            assert!(is_there(name), "{}: no “{name}”", case.name);
        }
        for name in case.absent {
            assert!(!is_there(name), "{}: “{name}”", case.name);
        }
        if !case.is_error {
            continue;
        }
        // It goes on: another document opens.
        let text = CUBE.to_owned();
        let queue = |message| window.log.0.borrow_mut().queue.push(message);
        queue(Message::OpenText { text });
        window.settle();
        assert!(shows(&window, "Show top alone"), "{}", case.name);
    }
}

/// Who supplies another file than the document waits for is told both hashes, and may try again.
#[test]
fn another_file_than_the_one_waited_for_is_an_error() {
    let [(_, scan), _] = segment_files::files();
    let wanted = segment_files::hash(&scan);
    let json = format!(r#"{{ "fabrica": 1, "subject": {{ "sha256": "{wanted}" }} }}"#);
    let log = Fake::default();
    log.0.borrow_mut().files = files();
    // Nobody answers the first load but the test itself.
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(SMALL, egui::Theme::Light, log, Some(&json));
    let lost = LoadEvent::Failed {
        message: "open the file".to_owned(),
        details: String::new(),
        fault: None,
    };
    let ticket = Ticket(window.log.0.borrow().next_ticket);
    let say = |window: &Window, message| window.log.0.borrow_mut().queue.push(message);
    let event = lost;
    say(&window, Message::Load { ticket, event });
    window.log.0.borrow_mut().is_slow = false;
    window.steps(3);
    let before = window.document().to_json();
    let [_, (_, parts)] = segment_files::files();
    for (ticket, name) in [(Ticket(90), "parts.nii"), (Ticket(91), "scan.nii")] {
        window.log.file_starts(ticket);
        arrives(&window, name, ticket);
        window.settle();
        assert_eq!(
            window.document().to_json(),
            before,
            "{name}: nothing is replaced"
        );
        let is_right = name == "scan.nii";
        if !is_right {
            let both = [&*wanted, &segment_files::hash(&parts)];
            assert!(has_told(&mut window, &both), "both hashes are told");
        }
        window.click("Panel: Tissues");
        assert!(window.harness.state().is_at_rest(), "{name}: it goes on");
    }
    assert!(!shows(&window, "another file"), "it is there");
}

/// The file of `view --subject` takes the subject's place whatever its hash; that is a notice, and label volumes stay.
#[test]
fn a_file_in_place_of_the_subject_is_taken_with_a_notice() {
    let wanted = "1".repeat(64);
    let json = format!(
        r#"{{ "fabrica": 1, "subject": {{ "src": "gone.nii", "sha256": "{wanted}", "segments": {{ "src": "parts.nii" }} }} }}"#
    );
    let log = Fake::default();
    let ticket = Ticket(77);
    {
        let log = &mut *log.0.borrow_mut();
        log.files = files();
        log.instead = Some(ticket);
        log.read("scan.nii", Role::Subject, ticket);
    }
    let mut window = Window::open_with(SMALL, egui::Theme::Light, log, Some(&json));
    window.settle();
    let [(_, scan), _] = segment_files::files();
    let told = ["another file", &wanted, &segment_files::hash(&scan)];
    assert!(has_told(&mut window, &told), "it is a notice");
    window.click("Panel: Tissues");
    assert!(shows(&window, "Show segment 2 alone"), "its label volume");
}
