//! A right hand, raised, the palm forwards: skin, fat, muscles, tendons, bones, vessels, nerves, nails.
//!
//! Millimetres: x to the right (the thumb is at −x), y out of the palm, z towards the fingertips; the wrist is at z 0.

use glam::Vec3;

use super::lanes::Lanes;
use super::paint::{Block, Canvas, Model, ROWS, SegmentSpec, border_width, segment};
use super::shape::{
    Field, Knot, Near, Places, Shape, ball, capsule, curve, ellipsoid, strap, turn_deg,
};

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

/// One finger: its joints from the base of the metacarpal to the tip, and the direction out of its palmar side at each.
struct Finger {
    /// Base and head of the metacarpal, the two joints of the finger, end of the last bone.
    joints: [Vec3; 5],
    /// Across the finger.
    across: Vec3,
    /// Out of the palmar side, by bone.
    palmar: [Vec3; 4],
    /// Half widths of the flesh at the joints.
    flesh: [f32; 5],
}

fn fingers() -> Vec<Finger> {
    // Base, head of the metacarpal; lengths of the three bones; spread and flexion in degrees; half widths.
    type Row = ([f32; 3], [f32; 3], [f32; 3], f32, [f32; 3], [f32; 5]);
    let rows: [Row; 4] = [
        (
            [-13.0, -3.0, 32.0],
            [-25.0, -3.0, 90.0],
            [42.0, 25.0, 18.0],
            -7.0,
            [5.0, 9.0, 6.0],
            [10.0, 11.0, 9.3, 8.4, 7.0],
        ),
        (
            [-2.0, -4.0, 33.0],
            [-3.0, -4.0, 91.0],
            [46.0, 29.0, 19.0],
            -0.5,
            [4.0, 8.0, 6.0],
            [10.0, 11.2, 9.5, 8.5, 7.1],
        ),
        (
            [9.0, -3.5, 31.0],
            [17.0, -3.0, 84.0],
            [42.0, 27.5, 19.0],
            5.5,
            [7.0, 11.0, 7.0],
            [10.0, 10.8, 9.1, 8.1, 6.8],
        ),
        (
            [18.0, -2.0, 28.0],
            [34.0, -1.0, 75.0],
            [34.0, 20.0, 17.0],
            14.0,
            [10.0, 14.0, 9.0],
            [9.0, 10.0, 8.2, 7.3, 6.1],
        ),
    ];
    let mut out: Vec<Finger> = rows
        .into_iter()
        .map(|(base, head, lengths, spread, flexion, flesh)| {
            let mut joints = [
                Vec3::from_array(base),
                Vec3::from_array(head),
                Vec3::ZERO,
                Vec3::ZERO,
                Vec3::ZERO,
            ];
            let mut palmar = [Vec3::Y; 4];
            let mut bend = 0.0;
            for i in 0..3 {
                bend += flexion[i];
                // Towards the palm about x, then spread in the plane of the hand.
                let turn = turn_deg(0.0, spread, 0.0) * turn_deg(-bend, 0.0, 0.0);
                joints[i + 2] = joints[i + 1] + turn.z_axis * lengths[i];
                palmar[i + 1] = turn.y_axis;
            }
            Finger {
                joints,
                across: turn_deg(0.0, spread, 0.0).x_axis,
                palmar,
                flesh,
            }
        })
        .collect();
    // The thumb stands off and is turned, so that its nail looks sideways.
    let points = [
        [-21.0, 3.0, 24.0],
        [-46.0, 13.0, 56.0],
        [-60.0, 17.0, 85.0],
        [-67.0, 20.0, 100.0],
        [-72.0, 22.0, 111.0],
    ]
    .map(Vec3::from_array);
    let across = Vec3::new(0.45, -0.83, 0.33);
    let palmar = [0, 1, 2, 3].map(|i| {
        let along = points[i + 1] - points[i];
        let p = across.cross(along) * -1.0;
        p / p.length()
    });
    out.push(Finger {
        joints: points,
        across: across / across.length(),
        palmar,
        flesh: [12.0, 12.0, 11.0, 10.4, 8.6],
    });
    out
}

/// See the module.
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
}

fn arr(p: Vec3) -> [f32; 3] {
    p.to_array()
}

