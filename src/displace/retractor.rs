use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// All that is known about retractor besides its formula. It is grabbed at the wound's rim, on the top.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "retractor",
        summary: "Draw an incision along x open, compressing the tissue beside it",
        params: &[
            number("amount", "Half opening at the top", 0.3, 0.0, 0.4),
            number("length", "Half length of the incision", 0.5, 0.05, 1.0),
            number("reach", "How far beside it tissue gives way", 0.4, 0.1, 0.5),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let [amount, _, reach, ..] = given.p;
        if amount == 0.0 {
            return Reach::NONE;
        }
        let shift = Vec3::new(0.0, amount.min(0.95 * reach), 0.0);
        Reach::shifted(
            aabb([0.0, 0.5 - reach, 0.0], [1.0, 0.5 + reach, INF]),
            -shift,
            shift,
        )
        .with_detail(0.3 * reach.min(given.p[1]))
    },
    grip: Grip::Number(
        |given| Vec3::new(0.5, 0.5 + given.p[0].min(0.95 * given.p[2]), 1.0),
        INF,
    ),
    icon: Icon {
        params: &[("amount", 0.28), ("length", 0.4)],
        yaw_pitch_deg: [148.0, 38.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::OpenUp, 2)),
    shape: Shape::OPENING,
};
