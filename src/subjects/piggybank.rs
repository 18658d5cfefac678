//! The piggy bank: an earthenware pig with coins inside.
//!
//! Millimetres about its middle; the snout looks forwards (+y).

use glam::Vec3;

use super::lanes::Lanes;
use super::paint::{Block, Canvas, Model, ROWS, SegmentSpec, border_width, segment};
use super::random::Random;
use super::shape::{Field, Knot, Near, Places, ball, capsule, cuboid, curve, disc, ellipsoid};

const SEGMENTS: &[SegmentSpec] = &[
    segment("wall", [232, 150, 156]),
    segment("coins", [214, 172, 72]),
    segment("eyes", [36, 30, 34]),
    segment("plug", [60, 60, 64]),
];

/// Thickness of the wall, mm.
const WALL_MM: f32 = 5.0;
/// Radius and half the thickness of a coin, mm.
const COIN_MM: [f32; 2] = [11.5, 1.2];

/// The bank's shapes, each as one field of distances in mm.
pub(super) struct Piggybank {
    body: Field,
    /// The belly, which is hollow.
    belly: Field,
    slot: Field,
    coins: Field,
    eyes: Field,
    plug: Field,
}

fn belly() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([0.0, -6.0, 0.0], [47.0, 60.0, 45.0]));
    f.join(14.0, ellipsoid([0.0, 38.0, 6.0], [33.0, 30.0, 32.0]));
    f
}

impl Piggybank {
    pub(super) fn new() -> Self {
        let belly = belly();
        let mut body = belly.clone();
        // Snout with a flat end and nostrils.
        body.join(9.0, capsule([0.0, 58.0, 3.0], [0.0, 71.0, 2.0], 15.0, 14.0));
        body.join(
            4.0,
            disc([0.0, 78.0, 2.0], 15.0, 4.0, 2.5).turned(84.0, 0.0, 0.0),
        );
        body.carve(
            1.5,
            capsule([5.5, 88.0, 3.0], [5.5, 79.0, 3.0], 2.6, 2.2).both(),
        );
        body.raise(
            -1.6,
            capsule([0.0, 66.0, -12.0], [12.0, 62.0, -8.0], 4.0, 3.5).both(),
        );
        // Ears, legs, tail.

        body.join(
            5.0,
            ellipsoid([24.0, 42.0, 38.0], [9.5, 4.2, 14.0])
                .turned(-24.0, 24.0, -18.0)
                .both(),
        );
        body.carve(
            2.5,
            ellipsoid([23.5, 46.5, 39.5], [5.8, 3.4, 9.5])
                .turned(-24.0, 24.0, -18.0)
                .both(),
        );
        for y in [34.0, -38.0] {
            body.join(
                8.0,
                capsule([25.0, y, -32.0], [27.0, y + 1.0, -50.0], 13.0, 11.5).both(),
            );
        }
        body.carve(2.0, cuboid([0.0, 0.0, -74.0], [80.0, 100.0, 18.0], 1.0));
        let tail: [Knot; 7] = [
            ([0.0, -62.0, 10.0], 3.6),
            ([0.0, -70.0, 13.0], 3.2),
            ([6.0, -75.0, 18.0], 3.0),
            ([4.0, -77.0, 26.0], 2.9),
            ([-5.0, -76.0, 25.0], 2.7),
            ([-5.0, -77.0, 16.0], 2.5),
            ([2.0, -81.0, 13.0], 2.0),
        ];
        body.join_all(2.5, curve(&tail));
        let mut slot = Field::default();
        slot.join(0.0, cuboid([0.0, -6.0, 45.0], [1.9, 16.0, 14.0], 0.8));
        let mut eyes = Field::default();
        eyes.join(0.0, ball(belly.pull([17.0, 60.0, 21.0], -1.5), 4.0).both());
        let mut plug = Field::default();
        plug.join(0.0, disc([0.0, -4.0, -44.0], 13.0, 4.0, 1.5));
        Self {
            body,
            belly,
            slot,
            coins: coins(),
            eyes,
            plug,
        }
    }
}

