use glam::DVec2;
use robust::{Coord, incircle, orient2d};

/// Stands for a triangle where there is none.
pub(crate) const NONE: u32 = u32::MAX;

/// A triangulation of a rectangle that is Delaunay but for fixed edges. Edge k of a triangle lies opposite its corner
/// k; corners go around counter-clockwise (y up).
pub(crate) struct Delaunay {
    /// All points; the rectangle's corners are the first four.
    pub(crate) points: Vec<DVec2>,
    /// All triangles, those that are not drawn too.
    pub(crate) triangles: Vec<Triangle>,
    /// A triangle at each point.
    at_point: Vec<u32>,
    /// Where the last point was found: the next one is often near.
    last: u32,
}

/// A triangle of a triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Triangle {
    /// Indices of its points.
    pub(crate) corners: [u32; 3],
    /// The triangles across its edges.
    pub(crate) next: [u32; 3],
    /// Which of its edges are fixed.
    pub(crate) fixed: [bool; 3],
    /// The region it belongs to.
    pub(crate) label: u8,
}

/// Where a point lies in a triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// On a point that is there already.
    Point(u32),
    /// On an edge of a triangle.
    Edge(u32, usize),
    /// In a triangle.
    Inside(u32),
}

impl Delaunay {
    /// Two triangles that make up a rectangle.
    pub(crate) fn new(low: DVec2, high: DVec2) -> Self {
        let corners = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        let triangle = |corners, next, edges: [bool; 3]| Triangle {
            corners,
            next,
            fixed: edges,
            label: 0,
        };
        Self {
            points: corners.to_vec(),
            triangles: vec![
                triangle([0, 1, 2], [NONE, 1, NONE], [true, false, true]),
                triangle([0, 2, 3], [NONE, NONE, 0], [true, true, false]),
            ],
            at_point: vec![0, 0, 0, 1],
            last: 0,
        }
    }

    pub(crate) fn point(&self, index: u32) -> DVec2 {
        self.points[index as usize]
    }

    pub(crate) fn triangle(&self, index: u32) -> &Triangle {
        &self.triangles[index as usize]
    }

    /// Twice the area to the left of a line at a point; its sign is exact.
    pub(crate) fn side(&self, from: u32, to: u32, p: DVec2) -> f64 {
        orient2d(coord(self.point(from)), coord(self.point(to)), coord(p))
    }

    /// Whether a point lies inside a triangle's circumcircle.
    pub(crate) fn is_in_circle(&self, triangle: u32, p: DVec2) -> bool {
        let [a, b, c] = self
            .triangle(triangle)
            .corners
            .map(|corner| coord(self.point(corner)));
        incircle(a, b, c, coord(p)) > 0.0
    }

    /// Corner of the neighbour across an edge that is not on that edge, and its position in the neighbour.
    pub(crate) fn across(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        let next = self.triangle(triangle).next[edge];
        if next == NONE {
            return None;
        }
        let position = self
            .triangle(next)
            .next
            .iter()
            .position(|back| *back == triangle)?;
        Some((next, position))
    }

    /// Walks from a triangle to the one that holds a point of the rectangle. With `stops` it ends at the first fixed
    /// edge in the way, which is given as a place on that edge.
    pub(crate) fn walk(&self, start: u32, p: DVec2, stops: bool) -> Place {
        let mut at = start;
        // With fixed edges a walk might go in circles; changing the edge that is tried first breaks them.
        for step in 0..2 * self.triangles.len() + 8 {
            let triangle = self.triangle(at);
            let mut zeros = [false; 3];
            let mut exit = None;
            for i in 0..3 {
                let edge = (i + step) % 3;
                let side = self.side(
                    triangle.corners[(edge + 1) % 3],
                    triangle.corners[(edge + 2) % 3],
                    p,
                );
                zeros[edge] = side == 0.0;
                if side < 0.0 {
                    exit = Some(edge);
                    break;
                }
            }
            let Some(edge) = exit else {
                return match zeros {
                    [false, false, false] => Place::Inside(at),
                    [_, true, true] => Place::Point(triangle.corners[0]),
                    [true, _, true] => Place::Point(triangle.corners[1]),
                    [true, true, _] => Place::Point(triangle.corners[2]),
                    [true, ..] => Place::Edge(at, 0),
                    [_, true, _] => Place::Edge(at, 1),
                    _ => Place::Edge(at, 2),
                };
            };
            if stops && triangle.fixed[edge] || triangle.next[edge] == NONE {
                return Place::Edge(at, edge);
            }
            at = triangle.next[edge];
        }
        Place::Inside(at)
    }

