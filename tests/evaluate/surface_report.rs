//! Chapter 8 and sections 7.5.2 and 7.6.2 at full size, written into the page.

use super::bench::seconds;
use super::layered::{self, Layered, error_of};
use super::page::{Page, figures};
use super::report::folder;
use super::shapes::{self, Search, ShapeError, Truth, error_of_moved, error_of_rays, studio};
use super::templates;
use crate::data::data_folder;
use crate::gpu::{builtin, gpu, studio_of};
use crate::surfaces::surface_of;
use fabrica::data::{Mesh, Resources, Surface, Triangle};
use fabrica::document::{Document, Illustration, ObjectSource};
use fabrica::render::{Studio, encode_png};
use fabrica::subjects;
use glam::Vec3;
use std::sync::Arc;

/// Turns the upper half, continuous.
pub(crate) const TURN: &str = r#"{ "kind": "twist", "at": [0, 0, 0.1], "size": [1.2, 1.2, 0.6], "params": { "angle": 2.5 } }"#;
/// Opens the front, discontinuous.
const OPEN: &str = r#"{ "kind": "peel", "at": [0, 0.3, 0.1], "rotate": [-0.70710678, 0, 0, 0.70710678], "size": [0.7, 0.6, 0.4], "params": { "progress": 0.6 } }"#;
/// A narrow pull (section 7.5.2).
pub(crate) const PULL: &str = r#"{ "kind": "poke", "at": [0, 0, 0.5], "size": [0.2, 0.2, 0.6], "params": { "amount": 0.6, "sigma": 0.05 } }"#;
/// Where the pull stands: middle, and half the side of a cube.
pub(crate) const PULLED: (Vec3, f32) = (Vec3::new(0.0, 0.0, 0.68), 0.03);

const SIZE: [u32; 2] = [160, 120];

/// A mesh of the scans' folder, or a made one where there is none.
fn mesh(name: &str, otherwise: impl Fn() -> Arc<Surface>) -> (String, Arc<Surface>) {
    let file = data_folder("report").map(|folder| folder.join("mesh").join(name));
    match file.map(std::fs::read) {
        Some(Ok(bytes)) => (name.to_owned(), surface_of(name, bytes)),
        _ => ("made".to_owned(), otherwise()),
    }
}

/// Writes all sections.
pub(crate) fn write(page: &mut Page) {
    moved(page);
    sizes(page);
    fields(page);
    representations(page);
    neighbours(page);
    pull(page);
}

fn shape_row(name: String, error: &ShapeError) -> Vec<String> {
    vec![
        name,
        figures(error.mean),
        figures(error.worst),
        format!("{:.2} %", 100.0 * error.turned),
    ]
}

fn picture(page: &mut Page, name: &str, title: &str, studio: &Studio, scene: &Illustration) {
    let image = pollster::block_on(studio.render_image(scene, [240, 320], 4)).expect("a picture");
    std::fs::write(folder().join(name), encode_png(&image).expect("a PNG")).expect("a picture");
    page.picture(name, title);
}

