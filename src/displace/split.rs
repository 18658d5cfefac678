use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{ParamKind, ParamSpec, TemplateSpec, number};
use glam::Vec3;

/// All that is known about split besides its formula. It is grabbed at the rim of the opening, on the top.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "split",
        summary: "Two halves apart along x",
        params: &[
            number("amount", "Half width of the opening", 0.25, 0.0, 1.0),
            number(
                "lens",
                "1 closes the opening at both ends in y",
                0.0,
                0.0,
                1.0,
            ),
            ParamSpec {
                name: "wedge",
                summary: "Closed at the bottom, open at the top",
                kind: ParamKind::Flag { default: true },
            },
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
        let low = if given.p[2] > 0.5 { 0.0 } else { -INF };
        let shift = Vec3::new(amount, 0.0, 0.0);
        Reach::shifted(aabb([-INF, -INF, low], [INF; 3]), -shift, shift).with_detail(0.2)
    },
    grip: Grip::Number(|given| Vec3::new(0.5 + given.p[0], 0.5, 1.0), INF),
    icon: Icon {
        params: &[("amount", 0.2)],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::TakeApart, 0)),
    shape: Shape::OPENING,
};
