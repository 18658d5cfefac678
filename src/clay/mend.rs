//! Triangles of a file as surfaces of which a clay can be made (spec/sweepers.md, C): every edge with one triangle or
//! two that agree, every vertex with one fan, closed pieces with their fronts outside.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::mesh::{NONE, next};
use crate::data::mesh::edges::{Sets, Side, by_edge, sides};
use crate::data::mesh::{pieces, volume, winding_number};

/// Triangles that are looked at to find what lies within what: beyond it pieces stay as the file has them.
const MAX_LOOKS: usize = 50_000_000;
/// Angles around an edge, radians: as near as this they are the same.
const SAME_ANGLE: f64 = 1e-6;
/// The least angle around an edge, radians.
const CUT: f64 = -1.0;
/// Vertices of a piece that all have to lie within another one.
const SAMPLES: usize = 3;

/// Surfaces, and what was done to have them.
pub(super) struct Mended {
    /// Vertices, the clay's space. Those that were parted have several at one place, the first where it was.
    pub(super) positions: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The other half-edge of each half-edge, or [`NONE`].
    pub(super) twins: Vec<[u32; 3]>,
    /// Edges of more than two triangles, or of two that disagree.
    pub(super) parted_edges: usize,
    /// Pieces that were inside out.
    pub(super) turned_pieces: usize,
}

impl Mended {
    /// Mends triangles whose corners are three different vertices each.
    pub(super) fn of(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut mended = Self {
            twins: vec![[NONE; 3]; triangles.len()],
            positions,
            triangles,
            parted_edges: 0,
            turned_pieces: 0,
        };
        mended.pair();
        mended.part();
        mended.turn();
        mended
    }

    fn half_of(&self, side: &Side) -> u32 {
        let [a, b] = side.edge;
        let from = if side.is_forward { a } else { b };
        let corners = self.triangles[side.triangle as usize];
        let corner = corners.iter().position(|corner| *corner == from);
        3 * side.triangle + corner.unwrap_or(0) as u32
    }

    fn join(&mut self, one: &Side, two: &Side) {
        let [one, two] = [one, two].map(|side| self.half_of(side));
        self.twins[(one / 3) as usize][(one % 3) as usize] = two;
        self.twins[(two / 3) as usize][(two % 3) as usize] = one;
    }

    /// Finds for each side of a triangle the one that it goes on to.
    fn pair(&mut self) {
        for edge in by_edge(&sides(&self.triangles)) {
            match edge {
                [_] => {}
                [one, two] if one.is_forward != two.is_forward => self.join(one, two),
                _ => {
                    self.parted_edges += 1;
                    for [one, two] in self.wedges(edge) {
                        self.join(&one, &two);
                    }
                }
            }
        }
    }

    /// The sides at an edge that have a body between them: around the edge, each at which a body begins goes with the
    /// next at which one ends, as brackets do. So bodies that touch along an edge come apart, and a wall that ends at
    /// another one gets a border there.
    fn wedges(&self, edge: &[Side]) -> Vec<[Side; 2]> {
        let at = |vertex: u32| self.positions[vertex as usize].as_dvec3();
        let [a, b] = edge[0].edge.map(at);
        let along = (b - a).normalize_or_zero();
        let out_of = |side: &Side| {
            let corners = self.triangles[side.triangle as usize];
            let across = corners.iter().find(|corner| !side.edge.contains(corner));
            let out = across.map_or(DVec3::ZERO, |vertex| at(*vertex) - a);
            out - along * out.dot(along)
        };
        let zero = out_of(&edge[0]);
        let place_of = |side: &Side| {
            let out = out_of(side);
            let angle = libm::atan2(along.dot(zero.cross(out)), zero.dot(out));
            // What lies in one plane is at one place, and the circle is cut where faces seldom are.
            let angle = if angle < CUT { angle + TAU } else { angle };
            libm::round(angle / SAME_ANGLE) as i64
        };
        let mut around: Vec<(i64, Side)> =
            edge.iter().map(|side| (place_of(side), *side)).collect();
        // A body ends before the next one begins at the same place.
        around.sort_by_key(|(place, side)| (*place, !side.is_forward, side.triangle));
        let (mut open, mut wedges) = (Vec::new(), Vec::new());
        let mut is_closed = vec![false; around.len()];
        for turn in 0..2 {
            for (i, (_, side)) in around.iter().enumerate() {
                match side.is_forward {
                    false if turn == 0 => open.push(*side),
                    true if !is_closed[i] => {
                        if let Some(begun) = open.pop() {
                            is_closed[i] = true;
                            wedges.push([begun, *side]);
                        }
                    }
                    _ => {}
                }
            }
        }
        wedges
    }