impl Hand {
    pub(super) fn new() -> Self {
        let fingers = fingers();
        let (skin, nails) = skin(&fingers);
        let (bones, cartilage) = bones(&fingers);
        Self {
            muscles: muscles(),
            tendons: tendons(&fingers),
            arteries: arteries(&fingers),
            veins: veins(&fingers, &skin),
            nerves: nerves(&fingers),
            skin,
            nails,
            bones,
            cartilage,
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

/// A long bone: slim in the middle, broad at both ends.
fn long_bone(f: &mut Field, a: Vec3, b: Vec3, shaft: f32, base: f32, head: f32) {
    let way = b - a;
    f.join(
        0.0,
        capsule(arr(a + way * 0.1), arr(b - way * 0.1), shaft, shaft * 0.95),
    );
    f.join(4.0, ball(arr(a + way * (base / way.length())), base));
    f.join(4.0, ball(arr(b - way * (head / way.length())), head));
}

fn bones(fingers: &[Finger]) -> (Field, Field) {
    let mut f = Field::default();
    let mut cartilage = Field::default();
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
    // Wrist: two rows of four.
    for (p, r) in [
        ([-14.0, -1.0, 10.0], [7.5, 7.0, 7.5]),
        ([-2.0, -3.0, 8.0], [6.8, 7.5, 6.5]),
        ([9.5, -3.0, 9.5], [6.0, 6.5, 6.5]),
        ([13.5, 6.0, 11.0], [4.6, 4.4, 4.6]),
        ([-20.5, 1.5, 20.0], [6.0, 6.5, 5.5]),
        ([-12.0, -2.5, 23.5], [4.8, 6.5, 6.0]),
        ([-2.5, -3.0, 22.0], [6.0, 7.5, 9.0]),
        ([9.5, -1.5, 21.5], [7.0, 6.8, 7.5]),
    ] {
        f.join(0.0, ellipsoid(p, r));
    }
    f.join(1.0, capsule([10.0, 5.0, 22.0], [10.5, 9.0, 21.0], 3.0, 2.6));
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

fn tendons(fingers: &[Finger]) -> Field {
    let mut f = Field::default();
    for (index, finger) in fingers.iter().enumerate() {
        let j = &finger.joints;
        let x = index as f32;
        let (palm, back) = if index == 4 {
            (Vec3::new(-12.0, 9.0, 6.0), Vec3::new(-22.0, -7.0, 4.0))
        } else {
            (
                Vec3::new(-7.0 + 4.2 * x, 9.5, 6.0),
                Vec3::new(-6.0 + 4.0 * x, -12.0, 2.0),
            )
        };
        // Flexors run through the tunnel of the wrist, extensors over its back.
        let below = |joint: usize, depth: f32| {
            let bone = joint.min(3);
            (j[joint] + finger.palmar[bone] * depth).to_array()
        };
        f.join_all(
            0.0,
            curve(&[
                ([palm.x * 1.1, palm.y, -108.0], 2.2),
                (arr(palm + Vec3::new(0.0, 0.0, -30.0)), 2.2),
                (arr(palm), 2.1),
                (arr((palm + j[1]) * 0.5 + Vec3::Y * 5.0), 2.1),
                (below(1, 7.4), 2.2),
                (below(2, 5.8), 1.9),
                (below(3, 4.6), 1.6),
                (
                    arr(j[3] + (j[4] - j[3]) * 0.45 + finger.palmar[3] * 2.6),
                    1.0,
                ),
            ]),
        );
        let mut over: Vec<Knot> = vec![
            ([back.x * 1.4, back.y - 1.0, -108.0], 1.9),
            (arr(back), 1.8),
            (arr((back + j[1]) * 0.5 - Vec3::Y * 4.0), 1.7),
            (below(1, -7.6), 1.9),
            (below(2, -5.6), 1.7),
            (below(3, -4.4), 1.2),
        ];
        if index == 4 {
            over[2] = (arr((j[0] + j[1]) * 0.5 - finger.palmar[0] * 6.0), 1.6);
        }
        f.join_all(0.0, curve(&over));
    }
    // Long palmar tendon, and the band over the tunnel.
    f.join_all(
        0.0,
        curve(&[
            ([0.0, 15.5, -108.0], 1.8),
            ([-1.0, 15.0, -20.0], 1.6),
            ([-1.0, 15.0, 12.0], 1.6),
        ]),
    );
    f.join(
        0.0,
        strap(
            [-13.0, 9.5, 13.0],
            [11.0, 10.0, 13.0],
            10.0,
            10.0,
            [0.0, 1.0, 0.0],
            0.16,
        ),
    );
    f
}

fn arteries(fingers: &[Finger]) -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([-19.0, 9.0, -108.0], 1.9),
            ([-20.0, 10.0, -20.0], 1.8),
            ([-25.0, 2.0, 8.0], 1.6),
            ([-24.0, -6.0, 28.0], 1.5),
            ([-12.0, 3.0, 46.0], 1.5),
            ([6.0, 4.0, 46.0], 1.4),
            ([18.0, 5.0, 40.0], 1.2),
        ]),
    );
    let arch: [Knot; 8] = [
        ([18.0, 9.0, -108.0], 1.9),
        ([17.0, 11.0, -20.0], 1.8),
        ([17.0, 11.0, 12.0], 1.7),
        ([19.0, 11.0, 34.0], 1.7),
        ([12.0, 11.5, 54.0], 1.6),
        ([-3.0, 11.5, 60.0], 1.6),
        ([-17.0, 11.5, 52.0], 1.4),
        ([-24.0, 12.0, 40.0], 1.2),
    ];
    f.join_all(0.0, curve(&arch));
    for finger in fingers {
        let j = &finger.joints;
        for side in [-1.0, 1.0] {
            let beside = |joint: usize, r: f32| {
                let out = finger.flesh[joint] * 0.52 * side;
                let depth = finger.flesh[joint] * 0.24;
                (
                    arr(j[joint] + finger.across * out + finger.palmar[joint.min(3)] * depth),
                    r,
                )
            };
            let root =
                j[1] * 0.55 + Vec3::new(0.0, 11.0, 26.0) * 0.5 + finger.across * (side * 2.0);
            f.join_all(
                0.0,
                curve(&[
                    (arr(root), 1.2),
                    beside(1, 1.15),
                    beside(2, 1.0),
                    beside(3, 0.9),
                    beside(4, 0.6),
                ]),
            );
        }
    }
    f
}

