//! The head's soft parts: muscles, tongue, glands, air passages, vessels and nerves.
//!
//! Coordinates as in [`super::head_skin`].

use super::lanes::{Lanes, Points};
use super::paint::Revision;
use super::shape::{
    Field, Knot, Shape, along_curve, at, ball, both, capsule, chain, cuboid, curve, ellipsoid,
    strap,
};

/// The fan of the temporal muscle.
fn temporal() -> Shape {
    ellipsoid([59.0, 20.0, 38.0], [14.0, 46.0, 42.0]).turned(0.0, -6.0, 0.0)
}

/// The hollow of the skull that holds the fan.
pub(super) fn temples() -> Field {
    let mut f = Field::default();
    f.join(0.0, temporal().both());
    f
}

/// Muscles that have a body of their own.
pub(super) fn muscles() -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        both(vec![
            temporal(),
            strap(
                [59.0, 30.0, 14.0],
                [48.5, 36.0, -12.0],
                20.0,
                8.0,
                [1.0, 0.0, 0.3],
                0.5,
            ),
        ]),
    );
    let mut add = |shape: Shape| f.join(0.0, shape.both());
    // Of chewing: temporal fan and tendon, masseter, the two pterygoids.

    add(strap(
        [57.5, 42.0, -10.0],
        [53.5, 22.0, -60.0],
        15.5,
        15.0,
        [1.0, 0.3, 0.0],
        0.42,
    ));
    add(strap(
        [24.0, 40.0, -4.0],
        [47.0, 14.0, -10.0],
        8.0,
        6.0,
        [0.0, 0.0, 1.0],
        1.0,
    ));
    add(strap(
        [18.0, 38.0, -14.0],
        [42.0, 20.0, -56.0],
        10.0,
        9.0,
        [1.0, 0.3, 0.5],
        0.6,
    ));
    // Cheek.
    add(strap(
        [31.0, 70.0, -44.0],
        [40.0, 42.0, -46.0],
        12.0,
        12.0,
        [0.9, 0.4, 0.0],
        0.18,
    ));
    // Neck: sternocleidomastoid, back of the neck, scalenes, before the spine.
    add(strap(
        [60.0, -17.0, -24.0],
        [15.0, 32.0, -185.0],
        12.5,
        12.0,
        [0.8, 0.6, 0.0],
        0.5,
    ));
    add(strap(
        [50.0, -46.0, -6.0],
        [44.0, -46.0, -185.0],
        9.0,
        16.0,
        [0.8, -0.6, 0.0],
        0.45,
    ));
    add(capsule(
        [12.0, -64.0, -10.0],
        [13.0, -60.0, -185.0],
        11.0,
        12.0,
    ));
    add(capsule(
        [32.0, -55.0, -8.0],
        [24.0, -62.0, -185.0],
        9.5,
        9.0,
    ));
    add(strap(
        [24.0, -76.0, -4.0],
        [34.0, -70.0, -185.0],
        20.0,
        34.0,
        [0.45, -0.9, 0.0],
        0.17,
    ));
    add(capsule(
        [14.0, -38.0, -30.0],
        [20.0, -40.0, -60.0],
        8.0,
        7.0,
    ));
    add(capsule(
        [33.0, -24.0, -44.0],
        [40.0, -30.0, -185.0],
        6.5,
        11.0,
    ));
    add(capsule([28.0, -8.0, -70.0], [34.0, -6.0, -185.0], 5.0, 9.0));
    add(strap(
        [8.0, 1.0, -34.0],
        [9.0, -8.0, -185.0],
        6.5,
        7.0,
        [0.0, 1.0, 0.0],
        0.6,
    ));
    // Floor of the mouth, muscles of the tongue bone.
    add(capsule([5.5, 79.0, -92.0], [11.0, 38.0, -98.0], 4.6, 3.8));
    add(capsule([12.0, 38.0, -98.0], [54.0, -10.0, -34.0], 3.0, 4.5));
    add(strap(
        [3.0, 72.0, -83.0],
        [14.0, 34.0, -92.0],
        15.0,
        18.0,
        [0.1, 0.0, 1.0],
        0.2,
    ));
    add(strap(
        [5.0, 34.0, -102.0],
        [7.0, 22.0, -185.0],
        7.0,
        8.0,
        [0.1, 1.0, 0.0],
        0.4,
    ));
    add(strap(
        [14.0, 30.0, -104.0],
        [20.0, 16.0, -185.0],
        6.0,
        8.0,
        [0.8, 0.6, 0.0],
        0.4,
    ));
    // Of the eye.
    let [x, y, z] = super::head_skin::EYE;
    for (dx, dz) in [(0.0, 11.4), (0.0, -11.4), (11.4, 0.0), (-11.4, 0.0)] {
        let normal = [dx, 0.0, dz];
        let (mx, mz) = (x + dx * 0.92, z + dz * 0.92);
        let back = [15.5 + dx * 0.2, 40.0, 19.0 + dz * 0.2];
        let front = [x + dx * 1.02, y + 3.0, z + dz * 1.02];
        f.join_all(
            0.0,
            both(vec![
                strap(back, [mx, y - 8.0, mz], 3.4, 4.6, normal, 0.42),
                strap([mx, y - 8.0, mz], front, 4.6, 4.4, normal, 0.3),
            ]),
        );
    }
    f
}

