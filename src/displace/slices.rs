use super::facts::{Facts, Grip, INF, Icon, Reach, aabb};
use glam::Vec3;

/// Everything about slices but its formula. It is grabbed at the underside of the last slab.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let [count, gap, shift, progress, ..] = given.p;
        let (gap, shift) = (gap * progress, shift * progress);
        if count < 1.5 || (gap == 0.0 && shift == 0.0) {
            return Reach::NONE;
        }
        let last = (count + 0.5).floor() - 1.0;
        let sideways = shift * last;
        // The first slab stays where it is.
        Reach::shifted(
            aabb([-INF, -INF, 1.0 / (last + 1.0)], [INF; 3]),
            Vec3::new(sideways.min(0.0), 0.0, 0.0),
            Vec3::new(sideways.max(0.0), 0.0, gap * last),
        )
        .with_detail(0.4 / (last + 1.0))
    },
    grip: Grip::Number(
        |given| {
            let [count, gap, shift, progress, ..] = given.p;
            let last = (count + 0.5).floor() - 1.0;
            Vec3::new(
                0.5 + shift * progress * last,
                0.5,
                last * (1.0 / (last + 1.0) + gap * progress),
            )
        },
        INF,
    ),
    icon: Icon {
        at: [0.0, 0.0, -0.15],
        params: &[("count", 4.0), ("gap", 0.12), ("shift", 0.06)],
        ..Icon::PLAIN
    },
};
