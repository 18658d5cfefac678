use super::facts::{
    Amount, Facts, Given, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb,
};
use super::spec::{TemplateSpec, number};
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, TAU};

/// Radius up to which something turns, subject units.
fn radius(given: &Given) -> f32 {
    let flat = given.size.truncate();
    if given.p[1] > 0.0 {
        0.5 * flat.min_element()
    } else {
        0.5 * flat.length()
    }
}

/// All that is known about twist besides its formula. It is grabbed on its top face, at the edge of what turns as one.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "twist",
        summary: "Turn about the z axis",
        params: &[
            number(
                "angle",
                "Turn of the middle, radians",
                FRAC_PI_2,
                -2.0 * TAU,
                2.0 * TAU,
            ),
            number(
                "falloff",
                "0 turns the whole box, 1 falls off from the axis on",
                0.3,
                0.0,
                1.0,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        if given.p[0] == 0.0 {
            return Reach::NONE;
        }
        let radius = radius(given);
        let half = (Vec3::splat(radius) / given.size).min(Vec3::splat(0.5));
        // A point can end on the other side of the circle.
        let shift = (Vec3::splat(2.0 * radius) / given.size).with_z(0.0);
        Reach::shifted(
            aabb(
                [0.5 - half.x, 0.5 - half.y, 0.0],
                [0.5 + half.x, 0.5 + half.y, INF],
            ),
            -shift,
            shift,
        )
        .with_detail(if given.p[1] > 0.0 {
            // The turn changes by 3/falloff of the angle per unit across at most, and by the angle per unit along.
            (given.p[1] / 6.0).min(0.25 * given.p[1].min(1.0) / given.p[0].abs())
        } else {
            (0.25 / given.p[0].abs()).min(0.5)
        })
        .torn()
    },
    grip: Grip::Number(
        |given| {
            let inner = 0.5 * (1.0 - given.p[1]).max(0.5) * given.size.x.min(given.size.y);
            let (sin, cos) = given.p[0].sin_cos();
            Vec3::new(
                0.5 + inner * cos / given.size.x,
                0.5 + inner * sin / given.size.y,
                1.0,
            )
        },
        std::f32::consts::PI,
    ),
    icon: Icon {
        params: &[("angle", 0.9), ("falloff", 0.0)],
        ..Icon::PLAIN
    },
    mirror: Mirror {
        handed: &["angle"],
        ..Mirror::ACROSS_X
    },
    catalogue: Some((Group::Bend, 1)),
    shape: Shape::WHOLE,
};
