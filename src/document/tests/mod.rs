mod carving;
mod clay;
mod controls;
mod curves;
mod figures;
mod lessons;
mod lights;
mod poses;
mod recipes;
mod recording;
mod revisions;
mod styles;
mod surfaces;
mod sweeps;

use super::*;
use crate::math::Placement;
use glam::{Quat, Vec3};
use serde_json::{Value, json};

fn document(value: Value) -> Document {
    Document::from_value(value).expect("a document")
}

fn error(value: Value) -> String {
    Document::from_value(value)
        .expect_err("no document")
        .to_string()
}

fn notices(document: &Document) -> Vec<String> {
    document.notices().iter().map(Notice::to_string).collect()
}

#[test]
fn the_empty_document_is_one() {
    let read = Document::from_json(r#"{"fabrica":1}"#).expect("a document");
    assert_eq!(read, Document::new());
    assert_eq!(read.illustration(), Document::new().illustration());
    assert_eq!(read.byte_count(), Document::new().byte_count());
    assert_eq!(read.to_json_compact(), r#"{"fabrica":1}"#);
    let camera = &read.illustration().camera;
    assert_eq!((camera.distance, camera.fov_deg), (2.5, 30.0));
}

#[test]
fn every_default_is_left_out_and_filled_in() {
    // A field's place is no default: without one its file says where it lies. A carve without an object is told of.
    let has_defaults =
        |kind: &TemplateKind| *kind != TemplateKind::Field && *kind != TemplateKind::Carve;
    for kind in TemplateKind::ALL.into_iter().filter(has_defaults) {
        let spec = kind.spec();
        let params: serde_json::Map<String, Value> = spec
            .params
            .iter()
            .map(|param| {
                let value = match param.kind {
                    ParamKind::Number { default, .. } | ParamKind::Count { default, .. } => {
                        json!(plain_f64(default))
                    }
                    ParamKind::Flag { default } => json!(default),
                    ParamKind::Choice { names } => json!(names[0]),
                    ParamKind::Vector { default, .. } => json!(default.map(plain_f64)),
                    ParamKind::Rotation => json!([0.0, 0.0, 0.0, 1.0]),
                };
                (param.name.to_owned(), value)
            })
            .collect();
        let written = document(json!({ "fabrica": 1, "title": "", "templates": [{
            "kind": spec.name, "name": "", "at": [0, 0, 0], "rotate": [0, 0, 0, 1], "size": [0.5, 0.5, 0.5], "enabled": true,
            "mode": "compose", "align": { "to": "axis", "depth": 0.02, "thickness": 0.01 }, "params": params }],
            "subject": { "builtin": "head" }, "labels": [], "steps": [], "camera": { "target": [0, 0, 0], "rotate": [0, 0, 0, 1], "distance": 2.5, "fov": 30 },
            "look": { "transfer": "auto", "window": "auto", "opacity": "constancy", "gradient": 0, "segments": {}, "background": "#ffffff", "scale": false, "sides": false, "style": "none" } }));
        let bare = document(json!({ "fabrica": 1, "templates": [{ "kind": spec.name }] }));
        assert_eq!(written, bare, "of {}", spec.name);
        assert_eq!(
            written.illustration(),
            bare.illustration(),
            "of {}",
            spec.name
        );
        assert!(written.notices().is_empty(), "{:?}", written.notices());
        assert_eq!(
            bare.illustration().templates[0].params.len(),
            spec.params.len()
        );
    }
}

#[test]
fn values_are_clamped_in_what_is_drawn_only() {
    let document = document(
        json!({ "fabrica": 1, "camera": { "fov": 500 }, "look": { "window": [600, -200] }, "templates": [
        { "kind": "peel", "params": { "progress": 1.5, "angle": std::f64::consts::TAU }, "size": [0, 1e30, -1] },
        { "kind": "slices", "params": { "count": 2.5 } },
        { "kind": "pull", "params": { "offset": [0, 3, 4] } },
        { "kind": "move", "params": { "offset": [0, 0, 99] }, "rotate": [0, 0, 3, 4] }] }),
    );
    let drawn = document.illustration();
    assert_eq!(drawn.templates[0].number("progress"), 1.0);
    assert_eq!(
        drawn.templates[0].placement.size,
        Vec3::new(1e-4, 1e4, 1e-4)
    );
    assert_eq!(drawn.templates[1].number("count"), 3.0, "halves go up");
    let ParamValue::Vector(offset) = drawn.templates[2].params[0] else {
        panic!("a vector")
    };
    assert!(
        (offset - Vec3::new(0.0, 0.18, 0.24)).length() < 1e-6,
        "scaled to 0.3: {offset}"
    );
    assert_eq!(
        drawn.templates[3].params[0],
        ParamValue::Vector(Vec3::new(0.0, 0.0, 10.0))
    );
    assert!(
        (drawn.templates[3].placement.rotate - Quat::from_xyzw(0.0, 0.0, 0.6, 0.8)).length() < 1e-6
    );
    assert_eq!(drawn.look.window, Window::Range([-200.0, 600.0]));
    let lines = notices(&document);
    for at in [
        "/camera/fov",
        "/look/window",
        "/templates/0/params/progress",
        "/templates/0/size",
        "/templates/1/params/count",
        "/templates/2/params/offset",
        "/templates/3/params/offset",
        "/templates/3/rotate",
    ] {
        assert!(
            lines.iter().any(|line| line.starts_with(at)),
            "{at} in {lines:?}"
        );
    }
    assert_eq!(
        lines.len(),
        8,
        "and nothing else (2π is in range): {lines:?}"
    );
    assert_eq!(
        document.get("/templates/0/params/progress"),
        Some(&json!(1.5))
    );
}

#[test]
fn what_is_unknown_is_kept_and_named() {
    let value = json!({ "fabrica": 1, "x": { "deep": [1, { "y": null }] }, "subject": { "builtin": "dragon" },
        "look": { "opacity": "later", "background": "teal", "transfer": "ct-glass" },
        "templates": [{ "kind": "later", "params": { "a": 1 } }, { "kind": "cut", "mode": "blend", "params": { "shape": "torus" } }, { "at": [1, 2, 3] },
            { "kind": "peel", "align": { "to": "segment", "keep": ["bone", 3] }, "constrain": { "by": "displacement", "keep": ["bone"] } }] });
    let document = document(value.clone());
    assert_eq!(document.value(), &value, "nothing is lost");
    assert_eq!(
        document.illustration().templates.len(),
        2,
        "the unknown ones are not drawn"
    );
    assert_eq!(document.illustration().templates[0].index, 1);
    assert_eq!(notices(&document).len(), 9, "{:#?}", notices(&document));
}

#[test]
fn limits_and_wrong_types_are_errors() {
    let label = json!({ "text": "a" });
    for (value, part) in [
        (
            json!({ "fabrica": 1, "labels": vec![label; 257] }),
            "/labels: 257 labels",
        ),
        (
            json!({ "fabrica": 1, "steps": vec![json!({}); 101] }),
            "/steps: 101 steps",
        ),
        (
            json!({ "fabrica": 1, "templates": { "0": 1 } }),
            "/templates: expected a list",
        ),
        (
            json!({ "fabrica": "1" }),
            "/fabrica: expected the format's number",
        ),
        (json!({ "fabrica": 1.5 }), "has format 1.5"),
        (json!({ "fabrica": 0 }), "/fabrica"),
        (
            json!({ "fabrica": 1, "look": { "transfer": [{ "opacity": "a lot" }] } }),
            "/look/transfer/0/opacity: expected a number",
        ),
        (
            json!({ "fabrica": 1, "subject": { "sha256": "abc" } }),
            "/subject/sha256",
        ),
        (
            json!({ "fabrica": 1, "templates": [{ "align": { "keep": [true] } }] }),
            "/templates/0/align/keep/0",
        ),
        (
            json!({ "fabrica": 1, "title": null }),
            "/title: expected a text, found null",
        ),
        (
            json!({ "fabrica": 1, "steps": [{ "set": { "/camera/fov": "wide" } }] }),
            "step 1",
        ),
        (
            json!({ "fabrica": 1, "steps": [{ "set": { "/fabrica": 1 } }] }),
            "may not be set",
        ),
        (
            json!({ "fabrica": 1, "steps": [{ "set": { "": {} } }] }),
            "may not be set",
        ),
        (
            json!({ "fabrica": 1, "steps": [{ "set": { "title": "x" } }] }),
            "not a JSON pointer",
        ),
    ] {
        let message = error(value);
        assert!(message.contains(part), "“{part}” is not in: {message}");
    }
}

fn lesson() -> Document {
    document(
        json!({ "fabrica": 1, "templates": [{ "kind": "peel" }, { "kind": "move" }], "steps": [
        { "set": { "/templates/0/params/progress": 1.0, "/camera/target/0": 1, "/look/background": "#000000", "/title": "one" }, "seconds": 2 },
        { "set": { "/templates/1/params/turn": [0, 0, 1, 0], "/templates/1/enabled": false, "/labels/-": { "text": "new" }, "/templates/7/at": [0, 0, 0] } }] }),
    )
}

#[test]
fn steps_build_on_each_other() {
    let lesson = lesson();
    assert_eq!(
        notices(&lesson),
        ["/steps/1/set/~1templates~17~1at: /templates/7/at is not there; left out"]
    );
    assert_eq!(lesson.step_count(), 2);
    let steps: Vec<Document> = (0..3).map(|n| lesson.at_step(n).expect("a step")).collect();
    assert_eq!(
        steps[0].illustration().templates,
        lesson.illustration().templates
    );
    assert_eq!(
        steps[1].illustration().camera.target,
        Vec3::X,
        "a vector at its default is made"
    );
    assert_eq!(steps[1].illustration().title, "one");
    assert_eq!(
        steps[2].illustration().templates[0].number("progress"),
        1.0,
        "step 2 is step 1 and more"
    );
    assert!(!steps[2].illustration().templates[1].enabled);
    assert_eq!(steps[2].illustration().captions[0].text, "new");
    assert_eq!(
        lesson.at_step(3).expect_err("no step").to_string(),
        "there is no step 3: the document has steps 0 to 2"
    );
}

#[test]
fn passages_ease_and_mix_in_linear_light() {
    let lesson = lesson();
    let at = |step, seconds| lesson.at_time(step, seconds).expect("a moment");
    let progress = |seconds| at(1, seconds).templates[0].number("progress");
    assert_eq!(
        (progress(0.0), progress(1.0), progress(2.0), progress(9.0)),
        (0.5, 0.75, 1.0, 1.0)
    );
    assert!(
        (progress(0.5) - (0.5 + 0.5 * 0.15625)).abs() < 1e-6,
        "smoothstep: {}",
        progress(0.5)
    );
    assert_eq!(at(1, 0.0).title, "one", "the rest switches at the start");
    // Half the light of white is sRGB 188.
    assert_eq!(at(1, 1.0).look.background, Background::Color([188; 3]));
    let ParamValue::Rotation(turn) = at(2, 0.5).templates[1].params[1] else {
        panic!("a rotation")
    };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    assert!(
        turn.dot(Quat::from_xyzw(0.0, 0.0, half, half)).abs() > 0.99999,
        "a quarter turn: {turn}"
    );
    assert_eq!(at(0, 3.0).title, "", "there is no passage to step 0");
}

#[test]
fn pointers_of_steps_follow_their_templates() {
    let mut history = History::new(lesson());
    let keys = |history: &History, step: usize| -> Vec<String> {
        let set = history.document().get(&format!("/steps/{step}/set"));
        let set = set.and_then(Value::as_object).expect("a set");
        set.keys()
            .filter(|key| key.starts_with("/templates"))
            .cloned()
            .collect()
    };
    history
        .apply(&Edit::MoveTemplate { from: 0, to: 1 })
        .expect("moved");
    assert_eq!(keys(&history, 0), ["/templates/1/params/progress"]);
    assert_eq!(
        keys(&history, 1),
        [
            "/templates/0/enabled",
            "/templates/0/params/turn",
            "/templates/7/at"
        ]
    );
    history
        .apply(&Edit::AddTemplate {
            index: 0,
            kind: TemplateKind::Cut,
            placement: Placement::DOCUMENT_DEFAULT,
        })
        .expect("added");
    assert_eq!(keys(&history, 0), ["/templates/2/params/progress"]);
    history
        .apply(&Edit::DuplicateTemplate { template: 1 })
        .expect("copied");
    assert_eq!(keys(&history, 0), ["/templates/3/params/progress"]);
    assert_eq!(
        keys(&history, 1),
        [
            "/templates/1/enabled",
            "/templates/1/params/turn",
            "/templates/9/at"
        ]
    );
    history
        .apply(&Edit::RemoveTemplate { template: 3 })
        .expect("removed");
    assert!(
        history
            .document()
            .get("/steps/0/set/~1camera~1target~10")
            .is_some()
    );
    assert!(
        keys(&history, 0).is_empty(),
        "what moved the removed template went with it"
    );
    for _ in 0..4 {
        assert!(history.undo());
    }
    assert_eq!(history.document(), &lesson());
}

#[test]
fn drags_are_one_step_and_have_names() {
    let place = |x: f32| Edit::SetPlacement {
        template: 0,
        placement: Placement {
            at: Vec3::new(x, 0.0, 0.0),
            ..Placement::DOCUMENT_DEFAULT
        },
    };
    let mut history = History::new(document(
        json!({ "fabrica": 1, "templates": [{ "kind": "peel", "unknown": 7 }] }),
    ));
    let first = history.document().clone();
    for i in 1..=50 {
        assert!(history.drag(&place(i as f32 * 0.01)).expect("dragged"));
    }
    history.end_drag();
    assert_eq!(history.undo_name(), Some("Move peel"));
    history.drag(&place(0.8)).expect("dragged again");
    history.end_drag();
    assert_eq!(
        history.document().get("/templates/0/at"),
        Some(&json!([0.8, 0, 0]))
    );
    assert_eq!(
        history.document().get("/templates/0/unknown"),
        Some(&json!(7)),
        "an edit leaves the rest alone"
    );
    assert!(history.undo());
    assert_eq!(
        history.document().get("/templates/0/at"),
        Some(&json!([0.5, 0, 0])),
        "two drags are two steps"
    );
    assert!(history.undo());
    assert_eq!(history.document(), &first);
    assert!(!history.undo(), "and fifty movements were one");
    assert_eq!(history.redo_name(), Some("Move peel"));
    assert!(history.redo() && history.redo() && !history.redo());
    // There and back again is nothing.
    let mut history = History::new(first.clone());
    history.drag(&place(0.3)).expect("there");
    history.drag(&place(0.0)).expect("and back");
    assert_eq!((history.document(), history.undo_name()), (&first, None));
    // A new edit forgets what was undone.
    history
        .apply(&Edit::SetTitle("a".to_owned()))
        .expect("titled");
    history.undo();
    history
        .apply(&Edit::SetTitle("b".to_owned()))
        .expect("titled");
    assert!(!history.redo());
    assert!(
        !history
            .apply(&Edit::SetTitle("b".to_owned()))
            .expect("the same"),
        "no change is no step"
    );
    assert_eq!(
        history
            .apply(&Edit::RemoveTemplate { template: 5 })
            .expect_err("nothing")
            .to_string(),
        "/templates/5: there is nothing there"
    );
    assert_eq!(
        history.document().illustration().title,
        "b",
        "a failed edit changes nothing"
    );
}

#[test]
fn typed_edits_write_what_they_say() {
    let mut history = History::new(Document::new());
    for edit in [
        Edit::AddTemplate {
            index: 9,
            kind: TemplateKind::Move,
            placement: Placement {
                at: Vec3::splat(0.123_456),
                rotate: -Quat::IDENTITY,
                size: Vec3::splat(1e-9),
            },
        },
        Edit::SetParam {
            template: 0,
            param: "turn",
            value: ParamValue::Rotation(Quat::from_xyzw(0.0, 0.0, 0.6, 0.8)),
        },
        Edit::SetAlign {
            template: 0,
            align: Align::Segment {
                keep: vec!["bone".to_owned()],
                thickness: 0.02,
            },
        },
        Edit::SetMode {
            template: 0,
            mode: TemplateMode::Add,
        },
        Edit::SetEnabled {
            template: 0,
            enabled: false,
        },
        Edit::RenameTemplate {
            template: 0,
            name: "lid".to_owned(),
        },
        Edit::SetTransfer(Transfer::Points(vec![TransferPoint {
            value: 0.000_123_456,
            color_srgb: [1, 2, 255],
            opacity: 0.25,
        }])),
        Edit::SetWindow(Window::Range([-160.0, 420.5])),
        Edit::SetOpacity(OpacityMode::Mass),
        Edit::Set {
            pointer: "/look/gradient".to_owned(),
            value: json!(0.5),
            name: "Change edges".to_owned(),
        },
        Edit::SetBackground(Background::None),
        Edit::SetCamera(Camera {
            distance: 1.0,
            ..Camera::DOCUMENT_DEFAULT
        }),
        Edit::SetSubject(SubjectRef::Builtin {
            name: "bar".to_owned(),
            revision: 1,
        }),
        Edit::AddCaption(Caption {
            at: Vec3::X,
            text: "a".to_owned(),
            enabled: true,
        }),
        Edit::AddStep {
            index: 0,
            step: json!({ "title": "s" }),
        },
    ] {
        assert!(
            history.apply(&edit).expect("an edit"),
            "{edit:?} changes something"
        );
    }
    assert_eq!(
        history.document().to_json_compact(),
        concat!(
            r#"{"fabrica":1,"subject":{"builtin":"bar"},"templates":[{"kind":"move","name":"lid","at":[0.1235,0.1235,0.1235],"size":[1e-4,1e-4,1e-4],"#,
            r#""params":{"turn":[0,0,0.6,0.8]},"enabled":false,"mode":"add","align":{"to":"segment","keep":["bone"],"thickness":0.02}}],"#,
            r##""look":{"transfer":[{"value":1.2346e-4,"color":"#0102ff","opacity":0.25}],"window":[-160,420.5],"opacity":"mass","gradient":0.5,"background":"none"},"##,
            r#""camera":{"distance":1},"labels":[{"at":[1,0,0],"text":"a"}],"steps":[{"title":"s"}]}"#
        )
    );
    history
        .apply(&Edit::SetAlign {
            template: 0,
            align: Align::Axis,
        })
        .expect("aligned");
    assert_eq!(
        history.document().get("/templates/0/align"),
        None,
        "the default is left out"
    );
    let full = document(json!({ "fabrica": 1, "templates": vec![json!({ "kind": "cut" }); 32] }));
    let one_more = Edit::DuplicateTemplate { template: 3 }
        .apply(&full)
        .expect_err("full");
    assert_eq!(
        one_more.to_string(),
        "/templates: 33 templates, at most 32 are allowed"
    );
}

#[test]
fn how_a_file_is_read_is_kept() {
    let text = r#"{"fabrica":1,"subject":{"sha256":"HASH","name":"a","frame":3,"raw":{"size":[4,3,2],"type":"int16","order":"big","spacing":[1,1,2],"skip":7},"segments":{"names":{"1":"bone"}}}}"#;
    let text = text.replace("HASH", &"0f".repeat(32));
    let document = Document::from_json(&text).expect("a document");
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    let subject = document.illustration().subject.clone();
    let reading = subject.reading().cloned().expect("a file");
    assert_eq!(reading.frame, 3);
    let raw = reading.raw.clone().expect("the raw layout of the document");
    assert_eq!((raw.size, raw.element), ([4, 3, 2], "int16"));
    assert!(raw.big_endian && raw.skip_bytes == 7);
    assert_eq!(document.to_json_compact(), text, "written as read");
    // Another volume of the same file keeps the names of its segments; another file does not.
    let other = subject.with_reading(Reading {
        frame: 0,
        ..reading
    });
    let edited = Edit::SetSubject(other.clone())
        .apply(&document)
        .expect("possible");
    assert_eq!(edited.illustration().subject, other);
    assert!(edited.illustration().segments.len() == 1, "the same file");
    assert!(!edited.to_json_compact().contains("frame"), "the default");
    let fresh = SubjectRef::Supplied {
        sha256: "ab".repeat(32),
        name: String::new(),
        reading: Reading::default(),
    };
    let edited = Edit::SetSubject(fresh).apply(&document).expect("possible");
    assert!(edited.illustration().segments.is_empty(), "another file");

    let wrong = [
        (r#""frame":-1"#, "/subject/frame"),
        (r#""frame":1.5"#, "/subject/frame"),
        (r#""raw":[]"#, "/subject/raw"),
        (r#""raw":{"size":[1,2]}"#, "/subject/raw/size"),
        (r#""raw":{"skip":"x"}"#, "/subject/raw/skip"),
    ];
    for (keys, pointer) in wrong {
        let text = format!(r#"{{"fabrica":1,"subject":{{"src":"a.raw",{keys}}}}}"#);
        let error = Document::from_json(&text).expect_err(keys).to_string();
        assert!(error.contains(pointer), "{keys}: {error}");
    }
    let odd = r#"{"fabrica":1,"subject":{"src":"a.raw","raw":{"size":[0,1e9,2],"type":"quux","order":"middle"}}}"#;
    let document = Document::from_json(odd).expect("drawn as well as can be");
    assert_eq!(document.notices().len(), 3, "{:?}", document.notices());
}

#[test]
fn an_amount_of_nothing_is_nothing_and_of_all_is_what_is_set() {
    for kind in TemplateKind::ALL {
        let json = |amount: f64| {
            document(
                json!({ "fabrica": 1, "templates": [{ "kind": kind.spec().name, "amount": amount,
                "params": match kind { TemplateKind::Move => json!({ "turn": [0, 0, 0.6, 0.8] }), _ => json!({}) } }] }),
            )
        };
        let acting = |amount| json(amount).illustration().templates[0].acting();
        let (none, half, all) = (acting(0.0), acting(0.5), acting(1.0));
        assert_eq!(all.params, json(1.0).illustration().templates[0].params);
        assert_eq!(
            (none.amount, half.amount),
            (1.0, 1.0),
            "it is worked in once"
        );
        assert_eq!(half.acting(), half);
        match kind
            .spec()
            .main_param
            .map(|i| (none.params[i], half.params[i], all.params[i]))
        {
            Some((ParamValue::Number(a), ParamValue::Number(b), ParamValue::Number(c))) => {
                assert_eq!((a, b), (0.0, c / 2.0), "{kind:?}");
            }
            Some((ParamValue::Vector(a), ParamValue::Vector(b), ParamValue::Vector(c))) => {
                assert_eq!((a, b), (Vec3::ZERO, c / 2.0), "{kind:?}");
            }
            None => {
                assert!(!none.enabled && half.enabled, "{kind:?}");
                assert_eq!(half.placement.size.z, 0.5 * all.placement.size.z);
                let top = |t: &PlacedTemplate| {
                    t.placement.subject_from_template(Vec3::new(0.5, 0.5, 1.0))
                };
                assert!(
                    top(&half).distance(top(&all)) < 1e-6,
                    "it goes down from the top"
                );
            }
            other => panic!("{kind:?}: {other:?}"),
        }
        if kind == TemplateKind::Move {
            assert_eq!(none.params[1], ParamValue::Rotation(Quat::IDENTITY));
        }
    }
}

#[test]
fn an_amount_is_kept_in_range_and_left_out_when_whole() {
    let given = document(
        json!({ "fabrica": 1, "templates": [{ "kind": "peel", "amount": 1.5 }, { "kind": "cut", "amount": 0.25 }] }),
    );
    let templates = &given.illustration().templates;
    assert_eq!((templates[0].amount, templates[1].amount), (1.0, 0.25));
    assert_eq!(given.notices().len(), 1, "{:?}", given.notices());
    let whole = Edit::SetAmount {
        template: 1,
        amount: 1.0,
    }
    .apply(&given)
    .expect("set");
    assert_eq!(whole.illustration().templates[1].amount, 1.0);
    let wrong = Document::from_json(
        r#"{ "fabrica": 1, "templates": [{ "kind": "cut", "amount": "all" }] }"#,
    );
    assert!(wrong.is_err());
    // Half way from nothing to all of it.
    let walked = document(
        json!({ "fabrica": 1, "templates": [{ "kind": "peel", "amount": 0 }],
        "steps": [{ "set": { "/templates/0/amount": 1 } }] }),
    );
    let middle = walked.at_time(1, 0.5);
    assert!((0.3..0.7).contains(&middle.expect("a step").templates[0].amount));
}

#[test]
fn control_points_and_files_are_read_or_refused() {
    let drawn = |params: Value| {
        let kind = if params.get("points").is_some() {
            "rbf"
        } else {
            "field"
        };
        let value = json!({ "fabrica": 1, "templates": [{ "kind": kind, "params": params }] });
        Document::from_value(value)
    };
    let points = json!({ "points": [{ "at": [0.1, 0.2, 99], "move": [0, 0.5, 0], "later": 1 }, {}], "cut": [[0.5, 0], [0.5, 1]] });
    let document = drawn(points).expect("right");
    let TemplateData::Points(points) = &document.illustration().templates[0].data else {
        panic!("an rbf has points");
    };
    assert_eq!(points.points[0].at, Vec3::new(0.1, 0.2, 10.0), "clamped");
    assert_eq!(points.points[1].at, Vec3::splat(0.5));
    assert_eq!(points.cut.len(), 2);
    assert_eq!(notices(&document).len(), 2, "{:?}", notices(&document));
    assert_eq!(
        document,
        Document::from_json(&document.to_json()).expect("round")
    );
    for wrong in [
        json!({ "points": 3 }),
        json!({ "points": [3] }),
        json!({ "points": [{ "at": [0, 1] }] }),
        json!({ "points": [{ "move": "up" }] }),
        json!({ "points": [], "cut": [[0, 1, 2]] }),
        json!({ "points": [], "cut": [[0, null]] }),
        json!({ "src": 3 }),
        json!({ "sha256": "abc" }),
    ] {
        assert!(drawn(wrong.clone()).is_err(), "{wrong}");
    }
    let five = vec![json!({ "kind": "field", "params": { "src": "a.nrrd" } }); 5];
    let many = super::tests::document(json!({ "fabrica": 1, "templates": five }));
    assert!(
        many.notices()[0]
            .to_string()
            .contains("/templates/4: more than four fields")
    );
}
