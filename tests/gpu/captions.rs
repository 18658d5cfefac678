//! Captions follow their tissue: points of rest space are found in the deformed object, by asking the object what it
//! has there.

use crate::cli::fabrica_with;
use crate::data::data_folder;
use crate::gpu::{builtin, gpu, studio_of};
use crate::scans::read_volume_at;
use crate::scatter::Random;
use fabrica::clay::Way;
use fabrica::data::{Grids, VolumeBuilder};
use fabrica::document::{Align, Document, Illustration, SubjectRef, TemplateKind};
use fabrica::load::{LoadReport, ReadOptions};
use fabrica::render::{Studio, View, caption_places};
use glam::{Vec2, Vec3};

/// Farthest that the tissue at a caption's place may have been from the caption's point at rest, subject units: half a
/// voxel of a volume of 256.
const FARTHEST: f32 = 0.5 / 256.0;

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
                off < FARTHEST,
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

/// What is in sight: (subject space, rest space), a little under the surfaces that a grid of rays meets. A search by
/// brute force for the tissue that a caption can be fastened to.
fn in_sight(studio: &Studio, shown: &Illustration) -> Vec<(Vec3, Vec3)> {
    const SIDE: u32 = 40;
    let pixels: Vec<Vec2> = (0..SIDE * SIDE)
        .map(|i| Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5)
        .collect();
    let depths = pollster::block_on(studio.depths(shown, [SIDE; 2], &pixels)).expect("depths");
    let view = View::new(&shown.camera, [SIDE; 2]);
    let met = pixels.iter().zip(depths).filter_map(|(pixel, depth)| {
        let (origin, dir) = view.ray(*pixel);
        Some(origin + dir * (depth? + 0.004))
    });
    let met: Vec<Vec3> = met.collect();
    let samples = pollster::block_on(studio.probe_object(shown, &met)).expect("samples");
    let pairs = met.into_iter().zip(samples);
    pairs
        .filter(|(_, s)| s.continuity >= 0.0 && s.pos_in_rest.abs().max_element() < 0.499)
        .map(|(place, s)| (place, s.pos_in_rest))
        .collect()
}

/// How many places in sight were followed, and how many of them were not found, under a template of this kind with
/// random parameters: alone, with kept tissue, or before one of another kind, by the number of the round.
fn asked_and_missed(
    studio: &Studio,
    random: &mut Random,
    kind: TemplateKind,
    round: usize,
) -> (usize, usize) {
    let kinds = TemplateKind::FORMULAS;
    let mut shown = document("").illustration().clone();
    let mut template = random.template(kind);
    if round % 3 == 1 {
        template.align = Align::Segment {
            keep: vec!["bottom".to_owned()],
            thickness: Align::DEFAULT_THICKNESS,
        };
    }
    shown.templates.push(template);
    if round % 3 == 2 {
        let other = kinds[random.index(kinds.len())];
        shown.templates.push(random.template(other));
    }
    let seen = in_sight(studio, &shown);
    let rest: Vec<Vec3> = seen
        .iter()
        .map(|(_, rest)| *rest)
        .step_by((seen.len() / 200).max(1))
        .take(256)
        .collect();
    let places = pollster::block_on(studio.follow_points(&shown, &rest)).expect("places");
    let found: Vec<(Vec3, Vec3)> = rest
        .iter()
        .zip(&places)
        .filter_map(|(rest, place)| Some((*rest, (*place)?)))
        .collect();
    let at: Vec<Vec3> = found.iter().map(|(_, place)| *place).collect();
    let samples = pollster::block_on(studio.probe_object(&shown, &at)).expect("samples");
    for ((rest, place), sample) in found.iter().zip(samples) {
        let off = sample.pos_in_rest.distance(*rest);
        assert!(
            sample.continuity >= 0.0 && off < FARTHEST,
            "{rest} at {place} is off by {off}: {:?}",
            shown.templates
        );
    }
    (rest.len(), rest.len() - found.len())
}

fn are_found(kinds: impl Iterator<Item = TemplateKind>, rounds: usize, least: usize) {
    let studio = studio("cube");
    let mut random = Random(0x00ca_9710);
    let (mut asked, mut missed) = (0, 0);
    for (index, kind) in kinds.enumerate() {
        let (mut asked_of, mut missed_of) = (0, 0);
        for round in index..index + rounds {
            let (asked, missed) = asked_and_missed(&studio, &mut random, kind, round);
            asked_of += asked;
            missed_of += missed;
        }
        println!("{missed_of} of {asked_of} missed: {}", kind.spec().name);
        asked += asked_of;
        missed += missed_of;
    }
    assert!(asked > least, "{asked} places");
    assert!(100 * missed <= asked, "{missed} of {asked} are not found");
}

/// Every third kind; the whole list takes minutes, see below.
#[test]
fn what_is_in_sight_is_found_exactly() {
    are_found(TemplateKind::FORMULAS.into_iter().step_by(3), 1, 1000);
}

