use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Shape};
use super::spec::{TemplateSpec, number};
use super::squeeze::reach;
use glam::Vec3;

/// All that is known about dilate besides its formula. It is grabbed at the bulge.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "dilate",
        summary: "A bulge at mid height",
        params: &[number("strength", "How wide", 0.5, 0.0, 0.9)],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach,
    // Outside the cube the displacement of its side goes on: x - strength/2 = 1.
    grip: Grip::Number(|given| Vec3::new(1.0 + 0.5 * given.p[0], 0.5, 0.5), INF),
    icon: Icon {
        size: [1.0, 1.0, 0.9],
        params: &[("strength", 0.45)],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 4)),
    shape: Shape::WHOLE,
};
