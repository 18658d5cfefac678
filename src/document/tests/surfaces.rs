//! Meshes of the subject, objects of the scene, and what bodies are made of.

use super::{document, error, notices};
use crate::document::{
    BodyKind, Document, Edit, History, Illustration, MeshAxes, MeshParts, MeshReading, MeshRef,
    MeshUnits, ObjectPlacement, ObjectSource, SubjectBox, SubjectRef,
};
use crate::math::mix_srgb;
use glam::{DVec3, Quat, Vec3};
use serde_json::{Value, json};

fn hash(byte: &str) -> String {
    byte.repeat(32)
}

/// A document with every key, none at its default, in the order in which keys are written.
fn full() -> String {
    let text = r##"{"fabrica":1,
        "subject":{"meshes":[{"src":"talus.stl","name":"talus","units":"cm","axes":"lps","parts":"pieces","smooth":0},
            {"sha256":"HASH","name":"skin","parts":"whole"}],"box":[-10,-20,-30,10,20,31.5]},
        "objects":[{"builtin":"scalpel","name":"knife","group":"tools","at":[0.1,0.3,0.2],"rotate":[0,0,0.6,0.8],"size":0.5,
            "enabled":false,"color":"#112233","opacity":0.5,"inside":"#445566","gloss":0.9},
            {"src":"plate.obj","units":"in","axes":"y-up","at":[0,0,0],"smooth":25}],
        "look":{"segments":{"skin":0.25,"talus":{"thickness":0.2,"color":"#ff0000","opacity":0.4,"body":"hollow","inside":"#00ff00",
            "layers":[{"name":"core","depth":0.5}],"gloss":0.7}},
            "thickness":0.05,"body":"solid","inside":"#0000ff",
            "layers":[{"name":"flesh","depth":0.01,"color":"#f2e3b3","grain":0.2},{"name":"rind","color":"#b8433a"}],"gloss":0.3}}"##;
    let lines = text.lines().map(str::trim_start);
    lines.collect::<String>().replace("HASH", &hash("0a"))
}

fn bounds_of(shown: &Illustration) -> Option<SubjectBox> {
    match &shown.subject {
        SubjectRef::Meshes { bounds, .. } => *bounds,
        subject => subject.reading().and_then(|reading| reading.bounds),
    }
}

#[test]
fn every_key_is_read_and_written_as_it_was() {
    let text = full();
    let document = Document::from_json(&text).expect("a document");
    assert_eq!(document.to_json_compact(), text);
    assert_eq!(
        Document::from_json(&document.to_json()).expect("its own text"),
        document
    );
    assert_eq!(notices(&document), [""; 0], "all of it is drawn");
    let shown = document.illustration();
    let SubjectRef::Meshes { meshes, .. } = &shown.subject else {
        panic!("meshes alone: {:?}", shown.subject);
    };
    assert_eq!(shown.meshes(), meshes);
    let first = &meshes[0];
    assert_eq!(
        (first.index, first.src.as_deref(), &*first.name),
        (0, Some("talus.stl"), "talus")
    );
    let reading = MeshReading {
        units: Some(MeshUnits::Centimetre),
        axes: Some(MeshAxes::Lps),
        parts: MeshParts::Pieces,
        smooth_deg: Some(0.0),
    };
    assert_eq!(first.reading, reading);
    assert_eq!(meshes[1].sha256, Some(hash("0a")));
    assert_eq!(meshes[1].reading.smooth_deg, None, "the file's own normals");
    let subject_box = bounds_of(shown).expect("a box");
    assert_eq!(subject_box.middle_mm(), DVec3::new(0.0, 0.0, 0.75));
    assert_eq!(subject_box.mm_per_unit(), 61.5);

    let knife = shown.object("knife").expect("by its name");
    assert_eq!(knife.source, ObjectSource::Builtin("scalpel"));
    let placement = knife.placement.expect("a tool has a place");
    assert_eq!(
        (placement.at, placement.size),
        (Vec3::new(0.1, 0.3, 0.2), 0.5)
    );
    assert!(!knife.enabled && (knife.opacity, knife.gloss) == (0.5, 0.9));
    assert_eq!(knife.inside_srgb, Some([0x44, 0x55, 0x66]));
    let plate = shown.object("object 2").expect("counted from 1");
    assert!(
        matches!(&plate.source, ObjectSource::File { src: Some(src), .. } if src == "plate.obj")
    );
    assert_eq!(
        plate.placement,
        Some(ObjectPlacement::DOCUMENT_DEFAULT),
        "one of the three keys places it"
    );

    let talus = shown.look.of_mesh_segment("talus", Some(1));
    assert_eq!(talus.opacity, Some(0.4));
    assert_eq!(talus.color_srgb, Some([255, 0, 0]));
    let talus = talus.surface;
    assert_eq!(
        (talus.body, talus.thickness, talus.gloss),
        (BodyKind::Hollow, 0.2, 0.7)
    );
    assert_eq!(talus.layers.len(), 1);
    let skin = shown.look.of_mesh_segment("skin", Some(2));
    assert_eq!(skin.opacity, Some(0.25), "a number is an opacity");
    assert_eq!(skin.surface, shown.look.surface);
    let names: Vec<&str> = skin.surface.layers.iter().map(|l| &*l.name).collect();
    assert_eq!(names, ["rind", "flesh"], "sorted by depth");
    assert_eq!(skin.surface.layers[0].index, 1, "and found again");
    let other = shown.look.of_mesh_segment("cuboid", Some(3));
    assert_eq!(
        (other.opacity, other.color_srgb),
        (None, None),
        "the file's"
    );
}