/// Flat muscles under the skin of face and scalp: where they run, whatever their depth.
pub(super) fn facial_muscles() -> Field {
    let mut f = Field::default();
    // About the eye, about the mouth.
    let eye: [Knot; 9] = [
        ([13.0, 90.0, 16.0], 5.0),
        ([20.0, 92.0, 29.0], 6.5),
        ([33.0, 89.0, 34.0], 7.0),
        ([47.0, 77.0, 29.0], 7.0),
        ([53.0, 68.0, 15.0], 7.0),
        ([47.0, 75.0, 1.0], 7.0),
        ([33.0, 83.0, -4.0], 6.5),
        ([20.0, 88.0, 2.0], 5.5),
        ([13.0, 90.0, 14.0], 5.0),
    ];
    f.join_all(0.0, both(curve(&eye)));
    f.join(
        0.0,
        strap(
            [15.0, 84.0, 16.0],
            [49.0, 76.0, 16.0],
            14.0,
            14.0,
            [0.0, 1.0, 0.0],
            1.0,
        )
        .both(),
    );
    let mouth: [Knot; 5] = [
        ([0.0, 101.0, -41.5], 7.0),
        ([15.0, 97.0, -43.0], 7.5),
        ([29.0, 85.0, -53.0], 7.5),
        ([16.0, 94.0, -63.0], 7.0),
        ([0.0, 98.0, -64.5], 7.0),
    ];
    f.join_all(0.0, both(curve(&mouth)));
    let mut band = |from: [f32; 3], to: [f32; 3], r0: f32, r1: f32| {
        f.join(0.0, capsule(from, to, r0, r1).both());
    };
    // Forehead, nose, lifters of the lip, smile, lower lip, chin, neck's platysma at the jaw.
    band([16.0, 94.0, 40.0], [24.0, 84.0, 76.0], 14.0, 19.0);
    band([36.0, 86.0, 42.0], [30.0, 82.0, 70.0], 9.0, 12.0);
    band([24.0, 84.0, 76.0], [26.0, 72.0, 92.0], 19.0, 13.0);
    band([7.0, 94.0, 18.0], [4.5, 100.0, 34.0], 4.0, 5.0);
    band([9.0, 98.0, -2.0], [15.0, 98.0, -16.0], 4.5, 5.0);
    band([14.0, 92.0, 4.0], [19.0, 94.0, -36.0], 3.5, 4.5);
    band([27.0, 84.0, -8.0], [23.0, 92.0, -40.0], 4.5, 4.5);
    band([41.0, 72.0, -10.0], [27.0, 89.0, -45.0], 3.6, 3.8);
    band([51.0, 61.0, -12.0], [30.0, 86.0, -49.0], 4.2, 4.2);
    band([56.0, 38.0, -42.0], [32.0, 82.0, -52.0], 6.0, 3.6);
    band([31.0, 84.0, -57.0], [27.0, 80.0, -86.0], 4.0, 7.0);
    band([17.0, 94.0, -66.0], [20.0, 88.0, -86.0], 5.5, 6.5);
    band([5.0, 97.0, -73.0], [6.0, 96.0, -88.0], 5.0, 6.0);
    // Back of the scalp.
    band([13.0, -91.0, 17.0], [33.0, -83.0, 19.0], 10.0, 9.0);
    band([21.0, -90.0, 20.0], [23.0, -89.0, 45.0], 13.0, 9.0);
    f
}

