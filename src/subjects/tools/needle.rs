//! A straight surgical needle: a round shaft with a three-edged cutting point, and a long eye.

use glam::DVec3;

use super::steel::{BRUSHED, GROUND, POLISHED};
use crate::subjects::loft::{Loft, Station, curve_at, linear};

/// Height, half of the width and half of the thickness, mm.
const SHAFT: [[f64; 3]; 9] = [
    [-30.0, 0.04, 0.04],
    [-27.0, 0.42, 0.42],
    [-23.0, 0.85, 0.85],
    [-17.0, 0.8, 0.8],
    [-5.0, 0.8, 0.8],
    [12.0, 0.8, 0.8],
    [20.0, 1.05, 0.75],
    [25.0, 1.3, 0.65],
    [30.0, 1.1, 0.6],
];
/// Heights between which the eye lies and half of its width, mm.
const EYE: [f64; 2] = [20.0, 28.4];
const EYE_HALF: f64 = 0.62;
/// Length of the eye's round ends and of the end of the needle, mm.
const ROUND: f64 = 1.1;
const END: f64 = 1.4;

pub(super) fn add(loft: &mut Loft) {
    let mut heights = vec![-30.0, -29.4];
    heights.extend((1..16).map(|i| -29.4 + 0.9 * f64::from(i)));
    heights.extend((0..12).map(|i| -15.0 + 2.5 * f64::from(i)));
    let [low, high] = EYE;
    heights.extend([16.5, 18.5]);
    for i in 0..24 {
        // Denser towards both ends.
        let part = f64::from(i) / 24.0;
        heights.push(low + (high - low) * part * part * (3.0 - 2.0 * part));
    }
    heights.push(high);
    for i in 1..8 {
        let left = 1.0 - f64::from(i) / 8.0;
        heights.push(30.0 - END * left * left);
    }
    let [ground, polished, brushed] = [GROUND, POLISHED, BRUSHED].map(linear);
    let station = |z: f64| {
        let [_, w, t] = curve_at(&SHAFT, z);
        let round = |into: f64| (1.0 - into * into).max(0.0).sqrt();
        let end = round(((z - 30.0) / END + 1.0).max(0.0));
        let is_open = z > low && z < high;
        let from_end = (z - low).min(high - z) / ROUND;
        let hole = if is_open {
            EYE_HALF * round(1.0 - from_end.min(1.0))
        } else {
            0.0
        };
        let [w, t] = [w * end, t * (0.5 + 0.5 * end)];
        let flat = ((z - 13.0) / 8.0).clamp(0.0, 1.0);
        let point = ((-17.0 - z) / 5.0).clamp(0.0, 1.0);
        let color = ground.lerp(polished, ((z + 22.0) / 5.0).clamp(0.0, 1.0) as f32);
        Station {
            at: DVec3::new(0.0, 0.0, z),
            half: if z == -30.0 { [0.0; 2] } else { [w, t] },
            round: w.min(t) * (0.97 - 0.4 * flat),
            hole,
            three_edged: point * point * (3.0 - 2.0 * point),
            color: color.lerp(brushed, flat as f32),
            ..Station::PLAIN
        }
    };
    let stations: Vec<Station> = heights.into_iter().map(station).collect();
    loft.add_bar(DVec3::X, 6, &stations);
}
