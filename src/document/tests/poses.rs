//! Poses of a figure: what steps may set, the way from one to the next, and edits of its lists.

use super::figures::{full, points, with};
use super::{document, notices};
use crate::document::figure::{Handle, Hold, Move, Propagation, Rigidity};
use crate::document::{Document, Edit, FigureList, pointer};
use glam::{DVec2, dvec2};
use serde_json::{Value, json};

#[test]
fn steps_set_poses_and_no_other_mesh() {
    let step = |target: &str, value: Value| {
        let mut root = with(full());
        let set = serde_json::Map::from_iter([(target.to_owned(), value)]);
        root["steps"] = json!([{ "set": set }]);
        Document::from_value(root)
    };
    for target in [
        "/figure",
        "/figure/detail",
        "/figure/rest",
        "/figure/regions",
        "/figure/regions/0",
        "/figure/regions/4",
        "/figure/regions/-",
        "/figure/regions/0/name",
        "/figure/regions/0/from",
        "/figure/regions/0/from/flood/tolerance",
        "/figure/regions/1/from/polygon/0",
        "/figure/regions/0/grow",
        "/figure/regions/0/smooth",
        "/figure/regions/0/fill",
        "/figure/regions/0/least",
        "/figure/regions/0/cut",
        "/figure/regions/0/behind",
        "/figure/regions/0/hide",
        "/figure/regions/0/later",
        "/figure/regions/0/later/more",
    ] {
        let message = step(target, json!(1)).expect_err(target).to_string();
        let entry = pointer::join("/steps/0/set", target);
        assert_eq!(message, format!("{entry}: may not be set by a step"));
    }
    for (target, value) in [
        ("/figure/regions/0/rigidity", json!([1, 2])),
        ("/figure/regions/1/rigidity/0", json!(3)),
        ("/figure/regions/0/fixed", json!(false)),
        ("/figure/regions/0/order", json!(2)),
        ("/figure/handles", json!([])),
        ("/figure/handles/0", json!({ "region": "skin" })),
        ("/figure/handles/-", json!({ "region": "skin" })),
        ("/figure/handles/0/at/0", json!(0.5)),
        ("/figure/handles/0/turn", json!(null)),
        ("/figure/handles/1/move/1", json!(0.5)),
        ("/figure/handles/2/to", points(2)),
        ("/figure/only", json!([])),
        ("/figure/propagation", json!("nearest")),
        ("/figure/reach", json!(0.25)),
        ("/figure/rotations", json!("found")),
        ("/figure/context", json!({})),
        ("/figure/context/like/0/0", json!(3)),
        ("/figure/contours/0/amount", json!(0)),
        ("/figure/contours", json!([])),
        ("/figure/later", json!(0)),
    ] {
        let document = step(target, value).unwrap_or_else(|error| panic!("{target}: {error}"));
        let dangling = notices(&document)
            .into_iter()
            .filter(|n| n.starts_with("/steps"));
        assert_eq!(dangling.count(), 0, "{target}");
        let state = document.at_step(1).expect("a step");
        assert_ne!(state.get("/figure"), document.get("/figure"), "{target}");
    }
    let message = step("/figure/handles/0/region", json!("skin")).expect_err("both");
    assert!(
        message
            .to_string()
            .contains("step 1 makes the document wrong: /figure/handles/0: expected exactly one"),
        "{message}"
    );
    // A figure that the document leaves out is made on the way.
    let made = document(json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" },
        "steps": [{ "set": { "/figure/handles/-": { "region": "hand", "turn": 1 } } }] }));
    assert_eq!(notices(&made), [""; 0]);
    assert_eq!(made.illustration().figure, None);
    let posed = made.at_step(1).expect("a step");
    let posed = posed.illustration().figure.clone().expect("a figure");
    assert_eq!(posed.handles[0].motion.turn, Some(1.0));
}

