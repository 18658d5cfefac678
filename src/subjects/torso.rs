//! A torso from the root of the neck to the hips: wall, frame, and all that chest and belly hold, in CT-like values.
//!
//! Millimetres: x to the patient's right, y anterior, z up; z = 0 at the lower end of the breastbone's body. The arms
//! are cut off beside the shoulders.

use glam::Vec3;

use super::lanes::{LANES, Lanes, Points};
use super::paint::{
    Block, Canvas, Model, Passage, ROWS, Revision, SegmentSpec, border_width, segment,
};
use super::profile::Profile;
use super::shape::{Field, Near, Places};
use super::torso_belly::{self, Kidneys};
use super::torso_chest::{self, Heart};
use super::torso_frame::{self, Spine};
use super::torso_lungs::{self, Tree};
use super::torso_wall::{self, ARM_END_MM, BOTTOM_MM, Outside, TOP_MM};

/// Segments of the torso; the number of each is its label.
#[derive(Clone, Copy)]
#[repr(u8)]
enum Tissue {
    Skin = 1,
    Fat,
    Muscle,
    Tendons,
    Ribs,
    Cartilage,
    Sternum,
    Clavicles,
    Scapulae,
    Humeri,
    Spine,
    Discs,
    Pelvis,
    Lungs,
    Bronchi,
    Heart,
    Arteries,
    Veins,
    Diaphragm,
    Liver,
    Gallbladder,
    Oesophagus,
    Stomach,
    Bowel,
    Colon,
    Contents,
    Spleen,
    Pancreas,
    Kidneys,
    Ureters,
    Glands,
    Nerves,
    Air,
}

const SEGMENTS: &[SegmentSpec] = &[
    segment("skin", [226, 176, 148]),
    segment("fat", [240, 209, 128]),
    segment("muscle", [165, 68, 58]),
    segment("tendons", [228, 222, 208]),
    segment("ribs", [238, 227, 200]),
    segment("cartilage", [188, 208, 216]),
    segment("sternum", [232, 216, 184]),
    segment("clavicles", [236, 222, 190]),
    segment("scapulae", [230, 216, 188]),
    segment("humeri", [234, 220, 190]),
    segment("spine", [240, 228, 198]),
    segment("discs", [168, 196, 206]),
    segment("pelvis", [234, 220, 188]),
    segment("lungs", [226, 158, 158]),
    segment("bronchi", [206, 214, 206]),
    segment("heart", [172, 52, 48]),
    segment("arteries", [200, 40, 36]),
    segment("veins", [70, 88, 164]),
    segment("diaphragm", [186, 92, 76]),
    segment("liver", [134, 60, 44]),
    segment("gallbladder", [92, 136, 74]),
    segment("oesophagus", [206, 138, 116]),
    segment("stomach", [222, 150, 122]),
    segment("bowel", [236, 174, 152]),
    segment("colon", [206, 146, 104]),
    segment("contents", [176, 150, 92]),
    segment("spleen", [122, 52, 78]),
    segment("pancreas", [228, 186, 112]),
    segment("kidneys", [152, 62, 54]),
    segment("ureters", [232, 206, 120]),
    segment("glands", [196, 108, 92]),
    segment("nerves", [238, 212, 104]),
    segment("air", [214, 146, 130]),
];

/// The torso's shapes: outlines by height, and fields of distances in mm.
pub(super) struct Torso {
    trunk: Profile,
    skin: Field,
    cavity: Profile,
    relief: Field,
    sheets: Field,
    deep_muscles: Field,
    spine: Spine,
    ribs: Field,
    cartilages: Field,
    sternum: Field,
    clavicles: Field,
    scapulae: Field,
    humeri: Field,
    pelvis: Field,
    mediastinum: Field,
    heart: Heart,
    windpipe: Field,
    windpipe_air: Field,
    lung_bronchi: Field,
    lung_arteries: Field,
    lung_veins: Field,
    gullet: Field,
    glands: Field,
    chest_arteries: Field,
    chest_veins: Field,
    dome: Field,
    liver: Field,
    band: Field,
    gallbladder: Field,
    stomach: [Field; 2],
    duodenum: [Field; 2],
    bowel: [Field; 2],
    colon: Field,
    pancreas: Field,
    spleen: Field,
    kidneys: Kidneys,
    belly_arteries: Field,
    belly_veins: Field,
    revision: Revision,
}

