//! The displacement between the control points of an `rbf`, solved in 64 bits so that a shader can evaluate it in 32.

use super::facts::Given;
use super::points::ControlPoints;
use super::spec::MAX_PARAM_FLOATS;
use crate::math::Solver;
use glam::{DVec2, DVec3, Vec3};

/// A point that lies nearer than this to one before it is left out, template units: two different displacements at one
/// place have no smooth interpolant.
const NEAREST: f64 = 1e-3;
/// The terms of a side, times a strength above 1, are kept below this in sum at any place, so that the map has noise of
/// 1e-5 and not more between places beside each other: 32-bit terms were measured to have noise of 7e-8 of their sum
/// where the basis is a square root or its inverse, of 1.4e-7 where it is another power. A larger sum is one of broad
/// functions that nearly cancel.
const MOST_ROOTS: f64 = 112.0;
const MOST_POWERS: f64 = 56.0;
/// A point that is missed by more than this is told of, subject units.
const MISSED: f64 = 1e-3;
/// Least and greatest weight of smallness that is tried where points lie too close for their softness, and how often
/// the range is halved.
const RIDGE: [f64; 2] = [1e-15, 1e3];
const RIDGE_TURNS: usize = 26;

/// One side of the cut: coefficients for its points and for 1, x, y, z about the middle of the box.
struct Side {
    centers: Vec<DVec3>,
    coefficients: Vec<DVec3>,
    polynomial: [DVec3; 4],
    bumps: Vec<Bump>,
}

/// What a point still lacks, given to the tissue around it up to the next point.
struct Bump {
    center: DVec3,
    /// Way to the next point, template units.
    radius: f64,
    height: DVec3,
}

/// A control point that the map misses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missed {
    /// Which of the template's points, from 0.
    pub point: usize,
    /// By how much, subject units, as the template acts: its strength and its falloffs count.
    pub by: f32,
}

/// The solved interpolant. Source: Correa, eq. 4.32 to 4.36.
///
/// Where points lie so close for their softness that only large coefficients would reach them, which 32 bits cannot
/// hold, the sum is the smoothest that keeps its terms small (it weighs the squares of the coefficients against what it
/// misses: Wahba 1990, "Spline models for observational data", section 1.3), and what it misses at a point is added in
/// a bump no wider than the way to the next point. Both change evenly with the points; the points themselves are met.
///
/// Differs from the source: a basis that falls is scaled to 1 at its centre (the same functions with other
/// coefficients); the linear part is the one of least slope where the points do not determine it (all in a plane, say);
/// the bumps.
pub(crate) struct Interpolant {
    sides: Vec<Side>,
    cut: Vec<[DVec2; 2]>,
    p: [f64; MAX_PARAM_FLOATS],
}

impl Interpolant {
    pub(crate) fn of(given: &Given) -> Self {
        let nothing = ControlPoints::default();
        let data = given.points.as_ref().unwrap_or(&nothing);
        let p = given.p.map(f64::from);
        let places: Vec<DVec2> = data.cut.iter().map(|p| p.as_dvec2()).collect();
        let cut: Vec<[DVec2; 2]> = places
            .windows(2)
            .map(|pair| [pair[0], pair[1]])
            .filter(|[a, b]| a.distance(*b) > 1e-6)
            .collect();
        let mut points: [Vec<(DVec3, DVec3)>; 2] = Default::default();
        for point in &data.points {
            let at = point.at.as_dvec3();
            let is_right = is_right_of(&cut, at);
            let flat = flattened(at, &p);
            let side = &mut points[usize::from(is_right)];
            if side.iter().all(|(other, _)| other.distance(flat) > NEAREST) {
                side.push((flat, point.shift.as_dvec3()));
            }
        }
        let n_sides = if cut.is_empty() { 1 } else { 2 };
        let sides = points.iter().take(n_sides).map(|points| solve(points, &p));
        Self {
            sides: sides.collect(),
            cut,
            p,
        }
    }

    /// As the shader reads it (shaders/displace/rbf.wgsl).
    pub(crate) fn pack(&self) -> Vec<[f32; 4]> {
        let quad = |v: DVec3| [v.x as f32, v.y as f32, v.z as f32, 0.0];
        let count = |i: usize| {
            let side = self.sides.get(i);
            side.map_or(0.0, |s| (s.centers.len() + s.bumps.len()) as f32)
        };
        let mut out = vec![[count(0), count(1), self.cut.len() as f32, 0.0]];
        for side in &self.sides {
            out.extend(side.polynomial.map(quad));
            for (center, coefficient) in side.centers.iter().zip(&side.coefficients) {
                out.extend([quad(*center), quad(*coefficient)]);
            }
            for bump in &side.bumps {
                let [x, y, z, _] = quad(bump.center);
                let per_square = (1.0 / (bump.radius * bump.radius)) as f32;
                out.extend([[x, y, z, per_square], quad(bump.height)]);
            }
        }
        out.extend(
            self.cut
                .iter()
                .map(|[a, b]| [a.x as f32, a.y as f32, b.x as f32, b.y as f32]),
        );
        out
    }

