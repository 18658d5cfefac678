//! The tomato: skin, flesh, chambers with jelly and seeds, core, calyx.
//!
//! Millimetres about its middle; the stalk is up.

use glam::Vec3;

use super::lanes::Lanes;
use super::paint::{Block, Canvas, Model, ROWS, SegmentSpec, border_width, segment};
use super::random::Random;
use super::shape::{Field, Knot, Near, Places, capsule, curve, ellipsoid, turn_deg};

const SEGMENTS: &[SegmentSpec] = &[
    segment("skin", [206, 44, 30]),
    segment("flesh", [226, 92, 66]),
    segment("jelly", [226, 148, 60]),
    segment("seeds", [238, 214, 156]),
    segment("core", [238, 196, 168]),
    segment("calyx", [84, 128, 52]),
];

/// Chambers about the core.
const CHAMBERS: usize = 5;

/// The tomato's shapes, each as one field of distances in mm.
pub(super) struct Tomato {
    body: Field,
    /// Walls between the chambers, and the core.
    walls: Field,
    core: Field,
    seeds: Field,
    calyx: Field,
}

/// A direction in the plane, by degrees.
fn heading(deg: f32) -> (f32, f32) {
    let x = turn_deg(0.0, 0.0, deg).x_axis;
    (x.x, x.y)
}

impl Tomato {
    pub(super) fn new() -> Self {
        let mut body = Field::default();
        body.join(0.0, ellipsoid([0.0, 0.0, 0.0], [44.0, 44.0, 36.0]));
        let mut walls = Field::default();
        let mut core = Field::default();
        core.join(0.0, capsule([0.0, 0.0, 30.0], [0.0, 0.0, -24.0], 6.5, 4.0));
        core.join(6.0, ellipsoid([0.0, 0.0, 24.0], [11.0, 11.0, 9.0]));
        let mut seeds = Field::default();
        let mut state = Random(77);
        let mut random = || state.next();
        for i in 0..CHAMBERS {
            let deg = 360.0 / CHAMBERS as f32 * i as f32 + 9.0;
            let (x, y) = heading(deg);
            // A shoulder over each chamber; between two of them a wall.
            let size = 28.0 + 1.5 * random();
            body.join(
                16.0,
                ellipsoid([19.0 * x, 19.0 * y, 0.5], [size, size, 35.5]),
            );
            let (wx, wy) = heading(deg + 36.0);
            walls.join(
                5.0,
                super::shape::strap(
                    [28.0 * wx, 28.0 * wy, 0.0],
                    [34.0 * wx, 34.0 * wy, 0.0],
                    27.0,
                    27.0,
                    [-wy, wx, 0.0],
                    0.08,
                ),
            );
            // Seeds lie about the swelling that the core sends into the chamber.
            core.join(9.0, ellipsoid([10.0 * x, 10.0 * y, -1.0], [8.0, 8.0, 16.0]));
            for row in 0..7 {
                for side in 0..4 {
                    let across = deg + (side as f32 - 1.5) * 12.5 + 5.0 * random();
                    let (sx, sy) = heading(across);
                    let r = 21.5 + 6.5 * random();
                    let z = -18.0 + 5.6 * row as f32 + 2.0 * random();
                    seeds.join(
                        0.0,
                        ellipsoid([r * sx, r * sy, z], [2.4, 1.1, 1.8]).turned(
                            40.0 * random(),
                            25.0 * random(),
                            across + 60.0 * (random() - 0.5),
                        ),
                    );
                }
            }
            // Furrows between the shoulders.
            body.raise(
                -2.0,
                capsule(
                    [30.0 * wx, 30.0 * wy, 34.0],
                    [46.0 * wx, 46.0 * wy, 8.0],
                    14.0,
                    12.0,
                ),
            );
        }
        body.raise(-9.0, ellipsoid([0.0, 0.0, 36.0], [26.0, 26.0, 22.0]));
        body.raise(-4.0, ellipsoid([0.0, 0.0, -36.0], [18.0, 18.0, 14.0]));
        let mut calyx = Field::default();
        for i in 0..6 {
            let (x, y) = heading(60.0 * i as f32 + 20.0);
            let reach = 27.0 + 5.0 * random();
            let curl = 4.0 * random();
            let leaf: [Knot; 4] = [
                ([2.0 * x, 2.0 * y, 29.5], 3.0),
                ([0.35 * reach * x, 0.35 * reach * y, 33.0], 3.4),
                ([0.75 * reach * x, 0.75 * reach * y, 37.5], 2.4),
                ([reach * x, reach * y, 36.0 + curl], 0.6),
            ];
            calyx.join_all(1.5, curve(&leaf));
        }
        calyx.join(2.0, capsule([0.0, 0.0, 28.0], [2.0, 1.0, 41.0], 3.0, 2.4));
        calyx.join(1.0, capsule([2.0, 1.0, 41.0], [6.0, 2.0, 47.0], 2.4, 3.0));
        Self {
            body,
            walls,
            core,
            seeds,
            calyx,
        }
    }
}

impl Model for Tomato {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (Vec3::new(-52.0, -52.0, -40.0), Vec3::new(52.0, 52.0, 53.0))
    }

    fn segments(&self) -> &'static [SegmentSpec] {
        SEGMENTS
    }

    fn value_range(&self) -> [f32; 2] {
        [-1000.0, 1000.0]
    }

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let width = border_width(block.spacing);
        let (mut body, mut calyx) = (Near::default(), Near::default());
        self.body.near(block, 14.0 + width, &mut body);
        self.calyx.near(block, width, &mut calyx);
        if body.is_empty() && calyx.is_empty() {
            return;
        }
        let (mut walls, mut core, mut seeds) = (Near::default(), Near::default(), Near::default());
        self.walls.near(block, 8.0 + width, &mut walls);
        self.core.near(block, 8.0 + width, &mut core);
        self.seeds.near(block, width, &mut seeds);
        let flat = Lanes::splat;
        let skin = 1.1f32.max(0.8 * block.spacing);
        for row in 0..ROWS {
            let p = Places::new(block.row(row));
            let b = body.distance(&p);
            if !body.is_empty() && b.lowest() < width {
                out.lay(row, b - 0.5 * block.spacing, width, flat(60.0), 1);
                out.lay(row, b + skin, 0.6 * width, flat(20.0), 2);
                // Chambers: within the wall of the fruit, off the walls and the core.
                let inside = b + 8.5;
                let walls = if walls.is_empty() {
                    flat(1e3)
                } else {
                    walls.distance(&p)
                };
                let core = if core.is_empty() {
                    flat(1e3)
                } else {
                    core.distance(&p)
                };
                let room = -super::shape::smooth_min(-inside, walls.min(core), 5.0);
                out.lay(row, core.max(b + 3.0), 0.6 * width, flat(35.0), 5);
                out.lay(row, room, 0.6 * width, flat(-20.0), 3);
                if !seeds.is_empty() {
                    out.lay(
                        row,
                        seeds.distance(&p).max(room),
                        0.6 * width,
                        flat(160.0),
                        4,
                    );
                }
            }
            if !calyx.is_empty() {
                out.lay(row, calyx.distance(&p), width, flat(40.0), 6);
            }
        }
    }
}
