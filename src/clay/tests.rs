//! What a clay promises (spec/sweepers.md, B.1), on the recipes of `suite.rs`.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::check::Check;
use super::error::ClayError;
use super::mesh::{ClayMesh, Vertex};
use super::motion::Motion;
use super::refine::MAX_TRIANGLES;
use super::shaping::{Shaped, Shaping};
use super::suite::{ball, clay, key, place, stroke, suite};
use super::way::Way;
use super::{LeftOut, Space};
use crate::data::mesh::testing::cube;
use crate::data::{DistanceGrid, Grids};
use crate::displace::{ToolFile, ToolShape};
use crate::document::{Clay, ClayKey, ClayMove, ClayShape, ClayStart, ClayStroke, ClayTool};

/// Recipes whose measure by the way back says nothing: they stretch a thousandfold along the normal, so that the last
/// bit of a place lies many triangles away in the starting shape.
const LONG: [&str; 1] = ["spiral"];
/// Recipes with rims that are sharper than an edge may be short: their normals are not measured.
const SHARP_RIMS: [&str; 2] = ["spiral", "wring"];

fn shape_each(clay: &Clay, each: &mut dyn FnMut(&Shaping)) -> Shaping {
    let mut shaping = Shaping::new(clay).unwrap();
    for _ in &clay.strokes {
        shaping.stroke(clay, &mut |_| true).unwrap();
        each(&shaping);
    }
    shaping
}

fn shape(clay: &Clay) -> Shaping {
    shape_each(clay, &mut |_| {})
}

fn with_strokes(mut clay: Clay, strokes: Vec<ClayStroke>) -> Clay {
    clay.strokes = strokes;
    clay
}

/// The nearest point of a starting shape, and the normal there.
fn nearest(shape: ClayShape, pos: DVec3) -> (DVec3, DVec3) {
    let on_box = |half: DVec3| {
        let core = half - 0.02;
        let inner = pos.clamp(-core, core);
        let out = (pos - inner).normalize();
        (inner + 0.02 * out, out)
    };
    match shape {
        ClayShape::Ball => (0.5 * pos.normalize(), pos.normalize()),
        ClayShape::Cube => on_box(DVec3::splat(0.5)),
        ClayShape::Plate => on_box(DVec3::new(0.5, 0.5, 0.075)),
        ClayShape::Torus => {
            let ring = 0.35 * DVec3::new(pos.x, pos.y, 0.0).normalize();
            let out = (pos - ring).normalize();
            (ring + 0.15 * out, out)
        }
    }
}

#[test]
fn starting_shapes_are_closed_exact_and_even() {
    for (shape, name) in ClayShape::ALL.into_iter().zip(ClayShape::NAMES) {
        for detail in [0.004, 0.015, 0.02, 0.05, 0.1] {
            let mut clay = clay(shape, &[ball(0.1, 0.1)]);
            clay.detail = detail;
            let shaped = Shaping::new(&clay).unwrap().shaped();
            let check = Check::of(&shaped.positions, &shaped.triangles, None);
            let euler = if shape == ClayShape::Torus { 0 } else { 2 };
            assert!(
                check.is_two_manifold() && check.border_edges == 0,
                "{name} {detail}"
            );
            assert_eq!((check.euler, check.pieces, check.crossing), (euler, 1, 0));
            assert!(
                check.longest_edge.unwrap() <= detail.max(0.015),
                "{name} {detail}"
            );
            for (pos, normal) in shaped.positions.iter().zip(&shaped.normals) {
                let (on, out) = nearest(shape, pos.as_dvec3());
                let off = on.distance(pos.as_dvec3());
                assert!(off < detail / 40.0, "{name} {detail} {pos} {off}");
                assert!(out.dot(normal.as_dvec3()) > 0.99, "{name} {detail} {pos}");
            }
            let box_of = shaped.positions.iter().copied();
            let [least, most] =
                [box_of.clone().reduce(Vec3::min), box_of.reduce(Vec3::max)].map(Option::unwrap);
            assert!(
                ((most - least).max_element() - 1.0).abs() < 1e-3,
                "{name} {detail}"
            );
        }
    }
}

