//! Polygons into triangles, by ear clipping in the plane of their normal.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

/// Corners of one polygon, at most: clipping its ears takes time with their square.
pub(crate) const MAX_CORNERS: usize = 10_000;

/// Newell's normal: twice the area of the polygon as a vector; of concave and crooked ones too.
fn newell(corners: &[DVec3]) -> DVec3 {
    let next = corners.iter().cycle().skip(1);
    let first = corners.first().copied().unwrap_or_default();
    // From the first corner, so that large coordinates do not cost digits.
    let pairs = corners.iter().zip(next);
    pairs.map(|(&a, &b)| (a - first).cross(b - first)).sum()
}

/// The polygon in the plane of its normal, turning to the left. All zero if it has no area.
fn flattened(corners: &[DVec3]) -> Vec<DVec2> {
    let normal = newell(corners).normalize_or_zero();
    let x_axis = normal.any_orthonormal_vector_or_zero();
    let y_axis = normal.cross(x_axis);
    let first = corners.first().copied().unwrap_or_default();
    let flat = corners.iter().map(|&p| p - first);
    flat.map(|p| DVec2::new(p.dot(x_axis), p.dot(y_axis)))
        .collect()
}

trait Orthonormal {
    fn any_orthonormal_vector_or_zero(self) -> DVec3;
}

impl Orthonormal for DVec3 {
    fn any_orthonormal_vector_or_zero(self) -> DVec3 {
        match self == DVec3::ZERO {
            true => DVec3::ZERO,
            false => self.any_orthonormal_vector(),
        }
    }
}

