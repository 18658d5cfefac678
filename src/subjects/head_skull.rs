//! The head's hard parts: cranial cavity and vault, face bones, jaw, teeth, neck vertebrae, and the hollows in them.
//!
//! Coordinates as in [`super::head_skin`].

use glam::{Mat3, Vec3};

use super::lanes::Lanes;
use super::shape::{Field, Knot, Places, ball, both, capsule, cuboid, curve, ellipsoid, strap};

/// The upper part of the cranial cavity, over the floors of the fossae: the room of the cerebrum.
pub(super) fn cerebral_space() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([0.0, -5.0, 46.0], [64.5, 78.0, 72.0]));
    f.join(14.0, ellipsoid([0.0, -42.0, 36.0], [54.0, 40.5, 46.0]));
    f.join(12.0, ellipsoid([0.0, 30.0, 62.0], [52.5, 48.5, 42.0]));
    // The floor rises forwards: middle fossa, then the roofs of the orbits.
    f.carve(
        10.0,
        cuboid([0.0, 5.2, -43.4], [95.0, 60.0, 60.0], 1.0).turned(26.57, 0.0, 0.0),
    );
    f.carve(18.0, cuboid([0.0, 66.0, -14.0], [95.0, 42.0, 50.0], 1.0));
    // Temporal lobes.
    f.join(
        8.0,
        ellipsoid([42.0, 6.0, 21.0], [19.5, 30.0, 22.0])
            .turned(0.0, -8.0, 0.0)
            .both(),
    );
    f.join(
        8.0,
        ellipsoid([40.0, -14.0, 26.0], [22.0, 30.0, 20.0]).both(),
    );
    f
}

/// The room of the cerebellum and brain stem, down to the foramen magnum.
pub(super) fn posterior_fossa() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([0.0, -38.0, 1.0], [48.0, 38.5, 28.0]));
    f.join(10.0, ellipsoid([0.0, -26.0, 14.0], [22.0, 24.0, 26.0]));
    // Along the clivus to the foramen and the canal.
    f.join(
        8.0,
        capsule([0.0, -4.0, 8.0], [0.0, -20.0, -28.0], 14.0, 13.0),
    );
    f
}

/// What lies under the tentorium.
pub(super) fn under_tentorium() -> Field {
    let mut f = Field::default();
    f.join(0.0, ellipsoid([0.0, -48.0, -10.0], [70.0, 48.0, 29.0]));
    f.join(8.0, ellipsoid([0.0, -26.0, 8.0], [19.0, 25.0, 26.0]));
    f
}

/// The whole cranial cavity.
pub(super) fn cavity() -> Field {
    let mut f = cerebral_space();
    f.append(posterior_fossa(), 6.0);
    // Pituitary fossa, olfactory groove.
    f.join(5.0, capsule([0.0, 12.0, 24.0], [0.0, 20.0, 20.0], 8.0, 6.0));
    f.join(5.0, capsule([0.0, 38.0, 34.0], [0.0, 70.0, 33.0], 6.0, 6.0));
    f
}

/// Spinal canal below the skull.
pub(super) fn canal() -> Field {
    let mut f = Field::default();
    let path: [Knot; 5] = [
        ([0.0, -20.0, -24.0], 13.0),
        ([0.0, -27.0, -45.0], 9.5),
        ([0.0, -29.5, -80.0], 8.5),
        ([0.0, -31.0, -115.0], 8.5),
        ([0.0, -36.0, -160.0], 8.5),
    ];
    f.join_all(0.0, curve(&path));
    f
}

