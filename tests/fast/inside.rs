//! What is inside of real meshes, and how deep, against sums and searches over all their triangles in double precision
//! (spec/surfaces.md, "Inside and outside"; Jacobson, Kavan, Sorkine-Hornung 2013).

use crate::data::data_folder;
use crate::scans::{Random, rounds};
use crate::surfaces::surface_of;
use fabrica::data::Surface;
use glam::{DVec3, Vec3};
use std::path::Path;

/// Points of each mesh; `FABRICA_FUZZ_ROUNDS` asks for more.
const POINTS: usize = 300;
/// How far depths may be off, and from how far on the side has to be right, subject units.
const FARTHEST: f64 = 2e-4;
const SURE: f64 = 0.001;

type Corners = [DVec3; 3];

/// Winding number of triangles around a place: the sum of their signed solid angles (Van Oosterom, Strackee 1983).
fn winding(triangles: &[Corners], place: DVec3) -> f64 {
    let solid_angle = |corners: &Corners| {
        let [a, b, c] = corners.map(|corner| corner - place);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    triangles.iter().map(solid_angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Distance of a place to a triangle: to its plane above its inside, else to the nearest of its edges.
fn distance(&[a, b, c]: &Corners, place: DVec3) -> f64 {
    let normal = (b - a).cross(c - a);
    let is_above = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(from, to)| (*to - *from).cross(place - *from).dot(normal) >= 0.0);
    if is_above && normal.length_squared() > 0.0 {
        return (place - a).dot(normal.normalize()).abs();
    }
    let to_edge = |from: DVec3, to: DVec3| {
        let (edge, way) = (to - from, place - from);
        let part = (way.dot(edge) / edge.length_squared().max(1e-300)).clamp(0.0, 1.0);
        (way - edge * part).length()
    };
    to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
}

/// The triangles of a surface as the program has them, but for lids.
fn triangles_of(surface: &Surface) -> Vec<Corners> {
    let own = (0..surface.triangles.len()).filter(|i| !surface.is_lid(*i));
    own.map(|i| surface.triangles[i].0.map(|corner| corner.as_dvec3()))
        .collect()
}

/// Places around a surface, every other one near its triangles, where sides are easily mistaken.
fn places(triangles: &[Corners], count: usize) -> Vec<Vec3> {
    let mut random = Random(0x5eed_1234_9876_4321);
    let mut number = move || random.next() as f64 / (1_u64 << 53) as f64;
    (0..count)
        .map(|i| {
            let mut cube = || DVec3::new(number(), number(), number()) - 0.5;
            let [anywhere, aside] = [cube() * 1.05, cube() * 0.02];
            let [a, b, c] = triangles[(number() * triangles.len() as f64) as usize];
            let beside = (a + b + c) / 3.0 + aside;
            [anywhere, beside][i % 2].as_vec3()
        })
        .collect()
}

/// Compares depths with those by all triangles; `is_asked` leaves out places that nothing is promised of. Returns how
/// many were compared, and how many were on the wrong side.
fn compare(
    what: &str,
    surface: &Surface,
    truth: &[Corners],
    is_asked: impl Fn(DVec3) -> bool,
) -> (usize, usize) {
    let own = triangles_of(surface);
    let (mut worst, mut count, mut wrong) = (0.0_f64, 0, 0);
    for place in places(truth, rounds(POINTS)) {
        let wide = place.as_dvec3();
        let far = |triangles: &[Corners]| {
            let each = triangles.iter().map(|corners| distance(corners, wide));
            each.fold(f64::INFINITY, f64::min)
        };
        let found = f64::from(surface.depth_at(place));
        let exact = far(&own);
        worst = worst.max((found.abs() - exact).abs());
        if far(truth) > SURE && is_asked(wide) {
            count += 1;
            let is_inside = winding(truth, wide).abs() >= 0.5;
            wrong += usize::from(is_inside != (found > 0.0));
        }
    }
    println!("{what}: {count} sides, {wrong} wrong; depths off by at most {worst:.1e}");
    assert!(worst <= FARTHEST, "{what}: {worst}");
    assert!(count > rounds(POINTS) / 2, "{what}: {count}");
    (count, wrong)
}

fn read(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join("mesh").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn depths_of_real_meshes_are_those_of_a_search() {
    let Some(folder) = data_folder("depths of real meshes") else {
        return;
    };
    for name in [
        "bunny.obj",
        "vhf_left_talus.stl",
        "skull_low_resolution.obj",
        "hand_lowres.obj",
    ] {
        let surface = surface_of(name, read(&folder, name));
        let truth = triangles_of(&surface);
        // Lids are as near to where the winding number is ½ as their triangles can be.
        let is_closed = surface.segments.iter().all(|segment| segment.is_closed);
        let away = |place| is_closed || (winding(&truth, place).abs() - 0.5).abs() > 0.01;
        let (_, wrong) = compare(name, &surface, &truth, away);
        assert_eq!(wrong, 0, "{name}");
    }
}

/// An ASCII STL of triangles: nothing in it is welded.
fn stl(triangles: &[Corners]) -> Vec<u8> {
    let mut text = String::from("solid a\n");
    for corners in triangles {
        text += "facet normal 0 0 0\nouter loop\n";
        for corner in corners {
            text += &format!("vertex {} {} {}\n", corner.x, corner.y, corner.z);
        }
        text += "endloop\nendfacet\n";
    }
    (text + "endsolid a\n").into_bytes()
}

#[test]
fn a_mesh_in_disorder_has_the_same_inside() {
    let Some(folder) = data_folder("a mesh in disorder") else {
        return;
    };
    let whole = surface_of("bunny.obj", read(&folder, "bunny.obj"));
    let truth = triangles_of(&whole);
    let mut random = Random(0x0dd0_1234_5678_9abc);
    let mut shuffled = truth.clone();
    for i in (1..shuffled.len()).rev() {
        shuffled.swap(i, random.next() % (i + 1));
    }
    let inside_out: Vec<Corners> = shuffled.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let twice: Vec<Corners> = truth.iter().chain(&shuffled).copied().collect();
    for (what, triangles) in [
        ("unwelded, in random order", &shuffled),
        ("inside out", &inside_out),
        ("every triangle twice", &twice),
    ] {
        let surface = surface_of("bunny.stl", stl(triangles));
        let (_, wrong) = compare(what, &surface, &truth, |_| true);
        assert_eq!(wrong, 0, "{what}");
        let outwards = triangles_of(&surface)
            .iter()
            .map(signed_volume)
            .sum::<f64>();
        assert!(outwards > 0.0, "{what}: fronts are outside");
    }

    let (kept, removed): (Vec<Corners>, Vec<Corners>) = shuffled
        .iter()
        .partition(|_| !random.next().is_multiple_of(20));
    let surface = surface_of("bunny.stl", stl(&kept));
    assert!(!surface.segments[0].is_closed);
    let away = |place: DVec3| removed.iter().all(|gone| distance(gone, place) > 0.02);
    let (count, wrong) = compare("without a twentieth", &surface, &truth, away);
    assert!(100 * wrong <= count, "{wrong} of {count}");
}

/// Six times the volume between a triangle and the origin, positive where the front is away from it.
fn signed_volume(&[a, b, c]: &Corners) -> f64 {
    a.dot(b.cross(c))
}