/// What lies between the lungs.
fn mediastinum() -> Field {
    use super::shape::{capsule, curve, ellipsoid};
    let mut f = Field::default();
    let knots: Vec<_> = [
        -130.0f32, -80.0, -30.0, 20.0, 60.0, 100.0, 140.0, 180.0, 220.0,
    ]
    .map(|z| ([0.0, torso_frame::spine_y(z) - 6.0, z], 27.0))
    .to_vec();
    f.join_all(0.0, curve(&knots));
    f.join(
        14.0,
        ellipsoid([-20.0, 28.0, 30.0], [60.0, 46.0, 46.0]).turned(0.0, 30.0, 24.0),
    );
    f.join(14.0, ellipsoid([14.0, 10.0, 40.0], [52.0, 44.0, 48.0]));
    // Before the heart, most on the left, the lungs give way up to the breastbone.
    f.join(
        14.0,
        ellipsoid([-26.0, 66.0, 18.0], [60.0, 42.0, 46.0]).turned(0.0, 18.0, 0.0),
    );
    f.join(
        12.0,
        capsule([0.0, 70.0, 60.0], [0.0, 50.0, 130.0], 14.0, 14.0),
    );
    f.join(
        16.0,
        capsule([2.0, 10.0, 90.0], [2.0, 10.0, 200.0], 34.0, 26.0),
    );
    f.join(
        12.0,
        capsule([0.0, -20.0, 60.0], [0.0, -24.0, 130.0], 34.0, 28.0),
    );
    f
}

impl Torso {
    pub(super) fn new(revision: Revision) -> Self {
        let cavity = torso_frame::cavity();
        let (ribs, cartilages) = torso_frame::ribs(&cavity);
        let [lung_bronchi, lung_arteries, lung_veins] = torso_chest::lung_trees();
        let (chest_arteries, chest_veins) = torso_chest::vessels(revision);
        let (belly_arteries, belly_veins) = torso_belly::vessels(revision);
        let colon = torso_belly::colon();
        let outside = Outside::new();
        let bowel = torso_belly::small_bowel(&cavity);
        let mut torso = Self {
            relief: outside.muscle_relief(),
            sheets: outside.sheets(),
            deep_muscles: torso_wall::deep_muscles(),
            spine: torso_frame::spine(revision),
            sternum: torso_frame::sternum(&cavity),
            clavicles: torso_frame::clavicles(),
            scapulae: torso_frame::scapulae(),
            humeri: torso_frame::humeri(),
            pelvis: torso_frame::pelvis(),
            mediastinum: mediastinum(),
            heart: torso_chest::heart(revision),
            windpipe: torso_chest::windpipe(0.0),
            windpipe_air: torso_chest::windpipe(match revision {
                Revision::First => 2.4,
                Revision::Second => 3.0,
            }),
            gullet: torso_chest::gullet(),
            glands: torso_chest::glands(),
            dome: torso_belly::dome(),
            liver: torso_belly::liver(),
            band: torso_belly::band_of_liver(),
            gallbladder: torso_belly::gallbladder(),
            stomach: [torso_belly::stomach(0.0), torso_belly::stomach(4.0)],
            duodenum: [torso_belly::duodenum(0.0), torso_belly::duodenum(3.0)],
            bowel: [
                torso_belly::tube(&bowel, 0.0),
                torso_belly::tube(&bowel, 3.0),
            ],
            pancreas: torso_belly::pancreas(),
            spleen: torso_belly::spleen(),
            kidneys: torso_belly::kidneys(revision),
            trunk: outside.trunk,
            skin: outside.skin,
            cavity,
            ribs,
            cartilages,
            lung_bronchi,
            lung_arteries,
            lung_veins,
            chest_arteries,
            chest_veins,
            colon,
            belly_arteries,
            belly_veins,
            revision,
        };
        if revision == Revision::Second {
            torso.grow_lung_trees();
        }
        torso
    }