    /// Lines along x and along y in the middle plane, bent with the tissue; parted where the cut runs. Template space.
    pub(crate) fn bent_lattice(&self) -> Vec<Vec<Vec3>> {
        const LINES: usize = 9;
        const PLACES: usize = 24;
        let mut lines = Vec::new();
        for axis in 0..2 {
            for line in 0..LINES {
                let mut piece: Vec<Vec3> = Vec::new();
                let mut last_side = None;
                for place in 0..=PLACES {
                    let (along, across) = (
                        place as f64 / PLACES as f64,
                        line as f64 / (LINES - 1) as f64,
                    );
                    let tissue = match axis {
                        0 => DVec3::new(along, across, 0.5),
                        _ => DVec3::new(across, along, 0.5),
                    };
                    let side = usize::from(self.is_right(tissue));
                    // Where this tissue is now: from there it comes.
                    let mut now = tissue;
                    for _ in 0..6 {
                        now = tissue - self.displacement(side, now);
                    }
                    if last_side.is_some_and(|last| last != side) {
                        lines.push(std::mem::take(&mut piece));
                    }
                    last_side = Some(side);
                    piece.push(now.as_vec3());
                }
                lines.push(piece);
            }
        }
        lines.retain(|line| line.len() > 1);
        lines
    }

    fn is_right(&self, q: DVec3) -> bool {
        is_right_of(&self.cut, q)
    }

    /// The points that the map misses in a template of this size. Beyond the box nothing is displaced, and no point is
    /// missed there.
    pub(crate) fn missed(&self, given: &Given) -> Vec<Missed> {
        let points = given.points.iter().flat_map(|data| &data.points);
        let each = points.enumerate().map(|(point, wanted)| {
            let at = wanted.at.as_dvec3();
            let side = self.sides.get(usize::from(self.is_right(at)));
            let got = side.map_or(DVec3::ZERO, |s| s.at(flattened(at, &self.p), &self.p));
            let lack = (got - wanted.shift.as_dvec3()) * self.weight(at);
            let by = (lack * given.size.as_dvec3()).length() as f32;
            Missed { point, by }
        });
        each.filter(|missed| f64::from(missed.by) > MISSED)
            .collect()
    }

    /// How much of the interpolated displacement counts at a place: the strength, less towards the faces and away from
    /// the middle as the template says.
    fn weight(&self, q: DVec3) -> f64 {
        let [strength, _, _, extrude, falloff, edge, ..] = self.p;
        if q.cmplt(DVec3::ZERO).any() || q.cmpgt(DVec3::ONE).any() {
            return 0.0;
        }
        let eased = |t: f64| {
            let t = t.clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        };
        let mut weight = strength;
        if extrude > 0.5 && falloff > 0.0 {
            let part = ((q.z - 0.5).abs() - 0.5 + 0.5 * falloff) / (0.5 * falloff);
            weight *= 1.0 - eased(part);
        }
        if edge > 0.0 {
            for x in q.to_array() {
                weight *= eased(x.min(1.0 - x) / edge);
            }
        }
        weight
    }

    /// As the shader has it, for one side; beyond the faces as at them.
    fn displacement(&self, side: usize, q: DVec3) -> DVec3 {
        let q = q.clamp(DVec3::ZERO, DVec3::ONE);
        let weight = self.weight(q);
        self.sides.get(side).map_or(DVec3::ZERO, |s| {
            s.at(flattened(q, &self.p), &self.p) * weight
        })
    }

