use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{ParamKind, ParamSpec, TemplateSpec, number};
use glam::Vec3;

/// All that is known about slices besides its formula. It is grabbed at the underside of the last slab.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "slices",
        summary: "Cut into slabs along z and draw them apart",
        params: &[
            ParamSpec {
                name: "count",
                summary: "Number of slabs",
                kind: ParamKind::Count {
                    default: 4.0,
                    min: 1.0,
                    max: 32.0,
                },
            },
            number("gap", "Between two slabs", 0.1, 0.0, 2.0),
            number("shift", "Sideways, along x, per slab", 0.0, -1.0, 1.0),
            number("progress", "0 closed, 1 drawn apart", 1.0, 0.0, 1.0),
        ],
        main_param: Some(3),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let [count, gap, shift, progress, ..] = given.p;
        // The slabs' edges may be finer than a cell, but a slab is never off by more than one gap and one shift.
        let ripple = Vec3::new(shift.abs(), 0.0, gap) * progress;
        let (gap, shift) = (gap * progress, shift * progress);
        if count < 1.5 || (gap == 0.0 && shift == 0.0) {
            return Reach::NONE.rippled(ripple);
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
        .rippled(ripple)
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
    mirror: Mirror::ACROSS_Y,
    catalogue: Some((Group::TakeApart, 1)),
    shape: Shape::WHOLE,
};
