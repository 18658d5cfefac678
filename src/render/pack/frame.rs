//! The uniform of one sample of a picture: camera, sampling and the length of a step.

use super::gpu_types::Frame;
use super::view::View;
use crate::math::Aabb;

/// Length of a step, in voxels of the finest spacing. Crossings are found exactly at any step; this is for thin things
/// and haze.
const STEP: f32 = 0.75;
/// Steps are never longer than this, in voxels and in subject units, whichever is longer: the skip grid is made for
/// steps of this length.
const LONGEST_STEP_VOXELS: f32 = 1.25;
const LONGEST_STEP: f32 = 0.009;

/// The longest step that any ray takes through a subject whose finest detail has this length.
pub(crate) fn longest_step(detail: f32) -> f32 {
    (LONGEST_STEP_VOXELS * detail).max(LONGEST_STEP)
}

/// Uniform of sample `index` of a picture of a subject whose finest detail has this length, subject units. The same
/// for the same index on every machine: nothing is random.
///
/// `finished` is the view of the finished picture. A quick picture of fewer pixels takes the steps of the finished one:
/// the colour of a surface counts for the whole step behind the surface, so that longer steps change the light. With
/// steps made for its own pixels, a quick picture of half transparent tissue differed by up to 7 levels of 255 in the
/// mean.
pub(crate) fn frame_of(
    view: &View,
    finished: &View,
    bounds: Aabb,
    detail: f32,
    index: u32,
) -> Frame {
    let distance = (view.eye() - bounds.center()).length();
    // Finer than a pixel is lost on the picture.
    let step = (detail * STEP)
        .max(0.6 * finished.units_per_pixel(distance))
        .min(longest_step(detail));
    let k = index as f32;
    // Rank-1 lattice with the plastic number: the first samples already lie well apart (Roberts 2018).
    let place = |ratio: f32| (0.5 + k * ratio).fract();
    let margin = 1.5 * step;
    let min = bounds.min - margin;
    let max = bounds.max + margin;
    Frame {
        subject_from_view: view.subject_from_view.into(),
        lens: view.lens.to_array(),
        size_px: view.size_px.to_array(),
        jitter: [place(0.754_877_7), place(0.569_840_3)],
        first_step: place(0.618_034),
        occlusion_turn: k * 2.399_963,
        bounds_min: min.extend(0.0).to_array(),
        bounds_max: max.extend(0.0).to_array(),
        step,
        first_row: 0.0,
        is_finished: 1,
        padding: 0,
    }
}

impl Frame {
    /// For a quick picture of what moves: rims of flaps may have gaps where they are thinner than a step, smooth
    /// surfaces show layers of voxels, and shadows are grainy.
    pub(crate) fn of_what_moves(self) -> Frame {
        Frame {
            is_finished: 0,
            ..self
        }
    }
}
