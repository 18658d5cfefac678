//! The torso's frame: spine, ribs with their cartilages, breastbone, collar bones, shoulder blades, pelvis.
//!
//! Millimetres as in `torso`. Proportions after common textbooks of anatomy: the notch of the breastbone stands before
//! T2/T3, its angle before T4/T5, its lower end before T9; the top of the pelvis before L4.

use glam::Vec3;

use super::paint::Revision;
use super::profile::{Profile, Ring};
use super::shape::{
    Field, Knot, Shape, ball, capsule, cuboid, curve, disc, ellipsoid, strap, turn_deg,
};

/// The inside of chest and belly, lowest first: height, half width, front, back.
const CAVITY: [Ring; 15] = [
    [-276.0, 106.0, 62.0, -72.0],
    [-220.0, 109.0, 68.0, -58.0],
    [-180.0, 108.0, 72.0, -55.0],
    [-140.0, 110.0, 74.0, -60.0],
    [-100.0, 117.0, 76.0, -68.0],
    [-60.0, 127.0, 78.0, -78.0],
    [-20.0, 132.0, 80.0, -86.0],
    [20.0, 132.0, 81.0, -92.0],
    [60.0, 126.0, 76.0, -95.0],
    [100.0, 113.0, 66.0, -94.0],
    [130.0, 96.0, 55.0, -88.0],
    [155.0, 70.0, 38.0, -76.0],
    [172.0, 48.0, 18.0, -62.0],
    [184.0, 30.0, 2.0, -48.0],
    [230.0, 20.0, -10.0, -40.0],
];
/// From the cavity to the middle of a rib, mm.
const RIB_DEPTH_MM: f32 = 6.0;

/// The inside of chest and belly.
pub(super) fn cavity() -> Profile {
    Profile::new(&CAVITY, 0.35)
}

/// Height of the middle of each vertebral body, from C6 to S1, and from which one on they are thoracic and lumbar.
const VERTEBRAE: [f32; 20] = [
    209.0, 192.0, 174.0, 155.0, 135.0, 114.0, 92.5, 70.5, 48.0, 25.0, 1.0, -24.5, -51.0, -79.5,
    -110.0, -142.5, -176.5, -212.0, -248.0, -281.0,
];
const FIRST_THORACIC: usize = 2;
const FIRST_LUMBAR: usize = 14;

/// The spine's curve: height, y of the middle of the bodies.
const CURVE: [[f32; 2]; 10] = [
    [240.0, -18.0],
    [209.0, -22.0],
    [174.0, -36.0],
    [135.0, -50.0],
    [92.0, -59.0],
    [25.0, -62.0],
    [-51.0, -50.0],
    [-142.0, -28.0],
    [-200.0, -24.0],
    [-290.0, -52.0],
];

/// y of the middle of the vertebral bodies at a height.
pub(super) fn spine_y(z: f32) -> f32 {
    let last = CURVE.len() - 1;
    let mut i = 0;
    while i + 1 < last && z < CURVE[i + 1][0] {
        i += 1;
    }
    let slope = |i: usize| {
        let (a, b) = (CURVE[i.saturating_sub(1)], CURVE[(i + 1).min(last)]);
        (b[1] - a[1]) / (b[0] - a[0])
    };
    let (a, b) = (CURVE[i], CURVE[i + 1]);
    let span = b[0] - a[0];
    let t = ((z - a[0]) / span).clamp(0.0, 1.0);
    let (t2, t3) = (t * t, t * t * t);
    a[1] * (2.0 * t3 - 3.0 * t2 + 1.0)
        + slope(i) * span * (t3 - 2.0 * t2 + t)
        + b[1] * (3.0 * t2 - 2.0 * t3)
        + slope(i + 1) * span * (t3 - t2)
}

/// Half width and half depth of a vertebral body, mm.
fn body_radius(index: usize) -> f32 {
    if index < FIRST_THORACIC {
        11.0
    } else {
        12.5 + 0.75 * (index - FIRST_THORACIC) as f32
    }
}

/// Degrees by which the bodies lean at a height, about x.
fn lean_deg(z: f32) -> f32 {
    let slope = (spine_y(z + 8.0) - spine_y(z - 8.0)) / 16.0;
    // The angle of a small slope; its sine and tangent hardly differ.
    (-57.3 * slope).clamp(-32.0, 32.0)
}

/// What belongs to the spine.
pub(super) struct Spine {
    pub(super) bones: Field,
    pub(super) discs: Field,
    /// The sac of the cord and the roots.
    pub(super) canal: Field,
    pub(super) cord: Field,
    pub(super) roots: Field,
}

