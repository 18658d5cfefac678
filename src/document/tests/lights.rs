//! `look.light`: its defaults, steps, and values that are wrong.

use super::{document, error, notices};
use crate::document::{Control, ControlRange, Document, Edit, Light, NoticeKind};
use glam::Vec3;
use serde_json::{Value, json};

fn with_light(light: Value) -> Document {
    document(json!({ "fabrica": 1, "look": { "light": light } }))
}

fn light(document: &Document) -> Light {
    document.illustration().look.light.expect("a light")
}

/// The direction that is drawn, and what is said of it.
fn from(written: Value) -> (Vec3, Vec<String>) {
    let document = with_light(json!({ "from": written }));
    let kept = document.get("/look/light/from").cloned();
    assert_eq!(kept, Some(written), "what is written stays");
    (light(&document).from, notices(&document))
}

#[track_caller]
fn near(a: Vec3, b: Vec3) {
    assert!(a.distance(b) < 1e-6, "{a} is not {b}");
}

#[test]
fn no_light_is_none_and_an_empty_one_is_the_default() {
    let bare = document(json!({ "fabrica": 1 }));
    assert_eq!(bare.illustration().look.light, None);
    let empty = with_light(json!({}));
    assert_eq!(light(&empty), Light::DOCUMENT_DEFAULT);
    assert_eq!(
        empty.to_json_compact(),
        r#"{"fabrica":1,"look":{"light":{}}}"#,
        "it is another document than the one without"
    );
    let Light {
        from,
        soft,
        contact,
        skin,
    } = light(&empty);
    near(from, Vec3::new(-0.5, 0.6, 0.6) / 0.97_f32.sqrt());
    assert_eq!((soft, contact, skin), (0.5, 0.5, 0.0));
    let full =
        with_light(json!({ "from": [-0.5, 0.6, 0.6], "soft": 0.5, "contact": 0.5, "skin": 0.0 }));
    assert_eq!(full, empty, "defaults are left out");
    assert_eq!(full.illustration(), empty.illustration());
    assert_eq!(notices(&full), [""; 0]);
}

#[test]
fn a_direction_is_one_whatever_its_length() {
    for (written, drawn) in [
        (json!([0, 3, 4]), Vec3::new(0.0, 0.6, 0.8)),
        (json!([0, 0, 1]), Vec3::Z),
        (json!([1e-300, 0, 0]), Vec3::X),
        (json!([0, -5e-324, 0]), Vec3::NEG_Y),
        (json!([-10000, 0, 0]), Vec3::NEG_X),
        // From behind, as a rim of light.
        (json!([0, 0.6, -0.8]), Vec3::new(0.0, 0.6, -0.8)),
        (json!([0.05, 0, -1]), Vec3::new(0.05, 0.0, -1.0).normalize()),
    ] {
        let (found, told) = from(written);
        near(found, drawn);
        assert!((found.length() - 1.0).abs() < 1e-6);
        assert_eq!(told, [""; 0]);
    }
}

