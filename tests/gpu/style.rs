//! An illustrator's looks: outlines where they belong, strokes that make the tone and stay on their tissue, and
//! pictures that come out the same however they are drawn.

use crate::align::labelled_block;
use crate::gpu::{builtin, software, studio_of};
use crate::pieces::pieces;
use fabrica::data::{Segmentation, Subject, Volume, Voxels};
use fabrica::document::{Document, Illustration, STYLE_PRESETS};
use fabrica::render::{Image, Studio, View};
use glam::{DVec3, UVec3, Vec2, Vec3};

/// Voxels along a side of the test volumes.
const SIDE: u32 = 64;
const SIZE: [u32; 2] = [200, 200];

pub(crate) fn illustration(rest: &str) -> Illustration {
    let json = format!(r#"{{"fabrica":1,{rest}}}"#);
    Document::from_json(&json)
        .expect("a document")
        .illustration()
        .clone()
}

pub(crate) fn drawn(studio: &Studio, shown: &Illustration, size: [u32; 2], samples: u32) -> Image {
    pollster::block_on(studio.render_image(shown, size, samples)).expect("a picture")
}

/// A solid whose value falls from 200 to 0 across its surface, two voxels wide: `depth` is the depth of a point under
/// it, voxels from the middle of the volume, above 0 inside.
pub(crate) fn solid(
    depth: impl Fn(DVec3) -> f64,
    label: impl Fn(UVec3) -> u8,
    names: &[&str],
) -> Volume {
    let mut volume = labelled_block(SIDE, label, names);
    let middle = DVec3::splat(f64::from(SIDE - 1) / 2.0);
    let value = |i: u32| {
        let voxel = UVec3::new(i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE));
        let depth = depth(voxel.as_dvec3() - middle);
        (100.0 + 100.0 * depth.clamp(-1.0, 1.0)) as u8
    };
    volume.voxels = Voxels::U8((0..SIDE.pow(3)).map(value).collect());
    volume
}

fn ball(at: DVec3) -> f64 {
    20.0 - at.length()
}

pub(crate) fn cuboid(at: DVec3) -> f64 {
    (DVec3::new(18.0, 14.0, 16.0) - at.abs()).min_element()
}

fn torus(at: DVec3) -> f64 {
    let around = (at.x.hypot(at.z) - 18.0).hypot(at.y);
    7.0 - around
}

/// Opaque from half the value on, and white without a style.
pub(crate) const LOOK: &str = r##""transfer":[{"value":99.9,"color":"#ffffff","opacity":0},{"value":100.1,"color":"#ffffff","opacity":1}],"background":"#ffffff""##;
/// White, so that nothing but lines is seen.
pub(crate) const WHITE: &str = r##""tone":{"warm":"#ffffff","cool":"#ffffff"}"##;
const CAMERA: &str = r#""camera":{"rotate":[0.2,0.1,0.3,0.927],"distance":3.2}"#;

/// True where a black line covers half of a pixel of white, in linear light.
fn is_line(image: &Image, x: u32, y: u32) -> bool {
    image.rgba[4 * (y * image.size[0] + x) as usize] < 188
}