#[test]
fn defaults_are_left_out() {
    let written = document(json!({ "fabrica": 1,
        "subject": { "builtin": "head", "meshes": [], "parts": "named" },
        "objects": [{ "builtin": "needle", "name": "", "group": "", "at": [0, 0, 0], "rotate": [0, 0, 0, 1], "size": 0.3,
            "opacity": 1, "gloss": 0.5, "enabled": true }],
        "look": { "body": "auto", "thickness": 0.03, "layers": [], "gloss": 0.1,
            "segments": { "a": { "layers": [{ "depth": 0, "name": "", "grain": 0 }] } } } }));
    assert_eq!(
        written.to_json_compact(),
        r#"{"fabrica":1,"objects":[{"builtin":"needle"}],"look":{"segments":{"a":{"layers":[{}]}}}}"#
    );
    let bare = Document::from_json(&written.to_json_compact()).expect("a document");
    assert_eq!(bare.illustration(), written.illustration());
    let look = &bare.illustration().look;
    let surface = &look.surface;
    assert_eq!(
        (surface.body, surface.thickness, surface.gloss),
        (BodyKind::Auto, 0.03, 0.1)
    );
    assert!(surface.inside_srgb.is_none() && surface.layers.is_empty());
    assert_eq!(look.of_mesh_segment("a", None).opacity, None, "the file's");
    assert_eq!(look.segments[0].opacity, 1.0, "of a scan it is solid");
    // What a missing key means depends on the file, or is said by the look: these stay.
    for stays in [
        r#"{"fabrica":1,"subject":{"meshes":[{"src":"a.stl","units":"mm","axes":"ras","smooth":40}]}}"#,
        r#"{"fabrica":1,"objects":[{"src":"a.stl","at":[0,0,0],"rotate":[0,0,0,1],"size":0.3}]}"#,
        r#"{"fabrica":1,"look":{"segments":{"a":{"thickness":0.03,"body":"auto","layers":[],"gloss":0.1}}}}"#,
    ] {
        let document = Document::from_json(stays).expect("a document");
        assert_eq!(document.to_json_compact(), stays);
    }
}

#[test]
fn meshes_are_the_subject_or_lie_beside_it() {
    let subject = |subject: Value| {
        let document = document(json!({ "fabrica": 1, "subject": subject }));
        let shown = document.illustration().clone();
        (document, shown)
    };
    let mesh = json!([{ "src": "a.stl" }]);
    let (alone, shown) = subject(json!({ "meshes": mesh }));
    assert!(matches!(&shown.subject, SubjectRef::Meshes { meshes, .. } if meshes.len() == 1));
    assert!(shown.meshes_beside.is_empty());
    assert!(alone.notices().is_empty(), "{:?}", alone.notices());
    assert_eq!(shown.subject.src(), Some("a.stl"));
    // Beside meshes the head is written, which alone it is not.
    let (head, shown) = subject(json!({ "meshes": mesh, "builtin": "head" }));
    assert!(matches!(&shown.subject, SubjectRef::Builtin { name, .. } if name == "head"));
    assert_eq!(shown.meshes().len(), 1);
    assert_eq!(
        head.to_json_compact(),
        r#"{"fabrica":1,"subject":{"builtin":"head","meshes":[{"src":"a.stl"}]}}"#
    );
    assert_eq!(notices(&head), [""; 0], "both are drawn");
    for file in [json!({ "src": "ct.nii" }), json!({ "sha256": hash("0b") })] {
        let mut both = file.clone();
        both["meshes"] = mesh.clone();
        let (_, shown) = subject(both);
        assert!(shown.subject.reading().is_some(), "{file}: a file");
        assert_eq!(shown.meshes_beside.len(), 1);
    }
    // Entries without a file are named, and the others keep their places.
    let (odd, shown) = subject(json!({ "meshes": [{ "name": "lost" }, { "src": "a.stl" }] }));
    assert_eq!(shown.meshes()[0].index, 1);
    assert!(notices(&odd)[0].starts_with("/subject/meshes/0: a mesh with neither"));
    let (_, shown) = subject(json!({ "meshes": [{ "name": "lost" }] }));
    assert_eq!(
        shown.subject,
        SubjectRef::Meshes {
            meshes: Vec::new(),
            bounds: None
        },
        "never the head"
    );
    let (_, shown) = subject(json!({ "meshes": [], "name": "none" }));
    assert!(
        matches!(shown.subject, SubjectRef::Builtin { .. }),
        "the head"
    );
    // The one-file form.
    let (one, shown) = subject(
        json!({ "src": "a.obj", "units": "m", "axes": "ras", "parts": "whole", "smooth": 10 }),
    );
    let reading = shown.subject.reading().expect("a file").mesh;
    assert_eq!(
        (reading.units, reading.axes),
        (Some(MeshUnits::Metre), Some(MeshAxes::Ras))
    );
    assert_eq!(
        (reading.parts, reading.smooth_deg),
        (MeshParts::Whole, Some(10.0))
    );
    let again = Edit::SetSubject(shown.subject)
        .apply(&one)
        .expect("the same");
    assert_eq!(again, one, "and it is written so");
    let (aside, _) = subject(json!({ "meshes": mesh, "name": "x", "units": "m" }));
    assert_eq!(aside.notices().len(), 2, "{:?}", aside.notices());
}

