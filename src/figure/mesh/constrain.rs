use std::collections::VecDeque;

use super::delaunay::Delaunay;

/// Fixed edges.
impl Delaunay {
    /// Makes the line between two points an edge and fixes it. Points that lie on it divide it; it must cross no fixed
    /// edge.
    pub(crate) fn fix(&mut self, from: u32, to: u32) {
        let mut from = from;
        while from != to {
            from = self.fix_first_part(from, to);
        }
    }

    /// Fixes a line up to the first point that lies on it, and gives that point.
    fn fix_first_part(&mut self, from: u32, to: u32) -> u32 {
        let target = self.point(to);
        for (t, i) in self.around(from) {
            let corners = self.triangle(t).corners;
            for corner in [corners[(i + 1) % 3], corners[(i + 2) % 3]] {
                let ahead =
                    (self.point(corner) - self.point(from)).dot(target - self.point(from)) > 0.0;
                if corner == to || ahead && self.side(from, to, self.point(corner)) == 0.0 {
                    self.set_fixed(from, corner);
                    return corner;
                }
            }
        }
        let (mut crossing, end) = self.crossed(from, to);
        let mut made = Vec::new();
        let mut tries = 0;
        while let Some((a, b)) = crossing.pop_front() {
            let Some((t, edge, [p, q])) = self.facing(a, b) else {
                continue;
            };
            // Only a convex quadrilateral can be flipped.
            let is_convex = self.side(p, q, self.point(a)) * self.side(p, q, self.point(b)) < 0.0;
            tries += 1;
            if !is_convex && tries < 1_000_000 {
                crossing.push_back((a, b));
                continue;
            }
            self.flip(t, edge);
            let is_across = |p: u32| p != from && p != end;
            let (side_p, side_q) = (
                self.side(from, end, self.point(p)),
                self.side(from, end, self.point(q)),
            );
            if is_across(p) && is_across(q) && side_p * side_q < 0.0 {
                crossing.push_back((p, q));
            } else {
                made.push((p, q));
            }
        }
        self.set_fixed(from, end);
        self.restore(made);
        end
    }

    /// The edges that the line between two points crosses, and the first point on it.
    fn crossed(&self, from: u32, to: u32) -> (VecDeque<(u32, u32)>, u32) {
        let mut crossing = VecDeque::new();
        let start = self.around(from).into_iter().find(|(t, i)| {
            let corners = self.triangle(*t).corners;
            let (right, left) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
            self.side(from, to, self.point(right)) < 0.0
                && self.side(from, to, self.point(left)) > 0.0
        });
        let Some((mut t, mut edge)) = start else {
            return (crossing, to);
        };
        loop {
            let corners = self.triangle(t).corners;
            crossing.push_back((corners[(edge + 1) % 3], corners[(edge + 2) % 3]));
            let Some((next, position)) = self.across(t, edge) else {
                return (crossing, to);
            };
            let corners = self.triangle(next).corners;
            let apex = corners[position];
            let side = self.side(from, to, self.point(apex));
            if apex == to || side == 0.0 {
                return (crossing, apex);
            }
            // The line leaves through the edge whose ends lie to both of its sides.
            edge = if side > 0.0 {
                (position + 1) % 3
            } else {
                (position + 2) % 3
            };
            t = next;
        }
    }

    /// The triangle left of an edge, its number of the edge, and the corners that face the edge from both sides; none
    /// if there is no such edge, or nothing beyond it.
    fn facing(&self, from: u32, to: u32) -> Option<(u32, usize, [u32; 2])> {
        let (t, edge) = self.edge_between(from, to)?;
        let (u, position) = self.across(t, edge)?;
        let corners = [
            self.triangle(t).corners[edge],
            self.triangle(u).corners[position],
        ];
        Some((t, edge, corners))
    }

    fn set_fixed(&mut self, from: u32, to: u32) {
        for (a, b) in [(from, to), (to, from)] {
            if let Some((t, edge)) = self.edge_between(a, b) {
                self.triangles[t as usize].fixed[edge] = true;
            }
        }
    }

    /// Flips edges that were made on the way to a fixed one until they are Delaunay again.
    fn restore(&mut self, edges: Vec<(u32, u32)>) {
        let mut edges = edges;
        let mut is_changed = true;
        while is_changed {
            is_changed = false;
            for pair in &mut edges {
                let Some((t, edge, [p, q])) = self.facing(pair.0, pair.1) else {
                    continue;
                };
                let is_fixed = self.triangle(t).fixed[edge];
                if !is_fixed && self.is_in_circle(t, self.point(q)) {
                    self.flip(t, edge);
                    *pair = (p, q);
                    is_changed = true;
                }
            }
        }
    }
}
