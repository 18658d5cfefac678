//! Every kind, every language, and documents that nobody meant to write.

use super::*;
use crate::document::{Document, MAX_ALT, TemplateKind};
use serde_json::{Value, json};

fn document(value: Value) -> Document {
    Document::from_value(value).expect("a document")
}

fn words(value: Value, step: usize, measured: &Measured) -> [String; 4] {
    let document = document(value);
    Lang::ALL.map(|lang| {
        let description = describe(&document, step, measured, lang).expect("a step");
        description.text().to_owned()
    })
}

fn told(value: Value) -> [String; 4] {
    words(value, 0, &Measured::default())
}

fn sight() -> Sight {
    Sight {
        object: 0.34,
        segments: vec![
            Seen {
                name: "bone".to_owned(),
                share: 0.42,
            },
            Seen {
                name: "skin".to_owned(),
                share: 0.31,
            },
            Seen {
                name: "Tumor".to_owned(),
                share: 0.2,
            },
            Seen {
                name: "hair".to_owned(),
                share: 0.004,
            },
        ],
        unnamed: 0.066,
    }
}

#[test]
fn all_is_told_in_every_language() {
    let value = json!({ "fabrica": 1, "title": "Skull", "caption": "Opened?", "templates": [
        { "kind": "peel", "name": "scalp", "params": { "progress": 0.8 }, "align": { "to": "segment", "keep": ["bone", "brain", 7] } },
        { "kind": "twist", "params": { "angle": -0.5 }, "align": { "to": "segment", "keep": ["bone", "brain", 7] } },
        { "kind": "cut", "enabled": false }],
        "look": { "segments": { "hair": 0, "skin": 0.3, "brain": 1 } },
        "camera": { "rotate": [0, 0, 0.3827, 0.9239] } });
    let measured = Measured {
        sight: Some(sight()),
        mm_per_unit: Some(240.0),
        turned: None,
    };
    assert_eq!(
        words(value, 0, &measured),
        [
            "Skull. Opened? Object: head. The layer is peeled back, 80 % (“scalp”). It is twisted by −29° over 120 mm. \
         Left in place: bone, brain, 7. Not drawn: hair. Drawn see-through: skin. Seen from the left front (the patient's left). \
         In sight: bone 42 %, skin 31 %, Tumor 20 %, without a name 7 %. The object covers 34 % of the picture.",
            "Skull. Opened? Objekt: Kopf. Die Schicht ist abgerollt, 80 % („scalp“). Um −29° verdreht, auf 120 mm Länge. \
         Am Platz gelassen: Knochen, Gehirn, 7. Nicht gezeichnet: Haar. Durchscheinend gezeichnet: Haut. Ansicht von vorn links (vom Patienten aus links). \
         Zu sehen: Knochen 42 %, Haut 31 %, Tumor 20 %, ohne Namen 7 %. Das Objekt nimmt 34 % des Bildes ein.",
            "Skull. Opened? Objeto: cabeza. La capa está enrollada, 80 % («scalp»). Torsión de −29° en 120 mm. \
         Sin mover: hueso, cerebro, 7. Sin dibujar: pelo. Con transparencia: piel. Vista desde delante y desde la izquierda del paciente. \
         A la vista: hueso 42 %, piel 31 %, Tumor 20 %, sin nombre 7 %. El objeto ocupa el 34 % de la imagen.",
            "Skull。Opened?对象：头部。表层已卷起，80%（“scalp”）。扭转 −29°，分布于 120 毫米长度。\
         保持原位：骨、大脑、7。未绘制：毛发。半透明绘制：皮肤。从患者左前方观看。\
         可见：骨 42%、皮肤 31%、Tumor 20%、未命名 7%。对象占图像的 34%。",
        ]
    );
}