fn veins(fingers: &[Finger], skin: &Field) -> Field {
    let mut f = Field::default();
    let mut tube = |knots: &[Knot]| {
        let knots: Vec<Knot> = knots
            .iter()
            .map(|&(p, r)| (skin.pull(p, -(r + 1.9)), r))
            .collect();
        f.join_all(0.0, curve(&knots));
    };
    // Along the back of the fingers into a net on the back of the hand, and up the forearm.
    for pair in fingers[..4].windows(2) {
        let root = (pair[0].joints[1] + pair[1].joints[1]) * 0.5;
        let (x, z) = (root.x, root.z);
        tube(&[
            ([x, -12.0, z - 4.0], 1.2),
            ([x * 0.85, -14.0, z - 24.0], 1.5),
            ([x * 0.6, -14.0, z - 46.0], 1.6),
        ]);
    }
    tube(&[
        ([-34.0, -9.0, 62.0], 1.2),
        ([-14.0, -14.0, 48.0], 1.5),
        ([2.0, -15.0, 40.0], 1.6),
        ([18.0, -14.0, 44.0], 1.5),
        ([30.0, -11.0, 56.0], 1.2),
    ]);
    tube(&[
        ([-14.0, -14.0, 48.0], 1.6),
        ([-22.0, -12.0, 18.0], 1.8),
        ([-27.0, -6.0, -20.0], 2.0),
        ([-26.0, 2.0, -70.0], 2.1),
        ([-22.0, 8.0, -108.0], 2.1),
    ]);
    tube(&[
        ([18.0, -14.0, 44.0], 1.5),
        ([20.0, -13.0, 10.0], 1.7),
        ([24.0, -10.0, -40.0], 1.9),
        ([26.0, -6.0, -108.0], 2.0),
    ]);
    for finger in fingers {
        let j = &finger.joints;
        let beside = |joint: usize, r: f32| {
            (
                arr(j[joint] - finger.palmar[joint.min(3)] * 20.0 + finger.across * 3.0),
                r,
            )
        };
        tube(&[beside(3, 0.9), beside(2, 1.1), beside(1, 1.2)]);
    }
    f
}