#[test]
fn every_stroke_leaves_one_whole_surface() {
    for (name, clay) in suite() {
        let mut strokes = 0;
        shape_each(&clay, &mut |shaping| {
            strokes += 1;
            let check = Check::of_clay(&shaping.shaped());
            let at = format!("{name} {strokes}: {}", check.lines());
            assert!(check.is_two_manifold() && check.border_edges == 0, "{at}");
            assert_eq!(
                (check.euler, check.pieces, check.crossing),
                (2, 1, 0),
                "{at}"
            );
            assert!(check.longest_edge.unwrap() <= clay.detail, "{at}");
            assert!(shaping.left_out().is_empty() && shaping.full_since().is_none());
        });
        assert_eq!(strokes, clay.strokes.len());
    }
}

/// The same check catches a map that folds: a sub-step of the paper ten times beyond its bound.
#[test]
fn a_fold_is_seen() {
    let clay = clay(ClayShape::Plate, &[ball(0.1, 0.1)]);
    let mut shaped = Shaping::new(&clay).unwrap().shaped();
    let tool = DVec3::new(0.0, 0.0, 0.175);
    for pos in &mut shaped.positions {
        let distance = (pos.as_dvec3().distance(tool) - 0.1).max(0.0);
        let (field, _) = super::field::falloff(distance / 0.1);
        *pos -= Vec3::Z * (0.5 * field) as f32;
    }
    assert!(Check::of_clay(&shaped).crossing > 0);
}

/// The measure of the spec: a vertex is taken back through the exact inverses, the nearest point of the starting shape
/// is carried forward again, and the distance of the two counts; and the normals.
#[test]
fn the_mesh_stands_for_the_exact_sweep() {
    for (name, clay) in suite() {
        if LONG.contains(&name) {
            continue;
        }
        let ClayStart::Shape(start) = clay.from else {
            unreachable!("the suite begins with built-in shapes")
        };
        let shaped = shape(&clay).shaped();
        let way = Way::of(&clay, &Grids::default());
        let all = shaped.positions.iter().zip(&shaped.normals).step_by(3);
        let seen: Vec<_> = all.map(|(p, n)| (p.as_dvec3(), n.as_dvec3())).collect();
        let mut exact = seen.clone();
        way.back(&mut exact);
        for vertex in &mut exact {
            *vertex = nearest(start, vertex.0);
        }
        way.forward(&mut exact);
        let (mut off, mut angles) = (Vec::new(), Vec::new());
        for ((pos, normal), (exact, out)) in seen.into_iter().zip(exact) {
            off.push(exact.distance(pos) / clay.detail);
            angles.push(out.angle_between(normal).to_degrees());
        }
        let most = |values: &mut Vec<f64>, part: f64| {
            values.sort_by(f64::total_cmp);
            values[((values.len() - 1) as f64 * part) as usize]
        };
        let [most_of, all] = [0.99, 1.0].map(|part| most(&mut off, part));
        assert!(
            most_of < 0.25 && all < 1.0,
            "{name}: {most_of} {all} of the detail"
        );
        if !SHARP_RIMS.contains(&name) {
            let degrees = most(&mut angles, 0.99);
            assert!(degrees < 5.0, "{name}: normals {degrees}° off");
        }
    }
}

/// Distance of a place from a triangle.
fn from_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let from_edge = |a: DVec3, b: DVec3| {
        let along = b - a;
        let part = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        p.distance(a + part * along)
    };
    let normal = (b - a).cross(c - a);
    let is_inner = |a: DVec3, b: DVec3| normal.dot((b - a).cross(p - a)) >= 0.0;
    if is_inner(a, b) && is_inner(b, c) && is_inner(c, a) {
        return (p - a).dot(normal.normalize()).abs();
    }
    from_edge(a, b).min(from_edge(b, c)).min(from_edge(c, a))
}

#[test]
fn a_coarse_mesh_lies_on_a_fine_one() {
    for (_, clay) in suite().into_iter().filter(|(name, _)| LONG.contains(name)) {
        let mut fine = clay.clone();
        fine.detail = 0.5 * clay.detail;
        let [coarse, fine] = [&clay, &fine].map(|clay| shape(clay).shaped());
        let touched = coarse.positions.iter().zip(&coarse.touched);
        let touched = touched.filter(|(_, is_touched)| **is_touched);
        for (pos, _) in touched.step_by(23) {
            let pos = pos.as_dvec3();
            let corners = |t: &[u32; 3]| t.map(|v| fine.positions[v as usize].as_dvec3());
            let distances = fine
                .triangles
                .iter()
                .map(|t| from_triangle(pos, corners(t)));
            let off = distances.fold(f64::INFINITY, f64::min);
            assert!(off < 0.1 * clay.detail, "{pos} {off}");
        }
    }
}

