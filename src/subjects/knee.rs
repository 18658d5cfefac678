//! A right knee, almost straight: bones with cartilage and menisci, ligaments, muscles, vessels, nerves, skin.
//!
//! Millimetres about the middle of the joint: x to the patient's right (lateral), y anterior, z up.

use glam::Vec3;

use super::lanes::Lanes;
use super::limb::{Cord, inner_width, lay_bone, lay_skin, near, parted};
use super::paint::{
    Block, Canvas, Model, Passage, ROWS, Revision, SegmentSpec, border_width, segment,
};
use super::shape::{Field, Knot, Places, Shape, ball, capsule, curve, ellipsoid, strap};

const SEGMENTS: &[SegmentSpec] = &[
    segment("skin", [226, 176, 148]),
    segment("fat", [240, 209, 128]),
    segment("muscle", [165, 68, 58]),
    segment("femur", [236, 224, 196]),
    segment("tibia", [230, 216, 184]),
    segment("fibula", [224, 208, 176]),
    segment("patella", [242, 232, 208]),
    segment("cartilage", [190, 208, 214]),
    segment("menisci", [150, 186, 176]),
    segment("ligaments", [214, 214, 200]),
    segment("tendons", [228, 224, 214]),
    segment("joint fluid", [226, 214, 130]),
    segment("arteries", [196, 44, 38]),
    segment("veins", [72, 90, 160]),
    segment("nerves", [236, 206, 90]),
];

/// Half the height that is shown.
const HALF_MM: f32 = 118.0;
/// How much larger muscles grow far from the joint, mm: until they meet.
const SWELL_MM: f32 = 9.0;

/// The knee's shapes, each as one field of distances in mm.
pub(super) struct Knee {
    skin: Field,
    muscles: Field,
    femur: Field,
    tibia: Field,
    fibula: Field,
    patella: Field,
    /// Where the ends of the bones wear cartilage.
    gliding: Field,
    menisci: Field,
    ligaments: Field,
    tendons: Field,
    capsule: Field,
    arteries: Field,
    veins: Field,
    nerves: Field,
    revision: Revision,
}

fn skin() -> Field {
    let mut f = Field::default();
    // Thigh, knee, calf.
    f.join(
        0.0,
        capsule([-2.0, -6.0, 210.0], [0.0, -4.0, -40.0], 77.0, 44.0),
    );
    f.join(34.0, ellipsoid([0.0, 0.0, 6.0], [50.0, 51.0, 76.0]));
    f.join(34.0, ellipsoid([1.0, -13.0, -88.0], [51.0, 48.0, 96.0]));
    f.join(
        34.0,
        capsule([2.0, -10.0, -60.0], [0.0, -4.0, -230.0], 46.0, 40.0),
    );
    // Kneecap, its tendon, the bump of the shin.
    f.raise(5.0, ellipsoid([0.0, 56.0, 18.0], [32.0, 30.0, 33.0]));
    f.raise(
        2.2,
        capsule([0.0, 52.0, -6.0], [1.0, 46.0, -40.0], 20.0, 18.0),
    );
    f.raise(2.4, ellipsoid([1.0, 44.0, -46.0], [24.0, 22.0, 22.0]));
    f.raise(-2.4, ellipsoid([27.0, 48.0, -4.0], [22.0, 24.0, 26.0]));
    f.raise(-2.4, ellipsoid([-27.0, 48.0, -4.0], [22.0, 24.0, 26.0]));
    f.raise(-2.0, ellipsoid([30.0, 46.0, 40.0], [24.0, 26.0, 30.0]));
    f.raise(4.5, ellipsoid([-34.0, 42.0, 58.0], [32.0, 32.0, 40.0]));
    f.raise(3.0, ellipsoid([34.0, 40.0, 92.0], [34.0, 32.0, 42.0]));
    // Hollow of the knee between the tendons; heads of the calf.
    f.raise(-4.0, ellipsoid([2.0, -56.0, 6.0], [30.0, 30.0, 50.0]));
    f.raise(
        2.5,
        capsule([-34.0, -36.0, 80.0], [-34.0, -32.0, -16.0], 22.0, 18.0),
    );
    f.raise(
        2.5,
        capsule([36.0, -34.0, 80.0], [38.0, -26.0, -14.0], 20.0, 17.0),
    );
    f.raise(4.0, ellipsoid([-22.0, -58.0, -84.0], [32.0, 30.0, 56.0]));
    f.raise(2.5, ellipsoid([24.0, -54.0, -76.0], [28.0, 28.0, 50.0]));
    f
}

