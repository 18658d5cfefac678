//! Sweeps: WGSL numbers against a plain f64 reading with an integrator of its own, and cases that have a formula.

use crate::align::{Labels, probe};
use crate::gpu::{builtin, gpu, studio_of};
use crate::long::long_or;
use crate::reference_sweep::{Measured, Sweep, source, target};
use crate::scatter::Random;
use fabrica::data::{DistanceGrid, Grids, Resources};
use fabrica::document::Document;
use fabrica::placed;
use fabrica::render::{Probe, Sample};
use glam::{DVec3, Quat, Vec3};
use serde_json::{Value, json};
use std::sync::Arc;

/// spec/sweepers.md, A.3: how far a place, and a source by the stretch of the map, may be off, subject units.
const BOUND: f64 = 1e-3;
/// What is aimed at, for most points.
const AIM: f64 = 1e-4;

fn document(templates: Value) -> Document {
    let value = json!({ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": templates });
    let document = Document::from_value(value).expect("a document");
    assert_eq!(document.notices(), [], "{}", document.to_json());
    document
}

fn ask(document: &Document, points: &[Vec3]) -> Vec<Sample> {
    let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
    let resources = Resources::default();
    let asked = probe.samples(document.illustration(), &resources, points);
    pollster::block_on(asked).expect("samples")
}

/// A number as a document writes it.
fn short(x: f32) -> f64 {
    (f64::from(x) * 1e4).round() / 1e4
}

fn list(v: Vec3) -> Value {
    json!(v.to_array().map(short))
}

/// A tool of the shape of this number, that comes near the box.
fn tool(random: &mut Random, shape: usize) -> Value {
    let mut n = |low: f32, high: f32| short(random.between(low, high));
    let mut tool = match shape {
        0 => json!({ "radius": n(0.05, 0.3) }),
        1 => json!({ "shape": "ellipsoid", "radii": [n(0.05, 0.4), n(0.05, 0.4), n(0.05, 0.4)] }),
        2 => json!({ "shape": "capsule", "radius": n(0.0, 0.2), "length": n(0.1, 0.8) }),
        3 => {
            json!({ "shape": "box", "half": [n(0.05, 0.3), n(0.05, 0.3), n(0.05, 0.3)], "round": n(0.0, 0.05) })
        }
        4 => json!({ "shape": "torus", "ring": n(0.1, 0.4), "radius": n(0.0, 0.1) }),
        _ => {
            let points: Vec<Value> = (0..3 + random.index(5))
                .map(|_| list(random.vector(-0.3, 0.3)))
                .collect();
            json!({ "shape": "curve", "points": points, "radius": short(random.between(0.0, 0.1)) })
        }
    };
    tool["coat"] = json!(short(random.between(0.15, 0.5)));
    let count = [1, 2, 2, 3, 4][random.index(5)];
    let mut at = random.vector(0.1, 0.9);
    let keys = (0..count).map(|_| {
        at += random.vector(-0.35, 0.35);
        if random.index(3) == 0 {
            return list(at);
        }
        let turn = Quat::IDENTITY.slerp(random.rotation(), random.between(0.0, 0.5));
        json!({ "at": list(at), "rotate": turn.to_array().map(short),
            "scale": short(random.between(0.7, 1.5)) })
    });
    tool["path"] = keys.collect();
    if count > 2 && random.index(2) == 0 {
        tool["spline"] = json!(true);
    }
    tool
}

/// One to three sweeps of one to four tools, the first of the shape of this number.
pub(crate) fn sweeps(random: &mut Random, shape: usize) -> Value {
    let count = 1 + random.index(3);
    let each = (0..count).map(|i| {
        let mirror = ["", "", "", "x", "y", "z", "xz"][random.index(7)];
        let most = (8 >> mirror.len()).min(4);
        let tools: Vec<Value> = (0..1 + random.index(most))
            .map(|j| {
                let shape = if i + j == 0 { shape } else { random.index(6) };
                tool(random, shape)
            })
            .collect();
        let progress = [1.0, short(random.between(0.2, 1.0))][random.index(2)];
        let mut template = json!({ "kind": "sweep", "at": list(random.vector(-0.2, 0.2)),
            "rotate": random.rotation().to_array().map(short), "size": list(random.vector(0.3, 0.7)),
            "params": { "progress": progress, "mirror": mirror, "tools": tools } });
        if i > 0 && random.index(4) == 0 {
            template["mode"] = json!("add");
        }
        template
    });
    each.collect()
}

/// How much the map stretches at a point, by differences of the reference.
fn stretch(sweeps: &[Sweep], at: DVec3) -> f64 {
    const STEP: f64 = 1e-4;
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
        (source(sweeps, at + axis * STEP) - source(sweeps, at - axis * STEP)) / (2.0 * STEP)
    });
    // No less than the largest singular value.
    axes.iter().map(|a| a.length_squared()).sum::<f64>().sqrt()
}