/// The pixels where the object is, by a picture of the same view with nothing behind it.
fn covered(studio: &Studio, rest: &str) -> Vec<bool> {
    let look = LOOK
        .replace("#ffffff\"", "none\"")
        .replace("\"color\":\"none\"", "\"color\":\"#ffffff\"");
    let plain = illustration(&format!(r#""look":{{{look}}},{rest}"#));
    let image = drawn(studio, &plain, SIZE, 4);
    image.rgba.chunks_exact(4).map(|p| p[3] >= 128).collect()
}

/// Distance of a pixel to the nearest one of a set, pixels.
fn distance_to(set: &[(i32, i32)], x: i32, y: i32) -> f64 {
    let squares = set.iter().map(|&(a, b)| (a - x).pow(2) + (b - y).pow(2));
    f64::from(squares.min().unwrap_or(i32::MAX)).sqrt()
}

/// Pixels of the object at its border: those with a neighbour beside, above or below that is not the object's.
fn border(covered: &[bool]) -> Vec<(i32, i32)> {
    let side = SIZE[0] as usize;
    let mut found = Vec::new();
    for y in 1..side - 1 {
        for x in 1..side - 1 {
            let at = y * side + x;
            let beside = [at - 1, at + 1, at - side, at + side];
            if covered[at] && beside.iter().any(|&other| !covered[other]) {
                found.push((x as i32, y as i32));
            }
        }
    }
    found
}

/// Ball, box and torus: the silhouette has a line everywhere within a pixel, and there is none inside but for the edges
/// of the box, where creases are asked for.
#[test]
fn outlines_stand_at_silhouettes_and_nowhere_inside() {
    let solids = [
        ("ball", solid(ball, |_| 1, &["ball"])),
        ("box", solid(cuboid, |_| 1, &["box"])),
        ("torus", solid(torus, |_| 1, &["torus"])),
    ];
    for (name, volume) in solids {
        let studio = studio_of(software(), &volume, true);
        let covered = covered(&studio, CAMERA);
        let border = border(&covered);
        assert!(border.len() > 200, "{name}: {} at the border", border.len());
        for creases in [0.0, 1.0] {
            // A line of two pixels.
            let style = format!(
                r##""style":{{"outline":{{"width":10,"color":"#000000","creases":{creases}}},{WHITE}}}"##
            );
            let shown = illustration(&format!(r#""look":{{{LOOK},{style}}},{CAMERA}"#));
            let image = drawn(&studio, &shown, SIZE, 4);
            let mut dark = Vec::new();
            for y in 0..SIZE[1] {
                for x in 0..SIZE[0] {
                    if is_line(&image, x, y) {
                        dark.push((x as i32, y as i32));
                    }
                }
            }
            let missed = border
                .iter()
                .filter(|&&(x, y)| distance_to(&dark, x, y) > 1.0)
                .count();
            assert_eq!(missed, 0, "{name}: of {} places", border.len());
            // The line is two pixels wide and lies on the inner side.
            let inside = dark
                .iter()
                .filter(|&&(x, y)| distance_to(&border, x, y) > 2.5)
                .count() as f64;
            let share = inside / dark.len() as f64;
            println!(
                "{name}, creases {creases}: {} dark, {share:.3} inside",
                dark.len()
            );
            if name == "box" && creases == 1.0 {
                assert!(share > 0.2, "the edges of a box are creases: {share}");
            } else {
                assert!(share <= 0.0, "{name}: {share} of the lines lie inside");
            }
        }
    }
}

/// The gaps of at most three pixels between two lines, in the rows of a square picture and in its columns: what a rim
/// that is drawn twice leaves all along it. Where lines meet at a sharp angle there are a few.
fn slits(is_dark: impl Fn(u32, u32) -> bool, side: u32) -> usize {
    let across = |along: u32, at: u32, is_row: bool| match is_row {
        true => is_dark(at, along),
        false => is_dark(along, at),
    };
    let mut found = 0;
    for is_row in [true, false] {
        for along in 0..side {
            let mut since_line = None;
            for at in 0..side {
                if across(along, at, is_row) {
                    found += usize::from(matches!(since_line, Some(1..=3)));
                    since_line = Some(0);
                } else {
                    since_line = since_line.map(|gap: u32| gap + 1);
                }
            }
        }
    }
    found
}

/// A peeled cube: its skin, the cut and the flap's underside meet at rims that are drawn once, and all lines hang
/// together.
#[test]
fn the_rim_of_a_peeled_cube_is_drawn_once() {
    let side = 300;
    let volume = solid(|at| 22.0 - at.abs().max_element(), |_| 1, &["cube"]);
    let studio = studio_of(software(), &volume, true);
    let peel = r#""templates":[{"kind":"peel","at":[0,0,0.15],"size":[0.5,0.5,0.5],"params":{"progress":0.5,"depth":0.5}}],"camera":{"rotate":[0.25,0.1,0.25,0.93],"distance":2.4}"#;
    let style =
        format!(r##""style":{{"outline":{{"width":8,"color":"#000000","creases":0.5}},{WHITE}}}"##);
    let picture = |rest: &str| {
        let shown = illustration(&format!(r#""look":{{{LOOK},{style}}},{rest}"#));
        drawn(&studio, &shown, [side, side], 4)
    };
    let peeled = picture(peel);
    let dark = |image: &Image| {
        let places = (0..side * side).filter(|i| is_line(image, i % side, i / side));
        places.count()
    };
    let closed = picture(&peel.replace("\"progress\":0.5", "\"progress\":0"));
    let (lines, of_cube) = (dark(&peeled), dark(&closed));
    assert!(
        lines > of_cube + 300,
        "the rims: {lines} dark, {of_cube} of the cube"
    );
    let found = slits(|x, y| is_line(&peeled, x, y), side);
    println!("{lines} dark, {of_cube} of the cube alone, {found} slits");
    assert!(
        found * 50 < lines,
        "{found} slits beside {lines} dark pixels"
    );
    let only_lines: Vec<u8> = (0..side * side)
        .flat_map(|i| {
            [
                0,
                0,
                0,
                255 * u8::from(is_line(&peeled, i % side, i / side)),
            ]
        })
        .collect();
    let pieces = pieces(side, &only_lines);
    let small = pieces.iter().skip(1).map(Vec::len).sum::<usize>();
    assert!(
        small * 100 < lines,
        "{small} of {lines} dark pixels stand apart"
    );
    // Negative control: lines that are drawn twice, five pixels apart.
    let twice = |x: u32, y: u32| is_line(&peeled, x, y) || x >= 5 && is_line(&peeled, x - 5, y);
    let doubled = slits(twice, side);
    assert!(
        doubled * 10 > lines,
        "{doubled} slits beside {lines} dark pixels"
    );
}

/// Two tissues of one form, one colour: a line stands along their border, and ends with it.
#[test]
fn segments_have_a_line_between_them() {
    let volume = solid(
        ball,
        |voxel| 1 + u8::from(voxel.x >= SIDE / 2),
        &["left", "right"],
    );
    let studio = studio_of(software(), &volume, true);
    let style = format!(r##""style":{{"outline":{{"width":10,"color":"#000000"}},{WHITE}}}"##);
    let camera = r#""camera":{"rotate":[0,0,0,1],"distance":3.2}"#;
    let shown = illustration(&format!(r#""look":{{{LOOK},{style}}},{camera}"#));
    let image = drawn(&studio, &shown, SIZE, 4);
    let middle = SIZE[0] / 2;
    let lines = (70..130).filter(|&y| (middle - 2..middle + 2).any(|x| is_line(&image, x, y)));
    assert_eq!(lines.count(), 60, "in each row between the two");
    let others = (70..130).filter(|&y| (middle - 15..middle - 4).any(|x| is_line(&image, x, y)));
    assert_eq!(others.count(), 0, "and nowhere beside");
}

/// The mean of the red channel in squares of 32 × 32 pixels that the object fills, with their places.
pub(crate) fn squares(image: &Image, covered: &[bool]) -> Vec<((u32, u32), f64)> {
    let mut found = Vec::new();
    for y in (0..image.size[1] - 31).step_by(16) {
        for x in (0..image.size[0] - 31).step_by(16) {
            let places = (0..32).flat_map(|b| (0..32).map(move |a| (x + a, y + b)));
            let index = |(x, y): (u32, u32)| (y * image.size[0] + x) as usize;
            if places.clone().all(|at| covered[index(at)]) {
                let sum: f64 = places.map(|at| f64::from(image.rgba[4 * index(at)])).sum();
                found.push(((x, y), sum / 1024.0 / 255.0));
            }
        }
    }
    found
}

/// Black strokes and dots on white make the tone: the mean grey of 32 × 32 pixels is that of the same picture with an
/// even tone, which very narrow strokes become, within 10 %.
#[test]
fn strokes_and_dots_make_the_tone() {
    let volume = solid(ball, |_| 1, &["ball"]);
    let studio = studio_of(software(), &volume, true);
    // Dark tissue, so that there are dark tones and light ones.
    let look = LOOK.replace("\"color\":\"#ffffff\"", "\"color\":\"#303030\"");
    let size = [480, 480];
    let plain = illustration(&format!(
        r#""look":{{{}}},{CAMERA}"#,
        look.replace("\"background\":\"#ffffff\"", "\"background\":\"none\"")
    ));
    let covered: Vec<bool> = drawn(&studio, &plain, size, 1)
        .rgba
        .chunks_exact(4)
        .map(|p| p[3] == 255)
        .collect();
    let with = |strokes: &str| {
        let shown = illustration(&format!(
            r#""look":{{{look},"style":{{{WHITE},{strokes}}}}},{CAMERA}"#
        ));
        squares(&drawn(&studio, &shown, size, 4), &covered)
    };
    // Strokes that lie nearer than two pixels become their mean.
    let even = with(r##""hatch":{"spacing":2,"width":0.2,"color":"#000000"}"##);
    assert!(even.len() > 30, "{} squares", even.len());
    let tones: Vec<f64> = even.iter().map(|(_, tone)| *tone).collect();
    let (darkest, lightest) = tones.iter().fold((1.0_f64, 0.0_f64), |(a, b), tone| {
        (a.min(*tone), b.max(*tone))
    });
    assert!(
        darkest < 0.4 && lightest > 0.5,
        "tones from {darkest} to {lightest}"
    );
    for (name, strokes) in [
        (
            "along the axis",
            r##""hatch":{"spacing":14,"width":1,"color":"#000000","by":"axis"}"##,
        ),
        (
            "along the curvature",
            r##""hatch":{"spacing":14,"width":1,"color":"#000000"}"##,
        ),
        (
            "dots",
            r##""stipple":{"spacing":11,"size":4,"color":"#000000"}"##,
        ),
    ] {
        let found = with(strokes);
        let off = found
            .iter()
            .zip(&even)
            .map(|((at, tone), (_, wanted))| ((tone - wanted).abs(), *at));
        let (worst, at) = off.fold(
            (0.0, (0, 0)),
            |worst, one| if one.0 > worst.0 { one } else { worst },
        );
        println!("{name}: {worst:.3} off at {at:?}");
        assert!(worst <= 0.1, "{name}: the tone is {worst:.3} off at {at:?}");
    }
}

/// A plate that faces the eye is moved across the picture by a template, by a whole number of pixels: its strokes and
/// dots go with it. Without a move of the tissue they would stand still.
#[test]
fn strokes_ride_on_the_tissue() {
    let plate = |at: DVec3| (DVec3::new(24.0, 4.0, 24.0) - at.abs()).min_element();
    let volume = solid(plate, |_| 1, &["plate"]);
    let studio = studio_of(software(), &volume, true);
    let size = [300, 300];
    for strokes in [
        r##""hatch":{"spacing":20,"width":2,"color":"#000000","by":"axis"}"##,
        r##""stipple":{"spacing":20,"size":6,"color":"#000000"}"##,
    ] {
        let look = LOOK.replace("\"color\":\"#ffffff\"", "\"color\":\"#404040\"");
        let scene = |offset: f32| {
            illustration(&format!(
                r#""look":{{{look},"style":{{{WHITE},{strokes}}}}},"camera":{{"rotate":[0,0,0,1],"distance":3.2}},
                "templates":[{{"kind":"move","size":[0.99,0.99,0.99],"params":{{"offset":[{offset},0,0]}}}}]"#
            ))
        };
        let still = drawn(&studio, &scene(0.0), size, 4);
        // How far a step of the template goes in the picture: on the plate's front, 4 of 64 voxels before its middle.
        let view = View::new(&scene(0.0).camera, size);
        let front = Vec3::new(0.0, 4.0 / 64.0, 0.0);
        let px = |pos: Vec3| view.pixel_from_subject(pos).expect("in sight");
        let per_unit = px(front + Vec3::X) - px(front);
        assert!(per_unit.y.abs() < 1e-3 && per_unit.x < -50.0, "{per_unit}");
        let pixels = 24_i32;
        let moved = drawn(
            &studio,
            &scene(-(pixels as f32) / per_unit.x / 0.99),
            size,
            4,
        );
        let gray =
            |image: &Image, x: i32, y: i32| i32::from(image.rgba[4 * (y * 300 + x) as usize]);
        let difference = |shift: i32| {
            let places = (120..180).flat_map(|y| (130..170).map(move |x| (x, y)));
            let sum: i32 = places
                .map(|(x, y)| (gray(&moved, x + shift, y) - gray(&still, x, y)).abs())
                .sum();
            f64::from(sum) / 2400.0
        };
        // Whichever way the template's x runs in the picture.
        let ridden = difference(pixels).min(difference(-pixels));
        let stood = difference(0);
        println!("{strokes}: {ridden:.1} where it went, {stood:.1} where it was");
        assert!(
            ridden < 4.0,
            "strokes do not ride: {ridden:.1} levels of 255"
        );
        assert!(stood > 20.0, "the test would not see it: {stood:.1}");
    }
}

/// The tissue far from every template fades to the paper, what is opened stays; a ghost lets what is kept be seen.
#[test]
fn ghosts_show_what_they_surround() {
    let inner = |voxel: UVec3| {
        let at = voxel.as_dvec3() - 31.5;
        1 + u8::from(at.length() < 10.0)
    };
    let volume = solid(ball, inner, &["shell", "core"]);
    let studio = studio_of(software(), &volume, true);
    let look = LOOK.replace("\"background\":\"#ffffff\"", "\"background\":\"none\"");
    let alpha_of = |ghost: &str, templates: &str| {
        let shown = illustration(&format!(
            r#""look":{{{look},"style":{{"ghost":{{{ghost}}}}}}},{CAMERA},"templates":[{templates}]"#
        ));
        let image = drawn(&studio, &shown, [64, 64], 2);
        move |x: usize, y: usize| image.rgba[4 * (y * 64 + x) + 3]
    };
    let peel = r#"{"kind":"peel","at":[0,0.3,0.3],"size":[0.1,0.1,0.1],"align":{"to":"segment","keep":["core"]}}"#;
    let ghost = alpha_of(r#""by":"facing","strength":0.8"#, peel);
    assert_eq!(ghost(32, 32), 255, "what is kept is solid");
    // Beside the core, near the rim of the shell, which stays.
    let beside = ghost(32 + 8, 32);
    assert!((1..235).contains(&beside), "the shell is clear: {beside}");
    let solid = alpha_of(r#""by":"facing","strength":0"#, peel);
    assert_eq!(solid(32 + 8, 32), 255, "no ghost");
    let far = r#"{"kind":"peel","at":[0,-3,0],"size":[0.1,0.1,0.1]}"#;
    assert_eq!(
        alpha_of(r#""by":"cut","strength":1"#, far)(32, 32),
        0,
        "far from what is opened"
    );
    assert_eq!(
        alpha_of(r#""by":"cut","strength":1"#, "")(32, 32),
        255,
        "nothing is opened"
    );
}

/// Every preset draws something of its own.
#[test]
fn presets_differ() {
    let studio = studio_of(software(), &builtin("bar", 48), true);
    let scene = |preset: &str| {
        illustration(&format!(
            r#""subject":{{"builtin":"bar"}},"look":{{"style":"{preset}","background":"none"}},{CAMERA}"#
        ))
    };
    let mut pictures = vec![("none", drawn(&studio, &scene("none"), [96, 96], 1))];
    for preset in STYLE_PRESETS {
        let picture = drawn(&studio, &scene(preset.name), [96, 96], 1);
        for (name, other) in &pictures {
            let apart = picture
                .rgba
                .iter()
                .zip(&other.rgba)
                .filter(|(a, b)| a != b)
                .count();
            assert!(apart > 1000, "{} and {name} are alike", preset.name);
        }
        pictures.push((preset.name, picture));
    }
}

/// Of two rods, one that lies and one that stands, each is hatched along its own length.
#[test]
fn strokes_follow_the_long_axis() {
    // Two rods: one lies along x, one stands along z.
    let rods = |at: DVec3| {
        let lying =
            (DVec3::new(26.0, 6.0, 6.0) - (at - DVec3::new(0.0, 0.0, 14.0)).abs()).min_element();
        let standing =
            (DVec3::new(6.0, 6.0, 18.0) - (at + DVec3::new(0.0, 0.0, 12.0)).abs()).min_element();
        lying.max(standing)
    };
    // Labels whose strokes are plain lines that are not turned.
    let label = |voxel: UVec3| if voxel.z > 38 { 9 } else { 18 };
    let names: Vec<String> = (1..=18).map(|label| format!("rod {label}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut volume = solid(rods, label, &names);
    // Air has no label: only the rods count.
    if let Some(Segmentation { labels, .. }) = &mut volume.segmentation {
        let values = match &volume.voxels {
            Voxels::U8(values) => values.clone(),
            _ => unreachable!("made of bytes"),
        };
        for (label, value) in labels.iter_mut().zip(values) {
            if value < 100 {
                *label = 0;
            }
        }
    }
    let studio = Studio::new(software(), &Subject::from(volume), true).expect("a studio");
    let look = LOOK.replace("\"color\":\"#ffffff\"", "\"color\":\"#808080\"");
    let shown = illustration(&format!(
        r##""look":{{{look},"style":{{{WHITE},"hatch":{{"spacing":24,"width":3,"color":"#000000","by":"axis"}}}}}},"camera":{{"rotate":[0,0,0,1],"distance":3.2}}"##
    ));
    let size = [400, 400];
    let image = drawn(&studio, &shown, size, 4);
    let view = View::new(&shown.camera, size);
    // How much the grey changes from pixel to pixel along both axes of the picture, about a voxel's place.
    let changes = |at: Vec3| {
        let pixel = view.pixel_from_subject(at).expect("in sight");
        let gray = |x: u32, y: u32| i32::from(image.rgba[4 * (y * 400 + x) as usize]);
        let Vec2 { x, y } = pixel;
        let places =
            (0..24).flat_map(|b| (0..24).map(move |a| (x as u32 - 12 + a, y as u32 - 12 + b)));
        places.fold((0, 0), |(right, down), (x, y)| {
            (
                right + (gray(x + 1, y) - gray(x, y)).abs(),
                down + (gray(x, y + 1) - gray(x, y)).abs(),
            )
        })
    };
    let (right, down) = changes(Vec3::new(0.2, 0.1, 14.0 / 64.0));
    assert!(
        down > 2 * right,
        "lying strokes change downwards: {right}, {down}"
    );
    let (right, down) = changes(Vec3::new(0.0, 0.1, -14.0 / 64.0));
    assert!(
        right > 2 * down,
        "standing strokes change sideways: {right}, {down}"
    );
}

/// The key light of a document comes from where it says, in the camera's axes; a contact of 0 leaves no hollow dark,
/// and light under the skin reddens the border of the shadow. The default is nearly the light of a document without
/// one.
#[test]
fn light_falls_as_the_document_says() {
    let volume = solid(ball, |_| 1, &["ball"]);
    let studio = studio_of(software(), &volume, true);
    let size = [64, 64];
    let look = LOOK.replace("\"color\":\"#ffffff\"", "\"color\":\"#a0a0a0\"");
    let lit = |light: &str| {
        let shown = illustration(&format!(r#""look":{{{look}{light}}},{CAMERA}"#));
        drawn(&studio, &shown, size, 2)
    };
    // Mean of a channel in columns of the middle rows.
    let mean = |image: &Image, columns: std::ops::Range<u32>, channel: usize| {
        let places = (26..38).flat_map(|y| columns.clone().map(move |x| (x, y)));
        let (sum, count) = places.fold((0, 0), |(sum, count), (x, y)| {
            let at = 4 * (y * size[0] + x) as usize + channel;
            (sum + u32::from(image.rgba[at]), count + 1)
        });
        f64::from(sum) / f64::from(count)
    };
    let left = lit(r#","light":{"from":[-1,0,0.3]}"#);
    let right = lit(r#","light":{"from":[1,0,0.3]}"#);
    assert!(
        mean(&left, 24..30, 0) > mean(&left, 36..40, 0) + 40.0,
        "from the left"
    );
    assert!(
        mean(&right, 36..40, 0) > mean(&right, 24..30, 0) + 40.0,
        "from the right"
    );
    let plain = lit("");
    let usual = lit(r#","light":{}"#);
    let apart = plain
        .rgba
        .iter()
        .zip(&usual.rgba)
        .map(|(a, b)| u32::from(a.abs_diff(*b)));
    let apart = f64::from(apart.sum::<u32>()) / plain.rgba.len() as f64;
    assert!(apart < 4.0, "{apart:.1} levels of 255 in the mean");
    // At the border of the shadow red comes through, blue does not.
    let skin = lit(r#","light":{"from":[-1,0,0.3],"skin":1}"#);
    let redder = |image: &Image| mean(image, 33..38, 0) - mean(image, 33..38, 2);
    assert!(redder(&skin) > redder(&left) + 10.0, "under the skin");
    // A slit that light from everywhere hardly reaches.
    let slit = r#","templates":[{"kind":"split","at":[0,0.1,0.1],"size":[0.5,0.6,0.5]}]"#;
    let contact = |amount: f32| {
        let light = format!(r#","light":{{"contact":{amount},"soft":1}}"#);
        let shown = illustration(&format!(r#""look":{{{look}{light}}},{CAMERA}{slit}"#));
        drawn(&studio, &shown, size, 2)
    };
    let sum = |image: &Image| image.rgba.iter().map(|v| u64::from(*v)).sum::<u64>();
    assert!(sum(&contact(0.0)) > sum(&contact(0.5)) && sum(&contact(0.5)) > sum(&contact(1.0)));
}