/// A wrong type, a number that is none, and a value out of range, for every key. `VALUE` stands for what is tried.
#[test]
fn hostile_values_are_errors_or_named() {
    const SUBJECT: &str = r#"{"fabrica":1,"subject":{"src":"a.stl","KEY":VALUE}}"#;
    const MESH: &str = r#"{"fabrica":1,"subject":{"meshes":[{"src":"a.stl","KEY":VALUE}]}}"#;
    const OBJECT: &str = r#"{"fabrica":1,"objects":[{"src":"a.stl","KEY":VALUE}]}"#;
    const LOOK: &str = r#"{"fabrica":1,"look":{"KEY":VALUE}}"#;
    const SEGMENT: &str = r#"{"fabrica":1,"look":{"segments":{"a":{"KEY":VALUE}}}}"#;
    const LAYER: &str = r#"{"fabrica":1,"look":{"layers":[{"KEY":VALUE}]}}"#;
    let places = [
        (SUBJECT, "/subject"),
        (MESH, "/subject/meshes/0"),
        (OBJECT, "/objects/0"),
        (LOOK, "/look"),
        (SEGMENT, "/look/segments/a"),
        (LAYER, "/look/layers/0"),
    ];
    let at = |place: &str| {
        places
            .iter()
            .find(|(text, _)| *text == place)
            .expect("one")
            .1
    };
    let tried = |place: &str, key: &str, value: &str| {
        Document::from_json(&place.replace("KEY", key).replace("VALUE", value))
    };
    let texts = [
        (MESH, "src"),
        (MESH, "sha256"),
        (MESH, "name"),
        (OBJECT, "src"),
        (OBJECT, "sha256"),
        (OBJECT, "name"),
        (OBJECT, "group"),
        (OBJECT, "builtin"),
        (LAYER, "name"),
    ];
    let names = [
        (SUBJECT, "units"),
        (SUBJECT, "axes"),
        (SUBJECT, "parts"),
        (MESH, "units"),
        (MESH, "axes"),
        (MESH, "parts"),
        (OBJECT, "units"),
        (OBJECT, "axes"),
        (LOOK, "body"),
        (SEGMENT, "body"),
        (LOOK, "inside"),
        (SEGMENT, "inside"),
        (SEGMENT, "color"),
        (OBJECT, "color"),
        (OBJECT, "inside"),
        (LAYER, "color"),
    ];
    let numbers = [
        (SUBJECT, "smooth", 180.0),
        (MESH, "smooth", 180.0),
        (OBJECT, "smooth", 180.0),
        (OBJECT, "size", 10.0),
        (OBJECT, "opacity", 1.0),
        (OBJECT, "gloss", 1.0),
        (LOOK, "thickness", 0.5),
        (SEGMENT, "thickness", 0.5),
        (LOOK, "gloss", 1.0),
        (SEGMENT, "gloss", 1.0),
        (SEGMENT, "opacity", 1.0),
        (LAYER, "depth", 1.0),
        (LAYER, "grain", 0.5),
    ];
    let lists = [
        (SUBJECT, "meshes"),
        (SUBJECT, "box"),
        (LOOK, "layers"),
        (SEGMENT, "layers"),
        (OBJECT, "at"),
        (OBJECT, "rotate"),
    ];
    let is_error = |place: &str, key: &str, value: &str, pointer: &str| {
        let error = tried(place, key, value)
            .map(|_| ())
            .expect_err(key)
            .to_string();
        assert!(error.contains(pointer), "{key}: {value}: {error}");
    };
    let own = |place: &str, key: &str| format!("{}/{key}", at(place));
    for (place, key) in texts.into_iter().chain(names) {
        for wrong in ["3", "null", "true", "[]", "{}"] {
            is_error(place, key, wrong, &own(place, key));
        }
    }
    for (place, key) in names {
        let document = tried(place, key, "\"quux\"").expect("kept");
        let line = notices(&document);
        assert!(
            line.iter().any(|l| l.starts_with(&own(place, key))),
            "{key}: {line:?}"
        );
        assert!(document.to_json_compact().contains("quux"), "{key} is kept");
    }
    for (place, key, most) in numbers {
        for wrong in ["\"much\"", "null", "[1]", "true", "1e999", "-1e999"] {
            is_error(place, key, wrong, &own(place, key));
        }
        // Of the JSON for NaN and infinity there is none: they are no values at all.
        for wrong in ["NaN", "Infinity", "-inf"] {
            assert!(tried(place, key, wrong).is_err(), "{key}: {wrong}");
        }
        for outside in [-0.5, most * 1.5, 1e30] {
            let document =
                tried(place, key, &outside.to_string()).expect("drawn as well as can be");
            let lines = notices(&document);
            let named = lines
                .iter()
                .filter(|line| line.starts_with(&own(place, key)));
            assert_eq!(named.count(), 1, "{key} {outside}: {lines:?}");
        }
        let document = tried(place, key, &most.to_string()).expect("in range");
        assert!(notices(&document).is_empty(), "{key}");
    }
    for (place, key) in lists {
        for wrong in ["3", "null", "\"all\"", "{}", "[null]", "[[]]"] {
            is_error(place, key, wrong, &own(place, key));
        }
    }
    for (wrong, pointer) in [
        ("[0,0,0,1,1]", "/subject/box"),
        ("[0,0,0,1,1,\"x\"]", "/subject/box/5"),
        ("[0,0,0,1,1,1e999]", "/subject/box/5"),
    ] {
        is_error(SUBJECT, "box", wrong, pointer);
    }
    is_error(OBJECT, "rotate", "[0,0,0,0]", "/objects/0/rotate");
    is_error(MESH, "sha256", "\"abc\"", "/subject/meshes/0/sha256");
    is_error(OBJECT, "sha256", "\"abc\"", "/objects/0/sha256");
    for (place, key) in places.map(|(place, _)| (place, "later")) {
        let document = tried(place, key, "[1]").expect("kept");
        let lines = notices(&document);
        assert!(
            lines.iter().any(|l| l.starts_with(&own(place, key))),
            "{lines:?}"
        );
        assert!(document.to_json_compact().contains("later"));
    }
}

