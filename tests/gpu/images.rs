//! The picture: laws in numbers first, then snapshots of 128 pixels or less, drawn by the software rasteriser.
//!
//! `FABRICA_BLESS=name cargo test --test gpu images::` writes a snapshot anew (`all` for every one).

use crate::data::data_folder;
use crate::figures::figure_image;
use crate::gpu::{builtin, open_software, software, studio_of, uniform_volume};
use crate::scans::read_volume_at;
use fabrica::data::{Subject, SubjectPart, SubjectSink as _, Volume, VolumeBuilder};
use fabrica::document::{Document, Illustration};
use fabrica::load::{LoadReport, ReadOptions};
use fabrica::render::{
    Image, RenderError, Renderer, Studio, encode_png, render_image, system_clock,
};
use fabrica::subjects::{FINE_RESOLUTION, Generator};
use glam::{Vec2, Vec3};
use std::path::PathBuf;

fn illustration(json: &str) -> Illustration {
    let document = Document::from_json(json).expect("a valid document");
    document.illustration().clone()
}

fn draw(volume: &Volume, json: &str, size: [u32; 2], samples: u32) -> Image {
    let scene = illustration(json);
    let subject = Subject::from(volume.clone());
    let picture = render_image(software(), &scene, &subject, size, samples);
    pollster::block_on(picture).expect("a picture")
}

fn pixel(image: &Image, x: u32, y: u32) -> [u8; 4] {
    let at = 4 * (y * image.size[0] + x) as usize;
    image.rgba[at..at + 4].try_into().expect("inside")
}

/// Largest difference of any channel, and how many pixels differ by more than `bound`.
fn difference(a: &Image, b: &Image, bound: u8) -> (u8, usize) {
    assert_eq!(a.size, b.size);
    let worst = |(x, y): (&[u8], &[u8])| x.iter().zip(y).map(|(p, q)| p.abs_diff(*q)).max();
    let pixels: Vec<u8> = a
        .rgba
        .chunks_exact(4)
        .zip(b.rgba.chunks_exact(4))
        .filter_map(worst)
        .collect();
    (
        pixels.iter().copied().max().unwrap_or_default(),
        pixels.iter().filter(|&&d| d > bound).count(),
    )
}

/// The rim of a flap runs out into the skin's soft border, where tissue is thinner than a step of the ray. It is seen
/// as far as it is dense, wherever the samples lie: no stripes and no gaps along the rim. Rows of pixels that end and
/// go on within six pixels are counted; four are of leaves and of the flap before the fruit, and 25 there were when
/// rays did not search for cuts.
#[test]
fn the_rim_of_a_flap_has_no_gaps() {
    let peel = r#"{ "fabrica": 1, "subject": { "builtin": "tomato" }, "look": { "background": "none" },
        "templates": [{ "kind": "peel", "at": [0, 0.36, 0.02], "rotate": [-0.7071, 0, 0, 0.7071], "size": [0.72, 0.62, 0.3],
            "params": { "depth": 0.36, "progress": 0.7, "radius": 0.14 } }],
        "camera": { "rotate": [0.1361, 0.0289, 0.2059, 0.9686], "distance": 2.3 } }"#;
    let image = draw(&builtin("tomato", FINE_RESOLUTION), peel, [400, 300], 1);
    let mut gaps = 0;
    for y in 0..image.size[1] {
        let seen = (0..image.size[0]).filter(|&x| pixel(&image, x, y)[3] > 96);
        let seen: Vec<u32> = seen.collect();
        gaps += seen
            .windows(2)
            .filter(|w| (2..=6).contains(&(w[1] - w[0])))
            .count();
    }
    println!("{gaps} gaps");
    assert!(gaps <= 6, "{gaps} gaps along rims");
}

/// A revision of a built-in subject, so many voxels along its longest side.
pub(crate) fn revision(name: &str, revision: u32, resolution: u32) -> Volume {
    let generator = Generator::of_revision(name, revision, resolution).expect("a subject");
    let mut builder = VolumeBuilder::new();
    let mut take = |part| builder.take(part).expect("it is taken");
    take(SubjectPart::header(generator.header()));
    let slab = generator.slab(0..generator.slice_count());
    slab.into_parts().into_iter().for_each(take);
    builder.finish().expect("a whole volume")
}

