use super::facts::{
    Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb, sector,
};
use super::spec::{TemplateSpec, number};
use glam::Vec3;
use std::f32::consts::{PI, TAU};

/// All that is known about peel besides its formula. It is grabbed at its hinge, on the top.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "peel",
        summary: "Roll a layer up from its left edge",
        params: &[
            number(
                "progress",
                "How far along x the hinge has come",
                0.5,
                0.0,
                1.0,
            ),
            number(
                "depth",
                "Thickness of the layer under the top, fraction of z",
                0.3,
                0.01,
                1.0,
            ),
            number(
                "radius",
                "Inside of the roll, fraction of x",
                0.15,
                0.01,
                2.0,
            ),
            number(
                "angle",
                "Where the roll ends and the flap goes on straight, radians",
                PI,
                0.0,
                TAU,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let [progress, depth, radius, turn, ..] = given.p;
        if progress <= 0.0 || turn <= 0.0 {
            return Reach::NONE;
        }
        let size = given.size;
        let (hinge, thickness, inner) = (progress * size.x, depth * size.z, radius * size.x);
        let middle = inner + 0.5 * thickness;
        // The whole flap is as long as the hinge has come: first around, then straight on.
        let turned = turn.min(hinge / middle);
        let tail = (hinge - turned * middle).max(0.0);
        let (min, max) = sector(turned, inner, inner + thickness, tail);
        let center = glam::Vec2::new(hinge, size.z + inner);
        let flat = glam::Vec2::new(size.x, size.z);
        let (min, max) = ((center + min) / flat, (center + max) / flat);
        Reach::taken_out(
            aabb([0.0, 0.0, 1.0 - depth], [progress, 1.0, 1.0]),
            aabb([min.x, 0.0, min.y], [max.x, 1.0, max.y]),
        )
        .with_detail((0.6 * inner / size.x.max(size.z)).min(0.5))
    },
    grip: Grip::Number(|given| Vec3::new(given.p[0], 0.5, 1.0), INF),
    icon: Icon {
        params: &[("progress", 0.62), ("depth", 0.22), ("radius", 0.12)],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_Y,
    catalogue: Some((Group::OpenUp, 0)),
    shape: Shape::LAYER,
};