    /// Bounds of the displacement in the box: looked at on a grid, widened by what may lie between.
    pub(crate) fn shift(&self) -> [Vec3; 2] {
        const N: usize = 6;
        const STRIDES: [usize; 3] = [1, N + 1, (N + 1) * (N + 1)];
        let (mut least, mut most, mut steepest) = (DVec3::ZERO, DVec3::ZERO, 0.0_f64);
        for side in &self.sides {
            let place = |i: usize| STRIDES.map(|stride| i / stride % (N + 1));
            let all: Vec<DVec3> = (0..STRIDES[2] * (N + 1))
                .map(|i| {
                    let q = DVec3::from_array(place(i).map(|k| k as f64 / N as f64));
                    side.smooth_at(flattened(q, &self.p), &self.p) * self.p[0]
                })
                .collect();
            let [low, high] = side.bump_bounds();
            for (i, d) in all.iter().enumerate() {
                least = least.min(*d + low * self.p[0]);
                most = most.max(*d + high * self.p[0]);
                for (axis, stride) in STRIDES.into_iter().enumerate() {
                    if place(i)[axis] > 0 {
                        steepest = steepest.max(d.distance(all[i - stride]));
                    }
                }
            }
        }
        if least == most {
            return [Vec3::ZERO; 2];
        }
        let margin = 0.75 * steepest + 1e-4;
        [(least - margin).as_vec3(), (most + margin).as_vec3()]
    }
}

/// What of a point counts: all of it, or x and y.
fn flattened(q: DVec3, p: &[f64; MAX_PARAM_FLOATS]) -> DVec3 {
    if p[3] > 0.5 {
        DVec3::new(q.x, q.y, 0.5)
    } else {
        q
    }
}

/// The basis at a squared distance: 1 at its centre where it falls with the distance; 1 about a box away where it
/// grows. So powers of 32 bits are the most exact where they are largest.
fn basis(d2: f64, p: &[f64; MAX_PARAM_FLOATS]) -> f64 {
    let (m, r2) = (exponent(p[2]), p[1] * p[1]);
    libm::pow(if m > 0.0 { d2 + r2 } else { d2 / r2 + 1.0 }, m)
}

/// An exponent of 0 is a constant, which interpolates nothing.
fn exponent(given: f64) -> f64 {
    if given.abs() < 0.05 { -0.05 } else { given }
}

impl Bump {
    /// 1 in the middle, 0 from the radius on, twice differentiable.
    fn at(&self, q: DVec3) -> DVec3 {
        let near = (1.0 - self.center.distance_squared(q) / (self.radius * self.radius)).max(0.0);
        self.height * (near * near * near)
    }
}

impl Side {
    /// As the shader has it.
    fn at(&self, q: DVec3, p: &[f64; MAX_PARAM_FLOATS]) -> DVec3 {
        self.smooth_at(q, p) + self.bumps.iter().map(|bump| bump.at(q)).sum::<DVec3>()
    }

    /// Bounds of what the bumps add anywhere.
    fn bump_bounds(&self) -> [DVec3; 2] {
        let (mut least, mut most) = (DVec3::ZERO, DVec3::ZERO);
        for bump in &self.bumps {
            // Only those whose reaches meet add up.
            let meets = |b: &&Bump| b.center.distance(bump.center) < b.radius + bump.radius;
            let near = || self.bumps.iter().filter(meets);
            let low: DVec3 = near().map(|b| b.height.min(DVec3::ZERO)).sum();
            let high: DVec3 = near().map(|b| b.height.max(DVec3::ZERO)).sum();
            least = least.min(low);
            most = most.max(high);
        }
        [least, most]
    }

    fn smooth_at(&self, q: DVec3, p: &[f64; MAX_PARAM_FLOATS]) -> DVec3 {
        let [one, x, y, z] = self.polynomial;
        let c = q - 0.5;
        let mut sum = one + x * c.x + y * c.y + z * c.z;
        for (center, coefficient) in self.centers.iter().zip(&self.coefficients) {
            sum += *coefficient * basis(center.distance_squared(q), p);
        }
        sum
    }
}

/// Coefficients so that the points have their displacements, with no part of the sum that the polynomial could hold.
fn solve(points: &[(DVec3, DVec3)], p: &[f64; MAX_PARAM_FLOATS]) -> Side {
    let centers: Vec<DVec3> = points.iter().map(|(at, _)| *at).collect();
    if centers.is_empty() {
        return Side {
            centers,
            coefficients: Vec::new(),
            polynomial: [DVec3::ZERO; 4],
            bumps: Vec::new(),
        };
    }
    let system = System::of(points, p);
    if let Some(exact) = system.solved(0.0).filter(|s| s.terms <= system.most) {
        return Side {
            centers,
            coefficients: exact.coefficients,
            polynomial: exact.polynomial,
            bumps: Vec::new(),
        };
    }
    // As the shader gets them, so that the bumps make up for the rounding too.
    let tamed = system.tamed();
    let rounded = |v: DVec3| v.as_vec3().as_dvec3();
    let mut side = Side {
        centers: centers.into_iter().map(rounded).collect(),
        coefficients: tamed.coefficients.into_iter().map(rounded).collect(),
        polynomial: tamed.polynomial.map(rounded),
        bumps: Vec::new(),
    };
    side.bumps = bumps(points, &side, p);
    side
}

