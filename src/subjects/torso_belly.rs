//! What the belly holds: liver, stomach, bowel, spleen, pancreas, kidneys; and the diaphragm above it.
//!
//! Millimetres as in `torso`; +x is the patient's right.

use super::paint::Revision;
use super::profile::Profile;
use super::random::Random;
use super::shape::{Field, Knot, at, ball, capsule, curve, ellipsoid, strap};

/// The space under the diaphragm: its surface is the dome.
pub(super) fn dome() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([66.0, -8.0, -84.0], [62.0, 78.0, 116.0]));
    f.join(22.0, ellipsoid([-66.0, -10.0, -88.0], [60.0, 76.0, 106.0]));
    f.join(26.0, ellipsoid([0.0, 4.0, -84.0], [72.0, 86.0, 92.0]));
    f.join(30.0, ellipsoid([0.0, 0.0, -200.0], [140.0, 110.0, 130.0]));
    f
}

pub(super) fn liver() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([64.0, -6.0, -36.0], [68.0, 86.0, 74.0]));
    f.join(18.0, ellipsoid([-6.0, 34.0, -14.0], [64.0, 44.0, 34.0]));
    f.join(14.0, ellipsoid([102.0, 4.0, -74.0], [24.0, 52.0, 44.0]));
    // Its underside, hollowed by stomach, bowel and kidney.
    f.carve(12.0, ellipsoid([-12.0, -14.0, -96.0], [92.0, 74.0, 66.0]));
    f.carve(10.0, ellipsoid([64.0, -44.0, -124.0], [34.0, 38.0, 58.0]));
    f.carve(10.0, ellipsoid([44.0, 66.0, -122.0], [60.0, 50.0, 46.0]));
    f.carve(8.0, ellipsoid([-64.0, -30.0, -6.0], [36.0, 46.0, 40.0]));
    // The notch of the round ligament.
    f.carve(
        5.0,
        capsule([4.0, 84.0, -60.0], [2.0, 74.0, -28.0], 5.0, 2.0),
    );
    f
}

/// Between the liver's lobes: the sickle-shaped band.
pub(super) fn band_of_liver() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        strap(
            [4.0, 76.0, -36.0],
            [4.0, 60.0, 4.0],
            9.0,
            12.0,
            [1.0, 0.0, 0.0],
            0.1,
        ),
    );
    f.join_all(
        0.0,
        curve(&[
            ([4.0, 78.0, -40.0], 2.4),
            ([3.0, 78.0, -90.0], 2.2),
            ([0.0, 72.0, -158.0], 2.0),
        ]),
    );
    f
}

pub(super) fn gallbladder() -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([24.0, 20.0, -64.0], 3.0),
            ([36.0, 40.0, -74.0], 8.0),
            ([46.0, 60.0, -88.0], 13.0),
            ([48.0, 66.0, -94.0], 12.0),
        ]),
    );
    f.join_all(
        2.0,
        curve(&[
            ([24.0, 20.0, -64.0], 2.6),
            ([22.0, 12.0, -84.0], 2.6),
            ([36.0, 10.0, -122.0], 2.4),
        ]),
    );
    f
}

const STOMACH: [Knot; 8] = [
    ([-60.0, -20.0, 2.0], 27.0),
    ([-64.0, -10.0, -16.0], 33.0),
    ([-66.0, 12.0, -50.0], 31.0),
    ([-56.0, 34.0, -84.0], 27.0),
    ([-34.0, 44.0, -108.0], 23.0),
    ([-8.0, 44.0, -112.0], 18.0),
    ([12.0, 36.0, -102.0], 13.0),
    ([24.0, 28.0, -98.0], 9.0),
];

/// The stomach, and the duodenum, outer surface less `inset` mm.
pub(super) fn stomach(inset: f32) -> Field {
    let mut f = Field::default();
    f.join_all(0.0, curve(&STOMACH.map(|(p, r)| (p, r - inset))));
    f.join_all(
        8.0,
        curve(&[
            ([-13.0, -26.0, 10.0], 8.0 - inset),
            ([-22.0, -18.0, -4.0], 9.0 - inset),
            ([-42.0, -8.0, -16.0], 12.0 - inset),
        ]),
    );
    f
}