    /// Where a point of the rectangle lies.
    pub(crate) fn locate(&self, p: DVec2) -> Place {
        self.walk(self.last, p, false)
    }

    /// Adds a point of the rectangle, or finds the one that is there.
    pub(crate) fn insert(&mut self, p: DVec2) -> u32 {
        match self.locate(p) {
            Place::Point(index) => index,
            Place::Edge(triangle, edge) => self.split_edge(triangle, edge, p),
            Place::Inside(triangle) => self.split_triangle(triangle, p),
        }
    }

    /// Puts a point into a triangle.
    pub(crate) fn split_triangle(&mut self, t0: u32, p: DVec2) -> u32 {
        let index = self.push_point(p, t0);
        let Triangle {
            corners: [a, b, c],
            next,
            fixed,
            label,
        } = *self.triangle(t0);
        let (t1, t2) = (self.triangles.len() as u32, self.triangles.len() as u32 + 1);
        let made = |corners, next, outer| Triangle {
            corners,
            next,
            fixed: [outer, false, false],
            label,
        };
        self.triangles[t0 as usize] = made([index, b, c], [next[0], t1, t2], fixed[0]);
        self.triangles
            .push(made([index, c, a], [next[1], t2, t0], fixed[1]));
        self.triangles
            .push(made([index, a, b], [next[2], t0, t1], fixed[2]));
        self.relink(next[1], t0, t1);
        self.relink(next[2], t0, t2);
        self.at_point[a as usize] = t1;
        self.at_point[b as usize] = t0;
        self.at_point[c as usize] = t0;
        self.legalise(vec![t0, t1, t2]);
        index
    }

    /// Puts a point onto an edge; the halves of a fixed edge are fixed.
    pub(crate) fn split_edge(&mut self, t1: u32, edge: usize, p: DVec2) -> u32 {
        let index = self.push_point(p, t1);
        let across = self.across(t1, edge);
        let old = *self.triangle(t1);
        let at = |k: usize| (edge + k) % 3;
        let [a, b, c] = [old.corners[at(0)], old.corners[at(1)], old.corners[at(2)]];
        let is_fixed = old.fixed[edge];
        let n = self.triangles.len() as u32;
        let t2 = n;
        let (u1, u2) = if across.is_some() {
            (across.map_or(NONE, |(u, _)| u), n + 1)
        } else {
            (NONE, NONE)
        };
        self.triangles[t1 as usize] = Triangle {
            corners: [index, c, a],
            next: [old.next[at(1)], t2, u2],
            fixed: [old.fixed[at(1)], false, is_fixed],
            label: old.label,
        };
        self.triangles.push(Triangle {
            corners: [index, a, b],
            next: [old.next[at(2)], u1, t1],
            fixed: [old.fixed[at(2)], is_fixed, false],
            label: old.label,
        });
        self.relink(old.next[at(2)], t1, t2);
        self.at_point[a as usize] = t1;
        self.at_point[b as usize] = t2;
        self.at_point[c as usize] = t1;
        let mut changed = vec![t1, t2];
        if let Some((_, position)) = across {
            let old = *self.triangle(u1);
            let at = |k: usize| (position + k) % 3;
            let d = old.corners[position];
            self.triangles[u1 as usize] = Triangle {
                corners: [index, b, d],
                next: [old.next[at(1)], u2, t2],
                fixed: [old.fixed[at(1)], false, is_fixed],
                label: old.label,
            };
            self.triangles.push(Triangle {
                corners: [index, d, c],
                next: [old.next[at(2)], t1, u1],
                fixed: [old.fixed[at(2)], is_fixed, false],
                label: old.label,
            });
            self.relink(old.next[at(2)], u1, u2);
            self.at_point[d as usize] = u1;
            changed.extend([u1, u2]);
        }
        self.legalise(changed);
        index
    }

