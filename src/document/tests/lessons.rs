use super::{document, lesson};
use crate::document::blend::blend;
use crate::document::{Document, MAX_ALT};
use serde_json::json;
use std::sync::Arc;

#[test]
fn a_moment_is_the_blend_of_two_documents() {
    let others = [
        lesson(),
        document(json!({ "fabrica": 1 })),
        document(
            json!({ "fabrica": 1, "look": { "background": "#102030", "transfer": [{ "value": 1, "color": "#c88a6a" }, { "value": 2 }] },
            "templates": [{ "kind": "slices", "align": { "to": "surface" } }, { "kind": "rbf", "params": { "points": [{}, { "at": [0.1, 0.2, 0.3] }] } }],
            "labels": [{ "text": "a" }],
            "steps": [{ "set": { "/look/background": "#c0ffee", "/look/transfer/0/value": 0.25, "/labels/0/at/0": 0.3 }, "seconds": 0 },
                { "set": { "/templates/0/params/count": 9, "/templates/0/align/depth": 0.3, "/templates/1/params/points/1/at": [0.9, 0.8, 0.7], "/camera/rotate": [0, 0, 0.6, 0.8] }, "seconds": 0.7 },
                { "set": { "/templates/0/curve": { "points": [[0, 0.6], [1, 1]] }, "/camera/fov": 50 } }] }),
        ),
    ];
    for document in others {
        let lesson = document.lesson().expect("a lesson");
        let steps = &document.illustration().steps;
        for step in 0..=document.step_count() {
            let end = document.at_step(step).expect("a step");
            assert_eq!(
                lesson.at_step(step).expect("a step").as_ref(),
                end.illustration()
            );
            for seconds in [
                0.0,
                0.1,
                0.35,
                0.5,
                0.69,
                1.0,
                2.0,
                -1.0,
                f32::NAN,
                f32::INFINITY,
            ] {
                let expected = match step.checked_sub(1) {
                    None => end.illustration().clone(),
                    Some(before) => {
                        let start = document.at_step(before).expect("the step before");
                        let total = steps[before].seconds;
                        let part = match total > 0.0 && seconds.is_finite() {
                            true => (seconds / total).clamp(0.0, 1.0),
                            false => 1.0,
                        };
                        let eased = part * part * (3.0 - 2.0 * part);
                        blend(start.illustration(), end.illustration(), eased)
                    }
                };
                let shown = lesson.at(step, seconds).expect("a moment");
                // Printed floats differ where their bits do.
                assert_eq!(
                    format!("{shown:?}"),
                    format!("{expected:?}"),
                    "{step} at {seconds}"
                );
            }
        }
        let beyond = document.step_count() + 1;
        assert_eq!(
            lesson.at(beyond, 0.0).expect_err("no step"),
            document.at_step(beyond).expect_err("no step")
        );
    }
}

#[test]
fn the_states_of_a_document_are_resolved_once() {
    let document = lesson();
    let again = document.clone();
    let state = |document: &super::Document| {
        let lesson = document.lesson().expect("a lesson");
        Arc::clone(lesson.at_step(1).expect("a step"))
    };
    assert!(
        Arc::ptr_eq(&state(&document), &state(&again)),
        "a copy shares them"
    );
    let edited = document.with("/title", json!("another")).expect("an edit");
    assert!(
        !Arc::ptr_eq(&state(&document), &state(&edited)),
        "another revision does not"
    );
    assert_eq!(state(&edited).title, "one", "as the step sets it");
}

#[test]
fn texts_in_place_of_pictures_are_kept_and_bounded() {
    let text = r#"{"fabrica":1,"title":"T","caption":"C","alt":"A skull.","credit":"D","steps":[{"title":"S","alt":"Open.","set":{"/alt":"B"}}]}"#;
    let read = Document::from_json(text).expect("a document");
    assert_eq!(read.to_json_compact(), text, "in its place");
    assert!(read.notices().is_empty(), "{:?}", read.notices());
    let shown = read.illustration();
    assert_eq!(
        (shown.alt.as_str(), shown.steps[0].alt.as_str()),
        ("A skull.", "Open.")
    );
    let step = read.at_step(1).expect("a step");
    assert_eq!(step.illustration().alt, "B", "a step may set it");
    let empty = document(json!({ "fabrica": 1, "alt": "", "steps": [{ "alt": "" }] }));
    assert_eq!(empty.to_json_compact(), r#"{"fabrica":1,"steps":[{}]}"#);
    // Of a text without an end the first characters count; it is kept.
    let long = "ß".repeat(MAX_ALT + 1);
    let kept = document(json!({ "fabrica": 1, "alt": long, "steps": [{ "alt": long }] }));
    assert_eq!(kept.illustration().alt, long[..2 * MAX_ALT]);
    assert_eq!(kept.get("/alt"), Some(&json!(long)));
    assert_eq!(
        super::notices(&kept),
        [
            "/steps/0/alt: 2001 characters; it is kept, and the first 2000 count",
            "/alt: 2001 characters; it is kept, and the first 2000 count"
        ]
    );
    let whole = document(json!({ "fabrica": 1, "alt": "ß".repeat(MAX_ALT) }));
    assert!(whole.notices().is_empty(), "{:?}", whole.notices());
    for wrong in [json!(1), json!(null), json!(["a"]), json!({ "en": "a" })] {
        let at = super::error(json!({ "fabrica": 1, "alt": wrong }));
        assert!(at.contains("/alt") && at.contains("a text"), "{at}");
        let at = super::error(json!({ "fabrica": 1, "steps": [{ "alt": wrong }] }));
        assert!(at.contains("/steps/0/alt"), "{at}");
        let at = super::error(json!({ "fabrica": 1, "steps": [{ "set": { "/alt": wrong } }] }));
        assert!(at.contains("/alt") && at.contains("step 1"), "{at}");
    }
}

#[test]
fn scale_bar_and_letters_of_sides_are_switched_on_by_documents_and_steps() {
    let text = r##"{"fabrica":1,"look":{"background":"#102030","scale":true,"sides":true},"steps":[{"set":{"/look/scale":false}}]}"##;
    let read = Document::from_json(text).expect("a document");
    assert_eq!(read.to_json_compact(), text, "in their places");
    assert!(read.notices().is_empty(), "{:?}", read.notices());
    let marks = |document: &Document| {
        let look = &document.illustration().look;
        (look.scale_bar, look.sides)
    };
    assert_eq!(marks(&read), (true, true));
    let step = read.at_step(1).expect("a step");
    assert_eq!(marks(&step), (false, true), "a step may set them");
    let bare = document(json!({ "fabrica": 1, "look": { "scale": false, "sides": false } }));
    assert_eq!(bare.to_json_compact(), r#"{"fabrica":1}"#);
    assert_eq!(marks(&bare), (false, false));
    for wrong in [json!(1), json!(null), json!("yes"), json!([true])] {
        for key in ["scale", "sides"] {
            let at = super::error(json!({ "fabrica": 1, "look": { key: wrong } }));
            assert!(
                at.contains(&format!("/look/{key}")) && at.contains("true or false"),
                "{at}"
            );
        }
        let at =
            super::error(json!({ "fabrica": 1, "steps": [{ "set": { "/look/sides": wrong } }] }));
        assert!(at.contains("/look/sides") && at.contains("step 1"), "{at}");
    }
}
