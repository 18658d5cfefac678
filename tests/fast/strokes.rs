//! Strokes at their limits: very many, very thin, very long, stopped midway; and none of them folds anything.

use std::sync::Arc;

use crate::long::long_or;
use crate::scatter::Random;
use fabrica::clay::{Check, Way};
use fabrica::data::Grids;
use fabrica::document::{Clay, Document, SubjectRef};
use fabrica::link;
use fabrica::shell::clays::ClayDesk;
use glam::{DMat3, DVec3, Vec3};
use serde_json::{Value, json};

/// Bytes of earlier states that may be kept.
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

/// Fifty strokes on a clay of which as many copies would take ten times the room.
#[test]
fn fifty_strokes_on_a_large_clay_are_taken_back_without_a_replay() {
    let mut recipe = many(53);
    recipe["detail"] = json!(0.008);
    // All of it is moved a little, and so refined.
    let tools = recipe["tools"].as_array_mut();
    tools.expect("tools").push(json!({ "radius": 0.6 }));
    recipe["strokes"][0] = json!({ "tool": 1, "path": [0, 0, 0, 0, 0, 10] });
    let clay = clay(recipe);
    let mut desk = ClayDesk::default();
    let shaped = desk.shape(&clay, &mut |_| true);
    let now = shaped.expect("it is shaped").bytes();
    let kept = desk.bytes() - now;
    println!("{kept} bytes are kept beside {now}");
    assert!(kept <= MOST_KEPT, "{kept}");
    assert!(
        50 * now > 5 * MOST_KEPT,
        "the clay is too small to tell: {now}"
    );
    for strokes in (3..53).rev() {
        let back = desk.shape(&clay.cut(strokes), &mut |_| panic!("a replay to {strokes}"));
        back.expect("it is there");
    }
    let back = check(&mut desk, &clay.cut(3)).sha256;
    assert_eq!(back, check(&mut ClayDesk::default(), &clay.cut(3)).sha256);
}

/// A long replay that is stopped goes on from fifty strokes before at most.
#[test]
fn a_long_replay_goes_on_from_the_last_state_of_fifty() {
    let clay = clay(many(400));
    let mut desk = ClayDesk::default();
    assert!(desk.shape(&clay, &mut |part| part < 0.7).is_err());
    let mut first = None;
    let mut hear = |part: f32| {
        first.get_or_insert(part);
        true
    };
    desk.shape(&clay, &mut hear).expect("it goes on");
    assert!(first.is_some_and(|first| first > 0.55), "{first:?}");
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

/// Strokes of every sort: of balls and of a bar, turned, growing, straight and curved, mirrored, together, smoothing,
/// and one that is switched off.
fn of_every_sort(count: usize) -> Value {
    let mut random = Random(0x1900_0011);
    let strokes = (0..count).map(|i| {
        let [x, y, z] = whole(on_ball(&mut random, 0.48));
        let mut path = vec![x, y, z];
        for _ in 0..1 + i % 3 {
            path.extend(whole(on_ball(&mut random, 0.06)));
        }
        let mut stroke = json!({ "path": path, "tool": i % 3 });
        match i % 8 {
            1 => stroke["turns"] = json!([0, 0, 0, 40, -20, 10]),
            2 => stroke["scales"] = json!([100, 140]),
            3 => stroke["mirror"] = json!("xy"),
            4 => stroke["do"] = json!("smooth"),
            5 => {
                let [x, y, z] = whole(on_ball(&mut random, 0.5));
                stroke["with"] = json!([{ "tool": 1, "path": [x, y, z] }]);
            }
            6 => stroke["straight"] = json!(true),
            7 => stroke["off"] = json!(true),
            _ => {}
        }
        stroke
    });
    let strokes: Vec<Value> = strokes.collect();
    let tools = json!([
        { "radius": 0.08, "coat": 0.1 },
        { "radius": 0.12 },
        { "shape": "capsule", "radius": 0.05, "length": 0.2, "coat": 0.08 }
    ]);
    json!({ "detail": 0.06, "tools": tools, "strokes": strokes })
}

/// What a hand has on its screen after each stroke, one undone and another in its place among them, is bit for bit what
/// somebody sees who opens the link of that moment.
#[test]
fn what_a_hand_shaped_is_what_its_link_gives() {
    let mut live = ClayDesk::default();
    let recipe = of_every_sort(24);
    let mut moments: Vec<Value> = (1..=24)
        .map(|strokes| {
            let mut moment = recipe.clone();
            let list = moment["strokes"].as_array_mut().expect("strokes");
            list.truncate(strokes);
            moment
        })
        .collect();
    let mut other = moments[11].clone();
    other["strokes"][11]["path"] = json!([0, 480, 0, 0, 40, 10]);
    moments.splice(12..12, [moments[10].clone(), other, moments[11].clone()]);
    let mut seen = std::collections::BTreeSet::new();
    for moment in moments {
        let document = json!({ "fabrica": 1, "subject": { "clay": moment } });
        let document = Document::from_value(document).expect("a document");
        let sent = link::encode(&document);
        let opened = link::decode(&sent).expect("a link").document;
        let [here, there] =
            [&document, &opened].map(|document| match &document.illustration().subject {
                SubjectRef::Clay(clay) => Arc::clone(clay),
                other => panic!("{other:?}"),
            });
        let strokes = here.strokes.len();
        let shown = live.shape(&here, &mut |_| true).expect("it is shaped");
        assert_eq!(shown.left_out(), [], "{strokes}");
        let shown = shown.shaped();
        let mut anew = ClayDesk::default();
        let replayed = anew.shape(&there, &mut |_| true).expect("it is shaped");
        let replayed = replayed.shaped();
        assert_eq!(shown.triangles, replayed.triangles, "{strokes} strokes");
        let bits = |list: &[Vec3]| -> Vec<[u32; 3]> {
            list.iter()
                .map(|v| v.to_array().map(f32::to_bits))
                .collect()
        };
        assert_eq!(bits(&shown.positions), bits(&replayed.positions));
        assert_eq!(bits(&shown.normals), bits(&replayed.normals));
        seen.insert(Check::of_clay(&shown).sha256);
    }
    // The strokes switched off change nothing, all others do: every eighth of 24 is off, and one is another.
    assert_eq!(seen.len(), 24 - 3 + 1);
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

/// One to three strokes of one to four tools at once, of every shape that has a formula.
fn random_strokes(random: &mut Random, first: usize) -> Value {
    const SHAPES: [&str; 6] = ["ball", "ellipsoid", "capsule", "box", "torus", "curve"];
    let tools = SHAPES.map(|shape| json!({ "shape": shape, "coat": 0.1 + 0.2 * random.unit() }));
    let strokes = (0..1 + random.index(3)).map(|i| {
        let mirror = ["", "", "x", "yz"][random.index(4)];
        let most = (8 >> mirror.len()).min(4);
        let moves: Vec<Value> = (0..1 + random.index(most))
            .map(|j| {
                let tool = if i + j == 0 { first } else { random.index(6) };
                let mut path = whole(random.vector(-500.0, 500.0)).to_vec();
                let (mut turns, mut scales) = (vec![0, 0, 0], vec![100]);
                for _ in 0..1 + random.index(3) {
                    path.extend(whole(random.vector(-250.0, 250.0)));
                    turns.extend(whole(random.vector(-60.0, 60.0)));
                    scales.push(80 + random.index(50) as i32);
                }
                json!({ "tool": tool, "path": path, "turns": turns, "scales": scales })
            })
            .collect();
        let mut stroke = moves[0].clone();
        stroke["mirror"] = json!(mirror);
        stroke["with"] = moves[1..].iter().cloned().collect();
        stroke
    });
    let strokes: Vec<Value> = strokes.collect();
    json!({ "tools": tools, "strokes": strokes })
}

/// Differences of places so far apart, the clay's space.
const APART: f64 = 1e-6;
/// Columns of both sides that differ by more than this part of their length lie on both sides of a crease.
const CREASE: f64 = 0.02;

/// Determinants of a map at some places by differences; `None` at creases.
fn determinants(places: &[DVec3], map: impl Fn(&mut [DVec3])) -> Vec<Option<f64>> {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
        [-APART, 0.0, APART].map(|by| {
            let mut moved: Vec<DVec3> = places.iter().map(|p| *p + by * axis).collect();
            map(&mut moved);
            moved
        })
    });
    let of = |i: usize| {
        let columns = sides.each_ref().map(|[behind, here, ahead]| {
            let [behind, here, ahead] = [behind[i], here[i], ahead[i]];
            let [one, other] = [here - behind, ahead - here].map(|way| way / APART);
            let is_even = one.distance(other) <= CREASE * one.length().max(other.length());
            is_even.then_some(0.5 * (one + other))
        });
        let [Some(x), Some(y), Some(z)] = columns else {
            return None;
        };
        Some(DMat3::from_cols(x, y, z).determinant())
    };
    (0..places.len()).map(of).collect()
}

