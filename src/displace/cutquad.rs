use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about cutquad but its formula. It is grabbed at the wound's rim, on the top.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let [amount, length, ripple, ..] = given.p;
        if amount == 0.0 {
            return Reach::NONE;
        }
        let aside = amount.min(0.38);
        let up = ripple * (10.0 * amount).min(1.0);
        Reach::shifted(
            aabb([0.1, 0.5 - length, 0.0], [0.9, 0.5 + length, INF]),
            Vec3::new(-aside, 0.0, 0.0),
            Vec3::new(aside, 0.0, up),
        )
        // Two waves of the lips between the rim and the end of the reach.
        .with_detail(0.25 * (0.4 - aside).min(length))
    },
    grip: Grip::Number(|given| Vec3::new(0.5 + given.p[0].min(0.38), 0.5, 1.0), INF),
    icon: Icon {
        params: &[("amount", 0.26), ("ripple", 0.15)],
        yaw_pitch_deg: [148.0, 38.0],
        ..Icon::PLAIN
    },
};