#[test]
fn strokes_touch_only_what_they_reach() {
    let of = |keys: [[i32; 3]; 2]| {
        let clay = clay(ClayShape::Ball, &[ball(0.1, 0.1)]);
        with_strokes(clay, vec![stroke(&keys.map(place))])
    };
    let start = Shaping::new(&of([[0; 3]; 2])).unwrap().shaped();
    // The coating ends 0.01 inside the surface, or outside of it.
    for keys in [[[0, 0, -250], [0, 0, 290]], [[800, 0, -300], [800, 0, 400]]] {
        let shaped = shape(&of(keys)).shaped();
        assert_eq!(shaped.positions, start.positions);
        assert_eq!(shaped.triangles, start.triangles);
    }
    let pushed = shape(&of([[0, 0, 700], [0, 0, 300]])).shaped();
    let is_reached = |pos: &Vec3| {
        let on_way = Vec3::Z * pos.z.clamp(0.3, 0.7);
        pos.distance(on_way) < 0.2
    };
    let bits = |pos: &Vec3| pos.to_array().map(f32::to_bits);
    let after: std::collections::BTreeSet<_> = pushed.positions.iter().map(bits).collect();
    let outside = start.positions.iter().filter(|pos| !is_reached(pos));
    assert!(outside.clone().count() > 5000);
    assert!(outside.into_iter().all(|pos| after.contains(&bits(pos))));
}

#[test]
fn a_tool_that_holds_all_of_it_carries_it_rigidly() {
    for shape_of in ClayShape::ALL {
        let clay = clay(shape_of, &[ball(1.0, 0.5)]);
        let turned = [place([0; 3]), key([150, -80, 40], [40, 70, -25], 100)];
        let clay = with_strokes(clay, vec![stroke(&turned)]);
        let start = Shaping::new(&clay).unwrap().shaped();
        let carried = shape(&clay).shaped();
        assert_eq!(carried.triangles, start.triangles, "{shape_of:?}");
        for [a, b, _] in &start.triangles {
            let length = |shaped: &Shaped| {
                let [a, b] = [a, b].map(|v| shaped.positions[*v as usize].as_dvec3());
                a.distance(b)
            };
            assert!((length(&start) - length(&carried)).abs() < 2e-6);
        }
    }
}

#[test]
fn mirrored_strokes_leave_mirrored_clay() {
    let mut clay = clay(ClayShape::Ball, &[ball(0.1, 0.15)]);
    let mut pull = stroke(&[[150, 100, 400], [300, 150, 700], [450, 100, 750]].map(place));
    pull.mirror = [true, false, false];
    let mut press = stroke(&[[60, -550, 0], [40, -300, 50]].map(place));
    press.mirror = [true, false, true];
    clay.strokes = vec![pull, press];
    let shaped = shape(&clay).shaped();
    let triangles: Vec<[DVec3; 3]> = shaped
        .triangles
        .iter()
        .map(|t| t.map(|v| shaped.positions[v as usize].as_dvec3()))
        .collect();
    let touched = shaped.positions.iter().zip(&shaped.touched);
    for (pos, _) in touched.filter(|(_, is_touched)| **is_touched).step_by(11) {
        let image = pos.as_dvec3() * DVec3::new(-1.0, 1.0, 1.0);
        let distances = triangles.iter().map(|t| from_triangle(image, *t));
        let off = distances.fold(f64::INFINITY, f64::min);
        assert!(off < 0.25 * clay.detail, "{pos} {off}");
    }
    let all = shaped.positions.iter().zip(&shaped.normals);
    let on_plane: Vec<_> = all.filter(|(pos, _)| pos.x.abs() < 1e-5).collect();
    assert!(on_plane.len() > 50);
    assert!(on_plane.iter().all(|(_, normal)| normal.x.abs() < 1e-3));
}

