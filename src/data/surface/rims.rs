//! The form of a grid of distances in lines: the rims of the shadows that its mesh casts along the axes.
//!
//! ```text
//!   d---c     A shadow has at each node of a plane the least distance along the axis across it. Its rim is where
//!   | ` |     that passes a level, by lines through the cells of the plane (Lorensen and Cline's marching cubes
//!   a---b     in the plane), with the shadow on the left.
//! ```

use glam::{UVec3, Vec3};

/// The rims of the shadows of distances (x fastest; 0 inside) in the middle planes across the three axes, as closed
/// lines about the origin; nodes are `cell` apart. The rim is where the distance is half of that: it lies so far
/// outside.
pub(super) fn rims(nodes: UVec3, values: &[f32], cell: f32) -> Vec<Vec<Vec3>> {
    let nodes = nodes.to_array().map(|n| n as usize);
    let value = |at: [usize; 3]| values[at[0] + nodes[0] * (at[1] + nodes[1] * at[2])];
    let mut lines = Vec::new();
    for across in 0..3 {
        let axes @ [u, v] = [(across + 1) % 3, (across + 2) % 3];
        let shadow: Vec<f32> = (0..nodes[u] * nodes[v])
            .map(|node| {
                let mut at = [0; 3];
                (at[u], at[v]) = (node % nodes[u], node / nodes[u]);
                let along = (0..nodes[across]).map(|i| {
                    at[across] = i;
                    value(at)
                });
                along.fold(f32::INFINITY, f32::min)
            })
            .collect();
        for line in around(&shadow, nodes[u], 0.5 * cell) {
            let place = |[a, b]: [f32; 2]| {
                let mut place = Vec3::ZERO;
                for (axis, along) in axes.into_iter().zip([a, b]) {
                    place[axis] = (along - 0.5 * (nodes[axis] - 1) as f32) * cell;
                }
                place
            };
            lines.push(line.into_iter().map(place).collect());
        }
    }
    lines
}

/// Closed lines around what is below a level, in steps between values. `width` values make a row.
fn around(values: &[f32], width: usize, level: f32) -> Vec<Vec<[f32; 2]>> {
    // Where a rim comes to from where it crosses an edge. Edges are numbered by the value at which they begin: along a
    // row even, across rows odd.
    let mut next = vec![None; 2 * values.len()];
    for below in 0..values.len() / width - 1 {
        for left in 0..width - 1 {
            let first = left + width * below;
            let corners = [first, first + 1, first + width + 1, first + width];
            let edges = [
                2 * first,
                2 * (first + 1) + 1,
                2 * (first + width),
                2 * first + 1,
            ];
            let is_in = corners.map(|corner| values[corner] < level);
            for out in (0..4).filter(|&k| is_in[k] && !is_in[(k + 1) % 4]) {
                let mut on = (1..4).map(|k| (out + k) % 4);
                let back = on.find(|&k| !is_in[k] && is_in[(k + 1) % 4]);
                next[edges[out]] = back.map(|back| edges[back]);
            }
        }
    }
    let crossing = |edge: usize| {
        let first = edge / 2;
        let (a, b) = match edge % 2 {
            0 => (values[first], values[first + 1]),
            _ => (values[first], values[first + width]),
        };
        let part = (level - a) / (b - a);
        let [x, y] = [first % width, first / width].map(|n| n as f32);
        match edge % 2 {
            0 => [x + part, y],
            _ => [x, y + part],
        }
    };
    let mut lines = Vec::new();
    for start in 0..next.len() {
        let mut line = Vec::new();
        let mut at = start;
        while let Some(to) = next[at].take() {
            line.push(crossing(at));
            at = to;
        }
        let Some(&first) = line.first() else { continue };
        // Where the grid cuts a rim off, its ends are joined.
        if at != start {
            line.push(crossing(at));
        }
        line.push(first);
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distances(nodes: UVec3, cell: f32, of: impl Fn(Vec3) -> f32) -> Vec<f32> {
        let middle = 0.5 * (nodes - 1).as_vec3();
        let mut values = Vec::new();
        for z in 0..nodes.z {
            for y in 0..nodes.y {
                for x in 0..nodes.x {
                    values.push(of((UVec3::new(x, y, z).as_vec3() - middle) * cell).max(0.0));
                }
            }
        }
        values
    }

    #[test]
    fn a_ball_casts_three_round_shadows() {
        let (nodes, cell) = (UVec3::splat(48), 1.5 / 47.0);
        let values = distances(nodes, cell, |p| p.length() - 0.4);
        let lines = rims(nodes, &values, cell);
        assert_eq!(lines.len(), 3);
        for (axis, line) in lines.iter().enumerate() {
            assert!(line.len() > 60 && line.first() == line.last());
            for p in line {
                assert!(p[axis] == 0.0);
                let off = p.length() - 0.4 - 0.5 * cell;
                // Distances are 0 inside, so that lines bend between the last node there and the next.
                assert!(off.abs() < 0.15 * cell, "{off}");
            }
        }
    }

    #[test]
    fn a_ring_has_a_hole_where_it_is_seen_through() {
        let (nodes, cell) = (UVec3::new(48, 48, 26), 1.5 / 47.0);
        let ring = |p: Vec3| (p.truncate().length() - 0.35).hypot(p.z) - 0.08;
        let lines = rims(nodes, &distances(nodes, cell, ring), cell);
        let flat = |axis: usize| {
            lines
                .iter()
                .filter(|line| line.iter().all(|p| p[axis] == 0.0))
                .count()
        };
        assert_eq!([flat(0), flat(1), flat(2)], [1, 1, 2]);
    }

    #[test]
    fn places_that_touch_by_a_corner_have_lines_that_close() {
        let values = [
            1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0,
        ];
        for line in around(&values, 4, 0.5) {
            assert!(line.len() > 3 && line.first() == line.last(), "{line:?}");
        }
        // Without a rim, and with one that the grid cuts off.
        assert!(around(&[1.0; 16], 4, 0.5).is_empty());
        assert!(around(&[0.0; 16], 4, 0.5).is_empty());
        let cut = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let ends = [[1.5, 0.0], [1.5, 1.0], [1.5, 0.0]];
        assert_eq!(around(&cut, 3, 0.5), [ends]);
    }
}
