//! Clays: what documents say of them, limits, hostile input, edits, steps.

use crate::document::{
    Clay, ClayKey, ClayShape, ClayStart, ClayTool, Document, Edit, Illustration, SubjectRef,
    ToolShape, VoxelPart, VoxelSource, clay_from_text, clay_to_text,
};
use serde_json::{Value, json};

fn read(clay: Value) -> Result<Document, crate::document::DocumentError> {
    Document::from_value(json!({ "fabrica": 1, "subject": { "clay": clay } }))
}

fn right(clay: Value) -> Document {
    read(clay).expect("right")
}

fn clay_in(illustration: &Illustration) -> &Clay {
    match &illustration.subject {
        SubjectRef::Clay(clay) => clay,
        other => panic!("a clay: {other:?}"),
    }
}

fn clay(document: &Document) -> &Clay {
    clay_in(document.illustration())
}

fn notices(document: &Document) -> Vec<String> {
    document.notices().iter().map(ToString::to_string).collect()
}

/// A clay whose one stroke is this.
fn stroked(stroke: Value) -> Value {
    json!({ "strokes": [stroke] })
}

/// Poses of the only tool of the only stroke.
fn keys(document: &Document) -> &[ClayKey] {
    &clay(document).strokes[0].moves[0].keys
}

fn key(at: [i32; 3], turn: [i32; 3], percent: i32) -> ClayKey {
    ClayKey { at, turn, percent }
}

/// A clay with every key, off its default.
fn everything() -> Value {
    json!({ "from": { "shape": "torus" }, "detail": 0.03, "tools": [
            { "radius": 0.2, "coat": 0.05 },
            { "shape": "box", "half": [0.1, 0.2, 0.3], "round": 0.05 },
            { "shape": "capsule", "radius": 0.1, "length": 0.5, "coat": 1.5, "x-later": [1] },
            { "shape": "mesh", "src": "tooth.stl", "longest": 0.3 },
            { "shape": "clay", "strokes": 1, "longest": 0.25 }],
        "strokes": [
            { "tool": 1, "path": [0, 350, 620, 0, -20, -140, 5, 5, 5], "turns": [0, 0, 90, -10, 0, 0], "scales": [50, 200],
                "straight": true, "mirror": "xz", "with": [{ "tool": 2, "path": [1, 2, 3], "turns": [1, 2, 3], "scales": [80] }] },
            { "path": [-500, 0, 0], "do": "smooth", "strength": 80, "off": true, "x-note": "kept" }],
        "x-later": { "deep": 1 } })
}

#[test]
fn the_example_of_the_specification_is_read() {
    let document = right(json!({
        "from": { "shape": "ball" }, "detail": 0.02, "tools": [{ "shape": "ball", "radius": 0.1, "coat": 0.1 }],
        "strokes": [{ "tool": 0, "path": [0, 350, 620, 0, -20, -140], "mirror": "x" }] }));
    assert_eq!(document.notices(), []);
    let made = clay(&document);
    assert_eq!(
        (&made.from, made.detail),
        (&ClayStart::Shape(ClayShape::Ball), 0.02)
    );
    assert_eq!(made.tools, [ClayTool::default()]);
    let [stroke] = &made.strokes[..] else {
        panic!("one stroke")
    };
    assert_eq!(stroke.mirror, [true, false, false]);
    assert_eq!((stroke.smooth, stroke.is_off), (None, false));
    assert_eq!(
        (stroke.moves[0].tool, stroke.moves[0].is_straight),
        (0, false)
    );
    let turn = [0; 3];
    assert_eq!(
        keys(&document),
        [key([0, 350, 620], turn, 100), key([0, 330, 480], turn, 100)]
    );
    let subject = &document.illustration().subject;
    assert!(subject.is_made() && !subject.has_file());
    assert_eq!(subject.is_figure(), Some(false));
    assert_eq!((subject.src(), subject.reading()), (None, None));
}

