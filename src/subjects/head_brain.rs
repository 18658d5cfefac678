//! The brain: hemispheres with their folds, cerebellum with its leaves, stem, ventricles.
//!
//! The folds are the nodal lines of a random wave on the surface: such lines wind, keep their distance and hardly ever
//! cross, as sulci do. The sulci that have names are drawn as curves, and the wave keeps away from them, which leaves
//! the gyri along them whole. Coordinates as in [`super::head_skin`].

use super::head_skull::cerebral_space;
use super::lanes::{LANES, Lanes, Points};
use super::random::Random;
use super::shape::{Field, Knot, Places, Shape, both, capsule, cuboid, curve, ellipsoid, strap};

/// Thickness of the fluid between bone and brain, mm.
const FLUID_MM: f32 = 2.4;
/// How deep sulci reach, mm.
const SULCUS_DEPTH_MM: f32 = 13.0;
/// Half the width of a sulcus at the surface, mm.
const SULCUS_HALF_MM: f32 = 1.0;
/// How far the crown of a gyrus rises over its edge, mm.
const CROWN_MM: f32 = 3.2;
/// Directions along one side of a table of folds.
const TABLE: usize = 256;
/// Plane waves that are summed.
const WAVES: usize = 22;

/// The hemispheres before they are folded, and between which the long fissure runs.
pub(super) fn hemispheres() -> Field {
    let mut f = cerebral_space();
    f.carve(4.0, ellipsoid([0.0, -48.0, -9.0], [70.0, 49.0, 29.0]));
    f.carve(4.0, ellipsoid([0.0, -27.0, 6.0], [19.0, 25.0, 26.0]));
    // The valley of the lateral fissure's stem between frontal and temporal lobe.
    let stem: [Knot; 3] = [
        ([20.0, 27.0, 24.0], 3.0),
        ([42.0, 33.0, 25.0], 4.0),
        ([54.0, 34.0, 26.0], 4.5),
    ];
    f.carve_all(4.0, both(curve(&stem)));
    f
}

/// The gap between the hemispheres, over and before the callosal body and behind it.
pub(super) fn long_fissure() -> Field {
    let mut f = Field::default();
    f.join(0.0, cuboid([0.0, 0.0, 70.0], [1.3, 120.0, 90.0], 0.1));
    f.carve(2.0, ellipsoid([0.0, 0.0, 40.0], [400.0, 41.0, 25.0]));
    f
}

/// The sulci that have names, on both sides, as thin lines on the surface.
fn named_sulci() -> Field {
    let mut f = Field::default();
    let mut line = |points: &[[f32; 3]]| {
        let knots: Vec<Knot> = points.iter().map(|&p| (p, 0.1)).collect();
        f.join_all(0.0, both(curve(&knots)));
    };
    // Lateral, central, superior temporal.
    line(&[
        [46.0, 36.0, 24.0],
        [57.0, 24.0, 27.0],
        [62.0, 4.0, 33.0],
        [62.0, -20.0, 42.0],
        [57.0, -38.0, 54.0],
    ]);
    line(&[
        [3.0, -14.0, 116.0],
        [20.0, -6.0, 112.0],
        [38.0, 4.0, 98.0],
        [52.0, 10.0, 76.0],
        [60.0, 14.0, 50.0],
    ]);
    line(&[
        [46.0, 34.0, 6.0],
        [58.0, 14.0, 10.0],
        [62.0, -12.0, 20.0],
        [60.0, -38.0, 32.0],
        [50.0, -56.0, 50.0],
    ]);
    // Before and behind the central one.
    line(&[
        [22.0, 12.0, 110.0],
        [38.0, 22.0, 94.0],
        [50.0, 28.0, 72.0],
        [56.0, 30.0, 48.0],
    ]);
    line(&[
        [22.0, -26.0, 108.0],
        [40.0, -14.0, 94.0],
        [54.0, -8.0, 74.0],
        [60.0, -8.0, 54.0],
    ]);
    // Upper and lower frontal.
    line(&[
        [18.0, 70.0, 58.0],
        [22.0, 62.0, 78.0],
        [24.0, 42.0, 98.0],
        [24.0, 16.0, 109.0],
    ]);
    line(&[[38.0, 58.0, 52.0], [47.0, 46.0, 62.0], [53.0, 30.0, 66.0]]);
    // Between the parietal lobules; towards the occiput.
    line(&[
        [46.0, -16.0, 88.0],
        [36.0, -42.0, 92.0],
        [24.0, -66.0, 74.0],
    ]);
    line(&[[3.0, -64.0, 84.0], [16.0, -68.0, 76.0], [26.0, -70.0, 66.0]]);
    // On the inner side: cingulate, parieto-occipital, calcarine.
    line(&[
        [2.0, 46.0, 36.0],
        [2.0, 56.0, 56.0],
        [2.0, 44.0, 76.0],
        [2.0, 8.0, 86.0],
        [2.0, -30.0, 84.0],
        [2.0, -42.0, 104.0],
    ]);
    line(&[[2.0, -42.0, 44.0], [2.0, -56.0, 66.0], [2.0, -64.0, 86.0]]);
    line(&[[2.0, -42.0, 42.0], [2.0, -58.0, 44.0], [2.0, -78.0, 38.0]]);
    f
}

