//! The head's outer surface, sculpted: braincase, face, nose, eyes, mouth, ears, neck.
//!
//! Millimetres about the middle between the ear canals, Frankfurt plane level: x right, y anterior, z up. Landmarks
//! kept: vertex z 130, glabella y 97, pupils z 16 and x ±31.5, tip of the nose y 119, mouth z −52, chin z −98, gonion x
//! ±52.

use glam::{Mat3, Vec3};

use super::shape::{Field, Knot, Shape, ball, both, capsule, curve, ellipsoid, strap};

/// Middle of the right eyeball.
pub(super) const EYE: [f32; 3] = [31.5, 72.0, 16.0];
/// Radius of the eyeball.
pub(super) const EYE_RADIUS: f32 = 12.0;

/// Frame of the right ear: columns are backwards, upwards and outwards along the auricle.
fn ear_frame() -> Mat3 {
    let out = Vec3::new(0.88, 0.44, 0.06);
    let out = out / out.length();
    // The auricle leans back by about 14 degrees.
    let up = Vec3::new(0.06, -0.24, 0.96);
    let up = up - out * up.dot(out);
    let up = up / up.length();
    Mat3::from_cols(up.cross(out) * -1.0, up, out)
}

/// Middle of the right auricle.
const EAR: Vec3 = Vec3::new(76.5, -14.0, -1.0);

/// From ear coordinates (backwards, upwards, outwards) to the head's.
fn ear(p: [f32; 3]) -> [f32; 3] {
    (EAR + ear_frame() * Vec3::from_array(p)).to_array()
}

/// The whole outer surface without the openings of the lids (see [`palpebral_fissure`]).
pub(super) fn skin() -> Field {
    let mut f = Field::default();
    braincase(&mut f);
    face(&mut f);
    neck(&mut f);
    nose(&mut f);
    eyes(&mut f);
    mouth(&mut f);
    ears(&mut f);
    f
}

fn braincase(f: &mut Field) {
    f.join(0.0, ellipsoid([0.0, -4.0, 48.0], [75.5, 91.0, 82.0]));
    f.join(22.0, ellipsoid([0.0, 38.0, 58.0], [61.0, 55.0, 56.0]));
    f.join(22.0, ellipsoid([0.0, -46.0, 26.0], [57.0, 49.0, 50.0]));
    f.join(
        20.0,
        ellipsoid([42.0, -38.0, -8.0], [21.0, 33.0, 34.0]).both(),
    );
}

fn face(f: &mut Field) {
    // Upper face between the temples, down to the mouth.
    f.join(14.0, ellipsoid([0.0, 32.0, -8.0], [64.5, 56.0, 62.0]));
    // Muzzle over the teeth.
    f.join(20.0, ellipsoid([0.0, 60.0, -44.0], [33.0, 39.5, 32.0]));
    // Jaw from the angle to the chin, and the floor between.
    f.join(
        20.0,
        capsule([43.0, 14.0, -50.0], [14.0, 76.0, -82.0], 11.5, 13.5).both(),
    );
    f.join(16.0, ellipsoid([0.0, 46.0, -62.0], [44.0, 41.0, 30.0]));
    f.join(14.0, ellipsoid([0.0, 83.0, -83.0], [19.0, 14.5, 15.0]));
    // Cheek pads and cheekbones.
    f.join(22.0, ball([34.0, 60.0, -32.0], 20.0).both());
    f.raise(
        4.2,
        ellipsoid([49.0, 62.0, -4.0], [30.0, 28.0, 24.0]).both(),
    );
    f.raise(
        2.0,
        ellipsoid([62.0, 34.0, -6.0], [18.0, 34.0, 15.0]).both(),
    );
    // Before the ear.
    f.join(
        16.0,
        ellipsoid([51.0, 6.0, -14.0], [17.0, 27.0, 32.0]).both(),
    );
    // Temple, hollow of the cheek, fullness of the masseter.
    f.raise(
        -3.2,
        ellipsoid([66.0, 50.0, 32.0], [32.0, 36.0, 38.0]).both(),
    );
    f.raise(
        -2.2,
        ellipsoid([52.0, 50.0, -36.0], [22.0, 28.0, 24.0]).both(),
    );
    f.raise(
        1.4,
        ellipsoid([58.0, 20.0, -40.0], [18.0, 22.0, 28.0]).both(),
    );
    // Jaw line under the body of the jaw.
    f.raise(
        0.9,
        capsule([46.0, 22.0, -66.0], [20.0, 74.0, -92.0], 13.0, 12.0).both(),
    );
    // Frontal eminences.
    f.raise(
        1.5,
        ellipsoid([28.0, 84.0, 72.0], [24.0, 20.0, 20.0]).both(),
    );
}

