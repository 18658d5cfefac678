use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about hole but its formula. It is grabbed at its rim, on the top.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let amount = given.p[0];
        if amount == 0.0 {
            return Reach::NONE;
        }
        let shift = Vec3::new(amount.min(0.475), amount.min(0.475), 0.0);
        Reach::shifted(aabb([0.0, 0.0, -INF], [1.0, 1.0, INF]), -shift, shift).with_detail(0.15)
    },
    grip: Grip::Number(|given| Vec3::new(0.5 + given.p[0], 0.5, 1.0), INF),
    icon: Icon {
        params: &[("taper", 0.5)],
        yaw_pitch_deg: [148.0, 40.0],
        ..Icon::PLAIN
    },
};
