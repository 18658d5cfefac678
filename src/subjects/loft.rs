//! Closed bodies of triangles made of rings of vertices, and the cross-sections and curves that give their places.
//!
//! Rings follow each other along a body and go round it counter-clockwise, seen from where the body goes on.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3, Vec3};

use crate::data::{Coloring, Corners, Mesh, MeshPart};
use crate::math::linear_from_srgb;

/// A vertex before it has a number: its place, mm, and its linear colour.
pub(super) type Point = (DVec3, Vec3);

/// A mesh in the making.
pub(super) struct Loft {
    positions: Vec<Vec3>,
    colors: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    parts: Vec<MeshPart>,
}

/// A cross-section of a bar that runs in a plane: a rectangle with round corners, which may have a recess in the middle
/// of its two faces or a hole from face to face.
#[derive(Clone, Copy)]
pub(super) struct Station {
    /// Middle of the section and the direction in which the bar goes on, mm.
    pub(super) at: DVec3,
    pub(super) along: DVec3,
    /// Half of the width and of the thickness, mm. A width of 0 is a tip, which only an end of the bar may be.
    pub(super) half: [f64; 2],
    /// Radius of the corners, mm, less than half of the thickness.
    pub(super) round: f64,
    /// Half of the width of the recess, mm: 0 at all stations of a bar that has none.
    pub(super) face: f64,
    /// Depth of the recess in the outer and in the inner face, mm.
    pub(super) depth: [f64; 2],
    /// Half of the width of the hole, mm; 0 for none, as at the first and the last station.
    pub(super) hole: f64,
    /// How far the section leans forward, mm for each mm of width.
    pub(super) slant: f64,
    /// How triangular a round section is, 0 to 1; one edge points inwards.
    pub(super) three_edged: f64,
    /// Linear colour.
    pub(super) color: Vec3,
}

impl Station {
    /// A bar that goes up along z, from which stations take what they do not say.
    pub(super) const PLAIN: Self = Self {
        at: DVec3::ZERO,
        along: DVec3::Z,
        half: [0.0; 2],
        round: 0.0,
        face: 0.0,
        depth: [0.0; 2],
        hole: 0.0,
        slant: 0.0,
        three_edged: 0.0,
        color: Vec3::ONE,
    };
}

/// Width of the slope around a recess and of the bevel around a hole, mm.
const RIM: f64 = 0.2;
/// Brightness of the floor of a recess, where little light comes.
const FLOOR: f32 = 0.45;

impl Loft {
    pub(super) fn new() -> Self {
        Self {
            positions: Vec::new(),
            colors: Vec::new(),
            triangles: Vec::new(),
            parts: Vec::new(),
        }
    }

    /// Ends a part: everything that was added since the last one.
    pub(super) fn end_part(&mut self, name: &str) {
        let start = self.parts.last().map_or(0, |part| part.triangles.end);
        self.parts.push(MeshPart {
            name: name.to_owned(),
            triangles: start..self.triangles.len(),
        });
    }

    pub(super) fn finish(self) -> Mesh {
        Mesh {
            colors: Some(Corners {
                values: self.colors,
                at: self.triangles.clone(),
            }),
            positions: self.positions,
            triangles: self.triangles,
            parts: self.parts,
            coloring: Coloring::First,
            ..Mesh::default()
        }
    }

    fn vertex(&mut self, (place, color): Point) -> u32 {
        self.positions.push(place.as_vec3());
        self.colors.push(color);
        self.positions.len() as u32 - 1
    }

    fn ring(&mut self, points: Vec<Point>) -> Vec<u32> {
        points.into_iter().map(|point| self.vertex(point)).collect()
    }

    /// Adds a closed body. Its rings have equally many vertices, but for a tip, a ring of one, at either end; an end
    /// without a tip gets a flat lid.
    pub(super) fn add_body(&mut self, rings: impl IntoIterator<Item = Vec<Point>>) {
        let mut last = Vec::new();
        for ring in rings {
            let next = self.ring(ring);
            if last.is_empty() {
                self.cover(&next, true);
            } else {
                self.join(&last, &next);
            }
            last = next;
        }
        self.cover(&last, false);
    }

