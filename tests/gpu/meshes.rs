//! Rays meet the triangles of a mesh where a search by brute force finds them, under templates of every sort. The
//! search takes the map alone from the GPU, at small steps, and everything else from the triangles.

use std::sync::Arc;

use crate::data::data_folder;
use crate::gpu::gpu;
use crate::scatter::Random;
use crate::surfaces::{brick, surface_of};
use fabrica::data::Surface;
use fabrica::document::{Document, Illustration};
use fabrica::render::{SliceColors, SlicePlane, SliceView, Studio, View};
use glam::{Vec2, Vec3};

/// Rays of each case.
const RAYS: usize = 60;
/// Step of the search along a ray, subject units.
const STEP: f32 = 1.0 / 1500.0;
/// How far the distance along a ray may be off, subject units: the page's 1e-3, and here half a step for walls of gaps.
const FARTHEST: f32 = 1e-3;
/// Distance of the parallels that tell whether a ray is steady (spec/surfaces.md, "Exactness"), and how far apart what
/// they meet may lie.
const ASIDE: f32 = 0.002;
const STEADY: f32 = 0.02;

fn document(templates: &str, turn: [f32; 4]) -> Document {
    Document::from_json(&format!(
        r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"camera":{{"rotate":{turn:?},"distance":1.6}},"templates":[{templates}]}}"#
    ))
    .expect("a good document")
}

/// Where each ray first meets a triangle or the wall of a gap inside a closed body.
fn search(
    studio: &Studio,
    surface: &Surface,
    shown: &Illustration,
    rays: &[(Vec3, Vec3)],
) -> Vec<Option<f32>> {
    let (first, count) = (0.4, (2.4 / STEP) as usize);
    let t_at = |i: usize| first + i as f32 * STEP;
    let points: Vec<Vec3> = rays
        .iter()
        .flat_map(|(eye, dir)| (0..count).map(|i| *eye + *dir * t_at(i)))
        .collect();
    let samples = pollster::block_on(studio.probe_object(shown, &points)).expect("samples");
    let is_inside = |place: Vec3| {
        let segment = surface.segment_at(place);
        segment.is_some_and(|segment| surface.segments[segment].is_closed)
    };
    samples
        .chunks(count)
        .map(|along| {
            along.windows(2).zip(0..).find_map(|(pair, i)| {
                let [a, b] = [pair[0], pair[1]];
                if b.continuity < 0.0 {
                    return None;
                }
                let is_jump = a.pos_in_rest.distance(b.pos_in_rest) > 12.0 * STEP + 1e-4;
                if a.continuity < 0.0 || is_jump {
                    return is_inside(b.pos_in_rest).then(|| t_at(i) + 0.5 * STEP);
                }
                let mut nearest = f32::INFINITY;
                let (from, to) = (a.pos_in_rest, b.pos_in_rest);
                surface
                    .tree
                    .crossings(&surface.triangles, from, to, |_, part, _| {
                        nearest = nearest.min(part);
                    });
                nearest.is_finite().then(|| t_at(i) + nearest * STEP)
            })
        })
        .collect()
}