#[test]
fn lights_are_written_byte_for_byte() {
    for text in [
        "{}",
        r#"{"from":[0.25,-0.5,1],"soft":0,"contact":1,"skin":0.35}"#,
        r#"{"from":[0,0,0],"soft":7}"#,
        r#"{"contact":0.125,"later":[1]}"#,
    ] {
        let text =
            format!(r#"{{"fabrica":1,"look":{{"sides":true,"style":"ink","light":{text}}}}}"#);
        let document = Document::from_json(&text).expect("a document");
        assert_eq!(document.to_json_compact(), text);
        let again = Document::from_json(&document.to_json()).expect("a document");
        assert_eq!(again, document);
    }
}

/// The place of `skin` among the keys of an object is that of an unknown one.
#[test]
fn segments_are_written_in_their_old_order() {
    let text = r#"{"fabrica":1,"look":{"segments":{"brain":1,"skin":0.5,"skull":1}}}"#;
    let document = Document::from_json(text).expect("a document");
    assert_eq!(document.to_json_compact(), text);
}

#[test]
fn steps_set_parts_of_lights_and_make_what_is_missing() {
    let at = |look: Value, set: Value| {
        let document = document(json!({ "fabrica": 1, "look": look, "steps": [{ "set": set }] }));
        assert_eq!(notices(&document), [""; 0]);
        let state = document.at_step(1).expect("a step");
        let made = state.get("/look/light").cloned().unwrap_or_default();
        (state.illustration().look.light, made)
    };
    for (key, value) in [("soft", 0.25), ("contact", 0.0), ("skin", 1.0)] {
        let pointer = format!("/look/light/{key}");
        let (found, made) = at(json!({}), json!({ pointer: value }));
        assert_eq!(made[key].as_f64(), Some(value), "{made}");
        assert_eq!(made.as_object().map(|made| made.len()), Some(1), "{made}");
        let found = found.expect("a light");
        let mut wanted = Light::DOCUMENT_DEFAULT;
        match key {
            "soft" => wanted.soft = 0.25,
            "contact" => wanted.contact = 0.0,
            _ => wanted.skin = 1.0,
        }
        assert_eq!(found, wanted);
    }
    let (found, made) = at(json!({}), json!({ "/look/light/from/0": 0.6 }));
    assert_eq!(made, json!({ "from": [0.6, 0.6, 0.6] }), "the rest is made");
    near(found.expect("a light").from, Vec3::ONE.normalize());
    let (found, _) = at(
        json!({ "light": { "soft": 1, "skin": 0.5 } }),
        json!({ "/look/light/skin": 0.75, "/look/light/from": [0, 0, 2] }),
    );
    assert_eq!(
        found,
        Some(Light {
            from: Vec3::Z,
            soft: 1.0,
            contact: 0.5,
            skin: 0.75,
        })
    );
    let (found, made) = at(json!({}), json!({ "/look/light": {} }));
    assert_eq!((found, made), (Some(Light::DOCUMENT_DEFAULT), json!({})));
    let (found, _) = at(json!({ "light": {} }), json!({ "/look": {} }));
    assert_eq!(found, None, "a look without it has none");
    let wrong = json!({ "fabrica": 1, "steps": [{ "set": { "/look/light/soft": "very" } }] });
    let message = error(wrong);
    assert!(
        message.contains("/look/light/soft: expected a number, found “very”"),
        "{message}"
    );
    let nowhere = json!({ "fabrica": 1, "steps": [{ "set": { "/look/light/soft/x": 1 } }] });
    let told = notices(&document(nowhere));
    assert!(told[0].ends_with("is not there; left out"), "{told:?}");
}

#[test]
fn lights_ease() {
    let way = |start: Value, end: Value| {
        let document = document(json!({ "fabrica": 1, "look": start,
            "steps": [{ "set": { "/look": end } }] }));
        [0.0, 0.5, 1.0].map(|t| document.at_time(1, t).expect("a moment").look.light)
    };
    let of = |from: [f64; 3]| json!({ "light": { "from": from } });
    let first = json!({ "light": { "from": [0, 0, 1], "soft": 0, "contact": 1, "skin": 0.25 } });
    let second = json!({ "light": { "from": [1, 0, 0], "soft": 0.5, "contact": 0, "skin": 0.75 } });
    let [start, half, end] = way(first.clone(), second.clone());
    let [start, half, end] = [start, half, end].map(|light| light.expect("a light"));
    assert_eq!(
        start,
        light(&document(json!({ "fabrica": 1, "look": first })))
    );
    assert_eq!(
        end,
        light(&document(json!({ "fabrica": 1, "look": second })))
    );
    near(half.from, Vec3::new(0.5_f32.sqrt(), 0.0, 0.5_f32.sqrt()));
    let numbers = Vec3::new(half.soft, half.contact, half.skin);
    near(numbers, Vec3::new(0.25, 0.5, 0.5));
    // Lights of opposite sides pass the viewer, and so do those from behind.
    for (start, end) in [
        ([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.0, 1.0, -0.5], [0.0, -1.0, -0.5]),
    ] {
        let [_, half, _] = way(of(start), of(end));
        near(half.expect("a light").from, Vec3::Z);
    }
    // From none to one, and back, there is nothing between.
    let [one, none] = [second, json!({})];
    assert_eq!(way(none.clone(), one.clone()), [Some(end); 3]);
    assert_eq!(way(one, none), [None; 3]);
}

/// Every moment between any two lights has one that a document could have.
#[test]
fn light_on_its_way_is_of_length_one_and_never_from_straight_behind() {
    let mut directions = Vec::new();
    for x in [-1.0, -0.045, 0.0, 0.3, 1.0] {
        for y in [-1.0, 0.0, 0.045, 1.0] {
            for z in [-1.0, -0.2, 0.0, 1.0] {
                directions.push(json!([x, y, z]));
            }
        }
    }
    let steps: Vec<Value> = directions
        .iter()
        .map(|from| json!({ "set": { "/look/light/from": from } }))
        .collect();
    for steps in steps.chunks(40) {
        let way = document(json!({ "fabrica": 1, "look": { "light": {} }, "steps": steps }));
        for step in 1..=steps.len() {
            let mut before: Option<Vec3> = None;
            for moment in 0..=100 {
                let shown = way.at_time(step, moment as f32 / 100.0).expect("a moment");
                let from = shown.look.light.expect("a light").from;
                assert!((from.length() - 1.0).abs() < 1e-5, "{from}");
                assert!(from.z > -0.999_01, "{from}");
                if let Some(before) = before {
                    // The longest way is two times 177.5 degrees, at most 1.5 times as fast as in the mean.
                    assert!(before.distance(from) < 0.15, "{before} jumps to {from}");
                }
                before = Some(from);
            }
        }
    }
}

/// A wrong type, a number that is none, and a value out of range, for every key.
#[test]
fn hostile_lights_are_errors_or_named() {
    let tried = |key: &str, value: &str| {
        let text = format!(r#"{{"fabrica":1,"look":{{"light":{{"{key}":{value}}}}}}}"#);
        Document::from_json(&text)
    };
    let refused = |key: &str, value: &str, message: &str| {
        let found = tried(key, value).map(|_| ()).expect_err(value).to_string();
        assert_eq!(found, format!("/look/light/{message}"));
    };
    for key in ["soft", "contact", "skin"] {
        for (value, drawn) in [("-0.5", 0), ("1.5", 1), ("1e300", 1)] {
            let document = tried(key, value).expect("kept");
            assert!(document.to_json_compact().contains(value));
            assert_eq!(
                notices(&document),
                [format!(
                    "/look/light/{key}: {value} is outside the range; {drawn} is drawn"
                )]
            );
            let light = light(&document);
            let found = match key {
                "soft" => light.soft,
                "contact" => light.contact,
                _ => light.skin,
            };
            assert_eq!(found, drawn as f32);
        }
        for (value, found) in [
            (r#""much""#, "“much”"),
            ("null", "null"),
            ("true", "true"),
            ("[0.5]", "a list of 1"),
            ("{}", "an object"),
        ] {
            let message = format!("{key}: expected a number, found {found}");
            refused(key, value, &message);
        }
        let message = tried(key, "1e999").map(|_| ()).expect_err(key).to_string();
        assert!(
            message.contains(&format!("/look/light/{key}"))
                && message.contains("is not a finite number"),
            "{message}"
        );
    }
    for (value, found) in [
        ("7", "7"),
        (r#""left""#, "“left”"),
        ("null", "null"),
        ("[]", "a list of 0"),
        ("[0,1]", "a list of 2"),
        ("[0,1,0,0]", "a list of 4"),
        ("{}", "an object"),
    ] {
        let message = format!("from: expected a list of three numbers, found {found}");
        refused("from", value, &message);
    }
    refused(
        "from",
        r#"[0,"1",0]"#,
        "from/1: expected a number, found “1”",
    );
    refused(
        "from",
        "[0,1,null]",
        "from/2: expected a number, found null",
    );
    let huge = tried("from", "[1e999,0,0]").map(|_| ()).expect_err("huge");
    let message = huge.to_string();
    assert!(message.contains("/look/light/from/0"), "{message}");
    let not_a_number = json!({ "from": [f64::NAN, 0, 1] });
    assert_eq!(
        error(json!({ "fabrica": 1, "look": { "light": not_a_number } })),
        "/look/light/from/0: expected a number, found null"
    );
    for (value, found) in [
        (json!(7), "7"),
        (json!("left"), "“left”"),
        (json!([]), "a list of 0"),
        (json!(null), "null"),
        (json!(false), "false"),
    ] {
        let wanted = format!("/look/light: expected an object, found {found}");
        let of = json!({ "fabrica": 1, "look": { "light": value } });
        assert_eq!(error(of), wanted);
    }
    let document = with_light(json!({ "later": [1], "skin": 0.5 }));
    assert_eq!(
        notices(&document),
        ["/look/light/later: this version does not know this key; it is kept"]
    );
    assert_eq!(document.notices()[0].kind, NoticeKind::UnknownKey);
    assert_eq!(light(&document).skin, 0.5);
}

#[test]
fn what_is_no_direction_is_drawn_as_the_default() {
    for (written, text) in [
        (json!([0, 0, 0]), "[0, 0, 0]"),
        (json!([0, 0, -1]), "[0, 0, -1]"),
        (json!([0.03, -0.03, -1]), "[0.03, -0.03, -1]"),
        (json!([0, 1e-300, -1e-200]), "[0, 1e-300, -1e-200]"),
        (json!([0, 1, -1e300]), "[0, 1, -1e300]"),
    ] {
        let (found, told) = from(written);
        assert_eq!(found, Light::DOCUMENT_DEFAULT.from);
        let wanted =
            format!("/look/light/from: {text} is outside the range; [-0.5, 0.6, 0.6] is drawn");
        assert_eq!(told, [wanted]);
    }
    let (found, told) = from(json!([1e300, 0, -20000]));
    near(found, Vec3::new(1.0, 0.0, -1.0).normalize());
    assert_eq!(
        told,
        ["/look/light/from: [1e300, 0, -20000] is outside the range; [10000, 0, -10000] is drawn"]
    );
}

#[test]
fn lights_are_edited_recorded_and_moved_by_readers() {
    let at_step = |document: &Document, pointer: &str, value: Value| {
        let set = Edit::Set {
            pointer: pointer.to_owned(),
            value,
            name: "Change light".to_owned(),
        };
        let edit = Edit::AtStep {
            step: 1,
            edit: Box::new(set),
        };
        let document = edit.apply(document).expect("an edit");
        document.get("/steps/0/set").cloned().expect("what it sets")
    };
    let dark = document(json!({ "fabrica": 1, "steps": [{}, {}] }));
    let lit =
        document(json!({ "fabrica": 1, "look": { "light": { "soft": 0.25 } }, "steps": [{}, {}] }));
    assert_eq!(
        at_step(&dark, "/look/light/skin", json!(0.5)),
        json!({ "/look/light": { "skin": 0.5 } })
    );
    assert_eq!(
        at_step(&lit, "/look/light/skin", json!(0.5)),
        json!({ "/look/light/skin": 0.5 })
    );
    assert_eq!(
        at_step(&lit, "/look/light", json!({})),
        json!({ "/look/light/soft": 0.5 })
    );
    assert_eq!(
        at_step(&lit, "/look", json!({})),
        json!({ "/look": {} }),
        "no value of the key is that of none"
    );
    let controls = json!([{ "pointer": "/look/light/soft" }, { "pointer": "/look/light/skin" },
        { "pointer": "/look/light/from/0", "min": -1, "max": 1 }, { "pointer": "/look/light" }]);
    let offered = document(json!({ "fabrica": 1, "controls": controls }));
    let ranges: Vec<ControlRange> = offered
        .illustration()
        .controls
        .iter()
        .map(|control: &Control| control.range)
        .collect();
    let number = |default, min| ControlRange::Number {
        default,
        min,
        max: 1.0,
        is_whole: false,
    };
    assert_eq!(
        ranges,
        [number(0.5, 0.0), number(0.0, 0.0), number(-0.5, -1.0)],
        "an object is no number"
    );
}
