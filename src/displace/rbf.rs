use super::facts::{Amount, Facts, Given, Grip, Group, Holds, Icon, Mirror, Reach, Shape};
use super::points::{ControlPoint, ControlPoints};
use super::spec::{MAX_PARAM_FLOATS, ParamKind, ParamSpec, TemplateSpec, number};
use crate::math::Aabb;
use glam::{DVec2, DVec3, Vec3};

/// All that is known about rbf besides its formula. Its control points have handles of their own.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "rbf",
        summary: "Displacements at control points, interpolated",
        params: &[
            number("strength", "Times the displacements", 1.0, 0.0, 2.0),
            number(
                "softness",
                "Reach of a control point, fractions of the box",
                0.2,
                0.01,
                2.0,
            ),
            number(
                "exponent",
                "Of the multiquadric; -0.5 is smooth and local",
                -0.5,
                -2.0,
                0.9,
            ),
            ParamSpec {
                name: "extrude",
                summary: "Control points count in x and y alone, for every z",
                kind: ParamKind::Flag { default: false },
            },
            number(
                "falloff",
                "0 extrudes through the whole box, 1 falls off from its middle on",
                0.3,
                0.0,
                1.0,
            ),
            number(
                "edge",
                "Width over which it ends at the faces of the box",
                0.0,
                0.0,
                0.5,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Points,
    amount: Amount::Parameters,
    reach: |given| {
        let [least, most] = Interpolant::of(given).shift();
        if least == Vec3::ZERO && most == Vec3::ZERO {
            return Reach::NONE;
        }
        let has_cut = given
            .points
            .as_ref()
            .is_some_and(|points| points.cut.len() > 1);
        // The map is smooth as far as the points' reach goes; across a cut differences say nothing.
        let detail = if has_cut {
            0.0
        } else {
            0.25 * given.p[1].clamp(0.05, 0.6)
        };
        // Forwards is the negative.
        let reach = Reach::shifted(Aabb::UNIT, -most, -least).with_detail(detail);
        if given.p[5] > 0.0 {
            reach
        } else {
            reach.torn()
        }
    },
    grip: Grip::None,
    // The top is drawn up to one side and down on the other.
    icon: Icon {
        points: &[
            point([0.0, 0.0, 0.0], [0.0, 0.0]),
            point([1.0, 0.0, 0.0], [0.0, 0.0]),
            point([0.0, 1.0, 0.0], [0.0, 0.0]),
            point([1.0, 1.0, 0.0], [0.0, 0.0]),
            point([0.3, 0.3, 0.8], [-0.1, -0.3]),
            point([0.75, 0.7, 0.8], [0.1, 0.2]),
        ],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 6)),
    shape: Shape::CUBE,
};

/// A control point with a shift in x and z.
const fn point(at: [f32; 3], [x, z]: [f32; 2]) -> ControlPoint {
    ControlPoint {
        at: Vec3::from_array(at),
        shift: Vec3::new(x, 0.0, z),
    }
}

/// A point that lies nearer than this to one before it is left out, template units: two different displacements at one
/// place have no smooth interpolant.
const NEAREST: f64 = 1e-3;
/// The coefficients of one side are kept below this in sum, so that 32-bit floats hold the result to a few ten
/// thousandths: where points lie close for their softness, the interpolant passes them by a hair instead.
const LARGEST_SUM: f64 = 4000.0;

/// One side of the cut: coefficients for its points and for 1, x, y, z about the middle of the box.
struct Side {
    centers: Vec<DVec3>,
    coefficients: Vec<DVec3>,
    polynomial: [DVec3; 4],
}

