use super::facts::{Facts, Grip, INF, Icon};
use super::squeeze::reach;
use glam::Vec3;

/// Everything about dilate but its formula. It is grabbed at the bulge.
pub(super) const FACTS: Facts = Facts {
    reach,
    // Outside the cube the displacement of its side goes on: x - strength/2 = 1.
    grip: Grip::Number(|given| Vec3::new(1.0 + 0.5 * given.p[0], 0.5, 0.5), INF),
    icon: Icon {
        size: [1.0, 1.0, 0.9],
        params: &[("strength", 0.45)],
        ..Icon::PLAIN
    },
};
