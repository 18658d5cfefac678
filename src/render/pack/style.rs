//! An illustrator's look as the shaders take it.

use super::gpu_types::{self, HATCH_AXIS, HATCH_CURVATURE};
use super::look::linear_color;
use crate::document::{GhostBy, HatchBy, Style};
use glam::Vec3;

/// Angles between normals at which a line stands along a crease, for `creases` near 0 and at 1, degrees.
const CREASE_DEG: [f32; 2] = [110.0, 20.0];

/// The uniform of a style for a picture of this size, pixels, of a subject whose segments have these long axes and
/// patterns of strokes, and whose finest detail has this length, subject units. The traced pixels begin with row
/// `first_row` of the picture.
pub(crate) fn style_uniform(
    style: &Style,
    size_px: [f32; 2],
    (axes, patterns, detail): (&[Vec3; 256], &[u8; 256], f32),
    first_row: u32,
) -> gpu_types::Style {
    let px = size_px[0].min(size_px[1]) / 1000.0;
    let color = |srgb| linear_color(srgb).extend(1.0).to_array();
    let creases = style.outline.creases;
    let angle = CREASE_DEG[0] + (CREASE_DEG[1] - CREASE_DEG[0]) * creases;
    gpu_types::Style {
        outline_color: color(style.outline.color_srgb),
        warm: color(style.tone.warm_srgb),
        cool: color(style.tone.cool_srgb),
        hatch_color: color(style.hatch.color_srgb),
        stipple_color: color(style.stipple.color_srgb),
        axes: std::array::from_fn(|label| {
            axes[label].extend(f32::from(patterns[label])).to_array()
        }),
        outline_px: style.outline.width * px,
        // No two normals differ by more than the angle of the cosine -1.
        crease_cosine: if creases > 0.0 {
            angle.to_radians().cos()
        } else {
            -2.0
        },
        levels: style.tone.levels as f32,
        tone: style.tone.strength,
        hatch_spacing_px: style.hatch.spacing * px,
        hatch_width_px: style.hatch.width * px,
        hatch: style.hatch.strength,
        hatch_by: match style.hatch.by {
            HatchBy::Curvature => HATCH_CURVATURE,
            HatchBy::Axis => HATCH_AXIS,
        },
        stipple_spacing_px: style.stipple.spacing * px,
        stipple_size_px: style.stipple.size * px,
        stipple: style.stipple.strength,
        vignette: match style.ghost.by {
            GhostBy::Cut => style.ghost.strength,
            GhostBy::Facing => 0.0,
        },
        detail,
        first_row,
        padding: [0; 2],
    }
}

/// How many rows of pixels beyond its own a part of a picture of this size takes into account.
pub(crate) fn style_margin(style: &Style, size_px: [u32; 2]) -> u32 {
    let px = size_px[0].min(size_px[1]) as f32 / 1000.0;
    let strokes = match style.hatch.strength > 0.0 {
        true => style.hatch.spacing * px,
        false => 0.0,
    };
    // The next pixels, and the farthest of an outline and of a curvature.
    let farthest = (style.outline.width * px).max(strokes).max(4.0);
    farthest.ceil() as u32 + 2
}