/// The solved interpolant. Source: Correa, eq. 4.32 to 4.36.
///
/// Differs from the source: the basis is scaled to 1 at its centre (the same functions with other coefficients); the
/// linear part is the one of least slope where the points do not determine it (all in a plane, say).
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
            let is_right = !cut.is_empty() && distance_to_cut(&cut, at.truncate()) < 0.0;
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
        let count = |i: usize| self.sides.get(i).map_or(0.0, |s| s.centers.len() as f32);
        let mut out = vec![[count(0), count(1), self.cut.len() as f32, 0.0]];
        for side in &self.sides {
            out.extend(side.polynomial.map(quad));
            for (center, coefficient) in side.centers.iter().zip(&side.coefficients) {
                out.extend([quad(*center), quad(*coefficient)]);
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
        !self.cut.is_empty() && distance_to_cut(&self.cut, q.truncate()) < 0.0
    }

    /// As the shader has it, for one side.
    fn displacement(&self, side: usize, q: DVec3) -> DVec3 {
        let q = q.clamp(DVec3::ZERO, DVec3::ONE);
        let edge = self.p[5];
        let mut weight = self.p[0];
        if edge > 0.0 {
            for x in q.to_array() {
                let t = (x.min(1.0 - x) / edge).clamp(0.0, 1.0);
                weight *= t * t * (3.0 - 2.0 * t);
            }
        }
        self.sides.get(side).map_or(DVec3::ZERO, |s| {
            s.at(flattened(q, &self.p), &self.p) * weight
        })
    }

    /// Bounds of the displacement in the box: looked at on a grid, widened by what may lie between.
    fn shift(&self) -> [Vec3; 2] {
        const N: usize = 6;
        const STRIDES: [usize; 3] = [1, N + 1, (N + 1) * (N + 1)];
        let (mut least, mut most, mut steepest) = (DVec3::ZERO, DVec3::ZERO, 0.0_f64);
        for side in &self.sides {
            let place = |i: usize| STRIDES.map(|stride| i / stride % (N + 1));
            let all: Vec<DVec3> = (0..STRIDES[2] * (N + 1))
                .map(|i| {
                    let q = DVec3::from_array(place(i).map(|k| k as f64 / N as f64));
                    side.at(flattened(q, &self.p), &self.p) * self.p[0]
                })
                .collect();
            for (i, d) in all.iter().enumerate() {
                least = least.min(*d);
                most = most.max(*d);
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

/// The basis at a squared distance, 1 at its centre.
fn basis(d2: f64, p: &[f64; MAX_PARAM_FLOATS]) -> f64 {
    libm::pow(d2 / (p[1] * p[1]) + 1.0, exponent(p[2]))
}

/// An exponent of 0 is a constant, which interpolates nothing.
fn exponent(given: f64) -> f64 {
    if given.abs() < 0.05 { -0.05 } else { given }
}

impl Side {
    fn at(&self, q: DVec3, p: &[f64; MAX_PARAM_FLOATS]) -> DVec3 {
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
    let n = centers.len();
    let none = Side {
        centers: Vec::new(),
        coefficients: Vec::new(),
        polynomial: [DVec3::ZERO; 4],
    };
    if n == 0 {
        return none;
    }
    let middle = centers.iter().sum::<DVec3>() / n as f64;
    let size = n + 4;
    let mut ridge = 0.0;
    for _ in 0..14 {
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![DVec3::ZERO; size];
        for (i, (at, shift)) in points.iter().enumerate() {
            for (j, other) in centers.iter().enumerate() {
                matrix[i * size + j] = basis(at.distance_squared(*other), p);
            }
            // Conditionally definite the other way round for a positive exponent.
            matrix[i * size + i] += if p[2] > 0.0 { -ridge } else { ridge };
            let c = *at - middle;
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
        let solved = eliminate(&mut matrix, &mut right);
        let sum: f64 = right.iter().take(n).map(|a| a.length()).sum();
        if solved && sum.is_finite() && sum <= LARGEST_SUM {
            let [one, x, y, z] = [right[n], right[n + 1], right[n + 2], right[n + 3]];
            let c = DVec3::splat(0.5) - middle;
            right.truncate(n);
            return Side {
                centers,
                coefficients: right,
                polynomial: [one + x * c.x + y * c.y + z * c.z, x, y, z],
            };
        }
        ridge = if ridge == 0.0 { 1e-12 } else { 10.0 * ridge };
    }
    none
}

/// Gauss with the largest pivot of each column. False if there is none.
fn eliminate(matrix: &mut [f64], right: &mut [DVec3]) -> bool {
    let n = right.len();
    for column in 0..n {
        let best = (column..n)
            .max_by(|a, b| {
                let size = |row: usize| matrix[row * n + column].abs();
                size(*a).total_cmp(&size(*b))
            })
            .unwrap_or(column);
        if matrix[best * n + column].abs() < 1e-300 {
            return false;
        }
        if best != column {
            for k in 0..n {
                matrix.swap(best * n + k, column * n + k);
            }
            right.swap(best, column);
        }
        for row in column + 1..n {
            let factor = matrix[row * n + column] / matrix[column * n + column];
            if factor != 0.0 {
                for k in column..n {
                    matrix[row * n + k] -= factor * matrix[column * n + k];
                }
                let above = right[column];
                right[row] -= factor * above;
            }
        }
    }
    for row in (0..n).rev() {
        for k in row + 1..n {
            let known = right[k];
            right[row] -= matrix[row * n + k] * known;
        }
        right[row] /= matrix[row * n + row];
    }
    true
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