fn femur() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        capsule([10.0, 8.0, 260.0], [3.0, 4.0, 48.0], 14.5, 17.0),
    );
    f.join(22.0, ellipsoid([0.0, 2.0, 32.0], [36.0, 19.0, 24.0]));
    // Condyles roll back; the groove for the kneecap lies before and between them.
    f.join(12.0, ellipsoid([-22.0, -6.0, 18.0], [13.5, 31.0, 19.0]));
    f.join(12.0, ellipsoid([22.0, -5.0, 19.0], [14.0, 31.5, 18.5]));
    f.join(12.0, ellipsoid([0.0, 17.0, 25.0], [27.0, 14.0, 20.0]));
    f.carve(7.0, capsule([0.0, 36.0, 44.0], [0.0, 30.0, 6.0], 7.0, 8.5));
    f.carve(
        6.0,
        capsule([0.0, 14.0, 2.0], [0.0, -34.0, 14.0], 7.5, 10.0),
    );
    f.join(6.0, ball([-35.0, -4.0, 32.0], 6.0));
    f.join(6.0, ball([35.0, -4.0, 31.0], 5.5));
    f
}

fn tibia() -> Field {
    let mut f = Field::default();
    f.join(
        0.0,
        capsule([2.0, -2.0, -50.0], [0.0, 2.0, -260.0], 18.0, 13.0),
    );
    f.join(18.0, ellipsoid([0.0, -4.0, -20.0], [38.5, 24.0, 15.0]));
    f.carve(3.0, ellipsoid([-21.0, -5.0, 19.0], [22.0, 30.0, 24.5]));
    f.carve(3.0, ellipsoid([21.0, -5.0, 20.5], [22.0, 30.0, 24.5]));
    f.join(
        4.0,
        capsule([-5.0, -3.0, -8.0], [-5.5, -4.0, -1.5], 4.0, 2.2),
    );
    f.join(4.0, capsule([5.0, -4.0, -8.0], [5.5, -5.0, -1.0], 4.0, 2.2));
    f.join(12.0, ellipsoid([2.0, 20.0, -42.0], [11.0, 9.0, 16.0]));
    f.join(
        10.0,
        capsule([1.0, 18.0, -50.0], [-1.0, 14.0, -200.0], 5.0, 4.0),
    );
    f
}