/// What is left of the displacements at the points, each with the way to the next point.
fn bumps(points: &[(DVec3, DVec3)], side: &Side, p: &[f64; MAX_PARAM_FLOATS]) -> Vec<Bump> {
    let each = points.iter().enumerate().map(|(i, (at, shift))| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != i);
        let ways = others.map(|(_, (other, _))| other.distance(*at));
        Bump {
            center: *at,
            radius: ways.fold(1.0, f64::min),
            height: *shift - side.smooth_at(*at, p),
        }
    });
    each.collect()
}

/// The equations of one side.
struct System<'a> {
    points: &'a [(DVec3, DVec3)],
    /// Basis of each point at each point, by rows, scaled so that none is above 1.
    basis: Vec<f64>,
    /// The same at the corners of the box, where a basis that grows is largest, by rows.
    at_corners: Vec<f64>,
    /// What the basis was divided by.
    scale: f64,
    /// About this, in this unit, the linear part is solved.
    middle: DVec3,
    radius: f64,
    grows: bool,
    /// How large the terms may be.
    most: f64,
}

struct Solution {
    coefficients: Vec<DVec3>,
    /// For 1, x, y, z about the middle of the box.
    polynomial: [DVec3; 4],
    /// Greatest sum of the sizes of the terms at a point or a corner.
    terms: f64,
}

impl<'a> System<'a> {
    fn of(points: &'a [(DVec3, DVec3)], p: &[f64; MAX_PARAM_FLOATS]) -> Self {
        let n = points.len();
        let places = || points.iter().map(|(at, _)| *at);
        let middle = places().sum::<DVec3>() / n as f64;
        let farthest = places().map(|at| at.distance(middle)).fold(0.0, f64::max);
        let corners = (0..8u32).map(|i| {
            let corner = [1, 2, 4].map(|bit| f64::from(u8::from(i & bit != 0)));
            flattened(DVec3::from_array(corner), p)
        });
        let all = |from: DVec3| places().map(move |at| basis(at.distance_squared(from), p));
        let mut at_points: Vec<f64> = places().flat_map(all).collect();
        let mut at_corners: Vec<f64> = corners.flat_map(all).collect();
        let scale = at_points.iter().copied().fold(0.0, f64::max);
        at_points.iter_mut().for_each(|value| *value /= scale);
        at_corners.iter_mut().for_each(|value| *value /= scale);
        let most = match exponent(p[2]).abs() {
            0.5 => MOST_ROOTS,
            _ => MOST_POWERS,
        };
        Self {
            points,
            basis: at_points,
            at_corners,
            scale,
            middle,
            radius: if farthest > 1e-9 { farthest } else { 1.0 },
            grows: p[2] > 0.0,
            most: most / p[0].max(1.0),
        }
    }

    /// The coefficients when their squares count `ridge` against what is missed; `None` if there are none.
    fn solved(&self, ridge: f64) -> Option<Solution> {
        let n = self.points.len();
        let size = n + 4;
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![DVec3::ZERO; size];
        for (i, (at, shift)) in self.points.iter().enumerate() {
            matrix[i * size..][..n].copy_from_slice(&self.basis[i * n..][..n]);
            // Conditionally definite the other way round where the basis grows.
            matrix[i * size + i] += if self.grows { -ridge } else { ridge };
            let c = (*at - self.middle) / self.radius;
            for (k, term) in [1.0, c.x, c.y, c.z].into_iter().enumerate() {
                matrix[i * size + n + k] = term;
                matrix[(n + k) * size + i] = term;
            }
            right[i] = *shift;
        }
        // A slope that nothing asks for is 0.
        for k in n + 1..size {
            matrix[k * size + k] = -1e-9;
        }
        let mut found = Solver::new(&matrix, size)?.solve(&right);
        let sizes = || found.iter().take(n).map(|a| a.length());
        let places = self.basis.chunks_exact(n);
        let sums = places
            .chain(self.at_corners.chunks_exact(n))
            .map(|row| row.iter().zip(sizes()).map(|(basis, a)| basis * a).sum());
        let terms: f64 = sums.fold(0.0, f64::max);
        if !terms.is_finite() {
            return None;
        }
        let slopes = [1, 2, 3].map(|k| found[n + k] / self.radius);
        let c = DVec3::splat(0.5) - self.middle;
        let one = found[n] + slopes[0] * c.x + slopes[1] * c.y + slopes[2] * c.z;
        found.truncate(n);
        found.iter_mut().for_each(|a| *a /= self.scale);
        Some(Solution {
            coefficients: found,
            polynomial: [one, slopes[0], slopes[1], slopes[2]],
            terms,
        })
    }

