//! Flat cuts through the deformed object agree with what `fabrica probe --object` says of the same points.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use fabrica::data::Volume;
use fabrica::document::{Document, Illustration};
use fabrica::render::{Image, MarkedValues, SliceColors, SlicePlane, SliceView, encode_png};
use fabrica::subjects::FINE_RESOLUTION;
use glam::{DVec3, Vec2, Vec3};

use crate::gpu::{builtin, software, studio_of};
use crate::long::long_or;
use crate::scatter::Random;

/// Pixels along a side of each random slice.
const SIDE: u32 = 24;

/// A head that is peeled, cut and twisted.
const DEFORMED: &str = r#"{ "fabrica": 1, "subject": { "builtin": "head" }, "templates": [
    { "kind": "peel", "at": [0, 0.35, 0.15], "rotate": [-0.7071068, 0, 0, 0.7071068], "size": [0.4, 0.4, 0.3],
      "params": { "angle": 1.2 } },
    { "kind": "cut", "at": [0.25, 0, 0.2], "size": [0.25, 0.3, 0.4] },
    { "kind": "twist", "at": [0, 0, -0.1], "size": [0.9, 0.9, 0.6], "params": { "angle": 0.6 } } ] }"#;

/// A flap and a retractor that leave the skull alone.
const KEPT: &str = r#"{ "fabrica": 1, "subject": { "builtin": "head" }, "templates": [
    { "kind": "flap", "at": [0, 0.35, 0.15], "rotate": [-0.7071068, 0, 0, 0.7071068], "size": [0.4, 0.4, 0.3],
      "amount": 0.6, "align": { "to": "segment", "keep": ["bone"] } },
    { "kind": "retractor", "at": [0.25, 0, 0.2], "size": [0.4, 0.5, 0.4], "amount": 0.5,
      "align": { "to": "segment", "keep": ["bone"] } } ] }"#;

fn illustration(json: &str) -> Illustration {
    Document::from_json(json)
        .expect("a document")
        .illustration()
        .clone()
}

struct Row {
    rest: Vec3,
    continuity: f32,
    value: Option<f32>,
    segment: String,
}

/// What the program says.
fn probe_object(document: &str, points: &[Vec3]) -> Vec<Row> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("document.json");
    std::fs::write(&path, document).expect("written");
    let mut lines = String::new();
    for p in points {
        writeln!(lines, "{},{},{}", p.x, p.y, p.z).expect("to a string");
    }
    let mut child = Command::new(env!("CARGO_BIN_EXE_fabrica"))
        .args(["probe", "--object", "--adapter", "llvmpipe"])
        .arg(&path)
        .env("XDG_RUNTIME_DIR", folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut input = child.stdin.take().expect("a pipe");
    let writer = std::thread::spawn(move || input.write_all(lines.as_bytes()));
    let output = child.wait_with_output().expect("the program ends");
    writer
        .join()
        .expect("no panic")
        .expect("it reads all points");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("text");
    let rows = text.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse::<f32>().expect("a number");
        Row {
            rest: Vec3::new(number(3), number(4), number(5)),
            continuity: number(6),
            value: cells[7].parse().ok(),
            segment: cells[8..].join(",").trim_matches('"').to_owned(),
        }
    });
    rows.collect()
}

/// Greatest difference between the eight voxels around a place, and how near it is to where the nearest voxel changes.
fn around(volume: &Volume, rest: Vec3) -> (f32, f64) {
    let pos = volume
        .grid
        .subject_from_voxel()
        .inverse()
        .transform_point3(rest.as_dvec3());
    let low = pos.floor().max(DVec3::ZERO).as_uvec3();
    let values = (0..8_u32).filter_map(|corner| {
        let step = glam::UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
        volume.value_at((low + step).min(volume.grid.dims - 1))
    });
    let (min, max) = values.fold((f32::MAX, f32::MIN), |(a, b), v| (a.min(v), b.max(v)));
    let to_face = (pos - pos.floor() - 0.5).abs().min_element();
    (max - min, to_face)
}

/// Some slices at random: anywhere near the object, at any angle.
fn planes(random: &mut Random, count: usize) -> Vec<SlicePlane> {
    (0..count)
        .map(|_| {
            let turn = random.rotation();
            let pixel = random.between(0.003, 0.035);
            SlicePlane {
                corner: random.vector(-0.2, 0.2)
                    - turn * Vec3::new(1.0, 1.0, 0.0) * (0.5 * SIDE as f32 * pixel),
                right: turn * Vec3::X * pixel,
                down: turn * Vec3::Y * pixel,
            }
        })
        .collect()
}

#[test]
fn slices_agree_with_the_object_probe() {
    agree(DEFORMED, 24, (8_000, 2_000, 300));
}

#[test]
fn slices_agree_with_the_object_probe_where_tissue_is_kept() {
    let (slices, least) = long_or((12, (4_000, 300, 50)), (4, (1_300, 100, 16)));
    agree(KEPT, slices, least);
}