/// By the flow in 64 bits that strokes and captions go by. With `FABRICA_LONG` at 100,000 points.
#[test]
fn no_stroke_turns_anything_inside_out() {
    let mut random = Random(0x0d37_0019);
    let (mut creases, mut least, mut moved) = (0, f64::MAX, 0);
    let count = long_or(10_000, 300);
    for round in 0..10 {
        let clay = clay(random_strokes(&mut random, round % 6));
        let way = Way::of(&clay, &Grids::default());
        let places = (0..count).map(|_| random.vector(-0.8, 0.8).as_dvec3());
        let places: Vec<DVec3> = places.collect();
        let forward = |places: &mut [DVec3]| {
            let mut all: Vec<_> = places.iter().map(|p| (*p, DVec3::ZERO)).collect();
            way.forward(&mut all);
            let carried = places.iter_mut().zip(all);
            carried.for_each(|(place, (there, _))| *place = there);
        };
        let mut there = places.clone();
        forward(&mut there);
        moved += (0..count).filter(|i| there[*i] != places[*i]).count();
        for (place, determinant) in places.iter().zip(determinants(&places, forward)) {
            match determinant {
                Some(found) => {
                    assert!(found > 0.0, "round {round}: {found} at {place}");
                    least = least.min(found);
                }
                None => creases += 1,
            }
        }
    }
    println!(
        "{moved} of {} points moved, {creases} at creases, least {least}",
        10 * count
    );
    assert!(moved > 3 * count && creases * 50 < 10 * count);
    // A single step of the paper, twice beyond the bound of spec/sweepers.md, D.2, does turn some inside out.
    let pushed = |places: &mut [DVec3]| {
        for place in places {
            let beyond = ((place.length() - 0.1) / 0.3).clamp(0.0, 1.0);
            let field = (1.0 - beyond).powi(3) * (1.0 + 3.0 * beyond + 6.0 * beyond * beyond);
            place.x += 0.32 * field;
        }
    };
    let places: Vec<DVec3> = (0..1000)
        .map(|_| random.vector(-0.3, 0.3).as_dvec3())
        .collect();
    let turned = determinants(&places, pushed);
    assert!(turned.iter().flatten().any(|found| *found < 0.0));
}