fn neck(f: &mut Field) {
    f.join(
        22.0,
        strap(
            [0.0, -14.0, -30.0],
            [0.0, -24.0, -175.0],
            51.0,
            57.0,
            [0.0, 1.0, 0.0],
            0.88,
        ),
    );
    // Trapezius towards the shoulders.
    f.join(
        22.0,
        capsule([20.0, -50.0, -50.0], [40.0, -46.0, -185.0], 20.0, 30.0).both(),
    );
    // Sternocleidomastoid from the mastoid to the breast bone.
    f.join(
        8.0,
        capsule([60.0, -16.0, -30.0], [15.0, 36.0, -180.0], 10.0, 8.5).both(),
    );
    f.raise(
        -3.5,
        capsule([46.0, 22.0, -88.0], [20.0, 32.0, -150.0], 13.0, 12.0).both(),
    );
    // Larynx.
    f.join(20.0, ellipsoid([0.0, 20.0, -122.0], [7.0, 10.0, 12.0]));
    // Nape.
    f.join(
        24.0,
        capsule([9.0, -57.0, -22.0], [10.0, -58.0, -185.0], 19.0, 20.0).both(),
    );
    f.raise(
        -1.5,
        capsule([0.0, -80.0, -30.0], [0.0, -80.0, -150.0], 17.0, 17.0),
    );
}

fn nose(f: &mut Field) {
    // Side walls, bridge, tip.
    f.join(
        14.0,
        capsule([3.5, 82.0, 24.0], [9.5, 91.0, -19.0], 6.0, 8.5).both(),
    );
    f.join(
        7.0,
        capsule([0.0, 88.0, 25.0], [0.0, 107.0, -13.0], 6.0, 7.0),
    );
    f.join(6.0, ellipsoid([0.0, 109.5, -17.0], [9.0, 9.5, 8.5]));
    f.join(3.0, ellipsoid([4.0, 111.5, -17.5], [5.5, 6.5, 6.0]).both());
    // Wings.
    f.join(
        4.5,
        ellipsoid([12.0, 100.0, -21.5], [6.2, 10.5, 7.6])
            .turned(-14.0, 0.0, 16.0)
            .both(),
    );
    // Columella.
    f.join(
        5.0,
        capsule([0.0, 110.5, -23.0], [0.0, 101.0, -28.0], 3.6, 4.2),
    );
    // Groove about the wing.
    let groove: [Knot; 4] = [
        ([10.5, 110.0, -12.5], 4.0),
        ([16.5, 103.5, -12.5], 4.5),
        ([20.0, 95.0, -19.0], 4.5),
        ([18.0, 93.0, -27.5], 4.0),
    ];
    f.raise_all(-1.8, both(curve(&groove)));
    // Nostrils.
    f.carve(
        1.2,
        ellipsoid([6.4, 104.5, -28.0], [3.4, 6.8, 7.0])
            .turned(-18.0, -14.0, 20.0)
            .both(),
    );
}

fn eyes(f: &mut Field) {
    // Brow ridge.
    let ridge: [Knot; 4] = [
        ([6.0, 96.0, 33.0], 13.0),
        ([20.0, 94.0, 36.5], 13.0),
        ([36.0, 86.0, 37.5], 13.0),
        ([53.0, 68.0, 30.0], 12.0),
    ];
    f.raise_all(2.6, both(curve(&ridge)));
    f.raise(1.2, ellipsoid([0.0, 96.0, 36.0], [16.0, 14.0, 12.0]));
    // Socket, deepest beside the nose.
    f.raise(
        -7.5,
        ellipsoid([30.0, 88.0, 18.0], [26.0, 24.0, 19.0]).both(),
    );
    f.raise(
        -4.0,
        ellipsoid([15.0, 88.0, 18.0], [11.0, 16.0, 16.0]).both(),
    );
    // Lids over the eyeball.
    let [x, y, z] = EYE;
    f.join(7.0, ellipsoid([x, y, z], [14.6, 14.2, 13.6]).both());
    // Crease of the upper lid, furrow under the lower.
    let crease: [Knot; 5] = [
        ([18.0, 84.0, 18.0], 3.0),
        ([22.0, 86.5, 23.5], 3.4),
        ([31.0, 88.0, 27.0], 3.6),
        ([41.0, 84.5, 25.0], 3.6),
        ([49.0, 77.0, 19.0], 3.2),
    ];
    f.raise_all(-2.2, both(curve(&crease)));
    let under: [Knot; 4] = [
        ([18.5, 85.0, 10.0], 4.5),
        ([27.0, 86.0, 3.5], 5.0),
        ([38.0, 83.0, 3.5], 5.0),
        ([46.0, 77.0, 8.0], 4.0),
    ];
    f.raise_all(-0.7, both(curve(&under)));
    // The opening between the lids.
    f.carve_all(0.6, palpebral_fissure());
}

