//! What a picture is said to show, against pictures.

use fabrica::data::Subject;
use fabrica::describe::{Lang, Measured, Sight, describe};
use fabrica::document::{Document, SubjectRef};
use fabrica::render::{SIGHT_PX, Sighting, Studio};
use glam::Vec2;

use crate::gpu::{builtin, gpu};
use crate::long::long_or;

/// As `fabrica render` draws.
const FULL_PX: [u32; 2] = [1024, 768];
/// What comes before the name of the object, by language.
const OBJECT: [&str; 4] = ["Object: ", "Objekt: ", "Objeto: ", "对象："];
/// How far a share may be from that of a full-size picture.
const MOST_OFF: f32 = 0.05;

fn gallery(name: &str) -> Document {
    let path = format!("{}/web/gallery/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Document::from_json(&std::fs::read_to_string(path).expect("text")).expect("a document")
}

fn studio(document: &Document, resolution: u32) -> (Studio, f64) {
    let SubjectRef::Builtin { name, .. } = &document.illustration().subject else {
        panic!("the gallery is built in")
    };
    let subject = Subject::from(builtin(name, resolution));
    let mm_per_unit = subject.frame().mm_per_unit;
    (
        Studio::new(gpu(), &subject, true).expect("it fits"),
        mm_per_unit,
    )
}

fn sighting(studio: &Studio, document: &Document, step: usize, size_px: [u32; 2]) -> Sighting {
    let at_step = document.at_step(step).expect("a step");
    pollster::block_on(studio.identify(at_step.illustration(), size_px)).expect("a picture")
}

/// Pixels of a segment among those of the object, counted by hand.
fn counted(full: &Sighting, studio: &Studio, name: &str) -> f32 {
    let labels: Vec<u16> = studio
        .segments()
        .iter()
        .filter(|s| s.name == name)
        .map(|s| s.label)
        .collect();
    let object = full.labels.iter().flatten().count();
    let of_it = full
        .labels
        .iter()
        .flatten()
        .filter(|label| labels.contains(label))
        .count();
    of_it as f32 / object as f32
}

/// Checks every step of a document: shares against a full-size picture, words in four languages, neighbours unlike.
/// Returns the largest difference.
fn check(name: &str, document: &Document, resolution: u32, full_px: [u32; 2]) -> f32 {
    let (studio, mm_per_unit) = studio(document, resolution);
    let mut most = 0.0_f32;
    let mut before = Lang::ALL.map(|_| [String::new(), String::new()]);
    for step in 0..=document.step_count() {
        let small = sighting(&studio, document, step, SIGHT_PX);
        let sight = Sight::count(small.labels, studio.segments());
        let full = sighting(&studio, document, step, full_px);
        let object = full.labels.iter().flatten().count() as f32 / full.labels.len() as f32;
        let mut off = |what: &str, told: f32, is: f32| {
            most = most.max((told - is).abs());
            assert!(
                (told - is).abs() <= MOST_OFF,
                "{name}, step {step}: {what} {told}, counted {is}"
            );
        };
        off("object", sight.object, object);
        for seen in &sight.segments {
            off(&seen.name, seen.share, counted(&full, &studio, &seen.name));
        }
        // Nothing large is left out.
        for segment in studio.segments() {
            let told = sight.segments.iter().find(|seen| seen.name == segment.name);
            off(
                &segment.name,
                told.map_or(0.0, |seen| seen.share),
                counted(&full, &studio, &segment.name),
            );
        }
        let measured = Measured {
            sight: Some(sight),
            mm_per_unit: Some(mm_per_unit),
            turned: None,
        };
        for (lang, before) in Lang::ALL.into_iter().zip(&mut before) {
            let told = describe(document, step, &measured, lang).expect("a step");
            let text = told.text().to_owned();
            assert!(
                text.contains('%') && text.chars().count() > 60,
                "{name}, step {step}: {text}"
            );
            assert_ne!(text, before[0], "{name}, step {step}");
            // Titles are unlike anyway: what follows the object's name tells whether the pictures are.
            let own = text
                .split_once(OBJECT[lang as usize])
                .map(|(_, own)| own.to_owned());
            let own = own.expect("the object is named");
            // Words alike stand for states alike.
            let is_same = step > 0 && {
                let earlier = document.at_step(step - 1).expect("a step");
                let later = document.at_step(step).expect("a step");
                earlier.illustration() == later.illustration()
            };
            assert!(own != before[1] || is_same, "{name}, step {step}: {own}");
            *before = [text.clone(), own];
            if lang == Lang::English {
                println!("{text}\n");
            }
        }
    }
    println!("{name}: at most {:.1} percentage points off", 100.0 * most);
    most
}

#[test]
fn shares_agree_with_full_pictures() {
    for name in ["tomato-peel", "piggybank-savings"] {
        check(name, &gallery(name), 64, [512, 384]);
    }
}

/// All of it in full size, by `cargo test --test gpu -- --ignored whole_gallery --nocapture`: minutes on a software
/// GPU.
#[test]
#[ignore = "minutes on a software GPU"]
fn the_whole_gallery_agrees_with_full_pictures() {
    let mut most = 0.0_f32;
    let folder = format!("{}/web/gallery", env!("CARGO_MANIFEST_DIR"));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("the gallery")
        .filter_map(|entry| {
            entry
                .expect("an entry")
                .path()
                .file_stem()?
                .to_str()
                .map(str::to_owned)
        })
        .collect();
    names.sort();
    assert!(names.len() > 20, "{names:?}");
    for name in names {
        most = most.max(check(&name, &gallery(&name), 160, FULL_PX));
    }
    println!("of all: at most {:.1} percentage points off", 100.0 * most);
}

/// What is told of every pixel is what a click on it finds.
#[test]
fn a_pixel_has_the_segment_that_is_picked_there() {
    let document = gallery("tomato-peel");
    let (studio, _) = studio(&document, 64);
    let size_px = [64, 48];
    let seen = sighting(&studio, &document, 3, size_px);
    let at_step = document.at_step(3).expect("a step");
    let mut n_segments = std::collections::BTreeSet::new();
    for i in (0..64 * 48).step_by(long_or(61, 121)) {
        let pixel = Vec2::new((i % 64) as f32, (i / 64) as f32) + 0.5;
        let pick = pollster::block_on(studio.pick(at_step.illustration(), size_px, pixel));
        let picked = pick
            .expect("an answer")
            .map(|pick| pick.segment.unwrap_or(0));
        assert_eq!(seen.labels[i], picked, "at {pixel}");
        n_segments.insert(picked);
    }
    assert!(n_segments.len() >= 4, "{n_segments:?}");
}

/// Counted without the labels: each segment is drawn as a body of one plain colour, and the colours of the picture are
/// counted.
#[test]
fn shares_agree_with_the_colours_of_a_picture() {
    let text = r##"{ "fabrica": 1, "subject": { "builtin": "head" }, "templates": [
            { "kind": "cut", "at": [-0.5, 0.1, 0.2], "size": [1, 1.5, 0.5], "align": { "to": "segment", "keep": ["bone", "brain"] } },
            { "kind": "cut", "at": [-0.5, 0.1, 0.35], "size": [1, 1.5, 0.3], "align": { "to": "segment", "keep": ["brain"] } }],
        "look": { "background": "none", "segments": { LOOKS } }, "camera": { "rotate": [0, 0, 0.2, 0.98] } }"##;
    let plain = Document::from_json(&text.replace("LOOKS", "")).expect("a document");
    let (studio, _) = studio(&plain, 96);
    let colors = [
        ("skin", "#ff0000"),
        ("bone", "#00ff00"),
        ("brain", "#0000ff"),
    ];
    let looks: Vec<String> = studio
        .segments()
        .iter()
        .map(
            |segment| match colors.iter().find(|(name, _)| *name == segment.name) {
                Some((name, color)) => {
                    format!(r#""{name}": {{ "opacity": 1, "color": "{color}" }}"#)
                }
                None => format!(r#""{}": 0"#, segment.name),
            },
        )
        .collect();
    let document =
        Document::from_json(&text.replace("LOOKS", &looks.join(", "))).expect("a document");
    let seen = sighting(&studio, &document, 0, SIGHT_PX);
    let sight = Sight::count(seen.labels, studio.segments());
    let drawing = studio.render_image(document.illustration(), [512, 384], 1);
    let image = pollster::block_on(drawing).expect("a picture");
    let mut counts = [0_usize; 3];
    for pixel in image.rgba.chunks_exact(4).filter(|pixel| pixel[3] > 127) {
        let brightest = (0..3).max_by_key(|&i| pixel[i]).unwrap_or(0);
        counts[brightest] += 1;
    }
    let object: usize = counts.iter().sum();
    println!("{sight:?} {counts:?}");
    for ((name, _), count) in colors.iter().zip(counts) {
        let is = count as f32 / object as f32;
        assert!(is > 0.05, "{name} is in the picture: {counts:?}");
        let seen = sight.segments.iter().find(|seen| seen.name == *name);
        let told = seen.map_or(0.0, |seen| seen.share);
        assert!(
            (told - is).abs() <= MOST_OFF,
            "{name}: {told}, counted {is}"
        );
    }
    let covered = object as f32 / (512.0 * 384.0);
    assert!(
        (sight.object - covered).abs() < 0.02,
        "{} {covered}",
        sight.object
    );
}
