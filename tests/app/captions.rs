//! Captions: set on tissue, named, followed while the object is opened, written into saved pictures.

use super::*;
use fabrica::document::Caption;

impl Window {
    fn captions(&self) -> Vec<Caption> {
        self.document().illustration().captions.clone()
    }
}

#[test]
fn a_caption_is_set_named_and_follows_its_tissue() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Panel: Text");
    window.click("Add a label");
    let at = window.picture_center() + vec2(40.0, -30.0);
    window.click_at(at);
    window.settle();
    assert_eq!(window.captions().len(), 1);
    assert_eq!(
        window.captions()[0].text,
        "Middle",
        "as its tissue is called"
    );
    // Its field has the keyboard, and typed text replaces the text in it.
    window
        .harness
        .event(egui::Event::Text("Os parietale".to_owned()));
    window.steps(3);
    assert_eq!(window.captions()[0].text, "Os parietale");
    window.settle();
    window.look("caption");
    let in_picture = |window: &Window| {
        let texts = window
            .harness
            .query_all_by_role_and_label(Role::Label, "Os parietale");
        texts.count()
    };
    assert_eq!(in_picture(&window), 1, "it stands in the picture");
    // Its tissue is taken away, and with it the caption; and both come back.
    let cut = r#"[{"kind":"cut","size":[2,2,2]}]"#;
    let mut json: serde_json::Value =
        serde_json::from_str(&window.document().to_json()).expect("JSON");
    json["templates"] = serde_json::from_str(cut).expect("JSON");
    let mut without = Window::open(DESK, &json.to_string());
    without.settle();
    assert_eq!(in_picture(&without), 0, "nothing is left to name");
    // By keyboard: in the middle, dropped, undone.
    window.press(Key::Escape);
    window.press(Key::Escape);
    window.click("Panel: Templates");
    window.press(Key::A);
    window.press(Key::Escape);
    window.press(Key::Enter);
    window.settle();
    assert_eq!(window.captions().len(), 1, "it was dropped");
    window.press(Key::A);
    window.press(Key::Enter);
    window.settle();
    assert_eq!(window.captions().len(), 2, "Enter sets it in the middle");
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(window.captions().len(), 1);
    window.click("Panel: Text");
    window.click("Remove the label Os parietale");
    window.settle();
    assert!(window.captions().is_empty());
    assert_eq!(in_picture(&window), 0);
}
