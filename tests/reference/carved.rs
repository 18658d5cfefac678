//! A plain f64 reading of `carve` (spec/surfaces.md) for two objects whose distances are known in closed form. It was
//! written from that page, not from the shaders.

use glam::DVec3;

/// An object in its own axes, about its middle, subject units.
pub(crate) trait Solid {
    /// d: the distance to the surface, positive outside.
    fn distance(&self, pos: DVec3) -> f64;
    /// m: the gradient of d.
    fn outwards(&self, pos: DVec3) -> DVec3;
    /// h: 0.9 times the greatest t for which every f - r m, 0 < r ≤ t, lies inside and at least 0.9 r from the surface.
    fn room(&self, pos: DVec3) -> f64;
    /// True so near a place where m or h jumps.
    fn jumps_near(&self, pos: DVec3, within: f64) -> bool;
}

/// What the page says of a place.
pub(crate) struct Carved {
    pub(crate) source: DVec3,
    pub(crate) continuity: f64,
}

/// The page's formula.
pub(crate) fn carve(solid: &dyn Solid, pos: DVec3, push: f64, reach: f64) -> Carved {
    let d = solid.distance(pos);
    // Not below -0.9 · reach.
    let push = push.max(-0.9 * reach);
    let p = if push < 0.0 {
        push
    } else {
        push.min(solid.room(pos))
    };
    let part = (1.0 - d.max(0.0) / reach).clamp(0.0, 1.0);
    Carved {
        source: pos - solid.outwards(pos) * p * part,
        continuity: d,
    }
}

/// A ball of this radius.
pub(crate) struct Ball(pub(crate) f64);

impl Solid for Ball {
    fn distance(&self, pos: DVec3) -> f64 {
        pos.length() - self.0
    }

    fn outwards(&self, pos: DVec3) -> DVec3 {
        pos.try_normalize().unwrap_or(DVec3::X)
    }

    fn room(&self, _pos: DVec3) -> f64 {
        // Past the middle the other side comes nearer: 2R - r = 0.9 r.
        0.9 * 2.0 * self.0 / 1.9
    }

    fn jumps_near(&self, pos: DVec3, within: f64) -> bool {
        pos.length() < within
    }
}

/// A box with these half sides.
pub(crate) struct Brick(pub(crate) DVec3);

impl Brick {
    /// The axis of the nearest side of a place inside.
    fn nearest_axis(&self, pos: DVec3) -> usize {
        let left = self.0 - pos.abs();
        (0..3).fold(
            0,
            |best, axis| if left[axis] < left[best] { axis } else { best },
        )
    }
}

impl Solid for Brick {
    fn distance(&self, pos: DVec3) -> f64 {
        let over = pos.abs() - self.0;
        over.max(DVec3::ZERO).length() + over.max_element().min(0.0)
    }

    fn outwards(&self, pos: DVec3) -> DVec3 {
        let away = pos - pos.clamp(-self.0, self.0);
        let mut side = DVec3::ZERO;
        let axis = self.nearest_axis(pos);
        side[axis] = pos[axis].signum();
        away.try_normalize().unwrap_or(side)
    }

    fn room(&self, pos: DVec3) -> f64 {
        let foot = pos.clamp(-self.0, self.0);
        let over = (pos.abs() - self.0).cmpgt(DVec3::ZERO);
        let axis = match over.bitmask().count_ones() {
            // At an edge the sides are nearer than 0.9 r from the start.
            2.. => return 0.0,
            1 => over.bitmask().trailing_zeros() as usize,
            _ => self.nearest_axis(pos),
        };
        let left = self.0 - foot.abs();
        let sides = (0..3)
            .filter(|other| *other != axis)
            .map(|other| left[other] / 0.9);
        0.9 * sides.fold(2.0 * self.0[axis] / 1.9, f64::min)
    }

    fn jumps_near(&self, pos: DVec3, within: f64) -> bool {
        let over = pos.abs() - self.0;
        let mut sorted = over.to_array();
        sorted.sort_by(f64::total_cmp);
        // Inside, where two sides are equally near; this holds the edges. Opposite sides are, in the middle.
        let nearest = self.nearest_axis(pos);
        sorted[2] < within
            && ((sorted[2] - sorted[1]) < within * 2f64.sqrt() || pos[nearest].abs() < within)
    }
}