/// What the skull has besides the vault about the cavity: face, arches, base.
pub(super) fn face_bones() -> Field {
    let mut f = Field::default();
    // Block of the midface; orbits, nose and sinuses are hollowed out of it.
    f.join(0.0, ellipsoid([0.0, 58.0, 2.0], [31.0, 30.0, 36.0]));
    f.join(
        8.0,
        ellipsoid([22.0, 62.0, -14.0], [17.0, 23.0, 22.0]).both(),
    );
    // Brow and rim of the orbit.
    let brow: [Knot; 5] = [
        ([0.0, 85.5, 35.0], 7.5),
        ([12.0, 86.0, 36.5], 7.5),
        ([28.0, 83.0, 38.5], 6.5),
        ([42.0, 75.5, 36.5], 6.0),
        ([51.0, 65.0, 28.0], 5.5),
    ];
    f.join_all(7.0, both(curve(&brow)));
    let lateral: [Knot; 4] = [
        ([51.0, 65.0, 28.0], 5.2),
        ([52.5, 61.5, 16.0], 4.4),
        ([51.5, 61.0, 5.0], 5.2),
        ([47.0, 64.0, -4.0], 7.0),
    ];
    f.join_all(4.0, both(curve(&lateral)));
    let lower: [Knot; 4] = [
        ([11.5, 84.0, 12.0], 3.6),
        ([17.0, 84.0, 1.0], 4.0),
        ([31.0, 78.5, -4.0], 4.6),
        ([47.0, 66.0, -2.0], 6.0),
    ];
    f.join_all(5.0, both(curve(&lower)));
    // Greater wing behind the orbit.
    f.join(
        5.0,
        strap(
            [50.0, 58.0, 16.0],
            [36.0, 40.0, 18.0],
            15.0,
            14.0,
            [0.75, -0.65, 0.0],
            0.2,
        )
        .both(),
    );
    // The frontal bone's flank, over the greater wing.
    f.join(9.0, ellipsoid([42.0, 56.0, 36.0], [9.0, 14.0, 12.0]).both());
    f.join(6.0, ellipsoid([46.0, 42.0, 18.0], [7.0, 14.0, 15.0]).both());
    // Zygoma and its arch.
    f.join(6.0, ellipsoid([46.5, 62.0, -8.0], [10.5, 10.0, 9.5]).both());
    f.join(
        5.0,
        capsule([44.0, 62.0, -13.0], [30.0, 66.0, -24.0], 7.0, 7.0).both(),
    );
    let arch: [Knot; 5] = [
        ([51.0, 57.0, -7.0], 5.5),
        ([58.5, 46.0, -7.0], 4.4),
        ([62.0, 30.0, -5.5], 4.0),
        ([62.5, 15.0, -3.0], 4.0),
        ([60.0, 3.0, 1.5], 5.0),
    ];
    f.join_all(3.0, both(curve(&arch)));
    // Nasal bones and the frontal process of the maxilla.
    f.join(
        5.0,
        capsule([2.5, 86.0, 28.0], [2.8, 99.0, 7.0], 4.0, 2.8).both(),
    );
    f.join(
        5.0,
        strap(
            [8.5, 85.0, 24.0],
            [14.0, 88.5, -16.0],
            6.5,
            5.5,
            [0.8, 0.6, 0.0],
            0.5,
        )
        .both(),
    );
    // Upper dental arch with its ridges over the roots.
    let alveolar: [Knot; 5] = [
        ([0.0, 87.5, -36.0], 7.5),
        ([11.0, 85.5, -36.0], 7.5),
        ([21.0, 75.5, -35.0], 7.5),
        ([26.0, 62.0, -33.5], 7.5),
        ([27.5, 48.0, -32.0], 7.0),
    ];
    f.join_all(6.0, both(curve(&alveolar)));
    f.join(
        3.0,
        capsule([0.0, 90.0, -31.0], [0.0, 95.0, -30.5], 3.0, 1.6),
    );
    // Palate.
    f.join(
        3.0,
        strap(
            [0.0, 84.0, -31.0],
            [0.0, 54.0, -30.0],
            23.0,
            23.0,
            [0.0, 0.0, 1.0],
            0.1,
        ),
    );
    // Sphenoid, clivus, pterygoid plates.
    f.join(6.0, ellipsoid([0.0, 28.0, 9.0], [17.0, 15.0, 14.0]));
    f.join(6.0, capsule([0.0, 14.0, 4.0], [0.0, -1.0, -23.0], 8.0, 6.0));
    f.join(
        4.0,
        strap(
            [15.0, 39.0, -4.0],
            [16.0, 40.0, -34.0],
            9.0,
            5.5,
            [1.0, 0.0, 0.0],
            0.3,
        )
        .both(),
    );
    f.join(
        4.0,
        capsule([30.0, 38.0, 2.0], [44.0, 20.0, 0.0], 8.0, 7.0).both(),
    );
    // Petrous pyramid, mastoid, styloid.
    f.join(
        6.0,
        capsule([18.0, 8.0, 2.0], [56.0, -10.0, 0.0], 7.0, 11.0).both(),
    );
    f.join(
        7.0,
        capsule([60.0, -20.0, 2.0], [56.0, -13.0, -23.0], 10.5, 6.0).both(),
    );
    f.join(
        2.0,
        capsule([48.0, -5.0, -12.0], [40.0, 9.0, -42.0], 2.2, 1.2).both(),
    );
    // Back of the base: condyles, nuchal lines, outer protuberance.
    f.join(
        4.0,
        ellipsoid([15.5, -10.0, -27.0], [6.0, 10.0, 6.0])
            .turned(0.0, 0.0, 25.0)
            .both(),
    );
    f.join(6.0, ball([0.0, -88.5, 4.0], 4.5));
    let nuchal: [Knot; 3] = [
        ([0.0, -87.0, 4.0], 3.5),
        ([28.0, -78.5, 2.0], 3.0),
        ([50.0, -52.0, -4.0], 3.0),
    ];
    f.join_all(7.0, both(curve(&nuchal)));
    // Temporal line.
    let temporal: [Knot; 4] = [
        ([52.0, 64.0, 34.0], 3.0),
        ([52.0, 55.0, 52.0], 2.2),
        ([58.0, 25.0, 80.0], 1.8),
        ([62.0, -20.0, 82.0], 1.2),
    ];
    f.join_all(6.0, both(curve(&temporal)));
    f
}

