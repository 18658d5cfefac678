use super::facts::{Facts, Grip, INF, Icon, Reach};
use crate::math::Aabb;
use glam::Vec3;

/// Everything about lens but its formula. Nothing in the picture is where its strength is, so it is a slider along x, from the middle
/// (0) to the side of the box (0.9).
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        if given.p[0] == 0.0 {
            return Reach::NONE;
        }
        let shift = Vec3::splat(0.5 * given.p[0]);
        Reach::shifted(Aabb::UNIT, -shift, shift).with_detail(0.15)
    },
    grip: Grip::Number(
        |given| Vec3::new(0.5 + 0.5 / 0.9 * given.p[0], 0.5, 0.5),
        INF,
    ),
    icon: Icon {
        at: [-0.5, -0.5, 0.5],
        size: [1.2, 1.2, 1.2],
        params: &[("strength", 0.75)],
        ..Icon::PLAIN
    },
};
