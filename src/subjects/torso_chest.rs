//! What the chest holds: heart and great vessels, windpipe and its tree, gullet.
//!
//! Millimetres as in `torso`; +x is the patient's right.

use glam::Vec3;

use super::lanes::{LANES, Lanes, Points};
use super::paint::Revision;
use super::random::Random;
use super::shape::{Field, Knot, Shape, along_curve, capsule, chain, curve, ellipsoid};

/// The heart: its outside, and the rooms that hold blood.
pub(super) struct Heart {
    pub(super) body: Field,
    pub(super) left_rooms: Field,
    pub(super) right_rooms: Field,
    /// Fat in the grooves, and the heart's own vessels in it.
    pub(super) grooves: Field,
    pub(super) arteries: Field,
    pub(super) veins: Field,
}

const LV: ([f32; 3], [f32; 3]) = ([-20.0, 12.0, 42.0], [-72.0, 50.0, 4.0]);

pub(super) fn heart(revision: Revision) -> Heart {
    let mut body = Field::default();
    // Rooms behind first: left atrium, right atrium, then the chambers.
    body.join(0.0, ellipsoid([-6.0, -16.0, 52.0], [38.0, 22.0, 27.0]));
    body.join(
        4.0,
        ellipsoid([34.0, 18.0, 32.0], [27.0, 30.0, 38.0]).turned(0.0, 8.0, 0.0),
    );
    body.join(5.0, capsule(LV.0, LV.1, 35.0, 15.0));
    body.join(5.0, right_ventricle(0.0));
    body.join(
        6.0,
        capsule([-16.0, 50.0, 34.0], [-20.0, 46.0, 72.0], 20.0, 14.0),
    );
    // The ears of the atria.
    body.join(
        3.0,
        ellipsoid([20.0, 42.0, 58.0], [18.0, 11.0, 12.0]).turned(0.0, 20.0, -20.0),
    );
    body.join(
        3.0,
        ellipsoid([-48.0, 16.0, 66.0], [12.0, 19.0, 9.0]).turned(0.0, 20.0, 20.0),
    );
    let ring: [Knot; 6] = [
        ([24.0, 46.0, 66.0], 6.0),
        ([22.0, 58.0, 40.0], 7.0),
        ([28.0, 50.0, 8.0], 7.0),
        ([20.0, 22.0, -6.0], 7.0),
        ([-16.0, -10.0, 14.0], 7.0),
        ([-46.0, -10.0, 44.0], 7.0),
    ];
    let front: [Knot; 4] = [
        ([-34.0, 44.0, 66.0], 5.5),
        ([-46.0, 60.0, 42.0], 6.0),
        ([-62.0, 68.0, 16.0], 6.0),
        ([-78.0, 62.0, -6.0], 5.0),
    ];
    body.raise_all(
        -4.0,
        curve(&ring)
            .into_iter()
            .map(|s| s.moved([0.0; 3]))
            .collect(),
    );
    body.raise_all(-3.0, curve(&front));
    let on = |p: [f32; 3], depth: f32| body.pull(p, depth);
    let mut grooves = Field::default();
    grooves.join_all(0.0, curve(&ring.map(|(p, r)| (on(p, -1.0), r * 0.7))));
    grooves.join_all(0.0, curve(&front.map(|(p, r)| (on(p, -1.0), r * 0.6))));
    let mut arteries = Field::default();
    // Where arteries and veins cross, the arteries lie farther out.
    let [arteries_mm, veins_mm] = match revision {
        Revision::First => [0.8, 0.8],
        Revision::Second => [1.8, -1.8],
    };
    let mut add = |knots: &[Knot]| {
        let laid: Vec<Knot> = knots
            .iter()
            .map(|&(p, r)| (on(p, arteries_mm), r))
            .collect();
        arteries.join_all(0.0, curve(&laid));
    };
    add(&[
        ([8.0, 44.0, 76.0], 2.6),
        ([24.0, 54.0, 52.0], 2.5),
        ([27.0, 56.0, 22.0], 2.4),
        ([24.0, 34.0, -4.0], 2.2),
        ([-8.0, 14.0, -12.0], 2.0),
    ]);
    add(&[
        ([27.0, 56.0, 14.0], 1.9),
        ([4.0, 72.0, -2.0], 1.7),
        ([-24.0, 72.0, -14.0], 1.5),
    ]);
    add(&[
        ([-30.0, 34.0, 72.0], 2.6),
        ([-42.0, 58.0, 52.0], 2.5),
        ([-58.0, 68.0, 24.0], 2.2),
        ([-74.0, 66.0, 2.0], 1.9),
        ([-80.0, 54.0, -10.0], 1.6),
    ]);
    add(&[
        ([-48.0, 62.0, 42.0], 1.9),
        ([-70.0, 56.0, 28.0], 1.7),
        ([-86.0, 48.0, 10.0], 1.4),
    ]);
    add(&[
        ([-34.0, 28.0, 70.0], 2.3),
        ([-54.0, 8.0, 58.0], 2.1),
        ([-56.0, -8.0, 40.0], 1.9),
        ([-60.0, 10.0, 12.0], 1.6),
    ]);
    if revision == Revision::Second {
        // From the great artery, and from one to the next.
        let start = |end: [f32; 3], r: f32| (on(end, arteries_mm), r);
        for joint in [
            [([0.0, 28.0, 68.0], 2.6), start([8.0, 44.0, 76.0], 2.6)],
            [([-8.0, 24.0, 64.0], 2.6), start([-30.0, 34.0, 72.0], 2.6)],
            [
                start([-30.0, 34.0, 72.0], 2.3),
                start([-34.0, 28.0, 70.0], 2.3),
            ],
            [
                start([27.0, 56.0, 22.0], 1.9),
                start([27.0, 56.0, 14.0], 1.9),
            ],
            [
                start([-42.0, 58.0, 52.0], 1.9),
                start([-48.0, 62.0, 42.0], 1.9),
            ],
        ] {
            arteries.join_all(0.0, chain(&joint));
        }
    }
    let mut veins = Field::default();
    let laid: Vec<Knot> = [
        ([-76.0, 60.0, 0.0], 1.7),
        ([-52.0, 64.0, 40.0], 2.2),
        ([-52.0, -4.0, 46.0], 3.0),
        ([-20.0, -14.0, 20.0], 3.6),
        ([16.0, -2.0, 8.0], 3.8),
    ]
    .map(|(p, r)| (on(p, veins_mm), r))
    .to_vec();
    veins.join_all(0.0, curve(&laid[..2]));
    veins.join_all(0.0, curve(&laid[2..]));
    if revision == Revision::Second {
        let between = along_curve(&[
            ([-52.0, 64.0, 40.0], 2.2),
            ([-62.0, 30.0, 58.0], 2.6),
            ([-52.0, -4.0, 46.0], 3.0),
        ]);
        let laid: Vec<Knot> = between.iter().map(|&(p, r)| (on(p, veins_mm), r)).collect();
        veins.join_all(0.0, chain(&laid));
    }
    let mut left_rooms = Field::default();
    left_rooms.join(0.0, ellipsoid([-6.0, -16.0, 52.0], [35.0, 19.0, 24.0]));
    left_rooms.join(
        0.0,
        capsule([-24.0, 14.0, 39.0], [-64.0, 44.0, 10.0], 21.5, 5.5),
    );
    left_rooms.join(
        3.0,
        capsule([-8.0, -6.0, 50.0], [-24.0, 14.0, 40.0], 12.0, 14.0),
    );
    left_rooms.join(
        3.0,
        capsule([-20.0, 18.0, 44.0], [-2.0, 18.0, 64.0], 11.0, 11.0),
    );
    let mut right_rooms = Field::default();
    right_rooms.join(0.0, right_ventricle(4.5));
    // The wall between the chambers is the left one's.
    right_rooms.carve(2.0, capsule(LV.0, LV.1, 35.0, 15.0));
    right_rooms.join(
        4.0,
        capsule([-16.0, 50.0, 34.0], [-20.0, 46.0, 72.0], 15.5, 11.0),
    );
    right_rooms.join(
        0.0,
        ellipsoid([34.0, 18.0, 32.0], [23.5, 26.5, 34.5]).turned(0.0, 8.0, 0.0),
    );
    right_rooms.join(
        3.0,
        capsule([28.0, 28.0, 24.0], [2.0, 44.0, 20.0], 13.0, 11.0),
    );
    Heart {
        body,
        left_rooms,
        right_rooms,
        grooves,
        arteries,
        veins,
    }
}