#[test]
fn a_box_has_a_size() {
    let with = |numbers: [f64; 6]| {
        Document::from_value(
            json!({ "fabrica": 1, "subject": { "meshes": [{ "src": "a.stl" }], "box": numbers } }),
        )
    };
    for nothing in [
        [1.0; 6],
        [0.0; 6],
        [0.0, 0.0, 0.0, -1.0, -2.0, 0.0],
        [0.0, 0.0, 0.0, 1e-60, 0.0, 0.0],
    ] {
        let error = with(nothing).expect_err("no size").to_string();
        assert_eq!(error, "/subject/box: the box has no size");
    }
    let flat = with([0.0, 0.0, 0.0, 0.0, 5.0, 0.0]).expect("one side is enough");
    assert_eq!(
        bounds_of(flat.illustration()).expect("a box").mm_per_unit(),
        5.0
    );
    assert!(notices(&flat).is_empty());
    let odd = with([0.0, 4.0, 0.0, 2.0, 1.0, 1e300]).expect("as well as can be");
    let drawn = bounds_of(odd.illustration()).expect("a box");
    assert_eq!(
        (drawn.min_mm, drawn.max_mm),
        (DVec3::new(0.0, 4.0, 0.0), DVec3::new(2.0, 4.0, 1e7))
    );
    assert!(
        notices(&odd)[0].starts_with("/subject/box: [0, 4, 0, 2, 1, 1e300] is outside"),
        "{:?}",
        notices(&odd)
    );
}

#[test]
fn lists_have_limits() {
    let meshes = |n: usize| json!({ "fabrica": 1, "subject": { "meshes": vec![json!({ "src": "a.stl" }); n] } });
    let objects =
        |n: usize| json!({ "fabrica": 1, "objects": vec![json!({ "builtin": "needle" }); n] });
    let layers = |n: usize| json!({ "fabrica": 1, "look": { "layers": vec![json!({}); n] } });
    let own_layers = |n: usize| json!({ "fabrica": 1, "look": { "segments": { "a": { "layers": vec![json!({}); n] } } } });
    assert_eq!(document(meshes(64)).illustration().meshes().len(), 64);
    assert_eq!(document(objects(16)).illustration().objects.len(), 16);
    assert_eq!(
        document(layers(8)).illustration().look.surface.layers.len(),
        8
    );
    document(own_layers(8));
    for (value, line) in [
        (
            meshes(65),
            "/subject/meshes: 65 meshes, at most 64 are allowed",
        ),
        (objects(17), "/objects: 17 objects, at most 16 are allowed"),
        (layers(9), "/look/layers: 9 layers, at most 8 are allowed"),
        (
            own_layers(9),
            "/look/segments/a/layers: 9 layers, at most 8 are allowed",
        ),
    ] {
        assert_eq!(error(value), line);
    }
}

#[test]
fn objects_are_named_and_unknown_ones_left_out() {
    let document = document(json!({ "fabrica": 1, "objects": [
        { "builtin": "needle", "name": "knife" }, { "builtin": "scalpel", "name": "knife" }, { "builtin": "saw" }, {},
        { "builtin": "forceps", "src": "a.stl", "sha256": hash("0a") }, { "src": "b.stl" }, { "builtin": "needle", "name": "object 6" } ] }));
    let shown = document.illustration();
    let places: Vec<usize> = shown.objects.iter().map(|object| object.index).collect();
    assert_eq!(places, [0, 1, 4, 5, 6]);
    let knife = shown.object("knife").expect("two of them");
    assert_eq!(knife.index, 0, "the first counts");
    assert_eq!(shown.objects[3].placement, None, "where its file says");
    let lines = notices(&document);
    let expected = [
        "/objects/1/name: an object before is called “knife” too",
        "/objects/2/builtin: this version does not know “saw”; it is kept, nothing is drawn",
        "/objects/3: an object with none of",
        "/objects/4/src: the built-in object is shown",
        "/objects/4/sha256: the built-in object is shown",
        "/objects/6/name: an object before is called “object 6” too",
    ];
    assert_eq!(lines.len(), expected.len(), "{lines:#?}");
    for (line, start) in lines.iter().zip(expected) {
        assert!(line.starts_with(start), "{line}");
    }
}

// ---------------------------------------------------------------------------------------- steps

