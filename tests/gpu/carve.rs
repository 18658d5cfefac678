//! The template `carve` against the page's formula, with a ball and a box, whose distances and depths are known in
//! closed form.

use std::sync::{Arc, LazyLock};

use fabrica::data::{Mesh, Resources, Surface};
use fabrica::document::Document;
use fabrica::placed;
use fabrica::render::{Probe, Sample};
use glam::{DMat3, DVec3, Vec3};

use crate::carved::{Ball, Brick, Solid, carve};
use crate::gpu::gpu;
use crate::scatter::Random;
use crate::surfaces::{ball_mesh, brick_mesh};

/// The ball, made ready once for all tests: of 36,480 triangles that takes seconds.
static BALL: LazyLock<Arc<Surface>> = LazyLock::new(|| carving(&ball_mesh(96)));

fn carving(mesh: &Mesh) -> Arc<Surface> {
    let surface = Surface::new(mesh, None, &mut |_| true).expect("it has a size");
    Arc::new(surface.carving(&mut |_| true).expect("not stopped"))
}

/// A document with one tool, placed and turned, and its carve.
fn document(size: f64, push: f64, reach: f64) -> Document {
    let text = format!(
        r#"{{ "fabrica": 1, "objects": [{{ "src": "tool.stl", "name": "tool", "at": [0.1, -0.05, 0.2],
        "rotate": [0.1825742, 0.3651484, 0.5477226, 0.7302967], "size": {size} }}],
        "templates": [{{ "kind": "carve", "params": {{ "object": "tool", "push": {push}, "reach": {reach} }} }}] }}"#
    );
    let document = Document::from_json(&text).expect("a document");
    assert_eq!(document.notices(), [], "nothing to tell of");
    document
}

fn with_tool(document: &Document, surface: &Arc<Surface>) -> Resources {
    let mut resources = Resources::default();
    let source = document.illustration().objects[0].source.clone();
    resources.objects.push((source, Arc::clone(surface)));
    resources
}

fn probe() -> Probe {
    pollster::block_on(Probe::new(gpu())).expect("the probe compiles")
}

fn ask(probe: &Probe, document: &Document, resources: &Resources, points: &[Vec3]) -> Vec<Sample> {
    let samples = probe.samples(document.illustration(), resources, points);
    pollster::block_on(samples).expect("samples")
}

/// A place of subject space in the tool's own axes, from its middle, subject units.
fn to_tool(document: &Document, pos: Vec3) -> DVec3 {
    let placement = document.illustration().objects[0]
        .placement
        .expect("placed");
    let turn = DMat3::from_quat(placement.rotate.as_dquat().normalize());
    turn.transpose() * (pos - placement.at).as_dvec3()
}

fn from_tool(document: &Document, pos: DVec3) -> Vec3 {
    let placement = document.illustration().objects[0]
        .placement
        .expect("placed");
    let turn = DMat3::from_quat(placement.rotate.as_dquat().normalize());
    (turn * pos).as_vec3() + placement.at
}

/// The page's bound: 1e-3, or half a cell if that is more.
fn bound(size: f64) -> f64 {
    (size / 256.0).max(1e-3)
}

/// Settings: size of the tool, push, reach. Push below and above half the thickness, and below 0. The ball is made of
/// flat triangles, which lean against it by up to a degree: of a larger one the room would differ by more than asked.
const SETTINGS: [[f64; 3]; 6] = [
    [0.3, 0.02, 0.15],
    [0.1, 0.5, 0.3],
    [0.6, 0.1, 0.1],
    [0.5, -0.1, 0.12],
    [0.05, 0.5, 1.0],
    [0.3, 0.0, 0.15],
];

/// Makes the closed form of a tool of some size.
type SolidOf = dyn Fn(f64) -> Box<dyn Solid>;

#[test]
fn carve_is_the_page_s_formula_for_a_ball() {
    let ball: [(_, &SolidOf); 1] = [(Arc::clone(&BALL), &|size| Box::new(Ball(size / 2.0)))];
    compare(&ball, |_| true);
}

#[test]
fn carve_is_the_page_s_formula_for_boxes() {
    compare(&boxes(), |push| push >= 0.0);
}

/// Tissue that closes in goes all of `push` also beside an edge, where the grid turns its direction over a cell or two
/// and not at once.
#[test]
#[ignore = "two to six cells from an edge m is wrong by up to 6 %, and tissue that closes in by that of `push` (issue 15)"]
fn closing_in_is_the_page_s_formula_for_boxes() {
    compare(&boxes(), |push| push < 0.0);
}

