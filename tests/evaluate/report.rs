//! Everything at full size, written into target/evaluation.

use super::bench::{FINE, METHODS, Method, Object, QUICK, Scan, Scanner, seconds};
use super::maps::{Baked, MapError, Places, Precision};
use super::normals::{Relief, Surface, normal_errors, picture};
use super::opacity::{MODES, haze, stopped};
use super::page::{Page, figures};
use super::{BLOCK, EGG, PEEL, POKE, TWIST, WAVE, templates};
use crate::gpu::{gpu, studio_of};
use fabrica::data::{Subject, VolumeBuilder};
use fabrica::document::{PlacedTemplate, SubjectRef};
use fabrica::render::{self, Image, encode_png};
use fabrica::subjects;
use glam::{DVec3, UVec3, Vec3};
use std::path::PathBuf;

/// Deformations that normals are measured under.
pub(crate) fn deformations() -> Vec<(&'static str, Vec<PlacedTemplate>)> {
    [
        ("at rest", String::new()),
        ("twist", TWIST.to_owned()),
        (
            "bend",
            r#"{ "kind": "bend", "size": [0.9, 0.9, 0.9], "params": { "angle": 0.9 } }"#.to_owned(),
        ),
        (
            "squeeze",
            r#"{ "kind": "squeeze", "size": [1, 1, 0.8], "params": { "strength": 1 } }"#.to_owned(),
        ),
        (
            "dilate",
            r#"{ "kind": "dilate", "size": [1, 1, 0.8], "params": { "strength": 0.4 } }"#
                .to_owned(),
        ),
        ("poke", POKE.to_owned()),
        ("wave", WAVE.to_owned()),
        ("peel", PEEL.to_owned()),
        (
            "twist of a squeeze",
            format!(r#"{{ "kind": "squeeze", "size": [1, 1, 0.8] }}, {TWIST}"#),
        ),
    ]
    .into_iter()
    .map(|(name, list)| (name, templates(&list)))
    .collect()
}

pub(crate) fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("target/evaluation")
}

pub(crate) fn write() {
    let folder = folder();
    std::fs::create_dir_all(&folder).expect("target/evaluation");
    let mut page = Page::new();
    let info = &gpu().info;
    page.title("Evaluation of deformed volumes and surfaces");
    page.text(&format!(
        "Chapters 6 and 8 of Correa’s dissertation (2007) done again, with ground truth. Maps, scans and pictures come from Fabrica’s WGSL on {} ({}); what they are held against is closed form in f64. Written by <code>cargo xtask evaluate</code>, version {}; every number comes out again.",
        info.name, info.driver_info, env!("CARGO_PKG_VERSION")
    ));
    type Part = fn(&mut Page);
    let parts: [(&str, Part); 8] = [
        ("maps", maps),
        ("Jacobians", jacobians),
        ("opacity", opacity),
        ("normals", normals),
        ("grain", grain),
        ("shape", shape),
        ("cost", cost),
        ("surfaces", super::surface_report::write),
    ];
    for (name, part) in parts {
        let start = std::time::Instant::now();
        part(&mut page);
        println!("{name}: {:.1} s", start.elapsed().as_secs_f32());
    }
    let index = folder.join("index.html");
    std::fs::write(&index, page.end()).expect("the report");
    println!("look at {}", index.display());
}

fn map_row(name: String, error: MapError) -> Vec<String> {
    vec![
        name,
        figures(error.rms),
        figures(error.worst),
        format!("{:.2} %", 100.0 * error.wrong_side),
    ]
}

fn maps(page: &mut Page) {
    page.section("Displacement resolution and precision (6.2.1, 6.2.2)");
    page.text("Distance between the source position that a map gives and that of the closed form, subject units (1 is the longest side of the subject), at 20,000 places of the template’s box; places within 0.004 units of a cut count only for the side that they are found on. Fabrica evaluates formulas and bakes nothing here: what is left is the rounding of f32.");
    for (name, text, sizes, flat) in [
        ("Twist", TWIST, [8, 16, 32, 64, 96], false),
        (
            "Peel (four texels along its hinge, as published)",
            PEEL,
            [32, 64, 128, 256, 512],
            true,
        ),
    ] {
        let list = templates(text);
        let places = Places::new(&list, 20_000);
        let mut rows = vec![map_row("exact (formulas)".to_owned(), places.exact(&list))];
        let mut lines = Vec::new();
        for (precision, title) in Precision::ALL {
            let mut line = Vec::new();
            for n in sizes {
                let dims = UVec3::new(n, if flat { 4 } else { n }, n);
                let error = places.of(&Baked::new(&list, dims, precision));
                rows.push(map_row(
                    format!("{} × {} × {}, {title}", dims.x, dims.y, dims.z),
                    error,
                ));
                line.push([f64::from(n), error.rms]);
            }
            lines.push((title.to_owned(), line));
        }
        page.text(&format!("<b>{name}</b>"));
        page.plot(
            "Error of baked maps by resolution",
            ["texels along a side", "rms error, subject units"],
            &lines,
        );
        page.table(
            &["map", "rms error", "largest", "wrong side of a cut"],
            &rows,
        );
    }
}

