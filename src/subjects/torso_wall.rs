//! The torso's outside: skin, and the muscles under it.
//!
//! Millimetres as in `torso`.

use glam::Vec3;

use super::lanes::{Lanes, Points};
use super::profile::{Profile, Ring};
use super::shape::{Field, Knot, Places, Shape, at, ball, capsule, curve, ellipsoid, strap};

/// The skin without the shoulders, lowest first: height, half width, front, back.
const TRUNK: [Ring; 17] = [
    [-276.0, 164.0, 86.0, -116.0],
    [-250.0, 159.0, 90.0, -112.0],
    [-220.0, 150.0, 94.0, -104.0],
    [-180.0, 140.0, 97.0, -94.0],
    [-140.0, 136.0, 98.0, -92.0],
    [-100.0, 141.0, 99.0, -97.0],
    [-60.0, 149.0, 101.0, -104.0],
    [-20.0, 155.0, 104.0, -111.0],
    [20.0, 158.0, 105.0, -117.0],
    [60.0, 158.0, 101.0, -119.0],
    [100.0, 153.0, 90.0, -117.0],
    [130.0, 138.0, 76.0, -111.0],
    [150.0, 114.0, 64.0, -103.0],
    [166.0, 90.0, 54.0, -94.0],
    [182.0, 70.0, 50.0, -84.0],
    [204.0, 60.0, 48.0, -72.0],
    [230.0, 57.0, 48.0, -66.0],
];

/// Where the arms are cut off.
pub(super) const ARM_END_MM: f32 = 180.0;
/// Where the neck is cut off.
pub(super) const TOP_MM: f32 = 226.0;
/// Where the hips are cut off.
pub(super) const BOTTOM_MM: f32 = -272.0;

/// The skin, whole: what lies on it and under it is laid by it.
pub(super) struct Outside {
    pub(super) trunk: Profile,
    pub(super) skin: Field,
}

/// Thickness of the fat under the skin at a height, mm.
pub(super) fn fat_mm(z: f32) -> f32 {
    let belly = 1.0 - ((z + 130.0) / 130.0).clamp(-1.0, 1.0).abs();
    5.0 + 6.0 * belly
}

/// Skin over the fat, mm, for laying only.
const SKIN_MM: f32 = 2.3;

impl Outside {
    pub(super) fn new() -> Self {
        Self {
            trunk: Profile::new(&TRUNK, 0.55),
            skin: skin(),
        }
    }

    /// Knots moved to where the muscles' outer surface is, before its own relief.
    fn laid(&self, knots: &[Knot]) -> Vec<Knot> {
        let near = self.skin.everywhere();
        let depth = |p: Vec3| {
            let p = Places::new(Points {
                x: Lanes::splat(p.x),
                y: Lanes::splat(p.y),
                z: Lanes::splat(p.z),
            });
            near.onto(&p, self.trunk.distance(&p.plain))[0] + SKIN_MM
        };
        let lay = |&(p, r): &Knot| {
            let mut p = at(p);
            for _ in 0..6 {
                let d = depth(p);
                let slope = Vec3::new(
                    depth(p + Vec3::X * 0.5) - d,
                    depth(p + Vec3::Y * 0.5) - d,
                    depth(p + Vec3::Z * 0.5) - d,
                ) / 0.5;
                p -= slope * ((d + fat_mm(p.z)) / slope.length_squared().max(0.3));
            }
            (p.to_array(), r)
        };
        knots.iter().map(lay).collect()
    }