/// How many of these points are off by more than the bound, and by more than the aim.
fn wrong(sweeps: &[Sweep], points: &[Vec3], found: &[Sample]) -> [usize; 2] {
    let is_sum = sweeps.len() > 1;
    let mut wrong = [0; 2];
    for (i, (point, found)) in points.iter().zip(found).enumerate() {
        let at = point.as_dvec3();
        let mut off = source(sweeps, at).distance(found.pos_in_rest.as_dvec3());
        if off > AIM {
            off /= stretch(sweeps, at).max(1.0);
        }
        if !is_sum && i % 4 == 0 {
            off = off.max(target(sweeps, found.pos_in_rest.as_dvec3()).distance(at));
        }
        wrong[0] += usize::from(off > BOUND);
        wrong[1] += usize::from(off > AIM);
        assert_eq!(found.continuity, 1.0, "nothing is torn at {point}");
    }
    wrong
}

#[test]
fn random_sweeps_are_the_flow_of_the_reference() {
    let mut random = Random(0x5eed_0019);
    let (mut asked, mut moved, mut off_aim) = (0, 0, 0);
    for round in 0..long_or(40, 12) {
        let document = document(sweeps(&mut random, round % 6));
        let text: Value = serde_json::from_str(&document.to_json()).expect("its own text");
        let templates = &document.illustration().templates;
        let points: Vec<Vec3> = (0..long_or(200, 40))
            .map(|_| {
                let of = &templates[random.index(templates.len())];
                of.subject_from_template(random.vector(-0.2, 1.2))
            })
            .collect();
        let found = ask(&document, &points);
        let mut reference = Sweep::all(&text);
        let [over, off] = wrong(&reference, &points, &found);
        assert_eq!(over, 0, "round {round}: {text}");
        off_aim += off;
        asked += points.len();
        let is_moved = |(p, s): &(&Vec3, &Sample)| p.distance(s.pos_in_rest) > 0.01;
        let count = points.iter().zip(&found).filter(is_moved).count();
        moved += count;
        // The comparison sees a screw of the wrong sign, where its tool moves anything.
        let is_single = reference.len() == 1 && templates[0].params.len() == 1;
        let tools = text["templates"][0]["params"]["tools"].as_array();
        if is_single && count > 5 && tools.is_some_and(|tools| tools.len() == 1) {
            reference[0].is_wrong = true;
            let [over, _] = wrong(&reference, &points, &found);
            assert!(over > count / 3, "round {round}: a wrong sign passes");
        }
    }
    println!("{asked} points, {moved} moved, {off_aim} off by more than {AIM}");
    assert!(moved > asked / 8, "of {asked} points only {moved} move");
    assert!(off_aim < asked / 50, "{off_aim} of {asked} miss the aim");
}

/// What the reference carries forward from a place, the probe brings back to it.
#[test]
fn what_was_carried_forward_comes_back() {
    let mut random = Random(0xf0_0019);
    let (mut moved, mut off_aim) = (0, 0);
    let count = long_or(1000, 60);
    for round in 0..10 {
        let mut templates = sweeps(&mut random, round % 6);
        for template in templates.as_array_mut().expect("a list") {
            // Displacements that are summed have no map forward.
            template.as_object_mut().expect("a template").remove("mode");
        }
        let document = document(templates);
        let reference = Sweep::all(&serde_json::from_str(&document.to_json()).expect("its text"));
        let placed = &document.illustration().templates;
        let places: Vec<Vec3> = (0..count)
            .map(|_| {
                let of = &placed[random.index(placed.len())];
                of.subject_from_template(random.vector(-0.1, 1.1))
            })
            .collect();
        let there = places.iter().map(|p| target(&reference, p.as_dvec3()));
        let there: Vec<Vec3> = there.map(|p| p.as_vec3()).collect();
        for ((place, at), found) in places.iter().zip(&there).zip(ask(&document, &there)) {
            let mut off = f64::from(found.pos_in_rest.distance(*place));
            if off > AIM {
                off /= stretch(&reference, at.as_dvec3()).max(1.0);
            }
            assert!(
                off < BOUND,
                "round {round}: {place} went to {at}, {found:?}"
            );
            off_aim += usize::from(off > AIM);
            moved += usize::from(at.distance(*place) > 0.01);
        }
    }
    println!(
        "{moved} of {} points moved, {off_aim} off by more than {AIM}",
        10 * count
    );
    assert!(moved > 2 * count && off_aim * 50 < 10 * count);
}

