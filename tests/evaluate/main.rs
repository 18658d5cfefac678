//! The dissertation's chapters 6 and 8 done again, with ground truth: what baked maps lose, which normals are right,
//! whether opacity is conserved, what lighting and alignment cost; how surfaces deform without remeshing, and what that
//! costs. Maps, scans and pictures come from the program's own WGSL; what they are held against is f64 closed form.
//!
//! The claims that must hold are tests. `cargo xtask evaluate` runs the whole, for some minutes, and writes
//! target/evaluation/index.html; so does `cargo test --test evaluate -- --ignored`.

mod bench;
#[path = "../support/data.rs"]
mod data;
#[path = "../support/gpu.rs"]
mod gpu;
mod layered;
mod maps;
mod normals;
mod opacity;
mod page;
#[path = "../reference/mod.rs"]
mod reference;
mod report;
#[path = "../support/scatter.rs"]
mod scatter;
mod shapes;
mod surface_report;
#[path = "../support/surfaces.rs"]
mod surfaces;

use bench::{Object, Scan};
use fabrica::data::Surface as MeshSurface;
use fabrica::document::{Document, PlacedTemplate};
use glam::{DVec3, UVec3};
use layered::Layered;
use maps::{Baked, Places, Precision};
use normals::{Relief, Surface, normal_errors};
use opacity::{MODES, haze, stopped};
use shapes::{Search, Truth};
use std::sync::Arc;

