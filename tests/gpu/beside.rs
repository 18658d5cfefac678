//! Meshes beside a volume: both are in one scene, in the order of their depth, moved by the same templates.

use std::sync::Arc;

use crate::gpu::{builtin, gpu};
use crate::scatter::Random;
use fabrica::data::{FIRST_MESH_LABEL, Mesh, MeshPart, Subject, Surface};
use fabrica::document::{Document, Illustration};
use fabrica::render::{Fillings, Meeting, RayEvent, SlicePlane, Studio, View};
use glam::{DVec3, Vec2, Vec3};

/// Rays of each case.
const RAYS: usize = 300;

const PEEL: &str = r#"{"kind":"peel","at":[0,0.3,0.1],"rotate":[-0.70710678,0,0,0.70710678],"size":[0.6,0.6,0.4]}"#;
const TWIST: &str =
    r#"{"kind":"twist","at":[0,0.2,0.1],"size":[0.7,0.7,0.7],"params":{"angle":1.2}}"#;
const KEPT: &str = r#"{"kind":"twist","at":[0,0.2,0.1],"size":[0.7,0.7,0.7],"params":{"angle":1.2},
    "align":{"to":"segment","keep":["ball"]}}"#;
/// How far the place at which a ray turns half opaque in tissue may move, subject units: a step of its march, whose
/// first sample lies elsewhere where a mesh makes a cell visible.
const STEP: f32 = 0.006;

/// A ball of triangles around a point, in a space of this unit (mm) about the origin.
fn ball(middle: Vec3, radius: f32, unit_mm: f64) -> Arc<Surface> {
    let (around, along) = (48_u32, 24_u32);
    let mut mesh = Mesh::default();
    let place = |i: u32, k: u32| {
        let (a, b) = (
            std::f32::consts::TAU * (i % around) as f32 / around as f32,
            std::f32::consts::PI * k as f32 / along as f32,
        );
        let out = Vec3::new(b.sin() * a.cos(), b.sin() * a.sin(), b.cos());
        (middle + radius * out) * unit_mm as f32
    };
    for k in 0..=along {
        let ring = if k == 0 || k == along { 1 } else { around };
        mesh.positions.extend((0..ring).map(|i| place(i, k)));
    }
    let index = |i: u32, k: u32| match k {
        0 => 0,
        k if k == along => 1 + (along - 1) * around,
        k => 1 + (k - 1) * around + i % around,
    };
    for k in 0..along {
        for i in 0..around {
            let quad = [
                index(i, k),
                index(i, k + 1),
                index(i + 1, k + 1),
                index(i + 1, k),
            ];
            let both = [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]];
            let is_whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
            mesh.triangles.extend(both.into_iter().filter(is_whole));
        }
    }
    mesh.parts.push(MeshPart {
        name: "ball".to_owned(),
        triangles: 0..mesh.triangles.len(),
    });
    let half = DVec3::splat(0.5 * unit_mm);
    let surface = Surface::of(&[(&mesh, None)], Some([-half, half]), &mut |_| true);
    Arc::new(surface.expect("it has a size"))
}

/// A head with a ball beside its tissue.
fn head_with_ball(middle: Vec3, radius: f32) -> Subject {
    let head = Subject::from(builtin("head", 96));
    let unit_mm = head.mm_per_unit().expect("it has a size");
    head.with_meshes(Some(ball(middle, radius, unit_mm)))
}

fn shown(look: &str, templates: &str) -> Illustration {
    let json = format!(
        r#"{{"fabrica":1,"subject":{{"builtin":"head","meshes":[{{"src":"ball.stl"}}]}},
            "look":{{"segments":{{"ball":{look}}}}},"templates":[{templates}]}}"#
    );
    let document = Document::from_json(&json).expect("a good document");
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    document.illustration().clone()
}

fn rays(random: &mut Random, at: Vec3) -> Vec<(Vec3, Vec3)> {
    let mut inside = |most: f32| {
        let mut one = || random.between(-most, most);
        Vec3::new(one(), one(), one())
    };
    (0..RAYS)
        .map(|_| {
            let origin = (at + inside(0.4)).normalize_or(Vec3::Y) * 2.0;
            (origin, (at + inside(0.15) - origin).normalize())
        })
        .collect()
}

fn events(studio: &Studio, shown: &Illustration, rays: &[(Vec3, Vec3)]) -> Vec<Option<RayEvent>> {
    pollster::block_on(studio.events(shown, rays)).expect("events")
}

