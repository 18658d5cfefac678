//! Sweeps: tools and paths as documents write them, limits, hostile input, edits, steps, mirror images.

use crate::displace::MOST_STEPS;
use crate::document::{
    Document, Edit, PlacedTemplate, Plane, SweepTools, TemplateData, ToolFile, ToolShape, mirror,
};
use glam::{Quat, Vec3};
use serde_json::{Value, json};

fn read(params: Value) -> Result<Document, crate::document::DocumentError> {
    let template = json!({ "kind": "sweep", "params": params });
    Document::from_value(json!({ "fabrica": 1, "templates": [template] }))
}

fn tools_of(template: &PlacedTemplate) -> &SweepTools {
    match &template.data {
        TemplateData::Tools(tools) => tools,
        other => panic!("a sweep has tools: {other:?}"),
    }
}

fn tools(document: &Document) -> &SweepTools {
    tools_of(&document.illustration().templates[0])
}

fn notices(document: &Document) -> Vec<String> {
    document.notices().iter().map(ToString::to_string).collect()
}

#[test]
fn a_sweep_of_nothing_said_presses_from_above() {
    let document = read(json!({})).expect("right");
    assert_eq!(tools(&document), &SweepTools::default());
    let said = read(
        json!({ "progress": 1, "mirror": "", "tools": [{ "shape": "ball", "coat": 0.25, "spline": false }] }),
    );
    let said = said.expect("right");
    assert_eq!(tools(&said), tools(&document));
    // The canonical form has what differs from defaults.
    assert!(
        said.to_json_compact()
            .contains(r#""params":{"tools":[{}]}"#)
    );
    let none = read(json!({ "tools": [] })).expect("right");
    assert_eq!(tools(&none).tools, []);
    assert!(
        none.to_json_compact().contains(r#""tools":[]"#),
        "no tool is not one tool"
    );
}

#[test]
fn every_shape_has_its_own_numbers() {
    let of =
        |tool: Value| tools(&read(json!({ "tools": [tool] })).expect("right")).tools[0].clone();
    for name in ToolShape::NAMES {
        let shape = of(json!({ "shape": name })).shape;
        assert_eq!(shape, ToolShape::named(name), "{name}");
    }
    let shape = of(json!({ "shape": "capsule", "radius": 0.3 })).shape;
    let expected = ToolShape::Capsule {
        radius: 0.3,
        length: 0.4,
    };
    assert_eq!(shape, Some(expected));
    let path =
        of(json!({ "path": [[0, 0, 9], { "at": [1, 1, 1], "rotate": [0, 0, 1, 0], "scale": 2 }] }))
            .path;
    assert_eq!(path[0].at, Vec3::new(0.0, 0.0, 9.0));
    assert_eq!(
        (path[1].rotate, path[1].scale),
        (Quat::from_xyzw(0.0, 0.0, 1.0, 0.0), 2.0)
    );
}

#[test]
fn values_out_of_range_are_drawn_at_its_end_and_named() {
    let document = read(json!({ "progress": 3, "mirror": "xq", "tools": [
        { "radius": 9, "coat": 0 }, { "shape": "mesh", "src": "a.stl", "longest": 1 },
        { "shape": "box", "half": [0.1, 0.2, 0.3], "round": 0.5 },
        { "shape": "curve", "points": [[0, 0, 0], [0, 0, 9]], "path": [{ "scale": 100 }, [0, 0, -20]] }, {}] }))
    .expect("right");
    let said = notices(&document).join("\n");
    for part in [
        "tools/0/radius",
        "tools/0/coat",
        "tools/2/round",
        "tools/3/points/1",
        "tools/3/path/0/scale",
        "tools/3/path/1",
        "params/tools: 5",
        "params/progress",
        "params/mirror",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    let held = tools(&document);
    assert_eq!(held.tools.len(), 4);
    let mesh = ToolShape::Mesh {
        file: ToolFile {
            src: Some("a.stl".to_owned()),
            ..ToolFile::default()
        },
        longest: 1.0,
    };
    assert_eq!(held.tools[1].shape, Some(mesh));
    assert_eq!(
        held.tools[2].shape,
        Some(ToolShape::Box {
            half: Vec3::new(0.1, 0.2, 0.3),
            round: 0.1
        })
    );
    assert!(document.to_json_compact().contains(r#""longest":1"#));
}

#[test]
fn meshes_as_tools_are_read_limited_and_written() {
    let hash = "AB".repeat(32);
    let document = read(json!({ "tools": [
        { "shape": "mesh", "sha256": hash, "name": "tooth" }, { "shape": "mesh", "longest": 9 },
        { "shape": "clay", "strokes": 3, "later": 1 }] }))
    .expect("right");
    let said = notices(&document).join("\n");
    for part in [
        "tools/1: a mesh of which no file is named",
        "tools/1/longest: 9",
        "tools/2/shape",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    let held = tools(&document);
    let file = |i: usize| held.tools[i].shape.as_ref().and_then(ToolShape::file);
    let named = file(0).expect("a mesh");
    assert_eq!(named.key(), Some(&*"ab".repeat(32)));
    assert_eq!((named.name.as_str(), &named.src), ("tooth", &None));
    assert_eq!(
        held.tools[0].shape.as_ref().map(ToolShape::numbers),
        Some(vec![0.4])
    );
    assert_eq!(file(1).expect("a mesh").key(), None);
    assert_eq!(held.tools[2].shape, None, "a sweep knows no clay");
    // Written by an edit as it was read; another shape has no file.
    let mut other = held.clone();
    other.tools[0].coat = 0.5;
    other.tools[1].shape = ToolShape::named("ball");
    let edit = Edit::SetTools {
        template: 0,
        tools: other.clone(),
    };
    let after = edit.apply(&document).expect("it takes them");
    assert_eq!(tools(&after), &other);
    let text = after.to_json_compact();
    assert!(
        text.contains(r#""name":"tooth""#) && text.contains(r#""later":1"#),
        "{text}"
    );
    // A mesh has no mirror image that a document could name.
    let template = &document.illustration().templates[0];
    assert_eq!(mirror(template, Plane::Sagittal, true), []);
}

#[test]
fn what_is_no_file_of_a_tool_is_refused_by_its_pointer() {
    for (tool, at) in [
        (json!({ "shape": "mesh", "src": 3 }), "/tools/0/src"),
        (
            json!({ "shape": "mesh", "sha256": "abc" }),
            "/tools/0/sha256",
        ),
        (
            json!({ "shape": "mesh", "src": "a.stl", "name": [] }),
            "/tools/0/name",
        ),
        (
            json!({ "shape": "mesh", "src": "a.stl", "longest": null }),
            "/tools/0/longest",
        ),
    ] {
        let error = read(json!({ "tools": [tool] }))
            .expect_err("wrong")
            .to_string();
        assert!(error.contains(at), "{error}");
    }
}

#[test]
fn the_seventeenth_mesh_is_left_out_and_named() {
    let sweep = |from: usize| {
        let tools = (from..from + 4).map(|i| json!({ "shape": "mesh", "src": format!("{i}.stl") }));
        json!({ "kind": "sweep", "params": { "tools": tools.collect::<Vec<_>>() } })
    };
    let mut templates: Vec<Value> = (0..4).map(|i| sweep(4 * i)).collect();
    // Two more, and one that is known.
    templates.push(json!({ "kind": "sweep", "params": { "tools": [
        { "shape": "mesh", "src": "16.stl" }, { "shape": "mesh", "src": "3.stl" }, { "shape": "mesh", "src": "17.stl" }] } }));
    let document =
        Document::from_value(json!({ "fabrica": 1, "templates": templates })).expect("right");
    let pointers: Vec<&str> = document
        .notices()
        .iter()
        .map(|n| n.pointer.as_str())
        .collect();
    assert_eq!(
        pointers,
        ["/templates/4/params/tools/0", "/templates/4/params/tools/2"]
    );
    let last = &document.illustration().templates[4];
    let TemplateData::Tools(held) = &last.data else {
        panic!("tools");
    };
    let keys = held
        .tools
        .iter()
        .map(|tool| tool.shape.as_ref()?.file()?.key());
    assert_eq!(keys.collect::<Vec<_>>(), [None, Some("3.stl"), None]);
}

#[test]
fn what_is_no_sweep_is_refused_by_its_pointer() {
    for (wrong, at) in [
        (json!({ "tools": 3 }), "/params/tools"),
        (json!({ "tools": [3] }), "/tools/0"),
        (json!({ "tools": [{ "shape": 3 }] }), "/tools/0/shape"),
        (json!({ "tools": [{ "radius": [1] }] }), "/tools/0/radius"),
        (
            json!({ "tools": [{ "shape": "ellipsoid", "radii": 1 }] }),
            "/tools/0/radii",
        ),
        (
            json!({ "tools": [{ "shape": "curve", "points": [[0, 0, 0]] }] }),
            "/tools/0/points",
        ),
        (json!({ "tools": [{ "path": [] }] }), "/tools/0/path"),
        (
            json!({ "tools": [{ "path": [[0, 0]] }] }),
            "/tools/0/path/0",
        ),
        (
            json!({ "tools": [{ "path": [{ "at": [0, null, 0] }] }] }),
            "/path/0/at",
        ),
        (
            json!({ "tools": [{ "path": ["here"] }] }),
            "/tools/0/path/0",
        ),
        (json!({ "mirror": 1 }), "/params/mirror"),
        (json!({ "progress": "all" }), "/params/progress"),
    ] {
        let error = read(wrong.clone()).expect_err("refused").to_string();
        assert!(error.contains(at), "{wrong}: {error}");
    }
}

#[test]
fn images_that_do_not_all_fit_are_left_out() {
    let document = read(json!({ "mirror": "xyz", "tools": [{}, {}] })).expect("right");
    assert_eq!(tools(&document).acting().count(), 1);
    assert!(
        notices(&document)
            .join("\n")
            .contains("/params/tools/1: more than eight tools")
    );
    let document = read(json!({ "mirror": "x", "tools": [{}, {}, {}, {}] })).expect("right");
    assert_eq!(
        (tools(&document).acting().count(), document.notices().len()),
        (4, 0)
    );
}

#[test]
fn a_document_has_so_many_pieces_and_steps_and_no_more() {
    let long = |keys: usize| {
        let path: Vec<Value> = (0..keys)
            .map(|i| json!([0.5, 0.5, 0.5 + 0.01 * (i % 2) as f64]))
            .collect();
        json!({ "kind": "sweep", "params": { "tools": [{ "coat": 1, "path": path }] } })
    };
    let of = |templates: Vec<Value>| {
        Document::from_value(json!({ "fabrica": 1, "templates": templates })).expect("right")
    };
    let fits = of(vec![long(64), long(64), long(64), long(64), long(5)]);
    assert_eq!(fits.notices(), [], "4 · 63 + 4 are 256");
    let over = of(vec![
        long(64),
        long(64),
        long(64),
        long(64),
        long(6),
        long(5),
    ]);
    let out: Vec<bool> = over
        .illustration()
        .templates
        .iter()
        .map(|t| tools_of(t).is_left_out)
        .collect();
    assert_eq!(out, [false, false, false, false, true, false]);
    assert!(
        notices(&over)[0].contains("/templates/4"),
        "{:?}",
        over.notices()
    );
    // 2,000 coats.
    let far = json!({ "kind": "sweep", "params": { "tools": [{ "coat": 0.01, "path": [[0, 0, 0], [10, 10, 10]] }] } });
    let far = of(vec![far]);
    assert!(tools(&far).is_left_out);
    assert_eq!(far.notices().len(), 1);
}

#[test]
fn an_edit_keeps_what_it_does_not_know() {
    let document = read(
        json!({ "tools": [{ "shape": "cloud", "src": "a.stl" }, { "later": [1], "path": [[0, 0, 0]] }] }),
    );
    let document = document.expect("right");
    let mut held = tools(&document).clone();
    assert_eq!(held.acting().count(), 1, "what is not drawn does not act");
    held.mirror = [true, false, true];
    held.tools[1].coat = 0.5;
    held.tools[1].path[0].scale = 2.0;
    let edit = Edit::SetTools {
        template: 0,
        tools: held.clone(),
    };
    let after = edit.apply(&document).expect("it takes them");
    assert_eq!(tools(&after), &held);
    let text = after.to_json_compact();
    assert!(
        text.contains(r#""src":"a.stl""#) && text.contains(r#""later":[1]"#),
        "{text}"
    );
    assert!(text.contains(r#""mirror":"xz""#), "{text}");
}

#[test]
fn tools_ease_from_step_to_step() {
    let document = Document::from_value(
        json!({ "fabrica": 1, "templates": [{ "kind": "sweep", "params": {
        "tools": [{ "radius": 0.1, "path": [[0, 0, 0], { "at": [1, 0, 0], "scale": 1 }] }] } }],
        "steps": [{ "set": { "/templates/0/params/tools/0/radius": 0.3,
            "/templates/0/params/tools/0/path/1": { "at": [0, 1, 0], "scale": 4 } } },
            { "set": { "/templates/0/params/tools": [{}, {}] } }] }),
    );
    let document = document.expect("right");
    let middle = document.at_time(1, 0.5).expect("a step");
    let tool = &tools_of(&middle.templates[0]).tools[0];
    let radius = tool.shape.as_ref().map_or(0.0, |shape| shape.numbers()[0]);
    assert!((radius - 0.2).abs() < 1e-6, "{radius}");
    assert!(tool.path[1].at.distance(Vec3::new(0.5, 0.5, 0.0)) < 1e-6);
    assert!((tool.path[1].scale - 2.0).abs() < 1e-5, "geometrically");
    // Other tools: at once.
    let early = document.at_time(2, 0.01).expect("a step");
    assert_eq!(tools_of(&early.templates[0]).tools.len(), 2);
}

#[test]
fn a_mirrored_sweep_is_seen_in_the_mirror() {
    let document = read(
        json!({ "tools": [{ "shape": "curve", "points": [[0.1, 0, 0], [0.2, 0.3, 0]],
        "path": [[0.2, 0.3, 0.4], { "at": [0.5, 0.5, 0.5], "rotate": [0.5, 0.5, 0.5, 0.5] }] }] }),
    );
    let document = document.expect("right");
    let edits = mirror(&document.illustration().templates[0], Plane::ALL[0], false);
    let name = String::new();
    let other = Edit::All { name, edits }
        .apply(&document)
        .expect("a mirror");
    let (a, b) = (&tools(&document).tools[0], &tools(&other).tools[0]);
    let flip = Vec3::new(-1.0, 1.0, 1.0);
    let points =
        |tool: &crate::document::SweepTool| tool.shape.as_ref().map(|s| s.points().to_vec());
    let [points_a, points_b] = [a, b].map(|tool| points(tool).expect("a curve"));
    for ((a_key, b_key), (p, q)) in a
        .path
        .iter()
        .zip(&b.path)
        .zip(points_a.iter().zip(&points_b))
    {
        // Where a point of the tool is, from the middle of the box.
        let place = a_key.at - 0.5 + a_key.rotate * *p;
        let image = b_key.at - 0.5 + b_key.rotate * *q;
        assert!((place * flip).distance(image) < 1e-4);
    }
}

/// A thin coating in the way of a wide one asks for many more steps than the limit counts.
#[test]
fn all_sweeps_of_a_document_share_the_steps_that_are_done() {
    let sweep = json!({ "kind": "sweep", "size": [1, 1, 1], "params": { "tools": [
        { "coat": 2, "path": [[-3.5, 0.5, 0.5], [4.5, 0.5, 0.5]] },
        { "radius": 0.005, "coat": 0.01, "path": [[0.5, 0.5, 0.5]] }] } });
    let document =
        Document::from_value(json!({ "fabrica": 1, "templates": vec![sweep; 32] })).expect("right");
    assert_eq!(document.notices(), [], "each counts for 32 steps");
    let templates = &document.illustration().templates;
    let shares: Vec<usize> = templates.iter().map(|t| tools_of(t).most_steps).collect();
    assert!(shares.iter().all(|share| *share >= 32), "{shares:?}");
    assert!(
        shares.iter().sum::<usize>() <= MOST_STEPS + 32,
        "{shares:?}"
    );
}

#[test]
fn a_pointer_makes_what_stands_at_its_default() {
    for (params, pointer, value) in [
        (json!({}), "coat", json!(0.5)),
        (json!({}), "path/1/0", json!(0.9)),
        (
            json!({ "tools": [{ "shape": "ellipsoid", "radii": [0.2, 0.15, 0.1] }] }),
            "radii/0",
            json!(0.3),
        ),
        (
            json!({ "tools": [{ "shape": "box" }] }),
            "half/1",
            json!(0.3),
        ),
        (
            json!({ "tools": [{ "path": [[0, 0, 0], { "at": [1, 0, 0], "scale": 2 }] }] }),
            "path/1/rotate/2",
            json!(1),
        ),
    ] {
        let pointer = format!("/templates/0/params/tools/0/{pointer}");
        let document = Document::from_value(json!({ "fabrica": 1,
            "templates": [{ "kind": "sweep", "params": params }], "steps": [{ "set": { &pointer: value } }] }));
        let document = document.expect("right");
        assert_eq!(document.notices(), [], "{pointer}");
        let step = document.at_time(1, 1.0).expect("a step");
        assert_ne!(tools_of(&step.templates[0]), tools(&document), "{pointer}");
    }
}

#[test]
fn what_is_beyond_the_tools_that_are_drawn_stays() {
    let document = read(json!({ "tools": [{}, {}, {}, {}, { "coat": 1.5 }] })).expect("right");
    let mut held = tools(&document).clone();
    held.tools[0].shape = ToolShape::named("ellipsoid");
    let edit = Edit::SetTools {
        template: 0,
        tools: held.clone(),
    };
    let after = edit.apply(&document).expect("it takes them");
    assert!(after.to_json_compact().contains(r#""coat":1.5"#));
    // Of another shape only its own numbers are left.
    held.tools[0].shape = ToolShape::named("ball");
    let edit = Edit::SetTools {
        template: 0,
        tools: held,
    };
    let text = edit.apply(&after).expect("it takes them").to_json_compact();
    assert!(!text.contains("radii"), "{text}");
}
