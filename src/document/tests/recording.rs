//! Steps as they are recorded: what is done while a step is shown, and what becomes of the others.

use super::document;
use crate::document::difference::difference;
use crate::document::{Caption, Document, Edit, ParamValue, TemplateKind};
use crate::math::Placement;
use glam::Vec3;
use serde_json::{Value, json};

fn three_steps() -> Document {
    document(json!({ "fabrica": 1, "subject": { "builtin": "cube" },
        "templates": [{ "kind": "peel", "params": { "progress": 0.25 } }, { "kind": "hole" }],
        "labels": [{ "text": "a" }],
        "steps": [{ "title": "one", "set": { "/templates/0/params/progress": 0.4 } },
            { "title": "two", "set": { "/camera/distance": 2, "/templates/9/at": [0, 0, 1] } },
            { "title": "three", "set": { "/templates/0/params/progress": 0.6, "/templates/1/enabled": false } }] }))
}

fn at(step: usize, edit: Edit) -> Edit {
    let edit = Box::new(edit);
    Edit::AtStep { step, edit }
}

fn done(document: &Document, edit: &Edit) -> Document {
    edit.apply(document).expect("an edit")
}

fn set_of(document: &Document, step: usize) -> Value {
    let set = document.get(&format!("/steps/{}/set", step - 1));
    set.cloned().unwrap_or_else(|| json!({}))
}

fn progress(value: f32) -> Edit {
    Edit::SetParam {
        template: 0,
        param: "progress",
        value: ParamValue::Number(value),
    }
}

fn add(index: usize) -> Edit {
    Edit::AddTemplate {
        index,
        kind: TemplateKind::Split,
        placement: Placement::DOCUMENT_DEFAULT,
    }
}

/// What a step shows: templates and captions that are switched on, and the rest.
fn shown(document: &Document, step: usize) -> crate::document::Illustration {
    let state = document.lesson().expect("a lesson").at_step(step);
    let mut shown = state.expect("a step").as_ref().clone();
    shown.templates.retain(|template| template.enabled);
    shown.templates.iter_mut().for_each(|t| t.index = 0);
    shown.captions.retain(|caption| caption.enabled);
    shown
}

#[test]
fn an_edit_at_a_step_is_what_the_step_sets() {
    let before = three_steps();
    let after = done(&before, &at(2, progress(0.5)));
    assert_eq!(
        set_of(&after, 2),
        json!({ "/camera/distance": 2, "/templates/0/params/progress": 0.5, "/templates/9/at": [0, 0, 1] }),
        "with what is of another document"
    );
    for step in [0, 1, 3] {
        assert_eq!(shown(&before, step), shown(&after, step), "step {step}");
    }
    // Back to what the step before has: nothing to set.
    let back = done(&after, &at(2, progress(0.4)));
    assert_eq!(back, before);
    // To a default, which no step can leave out.
    let default = done(&before, &at(1, progress(0.5)));
    assert_eq!(
        set_of(&default, 1),
        json!({ "/templates/0/params/progress": 0.5 })
    );
    // It holds until another step sets it.
    let far = Edit::SetPlacement {
        template: 1,
        placement: Placement {
            at: Vec3::X,
            ..Placement::DOCUMENT_DEFAULT
        },
    };
    let moved = done(&before, &at(1, far));
    assert_eq!(moved.get("/templates/1"), before.get("/templates/1"));
    for step in [1, 2] {
        assert_eq!(shown(&moved, step).templates[1].placement.at, Vec3::X);
    }
}

#[test]
fn what_belongs_to_all_steps_stays_with_the_document() {
    let before = three_steps();
    let name = "lid".to_owned();
    for edit in [
        Edit::SetTitle("T".to_owned()),
        Edit::SetLegend("L".to_owned()),
        Edit::RenameTemplate { template: 0, name },
        Edit::SetGroup {
            template: 0,
            group: "g".to_owned(),
        },
    ] {
        assert_eq!(done(&before, &at(2, edit.clone())), done(&before, &edit));
    }
    let turned = done(&before, &at(2, Edit::MoveTemplate { from: 1, to: 0 }));
    assert_eq!(
        turned.get("/templates/1/kind"),
        before.get("/templates/0/kind")
    );
    assert_eq!(
        set_of(&turned, 3),
        json!({ "/templates/1/params/progress": 0.6, "/templates/0/enabled": false })
    );
    assert_eq!(
        set_of(&turned, 1),
        json!({ "/templates/1/params/progress": 0.4 })
    );
}

