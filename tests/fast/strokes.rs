//! Strokes at their limits: very many, very thin, very long, stopped midway.

use std::sync::Arc;

use crate::scatter::Random;
use fabrica::clay::Check;
use fabrica::document::{Clay, Document, SubjectRef};
use fabrica::shell::clays::ClayDesk;
use glam::Vec3;
use serde_json::{Value, json};

/// Bytes of earlier states that may be kept (spec/sweepers.md, B.3), and strokes that they are of.
const MOST_KEPT: usize = 64 << 20;

/// The clay of this recipe, which nothing is said of.
fn clay(recipe: Value) -> Arc<Clay> {
    let document = json!({ "fabrica": 1, "subject": { "clay": recipe } });
    let document = Document::from_value(document).expect("a document");
    assert_eq!(document.notices(), []);
    match &document.illustration().subject {
        SubjectRef::Clay(clay) => Arc::clone(clay),
        other => panic!("{other:?}"),
    }
}

/// What a desk makes of a clay: one whole surface.
fn check(desk: &mut ClayDesk, clay: &Arc<Clay>) -> Check {
    let shaping = desk.shape(clay, &mut |_| true).expect("it is shaped");
    assert_eq!(shaping.left_out(), []);
    assert_eq!(shaping.done(), clay.strokes.len());
    let check = Check::of_clay(&shaping.shaped());
    let whole = (check.euler, check.pieces, check.border_edges);
    assert!(
        check.is_two_manifold() && whole == (2, 1, 0),
        "{}",
        check.lines()
    );
    check
}

/// A place on the unit ball, thousandths of the radius.
fn on_ball(random: &mut Random, radius: f32) -> Vec3 {
    1000.0 * radius * random.vector(-1.0, 1.0).normalize_or(Vec3::X)
}

fn whole(v: Vec3) -> [i32; 3] {
    v.to_array().map(|x| x.round() as i32)
}

/// As many small strokes as a clay may have, pulls and presses and every tenth one that smooths.
fn many(count: usize) -> Value {
    let mut random = Random(0x2000_0019);
    let strokes = (0..count).map(|i| {
        let [x, y, z] = whole(on_ball(&mut random, 0.5));
        let [right, up, ahead] = whole(on_ball(&mut random, 0.03));
        let mut stroke = json!({ "path": [x, y, z, right, up, ahead] });
        if i % 10 == 9 {
            stroke["do"] = json!("smooth");
        }
        stroke
    });
    let strokes: Vec<Value> = strokes.collect();
    json!({ "detail": 0.1, "tools": [{ "radius": 0.06, "coat": 0.08 }], "strokes": strokes })
}

#[test]
fn two_thousand_strokes_are_done_and_taken_back() {
    let clay = clay(many(Clay::MAX_STROKES));
    let mut desk = ClayDesk::default();
    let all = check(&mut desk, &clay);
    println!("{} triangles, {} bytes", all.triangles, desk.bytes());
    assert!(desk.bytes() <= MOST_KEPT, "{}", desk.bytes());
    // The last are taken back without a replay, and are what they were.
    for strokes in (1970..2000).rev() {
        let back = desk.shape(&clay.cut(strokes), &mut |_| panic!("a replay to {strokes}"));
        back.expect("it is there");
    }
    let back = check(&mut desk, &clay.cut(1970)).sha256;
    assert_eq!(
        back,
        check(&mut ClayDesk::default(), &clay.cut(1970)).sha256
    );
    assert_ne!(back, all.sha256);
    // One more is refused.
    let document = json!({ "fabrica": 1, "subject": { "clay": many(Clay::MAX_STROKES + 1) } });
    let refused = Document::from_value(document).expect_err("one stroke too many");
    let refused = refused.to_string();
    assert!(
        refused.starts_with("/subject/clay/strokes: 2001"),
        "{refused}"
    );
}

/// Wherever a replay is stopped, what was done is kept, and the clay becomes what it would have become; undo as well.
#[test]
fn a_replay_that_was_stopped_goes_on_and_is_taken_back() {
    let mut recipe = many(12);
    recipe["detail"] = json!(0.05);
    let clay = clay(recipe);
    let mut anew = ClayDesk::default();
    let whole = check(&mut anew, &clay).sha256;
    let undone = check(&mut anew, &clay.cut(11)).sha256;
    for until in [0.0, 0.3, 0.62, 0.9] {
        let mut desk = ClayDesk::default();
        let stopped = desk.shape(&clay, &mut |part| part < until);
        assert!(stopped.is_err(), "{until}");
        let mut first = None;
        let mut hear = |part: f32| {
            first.get_or_insert(part);
            true
        };
        let went_on = desk.shape(&clay, &mut hear).expect("it goes on").shaped();
        assert_eq!(Check::of_clay(&went_on).sha256, whole, "{until}");
        let first = first.expect("it was not done");
        assert!(first > until - 1.0 / 12.0, "{first} after {until}");
        // Stopped once more, it is taken back.
        let mut other = Clay::clone(&clay);
        other.strokes[5].moves[0].keys[1].at[0] += 10;
        let stopped = desk.shape(&Arc::new(other), &mut |part| part < until);
        assert!(stopped.is_err(), "{until}");
        assert_eq!(check(&mut desk, &clay.cut(11)).sha256, undone, "{until}");
    }
}

