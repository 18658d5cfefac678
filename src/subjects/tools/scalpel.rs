//! A scalpel: a flat handle with grooves for the fingers (No. 3), and a blade with a belly (No. 10) on its tongue.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::steel::{BRUSHED, GROUND, POLISHED};
use crate::subjects::loft::{Loft, Point, Station, curve_at, hermite, linear};

/// Height, half of the width and half of the thickness of the handle, mm.
const HANDLE: [[f64; 3]; 9] = [
    [-43.0, 3.5, 1.05],
    [-38.0, 4.0, 1.35],
    [-30.0, 3.75, 1.55],
    [-16.0, 4.5, 1.7],
    [0.0, 5.0, 1.75],
    [18.0, 4.8, 1.75],
    [40.0, 3.9, 1.7],
    [62.0, 3.9, 1.65],
    [80.0, 4.7, 1.6],
];
/// Where the handle has its shoulder, and how the shoulder leans.
const SHOULDER: f64 = -43.0;
const SLANT: f64 = 0.55;
/// Heights of the first groove's middle and of the tongue's end, mm.
const FIRST_GROOVE: f64 = -19.0;
const TONGUE: f64 = -60.0;
const GROOVES: usize = 20;
/// Between the grooves, their depth and the height of the round end, mm.
const PITCH: f64 = 1.9;
const DEPTH: f64 = 0.4;
const END: f64 = 5.0;

/// The spine of the blade, half of its thickness, its tip and where its edge begins, mm.
const SPINE: f64 = 3.3;
const HALF: f64 = 0.3;
const TIP: f64 = -80.0;
const HEEL: f64 = -50.0;
/// The ends of the belly with its slopes, mm: across and up.
const BELLY: [[f64; 2]; 4] = [[SPINE, TIP], [-10.5, 7.0], [-3.9, -61.0], [0.6, 26.0]];
/// Width of what is ground, and of the strip beside a ridge over which the shading turns, mm.
const BEVEL: f64 = 1.5;
const TURN: f64 = 0.07;

pub(super) fn add(loft: &mut Loft) {
    loft.add_bar(DVec3::X, 3, &handle());
    loft.add_body(blade());
}

fn handle() -> Vec<Station> {
    let steel = Station {
        color: linear(BRUSHED),
        round: 0.6,
        face: 0.6,
        ..Station::PLAIN
    };
    let tongue = |z: f64, half: [f64; 2]| Station {
        at: DVec3::new(0.0, 0.0, z),
        half,
        round: 0.15,
        face: 0.3,
        ..steel
    };
    let at = |z: f64, slant: f64, less: f64| {
        let [_, w, t] = curve_at(&HANDLE, z);
        Station {
            at: DVec3::new(0.0, 0.0, z),
            half: [w - less, t - less],
            round: 0.6 - less,
            face: w - 1.6,
            slant,
            ..steel
        }
    };
    let mut stations = vec![
        tongue(TONGUE, [1.0, 0.4]),
        tongue(TONGUE + 0.4, [1.5, 0.85]),
        Station {
            slant: SLANT,
            ..tongue(SHOULDER - 0.4, [1.8, 0.85])
        },
        at(SHOULDER - 0.4, SLANT, 0.4),
        at(SHOULDER, SLANT, 0.0),
    ];
    for step in 1..=12 {
        let part = f64::from(step) / 12.0;
        stations.push(at(SHOULDER + 22.0 * part, SLANT * (1.0 - part), 0.0));
    }
    for groove in 0..GROOVES {
        let middle = FIRST_GROOVE + PITCH * groove as f64;
        for (offset, depth) in [(-0.6, 0.0), (-0.35, DEPTH), (0.35, DEPTH), (0.6, 0.0)] {
            let depth = [depth; 2];
            stations.push(Station {
                depth,
                ..at(middle + offset, 0.0, 0.0)
            });
        }
    }
    let from = FIRST_GROOVE + PITCH * GROOVES as f64;
    for step in 0..20 {
        stations.push(at(
            from + (80.0 - END - from) * f64::from(step) / 20.0,
            0.0,
            0.0,
        ));
    }
    for step in 0..10 {
        let angle = FRAC_PI_2 * f64::from(step) / 10.0;
        let mut station = at(80.0 - END + END * libm::sin(angle), 0.0, 0.0);
        let share = libm::cos(angle);
        station.half[0] *= share;
        station.half[1] -= 0.5 * (1.0 - share);
        station.round = (0.5 * station.half[0]).min(0.6);
        station.face *= share;
        stations.push(station);
    }
    stations
}

fn blade() -> Vec<Vec<Point>> {
    let [steel, ground] = [linear(POLISHED), linear(GROUND)];
    // A section: the edge, the inner border of what is ground, the height of the spine, and a share of the thickness.
    let section = |edge: DVec2, border: DVec2, spine: f64, share: f64| {
        let half = HALF * share;
        let way = (border - edge).normalize_or_zero() * (TURN * share);
        let face = [
            (border - way, 0.94 * half, ground),
            (border, half, ground),
            (border + way, half, steel),
            (DVec2::new(SPINE - 0.4 * half, spine), half, steel),
            (DVec2::new(SPINE, spine), 0.6 * half, steel),
        ];
        let place = |p: DVec2, y: f64| DVec3::new(p.x, y, p.y);
        let mut ring = vec![(place(edge, 0.0), ground)];
        ring.extend(face.iter().map(|&(p, y, color)| (place(p, -y), color)));
        ring.extend(face.iter().rev().map(|&(p, y, color)| (place(p, y), color)));
        ring
    };
    let mut rings = vec![vec![(DVec3::new(SPINE, 0.0, TIP), ground)]];
    for step in 1..=36 {
        let part = f64::from(step) / 36.0;
        // Denser towards the tip, where the edge turns and the blade gets thin.
        let part = part * (0.5 + 0.5 * part);
        let at = |t: f64| DVec2::from(hermite([BELLY[0], BELLY[1], BELLY[2], BELLY[3]], t));
        let edge = at(part);
        let way = at(part + 0.01) - at(part - 0.01);
        let share = (6.0 * part).min(1.0);
        let mut border = edge + DVec2::new(way.y, -way.x).normalize_or_zero() * (BEVEL * share);
        border.x = border.x.min(0.5 * (edge.x + SPINE));
        rings.push(section(edge, border, border.y, share));
    }
    // Behind the heel the blade is not ground, and it ends at the shoulder.
    let straight = |x: f64, z: f64, width: f64, slant: f64| {
        let edge = DVec2::new(x, z + slant * x);
        let border = DVec2::new(x + width, z + slant * (x + width));
        section(edge, border, z + slant * SPINE, 1.0)
    };
    rings.extend([
        straight(-3.65, HEEL, BEVEL, 0.0),
        straight(-3.0, HEEL + 0.8, 0.5, 0.0),
        straight(-3.0, HEEL + 2.5, 0.4, SLANT),
        straight(-3.0, SHOULDER - 0.2, 0.4, SLANT),
    ]);
    rings
}