/// Orbits and other openings of the skull that hold soft tissue.
pub(super) fn openings() -> Field {
    let mut f = Field::default();
    // A rounded cone towards the optic canal.
    f.join(
        0.0,
        capsule([34.0, 86.0, 16.5], [15.0, 38.0, 19.0], 18.2, 4.0).both(),
    );
    f.join(
        4.0,
        ellipsoid([31.5, 74.0, 17.0], [18.0, 17.0, 16.5]).both(),
    );
    f.join(
        2.0,
        capsule([15.0, 40.0, 19.0], [10.0, 26.0, 22.0], 3.0, 2.6).both(),
    );
    // Fissures behind and below.
    f.join(
        2.0,
        capsule([26.0, 46.0, 5.0], [38.0, 58.0, 0.0], 2.5, 2.5).both(),
    );
    f.join(
        2.0,
        capsule([17.0, 38.0, 16.0], [27.0, 43.0, 22.0], 2.5, 2.0).both(),
    );
    // Piriform opening, before the nasal cavity proper.
    f.join(0.0, ellipsoid([5.5, 96.0, -19.0], [7.5, 14.0, 11.0]).both());
    f.join(4.0, ellipsoid([0.0, 99.0, -4.0], [7.0, 12.0, 12.0]));
    // Room over the tongue.
    f.join(0.0, ellipsoid([0.0, 62.0, -47.0], [21.5, 27.0, 15.0]));
    // Ear canal, infraorbital foramen, mandibular fossa.
    f.join(
        0.0,
        capsule([68.0, -10.5, -3.3], [44.0, 1.0, -2.0], 4.6, 4.0).both(),
    );
    f.join(
        0.0,
        capsule([27.0, 82.0, -11.0], [26.0, 70.0, -8.0], 1.8, 1.8).both(),
    );
    f.join(0.0, ellipsoid([51.0, 11.0, -5.0], [11.0, 7.5, 7.5]).both());
    // Carotid canal, jugular foramen, foramen ovale.
    f.join(
        0.0,
        capsule([27.0, 4.0, -16.0], [25.0, 6.0, 6.0], 3.2, 3.0).both(),
    );
    f.join(
        0.0,
        capsule([28.0, -9.0, -20.0], [30.0, -14.0, -2.0], 4.5, 4.0).both(),
    );
    f.join(
        0.0,
        capsule([23.0, 19.0, -10.0], [25.0, 18.0, 10.0], 2.5, 2.5).both(),
    );
    f
}