fn studio(subject: &Subject) -> Studio {
    Studio::new(gpu(), subject, true).expect("it fits")
}

/// Every ray meets the nearest of what it meets in the head alone and of what it meets in the mesh alone, opaque and
/// half clear, before, in and behind tissue.
#[test]
fn rays_meet_the_nearest_of_scan_and_mesh() {
    let mut random = Random(11);
    let head = Subject::from(builtin("head", 96));
    let alone = studio(&head);
    let (mut meshes, mut tissue, mut through) = (0, 0, 0);
    for (middle, templates) in [
        (Vec3::new(0.1, 0.4, 0.3), ""),
        (Vec3::new(0.05, 0.25, 0.15), PEEL),
        (Vec3::new(0.0, 0.1, 0.1), PEEL),
    ] {
        let both = head_with_ball(middle, 0.12);
        let mesh = both.surface().expect("it has a mesh").clone();
        let (both, mesh) = (studio(&both), studio(&Subject::from(mesh)));
        let rays = rays(&mut random, middle);
        for opacity in [1.0, 0.5] {
            let shown = shown(
                &format!(r#"{{"opacity":{opacity},"body":"hollow"}}"#),
                templates,
            );
            let found = events(&both, &shown, &rays);
            let of_head = events(&alone, &shown, &rays);
            let of_mesh = events(&mesh, &shown, &rays);
            let shown = self::shown(r#"{"body":"hollow"}"#, templates);
            let first = events(&mesh, &shown, &rays);
            for (i, ray) in rays.iter().enumerate() {
                let far = |event: &Option<RayEvent>| event.map_or(f32::INFINITY, |e| e.distance);
                let (own, stop, first) = (far(&of_head[i]), far(&of_mesh[i]), far(&first[i]));
                // Where both are at one place either may come first, and haze before a surface of a half clear mesh
                // may turn a ray opaque before it.
                let facing = of_head[i].map_or(1.0, |event| -event.normal.dot(ray.1));
                let slack = if first < own { 0.03 } else { STEP };
                // A ray that grazes tissue goes a long way in its skin.
                let slack = slack.max(STEP / facing.max(0.1));
                if (stop - own).abs() < slack {
                    continue;
                }
                let Some(event) = found[i] else {
                    assert!(
                        stop.min(own).is_infinite(),
                        "{ray:?}: nothing, {stop} {own}"
                    );
                    continue;
                };
                if stop < own {
                    let allowed = if templates.is_empty() { 1e-4 } else { 1e-3 };
                    let off = (event.distance - stop).abs();
                    if event.meeting != Meeting::Volume {
                        assert!(off < allowed, "{ray:?}: {event:?}, {stop} {own}");
                        assert_eq!(event.segment, Some(0), "{event:?}");
                        assert_eq!(Some(event.meeting), of_mesh[i].map(|event| event.meeting));
                        meshes += 1;
                    } else {
                        // Thin tissue between the two crossings of a half clear mesh.
                        assert!(
                            opacity < 1.0 && first < event.distance,
                            "{ray:?}: {event:?}"
                        );
                    }
                } else {
                    assert_eq!(event.meeting, Meeting::Volume, "{ray:?}: {event:?}");
                    let off = (event.distance - own).abs();
                    assert!(off <= slack, "{ray:?}: {event:?}, alone {own}");
                    tissue += 1;
                    through += usize::from(first < own);
                }
            }
        }
    }
    println!(
        "{meshes} rays end at the mesh, {tissue} in tissue, {through} of them through the mesh"
    );
    assert!(
        meshes > 200 && tissue > 200 && through > 20,
        "{meshes} {tissue} {through}"
    );
}

/// A solid mesh takes the place of the tissue that it lies in, for rays and for slices.
#[test]
fn a_solid_mesh_takes_the_place_of_tissue() {
    let middle = Vec3::new(0.0, 0.1, 0.1);
    let subject = head_with_ball(middle, 0.12);
    let both = studio(&subject);
    let clear = shown(r#"{"body":"solid","opacity":0.3}"#, "");
    // From its middle outwards: the cut face that the ray begins in, the skin, and the tissue behind it; inside of the
    // clear ball there is nothing of the head.
    let dirs = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::Z, Vec3::NEG_Z];
    let rays = dirs.map(|dir| (middle, dir));
    for (found, hollow) in events(&both, &clear, &rays).iter().zip(events(
        &both,
        &shown(r#"{"body":"hollow","opacity":0.3}"#, ""),
        &rays,
    )) {
        let found = found.expect("something is met");
        assert!(found.distance > 0.118, "nothing is in the ball: {found:?}");
        let hollow = hollow.expect("something is met");
        assert!(
            hollow.distance < 0.06,
            "tissue is in a hollow one: {hollow:?}"
        );
    }
    let solid = shown(r#"{"body":"solid"}"#, PEEL);
    let fillings = Fillings::of(&subject, &solid.look).expect("it has meshes");
    let plane = SlicePlane {
        corner: Vec3::new(-0.32, 0.1, 0.42),
        right: 0.01 * Vec3::X,
        down: -0.01 * Vec3::Z,
    };
    let texels = both.read_slice(&solid, &plane, [64, 64]).expect("a slice");
    let texels = pollster::block_on(texels).expect("numbers");
    let (mut filled, mut other) = (0, 0);
    for texel in texels.iter().filter(|texel| texel.is_there) {
        let is_filled = fillings.at(texel.pos_in_rest).is_some();
        let near = (texel.pos_in_rest - middle).length() - 0.12;
        if near.abs() > 2e-3 {
            assert_eq!(
                texel.segment == Some(FIRST_MESH_LABEL),
                is_filled,
                "{texel:?}"
            );
            filled += usize::from(is_filled);
            other += usize::from(!is_filled);
        }
    }
    assert!(filled > 100 && other > 500, "{filled} {other}");
}

/// What a template is told to keep of a mesh stays to the bit, with the tissue in it, and nothing else gets into it.
#[test]
fn a_segment_of_a_mesh_is_kept_beside_tissue() {
    let middle = Vec3::new(0.0, 0.25, 0.1);
    let subject = head_with_ball(middle, 0.12);
    let both = studio(&subject);
    let surface = subject.surface().expect("it has a mesh");
    let kept = shown("{}", KEPT);
    let mut random = Random(3);
    let points: Vec<Vec3> = (0..2000)
        .map(|_| {
            let mut one = || random.between(-0.2, 0.2);
            middle + Vec3::new(one(), one(), one())
        })
        .collect();
    let samples = pollster::block_on(both.probe_object(&kept, &points)).expect("samples");
    let moved =
        pollster::block_on(both.probe_object(&shown("{}", TWIST), &points)).expect("samples");
    let (mut inside, mut would_move) = (0, 0);
    for ((point, sample), moved) in points.iter().zip(&samples).zip(&moved) {
        if surface.depth_at(*point) > 1e-4 {
            inside += 1;
            would_move += usize::from(moved.pos_in_rest != *point || moved.continuity < 0.0);
            assert_eq!(sample.pos_in_rest, *point, "it stays to the bit");
            assert!(sample.continuity >= 0.0, "{point}");
        } else if sample.continuity >= 0.0 {
            let depth = surface.depth_at(sample.pos_in_rest);
            assert!(depth < 1e-4, "{point}: what is kept is here too: {depth}");
        }
    }
    println!("{inside} points are kept, {would_move} of them would move");
    assert!(inside > 100 && would_move > 50, "{inside} {would_move}");
}

/// A caption on the mesh is in sight where the mesh is, and not through it.
#[test]
fn captions_lie_on_meshes() {
    let middle = Vec3::new(0.0, 0.45, 0.2);
    let both = studio(&head_with_ball(middle, 0.1));
    let shown = shown(r#"{"gloss":0.3}"#, "");
    let view = View::new(&shown.camera, [200, 150]);
    let to_eye = (view.eye() - middle).normalize();
    let points = [middle + 0.1 * to_eye, middle - 0.1 * to_eye];
    let places = pollster::block_on(both.follow_points(&shown, &points)).expect("places");
    for (place, point) in places.iter().zip(points) {
        let place = place.expect("it is found");
        assert!((place - point).length() < 2e-3, "{place} {point}");
    }
    let pixels: Vec<Vec2> = points
        .iter()
        .filter_map(|p| view.pixel_from_subject(*p))
        .collect();
    let picks = pixels.iter().map(|pixel| {
        let pick = pollster::block_on(both.pick(&shown, [200, 150], *pixel));
        pick.expect("a pick").expect("something is there")
    });
    let picks: Vec<_> = picks.collect();
    assert_eq!(picks[0].segment, Some(FIRST_MESH_LABEL));
    assert!(
        (picks[0].pos_in_subject - points[0]).length() < 3e-3,
        "{:?}",
        picks[0]
    );
    assert!(
        (picks[1].pos_in_subject - points[1]).length() > 0.1,
        "it is behind: {:?}",
        picks[1]
    );
}
