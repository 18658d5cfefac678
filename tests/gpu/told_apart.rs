//! Without colour the tissues of a drawing are told apart: by their grey, or by their strokes.

use crate::gpu::{software, studio_of};
use crate::images::revision;
use crate::long::long_or;
use fabrica::data::stroke_patterns;
use fabrica::document::Document;
use fabrica::render::{Image, Sighting};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;

/// Voxels along the longest side of the knee.
const RESOLUTION: u32 = 144;
const SIZE: [u32; 2] = [800, 600];
/// Pixels of one tissue beside another from which on they have a common border.
const LEAST_BORDER: usize = 40;
/// How far from the border greys and strokes are compared, pixels.
const NEAR: i32 = 20;
/// Pixels of a tissue near a border from which on its strokes are looked at.
const LEAST_PLACES: usize = 60;
/// Strokes are seen where the grey changes so much from pixel to pixel, of 255, and have a direction where this part of
/// the change has one.
const LEAST_CHANGE: f64 = 8.0;
const LEAST_CLEAR: f64 = 0.2;
/// What is not told apart yet: fat and menisci in a cut from above, whose strokes are of one kind and 18 to 25 degrees
/// apart, and ligaments and tendons, whose strokes are of one kind and run alike.
const STILL_ALIKE: [(&str, &str); 2] = [("fat", "menisci"), ("ligaments", "tendons")];
/// Greys that are told apart, of 255, and directions, degrees.
const GREYS: f64 = 20.0;
const TURN_DEG: f64 = 30.0;

/// What is seen of one tissue beside another.
#[derive(Clone, Copy, Debug)]
struct Look {
    /// Mean grey of the file's, 0 to 255.
    grey: f64,
    /// Across the strokes, degrees from the picture's x, 0 to 180.
    across_deg: f64,
    /// How much of what changes changes along one direction, 0 to 1.
    clear: f64,
    /// Root of the mean square of the change of grey from pixel to pixel.
    change: f64,
}

/// Greys of a picture's file, by Rec. 709.
fn greys(image: &Image) -> Vec<f64> {
    let pixels = image.rgba.chunks_exact(4);
    pixels
        .map(|p| 0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2]))
        .collect()
}

/// Places of a picture that show one tissue within some pixels of another.
fn near(seen: &Sighting, border: &[(i32, i32)], label: u16) -> Vec<(i32, i32)> {
    let [width, height] = seen.size_px.map(|side| side as i32);
    let mut is_near = vec![false; seen.labels.len()];
    for &(x, y) in border {
        for b in (y - NEAR).max(2)..(y + NEAR).min(height - 2) {
            for a in (x - NEAR).max(2)..(x + NEAR).min(width - 2) {
                is_near[(b * width + a) as usize] = true;
            }
        }
    }
    let at = |x: i32, y: i32| seen.labels[(y * width + x) as usize];
    // With the pixels around, so that no line between two tissues counts.
    let is_inside =
        |&(x, y): &(i32, i32)| (-1..2).all(|b| (-1..2).all(|a| at(x + a, y + b) == Some(label)));
    let places = (0..height * width).filter(|i| is_near[*i as usize]);
    places
        .map(|i| (i % width, i / width))
        .filter(is_inside)
        .collect()
}

fn look(greys: &[f64], places: &[(i32, i32)], width: i32) -> Look {
    let at = |x: i32, y: i32| greys[(y * width + x) as usize];
    let (mut grey, mut even, mut odd, mut all) = (0.0, 0.0, 0.0, 0.0);
    for &(x, y) in places {
        let right = 0.5 * (at(x + 1, y) - at(x - 1, y));
        let down = 0.5 * (at(x, y + 1) - at(x, y - 1));
        grey += at(x, y);
        even += right * right - down * down;
        odd += 2.0 * right * down;
        all += right * right + down * down;
    }
    let count = places.len() as f64;
    Look {
        grey: grey / count,
        across_deg: (0.5 * odd.atan2(even)).to_degrees().rem_euclid(180.0),
        clear: even.hypot(odd) / f64::max(all, 1e-9),
        change: (all / count).sqrt(),
    }
}

/// Pairs of tissues with a common border, and the places of both near it.
type Borders = BTreeMap<(u16, u16), [Vec<(i32, i32)>; 2]>;

fn borders(seen: &Sighting) -> Borders {
    let [width, height] = seen.size_px.map(|side| side as i32);
    let label = |x: i32, y: i32| seen.labels[(y * width + x) as usize].filter(|label| *label > 0);
    let mut borders: BTreeMap<(u16, u16), Vec<(i32, i32)>> = BTreeMap::new();
    for (x, y) in (0..height - 1).flat_map(|y| (0..width - 1).map(move |x| (x, y))) {
        for (a, b) in [(x + 1, y), (x, y + 1)] {
            if let (Some(one), Some(other)) = (label(x, y), label(a, b))
                && one != other
            {
                let pair = (one.min(other), one.max(other));
                borders.entry(pair).or_default().push((x, y));
            }
        }
    }
    let mut found = Borders::new();
    for (pair, mut border) in borders {
        border.dedup();
        let places = [pair.0, pair.1].map(|label| near(seen, &border, label));
        // What is narrower than a few pixels is seen by its outline.
        if border.len() >= LEAST_BORDER && places.iter().all(|places| places.len() >= LEAST_PLACES)
        {
            found.insert(pair, places);
        }
    }
    found
}

