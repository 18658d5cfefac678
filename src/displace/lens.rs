use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape};
use super::spec::{TemplateSpec, number};
use crate::math::Aabb;
use glam::Vec3;

/// All that is known about lens besides its formula. Nothing in the picture is where its strength is, so it is a slider
/// along x, from the middle (0) to the side of the box (0.9).
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "lens",
        summary: "Magnify the middle of the box",
        params: &[number("strength", "How much", 0.5, 0.0, 0.9)],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        if given.p[0] == 0.0 {
            return Reach::NONE;
        }
        let shift = Vec3::splat(0.5 * given.p[0]);
        Reach::shifted(Aabb::UNIT, -shift, shift).with_detail(0.15)
    },
    grip: Grip::Number(
        |given| Vec3::new(0.5 + 0.5 / 0.9 * given.p[0], 0.5, 0.5),
        INF,
    ),
    icon: Icon {
        at: [-0.5, -0.5, 0.5],
        size: [1.2, 1.2, 1.2],
        params: &[("strength", 0.75)],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 5)),
    shape: Shape::CUBE,
};
