//! Figures: what is drawn of them, and the commands about them.

use std::path::Path;
use std::sync::Arc;

use fabrica::data::{Plate, Resources, Sheet, Subject};
use fabrica::document::{Document, Illustration};
use fabrica::figure::drawn::drawn as drawing_of;
use fabrica::figure::svg::Drawing;
use fabrica::figure::{Bender, builtin_plate, plate_of_drawing, plate_of_picture, unwatched};
use fabrica::pictures::{Picture, decode};
use fabrica::render::{Image, Studio};
use glam::{Vec2, Vec3};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{Outcome, fabrica_with};
use crate::data::data_folder;
use crate::gpu::software;
use crate::picture_files::png;
use crate::scatter::Random;

/// The figure of a document on a plate, bent.
fn bent(plate: &Plate, illustration: &Illustration) -> Sheet {
    let figure = illustration.figure.clone().unwrap_or_default();
    let mut bender = Bender::new(plate).expect("a drawing that is read");
    let bent = bender.bent(&figure, &mut unwatched);
    bent.expect("nobody stops it").sheet
}

fn drawn(plate: Plate, illustration: &Illustration, size: [u32; 2], samples: u32) -> Image {
    let illustration = illustration.clone().of_figure();
    let resources = Resources {
        sheet: Some(bent(&plate, &illustration)),
        ..Resources::default()
    };
    let subject = Subject::from(plate);
    let studio = Studio::new(software(), &subject, false).expect("it fits");
    let studio = studio.with_resources(resources);
    let picture = studio.render_image(&illustration, size, samples);
    pollster::block_on(picture).expect("a picture")
}

/// A picture of a document about a built-in figure.
pub(crate) fn figure_image(json: &str, size: [u32; 2], samples: u32) -> Image {
    let document = Document::from_json(json).expect("a valid document");
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    let illustration = document.illustration();
    let name = match &illustration.subject {
        fabrica::document::SubjectRef::Builtin { name, .. } => name.clone(),
        other => panic!("{other:?} is not built in"),
    };
    let plate = builtin_plate(&name).expect("built in");
    drawn(plate, illustration, size, samples)
}

/// A document about a picture, whose camera shows the picture from edge to edge: the shorter side is `half` · 2 units.
fn from_edge_to_edge(shorter: f64, rest: &str) -> Illustration {
    let distance = 0.5 * shorter / 15f64.to_radians().tan();
    let json = format!(
        r#"{{ "fabrica": 1, "subject": {{ "src": "plate.png" }}, "camera": {{ "distance": {distance} }}, "look": {{ "background": "none" }}{rest} }}"#
    );
    let document = Document::from_json(&json).expect("a valid document");
    document.illustration().clone()
}

/// A picture of stripes and noise, part of it clear.
fn speckled(size: [u32; 2]) -> Picture {
    let mut random = Random(7);
    let pixels = (0..size[0] * size[1]).map(|i| {
        let row = i / size[0];
        let alpha = if row < 3 { 0 } else { 255 };
        [
            (255.0 * random.unit()) as u8,
            if i % 2 == 0 { 240 } else { 20 },
            (i % 256) as u8,
            alpha,
        ]
    });
    Picture {
        size,
        pixels: pixels.collect(),
        is_of_inks: false,
    }
}

fn pixel(image: &Image, x: u32, y: u32) -> [u8; 4] {
    let at = 4 * (y * image.size[0] + x) as usize;
    image.rgba[at..at + 4].try_into().expect("inside")
}

/// At one texel per pixel the picture is the source's, whatever the number of samples (spec/figures.md, "Drawing").
#[test]
fn an_unbent_plate_is_the_source() {
    let size = [60, 40];
    let picture = speckled(size);
    let illustration = from_edge_to_edge(40.0 / 60.0, "");
    for samples in [1, 5, 16] {
        let plate = plate_of_picture(picture.clone()).plate;
        let image = drawn(plate, &illustration, size, samples);
        for (i, source) in picture.pixels.iter().enumerate() {
            let found = &image.rgba[4 * i..4 * i + 4];
            assert_eq!(found[3], source[3], "pixel {i}, {samples} samples");
            let off = (0..3).map(|c| found[c].abs_diff(source[c])).max();
            assert!(
                source[3] == 0 || off <= Some(1),
                "pixel {i}, {samples} samples: {found:?} and {source:?}"
            );
        }
    }
}

