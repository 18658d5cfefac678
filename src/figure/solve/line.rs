use glam::DVec2;

use crate::figure::complex::{arg, continued, div, mul, polar};

/// The least scale along a line.
const LEAST_SCALE: f64 = 0.05;

/// Where a vertex goes, and the turn and log scale that it has there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Target {
    pub(crate) place: DVec2,
    pub(crate) turn: f64,
    pub(crate) log_scale: f64,
}

/// A line and where its points go (spec/figures.md, "Line").
pub(crate) struct BentLine {
    points: Vec<DVec2>,
    to: Vec<DVec2>,
    /// Per point the logarithm of turn and scale: log scale and turn.
    logs: Vec<DVec2>,
}

impl BentLine {
    /// A line of at least one point; points equal to the one before are left out, with their partners.
    pub(crate) fn new(points: &[DVec2], to: &[DVec2]) -> Self {
        let mut line = Self {
            points: Vec::new(),
            to: Vec::new(),
            logs: Vec::new(),
        };
        for (point, to) in points.iter().zip(to) {
            if line.points.last() != Some(point) {
                line.points.push(*point);
                line.to.push(*to);
            }
        }
        let mut angle = None;
        let mut of_segments = Vec::new();
        for i in 1..line.points.len() {
            let ratio = div(
                line.to[i] - line.to[i - 1],
                line.points[i] - line.points[i - 1],
            );
            let turn = angle.map_or(arg(ratio), |before| continued(arg(ratio), before));
            angle = Some(turn);
            of_segments.push(DVec2::new(libm::log(ratio.length().max(LEAST_SCALE)), turn));
        }
        let n = line.points.len();
        line.logs = (0..n)
            .map(|i| {
                match (
                    i.checked_sub(1).and_then(|k| of_segments.get(k)),
                    of_segments.get(i),
                ) {
                    (Some(before), Some(after)) => (*before + *after) / 2.0,
                    (Some(one), None) | (None, Some(one)) => *one,
                    (None, None) => DVec2::ZERO,
                }
            })
            .collect();
        line
    }

    /// Where the line takes a vertex.
    pub(crate) fn target(&self, vertex: DVec2) -> Target {
        let mut least = f64::INFINITY;
        let mut found = (0, 0.0);
        for i in 1..self.points.len() {
            let part = part_of_segment(vertex, self.points[i - 1], self.points[i]);
            let nearest = self.points[i - 1] + part * (self.points[i] - self.points[i - 1]);
            let distance = nearest.distance_squared(vertex);
            if distance < least {
                least = distance;
                found = (i - 1, part);
            }
        }
        let (i, part) = found;
        let next = (i + 1).min(self.points.len() - 1);
        let along = |list: &[DVec2]| list[i] + part * (list[next] - list[i]);
        let log = along(&self.logs);
        let ratio = polar(libm::exp(log.x), log.y);
        Target {
            place: along(&self.to) + mul(ratio, vertex - along(&self.points)),
            turn: log.y,
            log_scale: log.x,
        }
    }
}

/// How far along a segment the place nearest to a point lies, 0 to 1.
fn part_of_segment(p: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let length = along.length_squared();
    if length > 0.0 {
        ((p - from).dot(along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Square of the distance of a place from a line of at least one point.
pub(crate) fn distance_squared_to_line(p: DVec2, points: &[DVec2]) -> f64 {
    let to_segment = |ends: &[DVec2]| {
        p.distance_squared(ends[0] + part_of_segment(p, ends[0], ends[1]) * (ends[1] - ends[0]))
    };
    points
        .windows(2)
        .map(to_segment)
        .fold(p.distance_squared(points[0]), f64::min)
}

/// Whether a line has a point in a triangle or on its edge.
pub(crate) fn meets_triangle(points: &[DVec2], corners: [DVec2; 3]) -> bool {
    let meets = |ends: &[DVec2]| {
        // What is left of the segment inside each of the edges' half planes.
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for i in 0..3 {
            let (a, edge) = (corners[i], corners[(i + 1) % 3] - corners[i]);
            let (from, to) = (edge.perp_dot(ends[0] - a), edge.perp_dot(ends[1] - a));
            if from < 0.0 && to < 0.0 {
                return false;
            }
            if from < 0.0 {
                first = first.max(from / (from - to));
            } else if to < 0.0 {
                last = last.min(from / (from - to));
            }
        }
        first <= last
    };
    points.windows(2).any(meets)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn a_line_bent_as_a_whole_is_a_similarity() {
        let points = [
            dvec2(0.0, 0.0),
            dvec2(0.1, 0.0),
            dvec2(0.1, 0.0),
            dvec2(0.2, 0.1),
        ];
        let z = polar(1.3, 2.5);
        let to = points.map(|p| dvec2(0.3, 0.2) + mul(z, p));
        let line = BentLine::new(&points, &to);
        for vertex in [
            dvec2(0.05, 0.02),
            dvec2(-0.1, 0.0),
            dvec2(0.3, 0.3),
            dvec2(0.1, -0.1),
        ] {
            let target = line.target(vertex);
            assert!(
                (target.place - dvec2(0.3, 0.2) - mul(z, vertex)).length() < 1e-12,
                "{vertex}"
            );
            assert!(
                (target.turn - 2.5).abs() < 1e-12
                    && (target.log_scale - libm::log(1.3)).abs() < 1e-12,
                "{vertex}"
            );
        }
    }

    #[test]
    fn angles_go_on_along_a_line() {
        // A line that is rolled up by 0.9 at each of its points, more than half a turn in all.
        let points: Vec<DVec2> = (0..8).map(|i| dvec2(f64::from(i) * 0.1, 0.0)).collect();
        let mut to = vec![DVec2::ZERO];
        for i in 0..7 {
            to.push(to[to.len() - 1] + polar(0.1, 0.9 * f64::from(i)));
        }
        let line = BentLine::new(&points, &to);
        assert!(
            (line.target(points[7]).turn - 5.4).abs() < 1e-12,
            "the last segment's turn"
        );
        assert!(
            (line.target(points[3]).turn - 2.25).abs() < 1e-12,
            "an inner point's is the mean"
        );
    }

    #[test]
    fn a_triangle_is_met_by_what_crosses_it() {
        let corners = [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(0.0, 1.0)];
        assert!(
            meets_triangle(&[dvec2(-1.0, 0.3), dvec2(2.0, 0.3)], corners),
            "across"
        );
        assert!(
            meets_triangle(&[dvec2(0.2, 0.2), dvec2(0.3, 0.3)], corners),
            "inside"
        );
        assert!(
            !meets_triangle(&[dvec2(1.0, 1.0), dvec2(2.0, 0.1)], corners),
            "beside"
        );
        assert!(
            !meets_triangle(
                &[dvec2(-1.0, 1.5), dvec2(0.5, 0.9), dvec2(2.0, 3.0)],
                corners
            ),
            "around a corner"
        );
    }
}