pub(super) fn spine(revision: Revision) -> Spine {
    let (mut bones, mut discs) = (Field::default(), Field::default());
    let mut roots = Field::default();
    let mut canal_knots: Vec<Knot> = Vec::new();
    for (i, &z) in VERTEBRAE.iter().enumerate() {
        let y = spine_y(z);
        let r = body_radius(i);
        let above = if i == 0 { 226.0 } else { VERTEBRAE[i - 1] };
        let below = VERTEBRAE.get(i + 1).copied().unwrap_or(-314.0);
        let lumbar = i >= FIRST_LUMBAR;
        let thoracic = i >= FIRST_THORACIC && !lumbar;
        let room = 0.5 * (above - below);
        let gap = if lumbar {
            9.5
        } else if thoracic {
            5.0
        } else {
            4.5
        };
        let half = 0.5 * (room - gap);
        let lean = turn_deg(lean_deg(z), 0.0, 0.0);
        // A place on the vertebra: across, backwards from the middle of the body, up.
        let on = |x: f32, back: f32, up: f32| {
            (Vec3::new(0.0, y, z) + lean * Vec3::new(x, -back, up)).to_array()
        };
        let wide = if lumbar { 1.18 } else { 1.0 };
        // The body: waisted, its rims proud.
        let plate = |up: f32| {
            ellipsoid(on(0.0, 0.0, up), [r * wide, r * 0.95, 4.5]).turned(lean_deg(z), 0.0, 0.0)
        };
        bones.join_all(
            0.0,
            vec![
                disc(on(0.0, 0.0, 0.0), r * wide * 0.93, half, 3.0).turned(lean_deg(z), 0.0, 0.0),
                plate(half - 2.6),
                plate(-half + 2.6),
            ],
        );
        let canal_back = r + 8.0;
        canal_knots.push((on(0.0, canal_back, 0.0), if lumbar { 8.6 } else { 7.8 }));
        // Pedicles, the arch, the processes.
        let pedicle = if lumbar { 6.0 } else { 4.0 };
        let side = if lumbar { 12.5 } else { 10.0 };
        let mut arch = vec![
            strap(
                on(side, r - 4.0, half * 0.4),
                on(side + 1.5, canal_back + 2.0, half * 0.35),
                pedicle,
                pedicle,
                [1.0, 0.0, 0.0],
                0.62,
            )
            .both(),
            strap(
                on(side + 1.0, canal_back + 3.0, 0.0),
                on(1.0, canal_back + 12.5, -2.0),
                half * 0.8,
                half * 0.72,
                [0.4, -0.9, 0.0],
                0.36,
            )
            .both(),
            // Joints with the vertebrae above and below.
            capsule(
                on(side + 2.0, canal_back + 5.0, half * 0.9),
                on(side + 2.5, canal_back + 7.0, -half * 1.15),
                4.2,
                4.2,
            )
            .both(),
        ];
        if lumbar {
            arch.push(strap(
                on(0.0, canal_back + 11.0, -2.0),
                on(0.0, canal_back + 33.0, -5.0),
                10.0,
                11.0,
                [1.0, 0.0, 0.0],
                0.3,
            ));
            arch.push(
                strap(
                    on(side + 3.0, canal_back + 1.0, 3.0),
                    on(42.0, canal_back + 5.0, 5.0),
                    5.5,
                    4.0,
                    [0.0, 1.0, 0.0],
                    0.55,
                )
                .both(),
            );
        } else {
            let drop = if thoracic { 21.0 } else { 6.0 };
            let reach = if thoracic { 27.0 } else { 30.0 };
            arch.push(strap(
                on(0.0, canal_back + 10.0, -1.0),
                on(0.0, canal_back + reach, -drop),
                6.5,
                4.2,
                [1.0, 0.0, 0.0],
                0.5,
            ));
            arch.push(
                capsule(
                    on(side + 2.0, canal_back + 5.0, 2.5),
                    on(29.0, canal_back + 13.0, 5.0),
                    4.6,
                    5.0,
                )
                .both(),
            );
        }
        bones.join_all(2.0, arch);
        // The disc below.
        let middle = 0.5 * (z + below);
        discs.join(
            0.0,
            disc(
                [0.0, spine_y(middle), middle],
                r * wide * 0.98,
                gap * 0.5 + 1.5,
                2.0,
            )
            .turned(lean_deg(middle), 0.0, 0.0),
        );
        // The root leaves between this vertebra and the next.
        let out = middle + 1.0;
        let y = spine_y(out);
        if revision == Revision::Second {
            // Out of the cord, however thin it is there.
            let inner = [1.0, y - canal_back, out + 10.0];
            let outer = [4.0, y - canal_back, out + 8.0];
            roots.join(0.0, capsule(inner, outer, 1.6, 1.6).both());
        }
        roots.join_all(
            0.0,
            curve(&[
                ([4.0, y - canal_back, out + 8.0], 1.6),
                ([14.0, y - r - 5.0, out], 2.4),
                ([30.0, y - r, out - 5.0], 1.9),
                (
                    [
                        52.0,
                        y - r - 6.0 + if lumbar { 14.0 } else { 0.0 },
                        out - 14.0,
                    ],
                    1.5,
                ),
            ])
            .into_iter()
            .map(Shape::both)
            .collect(),
        );
    }
    let first = canal_knots[0].0;
    canal_knots.insert(0, ([0.0, first[1] + 3.0, 240.0], 7.8));
    let mut canal = Field::default();
    canal.join_all(0.0, curve(&canal_knots));
    let mut cord = Field::default();
    let cord_knots: Vec<Knot> = canal_knots
        .iter()
        .filter(|(p, _)| p[2] > -125.0)
        .map(|&(p, _)| (p, if p[2] < -105.0 { 1.2 } else { 5.0 }))
        .collect();
    cord.join_all(0.0, curve(&cord_knots));
    // Below its end the roots run on, like a horse's tail.
    for x in [-3.6f32, -1.4, 1.4, 3.6] {
        let strand: Vec<Knot> = canal_knots
            .iter()
            .filter(|(p, _)| p[2] < -70.0)
            .enumerate()
            .map(|(i, &(p, _))| {
                let wave = if i % 2 == 0 { 1.0 } else { -1.0 };
                ([x, p[1] + wave * 1.2 - x.abs() * 0.5, p[2]], 1.3)
            })
            .collect();
        cord.join_all(0.0, curve(&strand));
    }
    Spine {
        bones,
        discs,
        canal,
        cord,
        roots,
    }
}