#[test]
fn what_is_added_at_a_step_is_switched_off_before_it() {
    let before = three_steps();
    let added = done(&before, &at(2, add(1)));
    assert_eq!(added.get("/templates/1/enabled"), Some(&json!(false)));
    assert_eq!(set_of(&added, 2)["/templates/1/enabled"], json!(true));
    assert_eq!(
        set_of(&added, 3)["/templates/2/enabled"],
        json!(false),
        "the hole has moved up"
    );
    for step in [0, 1] {
        assert_eq!(shown(&before, step), shown(&added, step), "step {step}");
    }
    for step in [2, 3] {
        let [more, fewer] = [&added, &before].map(|d| shown(d, step).templates.len());
        assert_eq!(more, fewer + 1, "step {step}");
        let new = &shown(&added, step).templates[1];
        assert_eq!((new.kind, new.amount), (TemplateKind::Split, 1.0));
    }
    // In the passage to its step it grows out of nothing.
    let first = added.at_time(2, 0.0).expect("a moment");
    assert!(first.templates[1].enabled && first.templates[1].amount == 0.0);
    // What is done to it before anybody has seen it lies ready.
    let side = Edit::SetParam {
        template: 1,
        param: TemplateKind::Split.spec().params[0].name,
        value: ParamValue::Number(0.125),
    };
    let ready = done(&added, &at(2, side));
    assert_eq!(set_of(&ready, 2), set_of(&added, 2));
    assert_ne!(ready.get("/templates/1"), added.get("/templates/1"));
    // Who switches it on earlier sees it.
    let enabled = true;
    let earlier = done(
        &added,
        &at(
            1,
            Edit::SetEnabled {
                template: 1,
                enabled,
            },
        ),
    );
    let new = &shown(&earlier, 1).templates[1];
    assert_eq!((new.kind, new.amount), (TemplateKind::Split, 1.0));

    let caption = Caption {
        at: Vec3::ZERO,
        text: "new".to_owned(),
        enabled: true,
    };
    let labelled = done(&before, &at(3, Edit::AddCaption(caption)));
    let counts: Vec<usize> = (0..=3)
        .map(|step| shown(&labelled, step).captions.len())
        .collect();
    assert_eq!(counts, [1, 1, 1, 2]);
    assert_eq!(labelled.get("/labels/1/enabled"), Some(&json!(false)));
}

#[test]
fn what_is_removed_at_a_step_is_switched_off_from_there_on() {
    let before = three_steps();
    let removed = done(&before, &at(2, Edit::RemoveTemplate { template: 0 }));
    assert_eq!(removed.get("/templates"), before.get("/templates"));
    assert_eq!(
        set_of(&removed, 2),
        json!({ "/camera/distance": 2, "/templates/0/enabled": false, "/templates/9/at": [0, 0, 1] })
    );
    assert_eq!(
        set_of(&removed, 3),
        json!({ "/templates/1/enabled": false })
    );
    let counts: Vec<usize> = (0..=3)
        .map(|step| shown(&removed, step).templates.len())
        .collect();
    assert_eq!(counts, [2, 2, 1, 0]);
    let unlabelled = done(&before, &at(1, Edit::RemoveCaption { caption: 0 }));
    assert_eq!(set_of(&unlabelled, 1)["/labels/0/enabled"], json!(false));
    // What no step before has shown goes for good.
    let added = done(&before, &at(2, add(0)));
    let gone = done(&added, &at(2, Edit::RemoveTemplate { template: 0 }));
    assert_eq!(gone, before);
    // In the document itself it goes, and its pointers in all steps with it.
    let gone = done(&before, &at(0, Edit::RemoveTemplate { template: 0 }));
    assert_eq!(set_of(&gone, 1), json!({}));
    assert_eq!(
        set_of(&gone, 3),
        json!({ "/templates/0/enabled": false }),
        "renumbered"
    );
    let nowhere = at(2, Edit::RemoveTemplate { template: 7 });
    assert!(nowhere.apply(&before).is_err());
    assert!(at(4, progress(0.5)).apply(&before).is_err(), "no such step");
}

