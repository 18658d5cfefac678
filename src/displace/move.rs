use super::facts::{Amount, Facts, Grip, Group, Holds, Icon, Mirror, Reach, Shape};
use super::spec::{ParamKind, ParamSpec, TemplateSpec};
use crate::math::Aabb;
use glam::{Quat, Vec3};

/// All that is known about move besides its formula. It is grabbed at the middle of the moved box.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "move",
        summary: "Take the box out whole and put it elsewhere",
        params: &[
            ParamSpec {
                name: "offset",
                summary: "How far, fractions of the box",
                kind: ParamKind::Vector {
                    default: [0.0, 0.0, 0.6],
                    min: -10.0,
                    max: 10.0,
                    max_length: f32::INFINITY,
                },
            },
            ParamSpec {
                name: "turn",
                summary: "Turned about its centre",
                kind: ParamKind::Rotation,
            },
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let p = given.p;
        let offset = Vec3::new(p[0], p[1], p[2]);
        let turn = Quat::from_xyzw(p[3], p[4], p[5], p[6]);
        if offset == Vec3::ZERO && turn.xyz() == Vec3::ZERO {
            return Reach::NONE;
        }
        let corners = Aabb::UNIT
            .corners()
            .map(|q| turn * (given.size * (q - 0.5)) / given.size + offset + 0.5);
        Reach::taken_out(Aabb::UNIT, Aabb::from_points(corners))
    },
    grip: Grip::Vector,
    icon: Icon {
        at: [-0.25, -0.25, 0.25],
        size: [0.5, 0.5, 0.5],
        ..Icon::PLAIN
    },
    mirror: Mirror {
        handed: &["offset", "turn"],
        ..Mirror::ACROSS_X
    },
    catalogue: Some((Group::TakeApart, 2)),
    shape: Shape {
        size: [0.9, 0.9, 0.7],
        above: 0.3,
    },
};
