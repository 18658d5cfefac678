//! A body as a pile of cross-sections: each an ellipse, somewhat squared, with a front and a back of its own.

use super::lanes::{Lanes, Points};

/// Distance between the rows of the table, mm.
const STEP_MM: f32 = 1.0;

/// One cross-section as given: height, half width, front, back, mm.
pub(super) type Ring = [f32; 4];

/// The outline of a body by height, mm. Made once per subject; a look-up costs one row, for z is the same along a row
/// of voxels.
pub(super) struct Profile {
    bottom: f32,
    /// Half width, middle, half depth in front, half depth behind, mm.
    rows: Vec<[f32; 4]>,
    /// Squareness, 0 (ellipse) to 1.
    square2: f32,
}

impl Profile {
    /// From cross-sections, the lowest first. They are joined by cubic curves; beyond the ends the last one goes on.
    pub(super) fn new(rings: &[Ring], square: f32) -> Self {
        let knots: Vec<[f32; 5]> = rings
            .iter()
            .map(|&[z, half, front, back]| {
                let middle = 0.5 * (front + back);
                [z, half, middle, front - middle, middle - back]
            })
            .collect();
        let last = knots.len() - 1;
        let slope = |i: usize, k: usize| {
            let (a, b) = (&knots[i.saturating_sub(1)], &knots[(i + 1).min(last)]);
            (b[k] - a[k]) / (b[0] - a[0])
        };
        let bottom = knots[0][0];
        let count = ((knots[last][0] - bottom) / STEP_MM) as usize + 2;
        let mut rows = Vec::with_capacity(count);
        let mut i = 0;
        for row in 0..count {
            let z = (bottom + row as f32 * STEP_MM).min(knots[last][0]);
            while i + 1 < last && z > knots[i + 1][0] {
                i += 1;
            }
            let (a, b) = (&knots[i], &knots[i + 1]);
            let span = b[0] - a[0];
            let t = (z - a[0]) / span;
            let (t2, t3) = (t * t, t * t * t);
            rows.push([1, 2, 3, 4].map(|k| {
                a[k] * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + slope(i, k) * span * (t3 - 2.0 * t2 + t)
                    + b[k] * (3.0 * t2 - 2.0 * t3)
                    + slope(i + 1, k) * span * (t3 - t2)
            }));
        }
        Self {
            bottom,
            rows,
            square2: square * square,
        }
    }

    /// The cross-section at a height, and how it changes per mm.
    #[inline]
    fn section(&self, z: f32) -> ([f32; 4], [f32; 4]) {
        let at = ((z - self.bottom) / STEP_MM).clamp(0.0, (self.rows.len() - 2) as f32);
        let row = at as usize;
        let (a, b) = (&self.rows[row], &self.rows[row + 1]);
        let slope = [0, 1, 2, 3].map(|k| (b[k] - a[k]) / STEP_MM);
        let t = (at - row as f32) * STEP_MM;
        ([0, 1, 2, 3].map(|k| a[k] + slope[k] * t), slope)
    }

    /// Signed distance of points of one height, mm: exact to first order near the surface.
    #[inline]
    pub(super) fn distance(&self, p: &Points) -> Lanes {
        let ([half, middle, front, back], slope) = self.section(p.z[0]);
        let zero = Lanes::splat(0.0);
        let y = p.y - middle;
        let (inv_front, inv_back) = (1.0 / front, 1.0 / back);
        let before = y.map(|y| if y > 0.0 { 1.0 } else { 0.0 });
        let inv_depth = Lanes::splat(inv_back).mix(Lanes::splat(inv_front), before);
        let deeper = Lanes::splat(slope[3]).mix(Lanes::splat(slope[2]), before);
        let u = p.x * (1.0 / half);
        let v = y * inv_depth;
        let (u2, v2) = (u * u, v * v);
        let (cu, cv) = (
            u2.min(Lanes::splat(1.3)) * self.square2,
            v2.min(Lanes::splat(1.3)),
        );
        let f = (u2 + v2 - cu * cv).max(zero) + 1e-6;
        let gu = u * (Lanes::splat(1.0) - cv * self.square2);
        let gv = v * (Lanes::splat(1.0) - cu);
        let gx = gu * (1.0 / half);
        let gy = gv * inv_depth;
        // Upwards the section grows and moves: v changes by -(v b' + middle') / b.
        let gz = gu * u * (slope[0] / half) + gv * (v * deeper + slope[1]) * inv_depth;
        let k0 = f.sqrt();
        let k1 = (gx * gx + gy * gy + gz * gz).sqrt() + 1e-5;
        k0 * (k0 - 1.0) / k1
    }

    /// Where a ray from the middle of a cross-section leaves it, mm: `side` along x, `forward` along y.
    pub(super) fn rim(&self, z: f32, side: f32, forward: f32, outside: f32) -> [f32; 3] {
        let ([half, middle, front, back], _) = self.section(z);
        let depth = if forward > 0.0 { front } else { back };
        // The ray's length to the squared ellipse, by halving.
        let (mut low, mut high) = (0.5f32, 1.6f32);
        for _ in 0..24 {
            let t = 0.5 * (low + high);
            let (u2, v2) = (t * side * t * side, t * forward * t * forward);
            let f = u2 + v2 - self.square2 * u2.min(1.3) * v2.min(1.3);
            if f < 1.0 {
                low = t;
            } else {
                high = t;
            }
        }
        [
            side * (low * half + outside),
            middle + forward * (low * depth + outside),
            z,
        ]
    }

    /// y of the front at a height and a distance from the middle, mm.
    pub(super) fn front(&self, z: f32, x: f32) -> f32 {
        let ([half, middle, front, _], _) = self.section(z);
        let u2 = (x / half) * (x / half);
        let v2 = (1.0 - u2).max(0.0) / (1.0 - self.square2 * u2.min(1.0)).max(0.05);
        middle + front * v2.min(1.0).sqrt()
    }
}