/// Shape of the tongue.
pub(super) fn tongue() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([0.0, 64.0, -52.5], [20.5, 25.0, 13.0]));
    f.join(12.0, ellipsoid([0.0, 42.0, -62.0], [17.5, 18.0, 24.0]));
    f.join(8.0, ellipsoid([0.0, 56.0, -72.0], [11.0, 22.0, 15.0]));
    f.raise(
        -1.8,
        capsule([0.0, 88.0, -41.0], [0.0, 52.0, -39.0], 4.0, 4.0),
    );
    f
}

/// Shape of the glands together.
pub(super) fn glands() -> Field {
    let mut f = Field::default();
    // Parotid, submandibular, sublingual, lacrimal, thyroid, pituitary.
    f.join(
        0.0,
        ellipsoid([59.0, 12.0, -36.0], [8.0, 12.0, 23.0]).both(),
    );
    f.join(3.0, ellipsoid([54.0, 2.0, -42.0], [8.0, 9.0, 18.0]).both());
    f.join(
        0.0,
        ellipsoid([30.0, 36.0, -84.0], [9.0, 16.0, 10.0]).both(),
    );
    f.join(0.0, ellipsoid([14.0, 70.0, -72.0], [4.5, 14.0, 5.5]).both());
    f.join(
        0.0,
        ellipsoid([44.0, 72.0, 28.0], [6.0, 7.0, 3.0])
            .turned(0.0, 40.0, 0.0)
            .both(),
    );
    f.join(
        0.0,
        ellipsoid([16.0, 16.0, -142.0], [7.0, 9.0, 18.0]).both(),
    );
    f.join(0.0, ellipsoid([0.0, 17.5, 18.5], [6.0, 5.0, 4.0]));
    f
}

/// Air from the nostrils to the windpipe.
pub(super) fn airway() -> Field {
    let mut f = Field::default();
    // Nasal cavity, with the septum and the turbinates left standing.
    f.join(0.0, ellipsoid([0.0, 70.0, -14.0], [14.5, 31.0, 15.5]));
    f.join(5.0, ellipsoid([0.0, 68.0, 4.0], [7.5, 24.0, 15.0]));
    f.join(
        4.0,
        capsule([7.0, 104.0, -27.0], [6.0, 92.0, -17.0], 3.6, 6.0).both(),
    );
    // Its way back to the throat.
    f.join(
        6.0,
        capsule([6.5, 48.0, -18.0], [5.0, 30.0, -14.0], 8.5, 8.5).both(),
    );
    f.carve(
        0.8,
        strap(
            [0.0, 96.0, -12.0],
            [0.0, 50.0, -8.0],
            26.0,
            26.0,
            [1.0, 0.0, 0.0],
            0.055,
        ),
    );
    let lower: [Knot; 3] = [
        ([9.5, 86.0, -22.0], 2.8),
        ([9.0, 66.0, -21.0], 4.6),
        ([8.0, 46.0, -20.0], 3.0),
    ];
    f.carve_all(0.8, both(curve(&lower)));
    f.carve(
        0.8,
        strap(
            [12.5, 84.0, -16.0],
            [12.5, 48.0, -14.0],
            5.0,
            5.0,
            [0.6, 0.0, 1.0],
            0.35,
        )
        .both(),
    );
    let middle: [Knot; 3] = [
        ([6.0, 80.0, -5.0], 1.8),
        ([6.2, 64.0, -5.0], 3.2),
        ([6.0, 48.0, -5.0], 2.0),
    ];
    f.carve_all(0.8, both(curve(&middle)));
    f.carve(
        0.8,
        strap(
            [8.5, 80.0, 0.0],
            [8.5, 48.0, 0.0],
            3.5,
            3.5,
            [0.8, 0.0, 1.0],
            0.4,
        )
        .both(),
    );
    f.carve(
        0.6,
        capsule([4.4, 58.0, 8.0], [4.4, 46.0, 6.0], 1.6, 1.6).both(),
    );
    // Throat.
    let throat: [Knot; 6] = [
        ([0.0, 25.0, -14.0], 9.0),
        ([0.0, 20.0, -30.0], 8.5),
        ([0.0, 17.0, -50.0], 6.5),
        ([0.0, 16.0, -78.0], 8.0),
        ([0.0, 16.0, -98.0], 8.0),
        ([0.0, 21.0, -113.0], 5.5),
    ];
    f.join_all(5.0, curve(&throat));
    f.join(
        3.0,
        strap(
            [0.0, 20.5, -112.0],
            [0.0, 21.0, -123.0],
            6.5,
            6.0,
            [1.0, 0.0, 0.0],
            0.5,
        ),
    );
    f.join(
        3.0,
        capsule([0.0, 19.0, -130.0], [0.0, 12.0, -185.0], 7.5, 8.0),
    );
    // Epiglottis and uvula stand in it.
    f.carve(
        0.8,
        strap(
            [0.0, 26.0, -104.0],
            [0.0, 20.0, -86.0],
            7.0,
            5.0,
            [0.0, 1.0, 0.3],
            0.2,
        ),
    );
    f.carve(
        1.0,
        capsule([0.0, 40.0, -28.0], [0.0, 20.5, -45.0], 6.0, 3.0),
    );
    // A little air over the tongue and before the teeth.
    f.join(
        0.0,
        strap(
            [0.0, 80.0, -39.6],
            [0.0, 52.0, -38.2],
            15.0,
            15.0,
            [0.0, 0.0, 1.0],
            0.1,
        ),
    );
    // Ear canal.
    f.join(
        0.0,
        capsule([72.0, -13.0, -3.5], [60.0, -6.0, -3.0], 3.3, 3.2).both(),
    );
    f.join(
        0.0,
        capsule([62.0, -3.5, -3.0], [46.0, 1.0, -2.0], 3.2, 3.0).both(),
    );
    f.join(1.0, ellipsoid([41.0, 2.0, -1.0], [4.0, 5.0, 6.0]).both());
    f
}