/// `least`: points compared, of these moved, and points with nothing.
fn agree(document: &str, slices: usize, least: (u32, u32, u32)) {
    let volume = builtin("head", FINE_RESOLUTION);
    let names: std::collections::BTreeMap<u16, String> = volume
        .segmentation
        .iter()
        .flat_map(|labels| &labels.segments)
        .map(|segment| (segment.label, segment.name.clone()))
        .collect();
    let studio = studio_of(software(), &volume, true);
    let illustration = illustration(document);
    let mut random = Random(20_261_121);
    let planes = planes(&mut random, slices);
    let mut points = Vec::new();
    let mut texels = Vec::new();
    for plane in &planes {
        let read = studio
            .read_slice(&illustration, plane, [SIDE, SIDE])
            .expect("it can be asked");
        texels.extend(pollster::block_on(read).expect("it is answered"));
        for y in 0..SIDE {
            for x in 0..SIDE {
                let pixel = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                points.push(plane.subject_from_pixel(pixel));
            }
        }
    }
    let rows = probe_object(document, &points);
    assert_eq!(rows.len(), texels.len());

    let span = volume.value_range[1] - volume.value_range[0];
    let (mut compared, mut moved, mut gaps, mut at_a_face) = (0, 0, 0, 0);
    let mut worst = 0.0_f32;
    for ((row, texel), pos) in rows.iter().zip(&texels).zip(&points) {
        // Two programs round differently: on the brink of a gap or of the scan either answer is right.
        if row.value.is_some() != texel.is_there {
            let bounds = volume.grid.subject_bounds();
            let to_side = (row.rest - bounds.min)
                .abs()
                .min((row.rest - bounds.max).abs());
            assert!(
                row.continuity.abs() < 1e-4 || to_side.min_element() < 1e-5,
                "at {pos}: probe {:?} at {}, slice {texel:?}",
                row.value,
                row.rest
            );
            continue;
        }
        let Some(value) = row.value else {
            gaps += 1;
            continue;
        };
        assert!(
            texel.pos_in_rest.distance(row.rest) < 2e-5,
            "at {pos}: {} and {}",
            row.rest,
            texel.pos_in_rest
        );
        assert!((texel.continuity - row.continuity).abs() < 1e-3, "at {pos}");
        let (contrast, to_face) = around(&volume, row.rest);
        // Half floats hold the normalised value to 2^-12; samplers weigh in 256ths; rounding of the place adds little.
        let allowed = span / 2048.0 + contrast * (3.0 / 256.0);
        let off = (texel.value - value).abs();
        worst = worst.max(off / allowed);
        assert!(
            off <= allowed,
            "at {pos}: probe {value}, slice {}; {allowed} is allowed",
            texel.value
        );
        let segment = texel
            .segment
            .map_or("", |label| names.get(&label).map_or("", String::as_str));
        if segment != row.segment {
            assert!(
                to_face < 2e-3,
                "at {pos}: probe {:?}, slice {segment:?}, {to_face} voxels from a face",
                row.segment
            );
            at_a_face += 1;
            continue;
        }
        compared += 1;
        moved += u32::from(row.rest.distance(*pos) > 1e-4);
    }
    println!(
        "{compared} points, {moved} of them moved, {gaps} with nothing, {at_a_face} on a voxel's face; worst {worst:.2} of what is allowed"
    );
    assert!(
        compared > least.0 && moved > least.1 && gaps > least.2,
        "the points say little: {compared}, {moved}, {gaps}"
    );
    assert!(at_a_face <= 3, "segments are exact: {at_a_face} differ");
}

fn save(name: &str, image: &Image) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    let bytes = encode_png(image).expect("encoded");
    std::fs::write(&path, bytes).expect("written");
    path
}

/// A slice across z as wide as the object.
fn axial(z: f32, side: u32, colors: SliceColors) -> SliceView {
    let pixel = 1.1 / side as f32;
    SliceView {
        plane: SlicePlane {
            corner: Vec3::new(0.55, 0.55, z),
            right: Vec3::new(-pixel, 0.0, 0.0),
            down: Vec3::new(0.0, -pixel, 0.0),
        },
        size_px: [side, side],
        colors,
        background_srgb: [26, 30, 34],
        samples: 1,
        marked: None,
    }
}