/// Hollows filled with air in the skull: the sinuses.
pub(super) fn sinuses() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid([26.0, 57.0, -13.0], [10.5, 15.0, 13.5]).both(),
    );
    f.join(0.0, ellipsoid([8.0, 30.0, 9.0], [7.0, 9.5, 8.5]).both());
    f.join(
        0.0,
        ellipsoid([8.5, 80.0, 39.0], [8.0, 2.8, 7.0])
            .turned(14.0, 0.0, 0.0)
            .both(),
    );
    // Ethmoid cells beside the roof of the nose, mastoid cells.
    for (i, z) in [14.0, 15.0, 15.5, 15.0, 14.0].into_iter().enumerate() {
        let y = 44.0 + 8.0 * i as f32;
        f.join(0.0, ball([9.0, y, z], 3.7).both());
        f.join(0.0, ball([8.8, y + 3.0, z - 7.6], 3.4).both());
    }
    for p in [
        [57.0, -13.0, -17.0],
        [60.0, -17.0, -10.0],
        [55.0, -19.0, -7.0],
        [58.0, -12.0, -8.0],
        [61.0, -22.0, -2.0],
        [55.0, -15.0, 1.0],
    ] {
        f.join(0.0, ball(p, 2.1).both());
    }
    f
}

/// Shape of the mandible.
pub(super) fn mandible() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        ellipsoid([51.0, 11.0, -6.5], [8.5, 4.2, 4.5])
            .turned(0.0, 0.0, 14.0)
            .both(),
    );
    f.join(
        3.0,
        capsule([50.5, 11.5, -8.0], [49.0, 15.0, -24.0], 4.0, 5.0).both(),
    );
    // Ramus, coronoid process, angle.
    f.join(
        5.0,
        strap(
            [48.5, 22.0, -26.0],
            [46.5, 24.0, -56.0],
            14.0,
            15.0,
            [1.0, 0.1, 0.0],
            0.25,
        )
        .both(),
    );
    f.join(
        4.0,
        strap(
            [48.0, 31.0, -26.0],
            [47.5, 36.0, -9.0],
            8.0,
            2.6,
            [1.0, 0.0, 0.0],
            0.4,
        )
        .both(),
    );
    f.join(5.0, ellipsoid([47.5, 17.0, -58.0], [4.5, 9.0, 10.0]).both());
    // Body, deepest at the chin.
    let body: [Knot; 5] = [
        ([46.0, 24.0, -58.0], 7.5),
        ([40.5, 44.0, -66.0], 8.0),
        ([31.0, 65.0, -74.0], 8.4),
        ([16.0, 80.0, -81.0], 8.4),
        ([0.0, 83.5, -84.0], 8.6),
    ];
    f.join_all(5.0, both(curve(&body)));
    let alveolar: [Knot; 5] = [
        ([31.0, 46.0, -60.5], 7.0),
        ([28.0, 58.0, -63.0], 6.5),
        ([22.5, 71.0, -66.5], 6.0),
        ([11.0, 81.5, -70.0], 6.0),
        ([0.0, 83.5, -71.0], 6.0),
    ];
    f.join_all(9.0, both(curve(&alveolar)));
    // Chin.
    f.join(6.0, ellipsoid([0.0, 87.0, -88.0], [6.0, 5.5, 7.0]));
    f.join(6.0, ellipsoid([12.0, 83.5, -92.0], [8.0, 5.5, 4.5]).both());
    f.carve(
        1.5,
        capsule([27.0, 80.0, -77.0], [24.0, 70.0, -76.0], 1.7, 1.5).both(),
    );
    f.raise(-1.6, ellipsoid([0.0, 91.0, -78.0], [16.0, 9.0, 6.0]));
    f
}