/// Vessels that would run in the bone of the vault are moved to its inner or outer side, whichever is nearer; those
/// under the scalp lie at an even depth.
fn fitted(knots: &[Knot], skin: &Field, cavity: &Field, revision: Revision) -> Vec<Knot> {
    knots
        .iter()
        .map(|&(p, r)| {
            let inside = cavity.at(p);
            // Branches on the brain sank into it in the first revision.
            let (deep, under) = match revision {
                Revision::Second if p[2] > BASE_MM => (9.0, r + 1.0),
                _ => (r + 0.8, r + 0.6),
            };
            let pulled = if p[2] < 4.0 || inside < -deep {
                p
            } else if inside < 5.0 {
                cavity.pull(p, -under)
            } else if p[2] < 25.0 {
                p
            } else {
                skin.pull(p, -(r + 2.6).min(4.4))
            };
            (pulled, r)
        })
        .collect()
}

/// Vessels pass the bones of the skull's base, which ends at this height, mm.
pub(super) const BASE_MM: f32 = 44.0;

/// Where a knot of a vessel lies.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    /// Under the vault, by its inner side.
    Inner,
    /// Under the scalp.
    Scalp,
    /// Deep in the brain, in the face or in the neck.
    Elsewhere,
}

/// Where a place comes to that is led along a field's slope until it lies so deep, mm.
fn led(field: &Field, p: [f32; 3], depth: f32) -> [f32; 3] {
    let there = field.pull(p, -depth);
    // About the base of the skull the slope leads astray.
    if at(p).distance(at(there)) < 16.0 {
        there
    } else {
        p
    }
}

/// A place, at least so deep under the skin, mm.
fn covered(skin: &Field, p: [f32; 3], depth: f32) -> [f32; 3] {
    if skin.at(p) > -depth {
        led(skin, p, depth)
    } else {
        p
    }
}

/// The capsules of a vessel, on one side of the head. In the second revision it keeps its depth under the vault or
/// under the scalp between its knots too: where it dived into the bone or the brain, it was cut.
fn vessel(knots: &[Knot], skin: &Field, cavity: &Field, revision: Revision) -> Vec<Shape> {
    let fitted = fitted(knots, skin, cavity, revision);
    if revision == Revision::First {
        return curve(&fitted);
    }
    let side = |&(p, r): &Knot| {
        let inside = cavity.at(p);
        if p[2] < 25.0 || inside < -(r + 1.6) {
            Side::Elsewhere
        } else if inside < 0.0 {
            Side::Inner
        } else {
            Side::Scalp
        }
    };
    let sides: Vec<Side> = fitted.iter().map(side).collect();
    let pieces = along_curve(&fitted);
    let in_span = (pieces.len() - 1) / (fitted.len() - 1);
    let points: Vec<Knot> = pieces
        .into_iter()
        .enumerate()
        .map(|(i, (p, r))| {
            let place = match [sides[i / in_span], sides[i.div_ceil(in_span)]] {
                [Side::Scalp, Side::Scalp] => led(skin, p, (r + 2.8).min(4.6)),
                [Side::Inner, Side::Inner] => led(cavity, p, r + 1.0),
                [Side::Scalp, _] | [_, Side::Scalp] => covered(skin, p, r + 2.8),
                _ if p[2] > BASE_MM && cavity.at(p) > -(r + 1.0) => led(cavity, p, r + 1.0),
                _ => covered(skin, p, r + 3.6),
            };
            (place, r)
        })
        .collect();
    chain(&points)
}

