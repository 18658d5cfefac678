use super::facts::{Facts, Grip, Icon, Reach};
use crate::math::Aabb;
use glam::{Quat, Vec3};

/// Everything about move but its formula. It is grabbed at the middle of the moved box.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let p = given.p;
        let offset = Vec3::new(p[0], p[1], p[2]);
        let turn = Quat::from_xyzw(p[3], p[4], p[5], p[6]);
        if offset == Vec3::ZERO && turn.xyz() == Vec3::ZERO {
            return Reach::NONE;
        }
        let corners = Aabb::UNIT
            .corners()
            .map(|q| turn * (given.size * (q - 0.5)) / given.size + offset + 0.5);
        Reach::taken_out(Aabb::UNIT, Aabb::from_points(corners))
    },
    grip: Grip::Vector,
    icon: Icon {
        at: [-0.25, -0.25, 0.25],
        size: [0.5, 0.5, 0.5],
        params: &[],
        yaw_pitch_deg: [148.0, 28.0],
    },
};