/// Distance to the nearest sulcus, for every direction from the middle of a hemisphere.
struct Folds {
    center: [f32; 3],
    distance: Vec<f32>,
}

/// From the unit square to a direction: the octahedron unfolded.
fn direction(u: f32, v: f32) -> [f32; 3] {
    let (x, y) = (u * 2.0 - 1.0, v * 2.0 - 1.0);
    let z = 1.0 - x.abs() - y.abs();
    let sign = |a: f32| if a < 0.0 { -1.0 } else { 1.0 };
    let (x, y) = if z < 0.0 {
        ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y))
    } else {
        (x, y)
    };
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

impl Folds {
    fn new(side: f32, seed: u32, hemispheres: &Field, fissure: &Field, named: &Field) -> Self {
        let center = [side * 28.0, -6.0, 54.0];
        // A random wave: equal lengths, directions and phases from a small generator of its own.
        let mut state = Random(seed);
        let mut random = || state.next();
        let waves: Vec<([f32; 3], f32)> = (0..WAVES)
            .map(|i| {
                // Directions spread evenly over the sphere by the golden angle, then jittered.
                let z = 1.0 - (2.0 * i as f32 + 1.0) / WAVES as f32;
                let turn = (i as f32 * 0.381_966 + 0.25 * random()) * std::f32::consts::TAU;
                let r = (1.0 - z * z).sqrt();
                let k = std::f32::consts::TAU / (17.5 + 5.0 * random());
                (
                    [k * r * libm::cosf(turn), k * r * libm::sinf(turn), k * z],
                    random() * std::f32::consts::TAU,
                )
            })
            .collect();
        let (solid, gap, lines) = (
            hemispheres.everywhere(),
            fissure.everywhere(),
            named.everywhere(),
        );
        let mut distance = vec![0.0; TABLE * TABLE];
        for (row, cells) in distance.chunks_exact_mut(TABLE).enumerate() {
            for (chunk, cells) in cells.chunks_exact_mut(LANES).enumerate() {
                let mut way = Points {
                    x: Lanes::splat(0.0),
                    y: Lanes::splat(0.0),
                    z: Lanes::splat(0.0),
                };
                for i in 0..LANES {
                    let u = ((chunk * LANES + i) as f32 + 0.5) / TABLE as f32;
                    let d = direction(u, (row as f32 + 0.5) / TABLE as f32);
                    (way.x[i], way.y[i], way.z[i]) = (d[0], d[1], d[2]);
                }
                // Walk to the surface.
                let mut t = Lanes::splat(6.0);
                let mut places = Places::new(way);
                for _ in 0..14 {
                    places = Places::new(Points {
                        x: way.x * t + center[0],
                        y: way.y * t + center[1],
                        z: way.z * t + center[2],
                    });
                    let d = solid.distance(&places) + FLUID_MM;
                    let d = d.max(-gap.distance(&places));
                    t = (t - d * 0.9).clamp(4.0, 120.0);
                }
                let line = lines.distance(&places).max(Lanes::splat(0.0));
                for (i, cell) in cells.iter_mut().enumerate() {
                    let p = [places.plain.x[i], places.plain.y[i], places.plain.z[i]];
                    let (mut f, mut g) = (0.0f32, [0.0f32; 3]);
                    for (k, phase) in &waves {
                        let (sin, cos) =
                            libm::sincosf(k[0] * p[0] + k[1] * p[1] + k[2] * p[2] + phase);
                        f += cos;
                        for axis in 0..3 {
                            g[axis] -= k[axis] * sin;
                        }
                    }
                    let slope = (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]).sqrt();
                    let wave = f.abs() / slope.max(0.35);
                    // Lines that have names push the others away, and are opened a little wider.
                    let wave = wave + (5.5 - line[i]).max(0.0) * 0.9;
                    *cell = wave.min(line[i] - 0.3).clamp(-0.3, 8.0);
                }
            }
        }
        Self { center, distance }
    }

    /// Distance to the nearest sulcus at a point, mm, as measured at the surface outwards of it, and how deep a sulcus
    /// may reach there: they would crowd at the middle.
    #[inline]
    fn at(&self, x: f32, y: f32, z: f32) -> (f32, f32) {
        let (x, y, z) = (x - self.center[0], y - self.center[1], z - self.center[2]);
        let room = (x * x + y * y + z * z).sqrt() - 20.0;
        let sum = x.abs() + y.abs() + z.abs() + 1e-3;
        let (mut u, mut v) = (x / sum, y / sum);
        if z < 0.0 {
            let (a, b) = (1.0 - v.abs(), 1.0 - u.abs());
            u = if u < 0.0 { -a } else { a };
            v = if v < 0.0 { -b } else { b };
        }
        let to_cell =
            |a: f32| ((a * 0.5 + 0.5) * TABLE as f32 - 0.5).clamp(0.0, TABLE as f32 - 1.001);
        let (u, v) = (to_cell(u), to_cell(v));
        let (i, j) = (u as usize, v as usize);
        let (s, t) = (u - i as f32, v - j as f32);
        let get = |i: usize, j: usize| self.distance.get(i + TABLE * j).copied().unwrap_or(8.0);
        let a = get(i, j) * (1.0 - s) + get(i + 1, j) * s;
        let b = get(i, j + 1) * (1.0 - s) + get(i + 1, j + 1) * s;
        (a * (1.0 - t) + b * t, room.clamp(0.0, SULCUS_DEPTH_MM))
    }
}

