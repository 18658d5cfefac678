use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about poke but its formula. It is grabbed at the top of its bump.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let amount = given.p[0];
        if amount == 0.0 {
            return Reach::NONE;
        }
        // Upwards by `amount` at the top and above; downwards, where it pushes, by no more.
        Reach::shifted(
            aabb([0.0; 3], [1.0, 1.0, INF]),
            Vec3::new(0.0, 0.0, amount.min(0.0)),
            Vec3::new(0.0, 0.0, amount.max(0.0)),
        )
        .with_detail(0.7 * given.p[1])
    },
    grip: Grip::Number(
        |given| {
            let amount = given.p[0];
            // Above the cube the push carries: z - amount = 1. Within it: z (1 - amount) = 1.
            let top = if amount >= 0.0 {
                1.0 + amount
            } else {
                1.0 / (1.0 - amount)
            };
            Vec3::new(0.5, 0.5, top)
        },
        INF,
    ),
    icon: Icon {
        size: [1.0, 1.0, 0.8],
        at: [0.0, 0.0, 0.1],
        params: &[("amount", 0.45)],
        ..Icon::PLAIN
    },
};