#[test]
fn lengths_are_in_millimetres_where_they_are_known() {
    let value = json!({ "fabrica": 1, "subject": { "builtin": "bar" },
        "templates": [{ "kind": "move", "size": [0.5, 1, 1], "params": { "offset": [0.5, 0, 0] } }] });
    let known = Measured {
        sight: None,
        mm_per_unit: Some(22.0),
        turned: None,
    };
    let told = words(value.clone(), 0, &known);
    for (told, part) in told.iter().zip([
        "put 5.5 mm away",
        "um 5,5 mm versetzt",
        "a 5,5 mm",
        "移开 5.5 毫米",
    ]) {
        assert!(told.contains(part), "{told}");
    }
    for mm_per_unit in [None, Some(0.0), Some(f64::NAN)] {
        let measured = Measured {
            sight: None,
            mm_per_unit,
            turned: None,
        };
        let told = words(value.clone(), 0, &measured);
        assert!(
            told[0].contains("put 25 % of the longest side away"),
            "{told:?}"
        );
    }
}

#[test]
fn every_kind_has_a_sentence_of_its_own_and_none_at_rest() {
    for lang in 0..4 {
        let mut seen: Vec<String> = Vec::new();
        for kind in TemplateKind::ALL {
            let name = kind.spec().name;
            let params = match kind {
                TemplateKind::Rbf => {
                    json!({ "points": [{ "at": [0.5, 0.5, 0.5], "move": [0.1, 0, 0] }] })
                }
                TemplateKind::Carve => json!({ "object": "knife" }),
                _ => json!({}),
            };
            let objects = match kind {
                TemplateKind::Carve => json!([{ "builtin": "scalpel", "name": "knife" }]),
                _ => json!([]),
            };
            let told_at = |amount: f64| {
                let template = json!({ "kind": name, "params": params, "amount": amount });
                told(json!({ "fabrica": 1, "objects": objects, "templates": [template] }))
            };
            let (done, rest) = (told_at(1.0), told_at(0.0));
            let nothing = [
                "Nothing is deformed",
                "Nichts ist verformt",
                "Sin deformación",
                "没有任何变形",
            ][lang];
            assert!(rest[lang].contains(nothing), "{name}: {}", rest[lang]);
            assert!(!done[lang].contains(nothing), "{name}: {}", done[lang]);
            assert!(!done[lang].contains(['{', '}']), "{name}: {}", done[lang]);
            assert!(!seen.contains(&done[lang]), "{name}: {}", done[lang]);
            seen.push(done[lang].clone());
        }
    }
    let empty = told(
        json!({ "fabrica": 1, "templates": [{ "kind": "rbf" }, { "kind": "slices", "params": { "count": 1 } }] }),
    );
    assert!(empty[0].contains("Nothing is deformed"), "{empty:?}");
}

#[test]
fn the_author_has_the_last_word() {
    let value = json!({ "fabrica": 1, "title": "T", "alt": "A head,\nuntouched.", "steps": [
        { "title": "one" }, { "title": "two", "alt": "Two." }, { "set": { "/alt": "Three." } }, { "title": "four" }, { "set": { "/alt": "" } }] });
    let document = document(value);
    let text = |step| {
        let description =
            describe(&document, step, &Measured::default(), Lang::German).expect("a step");
        (
            description.text().to_owned(),
            description.to_json()["is_by_author"] == true,
        )
    };
    assert_eq!(text(0), ("A head, untouched.".to_owned(), true));
    assert_eq!(text(2), ("Two.".to_owned(), true));
    assert_eq!(text(3), ("Three.".to_owned(), true));
    for (step, begins) in [
        (1, "Schritt 1 von 5: one. "),
        (4, "Schritt 4 von 5: four. "),
        (5, "Schritt 5 von 5. "),
    ] {
        let (text, is_by_author) = text(step);
        assert!(text.starts_with(begins) && !is_by_author, "{text}");
    }
}