fn muscles() -> Field {
    let mut f = Field::default();
    let mut add = |shape: Shape| f.join(0.0, shape);
    // Quadriceps: straight, inner, outer, middle.
    add(strap(
        [4.0, 46.0, 220.0],
        [0.0, 36.0, 62.0],
        24.0,
        12.0,
        [0.0, 1.0, 0.0],
        0.55,
    ));
    add(capsule(
        [-34.0, 26.0, 220.0],
        [-26.0, 28.0, 44.0],
        26.0,
        14.0,
    ));
    add(capsule([42.0, 22.0, 220.0], [27.0, 30.0, 62.0], 27.0, 11.0));
    add(strap(
        [6.0, 28.0, 220.0],
        [0.0, 25.0, 70.0],
        24.0,
        14.0,
        [0.0, 1.0, 0.0],
        0.5,
    ));
    // Hamstrings and inner thigh.
    add(capsule(
        [34.0, -46.0, 220.0],
        [37.0, -28.0, 26.0],
        20.0,
        8.0,
    ));
    add(capsule(
        [-14.0, -54.0, 220.0],
        [-30.0, -38.0, 30.0],
        18.0,
        9.0,
    ));
    add(capsule(
        [-30.0, -40.0, 220.0],
        [-33.0, -31.0, 20.0],
        18.0,
        9.5,
    ));
    add(capsule(
        [-52.0, -12.0, 220.0],
        [-42.0, -22.0, 20.0],
        12.0,
        6.0,
    ));
    // Calf: two heads, soleus, popliteus, and the muscles of the shin.
    add(capsule(
        [-19.0, -34.0, 22.0],
        [-20.0, -46.0, -90.0],
        10.0,
        18.0,
    ));
    add(capsule(
        [20.0, -34.0, 22.0],
        [22.0, -44.0, -80.0],
        9.5,
        16.0,
    ));
    add(strap(
        [10.0, -28.0, -40.0],
        [2.0, -34.0, -220.0],
        24.0,
        30.0,
        [0.0, 1.0, 0.0],
        0.5,
    ));
    add(strap(
        [24.0, -24.0, 2.0],
        [-8.0, -24.0, -44.0],
        9.0,
        17.0,
        [0.0, 1.0, 0.0],
        0.38,
    ));
    add(capsule(
        [22.0, 14.0, -36.0],
        [14.0, 20.0, -220.0],
        9.0,
        15.0,
    ));
    add(capsule([36.0, 2.0, -44.0], [34.0, -2.0, -220.0], 7.0, 13.0));
    add(capsule(
        [16.0, -8.0, -70.0],
        [14.0, -10.0, -220.0],
        8.0,
        13.0,
    ));
    f
}

