//! The built-in starting shapes (spec/sweepers.md, B): closed, mirrored in all three middle planes, with vertices in
//! them.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_4, TAU};

use glam::DVec3;

use super::mesh::Vertex;
use crate::document::ClayShape;

/// Edges of a starting shape are no longer than this, or than the detail if that is more.
pub(super) const FINEST: f64 = 0.015;
/// Radius of the edges of cube and plate.
const ROUND: f64 = 0.02;
/// Half sides of cube and plate.
const CUBE: DVec3 = DVec3::splat(0.5);
const PLATE: DVec3 = DVec3::new(0.5, 0.5, 0.075);
/// Radii of the torus.
const RING: f64 = 0.35;
const TUBE: f64 = 0.15;
/// Longest edge of a ball of radius 1 whose base has edges of length 1: those in the middle of a face of an icosahedron
/// come out longest.
const BALL_STRETCH: f64 = 1.259;

/// Vertices and triangles of a shape.
pub(super) fn shape(shape: ClayShape, detail: f64) -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let longest = detail.max(FINEST);
    match shape {
        ClayShape::Ball => ball(longest),
        ClayShape::Cube => rounded_box(CUBE, longest, detail),
        ClayShape::Plate => rounded_box(PLATE, longest, detail),
        ClayShape::Torus => torus(longest),
    }
}

/// Vertices by what they are made of, each once.
#[derive(Default)]
struct Welded {
    index_of: HashMap<[i64; 3], u32>,
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
}

impl Welded {
    fn vertex(&mut self, pos: DVec3, normal: DVec3) -> u32 {
        // Exactly in the middle planes, whatever rounding says, and no negative zero.
        let clean = |v: DVec3| {
            DVec3::from_array(v.to_array().map(|x| if x.abs() < 1e-12 { 0.0 } else { x }))
        };
        let (pos, normal) = (clean(pos), clean(normal));
        let key = pos.to_array().map(|x| libm::round(x * 1e8) as i64);
        *self.index_of.entry(key).or_insert_with(|| {
            self.vertices.push(Vertex::new(pos, normal));
            (self.vertices.len() - 1) as u32
        })
    }

    fn done(self) -> (Vec<Vertex>, Vec<[u32; 3]>) {
        (self.vertices, self.triangles)
    }
}

/// An icosahedron whose faces are divided and pressed onto the ball of radius ½.
fn ball(longest: f64) -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let golden = (1.0 + libm::sqrt(5.0)) / 2.0;
    let mut corners = Vec::new();
    for one in [-1.0, 1.0] {
        for two in [-golden, golden] {
            corners.extend([
                DVec3::new(0.0, one, two),
                DVec3::new(one, two, 0.0),
                DVec3::new(two, 0.0, one),
            ]);
        }
    }
    let edge = 2.0;
    let radius = corners[0].length();
    let wanted = BALL_STRETCH * (0.5 * edge / radius) / longest;
    // Of an even number, so that the middle planes meet vertices.
    let parts = 2 * libm::ceil(wanted / 2.0) as i32;
    let mut welded = Welded::default();
    let is_near = |a: DVec3, b: DVec3| a != b && a.distance(b) < 1.1 * edge;
    for (i, a) in corners.iter().enumerate() {
        for (j, b) in corners.iter().enumerate().skip(i + 1) {
            for c in corners.iter().skip(j + 1) {
                if !(is_near(*a, *b) && is_near(*b, *c) && is_near(*c, *a)) {
                    continue;
                }
                let is_outward = (*b - *a).cross(*c - *a).dot(*a) > 0.0;
                let [b, c] = if is_outward { [*b, *c] } else { [*c, *b] };
                let mut at = |u: i32, v: i32| {
                    let [u, v] = [u, v].map(|part| f64::from(part) / f64::from(parts));
                    let out = (*a * (1.0 - u - v) + b * u + c * v).normalize();
                    welded.vertex(0.5 * out, out)
                };
                let mut triangles = Vec::new();
                for u in 0..parts {
                    for v in 0..parts - u {
                        triangles.push([at(u, v), at(u + 1, v), at(u, v + 1)]);
                        if u + v + 2 <= parts {
                            triangles.push([at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)]);
                        }
                    }
                }
                welded.triangles.extend(triangles);
            }
        }
    }
    welded.done()
}

