use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// All that is known about poke besides its formula. It is grabbed at the top of its bump.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "poke",
        summary: "Push in or pull out a bump along z",
        params: &[
            number("amount", "Height; positive pulls out", 0.5, -2.0, 0.95),
            number("sigma", "Width of the bump", 0.15, 0.05, 0.3),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
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
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 1)),
    shape: Shape {
        size: [0.9, 0.9, 0.6],
        above: 0.2,
    },
};
