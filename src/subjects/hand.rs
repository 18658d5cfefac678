//! A right hand, raised, the palm forwards: skin, fat, muscles, tendons, bones, vessels, nerves, nails.
//!
//! Millimetres: x to the right (the thumb is at −x), y out of the palm, z towards the fingertips; the wrist is at z 0.

use glam::Vec3;

use super::hand_cords::{arteries, nerves, tendons, veins};
use super::hand_plan::{Finger, arr, fingers};
use super::lanes::Lanes;
use super::limb::{Cord, inner_width, lay_bone, lay_skin, near, parted};
use super::paint::{
    Block, Canvas, Model, Passage, ROWS, Revision, SegmentSpec, border_width, segment,
};
use super::shape::{Field, Knot, Places, Shape, ball, capsule, curve, ellipsoid, strap};

const SEGMENTS: &[SegmentSpec] = &[
    segment("skin", [226, 176, 148]),
    segment("fat", [240, 209, 128]),
    segment("muscle", [165, 68, 58]),
    segment("bone", [236, 224, 196]),
    segment("tendons", [226, 222, 212]),
    segment("arteries", [196, 44, 38]),
    segment("veins", [72, 90, 160]),
    segment("nerves", [236, 206, 90]),
    segment("cartilage", [190, 208, 214]),
    segment("nails", [238, 196, 184]),
];

/// Where the forearm is cut off.
const END_MM: f32 = -58.0;

/// The hand's shapes, each as one field of distances in mm.
pub(super) struct Hand {
    skin: Field,
    nails: Field,
    bones: Field,
    cartilage: Field,
    muscles: Field,
    tendons: Field,
    arteries: Field,
    veins: Field,
    nerves: Field,
    revision: Revision,
}

impl Hand {
    pub(super) fn new(revision: Revision) -> Self {
        let fingers = fingers();
        let (skin, nails) = skin(&fingers);
        let (bones, cartilage) = bones(&fingers);
        Self {
            muscles: muscles(),
            tendons: tendons(&fingers, &skin, revision),
            arteries: arteries(&fingers, revision),
            veins: veins(&fingers, &skin, revision),
            nerves: nerves(&fingers),
            skin,
            nails,
            bones,
            cartilage,
            revision,
        }
    }
}