fn right_ventricle(inset: f32) -> Shape {
    ellipsoid(
        [-18.0, 46.0, 18.0],
        [48.0 - inset, 27.0 - inset, 34.0 - inset],
    )
    .turned(0.0, 24.0, 14.0)
}

/// Windpipe and main bronchi outside; inside less `inset` mm.
pub(super) fn windpipe(inset: f32) -> Field {
    let mut f = Field::default();
    let less = |knots: &[Knot]| -> Vec<Shape> {
        let knots: Vec<Knot> = knots.iter().map(|&(p, r)| (p, r - inset)).collect();
        curve(&knots)
    };
    f.join_all(
        0.0,
        less(&[
            ([0.0, 22.0, 240.0], 10.5),
            ([0.0, 14.0, 190.0], 10.5),
            ([0.0, 0.0, 140.0], 10.5),
            ([0.0, -10.0, 104.0], 10.5),
        ]),
    );
    f.join_all(
        3.0,
        less(&[
            ([0.0, -10.0, 104.0], 8.5),
            ([20.0, -14.0, 88.0], 8.2),
            ([40.0, -16.0, 72.0], 7.0),
        ]),
    );
    f.join_all(
        3.0,
        less(&[
            ([0.0, -10.0, 104.0], 8.0),
            ([-26.0, -18.0, 88.0], 7.4),
            ([-50.0, -24.0, 74.0], 6.4),
        ]),
    );
    f
}

