use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;
use std::f32::consts::TAU;

/// Where the first crest lies, template units from the axis, and its weight.
fn crest(frequency: f32, falloff: f32) -> (f32, f32) {
    let rho = (std::f32::consts::FRAC_PI_2 / frequency.max(1e-3)).min(0.35);
    let t = ((rho - 0.5 + 0.5 * falloff) / (0.5 * falloff).max(1e-6)).clamp(0.0, 1.0);
    let weight = if falloff > 0.0 {
        1.0 - t * t * (3.0 - 2.0 * t)
    } else {
        1.0
    };
    (rho, weight * (frequency * rho).sin())
}

/// All that is known about wave besides its formula. It is grabbed at its first crest, on the face that it ripples.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "wave",
        summary: "Concentric ripple along y",
        params: &[
            number("amplitude", "Height of the ripple", 0.08, 0.0, 0.5),
            number(
                "frequency",
                "Radians per unit of radius",
                2.0 * TAU,
                0.0,
                64.0,
            ),
            number(
                "falloff",
                "0 ripples the whole box, 1 falls off from the axis on",
                0.5,
                0.0,
                1.0,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let amplitude = given.p[0];
        if amplitude == 0.0 || given.p[1] == 0.0 {
            return Reach::NONE;
        }
        let shift = Vec3::new(0.0, amplitude, 0.0);
        Reach::shifted(aabb([0.0, -INF, 0.0], [1.0, INF, 1.0]), -shift, shift)
            .with_detail((0.5 / given.p[1]).min(if given.p[2] > 0.0 {
                given.p[2] / 6.0
            } else {
                0.5
            }))
            .torn()
    },
    grip: Grip::Number(
        |given| {
            let (rho, height) = crest(given.p[1], given.p[2]);
            Vec3::new(0.5 + rho, -given.p[0] * height, 0.5)
        },
        INF,
    ),
    icon: Icon {
        params: &[("amplitude", 0.1), ("frequency", 25.0)],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Bend, 2)),
    shape: Shape::WHOLE,
};