fn skin(fingers: &[Finger]) -> (Field, Field) {
    let mut f = Field::default();
    // Forearm and wrist, palm, balls of thumb and little finger.
    f.join(
        0.0,
        strap(
            [-2.0, -1.0, -110.0],
            [0.0, 0.0, 8.0],
            31.0,
            27.0,
            [0.0, 1.0, 0.0],
            0.72,
        ),
    );
    f.join(18.0, ellipsoid([4.0, 0.0, 46.0], [39.0, 14.5, 48.0]));
    f.join(
        12.0,
        strap(
            [-24.0, -1.0, 84.0],
            [32.0, 0.0, 74.0],
            15.0,
            13.0,
            [0.0, 1.0, 0.0],
            0.86,
        ),
    );
    f.join(
        12.0,
        capsule([-17.0, 6.0, 22.0], [-40.0, 11.0, 54.0], 16.0, 13.0),
    );
    f.join(
        14.0,
        capsule([24.0, 4.0, 20.0], [34.0, 3.0, 62.0], 13.0, 12.0),
    );
    let mut nails = Field::default();
    for (index, finger) in fingers.iter().enumerate() {
        let j = &finger.joints;
        let thumb = index == 4;
        let mut knots: Vec<Knot> = vec![(arr(j[1]), finger.flesh[1])];
        for bone in 1..4 {
            let (a, b) = (j[bone], j[bone + 1]);
            let middle = (a + b) * 0.5 + finger.palmar[bone] * 1.2;
            let r = (finger.flesh[bone] + finger.flesh[bone + 1]) * 0.5;
            let slim = if bone == 3 { 1.0 } else { 0.96 };
            knots.push((arr(middle), r * slim));
            let end = if bone == 3 {
                b + finger.palmar[3] * 0.6
            } else {
                b
            };
            knots.push((arr(end), finger.flesh[bone + 1]));
        }
        f.join_all(if thumb { 9.0 } else { 5.0 }, curve(&knots));
        // Creases on the palmar side, wrinkles over the knuckles.
        for joint in 1..4 {
            let r = finger.flesh[joint];
            let side = finger.across * (r * 0.8);
            let front = j[joint] + finger.palmar[joint] * r;
            // The crease at the root of a finger lies farther out than its joint.
            let front = if joint == 1 {
                front + (j[2] - j[1]) * 0.45
            } else {
                front
            };
            f.raise(
                -0.9,
                capsule(arr(front - side), arr(front + side), 2.2, 2.2),
            );
            let back = j[joint] - finger.palmar[joint] * (r * 0.95);
            if joint > 1 {
                f.raise(1.0, ball(arr(back), 6.0));
                for step in [-2.2, 0.0, 2.2] {
                    let way = j[joint + 1] - j[joint];
                    let at = back + way * (step / way.length());
                    f.raise(
                        -0.5,
                        capsule(arr(at - side * 0.6), arr(at + side * 0.6), 1.3, 1.3),
                    );
                }
            } else if !thumb {
                f.raise(2.2, ball(arr(back), 10.0));
            }
        }
        // Nail: a curved plate on the back of the last bone.
        let along = j[4] - j[3];
        let along = along / along.length();
        let back = -finger.palmar[3];
        let r = finger.flesh[4];
        let middle = j[4] - along * 2.5 + back * (r * 0.80);
        let frame = glam::Mat3::from_cols(finger.across, along, back);
        let nail = ellipsoid(arr(middle), [r * 0.78, r * 1.05, 1.9]).oriented(frame);
        f.raise(
            -1.0,
            ellipsoid(arr(middle + back * 1.4), [r * 0.95, r * 1.2, 3.5]).oriented(frame),
        );
        nails.join(0.0, nail);
    }
    // Lines of the palm.
    for (knots, depth) in [
        (
            [
                ([-33.0, 15.0, 80.0], 2.6),
                ([-14.0, 16.0, 64.0], 2.8),
                ([-7.0, 17.0, 40.0], 2.8),
                ([-9.0, 16.0, 14.0], 2.4),
            ],
            -1.3,
        ),
        (
            [
                ([-33.0, 15.0, 80.0], 2.6),
                ([-6.0, 16.0, 68.0], 2.8),
                ([16.0, 16.0, 54.0], 2.6),
                ([30.0, 15.0, 42.0], 2.0),
            ],
            -1.1,
        ),
        (
            [
                ([-16.0, 14.0, 92.0], 2.2),
                ([-2.0, 15.0, 79.0], 2.8),
                ([20.0, 15.0, 70.0], 2.8),
                ([42.0, 12.0, 66.0], 2.4),
            ],
            -1.2,
        ),
        (
            [
                ([-24.0, 14.0, -3.0], 2.2),
                ([-8.0, 18.0, -1.0], 2.4),
                ([8.0, 18.0, -1.0], 2.4),
                ([24.0, 14.0, -3.0], 2.2),
            ],
            -0.9,
        ),
    ] {
        let knots = knots.map(|(p, r): Knot| (f.pull(p, 0.0), r));
        f.raise_all(depth, curve(&knots));
    }
    (f, nails)
}

/// A long bone: it narrows from both ends to its waist, which lies nearer to the head.
fn long_bone(f: &mut Field, a: Vec3, b: Vec3, shaft: f32, base: f32, head: f32) {
    let way = b - a;
    let along = way * way.length().recip();
    let waist = a + way * 0.58;
    let (low, high) = (a + along * (base * 0.9), b - along * (head * 0.9));
    f.join(0.0, capsule(arr(low), arr(waist), base * 0.84, shaft));
    f.join(3.0, capsule(arr(waist), arr(high), shaft, head * 0.84));
    f.join(3.0, ball(arr(low), base * 0.92));
    f.join(3.0, ball(arr(high), head * 0.92));
}

