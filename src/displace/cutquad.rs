use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// All that is known about cutquad besides its formula. It is grabbed at the wound's rim, on the top.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "cutquad",
        summary: "An incision along y with lips that bulge",
        params: &[
            number("amount", "Half opening at the top", 0.3, 0.0, 0.4),
            number("length", "Half length of the incision", 0.45, 0.05, 0.5),
            number("ripple", "Height of the bulging lips", 0.1, 0.0, 0.5),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let [amount, length, ripple, ..] = given.p;
        if amount == 0.0 {
            return Reach::NONE;
        }
        let aside = amount.min(0.38);
        let up = ripple * (10.0 * amount).min(1.0);
        Reach::shifted(
            aabb([0.1, 0.5 - length, 0.0], [0.9, 0.5 + length, INF]),
            Vec3::new(-aside, 0.0, 0.0),
            Vec3::new(aside, 0.0, up),
        )
        // Two waves of the lips between the rim and the end of the reach.
        .with_detail(0.25 * (0.4 - aside).min(length))
    },
    grip: Grip::Number(|given| Vec3::new(0.5 + given.p[0].min(0.38), 0.5, 1.0), INF),
    icon: Icon {
        params: &[("amount", 0.26), ("ripple", 0.15)],
        yaw_pitch_deg: [148.0, 38.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::OpenUp, 3)),
    shape: Shape::OPENING,
};
