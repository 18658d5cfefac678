use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about retractor but its formula. It is grabbed at the wound's rim, on the top.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let [amount, _, reach, ..] = given.p;
        if amount == 0.0 {
            return Reach::NONE;
        }
        let shift = Vec3::new(0.0, amount.min(0.95 * reach), 0.0);
        Reach::shifted(
            aabb([0.0, 0.5 - reach, 0.0], [1.0, 0.5 + reach, INF]),
            -shift,
            shift,
        )
        .with_detail(0.3 * reach.min(given.p[1]))
    },
    grip: Grip::Number(
        |given| Vec3::new(0.5, 0.5 + given.p[0].min(0.95 * given.p[2]), 1.0),
        INF,
    ),
    icon: Icon {
        params: &[("amount", 0.28), ("length", 0.4)],
        yaw_pitch_deg: [148.0, 38.0],
        ..Icon::PLAIN
    },
};