fn nerves(fingers: &[Finger]) -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([-1.0, 10.0, -108.0], 2.3),
            ([-3.0, 12.0, -20.0], 2.3),
            ([-4.0, 12.0, 16.0], 2.4),
            ([-8.0, 11.0, 34.0], 1.8),
        ]),
    );
    f.join_all(
        0.0,
        curve(&[
            ([22.0, 7.0, -108.0], 1.9),
            ([20.5, 10.0, -10.0], 1.9),
            ([20.5, 10.0, 14.0], 1.8),
            ([24.0, 9.0, 36.0], 1.5),
        ]),
    );
    for (index, finger) in fingers.iter().enumerate() {
        let j = &finger.joints;
        let root = if index == 3 {
            Vec3::new(24.0, 9.0, 36.0)
        } else {
            Vec3::new(-7.0, 11.0, 32.0)
        };
        for side in [-1.0, 1.0] {
            let beside = |joint: usize, r: f32| {
                let out = finger.flesh[joint] * 0.42 * side;
                let depth = finger.flesh[joint] * 0.46;
                (
                    arr(j[joint] + finger.across * out + finger.palmar[joint.min(3)] * depth),
                    r,
                )
            };
            f.join_all(
                0.0,
                curve(&[
                    (arr(root), 1.4),
                    beside(1, 1.1),
                    beside(2, 0.95),
                    beside(3, 0.8),
                    beside(4, 0.5),
                ]),
            );
        }
    }
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

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let width = border_width(block.spacing);
        let soft = 0.55 * width;
        let near = |field, band: f32| {
            let mut near = Near::default();
            Field::near(field, block, band + width, &mut near);
            near
        };
        let skin = near(&self.skin, 6.0);
        let nails = near(&self.nails, 1.0);
        if skin.is_empty() {
            return;
        }
        let muscles = near(&self.muscles, 5.0);
        let bones = near(&self.bones, 4.0);
        let cartilage = near(&self.cartilage, 1.0);
        let tubes = [
            (near(&self.veins, 0.0), 160.0, 7),
            (near(&self.arteries, 0.0), 230.0, 6),
            (near(&self.nerves, 0.0), 32.0, 8),
        ];
        let tendons = near(&self.tendons, 1.0);
        let flat = Lanes::splat;
        let thickness = 1.9f32.max(0.9 * block.spacing);
        for row in 0..ROWS {
            let p = Places::new(block.row(row));
            let s = skin.distance(&p);
            if s.lowest() > width {
                continue;
            }
            out.lay(row, s - 0.5 * block.spacing, width, flat(30.0), 1);
            out.lay(row, s + thickness, soft, flat(-100.0), 2);
            if !muscles.is_empty() {
                let (first, second) = muscles.two_nearest(&p);
                let d = (first - 0.8).max(flat(0.9) - (second - first));
                out.lay(row, d.max(s + 3.0), soft, flat(55.0), 3);
            }
            if !cartilage.is_empty() {
                out.lay(
                    row,
                    cartilage.distance(&p).max(s + 2.4),
                    soft,
                    flat(110.0),
                    9,
                );
            }
            if !bones.is_empty() {
                let d = bones.distance(&p).max(s + 2.2);
                let spongy = ((-d - 1.4) * 0.8).clamp(0.0, 1.0);
                out.lay(row, d, width, flat(1200.0).mix(flat(420.0), spongy), 4);
            }
            if !tendons.is_empty() {
                out.lay(row, tendons.distance(&p).max(s + 2.2), soft, flat(90.0), 5);
            }
            for (field, value, label) in &tubes {
                if !field.is_empty() {
                    out.lay(
                        row,
                        field.distance(&p).max(s + 1.9),
                        soft,
                        flat(*value),
                        *label,
                    );
                }
            }
            if !nails.is_empty() {
                let d = nails.distance(&p).max(s - 0.6).max(-(s + 1.2));
                out.lay(row, d - 0.4 * block.spacing, width, flat(140.0), 10);
            }
            out.lay(row, p.plain.z - END_MM, width, flat(-1000.0), 0);
        }
    }
}