pub(super) fn duodenum(inset: f32) -> Field {
    let knots: [Knot; 9] = [
        ([24.0, 28.0, -98.0], 11.0),
        ([40.0, 20.0, -94.0], 13.0),
        ([54.0, 4.0, -104.0], 13.0),
        ([58.0, -2.0, -130.0], 13.0),
        ([52.0, 4.0, -156.0], 13.0),
        ([28.0, 14.0, -166.0], 12.0),
        ([0.0, 20.0, -160.0], 12.0),
        ([-22.0, 12.0, -144.0], 12.0),
        ([-30.0, 18.0, -132.0], 12.0),
    ];
    let mut f = Field::default();
    f.join_all(0.0, curve(&knots.map(|(p, r)| (p, r - inset))));
    f
}

pub(super) fn pancreas() -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([40.0, 10.0, -138.0], 14.0),
            ([34.0, 14.0, -120.0], 16.0),
            ([12.0, 16.0, -110.0], 11.0),
            ([-18.0, 8.0, -104.0], 11.0),
            ([-52.0, -18.0, -96.0], 10.0),
            ([-80.0, -36.0, -84.0], 7.0),
        ]),
    );
    f
}

pub(super) fn spleen() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid([-94.0, -46.0, -48.0], [33.0, 46.0, 66.0]).turned(24.0, -8.0, -24.0),
    );
    f.carve(8.0, ellipsoid([-62.0, -18.0, -44.0], [22.0, 30.0, 46.0]));
    f
}

/// Middle and lean of each kidney: the right one stands lower.
const KIDNEYS: [([f32; 3], f32); 2] = [
    ([63.0, -42.0, -126.0], -10.0),
    ([-62.0, -44.0, -112.0], 10.0),
];

/// The kidneys: outside, marrow, hollow, and what leads from it.
pub(super) struct Kidneys {
    pub(super) body: Field,
    pub(super) pyramids: Field,
    pub(super) sinus: Field,
    pub(super) ureters: Field,
    pub(super) adrenals: Field,
}

pub(super) fn kidneys(revision: Revision) -> Kidneys {
    let (mut body, mut pyramids, mut sinus) =
        (Field::default(), Field::default(), Field::default());
    let (mut ureters, mut adrenals) = (Field::default(), Field::default());
    for (center, lean) in KIDNEYS {
        let [x, y, z] = center;
        let side = if x > 0.0 { 1.0 } else { -1.0 };
        body.join(
            0.0,
            ellipsoid(center, [27.0, 24.0, 55.0]).turned(-8.0, lean, 24.0 * side),
        );
        let inner = [x - side * 25.0, y + 7.0, z];
        body.carve(9.0, ellipsoid(inner, [15.0, 12.0, 17.0]));
        sinus.join(
            0.0,
            ellipsoid([x - side * 11.0, y + 4.0, z], [15.0, 9.0, 26.0]).turned(0.0, lean, 0.0),
        );
        // Pyramids point inwards, seven in a fan, before and behind.
        for k in 0..7 {
            let t = (k as f32 - 3.0) / 3.0;
            let reach = 1.0 - 0.32 * t * t;
            for back in [-1.0f32, 1.0] {
                let tip = [x - side * 5.0, y + 2.0 + back * 2.0, z + t * 20.0];
                let base = [
                    x + side * 12.0 * reach,
                    y - 2.0 + back * 9.0 * reach,
                    z + t * 40.0,
                ];
                pyramids.join(0.0, capsule(tip, base, 2.4, 5.6));
            }
        }
        // Pelvis of the kidney and ureter.
        let mut knots = vec![
            ([x - side * 8.0, y + 4.0, z + 6.0], 5.0),
            ([x - side * 24.0, y + 7.0, z - 2.0], 7.0),
            ([x - side * 29.0, y + 9.0, z - 18.0], 3.6),
            ([side * 38.0, -2.0, z - 56.0], 2.8),
        ];
        knots.extend(match revision {
            Revision::First => vec![
                ([side * 34.0, 12.0, -212.0], 2.8),
                ([side * 40.0, 4.0, -252.0], 2.8),
                ([side * 36.0, -8.0, -300.0], 2.8),
            ],
            // Before the vessels of the pelvis.
            Revision::Second => vec![
                ([side * 35.0, 12.0, -205.0], 2.8),
                ([side * 33.0, 20.0, -236.0], 2.8),
                ([side * 34.0, 20.0, -258.0], 2.8),
                ([side * 35.0, 6.0, -280.0], 2.8),
                ([side * 35.0, -8.0, -300.0], 2.8),
            ],
        });
        ureters.join_all(0.0, curve(&knots));
        for (dx, dz) in [(-6.0f32, -8.0f32), (6.0, -8.0)] {
            adrenals.join(
                2.0,
                strap(
                    [x - side * 16.0, y + 4.0, z + 66.0],
                    [x - side * 16.0 + dx, y, z + 56.0 + dz],
                    6.0,
                    6.0,
                    [0.3, 1.0, 0.0],
                    0.5,
                ),
            );
        }
    }
    Kidneys {
        body,
        pyramids,
        sinus,
        ureters,
        adrenals,
    }
}