fn jacobians(page: &mut Page) {
    page.section("Precision of the Jacobian (6.2.3)");
    page.text("Mean angle in degrees between normals carried over by the closed form’s Jacobian and by one kept with ten bits per component over −2 to 2, by one divided by its largest component first (equation 6.1), and by the differences that Fabrica takes where it shades.");
    let mut rows = Vec::new();
    let mut lines: Vec<(String, Vec<[f64; 2]>)> = ["10 bit", "10 bit, normalised", "on the fly"]
        .map(|name| (name.to_owned(), Vec::new()))
        .to_vec();
    for (kind, param, strengths) in [
        ("twist", "angle", [1.5, 3.0, 6.0, 12.0]),
        ("squeeze", "strength", [0.5, 1.0, 1.5, 2.0]),
        ("dilate", "strength", [0.2, 0.4, 0.6, 0.9]),
        ("twist of a squeeze", "strength", [0.5, 1.0, 1.5, 2.0]),
    ] {
        for strength in strengths {
            let one = kind.split(' ').next_back().unwrap_or(kind);
            let mut text = format!(
                r#"{{ "kind": "{one}", "size": [0.9, 0.9, 0.9], "params": {{ "{param}": {strength} }} }}"#
            );
            if one != kind {
                text = format!("{text}, {TWIST}");
            }
            let list = templates(&text);
            let (angles, det) = Places::new(&list, 2_000).jacobians(&list);
            let mut row = vec![format!("{kind} {strength}"), figures(det)];
            for (line, angle) in lines.iter_mut().zip(angles) {
                row.push(format!("{angle:.4}"));
                line.1.push([det, angle]);
            }
            rows.push(row);
        }
    }
    for line in &mut lines {
        line.1.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    page.plot(
        "Angle error by how much tissue is pressed together (figure 6.6)",
        ["mean determinant", "degrees"],
        &lines,
    );
    page.table(
        &[
            "deformation",
            "mean det J",
            "10 bit",
            "10 bit, normalised",
            "on the fly",
        ],
        &rows,
    );
}

fn opacity(page: &mut Page) {
    page.section("Opacity through compression and dilation (6.2.4)");
    page.text("Share of the light that a ray through the middle of a cube of haze (1 % per 0.01 units) loses: in Fabrica’s picture, and by the integral along the ray in f64. Constancy keeps what the untouched cube has; mass gives more where tissue is pressed together, less where it is drawn apart; without adjustment a shorter way is clearer.");
    let studio = haze();
    let whole = stopped(&studio, &[], MODES[0].0);
    let percent = |v: f64| format!("{:.1} %", 100.0 * v);
    let mut rows = vec![vec![
        "at rest".to_owned(),
        "any".to_owned(),
        percent(whole[0]),
        percent(whole[1]),
        percent((whole[0] - whole[1]).abs()),
    ]];
    for (kind, strengths) in [("squeeze", [0.5, 1.0, 2.0]), ("dilate", [0.3, 0.6, 0.9])] {
        for strength in strengths {
            let list = templates(&format!(
                r#"{{ "kind": "{kind}", "size": [1.2, 1.2, 1.2], "params": {{ "strength": {strength} }} }}"#
            ));
            for (mode, name) in MODES {
                let [drawn, right] = stopped(&studio, &list, mode);
                rows.push(vec![
                    format!("{kind} {strength}"),
                    name.to_owned(),
                    percent(drawn),
                    percent(right),
                    percent((drawn - right).abs()),
                ]);
            }
        }
    }
    page.table(
        &["deformation", "mode", "drawn", "integral", "off by"],
        &rows,
    );
}

fn save(name: &str, n: u32, light: &[f64]) {
    let rgba = light
        .iter()
        .flat_map(|l| {
            let byte = (255.0 * l.clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8;
            [byte, byte, byte, 255]
        })
        .collect();
    let png = encode_png(&Image { size: [n, n], rgba }).expect("a PNG");
    std::fs::write(folder().join(name), png).expect("a picture");
}

/// Scans of a ball that normals at rest are measured on.
pub(crate) const SCANNERS: [(&str, Scanner); 4] = {
    const fn scanner(thick: u32, noise: f64) -> Scanner {
        Scanner {
            n: 80,
            thick,
            noise,
        }
    }
    [
        ("cubes", scanner(1, 0.0)),
        ("cubes, noise of 0.05", scanner(1, 0.05)),
        ("slices five times as thick", scanner(5, 0.0)),
        ("such slices, noise of 0.05", scanner(5, 0.05)),
    ]
};
pub(crate) const BALL: Object = Object::Egg(DVec3::splat(0.36));

fn grain(page: &mut Page) {
    page.section("Normals of a smooth surface");
    page.text("A ball of radius 0.36 in scans of 80 × 80 voxels a slice, values from 0 to 1 with an edge as soft as a CT’s. Angles between the normals of a picture and those of the ball at 4,000 places, degrees: by central differences of two reaches, which pictures had before, and by Sobel’s operator, which they have.");
    let rows: Vec<_> = SCANNERS
        .iter()
        .map(|(name, scanner)| {
            let scan = Scan::by(BALL, *scanner);
            let surface = Surface::new(BALL, &[], 1.0 / 80.0, 4_000);
            let angles = [QUICK, FINE].map(|method| surface.angles_at_rest(&scan, method));
            let figures = angles.as_flattened().iter().map(|a| format!("{a:.2}"));
            [(*name).to_owned()].into_iter().chain(figures).collect()
        })
        .collect();
    page.table(
        &["voxels", "two reaches, mean", "99 %", "Sobel, mean", "99 %"],
        &rows,
    );
}

fn normals(page: &mut Page) {
    page.section("Normals (6.3)");
    page.text("An ellipsoid of known surface, scanned at 96³ with an edge as soft as a CT’s, deformed, and its normals found by each method at 2,000 places of the deformed surface. Angles to the closed form’s normals in degrees (mean, and what one place in a hundred exceeds), and the root mean square error of diffuse light. “Jacobian” is the program as it is: at rest the gradient is by Sobel’s operator over 26 places around. “Two reaches” is what it took before: it rounds curved surfaces. “Sobel at rest” takes eight places half a voxel off: as exact as Sobel on the fly, for a fraction of the look-ups. The dot product (slope along the light alone) has no normal; it takes every gradient for as long as at rest.");
    let n = 96;
    let scan = Scan::new(EGG, n);
    let mut rows = Vec::new();
    for (name, list) in deformations() {
        let surface = Surface::new(EGG, &list, 1.0 / f64::from(n), 2_000);
        for error in normal_errors(&scan, &list, &surface) {
            let [mean, high] = error.angle.map_or(["–".to_owned(), "–".to_owned()], |a| {
                a.map(|v| format!("{v:.2}"))
            });
            rows.push(vec![
                name.to_owned(),
                error.name.to_owned(),
                mean,
                high,
                format!("{:.4}", error.light),
                surface.len().to_string(),
            ]);
        }
    }
    page.table(
        &[
            "deformation",
            "method",
            "mean angle",
            "99 %",
            "error of light",
            "places",
        ],
        &rows,
    );
    page.text("The block at 64³ under a twist and a peel, lit by each method (figures 6.12 and 6.13; no highlight without a normal):");
    let scan = Scan::new(BLOCK, 64);
    for (kind, list) in [("twist", templates(TWIST)), ("peel", templates(PEEL))] {
        for (method, name) in &METHODS[1..] {
            let file = format!("{kind}-{method}.png");
            save(&file, 176, &picture(&scan, BLOCK, &list, 176, *method));
            page.picture(&file, &format!("{kind}, {name}"));
        }
    }
}

fn shape(page: &mut Page) {
    page.section("Shape from normals (6.3.1)");
    page.text("The top of a block, deformed: its height is integrated from the normals that a method finds (Horn’s gradient integration, from flat), and compared with its true height. Root mean square error as a share of the relief.");
    let scan = Scan::new(BLOCK, 96);
    let rounds = [10, 30, 100, 300, 1_000, 3_000, 10_000];
    let mut rows = Vec::new();
    for (name, text) in [("poke", POKE), ("wave", WAVE)] {
        let list = templates(text);
        let mut lines = Vec::new();
        for (method, title) in &METHODS[1..5] {
            let relief = Relief::new(&scan, BLOCK, &list, 56, *method);
            let shares: Vec<f64> = relief
                .errors(&rounds)
                .iter()
                .map(|e| e / relief.spread())
                .collect();
            let mut row = vec![format!("{name}, {title}")];
            row.extend(shares.iter().map(|s| format!("{:.2} %", 100.0 * s)));
            rows.push(row);
            lines.push((
                (*title).to_owned(),
                rounds
                    .iter()
                    .zip(&shares)
                    .map(|(r, s)| [f64::from(*r), 100.0 * s])
                    .collect(),
            ));
        }
        page.plot(
            &format!("Error of the shape of a {name} (figure 6.15)"),
            ["rounds of integration", "% of the relief"],
            &lines,
        );
    }
    let mut head = vec!["relief and method".to_owned()];
    head.extend(rounds.map(|r| format!("{r} rounds")));
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    page.table(&head, &rows);
}

fn cost(page: &mut Page) {
    page.section("Cost (6.4)");
    page.text("Time of a frame as a ratio, all in one run on one adapter; the fastest of several runs counts. <b>Lighting</b>: 96² rays by even steps, every sample with something in it lit, no other work; ratio to the same rays unlit. (The dissertation counted texture look-ups: Jacobian 2.67 stored or 3.34 on the fly, central differences 7, diffuse component 3.)");
    let scan = Scan::new(BLOCK, 64);
    let points: Vec<Vec3> = (0..96 * 96)
        .map(|i| {
            Vec3::new(
                (i % 96) as f32 / 96.0 - 0.495,
                0.65,
                (i / 96) as f32 / 96.0 - 0.495,
            )
        })
        .collect();
    let cases = [
        ("none", ""),
        ("twist", TWIST),
        ("peel", PEEL),
        ("wave", WAVE),
    ];
    let mut rows = Vec::new();
    for (method, name) in METHODS {
        rows.push((method, vec![name.to_owned()]));
    }
    for (_, text) in cases {
        let list = templates(text);
        let mut base = 0.0;
        for (method, row) in &mut rows {
            let kernel = Method::new(&scan, &list, "march", *method);
            let time = seconds(3, || drop(kernel.run(&points)));
            if *method == 0 {
                base = time;
            }
            row.push(format!("{:.2}", time / base));
        }
    }
    let rows: Vec<Vec<String>> = rows.into_iter().map(|r| r.1).collect();
    page.table(&["lighting", "no template", "twist", "peel", "wave"], &rows);

    let mut builder = VolumeBuilder::new();
    subjects::generate("head", 96, &mut builder).expect("the head");
    let volume = builder.finish().expect("a whole volume");
    page.text("<b>Adjusting opacity</b> (figure 6.21): the program’s own frames of the head, 160 × 120 pixels, under a split; ratio to no adjustment.");
    let studio = studio_of(gpu(), &volume, true);
    let mut scene = fabrica::document::Illustration::document_default();
    scene.templates = templates(
        r#"{ "kind": "split", "at": [0, 0, 0.2], "size": [0.8, 1, 0.6], "params": { "amount": 0.15 } }"#,
    );
    scene.camera.distance = 2.1;
    let mut rows = Vec::new();
    for (mode, gradient, name) in [
        (MODES[2].0, 0.0, "none"),
        (MODES[0].0, 0.0, "constancy"),
        (MODES[1].0, 0.0, "mass"),
        (MODES[0].0, 1.0, "constancy, by the gradient (6.2.5)"),
    ] {
        scene.look.opacity = mode;
        scene.look.gradient = gradient;
        let scene = scene.clone();
        let time = seconds(3, || {
            let image = studio.render_image(&scene, [160, 120], 1);
            drop(pollster::block_on(image).expect("a picture"));
        });
        rows.push((name, time));
    }
    let base = rows[0].1;
    let rows: Vec<Vec<String>> = rows
        .into_iter()
        .map(|(name, time)| vec![name.to_owned(), format!("{:.2}", time / base)])
        .collect();
    page.table(&["opacity", "ratio"], &rows);

    page.text("<b>Alignment</b> (table 6.3): as <code>fabrica bench</code>, 160 × 120 pixels of the head under one peel; ratio to the same peel that moves everything. (The dissertation: 1.12 to 1.29 for the surface, 1.14 for segments.) A frame is what moving the camera costs; what is made once per edit is beside it.");
    let named = SubjectRef::Builtin {
        name: "head".to_owned(),
        revision: 1,
    };
    let subject = Subject::from(volume);
    let bench = (&subject, &named);
    let bench = render::bench(
        gpu(),
        bench,
        None,
        render::BenchPlan {
            size_px: [160, 120],
            repeats: 5,
            ..Default::default()
        },
        render::system_clock,
        |_| {},
    );
    let bench = pollster::block_on(bench).expect("a bench").rows;
    let peel = bench
        .iter()
        .find(|row| row.name == "one peel")
        .map_or(1.0, |row| row.seconds);
    let rows: Vec<Vec<String>> = bench
        .iter()
        .filter(|row| row.has_grid)
        .map(|row| {
            vec![
                row.name.to_owned(),
                format!("{:.2}", row.ratio),
                format!("{:.2}", row.seconds / peel),
                format!("{:.1} ms", 1e3 * row.making_seconds),
                format!("{:.1} ms", 1e3 * row.opening_seconds),
            ]
        })
        .collect();
    page.table(
        &[
            "frame",
            "to undeformed",
            "to the same peel, axis",
            "made once per edit",
            "made from nothing",
        ],
        &rows,
    );
}