fn with_set(set: Value) -> Result<Document, String> {
    let value = json!({ "fabrica": 1, "subject": { "meshes": [{ "src": "a.stl" }] },
        "objects": [{ "builtin": "scalpel", "name": "knife" }, { "src": "b.stl", "color": "#000000" }],
        "steps": [{ "set": set, "seconds": 1 }] });
    Document::from_value(value).map_err(|error| error.to_string())
}

#[test]
fn steps_set_what_an_object_does_and_not_which_it_is() {
    for (key, value) in [
        ("builtin", json!("needle")),
        ("src", json!("c.stl")),
        ("sha256", json!(hash("0c"))),
        ("name", json!("blade")),
        ("units", json!("m")),
        ("axes", json!("ras")),
        ("smooth", json!(10)),
    ] {
        for place in ["0", "1", "7", "-"] {
            let refused =
                with_set(json!({ format!("/objects/{place}/{key}"): value })).expect_err(key);
            assert!(
                refused.contains(&format!(
                    "~1objects~1{place}~1{key}: may not be set by a step"
                )),
                "{refused}"
            );
        }
    }
    // Nor in a whole entry, nor in the whole list.
    for whole in [
        json!({ "/objects/0": { "builtin": "needle", "name": "knife" } }),
        json!({ "/objects/0": { "builtin": "scalpel" } }),
        json!({ "/objects/0": 3 }),
        json!({ "/objects/2": { "builtin": "needle" } }),
        json!({ "/objects/-": { "builtin": "needle" } }),
        json!({ "/objects": [] }),
        json!({ "/objects": 3 }),
        json!({ "/subject/meshes/0/src": "c.stl" }),
        json!({ "/subject/box": [0, 0, 0, 1, 1, 1] }),
    ] {
        let refused = with_set(whole.clone()).expect_err("refused");
        assert!(
            refused.contains("may not be set by a step"),
            "{whole}: {refused}"
        );
    }
    for (pointer, value) in [
        ("/objects/0/at", json!([0.1, 0.2, 0.3])),
        ("/objects/0/at/1", json!(0.2)),
        ("/objects/0/rotate", json!([0, 0, 1, 0])),
        ("/objects/0/size", json!(0.5)),
        ("/objects/0/color", json!("#ff0000")),
        ("/objects/0/inside", json!("#ff0000")),
        ("/objects/0/opacity", json!(0.5)),
        ("/objects/0/gloss", json!(0)),
        ("/objects/0/enabled", json!(false)),
        ("/objects/0/group", json!("tools")),
        ("/objects/1", json!({ "src": "b.stl", "opacity": 0.5 })),
        ("/look/body", json!("thick")),
        ("/look/thickness", json!(0.1)),
        ("/look/inside", json!("#ff0000")),
        ("/look/layers", json!([{ "depth": 0.1 }])),
        ("/look/gloss", json!(0.5)),
        (
            "/look/segments",
            json!({ "a": { "body": "thick", "thickness": 0.1 } }),
        ),
    ] {
        let document = with_set(json!({ pointer: value })).expect(pointer);
        assert_eq!(
            document.notices().len(),
            0,
            "{pointer}: {:?}",
            document.notices()
        );
        let at_step = document.at_step(1).expect("a step");
        let before = document.at_step(0).expect("step 0");
        assert_ne!(at_step, before, "{pointer}");
    }
    let wrong = with_set(json!({ "/objects/0/opacity": "none" })).expect_err("no number");
    assert!(wrong.contains("/objects/0/opacity"), "{wrong}");
}