#[test]
fn readers_may_move_numbers_of_a_pose() {
    let mut root = with(full());
    root["controls"] = json!([
        { "pointer": "/figure/handles/0/turn" }, { "pointer": "/figure/handles/0/move/1" }, { "pointer": "/figure/handles/0/enabled" },
        { "pointer": "/figure/regions/0/order" }, { "pointer": "/figure/context/amount" }, { "pointer": "/figure/handles/0/at/0", "min": 0, "max": 1 },
        { "pointer": "/figure/regions/0/grow" }, { "pointer": "/figure/detail" }, { "pointer": "/figure/only/0/0" }, { "pointer": "/figure/handles/0/move/2" }]);
    let document = document(root);
    assert_eq!(document.illustration().controls.len(), 6);
    let told = notices(&document);
    let left: Vec<&str> = told.iter().filter_map(|n| n.split(": ").next()).collect();
    assert_eq!(
        left,
        ["/controls/6", "/controls/7", "/controls/8", "/controls/9"]
    );
}

#[test]
fn poses_ease_and_what_changes_the_matrices_switches() {
    let root = json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "figure": {
        "regions": [{ "name": "a", "rigidity": 1, "fixed": false, "order": 0 }],
        "handles": [
            { "at": [0, 0], "radius": 0.01, "move": [0, 0], "turn": 0, "scale": 1 },
            { "at": [0, 0], "turn": 2 },
            { "region": "a" },
            { "points": [[0, 0], [1, 0]], "to": [[0, 0], [1, 0]] },
            { "points": [[0, 0], [1, 0]], "to": [[0, 0], [1, 0]] },
            { "at": [0, 0], "move": [1, 1] },
            { "at": [0, 0], "enabled": false },
        ],
        "reach": 0, "context": { "points": points(3), "like": [[0, 0], [0, 0], [0, 0]], "strength": 5, "amount": 0 },
        "contours": [{ "region": "a", "like": [[0, 0], [0, 0], [0, 0]], "amount": 0, "keep": [[0, 0]] }] },
        "steps": [{ "seconds": 2, "set": {
            "/figure/regions/0/rigidity": "rigid", "/figure/regions/0/fixed": true, "/figure/regions/0/order": 4,
            "/figure/handles/0": { "at": [1, 1], "radius": 0.1, "move": [1, 2], "turn": 3, "scale": 2 },
            "/figure/handles/1/turn": null, "/figure/handles/2/turn": 1,
            "/figure/handles/3/to": [[0, 1], [1, 1]],
            "/figure/handles/4": { "points": [[0, 0], [1, 0], [2, 0]], "to": [[5, 0], [1, 5], [2, 0]] },
            "/figure/handles/5": { "region": "a", "move": [0, 0] }, "/figure/handles/6/enabled": true,
            "/figure/only": points(3), "/figure/reach": 1, "/figure/propagation": "linear",
            "/figure/context/like": [[2, 0], [0, 2], [0, 0]], "/figure/context/amount": 1, "/figure/context/strength": 7,
            "/figure/context/points": [[0, 0], [0, 1], [1, 0]],
            "/figure/contours/0/like": [[2, 0], [0, 2], [0, 0]], "/figure/contours/0/amount": 1, "/figure/contours/0/keep": [[0, 4]] } }] });
    let document = document(root);
    assert_eq!(notices(&document), [""; 0]);
    let at = |seconds: f32| {
        let illustration = document.at_time(1, seconds).expect("a step");
        illustration.figure.expect("a figure")
    };
    let last = document.at_step(1).expect("a step");
    assert_eq!(Some(at(2.0)), last.illustration().figure, "the end itself");
    let half = at(1.0);
    let [a, b, c, d, e, f, g] = half.handles.as_slice() else {
        panic!("seven handles");
    };
    assert_eq!(
        (half.regions[0].rigidity, half.regions[0].fixed),
        (Rigidity::Rigid, true)
    );
    assert_eq!(half.regions[0].order, 2.0);
    assert_eq!((&a.hold, a.radius), (&Hold::Point(DVec2::ONE), 0.1));
    let motion = Move {
        by: dvec2(0.5, 1.0),
        turn: Some(1.5),
        scale: 1.5,
    };
    assert_eq!(a.motion, motion);
    assert_eq!(b.motion.turn, None, "open at once");
    assert_eq!(c.motion.turn, Some(0.5), "a region's turn is never open");
    let to = |handle: &Handle| match &handle.hold {
        Hold::Line { to, .. } => to.clone(),
        _ => None,
    };
    assert_eq!(to(d), Some(vec![dvec2(0.0, 0.5), dvec2(1.0, 0.5)]));
    assert_eq!(
        to(e).map(|to| to[0]),
        Some(dvec2(5.0, 0.0)),
        "of another length"
    );
    assert_eq!(f.hold, Hold::Region("a".to_owned()));
    assert_eq!(f.motion.by, DVec2::ZERO, "another handle");
    assert!(g.enabled);
    assert_eq!(half.only.as_ref().map(Vec::len), Some(3));
    assert_eq!((half.reach, half.propagation), (0.5, Propagation::Linear));
    let context = half.context.as_ref().expect("a context");
    assert_eq!((context.amount, context.strength), (0.5, 7.0));
    assert_eq!(context.points[1], DVec2::Y);
    assert_eq!(context.like.as_ref().map(|like| like[1]), Some(DVec2::Y));
    let contour = &half.contours[0];
    assert_eq!(
        (contour.amount, contour.like[1], contour.keep[0]),
        (0.5, DVec2::Y, dvec2(0.0, 2.0))
    );
    // Already at the very beginning.
    let first = at(0.0);
    assert_eq!(first.regions[0].rigidity, Rigidity::Rigid);
    assert_eq!(first.handles[0].motion.by, DVec2::ZERO);
}

