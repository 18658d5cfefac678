//! The planes beyond which the tool in hand has its mirror images, faintly over the picture.

use egui::{Color32, Stroke, Ui};
use glam::Vec3;

use super::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::Session;
use crate::math::Aabb;

/// The squares stand off what they go around by so much of its longest side.
const OFF: f32 = 0.06;
/// Pieces of a side: where a part of it lies behind the eye, the rest is drawn.
const PIECES: u8 = 16;
/// Width of a line, points, and how much of it is seen.
const WIDTH: f32 = 1.0;
const SEEN: f32 = 0.75;
/// The same of its halo, which tells it from a picture of its colour.
const HALO_WIDTH: f32 = 2.6;
const HALO_SEEN: f32 = 0.3;

/// Draws a square around the object for each axis along which the tool in hand is mirrored, in the colour of that axis.
/// While the picture is presented alone there is none.
pub(crate) fn paint(ui: &Ui, view: &Projection, session: &Session) {
    let Some(subject) = &session.view.subject else {
        return;
    };
    if session.are_panels_hidden {
        return;
    }
    let painter = ui.painter_at(view.rect);
    let mirror = session.hand().mirror;
    let colors = [ink::X, ink::Y, ink::Z];
    for (axis, color) in colors.into_iter().enumerate() {
        if !mirror[axis] {
            continue;
        }
        let ring = square(&subject.bounds, axis);
        let spots: Vec<_> = ring.iter().map(|pos| view.ui_from_subject(*pos)).collect();
        let lines = |width: f32, color: Color32| {
            for piece in spots.windows(2) {
                if let [Some(from), Some(to)] = *piece {
                    painter.line_segment([from, to], Stroke::new(width, color));
                }
            }
        };
        lines(HALO_WIDTH, ink::HALO_LIGHT.gamma_multiply(HALO_SEEN));
        lines(WIDTH, color.gamma_multiply(SEEN));
    }
}

/// The places along the sides of a square in the middle plane across an axis, once around: it goes around the part of a
/// box that lies in that plane. Subject space.
fn square(bounds: &Aabb, axis: usize) -> Vec<Vec3> {
    let off = OFF * bounds.size().max_element();
    let [low, high] = [bounds.min - off, bounds.max + off];
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let corner = |[right, up]: [bool; 2]| {
        let mut pos = Vec3::ZERO;
        pos[u] = if right { high[u] } else { low[u] };
        pos[v] = if up { high[v] } else { low[v] };
        pos
    };
    let around = [[false, false], [true, false], [true, true], [false, true]].map(corner);
    let sides = around.into_iter().zip(around.into_iter().cycle().skip(1));
    let pieces = sides.flat_map(|(from, to)| {
        (0..PIECES).map(move |i| from.lerp(to, f32::from(i) / f32::from(PIECES)))
    });
    pieces.chain([around[0]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_lies_in_its_plane_and_goes_around_the_box() {
        let bounds = Aabb {
            min: Vec3::new(-0.2, -0.5, -0.1),
            max: Vec3::new(0.4, 0.3, 0.9),
        };
        for axis in 0..3 {
            let ring = square(&bounds, axis);
            assert_eq!(ring.first(), ring.last(), "it is closed");
            assert!(
                ring.iter().all(|pos| pos[axis] == 0.0),
                "in the plane of {axis}"
            );
            let around = Aabb::from_points(ring);
            for side in (0..3).filter(|side| *side != axis) {
                assert!((around.min[side] - bounds.min[side] + OFF).abs() < 1e-6);
                assert!((around.max[side] - bounds.max[side] - OFF).abs() < 1e-6);
            }
        }
    }
}
