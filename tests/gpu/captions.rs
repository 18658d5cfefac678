//! Captions follow their tissue: points of rest space are found in the deformed object, by asking the object what it
//! has there.

use crate::gpu::{builtin, gpu, studio_of};
use fabrica::document::Document;
use fabrica::render::Studio;
use glam::Vec3;

fn studio(name: &str) -> Studio {
    studio_of(gpu(), &builtin(name, 48), false)
}

fn document(templates: &str) -> Document {
    Document::from_json(&format!(
        r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"templates":[{templates}]}}"#
    ))
    .expect("a good document")
}

/// What the object has at points on a lattice of odd places, as far as it has something there: (subject space, rest
/// space).
fn material(studio: &Studio, document: &Document) -> Vec<(Vec3, Vec3)> {
    let mut points = Vec::new();
    for i in 0..14 * 14 * 14 {
        let at = Vec3::new((i % 14) as f32, (i / 14 % 14) as f32, (i / 196) as f32);
        points.push((at + Vec3::new(0.31, 0.47, 0.13)) / 14.0 * 1.3 - 0.65);
    }
    let samples = pollster::block_on(studio.probe_object(document.illustration(), &points));
    let samples = samples.expect("samples");
    let pairs = points.into_iter().zip(samples);
    pairs
        .filter(|(_, s)| s.continuity > 0.02 && s.pos_in_rest.abs().max_element() < 0.49)
        .map(|(point, s)| (point, s.pos_in_rest))
        .collect()
}

#[test]
fn points_are_found_where_their_tissue_went() {
    let studio = studio("cube");
    let mut found = 0;
    for (templates, wanted) in [
        ("", 1.0),
        (
            r#"{"kind":"twist","size":[0.8,0.8,0.8],"params":{"angle":70}}"#,
            0.99,
        ),
        (
            r#"{"kind":"bend","size":[1,0.5,0.5],"params":{"angle":60}}"#,
            0.97,
        ),
        (
            r#"{"kind":"peel","at":[0,0.2,0.4],"size":[0.7,0.5,0.25],"params":{"progress":0.6}}"#,
            0.97,
        ),
        (
            r#"{"kind":"split","at":[0,0,0.3],"size":[0.8,0.8,0.6]}"#,
            0.97,
        ),
        (
            r#"{"kind":"flap","at":[0,0.1,0.4],"size":[0.6,0.6,0.2],"align":{"to":"segment","keep":["bottom"]}},{"kind":"poke","at":[0.2,-0.2,0.4]}"#,
            0.97,
        ),
    ] {
        let document = document(templates);
        let pairs = material(&studio, &document);
        assert!(pairs.len() > 500, "{templates}: {} points", pairs.len());
        let rest: Vec<Vec3> = pairs
            .iter()
            .map(|(_, rest)| *rest)
            .step_by(7)
            .take(256)
            .collect();
        let shown = document.illustration();
        let places = pollster::block_on(studio.follow_points(shown, &rest)).expect("places");
        assert_eq!(places.len(), rest.len());
        let there: Vec<(Vec3, Vec3)> = rest
            .iter()
            .zip(&places)
            .filter_map(|(rest, place)| Some((*rest, (*place)?)))
            .collect();
        let part = there.len() as f32 / rest.len() as f32;
        println!("{part:.3} of {} found: {templates}", rest.len());
        assert!(part >= wanted, "{part} found: {templates}");
        // Where a point is found, the object has it.
        let points: Vec<Vec3> = there.iter().map(|(_, place)| *place).collect();
        let samples = pollster::block_on(studio.probe_object(shown, &points)).expect("samples");
        for ((rest, place), sample) in there.iter().zip(samples) {
            assert!(
                sample.continuity >= 0.0,
                "{rest} at {place} is a gap: {templates}"
            );
            let off = sample.pos_in_rest.distance(*rest);
            assert!(
                off < 0.009,
                "{rest} at {place} is off by {off}: {templates}"
            );
        }
        found += there.len();
        if templates.is_empty() {
            let most = there
                .iter()
                .map(|(a, b)| a.distance(*b))
                .fold(0.0, f32::max);
            assert!(most < 1e-6, "nothing moved: {most}");
        }
    }
    assert!(found > 900);
}

#[test]
fn what_is_cut_away_is_nowhere() {
    let studio = studio("cube");
    let document = document(r#"{"kind":"cut","at":[0,0,0.5],"size":[2,2,0.6]}"#);
    let rest = [
        Vec3::new(0.1, 0.1, 0.4),
        Vec3::new(0.1, 0.1, -0.2),
        Vec3::splat(1e30),
        Vec3::NAN,
    ];
    let places = pollster::block_on(studio.follow_points(document.illustration(), &rest));
    let places = places.expect("places");
    assert_eq!(places[0], None, "it lay in the cut");
    assert!(
        places[1].is_some_and(|at| at.distance(rest[1]) < 1e-6),
        "it stayed"
    );
    assert_eq!(places[2], Some(rest[2]), "far away nothing happens");
    assert_eq!(places[3], None);
    let none = pollster::block_on(studio.follow_points(document.illustration(), &[]));
    assert!(none.expect("nothing is asked").is_empty());
}