    /// Lets the trees of the lungs grow where they have room.
    fn grow_lung_trees(&mut self) {
        let [mediastinum, heart, dome, windpipe, arteries, veins, gullet] = [
            &self.mediastinum,
            &self.heart.body,
            &self.dome,
            &self.windpipe,
            &self.chest_arteries,
            &self.chest_veins,
            &self.gullet,
        ]
        .map(Field::everywhere);
        let lung = |p: &Places| {
            let beat = heart.distance(p);
            let c = self.cavity_distance(p);
            let under = dome.distance(p).max(Lanes::splat(3.5) - beat);
            lung_of(p, [c, under, beat, mediastinum.distance(p)])
        };
        let taken = |p: &Places, tree: Tree| {
            let others = match tree {
                Tree::Bronchi => arteries.distance(p).min(veins.distance(p)),
                // The lung artery carries spent blood, the lung veins fresh.
                Tree::Arteries => arteries.distance(p).min(windpipe.distance(p)),
                Tree::Veins => veins.distance(p).min(windpipe.distance(p)),
            };
            others.min(heart.distance(p)).min(gullet.distance(p))
        };
        let branches = torso_lungs::grow(&lung, &taken);
        let field = |shapes| {
            let mut field = Field::default();
            field.join_all(0.0, shapes);
            field
        };
        let [bronchi, arteries, veins] = [Tree::Bronchi, Tree::Arteries, Tree::Veins]
            .map(|tree| field(torso_lungs::tubes(&branches, tree)));
        (self.lung_bronchi, self.lung_arteries, self.lung_veins) = (bronchi, arteries, veins);
    }

    /// Distance from the outside of the cavity of chest and belly, whose top is closed.
    fn cavity_distance(&self, p: &Places) -> Lanes {
        // A profile takes the height of the first point for all eight.
        let mut c = Lanes::splat(0.0);
        for i in 0..LANES {
            let one = |of: &Lanes| Lanes::splat(of[i]);
            let point = Points {
                x: one(&p.plain.x),
                y: one(&p.plain.y),
                z: one(&p.plain.z),
            };
            c[i] = self.cavity.distance(&point)[0].max(p.plain.z[i] - 184.0);
        }
        c
    }
}

/// Distance from the outside of the lungs, from those from the cavity, from what lies under the diaphragm, from the
/// heart and from what lies between the lungs.
#[inline(always)]
fn lung_of(p: &Places, [c, under, beat, mediastinum]: [Lanes; 4]) -> Lanes {
    (c + 1.2)
        .max(Lanes::splat(4.2) - under)
        .max(-mediastinum)
        .max(Lanes::splat(2.5) - beat)
        .max(Lanes::splat(-80.0) - p.plain.z)
}

/// The fields of one block, cut down to what matters there.
struct Layer<'a>(Near<'a>);

impl Layer<'_> {
    /// Signed distance, or nothing if the field is far from the block.
    #[inline(always)]
    fn at(&self, p: &Places) -> Option<Lanes> {
        if self.0.is_empty() {
            return None;
        }
        Some(self.0.distance(p))
    }

    /// Signed distance; far away, "far".
    #[inline(always)]
    fn or_far(&self, p: &Places) -> Lanes {
        self.at(p).unwrap_or(Lanes::splat(super::shape::FAR))
    }
}