/// The almond between the lids as a row of flat capsules that look forwards.
fn palpebral_fissure() -> Vec<Shape> {
    // Along the fissure: x, z of its middle, half its height.
    let profile: [(f32, f32, f32); 8] = [
        (17.0, 13.6, 0.8),
        (19.3, 14.0, 1.8),
        (23.0, 14.8, 3.6),
        (28.0, 15.6, 4.8),
        (33.0, 16.0, 4.9),
        (38.5, 16.0, 4.1),
        (43.0, 15.9, 2.6),
        (46.8, 15.7, 0.8),
    ];
    profile
        .windows(2)
        .map(|pair| {
            let (a, b) = (pair[0], pair[1]);
            let y = |x: f32| 86.0 - 0.012 * (x - 28.0) * (x - 28.0);
            // Flat capsules, deep along y.
            strap(
                [a.0, y(a.0), a.1],
                [b.0, y(b.0), b.1],
                a.2,
                b.2,
                [0.0, 1.0, 0.0],
                3.2,
            )
            .both()
        })
        .collect()
}

fn mouth(f: &mut Field) {
    // The upper lip's skin over the teeth.
    f.raise(1.8, ellipsoid([0.0, 100.0, -39.0], [24.0, 14.0, 11.0]));
    // Philtrum and its ridges.
    f.raise(
        -1.9,
        capsule([0.0, 103.5, -36.0], [0.0, 103.5, -44.5], 3.6, 4.4),
    );
    f.raise(
        0.9,
        capsule([4.2, 103.0, -36.0], [5.6, 103.0, -44.0], 3.4, 3.6).both(),
    );
    // Folds beside nose and mouth, and above the chin.
    f.raise_all(
        -1.9,
        both(curve(&[
            ([20.5, 91.0, -24.0], 7.0),
            ([26.0, 88.0, -34.0], 9.5),
            ([32.0, 82.0, -50.0], 10.0),
        ])),
    );
    f.raise(-3.4, ellipsoid([0.0, 97.0, -68.5], [27.0, 15.0, 11.0]));
    f.raise(
        -1.5,
        ellipsoid([27.0, 87.0, -54.0], [9.0, 9.0, 10.0]).both(),
    );
    f.join_all(2.5, lips());
    // The line between the lips.
    let line: [Knot; 5] = [
        ([0.0, 106.5, -52.6], 2.6),
        ([6.0, 105.5, -52.0], 2.6),
        ([13.0, 100.5, -52.6], 2.5),
        ([19.0, 95.0, -52.9], 2.4),
        ([25.0, 89.5, -52.8], 2.6),
    ];
    f.raise_all(-2.4, both(curve(&line)));
}

/// The red of the lips.
pub(super) fn lips() -> Vec<Shape> {
    let upper: [Knot; 5] = [
        ([0.0, 100.6, -49.0], 3.1),
        ([4.5, 100.6, -48.2], 3.3),
        ([11.0, 97.8, -49.6], 3.0),
        ([17.5, 93.0, -51.3], 2.2),
        ([23.5, 88.4, -52.8], 1.2),
    ];
    let lower: [Knot; 5] = [
        ([0.0, 99.0, -56.4], 4.0),
        ([6.5, 98.4, -56.4], 4.0),
        ([13.0, 95.2, -55.6], 3.4),
        ([18.5, 91.8, -54.3], 2.3),
        ([23.5, 88.4, -53.0], 1.2),
    ];
    let mut shapes = both(curve(&upper));
    shapes.extend(both(curve(&lower)));
    shapes
}