/// The templates of a document's list.
fn templates(list: &str) -> Vec<PlacedTemplate> {
    let text = format!(r#"{{ "fabrica": 1, "templates": [{list}] }}"#);
    let document = Document::from_json(&text).expect("a document");
    document.illustration().templates.clone()
}

const TWIST: &str = r#"{ "kind": "twist", "size": [0.9, 0.9, 0.9], "params": { "angle": 3 } }"#;
const PEEL: &str = r#"{ "kind": "peel", "at": [0, 0, 0.1], "size": [0.8, 0.8, 0.4], "params": { "progress": 0.6 } }"#;
const POKE: &str = r#"{ "kind": "poke", "at": [0, 0, 0.15], "size": [0.7, 0.7, 0.4] }"#;
/// Ripples of the top: y of the template is up.
const WAVE: &str = r#"{ "kind": "wave", "at": [0, 0, 0.2], "rotate": [0.7071068, 0, 0, 0.7071068], "size": [0.8, 0.5, 0.8], "params": { "amplitude": 0.06, "falloff": 0.3, "frequency": 25 } }"#;

const BLOCK: Object = Object::Block(DVec3::new(0.36, 0.36, 0.2));
const EGG: Object = Object::Egg(DVec3::new(0.36, 0.2, 0.3));

#[test]
fn formulas_lose_nothing_and_textures_less_the_finer_they_are() {
    for list in [templates(TWIST), templates(PEEL)] {
        let places = Places::new(&list, 6_000);
        // Nothing but the rounding of f32.
        let exact = places.exact(&list);
        assert!(exact.worst < 2e-6 && exact.wrong_side < 2e-4, "{exact:?}");
        let dims = |n| {
            UVec3::new(
                n,
                if list[0].kind.spec().name == "peel" {
                    4
                } else {
                    n
                },
                n,
            )
        };
        let errors: Vec<f64> = [8, 16, 32, 64]
            .map(|n| {
                places
                    .of(&Baked::new(&list, dims(n), Precision::Single))
                    .rms
            })
            .to_vec();
        assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
        assert!(
            errors[3] > 10.0 * exact.rms,
            "a texture loses something: {errors:?}"
        );
        let of = |precision| places.of(&Baked::new(&list, dims(64), precision)).rms;
        let (coarse, fine) = (of(Precision::Bits8), of(Precision::Bits16));
        assert!(coarse > 1.02 * fine, "{coarse} {fine}");
    }
}

#[test]
fn the_jacobian_gives_the_best_normals() {
    let scan = Scan::new(EGG, 64);
    for (name, list) in report::deformations() {
        let surface = Surface::new(EGG, &list, 1.0 / 64.0, 500);
        assert!(surface.len() > 250, "{name}: {} places", surface.len());
        let errors = normal_errors(&scan, &list, &surface);
        let mean = |method: &str| {
            let of = errors.iter().find(|e| e.name == method).expect("a method");
            of.angle.map_or(f64::INFINITY, |a| a[0])
        };
        println!("{name}: {errors:?}");
        let own = mean("Jacobian, Sobel at rest");
        assert!(
            own < 0.75 * mean("central differences on the fly"),
            "{name}: {errors:?}"
        );
        assert!(own < 1.3 * mean("Sobel on the fly"), "{name}: {errors:?}");
        // What the program takes is as good; what it takes for taps around a surface reaches farther and rounds curved
        // surfaces.
        assert!(mean("Jacobian") < 1.1 * own, "{name}: {errors:?}");
        assert!(
            mean("Jacobian, two reaches at rest") < 3.5,
            "{name}: {errors:?}"
        );
    }
}

#[test]
fn pictures_have_smoother_normals_than_two_reaches() {
    let surface = Surface::new(report::BALL, &[], 1.0 / 80.0, 2_000);
    for (name, scanner) in report::SCANNERS {
        let scan = Scan::by(report::BALL, scanner);
        let [quick, fine] = [bench::QUICK, bench::FINE].map(|m| surface.angles_at_rest(&scan, m));
        println!("{name}: {quick:.2?} and {fine:.2?}");
        assert!(
            fine[0] < 0.5 * quick[0] && fine[1] < 0.5 * quick[1],
            "{name}"
        );
    }
}

#[test]
fn shape_comes_back_from_normals() {
    let scan = Scan::new(BLOCK, 64);
    for list in [templates(POKE), templates(WAVE)] {
        let relief = Relief::new(&scan, BLOCK, &list, 40, 1);
        let errors = relief.errors(&[10, 100, 1_000]);
        assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
        for other in [2, 3] {
            let others = Relief::new(&scan, BLOCK, &list, 40, other).errors(&[1_000]);
            assert!(
                errors[2] < others[0],
                "{errors:?}, method {other}: {others:?}"
            );
        }
        let left = errors[2] / relief.spread();
        assert!(left < 0.03, "{left} of the relief is lost");
    }
}

#[test]
fn opacity_is_what_each_mode_promises() {
    let studio = haze();
    let whole = stopped(&studio, &[], MODES[0].0);
    for kind in ["squeeze", "dilate"] {
        let list = templates(&format!(
            r#"{{ "kind": "{kind}", "size": [1.2, 1.2, 1.2] }}"#
        ));
        for (mode, name) in MODES {
            let [drawn, expected] = stopped(&studio, &list, mode);
            // A level of 255 is rounding; the rest of the bound is the sum along the ray by steps of three quarters of
            // a voxel.
            assert!(
                (drawn - expected).abs() < 0.012,
                "{kind}, {name}: {drawn} {expected}"
            );
            if name == "constancy" {
                assert!(
                    (drawn - whole[0]).abs() < 0.012,
                    "{kind}: {drawn} {whole:?}"
                );
            } else {
                assert!(
                    (drawn - whole[0]).abs() > 0.03,
                    "{kind}, {name}: nothing changed"
                );
            }
        }
    }
}

#[test]
fn triangles_that_stay_are_exact_and_moved_vertices_are_not() {
    let list = templates(surface_report::TURN);
    let coarse = shapes::egg(24);
    let fine = Arc::new(coarse.parted());
    let moved = [&coarse, &fine].map(|surface| shapes::error_of_moved(surface, &list, 4_000));
    // Parting the triangles in four makes chords half as long, and their height over an arc a quarter.
    assert!(
        moved[0].mean > 2.5 * moved[1].mean && moved[0].mean > 1e-3,
        "{moved:?}"
    );
    for surface in [&coarse, &fine] {
        let ours = shapes::error_of_rays(surface, &list, 300);
        assert!(ours.worst < 1e-4, "{ours:?}");
    }
}

#[test]
fn a_narrow_pull_is_missed_by_even_steps_and_not_by_the_picture() {
    let surface = shapes::egg(48);
    let list = templates(surface_report::PULL);
    let scene = shapes::scene(&list, 0.4);
    let rays = shapes::rays(&scene, surface_report::PULLED, 200);
    let truth = Truth::new(&surface, &list, rays);
    assert!(truth.met() > 20, "{} rays meet it", truth.met());
    let layered = Layered::field(&surface, 64);
    let even = truth.wrong_of(Search::Signs(1.0 / 32.0), &layered, &surface, &list);
    println!("{} rays meet it; even steps lose {even:?}", truth.met());
    assert!(even.0 > 0, "even steps miss nothing: {even:?}");
    assert_eq!(truth.wrong_of_picture(&surface, &scene), 0);
}

#[test]
fn depth_maps_do_for_what_they_see_whole() {
    let rays = layered::rays(1_000, true);
    let wrong = |surface: &MeshSurface, kind: fn(&MeshSurface, u32) -> Layered| {
        layered::error_of(&kind(surface, 64), surface, &rays).wrong
    };
    let (egg, vase) = (shapes::egg(48), shapes::vase(48));
    let errors = [
        wrong(&egg, Layered::field),
        wrong(&egg, Layered::depth_map),
        wrong(&egg, Layered::cube),
        wrong(&vase, Layered::field),
        wrong(&vase, Layered::cube),
    ];
    println!("{errors:?}");
    let [egg_field, egg_map, egg_cube, vase_field, vase_cube] = errors;
    assert!(
        egg_field < 0.02 && egg_map < 0.08 && egg_cube < 0.08,
        "{errors:?}"
    );
    // No side of the cube sees the vase's inner wall.
    assert!(vase_field < 0.05 && vase_cube > 0.1, "{errors:?}");
}

/// Not a test: writes the report.
#[test]
#[ignore = "takes minutes; run by cargo xtask evaluate"]
fn report() {
    report::write();
}