/// Shown at a third of its size, a plate of fine stripes is their mean in linear light, and not one of the stripes.
#[test]
fn small_pictures_are_means_in_linear_light() {
    let size = [240, 240];
    let pixels = (0..size[0] * size[1]).map(|i| [if i % 2 == 0 { 255 } else { 0 }; 3]);
    let picture = Picture {
        size,
        pixels: pixels.map(|[r, g, b]| [r, g, b, 255]).collect(),
        is_of_inks: false,
    };
    let plate = plate_of_picture(picture).plate;
    let image = drawn(plate, &from_edge_to_edge(1.0, ""), [80, 80], 4);
    // Half the light is sRGB 188.
    for (x, y) in [(20, 20), (41, 40), (60, 33)] {
        let found = pixel(&image, x, y);
        assert!(found[0].abs_diff(188) <= 6, "{x}, {y}: {found:?}");
    }
}

/// A plate of flat colours: a red trunk, a green limb right of it on white ground.
fn trunk_and_limb() -> Plate {
    let size = [200, 100];
    let pixels = (0..size[0] * size[1]).map(|i| {
        let (x, y) = (i % size[0], i / size[0]);
        match (x, y) {
            (40..=79, 20..=79) => [200, 30, 30, 255],
            (120..=179, 45..=54) => [30, 160, 30, 255],
            _ => [255, 255, 255, 255],
        }
    });
    let picture = Picture {
        size,
        pixels: pixels.collect(),
        is_of_inks: false,
    };
    plate_of_picture(picture).plate
}

/// Regions of [`trunk_and_limb`], the limb a sheet of its own that is brought over the trunk, with more keys.
fn over_the_trunk(limb: &str, more: &str) -> String {
    let flood = |x: f64, y: f64| format!(r#""from": {{ "flood": {{ "at": [[{x}, {y}]] }} }}"#);
    format!(
        r#", "figure": {{ "detail": 1500, "regions": [
            {{ "name": "paper", {}, "hide": true }},
            {{ "name": "trunk", {}, "fixed": true, "smooth": 0 }},
            {{ "name": "limb", {}, "cut": true, "smooth": 0, "rigidity": "rigid"{limb} }}
        ], "handles": [ {{ "region": "limb", "move": [-0.45, 0] }} ]{more} }}"#,
        flood(-0.4, 0.2),
        flood(-0.2, 0.0),
        flood(0.25, 0.0),
    )
}

#[test]
fn order_says_what_is_in_front() {
    for (order, expected) in [(1, [30, 160, 30]), (-1, [200, 30, 30])] {
        let rest = over_the_trunk(&format!(r#", "order": {order}"#), "");
        let illustration = from_edge_to_edge(0.5, &rest);
        let image = drawn(trunk_and_limb(), &illustration, [200, 100], 4);
        let found = pixel(&image, 60, 50);
        let off = (0..3).map(|c| found[c].abs_diff(expected[c])).max();
        assert!(off <= Some(1), "order {order}: {found:?}");
        assert_eq!(pixel(&image, 150, 50)[3], 0, "where the limb lay");
    }
}

/// Where a cut region lay: a hole, a colour, or what lies around it.
#[test]
fn what_lies_behind_a_cut_region_is_seen() {
    // The limb lies in the trunk here, and is taken out of it.
    let size = [200, 100];
    let pixels = (0..size[0] * size[1]).map(|i| match (i % size[0], i / size[0]) {
        (80..=119, 45..=54) => [30, 160, 30, 255],
        _ => [200, 120, 80, 255],
    });
    let picture = Picture {
        size,
        pixels: pixels.collect(),
        is_of_inks: false,
    };
    for (behind, expected) in [
        ("none", [0, 0, 0, 0]),
        ("#3050a0", [0x30, 0x50, 0xa0, 255]),
        ("smooth", [200, 120, 80, 255]),
    ] {
        let rest = format!(
            r#", "figure": {{ "detail": 1500, "rest": "bend", "regions": [
                {{ "name": "organ", "from": {{ "flood": {{ "at": [[0, 0]] }} }}, "cut": true, "smooth": 0, "behind": "{behind}" }}
            ], "handles": [ {{ "region": "organ", "move": [0.3, 0.15] }}, {{ "at": [-0.45, -0.2] }}, {{ "at": [0.45, 0.2] }} ] }}"#
        );
        let plate = plate_of_picture(picture.clone()).plate;
        let image = drawn(plate, &from_edge_to_edge(0.5, &rest), size, 4);
        let found = pixel(&image, 100, 50);
        let off = (0..4).map(|c| found[c].abs_diff(expected[c])).max();
        assert!(
            off <= Some(1) || expected[3] == 0 && found[3] == 0,
            "{behind}: {found:?}"
        );
        let moved = pixel(&image, 160, 20);
        assert_eq!(moved[1], 160, "{behind}: the organ is elsewhere: {moved:?}");
    }
}