#[test]
fn pointers_of_steps_follow_the_entries_of_a_figure() {
    let root = json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "figure": {
        "regions": [{ "name": "a" }, { "name": "b" }], "handles": [{ "region": "a" }, { "region": "b" }],
        "contours": [{ "region": "a", "like": points(3) }] },
        "controls": [{ "pointer": "/figure/handles/1/turn" }],
        "steps": [{ "set": { "/figure/regions/1/order": 1, "/figure/handles/1/turn": 1, "/figure/handles/0/turn": 2, "/figure/contours/0/amount": 0.5 } }] });
    let start = document(root);
    let set = |document: &Document| document.get("/steps/0/set").cloned().unwrap_or_default();
    let apply = |edit: Edit| edit.apply(&start).expect("an edit");
    let moved = apply(Edit::MoveInFigure {
        list: FigureList::Handles,
        from: 1,
        to: 0,
    });
    assert_eq!(set(&moved)["/figure/handles/0/turn"], 1);
    assert_eq!(set(&moved)["/figure/handles/1/turn"], 2);
    assert_eq!(
        moved.get("/controls/0/pointer"),
        Some(&json!("/figure/handles/0/turn"))
    );
    let removed = apply(Edit::RemoveFromFigure {
        list: FigureList::Handles,
        index: 0,
    });
    assert_eq!(
        set(&removed),
        json!({ "/figure/regions/1/order": 1, "/figure/handles/0/turn": 1, "/figure/contours/0/amount": 0.5 })
    );
    let added = apply(Edit::AddToFigure {
        list: FigureList::Regions,
        index: 0,
        entry: json!({ "name": "c" }),
    });
    assert_eq!(set(&added)["/figure/regions/2/order"], 1);
    assert_eq!(set(&added)["/figure/handles/1/turn"], 1, "other lists stay");
    let edit = Edit::AddToFigure {
        list: FigureList::Contours,
        index: 9,
        entry: json!({ "like": points(3) }),
    };
    assert_eq!(edit.name(&start), "Add contour");
    assert_eq!(apply(edit).get("/figure/contours/1/like"), Some(&points(3)));
    for edit in [
        Edit::RemoveFromFigure {
            list: FigureList::Regions,
            index: 2,
        },
        Edit::MoveInFigure {
            list: FigureList::Handles,
            from: 0,
            to: 2,
        },
        Edit::AddToFigure {
            list: FigureList::Handles,
            index: 0,
            entry: json!({}),
        },
    ] {
        assert!(edit.apply(&start).is_err(), "{edit:?}");
    }
    let mut crowded = start;
    for i in 2..64 {
        let entry = json!({ "name": format!("region of {i}") });
        crowded = Edit::AddToFigure {
            list: FigureList::Regions,
            index: i,
            entry,
        }
        .apply(&crowded)
        .expect("room");
    }
    let edit = Edit::AddToFigure {
        list: FigureList::Regions,
        index: 0,
        entry: json!({ "name": "z" }),
    };
    let message = edit.apply(&crowded).expect_err("full").to_string();
    assert_eq!(
        message,
        "/figure/regions: 65 regions, at most 64 are allowed"
    );
    // A list is made where there is none.
    let bare = document(json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" } }));
    let edit = Edit::AddToFigure {
        list: FigureList::Handles,
        index: 0,
        entry: json!({ "region": "hand" }),
    };
    let made = edit.apply(&bare).expect("an edit");
    assert_eq!(
        made.get("/figure"),
        Some(&json!({ "handles": [{ "region": "hand" }] }))
    );
}