/// Twice the area of a triangle, positive if it turns to the left.
fn turn([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// True if a triangle that turns to the left holds a point, its border included. A point at one of the corners does not
/// count: polygons with a bridge pass there twice.
fn holds(triangle: [DVec2; 3], point: DVec2) -> bool {
    let [a, b, c] = triangle;
    point != a
        && point != b
        && point != c
        && turn([a, b, point]) >= 0.0
        && turn([b, c, point]) >= 0.0
        && turn([c, a, point]) >= 0.0
}

/// Cuts a polygon of three corners or more into triangles, each as three indices of corners, in the turn of the
/// polygon: of the corners that are left the first, in order, whose triangle turns with the polygon and holds no other
/// corner is cut off, and the search starts again; if there is none, the second is. `corners` may be in any space.
///
/// A corner that was found blocked is not looked at again until its neighbours change or what blocked it is cut off,
/// and then the search goes on behind that: the time grows with the square of the corners, whatever their places.
pub(crate) fn triangulate(corners: &[DVec3]) -> Vec<[usize; 3]> {
    let n = corners.len();
    let mut triangles = Vec::with_capacity(n.saturating_sub(2));
    if n < 3 {
        return triangles;
    }
    let flat = flattened(corners);
    let mut next: Vec<usize> = (1..n).chain([0]).collect();
    let mut before: Vec<usize> = [n - 1].into_iter().chain(0..n - 1).collect();
    // For each corner those that it blocks, and the one that blocks it (n: its neighbours are new).
    let mut blocks: Vec<Vec<usize>> = vec![Vec::new(); n];
    let mut blocked_by = vec![n; n];
    let mut left: BTreeSet<usize> = (0..n).collect();
    let mut is_left = vec![true; n];
    let mut open = left.clone();
    while left.len() > 3 {
        let mut ear = None;
        while let Some(corner) = open.pop_first() {
            let triangle = [before[corner], corner, next[corner]].map(|i| flat[i]);
            if turn(triangle) <= 0.0 {
                continue;
            }
            let mut other = match blocked_by[corner] {
                blocker if blocker < n => blocker,
                _ => next[next[corner]],
            };
            // What was cut off still tells who came next.
            while !is_left[other] || (other != before[corner] && !holds(triangle, flat[other])) {
                other = next[other];
            }
            if other == before[corner] {
                ear = Some(corner);
                break;
            }
            blocked_by[corner] = other;
            blocks[other].push(corner);
        }
        let Some(cut) = ear.or_else(|| left.iter().nth(1).copied()) else {
            break;
        };
        let (a, b) = (before[cut], next[cut]);
        triangles.push([a, cut, b]);
        left.remove(&cut);
        open.remove(&cut);
        is_left[cut] = false;
        (next[a], before[b]) = (b, a);
        for neighbour in [a, b] {
            blocked_by[neighbour] = n;
            open.insert(neighbour);
        }
        let freed = std::mem::take(&mut blocks[cut]);
        open.extend(
            freed
                .into_iter()
                .filter(|&corner| is_left[corner] && blocked_by[corner] == cut),
        );
    }
    if let Some(&first) = left.first() {
        triangles.push([first, next[first], before[first]]);
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(points: &[(f64, f64)]) -> Vec<DVec3> {
        // Tilted, far away and turned, so that no axis is special.
        let turn = glam::DQuat::from_rotation_x(0.7) * glam::DQuat::from_rotation_y(-1.1);
        let at = DVec3::new(100.0, -50.0, 20.0);
        let points = points.iter();
        points
            .map(|&(x, y)| turn * DVec3::new(x, y, 0.0) + at)
            .collect()
    }

    fn area(corners: &[DVec3], triangle: &[usize; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|i| corners[i]);
        (b - a).cross(c - a) * 0.5
    }

    /// Every triangle turns with the polygon, and together they have its area: nothing overlaps.
    #[track_caller]
    fn covers(corners: &[DVec3]) -> Vec<[usize; 3]> {
        let triangles = triangulate(corners);
        assert_eq!(triangles.len(), corners.len() - 2);
        let whole = newell(corners) * 0.5;
        let mut sum = 0.0;
        for triangle in &triangles {
            let area = area(corners, triangle);
            assert!(
                area.dot(whole) >= -1e-9,
                "{triangle:?} turns with the polygon"
            );
            sum += area.length();
        }
        assert!(
            (sum - whole.length()).abs() < 1e-9 * whole.length(),
            "{sum} of {}",
            whole.length()
        );
        triangles
    }

    #[test]
    fn convex_ones_are_cut_from_the_first_corner() {
        let square = flat(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(covers(&square), [[3, 0, 1], [1, 2, 3]]);
        let round: Vec<(f64, f64)> = (0..40).map(|i| (f64::from(i) * 0.157).sin_cos()).collect();
        covers(&flat(&round));
    }

    #[test]
    fn concave_ones_come_out_right_where_fans_do_not() {
        let arrow = [(0.0, 0.0), (4.0, 4.0), (0.0, 2.0), (-4.0, 4.0)];
        covers(&flat(&arrow));
        let comb: Vec<(f64, f64)> = (0..9)
            .map(|i| (f64::from(i), if i % 2 == 0 { 5.0 } else { 1.0 }))
            .chain([(8.0, 0.0), (0.0, 0.0)])
            .collect();
        let corners = flat(&comb);
        covers(&corners);
        let fan = (1..corners.len() - 1).map(|i| [0, i, i + 1]);
        let whole = newell(&corners);
        assert!(
            fan.clone()
                .any(|triangle| area(&corners, &triangle).dot(whole) < 0.0),
            "a fan would fold over"
        );
        let spiral: Vec<(f64, f64)> = (0..60)
            .map(|i| (f64::from(i) * 0.3, 1.0 + f64::from(i) * 0.1))
            .chain(
                (0..60)
                    .rev()
                    .map(|i| (f64::from(i) * 0.3, 0.9 + f64::from(i) * 0.1)),
            )
            .map(|(angle, radius)| (radius * angle.cos(), radius * angle.sin()))
            .collect();
        covers(&flat(&spiral));
    }

    #[test]
    fn a_hole_with_a_bridge_is_left_out() {
        let ring = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (0.0, 4.0),
            (0.0, 0.0),
            (1.0, 1.0),
            (1.0, 3.0),
            (3.0, 3.0),
            (3.0, 1.0),
            (1.0, 1.0),
        ];
        covers(&flat(&ring));
    }

    #[test]
    fn a_corner_in_line_is_no_ear() {
        let corners = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0)]);
        for triangle in covers(&corners) {
            assert!(area(&corners, &triangle).length() > 0.1, "{triangle:?}");
        }
    }

    /// The rule as it is written down, searching all corners anew for each ear.
    fn by_the_rule(corners: &[DVec3]) -> Vec<[usize; 3]> {
        let flat = flattened(corners);
        let mut left: Vec<usize> = (0..corners.len()).collect();
        let mut triangles = Vec::new();
        while left.len() > 3 {
            let n = left.len();
            let around = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
            let ear = (0..n).find(|&i| {
                let triangle = around(i).map(|c| flat[c]);
                let mut others = left.iter().filter(|c| !around(i).contains(c));
                turn(triangle) > 0.0 && !others.any(|&c| holds(triangle, flat[c]))
            });
            let cut = ear.unwrap_or(1);
            triangles.push(around(cut));
            left.remove(cut);
        }
        triangles.push([left[0], left[1], left[2]]);
        triangles
    }

    #[test]
    fn what_is_remembered_changes_nothing() {
        let mut state = 1u64;
        let mut random = |n: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 33) % n) as f64
        };
        for round in 0..500 {
            // On a small grid, so that corners lie in line, coincide and cross.
            let n = 4 + random(14) as usize;
            let side = 3 + round % 9;
            let points: Vec<(f64, f64)> = (0..n).map(|_| (random(side), random(side))).collect();
            let corners: Vec<DVec3> = points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect();
            assert_eq!(triangulate(&corners), by_the_rule(&corners), "{points:?}");
        }
    }

    #[test]
    fn ten_thousand_corners_take_no_longer_than_their_square() {
        // A comb with long teeth: nearly every corner is blocked by many others.
        let n = MAX_CORNERS;
        let comb: Vec<DVec3> = (0..n)
            .map(|i| {
                DVec3::new(
                    i as f64,
                    if i % 2 == 0 { 1e4 } else { (i % 97) as f64 },
                    0.0,
                )
            })
            .collect();
        let start = std::time::Instant::now();
        assert_eq!(triangulate(&comb).len(), n - 2);
        assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
    }

    #[test]
    fn polygons_without_an_ear_are_cut_all_the_same() {
        let nothing = vec![DVec3::ONE; 6];
        assert_eq!(triangulate(&nothing).len(), 4, "no area");
        let bow = flat(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]);
        assert_eq!(triangulate(&bow).len(), 2, "crossed");
        assert_eq!(triangulate(&nothing[..2]), Vec::<[usize; 3]>::new());
        assert_eq!(
            triangulate(&flat(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])),
            [[0, 1, 2]]
        );
        let huge = vec![DVec3::splat(3e38), DVec3::X, DVec3::splat(-3e38), DVec3::Y];
        assert_eq!(triangulate(&huge).len(), 2, "no number overflows");
    }
}