/// Coordinates along a side of a box: its flat part in equal parts, and the angles of its rounding at both ends.
fn along_side(half: f64, longest: f64, detail: f64) -> Vec<f64> {
    let core = half - ROUND;
    let arcs = match detail {
        d if d <= 0.021 => 3,
        d if d <= 0.04 => 2,
        _ => 1,
    };
    // Diagonals are the longest edges.
    let flats =
        2 * libm::ceil(2.0 * core / (longest * std::f64::consts::FRAC_1_SQRT_2) / 2.0) as i32;
    let flat = (0..=flats).map(|i| core * (f64::from(2 * i - flats) / f64::from(flats)));
    let arc = |i: i32| core + ROUND * libm::tan(FRAC_PI_4 * f64::from(i) / f64::from(arcs));
    let low = (1..=arcs).rev().map(|i| -arc(i));
    low.chain(flat).chain((1..=arcs).map(arc)).collect()
}

/// A box with rounded edges, by its half sides.
fn rounded_box(half: DVec3, longest: f64, detail: f64) -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let core = half - ROUND;
    let mut welded = Welded::default();
    for axis in 0..3 {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let [us, vs] = [u, v].map(|side| along_side(half[side], longest, detail));
        for sign in [-1.0, 1.0] {
            let mut at = |i: usize, j: usize| {
                let mut on_box = DVec3::ZERO;
                on_box[axis] = sign * half[axis];
                on_box[u] = us[i];
                on_box[v] = vs[j];
                let inner = on_box.clamp(-core, core);
                let out = (on_box - inner).normalize();
                welded.vertex(inner + ROUND * out, out)
            };
            let mut triangles = Vec::new();
            for i in 0..us.len() - 1 {
                for j in 0..vs.len() - 1 {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    // Mirror images of each other in the middle planes.
                    let is_falling = (us[i] + us[i + 1] > 0.0) != (vs[j] + vs[j + 1] > 0.0);
                    let pair = if is_falling {
                        [[a, b, d], [b, c, d]]
                    } else {
                        [[a, b, c], [a, c, d]]
                    };
                    triangles.extend(if sign > 0.0 {
                        pair
                    } else {
                        pair.map(|[a, b, c]| [a, c, b])
                    });
                }
            }
            welded.triangles.extend(triangles);
        }
    }
    welded.done()
}

/// A ring about z.
fn torus(longest: f64) -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let parts = |length: f64| 4 * libm::ceil(length / (4.0 * longest)) as usize;
    let around = parts(TAU * (RING + TUBE) * std::f64::consts::SQRT_2);
    let across = parts(TAU * TUBE * std::f64::consts::SQRT_2);
    let circle = |i: usize, count: usize| {
        let angle = TAU * (i % count) as f64 / count as f64;
        (libm::cos(angle), libm::sin(angle))
    };
    let mut welded = Welded::default();
    let mut at = |i: usize, j: usize| {
        let [(x, y), (out, up)] = [circle(i, around), circle(j, across)];
        let normal = DVec3::new(out * x, out * y, up);
        welded.vertex(RING * DVec3::new(x, y, 0.0) + TUBE * normal, normal)
    };
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let is_falling = (4 * i / around + 4 * j / across) % 2 == 1;
            triangles.extend(if is_falling {
                [[a, b, d], [b, c, d]]
            } else {
                [[a, b, c], [a, c, d]]
            });
        }
    }
    welded.triangles = triangles;
    welded.done()
}