#[test]
fn what_bodies_and_objects_say_eases() {
    let document = document(
        json!({ "fabrica": 1, "subject": { "meshes": [{ "src": "a.stl" }] },
        "objects": [{ "builtin": "scalpel" }, { "src": "b.stl", "color": "#000000" }],
        "look": { "inside": "#000000", "layers": [{ "depth": 0.2, "name": "a", "grain": 0 }, { "depth": 0.1, "name": "b", "color": "#000000" }],
            "segments": { "talus": { "opacity": 1 }, "skin": { "thickness": 0.2, "body": "thick" } } },
        "steps": [{ "set": {
            "/objects/0/at": [0.4, 0, 0], "/objects/0/rotate": [0, 0, 1, 0], "/objects/0/size": 0.5, "/objects/0/opacity": 0,
            "/objects/0/gloss": 1, "/objects/0/color": "#ff0000", "/objects/0/enabled": false, "/objects/1/color": "#ffffff",
            "/objects/1/size": 1,
            "/look/inside": "#ffffff", "/look/body": "solid", "/look/thickness": 0.05, "/look/gloss": 0.5,
            "/look/layers/0/depth": 0, "/look/layers/0/grain": 0.4, "/look/layers/1/color": "#ffffff",
            "/look/segments/talus/thickness": 0.13, "/look/segments/talus/opacity": 0.5, "/look/segments/talus/body": "hollow",
            "/look/segments/skin": { "body": "thick" } } }] }),
    );
    let half = document.at_time(1, 0.5).expect("half the way");
    let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-5, "{a} is not {b}");
    let knife = &half.objects[0];
    let placement = knife.placement.expect("a place");
    near(placement.at.x, 0.2);
    near(placement.size, 0.4);
    let quarter = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
    assert!(
        placement.rotate.dot(quarter).abs() > 0.99999,
        "{}",
        placement.rotate
    );
    near(knife.opacity, 0.5);
    near(knife.gloss, 0.75);
    assert_eq!(
        (knife.color_srgb, knife.enabled),
        (Some([255, 0, 0]), false),
        "what was nothing switches"
    );
    let grey = mix_srgb([0; 3], [255; 3], 0.5);
    assert_eq!(half.objects[1].color_srgb, Some(grey), "in linear light");
    assert_eq!(
        half.objects[1].placement.map(|p| p.size),
        Some(1.0),
        "from the file's place it switches"
    );
    let surface = &half.look.surface;
    assert_eq!(
        (surface.body, surface.inside_srgb),
        (BodyKind::Solid, Some(grey))
    );
    near(surface.thickness, 0.04);
    near(surface.gloss, 0.3);
    // The first layer passes the second; each stays itself.
    let layers = |part: f32| {
        let shown = document
            .at_time(1, part)
            .expect("a moment")
            .look
            .surface
            .layers;
        shown
            .into_iter()
            .map(|layer| layer.name)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        (layers(0.1), layers(0.9)),
        (
            vec!["b".to_owned(), "a".to_owned()],
            vec!["a".to_owned(), "b".to_owned()]
        )
    );
    let a = surface
        .layers
        .iter()
        .find(|layer| layer.name == "a")
        .expect("a");
    near(a.depth, 0.1);
    near(a.grain, 0.2);
    let talus = half.look.of_mesh_segment("talus", None);
    near(talus.opacity.expect("given"), 0.75);
    near(talus.surface.thickness, 0.08);
    assert_eq!(talus.surface.body, BodyKind::Hollow);
    let skin = half.look.of_mesh_segment("skin", None);
    near(skin.surface.thickness, 0.125);
    // The ends are the states themselves.
    for (part, step) in [(0.0, 0), (1.0, 1)] {
        let state = document.at_step(step).expect("a step");
        let shown = document.at_time(1, part).expect("a moment");
        let thickness = |shown: &crate::document::Illustration, name: &str| {
            shown.look.of_mesh_segment(name, None).surface.thickness
        };
        for name in ["talus", "skin"] {
            near(
                thickness(&shown, name),
                thickness(state.illustration(), name),
            );
        }
        near(
            shown.look.surface.gloss,
            state.illustration().look.surface.gloss,
        );
    }
}

#[test]
fn readers_may_move_what_steps_may_set() {
    let controls = |pointers: &[&str]| {
        let controls: Vec<Value> = pointers.iter().map(|p| json!({ "pointer": p })).collect();
        let document = document(
            json!({ "fabrica": 1, "objects": [{ "builtin": "needle" }], "controls": controls }),
        );
        document.illustration().controls.len()
    };
    assert_eq!(
        controls(&[
            "/objects/0/opacity",
            "/objects/0/size",
            "/objects/0/enabled",
            "/look/thickness",
            "/look/layers/0/depth"
        ]),
        5
    );
    assert_eq!(
        controls(&["/objects/0/smooth", "/objects/0/name", "/subject/smooth"]),
        0
    );
}

// ---------------------------------------------------------------------------------------- edits

fn mesh(src: &str) -> MeshRef {
    MeshRef {
        index: 0,
        src: Some(src.to_owned()),
        sha256: None,
        name: String::new(),
        reading: MeshReading::default(),
    }
}

#[test]
fn meshes_are_added_where_nothing_moves() {
    let mut history = History::new(Document::new());
    let add = |src: &str, box_mm| Edit::AddMesh {
        mesh: mesh(src),
        box_mm,
    };
    history.apply(&add("a.stl", None)).expect("added");
    assert_eq!(
        history.document().get("/subject"),
        Some(&json!({ "builtin": "head", "meshes": [{ "src": "a.stl" }] })),
        "the head stays the subject"
    );
    assert_eq!(history.undo_name(), Some("Add mesh"));
    assert!(history.undo());
    assert_eq!(history.document(), &Document::new());
    let alone = SubjectRef::Meshes {
        meshes: vec![mesh("a.stl")],
        bounds: None,
    };
    history
        .apply(&Edit::SetSubject(alone.clone()))
        .expect("set");
    assert_eq!(history.document().illustration().subject, alone);
    let first = SubjectBox {
        min_mm: DVec3::splat(-1.5),
        max_mm: DVec3::splat(2.0),
    };
    history.apply(&add("b.stl", Some(first))).expect("added");
    let second = SubjectBox {
        min_mm: DVec3::ZERO,
        max_mm: DVec3::ONE,
    };
    history.apply(&add("c.stl", Some(second))).expect("added");
    let shown = history.document().illustration();
    assert_eq!(
        (shown.meshes().len(), bounds_of(shown)),
        (3, Some(first)),
        "the box of the first stays"
    );
    history
        .apply(&Edit::RemoveMesh { mesh: 1 })
        .expect("removed");
    let names: Vec<Option<&str>> = history
        .document()
        .illustration()
        .meshes()
        .iter()
        .map(|m| m.src.as_deref())
        .collect();
    assert_eq!(names, [Some("a.stl"), Some("c.stl")]);
    let none = Edit::RemoveMesh { mesh: 5 }
        .apply(history.document())
        .expect_err("none");
    assert_eq!(
        none.to_string(),
        "/subject/meshes/5: there is nothing there"
    );
    // Another subject brings its own meshes.
    let cube = SubjectRef::Builtin {
        name: "cube".to_owned(),
        revision: 1,
    };
    history.apply(&Edit::SetSubject(cube)).expect("set");
    assert_eq!(
        history.document().get("/subject"),
        Some(&json!({ "builtin": "cube" }))
    );
}

