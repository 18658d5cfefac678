//! A hand-held retractor (Langenbeck): a flat handle with a long opening, and a blade at a right angle with a lip.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3};

use super::steel::{BRUSHED, POLISHED};
use crate::subjects::loft::{Loft, Station, curve_at, linear};

/// Way from the lip's border, half of the width and half of the thickness of lip, blade and bend, mm.
const BLADE: [[f64; 3]; 5] = [
    [0.0, 7.2, 0.8],
    [10.0, 7.2, 0.8],
    [24.0, 6.7, 0.9],
    [34.0, 5.7, 1.1],
    [43.7, 4.7, 1.5],
];
/// Height, half of the width and half of the thickness of the handle, mm.
const HANDLE: [[f64; 3]; 8] = [
    [-72.0, 4.7, 1.5],
    [-58.0, 3.8, 1.75],
    [-36.0, 3.8, 1.9],
    [-16.0, 5.6, 1.9],
    [2.0, 8.4, 1.8],
    [26.0, 10.0, 1.75],
    [56.0, 9.8, 1.75],
    [80.0, 9.2, 1.75],
];
/// Angle of the lip and the radii of lip and bend, mm.
const LIP: f64 = 0.26 * PI;
const LIP_RADIUS: f64 = 8.0;
const BEND_RADIUS: f64 = 6.5;
/// Length of the straight part of the blade, mm.
const STRAIGHT: f64 = 27.0;
/// Heights between which the opening lies, lengths of its round ends, width of the bars beside it, mm.
const OPENING: [f64; 2] = [-8.0, 73.0];
const ROUNDS: [f64; 2] = [22.0, 6.0];
const BAR: f64 = 3.9;
/// Length of the round end of the handle, mm.
const END: f64 = 9.0;
/// Between a round corner and where a face is flat, mm.
const FLAT: f64 = 0.3;

pub(super) fn add(loft: &mut Loft) {
    let mut stations = blade();
    stations.extend(handle());
    loft.add_bar(DVec3::Y, 4, &stations);
}

/// Lip, blade and bend, up to where the handle begins.
fn blade() -> Vec<Station> {
    // Turns, lengths and steps of the three.
    let parts = [
        (LIP, LIP * LIP_RADIUS, 12),
        (0.0, STRAIGHT, 9),
        (FRAC_PI_2, FRAC_PI_2 * BEND_RADIUS, 12),
    ];
    let mut stations = Vec::new();
    let (mut at, mut angle, mut way) = (DVec2::ZERO, PI + LIP, 0.0);
    let [polished, brushed] = [linear(POLISHED), linear(BRUSHED)];
    let mut add = |at: DVec2, angle: f64, way: f64| {
        let [_, w, t] = curve_at(&BLADE, way);
        // The border of the lip is rounded off, and so are its corners.
        let corner = (1.0 - way / 5.0).max(0.0);
        let thin = (1.0 - way / 0.8).max(0.0);
        let share = 1.0 - 0.75 * (1.0 - (1.0 - corner * corner).sqrt());
        let round = 0.3 + 0.3 * (way / 40.0).min(1.0) - 0.15 * thin;
        stations.push(Station {
            at: DVec3::new(at.x, 0.0, at.y),
            along: DVec3::new(libm::cos(angle), 0.0, libm::sin(angle)),
            half: [w * share, t - 0.5 * thin * thin],
            round,
            face: w * share - round - FLAT,
            color: polished.lerp(brushed, ((way - 36.0) / 6.0).clamp(0.0, 1.0) as f32),
            ..Station::PLAIN
        });
    };
    for border in [0.0, 0.25, 0.6] {
        add(
            at + DVec2::new(libm::cos(angle), libm::sin(angle)) * border,
            angle,
            border,
        );
    }
    for (turn, length, steps) in parts {
        let step = length / f64::from(steps);
        let half_turn = 0.5 * turn / f64::from(steps);
        for _ in 0..steps {
            angle -= half_turn;
            at += DVec2::new(libm::cos(angle), libm::sin(angle)) * step;
            angle -= half_turn;
            way += step;
            add(at, angle, way);
        }
    }
    // The handle stands on z, and the blade lies at its foot.
    let foot = DVec3::new(-at.x, 0.0, HANDLE[0][0] - at.y - 0.5);
    for station in &mut stations {
        station.at += foot;
    }
    stations
}

fn handle() -> Vec<Station> {
    let mut heights: Vec<f64> = (0..16).map(|i| -72.0 + 4.0 * f64::from(i)).collect();
    let mut spread = |from: f64, to: f64, steps: u32, at: fn(f64) -> f64| {
        heights
            .extend((0..steps).map(|i| from + (to - from) * at(f64::from(i) / f64::from(steps))));
    };
    let [low, high] = OPENING;
    let slowly: fn(f64) -> f64 = |t| 1.0 - libm::cos(FRAC_PI_2 * t);
    let quickly: fn(f64) -> f64 = |t| libm::sin(FRAC_PI_2 * t);
    spread(low, low + ROUNDS[0], 14, slowly);
    spread(low + ROUNDS[0], high - ROUNDS[1], 20, |t| t);
    spread(high - ROUNDS[1], high, 10, quickly);
    spread(high, 80.0, 12, quickly);
    let color = linear(BRUSHED);
    let station = |z: f64| {
        let [_, w, t] = curve_at(&HANDLE, z);
        let round = |into: f64| (1.0 - into * into).max(0.0).sqrt();
        let end = round(((z - 80.0) / END + 1.0).max(0.0));
        let hole = round(((low - z) / ROUNDS[0] + 1.0).max(0.0))
            * round(((z - high) / ROUNDS[1] + 1.0).max(0.0));
        let is_open = z > low && z < high;
        let round = (0.5 * w * end).min(0.9);
        Station {
            at: DVec3::new(0.0, 0.0, z),
            half: [w * end, t - 0.4 * (1.0 - end)],
            round,
            face: w * end - round - FLAT,
            hole: if is_open { (w - BAR) * hole } else { 0.0 },
            color,
            ..Station::PLAIN
        }
    };
    heights.into_iter().map(station).collect()
}