/// How far before the spine the hoops of the windpipe and of its main bronchi end, y in mm.
pub(super) fn windpipe_behind(p: &Points) -> Lanes {
    const OFF_AXIS_MM: f32 = 4.0;
    // The axis of the windpipe by height, and those of the bronchi by how far they have gone aside.
    const AXIS: [[f32; 2]; 4] = [[104.0, -10.0], [140.0, 0.0], [190.0, 14.0], [240.0, 22.0]];
    let mut y = Lanes::splat(0.0);
    for i in 0..LANES {
        let (x, z) = (p.x[i], p.z[i]);
        let aside = if x > 0.0 { -0.15 * x } else { 0.28 * x };
        let mut axis = AXIS[0][1] + aside;
        for pair in AXIS.windows(2) {
            let t = (z - pair[0][0]) / (pair[1][0] - pair[0][0]);
            if t > 0.0 {
                axis = pair[0][1] + (pair[1][1] - pair[0][1]) * t.min(1.0);
            }
        }
        y[i] = axis - OFF_AXIS_MM;
    }
    y
}

pub(super) fn gullet() -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([-2.0, 4.0, 240.0], 6.5),
            ([-4.0, -8.0, 180.0], 6.5),
            ([-4.0, -26.0, 130.0], 6.5),
            ([-2.0, -34.0, 90.0], 6.5),
            ([-3.0, -40.0, 50.0], 6.5),
            ([-9.0, -34.0, 24.0], 6.5),
            ([-14.0, -26.0, 8.0], 7.0),
        ]),
    );
    f
}