    /// Gives every fan of triangles a vertex of its own.
    fn part(&mut self) {
        let corner_count = 3 * self.triangles.len();
        let mut fans = Sets::new(corner_count);
        for half in 0..corner_count as u32 {
            let twin = self.twins[(half / 3) as usize][(half % 3) as usize];
            if twin != NONE && half < twin {
                fans.join(half, next(twin));
                fans.join(next(half), twin);
            }
        }
        let mut is_taken = vec![false; self.positions.len()];
        let mut vertex_of = vec![NONE; corner_count];
        for corner in 0..corner_count {
            let fan = fans.find(corner as u32) as usize;
            let vertex = &mut self.triangles[corner / 3][corner % 3];
            if vertex_of[fan] == NONE {
                let old = *vertex as usize;
                vertex_of[fan] = match std::mem::replace(&mut is_taken[old], true) {
                    false => old as u32,
                    true => {
                        self.positions.push(self.positions[old]);
                        (self.positions.len() - 1) as u32
                    }
                };
            }
            *vertex = vertex_of[fan];
        }
    }

    /// Turns closed pieces over until what is outside of each is where the winding number is 0: one that lies within
    /// another is the wall of a cavity, one within that is a body again.
    fn turn(&mut self) {
        let (piece_of, count) = pieces(self.positions.len(), &self.triangles);
        let mut all: Vec<Piece> = (0..count).map(|_| Piece::default()).collect();
        for (triangle, piece) in piece_of.iter().enumerate() {
            let piece = &mut all[*piece as usize];
            let corners = self.triangles[triangle];
            piece.is_open |= self.twins[triangle].contains(&NONE);
            piece.triangles.push(corners);
            for corner in corners {
                let pos = self.positions[corner as usize];
                piece.bounds = [piece.bounds[0].min(pos), piece.bounds[1].max(pos)];
            }
        }
        for piece in &mut all {
            let center = ((piece.bounds[0] + piece.bounds[1]) * 0.5).as_dvec3();
            piece.volume = volume(&self.positions, &piece.triangles, center);
        }
        let mut looks = 0;
        let is_turned: Vec<bool> = (0..count)
            .map(|i| {
                let is_body = self.is_body(&all, i, &mut looks);
                is_body.is_some_and(|is_body| match is_body {
                    true => all[i].volume < 0.0,
                    false => all[i].volume > 0.0,
                })
            })
            .collect();
        self.turned_pieces = is_turned.iter().filter(|turned| **turned).count();
        for (triangle, piece) in piece_of.iter().enumerate() {
            if is_turned[*piece as usize] {
                self.triangles[triangle].swap(1, 2);
                let twins = &mut self.twins[triangle];
                twins.swap(0, 2);
                for twin in twins {
                    *twin = *twin - *twin % 3 + (2 - *twin % 3);
                }
            }
        }
    }

    /// True for a piece that is a body, false for one that is the wall of a cavity; `None` where it is neither, being
    /// open, or nobody knows.
    fn is_body(&self, all: &[Piece], index: usize, looks: &mut usize) -> Option<bool> {
        let piece = &all[index];
        if piece.is_open {
            return None;
        }
        let mut is_body = true;
        for other in all {
            *looks += 1;
            if *looks > MAX_LOOKS {
                return None;
            }
            if other.is_open || other.volume.abs() <= piece.volume.abs() || !other.may_hold(piece) {
                continue;
            }
            let step = piece.triangles.len().div_ceil(SAMPLES);
            *looks += SAMPLES * other.triangles.len();
            let is_within = piece.triangles.iter().step_by(step).all(|corners| {
                let place = self.positions[corners[0] as usize].as_dvec3();
                winding_number(&self.positions, &other.triangles, place).abs() > 0.5
            });
            is_body ^= is_within;
        }
        Some(is_body)
    }
}

/// What hangs together.
struct Piece {
    triangles: Vec<[u32; 3]>,
    bounds: [Vec3; 2],
    /// Below 0 for one that is inside out.
    volume: f64,
    is_open: bool,
}

impl Default for Piece {
    /// Nothing yet.
    fn default() -> Self {
        Self {
            triangles: Vec::new(),
            bounds: [Vec3::INFINITY, Vec3::NEG_INFINITY],
            volume: 0.0,
            is_open: false,
        }
    }
}

impl Piece {
    fn may_hold(&self, other: &Self) -> bool {
        self.bounds[0].cmple(other.bounds[0]).all() && other.bounds[1].cmple(self.bounds[1]).all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;

    /// Cubes by their lowest corners and sides; those of negative side are inside out. Vertices at one place are one.
    fn cubes(all: &[([f32; 3], f32)]) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (corners, faces) = cube();
        let (mut positions, mut triangles) = (Vec::<Vec3>::new(), Vec::new());
        for (at, side) in all {
            let mut index_of = Vec::new();
            for corner in &corners {
                let place = Vec3::from_array(*at) + *corner * side.abs();
                let known = positions.iter().position(|other| *other == place);
                index_of.push(known.unwrap_or(positions.len()) as u32);
                if known.is_none() {
                    positions.push(place);
                }
            }
            triangles.extend(faces.iter().map(|face| {
                let [a, b, c] = face.map(|i| index_of[i as usize]);
                if *side < 0.0 { [a, c, b] } else { [a, b, c] }
            }));
        }
        (positions, triangles)
    }