/// Signed distance to the superior sagittal sinus, mm, from that to the cavity: it runs under the vault in the middle,
/// wider towards the back.
pub(super) fn sagittal_sinus(p: &Points, cavity: Lanes) -> Lanes {
    let radius = (p.y * -0.02 + 3.6).clamp(2.0, 5.2);
    let (x, under) = (p.x, cavity + radius * 0.75);
    let tube = (x * x + under * under).sqrt() - radius;
    // From the crista galli to the confluence.
    let behind = (Lanes::splat(24.0) - p.z).max((p.y + 40.0).min(Lanes::splat(46.0) - p.z));
    tube.max(behind)
}

/// Arteries outside the skull, and inside it.
pub(super) fn arteries(skin: &Field, cavity: &Field, revision: Revision) -> Field {
    let mut f = Field::default();
    let mut tube = |knots: &[Knot]| {
        f.join_all(0.0, both(vessel(knots, skin, cavity, revision)));
    };
    // Common carotid, internal carotid with its siphon, middle and anterior cerebral arteries.
    tube(&[
        ([21.0, 6.0, -190.0], 3.6),
        ([23.0, 8.0, -130.0], 3.6),
        ([25.0, 9.0, -104.0], 4.4),
        ([28.0, 2.0, -84.0], 3.0),
        ([27.0, 1.0, -50.0], 2.6),
        ([26.0, 4.0, -16.0], 2.6),
        ([25.0, 6.0, 2.0], 2.5),
        ([14.0, 12.0, 6.0], 2.4),
        ([12.0, 22.0, 14.0], 2.3),
        ([12.0, 26.0, 21.0], 2.2),
        ([13.0, 18.0, 25.0], 2.1),
    ]);
    tube(&[
        ([13.0, 18.0, 25.0], 2.0),
        ([26.0, 20.0, 26.0], 1.8),
        ([42.0, 19.0, 27.0], 1.7),
        ([52.0, 8.0, 31.0], 1.5),
        ([55.0, -10.0, 37.0], 1.4),
        ([57.0, -32.0, 50.0], 1.2),
        ([50.0, -52.0, 70.0], 1.0),
    ]);
    tube(&[
        ([52.0, 8.0, 31.0], 1.4),
        ([58.5, 22.0, 46.0], 1.2),
        ([54.0, 32.0, 68.0], 1.0),
        ([44.0, 30.0, 92.0], 0.9),
    ]);
    tube(&[
        ([55.0, -10.0, 37.0], 1.3),
        ([62.0, -8.0, 58.0], 1.1),
        ([57.0, -16.0, 82.0], 0.9),
    ]);
    tube(&[
        ([13.0, 18.0, 25.0], 1.8),
        ([2.5, 28.0, 28.0], 1.7),
        ([2.2, 45.0, 40.0], 1.5),
        ([2.2, 46.0, 56.0], 1.5),
        ([2.2, 34.0, 70.0], 1.4),
        ([2.2, 8.0, 76.0], 1.2),
        ([2.2, -22.0, 78.0], 1.0),
    ]);
    // Posterior communicating and posterior cerebral arteries.
    tube(&[
        ([13.0, 17.0, 24.0], 1.2),
        ([8.0, 4.0, 24.0], 1.3),
        ([16.0, -8.0, 26.0], 1.5),
        ([18.0, -24.0, 28.0], 1.4),
        ([12.0, -48.0, 32.0], 1.2),
        ([6.0, -70.0, 34.0], 1.0),
    ]);
    tube(&[([0.0, 4.5, 22.0], 1.9), ([8.0, 4.0, 24.0], 1.5)]);
    // Vertebral artery through the side processes, over the atlas, into the skull.
    tube(&[
        ([18.5, -18.0, -150.0], 2.0),
        ([18.0, -12.0, -94.0], 2.0),
        ([17.5, -12.0, -62.0], 2.0),
        ([28.0, -14.0, -44.0], 2.0),
        ([22.0, -25.0, -36.0], 2.0),
        ([9.0, -17.0, -27.0], 2.0),
        ([0.0, -2.5, -12.0], 2.0),
    ]);
    tube(&[
        ([0.0, -2.5, -12.0], 2.1),
        ([0.0, 7.0, 6.0], 2.0),
        ([0.0, 4.5, 22.0], 1.9),
    ]);
    // Outer carotid: superficial temporal with two branches, facial, occipital.
    tube(&[
        ([25.0, 11.0, -102.0], 3.0),
        ([34.0, 14.0, -78.0], 2.6),
        ([48.0, 8.0, -48.0], 2.3),
        ([56.0, 5.0, -22.0], 2.1),
        ([68.5, 6.0, 2.0], 1.9),
        ([74.0, 4.0, 28.0], 1.8),
    ]);
    tube(&[
        ([74.0, 4.0, 28.0], 1.6),
        ([72.5, 26.0, 46.0], 1.4),
        ([65.0, 48.0, 58.0], 1.3),
        ([54.0, 60.0, 78.0], 1.1),
        ([44.0, 58.0, 96.0], 1.0),
    ]);
    tube(&[
        ([74.0, 4.0, 28.0], 1.6),
        ([75.0, -6.0, 52.0], 1.4),
        ([71.0, -16.0, 76.0], 1.3),
        ([58.0, -22.0, 102.0], 1.1),
    ]);
    // Branches begin in the middle of the outer carotid.
    let branch = |joint: Knot, knots: &[Knot]| match revision {
        Revision::First => knots.to_vec(),
        Revision::Second => [&[joint], knots].concat(),
    };
    let facial: [Knot; 8] = [
        ([32.0, 18.0, -88.0], 2.0),
        ([42.0, 34.0, -82.0], 1.9),
        ([47.0, 42.0, -74.0], 1.8),
        ([40.0, 62.0, -62.0], 1.7),
        ([31.0, 82.0, -50.0], 1.6),
        ([21.5, 91.0, -26.0], 1.4),
        ([13.0, 91.0, 4.0], 1.2),
        ([13.0, 88.0, 18.0], 1.0),
    ];
    tube(&branch(([29.0, 13.0, -91.0], 2.0), &facial));
    let occipital: [Knot; 6] = [
        ([34.0, 8.0, -76.0], 1.8),
        ([48.0, -16.0, -34.0], 1.7),
        ([52.0, -52.0, -10.0], 1.5),
        ([40.0, -78.0, 12.0], 1.4),
        ([30.0, -90.0, 36.0], 1.2),
        ([26.0, -88.0, 62.0], 1.0),
    ];
    tube(&branch(([34.0, 14.0, -78.0], 1.8), &occipital));
    f
}