pub(super) fn glands() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid([15.0, 28.0, 208.0], [9.0, 10.0, 22.0])
            .turned(-14.0, -8.0, 0.0)
            .both(),
    );
    f.join(4.0, ellipsoid([0.0, 33.0, 200.0], [12.0, 4.0, 7.0]));
    f
}

/// A branching tree: bronchi, and beside them arteries; veins run between.
struct Tree<'a> {
    tubes: &'a mut Vec<Shape>,
    random: Random,
}

impl Tree<'_> {
    fn grow(&mut self, start: Vec3, way: Vec3, length: f32, radius: f32, depth: u32) {
        let way = way / way.length().max(1e-6);
        let end = start + way * length;
        self.tubes.push(capsule(
            start.to_array(),
            end.to_array(),
            radius,
            radius * 0.82,
        ));
        if depth == 0 {
            return;
        }
        // Two planes of branching, crossed from one generation to the next.
        let helper = if way.z.abs() < 0.8 { Vec3::Z } else { Vec3::Y };
        let across = way.cross(helper);
        let across = across / across.length();
        let other = way.cross(across);
        let (a, b) = if depth.is_multiple_of(2) {
            (across, other)
        } else {
            (other, across)
        };
        for sign in [-1.0f32, 1.0] {
            let spread = 0.62 + 0.3 * (self.random.next() - 0.5);
            let next = way + a * (sign * spread) + b * (0.5 * (self.random.next() - 0.5));
            let length = length * (0.76 + 0.2 * (self.random.next() - 0.5));
            self.grow(end, next, length, radius * 0.76, depth - 1);
        }
    }
}

/// Where the trees of the lobes begin, where they go, and their length.
const LOBES: [([f32; 3], [f32; 3], f32); 6] = [
    ([40.0, -16.0, 78.0], [0.5, 0.1, 1.0], 26.0),
    ([44.0, -16.0, 68.0], [0.8, 1.1, -0.2], 27.0),
    ([46.0, -20.0, 64.0], [0.6, -0.5, -1.0], 30.0),
    ([-50.0, -22.0, 80.0], [-0.4, 0.4, 1.0], 26.0),
    ([-56.0, -18.0, 72.0], [-0.7, 1.0, -0.3], 24.0),
    ([-54.0, -26.0, 66.0], [-0.6, -0.4, -1.0], 30.0),
];

/// The trees within the lungs: bronchi, arteries (they carry spent blood), veins.
pub(super) fn lung_trees() -> [Field; 3] {
    [
        ([0.0f32, 0.0, 0.0], 4.2, 17u32),
        ([0.0, 5.0, 5.0], 4.0, 17),
        ([2.0, 2.0, -7.0], 3.8, 91),
    ]
    .map(|(shift, radius, seed)| {
        let mut f = Field::default();
        for (i, (start, way, length)) in LOBES.into_iter().enumerate() {
            let mut tubes = Vec::new();
            let mut tree = Tree {
                tubes: &mut tubes,
                random: Random(seed + 13 * i as u32),
            };
            tree.grow(
                Vec3::from_array(start) + Vec3::from_array(shift),
                Vec3::from_array(way),
                length,
                radius,
                5,
            );
            f.join_all(0.0, tubes);
        }
        f
    })
}

