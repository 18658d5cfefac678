use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// All that is known about peeler besides its formula. It is grabbed under the tip of its tongue.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "peeler",
        summary: "Lift a tongue of the top layer",
        params: &[
            number("lift", "Height at the tip", 0.5, 0.0, 2.0),
            number("width", "Width of the tongue", 1.0, 0.2, 1.0),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        if given.p[0] == 0.0 {
            return Reach::NONE;
        }
        Reach::shifted(
            aabb([0.0; 3], [1.0, 1.0, INF]),
            Vec3::ZERO,
            Vec3::new(0.0, 0.0, given.p[0]),
        )
        .with_detail(0.15 * given.p[1])
        .torn()
    },
    grip: Grip::Number(|given| Vec3::new(0.5, 1.0, given.p[0]), INF),
    icon: Icon {
        at: [0.0, 0.0, 0.2],
        size: [1.0, 1.0, 0.6],
        params: &[("lift", 0.7)],
        yaw_pitch_deg: [32.0, 28.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::OpenUp, 4)),
    shape: Shape {
        size: [0.8, 1.0, 0.6],
        above: 0.7,
    },
};
