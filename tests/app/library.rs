//! The library: examples, and documents that were open before.

use super::*;
use fabrica::app::Shipped;
use fabrica::document::Illustration;

/// How many examples the list has that ships with the program.
fn examples() -> usize {
    let list = include_bytes!("../../web/examples/list.json");
    let list: serde_json::Value = serde_json::from_slice(list).expect("JSON");
    let count = list["examples"].as_array().expect("examples").len();
    assert!(count >= 45, "{count} examples");
    count
}

/// A document with something placed, so that it counts as work.
const OWN: &str = r#"{ "fabrica": 1, "title": "My work", "subject": { "builtin": "cube" }, "templates": [ { "kind": "hole" } ] }"#;

fn fetched(window: &Window) -> Vec<Shipped> {
    window.log.0.borrow().fetched.clone()
}

fn shown(window: &Window) -> Illustration {
    window.document().illustration().clone()
}

/// The names of the examples that are offered.
fn offered(window: &Window) -> Vec<String> {
    let nodes = window.harness.root().children_recursive();
    let names = nodes.filter_map(|node| {
        let node = node.accesskit_node();
        let name = node.label().filter(|_| node.role() == Role::Button)?;
        name.strip_prefix("Open the example ").map(str::to_owned)
    });
    names.collect()
}

fn recent(window: &Window) -> usize {
    let kept = window.log.0.borrow().stored.get("recent").cloned();
    kept.unwrap_or_default().lines().count()
}

#[test]
fn examples_are_fetched_when_they_are_looked_at() {
    let mut window = Window::open(DESK, CUBE);
    assert!(fetched(&window).is_empty(), "nothing is fetched unasked");
    window.click("Examples");
    window.settle();
    let both = [Shipped::Examples, Shipped::ExamplePictures];
    assert_eq!(fetched(&window), both);
    assert_eq!(offered(&window).len(), examples());
    window.look("examples");
    window.click("Close the examples");
    assert!(offered(&window).is_empty(), "it is closed");
    window.click("Examples");
    assert_eq!(fetched(&window), both, "once is enough");
    assert_eq!(offered(&window).len(), examples());
}

fn search(window: &mut Window, text: &str) {
    window.harness.get_by_label("Search the examples").focus();
    window.steps(2);
    let search = window.harness.get_by_label("Search the examples");
    search.type_text(text);
    window.steps(3);
}

#[test]
fn examples_are_searched_and_filtered() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Examples");
    window.settle();
    search(&mut window, "knee flap");
    let found = offered(&window);
    assert!(!found.is_empty() && found.len() < 6, "{found:?}");
    window.click("Clear the search for examples");
    assert_eq!(offered(&window).len(), examples());
    window.click("Subject of the examples");
    window.click("Tomato");
    let tomatoes = offered(&window);
    assert!((2..6).contains(&tomatoes.len()), "{tomatoes:?}");
    window.click("Template of the examples");
    window.click("Wave");
    assert_eq!(offered(&window), ["Order matters"]);
    window.look("examples_found");
    search(&mut window, "spleen");
    window.harness.get_by_label("No example is like that");
}

#[test]
fn a_click_opens_an_example_as_its_link_would() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Examples");
    window.settle();
    search(&mut window, "bent");
    let name = offered(&window)[0].clone();
    window.click(&format!("Open the example {name}"));
    window.settle();
    assert!(offered(&window).is_empty(), "the library makes room");
    assert_eq!(shown(&window).title, name);
    assert_eq!(window.harness.state().step(), 0);
    let links = window.log.0.borrow().links.clone();
    let (link, change) = links.last().expect("the address follows");
    assert_eq!(*change, LinkChange::Push, "and can go back");
    let linked = fabrica::link::decode(link).expect("a link").document;
    assert_eq!(linked, window.document());
    assert_eq!(recent(&window), 1, "the cube that was looked at");

    // A look at another example leaves no trace of this one.
    window.click("Examples");
    let other = offered(&window)[1].clone();
    window.click(&format!("Open the example {other}"));
    assert_eq!(recent(&window), 1);
}

#[test]
fn a_copy_of_an_example_is_ones_own() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Examples");
    window.settle();
    let name = offered(&window)[0].clone();
    window.click(&format!("Make it mine: {name}"));
    window.settle();
    assert_eq!(shown(&window).title, format!("Copy of {name}"));
    assert!(window.harness.state().selected().is_some(), "it is edited");
    window.look("examples_mine");
    window.press(Key::Delete);
    window.settle();
    window.click("Examples");
    assert_eq!(offered(&window)[0], name, "the example stays as it is");
}

/// Tab goes from card to card, Enter opens, Escape closes.
#[test]
fn keys_reach_every_example() {
    let mut window = Window::open(DESK, CUBE);
    window.harness.get_by_label("Examples").focus();
    window.steps(2);
    window.press(Key::Enter);
    window.settle();
    let mut reached = Vec::new();
    for _ in 0..2 * examples() + 12 {
        window.press(Key::Tab);
        let root = window.harness.root();
        let focused = root.children_recursive().find(|node| node.is_focused());
        let name = focused.and_then(|node| node.accesskit_node().label());
        reached.extend(name.filter(|name| !reached.contains(name)));
    }
    for name in offered(&window) {
        let open = format!("Open the example {name}");
        assert!(reached.contains(&open), "{open}: {reached:?}");
        let mine = format!("Make it mine: {name}");
        assert!(reached.contains(&mine), "{mine}: {reached:?}");
    }
    let card = window
        .harness
        .get_by_label_contains("Open the example Whiplash");
    card.focus();
    window.steps(3);
    window.press(Key::Escape);
    assert!(offered(&window).is_empty(), "Escape closes");
    assert_eq!(shown(&window).title, "", "and opens nothing");
    window.click("Examples");
    let last = offered(&window).last().cloned().expect("examples");
    let open = format!("Open the example {last}");
    window.harness.get_by_label(&open).focus();
    window.steps(3);
    window.press(Key::Enter);
    assert_eq!(shown(&window).title, last);
}