fn ears(f: &mut Field) {
    let frame = ear_frame();
    // The auricle's plate, narrowing to the lobe.
    f.join(
        5.0,
        ellipsoid(ear([2.0, 9.0, -3.5]), [15.5, 21.5, 3.6])
            .oriented(frame)
            .both(),
    );
    f.join(
        4.0,
        ellipsoid(ear([-2.0, -15.0, -2.0]), [10.5, 15.0, 3.6])
            .oriented(frame)
            .both(),
    );
    f.join(
        3.0,
        ellipsoid(ear([-3.0, -25.5, -1.5]), [8.0, 8.0, 4.0])
            .oriented(frame)
            .both(),
    );
    f.join(
        5.0,
        ellipsoid(ear([-7.0, -18.0, -7.0]), [5.0, 9.0, 7.0])
            .oriented(frame)
            .both(),
    );
    // Its root on the head.
    f.join(
        6.0,
        ellipsoid(ear([-4.0, 2.0, -10.0]), [8.0, 17.0, 8.0])
            .oriented(frame)
            .both(),
    );
    // Bowl, and the hollow between the rims.
    f.carve(
        3.0,
        ellipsoid(ear([-2.5, -3.0, 3.0]), [8.5, 11.5, 8.5])
            .oriented(frame)
            .both(),
    );
    f.carve(
        2.0,
        ellipsoid(ear([2.0, 19.0, 2.5]), [6.5, 6.5, 4.2])
            .oriented(frame)
            .both(),
    );
    let mut rim = |knots: &[Knot], smooth: f32| {
        let knots: Vec<Knot> = knots.iter().map(|&(p, r)| (ear(p), r)).collect();
        f.join_all(smooth, both(curve(&knots)));
    };
    // Helix.
    rim(
        &[
            ([-4.0, 0.5, -2.5], 1.8),
            ([-9.5, 4.5, 0.5], 2.4),
            ([-12.0, 14.0, 1.0], 2.5),
            ([-9.0, 24.0, 1.2], 2.6),
            ([-1.0, 30.0, 1.2], 2.7),
            ([8.5, 28.5, 1.5], 2.7),
            ([15.5, 21.0, 1.8], 2.6),
            ([17.5, 10.0, 1.8], 2.4),
            ([15.0, -2.0, 1.4], 2.2),
            ([10.0, -12.0, 0.8], 2.0),
            ([5.0, -20.0, 0.0], 2.0),
        ],
        2.0,
    );
    // Antihelix with its upper leg, down to the antitragus.
    rim(
        &[
            ([2.5, 20.0, -1.0], 1.8),
            ([7.0, 12.0, 0.2], 2.4),
            ([8.8, 3.0, 0.4], 2.6),
            ([7.0, -7.5, 0.3], 2.6),
            ([2.5, -14.0, 0.3], 2.8),
            ([-2.0, -14.8, 0.0], 2.4),
        ],
        2.5,
    );
    rim(&[([7.0, 12.0, 0.0], 2.2), ([-3.0, 12.5, -1.0], 1.8)], 2.5);
    // Tragus before the canal.
    f.join(
        3.0,
        ellipsoid(ear([-10.5, -4.0, -2.0]), [3.2, 5.5, 4.0])
            .oriented(frame)
            .both(),
    );
    // Canal.
    f.carve(
        1.5,
        capsule([74.0, -13.0, -3.5], [62.0, -7.0, -3.0], 3.4, 3.0).both(),
    );
}

/// Where the auricle and the front of the nose have cartilage under the skin; the ear's rim is too thin to draw it.
pub(super) fn cartilage_regions() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid(ear([1.0, 5.0, 0.0]), [15.0, 23.0, 9.0])
            .oriented(ear_frame())
            .both(),
    );
    f.join(0.0, ellipsoid([0.0, 106.0, -13.0], [17.0, 14.0, 16.0]));
    f
}

/// Eyebrows and the line of the lashes.
pub(super) fn hair(skin: &Field) -> Field {
    let mut f = Field::default();
    let brow: [Knot; 5] = [
        ([10.0, 97.5, 33.5], 2.4),
        ([18.0, 97.0, 35.8], 3.0),
        ([29.0, 92.5, 38.6], 2.8),
        ([40.0, 85.0, 38.0], 2.3),
        ([51.0, 74.0, 33.0], 1.4),
    ];
    // On the skin, whatever its shape.
    let brow = brow.map(|(p, r)| (skin.pull(p, 0.0), r));
    f.join_all(0.0, both(curve(&brow)));
    f
}

/// Height at which the neck is cut off.
pub(super) const NECK_END_MM: f32 = -141.0;
