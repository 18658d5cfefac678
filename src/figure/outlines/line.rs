use glam::{DVec2, dvec2};

/// Points of outlines lie on a grid this fine (parts of a pixel), so that tests of their order are exact.
const GRID: f64 = 1024.0;
/// Largest part of a pixel, times its length, by which a line may change the area to its sides.
const MAX_SHIFT: f64 = 0.7;
/// `smooth` up to which areas are kept, pixels.
const MAX_KEPT_SMOOTH: f64 = 2.0;

/// How far a line is smoothed and simplified, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Finish {
    /// Standard deviation of the Gaussian along the line.
    pub(crate) smooth: f64,
    /// Points may lie this far from the line.
    pub(crate) tolerance: f64,
}

/// The corners of pixels along a line without those between two steps in the same direction.
pub(crate) fn corners(points: &[[u16; 2]], is_closed: bool) -> Vec<DVec2> {
    let n = points.len();
    let at = |i: usize| dvec2(f64::from(points[i][0]), f64::from(points[i][1]));
    let is_straight =
        |before: usize, i: usize, after: usize| at(i) - at(before) == at(after) - at(i);
    let mut kept: Vec<DVec2> = (1..n - 1)
        .filter(|i| !is_straight(i - 1, *i, i + 1))
        .map(at)
        .collect();
    if is_closed {
        // A closed line begins at its upper left corner, which is one; its last point is its first.
        kept.insert(0, at(0));
    } else {
        kept.insert(0, at(0));
        kept.push(at(n - 1));
    }
    kept
}

/// A line of steps along pixels, smoothed and simplified: its points, of a closed one without the first again. None if
/// too little is left of it, or areas to its sides would change too much.
pub(crate) fn finished(
    points: &[[u16; 2]],
    is_closed: bool,
    finish: Finish,
    keeps_area: bool,
) -> Option<Vec<DVec2>> {
    let smooth = smoothed(points, is_closed, finish.smooth);
    let is_loop = points.first() == points.last();
    let mut line = if is_loop {
        // A loop is simplified in two halves, between its first point and the one that is furthest from it.
        let distance = |i: &usize| smooth[*i].distance_squared(smooth[0]);
        let far = (0..smooth.len())
            .rev()
            .max_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let mut line = simplified(&smooth[..=far], finish.tolerance);
        line.pop();
        line.extend(simplified(&smooth[far..], finish.tolerance));
        line
    } else {
        simplified(&smooth, finish.tolerance)
    };
    let before = shoelace(
        points
            .iter()
            .map(|p| dvec2(f64::from(p[0]), f64::from(p[1]))),
    );
    let after = shoelace(line.iter().copied());
    if is_loop && (line.len() < 4 || before * after <= 0.0) {
        return None;
    }
    let length: f64 = line.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
    if keeps_area && finish.smooth <= MAX_KEPT_SMOOTH && (before - after).abs() > MAX_SHIFT * length
    {
        return None;
    }
    if is_closed {
        line.pop();
    }
    Some(line)
}

/// Area between a line and the chord of its ends, pixels: positive if it goes around clockwise on the screen.
fn shoelace(points: impl Iterator<Item = DVec2>) -> f64 {
    let mut points = points.peekable();
    let Some(first) = points.peek().copied() else {
        return 0.0;
    };
    let mut before = first;
    let mut sum = 0.0;
    for point in points {
        sum += (before - first).perp_dot(point - first);
        before = point;
    }
    sum / 2.0
}