/// Figure 8.1: vertices that are moved against triangles that stay.
fn moved(page: &mut Page) {
    page.section("Twist without remeshing (8.2, figure 8.1)");
    let (name, coarse) = mesh("hand_lowres.obj", || shapes::egg(24));
    page.text(&format!("A twist of 2.5 rad of {name} with three numbers of triangles (each parted in four at the middles of its sides, so the shape at rest is the same). Moved vertices: the mesh as modelling programs deform it. Ours: what the picture’s rays meet. Distances between what is shown and the true deformed surface, measured where the material was at rest, subject units; triangles that look to the wrong side, by area. The dissertation had to part its hand (18,905 triangles) into 52,463 for a smooth twist."));
    let list = templates(TURN);
    let shown = shapes::scene(&list, 0.4);
    let mut rows = Vec::new();
    let mut surface = coarse;
    for level in 0..3 {
        if level > 0 {
            surface = Arc::new(surface.parted());
        }
        let count = surface.triangles.len();
        let explicit = error_of_moved(&surface, &list, 20_000);
        rows.push(shape_row(
            format!("{count} triangles, moved vertices"),
            &explicit,
        ));
        let ours = error_of_rays(&surface, &list, 2_000);
        rows.push(shape_row(format!("{count} triangles, ours"), &ours));
        let triangles = shapes::moved(&surface, &shapes::untwisted(&list));
        let explicit = plain(&surface, &triangles);
        // At rest, as the vertices are moved already; what was the box stays it.
        let at_rest = shapes::scene(&[], 0.4);
        picture(
            page,
            &format!("moved-{level}.png"),
            &format!("{count} triangles, moved vertices"),
            &studio(&explicit),
            &at_rest,
        );
        picture(
            page,
            &format!("ours-{level}.png"),
            &format!("{count} triangles, ours"),
            &studio(&surface),
            &shown,
        );
    }
    page.table(&["mesh", "mean", "largest", "turned over"], &rows);
}

/// A surface of triangles, with flat normals, in the units of another.
fn plain(like: &Surface, triangles: &[Triangle]) -> Arc<Surface> {
    let mesh = Mesh {
        positions: triangles
            .iter()
            .flat_map(|t| t.0)
            .map(|p| p * 100.0)
            .collect(),
        triangles: (0..triangles.len() as u32)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect(),
        ..Mesh::default()
    };
    let half = like.frame.bounds.size().max_element() * 50.0;
    let within = [
        glam::DVec3::splat(-f64::from(half)),
        glam::DVec3::splat(f64::from(half)),
    ];
    Arc::new(
        Surface::of(&[(&mesh, Some(0.0))], Some(within), &mut |_| true).expect("it has a size"),
    )
}

fn frame(studio: &Studio, scene: &Illustration) -> f64 {
    seconds(3, || {
        drop(pollster::block_on(studio.render_image(scene, SIZE, 1)).expect("a picture"))
    })
}

/// Tables 8.1 and 8.2: time against triangles, continuous and cut, with and without skipping.
fn sizes(page: &mut Page) {
    page.section("Time against triangles (8.3, tables 8.1 and 8.2)");
    page.text("A frame of 160 × 120 pixels, fastest of three, as a ratio to the undeformed frame of the first mesh; “no skipping” is without the grid over the deformed space. The dissertation found no significant effect of the number of triangles (83.9 to 119.2 ms for 18,905 to 1,087,716 triangles, continuous), cuts 2.5 to 3.6 times as long without skipping and 0.8 to 1.5 times with it.");
    let mut meshes = vec![
        mesh("hand_lowres.obj", || shapes::egg(24)),
        mesh("bunny.obj", || shapes::egg(96)),
        mesh("armadillo.obj", || shapes::egg(170)),
    ];
    let finest = meshes[2].1.parted().parted();
    meshes.push((
        format!("{}, each triangle in 16", meshes[2].0),
        Arc::new(finest),
    ));
    let mut base = None;
    let mut rows = Vec::new();
    for (name, surface) in &meshes {
        let studio = studio(surface);
        let plain = studio.with_grid(false);
        let [rest, twist, open] = ["", TURN, OPEN].map(|list| shapes::scene(&templates(list), 0.4));
        let times = [
            frame(&studio, &rest),
            frame(&studio, &twist),
            frame(&plain, &twist),
            frame(&studio, &open),
            frame(&plain, &open),
        ];
        let base = *base.get_or_insert(times[0]);
        let mut row = vec![name.clone(), surface.triangles.len().to_string()];
        row.extend(times.map(|time| format!("{:.2}", time / base)));
        rows.push(row);
    }
    page.table(
        &[
            "mesh",
            "triangles",
            "at rest",
            "twist",
            "twist, no skipping",
            "cut",
            "cut, no skipping",
        ],
        &rows,
    );
}