#[test]
fn a_tool_pressed_into_one_huge_triangle_shapes_it() {
    let (corners, triangles) = cube();
    let corner = |corner: &Vec3| {
        let pos = corner.as_dvec3() - 0.5;
        Vertex::new(pos, pos.normalize())
    };
    let vertices: Vec<Vertex> = corners.iter().map(corner).collect();
    // Beside the diagonal of the upper face.
    let clay = with_strokes(
        clay(ClayShape::Cube, &[ball(0.06, 0.06)]),
        vec![stroke(&[[200, -200, 650], [200, -200, 450]].map(place))],
    );
    let mesh = ClayMesh::new(vertices, triangles).unwrap();
    let mut shaping = Shaping::of(mesh, Space::default(), clay.detail);
    shaping.stroke(&clay, &mut |_| true).unwrap();
    let shaped = shaping.shaped();
    let check = Check::of_clay(&shaped);
    assert_eq!((check.euler, check.crossing, check.border_edges), (2, 0, 0));
    assert!(check.longest_edge.unwrap() <= clay.detail);
    let deepest = shaped
        .positions
        .iter()
        .filter(|pos| pos.distance(Vec3::new(0.2, -0.2, 0.39)) < 0.02);
    assert!(deepest.count() > 3);
}

#[test]
fn the_way_back_is_the_inverse() {
    for (name, clay) in suite() {
        let way = Way::of(&clay, &Grids::default());
        let shaped = shape(&clay).shaped();
        let mut far = 0;
        let all = shaped.positions.iter().step_by(37);
        let places: Vec<_> = all.map(|pos| (pos.as_dvec3(), DVec3::ZERO)).collect();
        let mut agains = places.clone();
        way.back(&mut agains);
        way.forward(&mut agains);
        for ((pos, _), (again, _)) in places.into_iter().zip(agains) {
            far += usize::from(again.distance(pos) > 1e-4);
            assert!(again.distance(pos) < 1e-3, "{name} {pos} {again}");
        }
        assert!(far < 5, "{name} {far}");
    }
}

#[test]
fn smoothing_takes_wrinkles_away_and_leaves_the_rest() {
    let mut clay = clay(ClayShape::Ball, &[ball(0.03, 0.04), ball(0.2, 0.1)]);
    for x in [-120, -40, 40, 120] {
        clay.strokes
            .push(stroke(&[[x, 0, 600], [x, 0, 440]].map(place)));
    }
    let wrinkled = shape(&clay).shaped();
    let mut smooth = stroke(&[[-150, 0, 450], [150, 0, 450]].map(place));
    smooth.smooth = Some(100);
    smooth.moves[0].tool = 1;
    clay.strokes.push(smooth);
    let smoothed = shape(&clay).shaped();
    let area = |shaped: &Shaped| -> f64 {
        let areas = shaped.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|v| shaped.positions[v as usize].as_dvec3());
            0.5 * (b - a).cross(c - a).length()
        });
        areas.sum()
    };
    assert!(area(&smoothed) < area(&wrinkled) - 0.005);
    let check = Check::of_clay(&smoothed);
    assert!(check.is_two_manifold() && check.border_edges == 0);
    assert_eq!(check.euler, 2);
    assert!(check.longest_edge.unwrap() <= clay.detail);
    let below = |shaped: &Shaped| -> Vec<Vec3> {
        let low = shaped.positions.iter().filter(|pos| pos.z < 0.0);
        low.copied().collect()
    };
    assert_eq!(below(&smoothed), below(&wrinkled));
}

/// However many keys tell a way, it is smoothed at the same places of it.
#[test]
fn smoothing_heeds_the_way_and_not_its_keys() {
    let places = |count: i32, is_straight: bool| -> Vec<f64> {
        let keys: Vec<ClayKey> = (0..count)
            .map(|i| place([230 * i / (count - 1), 0, 500]))
            .collect();
        let mut one = stroke(&keys);
        one.smooth = Some(100);
        one.moves[0].is_straight = is_straight;
        let clay = with_strokes(clay(ClayShape::Cube, &[ball(0.1, 0.1)]), vec![one]);
        let motion = Motion::new(&clay, (0, &clay.strokes[0]), &Grids::default()).unwrap();
        let moments = motion.moments().unwrap().into_iter();
        let balls = moments.map(|moment| motion.step(moment).balls[0]);
        balls.map(|ball| ball.middle.x).collect()
    };
    // 4.6 times half a coating.
    let expected = [0.0, 0.046, 0.092, 0.138, 0.184, 0.23];
    for (count, is_straight) in [(2, true), (3, true), (3, false), (11, false), (24, true)] {
        let found = places(count, is_straight);
        let pairs = found.iter().zip(expected);
        let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(
            found.len() == expected.len() && off < 1e-3,
            "{count} keys, straight {is_straight}: {found:?}"
        );
    }
}