/// Points along a smooth curve through knots, about `step` mm apart.
fn resampled(knots: &[Knot], step: f32) -> Vec<Knot> {
    let k = |i: isize| {
        let i = i.clamp(0, knots.len() as isize - 1) as usize;
        at(knots[i].0).extend(knots[i].1)
    };
    let mut out: Vec<Knot> = Vec::new();
    let mut walked = step;
    let mut previous = k(0);
    for i in 0..knots.len() as isize - 1 {
        let (a, b, c, d) = (k(i - 1), k(i), k(i + 1), k(i + 2));
        for piece in 0..64 {
            let t = piece as f32 / 64.0;
            let (t2, t3) = (t * t, t * t * t);
            let p = (b * 2.0
                + (c - a) * t
                + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2
                + (b * 3.0 - a - c * 3.0 + d) * t3)
                * 0.5;
            walked += (p.truncate() - previous.truncate()).length();
            previous = p;
            if walked >= step {
                walked -= step;
                out.push((p.truncate().to_array(), p.w));
            }
        }
    }
    out
}

const COLON: [Knot; 21] = [
    ([74.0, 22.0, -262.0], 20.0),
    ([79.0, 20.0, -242.0], 25.0),
    ([81.0, 10.0, -208.0], 24.0),
    ([83.0, 0.0, -168.0], 23.0),
    ([82.0, 6.0, -130.0], 23.0),
    ([70.0, 32.0, -114.0], 20.0),
    ([46.0, 46.0, -128.0], 19.0),
    ([14.0, 50.0, -144.0], 18.5),
    ([-24.0, 49.0, -146.0], 18.5),
    ([-58.0, 38.0, -128.0], 18.5),
    ([-82.0, 12.0, -104.0], 18.5),
    ([-90.0, -22.0, -90.0], 18.0),
    ([-90.0, -34.0, -118.0], 17.0),
    ([-88.0, -26.0, -165.0], 16.5),
    ([-88.0, -8.0, -205.0], 16.0),
    ([-82.0, 12.0, -236.0], 16.0),
    ([-66.0, 26.0, -254.0], 16.0),
    ([-44.0, 28.0, -252.0], 16.0),
    ([-26.0, 14.0, -256.0], 16.0),
    ([-12.0, -8.0, -268.0], 16.0),
    ([-2.0, -28.0, -300.0], 17.0),
];