/// Figure 8.3: time against the size of the field.
fn fields(page: &mut Page) {
    page.section("Time against the size of the field (8.3.1, figure 8.3)");
    page.text("The same surface with fields of other sizes (the program’s has 128 voxels along the longest side). The field leads to the triangles and is not what is drawn: its size changes the time, and neither shape nor memory of detail. Steady rays that meet something else than by chords of 1/4096 in double precision.");
    let (name, surface) = mesh("bunny.obj", || shapes::egg(96));
    let scene = shapes::scene(&templates(TURN), 0.4);
    let rays = shapes::rays(&scene, (Vec3::ZERO, 0.3), 400);
    let truth = Truth::new(&surface, &scene.templates, rays);
    let mut base = None;
    let mut rows = Vec::new();
    for n in [32, 64, 128, 192] {
        let other = shapes::with_field(&surface, n);
        let time = frame(&studio(&other), &scene);
        let base = *base.get_or_insert(time);
        let wrong = truth.wrong_of_picture(&other, &scene);
        let bytes = 2 * other.field.depths.len() + other.segmentation.labels.len();
        rows.push(vec![
            format!("{name}, {n} voxels"),
            format!("{:.2} MB", bytes as f64 / 1e6),
            format!("{:.2}", time / base),
            format!("{wrong} of {}", truth.rays.len()),
        ]);
    }
    page.table(&["field", "size", "ratio of a frame", "rays wrong"], &rows);
}

/// Sections 7.6.2 and 8.3.1, figure 8.4: distance field, depth map and depth-map cube against the triangles.
fn representations(page: &mut Page) {
    page.section("Distance field, depth map and depth-map cube (7.6.2, 8.3.1, figure 8.4)");
    page.text("Equations 7.6 and 7.7 sampled from the triangles and searched by steps of 1/1024, 2,000 straight rays from all sides (of the depth map: from above). Distance along the ray to the first triangle, subject units, where both are within 0.02; rays that miss, or meet another part of the surface; time of a look-up on the processor as a ratio to that of the field of the same size (the dissertation: the same for a depth map, much slower for the cube, which takes six look-ups). Triangles, as the program draws them, have no error and no size to choose.");
    let mut rows = Vec::new();
    for (name, surface) in [
        ("egg".to_owned(), shapes::egg(96)),
        ("torus".to_owned(), shapes::torus(96)),
        ("vase".to_owned(), shapes::vase(96)),
        mesh("hand_closed.obj", || shapes::torus(128)),
        mesh("bunny.obj", || shapes::egg(128)),
    ] {
        for n in [32, 64, 128] {
            let mut base = 0.0;
            for (kind, layered) in [
                ("distance field", Layered::field(&surface, n)),
                ("depth map", Layered::depth_map(&surface, n)),
                ("depth-map cube", Layered::cube(&surface, n)),
            ] {
                let rays = layered::rays(2_000, kind == "depth map");
                let error = error_of(&layered, &surface, &rays);
                let places: Vec<Vec3> = rays
                    .iter()
                    .flat_map(|r| [r.0 * 0.5, r.1 * 0.5, r.0.lerp(r.1, 0.5)])
                    .collect();
                let time = seconds(5, || {
                    let sum: f32 = places.iter().map(|p| layered.value(*p)).sum();
                    std::hint::black_box(sum);
                });
                if kind == "distance field" {
                    base = time;
                }
                rows.push(vec![
                    format!("{name}, {kind}, {n}"),
                    format!("{:.2} MB", layered.bytes() as f64 / 1e6),
                    figures(error.mean),
                    format!("{:.1} %", 100.0 * error.wrong),
                    format!("{:.2}", time / base),
                ]);
            }
        }
    }
    page.table(
        &[
            "representation",
            "size",
            "mean distance",
            "rays wrong",
            "look-up",
        ],
        &rows,
    );
}