#[test]
#[ignore = "minutes: each list of kinds has programs of its own"]
fn what_is_in_sight_is_found_exactly_under_every_kind() {
    are_found(TemplateKind::FORMULAS.into_iter(), 6, 20_000);
}

/// Captions on the near side are in sight, those on the far side are not, however many there are.
#[test]
fn every_caption_is_asked_whether_it_is_in_sight() {
    let studio = studio("cube");
    let near = (0..120).map(|i| {
        (
            (i % 12) as f32 * 0.08 - 0.44,
            0.49,
            (i / 12) as f32 * 0.08 - 0.4,
        )
    });
    let far = near.clone().map(|(x, _, z)| (x, -0.49, z));
    let labels: Vec<String> = near
        .chain(far)
        .map(|(x, y, z)| format!(r#"{{"at":[{x},{y},{z}],"text":"a"}}"#))
        .collect();
    let document = Document::from_json(&format!(
        r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"labels":[{}]}}"#,
        labels.join(",")
    ))
    .expect("a good document");
    let mut shown = document.illustration().clone();
    // The camera looks along y.
    let eye = View::new(&shown.camera, [200; 2]).eye();
    assert!(eye.y > 1.0 && eye.x.abs() < 1e-3, "{eye}");
    shown.camera.distance = 3.0;
    let places = pollster::block_on(caption_places(&studio, &shown, [200; 2])).expect("places");
    let hidden: Vec<bool> = places
        .iter()
        .map(|place| place.expect("nothing is cut").1)
        .collect();
    assert_eq!(hidden.len(), 240);
    assert_eq!(hidden.iter().position(|is| *is), Some(120));
    assert!(hidden[120..].iter().all(|is| *is));
}

/// A ball is pressed into the side of a head, and another one beside it holds what is in it: forwards in one step, and
/// back in the next.
const PRESSED: &str = r#"{ "fabrica": 1, "subject": { "src": "head_t1.nii.gz" },
    "templates": [{ "kind": "sweep", "size": [1, 1, 1], "params": { "progress": 0, "tools": [
        { "radius": 0.09, "coat": 0.2, "path": [[1.02, 0.55, 0.45], [0.72, 0.55, 0.45]] },
        { "radius": 0.09, "coat": 0.12, "path": [[0.85, 0.72, 0.72]] }] } }],
    "labels": [{ "at": [0.3, 0.05, -0.05], "text": "Pressed in" }, { "at": [0.35, 0.22, 0.22], "text": "Held" },
        { "at": [0.25, 0.16, 0.05], "text": "Between" }],
    "steps": [{ "set": { "/templates/0/params/progress": 1 }, "seconds": 2 },
        { "set": { "/templates/0/params/progress": 0 }, "seconds": 2 }] }"#;

/// The captions of a real scan stay on their tissue while a tool is pressed into it and drawn back, and what another
/// tool holds stays in its place.
#[test]
fn captions_of_a_scan_stay_on_their_tissue_under_tools() {
    let test = "captions::captions_of_a_scan_stay_on_their_tissue_under_tools";
    let Some(folder) = data_folder(test) else {
        return;
    };
    let mut builder = VolumeBuilder::new();
    let (options, mut report) = (ReadOptions::default(), LoadReport::default());
    let path = folder.join("mri/head_t1.nii.gz");
    read_volume_at(&path, &options, &mut builder, &mut report).expect("a readable scan");
    let studio = studio_of(gpu(), &builder.finish().expect("a whole volume"), false);
    let document = Document::from_json(PRESSED).expect("a good document");
    assert_eq!(document.notices(), []);
    let captions = &document.illustration().captions;
    let rest: Vec<Vec3> = captions.iter().map(|caption| caption.at).collect();
    let mut places = Vec::new();
    for (step, seconds) in [(0, 9.0), (1, 0.7), (1, 9.0), (2, 1.3), (2, 9.0)] {
        let shown = document.at_time(step, seconds).expect("a step");
        let found = pollster::block_on(studio.follow_points(&shown, &rest)).expect("places");
        let found: Vec<Vec3> = found
            .into_iter()
            .map(|at| at.expect("it is there"))
            .collect();
        let samples = pollster::block_on(studio.probe_object(&shown, &found)).expect("samples");
        for ((rest, place), sample) in rest.iter().zip(&found).zip(samples) {
            let off = sample.pos_in_rest.distance(*rest);
            assert!(
                off < FARTHEST,
                "{rest} at {place} is off by {off} in step {step}"
            );
        }
        places.push(found);
    }
    let [before, early, all, late, after] = &places[..] else {
        panic!("five pictures")
    };
    assert_eq!(before, &rest);
    assert_eq!(after, before, "it went back");
    let way = |found: &[Vec3], i: usize| found[i].distance(rest[i]);
    println!(
        "{:?}",
        places
            .iter()
            .map(|f| [way(f, 0), way(f, 1), way(f, 2)])
            .collect::<Vec<_>>()
    );
    assert!(
        way(early, 0) > 0.01 && way(all, 0) > way(early, 0),
        "it is pressed in"
    );
    assert!(way(late, 0) < way(all, 0), "it comes back");
    for found in &places {
        assert!(way(found, 1) < 1e-4, "what is held stays");
    }
    assert!(
        way(all, 2) > 1e-3 && way(all, 2) < way(all, 0),
        "between them tissue gives way a little"
    );
}