    /// Adds a closed bar, `steps` edges round each corner of its sections. `across` is the direction of its width; the
    /// outer face is on the left of it, seen from where the bar goes on.
    pub(super) fn add_bar(&mut self, across: DVec3, steps: usize, stations: &[Station]) {
        // The whole section, or the two beside a hole.
        let mut last: Option<[Vec<u32>; 2]> = None;
        let mut whole: Vec<u32> = Vec::new();
        for station in stations {
            let points = station.points(across, steps);
            if station.hole > 0.0 {
                let next = station.beside_hole(across, &points);
                let next = next.map(|side| self.ring(side));
                let from = last.take().unwrap_or_else(|| self.halves(&whole, station));
                for (from, next) in from.iter().zip(&next) {
                    self.join(from, next);
                }
                last = Some(next);
                continue;
            }
            let next = self.ring(points);
            if let Some(from) = last.take() {
                for (from, next) in from.iter().zip(&self.halves(&next, station)) {
                    self.join(from, next);
                }
            } else if whole.is_empty() {
                self.cover(&next, true);
            } else {
                self.join(&whole, &next);
            }
            whole = next;
        }
        self.cover(&whole, false);
    }

    /// The two sides of a whole section where a hole begins or ends: they share a line from face to face.
    fn halves(&mut self, whole: &[u32], station: &Station) -> [Vec<u32>; 2] {
        let n = whole.len() / 2;
        let [low, high] = [0, n].map(|i| self.positions[whole[i] as usize].as_dvec3());
        let share = RIM / (2.0 * station.half[1]);
        let [near_low, near_high] =
            [share, 1.0 - share].map(|share| self.vertex((low.lerp(high, share), station.color)));
        let mut right = whole[1..n].to_vec();
        right.extend([whole[n], near_high, near_low, whole[0]]);
        let mut left = whole[n + 1..].to_vec();
        left.extend([whole[0], near_low, near_high, whole[n]]);
        [right, left]
    }

    /// Closes an end: nothing is to be done at a tip, else the ring gets a vertex in its middle.
    fn cover(&mut self, ring: &[u32], is_start: bool) {
        if ring.len() < 2 {
            return;
        }
        let sum: DVec3 = ring
            .iter()
            .map(|&i| self.positions[i as usize].as_dvec3())
            .sum();
        let color = self.colors[ring[0] as usize];
        let middle = [self.vertex((sum / ring.len() as f64, color))];
        if is_start {
            self.join(&middle, ring);
        } else {
            self.join(ring, &middle);
        }
    }

    /// Joins two rings, of which one may be a tip and which may share vertices.
    fn join(&mut self, from: &[u32], to: &[u32]) {
        for k in 0..from.len().max(to.len()) {
            let [[a, b], [c, d]] =
                [from, to].map(|ring| [k, k + 1].map(|index| ring[index % ring.len()]));
            for triangle in [[a, b, d], [a, d, c]] {
                let [a, b, c] = triangle;
                if a != b && b != c && c != a {
                    self.triangles.push(triangle);
                }
            }
        }
    }
}

impl Station {
    fn place(&self, across: DVec3, [x, y]: [f64; 2]) -> DVec3 {
        let out = self.along.cross(across);
        self.at + across * x + out * y + self.along * (self.slant * x)
    }