#[test]
fn what_cannot_be_done_is_named_and_left_out() {
    let mut clay = clay(ClayShape::Ball, &[ball(0.005, 0.01)]);
    clay.tools.push(ClayTool {
        shape: None,
        coat: 0.1,
    });
    let far = stroke(&[[0, 0, 0], [9000, 0, 0], [0, 0, 0]].map(place));
    let of = |tool| {
        let mut stroke = stroke(&[[0, 0, 700], [0, 0, 300]].map(place));
        stroke.moves[0].tool = tool;
        stroke
    };
    let mut off = of(0);
    off.is_off = true;
    // A straight way is told of as a whole, too: 18 units, in eighths of a coating.
    let straight = stroke(&[[-9000, 0, 0], [9000, 0, 0]].map(place));
    clay.strokes = vec![far, of(1), of(7), off, straight, of(0)];
    let shaping = shape(&clay);
    let [
        (0, LeftOut::TooLong { steps }),
        (1, LeftOut::NoTool(1)),
        (2, LeftOut::NoTool(7)),
        (4, LeftOut::TooLong { steps: 14_400 }),
    ] = shaping.left_out()
    else {
        panic!("{:?}", shaping.left_out());
    };
    assert!(*steps > 10_000);
    assert_eq!(shaping.done(), 6);
    let start = Shaping::new(&clay).unwrap().shaped();
    assert_ne!(shaping.shaped().positions, start.positions);
    clay.from = ClayStart::Unknown("egg".to_owned());
    assert_eq!(
        Shaping::new(&clay).unwrap_err(),
        ClayError::UnknownStart("egg".to_owned())
    );
}

#[test]
fn a_stroke_stops_when_asked() {
    let (_, clay) = suite().swap_remove(0);
    let mut shaping = Shaping::new(&clay).unwrap();
    let mut asked = 0;
    let stopped = shaping.stroke(&clay, &mut |part| {
        assert!((0.0..=1.0).contains(&part));
        asked += 1;
        asked < 3
    });
    assert_eq!(stopped, Err(ClayError::Stopped));
    // A long stroke tells the part of all its steps.
    let (_, clay) = suite().swap_remove(3);
    let mut parts = Vec::new();
    let mut hear = |part: f32| {
        parts.push(part);
        true
    };
    let done = Shaping::new(&clay).unwrap().stroke(&clay, &mut hear);
    assert_eq!(done, Ok(()));
    assert!(parts.len() > 8 && parts.is_sorted() && parts[parts.len() - 1] < 1.0);
}

#[test]
fn at_the_limit_of_triangles_it_goes_on_without_splitting() {
    let mut clay = clay(ClayShape::Ball, &[ball(0.1, 0.1), ball(0.5, 0.2)]);
    clay.detail = 0.004;
    let small = stroke(&[[0, 0, 700], [0, 0, 650]].map(place));
    let mut large = stroke(&[[0, 0, 20], [0, 0, 60]].map(place));
    large.moves[0].tool = 1;
    clay.strokes = vec![small, large.clone(), large];
    let shaping = shape(&clay);
    assert_eq!(shaping.full_since(), Some(1));
    let said = format!(
        "since stroke 2 the clay has {MAX_TRIANGLES} triangles, and no edge is split any more"
    );
    assert_eq!(shaping.notices(), [said]);
    let bytes = shaping.bytes() / shaping.vertex_count();
    assert!(bytes <= 200, "{bytes} bytes a vertex");
    let shaped = shaping.shaped();
    assert!(shaped.triangles.len() <= MAX_TRIANGLES + 2);
    let check = Check::of(&shaped.positions, &shaped.triangles, None);
    assert!(check.is_two_manifold() && check.border_edges == 0);
    assert_eq!(check.euler, 2);
}

/// The mesh of [`sixty_strokes_give_the_same_bits`].
const SIXTY_STROKES: &str = "312f5618ae6afbb73458d949ac3dd90a974d8dd4ab40c3c14d4a605bc9d7b43c";

