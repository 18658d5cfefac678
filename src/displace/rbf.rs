use super::facts::{Amount, Facts, Grip, Group, Holds, Icon, Mirror, Reach, Shape};
use super::interpolant::Interpolant;
use super::points::ControlPoint;
use super::spec::{ParamKind, ParamSpec, TemplateSpec, number};
use crate::math::Aabb;
use glam::Vec3;

/// All that is known about rbf besides its formula. Its control points have handles of their own.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "rbf",
        summary: "Displacements at control points, interpolated",
        params: &[
            number("strength", "Times the displacements", 1.0, 0.0, 2.0),
            number(
                "softness",
                "Reach of a control point, fractions of the box",
                0.2,
                0.01,
                2.0,
            ),
            number(
                "exponent",
                "Of the multiquadric; -0.5 is smooth and local",
                -0.5,
                -2.0,
                0.9,
            ),
            ParamSpec {
                name: "extrude",
                summary: "Control points count in x and y alone, for every z",
                kind: ParamKind::Flag { default: false },
            },
            number(
                "falloff",
                "0 extrudes through the whole box, 1 falls off from its middle on",
                0.3,
                0.0,
                1.0,
            ),
            number(
                "edge",
                "Width over which it ends at the faces of the box",
                0.0,
                0.0,
                0.5,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Points,
    amount: Amount::Parameters,
    reach: |given| {
        let [least, most] = Interpolant::of(given).shift();
        if least == Vec3::ZERO && most == Vec3::ZERO {
            return Reach::NONE;
        }
        let has_cut = given
            .points
            .as_ref()
            .is_some_and(|points| points.cut.len() > 1);
        // The map is smooth as far as the points' reach goes; across a cut differences say nothing.
        let detail = if has_cut {
            0.0
        } else {
            0.25 * given.p[1].clamp(0.05, 0.6)
        };
        // Forwards is the negative.
        let reach = Reach::shifted(Aabb::UNIT, -most, -least).with_detail(detail);
        if given.p[5] > 0.0 {
            reach
        } else {
            reach.torn()
        }
    },
    grip: Grip::None,
    // The top is drawn up to one side and down on the other.
    icon: Icon {
        points: &[
            point([0.0, 0.0, 0.0], [0.0, 0.0]),
            point([1.0, 0.0, 0.0], [0.0, 0.0]),
            point([0.0, 1.0, 0.0], [0.0, 0.0]),
            point([1.0, 1.0, 0.0], [0.0, 0.0]),
            point([0.3, 0.3, 0.8], [-0.1, -0.3]),
            point([0.75, 0.7, 0.8], [0.1, 0.2]),
        ],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 6)),
    shape: Shape::CUBE,
};

/// A control point with a shift in x and z.
const fn point(at: [f32; 3], [x, z]: [f32; 2]) -> ControlPoint {
    ControlPoint {
        at: Vec3::from_array(at),
        shift: Vec3::new(x, 0.0, z),
    }
}