fn bones(fingers: &[Finger]) -> (Field, Field) {
    let mut f = Field::default();
    let mut cartilage = Field::default();
    // Radius and ulna.
    f.join(
        0.0,
        capsule([-9.0, -1.0, -110.0], [-11.0, -1.0, -22.0], 6.8, 7.5),
    );
    f.join(8.0, ellipsoid([-10.0, -1.0, -8.0], [14.0, 9.0, 9.5]));
    f.join(
        3.0,
        capsule([-20.0, 0.0, -6.0], [-22.0, 0.0, 2.0], 4.5, 3.0),
    );
    f.carve(2.0, ellipsoid([-8.0, -2.0, 8.5], [14.0, 9.0, 9.0]));
    f.join(
        0.0,
        capsule([13.0, -3.0, -110.0], [14.0, -3.0, -12.0], 5.6, 5.4),
    );
    f.join(5.0, ball([14.0, -3.0, -8.0], 7.0));
    f.join(
        2.0,
        capsule([17.0, -5.0, -6.0], [18.5, -6.0, 2.0], 3.0, 2.0),
    );
    for (index, finger) in fingers.iter().enumerate() {
        let j = &finger.joints;
        let scale = [0.95, 1.0, 0.93, 0.82, 1.05][index];
        for bone in 0..4 {
            if index == 4 && bone == 3 {
                continue;
            }
            let (shaft, base, head) = [
                (4.0, 6.6, 6.8),
                (3.9, 6.2, 5.0),
                (3.2, 5.0, 4.2),
                (2.2, 4.2, 3.0),
            ][bone];
            let mut single = Field::default();
            let way = (j[bone + 1] - j[bone]) / (j[bone + 1] - j[bone]).length();
            let from = if bone == 0 { j[0] } else { j[bone] + way * 0.9 };
            let last = bone == 3 || (index == 4 && bone == 2);
            let to = if last {
                j[bone + 1] - way * 1.0
            } else {
                j[bone + 1] - way * 0.9
            };
            long_bone(
                &mut single,
                from,
                to,
                shaft * scale,
                base * scale,
                head * scale,
            );
            f.append(single, 0.0);
            if bone == 0 {
                cartilage.join(0.0, ball(arr(j[0]), 5.4 * scale));
            }
            if !last {
                cartilage.join(0.0, ball(arr(j[bone + 1]), (head - 0.6) * scale));
            }
        }
    }
    // The thumb has one bone less: its last one spans the end.
    let thumb = &fingers[4];
    long_bone(
        &mut f,
        thumb.joints[2] + Vec3::new(-0.6, 0.2, 1.2),
        thumb.joints[4] - Vec3::new(-1.0, 0.3, 2.0),
        3.4,
        5.4,
        3.4,
    );
    // Wrist: two rows of four, from the thumb's side. Each is hollow where its neighbour lies.
    let wrist: [([f32; 3], [f32; 3], f32); 8] = [
        ([-13.4, -0.8, 9.2], [8.6, 6.0, 5.4], -34.0),
        ([-1.4, -2.6, 7.8], [6.3, 7.6, 5.8], 0.0),
        ([9.6, -2.6, 10.6], [5.6, 6.2, 6.4], 20.0),
        ([13.6, 6.0, 11.0], [4.6, 4.4, 4.8], 0.0),
        ([-20.2, 1.8, 18.8], [5.8, 6.4, 5.2], -30.0),
        ([-11.6, -2.6, 23.0], [4.8, 6.6, 6.0], 0.0),
        ([-2.2, -3.0, 21.4], [5.6, 7.2, 8.8], 0.0),
        ([8.8, -1.8, 22.0], [6.4, 6.8, 7.0], 30.0),
    ];
    let mut carpals = Field::default();
    for (at, radii, tilt) in wrist {
        let shape = ellipsoid(at, radii).turned(0.0, tilt, 0.0);
        // Bones that are there already keep their place, but for a gap.
        carpals.carve(
            0.6,
            ellipsoid(at, radii.map(|r| r + 0.9)).turned(0.0, tilt, 0.0),
        );
        carpals.join(0.0, shape);
    }
    // The hook over the tunnel, and the ridge across from it.
    carpals.join(1.5, capsule([10.0, 4.0, 22.0], [10.5, 9.5, 21.0], 3.2, 2.6));
    carpals.join(
        2.0,
        capsule([-19.0, 6.0, 17.0], [-16.5, 8.6, 18.5], 3.0, 2.2),
    );
    f.append(carpals, 0.0);
    // Where they glide on each other.
    for (a, b) in [
        (0, 1),
        (1, 2),
        (2, 3),
        (0, 4),
        (0, 5),
        (0, 6),
        (1, 6),
        (2, 7),
        (4, 5),
        (5, 6),
        (6, 7),
    ] {
        let (a, b) = (Vec3::from_array(wrist[a].0), Vec3::from_array(wrist[b].0));
        cartilage.join(0.0, ball(arr((a + b) * 0.5), 3.8));
    }
    cartilage.join(0.0, ellipsoid([-8.0, -1.8, 2.6], [12.5, 7.4, 3.2]));
    cartilage.join(0.0, ellipsoid([11.0, -3.0, 1.0], [8.0, 6.0, 3.0]));
    (f, cartilage)
}