/// A recipe of sixty strokes: its mesh is the same, bit for bit, in every build and on every machine. The hash changes
/// with the mesher, and only then.
#[test]
fn sixty_strokes_give_the_same_bits() {
    let mut state = 5_u32;
    let mut draw = |below: i32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((i64::from(state >> 8) * i64::from(below)) >> 24) as i32
    };
    let boxed = ClayTool {
        shape: Some(ToolShape::Box {
            half: Vec3::new(0.1, 0.05, 0.08),
            round: 0.02,
        }),
        coat: 0.08,
    };
    let mut clay = clay(ClayShape::Ball, &[ball(0.08, 0.1), boxed]);
    clay.detail = 0.03;
    for i in 0..60 {
        let at = [draw(1000) - 500, draw(1000) - 500, draw(1000) - 500];
        let way = [draw(160) - 80, draw(160) - 80, draw(160) - 80];
        let to = [0, 1, 2].map(|axis| at[axis] + way[axis]);
        let turn = [draw(60), draw(60), 0];
        let mut stroke = stroke(&[place(at), key(to, turn, 90 + draw(20))]);
        stroke.moves[0].tool = i % 2;
        stroke.mirror[0] = i % 3 == 0;
        stroke.smooth = (i % 7 == 6).then_some(60);
        if i % 5 == 4 {
            stroke.moves.push(ClayMove {
                tool: 0,
                keys: vec![place(to)],
                is_straight: false,
            });
        }
        clay.strokes.push(stroke);
    }
    let shaping = shape(&clay);
    assert!(shaping.left_out().is_empty());
    let check = Check::of_clay(&shaping.shaped());
    assert_eq!((check.euler, check.border_edges), (2, 0));
    assert!(check.is_two_manifold());
    assert_eq!(check.sha256, SIXTY_STROKES, "{}", check.lines());
}

/// The clay itself after so many strokes, as a tool.
fn baked(strokes: u32, longest: f32) -> ClayTool {
    ClayTool {
        shape: Some(ToolShape::Clay { strokes, longest }),
        coat: 0.1,
    }
}

/// A stroke of another tool than the first.
fn by_tool(tool: usize, keys: &[ClayKey]) -> ClayStroke {
    let mut stroke = stroke(keys);
    stroke.moves[0].tool = tool;
    stroke
}

/// A ball baked out of the clay presses as a ball does, within the cells of its grid.
#[test]
fn a_baked_ball_presses_as_a_ball() {
    let way = [place([0, 100, 700]), place([0, 60, 480])];
    let [made, exact] = [baked(0, 0.3), ball(0.15, 0.1)].map(|tool| {
        let clay = with_strokes(clay(ClayShape::Ball, &[tool]), vec![stroke(&way)]);
        let shaping = shape(&clay);
        assert_eq!(shaping.left_out(), []);
        let check = Check::of_clay(&shaping.shaped());
        assert!(check.is_two_manifold(), "{}", check.lines());
        assert_eq!((check.euler, check.pieces, check.border_edges), (2, 1, 0));
        (clay, shaping)
    });
    let cell = 0.3 * DistanceGrid::CELL;
    let [way_of, exactly] = [&made, &exact].map(|(clay, shaping)| Way::of(clay, shaping.grids()));
    let mut moved = 0.0_f64;
    for i in 0..200 {
        let turn = f64::from(i) * 2.4;
        let height = 1.0 - f64::from(i) / 200.0;
        let out = (1.0 - height * height).sqrt();
        let at = 0.5 * DVec3::new(out * turn.cos(), out * turn.sin(), height);
        let [by_grid, by_ball] = [&way_of, &exactly].map(|way| way.forward_of(at));
        // Where the tissue was taken along a way of two coatings, a distance that is a little off is off again.
        assert!(by_grid.distance(by_ball) < 2.0 * cell, "{at}");
        moved = moved.max(by_ball.distance(at));
    }
    assert!(moved > 0.1, "{moved}");
}