/// Neck vertebrae, tongue bone.
pub(super) fn neck_bones() -> Field {
    let mut f = Field::default();
    // Atlas: a ring with two side masses.
    let ring: [Knot; 5] = [
        ([0.0, 1.5, -41.0], 4.0),
        ([13.0, -2.0, -41.0], 4.5),
        ([20.5, -14.0, -40.0], 5.0),
        ([16.0, -32.0, -41.0], 4.0),
        ([0.0, -42.5, -42.0], 4.5),
    ];
    f.join_all(0.0, both(curve(&ring)));
    f.join(3.0, ellipsoid([18.0, -11.0, -38.5], [7.0, 9.5, 6.5]).both());
    f.join(
        3.0,
        capsule([22.0, -14.0, -41.0], [37.0, -16.0, -42.0], 5.0, 3.5).both(),
    );
    f.carve(
        0.5,
        capsule([28.5, -14.0, -36.0], [28.5, -14.0, -47.0], 2.8, 2.8).both(),
    );
    // Axis with its tooth.
    f.join(
        0.0,
        capsule([0.0, -8.5, -27.0], [0.0, -8.0, -50.0], 4.3, 5.5),
    );
    for (level, (y, z)) in [
        (-8.5, -57.0),
        (-9.0, -75.5),
        (-11.0, -93.5),
        (-14.0, -111.0),
        (-18.0, -129.0),
        (-22.0, -147.0),
    ]
    .into_iter()
    .enumerate()
    {
        let grow = 1.0 + 0.04 * level as f32;
        let body = cuboid([0.0, y, z], [9.5 * grow, 8.0, 6.8], 4.0).turned(-8.0, 0.0, 0.0);
        f.join(0.0, body);
        // Arch, joints, spine, side processes with the hole of the artery.
        let arch: [Knot; 3] = [
            ([9.0, y - 7.0, z + 1.0], 4.0),
            ([15.0, y - 18.0, z], 4.4),
            ([2.0, y - 31.0, z - 4.0], 3.6),
        ];
        f.join_all(1.5, both(curve(&arch)));
        f.join(
            2.0,
            ellipsoid([16.5 * grow, y - 16.0, z], [5.0, 5.5, 8.0])
                .turned(25.0, 0.0, 0.0)
                .both(),
        );
        let long = if level == 0 || level == 5 { 50.0 } else { 43.0 };
        f.join(
            2.0,
            strap(
                [2.0, y - 30.0, z - 4.0],
                [2.5, y - long, z - 10.0],
                4.8,
                4.0,
                [1.0, 0.0, 0.0],
                0.6,
            )
            .both(),
        );
        f.join(
            2.0,
            strap(
                [11.0, y - 3.0, z],
                [23.0 * grow, y - 5.0, z - 2.0],
                5.0,
                4.2,
                [0.0, 0.0, 1.0],
                0.7,
            )
            .both(),
        );
        f.carve(
            0.5,
            capsule(
                [17.5 * grow, y - 4.0, z + 9.0],
                [17.5 * grow, y - 4.0, z - 10.0],
                2.5,
                2.5,
            )
            .both(),
        );
    }
    // Tongue bone.
    let hyoid: [Knot; 4] = [
        ([0.0, 36.0, -98.0], 3.6),
        ([10.0, 33.0, -98.0], 3.2),
        ([17.0, 22.0, -96.0], 2.4),
        ([20.0, 10.0, -93.0], 2.2),
    ];
    f.join_all(0.0, both(curve(&hyoid)));
    f
}

