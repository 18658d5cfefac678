use super::facts::{Facts, Grip, Icon, Reach};
use crate::math::Aabb;
use glam::Vec3;

/// Everything about pull but its formula. It is grabbed at the tip of its vector.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let offset = Vec3::new(given.p[0], given.p[1], given.p[2]);
        if offset == Vec3::ZERO {
            return Reach::NONE;
        }
        Reach::shifted(Aabb::UNIT, offset.min(Vec3::ZERO), offset.max(Vec3::ZERO)).with_detail(0.15)
    },
    grip: Grip::Vector,
    icon: Icon {
        at: [0.0, 0.0, 0.4],
        size: [1.1, 1.1, 1.2],
        ..Icon::PLAIN
    },
};
