//! Templates that carve: the object that they name, where they are, what is told, steps.

use crate::document::{Document, NotCarving, NoticeKind, ObjectPlacement};
use glam::Vec3;
use serde_json::{Value, json};

fn document(objects: Value, templates: Value) -> Document {
    let value = json!({ "fabrica": 1, "objects": objects, "templates": templates });
    Document::from_json(&value.to_string()).expect("a document")
}

fn carve(object: &str) -> Value {
    json!({ "kind": "carve", "at": [1, 2, 3], "params": { "object": object } })
}

/// Pointers of the notices, each with the reason.
fn told(document: &Document) -> Vec<(String, &'static str)> {
    let notices = document.notices().iter();
    let each = notices.map(|notice| match notice.kind {
        NoticeKind::NotCarving { why } => (notice.pointer.clone(), why),
        ref other => panic!("{other:?}"),
    });
    each.collect()
}

#[test]
fn a_carve_is_where_its_object_is() {
    let objects = json!([{ "builtin": "needle", "name": "pin" },
        { "builtin": "scalpel", "name": "knife", "at": [0.1, 0.2, 0.3], "size": 0.4 }]);
    let document = document(objects, json!([carve("knife")]));
    assert_eq!(document.notices(), []);
    let template = &document.illustration().templates[0];
    let found = template.carves_by().expect("the knife");
    assert_eq!(
        (found.index, template.placement.at),
        (1, Vec3::new(0.1, 0.2, 0.3))
    );
    assert_eq!(template.placement.size, Vec3::splat(0.4));
    let source = &document.illustration().objects[0].source;
    assert!(
        !document.illustration().carves_by(source),
        "the pin does nothing"
    );
    // Its own place is kept as it is written.
    assert!(document.to_json_compact().contains(r#""at":[1,2,3]"#));
    let again = Document::from_json(&document.to_json_compact()).expect("its own text");
    assert_eq!(again, document);
    // An object with a file and no place gives it one later.
    let by_file = self::document(
        json!([{ "src": "a.stl", "name": "a" }]),
        json!([carve("a")]),
    );
    let template = &by_file.illustration().templates[0];
    assert_eq!(
        template.carves_by().map(|found| found.placement),
        Some(None::<ObjectPlacement>)
    );
}

#[test]
fn what_does_not_carve_is_named() {
    let objects = json!([{ "builtin": "needle", "name": "a", "enabled": false },
        { "builtin": "needle", "name": "b" }]);
    let document = document(
        objects,
        json!([carve("a"), carve("c"), carve(""), carve("b")]),
    );
    let at = |index: usize| format!("/templates/{index}/params/object");
    let expected = [
        (at(0), NotCarving::Disabled.why()),
        (at(1), NotCarving::Unknown.why()),
        (at(2), NotCarving::Nameless.why()),
    ];
    assert_eq!(told(&document), expected);
    let carving = document.illustration().templates.iter();
    assert_eq!(carving.filter(|t| t.carves_by().is_some()).count(), 1);
    for notice in document.notices() {
        assert!(notice.to_string().ends_with("kept, not drawn"), "{notice}");
    }
}

#[test]
fn four_objects_carve_and_a_fifth_is_named() {
    let names = ["a", "b", "c", "d", "e"];
    let object = |name| json!({ "builtin": "needle", "name": name });
    let objects: Vec<Value> = names.into_iter().map(object).collect();
    // One that carves twice counts once, and one that is switched off does not.
    let mut templates: Vec<Value> = ["a", "a", "b", "c", "d", "e"].map(carve).to_vec();
    let all = document(json!(objects), json!(templates));
    let fifth = (
        "/templates/5/params/object".to_owned(),
        NotCarving::TooMany.why(),
    );
    assert_eq!(told(&all), [fifth]);
    templates[2]["enabled"] = json!(false);
    assert_eq!(told(&document(json!(objects), json!(templates))), []);
}

#[test]
fn values_are_clamped_and_wrong_types_are_errors() {
    let with = |params: Value| {
        let value = json!({ "fabrica": 1, "objects": [{ "builtin": "needle", "name": "a" }],
            "templates": [{ "kind": "carve", "params": params }] });
        Document::from_json(&value.to_string())
    };
    let far = with(json!({ "object": "a", "push": 7, "reach": 0 })).expect("clamped");
    assert_eq!(far.notices().len(), 2, "{:?}", far.notices());
    let template = &far.illustration().templates[0];
    assert_eq!(
        (template.number("push"), template.number("reach")),
        (0.5, 0.01)
    );
    let wrong = with(json!({ "object": 3 })).expect_err("a number");
    assert!(
        wrong.to_string().contains("/templates/0/params/object"),
        "{wrong}"
    );
}

#[test]
fn a_carve_follows_its_object_from_step_to_step() {
    let value = json!({ "fabrica": 1,
        "objects": [{ "builtin": "scalpel", "name": "knife", "at": [0, 0, 1] }],
        "templates": [{ "kind": "carve", "params": { "object": "knife" }, "amount": 0.5 }],
        "steps": [{ "title": "In", "set": { "/objects/0/at": [0, 0, 0] }, "seconds": 2 },
            { "title": "Off", "set": { "/objects/0/enabled": false } }] });
    let document = Document::from_json(&value.to_string()).expect("a document");
    let under_way = document.at_time(1, 1.0).expect("a passage");
    let template = &under_way.templates[0];
    assert_eq!(
        template.placement.at,
        under_way.objects[0].placement.expect("placed").at
    );
    assert!((template.placement.at.z - 0.5).abs() < 1e-6, "half way");
    let off = document.at_step(2).expect("a step");
    assert!(off.illustration().templates[0].carves_by().is_none());
    // Without any of it there is no gap either, though no push would leave one.
    let acting = |amount: f32| {
        let mut template = template.clone();
        template.amount = amount;
        template.acting().enabled
    };
    assert!(acting(0.01) && !acting(0.0));
}
