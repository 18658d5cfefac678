use glam::DVec2;

use super::mask::Mask;

/// Coordinates beyond this are moved to it, so that products of two stay finite, pixels.
const FAR: f64 = 1e9;

/// Closed lines and the rule by which they are filled. A line's last point is joined to its first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fill {
    /// The lines, in map space.
    pub lines: Vec<Vec<DVec2>>,
    /// Filled where the lines go around an odd number of times; otherwise where they go around at all.
    pub is_even_odd: bool,
}

/// Adds to a set the pixels whose centres are filled.
pub(crate) fn add_filled(mask: &mut Mask, fill: &Fill) {
    let [width, height] = mask.size;
    let mut crossings: Vec<Vec<(f64, i32)>> = vec![Vec::new(); height];
    for line in &fill.lines {
        let near = |p: &DVec2| p.clamp(-DVec2::splat(FAR), DVec2::splat(FAR));
        for (from, to) in line.iter().zip(line.iter().cycle().skip(1)) {
            add_crossings(&mut crossings, near(from), near(to));
        }
    }
    for (row, crossings) in crossings.iter_mut().enumerate() {
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut winding = 0;
        for (i, (x, sign)) in crossings.iter().enumerate() {
            winding += sign;
            let is_filled = if fill.is_even_odd {
                i % 2 == 0
            } else {
                winding != 0
            };
            let Some((end, _)) = crossings.get(i + 1) else {
                break;
            };
            if is_filled {
                // Pixels whose centre lies at or right of `x` and left of `end`.
                let first_at = |x: f64| (x - 0.5).ceil().clamp(0.0, width as f64) as usize;
                let (first, last) = (first_at(*x), first_at(*end));
                if first < last {
                    mask.bits[row * width + first..row * width + last].fill(true);
                }
            }
        }
    }
}

/// Notes where a segment crosses the middle of each row, and whether it goes down.
fn add_crossings(crossings: &mut [Vec<(f64, i32)>], from: DVec2, to: DVec2) {
    let (upper, lower, sign) = if from.y <= to.y {
        (from, to, 1)
    } else {
        (to, from, -1)
    };
    let height = crossings.len() as f64;
    let first_at = |y: f64| (y - 0.5).ceil().clamp(0.0, height) as usize;
    for (row, crossings) in crossings
        .iter_mut()
        .enumerate()
        .take(first_at(lower.y))
        .skip(first_at(upper.y))
    {
        let part = (row as f64 + 0.5 - upper.y) / (lower.y - upper.y);
        crossings.push((upper.x + (lower.x - upper.x) * part, sign));
    }
}

/// Whether two segments of a closed polygon cross, its neighbours aside.
pub(crate) fn crosses_itself(polygon: &[DVec2]) -> bool {
    let n = polygon.len();
    let segment = |i: usize| (polygon[i], polygon[(i + 1) % n]);
    (0..n).any(|i| {
        (i + 2..n).any(|j| {
            let are_neighbours = i == 0 && j + 1 == n;
            !are_neighbours && cross(segment(i), segment(j))
        })
    })
}

/// Whether each segment has the other's ends on both of its sides.
fn cross(a: (DVec2, DVec2), b: (DVec2, DVec2)) -> bool {
    let side = |line: (DVec2, DVec2), p: DVec2| (line.1 - line.0).perp_dot(p - line.0);
    side(a, b.0) * side(a, b.1) < 0.0 && side(b, a.0) * side(b, a.1) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn count(line: &[[f64; 2]], is_even_odd: bool) -> usize {
        let mut mask = Mask::none([20, 20]);
        let line = line.iter().map(|p| dvec2(p[0], p[1])).collect();
        add_filled(
            &mut mask,
            &Fill {
                lines: vec![line],
                is_even_odd,
            },
        );
        mask.count()
    }

    #[test]
    fn centres_decide() {
        assert_eq!(
            count(&[[2.0, 3.0], [7.0, 3.0], [7.0, 9.0], [2.0, 9.0]], false),
            30,
            "a rectangle"
        );
        assert_eq!(
            count(&[[2.4, 3.4], [6.6, 3.4], [6.6, 8.6], [2.4, 8.6]], false),
            30,
            "less than half is cut off"
        );
        assert_eq!(
            count(&[[2.6, 3.0], [7.0, 3.0], [7.0, 9.0], [2.6, 9.0]], false),
            24,
            "more than half is cut off"
        );
        assert_eq!(
            count(
                &[[-1e300, -5.0], [1e300, -5.0], [1e300, 50.0], [-1e300, 50.0]],
                false
            ),
            400,
            "far outside"
        );
    }

    #[test]
    fn rules_differ_where_a_line_goes_around_twice() {
        let twice = [
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 10.0],
            [0.0, 10.0],
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 5.0],
            [0.0, 5.0],
        ];
        assert_eq!(count(&twice, false), 100, "non-zero");
        assert_eq!(count(&twice, true), 75, "even-odd");
    }

    #[test]
    fn a_bow_tie_crosses_itself() {
        let bow = [[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 10.0]].map(|p| dvec2(p[0], p[1]));
        assert!(crosses_itself(&bow), "a bow tie");
        let square =
            [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|p| dvec2(p[0], p[1]));
        assert!(!crosses_itself(&square), "a square");
        assert!(
            count(&[[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 10.0]], false) >= 45,
            "filled by the non-zero rule"
        );
    }
}