/// No seam shows between triangles and regions of one sheet, however it is bent: each pixel inside is opaque.
#[test]
fn no_ground_shows_through_a_bent_sheet() {
    let mut random = Random(3);
    for turn in 0..10 {
        let [x, y] = [random.unit(), random.unit()].map(|value| 0.3 * value - 0.15);
        let angle = 2.0 * random.unit() - 1.0;
        let rest = format!(
            r#", "figure": {{ "detail": 2000, "regions": [
                {{ "name": "trunk", "from": {{ "flood": {{ "at": [[-0.2, 0]] }} }} }},
                {{ "name": "limb", "from": {{ "flood": {{ "at": [[0.25, 0]] }} }}, "rigidity": 10 }}
            ], "handles": [ {{ "at": [-0.4, 0], "turn": 0 }}, {{ "at": [0.25, 0], "move": [{x}, {y}], "turn": {angle} }} ] }}"#
        );
        let illustration = from_edge_to_edge(1.0, &rest);
        let plate = trunk_and_limb();
        let sheet = bent(&plate, &illustration.clone().of_figure());
        let image = drawn(plate, &illustration, [160, 160], 1);
        let mut inside = 0;
        for row in 0..160 {
            for column in 0..160 {
                let at =
                    |x: f32, y: f32| Vec2::new((x + 0.5) / 160.0 - 0.5, 0.5 - (y + 0.5) / 160.0);
                // Inside with all of its pixel, and where no fold lies.
                let corners = [
                    (-1.0, -1.0),
                    (1.0, -1.0),
                    (-1.0, 1.0),
                    (1.0, 1.0),
                    (0.0, 0.0),
                ];
                let is_inside = corners.iter().all(|(dx, dy)| {
                    let place = at(column as f32 + dx, row as f32 + dy);
                    sheet.back(place).is_some()
                });
                let alpha = pixel(&image, column, row)[3];
                inside += usize::from(is_inside);
                assert!(
                    !is_inside || alpha == 255,
                    "bend {turn}: alpha {alpha} at {column}, {row}"
                );
            }
        }
        assert!(inside > 5000, "bend {turn}: {inside} pixels lie inside");
    }
}

fn in_folder(json: &str) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("d.json"), json).expect("written");
    folder
}

fn call(folder: &Path, args: &[&str], input: &str) -> Outcome {
    fabrica_with(folder, args, input.as_bytes())
}

const ARM: &str = r#"{ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "figure": { "detail": 3000, "handles": [
    { "region": "humerus" }, { "region": "hand", "move": [0, 0.1], "turn": 0.5 } ] } }"#;

fn columns(line: &str) -> Vec<f64> {
    let numbers = line.split(',').take(7);
    numbers
        .map(|number| number.parse().expect("a number"))
        .collect()
}

/// `probe` inverts `probe --forward`, but where something else lies before the place (must-show 11).
#[test]
fn places_go_there_and_back() {
    let folder = in_folder(ARM);
    let mut random = Random(5);
    let points: Vec<String> = (0..1000)
        .map(|_| {
            format!(
                "{},{}",
                0.9 * random.unit() - 0.45,
                0.6 * random.unit() - 0.3
            )
        })
        .collect();
    let forward = ["probe", "d.json", "--forward", "--object"];
    let there = call(folder.path(), &forward, &points.join("\n")).ok();
    let moved: Vec<(Vec<f64>, String)> = there
        .out
        .lines()
        .filter(|line| columns(line)[6] > 0.0)
        .map(|line| {
            (
                columns(line),
                line.rsplit(',').next().unwrap_or_default().to_owned(),
            )
        })
        .collect();
    assert!(moved.len() > 200, "{} places lie in the arm", moved.len());
    let asked: Vec<String> = moved
        .iter()
        .map(|(c, _)| format!("{},{},0", c[3], c[4]))
        .collect();
    let back = call(
        folder.path(),
        &["probe", "d.json", "--object"],
        &asked.join("\n"),
    )
    .ok();
    let mut off = 0;
    for ((from, region), line) in moved.iter().zip(back.out.lines()) {
        let to = columns(line);
        assert_eq!(to[6], 1.0, "something is seen there: {line}");
        let away = (from[0] - to[3]).hypot(from[1] - to[4]);
        let seen = line.rsplit(',').next().unwrap_or_default();
        if away > 1e-4 {
            off += 1;
            assert!(
                seen != region || off < 30,
                "{from:?} in {region} came back as {line}"
            );
        }
    }
    assert!(off < moved.len() / 5, "{off} of {}", moved.len());
    let outside = call(folder.path(), &["probe", "d.json"], "3,4\n").ok();
    assert_eq!(outside.out, "3,4,0,3,4,0,-1\n");
}