/// Veins and the sinuses of the dura.
pub(super) fn veins(skin: &Field, cavity: &Field, revision: Revision) -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([0.0, -78.0, 24.0], 3.8),
            ([0.0, -52.0, 32.0], 3.0),
            ([0.0, -32.0, 42.0], 2.6),
        ]),
    );
    let mut tube = |knots: &[Knot]| {
        f.join_all(0.0, both(vessel(knots, skin, cavity, revision)));
    };
    // Transverse and sigmoid sinus into the internal jugular vein.
    tube(&[
        ([0.0, -81.0, 22.0], 4.4),
        ([24.0, -75.0, 18.0], 4.2),
        ([46.0, -54.0, 14.0], 4.2),
        ([52.0, -34.0, 6.0], 4.2),
        ([44.0, -20.0, -8.0], 4.0),
        ([30.0, -10.0, -17.0], 4.4),
        ([31.0, -4.0, -40.0], 4.6),
        ([33.0, 2.0, -80.0], 5.2),
        ([32.0, 6.0, -120.0], 5.6),
        ([29.0, 2.0, -190.0], 6.0),
    ]);
    // Bridging veins of the brain's surface.
    for (y, z) in [(52.0, 98.0), (22.0, 112.0), (-14.0, 114.0), (-44.0, 104.0)] {
        tube(&[
            ([1.0, y - 4.0, z + 1.0], 1.7),
            ([18.0, y, z - 2.0], 1.5),
            ([36.0, y + 4.0, z - 14.0], 1.2),
            ([48.0, y + 3.0, z - 30.0], 1.0),
        ]);
    }
    // Outer jugular and retromandibular, facial vein.
    tube(&[
        ([55.0, 2.0, -14.0], 2.0),
        ([53.0, 0.0, -46.0], 2.3),
        ([56.0, -4.0, -70.0], 2.4),
        ([55.0, 0.0, -110.0], 2.4),
        ([50.0, 8.0, -190.0], 2.5),
    ]);
    // The facial vein crosses the lower jaw behind the artery and opens into the inner jugular.
    let [over_jaw, end]: [Knot; 2] = match revision {
        Revision::First => [([48.0, 38.0, -76.0], 1.9), ([38.0, 14.0, -88.0], 2.2)],
        Revision::Second => [([46.0, 30.0, -68.0], 1.9), ([36.0, 3.0, -81.0], 2.2)],
    };
    tube(&[
        ([14.5, 87.0, 17.0], 1.2),
        ([24.0, 86.0, -20.0], 1.5),
        ([38.0, 72.0, -48.0], 1.7),
        over_jaw,
        end,
    ]);
    f
}