/// Two ears in four strokes, a muzzle, a tail and feet; the caption stands where an ear is pulled out of the ball.
const TWELVE_STROKES: &str = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.06,
    "tools": [{ "radius": 0.1, "coat": 0.15 }, { "radius": 0.06, "coat": 0.08 }], "strokes": [
        { "path": [250, 0, 350, 60, 0, 150], "mirror": "x" }, { "path": [300, 0, 480, 80, 0, 160], "mirror": "x" },
        { "path": [360, 0, 600, 60, 0, 120], "mirror": "x" }, { "path": [0, -430, 0, 0, -150, 0] },
        { "path": [0, -550, 0, 0, -80, -60], "tool": 1 }, { "path": [160, -600, 160, 0, 150, 0], "tool": 1, "mirror": "x" },
        { "path": [380, 0, 680, 60, 0, 60], "turns": [0, 0, 0, 0, 40, 0], "mirror": "x" },
        { "path": [0, 400, -200, 0, 200, 0] }, { "path": [0, 560, -200, 0, 120, 150], "tool": 1 },
        { "path": [0, 560, -100, 0, 0, 90], "do": "smooth" },
        { "path": [200, -300, -400, 0, -40, -160], "mirror": "x" }, { "path": [0, 0, -600, 0, 0, 120] }] } },
    "look": { "strokes": 0 }, "labels": [{ "at": [0.28, 0, 0.41], "text": "Ear" }], "camera": { "distance": 4.5 },
    "steps": [{ "seconds": 2, "set": { "/look/strokes": 3 } }, { "seconds": 2, "set": { "/look/strokes": 8 } },
        { "seconds": 1, "set": { "/look/strokes": 12 } }] }"#;

/// A clay grows stroke by stroke, in steps and between them, and its caption is on the ear in all of them.
#[test]
fn the_caption_of_a_clay_that_grows_is_on_its_ear() {
    let folder = tempfile::tempdir().expect("a folder");
    let document = Document::from_json(TWELVE_STROKES).expect("a good document");
    assert_eq!(document.notices(), []);
    let SubjectRef::Clay(clay) = &document.illustration().subject else {
        panic!("a clay")
    };
    let start = document.illustration().captions[0].at.as_dvec3();
    let camera = document.illustration().camera;
    let view = View::new(&camera, [240, 200]);
    let mut dots = Vec::new();
    for (step, seconds, strokes) in [
        (0, None, 0..=0),
        (1, Some(1.0), 1..=2),
        (2, None, 8..=8),
        (3, Some(0.5), 9..=11),
        (3, None, 12..=12),
    ] {
        let mut args = vec![
            "render",
            "-",
            "-o",
            "ear.svg",
            "--size",
            "240x200",
            "--samples",
            "1",
        ];
        let [step_text, seconds_text] = [step.to_string(), seconds.unwrap_or(0.0_f32).to_string()];
        args.extend(["--step", &step_text]);
        if seconds.is_some() {
            args.extend(["--time", &seconds_text]);
        }
        fabrica_with(folder.path(), &args, TWELVE_STROKES.as_bytes()).ok();
        let picture = std::fs::read_to_string(folder.path().join("ear.svg")).expect("a picture");
        let shown = document
            .at_time(step, seconds.unwrap_or(9.0))
            .expect("a step");
        let shown = shown.strokes_shown().expect("a clay");
        assert!(strokes.contains(&shown), "{args:?}: {shown}");
        assert!(picture.contains(">Ear<"), "{args:?}");
        // The dot at the end of its line is drawn last.
        let dot = picture.rsplit("<path d=\"M").next().expect("a line");
        let dot = dot
            .split_once('L')
            .and_then(|(place, _)| place.split_once(' '));
        let (x, y) = dot.expect("two numbers");
        let dot = Vec2::new(x.parse().expect("x"), y.parse().expect("y"));
        let ear = Way::of(&clay.cut(shown), &Grids::default()).forward_of(start);
        let wanted = view
            .pixel_from_subject(ear.as_vec3())
            .expect("in the picture");
        assert!(dot.distance(wanted) < 1.0, "{args:?}: {dot}, not {wanted}");
        dots.push(dot);
    }
    // The ear grows in its strokes, and stays where it is in those of the tail and the feet.
    let way = |i: usize| dots[i].distance(dots[i + 1]);
    assert!(way(0) > 5.0 && way(1) > 5.0, "{dots:?}");
    assert!(way(2) < 1.0 && way(3) < 1.0, "{dots:?}");
}
