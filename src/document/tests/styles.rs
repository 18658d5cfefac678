//! `look.style`: presets, what a document changes of them, steps, and values that are wrong.

use super::{document, error, notices};
use crate::document::{
    Document, Edit, GhostBy, HatchBy, Look, STYLE_PRESETS, Style, plain_f64, style_preset,
};
use crate::math::{hex, mix_srgb};
use serde_json::{Value, json};

fn with_style(style: Value) -> Document {
    document(json!({ "fabrica": 1, "look": { "style": style } }))
}

fn look(document: &Document) -> &Look {
    &document.illustration().look
}

fn style(value: Value) -> Style {
    let document = with_style(value);
    assert_eq!(notices(&document), [""; 0]);
    look(&document).style
}

/// Every key of a style.
fn written(style: &Style) -> Value {
    let number = plain_f64;
    let color = |color: [u8; 3]| format!("#{}", hex(&color));
    let Style {
        outline,
        tone,
        hatch,
        stipple,
        ghost,
    } = style;
    json!({
        "outline": { "width": number(outline.width), "color": color(outline.color_srgb), "creases": number(outline.creases) },
        "tone": { "levels": tone.levels, "warm": color(tone.warm_srgb), "cool": color(tone.cool_srgb),
            "strength": number(tone.strength) },
        "hatch": { "spacing": number(hatch.spacing), "width": number(hatch.width), "by": hatch.by.name(),
            "color": color(hatch.color_srgb), "strength": number(hatch.strength) },
        "stipple": { "spacing": number(stipple.spacing), "size": number(stipple.size),
            "color": color(stipple.color_srgb), "strength": number(stipple.strength) },
        "ghost": { "by": ghost.by.name(), "strength": number(ghost.strength) },
    })
}