/// Compares rays through random pixels. Returns how many meet something and how many steady ones are wrong.
fn compare(studio: &Studio, surface: &Surface, document: &Document, seed: u64) -> (usize, usize) {
    let shown = document.illustration();
    let size = [300, 300];
    let view = View::new(&shown.camera, size);
    let mut random = Random(seed);
    let pixels: Vec<Vec2> = (0..RAYS)
        .map(|_| Vec2::new(random.between(40.0, 260.0), random.between(40.0, 260.0)))
        .collect();
    let rays: Vec<(Vec3, Vec3)> = pixels.iter().map(|&pixel| view.ray(pixel)).collect();
    let found = pollster::block_on(studio.depths(shown, size, &pixels)).expect("depths");
    let expected = search(studio, surface, shown, &rays);
    let is_off = |found: Option<f32>, expected: Option<f32>| match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() > FARTHEST,
        (None, None) => false,
        _ => true,
    };
    let mut wrong = 0;
    for (i, (&found, &expected)) in found.iter().zip(&expected).enumerate() {
        if !is_off(found, expected) {
            continue;
        }
        let (eye, dir) = rays[i];
        let side = dir.any_orthonormal_vector();
        let sides = [side, -side, dir.cross(side), -dir.cross(side)];
        let parallels = sides.map(|aside| (eye + aside * ASIDE, dir));
        let beside = search(studio, surface, shown, &parallels);
        let is_like = |other: &Option<f32>| match (*other, expected) {
            (Some(other), Some(expected)) => (other - expected).abs() < STEADY,
            (None, None) => true,
            _ => false,
        };
        let is_steady = beside.iter().all(is_like);
        println!("ray {i}: found {found:?}, expected {expected:?}, steady: {is_steady}");
        wrong += usize::from(is_steady);
    }
    (expected.iter().flatten().count(), wrong)
}

const CASES: [&str; 8] = [
    "",
    r#"{"kind":"twist","size":[0.9,0.9,0.6],"params":{"angle":2.6}}"#,
    r#"{"kind":"poke","at":[0.05,0.1,0.2],"size":[0.15,0.15,0.15]}"#,
    r#"{"kind":"split","at":[0,0,0.1],"size":[0.8,0.9,0.8]}"#,
    r#"{"kind":"peel","at":[0,0.15,0.1],"rotate":[-0.70710678,0,0,0.70710678],"size":[0.7,0.6,0.4],"params":{"progress":0.6}}"#,
    r#"{"kind":"hole","at":[0.1,0,0.1],"size":[0.4,0.5,0.4]},{"kind":"bend","size":[1,0.6,0.6],"params":{"angle":0.9}}"#,
    r#"{"kind":"wave","size":[1,1,1]},{"kind":"slices","at":[0,0,0],"size":[1,0.9,0.7]}"#,
    r#"{"kind":"move","at":[0.1,0.1,0.1],"size":[0.4,0.4,0.4]},{"kind":"twist","size":[0.7,0.7,0.7]}"#,
];

/// Checks the cases whose numbers are even or odd: each has programs of its own, which take long to compile.
fn check(surface: &Arc<Surface>, what: &str, wants_grid: bool, parity: usize) {
    let turns = [[0.0, 0.0, 0.0, 1.0], [0.3, 0.2, 0.5, 0.787_4]];
    let subject = Arc::clone(surface).into();
    let studio = Studio::new(gpu(), &subject, wants_grid).expect("it fits");
    let (mut rays, mut met, mut wrong) = (0, 0, 0);
    for (case, templates) in CASES.iter().enumerate().filter(|(i, _)| i % 2 == parity) {
        let document = document(templates, turns[case / 2 % 2]);
        let (hits, off) = compare(&studio, surface, &document, 11 + case as u64);
        println!("{what}: {hits} of {RAYS} met, {off} wrong: {templates}");
        (rays, met, wrong) = (rays + RAYS, met + hits, wrong + off);
    }
    assert!(
        met * 2 > rays,
        "{what}: few rays meet anything: {met} of {rays}"
    );
    assert!(
        wrong * 1000 <= rays,
        "{what}: {wrong} of {rays} steady rays are wrong"
    );
}