    /// What the muscles' outer surface makes of the skin's, seen once skin and fat are gone.
    pub(super) fn muscle_relief(&self) -> Field {
        let mut f = Field::default();
        // Bellies of the straight muscle between its tendinous rows.
        let rows = [-22.0f32, -62.0, -104.0, -150.0, -206.0];
        for pair_of in rows.windows(2) {
            let z = 0.5 * (pair_of[0] + pair_of[1]);
            let half = 0.5 * (pair_of[0] - pair_of[1]);
            f.raise(
                4.0,
                ellipsoid([33.0, 92.0, z], [31.0, 30.0, half * 1.15]).both(),
            );
        }
        // The breastbone is bare of muscle.
        f.raise(
            -12.0,
            capsule([0.0, 84.0, 124.0], [0.0, 96.0, 6.0], 20.0, 18.0),
        );
        // Furrows between one muscle and the next.
        let mut furrow = |mm: f32, knots: &[Knot]| f.raise_all(-mm, pair(curve(&self.laid(knots))));
        let r = 6.0;
        // Under the great chest muscle, and between it and the deltoid.
        furrow(
            5.0,
            &[
                ([16.0, 104.0, 10.0], r),
                ([50.0, 102.0, 20.0], r),
                ([88.0, 92.0, 32.0], r),
                ([118.0, 72.0, 50.0], r),
                ([140.0, 44.0, 76.0], r),
            ],
        );
        furrow(
            5.0,
            &[
                ([84.0, 52.0, 152.0], r),
                ([108.0, 48.0, 132.0], r),
                ([132.0, 32.0, 106.0], r),
                ([158.0, 10.0, 76.0], r),
            ],
        );
        // Within the chest muscle: between the part of the collar bone and that of the breastbone, and its fan.
        furrow(
            2.0,
            &[
                ([20.0, 80.0, 124.0], 5.0),
                ([70.0, 78.0, 112.0], 5.0),
                ([118.0, 54.0, 100.0], 5.0),
            ],
        );
        furrow(
            1.4,
            &[
                ([20.0, 96.0, 76.0], 5.0),
                ([70.0, 92.0, 80.0], 5.0),
                ([118.0, 64.0, 86.0], 5.0),
            ],
        );
        // Teeth of the saw muscle and the oblique one between them.
        for (i, z) in [34.0f32, 10.0, -16.0, -42.0, -68.0].into_iter().enumerate() {
            let i = i as f32;
            furrow(
                3.4,
                &[
                    ([100.0 + 2.0 * i, 80.0 - 8.0 * i, z - 14.0], 5.0),
                    ([126.0, 56.0 - 10.0 * i, z], 5.0),
                    ([144.0, 20.0 - 8.0 * i, z + 14.0], 5.0),
                ],
            );
        }
        furrow(
            4.0,
            &[
                ([104.0, 80.0, 26.0], 5.0),
                ([108.0, 76.0, 0.0], 5.0),
                ([108.0, 74.0, -24.0], 5.0),
                ([112.0, 66.0, -50.0], 5.0),
                ([118.0, 52.0, -76.0], 5.0),
            ],
        );
        // The broad back muscle's front edge.
        furrow(
            4.0,
            &[
                ([150.0, -8.0, 66.0], r),
                ([150.0, -14.0, 20.0], r),
                ([142.0, -24.0, -40.0], r),
                ([132.0, -36.0, -110.0], r),
                ([128.0, -48.0, -180.0], r),
            ],
        );
        // The trapezius' lower edge, the deltoid's hind edge.
        furrow(
            4.0,
            &[
                ([6.0, -106.0, -74.0], r),
                ([32.0, -112.0, 0.0], r),
                ([64.0, -108.0, 70.0], r),
                ([96.0, -98.0, 122.0], r),
            ],
        );
        furrow(
            4.5,
            &[
                ([92.0, -96.0, 128.0], r),
                ([124.0, -82.0, 122.0], r),
                ([150.0, -66.0, 96.0], r),
                ([172.0, -58.0, 70.0], r),
            ],
        );
        // Hip: between the oblique and the gluteal muscle, along the crest.
        furrow(
            4.0,
            &[
                ([52.0, -98.0, -226.0], r),
                ([98.0, -74.0, -206.0], r),
                ([132.0, -26.0, -204.0], r),
                ([142.0, 14.0, -222.0], r),
                ([132.0, 50.0, -252.0], r),
            ],
        );
        f
    }