/// Discs between the vertebrae, cartilages of larynx and windpipe.
pub(super) fn cartilages() -> Field {
    let mut f = Field::default();
    for (y, z) in [
        (-8.7, -66.3),
        (-10.0, -84.5),
        (-12.5, -102.2),
        (-16.0, -120.0),
        (-20.0, -138.0),
    ] {
        f.join(
            0.0,
            cuboid([0.0, y, z], [10.0, 8.2, 3.6], 2.5).turned(-8.0, 0.0, 0.0),
        );
    }
    // Thyroid cartilage, ring cartilage, hoops of the windpipe.
    f.join(
        0.0,
        strap(
            [0.0, 33.5, -119.0],
            [18.0, 12.0, -116.0],
            11.0,
            12.0,
            [0.65, 0.75, 0.0],
            0.17,
        )
        .both(),
    );
    f.join(
        1.0,
        capsule([18.0, 11.0, -106.0], [17.0, 10.0, -130.0], 2.0, 2.0).both(),
    );
    let cricoid: [Knot; 4] = [
        ([0.0, 30.0, -134.0], 3.0),
        ([10.0, 26.0, -133.5], 3.2),
        ([13.0, 15.0, -131.0], 3.8),
        ([0.0, 6.0, -128.0], 5.0),
    ];
    f.join_all(0.0, both(curve(&cricoid)));
    f
}

/// One tooth: middle of the crown, its frame (across, outwards, up), half its width and thickness, height, direction of
/// the root.
fn tooth(
    crowns: &mut Field,
    roots: &mut Field,
    middle: Vec3,
    frame: Mat3,
    half: Vec3,
    root_up: f32,
    molar: bool,
) {
    let to = |x: f32, y: f32, z: f32| (middle + frame * Vec3::new(x, y, z)).to_array();
    let lift = |height: f32| height * root_up;
    if molar {
        crowns.join_all(
            0.0,
            vec![
                cuboid(
                    middle.to_array(),
                    half.to_array(),
                    half.min_element() * 0.75,
                )
                .oriented(frame)
                .both(),
            ],
        );
        crowns.raise(
            -1.2,
            capsule(
                to(-half.x, 0.0, lift(-half.z - 0.4)),
                to(half.x, 0.0, lift(-half.z - 0.4)),
                2.2,
                2.2,
            )
            .both(),
        );
        for side in [-0.45, 0.45] {
            roots.join(
                1.0,
                capsule(
                    to(side * half.x, 0.0, lift(half.z * 0.5)),
                    to(side * half.x * 1.1, 0.0, lift(half.z + 10.0)),
                    2.8,
                    1.3,
                )
                .both(),
            );
        }
    } else {
        // A wedge: thick at the neck, thin at the edge.
        crowns.join_all(
            0.0,
            vec![
                cuboid(
                    to(0.0, 0.0, 0.0),
                    [half.x, half.y * 0.8, half.z],
                    half.y * 0.7,
                )
                .oriented(frame)
                .both(),
                ellipsoid(
                    to(0.0, -half.y * 0.35, lift(half.z * 0.45)),
                    [half.x * 0.85, half.y * 1.1, half.z * 0.7],
                )
                .oriented(frame)
                .both(),
            ],
        );
        roots.join(
            1.0,
            capsule(
                to(0.0, -half.y * 0.3, lift(half.z * 0.6)),
                to(0.0, -half.y * 0.8, lift(half.z + 11.0)),
                2.6,
                1.1,
            )
            .both(),
        );
    }
}

