use super::facts::{Amount, Facts, Grip, Group, Holds, Icon, Mirror, Reach, Shape};
use super::spec::{ParamKind, ParamSpec, TemplateSpec};
use crate::math::Aabb;
use glam::Vec3;

/// All that is known about pull besides its formula. It is grabbed at the tip of its vector.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "pull",
        summary: "Draw the middle of the box along a vector",
        params: &[ParamSpec {
            name: "offset",
            summary: "Where the middle goes, fractions of the box",
            kind: ParamKind::Vector {
                default: [0.0, 0.0, 0.25],
                min: -0.3,
                max: 0.3,
                max_length: 0.3,
            },
        }],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let offset = Vec3::new(given.p[0], given.p[1], given.p[2]);
        if offset == Vec3::ZERO {
            return Reach::NONE;
        }
        Reach::shifted(Aabb::UNIT, offset.min(Vec3::ZERO), offset.max(Vec3::ZERO)).with_detail(0.15)
    },
    grip: Grip::Vector,
    icon: Icon {
        at: [0.0, 0.0, 0.4],
        size: [1.1, 1.1, 1.2],
        ..Icon::PLAIN
    },
    mirror: Mirror {
        handed: &["offset"],
        ..Mirror::ACROSS_X
    },
    catalogue: Some((Group::Carve, 2)),
    shape: Shape::CUBE,
};
