//! The cube: three strata along z with a ball among them and a grid engraved on the faces, so that every template shows
//! what it does to it.

use glam::Vec3;

use super::bar::{groove, rounded_box};
use super::lanes::Lanes;
use super::paint::{Block, Canvas, Model, ROWS, SegmentSpec, border_width, segment};

/// Half an edge, mm.
const HALF_MM: f32 = 48.0;
/// Radius of the ball, mm.
const BALL_MM: f32 = 25.0;
/// Lower edges of the two upper strata, mm.
const STRATA_MM: [f32; 2] = [28.0, -6.0];

const SEGMENTS: &[SegmentSpec] = &[
    segment("top", [226, 172, 140]),
    segment("middle", [240, 208, 120]),
    segment("bottom", [176, 84, 74]),
    segment("ball", [104, 146, 188]),
];

/// The cube, 100 mm wide, painted from distances; it holds no data.
pub(super) struct Cube;

impl Model for Cube {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (Vec3::splat(-50.0), Vec3::splat(50.0))
    }

    fn segments(&self) -> &'static [SegmentSpec] {
        SEGMENTS
    }

    fn value_range(&self) -> [f32; 2] {
        [-1000.0, 1000.0]
    }

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let width = border_width(block.spacing);
        for row in 0..ROWS {
            let p = block.row(row);
            // Where two engraved lines would meet a third family runs along the face itself: there it only lowers the
            // face.
            let lines = groove(p.x, 2.0 * HALF_MM / 6.0, 0.8)
                .max(groove(p.y, 2.0 * HALF_MM / 6.0, 0.8))
                .max(groove(p.z, 2.0 * HALF_MM / 6.0, 0.8));
            let cube = rounded_box(p, Vec3::splat(HALF_MM), 4.0) + lines;
            if cube.lowest() > width {
                continue;
            }
            out.lay(row, cube, width, Lanes::splat(120.0), 3);
            let inside = |d: Lanes| d.max(cube);
            // Strata change the value inside only: the outer border was laid above with its own smoothness.
            for (index, value) in [(1, -60.0), (0, 40.0)] {
                let above = Lanes::splat(STRATA_MM[index]) - p.z;
                out.lay(
                    row,
                    inside(above),
                    width,
                    Lanes::splat(value),
                    index as u8 + 1,
                );
            }
            let ball = (p.x * p.x + p.y * p.y + p.z * p.z).sqrt() - BALL_MM;
            out.lay(row, ball, width, Lanes::splat(900.0), 4);
        }
    }
}