/// A tool of a shape that this version does not have is kept and named; the others act as if they were alone.
#[test]
fn a_tool_of_an_unknown_shape_moves_nothing() {
    let path = json!([[0.5, 0.5, 0.2], [0.5, 0.5, 0.6]]);
    let cloud = json!({ "shape": "cloud", "density": [3], "path": path });
    let ball = json!({ "radius": 0.15, "path": [[0.2, 0.5, 0.4], [0.5, 0.5, 0.5]] });
    let of = |tools: Value| {
        let templates =
            json!([{ "kind": "sweep", "size": [1, 1, 1], "params": { "tools": tools } }]);
        let value =
            json!({ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": templates });
        Document::from_value(value).expect("a document")
    };
    let [alone, beside, without] = [json!([cloud]), json!([cloud, ball]), json!([ball])].map(of);
    for document in [&alone, &beside] {
        let said: Vec<String> = document.notices().iter().map(ToString::to_string).collect();
        let is_named = |line: &String| line.contains("/tools/0/shape") && line.contains("cloud");
        assert!(said.len() == 1 && is_named(&said[0]), "{said:?}");
        let link = fabrica::link::encode(document);
        let opened = fabrica::link::decode(&link).expect("a document").document;
        let text: Value = serde_json::from_str(&opened.to_json()).expect("its own text");
        assert_eq!(text["templates"][0]["params"]["tools"][0], cloud);
    }
    let mut random = Random(0xc10d);
    let points: Vec<Vec3> = (0..500).map(|_| random.vector(-0.5, 0.5)).collect();
    let [alone, beside, without] = [&alone, &beside, &without].map(|of| ask(of, &points));
    let is_still = |(point, found): (&Vec3, &Sample)| found.pos_in_rest == *point;
    assert!(points.iter().zip(&alone).all(is_still));
    assert!(!points.iter().zip(&without).all(is_still));
    for (one, other) in beside.iter().zip(&without) {
        assert_eq!(one.pos_in_rest, other.pos_in_rest);
    }
}

/// Tools and images whose reaches stay apart are integrated each by itself, those that meet together: the flow is the
/// same.
#[test]
fn tools_apart_move_each_its_own_tissue() {
    let ball =
        |from: [f64; 3], to: [f64; 3]| json!({ "radius": 0.06, "coat": 0.08, "path": [from, to] });
    let turned = json!({ "at": [0.8, 0.25, 0.6], "rotate": [0, 0, 0.4, 0.9165], "scale": 1.3 });
    let egg = json!({ "shape": "ellipsoid", "radii": [0.08, 0.05, 0.05], "coat": 0.06, "path": [[0.7, 0.2, 0.4], turned] });
    let arc = json!({ "shape": "curve", "points": [[-0.1, 0, 0], [0, 0.05, 0], [0.1, 0, 0.03]], "radius": 0.02, "coat": 0.07,
        "path": [[0.2, 0.8, 0.3], [0.3, 0.75, 0.7]] });
    let cases = [
        // Four images of one tool, each alone.
        ("xy", vec![ball([0.2, 0.2, 0.2], [0.25, 0.3, 0.8])]),
        // At its end it meets its image in one mirror.
        ("xz", vec![ball([0.2, 0.5, 0.2], [0.42, 0.5, 0.25])]),
        // Two alone and a curve, each on either side.
        (
            "x",
            vec![ball([0.2, 0.2, 0.2], [0.25, 0.25, 0.8]), egg, arc],
        ),
        // The second meets the image of the first.
        (
            "x",
            vec![
                ball([0.2, 0.5, 0.2], [0.2, 0.5, 0.8]),
                ball([0.8, 0.4, 0.5], [0.8, 0.7, 0.5]),
            ],
        ),
    ];
    let mut random = Random(0x0a9a_27ed);
    for (case, (mirror, tools)) in cases.into_iter().enumerate() {
        for progress in [1.0, 0.55] {
            let document = document(
                json!([{ "kind": "sweep", "at": [0.05, 0, 0.1], "rotate": [0.1, 0.2, 0, 0.9747], "size": [0.8, 0.9, 0.7],
                "params": { "progress": progress, "mirror": mirror, "tools": tools } }]),
            );
            let templates = &document.illustration().templates;
            let points: Vec<Vec3> = (0..long_or(4_000, 300))
                .map(|_| templates[0].subject_from_template(random.vector(0.0, 1.0)))
                .collect();
            let found = ask(&document, &points);
            let moved = points.iter().zip(&found);
            let is_moved = |(p, s): &(&Vec3, &Sample)| **p != s.pos_in_rest;
            let moved = moved.filter(is_moved).count();
            assert!(moved * 50 > points.len(), "case {case}: {moved} moved");
            let text: Value = serde_json::from_str(&document.to_json()).expect("its own text");
            let [over, off_aim] = wrong(&Sweep::all(&text), &points, &found);
            println!("case {case} at {progress}: {moved} moved, {off_aim} off by more than {AIM}");
            assert_eq!(over, 0, "case {case} at {progress}");
            assert!(
                off_aim * 50 < moved,
                "case {case}: {off_aim} of {moved} miss the aim"
            );
        }
    }
}

/// A block, 1 by 0.6 by 0.3, as a grid of distances.
fn block() -> Arc<DistanceGrid> {
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 1 { 0.5 } else { -0.5 };
        Vec3::new(side(0), 0.6 * side(1), 0.3 * side(2))
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(halves).collect();
    let positions: Vec<Vec3> = (0..8).map(corner).collect();
    let grid = DistanceGrid::of_mesh(&positions, &triangles, true, &mut |_| true);
    Arc::new(grid.expect("a block has a size"))
}

/// Tools that are meshes are their grids, linear between nodes; one of which nothing has come holds nothing.
#[test]
fn meshes_are_swept_as_their_grids() {
    let grid = block();
    let resources = Resources {
        grids: Grids {
            files: vec![("block.stl".to_owned(), Arc::clone(&grid))],
            baked: Vec::new(),
        },
        ..Resources::default()
    };
    let measured: Measured = Arc::new(move |q| grid.distance(q));
    let mut random = Random(0x619d);
    let (mut moved, mut off_aim, mut asked) = (0, 0, 0);
    for round in 0..long_or(12, 5) {
        let mut mesh = tool(&mut random, 0);
        mesh["shape"] = json!("mesh");
        mesh["src"] = json!("block.stl");
        mesh["longest"] = json!(short(random.between(0.2, 0.8)));
        let keys = mesh.as_object_mut().expect("a tool");
        keys.remove("radius");
        let mut tools = vec![mesh];
        if round % 2 == 1 {
            // Another of the same file, and one of no file that is here.
            let mut other = tools[0].clone();
            other["longest"] = json!(0.15);
            other["path"] = json!([[0.2, 0.3, 0.4], [0.7, 0.6, 0.5]]);
            tools.extend([other, tool(&mut random, 1 + round % 5)]);
        }
        let mirror = ["", "x"][round % 2];
        let templates = json!([{ "kind": "sweep", "size": [1, 0.8, 0.9],
            "rotate": random.rotation().to_array().map(short),
            "params": { "mirror": mirror, "tools": tools } }]);
        let document = document(templates);
        let text: Value = serde_json::from_str(&document.to_json()).expect("its own text");
        let of = &document.illustration().templates[0];
        let points: Vec<Vec3> = (0..long_or(200, 60))
            .map(|_| of.subject_from_template(random.vector(-0.2, 1.2)))
            .collect();
        let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
        let samples = probe.samples(document.illustration(), &resources, &points);
        let found = pollster::block_on(samples).expect("samples");
        let with_mesh = |sweep: Sweep| sweep.with_mesh(&measured);
        let mut reference: Vec<Sweep> = Sweep::all(&text).into_iter().map(with_mesh).collect();
        let [over, off] = wrong(&reference, &points, &found);
        assert_eq!(over, 0, "round {round}: {text}");
        off_aim += off;
        asked += points.len();
        let is_moved = |(p, s): &(&Vec3, &Sample)| p.distance(s.pos_in_rest) > 0.01;
        let count = points.iter().zip(&found).filter(is_moved).count();
        moved += count;
        if round % 2 == 0 {
            if count > 5 {
                reference[0].is_wrong = true;
                let [over, _] = wrong(&reference, &points, &found);
                assert!(over > count / 3, "round {round}: a wrong sign passes");
            }
            // Without its file the tool holds nothing.
            for (point, found) in points.iter().zip(ask(&document, &points)) {
                assert_eq!(found.pos_in_rest, *point, "round {round}");
            }
        }
    }
    println!("{asked} points, {moved} moved, {off_aim} off by more than {AIM}");
    assert!(moved > asked / 10, "of {asked} points only {moved} move");
}

/// The sweep of one tool in a box of side 1 about the origin.
fn one(tool: Value) -> Value {
    json!([{ "kind": "sweep", "size": [1, 1, 1], "params": { "tools": [tool] } }])
}

/// Ahead of a ball that goes straight, the distance to it shrinks by dx/dt = −v (1 − μ(x/λ)).
#[test]
fn a_ball_that_goes_straight_obeys_the_closed_integral() {
    let (radius, coat, way) = (0.1, 0.2, 0.5);
    let document = document(one(json!({ "radius": radius, "coat": coat,
        "path": [[0.5, 0.5, 0.2], [0.5, 0.5, 0.7]] })));
    let front = 0.2 + radius;
    let ahead: Vec<f64> = (1..10).map(|i| 0.02 * f64::from(i)).collect();
    let points: Vec<Vec3> = ahead
        .iter()
        .map(|x| Vec3::new(0.0, 0.0, (front + x) as f32))
        .collect();
    for (x, found) in ahead.iter().zip(ask(&document, &points)) {
        let before = f64::from(found.pos_in_rest.z) - (-0.3 + radius);
        let steps = 20_000;
        let width = (before - x) / f64::from(steps);
        let slowness = |x: f64| {
            let t = (x / coat).min(1.0);
            1.0 / (t.powi(3) * (10.0 - 15.0 * t + 6.0 * t * t))
        };
        let middles = (0..steps).map(|i| slowness(x + width * (f64::from(i) + 0.5)));
        let time = middles.sum::<f64>() * width;
        // By the stretch that there is: how fast the time changes with the source.
        assert!(
            (time - way).abs() < 2e-4 * slowness(*x),
            "{x}: {time} and not {way}"
        );
    }
}

#[test]
fn what_is_in_a_tool_moves_rigidly_and_grows_with_it() {
    let turn = [0.0, 0.0, 0.6, 0.8];
    let document = document(one(json!({ "radius": 0.15, "path": [[0.4, 0.5, 0.5],
        { "at": [0.6, 0.6, 0.5], "rotate": turn, "scale": 1.4 }] })));
    let mut random = Random(0x19);
    let inside: Vec<Vec3> = (0..100)
        .map(|_| random.vector(-1.0, 1.0).clamp_length_max(1.0) * 0.2)
        .collect();
    let middle = Vec3::new(0.1, 0.1, 0.0);
    let points: Vec<Vec3> = inside.iter().map(|p| middle + *p).collect();
    let back = Quat::from_array([0.0, 0.0, -0.6, 0.8]).normalize();
    for (p, found) in inside.iter().zip(ask(&document, &points)) {
        let expected = Vec3::new(-0.1, 0.0, 0.0) + back * *p / 1.4;
        assert!(
            found.pos_in_rest.distance(expected) < 1e-4,
            "{p}: {found:?}"
        );
    }
}

#[test]
fn mirrored_tools_keep_their_plane_and_still_ones_hold() {
    let plane = json!([{ "kind": "sweep", "size": [1, 1, 1], "params": { "mirror": "xy", "tools": [
        { "radius": 0.1, "path": [[0.3, 0.7, 0.2], [0.45, 0.6, 0.8]] },
        { "shape": "capsule", "coat": 0.2, "path": [[0.6, 0.4, 0.5],
            { "at": [0.4, 0.4, 0.5], "rotate": [0, 0.3827, 0, 0.9239] }] }] } }]);
    let document = document(plane);
    let mut random = Random(0x1919);
    let mut moved = 0;
    let mut points: Vec<Vec3> = (0..400).map(|_| random.vector(-0.45, 0.45)).collect();
    points.iter_mut().for_each(|p| p.x = 0.0);
    for (p, found) in points.iter().zip(ask(&document, &points)) {
        assert_eq!(found.pos_in_rest.x, 0.0, "{p} leaves the plane");
        moved += usize::from(found.pos_in_rest.distance(*p) > 0.02);
    }
    assert!(moved > 40, "{moved} points of the plane move in it");
    // In a tool that stands still and out of reach of the other one, nothing moves, by one bit.
    let held = self::document(
        json!([{ "kind": "sweep", "size": [1, 1, 1], "params": { "tools": [
        { "radius": 0.12, "coat": 0.1, "path": [[0.5, 0.5, 0.5]] },
        { "radius": 0.1, "coat": 0.1, "path": [[0.75, 0.5, 0.1], [0.75, 0.5, 0.9]] }] } }]),
    );
    let points: Vec<Vec3> = (0..300)
        .map(|_| random.vector(-0.12, 0.12).clamp_length_max(0.04) + Vec3::new(0.0, 0.0, 0.0))
        .collect();
    for (p, found) in points.iter().zip(ask(&held, &points)) {
        assert_eq!(found.pos_in_rest, *p);
    }
    // It slows what the other one drives through its coating.
    let beside = [Vec3::new(0.12, 0.0, 0.0)];
    let free = self::document(one(json!({ "radius": 0.1, "coat": 0.1,
        "path": [[0.75, 0.5, 0.1], [0.75, 0.5, 0.9]] })));
    let way = |document| ask(document, &beside)[0].pos_in_rest.distance(beside[0]);
    assert!(
        way(&held) < 0.9 * way(&free),
        "{} and {}",
        way(&held),
        way(&free)
    );
}

#[test]
fn what_no_coating_meets_keeps_its_bits_and_nothing_folds() {
    let mut random = Random(0x0fff_0019);
    for round in 0..long_or(10, 4) {
        let document = document(sweeps(&mut random, round));
        let illustration = document.illustration();
        let points = (0..long_or(10_000, 4000)).map(|_| random.vector(-0.7, 0.7));
        let points: Vec<Vec3> = points.collect();
        let found = ask(&document, &points);
        let resources = Resources::default();
        let reaches: Vec<_> = illustration
            .templates
            .iter()
            .map(|t| (t, placed::reach(t, &resources)))
            .collect();
        // Within the reach of the template that acts first on it, or of a later one.
        let is_free = |p: &Vec3| {
            reaches
                .iter()
                .all(|(t, reach)| !reach.contains(t.template_from_subject(*p)))
        };
        let mut free = 0;
        for (p, found) in points.iter().zip(&found) {
            if is_free(p) {
                free += 1;
                assert_eq!(found.pos_in_rest, *p, "round {round}");
            }
        }
        assert!(free > 200, "{free} points are free");
        if illustration
            .templates
            .iter()
            .any(|t| t.mode == fabrica::document::TemplateMode::Add)
        {
            // A sum may fold.
            continue;
        }
        const STEP: f32 = 1e-3;
        let corners = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| {
            let ahead: Vec<Vec3> = points.iter().map(|p| *p + axis * STEP).collect();
            let behind: Vec<Vec3> = points.iter().map(|p| *p - axis * STEP).collect();
            [ask(&document, &ahead), ask(&document, &behind)]
        });
        let folded = (0..points.len()).filter(|i| {
            let [x, y, z] = corners
                .each_ref()
                .map(|[a, b]| a[*i].pos_in_rest - b[*i].pos_in_rest);
            glam::Mat3::from_cols(x, y, z).determinant() <= 0.0
        });
        let folded = folded.count();
        assert!(
            folded * 100 <= points.len(),
            "round {round}: {folded} points fold"
        );
    }
}

#[test]
fn part_of_the_way_and_then_the_rest_is_the_whole() {
    let whole = document(one(
        json!({ "radius": 0.12, "path": [[0.3, 0.4, 0.2], [0.6, 0.5, 0.8]] }),
    ));
    let half = |path: Value| {
        json!({ "kind": "sweep", "size": [1, 1, 1],
            "params": { "tools": [{ "radius": 0.12, "path": path }] } })
    };
    let mut first = half(json!([[0.3, 0.4, 0.2], [0.6, 0.5, 0.8]]));
    first["params"]["progress"] = json!(0.4);
    let rest = half(json!([[0.42, 0.44, 0.44], [0.6, 0.5, 0.8]]));
    let both = document(json!([first, rest]));
    let mut random = Random(0x4019);
    let points: Vec<Vec3> = (0..2000).map(|_| random.vector(-0.4, 0.4)).collect();
    let pairs = ask(&whole, &points).into_iter().zip(ask(&both, &points));
    for (a, b) in pairs {
        let off = a.pos_in_rest.distance(b.pos_in_rest);
        assert!(off < 3e-4, "{a:?} and {b:?}");
    }
}

/// spec/sweepers.md, A.3: where material is pressed together the texture's source is a part of a coat off, but that
/// tissue is drawn in its place.
#[test]
fn the_baked_map_draws_tissue_in_its_place() {
    let studio = studio_of(gpu(), &builtin("cube", 16), false);
    // How far from their places points are drawn, texels, in order; and texels to a coat.
    let offs = |document: &Document, coat: f32, texels: Option<u32>| {
        let map = pollster::block_on(studio.bake(document.illustration(), texels));
        let map = map.expect("a baked map");
        let text: Value = serde_json::from_str(&document.to_json()).expect("its own text");
        let reference = Sweep::all(&text);
        let texel = (map.size / map.texels.as_vec3()).max_element();
        let mut random = Random(0xba4e);
        let mut offs = Vec::new();
        while offs.len() < long_or(3000, 600) {
            let point = map.origin_min + map.size * random.vector(0.0, 1.0);
            let texel_here = map.at(point).expect("inside the box");
            let way = Vec3::new(texel_here[0], texel_here[1], texel_here[2]);
            if way.length() > 1e-3 {
                let drawn = target(&reference, (point + way).as_dvec3());
                offs.push(drawn.distance(point.as_dvec3()) / f64::from(texel));
            }
        }
        offs.sort_by(f64::total_cmp);
        (offs, coat / texel)
    };
    let push = document(one(json!({ "radius": 0.1, "coat": 0.1,
        "path": [[0.5, 0.5, 0.3], [0.5, 0.5, 0.6]] })));
    let grown = document(one(json!({ "radius": 0.12, "coat": 0.15,
        "path": [[0.5, 0.5, 0.4], { "at": [0.5, 0.6, 0.5], "scale": 1.8 }] })));
    let turn = |rotate: [f64; 4]| {
        document(one(
            json!({ "shape": "ellipsoid", "radii": [0.2, 0.12, 0.12], "coat": 0.12,
            "path": [[0.5, 0.5, 0.5], { "at": [0.55, 0.5, 0.5], "rotate": rotate }] }),
        ))
    };
    let turned = turn([0.0, 0.0, 0.28, 0.96]);
    let pulled = document(one(
        json!({ "shape": "capsule", "coat": 0.1, "radius": 0.08, "length": 0.3,
        "path": [[0.4, 0.5, 0.5], [0.6, 0.55, 0.5]] }),
    ));
    let pinched = document(
        json!([{ "kind": "sweep", "size": [1, 1, 1], "params": { "mirror": "x",
        "tools": [{ "radius": 0.1, "coat": 0.12, "path": [[0.2, 0.5, 0.5], [0.36, 0.5, 0.6]] }] } }]),
    );
    let sweeps = [
        (&push, 0.1),
        (&grown, 0.15),
        (&turned, 0.12),
        (&pulled, 0.1),
        (&pinched, 0.12),
    ];
    let mut wrong = Vec::new();
    for (i, (document, coat)) in sweeps.into_iter().enumerate() {
        // As many texels as the renderer takes by itself.
        let (offs, texels) = offs(document, coat, None);
        let [most, usual] = [1.0, 0.99].map(|part| offs[((offs.len() - 1) as f64 * part) as usize]);
        println!(
            "sweep {i}: {texels:.1} texels to a coat; 99 % within {usual:.2} texels, all within {most:.2}"
        );
        if texels < 8.0 || usual > 1.0 || most > 1.5 {
            wrong.push(i);
        }
    }
    assert!(wrong.is_empty(), "sweeps {wrong:?}");
    // What a tool shears by two coatings gets more texels: 99 % are drawn in their places, the farthest two texels off.
    let (sheared, texels) = offs(&turn([0.0, 0.0, 0.6, 0.8]), 0.12, None);
    let [most, usual] =
        [1.0, 0.99].map(|part| sheared[((sheared.len() - 1) as f64 * part) as usize]);
    println!("sheared: {texels:.1} texels to a coat; 99 % within {usual:.2}, all within {most:.2}");
    assert!(usual <= 1.0, "{usual}");
    // Half as many are too few: the measure tells.
    let (_, fine) = offs(&push, 0.1, None);
    let few = 4.0 / 0.1
        * pollster::block_on(studio.bake(push.illustration(), None))
            .expect("a map")
            .size
            .max_element();
    let (offs, texels) = offs(&push, 0.1, Some(few.round() as u32));
    let most = offs.last().copied().unwrap_or_default();
    println!("{texels:.1} texels to a coat and not {fine:.1}: all within {most:.2}");
    assert!(most > 1.0, "{most}");
}

/// With `align` the bar's core stays in its place; with `constrain` too, and nothing is drawn from it.
#[test]
fn a_sweep_leaves_the_core_alone_or_stops_at_it() {
    let volume = builtin("bar", 64);
    let studio = studio_of(gpu(), &volume, false);
    let labels = Labels::new(&volume);
    let core = [labels.number("core")];
    let push = json!({ "kind": "sweep", "size": [0.8, 0.8, 0.8], "params": { "tools": [{ "radius": 0.15,
        "coat": 0.3, "path": [[0.5, 0.5, 0.9], [0.5, 0.55, 0.5]] }] } });
    let mut random = Random(0xc04e);
    let points: Vec<Vec3> = (0..4000).map(|_| random.vector(-0.3, 0.3)).collect();
    // Points of the core that move, points beside it that do, and points beside it that show core.
    let counts = |more: Value| {
        let mut template = push.clone();
        for (key, value) in more.as_object().into_iter().flatten() {
            template[key] = value.clone();
        }
        let document = document(json!([template]));
        let found = probe(&studio, &document.illustration().templates, &points);
        let (mut inside, mut beside, mut drawn) = (0, 0, 0);
        for (pos, sample) in points.iter().zip(&found) {
            let is_moved = sample.continuity >= 0.0 && sample.pos_in_rest.distance(*pos) > 1e-3;
            let to = labels.firmly_kept(sample.pos_in_rest.as_dvec3(), &core);
            match labels.firmly_kept(pos.as_dvec3(), &core) {
                Some(true) => inside += usize::from(sample.pos_in_rest != *pos),
                Some(false) if is_moved => {
                    beside += 1;
                    drawn += usize::from(to == Some(true));
                }
                _ => {}
            }
        }
        [inside, beside, drawn]
    };
    let free = counts(json!({}));
    let aligned = counts(json!({ "align": { "to": "segment", "keep": ["core"] } }));
    let limited = ["displacement", "coordinate"]
        .map(|by| counts(json!({ "constrain": { "by": by, "keep": ["core"] } })));
    println!("core moves, beside moves, shows core: {free:?}, aligned {aligned:?}, {limited:?}");
    assert!(free[0] > 50 && free[2] > 20, "{free:?}");
    assert!(aligned[0] == 0 && aligned[1] > 200, "{aligned:?}");
    for limited in limited {
        assert!(
            limited[0] == 0 && limited[1] > 200 && limited[2] == 0,
            "{limited:?}"
        );
    }
}

/// lavapipe ends all loops of a pixel after 65,535 turns: where tools are many, rays still come to the tissue. A ray
/// that ends before is a hole that tissue is drawn about.
#[test]
fn rays_through_many_tools_come_to_the_tissue() {
    let value = json!({ "fabrica": 1, "subject": { "builtin": "cube" },
    "templates": [{ "kind": "sweep", "at": [0, 0, 0.2], "size": [0.8, 0.8, 0.8], "params": { "mirror": "x", "tools": [
        { "radius": 0.12, "path": [[0.25, 0.5, 1.1], [0.3, 0.5, 0.75]] },
        { "shape": "ellipsoid", "path": [[0.7, 0.15, 0.6], { "at": [0.7, 0.1, 1.0], "rotate": [0, 0, 0.6, 0.8] }] },
    ] } }],
    "camera": { "rotate": [0.297, 0.198, 0.099, 0.929] } });
    let document = Document::from_value(value).expect("a document");
    let studio = studio_of(gpu(), &builtin("cube", 128), true);
    let (width, height) = (112_usize, 84_usize);
    let drawing = studio.render_image(document.illustration(), [width as u32, height as u32], 1);
    let image = pollster::block_on(drawing).expect("a picture");
    let is_drawn = |x: usize, y: usize| image.rgba[4 * (width * y + x)..][..4] != image.rgba[..4];
    let mut holes = 0;
    let mut drawn = 0;
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let about = (0..9).filter(|i| is_drawn(x + i % 3 - 1, y + i / 3 - 1));
            drawn += usize::from(is_drawn(x, y));
            holes += usize::from(!is_drawn(x, y) && about.count() > 5);
        }
    }
    println!("{drawn} pixels are drawn, {holes} are holes");
    assert!(drawn > 4000, "{drawn}");
    assert!(holes < 8, "{holes}");
}
