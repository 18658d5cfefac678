//! `figure`: defaults, ranges, faults and notices, and figures that cross to a worker.

use super::{document, error, notices};
use crate::document::figure::{
    Behind, Context, Contour, Figure, Flood, Handle, Hold, Move, Propagation, Region, Rest,
    Rigidity, Rotations, Source,
};
use crate::document::schema::{self, Kind};
use crate::document::{
    DRAWN_FIGURES, Document, SubjectRef, figure_from_text, figure_to_text, pointer,
};
use glam::{DVec2, dvec2};
use serde_json::{Value, json};
use std::f64::consts::PI;

fn with_figure(figure: Value) -> Document {
    document(with(figure))
}

pub(super) fn with(figure: Value) -> Value {
    json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "figure": figure })
}

fn figure(value: Value) -> Figure {
    let document = with_figure(value);
    assert_eq!(notices(&document), [""; 0]);
    document.illustration().figure.clone().unwrap_or_default()
}

fn region(value: Value) -> Region {
    figure(json!({ "regions": [value] })).regions.remove(0)
}

fn handle(value: Value) -> Handle {
    figure(json!({ "handles": [value] })).handles.remove(0)
}

/// What stands under `figure` in canonical form.
fn canonical(figure: Value) -> String {
    let document = with_figure(figure);
    let value = document.get("/figure").cloned().unwrap_or(json!({}));
    let mut text = String::new();
    crate::document::write::json::write_compact(&value, &mut text);
    text
}

pub(super) fn points(count: usize) -> Value {
    (0..count).map(|i| json!([i, i * i])).collect()
}

/// A figure with every key, none at its default.
pub(super) fn full() -> Value {
    json!({
        "regions": [
            { "name": "femur", "from": { "flood": { "at": [[0.1, 0.2]], "tolerance": 12, "gap": 2.5, "connected": false } },
              "fill": false, "grow": 1, "least": 4, "smooth": 2, "rigidity": "rigid", "fixed": true, "order": -1.5, "cut": true,
              "behind": "#a0b0c0", "hide": true },
            { "name": "skin", "from": { "polygon": [[0, 0], [1, 0], [1, 1]] }, "rigidity": [2, 3], "behind": "smooth" },
            { "name": "disc", "from": { "path": "disc-7" }, "rigidity": 4 },
            { "name": "spine", "from": { "path": 7 } },
        ],
        "handles": [
            { "name": "wrist", "at": [0.3, -0.1], "enabled": false, "scale": 2, "move": [0.05, 0.2], "radius": 0.02, "turn": 0.6 },
            { "region": "femur", "turn": -0.4 },
            { "to": [[0, 0], [0.1, 0.02]], "points": [[0, 0], [0.1, 0]] },
        ],
        "only": [[-0.2, 0], [0.4, 0], [0.4, 0.5]],
        "propagation": "gaussian", "reach": 0.5, "rotations": "propagated",
        "context": { "amount": 0.5, "keep": false, "points": [[0, 0.1], [0.1, 0.2], [-0.1, 0.2]], "strength": 7,
                     "like": [[0, 0], [100, 200], [-100, 200]] },
        "contours": [{ "amount": 0.25, "keep": [[0, 0.2]], "like": [[0, 0], [1, 0], [1, 1]], "mirror": true, "region": "skin" }],
        "rest": "keep", "detail": 8000,
    })
}

