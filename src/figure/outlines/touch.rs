use std::collections::BTreeSet;

use glam::DVec2;

use super::line::distance_squared;

/// Side of a cell of the grid that segments are sorted into, pixels.
const CELL: f64 = 8.0;
/// Lines nearer to each other than this touch, pixels. Where they are nearer without crossing, the mesh between them
/// would need far more triangles than its detail.
const CLEARANCE: f64 = 0.25;

/// A segment of a line.
#[derive(Clone, Copy)]
struct Segment {
    line: u32,
    from: DVec2,
    to: DVec2,
}

/// The lines that cross or touch another or themselves, but for ends that they share.
pub(crate) fn touching(
    lines: &[Vec<DVec2>],
    is_closed: impl Fn(usize) -> bool,
    size: [usize; 2],
) -> BTreeSet<usize> {
    let width = (size[0] as f64 / CELL) as usize + 1;
    let height = (size[1] as f64 / CELL) as usize + 1;
    let mut segments = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let n = if is_closed(i) {
            line.len()
        } else {
            line.len() - 1
        };
        segments.extend((0..n).map(|k| Segment {
            line: i as u32,
            from: line[k],
            to: line[(k + 1) % line.len()],
        }));
    }
    let mut cells: Vec<Vec<u32>> = vec![Vec::new(); width * height];
    for (i, segment) in segments.iter().enumerate() {
        visit_cells(segment, width, height, |cell| cells[cell].push(i as u32));
    }
    let mut found = BTreeSet::new();
    for cell in &cells {
        for (k, i) in cell.iter().enumerate() {
            for j in &cell[k + 1..] {
                let (a, b) = (&segments[*i as usize], &segments[*j as usize]);
                if touch(a, b) {
                    found.insert(a.line as usize);
                    found.insert(b.line as usize);
                }
            }
        }
    }
    found
}

/// Calls `visit` with each cell that a segment comes near.
fn visit_cells(segment: &Segment, width: usize, height: usize, mut visit: impl FnMut(usize)) {
    let (low, high) = (
        segment.from.min(segment.to) - CLEARANCE,
        segment.from.max(segment.to) + CLEARANCE,
    );
    let index = |value: f64, count: usize| ((value / CELL).max(0.0) as usize).min(count - 1);
    let along = segment.to - segment.from;
    for row in index(low.y, height)..=index(high.y, height) {
        // The part of the segment in this row of cells, and a clearance beyond it.
        let (mut left, mut right) = (low.x, high.x);
        if along.y.abs() > CELL {
            let x_at = |y: f64| {
                segment.from.x + along.x * ((y - segment.from.y) / along.y).clamp(0.0, 1.0)
            };
            let (upper, lower) = (
                row as f64 * CELL - CLEARANCE,
                (row + 1) as f64 * CELL + CLEARANCE,
            );
            let (a, b) = (x_at(upper), x_at(lower));
            (left, right) = (a.min(b) - CLEARANCE, a.max(b) + CLEARANCE);
        }
        for column in index(left, width)..=index(right, width) {
            visit(row * width + column);
        }
    }
}

fn touch(a: &Segment, b: &Segment) -> bool {
    let is_near = |p: DVec2, s: &Segment| distance_squared(p, s.from, s.to) < CLEARANCE * CLEARANCE;
    let shared = [a.from, a.to]
        .into_iter()
        .find(|p| *p == b.from || *p == b.to);
    let Some(shared) = shared else {
        let ends_are_near =
            is_near(a.from, b) || is_near(a.to, b) || is_near(b.from, a) || is_near(b.to, a);
        return ends_are_near || cross(a, b);
    };
    let other = |s: &Segment| if s.from == shared { s.to } else { s.from };
    other(a) == other(b) || is_near(other(a), b) || is_near(other(b), a)
}

/// Whether two segments cross: points lie on a grid of 1/1024 pixel, so the products are exact.
fn cross(a: &Segment, b: &Segment) -> bool {
    let side = |s: &Segment, p: DVec2| (s.to - s.from).perp_dot(p - s.from);
    side(a, b.from) * side(a, b.to) < 0.0 && side(b, a.from) * side(b, a.to) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn found(lines: &[&[[f64; 2]]]) -> Vec<usize> {
        let lines: Vec<Vec<DVec2>> = lines
            .iter()
            .map(|line| line.iter().map(|p| dvec2(p[0], p[1])).collect())
            .collect();
        touching(&lines, |_| false, [100, 100])
            .into_iter()
            .collect()
    }

    #[test]
    fn crossing_lines_are_found_and_neighbours_are_not() {
        let long: &[[f64; 2]] = &[[0.0, 0.0], [100.0, 90.0]];
        assert_eq!(
            found(&[
                long,
                &[[50.0, 10.0], [40.0, 80.0]],
                &[[0.0, 50.0], [20.0, 60.0]]
            ]),
            [0, 1],
            "a crossing"
        );
        assert_eq!(
            found(&[long, &[[0.0, 0.0], [0.0, 50.0], [50.0, 50.0]]]),
            [0_usize; 0],
            "a shared end, and no more"
        );
        assert_eq!(
            found(&[long, &[[0.0, 0.0], [50.0, 45.1]]]),
            [0, 1],
            "along each other"
        );
        assert_eq!(
            found(&[&[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0], [10.0, -10.0]]]),
            [0],
            "a line crosses itself"
        );
    }
}
