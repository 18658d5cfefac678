//! The baked map: how far it is from the exact one, and the picture that is drawn from it.

use crate::gpu::{builtin, gpu, studio_of};
use crate::scatter::Random;
use fabrica::data::{Resources, Subject};
use fabrica::document::{Document, Illustration};
use fabrica::render::gpu_types::Templates;
use fabrica::render::{BakedMap, Probe, Renderer, system_clock};
use glam::{UVec3, Vec3};

/// Templates that only bend space, without a jump.
const SMOOTH: &str = r#"
    { "kind": "poke", "at": [0, 0, -0.2], "size": [0.8, 0.8, 0.4] },
    { "kind": "wave", "at": [0.05, 0.02, 0.1], "size": [0.6, 0.6, 0.6] },
    { "kind": "lens", "at": [0.15, 0.2, 0.1], "size": [0.5, 0.5, 0.5] },
    { "kind": "pull", "at": [-0.2, 0, 0.2], "size": [0.6, 0.6, 0.6] }"#;

/// Templates that cut: the map jumps at their openings.
const TORN: &str = r#"
    { "kind": "peel", "at": [0, 0.15, 0.3], "size": [0.4, 0.4, 0.3] },
    { "kind": "retractor", "at": [0.1, 0.3, 0.1], "size": [0.3, 0.3, 0.3] },
    { "kind": "twist", "at": [0, 0, -0.35], "size": [0.5, 0.5, 0.3] },
    { "kind": "cut", "at": [-0.3, 0.1, 0.3], "size": [0.15, 0.2, 0.2] },
    { "kind": "pull", "at": [0, 0.4, -0.1], "size": [0.3, 0.3, 0.3] }"#;

fn illustration(subject: &str, templates: &str) -> Illustration {
    let json = format!(
        r#"{{ "fabrica": 1, "subject": {{ "builtin": "{subject}" }}, "templates": [{templates}] }}"#
    );
    let document = Document::from_json(&json).expect("a valid document");
    document.illustration().clone()
}

/// The baked map, and points of its box with their exact displacement.
fn baked_and_exact(templates: &str, texels: u32) -> (BakedMap, Vec<(Vec3, Vec3)>) {
    let gpu = gpu();
    let studio = studio_of(gpu, &builtin("cube", 16), false);
    let scene = illustration("cube", templates);
    let map = pollster::block_on(studio.bake(&scene, Some(texels))).expect("a baked map");
    assert_eq!(map.texels.max_element(), texels);
    let mut random = Random(11);
    let points: Vec<Vec3> = (0..20_000)
        .map(|_| map.origin_min + map.size * random.vector(0.0, 1.0))
        .collect();
    let exact = pollster::block_on(async {
        let probe = Probe::new(gpu).await.expect("the probe");
        let packed = Templates::pack(&scene.templates, &Resources::default());
        probe.samples_of(&packed, &points).await.expect("samples")
    });
    let pairs = points
        .iter()
        .zip(exact)
        .map(|(point, sample)| (*point, sample.pos_in_rest - *point))
        .collect();
    (map, pairs)
}

fn displacement(texel: [f32; 4]) -> Vec3 {
    Vec3::new(texel[0], texel[1], texel[2])
}

/// What interpolation can be off by at a point: the second differences of the texels around it, summed over the axes
/// (half of an eighth of each would do for a parabola; a jump shows in them as a whole), and the rounding of half
/// floats.
fn bound(map: &BakedMap, pos: Vec3) -> f32 {
    let at = (pos - map.origin_min) / map.size * map.texels.as_vec3() - 0.5;
    let low = at.floor().as_ivec3();
    let last = map.texels.as_ivec3() - 1;
    let texel = |p: glam::IVec3| {
        let p = p.clamp(glam::IVec3::ZERO, last).as_uvec3();
        let index = p.x + map.texels.x * (p.y + map.texels.y * p.z);
        displacement(map.values[index as usize])
    };
    let mut sum = 0.0;
    let mut longest = 0.0f32;
    for axis in 0..3 {
        let unit = glam::IVec3::AXES[axis];
        let mut most = 0.0f32;
        for corner in 0..8u32 {
            let p = low + UVec3::new(corner & 1, (corner >> 1) & 1, corner >> 2).as_ivec3();
            let middle = texel(p);
            longest = longest.max(middle.abs().max_element());
            most = most.max((texel(p + unit) + texel(p - unit) - 2.0 * middle).length());
        }
        sum += most;
    }
    sum + longest * 2f32.powi(-9) + 1e-5
}