/// A drawing that is seen closer than its pixels is drawn finer, so that an edge stays sharp.
#[test]
fn what_is_seen_closer_is_drawn_finer() {
    let folder = in_folder(
        r##"{ "fabrica": 1, "subject": { "src": "a.svg" }, "figure": { "detail": 500 },
            "look": { "background": "#ffffff" }, "camera": { "distance": 0.06, "fov": 10 } }"##,
    );
    let svg = br##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-50 -50 100 100"><path d="M-50-50H0.01V50H-50Z"/></svg>"##;
    std::fs::write(folder.path().join("a.svg"), svg).expect("room");
    // 19,000 pixels along the longest side: a texel of 2,048 is nine pixels wide, one of 4,096 half of that.
    let args = ["render", "d.json", "-o", "a.png", "--size", "200x200"];
    call(folder.path(), &args, "").ok();
    let png = decode(&std::fs::read(folder.path().join("a.png")).expect("written")).expect("a PNG");
    let between = |row: &[u8]| {
        assert!(
            row[4 * 20] < 20 && row[4 * 180] > 235,
            "an edge in the middle"
        );
        row.iter()
            .step_by(4)
            .filter(|red| (20..235).contains(*red))
            .count()
    };
    let finer = between(png.pixels[100 * 200..101 * 200].as_flattened());
    let text = std::fs::read_to_string(folder.path().join("d.json")).expect("written");
    let document = Document::from_json(&text).expect("a document");
    let plate = plate_of_drawing(svg).expect("a drawing").plate;
    let coarse = drawn(plate, document.illustration(), [200, 200], 1);
    let coarse = between(&coarse.rgba[4 * 100 * 200..4 * 101 * 200]);
    println!("{finer} pixels of the edge, else {coarse}");
    assert!(finer >= 1 && 4 * finer <= 3 * coarse, "{finer} of {coarse}");
}

/// Numbers, shapes and pixels of a figure, by the name of the file.
#[test]
fn figures_are_exported() {
    let folder = in_folder(ARM);
    let path = |name: &str| folder.path().join(name);
    let export = |name: &str| call(folder.path(), &["export-figure", "d.json", "-o", name], "");
    export("a.json").ok();
    export("b.json").ok();
    let [a, b] = ["a.json", "b.json"].map(|name| std::fs::read(path(name)).expect("written"));
    assert_eq!(a, b, "the same bytes when run again");
    let numbers: Value = serde_json::from_slice(&a).expect("JSON");
    let count = |key: &str| numbers[key].as_array().map_or(0, Vec::len);
    assert_eq!(count("vertices"), count("positions"));
    assert_eq!(count("triangles"), count("region"));
    assert_eq!(count("handles"), 2);
    let names: Vec<&str> = numbers["regions"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|region| region["name"].as_str())
        .collect();
    assert!(
        names.contains(&"biceps") && names.last() == Some(&"rest"),
        "{names:?}"
    );
    export("a.svg").ok();
    let svg = std::fs::read_to_string(path("a.svg")).expect("text");
    assert!(svg.starts_with("<svg "), "{}", &svg[..40]);
    let [bent, own] = [svg.as_str(), drawing_of("drawn-arm").expect("built in").svg]
        .map(|text| Drawing::read(text.as_bytes()).expect("an SVG"));
    assert_eq!(bent.shapes.len(), own.shapes.len(), "the same shapes");
    let moved = bent.shapes.iter().zip(&own.shapes);
    let moved = moved.filter(|(bent, own)| bent.outline != own.outline);
    assert!(moved.count() > 20, "those of the hand have moved");
    call(
        folder.path(),
        &["export-figure", "d.json", "-o", "a.png", "--size", "300"],
        "",
    )
    .ok();
    let png = decode(&std::fs::read(path("a.png")).expect("written")).expect("a PNG");
    assert_eq!(png.size[0].max(png.size[1]), 300);
    let wrong = export("a.txt");
    assert!(wrong.err.contains(".json, .svg or .png"), "{}", wrong.err);
    assert!(!path("a.txt").exists());
}