#[test]
fn no_style_is_the_default_and_left_out() {
    let bare = document(json!({ "fabrica": 1 }));
    assert_eq!(look(&bare).style, Style::PLAIN);
    assert_eq!(look(&bare).style_preset, None);
    assert!(Style::PLAIN.is_plain());
    for none in [json!("none"), json!({}), json!({ "preset": "none" })] {
        let document = with_style(none);
        assert_eq!(document, bare);
        assert_eq!(document.to_json_compact(), r#"{"fabrica":1}"#);
        assert_eq!(document.illustration(), bare.illustration());
        assert_eq!(notices(&document), [""; 0]);
    }
    assert_eq!(style(written(&Style::PLAIN)), Style::PLAIN);
}

#[test]
fn presets_have_names_and_are_in_range() {
    let names: Vec<&str> = STYLE_PRESETS.iter().map(|preset| preset.name).collect();
    assert_eq!(names, ["atlas", "ink", "pencil", "textbook", "blueprint"]);
    assert!(style_preset("none").is_none() && style_preset("crayon").is_none());
    for preset in STYLE_PRESETS {
        let (name, style) = (preset.name, preset.style);
        assert!(!style.is_plain(), "{name}");
        let named = with_style(json!(name));
        assert_eq!(look(&named).style, style, "{name}");
        assert_eq!(look(&named).style_preset, Some(name));
        let text = format!(r#"{{"fabrica":1,"look":{{"style":"{name}"}}}}"#);
        assert_eq!(named.to_json_compact(), text, "its name");
        let object = with_style(json!({ "preset": name }));
        assert_eq!(object, named, "an object that says no more is its name");
        let full = with_style(written(&style));
        assert_eq!(look(&full).style, style, "{name}, every key by itself");
        assert_eq!(notices(&full), [""; 0], "{name} is in range");
    }
}

#[test]
fn who_writes_a_part_wants_it() {
    let made = style(
        json!({ "outline": {}, "tone": { "levels": 3 }, "hatch": { "by": "axis" },
        "stipple": {}, "ghost": { "by": "cut" } }),
    );
    let strengths = [
        made.tone.strength,
        made.hatch.strength,
        made.stipple.strength,
        made.ghost.strength,
    ];
    assert_eq!((made.outline.width, strengths), (2.0, [1.0, 1.0, 1.0, 0.5]));
    assert_eq!((made.tone.levels, made.hatch.by), (3, HatchBy::Axis));
    assert_eq!(made.ghost.by, GhostBy::Cut);
    assert_eq!(made.outline.color_srgb, [0x1a; 3], "the rest is as ever");
    // What the preset draws is as the preset has it.
    let changed = style(
        json!({ "preset": "pencil", "outline": { "color": "#ff0000" }, "hatch": { "spacing": 4 },
        "stipple": { "size": 3 } }),
    );
    let pencil = style_preset("pencil").expect("a preset").style;
    assert_eq!(changed.outline.width, pencil.outline.width);
    assert_eq!(changed.outline.color_srgb, [255, 0, 0]);
    assert_eq!(changed.hatch.strength, pencil.hatch.strength);
    assert_eq!(
        (changed.hatch.spacing, changed.stipple.strength),
        (4.0, 1.0)
    );
    assert_eq!(changed.tone, pencil.tone);
    // 0 is 0.
    let off = style(
        json!({ "preset": "ink", "outline": { "width": 0 }, "tone": { "strength": 0 },
        "hatch": { "strength": 0 }, "ghost": { "strength": 0 } }),
    );
    assert!(off.is_plain());
}

#[test]
fn styles_are_written_byte_for_byte() {
    for text in [
        r##"{"preset":"ink","outline":{"color":"#fff","creases":0,"width":2.5},"tone":{"levels":4,"warm":"#ffeedd","cool":"#112233","strength":0.25},"hatch":{"spacing":2,"by":"curvature","color":"#123","strength":1,"width":0.2},"stipple":{"size":1.5,"spacing":5,"color":"#1a1a1a","strength":0},"ghost":{"by":"facing","strength":0.5}}"##,
        r#"{"outline":{"width":0}}"#,
        r#"{"outline":{}}"#,
        r#"{"preset":"crayon","tone":{}}"#,
        r#"{"later":[1]}"#,
        r#""crayon""#,
    ] {
        let text = format!(r#"{{"fabrica":1,"look":{{"sides":true,"style":{text}}}}}"#);
        let document = Document::from_json(&text).expect("a document");
        assert_eq!(document.to_json_compact(), text);
        let again = Document::from_json(&document.to_json()).expect("a document");
        assert_eq!(again, document);
    }
}

#[test]
fn steps_set_parts_of_styles_and_make_what_is_missing() {
    let at = |look: Value, set: Value| {
        let document = document(json!({ "fabrica": 1, "look": look, "steps": [{ "set": set }] }));
        assert_eq!(notices(&document), [""; 0]);
        let state = document.at_step(1).expect("a step");
        let style = state.get("/look/style").cloned();
        (state.illustration().look.style, style.unwrap_or_default())
    };
    let (style, made) = at(json!({}), json!({ "/look/style/outline/width": 3 }));
    assert_eq!(style.outline.width, 3.0);
    assert_eq!(made, json!({ "outline": { "width": 3 } }));
    let (style, made) = at(
        json!({ "style": "ink" }),
        json!({ "/look/style/outline/width": 3, "/look/style/ghost/by": "cut" }),
    );
    assert_eq!(style.hatch, style_preset("ink").expect("ink").style.hatch);
    assert_eq!((style.outline.width, style.ghost.strength), (3.0, 0.5));
    assert_eq!(
        made,
        json!({ "preset": "ink", "outline": { "width": 3 }, "ghost": { "by": "cut" } })
    );
    let (style, made) = at(
        json!({ "style": { "preset": "ink", "outline": { "width": 3 } } }),
        json!({ "/look/style/preset": "atlas" }),
    );
    assert_eq!((style.outline.width, style.outline.creases), (3.0, 0.4));
    assert_eq!(
        made,
        json!({ "preset": "atlas", "outline": { "width": 3 } })
    );
    let (_, made) = at(
        json!({ "style": "ink" }),
        json!({ "/look/style/preset": "none" }),
    );
    assert_eq!(made, Value::Null);
    let (_, made) = at(
        json!({ "style": { "outline": {} } }),
        json!({ "/look/style": "pencil" }),
    );
    assert_eq!(made, json!("pencil"));
    let wrong =
        json!({ "fabrica": 1, "steps": [{ "set": { "/look/style/hatch/spacing": "wide" } }] });
    assert!(error(wrong).contains("/look/style/hatch/spacing: expected a number, found “wide”"));
    let nowhere =
        json!({ "fabrica": 1, "steps": [{ "set": { "/look/style/hatch/nothing/x": 1 } }] });
    let told = notices(&document(nowhere));
    assert!(told[0].ends_with("is not there; left out"), "{told:?}");
}

#[test]
fn styles_ease() {
    let way = |start: Value, end: Value| {
        let document = document(json!({ "fabrica": 1, "look": { "style": start },
            "steps": [{ "set": { "/look/style": end } }] }));
        [0.0, 0.5, 1.0].map(|t| document.at_time(1, t).expect("a moment").look.style)
    };
    let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-5, "{a} is not {b}");
    let [ink, pencil] = ["ink", "pencil"].map(|name| style_preset(name).expect("one").style);
    let [start, half, end] = way(json!("ink"), json!("pencil"));
    near(half.outline.width, 1.6);
    near(half.hatch.spacing, 6.75);
    near(half.hatch.strength, 0.9);
    let grey = mix_srgb(ink.hatch.color_srgb, pencil.hatch.color_srgb, 0.5);
    assert_eq!(half.hatch.color_srgb, grey, "in linear light");
    assert_eq!(half.hatch.by, HatchBy::Curvature, "a choice jumps");
    let mut jumped = ink;
    jumped.hatch.by = pencil.hatch.by;
    assert_eq!((start, end), (jumped, pencil));
    // What one side does not draw grows in the other's colours, or goes in them.
    let part = json!({ "outline": { "width": 4, "color": "#ff0000", "creases": 1 }, "tone": { "levels": 3, "warm": "#00ff00" },
        "ghost": { "by": "cut" } });
    let [before, half, after] = way(json!("none"), part.clone());
    near(before.outline.width, 0.0);
    near(half.outline.width, 2.0);
    near(half.ghost.strength, 0.25);
    assert_eq!(
        (half.outline.color_srgb, half.outline.creases),
        ([255, 0, 0], 1.0)
    );
    assert_eq!(
        (half.tone.levels, half.tone.warm_srgb, half.ghost.by),
        (3, [0, 255, 0], GhostBy::Cut)
    );
    let [full, back, gone] = way(part, json!("none"));
    assert_eq!(full, after);
    assert_eq!(back, half);
    assert_eq!(gone, Style::PLAIN);
    let [_, half, _] = way(json!({ "stipple": { "size": 2 } }), json!("blueprint"));
    assert_eq!((half.stipple.size, half.stipple.strength), (2.0, 0.5));
    assert_eq!(half.hatch.by, HatchBy::Axis);
}

/// A wrong type, a number that is none, and a value out of range or unknown, for every key.
#[test]
fn hostile_styles_are_errors_or_named() {
    let tried = |part: &str, key: &str, value: &str| {
        let style = match part {
            "" => format!(r#"{{"{key}":{value}}}"#),
            part => format!(r#"{{"{part}":{{"{key}":{value}}}}}"#),
        };
        Document::from_json(&format!(r#"{{"fabrica":1,"look":{{"style":{style}}}}}"#))
    };
    let refused = |part: &str, key: &str, value: &str, what: &str| {
        let at = format!("/look/style/{part}/{key}").replace("//", "/");
        let error = tried(part, key, value)
            .map(|_| ())
            .expect_err(value)
            .to_string();
        assert_eq!(error, format!("{at}: {what}"));
    };
    let numbers = [
        ("outline", "width", 0.0, 20.0),
        ("outline", "creases", 0.0, 1.0),
        ("tone", "levels", 0.0, 5.0),
        ("tone", "strength", 0.0, 1.0),
        ("hatch", "spacing", 2.0, 50.0),
        ("hatch", "width", 0.2, 20.0),
        ("hatch", "strength", 0.0, 1.0),
        ("stipple", "spacing", 2.0, 50.0),
        ("stipple", "size", 0.2, 20.0),
        ("stipple", "strength", 0.0, 1.0),
        ("ghost", "strength", 0.0, 1.0),
    ];
    let told = |part: &str, key: &str, value: &str| {
        let document = tried(part, key, value).expect(key);
        let text = document.to_json_compact();
        assert!(text.contains(value), "{text} keeps {value}");
        let lines = notices(&document);
        assert_eq!(lines.len(), 1, "{lines:?}");
        lines[0].clone()
    };
    for (part, key, min, max) in numbers {
        let at = format!("/look/style/{part}/{key}");
        for (value, drawn) in [("-3", min), ("500", max), ("1e300", max)] {
            let line = told(part, key, value);
            let wanted = format!("{at}: {value} is outside the range; {drawn} is drawn");
            assert_eq!(line, wanted);
        }
        let what = "expected a number, found “much”";
        refused(part, key, r#""much""#, what);
        refused(part, key, "null", "expected a number, found null");
        let too_large = tried(part, key, "1e999").map(|_| ()).expect_err(key);
        let message = too_large.to_string();
        assert!(message.contains(&at), "{message}");
        assert!(message.contains("is not a finite number"), "{message}");
    }
    for (value, drawn) in [("1", 2), ("1.3", 2), ("2.5", 3), ("0.4", 0), ("-0.2", 0)] {
        let line = told("tone", "levels", value);
        let wanted =
            format!("/look/style/tone/levels: {value} is outside the range; {drawn} is drawn");
        assert_eq!(line, wanted);
        let document = tried("tone", "levels", value).expect("kept");
        assert_eq!(look(&document).style.tone.levels, drawn);
    }
    let texts = [
        ("", "preset", "none"),
        ("outline", "color", "the default"),
        ("tone", "warm", "the default"),
        ("tone", "cool", "the default"),
        ("hatch", "by", "the default"),
        ("hatch", "color", "the default"),
        ("stipple", "color", "the default"),
        ("ghost", "by", "the default"),
    ];
    for (part, key, drawn) in texts {
        refused(part, key, "7", "expected a text, found 7");
        let at = format!("/look/style/{part}/{key}").replace("//", "/");
        let wanted =
            format!("{at}: this version does not know “crayon”; it is kept, {drawn} is drawn");
        let document = tried(part, key, r#""crayon""#).expect("kept");
        assert_eq!(notices(&document), [wanted]);
        assert!(document.to_json_compact().contains("crayon"));
    }
    for part in ["outline", "tone", "hatch", "stipple", "ghost"] {
        refused("", part, "7", "expected an object, found 7");
        refused(
            "",
            part,
            r#""strong""#,
            "expected an object, found “strong”",
        );
        let wanted = "this version does not know this key; it is kept";
        let line = told(part, "later", "[1]");
        assert_eq!(line, format!("/look/style/{part}/later: {wanted}"));
    }
    assert!(told("", "later", "[1]").starts_with("/look/style/later: "));
    let of = |value: Value| json!({ "fabrica": 1, "look": { "style": value } });
    for (value, found) in [
        (json!(7), "7"),
        (json!([]), "a list of 0"),
        (json!(null), "null"),
    ] {
        let wanted = format!("/look/style: expected a preset's name or an object, found {found}");
        assert_eq!(error(of(value)), wanted);
    }
    let unknown = with_style(json!("crayon"));
    assert_eq!(
        notices(&unknown),
        ["/look/style: this version does not know “crayon”; it is kept, none is drawn"]
    );
    assert!(look(&unknown).style.is_plain() && look(&unknown).style_preset.is_none());
}

#[test]
fn styles_are_edited_and_recorded() {
    let edit = |document: &Document, edit: Edit| edit.apply(document).expect("an edit");
    let set = |key: &str, value: Value| Edit::Set {
        pointer: format!("/look/style/{key}"),
        value,
        name: "Change style".to_owned(),
    };
    let style = |document: &Document| document.get("/look/style").cloned();
    let bare = document(json!({ "fabrica": 1, "steps": [{}, {}] }));
    let ink = edit(&bare, Edit::SetStyle(Some("ink")));
    assert_eq!(style(&ink), Some(json!("ink")));
    let changed = edit(&ink, set("outline/width", json!(3)));
    let wanted = json!({ "preset": "ink", "outline": { "width": 3 } });
    assert_eq!(style(&changed), Some(wanted));
    assert_eq!(
        style(&edit(&changed, Edit::SetStyle(Some("ink")))),
        Some(json!("ink"))
    );
    assert_eq!(style(&edit(&changed, Edit::SetStyle(None))), None);
    let at_step = |document: &Document, inner: Edit| {
        let edit_of_step = Edit::AtStep {
            step: 1,
            edit: Box::new(inner),
        };
        let document = edit(document, edit_of_step);
        document.get("/steps/0/set").cloned().expect("what it sets")
    };
    assert_eq!(
        at_step(&ink, set("outline/width", json!(3))),
        json!({ "/look/style/outline": { "width": 3 } })
    );
    assert_eq!(
        at_step(&changed, set("outline/width", json!(4))),
        json!({ "/look/style/outline/width": 4 })
    );
    for (preset, wanted) in [(Some("atlas"), "atlas"), (None, "none")] {
        assert_eq!(
            at_step(&changed, Edit::SetStyle(preset)),
            json!({ "/look/style": wanted })
        );
    }
}

#[test]
fn readers_may_move_parts_of_styles() {
    use crate::document::ControlRange::Number;
    let pointers = [
        "/look/style/outline/width",
        "/look/style/tone/levels",
        "/look/style/hatch/by",
        "/look/style/preset",
    ];
    let controls = pointers.map(|pointer| json!({ "pointer": pointer }));
    let document =
        document(json!({ "fabrica": 1, "look": { "style": "ink" }, "controls": controls }));
    let controls = &document.illustration().controls;
    assert_eq!(controls.len(), 2, "names are no numbers");
    let number = |max, is_whole| Number {
        default: 0.0,
        min: 0.0,
        max,
        is_whole,
    };
    assert_eq!(controls[0].range, number(20.0, false));
    assert_eq!(controls[1].range, number(5.0, true));
}
