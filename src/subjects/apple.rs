//! An apple of triangles: a closed body with five lobes, and a stem that stands in it.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use super::loft::{Loft, hermite, linear};
use crate::data::Mesh;

/// Radius and height of the outline, mm, from the middle of the calyx to the middle of the stem's hollow.
const OUTLINE: [[f64; 2]; 15] = [
    [0.0, -26.0],
    [4.0, -28.0],
    [9.0, -32.0],
    [16.0, -32.5],
    [25.0, -26.0],
    [33.0, -12.5],
    [37.0, 3.0],
    [36.5, 16.0],
    [32.0, 26.5],
    [25.5, 32.5],
    [18.0, 34.5],
    [11.0, 32.0],
    [6.0, 26.5],
    [2.5, 21.5],
    [0.0, 20.0],
];
/// Rings of vertices between the two ends, and vertices of a ring.
const RINGS: usize = 84;
const AROUND: usize = 68;
/// Rings and vertices of a ring of the stem.
const STEM_RINGS: usize = 12;
const STEM_AROUND: usize = 14;
/// Where the stem begins, inside of the body, and how long it is, mm.
const STEM_FOOT: f64 = 16.0;
const STEM_LENGTH: f64 = 27.0;

/// sRGB colours of skin and stem.
const RED: [u8; 3] = [0xa8, 0x1f, 0x2a];
const DARK_RED: [u8; 3] = [0x82, 0x12, 0x22];
const YELLOW: [u8; 3] = [0xdd, 0xae, 0x4b];
const GREEN: [u8; 3] = [0x9a, 0xa5, 0x45];
const BROWN: [u8; 3] = [0x5c, 0x42, 0x2b];

/// The apple, mm: parts `body` and `stem`, about 12,000 triangles.
pub(super) fn apple() -> Mesh {
    let mut loft = Loft::new();
    add_tube(&mut loft, RINGS, AROUND, body_at, skin_at);
    loft.end_part("body");
    add_tube(&mut loft, STEM_RINGS, STEM_AROUND, stem_at, |_, _| {
        linear(BROWN)
    });
    loft.end_part("stem");
    loft.finish()
}

/// Adds a closed body: rings of vertices about an axis from one end to the other, with a vertex at each end. `place`
/// gives mm and `color` linear RGB at a share of the way, 0 to 1, and an angle.
fn add_tube(
    loft: &mut Loft,
    rings: usize,
    around: usize,
    place: impl Fn(f64, f64) -> DVec3,
    color: impl Fn(f64, f64) -> Vec3,
) {
    let rings = (0..=rings + 1).map(|ring| {
        let part = ring as f64 / (rings + 1) as f64;
        let is_tip = ring == 0 || ring == rings + 1;
        let around = if is_tip { 1 } else { around };
        let angles = (0..around).map(|k| TAU * k as f64 / around as f64);
        angles
            .map(|angle| (place(part, angle), color(part, angle)))
            .collect()
    });
    loft.add_body(rings);
}

/// The outline at a share of its way: a cubic curve through its points (Catmull-Rom).
fn outline_at(part: f64) -> [f64; 2] {
    let last = OUTLINE.len() - 1;
    let along = part.clamp(0.0, 1.0) * last as f64;
    let i = (along as usize).min(last - 1);
    let t = along - i as f64;
    // Beyond its ends the outline is mirrored at the axis.
    let point = |i: isize| {
        let inside = usize::try_from(i)
            .unwrap_or(1)
            .min(2 * last - i.max(0) as usize);
        let [r, z] = OUTLINE[inside];
        let is_beyond = i < 0 || i as usize > last;
        [if is_beyond { -r } else { r }, z]
    };
    let [a, b, c, d] = [-1, 0, 1, 2].map(|step| point(i as isize + step));
    let slope = |from: [f64; 2], to: [f64; 2]| [0, 1].map(|k| (to[k] - from[k]) * 0.5);
    hermite([b, slope(a, c), c, slope(b, d)], t)
}

fn body_at(part: f64, angle: f64) -> DVec3 {
    let [r, z] = outline_at(part);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    // Five lobes, strongest at the calyx, and a little unevenness.
    let low = (0.5 - 0.5 * z / 34.0).clamp(0.0, 1.0);
    let lobes = libm::cos(5.0 * angle + 0.4);
    let r = r
        * (1.0
            + 0.015 * libm::sin(angle + 0.7)
            + 0.01 * libm::sin(2.0 * angle - 0.5)
            + (0.004 + 0.016 * low * low) * lobes);
    let bumps = -low * low * low * lobes * (r / 16.0).min(1.0) + 0.03 * r * libm::cos(angle - 1.1);
    DVec3::new(r * cos, r * sin, z + bumps)
}

/// Linear colour of the skin: red on yellow, in streaks that run from the stem to the calyx, and green in the hollow.
fn skin_at(part: f64, angle: f64) -> Vec3 {
    let streak =
        |count: f64, phase: f64, drift: f64| libm::sin(count * angle + phase + drift * part);
    let fine = 0.4 * streak(25.0, 0.3, 3.0) + 0.3 * streak(19.0, 1.9, -4.0);
    let streaks = fine + 0.2 * streak(11.0, 0.8, 2.0) + 0.1 * streak(7.0, 2.1, -1.0);
    let side = (0.5 + 0.5 * libm::cos(angle - 4.3)) * (0.7 + 0.3 * libm::sin(PI * part));
    let hollow = ((part - 0.76) / 0.16).clamp(0.0, 1.0);
    let calyx = ((0.17 - part) / 0.17).clamp(0.0, 1.0);
    let pale = (side - 0.62 + 0.3 * streaks).clamp(0.0, 1.0) * 1.3;
    let yellow = (0.02 + 0.05 * streaks.max(0.0) + pale + 0.5 * calyx).clamp(0.0, 0.85);
    let red = linear(RED).lerp(linear(DARK_RED), (0.5 - 0.5 * streaks) as f32);
    let skin = red.lerp(linear(YELLOW), yellow as f32);
    let green = hollow * (0.8 + 0.2 * streaks);
    skin.lerp(linear(GREEN), green.clamp(0.0, 1.0) as f32)
}

fn stem_at(part: f64, angle: f64) -> DVec3 {
    // Half a turn at each end rounds it off.
    let cap = 0.06;
    let round = |from_end: f64| match from_end < cap {
        true => libm::sin(0.5 * PI * from_end / cap),
        false => 1.0,
    };
    let radius = (1.25 + 0.9 * part * part) * round(part) * round(1.0 - part);
    let bend = 4.5 * part * part;
    let height = STEM_FOOT + STEM_LENGTH * part;
    DVec3::new(
        bend + radius * libm::cos(angle),
        0.4 * bend + radius * libm::sin(angle),
        height,
    )
}