#[test]
fn every_key_is_read() {
    let read = figure(full());
    let regions = &read.regions;
    assert_eq!(
        regions[0],
        Region {
            name: "femur".to_owned(),
            from: Some(Source::Flood(Flood {
                at: vec![dvec2(0.1, 0.2)],
                tolerance: 12.0,
                gap: 2.5,
                connected: false,
            })),
            grow: 1.0,
            smooth: 2.0,
            fill: Some(false),
            least: 4,
            rigidity: Rigidity::Rigid,
            fixed: true,
            order: -1.5,
            cut: true,
            behind: Behind::Color([0xa0, 0xb0, 0xc0]),
            hide: true,
            given: Vec::new(),
        }
    );
    let square = vec![DVec2::ZERO, DVec2::X, DVec2::ONE];
    assert_eq!(regions[1].from, Some(Source::Polygon(square.clone())));
    assert_eq!(regions[1].rigidity, Rigidity::Elastic([2.0, 3.0]));
    assert_eq!(regions[1].behind, Behind::Smooth);
    assert_eq!(regions[2].from, Some(Source::Path("disc-7".to_owned())));
    assert_eq!(regions[2].rigidity, Rigidity::Elastic([4.0; 2]));
    assert_eq!(regions[3].from, Some(Source::Path("7".to_owned())));
    let wrist = &read.handles[0];
    assert_eq!(
        (wrist.name.as_deref(), wrist.radius, wrist.enabled),
        (Some("wrist"), 0.02, false)
    );
    assert_eq!(wrist.hold, Hold::Point(dvec2(0.3, -0.1)));
    let motion = Move {
        by: dvec2(0.05, 0.2),
        turn: Some(0.6),
        scale: 2.0,
    };
    assert_eq!(wrist.motion, motion);
    assert_eq!(read.handles[1].hold, Hold::Region("femur".to_owned()));
    let line = Hold::Line {
        points: vec![DVec2::ZERO, dvec2(0.1, 0.0)],
        to: Some(vec![DVec2::ZERO, dvec2(0.1, 0.02)]),
    };
    assert_eq!(read.handles[2].hold, line);
    assert_eq!(read.only.map(|only| only.len()), Some(3));
    assert_eq!(
        (read.propagation, read.rotations),
        (Propagation::Gaussian, Rotations::Propagated)
    );
    assert_eq!(
        (read.reach, read.rest, read.detail),
        (0.5, Rest::Keep, 8000)
    );
    let context = read.context.expect("a context");
    assert_eq!(
        context.like,
        Some(vec![DVec2::ZERO, dvec2(100.0, 200.0), dvec2(-100.0, 200.0)])
    );
    assert_eq!(
        (context.strength, context.keep, context.amount),
        (7.0, false, 0.5)
    );
    let contour = Contour {
        region: "skin".to_owned(),
        like: square,
        amount: 0.25,
        mirror: true,
        keep: vec![dvec2(0.0, 0.2)],
    };
    assert_eq!(read.contours, [contour]);
}

#[test]
fn defaults_are_filled_in_and_left_out() {
    let bare = document(json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" } }));
    assert_eq!(bare.illustration().figure, None);
    let plain = json!({ "regions": [], "handles": [], "only": [], "propagation": "harmonic", "reach": 0, "rotations": "found",
        "context": { "points": [], "strength": 5, "keep": true, "like": [], "amount": 1 }, "contours": [], "rest": "bend",
        "detail": 6000 });
    for nothing in [json!({}), plain] {
        let document = with_figure(nothing);
        assert_eq!(
            document.to_json_compact(),
            r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{}}"#
        );
        let figure = document.illustration().figure.as_ref();
        assert_eq!(figure, Some(&Figure::default()));
        assert_eq!(notices(&document), [""; 0]);
    }
    // Of each part what a short one means, and that a long one is written so.
    let cases = [
        (
            json!({ "regions": [{ "from": { "path": "a" }, "name": "", "grow": 0, "smooth": 1.5, "least": 16, "rigidity": 1, "fixed": false, "order": 0,
                "cut": false, "behind": "none", "hide": false }, { "from": { "path": "b" }, "rigidity": [1, 1.0] }] }),
            r#"{"regions":[{"from":{"path":"a"}},{"from":{"path":"b"}}]}"#,
        ),
        (
            json!({ "regions": [{ "from": { "flood": { "at": [[0, 0]], "tolerance": 24, "gap": 0, "connected": true } } }] }),
            r#"{"regions":[{"from":{"flood":{"at":[[0,0]]}}}]}"#,
        ),
        (
            json!({ "handles": [{ "at": [0, 0], "name": "", "radius": 0.01, "move": [0, 0], "turn": null, "scale": 1, "enabled": true },
                { "region": "", "turn": 0 }, { "points": [[0, 0], [1, 1]], "turn": 0 }, { "at": [0, 0], "turn": 0 }] }),
            r#"{"handles":[{"at":[0,0]},{"region":""},{"points":[[0,0],[1,1]]},{"at":[0,0],"turn":0}]}"#,
        ),
        (
            json!({ "context": { "points": [[0, 0], [0, 1], [1, 0]], "like": [], "strength": 5 } }),
            r#"{"context":{"points":[[0,0],[0,1],[1,0]]}}"#,
        ),
        (
            json!({ "contours": [{ "region": "", "amount": 1, "mirror": false, "keep": [], "like": [[0, 0], [0, 1], [1, 0]] }] }),
            r#"{"contours":[{"like":[[0,0],[0,1],[1,0]]}]}"#,
        ),
    ];
    for (long, short) in cases {
        assert_eq!(canonical(long.clone()), short);
        let short = serde_json::from_str(short).expect("JSON");
        assert_eq!(figure(long), figure(short));
    }
    let names: Vec<String> = figure(json!({ "regions": [{}, { "name": "a" }, {}] }))
        .regions
        .into_iter()
        .map(|region| region.name)
        .collect();
    assert_eq!(names, ["region 1", "a", "region 3"]);
    assert_eq!(region(json!({})), Region::new("region 1"));
    assert_eq!(
        handle(json!({ "at": [0.1, 0] })),
        Handle::pin(dvec2(0.1, 0.0), DVec2::ZERO)
    );
    assert_eq!(
        handle(json!({ "region": "a" })).motion.turn,
        Some(0.0),
        "open is the turn of a point alone"
    );
    assert_eq!(
        handle(json!({ "at": [0, 0], "turn": 0 })).motion.turn,
        Some(0.0)
    );
    assert!(region(json!({})).fills_holes() && !region(json!({ "hide": true })).fills_holes());
    assert!(region(json!({ "hide": true, "fill": true })).fills_holes());
    // Numbers that are the default in 32 bits are none.
    for text in [
        r#"{"reach":1e-50}"#,
        r#"{"handles":[{"at":[0,0],"move":[0,1e-60],"radius":0.010000000000000002}]}"#,
        r#"{"handles":[{"region":"a","turn":1e-300}]}"#,
        r#"{"regions":[{"order":5e-324,"rigidity":1.0000000000000002,"smooth":1.5000000000000002}]}"#,
    ] {
        assert_eq!(canonical(serde_json::from_str(text).expect("JSON")), text);
    }
}

