//! A plain f64 reading of `rbf` (spec/templates.md; Correa, eq. 4.32 to 4.36), in the words of the source: the basis is
//! not scaled, the polynomial is about the origin, and the system is solved as it stands there.

use glam::{DVec2, DVec3};

/// What a document says of an rbf, ranges applied.
#[derive(Clone, Debug)]
pub(crate) struct Rbf {
    /// Where, and the inverse displacement there.
    pub(crate) points: Vec<(DVec3, DVec3)>,
    pub(crate) softness: f64,
    pub(crate) exponent: f64,
    pub(crate) strength: f64,
    pub(crate) extrude: bool,
    pub(crate) falloff: f64,
    pub(crate) edge: f64,
    pub(crate) cut: Vec<DVec2>,
}

fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Rbf {
    /// Source point and continuity of the point `q` of template space: `source(q)` and `A(q)`.
    pub(crate) fn source(&self, q: DVec3) -> (DVec3, f64) {
        if q.cmplt(DVec3::ZERO).any() || q.cmpgt(DVec3::ONE).any() {
            return (q, 1.0);
        }
        let has_cut = self.cut.len() > 1;
        let side = self.is_left(q.truncate());
        let own: Vec<(DVec3, DVec3)> = self
            .points
            .iter()
            .filter(|(at, _)| !has_cut || self.is_left(at.truncate()) == side)
            .map(|(at, shift)| (self.flat(*at), *shift))
            .collect();
        let mut weight = self.strength;
        if self.extrude && self.falloff > 0.0 {
            let start = (1.0 - self.falloff) / 2.0;
            weight *= 1.0 - smoothstep(((q.z - 0.5).abs() - start) / (0.5 - start));
        }
        if self.edge > 0.0 {
            for x in q.to_array() {
                weight *= smoothstep(x.min(1.0 - x) / self.edge);
            }
        }
        let shift = self.interpolated(&own, self.flat(q)) * weight;
        let source = q + shift;
        if !has_cut || shift.length() < 1e-6 {
            return (source, 1.0);
        }
        // Equation 4.36 says 1 or 0; here its sign, and how far the cut is.
        let is_same = self.is_left(source.truncate()) == side;
        let away = self.distance(source.truncate());
        (source, if is_same { away } else { -away })
    }

    fn flat(&self, q: DVec3) -> DVec3 {
        if self.extrude {
            DVec3::new(q.x, q.y, 0.0)
        } else {
            q
        }
    }

    fn interpolated(&self, points: &[(DVec3, DVec3)], q: DVec3) -> DVec3 {
        let n = points.len();
        if n == 0 {
            return DVec3::ZERO;
        }
        let g = |d2: f64| (d2 + self.softness * self.softness).powf(self.exponent);
        let terms = |p: DVec3| -> Vec<f64> {
            if self.extrude {
                vec![1.0, p.x, p.y]
            } else {
                vec![1.0, p.x, p.y, p.z]
            }
        };
        let m = terms(q).len();
        // Rows: the interpolation at each point, then the side conditions.
        let mut rows = vec![vec![0.0; n + m + 3]; n + m];
        for i in 0..n {
            for j in 0..n {
                rows[i][j] = g(points[i].0.distance_squared(points[j].0));
            }
            for (k, term) in terms(points[i].0).into_iter().enumerate() {
                rows[i][n + k] = term;
                rows[n + k][i] = term;
            }
            for axis in 0..3 {
                rows[i][n + m + axis] = points[i].1[axis];
            }
        }
        for column in 0..n + m {
            let best = (column..n + m)
                .max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))
                .expect("a row");
            rows.swap(column, best);
            let pivot = rows[column].clone();
            assert!(
                pivot[column].abs() > 1e-12,
                "the points determine the polynomial"
            );
            for (i, row) in rows.iter_mut().enumerate() {
                if i != column {
                    let factor = row[column] / pivot[column];
                    for (value, above) in row.iter_mut().zip(&pivot) {
                        *value -= factor * above;
                    }
                }
            }
        }
        let solved = |i: usize, axis: usize| rows[i][n + m + axis] / rows[i][i];
        DVec3::from_array([0, 1, 2].map(|axis| {
            let radial: f64 = (0..n)
                .map(|i| solved(i, axis) * g(q.distance_squared(points[i].0)))
                .sum();
            let linear: f64 = terms(q)
                .into_iter()
                .enumerate()
                .map(|(k, term)| solved(n + k, axis) * term)
                .sum();
            radial + linear
        }))
    }

    /// The line with its two ends made very long.
    fn line(&self) -> Vec<DVec2> {
        let mut line = self.cut.clone();
        let n = line.len();
        let start = (line[0] - line[1]).normalize();
        let end = (line[n - 1] - line[n - 2]).normalize();
        line[0] += start * 1e3;
        line[n - 1] += end * 1e3;
        line
    }

    fn distance(&self, p: DVec2) -> f64 {
        let line = self.line();
        let pieces = line.windows(2);
        let each = pieces.map(|pair| {
            let along = pair[1] - pair[0];
            let t = ((p - pair[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            p.distance(pair[0] + along * t)
        });
        each.fold(f64::INFINITY, f64::min)
    }

    /// By how often a way from far out on the left crosses the line.
    pub(crate) fn is_left(&self, p: DVec2) -> bool {
        if self.cut.len() < 2 {
            return true;
        }
        let line = self.line();
        let first = line[1] - line[0];
        let far = line[0] + first * 0.25 + first.perp().normalize() * 1e4;
        let cross = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) > 0.0;
        let crossings = line.windows(2).filter(|pair| {
            cross(far, p, pair[0]) != cross(far, p, pair[1])
                && cross(pair[0], pair[1], far) != cross(pair[0], pair[1], p)
        });
        crossings.count() % 2 == 0
    }
}