/// The folds of both hemispheres, which differ a little, as they do.
pub(super) struct Cortex {
    right: Folds,
    left: Folds,
}

impl Cortex {
    pub(super) fn new() -> Self {
        let (solid, gap, named) = (hemispheres(), long_fissure(), named_sulci());
        Self {
            right: Folds::new(1.0, 11, &solid, &gap, &named),
            left: Folds::new(-1.0, 5, &solid, &gap, &named),
        }
    }

    /// Signed distance to the folded surface from that to the smooth one (fluid not taken off yet) and to the fissure.
    pub(super) fn distance(&self, p: &Points, solid: Lanes, fissure: Lanes) -> Lanes {
        let smooth = (solid + FLUID_MM).max(Lanes::splat(0.3) - fissure);
        let mut out = smooth;
        for i in 0..LANES {
            let d = smooth[i];
            if !(-SULCUS_DEPTH_MM - 6.0..6.0).contains(&d) {
                continue;
            }
            // What joins the hemispheres has no folds.
            let x = p.x[i].abs();
            if x < 10.0 && fissure[i] > x {
                continue;
            }
            let folds = if p.x[i] < 0.0 {
                &self.left
            } else {
                &self.right
            };
            let (s, depth) = folds.at(p.x[i], p.y[i], p.z[i]);
            let edge = (1.0 - s.max(0.0) * (1.0 / 5.0)).max(0.0);
            // A sulcus narrows and ends inwards.
            let cut = (s - SULCUS_HALF_MM).max(-d - depth);
            out[i] = (d + CROWN_MM * edge * edge).max(-cut);
        }
        out
    }
}