/// The large bowel: pouches between its rings.
pub(super) fn colon() -> Field {
    let path = resampled(&COLON, 9.0);
    let mut f = Field::default();
    for (i, (p, r)) in path.iter().enumerate() {
        // Every pouch is about 27 mm long: two full rings, one that is drawn in.
        if i % 3 == 1 {
            f.join(5.0, ball(*p, r * 1.04));
        }
    }
    let core: Vec<Knot> = path.iter().map(|&(p, r)| (p, r * 0.74)).collect();
    f.join_all(
        6.0,
        core.windows(2)
            .map(|w| capsule(w[0].0, w[1].0, w[0].1, w[1].1))
            .collect(),
    );
    // The worm-like appendage.
    f.join_all(
        2.0,
        curve(&[
            ([80.0, 6.0, -256.0], 5.0),
            ([66.0, -2.0, -264.0], 4.6),
            ([58.0, 8.0, -280.0], 4.4),
        ]),
    );
    f
}

/// The small bowel: one tube in many loops, in front of the great vessels.
pub(super) fn small_bowel(cavity: &Profile) -> Vec<Knot> {
    let mut state = Random(11);
    let mut random = || state.next() - 0.5;
    let mut knots: Vec<Knot> = vec![([-30.0, 18.0, -132.0], 11.0), ([-44.0, 20.0, -146.0], 12.0)];
    // Columns from the patient's left to the right; up and down through each, now before, now behind.
    let columns = [-62.0f32, -39.0, -16.0, 7.0, 30.0, 50.0];
    for (c, &x) in columns.iter().enumerate() {
        let top = -172.0 - if x.abs() < 40.0 { 6.0 } else { 0.0 };
        let rows = 5;
        for layer in 0..2 {
            for row in 0..rows {
                let row = if (layer == 0) == (c % 2 == 0) {
                    row
                } else {
                    rows - 1 - row
                };
                let row = if layer == 1 { rows - 1 - row } else { row };
                let z = top - 24.0 * row as f32;
                let sway = if row % 2 == 0 { 9.0 } else { -9.0 };
                let (x, z) = (x + sway + 11.0 * random(), z + 13.0 * random());
                let before = cavity.front(z, x) - 16.5;
                let y = if (layer == 0) == (c % 2 == 0) {
                    before
                } else {
                    before - 26.0
                };
                knots.push(([x, y + 2.0 * random(), z], 12.2 + random()));
            }
        }
    }
    knots.push(([66.0, 22.0, -246.0], 11.0));
    knots.push(([80.0, 20.0, -242.0], 10.0));
    knots
}

/// A tube through the knots, less `inset` mm.
pub(super) fn tube(knots: &[Knot], inset: f32) -> Field {
    let mut f = Field::default();
    let inner: Vec<Knot> = knots.iter().map(|&(p, r)| (p, r - inset)).collect();
    f.join_all(0.0, curve(&inner));
    f
}