#[test]
fn what_makes_room_is_listed_and_comes_back() {
    let mut window = Window::open(DESK, OWN);
    window.click("Examples");
    window.settle();
    let name = offered(&window)[0].clone();
    let own = window.document();
    window.click(&format!("Open the example {name}"));
    window.settle();
    window.click("Examples");
    window.click("Show: Recent documents");
    window.look("examples_recent");
    window.click("Open My work");
    window.settle();
    assert_eq!(window.document(), own);
    assert_eq!(recent(&window), 0, "what is open is not listed");

    // Work that another document replaces without a question.
    window.press(Key::Delete);
    window.click("1. Hole");
    window.press(Key::Delete);
    window.log.0.borrow_mut().queue.push(Message::OpenText {
        text: CUBE.to_owned(),
    });
    window.settle();
    assert_eq!(recent(&window), 1);
    window.click("Examples");
    window.click("Show: Recent documents");
    window.harness.get_by_label("Open My work");
    window.click("Remove My work from the list");
    assert!(window.harness.query_by_label("Open My work").is_none());
    assert_eq!(recent(&window), 0);
}

/// The pictures that are kept of recent documents.
fn kept_pictures(window: &Window) -> Vec<String> {
    let log = window.log.0.borrow();
    let kept = log.stored.get("recent-pictures").cloned();
    kept.unwrap_or_default()
        .lines()
        .map(str::to_owned)
        .collect()
}

/// What is left for another document is listed with the picture that it had, which goes when the entry goes.
#[test]
fn recent_documents_have_pictures() {
    let log = Fake::default();
    let without = r#"{ "fabrica": 1, "title": "Without" }"#;
    let without = Document::from_json(without).expect("a document");
    log.store_value("recent", &fabrica::link::encode(&without));
    let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(OWN));
    let rest = |window: &mut Window| {
        // Two seconds at rest, on the clock of the interface.
        window.steps(130);
        window.settle();
    };
    rest(&mut window);
    let own = window.log.0.borrow().stored.get("picture").cloned();
    let own = own.expect("a small picture of the open document");
    assert!(own.len() < 9_000, "{} characters", own.len());
    let open = |window: &mut Window, text: &str| {
        let text = text.to_owned();
        let log = &window.log.0;
        log.borrow_mut().queue.push(Message::OpenText { text });
        window.settle();
    };
    window.press(Key::N);
    window.press(Key::H);
    rest(&mut window);
    open(&mut window, CUBE);
    assert_eq!(recent(&window), 2);
    assert_eq!(kept_pictures(&window).len(), 1, "of what was left");
    window.click("Examples");
    window.click("Show: Recent documents");
    window.steps(3);
    window.look("recent_pictures");
    window.click("Remove My work from the list");
    assert_eq!(kept_pictures(&window).len(), 0, "it goes with its document");
    window.click("Remove Without from the list");
    // Then there is silence.
    window.click("Close the examples");
    rest(&mut window);
    window.steps(600);
    let delay = window.harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    assert!(delay > std::time::Duration::from_secs(1), "{delay:?}");
}

/// The picture that the last visit kept is of its document alone, not of one that is left at once.
#[test]
fn a_document_left_at_once_has_no_picture_of_another() {
    let log = Fake::default();
    log.store_value("document", &fabrica::link::encode(&Document::new()));
    log.store_value("picture", "0123456789abcdef iVBORw0KGgo");
    // No subject comes, so that no picture of it is complete.
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log, Some(OWN));
    window.press(Key::N);
    window.press(Key::H);
    let text = CUBE.to_owned();
    let log = &window.log.0;
    log.borrow_mut().queue.push(Message::OpenText { text });
    window.steps(3);
    assert_eq!(recent(&window), 1, "what was left");
    assert_eq!(kept_pictures(&window), [""; 0]);
}

/// The document of the last visit is not lost when a link is opened.
#[test]
fn a_link_keeps_the_document_of_the_last_visit() {
    let own = Document::from_json(OWN).expect("a document");
    let log = Fake::default();
    log.store_value("document", &fabrica::link::encode(&own));
    let window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    assert_eq!(recent(&window), 1);
    drop(window);
    // The same link again, as on a reload.
    let window = Window::open_with(DESK, egui::Theme::Light, log, Some(CUBE));
    assert_eq!(recent(&window), 1);
}

#[test]
fn a_list_that_does_not_come_is_asked_for_again() {
    let log = Fake::default();
    log.0.borrow_mut().is_offline = true;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    window.click("Examples");
    window.settle();
    log.0.borrow_mut().is_offline = false;
    window.click("Try again");
    window.settle();
    assert_eq!(offered(&window).len(), examples());
}

#[test]
fn a_phone_offers_examples_on_the_empty_start() {
    let size = vec2(360.0, 640.0);
    let mut window = Window::open_with(size, egui::Theme::Light, Fake::default(), None);
    window.look("examples_phone_start");
    window.click("Or start from an example");
    window.settle();
    window.look("examples_phone");
    let screen = egui::Rect::from_min_size(Pos2::ZERO, size);
    let first = format!("Open the example {}", offered(&window)[0]);
    let card = window.harness.get_by_label(&first).rect();
    assert!(screen.x_range().contains(card.left()) && screen.x_range().contains(card.right()));
    assert!(card.width() >= 120.0, "{card}");
    window.click("Close the examples");
    window.click("More");
    window.click("Examples");
    assert_eq!(offered(&window).len(), examples());
}