#[test]
fn poses_are_recorded_while_a_step_is_shown() {
    let root = json!({ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "figure": {
        "handles": [{ "region": "hand" }, { "at": [0, 0], "turn": 1 }], "only": points(3), "context": { "points": points(3) } },
        "steps": [{ "set": {} }, { "set": {} }] });
    let start = document(root);
    let at = |step: usize, edit: Edit| Edit::AtStep {
        step,
        edit: Box::new(edit),
    };
    let put = |pointer: &str, value: Value| Edit::Set {
        pointer: pointer.to_owned(),
        value,
        name: "Pose".to_owned(),
    };
    let set = |document: &Document, step: usize| {
        document
            .get(&format!("/steps/{step}/set"))
            .cloned()
            .unwrap_or(json!({}))
    };
    // A number, an open turn and what is taken away go into the step.
    for (pointer, value) in [
        ("/figure/handles/0/turn", json!(0.5)),
        ("/figure/handles/1/turn", json!(null)),
        ("/figure/only", json!([])),
    ] {
        let posed = at(1, put(pointer, value.clone()))
            .apply(&start)
            .expect(pointer);
        assert_eq!(set(&posed, 0), json!({ pointer: value }));
        assert_eq!(posed.get("/figure"), start.get("/figure"));
    }
    let gone = at(1, put("/figure/context", json!({})))
        .apply(&start)
        .expect("an edit");
    assert_eq!(
        gone.at_step(1).expect("a step").get("/figure/context"),
        None
    );
    assert!(gone.get("/figure/context").is_some(), "before it stays");
    // What is of all steps is set in the document.
    let all = at(1, put("/figure/detail", json!(900)))
        .apply(&start)
        .expect("an edit");
    assert_eq!(
        (all.get("/figure/detail"), set(&all, 0)),
        (Some(&json!(900)), json!({}))
    );
    // A handle comes with the step, and goes with one.
    let add = Edit::AddToFigure {
        list: FigureList::Handles,
        index: 0,
        entry: json!({ "region": "skin" }),
    };
    let added = at(1, add).apply(&start).expect("an edit");
    assert_eq!(
        added.get("/figure/handles/0"),
        Some(&json!({ "region": "skin", "enabled": false }))
    );
    assert_eq!(set(&added, 0), json!({ "/figure/handles/0/enabled": true }));
    let remove = Edit::RemoveFromFigure {
        list: FigureList::Handles,
        index: 0,
    };
    let removed = at(2, remove.clone()).apply(&added).expect("an edit");
    assert_eq!(
        set(&removed, 1),
        json!({ "/figure/handles/0/enabled": false })
    );
    let undone = at(1, remove).apply(&added).expect("an edit");
    assert_eq!(undone, start, "no step before shows it");
    // A region is of all steps, and so is the order of handles.
    let add = Edit::AddToFigure {
        list: FigureList::Regions,
        index: 0,
        entry: json!({ "name": "a" }),
    };
    let added = at(2, add).apply(&start).expect("an edit");
    assert_eq!(
        added.get("/figure/regions"),
        Some(&json!([{ "name": "a" }]))
    );
    // Steps that are moved go on to show what they showed.
    let mut posed = at(1, put("/figure/handles/0/turn", json!(0.5)))
        .apply(&start)
        .expect("an edit");
    posed = at(2, put("/figure/handles/0/turn", json!(0.25)))
        .apply(&posed)
        .expect("an edit");
    let swapped = Edit::MoveStep { from: 1, to: 0 }
        .apply(&posed)
        .expect("an edit");
    let turn = |document: &Document, step| {
        document
            .at_step(step)
            .expect("a step")
            .get("/figure/handles/0/turn")
            .cloned()
    };
    assert_eq!(
        (turn(&swapped, 1), turn(&swapped, 2)),
        (Some(json!(0.25)), Some(json!(0.5)))
    );
}