#[test]
fn a_step_keeps_what_differs_from_the_one_before() {
    let before = three_steps();
    let mut camera = before.illustration().camera;
    let same = Edit::SetCamera(crate::document::Camera {
        distance: 2.0,
        ..camera
    });
    let nothing = before.step_after(3, &same).expect("a step");
    assert_eq!(nothing, json!({ "set": {} }));
    camera.distance = 3.0;
    let step = before.step_after(1, &Edit::SetCamera(camera));
    let step = step.expect("a step");
    assert_eq!(step, json!({ "set": { "/camera/distance": 3 } }));
    // The steps behind a new one look as they did.
    let index = 1;
    let more = done(&before, &Edit::AddStep { index, step });
    assert_eq!(more.step_count(), 4);
    assert_eq!(shown(&more, 2).camera.distance, 3.0);
    for (old, new) in [(0, 0), (1, 1), (2, 3), (3, 4)] {
        assert_eq!(shown(&before, old), shown(&more, new));
    }
}

#[test]
fn steps_that_move_look_as_they_did() {
    let before = three_steps();
    let titles = |document: &Document| -> Vec<String> {
        let steps = &document.illustration().steps;
        steps.iter().map(|step| step.title.clone()).collect()
    };
    for (edit, order) in [
        (Edit::MoveStep { from: 2, to: 0 }, vec![3, 1, 2]),
        (Edit::MoveStep { from: 0, to: 1 }, vec![2, 1, 3]),
        (Edit::RemoveStep { step: 0 }, vec![2, 3]),
        (Edit::RemoveStep { step: 2 }, vec![1, 2]),
        (Edit::DuplicateStep { step: 0 }, vec![1, 1, 2, 3]),
        (Edit::DuplicateStep { step: 2 }, vec![1, 2, 3, 3]),
    ] {
        let after = done(&before, &edit);
        assert_eq!(shown(&before, 0), shown(&after, 0));
        let names = order.iter().map(|&old| titles(&before)[old - 1].clone());
        assert_eq!(titles(&after), names.collect::<Vec<_>>(), "{edit:?}");
        for (new, old) in (1..).zip(order) {
            assert_eq!(shown(&before, old), shown(&after, new), "{edit:?}: {new}");
        }
    }
    for nowhere in [
        Edit::MoveStep { from: 0, to: 3 },
        Edit::RemoveStep { step: 3 },
        Edit::DuplicateStep { step: 3 },
    ] {
        assert!(nowhere.apply(&before).is_err(), "{nowhere:?}");
    }
    let mut full = before;
    for _ in 3..crate::document::MAX_STEPS {
        full = done(&full, &Edit::DuplicateStep { step: 0 });
    }
    assert!(Edit::DuplicateStep { step: 0 }.apply(&full).is_err());
}

