use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use crate::math::Aabb;

/// Everything about cut but its formula. It has no main parameter: it is moved and sized as a whole.
pub(super) const FACTS: Facts = Facts {
    reach: |given| Reach {
        boxes: [
            if given.p[0] > 2.5 {
                aabb([-INF, -INF, 0.5], [INF; 3])
            } else {
                Aabb::UNIT
            },
            Aabb::EMPTY,
        ],
        detail: INF,
        ..Reach::NONE
    },
    grip: Grip::None,
    icon: Icon {
        at: [-0.3, -0.3, 0.3],
        size: [0.8, 0.8, 0.8],
        ..Icon::PLAIN
    },
};