/// Nerves: optic nerve, crossing and tract, trigeminal, facial.
pub(super) fn nerves(skin: &Field, revision: Revision) -> Field {
    let mut f = Field::default();
    let mut tube = |knots: &[Knot]| {
        let mut path = along_curve(knots);
        if revision == Revision::Second {
            for (p, r) in &mut path {
                *p = covered(skin, *p, *r + 4.2);
            }
        }
        f.join_all(0.0, both(chain(&path)));
    };
    tube(&[
        ([29.5, 60.5, 16.4], 2.6),
        ([24.0, 50.0, 17.0], 2.4),
        ([15.0, 38.0, 19.5], 2.4),
        ([9.0, 25.0, 23.0], 2.4),
        ([0.0, 15.5, 26.0], 2.8),
    ]);
    tube(&[
        ([0.0, 15.5, 26.0], 2.6),
        ([10.0, 4.0, 28.0], 2.2),
        ([17.0, -10.0, 32.0], 2.0),
    ]);
    tube(&[
        ([13.0, 4.0, 8.0], 2.4),
        ([20.0, 12.0, 8.0], 2.6),
        ([25.0, 18.0, 2.0], 2.2),
        ([25.0, 19.0, -14.0], 2.0),
        ([33.0, 26.0, -44.0], 1.8),
    ]);
    // The facial nerve, on the inner side of the vein behind the jaw.
    let facial: [Knot; 5] = [
        ([52.0, -4.0, -18.0], 1.6),
        ([49.0, 3.0, -22.0], 1.5),
        ([58.0, 12.0, -28.0], 1.4),
        ([58.0, 32.0, -26.0], 1.2),
        ([48.0, 56.0, -22.0], 1.0),
    ];
    match revision {
        Revision::First => tube(&[facial[0], facial[2], facial[3], facial[4]]),
        Revision::Second => tube(&facial),
    }
    // Olfactory tract.
    tube(&[
        ([6.0, 68.0, 31.5], 2.0),
        ([7.0, 50.0, 31.5], 1.4),
        ([9.0, 26.0, 30.0], 1.3),
    ]);
    f
}

/// Inner parts of the eyes that differ from the vitreous: lens, iris ring, pupil, as (shape, which).
pub(super) fn cornea() -> Field {
    let mut f = Field::default();
    let [x, y, z] = super::head_skin::EYE;
    f.join(0.0, ball([x, y, z], super::head_skin::EYE_RADIUS).both());
    f.join(1.0, ball([x, y + 5.2, z], 7.9).both());
    f
}

/// Lens of the eye.
pub(super) fn lens() -> Field {
    let mut f = Field::default();
    let [x, y, z] = super::head_skin::EYE;
    f.join(0.0, ellipsoid([x, y + 6.2, z], [4.8, 2.2, 4.8]).both());
    f
}

/// A cylinder through the iris, along y.
pub(super) fn iris(radius: f32) -> Field {
    let mut f = Field::default();
    let [x, y, z] = super::head_skin::EYE;
    f.join(
        0.0,
        capsule([x, y + 8.0, z], [x, y + 40.0, z], radius, radius).both(),
    );
    f
}

/// The gullet, closed, behind the windpipe.
pub(super) fn gullet() -> Shape {
    cuboid([0.0, 1.0, -152.0], [9.0, 3.0, 24.0], 2.5)
}
