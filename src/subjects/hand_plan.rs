//! Where the fingers of the hand lie: joints, directions and widths, from which its bones, flesh and cords are built.
//!
//! Millimetres, in the frame of the hand: x to the right, y out of the palm, z towards the fingertips.

use glam::Vec3;

use super::shape::turn_deg;

/// One finger: its joints from the base of the metacarpal to the tip, and the direction out of its palmar side at each.
pub(super) struct Finger {
    /// Base and head of the metacarpal, the two joints of the finger, end of the last bone.
    pub(super) joints: [Vec3; 5],
    /// Unit vector across the finger.
    pub(super) across: Vec3,
    /// Out of the palmar side, by bone.
    pub(super) palmar: [Vec3; 4],
    /// Half widths of the flesh at the joints.
    pub(super) flesh: [f32; 5],
}

/// The five fingers, the thumb last.
pub(super) fn fingers() -> Vec<Finger> {
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

/// A point as the three numbers that a knot of a curve takes.
pub(super) fn arr(p: Vec3) -> [f32; 3] {
    p.to_array()
}