/// A tool far thinner than an edge is long, around the clay by as many keys as a path may have.
#[test]
fn a_needle_goes_through_sixty_four_keys() {
    let keys = (0..Clay::MAX_KEYS).map(|i| {
        let angle = 0.09 * i as f32;
        let height = 0.4 * (0.05 * i as f32 - 1.6).sin();
        let wide = 490.0 * (1.0 - height * height).sqrt();
        Vec3::new(wide * angle.cos(), wide * angle.sin(), 490.0 * height)
    });
    let keys: Vec<[i32; 3]> = keys.map(whole).collect();
    let mut path = keys[0].to_vec();
    for pair in keys.windows(2) {
        path.extend([0, 1, 2].map(|axis| pair[1][axis] - pair[0][axis]));
    }
    let clay = clay(
        json!({ "detail": 0.02, "tools": [{ "radius": 0.005, "coat": 0.02 }], "strokes": [{ "path": path }] }),
    );
    let mut desk = ClayDesk::default();
    let check = check(&mut desk, &clay);
    assert_eq!(check.crossing, 0);
    assert!(check.longest_edge.expect("edges") <= clay.detail);
    let start = desk.shape(&clay.cut(0), &mut |_| true).expect("a ball");
    let count = start.vertex_count();
    println!("{} vertices of {count}", check.vertices);
    assert!(check.vertices > count + 300);
}

/// The longest stroke that is done goes to and fro by 500 coats; one of 2,000 is left out at once, and nothing moves.
#[test]
fn long_strokes_are_done_or_left_out() {
    let of = |turns: usize| {
        let mut path = vec![0, 0, 700];
        (0..turns).for_each(|i| path.extend([0, 0, if i % 2 == 0 { -500 } else { 500 }]));
        let coat = if turns > 40 { 0.0125 } else { 0.04 };
        clay(
            json!({ "detail": 0.05, "tools": [{ "radius": 0.1, "coat": coat }],
            "strokes": [{ "path": path, "straight": true }] }),
        )
    };
    let mut desk = ClayDesk::default();
    check(&mut desk, &of(40));
    let mut asked = 0;
    let far = of(50);
    let mut hear = |_| {
        asked += 1;
        true
    };
    let left = desk.shape(&far, &mut hear).expect("a ball");
    assert!(asked < 3, "{asked}");
    let said = left.notices();
    assert!(
        said[0].starts_with("stroke 1 is left out: it takes 16"),
        "{said:?}"
    );
    let left = left.shaped();
    let start = desk.shape(&far.cut(0), &mut |_| true).expect("a ball");
    assert_eq!(left.positions, start.shaped().positions);
}

/// A tool of a shape that this version does not have is kept in texts and links and named; its strokes do nothing.
#[test]
fn unknown_shapes_are_kept_and_named() {
    let cloud = json!({ "shape": "cloud", "density": [3] });
    let recipe = |first: Value| {
        json!({ "detail": 0.05, "tools": [first, { "radius": 0.1 }], "strokes": [
            { "path": [0, 0, 440, 0, 0, 300] }, { "tool": 1, "path": [440, 0, 0, 200, 0, 0] },
            { "tool": 1, "path": [0, 600, 0, 0, -300, 0], "with": [{ "path": [0, -600, 0, 0, 200, 0] }] }] })
    };
    let document = json!({ "fabrica": 1, "subject": { "clay": recipe(cloud.clone()) } });
    let document = Document::from_value(document).expect("a document");
    let said: Vec<String> = document.notices().iter().map(ToString::to_string).collect();
    let named = "/subject/clay/tools/0/shape: this version does not know “cloud”";
    assert!(said.len() == 1 && said[0].starts_with(named), "{said:?}");
    let link = fabrica::link::encode(&document);
    let opened = fabrica::link::decode(&link).expect("a document").document;
    let text: Value = serde_json::from_str(&opened.to_json()).expect("its own text");
    assert_eq!(text["subject"]["clay"]["tools"][0], cloud);
    let SubjectRef::Clay(of_cloud) = &opened.illustration().subject else {
        panic!("a clay")
    };
    let mut desk = ClayDesk::default();
    let shaping = desk.shape(of_cloud, &mut |_| true).expect("a clay");
    let why = "is left out: tool 0 is not there or of a shape that is not known";
    assert_eq!(
        shaping.notices(),
        [1, 3].map(|stroke| format!("stroke {stroke} {why}"))
    );
    let shaped = shaping.shaped();
    let mut known = recipe(json!({}));
    for stroke in [0, 2] {
        known["strokes"][stroke]["off"] = json!(true);
    }
    let known = desk.shape(&clay(known), &mut |_| true).expect("a clay");
    assert_eq!(known.shaped().positions, shaped.positions);
}
