//! What a step has to set so that one state becomes another.

use crate::document::Document;
use crate::document::difference::difference;
use serde_json::{Value, json};

fn differences(old: &str, new: &str) -> Value {
    let [old, new] = [old, new].map(|json| {
        let json = format!("{{ \"fabrica\": 1, {json} }}");
        Document::from_json(&json).expect("a document")
    });
    let changes = difference(old.value(), new.value());
    Value::Object(changes.into_iter().collect())
}

#[test]
fn only_what_differs_is_set() {
    let peel = r#""templates": [{ "kind": "hole" }, { "kind": "peel", "params": { "progress": 0.25 }, "amount": 0.5 }]"#;
    let turned = r#""templates": [{ "kind": "hole" }, { "kind": "peel", "at": [0, 0, 1], "enabled": false }],
        "camera": { "distance": 2 }, "look": { "background": "none" }"#;
    assert_eq!(
        differences(peel, turned),
        json!({ "/templates/1/at": [0, 0, 1], "/templates/1/enabled": false, "/templates/1/amount": 1,
            "/templates/1/params/progress": 0.5, "/camera/distance": 2, "/look/background": "none" })
    );
    assert_eq!(
        differences(turned, peel),
        json!({ "/templates/1/at": [0, 0, 0], "/templates/1/enabled": true, "/templates/1/amount": 0.5,
            "/templates/1/params/progress": 0.25, "/camera/distance": 2.5, "/look/background": "#ffffff" })
    );
    assert_eq!(differences(peel, peel), json!({}));
}

#[test]
fn what_has_no_default_is_set_with_what_holds_it() {
    assert_eq!(
        differences(r#""alt": "A skull.""#, r#""alt": """#),
        json!({ "/alt": "" }),
        "a text that is left out is empty"
    );
    let tinted = r#""look": { "transfer": "ct-bone", "tint": 0.3, "gradient": 0.5 }"#;
    let plain = r#""look": { "transfer": "ct-bone", "gradient": 0.5 }"#;
    assert_eq!(
        differences(tinted, plain),
        json!({ "/look": { "transfer": "ct-bone", "gradient": 0.5 } })
    );
    assert_eq!(differences(plain, tinted), json!({ "/look/tint": 0.3 }));
    let bodies = r#""look": { "segments": { "skull": 1, "brain": 0.5 } }"#;
    let fewer = r#""look": { "segments": { "brain": 0.25 } }"#;
    assert_eq!(
        differences(bodies, fewer),
        json!({ "/look/segments": { "brain": 0.25 } })
    );
    assert_eq!(
        differences(fewer, bodies),
        json!({ "/look/segments/brain": 0.5, "/look/segments/skull": 1 })
    );
    let kept =
        r#""templates": [{ "kind": "peel", "align": { "to": "segment", "keep": ["bone"] } }]"#;
    let moved = r#""templates": [{ "kind": "peel" }]"#;
    assert_eq!(
        differences(kept, moved),
        json!({ "/templates/0/align/to": "axis", "/templates/0/align/keep": [] })
    );
    let other = r#""templates": [{ "kind": "hole" }]"#;
    assert_eq!(
        differences(moved, other),
        json!({ "/templates/0": { "kind": "hole" } })
    );
    assert_eq!(
        differences(other, r#""title": "A""#),
        json!({ "/templates": [], "/title": "A" })
    );
}
