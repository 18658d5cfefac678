//! Objects stand in the scene at their true depth, before, in and behind what the templates move, and stay as they are.

use std::sync::Arc;

use crate::gpu::{builtin, gpu};
use crate::scatter::Random;
use crate::surfaces::brick;
use fabrica::data::{Mesh, Resources, Subject, Surface};
use fabrica::document::{Document, Illustration};
use fabrica::render::{Meeting, RayEvent, Studio};
use glam::{Quat, Vec3};

/// Rays of each case.
const RAYS: usize = 300;
/// How far an object may be off, subject units: the page's bound where no template reaches.
const FARTHEST: f32 = 1e-4;
/// Half of the brick's sides in its own space.
const HALF: Vec3 = Vec3::new(0.5, 0.3, 0.4);

const PEEL: &str = r#"{"kind":"peel","at":[0,0.3,0.1],"rotate":[-0.70710678,0,0,0.70710678],"size":[0.6,0.6,0.4]}"#;
const SPLIT: &str = r#"{"kind":"split","at":[0,0,0.1],"size":[0.8,0.9,0.8]}"#;

/// A brick at a place, opaque or half clear.
fn document(at: Vec3, turn: Quat, opacity: f32, templates: &str) -> Document {
    Document::from_json(&format!(
        r##"{{"fabrica":1,"subject":{{"builtin":"cube"}},"objects":[{{"src":"off.stl","enabled":false}},
            {{"src":"brick.stl","name":"brick","at":{:?},"rotate":{:?},"size":0.4,"opacity":{opacity},"color":"#2060c0"}}],
            "look":{{"body":"solid"}},"templates":[{templates}]}}"##,
        at.to_array(),
        turn.to_array(),
    ))
    .expect("a good document")
}

fn with_brick(studio: &Studio, shown: &Illustration, brick: &Arc<Surface>) -> Studio {
    let source = shown.objects[1].source.clone();
    studio.clone().with_resources(Resources {
        objects: vec![(source, Arc::clone(brick))],
        ..Resources::default()
    })
}

/// Where a ray enters and leaves the brick.
fn through_brick(shown: &Illustration, (origin, dir): (Vec3, Vec3)) -> Option<[f32; 2]> {
    let placed = shown.objects[1].placement.expect("it has a place");
    let back = placed.rotate.inverse();
    let start = back * (origin - placed.at) / placed.size;
    let along = back * dir / placed.size;
    let (a, b) = ((-HALF - start) / along, (HALF - start) / along);
    let (enters, leaves) = (a.min(b).max_element(), a.max(b).min_element());
    (enters <= leaves && enters > 0.0).then_some([enters, leaves])
}

/// Rays towards a place, from its side of the subject.
fn rays(random: &mut Random, at: Vec3) -> Vec<(Vec3, Vec3)> {
    let mut inside = |most: f32| {
        Vec3::new(
            random.between(-most, most),
            random.between(-most, most),
            random.between(-most, most),
        )
    };
    (0..RAYS)
        .map(|_| {
            let origin = (at + inside(0.4)).normalize_or(Vec3::Y) * 2.0;
            (origin, (at + inside(0.25) - origin).normalize())
        })
        .collect()
}

fn events(studio: &Studio, shown: &Illustration, rays: &[(Vec3, Vec3)]) -> Vec<Option<RayEvent>> {
    pollster::block_on(studio.events(shown, rays)).expect("events")
}

/// Every ray meets the nearest of the brick and what it would meet without it. `tolerance`: how far the subject's event
/// may move where a half clear brick lies before it, for tissue that is no surface.
fn check(subject: &Subject, templates: &str, tolerance: f32) {
    let brick = brick();
    let studio = Studio::new(gpu(), subject, true).expect("it fits");
    let mut random = Random(5);
    let turn = Quat::from_xyzw(0.2, 0.3, 0.1, 0.927_361_85).normalize();
    let (mut objects, mut behind) = (0, 0);
    for at in [
        Vec3::new(0.1, 0.55, 0.1),
        Vec3::new(0.0, 0.1, 0.1),
        Vec3::new(-0.1, -0.6, 0.0),
    ] {
        let rays = rays(&mut random, at);
        let clear = document(at, turn, 0.0, templates);
        let bare = events(&studio, clear.illustration(), &rays);
        for opacity in [1.0, 0.5] {
            let document = document(at, turn, opacity, templates);
            let shown = document.illustration();
            let found = events(&with_brick(&studio, shown, &brick), shown, &rays);
            for ((ray, bare), found) in rays.iter().zip(&bare).zip(&found) {
                let brick = through_brick(shown, *ray);
                let own = bare.as_ref().map_or(f32::INFINITY, |event| event.distance);
                // The second face of a half clear brick is what makes a ray more than half opaque.
                let stop =
                    brick.map_or(
                        f32::INFINITY,
                        |[enters, leaves]| {
                            if opacity == 1.0 { enters } else { leaves }
                        },
                    );
                if (stop - own).abs() < tolerance.max(1e-3) {
                    continue;
                }
                let Some(found) = found else {
                    assert!(
                        stop.min(own).is_infinite(),
                        "{ray:?}: nothing, {stop} {own}"
                    );
                    continue;
                };
                if stop < own {
                    assert_eq!(found.meeting, Meeting::Object, "{ray:?} {stop} {own}");
                    assert!((found.distance - stop).abs() < FARTHEST, "{found:?} {stop}");
                    assert_eq!(found.segment, Some(1), "its place in the document");
                    assert!(
                        found.normal.dot(ray.1) <= 1e-5,
                        "towards the eye: {found:?}"
                    );
                    objects += 1;
                } else {
                    let off = (found.distance - own).abs();
                    let is_before = brick.is_some_and(|[enters, _]| enters < own);
                    let allowed = if is_before { tolerance } else { 1e-5 };
                    assert!(off <= allowed, "{ray:?}: {found:?}, alone {own}");
                    assert_eq!(
                        Some(found.meeting),
                        bare.as_ref().map(|event| event.meeting)
                    );
                    behind += usize::from(is_before);
                }
            }
        }
    }
    println!("{objects} rays end at the brick, {behind} go through it");
    assert!(objects > 100 && behind > 10, "{objects} {behind}");
}

#[test]
fn objects_stand_before_in_and_behind_an_opened_scan() {
    check(&Subject::from(builtin("head", 96)), PEEL, 0.03);
}

#[test]
fn objects_stand_before_in_and_behind_a_cut_mesh() {
    let apple: Mesh = fabrica::subjects::mesh("apple").expect("it is built in");
    let surface = Surface::new(&apple, None, &mut |_| true).expect("it has a size");
    check(&Subject::from(Arc::new(surface)), SPLIT, 1e-4);
}