#[test]
fn odd_documents_are_described_too() {
    // Kinds that are not known, and no title.
    let odd = told(
        json!({ "fabrica": 1, "templates": [{ "kind": "unheard-of" }, {}], "subject": { "builtin": "castle" } }),
    );
    assert_eq!(
        odd[0],
        "Object: castle. Nothing is deformed. Seen from the front."
    );
    // Thirty-two templates: the same ones are counted, the rest summed up.
    let many: Vec<Value> = (0..32)
        .map(
            |i| json!({ "kind": "peel", "params": { "progress": 0.1 + 0.02 * f64::from(i % 16) } }),
        )
        .collect();
    let many = told(json!({ "fabrica": 1, "templates": many }));
    assert!(
        many[0].contains("peeled back, 10 % (2 times). "),
        "{}",
        many[0]
    );
    assert!(many[0].contains(". 18 more templates act. "), "{}", many[0]);
    let names: Vec<String> = (0..200).map(|i| format!("part {i} of\u{7} it")).collect();
    let keeps = told(
        json!({ "fabrica": 1, "templates": [{ "kind": "peel", "align": { "to": "segment", "keep": names } }, { "kind": "cut", "align": { "to": "segment", "keep": [""] } }] }),
    );
    assert!(
        keeps[0].contains("part 7 of it, 192 more. A block"),
        "{}",
        keeps[0]
    );
    // Texts do not end, bend lines or steer a terminal.
    let long = "w\u{1b}[2J\r\n".repeat(8_000);
    let long = told(
        json!({ "fabrica": 1, "title": long, "caption": long, "templates": [{ "kind": "cut", "name": long }],
        "subject": { "src": "a.nii", "name": long } }),
    );
    for text in long {
        assert!(
            text.chars().count() < 2 * MAX_ALT + 1000,
            "{}",
            text.chars().count()
        );
        assert!(!text.chars().any(char::is_control), "{text}");
    }
    // A picture with nothing, or nothing with a name, in it.
    let bare = |sight: Sight| {
        words(
            json!({ "fabrica": 1 }),
            0,
            &Measured {
                sight: Some(sight),
                mm_per_unit: None,
                turned: None,
            },
        )
    };
    for text in bare(Sight::default()) {
        assert!(!text.contains('%'), "{text}");
    }
    let unnamed = bare(Sight {
        object: 0.5,
        segments: Vec::new(),
        unnamed: 1.0,
    });
    assert!(
        unnamed[0].ends_with("front. The object covers 50 % of the picture."),
        "{unnamed:?}"
    );
    let nan = bare(Sight {
        object: f32::NAN,
        segments: vec![Seen {
            name: "x".to_owned(),
            share: f32::NAN,
        }],
        unnamed: f32::NAN,
    });
    assert!(!nan[0].contains("x NaN"), "{nan:?}");
}

#[test]
fn steps_that_are_not_there_are_named() {
    let document = document(json!({ "fabrica": 1, "steps": [{}] }));
    let error = describe(&document, 2, &Measured::default(), Lang::English).expect_err("no step");
    assert!(
        error.to_string().contains('2') && error.to_string().contains('1'),
        "{error}"
    );
}

#[test]
fn numbers_come_with_the_words() {
    let document = document(json!({ "fabrica": 1, "templates": [
        { "kind": "flap", "name": "door", "params": { "angle": std::f64::consts::PI } }, { "kind": "hole", "size": [0.5, 0.5, 0.5], "params": { "amount": 0.2 } }, { "kind": "cut" }] }));
    let measured = Measured {
        sight: Some(sight()),
        mm_per_unit: None,
        turned: None,
    };
    let value = describe(&document, 0, &measured, Lang::English)
        .expect("a step")
        .to_json();
    assert_eq!(
        value["done"],
        json!([
        { "template": 0, "kind": "flap", "name": "door", "degrees": 180.0 },
        { "template": 1, "kind": "hole", "part": 0.4444 },
        { "template": 2, "kind": "cut" }])
    );
    assert_eq!(value["from"], json!(["front"]));
    assert_eq!(
        value["segments"][0],
        json!({ "name": "bone", "share": 0.42 })
    );
    assert_eq!(value["object"], json!(0.34));
}