#[test]
fn figures_are_written_byte_for_byte() {
    let plain = r#"{"fabrica":1,"subject":{"builtin":"drawn-foot"},"#;
    for figure in [
        r##"{"context":{"amount":0.1,"keep":false,"like":[[0,0],[1,2],[-1,2]],"points":[[0,0.1],[0.1,0.2],[-0.1,0.2]],"strength":1},"detail":500,"handles":[{"name":"a","at":[0.1,0],"enabled":false,"scale":2,"move":[1,0],"radius":0.2,"turn":12.566370614359172},{"region":"b"},{"to":[[0,0],[1,1]],"points":[[0,0],[1,0]]}],"only":[[0,0],[1,0],[0,1]],"propagation":"linear","reach":2,"regions":[{"name":"b","order":-100,"from":{"flood":{"at":[[0,0]],"gap":16}},"behind":"#abc","cut":true,"fill":true,"fixed":true,"grow":-32,"hide":true,"least":0,"rigidity":[0.1,100],"smooth":0},{"from":{"path":0}},{"from":{"path":"a/b"}},{"from":{"polygon":[[0,0],[1,0],[0.30000000000000004,1]]}}],"rest":"drop","rotations":"propagated"}"##,
        r#"{"contours":[{"like":[[0,0],[1,0],[0,1]],"region":"b"}]}"#,
        // What is unknown, or not drawn, stays.
        r#"{"handles":[{"at":[0,0],"to":[[0,0],[1,1]],"later":1}],"propagation":"dual","regions":[{"from":{"lasso":[1]},"behind":"rough","rigidity":"stiff"}],"rest":"fly","x":{"order":1,"a":2}}"#,
        r#"{"handles":[{"to":[[0,0],[1,1]],"move":[1,1],"points":[[0,0],[1,0]],"turn":1}]}"#,
    ] {
        let text = format!(r#"{plain}"figure":{figure}}}"#);
        let document = Document::from_json(&text).expect("a document");
        assert_eq!(
            document.to_json_compact(),
            format!(r#"{plain}"figure":{figure}}}"#)
        );
        let again = Document::from_json(&document.to_json()).expect("a document");
        assert_eq!(again, document);
        assert_eq!(again.illustration(), document.illustration());
    }
}

#[test]
fn values_outside_their_range_are_clamped_and_named() {
    // The key in a part; a value below and what is drawn, a value above and what is drawn.
    let number = |at: &str, [low, high]: [f64; 2]| (at.to_owned(), low, high);
    let table = [
        number("/reach", [0.0, 2.0]),
        number("/detail", [500.0, 60_000.0]),
        number("/regions/0/grow", [-32.0, 32.0]),
        number("/regions/0/smooth", [0.0, 32.0]),
        number("/regions/0/least", [0.0, 1e6]),
        number("/regions/0/rigidity", [0.1, 100.0]),
        number("/regions/1/rigidity/0", [0.1, 100.0]),
        number("/regions/1/rigidity/1", [0.1, 100.0]),
        number("/regions/0/order", [-100.0, 100.0]),
        number("/regions/0/from/flood/tolerance", [0.0, 255.0]),
        number("/regions/0/from/flood/gap", [0.0, 16.0]),
        number("/regions/0/from/flood/at/0/0", [-1e4, 1e4]),
        number("/regions/1/from/polygon/2/1", [-1e4, 1e4]),
        number("/handles/0/at/1", [-1e4, 1e4]),
        number("/handles/0/radius", [0.001, 0.2]),
        number("/handles/0/move/0", [-4.0, 4.0]),
        number("/handles/0/move/1", [-4.0, 4.0]),
        number("/handles/0/scale", [0.05, 20.0]),
        number("/handles/0/turn", [-4.0 * PI, 4.0 * PI]),
        number("/handles/1/turn", [-4.0 * PI, 4.0 * PI]),
        number("/handles/2/points/1/0", [-1e4, 1e4]),
        number("/handles/2/to/1/0", [-1e4, 1e4]),
        number("/only/0/0", [-1e4, 1e4]),
        number("/context/points/0/0", [-1e4, 1e4]),
        number("/context/like/0/0", [-1e9, 1e9]),
        number("/context/strength", [0.0, 10.0]),
        number("/context/amount", [0.0, 1.0]),
        number("/contours/0/like/0/0", [-1e9, 1e9]),
        number("/contours/0/amount", [0.0, 1.0]),
        number("/contours/0/keep/0/0", [-1e4, 1e4]),
    ];
    for (at, low, high) in table {
        for (drawn, written) in [
            (low, low - 1.0 - low.abs() / 8.0),
            (low, -1e300),
            (high, high + 1.0 + high / 8.0),
            (high, 1e300),
        ] {
            let set = |value: f64| {
                let mut figure = full();
                if at.starts_with("/regions/0/rigidity") {
                    figure["regions"][0]["rigidity"] = json!(1);
                }
                *figure.pointer_mut(&at).expect("it is there") = json!(value);
                with_figure(figure)
            };
            let wrong = set(written);
            let told = notices(&wrong);
            assert_eq!(told.len(), 1, "{at} {written}: {told:?}");
            assert!(told[0].starts_with("/figure/"), "{told:?}");
            // A list of two is named as a whole.
            let named = told[0].split(": ").next().unwrap_or_default();
            assert!(format!("/figure{at}").starts_with(named), "{at}: {told:?}");
            assert!(told[0].contains("is outside the range"), "{told:?}");
            let right = set(drawn);
            assert_eq!(notices(&right), [""; 0], "{at} {drawn}");
            assert_eq!(wrong.illustration(), right.illustration(), "{at}");
            let kept = wrong.get(&format!("/figure{at}")).and_then(Value::as_f64);
            assert_eq!(kept, Some(written), "kept");
        }
    }
    let rounded = with_figure(json!({ "detail": 1000.5, "regions": [{ "least": 2.4 }] }));
    let figure = rounded.illustration().figure.clone().expect("a figure");
    assert_eq!((figure.detail, figure.regions[0].least), (1001, 2));
    let told = notices(&with_figure(
        json!({ "handles": [{ "at": [0, 0], "turn": 20 }] }),
    ));
    let message = "/figure/handles/0/turn: 20 is outside the range; 12.566371 is drawn";
    assert_eq!(told, [message]);
}

#[test]
fn unknown_values_are_kept_and_the_default_is_drawn() {
    let unknown = with_figure(
        json!({ "propagation": "dual", "rotations": "lost", "rest": "fly", "later": 1, "detail": 700,
        "regions": [{ "rigidity": "stiff", "behind": "rough", "later": 1, "from": { "lasso": [] } }],
        "handles": [{ "at": [0, 0], "later": 1 }], "context": { "later": 1 }, "contours": [{ "like": points(3), "later": 1 }] }),
    );
    let figure = unknown.illustration().figure.clone().expect("a figure");
    let like = figure.contours[0].like.clone();
    let drawn = Figure {
        regions: vec![Region {
            given: vec!["rigidity", "behind"],
            ..Region::new("region 1")
        }],
        handles: vec![Handle::pin(DVec2::ZERO, DVec2::ZERO)],
        contours: vec![Contour {
            region: String::new(),
            like,
            amount: 1.0,
            mirror: false,
            keep: Vec::new(),
        }],
        detail: 700,
        ..Figure::default()
    };
    assert_eq!(figure, drawn);
    let told = notices(&unknown);
    let wanted = [
        "/figure/later: this version does not know this key; it is kept",
        "/figure/regions/0/later: this version does not know this key; it is kept",
        "/figure/regions/0/from/lasso: this version does not know this key; it is kept",
        "/figure/regions/0/rigidity: this version does not know “stiff”; it is kept, 1 is drawn",
        "/figure/regions/0/behind: this version does not know “rough”; it is kept, none is drawn",
        "/figure/handles/0/later: this version does not know this key; it is kept",
        "/figure/propagation: this version does not know “dual”; it is kept, harmonic is drawn",
        "/figure/rotations: this version does not know “lost”; it is kept, found is drawn",
        "/figure/context/later: this version does not know this key; it is kept",
        "/figure/contours/0/later: this version does not know this key; it is kept",
        "/figure/rest: this version does not know “fly”; it is kept, bend is drawn",
    ];
    assert_eq!(told, wanted);
    let aside = with_figure(json!({ "handles": [
        { "points": [[0, 0], [1, 0]], "to": [[0, 0], [0, 1]], "move": [1, 1], "scale": 2 }, { "at": [0, 0], "to": [[0, 0], [0, 1]] }] }));
    let told = notices(&aside);
    let wanted = [
        "/figure/handles/0/move: `to` is shown; this is kept, left aside",
        "/figure/handles/0/scale: `to` is shown; this is kept, left aside",
        "/figure/handles/1/to: `move` is shown; this is kept, left aside",
    ];
    assert_eq!(told, wanted);
}

#[test]
fn faults_are_named_by_their_pointers() {
    let many = |n: usize, entry: Value| Value::Array(vec![entry; n]);
    let flood = |n: usize| json!({ "from": { "flood": { "at": points(n) } } });
    let table = [
        (
            json!({ "handles": [{ "at": [0, 0] }, {}] }),
            "/figure/handles/1: expected exactly one of `at`, `region` and `points`, found none of them",
        ),
        (
            json!({ "handles": [{ "at": [0, 0], "region": "a" }] }),
            "/figure/handles/0: expected exactly one of `at`, `region` and `points`, found `at` and `region`",
        ),
        (
            json!({ "handles": [{ "at": [0, 0], "region": "a", "points": points(2) }] }),
            "/figure/handles/0: expected exactly one of `at`, `region` and `points`, found `at` and `region` and `points`",
        ),
        (
            json!({ "handles": [{ "points": points(3), "to": points(2) }] }),
            "/figure/handles/0/to: 2 points, but `points` has 3",
        ),
        (
            json!({ "handles": [{ "points": points(3), "to": [] }] }),
            "/figure/handles/0/to: 0 points, but `points` has 3",
        ),
        (
            json!({ "handles": [{ "points": points(1) }] }),
            "/figure/handles/0/points: 1 points, at least 2 are needed",
        ),
        (
            json!({ "handles": [{ "points": points(33) }] }),
            "/figure/handles/0/points: 33 points, at most 32 are allowed",
        ),
        (
            json!({ "handles": many(65, json!({ "at": [0, 0] })) }),
            "/figure/handles: 65 handles, at most 64 are allowed",
        ),
        (
            json!({ "regions": many(65, json!({})) }),
            "/figure/regions: 65 regions, at most 64 are allowed",
        ),
        (
            json!({ "regions": [{ "name": "a" }, { "name": "a" }] }),
            "/figure/regions/1/name: “a” is taken; regions have names of their own",
        ),
        (
            json!({ "regions": [{ "name": "region 2" }, {}] }),
            "/figure/regions/1: “region 2” is taken; regions have names of their own",
        ),
        (
            json!({ "regions": [{ "name": "rest" }] }),
            "/figure/regions/0/name: “rest” is taken; regions have names of their own",
        ),
        (
            json!({ "regions": [{ "from": {} }] }),
            "/figure/regions/0/from: expected exactly one of `flood`, `polygon` and `path`, found none of them",
        ),
        (
            json!({ "regions": [{ "from": { "path": 1, "polygon": points(3) } }] }),
            "/figure/regions/0/from: expected exactly one of `flood`, `polygon` and `path`, found `polygon` and `path`",
        ),
        (
            json!({ "regions": [{ "from": { "path": -1 } }] }),
            "/figure/regions/0/from/path: expected an element's id or the number of a shape, found -1",
        ),
        (
            json!({ "regions": [{ "from": { "path": 1.5 } }] }),
            "/figure/regions/0/from/path: expected an element's id or the number of a shape, found 1.5",
        ),
        (
            json!({ "regions": [{ "from": { "polygon": points(2) } }] }),
            "/figure/regions/0/from/polygon: 2 points, at least 3 are needed",
        ),
        (
            json!({ "regions": [{ "from": { "polygon": [] } }] }),
            "/figure/regions/0/from/polygon: 0 points, at least 3 are needed",
        ),
        (
            json!({ "regions": [{ "from": { "polygon": points(513) } }] }),
            "/figure/regions/0/from/polygon: 513 points, at most 512 are allowed",
        ),
        (
            json!({ "regions": [{ "from": { "flood": {} } }] }),
            "/figure/regions/0/from/flood/at: 0 points, at least 1 are needed",
        ),
        (
            json!({ "regions": [flood(17)] }),
            "/figure/regions/0/from/flood/at: 17 points, at most 16 are allowed",
        ),
        (
            json!({ "regions": many(17, flood(16)).as_array().into_iter().flatten().cloned().collect::<Vec<_>>() }),
            "/figure/regions: 272 points of all floods together, at most 256 are allowed",
        ),
        (
            json!({ "regions": [{ "rigidity": [1] }] }),
            "/figure/regions/0/rigidity: expected a number, a list of two numbers or “rigid”, found a list of 1",
        ),
        (
            json!({ "only": points(2) }),
            "/figure/only: 2 points, at least 3 are needed",
        ),
        (
            json!({ "only": points(65) }),
            "/figure/only: 65 points, at most 64 are allowed",
        ),
        (
            json!({ "context": { "points": points(2) } }),
            "/figure/context/points: 2 points, at least 3 are needed",
        ),
        (
            json!({ "context": { "points": points(65) } }),
            "/figure/context/points: 65 points, at most 64 are allowed",
        ),
        (
            json!({ "context": { "points": points(4), "like": points(3) } }),
            "/figure/context/like: 3 points, but `points` has 4",
        ),
        (
            json!({ "context": { "like": points(3) } }),
            "/figure/context/like: 3 points, but `points` has 0",
        ),
        (
            json!({ "contours": [{ "region": "a" }] }),
            "/figure/contours/0/like: 0 points, at least 3 are needed",
        ),
        (
            json!({ "contours": [{ "like": points(257) }] }),
            "/figure/contours/0/like: 257 points, at most 256 are allowed",
        ),
        (
            json!({ "contours": [{ "like": points(3), "keep": points(17) }] }),
            "/figure/contours/0/keep: 17 points, at most 16 are allowed",
        ),
        (
            json!({ "contours": many(9, json!({ "like": points(3) })) }),
            "/figure/contours: 9 contours, at most 8 are allowed",
        ),
        (
            json!({ "only": [[0, 0], [0, 1], [1]] }),
            "/figure/only/2: expected a list of two numbers, found a list of 1",
        ),
        (
            json!({ "only": [[0, 0], [0, 1], [1, "NaN"]] }),
            "/figure/only/2/1: expected a number, found “NaN”",
        ),
    ];
    for (figure, message) in table {
        // Regions of one list need names of their own only once they are there.
        assert_eq!(error(with(figure)), message);
    }
    // Limits themselves are allowed.
    let named = |count: usize| -> Vec<Value> { (0..count).map(|_| flood(4)).collect() };
    let most = figure(
        json!({ "regions": named(64), "handles": many(64, json!({ "points": points(32), "to": points(32) })),
        "only": points(64), "context": { "points": points(64), "like": points(64) },
        "contours": many(8, json!({ "like": points(256), "keep": points(16) })) }),
    );
    assert_eq!(
        (most.regions.len(), most.handles.len(), most.contours.len()),
        (64, 64, 8)
    );
    for word in ["NaN", "Infinity", "-Infinity", "1e999"] {
        let text = format!(r#"{{"fabrica":1,"figure":{{"handles":[{{"at":[0,{word}]}}]}}}}"#);
        let found = Document::from_json(&text)
            .expect_err("no number")
            .to_string();
        assert_eq!(
            found,
            format!("/figure/handles/0/at/1: {word} is not a finite number")
        );
    }
}

/// The pointers to every key of `figure` in [`full`], and what kind they are of.
fn every_key() -> Vec<(String, Kind)> {
    let mut keys = Vec::new();
    schema::visit(&mut |at, _, of| {
        for key in of.iter().filter(|_| at.starts_with("/figure")) {
            keys.push((pointer::join(at, key.name), key.kind));
        }
    });
    let full = with(full());
    let found = |at: &str| full.pointer(at).is_some();
    let places = |at: String| {
        (0..3)
            .map(|i| at.replace('*', &i.to_string()))
            .find(|at| found(at))
    };
    keys.into_iter()
        .map(|(at, kind)| {
            let place = places(at.clone());
            (
                place.unwrap_or_else(|| panic!("{at} is in the example")),
                kind,
            )
        })
        .collect()
}

#[test]
fn a_wrong_type_is_an_error_at_every_key() {
    let values = [
        json!(null),
        json!(true),
        json!(1),
        json!("x"),
        json!([]),
        json!({}),
        json!([true]),
        json!([[0, 0], [0, null], [0, 0]]),
        json!([[0, 0, 0], [0, 0, 0], [0, 0, 0]]),
    ];
    let keys = every_key();
    assert!(keys.len() > 45, "{}", keys.len());
    for (at, kind) in keys {
        for value in &values {
            let is_right = match kind {
                Kind::Text | Kind::Name(_) | Kind::Behind => value.is_string(),
                Kind::Shape => value.is_string() || value.is_number(),
                Kind::Flag { .. } => value.is_boolean(),
                Kind::Exact { .. } | Kind::Count { .. } => value.is_number(),
                Kind::Turn => value.is_number() || value.is_null(),
                Kind::Rigidity => value.is_number() || value.is_string(),
                Kind::Object(_) => {
                    value == &json!({}) && !at.ends_with("/from") && !at.ends_with("/flood")
                }
                Kind::List { .. } => value == &json!([]),
                Kind::Points { .. } => {
                    value == &json!([])
                        && ["/only", "/keep", "/context/points", "/context/like"]
                            .iter()
                            .any(|end| at.ends_with(end))
                }
                _ => false,
            };
            let mut wrong = with(full());
            *wrong.pointer_mut(&at).expect("it is there") = value.clone();
            let result = Document::from_value(wrong);
            // Without points there is nothing that the other list goes with.
            let is_right = is_right && !(at.ends_with("/context/points") && value.is_array());
            match result {
                Ok(_) => assert!(is_right, "{at} is no {value}"),
                Err(error) => {
                    let error = error.to_string();
                    assert!(!is_right, "{at} may be {value}: {error}");
                    let place = at.replace("/context/points", "/context");
                    assert!(
                        error.starts_with(&place)
                            || error.starts_with(&at.replace("/points", "/to")),
                        "{at} {value}: {error}"
                    );
                }
            }
        }
    }
    for value in [json!(null), json!([]), json!("drawn"), json!(1)] {
        let message = error(with(value));
        assert!(
            message.starts_with("/figure: expected an object"),
            "{message}"
        );
    }
}

#[test]
fn hostile_text_is_an_error_and_nothing_more() {
    let deep = |open: &str, close: &str| {
        let inside = open.repeat(200) + &close.repeat(200);
        format!(r#"{{"fabrica":1,"figure":{{"only":{inside}}}}}"#)
    };
    for text in [
        deep("[", "]"),
        format!(
            r#"{{"fabrica":1,"figure":{}1{}}}"#,
            "{\"a\":".repeat(100),
            "}".repeat(100)
        ),
        format!(
            r#"{{"fabrica":1,"figure":{{"only":[{}[0,0]]}}}}"#,
            "[0,0],".repeat(100_000)
        ),
        format!(
            r#"{{"fabrica":1,"figure":{{"regions":[{}{{}}]}}}}"#,
            "{},".repeat(100_000)
        ),
        format!(
            r#"{{"fabrica":1,"figure":{{"handles":[{}]}}}}"#,
            "9".repeat(1000)
        ),
        r#"{"fabrica":1,"figure":{"detail":5,"detail":6}}"#.to_owned(),
    ] {
        let shown: String = text.chars().take(60).collect();
        assert!(Document::from_json(&text).is_err(), "{shown}");
    }
    // A text may be long; a name in a message is not.
    let name = "x".repeat(100_000);
    let message = error(with(
        json!({ "regions": [{ "name": name }, { "name": name }] }),
    ));
    assert!(message.len() < 300, "{}", message.len());
    for text in [
        "",
        "[]",
        "{",
        "null",
        r#"{"handles":[{}]}"#,
        r#"{"reach":NaN}"#,
    ] {
        assert!(figure_from_text(text).is_err(), "{text}");
    }
    let long = format!("{{{}}}", " ".repeat(1 << 20));
    assert!(figure_from_text(&long).is_err(), "longer than a document");
}

#[test]
fn notices_name_what_goes_with_another_subject() {
    let look = json!({ "transfer": "ct-bone", "window": [0, 1], "opacity": "mass", "segments": { "a": 1 } });
    let templates = json!([{ "kind": "peel", "align": { "to": "surface" } }]);
    let of = |subject: Value| {
        document(
            json!({ "fabrica": 1, "subject": subject, "templates": templates, "look": look, "figure": { "reach": 1 } }),
        )
    };
    let beside_figure = [
        "/templates",
        "/look/transfer",
        "/look/window",
        "/look/opacity",
        "/look/segments",
    ];
    let told = |document: &Document| {
        notices(document)
            .into_iter()
            .filter(|n| n.contains("beside"))
            .collect::<Vec<_>>()
    };
    let drawn = of(json!({ "builtin": "drawn-arm" }));
    let wanted = beside_figure.map(|at| format!("{at}: beside a figure this is kept, not drawn"));
    assert_eq!(told(&drawn), wanted);
    assert!(drawn.illustration().subject.is_drawn_figure());
    assert_eq!(drawn.illustration().templates.len(), 1, "kept");
    for subject in [
        json!({}),
        json!({ "builtin": "bar" }),
        json!({ "meshes": [{ "src": "a.stl" }] }),
    ] {
        let document = of(subject);
        let wanted = "/figure: beside a subject that is no figure this is kept, not drawn";
        assert_eq!(told(&document), [wanted]);
        assert_eq!(document.illustration().subject.is_figure(), Some(false));
    }
    // Of a file the bytes decide.
    for subject in [
        json!({ "src": "a.png" }),
        json!({ "sha256": "a".repeat(64) }),
    ] {
        let document = of(subject);
        assert_eq!(told(&document), [""; 0]);
        let illustration = document.illustration();
        assert_eq!(illustration.subject.is_figure(), None);
        assert_eq!(illustration.left_beside(true), beside_figure);
        assert_eq!(illustration.left_beside(false), ["/figure"]);
    }
    assert_eq!(Document::new().illustration().left_beside(true), [""; 0]);
    for name in DRAWN_FIGURES {
        let document = document(json!({ "fabrica": 1, "subject": { "builtin": name } }));
        assert_eq!(notices(&document), [""; 0], "{name}");
    }
    let later = of(json!({ "builtin": "drawn-hip" }));
    assert!(notices(&later)[0].contains("does not know the built-in subject “drawn-hip”"));
    assert_eq!(told(&later).len(), 5, "a figure all the same");
    let arm = |name: &str| SubjectRef::Builtin {
        name: name.to_owned(),
        revision: 1,
    };
    assert!(arm("drawn-").is_drawn_figure() && !arm("drawnarm").is_drawn_figure());
}

#[test]
fn figures_cross_to_a_worker_in_full_precision() {
    let read = figure(full());
    assert_eq!(figure_from_text(&figure_to_text(&read)), Ok(read.clone()));
    assert_eq!(figure(read.to_value()), read, "it is what a document holds");
    let third = 1.0 / 3.0;
    let odd = Figure {
        regions: vec![Region {
            rigidity: Rigidity::Elastic([third, third.sqrt()]),
            order: f64::MIN_POSITIVE,
            given: vec!["rigidity", "order"],
            ..Region::new("ä \"quoted\" / ~")
        }],
        handles: vec![
            Handle {
                motion: Move {
                    by: dvec2(third, -third),
                    turn: Some(third),
                    scale: third,
                },
                ..Handle::pin(dvec2(0.1 + 0.2, -1e-17), DVec2::ZERO)
            },
            Handle::pin(DVec2::ZERO, DVec2::ONE),
        ],
        context: Some(Context {
            points: vec![dvec2(third, 0.1), DVec2::X, DVec2::Y],
            strength: third,
            keep: true,
            like: None,
            amount: third,
        }),
        ..Figure::default()
    };
    assert_eq!(figure_from_text(&figure_to_text(&odd)), Ok(odd));
    let plain = Figure::default();
    assert_eq!(figure_from_text(&figure_to_text(&plain)), Ok(plain.clone()));
    assert_eq!(figure_from_text("{}"), Ok(plain));
    let message = figure_from_text(r#"{"handles":[{"at":[0,"x"]}]}"#).expect_err("no number");
    assert_eq!(
        message.to_string(),
        "/figure/handles/0/at/1: expected a number, found “x”"
    );
}