impl Knee {
    pub(super) fn new(revision: Revision) -> Self {
        let skin = skin();
        let tube = |f: &mut Field, knots: &[Knot]| f.join_all(0.0, curve(knots));
        let mut fibula = Field::default();
        fibula.join(
            0.0,
            capsule([35.0, -18.0, -36.0], [36.0, -14.0, -260.0], 6.0, 6.5),
        );
        fibula.join(5.0, ellipsoid([34.5, -18.5, -27.0], [9.0, 9.5, 11.0]));
        let mut patella = Field::default();
        patella.join(0.0, ellipsoid([0.0, 41.0, 20.0], [21.5, 9.5, 21.0]));
        patella.join(6.0, ellipsoid([0.0, 42.0, 4.0], [9.0, 6.5, 8.0]));
        patella.join(5.0, capsule([0.0, 35.0, 30.0], [0.0, 35.0, 10.0], 3.5, 3.5));
        let mut gliding = Field::default();
        gliding.join(0.0, ellipsoid([0.0, -4.0, 8.0], [42.0, 40.0, 26.0]));
        gliding.join(
            0.0,
            capsule([0.0, 32.0, 34.0], [0.0, 32.0, 8.0], 19.0, 17.0),
        );
        let mut menisci = Field::default();
        tube(
            &mut menisci,
            &[
                ([-7.0, 13.0, -5.0], 3.4),
                ([-24.0, 12.5, -4.0], 4.4),
                ([-33.0, -4.0, -3.5], 5.0),
                ([-25.0, -21.0, -3.0], 6.0),
                ([-8.0, -19.0, -5.0], 4.2),
            ],
        );
        tube(
            &mut menisci,
            &[
                ([7.0, 10.0, -5.0], 4.0),
                ([23.0, 12.0, -3.5], 4.8),
                ([32.5, -4.0, -3.0], 5.0),
                ([24.0, -20.0, -3.0], 5.4),
                ([8.0, -13.0, -5.0], 4.4),
            ],
        );
        let mut ligaments = Field::default();
        // Crossed pair, side ligaments, and the transverse one.
        ligaments.join(
            0.0,
            strap(
                [-1.0, 12.0, -6.0],
                [10.0, -17.0, 16.0],
                5.0,
                5.5,
                [0.8, 0.0, -0.5],
                0.7,
            ),
        );
        ligaments.join(
            0.0,
            strap(
                [0.0, -24.0, -9.0],
                [-9.0, 4.0, 12.0],
                5.8,
                5.8,
                [0.8, 0.0, 0.5],
                0.7,
            ),
        );
        ligaments.join_all(
            0.0,
            vec![
                strap(
                    [-38.5, -3.0, 33.0],
                    [-38.5, 2.0, -10.0],
                    8.0,
                    7.0,
                    [1.0, 0.0, 0.0],
                    0.24,
                ),
                strap(
                    [-38.5, 2.0, -10.0],
                    [-27.0, 8.0, -54.0],
                    7.0,
                    6.0,
                    [1.0, 0.4, 0.0],
                    0.24,
                ),
            ],
        );
        tube(
            &mut ligaments,
            &[
                ([38.0, -4.0, 31.0], 2.8),
                ([40.0, -11.0, 4.0], 2.6),
                ([38.0, -17.0, -22.0], 2.8),
            ],
        );
        tube(
            &mut ligaments,
            &[
                ([-14.0, 17.0, -4.5], 1.5),
                ([0.0, 20.0, -4.5], 1.5),
                ([14.0, 17.0, -4.5], 1.5),
            ],
        );
        let mut tendons = Field::default();
        tendons.join(
            0.0,
            strap(
                [0.0, 40.0, 76.0],
                [0.0, 46.0, 38.0],
                13.0,
                18.0,
                [0.0, 1.0, 0.0],
                0.22,
            ),
        );
        tendons.join(
            0.0,
            strap(
                [0.0, 46.0, 4.0],
                [1.5, 31.0, -42.0],
                13.0,
                11.0,
                [0.0, 1.0, 0.3],
                0.24,
            ),
        );
        tube(
            &mut tendons,
            &[
                ([-30.0, -40.0, 40.0], 2.8),
                ([-37.0, -34.0, 6.0], 2.6),
                ([-32.0, -12.0, -34.0], 2.6),
                ([-20.0, 12.0, -54.0], 3.0),
            ],
        );
        tube(
            &mut tendons,
            &[
                ([38.0, -30.0, 40.0], 3.6),
                ([41.0, -25.0, 8.0], 3.4),
                ([38.0, -20.0, -20.0], 3.6),
            ],
        );
        // The band of the outer thigh.
        let band = [[55.0, 4.0, 124.0], [46.0, 5.0, 40.0], [33.0, 15.0, -19.0]];
        for (pair, radius) in band.windows(2).zip([10.0, 9.0]) {
            tendons.join(
                2.0,
                strap(
                    pair[0],
                    pair[1],
                    radius,
                    radius - 2.0,
                    [1.0, 0.2, 0.0],
                    0.22,
                ),
            );
        }
        let mut bag = Field::default();
        bag.join(0.0, ellipsoid([0.0, -2.0, 6.0], [39.0, 31.0, 14.0]));
        bag.join(
            10.0,
            strap(
                [0.0, 29.0, 60.0],
                [0.0, 26.0, 6.0],
                20.0,
                24.0,
                [0.0, 1.0, 0.0],
                0.3,
            ),
        );
        let (mut arteries, mut veins, mut nerves) =
            (Field::default(), Field::default(), Field::default());
        tube(
            &mut arteries,
            &[
                ([-22.0, -20.0, 130.0], 4.2),
                ([-6.0, -32.0, 60.0], 4.2),
                ([2.0, -37.0, 20.0], 4.0),
                ([2.0, -36.0, -24.0], 3.8),
                ([6.0, -30.0, -54.0], 3.0),
                ([4.0, -28.0, -130.0], 2.6),
            ],
        );
        tube(
            &mut arteries,
            &[
                ([6.0, -30.0, -50.0], 2.4),
                ([14.0, -12.0, -58.0], 2.2),
                ([16.0, 0.0, -80.0], 2.2),
                ([14.0, 2.0, -130.0], 2.0),
            ],
        );
        for side in [-1.0, 1.0] {
            tube(
                &mut arteries,
                &[
                    ([side * 3.0, -35.0, 44.0], 1.7),
                    ([side * 34.0, -14.0, 48.0], 1.5),
                    ([side * 34.0, 16.0, 42.0], 1.3),
                    ([side * 22.0, 42.0, 32.0], 1.1),
                ],
            );
            tube(
                &mut arteries,
                &[
                    ([side * 3.0, -36.0, -8.0], 1.6),
                    ([side * 36.0, -16.0, -24.0], 1.4),
                    ([side * 34.0, 14.0, -20.0], 1.2),
                    ([side * 18.0, 40.0, -2.0], 1.0),
                ],
            );
        }
        tube(
            &mut veins,
            &[
                ([-18.0, -28.0, 130.0], 5.0),
                ([-2.0, -40.0, 60.0], 5.0),
                ([5.0, -44.0, 20.0], 4.8),
                ([5.0, -43.0, -24.0], 4.4),
                ([10.0, -36.0, -60.0], 3.4),
                ([9.0, -34.0, -130.0], 3.2),
            ],
        );
        let great = [
            [-52.0, -8.0, 116.0],
            [-50.0, -22.0, 50.0],
            [-50.0, -26.0, 0.0],
            [-46.0, -6.0, -50.0],
            [-40.0, 6.0, -116.0],
        ]
        .map(|p| (skin.pull(p, -6.0), 2.2));
        tube(&mut veins, &great);
        // The short one under the skin opens into the deep one past the nerve; in the first revision it ran into the
        // nerve.
        let [opening, bend]: [Knot; 2] = match revision {
            Revision::First => [([5.0, -44.0, 8.0], 2.2), ([6.0, -56.0, -10.0], 2.2)],
            Revision::Second => [([0.0, -45.0, 10.0], 2.2), ([-2.0, -55.0, -6.0], 2.2)],
        };
        tube(
            &mut veins,
            &[
                opening,
                bend,
                ([6.0, -64.0, -60.0], 2.0),
                ([6.0, -66.0, -130.0], 1.8),
            ],
        );
        tube(
            &mut nerves,
            &[
                ([6.0, -40.0, 130.0], 5.0),
                ([8.0, -46.0, 80.0], 4.6),
                ([7.0, -50.0, 30.0], 3.6),
                ([5.0, -49.0, -20.0], 3.4),
                ([7.0, -36.0, -64.0], 3.0),
                ([6.0, -32.0, -130.0], 2.8),
            ],
        );
        tube(
            &mut nerves,
            &[
                ([8.0, -46.0, 80.0], 3.4),
                ([26.0, -42.0, 36.0], 3.0),
                ([38.0, -34.0, -6.0], 2.8),
                ([44.0, -18.0, -40.0], 2.6),
                ([36.0, -4.0, -62.0], 2.4),
                ([28.0, 4.0, -130.0], 2.0),
            ],
        );
        Self {
            revision,
            skin,
            muscles: muscles(),
            femur: femur(),
            tibia: tibia(),
            fibula,
            patella,
            gliding,
            menisci,
            ligaments,
            tendons,
            capsule: bag,
            arteries,
            veins,
            nerves,
        }
    }
}