/// Arteries and veins of the chest, the neck and along the spine.
pub(super) fn vessels(revision: Revision) -> (Field, Field) {
    let (mut arteries, mut veins) = (Field::default(), Field::default());
    let tube = |f: &mut Field, knots: &[Knot]| f.join_all(2.0, curve(knots));
    // The great artery: root, arch, down the spine, parting before L4.
    tube(
        &mut arteries,
        &[
            ([-4.0, 18.0, 56.0], 15.5),
            ([6.0, 24.0, 76.0], 15.0),
            ([10.0, 20.0, 100.0], 14.5),
            ([2.0, 4.0, 118.0], 13.8),
            ([-14.0, -18.0, 120.0], 13.2),
            ([-24.0, -38.0, 104.0], 12.6),
            ([-24.0, -44.0, 76.0], 12.2),
            ([-22.0, -46.0, 30.0], 11.8),
            ([-16.0, -38.0, -20.0], 11.4),
            ([-8.0, -22.0, -70.0], 11.0),
            ([-5.0, -8.0, -120.0], 10.2),
            ([-4.0, 4.0, -170.0], 9.6),
            ([-3.0, 7.0, -206.0], 9.2),
        ],
    );
    for side in [-1.0f32, 1.0] {
        tube(
            &mut arteries,
            &[
                ([-3.0, 7.0, -204.0], 7.4),
                ([side * 22.0, 4.0, -234.0], 6.6),
                ([side * 48.0, 14.0, -268.0], 5.6),
                ([side * 66.0, 30.0, -306.0], 5.2),
            ],
        );
        tube(
            &mut arteries,
            &[
                ([side * 36.0, 6.0, -252.0], 4.6),
                ([side * 42.0, -18.0, -280.0], 4.2),
                ([side * 40.0, -30.0, -306.0], 4.0),
            ],
        );
        // Under the collar bone to the arm, and up the neck.
        let root: Knot = if side > 0.0 {
            ([14.0, 14.0, 142.0], 6.0)
        } else {
            ([-16.0, -10.0, 136.0], 5.6)
        };
        let mut arm = vec![
            root,
            ([side * 28.0, 2.0, 164.0], 5.2),
            ([side * 54.0, 6.0, 168.0], 5.0),
        ];
        if revision == Revision::Second {
            // Over the first rib, or through it.
            arm.push(([side * 72.0, 7.0, 160.0], 4.8));
        }
        arm.extend([
            ([side * 92.0, 0.0, 150.0], 4.6),
            ([side * 134.0, -14.0, 118.0], 4.4),
            ([side * 168.0, -20.0, 84.0], 4.0),
            ([side * 190.0, -22.0, 60.0], 4.0),
        ]);
        tube(&mut arteries, &arm);
        let root: Knot = if side > 0.0 {
            ([16.0, 14.0, 148.0], 5.0)
        } else {
            ([-8.0, 0.0, 126.0], 4.8)
        };
        tube(
            &mut arteries,
            &[
                root,
                ([side * 19.0, 12.0, 166.0], 4.4),
                ([side * 24.0, 10.0, 196.0], 4.2),
                ([side * 27.0, 10.0, 240.0], 4.2),
            ],
        );
        if revision == Revision::Second {
            // Behind the breastbone, from that under the collar bone.
            tube(
                &mut arteries,
                &[
                    ([side * 28.0, 3.0, 163.0], 1.9),
                    ([side * 19.0, 22.0, 156.0], 1.9),
                    ([side * 17.0, 34.0, 142.0], 1.9),
                ],
            );
        }
        tube(
            &mut arteries,
            &[
                ([side * 17.0, 34.0, 142.0], 1.9),
                ([side * 20.0, 64.0, 90.0], 1.8),
                ([side * 20.0, 74.0, 20.0], 1.7),
            ],
        );
    }
    tube(
        &mut arteries,
        &[
            ([8.0, 10.0, 112.0], 7.6),
            ([12.0, 14.0, 130.0], 7.0),
            ([16.0, 14.0, 146.0], 6.0),
        ],
    );
    // Lung veins reach the left atrium from both sides.
    for knots in [
        [
            ([58.0, -14.0, 76.0], 5.0),
            ([40.0, -16.0, 64.0], 6.2),
            ([22.0, -16.0, 58.0], 6.6),
        ],
        [
            ([60.0, -22.0, 44.0], 5.0),
            ([42.0, -20.0, 46.0], 6.0),
            ([22.0, -18.0, 46.0], 6.4),
        ],
        [
            ([-66.0, -12.0, 80.0], 5.0),
            ([-50.0, -14.0, 66.0], 6.0),
            ([-34.0, -16.0, 60.0], 6.4),
        ],
        [
            ([-66.0, -28.0, 46.0], 5.0),
            ([-50.0, -24.0, 46.0], 6.0),
            ([-34.0, -20.0, 48.0], 6.4),
        ],
    ] {
        tube(&mut arteries, &knots);
    }
    // The lung artery and its fork.
    tube(
        &mut veins,
        &[
            ([-20.0, 46.0, 68.0], 14.0),
            ([-20.0, 36.0, 84.0], 13.0),
            ([-20.0, 14.0, 94.0], 12.0),
            ([-34.0, -6.0, 94.0], 10.5),
            ([-58.0, -20.0, 84.0], 7.6),
        ],
    );
    tube(
        &mut veins,
        &[
            ([-20.0, 14.0, 94.0], 10.5),
            ([4.0, -2.0, 86.0], 10.0),
            ([30.0, -4.0, 82.0], 9.0),
            ([50.0, -10.0, 74.0], 7.0),
        ],
    );
    // Upper and lower great veins.
    tube(
        &mut veins,
        &[
            ([32.0, 14.0, 58.0], 10.5),
            ([32.0, 18.0, 84.0], 10.2),
            ([30.0, 20.0, 112.0], 9.6),
            ([28.0, 22.0, 130.0], 8.6),
        ],
    );
    tube(
        &mut veins,
        &[
            ([28.0, 22.0, 130.0], 7.8),
            ([6.0, 32.0, 136.0], 7.4),
            ([-18.0, 34.0, 146.0], 7.2),
            ([-34.0, 26.0, 160.0], 7.0),
        ],
    );
    for side in [-1.0f32, 1.0] {
        tube(
            &mut veins,
            &[
                if side > 0.0 {
                    ([28.0, 22.0, 130.0], 7.6)
                } else {
                    ([-34.0, 26.0, 160.0], 7.0)
                },
                ([side * 36.0, 26.0, 158.0], 6.6),
                ([side * 58.0, 22.0, 164.0], 6.0),
                ([side * 94.0, 12.0, 146.0], 5.6),
                ([side * 136.0, -8.0, 112.0], 5.2),
                ([side * 168.0, -14.0, 78.0], 4.8),
                ([side * 190.0, -16.0, 54.0], 4.8),
            ],
        );
        tube(
            &mut veins,
            &[
                ([side * 36.0, 26.0, 158.0], 6.0),
                ([side * 33.0, 18.0, 184.0], 6.2),
                ([side * 36.0, 12.0, 240.0], 6.4),
            ],
        );
        tube(
            &mut veins,
            &[
                ([8.0, 2.0, -212.0], 8.0),
                ([side * 22.0 + 3.0, -4.0, -240.0], 7.0),
                ([side * 46.0, 6.0, -272.0], 6.2),
                ([side * 62.0, 24.0, -306.0], 6.0),
            ],
        );
    }
    tube(
        &mut veins,
        &[
            ([30.0, 6.0, 14.0], 12.0),
            ([27.0, -8.0, 0.0], 12.0),
            ([24.0, -18.0, -40.0], 12.0),
            ([20.0, -14.0, -90.0], 11.4),
            ([17.0, -4.0, -140.0], 11.0),
            ([13.0, 4.0, -190.0], 10.6),
            ([8.0, 3.0, -214.0], 10.0),
        ],
    );
    // The unpaired vein on the right of the spine.
    tube(
        &mut veins,
        &[
            ([12.0, -22.0, -90.0], 3.0),
            ([14.0, -42.0, -20.0], 3.6),
            ([14.0, -46.0, 60.0], 4.2),
            ([16.0, -36.0, 100.0], 4.6),
            ([28.0, -12.0, 108.0], 4.8),
            ([30.0, 12.0, 104.0], 4.8),
        ],
    );
    (arteries, veins)
}