/// A heap: coins on the floor of the belly, the later ones on top and tilted, and one that stands against the wall.
fn coins() -> Field {
    let mut f = Field::default();
    let mut state = Random(3);
    let mut random = || state.next();
    let mut heap: Vec<Vec3> = Vec::new();
    for _ in 0..46 {
        // Fall at a random place: to rest on the belly or on the coins that are there.
        let mut best = Vec3::new(0.0, 0.0, 100.0);
        for _ in 0..6 {
            let (x, y) = ((random() - 0.5) * 52.0, (random() - 0.55) * 76.0);
            let r2 = (x / 42.0) * (x / 42.0) + ((y + 6.0) / 55.0) * ((y + 6.0) / 55.0);
            let rim2 = ((x.abs() + 8.0) / 42.0) * ((x.abs() + 8.0) / 42.0)
                + (((y + 6.0).abs() + 8.0) / 55.0) * (((y + 6.0).abs() + 8.0) / 55.0);
            if rim2 > 0.9 || r2 > 0.8 {
                continue;
            }
            let mut z = -40.0 * (1.0 - 0.7 * r2 - 0.3 * rim2).max(0.0).sqrt() + 1.6;
            for other in &heap {
                let d2 = (other.x - x) * (other.x - x) + (other.y - y) * (other.y - y);
                if d2 < 20.0 * 20.0 {
                    z = z.max(other.z + 2.0 * COIN_MM[1] + 0.2);
                }
            }
            if z < best.z {
                best = Vec3::new(x, y, z);
            }
        }
        if best.z > 20.0 {
            continue;
        }
        heap.push(best);
        let tilt = 7.0;
        f.join_all(
            0.0,
            vec![disc(best.to_array(), COIN_MM[0], COIN_MM[1], 0.4).turned(
                tilt * (random() - 0.5) * 2.0,
                tilt * (random() - 0.5) * 2.0,
                0.0,
            )],
        );
    }
    f.join(
        0.0,
        disc([-30.0, -16.0, -14.0], COIN_MM[0], COIN_MM[1], 0.4).turned(0.0, 62.0, 10.0),
    );
    f.join(
        0.0,
        disc([8.0, 30.0, -19.0], COIN_MM[0], COIN_MM[1], 0.4).turned(-48.0, 12.0, 0.0),
    );
    f
}

impl Model for Piggybank {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (Vec3::new(-51.0, -88.0, -59.0), Vec3::new(51.0, 86.0, 53.0))
    }

    fn segments(&self) -> &'static [SegmentSpec] {
        SEGMENTS
    }

    fn value_range(&self) -> [f32; 2] {
        [-1000.0, 3000.0]
    }

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let width = border_width(block.spacing);
        let near = |field| {
            let mut near = Near::default();
            Field::near(field, block, 10.0 + width, &mut near);
            near
        };
        let body = near(&self.body);
        let eyes = near(&self.eyes);
        if body.is_empty() {
            return;
        }
        let (belly, slot, coins, plug) = (
            near(&self.belly),
            near(&self.slot),
            near(&self.coins),
            near(&self.plug),
        );
        let flat = Lanes::splat;
        let wall = WALL_MM.max(1.6 * block.spacing);
        for row in 0..ROWS {
            let p = Places::new(block.row(row));
            let b = body.distance(&p);
            if b.lowest() > width {
                continue;
            }
            let mut d = b;
            if !belly.is_empty() {
                d = d.max(-(belly.distance(&p) + wall));
            }
            if !slot.is_empty() {
                d = d.max(-slot.distance(&p));
            }
            out.lay(row, d - 0.3 * block.spacing, width, flat(900.0), 1);
            if !plug.is_empty() {
                out.lay(row, plug.distance(&p).max(b - 1.0), width, flat(200.0), 4);
            }
            if !coins.is_empty() {
                out.lay(
                    row,
                    coins.distance(&p).max(b + wall),
                    0.7 * width,
                    flat(3000.0),
                    2,
                );
            }
            if !eyes.is_empty() {
                out.lay(row, eyes.distance(&p), width, flat(700.0), 3);
            }
        }
    }
}