/// What is baked on the way is the same whenever it is baked, and captions go with it.
#[test]
fn a_clay_is_baked_after_its_strokes() {
    let tools = [ball(0.12, 0.1), baked(1, 0.25)];
    let strokes = vec![
        stroke(&[place([0, 0, 450]), place([0, 0, 650])]),
        by_tool(1, &[key([700, 0, 0], [0, 90, 0], 100), place([450, 0, 0])]),
        by_tool(
            1,
            &[place([-700, 0, 0]), key([-450, 0, 0], [0, 0, 40], 120)],
        ),
    ];
    let clay = with_strokes(clay(ClayShape::Ball, &tools), strokes);
    let shaping = shape_each(&clay, &mut |shaping| assert!(!shaping.lacks(&clay)));
    assert_eq!(shaping.left_out(), []);
    let check = Check::of_clay(&shaping.shaped());
    assert!(check.is_two_manifold(), "{}", check.lines());
    assert_eq!((check.euler, check.border_edges), (2, 0));
    let again = shape(&clay);
    assert_eq!(Check::of_clay(&again.shaped()).sha256, check.sha256);
    let [(after, grid)] = &shaping.grids().baked[..] else {
        panic!("one tool was baked")
    };
    assert_eq!(*after, 1);
    // Longer than wide: a ball with a nose.
    let nodes = grid.nodes();
    assert!(nodes.z == 48 && nodes.x < 46, "{nodes}");
    let way = Way::of(&clay, shaping.grids());
    let at = DVec3::new(0.5, 0.0, 0.0);
    let there = way.forward_of(at);
    assert!(there.x < 0.4, "{there}");
    assert!(way.back_of(there).distance(at) < 1e-3);
    assert_eq!(Way::of(&clay, &Grids::default()).forward_of(at), at);
    // One that goes on from a state in which nothing was kept lacks it.
    let plain = with_strokes(clay.clone(), clay.strokes[..1].to_vec());
    let mut late = with_strokes(clay.clone(), clay.strokes[..1].to_vec());
    late.strokes.push(stroke(&[place([0, 450, 0])]));
    let two = shape(&late);
    assert!(!shape(&plain).lacks(&clay) && two.lacks(&clay));
}

#[test]
fn tools_of_later_strokes_and_of_no_file_hold_nothing_and_are_named() {
    let mesh = ClayTool {
        shape: ToolShape::named("mesh"),
        coat: 0.1,
    };
    let tools = [baked(2, 0.3), baked(2000, 0.3), baked(1, 0.3), mesh];
    let way = [place([0, 0, 600]), place([0, 0, 400])];
    let strokes = (0..4).map(|tool| by_tool(tool, &way));
    let clay = with_strokes(clay(ClayShape::Ball, &tools), strokes.collect());
    let start = Shaping::new(&clay).unwrap().shaped();
    let shaping = shape(&clay);
    let wanted = [
        (0, LeftOut::OfItself(0)),
        (1, LeftOut::OfItself(1)),
        (3, LeftOut::NoMesh(3)),
    ];
    assert_eq!(shaping.left_out(), wanted);
    assert_ne!(shaping.shaped().positions, start.positions);
    let said = shaping.notices().join("\n");
    for part in [
        "stroke 1 is left out: tool 0",
        "a tool of stroke 4 holds nothing: the mesh of tool 3",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    // Without the one that is baked in time nothing moves.
    let mut still = clay.clone();
    still.strokes[2].is_off = true;
    assert_eq!(shape(&still).shaped().positions, start.positions);
}

/// A file's grid is the tool that the file is.
#[test]
fn a_mesh_presses_where_its_grid_is_there() {
    let (positions, triangles) = cube();
    let grid = DistanceGrid::of_mesh(&positions, &triangles, true, &mut |_| true);
    let grid = Arc::new(grid.expect("not stopped"));
    let file = ToolFile {
        src: Some("cube.stl".to_owned()),
        ..ToolFile::default()
    };
    let tool = ClayTool {
        shape: Some(ToolShape::Mesh { file, longest: 0.3 }),
        coat: 0.1,
    };
    let way = [place([0, 0, 800]), place([0, 0, 580])];
    let clay = with_strokes(clay(ClayShape::Ball, &[tool]), vec![stroke(&way)]);
    let mut shaping = Shaping::new(&clay)
        .unwrap()
        .with_meshes(&[("cube.stl".to_owned(), grid)]);
    shaping.stroke(&clay, &mut |_| true).unwrap();
    assert_eq!(shaping.left_out(), []);
    let check = Check::of_clay(&shaping.shaped());
    assert!(
        check.is_two_manifold() && check.euler == 2,
        "{}",
        check.lines()
    );
    // Its lower side is at 0.43.
    let down = Way::of(&clay, shaping.grids()).forward_of(DVec3::new(0.0, 0.0, 0.5));
    assert!(down.z < 0.44 && down.z > 0.3, "{down}");
    assert_eq!(shape(&clay).left_out(), [(0, LeftOut::NoMesh(0))]);
}
