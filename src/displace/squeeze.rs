use super::facts::{
    Amount, Facts, Given, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb,
};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// What squeeze and dilate reach: they move by half their strength at the sides and beyond.
pub(super) fn reach(given: &Given) -> Reach {
    let strength = given.p[0];
    if strength == 0.0 {
        return Reach::NONE;
    }
    let shift = Vec3::new(0.5 * strength, 0.5 * strength, 0.0);
    Reach::shifted(aabb([-INF, -INF, 0.0], [INF, INF, 1.0]), -shift, shift).with_detail(0.05)
}

/// All that is known about squeeze besides its formula. It is grabbed at the waist.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "squeeze",
        summary: "A waist at mid height",
        params: &[number("strength", "How narrow", 0.5, 0.0, 2.0)],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach,
    grip: Grip::Number(
        |given| Vec3::new(0.5 + 0.5 / (1.0 + given.p[0]), 0.5, 0.5),
        INF,
    ),
    icon: Icon {
        params: &[("strength", 0.8)],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 3)),
    shape: Shape::WHOLE,
};