/// Figure 8.5: what neighbours that are not deformed cost.
fn neighbours(page: &mut Page) {
    page.section("Neighbours that are not deformed (8.3.2, figure 8.5)");
    page.text("A frame with objects beside, before and in what a peel opens, as a ratio to the same frame without them. The dissertation had to estimate depths inside the deformed region (up to a quarter more time, read off its figure); here the distance along a ray is known.");
    let objects = [
        "",
        r#"{ "builtin": "scalpel", "at": [0.9, 0, 0] }"#,
        r#"{ "builtin": "scalpel", "at": [0.1, 0.5, 0.1] }"#,
        r#"{ "builtin": "scalpel", "at": [0, 0.2, 0.1] }"#,
    ];
    let titles = ["none", "beside", "before", "in the cut"];
    let (name, surface) = mesh("bunny.obj", || shapes::egg(96));
    let head = studio_of(gpu(), &builtin("head", 96), true);
    let mut rows = Vec::new();
    for (name, studio) in [(name, studio(&surface)), ("head (96³)".to_owned(), head)] {
        let mut base = 0.0;
        let mut row = vec![name];
        for object in objects {
            let text = format!(
                r#"{{ "fabrica": 1, "subject": {{ "builtin": "cube" }}, "objects": [{object}], "templates": [{OPEN}] }}"#
            );
            let document = Document::from_json(&text).expect("a document");
            let mut scene = shapes::scene(&document.illustration().templates, 0.4);
            scene.objects.clone_from(&document.illustration().objects);
            let tool = subjects::tool("scalpel").expect("a tool");
            let tool = Surface::new(&tool, None, &mut |_| true).expect("it has a size");
            let resources = Resources {
                objects: vec![(ObjectSource::Builtin("scalpel"), Arc::new(tool))],
                ..Resources::default()
            };
            let time = frame(&studio.clone().with_resources(resources), &scene);
            if base == 0.0 {
                base = time;
            }
            row.push(format!("{:.2}", time / base));
        }
        rows.push(row);
    }
    let mut head = vec!["subject"];
    head.extend(titles);
    page.table(&head, &rows);
}

/// Figure 7.8: a narrow pull by even steps, by steps of equation 7.5, and by ours.
fn pull(page: &mut Page) {
    page.section("A narrow pull (7.5.2, figure 7.8)");
    page.text("Steady rays that miss the pulled surface or meet it elsewhere, against chords of 1/4096 in double precision, and samples of the map per ray. Signs: the zero of a distance field of 64³ by even steps with ten halvings, as the dissertation’s linear search; Jacobian: the same by equation 7.5; chords: even steps, each chord against the triangles.");
    let (name, surface) = mesh("bunny.obj", || shapes::egg(96));
    let list = templates(PULL);
    let scene = shapes::scene(&list, 0.4);
    let layered = Layered::field(&surface, 64);
    let truth = Truth::new(&surface, &list, shapes::rays(&scene, PULLED, 1_000));
    let mut rows = Vec::new();
    for denominator in [64.0, 128.0, 256.0, 512.0] {
        let step = 1.0 / denominator;
        for (kind, search) in [
            ("signs", Search::Signs(step)),
            ("Jacobian", Search::Jacobian(step)),
            ("chords", Search::Chords(step)),
        ] {
            let (wrong, samples) = truth.wrong_of(search, &layered, &surface, &list);
            rows.push(vec![
                format!("{name}, {kind}, 1/{denominator}"),
                format!("{wrong} of {}", truth.rays.len()),
                format!("{samples:.0}"),
            ]);
        }
    }
    let wrong = truth.wrong_of_picture(&surface, &scene);
    rows.push(vec![
        format!("{name}, ours"),
        format!("{wrong} of {}", truth.rays.len()),
        "–".to_owned(),
    ]);
    page.table(&["search", "rays wrong", "samples"], &rows);
}
