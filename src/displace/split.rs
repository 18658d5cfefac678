use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about split but its formula. It is grabbed at the rim of the opening, on the top.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let amount = given.p[0];
        if amount == 0.0 {
            return Reach::NONE;
        }
        let low = if given.p[2] > 0.5 { 0.0 } else { -INF };
        let shift = Vec3::new(amount, 0.0, 0.0);
        Reach::shifted(aabb([-INF, -INF, low], [INF; 3]), -shift, shift).with_detail(0.2)
    },
    grip: Grip::Number(|given| Vec3::new(0.5 + given.p[0], 0.5, 1.0), INF),
    icon: Icon {
        params: &[("amount", 0.2)],
        ..Icon::PLAIN
    },
};
