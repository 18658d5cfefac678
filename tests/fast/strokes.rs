//! Strokes at their limits, and what this version does not know of them.

use std::sync::Arc;

use fabrica::document::{Clay, Document, SubjectRef};
use fabrica::shell::clays::ClayDesk;
use serde_json::{Value, json};

/// The clay of this recipe, which nothing is said of.
fn clay(recipe: Value) -> Arc<Clay> {
    let document = json!({ "fabrica": 1, "subject": { "clay": recipe } });
    let document = Document::from_value(document).expect("a document");
    assert_eq!(document.notices(), []);
    match &document.illustration().subject {
        SubjectRef::Clay(clay) => Arc::clone(clay),
        other => panic!("{other:?}"),
    }
}

/// A tool of a shape that this version does not have is kept in texts and links and named; its strokes do nothing.
#[test]
fn unknown_shapes_are_kept_and_named() {
    let cloud = json!({ "shape": "cloud", "density": [3] });
    let recipe = |first: Value| {
        json!({ "detail": 0.05, "tools": [first, { "radius": 0.1 }], "strokes": [
            { "path": [0, 0, 440, 0, 0, 300] }, { "tool": 1, "path": [440, 0, 0, 200, 0, 0] },
            { "tool": 1, "path": [0, 600, 0, 0, -300, 0], "with": [{ "path": [0, -600, 0, 0, 200, 0] }] }] })
    };
    let document = json!({ "fabrica": 1, "subject": { "clay": recipe(cloud.clone()) } });
    let document = Document::from_value(document).expect("a document");
    let said: Vec<String> = document.notices().iter().map(ToString::to_string).collect();
    let named = "/subject/clay/tools/0/shape: this version does not know “cloud”";
    assert!(said.len() == 1 && said[0].starts_with(named), "{said:?}");
    let link = fabrica::link::encode(&document);
    let opened = fabrica::link::decode(&link).expect("a document").document;
    let text: Value = serde_json::from_str(&opened.to_json()).expect("its own text");
    assert_eq!(text["subject"]["clay"]["tools"][0], cloud);
    let SubjectRef::Clay(of_cloud) = &opened.illustration().subject else {
        panic!("a clay")
    };
    let mut desk = ClayDesk::default();
    let shaping = desk.shape(of_cloud, &mut |_| true).expect("a clay");
    let why = "is left out: tool 0 is not there or of a shape that is not known";
    assert_eq!(
        shaping.notices(),
        [1, 3].map(|stroke| format!("stroke {stroke} {why}"))
    );
    let shaped = shaping.shaped();
    let mut known = recipe(json!({}));
    for stroke in [0, 2] {
        known["strokes"][stroke]["off"] = json!(true);
    }
    let known = desk.shape(&clay(known), &mut |_| true).expect("a clay");
    assert_eq!(known.shaped().positions, shaped.positions);
}
