//! What runs through the hand: tendons, arteries, veins, nerves.

use glam::Vec3;

use super::hand_plan::{Finger, arr};
use super::paint::Revision;
use super::shape::{Field, Knot, along_curve, chain, curve, strap};

/// How far under the skin a vein lies, mm; and a tendon at least, on a finger and before, where veins cross it.
const VEIN_UNDER_MM: f32 = 2.15;
const FINGER_TENDON_UNDER_MM: f32 = 2.6;
const TENDON_UNDER_MM: f32 = 4.2;

pub(super) fn tendons(fingers: &[Finger], skin: &Field, revision: Revision) -> Field {
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
        f.join_all(
            0.0,
            match revision {
                Revision::First => curve(&over),
                // Over the knuckles they would come out of the skin.
                Revision::Second => {
                    let laid = along_curve(&over);
                    let knuckle = laid.len() / 2;
                    let under = |(i, (p, r)): (usize, Knot)| {
                        let deepest = match i < knuckle {
                            true => -(r + TENDON_UNDER_MM),
                            false => -(r + FINGER_TENDON_UNDER_MM),
                        };
                        match skin.at(p) > deepest {
                            true => (skin.pull(p, deepest), r),
                            false => (p, r),
                        }
                    };
                    let laid: Vec<Knot> = laid.into_iter().enumerate().map(under).collect();
                    chain(&laid)
                }
            },
        );
    }
    // Long palmar tendon, and the band over the tunnel.
    f.join_all(
        0.0,
        curve(&[
            ([0.0, 15.5, -108.0], 1.8),
            ([-1.0, 15.5, -20.0], 1.6),
            ([-1.0, 16.0, 12.0], 1.5),
        ]),
    );
    // The nerve runs under the band, the long palmar tendon over it.
    let band = [[-16.0, 10.0, 14.0], [-3.0, 14.6, 14.0], [11.0, 10.8, 14.0]];
    for pair in band.windows(2) {
        f.join(
            2.0,
            strap(pair[0], pair[1], 8.5, 8.5, [0.0, 1.0, 0.0], 0.14),
        );
    }
    f
}

pub(super) fn arteries(fingers: &[Finger], revision: Revision) -> Field {
    let mut f = Field::default();
    // Under the thumb's tendon, or through it.
    let under_tendon = match revision {
        Revision::First => [-24.0, -6.0, 28.0],
        Revision::Second => [-23.0, -2.0, 28.0],
    };
    let deep: [Knot; 7] = [
        ([-19.0, 9.0, -108.0], 1.9),
        ([-20.0, 10.0, -20.0], 1.8),
        ([-25.0, 2.0, 8.0], 1.6),
        (under_tendon, 1.5),
        ([-12.0, 3.0, 46.0], 1.5),
        ([6.0, 4.0, 46.0], 1.4),
        ([18.0, 5.0, 40.0], 1.2),
    ];
    f.join_all(0.0, curve(&deep));
    let mut arch: Vec<Knot> = vec![
        ([18.0, 9.0, -108.0], 1.9),
        ([17.0, 11.0, -20.0], 1.8),
        ([17.0, 11.0, 12.0], 1.7),
        ([19.0, 11.0, 34.0], 1.7),
        ([12.0, 11.5, 54.0], 1.6),
        ([-3.0, 11.5, 60.0], 1.6),
    ];
    arch.extend(match revision {
        Revision::First => vec![([-17.0, 11.5, 52.0], 1.4), ([-24.0, 12.0, 40.0], 1.2)],
        // Up to the nerves of index finger and thumb.
        Revision::Second => vec![([-9.0, 12.4, 58.0], 1.4)],
    });
    f.join_all(0.0, curve(&arch));
    let on_deep_arch = along_curve(&deep);
    for (index, finger) in fingers.iter().enumerate() {
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
            let mut knots = vec![
                (arr(root), 1.2),
                beside(1, 1.15),
                beside(2, 1.0),
                beside(3, 0.9),
                beside(4, 0.6),
            ];
            if revision == Revision::Second {
                let off = |knot: &Knot| (Vec3::from_array(knot.0) - root).length_squared();
                // From the deep arch, which lies behind the nerves.
                let nearest = on_deep_arch.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
                // That of the thumb goes straight: its nerves would cross the way over the palm.
                let replaced = usize::from(index == 4);
                knots.splice(0..replaced, nearest.map(|(p, _)| (*p, 1.2)));
            }
            f.join_all(0.0, curve(&knots));
        }
    }
    f
}

/// Places on the net of veins on the back of the hand.
const NET: [[f32; 3]; 5] = [
    [-34.0, -9.0, 62.0],
    [-14.0, -14.0, 48.0],
    [2.0, -15.0, 40.0],
    [18.0, -14.0, 44.0],
    [30.0, -11.0, 56.0],
];

pub(super) fn veins(fingers: &[Finger], skin: &Field, revision: Revision) -> Field {
    let mut f = Field::default();
    let mut tube = |knots: &[Knot]| {
        let under = |mm: f32| move |&(p, r): &Knot| (skin.pull(p, -(r + mm)), r);
        f.join_all(
            0.0,
            match revision {
                Revision::First => curve(&knots.iter().map(under(1.9)).collect::<Vec<_>>()),
                // Under the skin between the knots too.
                Revision::Second => {
                    let laid = along_curve(knots);
                    chain(&laid.iter().map(under(VEIN_UNDER_MM)).collect::<Vec<_>>())
                }
            },
        );
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
    let radii = [1.2, 1.5, 1.6, 1.5, 1.2];
    tube(&[0, 1, 2, 3, 4].map(|i| (NET[i], radii[i])));
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
            // From afar the way to the skin may end on the next finger.
            let away = match revision {
                Revision::First => 20.0,
                Revision::Second => finger.flesh[joint],
            };
            (
                arr(j[joint] - finger.palmar[joint.min(3)] * away + finger.across * 3.0),
                r,
            )
        };
        let mut knots = vec![beside(3, 0.9), beside(2, 1.1), beside(1, 1.2)];
        if revision == Revision::Second {
            // On to the net on the back of the hand.
            let off = |p: &[f32; 3]| (Vec3::from_array(*p) - j[1]).length_squared();
            let nearest = NET.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
            knots.extend(nearest.map(|p| (*p, 1.2)));
        }
        tube(&knots);
    }
    f
}

pub(super) fn nerves(fingers: &[Finger]) -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([-1.0, 10.0, -108.0], 2.3),
            ([-3.0, 12.0, -20.0], 2.3),
            ([-4.0, 11.4, 14.0], 2.3),
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