impl Model for Knee {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (
            Vec3::new(-80.0, -84.0, -HALF_MM - 3.0),
            Vec3::new(80.0, 80.0, HALF_MM + 3.0),
        )
    }

    fn segments(&self) -> &'static [SegmentSpec] {
        SEGMENTS
    }

    fn value_range(&self) -> [f32; 2] {
        [-1000.0, 1400.0]
    }

    fn passage(&self) -> Passage {
        self.revision.passage()
    }

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let skin = near(&self.skin, block, 12.0);
        if skin.is_empty() {
            return;
        }
        let muscles = near(&self.muscles, block, 7.0 + SWELL_MM);
        let bones = [
            (near(&self.femur, block, 6.0), 4),
            (near(&self.tibia, block, 6.0), 5),
            (near(&self.fibula, block, 4.0), 6),
            (near(&self.patella, block, 6.0), 7),
        ];
        let gliding = near(&self.gliding, block, 1.0);
        let menisci = near(&self.menisci, block, 1.0);
        let bag = Cord::new(&self.capsule, (block, 0.0), 12.0, 12, 5.0);
        let least = self.revision.least_mm(block, self.bounds_mm());
        let thick = (block, least);
        let mut cords = [
            Cord::new(&self.veins, thick, 160.0, 14, 3.0),
            Cord::new(&self.arteries, thick, 230.0, 13, 3.0),
            Cord::new(&self.nerves, thick, 32.0, 15, 3.0),
            // The small arteries about the joint pass under its ligaments.
            Cord::new(&self.ligaments, thick, 95.0, 10, 4.0),
            Cord::new(&self.tendons, thick, 90.0, 11, 3.0),
        ];
        if self.revision == Revision::Second {
            // Some ran into a ligament: through it they stay whole.
            cords.rotate_left(3);
        }
        let (width, soft) = (border_width(block.spacing), inner_width(block));
        let flat = Lanes::splat;
        for row in 0..ROWS {
            let p = Places::new(block.row(row));
            let s = skin.distance(&p);
            if s.lowest() > width {
                continue;
            }
            lay_skin(out, row, block, s, 2.2, [1, 2]);
            if !muscles.is_empty() {
                // Away from the joint they swell until a thin layer of fat is left between them.
                let swell = ((p.plain.z.abs() - 40.0) * (1.0 / 40.0)).clamp(0.0, 1.0);
                let d = parted(muscles.two_nearest(&p), 2.5 + SWELL_MM * swell[0], 1.2);
                out.lay(row, d.max(s + 6.5), soft, flat(55.0), 3);
            }
            bag.lay(out, row, block, &p, s);
            // Cartilage is the outermost layer of a bone where another glides on it.
            let joint = if gliding.is_empty() {
                flat(1e3)
            } else {
                gliding.distance(&p)
            };
            for (field, label) in &bones {
                if field.is_empty() {
                    continue;
                }
                let d = field.distance(&p).max(s + 4.0);
                if *label != 6 {
                    out.lay(row, (d - 0.8).max(joint), soft, flat(110.0), 8);
                }
                // Under the cartilage bone begins deeper.
                let covered = (joint * -0.5).clamp(0.0, 1.0) * if *label == 6 { 0.0 } else { 1.8 };
                let d = d + covered;
                let shaft = ((p.plain.z.abs() - 45.0) * 0.03).clamp(0.0, 1.0);
                let compact = shaft * 3.2 + 1.3;
                let inside = flat(380.0).mix(flat(60.0), shaft);
                lay_bone(out, row, block, d, compact, [flat(1250.0), inside], *label);
            }
            if !menisci.is_empty() {
                // A meniscus fills the wedge between the bones.
                let mut d = menisci.distance(&p).max(s + 5.0);
                for (bone, _) in &bones[..2] {
                    if !bone.is_empty() {
                        d = d.max(flat(0.9) - bone.distance(&p));
                    }
                }
                out.lay(row, d, soft, flat(90.0), 9);
            }
            for cord in &cords {
                cord.lay(out, row, block, &p, s);
            }
            let ends = flat(HALF_MM) - p.plain.z.abs();
            out.lay(row, ends, width, flat(-1000.0), 0);
        }
    }
}
