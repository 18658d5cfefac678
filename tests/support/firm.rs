//! What the f64 reading says, and whether it says it firmly: f32 cannot tell on which side of a jump a point lies that
//! is nearer to it than the rounding of its own coordinates.

use crate::reference::{self, Placed};
use glam::DVec3;

/// Asserted; the contract promises ten times as much.
pub(crate) const BOUND: f64 = 1e-4;
/// Moved by rounding, the reference may change by this much.
pub(crate) const FIRM: f64 = BOUND / 4.0;

/// How far the two differ: the larger of the distance in subject units and the continuity's difference (relative above
/// 1).
pub(crate) fn difference(one: (DVec3, f64), other: (DVec3, f64)) -> f64 {
    let scale = one.1.abs().max(1.0);
    let d = (one.0 - other.0)
        .length()
        .max((one.1 - other.1).abs() / scale);
    if d.is_nan() { f64::INFINITY } else { d }
}

/// The reference's answer, or `None` where rounding of the point alone moves it (see the head of this file).
pub(crate) fn firm(list: &[Placed], pos: DVec3) -> Option<(DVec3, f64)> {
    let answer = reference::map(list, pos);
    let farthest = list.iter().map(|t| t.at.length()).fold(0.0, f64::max);
    let nudged = |by: f64| -> Vec<Placed> {
        let mut list = list.to_vec();
        for param in list.iter_mut().flat_map(|t| &mut t.params) {
            // Whole numbers are exact in f32.
            if param.fract() != 0.0 {
                *param *= 1.0 + by;
            }
        }
        // Corners of a line are rounded each for itself.
        let points = list.iter_mut().flat_map(|t| &mut t.curve);
        for (i, point) in points.flat_map(|(points, _)| points).enumerate() {
            *point *= 1.0 + 0.5 * if i % 2 == 0 { by } else { -by };
        }
        list
    };
    let lists = [nudged(2f64.powi(-23)), nudged(-2f64.powi(-23))];
    for corner in 0..16u32 {
        let mut turn = 0u32;
        let moved = reference::map_with(&lists[(corner / 4 % 2) as usize], pos, &mut |q, size| {
            // Corners 8 to 15 take another corner for each template of the list.
            turn += 1;
            let pick = if corner < 8 {
                corner
            } else {
                corner.wrapping_mul(5).wrapping_add(turn * 3)
            };
            let rounding = 2f64.powi(-22) * (1.0 + q.abs() + (pos.length() + farthest) / size);
            let sign = |bit: u32| if pick & bit == 0 { 1.0 } else { -1.0 };
            q + rounding * DVec3::new(sign(1), sign(2), sign(4))
        });
        if difference(answer, moved) > FIRM {
            return None;
        }
    }
    Some(answer)
}
