use super::{document, lesson};
use crate::document::blend::blend;
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