/// All teeth: crowns and roots.
pub(super) fn teeth() -> Field {
    let mut crowns = Field::default();
    let mut roots = Field::default();
    // Widths from the middle to the back.
    let upper = (
        [4.3, 3.4, 3.9, 3.5, 3.4, 5.2, 4.9],
        30.5f32,
        50.0f32,
        42.8f32,
    );
    let lower = ([2.7, 3.0, 3.4, 3.5, 3.6, 5.5, 5.2], 28.0, 50.0, 40.8);
    for (is_upper, (widths, a, y0, b)) in [(true, upper), (false, lower)] {
        // Walk along the half ellipse (a sin t, y0 + b cos t) by arc length.
        let mut t = 0.0f64;
        let (a, b) = (f64::from(a), f64::from(b));
        let mut advance = |mm: f64| {
            for _ in 0..16 {
                let dx = a * libm::cos(t);
                let dy = b * libm::sin(t);
                t += mm / 16.0 / (dx * dx + dy * dy).sqrt();
            }
            t
        };
        for (i, half_width) in widths.into_iter().enumerate() {
            let t = advance(half_width);
            let (x, y) = (a * libm::sin(t), f64::from(y0) + b * libm::cos(t));
            advance(half_width);
            let along = Vec3::new((a * libm::cos(t)) as f32, (-b * libm::sin(t)) as f32, 0.0);
            let along = along / along.length();
            let out = Vec3::new(-along.y, along.x, 0.0);
            // Columns: along the arch, outwards, up.
            let frame = Mat3::from_cols(along, out, Vec3::Z);
            let molar = i >= 3;
            let (height, thick) = match i {
                0 | 1 => (
                    if is_upper { 5.2 } else { 4.6 },
                    if is_upper { 3.0 } else { 2.6 },
                ),
                2 => (5.4, 3.4),
                3 | 4 => (4.2, 4.2),
                _ => (3.8, 5.0),
            };
            // The plane of the bite rises a little towards the back.
            let bite =
                -52.0 + 0.09 * (97.0 - y as f32) + if is_upper && !molar { -1.6 } else { 0.0 };
            let z = if is_upper {
                bite + height
            } else {
                bite - height - if molar { 0.3 } else { 0.6 }
            };
            let half = Vec3::new(half_width as f32 * 0.97, thick, height);
            tooth(
                &mut crowns,
                &mut roots,
                Vec3::new(x as f32, y as f32, z),
                frame,
                half,
                if is_upper { 1.0 } else { -1.0 },
                molar,
            );
        }
    }
    crowns.append(roots, 0.5);
    crowns
}

/// How deep the sutures are engraved at points near the vault, mm, 0 away from them.
pub(super) fn sutures(p: &Places) -> Lanes {
    let p = &p.plain;
    let mut out = [0.0f32; super::lanes::LANES];
    for (i, depth) in out.iter_mut().enumerate() {
        let (x, y, z) = (p.x[i], p.y[i], p.z[i]);
        let ax = x.abs();
        // Triangle waves of two lengths make the teeth of the line.
        let zigzag = |s: f32, size: f32| {
            let tri = |s: f32| (s - (s + 0.5).floor()).abs() * 4.0 - 1.0;
            size * (tri(s / 7.0) + 0.6 * tri(s / 3.1 + 0.3))
        };
        let mut near = f32::INFINITY;
        let mut line = |d: f32| near = near.min(d.abs());
        // Coronal: from the bregma down to the temples.
        if z > 38.0 && y > 0.0 {
            line(y - 24.0 - 0.16 * (122.0 - z) - zigzag(ax + 0.5 * z, 1.4));
        }
        // Sagittal, between bregma and lambda.
        if y < 24.0 && z > 72.0 {
            line((x - zigzag(y, 1.8)) * 1.0);
        }
        // Lambdoid.
        if y < -40.0 && z > 8.0 {
            line((z - 76.0 + 1.12 * ax - zigzag(ax * 1.4, 2.2)) * 0.67);
        }
        // Squamous: an arc about the ear.
        if ax > 40.0 && z > 6.0 && y < 44.0 {
            let (dy, dz) = (y - 2.0, (z - 6.0) * 0.82);
            line((dy * dy + dz * dz).sqrt() - 40.0 - zigzag(y + z, 0.5));
        }
        let t = (near * (1.0 / 1.5)).min(1.0);
        *depth = 1.7 * (1.0 - t * t);
    }
    Lanes::from(out)
}
