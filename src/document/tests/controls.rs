//! Values that readers may move.

use crate::document::{ControlRange, Document, Edit, History};
use serde_json::json;

fn document(controls: serde_json::Value) -> Result<Document, String> {
    let value = json!({ "fabrica": 1, "subject": { "builtin": "cube" },
        "templates": [{ "kind": "peel" }, { "kind": "move" }], "controls": controls });
    Document::from_value(value).map_err(|error| error.to_string())
}

#[test]
fn values_that_a_step_may_set_are_controls() {
    let document = document(json!([
        { "pointer": "/templates/0/params/progress", "name": "Peel" },
        { "pointer": "/templates/0/params/progress", "min": 0.2, "max": 7 },
        { "pointer": "/templates/1/enabled" },
        { "pointer": "/templates/1/params/offset/2", "min": -1, "max": 0.5 },
        { "pointer": "/templates/0/at/0", "name": "Where", "min": -0.5, "max": 0.5 },
    ]))
    .expect("a document");
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    let controls = &document.illustration().controls;
    let names: Vec<&str> = controls.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["Peel", "progress", "enabled", "2", "Where"]);
    let range = |index: usize| match controls[index].range {
        ControlRange::Number { min, max, .. } => [min, max],
        ControlRange::Flag(_) => panic!("a number"),
    };
    assert_eq!(range(0), [0.0, 1.0]);
    assert_eq!(range(1), [0.2, 1.0], "within the range of the value");
    assert_eq!(controls[2].range, ControlRange::Flag(true));
    assert_eq!(range(4), [-0.5, 0.5]);
    let text = document.to_json_compact();
    let again = Document::from_json(&text).expect("a document");
    assert_eq!(again.illustration().controls, *controls);
}

#[test]
fn controls_follow_their_templates() {
    let document = document(json!([
        { "pointer": "/templates/0/params/progress" },
        { "pointer": "/templates/1/enabled" },
        { "pointer": "/camera/fov" },
    ]))
    .expect("a document");
    let mut history = History::new(document.clone());
    let pointers = |history: &History| -> Vec<String> {
        let controls = history.document().illustration().controls.iter();
        controls.map(|control| control.pointer.clone()).collect()
    };
    history
        .apply(&Edit::MoveTemplate { from: 0, to: 1 })
        .expect("two templates");
    let moved = [
        "/templates/1/params/progress",
        "/templates/0/enabled",
        "/camera/fov",
    ];
    assert_eq!(pointers(&history), moved);
    history
        .apply(&Edit::RemoveTemplate { template: 1 })
        .expect("a template");
    assert_eq!(pointers(&history), moved[1..]);
    history.undo();
    history.undo();
    assert_eq!(*history.document(), document);
}

#[test]
fn other_controls_are_kept_and_named() {
    for (control, why) in [
        (
            json!({ "pointer": "/templates/0/at/0" }),
            "needs `min` and `max`",
        ),
        (
            json!({ "pointer": "/templates/9/params/progress" }),
            "no number",
        ),
        (
            json!({ "pointer": "/templates/0/params/nothing" }),
            "no number",
        ),
        (json!({ "pointer": "/templates/0/kind" }), "no number"),
        (json!({ "pointer": "/steps/0/seconds" }), "no number"),
        (json!({ "pointer": "/controls/0/min" }), "no number"),
        (json!({ "pointer": "nowhere" }), "no number"),
        (json!({ "pointer": "" }), "no number"),
        (
            json!({ "pointer": "/camera/fov", "min": 60, "max": 20 }),
            "not below",
        ),
    ] {
        let document = document(json!([control])).expect("a document");
        assert!(document.illustration().controls.is_empty(), "{control}");
        let notice = document.notices().first().map(ToString::to_string);
        let notice = notice.unwrap_or_default();
        assert!(
            notice.starts_with("/controls/0") && notice.contains(why),
            "{control}: {notice}"
        );
        assert!(
            document.to_json_compact().contains("controls"),
            "it is kept"
        );
    }
    let many = vec![json!({ "pointer": "/camera/fov" }); 17];
    assert!(document(json!(many)).is_err_and(|why| why.contains("/controls")));
    for wrong in [
        json!(7),
        json!([7]),
        json!([{ "pointer": 7 }]),
        json!([{ "min": "a" }]),
    ] {
        assert!(document(wrong.clone()).is_err(), "{wrong}");
    }
}