    /// White lines and sheets on the muscles: mid line, rows and edges of the straight muscle, the sheet of the lower
    /// back.
    pub(super) fn sheets(&self) -> Field {
        let mut f = Field::default();
        f.join_all(
            0.0,
            curve(&self.laid(&[
                ([0.0, 98.0, -4.0], 3.0),
                ([0.0, 96.0, -60.0], 4.5),
                ([0.0, 92.0, -160.0], 5.0),
                ([0.0, 86.0, -280.0], 3.0),
            ])),
        );
        for (z, dip) in [
            (-22.0f32, 3.0f32),
            (-62.0, 3.0),
            (-104.0, 2.0),
            (-150.0, 2.0),
        ] {
            f.join_all(
                0.0,
                pair(curve(&self.laid(&[
                    ([2.0, 96.0, z], 2.2),
                    ([20.0, 96.0, z + dip], 2.4),
                    ([38.0, 93.0, z - dip], 2.4),
                    ([62.0, 87.0, z + dip], 2.2),
                ]))),
            );
        }
        f.join_all(
            0.0,
            pair(curve(&self.laid(&[
                ([64.0, 88.0, -30.0], 4.0),
                ([71.0, 84.0, -80.0], 4.5),
                ([72.0, 80.0, -140.0], 5.0),
                ([60.0, 80.0, -210.0], 6.0),
                ([32.0, 82.0, -280.0], 8.0),
            ]))),
        );
        // The diamond over the loins.
        f.join_all(
            0.0,
            pair(curve(&self.laid(&[
                ([4.0, -102.0, -70.0], 4.0),
                ([14.0, -96.0, -120.0], 16.0),
                ([22.0, -92.0, -170.0], 26.0),
                ([24.0, -96.0, -220.0], 28.0),
                ([14.0, -104.0, -262.0], 18.0),
            ]))),
        );
        f.join_all(
            0.0,
            curve(&self.laid(&[
                ([0.0, -116.0, 120.0], 5.0),
                ([0.0, -116.0, 40.0], 4.0),
                ([0.0, -106.0, -70.0], 4.0),
            ])),
        );
        f
    }
}

fn pair(shapes: Vec<Shape>) -> Vec<Shape> {
    shapes.into_iter().map(Shape::both).collect()
}

/// Shoulders and neck joined to the trunk, and what shows through the skin.
fn skin() -> Field {
    let mut f = Field::default();
    f.join(
        34.0,
        capsule([142.0, -30.0, 126.0], [226.0, -30.0, 42.0], 46.0, 43.0).both(),
    );
    f.join(
        26.0,
        strap(
            [36.0, -36.0, 196.0],
            [136.0, -36.0, 152.0],
            28.0,
            26.0,
            [0.2, 0.0, 1.0],
            0.8,
        )
        .both(),
    );
    // Front: chest, nipples, notch, collar bones, arch of the ribs, mid line, navel.
    f.raise(
        8.0,
        ellipsoid([68.0, 92.0, 72.0], [66.0, 44.0, 52.0]).both(),
    );
    for (mm, radius) in [(0.9, 13.0), (3.4, 5.5)] {
        f.raise(
            mm,
            ellipsoid([98.0, 86.0, 54.0], [radius, 40.0, radius]).both(),
        );
    }
    f.raise(
        -3.2,
        capsule([0.0, 104.0, 118.0], [0.0, 112.0, 6.0], 17.0, 19.0),
    );
    f.raise_all(
        -3.0,
        pair(curve(&[
            ([28.0, 112.0, 20.0], 19.0),
            ([66.0, 108.0, 24.0], 19.0),
            ([104.0, 90.0, 36.0], 18.0),
            ([132.0, 58.0, 62.0], 17.0),
        ])),
    );
    f.raise(-7.0, ball([0.0, 56.0, 164.0], 20.0));
    f.raise_all(
        5.0,
        pair(curve(&[
            ([18.0, 62.0, 153.0], 12.0),
            ([50.0, 62.0, 160.0], 11.0),
            ([92.0, 44.0, 170.0], 11.0),
        ])),
    );
    f.raise(
        -5.0,
        ellipsoid([74.0, 44.0, 182.0], [40.0, 26.0, 16.0]).both(),
    );
    f.raise_all(
        -2.6,
        pair(curve(&[
            ([8.0, 102.0, -16.0], 20.0),
            ([44.0, 100.0, -52.0], 24.0),
            ([86.0, 82.0, -90.0], 26.0),
        ])),
    );
    f.raise(
        -3.0,
        capsule([0.0, 104.0, -20.0], [0.0, 98.0, -150.0], 19.0, 18.0),
    );
    f.raise_all(
        -2.2,
        pair(curve(&[
            ([70.0, 90.0, -70.0], 20.0),
            ([74.0, 86.0, -140.0], 20.0),
            ([60.0, 82.0, -210.0], 20.0),
            ([36.0, 84.0, -262.0], 18.0),
        ])),
    );
    f.raise(2.0, ellipsoid([0.0, 98.0, -200.0], [54.0, 22.0, 44.0]));
    f.raise(-6.0, ellipsoid([0.0, 98.0, -166.0], [9.0, 12.0, 10.0]));
    f.raise(3.6, ball([86.0, 104.0, 50.0], 7.0).both());
    f.raise(
        5.0,
        ellipsoid([124.0, 56.0, -262.0], [24.0, 26.0, 26.0]).both(),
    );
    f.raise_all(
        3.0,
        pair(curve(&[
            ([24.0, 58.0, 158.0], 11.0),
            ([38.0, 38.0, 192.0], 12.0),
            ([54.0, 6.0, 232.0], 12.0),
        ])),
    );
    f.raise(3.0, ball([0.0, 50.0, 214.0], 16.0));
    // Back: furrow over the spine, shoulder blades, the long muscles, dimples.
    f.raise_all(
        -5.0,
        curve(&[
            ([0.0, -108.0, 170.0], 14.0),
            ([0.0, -114.0, 130.0], 20.0),
            ([0.0, -118.0, 60.0], 24.0),
            ([0.0, -106.0, -60.0], 24.0),
            ([0.0, -90.0, -160.0], 26.0),
            ([0.0, -104.0, -250.0], 20.0),
        ]),
    );
    f.raise(
        6.0,
        ellipsoid([96.0, -100.0, 92.0], [42.0, 34.0, 62.0]).both(),
    );
    f.raise(
        -2.0,
        ellipsoid([112.0, -86.0, 16.0], [34.0, 34.0, 26.0]).both(),
    );
    f.raise(
        5.0,
        capsule([34.0, -104.0, 10.0], [36.0, -88.0, -200.0], 20.0, 30.0).both(),
    );
    f.raise(-3.0, ball([40.0, -108.0, -250.0], 14.0).both());
    f
}