/// Vessels of the belly: arteries, veins, and the vein of the liver with its branches.
pub(super) fn vessels(revision: Revision) -> (Field, Field) {
    let (mut arteries, mut veins) = (Field::default(), Field::default());
    let red = |f: &mut Field, knots: &[Knot]| f.join_all(1.5, curve(knots));
    // Trunk to liver, spleen, stomach.
    red(
        &mut arteries,
        &[
            ([-4.0, -12.0, -92.0], 4.2),
            ([0.0, 6.0, -92.0], 4.0),
            ([16.0, 12.0, -88.0], 3.2),
            ([26.0, 8.0, -66.0], 3.0),
        ],
    );
    red(
        &mut arteries,
        &[
            ([0.0, 6.0, -92.0], 3.6),
            ([-24.0, 0.0, -92.0], 3.4),
            ([-54.0, -24.0, -82.0], 3.2),
            ([-82.0, -40.0, -64.0], 3.0),
        ],
    );
    // To the bowel.
    red(
        &mut arteries,
        &[
            ([-3.0, -8.0, -106.0], 4.4),
            ([0.0, 14.0, -130.0], 4.2),
            ([2.0, 20.0, -180.0], 3.4),
            ([22.0, 22.0, -226.0], 2.4),
        ],
    );
    for z in [-176.0f32, -196.0, -214.0] {
        red(
            &mut arteries,
            &[
                ([2.0, 18.0, z + 20.0], 2.4),
                ([-24.0, 22.0, z], 1.9),
                ([-54.0, 30.0, z - 12.0], 1.5),
            ],
        );
    }
    red(
        &mut arteries,
        &[
            ([-4.0, 8.0, -170.0], 2.8),
            ([-26.0, 10.0, -196.0], 2.4),
            ([-60.0, 4.0, -226.0], 2.0),
        ],
    );
    // To the kidneys.
    red(
        &mut arteries,
        &[
            ([-8.0, -8.0, -114.0], 3.8),
            ([-28.0, -28.0, -114.0], 3.4),
            ([-44.0, -38.0, -112.0], 3.0),
        ],
    );
    // Whole, it runs before the spine.
    let before_spine = match revision {
        Revision::First => None,
        Revision::Second => Some(([16.0, -11.0, -120.0], 3.6)),
    };
    let right: Vec<Knot> = [([0.0, -10.0, -116.0], 3.8)]
        .into_iter()
        .chain(before_spine)
        .chain([([26.0, -28.0, -124.0], 3.4), ([44.0, -36.0, -126.0], 3.0)])
        .collect();
    red(&mut arteries, &right);
    let blue = |f: &mut Field, knots: &[Knot]| f.join_all(1.5, curve(knots));
    blue(
        &mut veins,
        &[
            ([18.0, -8.0, -112.0], 4.6),
            ([-6.0, 4.0, -112.0], 4.4),
            ([-30.0, -24.0, -108.0], 4.4),
            ([-46.0, -36.0, -110.0], 3.8),
        ],
    );
    blue(
        &mut veins,
        &[([26.0, -8.0, -120.0], 4.4), ([44.0, -34.0, -128.0], 3.8)],
    );
    // Portal vein and what it gathers.
    blue(
        &mut veins,
        &[
            ([10.0, 20.0, -182.0], 4.6),
            ([12.0, 14.0, -128.0], 5.4),
            ([16.0, 4.0, -104.0], 6.4),
            ([26.0, 2.0, -70.0], 6.4),
            ([40.0, -2.0, -54.0], 5.4),
            ([70.0, -8.0, -42.0], 4.0),
            ([96.0, -12.0, -44.0], 2.6),
        ],
    );
    blue(
        &mut veins,
        &[
            ([34.0, 0.0, -60.0], 5.0),
            ([8.0, 22.0, -36.0], 4.0),
            ([-16.0, 34.0, -22.0], 2.8),
        ],
    );
    blue(
        &mut veins,
        &[
            ([16.0, 4.0, -108.0], 4.8),
            ([-20.0, 0.0, -100.0], 4.4),
            ([-56.0, -26.0, -90.0], 4.2),
            ([-84.0, -40.0, -66.0], 3.6),
        ],
    );
    blue(
        &mut veins,
        &[
            ([48.0, -4.0, -52.0], 4.0),
            ([64.0, 24.0, -34.0], 3.2),
            ([86.0, 40.0, -44.0], 2.4),
        ],
    );
    blue(
        &mut veins,
        &[
            ([60.0, -6.0, -46.0], 3.6),
            ([78.0, -36.0, -30.0], 2.8),
            ([96.0, -44.0, -10.0], 2.2),
        ],
    );
    // Liver veins run to the great vein just under the diaphragm.
    for knots in [
        [
            ([26.0, -12.0, 2.0], 5.0),
            ([52.0, -14.0, -6.0], 4.6),
            ([86.0, -20.0, -24.0], 3.2),
        ],
        [
            ([26.0, -8.0, 2.0], 5.0),
            ([44.0, 22.0, -4.0], 4.4),
            ([58.0, 50.0, -24.0], 3.0),
        ],
        [
            ([24.0, -8.0, 0.0], 4.6),
            ([8.0, 14.0, -2.0], 4.0),
            ([-16.0, 32.0, -8.0], 2.8),
        ],
    ] {
        blue(&mut veins, &knots);
    }
    (arteries, veins)
}
