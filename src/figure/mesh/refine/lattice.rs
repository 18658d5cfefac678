use glam::DVec2;

use super::super::delaunay::Place;
use super::{NO_POINT, Refinement};

/// Area of the triangles of the lattice that is laid into the figure, in largest areas.
const SEED_AREA: f64 = 0.8;
/// Room around a point of the lattice, in its sides.
const SEED_ROOM: f64 = 0.6;
/// How far a point of the lattice is moved from its place, in its sides. In a regular lattice many shortest ways are of
/// equal length, and which one is taken would hang on the last bit of a sum.
const SEED_JITTER: f64 = 0.05;

/// The lattice that refinement begins with.
impl Refinement<'_> {
    /// Puts points of a lattice of equal triangles into what is drawn, away from outlines and other points. Refinement
    /// alone makes triangles of a bit more than half the largest area, and takes half as many again.
    pub(super) fn seed(&mut self) {
        let side = (SEED_AREA * self.aim.area * 4.0 / 3.0_f64.sqrt()).sqrt();
        let height = side * 3.0_f64.sqrt() / 2.0;
        let size = self.mesh.point(2);
        let rows = (size.y / height) as usize;
        let mut near = 0;
        for row in 0..=rows {
            let y = (row as f64 + 0.5) * height;
            let first = if row % 2 == 0 { 0.25 } else { 0.75 };
            for column in 0..=(size.x / side) as usize {
                let p = DVec2::new((column as f64 + first) * side, y)
                    + SEED_JITTER * side * jitter(row, column);
                if self.mesh.points.len() >= self.aim.points {
                    return;
                }
                if p.cmpgt(DVec2::ZERO).all() && p.cmplt(size).all() {
                    self.seed_at(p, SEED_ROOM * side, &mut near);
                }
            }
        }
    }

    /// Adds a point if it is drawn there and nothing else is nearer than `room`. The search begins at `near`, which is
    /// the triangle that was found from then on: where little is drawn, most points are far from the last one added.
    fn seed_at(&mut self, p: DVec2, room: f64, near: &mut u32) {
        let Place::Inside(holder) = self.mesh.walk(*near, p, false) else {
            return;
        };
        *near = holder;
        if !self.is_drawn[usize::from(self.mesh.triangle(holder).label)] {
            return;
        }
        let (cavity, encroached) = self.cavity(holder, p);
        let is_near = |corner: u32| self.mesh.point(corner).distance_squared(p) < room * room;
        let is_crowded = cavity
            .iter()
            .any(|t| self.mesh.triangle(*t).corners.into_iter().any(is_near));
        if encroached.is_empty() && !is_crowded {
            self.mesh.split_triangle(holder, p);
            self.added([NO_POINT; 2]);
        }
    }
}

/// Two numbers, -1 to 1, that look random and are always the same for a row and a column.
fn jitter(row: usize, column: usize) -> DVec2 {
    let mut bits = (row as u64) << 32 | column as u64;
    let mut next = || {
        // The mixing step of SplitMix64.
        bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ mixed >> 31) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    DVec2::new(next(), next())
}