/// One rib: height at the spine, where bone ends (height, degrees around from the back), and how the cartilage goes on.
struct Rib {
    back_z: f32,
    end_z: f32,
    end_deg: f32,
    /// Where the cartilage reaches the breastbone or its upper neighbour: height and degrees; nothing for floating
    /// ribs.
    joint: Option<[f32; 2]>,
    half_height: f32,
}

const fn rib(
    back_z: f32,
    end_z: f32,
    end_deg: f32,
    joint: Option<[f32; 2]>,
    half_height: f32,
) -> Rib {
    Rib {
        back_z,
        end_z,
        end_deg,
        joint,
        half_height,
    }
}

const RIBS: [Rib; 12] = [
    rib(178.0, 142.0, 150.0, Some([136.0, 160.0]), 8.0),
    rib(160.0, 112.0, 148.0, Some([107.0, 167.0]), 6.6),
    rib(140.0, 88.0, 148.0, Some([86.0, 169.0]), 6.6),
    rib(119.0, 64.0, 146.0, Some([66.0, 170.0]), 6.8),
    rib(98.0, 38.0, 143.0, Some([46.0, 170.0]), 7.0),
    rib(76.0, 10.0, 140.0, Some([28.0, 170.5]), 7.2),
    rib(53.0, -19.0, 134.0, Some([13.0, 171.0]), 7.4),
    rib(30.0, -46.0, 128.0, Some([-18.0, 154.0]), 7.2),
    rib(6.0, -70.0, 121.0, Some([-44.0, 143.0]), 7.0),
    rib(-20.0, -92.0, 114.0, Some([-68.0, 132.0]), 6.8),
    rib(-47.0, -104.0, 82.0, None, 5.6),
    rib(-76.0, -112.0, 44.0, None, 5.0),
];

fn around_deg(deg: f32) -> (f32, f32) {
    let angle = f64::from(deg) * (std::f64::consts::PI / 180.0);
    (libm::sin(angle) as f32, -libm::cos(angle) as f32)
}

/// Flat pieces along a path on the cage; `normal` points out of it.
fn band(cage: &Profile, path: &[[f32; 2]], half_height: f32, flat: f32) -> Vec<Shape> {
    let points: Vec<([f32; 3], Vec3)> = path
        .iter()
        .map(|&[deg, z]| {
            let (side, forward) = around_deg(deg);
            let inner = cage.rim(z, side, forward, RIB_DEPTH_MM);
            let outer = cage.rim(z, side, forward, RIB_DEPTH_MM + 4.0);
            (inner, Vec3::from_array(outer) - Vec3::from_array(inner))
        })
        .collect();
    points
        .windows(2)
        .map(|pair| {
            strap(
                pair[0].0,
                pair[1].0,
                half_height,
                half_height,
                (pair[0].1 + pair[1].1).to_array(),
                flat,
            )
            .both()
        })
        .collect()
}