/// A slice shows what is filled, and lines where the surface is; its numbers are segments and depths.
#[test]
fn slices_show_what_is_filled() {
    let surface = brick();
    let studio = Studio::new(gpu(), &Arc::clone(&surface).into(), false).expect("it fits");
    let document = document(
        r#"{"kind":"split","at":[0,0,0.1],"size":[0.8,0.9,0.8]}"#,
        [0.0, 0.0, 0.0, 1.0],
    );
    let shown = document.illustration();
    let size_px = [120, 120];
    let plane = SlicePlane {
        corner: Vec3::new(-0.6, 0.6, 0.2),
        right: Vec3::X * 0.01,
        down: Vec3::NEG_Y * 0.01,
    };
    let read = studio.read_slice(shown, &plane, size_px).expect("asked");
    let texels = pollster::block_on(read).expect("read");
    let view = SliceView {
        plane,
        size_px,
        colors: SliceColors::Look,
        marked: None,
        samples: 1,
        background_srgb: [255; 3],
    };
    let image = pollster::block_on(studio.slice_image(shown, &view)).expect("drawn");
    let (mut filled, mut lines, mut empty) = (0, 0, 0);
    for (texel, pixel) in texels.iter().zip(image.rgba.chunks_exact(4)) {
        let own = surface
            .segment_at(texel.pos_in_rest)
            .filter(|_| texel.continuity >= 0.0);
        let depth = surface.depth_at(texel.pos_in_rest);
        if depth.abs() > 0.02 && texel.continuity.abs() > 0.02 {
            assert_eq!(texel.is_there, own.is_some(), "{texel:?}");
            // Beyond the field there is no more than its edge.
            let is_near = depth > -0.015;
            let off = (texel.value - depth).abs();
            assert!(
                !is_near || off < 0.2 * depth.abs() + 0.004,
                "{texel:?} {depth}"
            );
        }
        match pixel[0] {
            255 => empty += 1,
            0..=140 => lines += 1,
            _ => filled += 1,
        }
    }
    assert!(
        filled > 2000 && empty > 2000,
        "{filled} filled, {empty} empty"
    );
    assert!((150..1500).contains(&lines), "{lines} pixels of lines");
}

/// Wires lie on the edges of triangles and are about as wide as a pixel, whatever the size of the picture and wherever
/// templates move the triangles: across the front of a box the diagonal alone, between its two sides.
#[test]
fn wires_are_the_edges_of_triangles() {
    let surface = brick();
    let studio = Studio::new(gpu(), &Arc::clone(&surface).into(), false).expect("it fits");
    let twist = r#"{"kind":"twist","size":[1.2,1.2,1.2],"params":{"angle":0.5}}"#;
    for (templates, side) in [("", 160), ("", 320), (twist, 320)] {
        let document = document(templates, [0.0, 0.0, 0.0, 1.0]);
        let plain = document.illustration();
        let mut wired = plain.clone();
        wired.look.has_wires = true;
        let [plain, wired] = [plain, &wired].map(|shown| {
            let drawing = studio.render_image(shown, [side, side], 1);
            pollster::block_on(drawing).expect("drawn").rgba
        });
        let is_wire = |x: u32, y: u32| {
            let at = 4 * (y * side + x) as usize;
            let [was, is] = [&plain, &wired].map(|rgba| i32::from(rgba[at + 1]));
            assert!(is <= was, "a wire is darker");
            was - is > 25
        };
        let all = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
        let share = all.filter(|(x, y)| is_wire(*x, *y)).count() as f32 / (side * side) as f32;
        assert!((0.2..6.0).contains(&(share * side as f32)), "{share}");
        // A row above the middle.
        let row: Vec<bool> = (0..side).map(|x| is_wire(x, side * 9 / 20)).collect();
        let runs: Vec<usize> = row
            .chunk_by(|a, b| a == b)
            .filter(|run| run[0])
            .map(<[bool]>::len)
            .collect();
        assert!(
            (1..=3).contains(&runs.len()),
            "{templates} {side}: {runs:?}"
        );
        assert!(
            runs.iter().all(|run| *run <= 4),
            "{templates} {side}: {runs:?}"
        );
    }
}

#[test]
fn rays_meet_a_box_where_a_search_finds_it() {
    check(&brick(), "box", false, 0);
}

#[test]
fn rays_meet_a_scanned_figure_where_a_search_finds_it() {
    let Some(folder) = data_folder("rays meet a scanned figure") else {
        return;
    };
    let bytes = std::fs::read(folder.join("mesh/bunny.obj")).expect("the bunny");
    check(&surface_of("bunny.obj", bytes), "bunny", true, 1);
}