fn boxes() -> [(Arc<Surface>, &'static SolidOf); 2] {
    [
        (carving(&brick_mesh(Vec3::new(50.0, 30.0, 40.0))), &|size| {
            Box::new(Brick(DVec3::new(0.5, 0.3, 0.4) * size))
        }),
        (carving(&brick_mesh(Vec3::new(50.0, 4.0, 20.0))), &|size| {
            Box::new(Brick(DVec3::new(0.5, 0.04, 0.2) * size))
        }),
    ]
}

/// Compares each tool in all settings whose push is asked for.
fn compare(tools: &[(Arc<Surface>, &SolidOf)], is_asked: impl Fn(f64) -> bool) {
    let probe = probe();
    for (index, (surface, solid_of)) in tools.iter().enumerate() {
        for [size, push, reach] in SETTINGS.into_iter().filter(|setting| is_asked(setting[1])) {
            let document = document(size, push, reach);
            let resources = with_tool(&document, surface);
            let solid = solid_of(size);
            let mut random = Random(0xCA4E_0000 + index as u64);
            let far = (size / 2.0 + reach) as f32;
            let points: Vec<Vec3> = (0..4000)
                .map(|i| {
                    let near = if i % 2 == 0 { far } else { 0.6 * size as f32 };
                    let place = random.vector(-1.0, 1.0);
                    from_tool(&document, (place * near).as_dvec3())
                })
                .collect();
            let cell = size / 128.0;
            let (mut compared, mut wrong) = (0, 0);
            let mut worst = (0.0, 0.0);
            for (pos, sample) in points
                .iter()
                .zip(ask(&probe, &document, &resources, &points))
            {
                let own = to_tool(&document, *pos);
                // Within two cells of where m or h jumps nothing is asked.
                if solid.jumps_near(own, 2.0 * cell) {
                    continue;
                }
                compared += 1;
                let expected = carve(&*solid, own, push, reach);
                let source = to_tool(&document, sample.pos_in_rest);
                let off = source.distance(expected.source);
                let far_off = (f64::from(sample.continuity) - expected.continuity).abs();
                worst = (f64::max(worst.0, off), f64::max(worst.1, far_off));
                assert!(
                    off <= bound(size),
                    "tool {index}, {size} {push} {reach}: {off} off at {own}, d {}",
                    expected.continuity
                );
                // Walls lie within half a cell; farther away the distance is as good as the way is long.
                assert!(
                    far_off <= cell / 2.0 + 0.01 * expected.continuity.abs(),
                    "tool {index}, {size}: A {} for {} at {own}",
                    sample.continuity,
                    expected.continuity
                );
                // Negative control: with `push` for what the object leaves room for, or with the other sign.
                let other = carve(&*solid, own, -0.7 * push - 0.01, reach);
                wrong += usize::from(source.distance(other.source) > bound(size));
            }
            println!("tool {index}, {size} {push} {reach}: {compared} places, worst {worst:?}");
            assert!(compared > 1500, "only {compared} places are compared");
            assert!(wrong > 100, "only {wrong} places tell the sign");
        }
    }
}

/// Both D and A go over from one side of the wall to the other without a jump.
#[test]
fn displacement_and_continuity_go_on_at_the_wall() {
    let probe = probe();
    let surface = Arc::clone(&BALL);
    let document = document(0.4, 0.1, 0.2);
    let resources = with_tool(&document, &surface);
    let mut random = Random(5);
    let step = 1e-4;
    let mut points = Vec::new();
    for _ in 0..500 {
        let dir = random.vector(-1.0, 1.0).as_dvec3();
        let dir = dir.try_normalize().unwrap_or(DVec3::X);
        for away in [-step, step] {
            points.push(from_tool(&document, dir * (0.2 + away)));
        }
    }
    let samples = ask(&probe, &document, &resources, &points);
    let mut crossed = 0;
    for (pair, places) in samples.chunks(2).zip(points.chunks(2)) {
        let moved = |i: usize| pair[i].pos_in_rest - places[i];
        let jump = moved(0).distance(moved(1));
        assert!(jump < 5e-4, "D jumps by {jump}");
        assert!((pair[0].continuity - pair[1].continuity).abs() < 4.0 * step as f32);
        assert!(moved(1).length() > 0.09, "it is pushed there");
        crossed += usize::from(pair[0].continuity < pair[1].continuity);
    }
    assert_eq!(crossed, 500, "A grows outwards");
}

/// Where there is material the map does not fold: differences over a cell have a positive determinant. With `push`
/// where the object has no room for it the box does.
#[test]
fn nothing_folds_outside_of_the_object() {
    let probe = probe();
    let half = Vec3::new(50.0, 15.0, 30.0);
    let surface = carving(&brick_mesh(half));
    let (size, push, reach) = (0.4, 0.5, 0.2);
    let document = document(size, push, reach);
    let resources = with_tool(&document, &surface);
    let cell = size / 128.0;
    let solid = Brick(half.as_dvec3() / 100.0 * size);
    let mut random = Random(11);
    let mut points = Vec::new();
    let mut centers = Vec::new();
    while centers.len() < 3000 {
        let place = random.vector(-1.0, 1.0).as_dvec3();
        let place = place * (solid.0 + 0.5 * reach);
        if solid.distance(place) < 0.0 {
            continue;
        }
        centers.push(place);
        for axis in DMat3::IDENTITY.to_cols_array_2d().map(DVec3::from_array) {
            points.extend([place - axis * (cell / 2.0), place + axis * (cell / 2.0)]);
        }
    }
    let determinant = |ends: &[DVec3]| {
        let column = |k: usize| (ends[2 * k + 1] - ends[2 * k]) / cell;
        DMat3::from_cols(column(0), column(1), column(2)).determinant()
    };
    let asked: Vec<Vec3> = points
        .iter()
        .map(|pos| from_tool(&document, *pos))
        .collect();
    let samples = ask(&probe, &document, &resources, &asked);
    let sources: Vec<DVec3> = samples
        .iter()
        .map(|sample| to_tool(&document, sample.pos_in_rest))
        .collect();
    let least = sources
        .chunks(6)
        .map(determinant)
        .fold(f64::INFINITY, f64::min);
    assert!(least > 0.0, "least determinant {least}");
    // Without the limit of the page.
    let unlimited = |pos: &DVec3| {
        *pos - solid.outwards(*pos) * push * (1.0 - solid.distance(*pos).max(0.0) / reach)
    };
    let folded: Vec<DVec3> = points.iter().map(unlimited).collect();
    let least = folded
        .chunks(6)
        .map(determinant)
        .fold(f64::INFINITY, f64::min);
    assert!(least < 0.0, "without the limit {least}");
}

/// Grids are made of the object alone: where it is, how large, and how far it pushes change none of them; and a small
/// tool with a wide reach takes little.
#[test]
fn a_small_tool_with_a_wide_reach_takes_little_memory() {
    let surface = carving(&brick_mesh(Vec3::new(50.0, 30.0, 40.0)));
    let carver = surface.carver.as_ref().expect("made");
    assert!(carver.cuts(), "it is thick");
    let bytes = 4 * carver.texels.len();
    assert!(bytes < 64 << 20, "{bytes} bytes");
    let levels = carver.levels_within(1.0 / 0.02);
    assert!(
        levels <= carver.levels.len() && levels > carver.levels_within(1.0),
        "{levels} levels"
    );
    let cube = carving(&brick_mesh(Vec3::splat(50.0)));
    let bytes = 4 * cube.carver.as_ref().expect("made").texels.len();
    assert!(bytes < 16 << 20, "{bytes} bytes of a cube");
    let sheet = carving(&brick_mesh(Vec3::new(50.0, 0.002, 40.0)));
    assert!(
        !sheet.carver.as_ref().expect("made").cuts(),
        "a sheet cuts nothing"
    );
}

/// What the bounds promise holds: beyond the reach nothing moves and nothing is cut, and no material goes farther.
#[test]
fn its_bounds_hold_what_it_does() {
    let probe = probe();
    let surface = carving(&brick_mesh(Vec3::new(50.0, 10.0, 30.0)));
    for [size, push, reach] in SETTINGS {
        let document = document(size, push, reach);
        let resources = with_tool(&document, &surface);
        let template = &document.illustration().templates[0];
        let bounds = placed::reach(template, &resources);
        let mut random = Random(3);
        let place = || random.vector(-1.0, 1.0);
        let places: Vec<Vec3> = std::iter::repeat_with(place).take(2000).collect();
        let far = (size + 2.0 * reach) as f32;
        let scaled = places.iter().enumerate().map(|(i, place)| {
            let far = if i % 2 == 0 { far } else { 0.6 * size as f32 };
            from_tool(&document, (*place * far).as_dvec3())
        });
        let points: Vec<Vec3> = scaled.collect();
        let longest = placed::max_displacement(template, &resources, fabrica::math::Aabb::UNIT);
        let (mut inside, mut moves) = (0, 0);
        for (pos, sample) in points
            .iter()
            .zip(ask(&probe, &document, &resources, &points))
        {
            let q = template.template_from_subject(*pos);
            let moved = sample.pos_in_rest.distance(*pos);
            if bounds.contains(q) {
                inside += 1;
                moves += usize::from(moved > 1e-4);
                assert!(moved <= longest + 1e-4, "{moved} of {longest}");
            } else {
                assert!(moved < 1e-6 && sample.continuity >= 0.0, "{moved} at {q}");
            }
        }
        assert!(inside > 50, "{inside} places in the bounds");
        assert_eq!(moves > 0, push != 0.0, "{moves} move");
    }
}
