use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// All that is known about hole besides its formula. It is grabbed at its rim, on the top.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "hole",
        summary: "Push a round opening aside, along z",
        params: &[
            number("amount", "Radius at the top", 0.25, 0.0, 0.45),
            number(
                "taper",
                "Radius at the bottom as a fraction of it",
                1.0,
                0.0,
                1.0,
            ),
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
        let shift = Vec3::new(amount.min(0.475), amount.min(0.475), 0.0);
        Reach::shifted(aabb([0.0, 0.0, -INF], [1.0, 1.0, INF]), -shift, shift).with_detail(0.15)
    },
    grip: Grip::Number(|given| Vec3::new(0.5 + given.p[0], 0.5, 1.0), INF),
    icon: Icon {
        params: &[("taper", 0.5)],
        yaw_pitch_deg: [148.0, 40.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::OpenUp, 5)),
    shape: Shape::OPENING,
};
