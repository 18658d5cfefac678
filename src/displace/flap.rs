use super::facts::{
    Amount, Facts, Given, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb,
};
use super::spec::{TemplateSpec, number};
use crate::math::Aabb;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, PI};

/// Where a point of the closed door (template space) is when it is open.
fn opened(given: &Given, q: Vec3) -> Vec3 {
    let (sin, cos) = given.p[0].sin_cos();
    let (x, z) = (q.x * given.size.x, (q.z - 1.0) * given.size.z);
    Vec3::new(
        (x * cos - z * sin) / given.size.x,
        q.y,
        1.0 + (x * sin + z * cos) / given.size.z,
    )
}

/// All that is known about flap besides its formula. It is grabbed at the middle of its free edge.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "flap",
        summary: "A door that opens about its upper left edge",
        params: &[
            number("angle", "How far it is open, radians", FRAC_PI_2, 0.0, PI),
            number(
                "depth",
                "Thickness of the door under the top, fraction of z",
                0.3,
                0.01,
                1.0,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        if given.p[0] <= 0.0 {
            return Reach::NONE;
        }
        let door = aabb([0.0, 0.0, 1.0 - given.p[1]], [1.0; 3]);
        let corners = door.corners().map(|q| opened(given, q));
        Reach::taken_out(door, Aabb::from_points(corners))
    },
    grip: Grip::Number(|given| opened(given, Vec3::new(1.0, 0.5, 1.0)), INF),
    icon: Icon {
        at: [0.05, 0.0, 0.0],
        size: [0.8, 0.8, 1.0],
        params: &[("angle", 1.9), ("depth", 0.2)],
        yaw_pitch_deg: [212.0, 32.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_Y,
    catalogue: Some((Group::OpenUp, 1)),
    shape: Shape::LAYER,
};
