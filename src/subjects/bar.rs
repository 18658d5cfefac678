//! The bar: a core in a soft shell, along y, with rings engraved so that bending shows.

use glam::Vec3;

use super::lanes::{Lanes, Points};
use super::paint::{Block, Canvas, Model, ROWS, SegmentSpec, border_width, segment};

/// Half size of the shell, mm.
const SHELL: Vec3 = Vec3::new(32.0, 97.0, 32.0);
/// Half size of the core, mm.
const CORE: Vec3 = Vec3::new(13.0, 85.0, 13.0);
/// Between the engraved rings, mm.
const RING_MM: f32 = 19.4;

const SEGMENTS: &[SegmentSpec] = &[
    segment("shell", [216, 150, 120]),
    segment("core", [238, 226, 196]),
];

/// The bar, 70 by 200 by 70 mm, painted from distances; it holds no data.
pub(super) struct Bar;

impl Model for Bar {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (
            Vec3::new(-35.0, -100.0, -35.0),
            Vec3::new(35.0, 100.0, 35.0),
        )
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
            let shell = rounded_box(p, SHELL, 6.0) + groove(p.y, RING_MM, 1.0);
            if shell.lowest() > width {
                continue;
            }
            out.lay(row, shell, width, Lanes::splat(60.0), 1);
            let core = rounded_box(p, CORE, 12.9);
            out.lay(row, core, width, Lanes::splat(1000.0), 2);
        }
    }
}

/// Signed distance to a box with rounded edges about the origin, mm.
pub(super) fn rounded_box(p: Points, half: Vec3, radius: f32) -> Lanes {
    let zero = Lanes::splat(0.0);
    let x = p.x.abs() - (half.x - radius);
    let y = p.y.abs() - (half.y - radius);
    let z = p.z.abs() - (half.z - radius);
    let (ox, oy, oz) = (x.max(zero), y.max(zero), z.max(zero));
    let outside = (ox * ox + oy * oy + oz * oz).sqrt();
    outside + x.max(y).max(z).min(zero) - radius
}

/// Depth of lines engraved across a coordinate, one at every multiple of `period` mm, rounded, `depth` mm deep.
pub(super) fn groove(at: Lanes, period: f32, depth: f32) -> Lanes {
    at.map(|at| {
        let cycles = at / period;
        // Distance to the nearest line in units of a half width of 2 mm.
        let t = (cycles - (cycles + 0.5).floor()).abs() * period * 0.5;
        let t = (1.0 - t * t).max(0.0);
        depth * t * t
    })
}