#[test]
fn strange_steps_stay_as_they_are() {
    // A step that adds to lists, sets whole entries, and points at what is not there.
    let strange = document(json!({ "fabrica": 1,
        "templates": [{ "kind": "peel" }, { "kind": "of tomorrow", "x": 1 }],
        "steps": [{ "x-mine": [1], "set": { "/templates/2": { "kind": "hole" }, "/templates/7": 1, "/labels/-": { "text": "b" }, "/x/y": 2 } },
            { "set": { "/templates/0": { "kind": "peel", "amount": 0.5 }, "/look": { "gradient": 0.5 } } }] }));
    let unchanged = |after: &Document, step: usize, targets: &[&str]| {
        for target in targets {
            let set = set_of(&strange, step);
            assert_eq!(set_of(after, step)[*target], set[*target], "{target}");
        }
    };
    let grown = Edit::SetAmount {
        template: 2,
        amount: 0.25,
    };
    let after = done(&strange, &at(1, grown));
    assert_eq!(shown(&after, 1).templates[1].amount, 0.25);
    unchanged(&after, 1, &["/templates/7", "/labels/-", "/x/y"]);
    let half = Edit::SetAmount {
        template: 0,
        amount: 0.75,
    };
    let after = done(&strange, &at(2, half));
    assert_eq!(shown(&after, 2).templates[0].amount, 0.75);
    unchanged(
        &after,
        1,
        &["/templates/2", "/templates/7", "/labels/-", "/x/y"],
    );
    let white = Edit::Reset {
        pointer: "/look/gradient".to_owned(),
        name: String::new(),
    };
    let after = done(&strange, &at(2, white));
    assert_eq!(shown(&after, 2).look.gradient, 0.0);
    let gone = done(&strange, &at(2, Edit::RemoveTemplate { template: 2 }));
    assert_eq!(shown(&gone, 1).templates.len(), 2);
    assert_eq!(shown(&gone, 2).templates.len(), 1);
    let moved = done(&strange, &Edit::MoveStep { from: 1, to: 0 });
    assert_eq!(shown(&moved, 1), shown(&strange, 2));
    assert_eq!(shown(&moved, 2), shown(&strange, 1));
    assert_eq!(moved.get("/steps/1/x-mine"), Some(&json!([1])));
    unchanged(&moved, 1, &[]);
    assert_eq!(set_of(&moved, 2)["/x/y"], json!(2));
}

#[test]
fn the_new_keys_are_checked_and_kept() {
    let all = document(
        json!({ "fabrica": 1, "labels": [{ "text": "a", "enabled": false }],
        "steps": [{ "notes": "Ask for the name.", "hold": 7.5, "set": { "/labels/0/enabled": true } }, {}] }),
    );
    assert!(all.notices().is_empty(), "{:?}", all.notices());
    let steps = &all.illustration().steps;
    assert_eq!(
        (steps[0].notes.as_str(), steps[0].hold_seconds),
        ("Ask for the name.", 7.5)
    );
    assert_eq!((steps[1].notes.as_str(), steps[1].hold_seconds), ("", 4.0));
    assert!(!all.illustration().captions[0].enabled);
    assert!(shown(&all, 1).captions[0].enabled);
    let plain = document(
        json!({ "fabrica": 1, "labels": [{ "text": "a", "enabled": true }],
        "steps": [{ "notes": "", "hold": 4, "set": {} }] }),
    );
    let text = r#"{"fabrica":1,"labels":[{"text":"a"}],"steps":[{}]}"#;
    assert_eq!(plain.to_json_compact(), text, "defaults are left out");
    for (long, kept) in [(1e9, 3600.0), (-1.0, 0.0)] {
        let clamped = document(json!({ "fabrica": 1, "steps": [{ "hold": long }] }));
        assert_eq!(clamped.notices().len(), 1);
        assert_eq!(clamped.illustration().steps[0].hold_seconds, kept);
    }
    for wrong in [
        json!({ "steps": [{ "notes": 1 }] }),
        json!({ "steps": [{ "notes": ["a"] }] }),
        json!({ "steps": [{ "hold": "4" }] }),
        json!({ "steps": [{ "hold": null }] }),
        json!({ "labels": [{ "enabled": 1 }] }),
        json!({ "labels": [{ "enabled": "no" }] }),
        json!({ "labels": [{}], "steps": [{ "set": { "/labels/0/enabled": 0 } }] }),
        json!({ "steps": [{ "set": { "/steps/0/notes": "a" } }] }),
    ] {
        let mut wrong = wrong;
        wrong["fabrica"] = json!(1);
        assert!(Document::from_value(wrong.clone()).is_err(), "{wrong}");
    }
}

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