/// Source: the error of linear interpolation; Correa, section 6.2.
#[test]
fn the_error_stays_below_the_second_differences() {
    for (name, templates) in [("smooth", SMOOTH), ("torn", TORN)] {
        let (map, pairs) = baked_and_exact(templates, 96);
        let mut over = 0;
        let mut errors = Vec::new();
        for (pos, exact) in &pairs {
            let found = displacement(map.at(*pos).expect("inside the box"));
            let error = found.distance(*exact);
            over += usize::from(error > bound(&map, *pos));
            errors.push(error);
        }
        errors.sort_by(f32::total_cmp);
        let at = |part: f32| errors[((errors.len() - 1) as f32 * part) as usize];
        println!(
            "{name}: median error {:.6}, 99th percentile {:.5}, largest {:.4}, {over} of {} over the bound",
            at(0.5),
            at(0.99),
            at(1.0),
            errors.len()
        );
        // What lies between two texels without touching either can be missed: corners of boxes.
        assert!(over * 2000 <= errors.len(), "{name}: {over} over the bound");
        assert!(at(0.5) < 3e-4, "{name}: {}", at(0.5));
    }
}

/// Twice as many texels, a quarter of the error, where the map is smooth: until half floats round.
#[test]
fn finer_texels_err_less() {
    let mean = |texels| {
        let (map, pairs) = baked_and_exact(SMOOTH, texels);
        let sum: f32 = pairs
            .iter()
            .map(|(pos, exact)| displacement(map.at(*pos).expect("inside")).distance(*exact))
            .sum();
        sum / pairs.len() as f32
    };
    let errors = [16, 32, 64].map(mean);
    println!("mean error with 16, 32, 64 texels: {errors:?}");
    assert!(
        errors[1] < 0.4 * errors[0] && errors[2] < 0.4 * errors[1],
        "{errors:?}"
    );
}

/// The picture from the baked map is that of the exact one while something moves, but for the rims of cuts.
#[test]
fn the_baked_picture_is_close() {
    let gpu = gpu();
    let studio = studio_of(gpu, &builtin("head", 64), true);
    let scene = illustration("head", TORN);
    let size = [160, 160];
    let exact = pollster::block_on(studio.render_quick(&scene, size, 1)).expect("a picture");
    let baked =
        pollster::block_on(studio.render_baked(&scene, size, 1, Some(96))).expect("a picture");
    if let Ok(folder) = std::env::var("FABRICA_SHOW") {
        for (name, image) in [("exact", &exact), ("baked", &baked)] {
            let png = fabrica::render::encode_png(image).expect("a PNG");
            std::fs::write(format!("{folder}/{name}.png"), png).expect("written");
        }
    }
    let mut differences: Vec<u8> = exact
        .rgba
        .chunks_exact(4)
        .zip(baked.rgba.chunks_exact(4))
        .filter(|(a, _)| **a != [255; 4])
        .map(|(a, b)| {
            a.iter()
                .zip(b)
                .map(|(x, y)| x.abs_diff(*y))
                .max()
                .unwrap_or(0)
        })
        .collect();
    differences.sort_unstable();
    let mean = differences.iter().map(|d| f32::from(*d)).sum::<f32>() / differences.len() as f32;
    let median = differences[differences.len() / 2];
    println!(
        "baked picture: mean difference {mean:.2}, median {median} of 255, {} pixels",
        differences.len()
    );
    assert!(differences.len() > 5000, "something is drawn");
    assert!(mean > 0.0, "it was drawn from the texture");
    assert!(mean < 6.0 && median <= 2, "mean {mean}, median {median}");
}

/// While the camera moves the renderer may draw from the baked map; at rest it shows the exact picture, the same as
/// without.
#[test]
fn the_picture_at_rest_is_exact() {
    let gpu = gpu();
    let volume = builtin("head", 48);
    let mut scene = illustration("head", TORN);
    let mut renderer = Renderer::new(gpu.clone(), system_clock);
    renderer
        .set_subject(Subject::from(volume.clone()))
        .expect("fits");
    let size = [96, 96];
    let until_done = |renderer: &mut Renderer| {
        for _ in 0..20_000 {
            // A budget that the formulas cannot hold, so that baking is worth while.
            let state = renderer.draw(size, 2e-3, false).expect("a frame");
            if state.is_done && state.has_picture {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        panic!("the picture is never done");
    };
    renderer.set_illustration(&scene);
    until_done(&mut renderer);
    assert!(renderer.has_baked(), "worth while with five formulas");
    // The camera turns and comes back.
    for _ in 0..3 {
        scene.camera.distance += 0.1;
        renderer.set_illustration(&scene);
        renderer.draw(size, 2e-3, true).expect("a frame");
    }
    scene.camera.distance = 2.5;
    renderer.set_illustration(&scene);
    until_done(&mut renderer);
    let after = pollster::block_on(renderer.read_output()).expect("a picture");
    let mut fresh = Renderer::new(gpu.clone(), system_clock);
    fresh.set_subject(Subject::from(volume)).expect("fits");
    fresh.set_illustration(&scene);
    until_done(&mut fresh);
    let before = pollster::block_on(fresh.read_output()).expect("a picture");
    assert_eq!(after, before);
}