/// The cerebellum before it is cut into leaves.
pub(super) fn cerebellum() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid([24.5, -46.0, -3.0], [27.0, 31.0, 22.5])
            .turned(0.0, 8.0, 0.0)
            .both(),
    );
    f.join(7.0, ellipsoid([0.0, -47.0, 3.0], [9.0, 28.0, 23.0]));
    f.join(4.0, ellipsoid([9.0, -34.0, -22.0], [7.0, 11.0, 7.0]).both());
    f.raise(
        -4.0,
        capsule([0.0, -84.0, 0.0], [0.0, -60.0, -30.0], 9.0, 9.0),
    );
    f
}

/// Signed distance to the cerebellum's leaves from that to its smooth surface.
pub(super) fn folia(p: &Points, smooth: Lanes) -> Lanes {
    let mut out = smooth;
    for i in 0..LANES {
        let d = smooth[i];
        if !(-14.0..4.0).contains(&d) {
            continue;
        }
        let (x, y, z) = (p.x[i], p.y[i], p.z[i]);
        // Leaves lie about the axis from ear to ear.
        let angle = libm::atan2f(z + 3.0, -(y + 26.0));
        let along = angle * 34.0 + 0.10 * x.abs() + 1.3 * libm::sinf(x * 0.16);
        let line = |period: f32| {
            let s = along / period;
            (s - (s + 0.5).floor()).abs() * period
        };
        let small = (line(4.4) - 0.55).max(-d - 3.4);
        let large = (line(13.2) - 0.75).max(-d - 11.0);
        out[i] = d.max(-small).max(-large);
    }
    out
}

/// Midbrain, pons, medulla and cord.
pub(super) fn stem() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        capsule([0.0, -12.0, 32.0], [0.0, -8.0, 14.0], 11.5, 12.0),
    );
    f.join(3.0, capsule([0.0, -4.0, 30.0], [0.0, -3.0, 18.0], 9.0, 9.0));
    f.join(3.0, ellipsoid([0.0, -5.5, 6.0], [15.5, 12.5, 12.5]));
    f.join(
        6.0,
        strap(
            [12.0, -10.0, 5.0],
            [22.0, -32.0, 0.0],
            8.5,
            8.0,
            [1.0, 0.0, 0.0],
            0.8,
        )
        .both(),
    );
    let cord: [Knot; 5] = [
        ([0.0, -10.0, -4.0], 9.0),
        ([0.0, -17.0, -26.0], 6.8),
        ([0.0, -27.0, -46.0], 5.8),
        ([0.0, -30.0, -80.0], 5.6),
        ([0.0, -36.0, -160.0], 5.6),
    ];
    f.join_all(4.0, curve(&cord));
    // Colliculi.
    f.join(
        2.0,
        capsule([4.5, -25.0, 27.0], [4.5, -24.5, 19.0], 3.6, 3.4).both(),
    );
    f
}

/// Callosal body and other white tracts across the middle.
pub(super) fn callosum() -> Vec<Shape> {
    let arc: [Knot; 7] = [
        ([0.0, 27.0, 38.0], 2.0),
        ([0.0, 35.0, 46.0], 4.2),
        ([0.0, 30.0, 57.0], 4.0),
        ([0.0, 12.0, 64.0], 3.2),
        ([0.0, -10.0, 65.0], 3.2),
        ([0.0, -28.0, 60.0], 3.6),
        ([0.0, -36.0, 52.0], 5.0),
    ];
    let mut shapes = Vec::new();
    for side in [0.0, 5.0, 10.0] {
        for shape in curve(&arc) {
            shapes.push(shape.moved([side, 0.0, side * 0.12]).both());
        }
    }
    shapes
}

