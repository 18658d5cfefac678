//! Tissue forceps: one strip of steel, bent back on itself, whose two arms bow outwards and meet in fine tips.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::steel::{BRUSHED, POLISHED};
use crate::subjects::loft::{Loft, Station, curve_at, linear};

/// Height of an arm, its distance from the middle, half of its width and half of its thickness, mm.
const ARM: [[f64; 4]; 11] = [
    [-70.0, 1.55, 0.55, 0.45],
    [-68.0, 2.0, 0.85, 0.6],
    [-62.0, 2.7, 1.15, 0.65],
    [-48.0, 4.4, 1.9, 0.7],
    [-30.0, 6.6, 3.6, 0.75],
    [-10.0, 8.2, 4.9, 0.75],
    [10.0, 8.3, 5.2, 0.75],
    [28.0, 6.6, 5.0, 0.8],
    [44.0, 3.2, 4.7, 0.9],
    [54.0, 1.35, 4.5, 1.0],
    [68.0, 1.1, 4.3, 1.0],
];
/// Heights of the first tooth within the tips and of the first ridge of the grip, and where the back begins, mm.
const TEETH: f64 = -68.6;
const GRIP: f64 = -36.0;
const BACK: f64 = 67.8;
/// Between teeth and between ridges, mm.
const TOOTH: f64 = 1.1;
const RIDGE: f64 = 1.9;
const RIDGES: usize = 15;

pub(super) fn add(loft: &mut Loft) {
    let up = arm();
    let mirrored = up.iter().rev().map(|station| Station {
        at: station.at * DVec3::new(-1.0, 1.0, 1.0),
        along: station.along * DVec3::new(1.0, 1.0, -1.0),
        ..*station
    });
    let top = up[up.len() - 1];
    // Half a turn over the back.
    let turn = (1..10).map(|step| {
        let angle = PI * f64::from(step) / 10.0;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        Station {
            at: DVec3::new(top.at.x * cos, 0.0, top.at.z - top.at.x * sin),
            along: DVec3::new(sin, 0.0, cos),
            ..top
        }
    });
    let stations: Vec<Station> = up.iter().copied().chain(turn).chain(mirrored).collect();
    loft.add_bar(DVec3::Y, 3, &stations);
}

/// The arm at −x, from its tip up to the back.
fn arm() -> Vec<Station> {
    // Heights and the depth of the recesses there.
    let mut heights = vec![(-70.0, [0.0; 2]), (-69.7, [0.0; 2]), (-69.2, [0.0; 2])];
    for tooth in 0..7 {
        let z = TEETH + TOOTH * f64::from(tooth);
        heights.extend([(z, [0.0; 2]), (z + 0.5 * TOOTH, [0.0, 0.28])]);
    }
    heights.extend([-60.5, -57.0, -52.0, -48.0, -44.0, -40.5].map(|z| (z, [0.0; 2])));
    for ridge in 0..RIDGES {
        let z = GRIP + RIDGE * ridge as f64;
        heights.extend([(z, [0.0; 2]), (z + 0.5 * RIDGE, [0.4, 0.0])]);
    }
    let end = GRIP + RIDGE * RIDGES as f64;
    for step in 0..=14 {
        let part = f64::from(step) / 14.0;
        heights.push((end + (BACK - end) * part, [0.0; 2]));
    }
    let place = |z: f64| {
        let [_, x, ..] = curve_at(&ARM, z);
        DVec2::new(-x, z)
    };
    let [steel, tip] = [linear(BRUSHED), linear(POLISHED)];
    let station = |(z, depth): (f64, [f64; 2])| {
        let [_, _, w, t] = curve_at(&ARM, z);
        let is_back = z > BACK - 0.1;
        let way = place(z + 0.2) - place(z - 0.2);
        let way = if is_back {
            DVec2::Y
        } else {
            way.normalize_or_zero()
        };
        // The very tip is rounded off.
        let less = (0.7 - (z + 70.0)).max(0.0) * 0.4;
        let at = place(z);
        Station {
            at: DVec3::new(at.x, 0.0, at.y),
            along: DVec3::new(way.x, 0.0, way.y),
            half: [w - less, t - less],
            round: (0.45 * w).min(0.7 * (t - less)).min(0.4),
            face: (w - 1.0).max(0.5 * w - 0.2),
            depth,
            color: tip.lerp(steel, ((z + 58.0) / 8.0).clamp(0.0, 1.0) as f32),
            ..Station::PLAIN
        }
    };
    heights.into_iter().map(station).collect()
}