#[test]
fn pointers_of_steps_follow_their_objects() {
    let document = document(
        json!({ "fabrica": 1, "objects": [{ "builtin": "scalpel", "name": "knife" }, { "builtin": "needle" }],
        "controls": [{ "pointer": "/objects/1/opacity" }],
        "steps": [{ "set": { "/objects/0/at": [0, 0, 0.1], "/objects/1/opacity": 0.5 } }] }),
    );
    let mut history = History::new(document.clone());
    let keys = |history: &History| -> Vec<String> {
        let set = history
            .document()
            .get("/steps/0/set")
            .and_then(Value::as_object);
        set.into_iter()
            .flat_map(|set| set.keys().cloned())
            .collect()
    };
    history
        .apply(&Edit::MoveObject { from: 0, to: 1 })
        .expect("moved");
    assert_eq!(keys(&history), ["/objects/0/opacity", "/objects/1/at"]);
    history
        .apply(&Edit::AddObject {
            index: 0,
            object: json!({ "builtin": "forceps" }),
        })
        .expect("added");
    assert_eq!(keys(&history), ["/objects/1/opacity", "/objects/2/at"]);
    history
        .apply(&Edit::DuplicateObject { object: 1 })
        .expect("copied");
    assert_eq!(keys(&history), ["/objects/1/opacity", "/objects/3/at"]);
    history
        .apply(&Edit::RemoveObject { object: 1 })
        .expect("removed");
    assert_eq!(keys(&history), ["/objects/2/at"]);
    assert!(
        history.document().illustration().controls.is_empty(),
        "nor does a reader move it"
    );
    assert_eq!(history.undo_name(), Some("Remove needle"));
    let placement = ObjectPlacement {
        at: Vec3::X,
        rotate: Quat::IDENTITY,
        size: 0.0,
    };
    history
        .apply(&Edit::PlaceObject {
            object: 2,
            placement,
        })
        .expect("placed");
    assert_eq!(history.undo_name(), Some("Resize knife"));
    assert_eq!(
        history.document().get("/objects/2/size"),
        Some(&json!(0.001))
    );
    while history.undo() {}
    assert_eq!(history.document(), &document);
    let full = super::document(
        json!({ "fabrica": 1, "objects": vec![json!({ "builtin": "needle" }); 16] }),
    );
    let more = Edit::DuplicateObject { object: 0 }
        .apply(&full)
        .expect_err("full");
    assert_eq!(
        more.to_string(),
        "/objects: 17 objects, at most 16 are allowed"
    );
    for missing in [
        Edit::DuplicateObject { object: 16 },
        Edit::RemoveObject { object: 16 },
        Edit::PlaceObject {
            object: 16,
            placement,
        },
    ] {
        assert!(missing.apply(&full).is_err(), "{missing:?}");
    }
}

#[test]
fn edits_at_a_step_are_recorded() {
    let lesson = document(
        json!({ "fabrica": 1, "objects": [{ "builtin": "scalpel", "name": "knife", "color": "#ff0000" }, { "src": "a.stl" }],
        "look": { "layers": [{ "depth": 0.1 }] }, "steps": [{ "title": "In" }, { "title": "Out" }] }),
    );
    let at = |step: usize, edit: Edit, document: &Document| {
        let edit = Edit::AtStep {
            step,
            edit: Box::new(edit),
        };
        edit.apply(document).expect("done at a step")
    };
    let set = |pointer: &str, value: Value| Edit::Set {
        pointer: pointer.to_owned(),
        value,
        name: String::new(),
    };
    let opacity = |document: &Document, step: usize, object: usize| {
        document
            .at_step(step)
            .expect("a step")
            .illustration()
            .objects[object]
            .opacity
    };
    let placement = ObjectPlacement {
        at: Vec3::X,
        rotate: Quat::IDENTITY,
        size: 0.3,
    };
    let moved = at(
        1,
        Edit::PlaceObject {
            object: 0,
            placement,
        },
        &lesson,
    );
    assert_eq!(
        moved.get("/steps/0/set"),
        Some(&json!({ "/objects/0/at": [1, 0, 0] }))
    );
    assert_eq!(moved.get("/objects"), lesson.get("/objects"));
    // A file that gets a place at a step lies where it says before.
    let placed = at(
        1,
        Edit::PlaceObject {
            object: 1,
            placement,
        },
        &lesson,
    );
    let places = [0, 1]
        .map(|step| placed.at_step(step).expect("a step").illustration().objects[1].placement);
    assert_eq!(places, [None, Some(placement)]);
    // What a step may not set is done to all steps.
    let named = at(2, set("/objects/0/name", json!("blade")), &moved);
    assert_eq!(named.get("/objects/0/name"), Some(&json!("blade")));
    assert_eq!(named.get("/steps"), moved.get("/steps"));
    // A colour that goes away has no default that a step could set: the whole entry is.
    let plain = at(
        1,
        Edit::Reset {
            pointer: "/objects/0/color".to_owned(),
            name: String::new(),
        },
        &lesson,
    );
    let colors = [0, 1, 2]
        .map(|step| plain.at_step(step).expect("a step").illustration().objects[0].color_srgb);
    assert_eq!(colors, [Some([255, 0, 0]), None, None]);
    // One that is added is seen from the step on; one that is removed, before it.
    let added = at(
        2,
        Edit::AddObject {
            index: 9,
            object: json!({ "builtin": "needle", "opacity": 0.5 }),
        },
        &lesson,
    );
    let shown = [0, 1, 2]
        .map(|step| added.at_step(step).expect("a step").illustration().objects[2].enabled);
    assert_eq!(shown, [false, false, true]);
    assert_eq!((opacity(&added, 1, 2), opacity(&added, 2, 2)), (0.5, 0.5));
    let gone = at(1, Edit::RemoveObject { object: 0 }, &lesson);
    let shown =
        [0, 1, 2].map(|step| gone.at_step(step).expect("a step").illustration().objects[0].enabled);
    assert_eq!(shown, [true, false, false]);
    let body = at(1, set("/look/body", json!("solid")), &lesson);
    let body = at(2, set("/look/layers/0/depth", json!(0.3)), &body);
    assert_eq!(
        body.get("/steps/0/set"),
        Some(&json!({ "/look/body": "solid" }))
    );
    assert_eq!(
        body.get("/steps/1/set"),
        Some(&json!({ "/look/layers/0/depth": 0.3 }))
    );
    // Steps that change places go on to show what they showed.
    let turned = Edit::MoveStep { from: 0, to: 1 }
        .apply(&body)
        .expect("moved");
    let look = |document: &Document, step: usize| {
        document
            .at_step(step)
            .expect("a step")
            .illustration()
            .look
            .clone()
    };
    assert_eq!(look(&turned, 2), look(&body, 1));
    assert_eq!(look(&turned, 1), look(&body, 2));
}