fn muscles() -> Field {
    let mut f = Field::default();
    let mut add = |shape: Shape| f.join(0.0, shape);
    // Ball of the thumb: short abductor, flexor, opponens, adductor.
    add(strap(
        [-14.0, 9.0, 18.0],
        [-45.0, 16.0, 54.0],
        9.0,
        6.0,
        [0.3, 0.9, 0.1],
        0.6,
    ));
    add(strap(
        [-6.0, 10.0, 24.0],
        [-41.0, 17.0, 60.0],
        8.0,
        5.0,
        [0.2, 0.9, 0.2],
        0.6,
    ));
    add(strap(
        [-10.0, 4.0, 22.0],
        [-38.0, 9.0, 46.0],
        9.0,
        7.0,
        [0.4, 0.8, 0.2],
        0.6,
    ));
    add(strap(
        [-2.0, 4.5, 62.0],
        [-40.0, 10.0, 58.0],
        16.0,
        6.0,
        [0.1, 1.0, 0.0],
        0.28,
    ));
    // Ball of the little finger.
    add(strap(
        [15.0, 6.0, 16.0],
        [37.0, 4.0, 72.0],
        8.0,
        6.0,
        [0.0, 1.0, 0.0],
        0.7,
    ));
    add(strap(
        [23.0, 2.0, 16.0],
        [41.0, -1.0, 72.0],
        7.0,
        5.0,
        [1.0, 0.2, 0.0],
        0.7,
    ));
    // Between the metacarpals.
    for (a, b) in [
        ([-22.0, -4.0, 44.0], [-35.0, -3.0, 82.0]),
        ([-8.5, -4.0, 44.0], [-14.5, -3.5, 82.0]),
        ([3.0, -4.0, 44.0], [6.5, -3.5, 80.0]),
        ([14.0, -3.0, 40.0], [25.0, -2.0, 74.0]),
    ] {
        add(strap(a, b, 6.5, 4.5, [0.0, 1.0, 0.0], 1.2));
    }
    add(strap(
        [-26.0, -3.0, 36.0],
        [-32.0, -2.0, 80.0],
        8.0,
        4.5,
        [0.0, 1.0, 0.0],
        0.7,
    ));
    // Forearm: flexors before, extensors behind.
    for (x, y, r) in [
        (-19.0, 10.0, 6.5),
        (-7.0, 13.0, 7.0),
        (6.0, 13.0, 7.0),
        (19.0, 9.0, 7.0),
        (-1.0, 6.0, 7.0),
        (2.0, 0.0, 6.0),
    ] {
        add(capsule(
            [x, y, -110.0],
            [x * 0.75, y * 0.8, -20.0],
            r,
            r * 0.3,
        ));
    }
    for (x, y, r) in [
        (-20.0, -9.0, 6.0),
        (-8.0, -14.0, 6.5),
        (5.0, -15.0, 6.5),
        (19.0, -11.0, 6.0),
    ] {
        add(capsule(
            [x, y, -110.0],
            [x * 0.7, y * 0.8, -22.0],
            r,
            r * 0.3,
        ));
    }
    add(strap(
        [-18.0, 9.0, -24.0],
        [16.0, 9.0, -24.0],
        13.0,
        13.0,
        [0.0, 1.0, 0.0],
        0.2,
    ));
    f
}

impl Model for Hand {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (Vec3::new(-86.0, -24.0, -61.0), Vec3::new(64.0, 52.0, 192.0))
    }

    fn segments(&self) -> &'static [SegmentSpec] {
        SEGMENTS
    }

    fn value_range(&self) -> [f32; 2] {
        [-1000.0, 1400.0]
    }

    fn passage(&self) -> Passage {
        self.revision.passage()
    }

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let skin = near(&self.skin, block, 6.0);
        if skin.is_empty() {
            return;
        }
        let nails = near(&self.nails, block, 1.0);
        let muscles = near(&self.muscles, block, 5.0);
        let bones = near(&self.bones, block, 4.0);
        let cartilage = Cord::new(&self.cartilage, (block, 0.0), 110.0, 9, 2.4);
        let least = self.revision.least_mm(block, self.bounds_mm());
        let thick = (block, least);
        let cords = [
            Cord::new(&self.tendons, thick, 90.0, 5, 2.2),
            Cord::new(&self.veins, thick, 160.0, 7, 1.9),
            Cord::new(&self.arteries, thick, 230.0, 6, 1.9),
            Cord::new(&self.nerves, thick, 32.0, 8, 1.9),
        ];
        let (width, soft) = (border_width(block.spacing), inner_width(block));
        let flat = Lanes::splat;
        for row in 0..ROWS {
            let p = Places::new(block.row(row));
            let s = skin.distance(&p);
            if s.lowest() > width {
                continue;
            }
            lay_skin(out, row, block, s, 1.9, [1, 2]);
            if !muscles.is_empty() {
                let d = parted(muscles.two_nearest(&p), 0.8, 0.9);
                out.lay(row, d.max(s + 3.0), soft, flat(55.0), 3);
            }
            cartilage.lay(out, row, block, &p, s);
            if !bones.is_empty() {
                let d = bones.distance(&p).max(s + 2.2);
                lay_bone(out, row, block, d, flat(1.4), [1200.0, 420.0].map(flat), 4);
            }
            for cord in &cords {
                cord.lay(out, row, block, &p, s);
            }
            if !nails.is_empty() {
                let d = nails.distance(&p).max(s - 0.6).max(-(s + 1.2));
                out.lay(row, d - 0.4 * block.spacing, width, flat(140.0), 10);
            }
            out.lay(row, p.plain.z - END_MM, width, flat(-1000.0), 0);
        }
    }
}