/// A volume is no figure, a picture has no shapes, and broken files are named with what is wrong.
#[test]
fn wrong_figures_are_refused_in_a_line() {
    let folder = in_folder(r#"{ "fabrica": 1, "subject": { "builtin": "bar" } }"#);
    let bar = call(
        folder.path(),
        &["export-figure", "d.json", "-o", "x.json"],
        "",
    );
    assert!(bar.err.contains("no figure"), "{}", bar.err);
    let bar = call(folder.path(), &["probe", "d.json", "--forward"], "0,0\n");
    assert!(bar.err.contains("--forward"), "{}", bar.err);
    let rows: Vec<u8> = (0..20)
        .flat_map(|_| [0].into_iter().chain([120; 60]))
        .collect();
    let whole = png([20, 20], [8, 2, 0], &[], &rows);
    let huge = png([65_535, 65_535], [8, 2, 0], &[], &[]);
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.path().join(name), bytes).expect("written")
    };
    write("whole.png", &whole);
    write("huge.png", &huge);
    write("cut.png", &whole[..whole.len() / 2]);
    write("circle.svg", br##"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9"><use id="a" xlink:href="#b"/><use id="b" xlink:href="#a"/></svg>"##);
    write("text.svg", b"<svg");
    let of = |file: &str, output: &str| {
        let json = format!(r#"{{ "fabrica": 1, "subject": {{ "src": "{file}" }} }}"#);
        write("d.json", json.as_bytes());
        call(
            folder.path(),
            &["export-figure", "d.json", "-o", output],
            "",
        )
    };
    of("whole.png", "whole.json").ok();
    let shapes = of("whole.png", "whole.svg");
    assert!(shapes.err.contains("save a PNG"), "{}", shapes.err);
    for (file, parts) in [
        ("huge.png", ["65535", "too many"]),
        ("cut.png", ["PNG", "cut short or broken"]),
        ("text.svg", ["SVG", "line"]),
    ] {
        let outcome = of(file, "x.json");
        for part in parts {
            assert!(outcome.err.contains(part), "{file}: {}", outcome.err);
        }
        assert!(!folder.path().join("x.json").exists(), "{file}");
    }
    // A drawing in which nothing is left is drawn as nothing, in no time.
    of("circle.svg", "empty.json").ok();
    let empty = std::fs::read(folder.path().join("empty.json")).expect("written");
    let numbers: Value = serde_json::from_slice(&empty).expect("JSON");
    assert_eq!(numbers["triangles"].as_array().map(Vec::len), Some(0));
}

/// The plates of the test data come out as they are (must-show 1), and their size and depth are told.
#[test]
fn real_plates_come_out_as_they_are() {
    let Some(data) = data_folder("figures::real_plates_come_out_as_they_are") else {
        return;
    };
    let folder = TempDir::new().expect("a folder");
    for (name, told) in [
        ("elbow-joint-gray.png", "313 × 650"),
        ("atlas-axis-gray.png", "500 × 235"),
        ("vertebral-column-colored.png", "233 × 800"),
        ("gray_Skull.jpg", "500 × 503"),
    ] {
        let file = data.join("image2d").join(name);
        let shown = file.to_string_lossy();
        let info = call(folder.path(), &["info", &shown], "").ok();
        assert!(
            info.out.contains(told) && info.out.contains("bits"),
            "{}",
            info.out
        );
        let json = format!(r#"{{ "fabrica": 1, "subject": {{ "src": "{shown}" }} }}"#);
        std::fs::write(folder.path().join("d.json"), json).expect("written");
        call(
            folder.path(),
            &["export-figure", "d.json", "-o", "out.png"],
            "",
        )
        .ok();
        let out = std::fs::read(folder.path().join("out.png")).expect("written");
        let [source, out] = [std::fs::read(&file).expect("read"), out]
            .map(|bytes| decode(&bytes).expect("a picture"));
        assert_eq!(source.size, out.size, "{name}");
        let over_white = |value: u8, alpha: u8| {
            let (value, alpha) = (u32::from(value), u32::from(alpha));
            ((value * alpha + 255 * (255 - alpha) + 127) / 255) as u8
        };
        for (from, to) in source.pixels.iter().zip(&out.pixels) {
            if from[3] == 0 || from[3] == 255 {
                let off = (0..3)
                    .map(|c| over_white(from[c], from[3]).abs_diff(to[c]))
                    .max();
                assert!(off <= Some(1), "{name}: {from:?} and {to:?}");
            }
        }
    }
}

/// At half time a handle's move is the mean of both, and the picture is that of a document that has this move
/// (must-show 13).
#[test]
fn a_passage_goes_by_means() {
    let json = |y: f64, steps: &str| {
        format!(
            r#"{{ "fabrica": 1, "subject": {{ "builtin": "drawn-arm" }}, "figure": {{ "detail": 2000, "handles": [
                {{ "region": "humerus" }}, {{ "region": "hand", "move": [0, {y}], "turn": 0 }} ] }}{steps} }}"#
        )
    };
    let steps = r#", "steps": [{ "set": { "/figure/handles/1/move": [0, 0.1] }, "seconds": 2 }]"#;
    let lesson = Document::from_json(&json(0.0, steps)).expect("a document");
    let half = lesson.at_time(1, 1.0).expect("a moment");
    let half = half.figure.expect("a figure");
    let moved = half.handles[1].motion.by.y;
    assert!((moved - 0.05).abs() < 1e-6, "half way: {moved}");
    let still = Document::from_json(&json(moved, "")).expect("a document");
    assert_eq!(still.illustration().figure.as_ref(), Some(&half));
}