    fn mended(all: &[([f32; 3], f32)]) -> Mended {
        let (positions, triangles) = cubes(all);
        Mended::of(positions, triangles)
    }

    fn volume_of(mended: &Mended) -> f64 {
        volume(&mended.positions, &mended.triangles, DVec3::ZERO)
    }

    /// Every half-edge and its twin go along the same vertices in opposite directions.
    fn check(mended: &Mended) {
        let ends = |half: u32| {
            let corner = |half: u32| mended.triangles[(half / 3) as usize][(half % 3) as usize];
            [corner(half), corner(next(half))]
        };
        for half in 0..3 * mended.triangles.len() as u32 {
            let twin = mended.twins[(half / 3) as usize][(half % 3) as usize];
            if twin != NONE {
                let [from, to] = ends(half);
                assert_eq!(ends(twin), [to, from]);
            }
        }
    }

    #[test]
    fn what_is_a_surface_stays() {
        let (positions, triangles) = cube();
        let mended = Mended::of(positions.clone(), triangles.clone());
        check(&mended);
        assert_eq!((mended.positions, mended.triangles), (positions, triangles));
        assert_eq!((mended.parted_edges, mended.turned_pieces), (0, 0));
        assert!(mended.twins.iter().flatten().all(|twin| *twin != NONE));
    }

    #[test]
    fn bodies_that_touch_along_an_edge_come_apart() {
        let mended = mended(&[([0.0; 3], 1.0), ([1.0, 1.0, 0.0], 1.0)]);
        check(&mended);
        assert_eq!((mended.parted_edges, mended.positions.len()), (1, 16));
        assert!(mended.twins.iter().flatten().all(|twin| *twin != NONE));
        assert_eq!(pieces(16, &mended.triangles).1, 2);
        // At a corner alone as well, where no edge is parted.
        let touching = super::tests::mended(&[([0.0; 3], 1.0), ([1.0; 3], 1.0)]);
        assert_eq!((touching.parted_edges, touching.positions.len()), (0, 16));
        // And along a face that both have.
        let beside = super::tests::mended(&[([0.0; 3], 1.0), ([1.0, 0.0, 0.0], 1.0)]);
        check(&beside);
        assert_eq!(pieces(beside.positions.len(), &beside.triangles).1, 2);
        assert_eq!((beside.positions.len(), volume_of(&beside)), (16, 2.0));
    }

    #[test]
    fn a_wall_that_ends_at_another_gets_a_border() {
        let (mut positions, mut triangles) = cube();
        positions.push(Vec3::new(-1.0, -1.0, 0.0));
        // A fin at the edge from the first to the fifth corner.
        triangles.push([0, 4, 8]);
        let mended = Mended::of(positions, triangles);
        check(&mended);
        let borders = mended.twins.iter().flatten().filter(|twin| **twin == NONE);
        assert_eq!((borders.count(), mended.parted_edges), (3, 1));
        assert_eq!(pieces(mended.positions.len(), &mended.triangles).1, 2);
    }

    #[test]
    fn what_is_inside_out_is_turned_and_cavities_stay() {
        let alone = mended(&[([0.0; 3], -1.0)]);
        check(&alone);
        assert_eq!((alone.turned_pieces, volume_of(&alone)), (1, 1.0));
        // A body with a cavity, in it a body with a cavity, beside them a body.
        let right = [
            ([0.0; 3], 9.0),
            ([1.0; 3], -7.0),
            ([2.0; 3], 5.0),
            ([3.0; 3], -3.0),
            ([20.0; 3], 1.0),
        ];
        let all = mended(&right);
        check(&all);
        assert_eq!(all.turned_pieces, 0);
        let inside = volume_of(&all);
        assert_eq!(inside, 729.0 - 343.0 + 125.0 - 27.0 + 1.0);
        for wrong in 0..right.len() {
            let mut wrong_one = right;
            wrong_one[wrong].1 *= -1.0;
            let turned = mended(&wrong_one);
            check(&turned);
            assert_eq!((turned.turned_pieces, volume_of(&turned)), (1, inside));
        }
        // Bodies that only overlap are bodies.
        let overlap = mended(&[([0.0; 3], 4.0), ([3.0; 3], 2.0)]);
        assert_eq!(overlap.turned_pieces, 0);
    }
}