/// How light varies inside a square of 40 pixels: the root of the mean square of what a quadratic fit leaves, levels of
/// 255.
fn variation(image: &Image, [x0, y0]: [u32; 2]) -> f64 {
    let places = (0..40).flat_map(|y| (0..40).map(move |x| [x, y]));
    let samples: Vec<([f64; 6], f64)> = places
        .map(|[x, y]| {
            let [r, g, b, _] = pixel(image, x0 + x, y0 + y).map(f64::from);
            let [u, v] = [x, y].map(|c| f64::from(c) / 40.0 - 0.5);
            let terms = [1.0, u, v, u * u, u * v, v * v];
            (terms, 0.2126 * r + 0.7152 * g + 0.0722 * b)
        })
        .collect();
    // Normal equations, one term after the other.
    let mut rows = [[0.0; 7]; 6];
    for (terms, light) in &samples {
        for (row, a) in rows.iter_mut().zip(terms) {
            let ends = terms.iter().chain([light]);
            row.iter_mut().zip(ends).for_each(|(sum, b)| *sum += a * b);
        }
    }
    for i in 0..6 {
        let pivot = rows[i];
        for (j, row) in rows.iter_mut().enumerate() {
            let factor = if j == i { 0.0 } else { row[i] / pivot[i] };
            row.iter_mut()
                .zip(pivot)
                .for_each(|(a, b)| *a -= factor * b);
        }
    }
    let fit: Vec<f64> = (0..6).map(|i| rows[i][6] / rows[i][i]).collect();
    let left = samples.iter().map(|(terms, light)| {
        let fitted: f64 = terms.iter().zip(&fit).map(|(a, b)| a * b).sum();
        (light - fitted).powi(2)
    });
    (left.sum::<f64>() / samples.len() as f64).sqrt()
}

/// Smooth skin shows no layers of voxels: on the flank of the torso light varies by a third of what it did. In pictures
/// of the first revision, whose borders bend where the grid cannot follow, that was 0.94 levels by the normals of then.
/// There is no form in the square but the fitted one.
#[test]
fn smooth_skin_shows_no_layers_of_voxels() {
    let [first, second] = [1, 2].map(|number| {
        let flank = format!(
            r#"{{ "fabrica": 1, "subject": {{ "builtin": "torso", "revision": {number} }},
            "camera": {{ "distance": 0.6, "target": [-0.12, 0.1, 0.05] }} }}"#
        );
        let studio = studio_of(
            software(),
            &revision("torso", number, FINE_RESOLUTION),
            true,
        );
        let (scene, size) = (illustration(&flank), [240, 180]);
        let image = pollster::block_on(studio.render_image(&scene, size, 4));
        variation(&image.expect("a picture"), [145, 120])
    });
    println!("{first:.2} and {second:.2} levels");
    assert!(second < first, "the first revision shows more: {first}");
    assert!(second < 0.33 * 0.94, "{second} of 0.94");
}

/// The steps of the march leave layers where tissue grows denser over several of them: in the MRI of a head, whose skin
/// has no sharp border, they are plain at one sample. Each sample of a pixel has its steps elsewhere, so that they are
/// lost in the mean.
#[test]
fn layers_of_steps_are_lost_in_the_mean() {
    let Some(folder) = data_folder("images::layers_of_steps_are_lost_in_the_mean") else {
        return;
    };
    let (mut builder, mut report) = (VolumeBuilder::new(), LoadReport::default());
    let path = folder.join("mri/head_t1.nii.gz");
    read_volume_at(&path, &ReadOptions::default(), &mut builder, &mut report)
        .expect("a readable scan");
    let studio = studio_of(software(), &builder.finish().expect("a whole volume"), true);
    let temple = illustration(
        r#"{ "fabrica": 1, "camera": { "rotate": [0.0501, 0.02, 0.5514, 0.8325], "distance": 1.1, "target": [0.25, 0.1, 0] } }"#,
    );
    let [one, eight] = [1, 8].map(|samples| {
        let image = pollster::block_on(studio.render_image(&temple, [450, 450], samples));
        let image = image.expect("a picture");
        [[240, 360], [300, 370], [350, 390]].map(|at| variation(&image, at))
    });
    println!("{one:.2?} and {eight:.2?} levels");
    for (one, eight) in one.into_iter().zip(eight) {
        assert!(eight < 0.5 * one, "{eight} of {one}");
    }
}