/// Descriptions name the regions that are seen.
#[test]
fn regions_are_told_by_name() {
    let folder = in_folder(ARM);
    let told = call(folder.path(), &["describe", "d.json"], "").ok();
    assert!(
        told.out.contains("biceps") && told.out.contains("hand"),
        "{}",
        told.out
    );
}

/// A scan with a `figure` beside it is drawn as it is without, and a file that is not there is no reason to refuse what
/// templates do.
#[test]
fn figures_beside_other_subjects_change_nothing() {
    let folder = in_folder(
        r#"{ "fabrica": 1, "subject": { "src": "missing.nii" }, "templates": [{ "kind": "twist" }] }"#,
    );
    let probed = call(folder.path(), &["probe", "d.json"], "0.1,0.1,0.1\n").ok();
    assert_eq!(probed.out.lines().count(), 1, "{}", probed.out);
    let picture = |figure: &str| {
        let json = format!(
            r#"{{ "fabrica": 1, "subject": {{ "src": "ball.obj", "axes": "ras" }}{figure}, "camera": {{ "rotate": [0, 0, 0.7071068, 0.7071068] }} }}"#
        );
        std::fs::write(folder.path().join("d.json"), json).expect("written");
        let args = [
            "render",
            "d.json",
            "-o",
            "p.png",
            "--size",
            "40x40",
            "--samples",
            "1",
        ];
        let outcome = call(folder.path(), &args, "").ok();
        (
            std::fs::read(folder.path().join("p.png")).expect("written"),
            outcome.err,
        )
    };
    let obj = "v 0 0 0\nv 10 0 0\nv 0 20 0\nv 0 0 5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    std::fs::write(folder.path().join("ball.obj"), obj).expect("written");
    let (plain, _) = picture("");
    let (beside, told) = picture(r#", "figure": { "handles": [] }"#);
    assert!(plain == beside, "the picture is the same");
    assert!(told.contains("/figure"), "{told}");
}

/// A caption goes with its tissue, and is not seen where something covers it.
#[test]
fn captions_go_with_their_tissue() {
    let rest = over_the_trunk(r#", "order": 1"#, "");
    let illustration = from_edge_to_edge(0.5, &rest).of_figure();
    let sheet = bent(&trunk_and_limb(), &illustration);
    let on_limb = sheet.seen(Vec3::new(0.25, 0.0, 0.0)).expect("it is seen");
    assert!(
        (on_limb - Vec3::new(-0.2, 0.0, 0.0)).length() < 1e-3,
        "{on_limb}"
    );
    assert_eq!(
        sheet.seen(Vec3::new(-0.2, 0.0, 0.0)),
        None,
        "under the limb"
    );
    assert_eq!(sheet.seen(Vec3::new(0.4, 0.2, 0.0)), None, "on the paper");
}

/// What nobody could see is no reason to hang: of a drawing without shapes nothing is made.
#[test]
fn nothing_is_made_of_nothing() {
    let svg = br#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50"></svg>"#;
    let plate = fabrica::figure::plate_of_drawing(svg)
        .expect("an SVG")
        .plate;
    let illustration = from_edge_to_edge(0.5, "").of_figure();
    let sheet = bent(&plate, &illustration);
    assert!(sheet.mesh.triangles.is_empty());
    assert!(Arc::clone(&sheet.order).is_empty());
}