impl Model for Torso {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (
            Vec3::new(-ARM_END_MM - 3.0, -128.0, BOTTOM_MM - 3.0),
            Vec3::new(ARM_END_MM + 3.0, 120.0, TOP_MM + 3.0),
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
        let width = border_width(block.spacing);
        let soft = 0.55 * width;
        let flat = Lanes::splat;
        let outside = self.skin.near_onto(block, 16.0 + width);
        let mut depths = [flat(1e3); ROWS];
        let mut deepest = f32::INFINITY;
        for (row, depth) in depths.iter_mut().enumerate() {
            let p = Places::new(block.row(row));
            *depth = outside.onto(&p, self.trunk.distance(&p.plain));
            deepest = deepest.min(depth.lowest());
        }
        if deepest > 1.4 * width {
            return;
        }
        let near = |field, band: f32| {
            let mut near = Near::default();
            Field::near(field, block, band + width, &mut near);
            Layer(near)
        };
        let least = self.revision.least_mm(block, self.bounds_mm());
        // What is thinner than a voxel in places.
        let cord = |field, band: f32| {
            let mut near = Near::default();
            Field::near_thick(field, block, band + width, least, &mut near);
            Layer(near)
        };
        let relief = self.relief.near_onto(block, 0.0);
        let sheets = near(&self.sheets, 0.0);
        let deep_muscles = near(&self.deep_muscles, 5.0);
        let bones = [
            (near(&self.ribs, 3.0), Tissue::Ribs, 1.3),
            (near(&self.scapulae, 3.0), Tissue::Scapulae, 1.3),
            (near(&self.sternum, 3.0), Tissue::Sternum, 1.2),
            (near(&self.clavicles, 3.0), Tissue::Clavicles, 1.8),
            (near(&self.humeri, 3.0), Tissue::Humeri, 2.4),
            (near(&self.pelvis, 3.0), Tissue::Pelvis, 1.6),
            (near(&self.spine.bones, 3.0), Tissue::Spine, 1.3),
        ];
        let cartilages = near(&self.cartilages, 1.0);
        let [discs, canal, spinal_cord] =
            [&self.spine.discs, &self.spine.canal, &self.spine.cord].map(|field| near(field, 1.0));
        let roots = cord(&self.spine.roots, 1.0);
        let mediastinum = near(&self.mediastinum, 6.0);
        let heart = near(&self.heart.body, 6.0);
        let [heart_left, heart_right, grooves] = [
            &self.heart.left_rooms,
            &self.heart.right_rooms,
            &self.heart.grooves,
        ]
        .map(|field| near(field, 1.0));
        let [heart_arteries, heart_veins] =
            [&self.heart.arteries, &self.heart.veins].map(|field| cord(field, 1.0));
        let [windpipe, windpipe_air, gullet, glands] = [
            &self.windpipe,
            &self.windpipe_air,
            &self.gullet,
            &self.glands,
        ]
        .map(|field| near(field, 2.0));
        let [lung_bronchi, lung_arteries, lung_veins] =
            [&self.lung_bronchi, &self.lung_arteries, &self.lung_veins]
                .map(|field| cord(field, 1.0));
        let lung_trees = [
            (lung_bronchi, -250.0, Tissue::Bronchi),
            (lung_veins, 60.0, Tissue::Arteries),
            (lung_arteries, 60.0, Tissue::Veins),
        ];
        // Trees cut off by the lungs, and those that go on to their roots: the bronchi lie before the vessels there.
        type Tubes<'a> = &'a [(Layer<'a>, f32, Tissue)];
        let (cut_off, behind, before): (Tubes<'_>, Tubes<'_>, Tubes<'_>) = match self.revision {
            Revision::First => (&lung_trees, &[], &[]),
            Revision::Second => (&[], &lung_trees[1..], &lung_trees[..1]),
        };
        let dome = near(&self.dome, 30.0);
        let [liver, band, gallbladder, pancreas, spleen] = [
            &self.liver,
            &self.band,
            &self.gallbladder,
            &self.pancreas,
            &self.spleen,
        ]
        .map(|field| near(field, 3.0));
        let tubes = [
            (
                near(&self.duodenum[0], 2.0),
                near(&self.duodenum[1], 2.0),
                Tissue::Bowel,
            ),
            (
                near(&self.stomach[0], 2.0),
                near(&self.stomach[1], 2.0),
                Tissue::Stomach,
            ),
            (
                near(&self.bowel[0], 2.0),
                near(&self.bowel[1], 2.0),
                Tissue::Bowel,
            ),
        ];
        let colon = near(&self.colon, 4.0);
        let [kidneys, pyramids, sinus, adrenals] = [
            &self.kidneys.body,
            &self.kidneys.pyramids,
            &self.kidneys.sinus,
            &self.kidneys.adrenals,
        ]
        .map(|field| near(field, 3.0));
        let ureters = cord(&self.kidneys.ureters, 3.0);
        let vessels = [
            (cord(&self.belly_veins, 1.0), 160.0, Tissue::Veins),
            (cord(&self.chest_veins, 1.0), 160.0, Tissue::Veins),
            (cord(&self.belly_arteries, 1.0), 230.0, Tissue::Arteries),
            (cord(&self.chest_arteries, 1.0), 230.0, Tissue::Arteries),
        ];
        let thickness = 2.3f32.max(0.9 * block.spacing);

        for (row, &s) in depths.iter().enumerate() {
            if s.lowest() > 1.4 * width {
                continue;
            }
            let p = Places::new(block.row(row));
            let z = p.plain.z[0];
            // Lungs are nearly air, so the surface of the picture lies low on the slope that leads out of the air: a
            // wide one keeps it off the bend at its foot, where it would be terraced.
            out.lay(row, s, 1.4 * width, flat(30.0), Tissue::Skin as u8);
            let mut lay = |d: Lanes, value: f32, tissue: Tissue| {
                if d.lowest() < width {
                    out.lay(row, d, soft, flat(value), tissue as u8);
                }
            };
            lay(s + thickness, -100.0, Tissue::Fat);
            if s.lowest() < -2.0 {
                let c = self.cavity.distance(&p.plain).max(p.plain.z - 184.0);
                // The wall: muscle from the fat under the skin to the cavity, parted over the ribs by a thin layer of
                // fat.
                let m = relief.onto(&p, s + (thickness + torso_wall::fat_mm(z)));
                lay(m, 55.0, Tissue::Muscle);
                if z > -70.0 {
                    let plane = (c - 14.5).abs() - 0.9;
                    lay(plane.max(m + 4.0), -90.0, Tissue::Fat);
                }
                if let Some(d) = sheets.at(&p) {
                    lay(d.max((m + 0.4).abs() - 1.8), 90.0, Tissue::Tendons);
                }
                lay(c, -95.0, Tissue::Fat);
                if !deep_muscles.0.is_empty() {
                    let (first, second) = deep_muscles.0.two_nearest(&p);
                    lay((first - 1.4).max(m + 2.0), -90.0, Tissue::Fat);
                    let d = first.max(flat(1.0) - (second - first));
                    lay(d.max(m + 2.0), 55.0, Tissue::Muscle);
                }
                let beat = heart.or_far(&p);
                let under = dome.or_far(&p).max(flat(3.5) - beat);

                // Diaphragm, and where it lies against the wall below the lungs.
                let sheet = (under - 1.5).abs() - 2.0;
                lay(
                    sheet.max(c - 1.0).max(flat(-96.0) - p.plain.z),
                    52.0,
                    Tissue::Diaphragm,
                );
                if z < -20.0 && z > -110.0 {
                    let recess = c.max(-under).max(p.plain.z + 24.0);
                    lay(recess, 52.0, Tissue::Diaphragm);
                }

                // Lungs.
                if z > -90.0 {
                    let lung = lung_of(&p, [c, under, beat, mediastinum.or_far(&p)]);
                    if lung.lowest() < width {
                        lay(lung, -600.0, Tissue::Lungs);
                        // Fissures: one oblique in each, one level in the right.
                        let oblique = p.plain.y * 0.687 + p.plain.z * 0.727 - 30.4;
                        let level = (p.plain.z - 56.0 + p.plain.y * 0.1)
                            .abs()
                            .max(-oblique)
                            .max(-p.plain.x);
                        let fissure = oblique.abs().min(level) - 0.5 * block.spacing.max(1.8);
                        let shallow = flat(-5.0) - lung;
                        out.tone(row, fissure.max(shallow).max(lung - 2.0), soft, -1000.0);
                        for (tree, value, tissue) in cut_off {
                            if let Some(d) = tree.at(&p) {
                                let d = d.max(lung + 3.0);
                                out.lay(row, d, soft, flat(*value), *tissue as u8);
                                if matches!(tissue, Tissue::Bronchi) {
                                    out.lay(row, d + 1.5, soft, flat(-1000.0), Tissue::Air as u8);
                                }
                            }
                        }
                    }
                }
                let mut lay = |d: Lanes, value: f32, tissue: Tissue| {
                    if d.lowest() < soft {
                        out.lay(row, d, soft, flat(value), tissue as u8);
                    }
                };
                // An organ, in a thin coat of fat that parts it from its neighbours.
                let mut organ = |d: Lanes, value: f32, tissue: Tissue| {
                    lay(d - 1.3, -95.0, Tissue::Fat);
                    lay(d, value, tissue);
                };
                let below = (under + 2.2).max(c + 1.6);
                if let Some(d) = kidneys.at(&p) {
                    organ(d, 190.0, Tissue::Kidneys);
                    if let Some(e) = pyramids.at(&p) {
                        out.tone(row, e.max(d + 4.5), soft, 110.0);
                    }
                    let mut lay = |d: Lanes, value: f32, tissue: Tissue| {
                        out.lay(row, d, soft, flat(value), tissue as u8);
                    };
                    lay(sinus.or_far(&p), -90.0, Tissue::Fat);
                }
                let mut lay = |d: Lanes, value: f32, tissue: Tissue| {
                    if d.lowest() < soft {
                        out.lay(row, d, soft, flat(value), tissue as u8);
                    }
                };
                let ureters = ureters.at(&p);
                if let Some(d) = ureters {
                    lay(d.max(c), 60.0, Tissue::Ureters);
                }
                if let Some(d) = adrenals.at(&p) {
                    lay(d.max(below), 45.0, Tissue::Glands);
                }
                let mut organ = |d: Lanes, value: f32, tissue: Tissue| {
                    lay(d - 1.3, -95.0, Tissue::Fat);
                    lay(d, value, tissue);
                };
                if let Some(d) = pancreas.at(&p) {
                    organ(d.max(below), 42.0, Tissue::Pancreas);
                }
                if let Some(d) = spleen.at(&p) {
                    organ(d.max(below), 52.0, Tissue::Spleen);
                }
                if let Some(d) = liver.at(&p) {
                    organ(d.max(below), 62.0, Tissue::Liver);
                }
                if let Some(d) = band.at(&p) {
                    organ(d.max(below - 1.0), 60.0, Tissue::Tendons);
                }
                if let Some(d) = gallbladder.at(&p) {
                    organ(d.max(below), 12.0, Tissue::Gallbladder);
                }
                for (outer, inner, tissue) in &tubes {
                    let Some(d) = outer.at(&p) else { continue };
                    let d = d.max(below);
                    out.lay(row, d - 1.3, soft, flat(-95.0), Tissue::Fat as u8);
                    out.lay(row, d, soft, flat(48.0), *tissue as u8);
                    let Some(d) = inner.at(&p) else { continue };
                    let gas = matches!(tissue, Tissue::Stomach) && z > -16.0;
                    let (value, filling) = if gas {
                        (-1000.0, Tissue::Air)
                    } else {
                        (14.0, Tissue::Contents)
                    };
                    out.lay(row, d.max(below + 3.0), soft, flat(value), filling as u8);
                }
                let mut lay = |d: Lanes, value: f32, tissue: Tissue| {
                    if d.lowest() < soft {
                        out.lay(row, d, soft, flat(value), tissue as u8);
                    }
                };
                if let Some(d) = colon.at(&p) {
                    let d = d.max(below);
                    lay(d - 1.3, -95.0, Tissue::Fat);
                    lay(d, 46.0, Tissue::Colon);
                    // Gas rises into the transverse part.
                    let gas = (flat(34.0) - p.plain.y).max(flat(-175.0) - p.plain.z);
                    lay(d + 3.0, 0.0, Tissue::Contents);
                    lay((d + 3.0).max(gas), -1000.0, Tissue::Air);
                }

                // Between the lungs.
                if let Some(d) = gullet.at(&p) {
                    lay(d, 45.0, Tissue::Oesophagus);
                    lay(d + 4.2, 0.0, Tissue::Contents);
                }
                if let Some(d) = glands.at(&p) {
                    lay(d, 90.0, Tissue::Glands);
                }
                if heart.at(&p).is_some() {
                    lay(beat, 50.0, Tissue::Heart);
                    lay(grooves.or_far(&p).max(beat - 0.8), -80.0, Tissue::Fat);
                    lay(heart_right.or_far(&p), 150.0, Tissue::Veins);
                    lay(heart_left.or_far(&p), 220.0, Tissue::Arteries);
                }
                if let Some(d) = ureters.filter(|_| self.revision == Revision::Second) {
                    lay(d.max(c), 60.0, Tissue::Ureters);
                }
                for (vessel, value, tissue) in behind.iter().chain(&vessels).chain(before) {
                    if let Some(d) = vessel.at(&p) {
                        lay(d.max(m + 3.0), *value, *tissue);
                    }
                }
                if let Some(d) = heart_veins.at(&p) {
                    lay(d, 150.0, Tissue::Veins);
                }
                if let Some(d) = heart_arteries.at(&p) {
                    lay(d, 230.0, Tissue::Arteries);
                }
                if let Some(d) = windpipe.at(&p) {
                    // Hoops of cartilage, open behind.
                    let is_whole = self.revision == Revision::Second;
                    let share = if is_whole { 0.5 } else { 0.6 };
                    let hoop = (z * (1.0 / 7.5)).rem_euclid(1.0) < share && !(is_whole && z < 86.0);
                    let ring = if hoop {
                        Tissue::Cartilage
                    } else {
                        Tissue::Bronchi
                    };
                    lay(d, 70.0, ring);
                    if hoop && is_whole {
                        // Open: what lies between them hangs together there.
                        let behind = p.plain.y - torso_chest::windpipe_behind(&p.plain);
                        lay(d.max(behind), 70.0, Tissue::Bronchi);
                    }
                    if let Some(d) = windpipe_air.at(&p) {
                        lay(d, -1000.0, Tissue::Air);
                    }
                }

                // Frame.
                let [.., (chest_arteries, ..)] = &vessels;
                if let Some(d) = cartilages.at(&p) {
                    lay(d.max(s + 4.0), 110.0, Tissue::Cartilage);
                }
                if let Some(d) = discs.at(&p) {
                    lay(d, 90.0, Tissue::Discs);
                }
                for (bone, tissue, compact) in &bones {
                    if let Some(d) = bone.at(&p) {
                        // Ribs and shoulder blades lie under muscle, the others come up to the skin.
                        let covered = matches!(tissue, Tissue::Ribs | Tissue::Scapulae);
                        let mut d = d.max(if covered { m + 2.6 } else { s + 4.0 });
                        if self.revision == Revision::Second && matches!(tissue, Tissue::Ribs) {
                            // The first rib has a groove for the artery of the arm.
                            d = d.max(-chest_arteries.or_far(&p));
                        }
                        if d.lowest() < width {
                            let spongy = ((-d - *compact) * 0.8).clamp(0.0, 1.0);
                            let value = flat(1100.0).mix(flat(320.0), spongy);
                            out.lay(row, d, soft, value, *tissue as u8);
                        }
                    }
                }
                let mut lay = |d: Lanes, value: f32, tissue: Tissue| {
                    if d.lowest() < soft {
                        out.lay(row, d, soft, flat(value), tissue as u8);
                    }
                };
                if let Some(d) = canal.at(&p) {
                    lay(d, 10.0, Tissue::Fat);
                }
                for nerve in [&spinal_cord, &roots] {
                    if let Some(d) = nerve.at(&p) {
                        lay(d, 36.0, Tissue::Nerves);
                    }
                }
            }
            out.claim(row, s - block.spacing, Tissue::Skin as u8);
            let ends = (flat(ARM_END_MM) - p.plain.x.abs())
                .min(p.plain.z - BOTTOM_MM)
                .min(flat(TOP_MM) - p.plain.z);
            if ends.lowest() < width {
                out.lay(row, ends, width, flat(-1000.0), 0);
            }
        }
    }
}
