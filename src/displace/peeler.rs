use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about peeler but its formula. It is grabbed under the tip of its tongue.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        if given.p[0] == 0.0 {
            return Reach::NONE;
        }
        Reach::shifted(
            aabb([0.0; 3], [1.0, 1.0, INF]),
            Vec3::ZERO,
            Vec3::new(0.0, 0.0, given.p[0]),
        )
        .with_detail(0.15 * given.p[1])
        .torn()
    },
    grip: Grip::Number(|given| Vec3::new(0.5, 1.0, given.p[0]), INF),
    icon: Icon {
        at: [0.0, 0.0, 0.2],
        size: [1.0, 1.0, 0.6],
        params: &[("lift", 0.7)],
        yaw_pitch_deg: [32.0, 28.0],
    },
};