/// Whatever is done at a step is seen there, and nowhere before it.
#[test]
fn random_edits_at_steps_are_seen_there_only() {
    let mut bits = 0x5eed_u64;
    let mut below = |n: usize| {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        (bits >> 33) as usize % n
    };
    let mut lesson = document(json!({ "fabrica": 1,
        "objects": [{ "builtin": "scalpel", "name": "knife" }, { "src": "a.stl" }, { "src": "b.stl", "at": [0, 0, 0] }],
        "look": { "layers": [{ "depth": 0.1 }, {}], "segments": { "a": {}, "b": 0.5 } },
        "steps": [{ "title": "1" }, { "title": "2" }, { "title": "3" }] }));
    let colors = ["#000000", "#ffffff", "#ff8800"];
    let mut changed = 0;
    for round in 0..400 {
        let object = format!("/objects/{}", below(3));
        let number = json!([0.0, 0.3, 0.5, 1.0][below(4)]);
        let color = json!(colors[below(3)]);
        let (pointer, value) = match below(16) {
            0 => (format!("{object}/at"), Some(json!([number, 0, 0]))),
            1 => (format!("{object}/rotate"), Some(json!([0, 0, below(2), 1]))),
            2 => (format!("{object}/size"), Some(json!([0.3, 0.6][below(2)]))),
            3 => (format!("{object}/opacity"), Some(number)),
            4 => (format!("{object}/color"), Some(color)),
            5 => (format!("{object}/color"), None),
            6 => (format!("{object}/at"), None),
            7 => (format!("{object}/inside"), Some(color)),
            8 => (
                "/look/body".to_owned(),
                Some(json!(["auto", "thick", "solid"][below(3)])),
            ),
            9 => ("/look/inside".to_owned(), Some(color)),
            10 => ("/look/inside".to_owned(), None),
            11 => (format!("/look/layers/{}/depth", below(2)), Some(number)),
            12 => (
                format!("/look/layers/{}/color", below(2)),
                [Some(color), None][below(2)].clone(),
            ),
            13 => (
                "/look/layers".to_owned(),
                Some(json!(vec![json!({ "grain": 0.5 }); below(3)])),
            ),
            14 => (
                "/look/segments".to_owned(),
                Some(json!({ "a": { "thickness": 0.2 }, "b": { "layers": [] } })),
            ),
            _ => (
                "/look/thickness".to_owned(),
                [Some(json!(0.1)), None][below(2)].clone(),
            ),
        };
        let name = String::new();
        let edit = match value {
            Some(value) => Edit::Set {
                pointer: pointer.clone(),
                value,
                name,
            },
            None => Edit::Reset {
                pointer: pointer.clone(),
                name,
            },
        };
        let step = 1 + below(3);
        let states = |document: &Document| -> Vec<Document> {
            (0..4)
                .map(|step| document.at_step(step).expect("a step"))
                .collect()
        };
        let before = states(&lesson);
        // A layer that is not there any more cannot be changed.
        let Ok(wanted) = edit.apply(&before[step]) else {
            continue;
        };
        let edit = Edit::AtStep {
            step,
            edit: Box::new(edit),
        };
        lesson = edit
            .apply(&lesson)
            .expect("what can be done can be recorded");
        let after = states(&lesson);
        assert_eq!(after[step], wanted, "{round}: {pointer} at step {step}");
        assert_eq!(
            after[..step],
            before[..step],
            "{round}: {pointer} at step {step}"
        );
        changed += usize::from(wanted != before[step]);
        let again = Document::from_json(&lesson.to_json_compact()).expect("its own text");
        assert_eq!(again, lesson);
    }
    assert!(changed > 100, "only {changed} edits changed anything");
}