/// The document of the gallery at each of its steps, and the knee cut through in three ways: names and documents.
fn scenes() -> Vec<(String, Value)> {
    let layers = include_str!("../../web/gallery/layers-of-the-knee.json");
    let layers = Document::from_json(layers).expect("a document");
    let steps = 1..=layers.illustration().steps.len();
    let mut scenes: Vec<(String, Value)> = steps
        .map(|step| {
            let state = layers.at_step(step).expect("a step").to_json();
            let tree = serde_json::from_str(&state).expect("JSON");
            (format!("step {step}"), tree)
        })
        .collect();
    for (name, rotate, camera) in [
        (
            "from the front",
            [-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2],
            [0.0, 0.0, 0.0, 1.0],
        ),
        (
            "from aside",
            [-0.5, 0.5, 0.5, 0.5],
            [0.0, 0.0, -FRAC_1_SQRT_2, FRAC_1_SQRT_2],
        ),
        (
            "from above",
            [0.0, 0.0, 0.0, 1.0],
            [FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2],
        ),
    ] {
        let tree = json!({
            "fabrica": 1,
            "subject": { "builtin": "knee", "revision": 2 },
            "templates": [{ "kind": "cut", "rotate": rotate, "params": { "shape": "halfspace" } }],
            "camera": { "rotate": camera, "distance": 2.0 },
        });
        scenes.push((name.to_owned(), tree));
    }
    scenes
}

/// In grey, each two tissues of the knee with a common border in the picture differ by 20 of 255 in the mean, or in the
/// kind of their strokes, or by 30 degrees in their direction.
#[test]
fn ink_and_blueprint_tell_the_knees_tissues_apart() {
    let volume = revision("knee", 2, RESOLUTION);
    let labels = volume.segmentation.as_ref().expect("labels");
    let patterns = stroke_patterns(labels);
    let kind = |label: u16| patterns[usize::from(label)] / 3;
    let name = |label: u16| {
        let segment = labels
            .segments
            .iter()
            .find(|segment| segment.label == label);
        segment.map_or("", |segment| &segment.name)
    };
    let studio = studio_of(software(), &volume, true);
    let (mut count, mut alike, mut still, mut by_number) = (0, Vec::new(), 0, 0);
    // Where time is short, all layers that are left at the end, and a cut through all.
    let every = long_or(1, 3);
    for (scene, mut tree) in scenes().into_iter().rev().step_by(every) {
        let shown = |tree: &Value| {
            let document = Document::from_json(&tree.to_string()).expect("a document");
            document.illustration().clone()
        };
        let seen = pollster::block_on(studio.identify(&shown(&tree), SIZE)).expect("segments");
        let borders = borders(&seen);
        for preset in ["ink", "blueprint"] {
            // Without lines between the tissues, which would tell them apart as well.
            tree["look"]["style"] = json!({ "preset": preset, "outline": { "width": 0 } });
            let image = studio.render_image(&shown(&tree), SIZE, 1);
            let greys = greys(&pollster::block_on(image).expect("a picture"));
            for ((one, other), places) in &borders {
                let looks = [0, 1].map(|i| look(&greys, &places[i], SIZE[0] as i32));
                let turn_deg = (looks[0].across_deg - looks[1].across_deg).abs();
                let turn_deg = turn_deg.min(180.0 - turn_deg);
                let is_inked = looks.iter().all(|look| look.change > LEAST_CHANGE);
                let is_clear = looks.iter().all(|look| look.clear > LEAST_CLEAR);
                let by_grey = (looks[0].grey - looks[1].grey).abs() >= GREYS;
                let by_turn = is_inked && is_clear && turn_deg >= TURN_DEG;
                let by_kind = is_inked && kind(*one) != kind(*other);
                // As they would be told if kinds went by the numbers of the labels alone.
                let usual = is_inked && (one / 3) % 3 != (other / 3) % 3;
                let told = format!(
                    "{preset}, {scene}: {} and {}: {looks:.1?}, kinds {} and {}",
                    name(*one),
                    name(*other),
                    kind(*one),
                    kind(*other)
                );
                println!(
                    "{} {told}",
                    if by_grey {
                        "grey"
                    } else if by_kind {
                        "kind"
                    } else if by_turn {
                        "turn"
                    } else {
                        "!!!!"
                    }
                );
                count += 1;
                by_number += usize::from(!by_grey && !by_turn && !usual);
                if by_grey || by_kind || by_turn {
                    continue;
                }
                if STILL_ALIKE.contains(&(name(*one), name(*other))) {
                    still += 1;
                } else {
                    alike.push(told);
                }
            }
        }
    }
    println!(
        "{count} pairs, {} alike and {still} that are known, {by_number} if kinds went by number",
        alike.len()
    );
    assert!(count > long_or(80, 20), "{count} pairs");
    assert!(
        alike.is_empty(),
        "{} of {count}:\n{}",
        alike.len(),
        alike.join("\n")
    );
    assert!(
        by_number > still,
        "kinds by contact tell more: {by_number} and {still}"
    );
}