    /// The whole section: the middle of the inner face, the right side, the middle of the outer face, the left side.
    fn points(&self, across: DVec3, steps: usize) -> Vec<Point> {
        let [w, t] = self.half;
        if w == 0.0 {
            return vec![(self.at, self.color)];
        }
        let r = self.round;
        let [outer, inner] = self.depth;
        let half = |sign: f64, depth: f64, next_depth: f64| {
            let mut points = vec![(DVec2::new(0.0, -t + depth), depth)];
            if self.face > 0.0 {
                points.push((DVec2::new(self.face, -t + depth), depth));
                points.push((DVec2::new(self.face + RIM, -t), 0.0));
            }
            for (side, start) in [(-1.0, -FRAC_PI_2), (1.0, 0.0)] {
                for step in 0..=steps {
                    let angle = start + FRAC_PI_2 * step as f64 / steps as f64;
                    let corner = DVec2::new(w - r, side * (t - r));
                    let arm = DVec2::new(libm::cos(angle), libm::sin(angle)) * r;
                    points.push((corner + arm, 0.0));
                }
            }
            if self.face > 0.0 {
                points.push((DVec2::new(self.face + RIM, t), 0.0));
                points.push((DVec2::new(self.face, t - next_depth), next_depth));
            }
            points.into_iter().map(move |(p, depth)| (p * sign, depth))
        };
        let points = half(1.0, inner, outer).chain(half(-1.0, outer, inner));
        let points = points.map(|(p, depth)| {
            let p = p.lerp(self.on_triangle(p), self.three_edged);
            let color = self.color * if depth > 0.0 { FLOOR } else { 1.0 };
            (self.place(across, p.to_array()), color)
        });
        points.collect()
    }

    /// The same way from the middle, but on the triangle that goes round the section's width.
    fn on_triangle(&self, p: DVec2) -> DVec2 {
        let root = 0.75_f64.sqrt();
        let far = p.y.max((p.x * root).abs() - 0.5 * p.y);
        p * (0.5 * self.half[0] / far)
    }

    /// The two sections beside a hole, of the points of the whole one.
    fn beside_hole(&self, across: DVec3, whole: &[Point]) -> [Vec<Point>; 2] {
        let (n, t, h) = (whole.len() / 2, self.half[1], self.hole);
        let wall = |sign: f64| {
            [[h + RIM, t], [h, t - RIM], [h, RIM - t], [h + RIM, -t]]
                .map(|[x, y]| (self.place(across, [sign * x, sign * y]), self.color))
        };
        [(&whole[1..n], 1.0), (&whole[n + 1..], -1.0)]
            .map(|(side, sign)| [side, &wall(sign)].concat())
    }
}

/// A colour of a palette as linear light.
pub(super) fn linear(srgb: [u8; 3]) -> Vec3 {
    Vec3::from(srgb.map(linear_from_srgb))
}

/// A cubic curve from `a` to `b`, at a share of the way. It leaves `a` by the slope `m` and meets `b` by the slope `n`,
/// which count for the whole way.
pub(super) fn hermite<const N: usize>([a, m, b, n]: [[f64; N]; 4], t: f64) -> [f64; N] {
    let (t2, t3) = (t * t, t * t * t);
    std::array::from_fn(|k| {
        a[k] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + m[k] * (t3 - 2.0 * t2 + t)
            + b[k] * (3.0 * t2 - 2.0 * t3)
            + n[k] * (t3 - t2)
    })
}

/// A smooth curve through knots of which the first numbers grow, where the first number is `at`, no farther than the
/// ends.
pub(super) fn curve_at<const N: usize>(knots: &[[f64; N]], at: f64) -> [f64; N] {
    let last = knots.len() - 1;
    let i = (1..last).take_while(|&i| knots[i][0] <= at).count();
    let span = knots[i + 1][0] - knots[i][0];
    let slope = |i: usize| {
        let (from, to) = (knots[i.saturating_sub(1)], knots[(i + 1).min(last)]);
        let share = span / (to[0] - from[0]);
        std::array::from_fn(|k| (to[k] - from[k]) * share)
    };
    let t = ((at - knots[i][0]) / span).clamp(0.0, 1.0);
    hermite([knots[i], slope(i), knots[i + 1], slope(i + 1)], t)
}