/// A line convolved with a Gaussian, its ends kept: beyond an end it goes on as its mirror image in that point.
fn smoothed(points: &[[u16; 2]], is_closed: bool, sigma: f64) -> Vec<DVec2> {
    let at = |i: usize| dvec2(f64::from(points[i][0]), f64::from(points[i][1]));
    let n = points.len() - 1;
    if sigma <= 0.0 {
        return (0..=n).map(at).collect();
    }
    let (n_signed, drift) = (n as isize, 2.0 * (at(n) - at(0)));
    let extended = |i: isize| {
        if is_closed {
            return at(i.rem_euclid(n_signed) as usize);
        }
        let (period, rest) = (i.div_euclid(2 * n_signed), i.rem_euclid(2 * n_signed));
        let inside = if rest <= n_signed {
            at(rest as usize)
        } else {
            2.0 * at(n) - at((2 * n_signed - rest) as usize)
        };
        inside + period as f64 * drift
    };
    let half = (3.0 * sigma).ceil() as isize;
    let weight = |k: isize| libm::exp(-0.5 * (k as f64 / sigma) * (k as f64 / sigma));
    let weights: Vec<f64> = (0..=half).map(weight).collect();
    let total = 2.0 * weights.iter().sum::<f64>() - weights[0];
    let smooth = |i: usize| {
        if !is_closed && (i == 0 || i == n) {
            return at(i);
        }
        let i = i as isize;
        let mut sum = weights[0] * extended(i);
        for (k, weight) in (1..).zip(&weights[1..]) {
            sum += *weight * (extended(i - k) + extended(i + k));
        }
        (sum / total * GRID).round() / GRID
    };
    (0..=n).map(smooth).collect()
}

/// Douglas and Peucker's choice of points: none that is left out is further than `tolerance` from the line.
fn simplified(points: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let last = points.len() - 1;
    let mut is_kept = vec![false; points.len()];
    is_kept[0] = true;
    is_kept[last] = true;
    let mut stack = vec![(0, last)];
    while let Some((from, to)) = stack.pop() {
        let mut furthest = None;
        let mut most = tolerance * tolerance;
        for i in from + 1..to {
            let distance = distance_squared(points[i], points[from], points[to]);
            if distance > most {
                most = distance;
                furthest = Some(i);
            }
        }
        if let Some(i) = furthest {
            is_kept[i] = true;
            stack.push((from, i));
            stack.push((i, to));
        }
    }
    let kept = points.iter().zip(&is_kept).filter(|(_, kept)| **kept);
    kept.map(|(point, _)| *point).collect()
}

/// Square of a point's distance from a segment.
pub(crate) fn distance_squared(p: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let length = along.length_squared();
    let part = if length > 0.0 {
        ((p - from).dot(along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance_squared(from + part * along)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINISH: Finish = Finish {
        smooth: 1.5,
        tolerance: 0.75,
    };

    #[test]
    fn a_staircase_becomes_a_straight_line() {
        let stairs: Vec<[u16; 2]> = (0..41).map(|i| [u16::div_ceil(i, 2), i / 2]).collect();
        let line = finished(&stairs, false, FINISH, true).expect("a line");
        assert_eq!(line, [dvec2(0.0, 0.0), dvec2(20.0, 20.0)], "ends only");
        assert_eq!(corners(&stairs, false).len(), 41, "each step has a corner");
    }

    #[test]
    fn a_pixel_is_not_smoothed_away() {
        let pixel = [[3, 3], [4, 3], [4, 4], [3, 4], [3, 3]];
        assert_eq!(
            finished(&pixel, true, FINISH, true),
            None,
            "nothing would be left"
        );
        assert_eq!(corners(&pixel, true).len(), 4, "its own corners");
    }

    #[test]
    fn smoothing_keeps_ends() {
        let hook: Vec<[u16; 2]> = vec![[0, 5], [1, 5], [1, 6], [1, 7], [2, 7], [3, 7]];
        for sigma in [0.5, 2.0, 32.0] {
            let line = smoothed(&hook, false, sigma);
            assert_eq!(line[0], dvec2(0.0, 5.0), "first, {sigma}");
            assert_eq!(line[5], dvec2(3.0, 7.0), "last, {sigma}");
            assert!(
                line.iter().all(|p| p.x >= 0.0),
                "inside the picture, {sigma}"
            );
        }
    }
}
