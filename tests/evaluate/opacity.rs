//! Section 6.2.4: how opaque haze is that is pressed together or drawn apart, in each mode, against the integral along
//! the ray.

use super::bench::jacobian;
use crate::gpu::{gpu, studio_of, uniform_volume};
use crate::reference::{self, as_reference};
use fabrica::document::{
    Background, Illustration, OpacityMode, PlacedTemplate, Transfer, TransferPoint,
};
use fabrica::render::Studio;
use glam::DVec3;

pub(crate) const MODES: [(OpacityMode, &str); 3] = [
    (OpacityMode::Constancy, "constancy"),
    (OpacityMode::Mass, "mass"),
    (OpacityMode::None, "none"),
];

/// Opacity of 0.01 units.
const HAZE: f32 = 0.01;

/// A cube of one value.
pub(crate) fn haze() -> Studio {
    studio_of(gpu(), &uniform_volume(48), true)
}

fn scene(list: &[PlacedTemplate], mode: OpacityMode) -> Illustration {
    let mut scene = Illustration::document_default();
    scene.templates = list.to_vec();
    scene.look.opacity = mode;
    scene.look.background = Background::None;
    let point = |value| TransferPoint {
        value,
        color_srgb: [128; 3],
        opacity: HAZE,
    };
    scene.look.transfer = Transfer::Points(vec![point(0.0), point(9.0)]);
    scene
}

/// Share of the light that the ray through the middle loses: as drawn, and as the integral says.
pub(crate) fn stopped(studio: &Studio, list: &[PlacedTemplate], mode: OpacityMode) -> [f64; 2] {
    let image = studio.render_image(&scene(list, mode), [65, 65], 8);
    let image = pollster::block_on(image).expect("a picture");
    let drawn = f64::from(image.rgba[4 * (32 * 65 + 32) + 3]) / 255.0;
    let list = as_reference(list);
    let steps = 4_000;
    let length = 4.0 / f64::from(steps);
    let mut depth = 0.0;
    for i in 0..steps {
        let pos = DVec3::new(0.0, 2.0 - (f64::from(i) + 0.5) * length, 0.0);
        let (rest, a) = reference::map(&list, pos);
        if a < 0.0 || rest.abs().max_element() > 0.5 {
            continue;
        }
        let j = jacobian(&list, pos);
        depth += length
            * match mode {
                OpacityMode::Constancy => (j * DVec3::Y).length(),
                OpacityMode::Mass => j.determinant().abs(),
                OpacityMode::None => 1.0,
            };
    }
    [drawn, 1.0 - (1.0 - f64::from(HAZE)).powf(depth / 0.01)]
}