/// Muscles that lie deep, each by itself: they show in slices and once the wall is gone.
pub(super) fn deep_muscles() -> Field {
    let mut f = Field::default();
    let mut add = |shapes: Vec<Shape>| f.join_all(0.0, pair(shapes));
    // The long muscles of the back, two strands on each side.
    add(curve(&[
        ([13.0, -82.0, 226.0], 10.0),
        ([16.0, -96.0, 150.0], 11.0),
        ([17.0, -104.0, 60.0], 11.0),
        ([18.0, -92.0, -60.0], 14.0),
        ([19.0, -76.0, -160.0], 17.0),
        ([18.0, -88.0, -280.0], 13.0),
    ]));
    add(curve(&[
        ([34.0, -94.0, 120.0], 8.0),
        ([40.0, -102.0, 40.0], 11.0),
        ([44.0, -92.0, -60.0], 15.0),
        ([50.0, -76.0, -150.0], 19.0),
        ([40.0, -84.0, -240.0], 13.0),
    ]));
    // Square muscle of the loins, and psoas with iliacus.
    add(vec![strap(
        [44.0, -46.0, -84.0],
        [72.0, -58.0, -216.0],
        20.0,
        24.0,
        [0.4, 1.0, 0.0],
        0.42,
    )]);
    add(curve(&[
        ([27.0, -36.0, -92.0], 6.0),
        ([36.0, -22.0, -150.0], 17.0),
        ([46.0, -12.0, -205.0], 22.0),
        ([64.0, 6.0, -260.0], 22.0),
        ([74.0, 22.0, -300.0], 22.0),
    ]));
    add(vec![strap(
        [84.0, -34.0, -232.0],
        [84.0, 6.0, -290.0],
        24.0,
        30.0,
        [0.8, -0.5, 0.2],
        0.4,
    )]);
    // Neck: scalenes, levator, long muscle before the spine, the nodding muscle.
    add(vec![capsule(
        [20.0, -22.0, 226.0],
        [46.0, -4.0, 152.0],
        9.0,
        10.0,
    )]);
    add(vec![capsule(
        [26.0, -46.0, 226.0],
        [60.0, -66.0, 150.0],
        10.0,
        12.0,
    )]);
    add(vec![capsule(
        [8.0, -6.0, 226.0],
        [9.0, -26.0, 150.0],
        5.0,
        6.0,
    )]);
    add(vec![strap(
        [48.0, 2.0, 232.0],
        [18.0, 50.0, 152.0],
        14.0,
        9.0,
        [0.7, 0.7, 0.2],
        0.6,
    )]);
    add(vec![strap(
        [6.0, 36.0, 228.0],
        [9.0, 46.0, 150.0],
        9.0,
        8.0,
        [0.0, 1.0, 0.0],
        0.35,
    )]);
    f
}