    fn push_point(&mut self, p: DVec2, triangle: u32) -> u32 {
        self.points.push(p);
        self.at_point.push(triangle);
        self.last = triangle;
        self.points.len() as u32 - 1
    }

    /// Makes the triangle `of` point to `to` where it pointed to `from`.
    fn relink(&mut self, of: u32, from: u32, to: u32) {
        if of != NONE {
            for next in &mut self.triangles[of as usize].next {
                if *next == from {
                    *next = to;
                }
            }
        }
    }

    /// Flips edges opposite the first corner of triangles until they are Delaunay (Lawson).
    fn legalise(&mut self, mut stack: Vec<u32>) {
        while let Some(t) = stack.pop() {
            if self.triangle(t).fixed[0] {
                continue;
            }
            let Some((next, position)) = self.across(t, 0) else {
                continue;
            };
            if self.is_in_circle(t, self.point(self.triangle(next).corners[position])) {
                self.flip(t, 0);
                stack.push(t);
                stack.push(next);
            }
        }
    }

    /// Turns the edge between two triangles into the other diagonal. Both then begin with the corner that was opposite
    /// the edge in the first.
    pub(crate) fn flip(&mut self, t: u32, edge: usize) {
        let Some((u, position)) = self.across(t, edge) else {
            return;
        };
        let (old_t, old_u) = (*self.triangle(t), *self.triangle(u));
        let (of_t, of_u) = (|k: usize| (edge + k) % 3, |k: usize| (position + k) % 3);
        let [a, b, c] = [
            old_t.corners[of_t(0)],
            old_t.corners[of_t(1)],
            old_t.corners[of_t(2)],
        ];
        let d = old_u.corners[position];
        // u is d, c, b.
        self.triangles[t as usize] = Triangle {
            corners: [a, b, d],
            next: [old_u.next[of_u(1)], u, old_t.next[of_t(2)]],
            fixed: [old_u.fixed[of_u(1)], false, old_t.fixed[of_t(2)]],
            label: old_t.label,
        };
        self.triangles[u as usize] = Triangle {
            corners: [a, d, c],
            next: [old_u.next[of_u(2)], old_t.next[of_t(1)], t],
            fixed: [old_u.fixed[of_u(2)], old_t.fixed[of_t(1)], false],
            label: old_u.label,
        };
        self.relink(old_u.next[of_u(1)], u, t);
        self.relink(old_t.next[of_t(1)], t, u);
        self.at_point[a as usize] = t;
        self.at_point[b as usize] = t;
        self.at_point[d as usize] = t;
        self.at_point[c as usize] = u;
    }

    /// The triangles around a point with the position of the point in each, counter-clockwise; at the rectangle's edge
    /// from one edge to the other.
    pub(crate) fn around(&self, point: u32) -> Vec<(u32, usize)> {
        let position = |t: u32| {
            self.triangle(t)
                .corners
                .iter()
                .position(|corner| *corner == point)
                .unwrap_or(0)
        };
        let start = self.at_point[point as usize];
        let mut first = start;
        // Clockwise to the rectangle's edge, if there is one.
        loop {
            let next = self.triangle(first).next[(position(first) + 2) % 3];
            if next == NONE || next == start {
                break;
            }
            first = next;
        }
        if self.triangle(first).next[(position(first) + 2) % 3] != NONE {
            first = start;
        }
        let mut around = Vec::with_capacity(8);
        let mut at = first;
        loop {
            around.push((at, position(at)));
            let next = self.triangle(at).next[(position(at) + 1) % 3];
            if next == NONE || next == first {
                return around;
            }
            at = next;
        }
    }

    /// The triangle to the left of the edge between two points, and the edge's position in it, if there is one.
    pub(crate) fn edge_between(&self, from: u32, to: u32) -> Option<(u32, usize)> {
        let around = self.around(from);
        let found = around
            .iter()
            .find(|(t, i)| self.triangle(*t).corners[(i + 1) % 3] == to);
        found.map(|(t, i)| (*t, (i + 2) % 3))
    }
}

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}