    /// The solution that misses least of those whose terms are small enough.
    fn tamed(&self) -> Solution {
        let mut range = RIDGE.map(f64::ln);
        let mut best = None;
        for _ in 0..RIDGE_TURNS {
            let middle = 0.5 * (range[0] + range[1]);
            match self.solved(middle.exp()).filter(|s| s.terms <= self.most) {
                Some(solution) => {
                    best = Some(solution);
                    range[1] = middle;
                }
                None => range[0] = middle,
            }
        }
        // Nothing but bumps, where no weight is enough.
        best.unwrap_or_else(|| Solution {
            coefficients: vec![DVec3::ZERO; self.points.len()],
            polynomial: [DVec3::ZERO; 4],
            terms: 0.0,
        })
    }
}

/// True right of a cut; without a cut everything is left of it.
fn is_right_of(cut: &[[DVec2; 2]], q: DVec3) -> bool {
    !cut.is_empty() && distance_to_cut(cut, q.truncate()) < 0.0
}

/// Signed distance to the cut, whose first and last pieces go on straight: above 0 on its left.
fn distance_to_cut(cut: &[[DVec2; 2]], p: DVec2) -> f64 {
    let (mut nearest, mut across) = (f64::INFINITY, 0.0_f64);
    for (i, [a, b]) in cut.iter().enumerate() {
        let along = *b - *a;
        let t = (p - *a).dot(along) / along.length_squared();
        let perpendicular = along.perp_dot(p - *a) / along.length();
        let distance = if t < 0.0 && i > 0 {
            p.distance(*a)
        } else if t > 1.0 && i + 1 < cut.len() {
            p.distance(*b)
        } else {
            perpendicular.abs()
        };
        // Two pieces that share the nearest place: the one that the point lies more to the side of says which side.
        if distance < nearest || (distance == nearest && perpendicular.abs() > across.abs()) {
            nearest = distance;
            across = perpendicular;
        }
    }
    nearest.copysign(across)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_have_their_displacements() {
        let p = [1.0, 0.2, -0.5, 0.0, 0.3, 0.0, 0.0, 0.0];
        let points: Vec<(DVec3, DVec3)> = (0..20)
            .map(|i| {
                let at = |k: usize| ((i * k) % 19) as f64 / 19.0;
                let at = DVec3::new(at(7), at(5), at(3));
                (at, DVec3::new(0.1 * at.y, -0.2 * at.x * at.z, 0.05))
            })
            .collect();
        for exponent in [-0.5, 0.5, -1.0, 0.9] {
            let mut p = p;
            p[2] = exponent;
            let side = solve(&points, &p);
            for (at, shift) in &points {
                let got = side.at(*at, &p);
                assert!(got.distance(*shift) < 1e-6, "{exponent}: {got} for {shift}");
            }
        }
    }

    #[test]
    fn few_points_and_points_in_a_plane_are_solved() {
        let p = [1.0, 0.2, -0.5, 0.0, 0.3, 0.0, 0.0, 0.0];
        let up = DVec3::Z * 0.1;
        for n in 1..6 {
            let points: Vec<(DVec3, DVec3)> = (0..n)
                .map(|i| (DVec3::new(0.1 + 0.15 * f64::from(i), 0.4, 0.5), up))
                .collect();
            let side = solve(&points, &p);
            assert!(
                side.at(DVec3::splat(0.5), &p).distance(up) < 1e-6,
                "{n} points"
            );
        }
    }

    #[test]
    fn a_cut_has_two_sides_wherever_one_stands() {
        let cut = [
            [DVec2::new(0.2, 0.5), DVec2::new(0.5, 0.5)],
            [DVec2::new(0.5, 0.5), DVec2::new(0.6, 0.9)],
        ];
        let side = |x: f64, y: f64| distance_to_cut(&cut, DVec2::new(x, y));
        assert!(
            (side(-1.0, 0.6) - 0.1).abs() < 1e-12,
            "goes on at its start"
        );
        assert!(side(-1.0, 0.4) < 0.0);
        assert!(
            side(1.3, 3.0) < 0.0 && side(0.9, 3.0) > 0.0,
            "and at its end"
        );
        assert!(side(0.52, 0.4) < 0.0, "beyond the outer side of a corner");
        assert!(side(0.48, 0.55) > 0.0);
    }
}