#[test]
fn a_clay_of_nothing_said_is_a_ball_that_nothing_touched() {
    let document = right(json!({}));
    assert_eq!(clay(&document), &Clay::default());
    assert_eq!(document.notices(), []);
    let text = r#"{"fabrica":1,"subject":{"clay":{}}}"#;
    assert_eq!(document.to_json_compact(), text);
    let said = right(json!({ "from": { "shape": "ball" }, "detail": 0.02, "strokes": [] }));
    assert_eq!(said.to_json_compact(), text);
    assert_eq!(
        clay(&right(json!({ "tools": [{}] }))).tools,
        [ClayTool::default()]
    );
    // No tool is not one tool.
    let none = right(json!({ "tools": [] }));
    assert_eq!(clay(&none).tools, []);
    assert!(none.to_json_compact().contains(r#""tools":[]"#));
    for (shape, name) in ClayShape::ALL.into_iter().zip(ClayShape::NAMES) {
        let from = json!({ "from": { "shape": name } });
        assert_eq!(clay(&right(from)).from, ClayStart::Shape(shape));
    }
    for name in ToolShape::NAMES.into_iter().skip(1) {
        let tools = json!({ "tools": [{ "shape": name }] });
        let tool = clay(&right(tools)).tools[0].clone();
        assert_eq!((tool.shape, tool.coat), (ToolShape::named(name), 0.1));
    }
}

#[test]
fn turns_and_sizes_go_on_beyond_their_lists() {
    let path = json!([1, 2, 3, 1, 1, 1, -5, 0, 0]);
    let document = right(stroked(
        json!({ "path": path, "turns": [0, 90, 0, 0, 0, -179], "scales": [50, 300] }),
    ));
    assert_eq!(document.notices(), []);
    assert_eq!(
        keys(&document),
        [
            key([1, 2, 3], [0, 90, 0], 50),
            key([2, 3, 4], [0, 0, -179], 300),
            key([-3, 3, 4], [0; 3], 300)
        ]
    );
    let beyond = right(stroked(
        json!({ "path": [0, 0, 0], "turns": [1, 0, 0, 2, 0, 0], "scales": [10, 20] }),
    ));
    assert_eq!(keys(&beyond), [key([0; 3], [1, 0, 0], 10)]);
    let said = notices(&beyond).join("\n");
    assert!(said.contains("/strokes/0/turns: 2 is outside"), "{said}");
    assert!(said.contains("/strokes/0/scales: 2 is outside"), "{said}");
}

#[test]
fn a_stroke_smooths_rests_or_moves_several_tools() {
    let document = right(everything());
    let [first, second] = &clay(&document).strokes[..] else {
        panic!("two strokes")
    };
    assert_eq!(first.mirror, [true, false, true]);
    let moves: Vec<_> = first
        .moves
        .iter()
        .map(|one| (one.tool, one.keys.len(), one.is_straight))
        .collect();
    assert_eq!(moves, [(1, 3, true), (2, 1, false)]);
    assert_eq!(first.moves[1].keys, [key([1, 2, 3], [1, 2, 3], 80)]);
    assert_eq!((second.smooth, second.is_off), (Some(80), true));
    let plain = right(stroked(json!({ "path": [0, 0, 0], "do": "smooth" })));
    assert_eq!(clay(&plain).strokes[0].smooth, Some(50));
    // What a later version does is left out here.
    let later = right(stroked(json!({ "path": [0, 0, 0], "do": "carve" })));
    assert!(clay(&later).strokes[0].is_off);
    assert!(notices(&later)[0].starts_with("/subject/clay/strokes/0/do: "));
    assert!(later.to_json_compact().contains(r#""do":"carve""#));
}

#[test]
fn a_clay_may_be_made_from_a_file() {
    let sha256 = "a".repeat(64);
    let document = right(
        json!({ "from": { "sha256": sha256, "name": "Foot", "units": "m", "axes": "y-up", "shape": "cube" } }),
    );
    let ClayStart::Mesh(mesh) = &clay(&document).from else {
        panic!("a file")
    };
    assert_eq!(
        (mesh.src.as_ref(), mesh.sha256.as_ref()),
        (None, Some(&sha256))
    );
    assert_eq!(mesh.name, "Foot");
    assert!(mesh.reading.units.is_some() && mesh.reading.axes.is_some());
    let subject = &document.illustration().subject;
    assert!(subject.has_file() && subject.is_made());
    assert_eq!(
        (subject.src(), subject.supplied_sha256()),
        (None, Some(sha256.as_str()))
    );
    // As the part of the page gets it, and with another file.
    let again = clay_from_text(&clay_to_text(clay(&document)));
    assert_eq!(again.as_ref(), Ok(clay(&document)));
    let other = clay(&document).with_file(Some("a.stl".to_owned()), None);
    let file = other.mesh().expect("a file");
    assert_eq!(
        (file.src.as_deref(), file.sha256.as_ref()),
        (Some("a.stl"), None)
    );
    assert_eq!(
        (file.reading, &other.tools),
        (mesh.reading, &clay(&document).tools)
    );
    let of_shape = Clay::default().with_file(Some("a.stl".to_owned()), None);
    let said = right(json!({ "from": { "src": "a.stl" } }));
    assert_eq!(&of_shape, clay(&said), "as if the document had named it");
    assert!(notices(&document)[0].starts_with("/subject/clay/from/shape: "));
    for (from, name, at) in [
        (json!({ "shape": "egg" }), "egg", "from/shape"),
        // What is meant of it is not said.
        (json!({ "of": { "builtin": "torso" } }), "of", "from/of"),
    ] {
        let document = right(json!({ "from": from }));
        assert_eq!(clay(&document).from, ClayStart::Unknown(name.to_owned()));
        let [notice] = &notices(&document)[..] else {
            panic!("one notice")
        };
        assert!(
            notice.starts_with(&format!("/subject/clay/{at}: ")),
            "{notice}"
        );
        assert_eq!(document.value()["subject"]["clay"]["from"], from, "kept");
    }
}

#[test]
fn a_clay_may_begin_with_a_part_of_a_volume() {
    let volume_of = |from: &Value| {
        let document = right(json!({ "from": from }));
        let volume = clay(&document).volume().expect("a volume").clone();
        (document, volume)
    };
    let skin = json!({ "of": { "builtin": "head" }, "segment": "skin" });
    let (document, volume) = volume_of(&skin);
    assert_eq!(document.notices(), []);
    let (name, revision) = ("head".to_owned(), 1);
    assert_eq!(volume.of, VoxelSource::Builtin { name, revision });
    assert_eq!(volume.part, VoxelPart::Segment("skin".to_owned()));
    assert!(!volume.has_all_walls);
    let subject = &document.illustration().subject;
    assert!(!subject.has_file() && subject.is_made() && subject.src().is_none());
    assert!(clay(&document).file().is_none() && clay(&document).mesh().is_none());
    // What stands at its default is left out; the head is what goes without saying.
    let text = r#"{"fabrica":1,"subject":{"clay":{"from":{"of":{},"segment":"skin"}}}}"#;
    assert_eq!(document.to_json_compact(), text);
    assert_eq!(Document::from_json(text), Ok(document));

    let sha256 = "c".repeat(64);
    let whole = json!({ "of": { "sha256": sha256, "src": "ct.raw", "name": "Chest", "frame": 2,
        "raw": { "size": [4, 5, 6], "type": "int16" } }, "iso": 300.5, "walls": "all" });
    let (document, volume) = volume_of(&whole);
    assert_eq!(document.notices(), []);
    assert_eq!(
        document.value()["subject"]["clay"]["from"],
        whole,
        "no key is lost"
    );
    assert_eq!(
        (volume.part, volume.has_all_walls),
        (VoxelPart::Iso(300.5), true)
    );
    let VoxelSource::File { reading, .. } = &volume.of else {
        panic!("a file: {:?}", volume.of)
    };
    assert_eq!(reading.frame, 2);
    assert_eq!(reading.raw.as_ref().map(|raw| raw.size), Some([4, 5, 6]));
    let file = clay(&document).file().expect("a file");
    assert_eq!(
        (file.src, file.sha256, file.name),
        (Some("ct.raw"), Some(sha256.as_str()), "Chest")
    );
    let subject = &document.illustration().subject;
    assert!(subject.has_file());
    assert_eq!(
        (subject.src(), subject.supplied_sha256()),
        (Some("ct.raw"), None)
    );
    let supplied = json!({ "of": { "sha256": sha256 }, "iso": 0 });
    let (document, volume) = volume_of(&supplied);
    let subject = &document.illustration().subject;
    assert_eq!(
        (subject.src(), subject.supplied_sha256()),
        (None, Some(sha256.as_str()))
    );
    assert_eq!(volume.part, VoxelPart::Iso(0.0), "0 is a value");
    assert!(document.to_json_compact().contains(r#""iso":0"#));

    // As the part of the page gets it, as an edit writes it, and with another file.
    for from in [&skin, &whole, &supplied] {
        let (document, volume) = volume_of(from);
        let again = clay_from_text(&clay_to_text(clay(&document)));
        assert_eq!(again.as_ref(), Ok(clay(&document)));
        let edit = Edit::SetSubject(document.illustration().subject.clone());
        let written = edit.apply(&right(json!({}))).expect("it takes it");
        assert_eq!(clay(&written), clay(&document));
        let other = clay(&document).with_file(Some("b.nii".to_owned()), None);
        let file = other.file().expect("a file");
        assert_eq!(
            (file.src, file.sha256, file.name),
            (Some("b.nii"), None, "")
        );
        let other = other.volume().expect("a volume");
        assert_eq!(
            (&other.part, other.has_all_walls),
            (&volume.part, volume.has_all_walls)
        );
    }

    // What goes beside something else, and what this version does not know, is named.
    for (from, at) in [
        (
            json!({ "of": {}, "segment": "skin", "iso": 3 }),
            "iso: the segment is shown",
        ),
        (
            json!({ "of": {}, "iso": 3, "shape": "cube" }),
            "shape: a clay of a volume is shown",
        ),
        (
            json!({ "of": {}, "iso": 3, "src": "a.stl" }),
            "src: a clay of a volume is shown",
        ),
        (
            json!({ "of": {}, "iso": 3, "units": "cm" }),
            "units: a clay of a volume is shown",
        ),
        (
            json!({ "shape": "cube", "iso": 3 }),
            "iso: a clay of no volume is shown",
        ),
        (
            json!({ "src": "a.stl", "segment": "skin" }),
            "segment: a clay of no volume is shown",
        ),
        (
            json!({ "walls": "all" }),
            "walls: a clay of no volume is shown",
        ),
        (
            json!({ "of": {}, "iso": 3, "walls": "some" }),
            "walls: this version does not know “some”",
        ),
        (json!({ "of": {}, "iso": 1e300 }), "iso: 1"),
        (
            json!({ "of": {}, "iso": 3, "later": 1 }),
            "later: this version does not know this key",
        ),
        (
            json!({ "of": { "later": 1 }, "iso": 3 }),
            "of/later: this version does not know this key",
        ),
        (
            json!({ "of": { "builtin": "tooth" }, "iso": 3 }),
            "of/builtin: this version does not know",
        ),
        (
            json!({ "of": { "builtin": "head", "src": "a.nii" }, "iso": 3 }),
            "of/src: the built-in subject is shown",
        ),
        (
            json!({ "of": { "frame": 1 }, "iso": 3 }),
            "of/frame: the built-in subject is shown",
        ),
        (
            json!({ "of": { "src": "a.nii" } }),
            "of: a clay of a volume of which neither",
        ),
    ] {
        let document = right(json!({ "from": from }));
        let [notice] = &notices(&document)[..] else {
            panic!("one notice of {from}: {:#?}", notices(&document))
        };
        let expected = format!("/subject/clay/from/{at}");
        assert!(notice.starts_with(&expected), "{notice} for {expected}");
    }
    let unnamed = right(json!({ "from": { "of": {}, "segment": "" } }));
    assert_eq!(clay(&unnamed).from, ClayStart::Unknown("of".to_owned()));
}

#[test]
fn what_else_a_subject_names_is_left_aside() {
    let document = Document::from_value(json!({ "fabrica": 1, "subject": { "clay": {}, "builtin": "drawn-arm",
        "src": "a.nrrd", "sha256": "b".repeat(64), "frame": 1, "raw": {}, "units": "m", "axes": "ras", "parts": "whole",
        "smooth": 3, "box": [0, 0, 0, 1, 1, 1], "meshes": [{ "src": "a.stl" }] } }))
    .expect("right");
    assert_eq!(clay(&document), &Clay::default());
    assert!(document.illustration().meshes_beside.is_empty());
    assert!(!document.illustration().is_of_figure());
    let said = notices(&document);
    assert_eq!(said.len(), 11, "{said:#?}");
    for key in [
        "builtin", "src", "sha256", "frame", "raw", "units", "axes", "parts", "smooth", "box",
    ] {
        let line = format!("/subject/{key}: the clay is shown; this is kept, left aside");
        assert!(said.contains(&line), "{line} in {said:#?}");
    }
    let meshes = "/subject/meshes: beside a clay this is kept, not drawn".to_owned();
    assert!(said.contains(&meshes), "{said:#?}");
    // A camera is written as it is, whatever figure is left aside.
    let camera = document.illustration().camera;
    let again = Edit::SetCamera(camera).apply(&document).expect("a camera");
    assert_eq!(again.illustration().camera.rotate, camera.rotate);
}

#[test]
fn values_out_of_range_are_drawn_at_its_end_and_named() {
    let document = right(
        json!({ "detail": 5, "tools": [{ "radius": 9, "coat": 0 }, { "shape": "clay", "strokes": 12 },
            { "shape": "mesh", "src": "a.stl" }, { "shape": "cloud" }, { "shape": "clay", "strokes": 5000, "longest": 0 }],
        "strokes": [
            { "path": [20000, 0, -1e300, -30000, 0, 0], "turns": [300, -400, 0], "scales": [1, 1e9], "mirror": "xq" },
            { "path": [0, 0, 0], "tool": 9, "strength": 200, "do": "smooth", "later": 1 },
            { "path": [0, 0, 0], "tool": 2, "with": [{ "tool": 1, "path": [0, 0, 0] }] }] }),
    );
    let said = notices(&document);
    for part in [
        "detail: 5",
        "tools/0/radius: 9",
        "tools/0/coat: 0",
        "tools/3/shape: this version does not know “cloud”",
        "tools/4/strokes: 5000",
        "tools/4/longest: 0",
        "strokes/2/with/0/tool: a stroke by a tool that is made of it or of later strokes",
        "strokes/0/path/0: 20000",
        "strokes/0/path/2: -",
        "strokes/0/path/3: -30000",
        "strokes/0/turns/0: [300, -400, 0]",
        "strokes/0/scales/0: 1",
        "strokes/0/scales/1: 1000000000",
        "strokes/0/mirror: ",
        "strokes/1/tool: ",
        "strokes/1/strength: 200",
        "strokes/1/later: ",
    ] {
        let part = format!("/subject/clay/{part}");
        assert!(
            said.iter().any(|line| line.starts_with(&part)),
            "{part}: {said:#?}"
        );
    }
    assert_eq!(said.len(), 17, "{said:#?}");
    let made = clay(&document);
    assert_eq!((made.detail, made.tools[0].coat), (0.1, 0.01));
    let baked = ToolShape::Clay {
        strokes: 12,
        longest: 0.4,
    };
    assert_eq!(made.tools[1].shape, Some(baked));
    assert!(made.tools[3].shape.is_none());
    assert_eq!(
        made.strokes[0].moves[0].keys,
        [
            key([10_000, 0, -10_000], [107, -143, 0], 5),
            key([-10_000, 0, -10_000], [0; 3], 2000)
        ]
    );
    assert_eq!(made.strokes[1].smooth, Some(100));
    assert_eq!(made.strokes[1].moves[0].tool, 9, "it names no tool");
}

#[test]
fn what_is_no_clay_is_refused_by_its_pointer() {
    let of_stroke = [
        (json!(3), ""),
        (json!({}), "/path"),
        (json!({ "path": [] }), "/path"),
        (json!({ "path": 1 }), "/path"),
        (json!({ "path": [1, 2] }), "/path"),
        (json!({ "path": [1, 2, 3, 4] }), "/path"),
        (json!({ "path": [0, 0.5, 0] }), "/path/1"),
        (json!({ "path": [0, 0, null] }), "/path/2"),
        (json!({ "path": [[0], 0, 0] }), "/path/0"),
        (json!({ "path": vec![0; 3 * 65] }), "/path"),
        (json!({ "path": [0, 0, 0], "turns": [1, 2] }), "/turns"),
        (
            json!({ "path": [0, 0, 0], "turns": [1, 2, 0.1] }),
            "/turns/2",
        ),
        (
            json!({ "path": [0, 0, 0], "turns": vec![0; 3 * 65] }),
            "/turns",
        ),
        (json!({ "path": [0, 0, 0], "turns": "x" }), "/turns"),
        (json!({ "path": [0, 0, 0], "scales": 50 }), "/scales"),
        (json!({ "path": [0, 0, 0], "scales": [50.5] }), "/scales/0"),
        (
            json!({ "path": [0, 0, 0], "scales": vec![50; 65] }),
            "/scales",
        ),
        (json!({ "path": [0, 0, 0], "tool": -1 }), "/tool"),
        (json!({ "path": [0, 0, 0], "tool": [0] }), "/tool"),
        (json!({ "path": [0, 0, 0], "tool": 0.5 }), "/tool"),
        (json!({ "path": [0, 0, 0], "straight": 1 }), "/straight"),
        (json!({ "path": [0, 0, 0], "mirror": ["x"] }), "/mirror"),
        (json!({ "path": [0, 0, 0], "off": "yes" }), "/off"),
        (json!({ "path": [0, 0, 0], "do": 3 }), "/do"),
        (json!({ "path": [0, 0, 0], "strength": [1] }), "/strength"),
        (json!({ "path": [0, 0, 0], "with": {} }), "/with"),
        (
            json!({ "path": [0, 0, 0], "with": [{ "path": [1] }] }),
            "/with/0/path",
        ),
        (
            json!({ "path": [0, 0, 0], "with": vec![json!({ "path": [0, 0, 0] }); 8] }),
            "/with",
        ),
        // Three tools with four images each.
        (
            json!({ "path": [0, 0, 0], "mirror": "xy", "with": vec![json!({ "path": [0, 0, 0] }); 2] }),
            "",
        ),
    ];
    let of_stroke = of_stroke.map(|(stroke, at)| (stroked(stroke), format!("strokes/0{at}")));
    let of_clay = [
        (json!({ "from": "ball" }), "from"),
        (json!({ "from": { "shape": 3 } }), "from/shape"),
        (json!({ "from": { "sha256": "no" } }), "from/sha256"),
        (json!({ "from": { "src": 3 } }), "from/src"),
        (json!({ "from": { "of": "head", "iso": 1 } }), "from/of"),
        (json!({ "from": { "of": [], "iso": 1 } }), "from/of"),
        (
            json!({ "from": { "of": { "clay": {} }, "iso": 1 } }),
            "from/of/clay",
        ),
        (
            json!({ "from": { "of": { "meshes": [{ "src": "a.stl" }] }, "iso": 1 } }),
            "from/of/meshes",
        ),
        (
            json!({ "from": { "of": { "builtin": "apple" }, "iso": 1 } }),
            "from/of/builtin",
        ),
        (
            json!({ "from": { "of": { "builtin": "drawn-arm" }, "iso": 1 } }),
            "from/of/builtin",
        ),
        (
            json!({ "from": { "of": { "builtin": 3 }, "iso": 1 } }),
            "from/of/builtin",
        ),
        (
            json!({ "from": { "of": { "sha256": "no" }, "iso": 1 } }),
            "from/of/sha256",
        ),
        (
            json!({ "from": { "of": { "raw": 3 }, "iso": 1 } }),
            "from/of/raw",
        ),
        (
            json!({ "from": { "of": { "frame": -1 }, "iso": 1 } }),
            "from/of/frame",
        ),
        (json!({ "from": { "of": {}, "iso": "bone" } }), "from/iso"),
        (json!({ "from": { "of": {}, "iso": [1] } }), "from/iso"),
        (
            json!({ "from": { "of": {}, "segment": 7 } }),
            "from/segment",
        ),
        (
            json!({ "from": { "of": {}, "iso": 1, "walls": 2 } }),
            "from/walls",
        ),
        (json!({ "detail": "fine" }), "detail"),
        (json!({ "detail": [0.1] }), "detail"),
        (json!({ "tools": {} }), "tools"),
        (json!({ "tools": [3] }), "tools/0"),
        (json!({ "tools": [{ "shape": 3 }] }), "tools/0/shape"),
        (json!({ "tools": [{ "radius": [1] }] }), "tools/0/radius"),
        (json!({ "tools": [{ "coat": null }] }), "tools/0/coat"),
        (json!({ "tools": vec![json!({}); 17] }), "tools"),
        (json!({ "strokes": 3 }), "strokes"),
        (
            json!({ "strokes": vec![json!({ "path": [0, 0, 0] }); 2001] }),
            "strokes",
        ),
    ];
    let of_clay = of_clay.map(|(clay, at)| (clay, at.to_owned()));
    for (wrong, at) in of_stroke.into_iter().chain(of_clay) {
        let error = read(wrong).expect_err(&at).to_string();
        assert!(
            error.starts_with(&format!("/subject/clay/{at}: ")),
            "{at}: {error}"
        );
    }
    let error = read(json!([])).expect_err("no object").to_string();
    assert!(error.starts_with("/subject/clay: "), "{error}");
    for number in ["NaN", "1e999", "-Infinity"] {
        let text = r#"{"fabrica":1,"subject":{"clay":{"strokes":[{"path":[0,#,0]}]}}}"#;
        Document::from_json(&text.replace('#', number)).expect_err(number);
    }
    // What fits just so.
    let all = json!({ "tools": vec![json!({}); 16],
        "strokes": vec![json!({ "path": [0, 0, 0], "mirror": "xyz" }); 2000] });
    assert_eq!(right(all).notices(), []);
    let long = json!({ "path": vec![1; 3 * 64], "turns": vec![1; 3 * 64], "scales": vec![50; 64],
        "with": vec![json!({ "path": [0, 0, 0] }); 7] });
    assert_eq!(right(stroked(long)).notices(), []);
}

#[test]
fn everything_comes_back_from_the_canonical_form() {
    let document = right(everything());
    let text = document.to_json_compact();
    let again = Document::from_json(&text).expect("again");
    assert_eq!(again, document);
    assert_eq!(again.to_json_compact(), text);
    assert_eq!(
        document.value()["subject"]["clay"],
        everything(),
        "no key is lost"
    );
    // Defaults are left out, in what is said of every tool too.
    let spoken = right(
        json!({ "tools": [{ "shape": "ball", "coat": 0.1 }], "strokes": [{ "tool": 0, "path": [1, 2, 3], "turns": [],
        "scales": [], "straight": false, "mirror": "", "do": "sweep", "strength": 50, "off": false,
        "with": [{ "tool": 0, "path": [1, 2, 3], "straight": false }] }] }),
    );
    assert_eq!(
        spoken.to_json_compact(),
        r#"{"fabrica":1,"subject":{"clay":{"strokes":[{"path":[1,2,3],"with":[{"path":[1,2,3]}]}],"tools":[{}]}}}"#
    );
}

#[test]
fn an_edit_writes_a_clay_as_it_is() {
    let document = right(everything());
    let subject = document.illustration().subject.clone();
    let edit = Edit::SetSubject(subject.clone());
    let empty = Document::from_value(
        json!({ "fabrica": 1, "subject": { "src": "a.nrrd", "meshes": [{ "src": "b.stl" }] } }),
    );
    let written = edit.apply(&empty.expect("right")).expect("it takes it");
    assert_eq!(written.notices(), []);
    let [before, after] = [&document, &written].map(clay);
    assert_eq!(before.strokes, after.strokes);
    assert_eq!(before.tools[..3], after.tools[..3]);
    assert_eq!((&before.from, before.detail), (&after.from, after.detail));
    // What this version does not know stays where it was.
    let same = edit.apply(&document).expect("it takes it");
    assert_eq!(same.illustration().subject, subject);
    assert!(same.to_json_compact().contains("tooth.stl"));
    let from = json!({ "src": "foot.stl", "name": "Foot", "units": "cm" });
    let file = right(json!({ "from": from }));
    let edit = Edit::SetSubject(file.illustration().subject.clone());
    let written = edit.apply(&document).expect("it takes it");
    assert_eq!(written.illustration().subject, file.illustration().subject);
    assert_eq!(written.value()["subject"]["clay"]["from"], from);
    // Another subject takes its place.
    let cube = SubjectRef::Builtin {
        name: "cube".to_owned(),
        revision: 1,
    };
    let other = Edit::SetSubject(cube).apply(&document).expect("a cube");
    assert_eq!(
        other.to_json_compact(),
        r#"{"fabrica":1,"subject":{"builtin":"cube"}}"#
    );
}

#[test]
fn steps_show_one_stroke_after_the_other() {
    let strokes = vec![json!({ "path": [0, 0, 500] }); 10];
    let of = |strokes: Value, steps: Value| {
        Document::from_value(
            json!({ "fabrica": 1, "subject": { "clay": { "strokes": strokes } },
            "look": { "strokes": 2 }, "steps": steps }),
        )
    };
    let steps = json!([{ "set": { "/look/strokes": 6 } }, { "set": { "/look": {} } }, { "set": { "/look/strokes": 0 } }]);
    let document = of(json!(strokes), steps).expect("right");
    assert_eq!(document.notices(), []);
    assert_eq!(document.illustration().look.strokes, Some(2));
    let shown = |step, part| {
        let illustration = document.at_time(step, part).expect("a step");
        illustration.strokes_shown()
    };
    for (step, part, strokes) in [
        (0, 0.0, 2),
        (1, 0.0, 2),
        (1, 0.5, 4),
        (1, 1.0, 6),
        (2, 0.5, 8),
        (2, 1.0, 10),
        (3, 0.0, 10),
        (3, 0.5, 5),
        (3, 1.0, 0),
    ] {
        assert_eq!(shown(step, part), Some(strokes), "step {step}, {part}");
    }
    let walked: Vec<u32> = (0..=100)
        .filter_map(|i| shown(1, 0.01 * i as f32))
        .collect();
    assert!(
        walked.windows(2).all(|pair| pair[1] - pair[0] <= 1),
        "{walked:?}"
    );
    // At its end a step is what it says.
    let last = document.at_time(2, 1.0).expect("a step");
    assert_eq!(last.look.strokes, None);

    let more = of(json!([]), json!([]))
        .expect("right")
        .illustration()
        .clone();
    assert_eq!(more.strokes_shown(), Some(0), "more than there are is all");
    let refused = of(
        json!(strokes),
        json!([{ "set": { "/subject/clay/detail": 0.1 } }]),
    );
    assert!(refused.is_err(), "no step changes the clay");
    for (wrong, drawn) in [(json!(-1), 0), (json!(2.4), 2), (json!(1e9), 2000)] {
        let look = Document::from_value(json!({ "fabrica": 1, "look": { "strokes": wrong } }));
        let look = look.expect("right");
        assert_eq!(look.illustration().look.strokes, Some(drawn));
        assert_eq!(look.illustration().strokes_shown(), None, "no clay");
        assert_eq!(look.notices().len(), 1);
    }
    let wrong = Document::from_value(json!({ "fabrica": 1, "look": { "strokes": [1] } }));
    let error = wrong.expect_err("a list").to_string();
    assert!(error.starts_with("/look/strokes: "), "{error}");
    let moved =
        Document::from_value(json!({ "fabrica": 1, "controls": [{ "pointer": "/look/strokes" }] }));
    assert_eq!(moved.expect("right").illustration().controls.len(), 1);
}