/// Ribs, and their cartilages.
pub(super) fn ribs(cage: &Profile) -> (Field, Field) {
    let (mut ribs, mut cartilages) = (Field::default(), Field::default());
    for (i, rib) in RIBS.iter().enumerate() {
        let vertebra = VERTEBRAE[FIRST_THORACIC + i];
        let y = spine_y(vertebra);
        let r = body_radius(FIRST_THORACIC + i);
        // Head at the body, tubercle at the process, then round the cage, falling ever faster.
        let start_deg = 26.0f32;
        let mut path = Vec::new();
        const PIECES: usize = 14;
        for piece in 0..=PIECES {
            let t = piece as f32 / PIECES as f32;
            let deg = start_deg + (rib.end_deg - start_deg) * t;
            let fall = t * (0.55 + 0.45 * t);
            path.push([
                deg,
                rib.back_z - 4.0 + (rib.end_z - rib.back_z + 4.0) * fall,
            ]);
        }
        let mut shapes = band(cage, &path, rib.half_height, 0.46);
        let (side, forward) = around_deg(start_deg);
        let corner = cage.rim(rib.back_z - 4.0, side, forward, RIB_DEPTH_MM);
        let neck = [
            ([r - 1.0, y - r * 0.7, vertebra + 6.0], 4.6),
            ([30.0, y - r - 15.0, vertebra + 4.5], 4.4),
            (corner, 4.6),
        ];
        shapes.extend(curve(&neck).into_iter().map(Shape::both));
        ribs.join_all(2.0, shapes);
        if let Some([z, deg]) = rib.joint {
            let pieces = 6;
            let path: Vec<[f32; 2]> = (0..=pieces)
                .map(|piece| {
                    let t = piece as f32 / pieces as f32;
                    // The lower cartilages sag before they rise.
                    let sag = if i >= 5 {
                        8.0 * t * (1.0 - t) * 4.0 * 0.4
                    } else {
                        0.0
                    };
                    [
                        rib.end_deg + (deg - rib.end_deg) * t,
                        rib.end_z + (z - rib.end_z) * t - sag,
                    ]
                })
                .collect();
            cartilages.join_all(2.0, band(cage, &path, rib.half_height * 0.92, 0.5));
        }
    }
    (ribs, cartilages)
}

/// Breastbone: handle, body, sword.
pub(super) fn sternum(cage: &Profile) -> Field {
    let mut f = Field::default();
    let front = |z: f32| cage.rim(z, 0.0, 1.0, RIB_DEPTH_MM)[1];
    let mut shapes = Vec::new();
    let rows = [
        (147.0, 25.0),
        (138.0, 29.0),
        (126.0, 24.0),
        (112.0, 17.0),
        (104.0, 17.5),
        (86.0, 16.0),
        (66.0, 17.5),
        (46.0, 19.0),
        (28.0, 19.0),
        (14.0, 15.0),
        (4.0, 8.0),
        (-14.0, 5.5),
        (-26.0, 3.5),
    ];
    for pair in rows.windows(2) {
        let ((z0, w0), (z1, w1)) = (pair[0], pair[1]);
        let (z, w) = (0.5 * (z0 + z1), 0.5 * (w0 + w1));
        let thick = if z < 8.0 { 3.0 } else { 5.6 };
        let tilt = (front(z0) - front(z1)) / (z0 - z1) * 57.3;
        shapes.push(
            cuboid(
                [0.0, front(z), z],
                [w, thick, 0.5 * (z0 - z1) + 3.0],
                2.6f32.min(thick - 0.2),
            )
            .turned(-tilt, 0.0, 0.0),
        );
    }
    for shape in shapes {
        f.join(5.0, shape);
    }
    // The notch above and the angle between handle and body.
    f.carve(3.0, ball([0.0, front(152.0), 158.0], 12.0));
    f
}

pub(super) fn clavicles() -> Field {
    let mut f = Field::default();
    f.join_all(
        0.0,
        curve(&[
            ([17.0, 47.0, 148.0], 9.0),
            ([36.0, 48.0, 152.0], 6.8),
            ([66.0, 40.0, 156.0], 6.0),
            ([98.0, 16.0, 159.0], 6.2),
            ([124.0, -8.0, 160.0], 7.0),
            ([148.0, -20.0, 160.0], 7.4),
        ])
        .into_iter()
        .map(Shape::both)
        .collect(),
    );
    f
}