/// Exactly the values of a range are tinted; everything else is as without a mark, bit for bit.
#[test]
fn a_slice_marks_a_range_of_values() {
    let subject = builtin("head", 96);
    let studio = studio_of(software(), &subject, true);
    let illustration = illustration(DEFORMED);
    for colors in [
        SliceColors::Look,
        SliceColors::Grey {
            window: [-200.0, 300.0],
            marks_bodies: false,
        },
    ] {
        let plain = axial(0.15, 160, colors);
        let range = [200.0, 1000.0];
        let marked = SliceView {
            marked: Some(MarkedValues {
                range,
                color_srgb: [255, 0, 0],
            }),
            ..plain
        };
        let draw = |view: &SliceView| {
            pollster::block_on(studio.slice_image(&illustration, view)).expect("drawn")
        };
        let (without, with) = (draw(&plain), draw(&marked));
        save("slice_marked", &with);
        let read = studio.read_slice(&illustration, &plain.plane, plain.size_px);
        let texels = pollster::block_on(read.expect("asked")).expect("read");
        let pixels = without.rgba.chunks_exact(4).zip(with.rgba.chunks_exact(4));
        let (mut taken, mut left) = (0, 0);
        for (texel, (without, with)) in texels.iter().zip(pixels) {
            // On the brink two programs may round differently.
            if range.iter().any(|end| (texel.value - end).abs() < 0.1) {
                continue;
            }
            if texel.is_there && (range[0]..range[1]).contains(&texel.value) {
                taken += 1;
                assert!(
                    with[0] > 190 && with[1] < without[1].max(1),
                    "{texel:?}: {with:?}"
                );
            } else {
                left += 1;
                assert_eq!(with, without, "{texel:?}");
            }
        }
        assert!(
            taken > 500 && left > 5000,
            "{taken} are marked, {left} are not"
        );
    }
}

#[test]
fn a_slice_shows_what_it_reads() {
    let subject = builtin("head", 96);
    let studio = studio_of(software(), &subject, true);
    let illustration = illustration(DEFORMED);
    let window = [-200.0, 300.0];
    let view = axial(
        0.15,
        160,
        SliceColors::Grey {
            window,
            marks_bodies: false,
        },
    );
    let image = pollster::block_on(studio.slice_image(&illustration, &view)).expect("drawn");
    println!("{}", save("slice_grey", &image).display());
    let colored = axial(0.15, 160, SliceColors::Look);
    let colored = pollster::block_on(studio.slice_image(&illustration, &colored)).expect("drawn");
    println!("{}", save("slice_colors", &colored).display());
    let read = studio.read_slice(&illustration, &view.plane, view.size_px);
    let texels = pollster::block_on(read.expect("asked")).expect("read");
    let mut empty = 0;
    for (texel, pixel) in texels.iter().zip(image.rgba.chunks_exact(4)) {
        let grey = if texel.is_there {
            let level = (texel.value - window[0]) / (window[1] - window[0]);
            [255.0 * level.clamp(0.0, 1.0); 3]
        } else {
            empty += 1;
            view.background_srgb.map(f32::from)
        };
        for (wanted, found) in grey.iter().zip(pixel) {
            assert!(
                (wanted - f32::from(*found)).abs() <= 1.5,
                "{texel:?}: {wanted} and {pixel:?}"
            );
        }
    }
    assert!(empty > 500, "the cut shows: {empty}");
    assert_ne!(image.rgba, colored.rgba);
}

/// While tissue is painted, grey slices mark it, and nothing else.
#[test]
fn bodies_are_marked_over_grey() {
    let subject = builtin("head", 64);
    let studio = studio_of(software(), &subject, true);
    let illustration = illustration(
        r##"{ "fabrica": 1, "look": { "segments": { "brain": { "opacity": 1, "color": "#ff0000" }, "skin": 0 } } }"##,
    );
    let drawn = |marks_bodies| {
        let window = [-200.0, 300.0];
        let colors = SliceColors::Grey {
            window,
            marks_bodies,
        };
        let view = axial(0.15, 128, colors);
        pollster::block_on(studio.slice_image(&illustration, &view)).expect("drawn")
    };
    let (grey, marked) = (drawn(false), drawn(true));
    let view = axial(0.15, 128, SliceColors::Look);
    let read = studio.read_slice(&illustration, &view.plane, view.size_px);
    let texels = pollster::block_on(read.expect("asked")).expect("read");
    let labels = subject.segmentation.as_ref().expect("segments");
    let brain: Vec<u16> = labels
        .segments
        .iter()
        .filter(|segment| segment.name == "brain")
        .map(|segment| segment.label)
        .collect();
    let mut count = 0;
    let pixels = grey.rgba.chunks_exact(4).zip(marked.rgba.chunks_exact(4));
    for (texel, (grey, marked)) in texels.iter().zip(pixels) {
        let is_brain = texel.is_there && texel.segment.is_some_and(|label| brain.contains(&label));
        if is_brain {
            count += 1;
            assert!(marked[0] > marked[1] + 30, "{texel:?}: {marked:?} is red");
        } else {
            assert_eq!(marked, grey, "{texel:?}");
        }
    }
    assert!(count > 500, "only {count} of the brain");
}

#[test]
fn a_slice_of_no_size_is_refused() {
    let subject = builtin("bar", 16);
    let studio = studio_of(software(), &subject, true);
    let illustration = illustration(r#"{ "fabrica": 1 }"#);
    for size_px in [[0, 8], [8, 0], [u32::MAX, 8], [1 << 14, 8]] {
        let view = axial(0.0, 8, SliceColors::Look);
        assert!(
            studio
                .read_slice(&illustration, &view.plane, size_px)
                .is_err()
        );
    }
}