/// Grey matter in the depth: thalamus, caudate, lentiform nucleus, amygdala, and the walls of the third ventricle.
pub(super) fn deep_grey() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid([10.5, -10.0, 43.0], [8.5, 15.5, 9.5])
            .turned(0.0, 0.0, 14.0)
            .both(),
    );
    let caudate: [Knot; 4] = [
        ([12.0, 25.0, 47.0], 6.5),
        ([15.0, 12.0, 55.0], 4.6),
        ([17.0, -8.0, 59.0], 3.0),
        ([20.0, -26.0, 56.0], 2.2),
    ];
    f.join_all(0.0, both(curve(&caudate)));
    f.join(
        0.0,
        ellipsoid([25.5, 3.0, 41.0], [6.5, 16.5, 11.0])
            .turned(0.0, 0.0, -10.0)
            .both(),
    );
    f.join(0.0, ellipsoid([22.0, 6.0, 20.0], [7.0, 7.0, 7.0]).both());
    f.join(0.0, ellipsoid([4.5, 6.0, 33.0], [4.5, 12.0, 9.0]).both());
    f
}

/// Ventricles: the two lateral ones with their horns, third, aqueduct, fourth.
pub(super) fn ventricles() -> Field {
    let mut f = Field::default();
    let lateral: [Knot; 6] = [
        ([9.5, 33.0, 47.0], 3.8),
        ([9.0, 22.0, 55.0], 4.6),
        ([9.5, 2.0, 59.0], 4.2),
        ([13.0, -18.0, 57.5], 4.6),
        ([19.5, -34.0, 50.0], 5.8),
        ([17.0, -58.0, 44.0], 2.6),
    ];
    f.join_all(0.0, both(curve(&lateral)));
    let temporal: [Knot; 5] = [
        ([19.5, -34.0, 50.0], 5.5),
        ([25.0, -32.0, 36.0], 4.2),
        ([29.5, -18.0, 25.0], 3.2),
        ([31.0, -2.0, 19.0], 3.0),
        ([30.0, 9.0, 17.0], 2.4),
    ];
    f.join_all(1.0, both(curve(&temporal)));
    f.join(
        0.5,
        capsule([7.0, 11.0, 53.0], [1.5, 9.0, 47.0], 1.8, 1.8).both(),
    );
    f.join(0.5, ellipsoid([0.0, -3.0, 40.0], [2.6, 15.0, 10.5]));
    f.join(
        0.5,
        capsule([0.0, -16.0, 34.0], [0.0, -20.0, 14.0], 1.4, 1.4),
    );
    f.join(
        1.0,
        strap(
            [0.0, -20.0, 14.0],
            [0.0, -20.5, -10.0],
            5.0,
            5.5,
            [0.0, 1.0, 0.0],
            0.6,
        ),
    );
    f.join(1.0, ellipsoid([0.0, -23.0, 3.0], [7.5, 5.0, 6.5]));
    f
}

/// Signed distance to the two folds of the dura, from the distance to the room under the tentorium: the sickle between
/// the hemispheres, whose lower edge keeps off the callosal body, and the tent over the cerebellum, open for the stem.
pub(super) fn dura(p: &Points, under_tentorium: Lanes) -> Lanes {
    let one = Lanes::splat(1.0);
    let (y, z) = (p.y * (1.0 / 55.0), (p.z - 40.0) * (1.0 / 37.0));
    let about_callosum = (one - (y * y + z * z)) * 20.0;
    // Before the callosal body it ends on the floor of the skull, behind it on the tent.
    let low = (Lanes::splat(38.0) - p.z).min(p.y + 20.0);
    let sickle = (p.x.abs() - 0.75)
        .max(about_callosum)
        .max(-under_tentorium)
        .max(low)
        .max(Lanes::splat(6.0) - p.z);
    let (x, y) = (p.x * (1.0 / 21.0), (p.y + 8.0) * (1.0 / 30.0));
    let about_stem = (one - (x * x + y * y)) * 12.0;
    let tent = ((under_tentorium + 0.2).abs() - 0.8)
        .max(about_stem)
        .max(p.y)
        .max(-p.z);
    sickle.min(tent)
}