pub(super) fn scapulae() -> Field {
    let mut f = Field::default();
    let normal = [0.56, -0.83, 0.05];
    let mut plate = |start: [f32; 3], end: [f32; 3], r0: f32, r1: f32, flat: f32| {
        f.join(3.0, strap(start, end, r0, r1, normal, flat).both());
    };
    // The plate between the inner border, the upper border and the outer border.
    plate([82.0, -92.0, 128.0], [98.0, -86.0, 38.0], 15.0, 9.0, 0.26);
    plate([96.0, -84.0, 124.0], [104.0, -80.0, 62.0], 18.0, 14.0, 0.18);
    plate(
        [110.0, -74.0, 124.0],
        [112.0, -74.0, 84.0],
        17.0,
        14.0,
        0.18,
    );
    plate([98.0, -86.0, 36.0], [136.0, -52.0, 116.0], 8.0, 10.0, 0.62);
    plate([84.0, -92.0, 140.0], [126.0, -62.0, 142.0], 6.0, 8.0, 0.4);
    // Socket, spine, roof of the shoulder, the beak.
    f.join(
        5.0,
        ellipsoid([139.0, -42.0, 126.0], [9.0, 12.0, 17.0]).both(),
    );
    f.join(
        3.0,
        strap(
            [80.0, -97.0, 122.0],
            [132.0, -80.0, 146.0],
            5.0,
            11.0,
            [0.0, 0.35, 1.0],
            0.42,
        )
        .both(),
    );
    f.join_all(
        3.0,
        curve(&[
            ([130.0, -82.0, 147.0], 7.0),
            ([150.0, -64.0, 154.0], 8.0),
            ([164.0, -38.0, 158.0], 8.0),
            ([156.0, -20.0, 159.0], 6.5),
        ])
        .into_iter()
        .map(Shape::both)
        .collect(),
    );
    f.join_all(
        3.0,
        curve(&[
            ([132.0, -44.0, 140.0], 7.0),
            ([130.0, -26.0, 150.0], 6.0),
            ([138.0, -8.0, 142.0], 5.5),
        ])
        .into_iter()
        .map(Shape::both)
        .collect(),
    );
    f
}

pub(super) fn humeri() -> Field {
    let mut f = Field::default();
    f.join(0.0, ball([163.0, -36.0, 128.0], 23.0).both());
    f.join(
        6.0,
        ellipsoid([174.0, -24.0, 124.0], [14.0, 14.0, 18.0]).both(),
    );
    f.join(
        10.0,
        capsule([172.0, -32.0, 112.0], [214.0, -30.0, 34.0], 16.0, 13.0).both(),
    );
    f
}

/// Wings of the hip bones, and the sacrum.
pub(super) fn pelvis() -> Field {
    let mut f = Field::default();
    let mut wing =
        |start: [f32; 3], end: [f32; 3], r0: f32, r1: f32, normal: [f32; 3], flat: f32| {
            f.join(5.0, strap(start, end, r0, r1, normal, flat).both());
        };
    wing(
        [56.0, -78.0, -264.0],
        [102.0, -44.0, -262.0],
        34.0,
        46.0,
        [0.6, -0.8, 0.25],
        0.13,
    );
    wing(
        [100.0, -46.0, -262.0],
        [124.0, 8.0, -268.0],
        46.0,
        38.0,
        [0.9, -0.35, 0.25],
        0.12,
    );
    wing(
        [54.0, -78.0, -276.0],
        [96.0, -40.0, -300.0],
        30.0,
        40.0,
        [0.6, -0.8, 0.0],
        0.2,
    );
    f.join_all(
        5.0,
        curve(&[
            ([44.0, -92.0, -268.0], 8.5),
            ([58.0, -84.0, -238.0], 8.0),
            ([86.0, -62.0, -216.0], 7.0),
            ([112.0, -32.0, -210.0], 7.6),
            ([127.0, 4.0, -222.0], 8.0),
            ([128.0, 34.0, -246.0], 7.0),
            ([122.0, 48.0, -266.0], 8.0),
            ([112.0, 46.0, -290.0], 9.0),
        ])
        .into_iter()
        .map(Shape::both)
        .collect(),
    );
    // The sacrum's wings.
    f.join(
        6.0,
        ellipsoid([30.0, -64.0, -284.0], [30.0, 20.0, 26.0]).both(),
    );
    f.join(6.0, ellipsoid([0.0, -60.0, -290.0], [28.0, 20.0, 24.0]));
    f
}
