use super::facts::{
    Amount, Facts, Given, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, aabb,
};
use super::noise::noise;
use super::spec::{ParamKind, ParamSpec, TemplateSpec, number};
use glam::Vec3;
use std::f32::consts::TAU;

/// The middle of the crack keeps away from the sides in x by this much.
const MARGIN: f32 = 0.05;
/// The opening takes at most this part of the room between the middle and a side.
const MOST: f32 = 0.9;

/// Where the middle of the crack lies in x, at a place of the cube.
fn middle(given: &Given, y: f32, z: f32) -> f32 {
    let [_, _, _, roughness, grain, seed, ripple, cycles] = given.p;
    let tall = given.size.z / given.size.y.max(1e-30);
    let grain = grain.max(1e-6);
    let jagged = noise(y / grain, z * tall / grain, (seed.max(0.0) + 0.5) as u32);
    let turns = cycles.abs() * if cycles >= 0.0 { y } else { z };
    let wave = (TAU * (turns - turns.round())).sin();
    (0.5 + roughness * jagged + ripple * wave).clamp(MARGIN, 1.0 - MARGIN)
}

/// Where the wall on the side of greater x lies in the middle of the top, where the opening is widest.
fn rim(given: &Given) -> f32 {
    let middle = middle(given, 0.5, 1.0);
    middle + (0.5 * given.p[0]).min(MOST * (1.0 - middle))
}

/// Half side of the boxes in which teeth and waves still show in differences.
fn detail(given: &Given) -> f32 {
    let [_, _, _, roughness, grain, _, ripple, cycles] = given.p;
    let mut detail = 0.2_f32;
    if roughness > 0.0 {
        // A quarter of a cell of the finest octave, along y or along z.
        let tall = given.size.z / given.size.y.max(1e-30);
        detail = detail.min(grain / 32.0 * (1.0 / tall.max(1e-6)).min(1.0));
    }
    if ripple > 0.0 {
        detail = detail.min(0.08 / cycles.abs().max(0.1));
    }
    detail
}

/// All that is known about crack besides its formula. It is grabbed at the rim of the opening, on the top. Its teeth
/// are not mirrored: no parameter tells them from those of the mirror image.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "crack",
        summary: "A jagged or rippled break down from the top, drawn apart along x",
        params: &[
            number("amount", "Width of the opening at the top", 0.1, 0.0, 0.8),
            number(
                "lens",
                "1 closes the opening at both ends in y",
                1.0,
                0.0,
                1.0,
            ),
            number("depth", "Depth, fraction of z", 1.0, 0.05, 1.0),
            number("roughness", "Height of the teeth", 0.08, 0.0, 0.3),
            number(
                "grain",
                "Size of the largest teeth, fraction of y",
                0.25,
                0.02,
                1.0,
            ),
            ParamSpec {
                name: "seed",
                summary: "Which of many cracks",
                kind: ParamKind::Count {
                    default: 0.0,
                    min: 0.0,
                    max: 999.0,
                },
            },
            number("ripple", "Height of the waves", 0.0, 0.0, 0.3),
            number(
                "cycles",
                "Number of waves: along y, or along z if negative",
                4.0,
                -32.0,
                32.0,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let [amount, lens, depth, ..] = given.p;
        if amount == 0.0 {
            return Reach::NONE;
        }
        let opening = (0.5 * amount).min(MOST * (1.0 - MARGIN));
        let shift = Vec3::new(opening, 0.0, 0.0);
        let bounds = aabb([0.0, 0.0, 1.0 - depth], [1.0, 1.0, INF]);
        let reach = Reach::shifted(bounds, -shift, shift).with_detail(detail(given));
        match lens < 1.0 {
            true => reach.torn(),
            false => reach,
        }
    },
    grip: Grip::Number(|given| Vec3::new(rim(given), 0.5, 1.0), INF),
    icon: Icon {
        params: &[
            ("amount", 0.4),
            ("lens", 0.0),
            ("roughness", 0.16),
            ("grain", 0.4),
        ],
        yaw_pitch_deg: [148.0, 38.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::TakeApart, 3)),
    shape: Shape::OPENING,
};