/// Haze of 1 % per 0.01 units.
const HAZE: &str = r##""look": { "transfer": [{ "value": 0, "color": "#808080", "opacity": 0.01 }, { "value": 9, "color": "#808080", "opacity": 0.01 }], "background": "none" }"##;

/// A ray through the middle of a cube of haze goes 1 unit, so 1 − 0.99^100 of it is stopped (63.4 %, byte 161.7),
/// whether it takes 10 steps or 200. Bound: the way is known to 2⁻⁷ of a step at each end; 0.1 units · 2⁻⁷ · 2 is 0.16
/// % of the light, half a level; the rounding to bytes is another half.
#[test]
fn haze_does_not_depend_on_the_step() {
    let json = format!(r#"{{ "fabrica": 1, {HAZE} }}"#);
    let expected = (255.0 * (1.0 - 0.99f32.powi(100))) as i32;
    let mut colors = Vec::new();
    for n in [8, 32, 128] {
        let image = draw(&uniform_volume(n), &json, [17, 17], 1);
        let found = pixel(&image, 8, 8);
        assert!(
            (i32::from(found[3]) - expected).abs() <= 1,
            "{n} voxels: alpha {} instead of {expected}",
            found[3]
        );
        colors.push(found);
    }
    for channel in 0..4 {
        let all = colors.iter().map(|c| c[channel]);
        let (low, high) = (all.clone().min(), all.max());
        assert!(
            high.zip(low).is_some_and(|(h, l)| h - l <= 1),
            "channel {channel} depends on the step: {colors:?}"
        );
    }
    // Negative control: half the way is another colour.
    let cut = r#""templates": [{ "kind": "cut", "at": [0, 0.5, 0], "size": [4, 1, 4] }]"#;
    let image = draw(
        &uniform_volume(32),
        &format!(r#"{{ "fabrica": 1, {HAZE}, {cut} }}"#),
        [17, 17],
        1,
    );
    let half = (255.0 * (1.0 - 0.99f32.powi(50))) as i32;
    let found = i32::from(pixel(&image, 8, 8)[3]);
    assert!(
        (found - half).abs() <= 1,
        "half the way: {found} instead of {half}"
    );
    assert!(
        (found - expected).abs() > 20,
        "the comparison sees no difference"
    );
}

const CUBE: &str = r#""subject": { "builtin": "cube" }, "camera": { "rotate": [0.2, 0.1, 0.3, 0.927], "distance": 3.2 }"#;

/// Without templates, and with ones that are shut or switched off, the same object is seen.
#[test]
fn shut_templates_change_nothing() {
    let volume = builtin("cube", 64);
    let with = |templates: &str| {
        let json = format!(r#"{{ "fabrica": 1, {CUBE}, "templates": [{templates}] }}"#);
        draw(&volume, &json, [64, 64], 1)
    };
    let plain = with("");
    let disabled = with(r#"{ "kind": "peel", "enabled": false }"#);
    assert_eq!(plain, disabled, "a disabled template is as if not there");
    // A shut peel goes through the map and its longer loop, so rays are sampled at other places: grazing pixels differ.
    // Measured: 69 of 4,096.
    let shut = with(r#"{ "kind": "peel", "params": { "progress": 0 } }"#);
    let (_, shut_count) = difference(&plain, &shut, 3);
    assert!(shut_count <= 64 * 64 / 40, "{shut_count} pixels differ");
    let open = with(r#"{ "kind": "peel", "size": [0.8, 0.6, 0.8], "at": [0, 0, 0.2] }"#);
    let (worst, open_count) = difference(&plain, &open, 3);
    assert!(
        worst > 60 && open_count > 100,
        "the comparison does not see an open peel: {open_count}"
    );
}

/// The edge of a cut lies where the formula says, at any step: a cube cut at x = 0.1 keeps its part towards -x.
#[test]
fn cuts_are_where_they_are_at_any_step() {
    let json = r##"{ "fabrica": 1, "camera": { "distance": 100, "fov": 1 },
        "look": { "transfer": [{ "value": 0, "color": "#808080", "opacity": 1 }, { "value": 9, "color": "#808080", "opacity": 1 }], "background": "none" },
        "templates": [{ "kind": "cut", "at": [0.6, 0, 0], "size": [1, 4, 4] }] }"##;
    // 100 units away with 1 degree the view is 1.7455 units wide; -x is on the right.
    let units_per_pixel = 2.0 * 100.0 * 0.5f32.to_radians().tan() / 101.0;
    let expected = (0.5 + 0.1) / units_per_pixel;
    for n in [8, 64] {
        let image = draw(&uniform_volume(n), json, [101, 101], 4);
        let covered: f32 = (0..101)
            .map(|x| f32::from(pixel(&image, x, 50)[3]) / 255.0)
            .sum();
        assert!(
            (covered - expected).abs() < 0.75,
            "{n} voxels: {covered} pixels instead of {expected}"
        );
    }
}

/// Picking finds the front face of a cube, its normal, and where it was; beside the object there is nothing.
#[test]
fn picking_finds_the_surface() {
    let volume = builtin("cube", 64);
    let studio = studio_of(software(), &volume, true);
    let scene = illustration(r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#);
    let pick = |at: Vec2| pollster::block_on(studio.pick(&scene, [100, 100], at)).expect("a pick");
    let found = pick(Vec2::new(55.3, 48.2)).expect("the cube is there");
    assert!(found.normal.dot(Vec3::Y) > 0.95, "normal {}", found.normal);
    assert!((found.pos_in_subject.y - 0.5).abs() < 0.08, "{found:?}");
    assert!(
        (found.pos_in_rest - found.pos_in_subject).length() < 1e-6,
        "{found:?}"
    );
    assert!(found.segment.is_some(), "{found:?}");
    let (eye, dir) =
        fabrica::render::View::new(&scene.camera, [100, 100]).ray(Vec2::new(55.3, 48.2));
    assert!(
        (eye + dir * found.depth - found.pos_in_subject).length() < 1e-4,
        "{found:?}"
    );
    assert_eq!(pick(Vec2::new(1.0, 1.0)), None);
}

/// The progressive renderer ends in the picture that the one-off renderer draws, then rests; a resize and a lost device
/// end in the same picture.
#[test]
fn progressive_drawing_ends_and_recovers() {
    let volume = builtin("cube", 32);
    let scene = illustration(&format!(r#"{{ "fabrica": 1, {CUBE} }}"#));
    let own = open_software();
    let device = own.device.clone();
    let mut renderer = Renderer::new(own, system_clock);
    let subject = Subject::from(volume.clone());
    renderer.set_subject(subject).expect("fits");
    renderer.set_illustration(&scene);
    let settle = |renderer: &mut Renderer, size: [u32; 2]| {
        for _ in 0..20_000 {
            let state = renderer.draw(size, 0.05, false).expect("drawn");
            if state.is_done {
                assert!(state.has_picture, "done without a picture");
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        panic!("drawing does not end");
    };
    settle(&mut renderer, [60, 44]);
    let shown = pollster::block_on(renderer.read_output()).expect("read");
    let expected = draw(
        &volume,
        &format!(r#"{{ "fabrica": 1, {CUBE} }}"#),
        [60, 44],
        5,
    );
    let (worst, count) = difference(&shown, &expected, 1);
    assert!(count == 0, "{count} pixels differ, by up to {worst}");

    let generation = renderer.output_generation();
    settle(&mut renderer, [40, 40]);
    assert!(
        renderer.output_generation() > generation,
        "a resize makes a new texture"
    );

    device.destroy();
    let lost = renderer.draw([60, 44], 0.05, false);
    assert!(matches!(lost, Err(RenderError::DeviceLost(_))), "{lost:?}");
    renderer.recover(open_software()).expect("another device");
    settle(&mut renderer, [60, 44]);
    let again = pollster::block_on(renderer.read_output()).expect("read");
    assert_eq!(shown, again, "the same picture comes back");
}

/// What cannot be drawn is refused in words.
#[test]
fn impossible_sizes_are_refused() {
    let subject = Subject::from(uniform_volume(4));
    let scene = illustration(r#"{ "fabrica": 1 }"#);
    for size in [[0, 10], [10, 1 << 20]] {
        let refused = pollster::block_on(render_image(software(), &scene, &subject, size, 1));
        assert!(
            matches!(refused, Err(RenderError::BadSize { .. })),
            "{refused:?}"
        );
    }
}

/// Snapshots: name (path under tests/snapshots), subject, rest of the document. One fact each.
const SNAPSHOTS: &[(&str, &str, &str)] = &[
    ("cube/untouched", "cube", ""),
    (
        "peel/half",
        "cube",
        r#", "templates": [{ "kind": "peel", "size": [0.8, 0.6, 0.8], "at": [0, 0, 0.2] }]"#,
    ),
    (
        "peel/along_a_curve",
        "tomato",
        r#", "templates": [{ "kind": "peel", "size": [0.9, 0.5, 0.4], "at": [0, 0, 0.24], "curve": { "points": [[0.02, 0], [0.12, 0.55], [0.3, 0.95], [0.7, 0.95], [0.88, 0.55], [0.98, 0]] }, "params": { "depth": 0.2, "progress": 0.6, "radius": 0.12 } }], "camera": { "rotate": [0.1564, 0, 0.1545, 0.9755], "distance": 2.4, "target": [0, 0, 0.3] }"#,
    ),
    (
        "split/wedge",
        "cube",
        r#", "templates": [{ "kind": "split", "size": [1, 1.4, 1.2], "at": [0, 0.1, 0.2] }]"#,
    ),
    (
        "retractor/wound",
        "cube",
        r#", "templates": [{ "kind": "retractor", "size": [0.9, 0.9, 0.6], "at": [0, 0.1, 0.3] }]"#,
    ),
    (
        "slices/apart",
        "bar",
        r#", "templates": [{ "kind": "slices", "size": [0.6, 0.6, 0.6], "rotate": [-0.7071068, 0, 0, 0.7071068] }]"#,
    ),
    (
        "compose/bend_of_twist",
        "bar",
        r#", "templates": [{ "kind": "twist", "size": [0.5, 0.5, 1] }, { "kind": "bend", "size": [0.4, 1, 0.4] }]"#,
    ),
    // One peel, three alignments (the dissertation's figure 5.4).
    (
        "align/axis",
        "head",
        r#", "templates": [{ "kind": "peel", "at": [0, 0.04, 0.31], "rotate": [0, 0, -0.7071, 0.7071], "size": [0.5, 0.5, 0.38], "params": { "progress": 0.7, "depth": 0.6, "radius": 0.12, "angle": 2.6 } }], "camera": { "rotate": [0.3177, -0.0704, -0.2047, 0.9231], "distance": 1.5, "target": [0, 0.05, 0.24] }"#,
    ),
    (
        "align/surface",
        "head",
        r#", "templates": [{ "kind": "peel", "at": [0, 0.04, 0.31], "rotate": [0, 0, -0.7071, 0.7071], "size": [0.5, 0.5, 0.38], "params": { "progress": 0.7, "depth": 0.6, "radius": 0.12, "angle": 2.6 }, "align": { "to": "surface", "depth": 0.06 } }], "camera": { "rotate": [0.3177, -0.0704, -0.2047, 0.9231], "distance": 1.5, "target": [0, 0.05, 0.24] }"#,
    ),
    (
        "align/segment",
        "head",
        r#", "templates": [{ "kind": "peel", "at": [0, 0.04, 0.31], "rotate": [0, 0, -0.7071, 0.7071], "size": [0.5, 0.5, 0.38], "params": { "progress": 0.7, "depth": 0.6, "radius": 0.12, "angle": 2.6 }, "align": { "to": "segment", "keep": ["brain", "white matter", "csf", "ventricles", "veins", "arteries"] } }], "camera": { "rotate": [0.3177, -0.0704, -0.2047, 0.9231], "distance": 1.5, "target": [0, 0.05, 0.24] }"#,
    ),
    (
        "look/glass",
        "cube",
        r#", "look": { "transfer": "ct-skin-glass" }"#,
    ),
    (
        "look/edges",
        "bar",
        r##", "look": { "gradient": 1, "transfer": [{ "value": -600, "color": "#c8a078", "opacity": 0 }, { "value": 0, "color": "#c8a078", "opacity": 0.3 }, { "value": 900, "color": "#f0e4d0", "opacity": 0.5 }] }, "templates": [{ "kind": "split", "size": [0.6, 1.2, 0.6] }], "camera": { "rotate": [0.2577, 0, 0.2577, 0.9312], "distance": 2 }"##,
    ),
    (
        "look/mass",
        "cube",
        r##", "look": { "opacity": "mass", "transfer": [{ "value": -500, "color": "#4060c0", "opacity": 0 }, { "value": 100, "color": "#c06040", "opacity": 0.05 }, { "value": 900, "color": "#ffe0a0", "opacity": 0.8 }] }, "templates": [{ "kind": "squeeze", "size": [1.2, 1.2, 1.2] }]"##,
    ),
    (
        "style/ink",
        "head",
        r##", "look": { "style": "ink" }, "templates": [{ "kind": "peel", "at": [0, 0.04, 0.31], "rotate": [0, 0, -0.7071, 0.7071], "size": [0.5, 0.5, 0.38], "params": { "progress": 0.7, "depth": 0.6, "radius": 0.12, "angle": 2.6 } }], "camera": { "rotate": [0.3177, -0.0704, -0.2047, 0.9231], "distance": 1.5, "target": [0, 0.05, 0.24] }"##,
    ),
    (
        "style/atlas",
        "tomato",
        r##", "look": { "style": "atlas" }"##,
    ),
    (
        "style/pencil",
        "tomato",
        r##", "look": { "style": "pencil" }, "templates": [{ "kind": "peel", "size": [0.8, 0.6, 0.8], "at": [0, 0, 0.2] }]"##,
    ),
    (
        "style/textbook",
        "head",
        r##", "look": { "style": "textbook" }, "camera": { "rotate": [0.3177, -0.0704, -0.2047, 0.9231], "distance": 1.5, "target": [0, 0.05, 0.24] }"##,
    ),
    (
        "style/blueprint",
        "bar",
        r##", "look": { "style": "blueprint", "background": "#1d4f91" }, "templates": [{ "kind": "twist", "size": [0.5, 0.5, 1] }]"##,
    ),
    (
        "look/light",
        "head",
        r##", "look": { "light": { "from": [0.8, 0.3, 0.5], "soft": 0.9, "contact": 0.8, "skin": 0.7 } }, "templates": [{ "kind": "peel", "at": [0, 0.04, 0.31], "rotate": [0, 0, -0.7071, 0.7071], "size": [0.5, 0.5, 0.38], "params": { "progress": 0.7, "depth": 0.6, "radius": 0.12, "angle": 2.6 } }], "camera": { "rotate": [0.3177, -0.0704, -0.2047, 0.9231], "distance": 1.5, "target": [0, 0.05, 0.24] }"##,
    ),
    (
        "figure/arm_flexed",
        "drawn-arm",
        r##", "camera": { "distance": 1.7 }, "figure": { "handles": [{ "region": "humerus" }, { "at": [-0.1109, -0.2283], "turn": 0.7, "move": [0.0259, 0.0307] }, { "at": [-0.0907, -0.169], "turn": 0.7, "move": [-0.0171, 0.0298] }] }"##,
    ),
    (
        "figure/heart_wide",
        "drawn-heart",
        r##", "camera": { "distance": 1.9 }, "look": { "background": "#e8eef4" }, "figure": { "handles": [{ "region": "left ventricle", "scale": 1.2 }, { "region": "aorta" }, { "region": "right atrium" }] }"##,
    ),
    (
        "sweep/pressed_and_pulled",
        "bar",
        r##", "templates": [{ "kind": "sweep", "size": [0.6, 0.6, 0.6], "rotate": [-0.7071, 0, 0, 0.7071], "params": { "mirror": "x", "tools": [
            { "radius": 0.12, "coat": 0.2, "path": [[0.7, 0.35, 1], [0.62, 0.4, 0.5]] },
            { "shape": "torus", "ring": 0.1, "radius": 0.03, "path": [[0.7, 0.75, 0.6], { "at": [0.8, 0.8, 0.95], "rotate": [0, 0.2588, 0, 0.9659] }] }] } }]"##,
    ),
    (
        "style/stipple_and_vignette",
        "bar",
        r##", "look": { "style": { "tone": { "levels": 3 }, "stipple": { "spacing": 30, "size": 8 }, "ghost": { "by": "cut", "strength": 0.9 } } }, "templates": [{ "kind": "split", "at": [0, 0.1, 0.3], "size": [0.4, 0.6, 0.4] }]"##,
    ),
];

/// Opacity by the gradient (dissertation, section 6.2.5): even tissue is clear but for the faces of the scan and of
/// cuts, which are as steep as the tissue is dense. Two faces stop a share of the light, so four stop twice that share
/// of what is left; the bound is a fourteenth, for the layer of a face is met by samples at other places of a step.
/// Where the value is that of nothing, no cut makes a face.
#[test]
fn even_tissue_turns_clear_and_cuts_have_faces() {
    let look = |low: f32, gradient: f32| {
        format!(
            r##""look": {{ "gradient": {gradient}, "background": "none", "transfer": [{{ "value": {low}, "color": "#808080", "opacity": 0.05 }}, {{ "value": 9, "color": "#808080", "opacity": 0.05 }}] }}"##
        )
    };
    let gap = r#""templates": [{ "kind": "cut", "size": [4, 0.3, 4] }]"#;
    let alpha = |look: &str, rest: &str| {
        let json = format!(r#"{{ "fabrica": 1, {look}{rest} }}"#);
        let image = draw(&uniform_volume(32), &json, [65, 65], 8);
        f32::from(pixel(&image, 32, 32)[3]) / 255.0
    };
    let whole = alpha(&look(0.0, 0.0), "");
    assert!(whole > 0.98, "not modulated it is a block: {whole}");
    let two = alpha(&look(0.0, 1.0), "");
    let four = alpha(&look(0.0, 1.0), &format!(", {gap}"));
    let expected = 1.0 - (1.0 - two).powi(2);
    assert!((0.05..0.5).contains(&two), "two faces stop {two}");
    assert!(
        (four - expected).abs() < 0.07,
        "four faces stop {four}, not {expected}"
    );
    let half = alpha(&look(0.0, 0.5), "");
    assert!(half > two && half < whole, "half of it: {half}");
    // Negative control: without the correction a hole and a block would look the same.
    let hole = alpha(&look(7.0, 1.0), &format!(", {gap}"));
    assert!(hole < 0.01, "a cut through nothing has no face: {hole}");
}

const SNAPSHOT_SIZE: [u32; 2] = [96, 96];
/// A snapshot's file at most, bytes: pictures must not fill the repository.
const SNAPSHOT_BYTES: usize = 24_000;

#[test]
fn snapshots_match() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots");
    let blessed = std::env::var("FABRICA_BLESS").unwrap_or_default();
    let adapter = format!("{} {}", software().info.name, software().info.driver_info);
    let adapter_file = folder.join("adapter.txt");
    if blessed == "all" {
        std::fs::create_dir_all(&folder).expect("snapshots folder");
        std::fs::write(&adapter_file, &adapter).expect("adapter.txt");
    }
    let recorded = std::fs::read_to_string(&adapter_file).unwrap_or_default();
    // Another version of the rasteriser rounds otherwise: silhouettes move by parts of a pixel.
    let is_recorded_adapter = recorded.trim() == adapter.trim();
    let mut failures = Vec::new();
    let studios: Vec<(&str, Studio)> = [("cube", 64), ("bar", 64), ("tomato", 64), ("head", 112)]
        .into_iter()
        .map(|(name, resolution)| {
            (
                name,
                studio_of(software(), &builtin(name, resolution), true),
            )
        })
        .collect();
    for (name, subject, rest) in SNAPSHOTS {
        let camera = if rest.contains("\"camera\"") {
            ""
        } else {
            r#", "camera": { "rotate": [0.2, 0.1, 0.3, 0.927], "distance": 3.2 }"#
        };
        let json = format!(
            r#"{{ "fabrica": 1, "subject": {{ "builtin": "{subject}" }} {camera} {rest} }}"#
        );
        let studio = studios.iter().find(|(n, _)| n == subject);
        let actual = match studio {
            Some((_, studio)) => {
                let picture = studio.render_image(&illustration(&json), SNAPSHOT_SIZE, 2);
                pollster::block_on(picture).expect("a picture")
            }
            None => figure_image(&json, SNAPSHOT_SIZE, 2),
        };
        let path = folder.join(format!("{name}.png"));
        if blessed == "all" || blessed == *name {
            let bytes = encode_png(&actual).expect("PNG");
            assert!(
                bytes.len() <= SNAPSHOT_BYTES,
                "{name} takes {} bytes",
                bytes.len()
            );
            std::fs::create_dir_all(path.parent().expect("in a folder")).expect("folder");
            std::fs::write(&path, bytes).expect("snapshot");
            continue;
        }
        let expected = match image::open(&path) {
            Ok(found) => found.to_rgba8(),
            Err(error) => {
                failures.push(format!("{name}: {error}; FABRICA_BLESS={name} writes it"));
                continue;
            }
        };
        let expected = Image {
            size: [expected.width(), expected.height()],
            rgba: expected.into_raw(),
        };
        if expected.size != actual.size {
            failures.push(format!("{name}: the snapshot is {:?}", expected.size));
            continue;
        }
        let allowed = if is_recorded_adapter {
            (1, 0)
        } else {
            (8, 96 * 96 / 50)
        };
        let (worst, count) = difference(&expected, &actual, allowed.0);
        if count > allowed.1 {
            let sweep: Vec<String> = [1, 2, 4, 8, 16, 32]
                .iter()
                .map(|&bound| format!("{} over {bound}", difference(&expected, &actual, bound).1))
                .collect();
            let strip = write_strip(name, &expected, &actual);
            failures.push(format!(
                "{name}: {count} pixels differ, by up to {worst} ({}); see {}; FABRICA_BLESS={name} accepts",
                sweep.join(", "),
                strip.display()
            ));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Expected, difference (eightfold), actual, side by side.
fn write_strip(name: &str, expected: &Image, actual: &Image) -> PathBuf {
    let [width, height] = actual.size;
    let row = 4 * width as usize;
    let mut rgba = Vec::new();
    for (e, a) in expected
        .rgba
        .chunks_exact(row)
        .zip(actual.rgba.chunks_exact(row))
    {
        rgba.extend_from_slice(e);
        rgba.extend(e.iter().zip(a).enumerate().map(|(i, (p, q))| {
            if i % 4 == 3 {
                255
            } else {
                p.abs_diff(*q).saturating_mul(8)
            }
        }));
        rgba.extend_from_slice(a);
    }
    let strip = Image {
        size: [3 * width, height],
        rgba,
    };
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("snapshots");
    let path = folder.join(format!("{}.png", name.replace('/', "_")));
    std::fs::create_dir_all(&folder).expect("folder");
    std::fs::write(&path, encode_png(&strip).expect("PNG")).expect("strip");
    path
}

/// Negative control: a snapshot comparison that sees a changed template.
#[test]
fn snapshots_would_see_another_picture() {
    let volume = builtin("cube", 32);
    let with = |progress: f32| {
        draw(
            &volume,
            &format!(
                r#"{{ "fabrica": 1, {CUBE}, "templates": [{{ "kind": "peel", "size": [0.8, 0.6, 0.8], "at": [0, 0, 0.2], "params": {{ "progress": {progress} }} }}] }}"#
            ),
            [48, 48],
            1,
        )
    };
    let (_, count) = difference(&with(0.5), &with(0.55), 1);
    assert!(count > 20, "only {count} pixels tell 0.5 from 0.55");
}
