//! The head: skin, fat, muscle, skull, brain and what lies between, in CT-like values.
//!
//! Every tissue is a field of signed distances; a block is painted from what lies behind to what lies before, as an
//! illustrator lays paint: fat first, muscles on it, bone on those, and so on.

use glam::Vec3;

use super::head_brain::{self, Cortex};
use super::head_skin;
use super::head_skull;
use super::head_soft;
use super::lanes::Lanes;
use super::paint::{
    Block, Canvas, Model, Passage, ROWS, Revision, SegmentSpec, border_width, segment,
};
use super::shape::{Field, Near, Places, smooth_min};

/// Segments of the head; the number of each is its label.
#[derive(Clone, Copy)]
#[repr(u8)]
enum Tissue {
    Skin = 1,
    Fat,
    Muscle,
    Bone,
    Brain,
    WhiteMatter,
    Cerebellum,
    BrainStem,
    Ventricles,
    Csf,
    Eyes,
    Iris,
    Pupil,
    Lens,
    Teeth,
    Tongue,
    Mucosa,
    Airway,
    Arteries,
    Veins,
    Nerves,
    Cartilage,
    Glands,
    Lips,
    Hair,
    Dura,
}

const SEGMENTS: &[SegmentSpec] = &[
    segment("skin", [226, 176, 148]),
    segment("fat", [240, 209, 128]),
    segment("muscle", [165, 68, 58]),
    segment("bone", [236, 224, 196]),
    segment("brain", [214, 168, 156]),
    segment("white matter", [240, 230, 216]),
    segment("cerebellum", [204, 154, 144]),
    segment("brain stem", [232, 208, 176]),
    segment("ventricles", [120, 160, 196]),
    segment("csf", [176, 204, 220]),
    segment("eyes", [240, 237, 232]),
    segment("iris", [104, 122, 116]),
    segment("pupil", [24, 20, 20]),
    segment("lens", [206, 220, 224]),
    segment("teeth", [248, 244, 230]),
    segment("tongue", [198, 98, 94]),
    segment("mucosa", [206, 112, 104]),
    segment("airway", [196, 220, 232]),
    segment("arteries", [196, 44, 38]),
    segment("veins", [72, 90, 160]),
    segment("nerves", [236, 206, 90]),
    segment("cartilage", [190, 208, 214]),
    segment("glands", [214, 168, 110]),
    segment("lips", [206, 134, 120]),
    segment("hair", [140, 104, 82]),
    segment("dura", [218, 206, 184]),
];

/// The head's shapes, each as one field of distances in mm.
pub(super) struct Head {
    skin: Field,
    lips: Field,
    hair: Field,
    cartilage_regions: Field,
    cartilages: Field,
    muscles: Field,
    facial_muscles: Field,
    temples: Field,
    tongue: Field,
    glands: Field,
    airway: Field,
    sinuses: Field,
    arteries: Field,
    veins: Field,
    nerves: Field,
    cavity: Field,
    canal: Field,
    face_bones: Field,
    openings: Field,
    lower_bones: Field,
    teeth: Field,
    hemispheres: Field,
    fissure: Field,
    cerebellum: Field,
    tentorium: Field,
    stem: Field,
    callosum: Field,
    deep_grey: Field,
    ventricles: Field,
    eyes: Field,
    lens: Field,
    iris: Field,
    pupil: Field,
    cortex: Cortex,
    revision: Revision,
}

fn of(shapes: Vec<super::shape::Shape>, smooth: f32) -> Field {
    let mut f = Field::default();
    f.join_all(smooth, shapes);
    f
}

impl Head {
    /// Builds the model; it takes some ten milliseconds, most for the folds of the brain.
    pub(super) fn new(revision: Revision) -> Self {
        let skin = head_skin::skin();

        let mut lower_bones = head_skull::mandible();
        lower_bones.append(head_skull::neck_bones(), 0.0);
        let cavity = head_skull::cavity();
        let mut muscles = head_soft::muscles();
        muscles.join(0.0, head_soft::gullet());
        Self {
            lips: of(head_skin::lips(), 0.0),
            hair: head_skin::hair(&skin),
            cartilage_regions: head_skin::cartilage_regions(),
            cartilages: head_skull::cartilages(),
            muscles,
            facial_muscles: head_soft::facial_muscles(),
            temples: head_soft::temples(),
            tongue: head_soft::tongue(),
            glands: head_soft::glands(),
            airway: head_soft::airway(),
            sinuses: head_skull::sinuses(),
            arteries: head_soft::arteries(&skin, &cavity, revision),
            veins: head_soft::veins(&skin, &cavity, revision),
            nerves: head_soft::nerves(&skin, revision),
            canal: head_skull::canal(),
            face_bones: head_skull::face_bones(),
            openings: head_skull::openings(),
            lower_bones,
            teeth: head_skull::teeth(),
            hemispheres: head_brain::hemispheres(),
            fissure: head_brain::long_fissure(),
            cerebellum: head_brain::cerebellum(),
            tentorium: head_skull::under_tentorium(),
            stem: head_brain::stem(),
            callosum: of(head_brain::callosum(), 0.0),
            deep_grey: head_brain::deep_grey(),
            ventricles: head_brain::ventricles(),
            eyes: head_soft::cornea(),
            lens: head_soft::lens(),
            iris: head_soft::iris(5.7),
            pupil: head_soft::iris(2.4),
            skin,
            cavity,
            cortex: Cortex::new(),
            revision,
        }
    }
}

/// The fields of one block, cut down to what matters there.
struct Layer<'a>(Near<'a>);

impl<'a> Layer<'a> {
    /// With capsules that are at least `least` mm thick.
    fn new(field: &'a Field, block: &Block, band: f32, least: f32) -> Self {
        let mut near = Near::default();
        field.near_thick(block, band, least, &mut near);
        Self(near)
    }

    /// Signed distance, or nothing if the field is far from the block.
    #[inline(always)]
    fn at(&self, p: &Places) -> Option<Lanes> {
        if self.0.is_empty() {
            return None;
        }
        Some(self.0.distance(p))
    }
}

/// How far the brain stays away from vessels on it, and how deep under the skull's inner side such grooves reach, mm.
/// In the first revision there are none: its vessels sink into the brain.
const GROOVE_MM: f32 = 0.9;
const GROOVE_DEPTH_MM: f32 = 5.0;

impl Model for Head {
    fn bounds_mm(&self) -> (Vec3, Vec3) {
        (
            Vec3::new(-95.0, -103.34, -144.0),
            Vec3::new(95.0, 124.0, 134.0),
        )
    }

    fn segments(&self) -> &'static [SegmentSpec] {
        SEGMENTS
    }

    fn value_range(&self) -> [f32; 2] {
        [-1000.0, 2400.0]
    }

    fn passage(&self) -> Passage {
        self.revision.passage()
    }

    fn paint(&self, block: &Block, out: &mut Canvas) {
        let width = border_width(block.spacing);
        let layer = |field, band: f32| Layer::new(field, block, band + width, 0.0);
        // What is thinner than a voxel in places.
        let least = self.revision.least_mm(block, self.bounds_mm());
        let cord = |field| Layer::new(field, block, width, least);
        let skin = layer(&self.skin, 16.0);
        let eyes = layer(&self.eyes, 1.0);
        if skin.0.is_empty() && eyes.0.is_empty() {
            return;
        }
        let lips = layer(&self.lips, 2.0);
        let hair = layer(&self.hair, 0.0);
        let cartilage_regions = layer(&self.cartilage_regions, 0.0);
        let cartilages = layer(&self.cartilages, 0.0);
        let muscles = layer(&self.muscles, 5.0);
        let facial = layer(&self.facial_muscles, 0.0);
        let temples = layer(&self.temples, 0.0);
        let tongue = layer(&self.tongue, 0.0);
        let glands = layer(&self.glands, 0.0);
        let airway = layer(&self.airway, 4.0);
        let sinuses = layer(&self.sinuses, 3.0);
        let arteries = cord(&self.arteries);
        let veins = cord(&self.veins);
        let nerves = cord(&self.nerves);
        let cavity = layer(&self.cavity, 12.0);
        let canal = layer(&self.canal, 2.0);
        let face_bones = layer(&self.face_bones, 6.0);
        let openings = layer(&self.openings, 2.0);
        let lower_bones = layer(&self.lower_bones, 4.0);
        let teeth = layer(&self.teeth, 2.0);
        let hemispheres = layer(&self.hemispheres, 20.0);
        let fissure = layer(&self.fissure, 20.0);
        let cerebellum = layer(&self.cerebellum, 14.0);
        let tentorium = layer(&self.tentorium, 14.0);
        let stem = layer(&self.stem, 3.0);
        let callosum = layer(&self.callosum, 0.0);
        let deep_grey = layer(&self.deep_grey, 0.0);
        let ventricles = layer(&self.ventricles, 0.0);
        let lens = layer(&self.lens, 0.0);
        let iris = layer(&self.iris, 0.0);
        let pupil = layer(&self.pupil, 0.0);
        // Over it no vessel passes the bone.
        let base = match self.revision {
            Revision::First => 4.0,
            Revision::Second => head_soft::BASE_MM,
        };
        let skin_thickness = 2.3f32.max(0.9 * block.spacing);
        let flat = Lanes::splat;

        for row in 0..ROWS {
            let p = Places::new(block.row(row));
            let s = skin.at(&p).unwrap_or(flat(1e3));
            let eye = eyes.at(&p);
            if s.lowest() > width && eye.is_none_or(|eye| eye.lowest() > width) {
                continue;
            }
            // Where a surface is drawn, against air and on bone, values go over smoothly; between soft tissues sharply.
            let mut lay = |d: Lanes, value: Lanes, tissue: Tissue| {
                let width = match tissue {
                    Tissue::Skin | Tissue::Bone | Tissue::Airway | Tissue::Eyes | Tissue::Hair => {
                        width
                    }
                    _ => 0.55 * width,
                };
                if d.lowest() < width {
                    out.lay(row, d, width, value, tissue as u8);
                }
            };
            // Values go over a little outside the surface, so that even the thin skin has its own.
            lay(s - 0.5 * block.spacing, flat(30.0), Tissue::Skin);
            lay(s + skin_thickness, flat(-100.0), Tissue::Fat);
            if !muscles.0.is_empty() {
                // In the neck muscles lie close: they swell until a thin layer of fat is left between them.
                let (first, second) = muscles.0.two_nearest(&p);
                let swell = ((p.plain.z + 34.0) * (-1.0 / 16.0)).clamp(0.0, 1.0) * 3.2 + 0.4;
                let d = (first - swell).max(flat(1.1) - (second - first));
                lay(d.max(s + 3.4), flat(55.0), Tissue::Muscle);
            }
            if let Some(d) = facial.at(&p) {
                let sheet = (s + 4.2).abs() - 1.8;
                lay(d.max(sheet), flat(50.0), Tissue::Muscle);
            }
            if let Some(d) = glands.at(&p) {
                lay(d.max(s + 3.0), flat(20.0), Tissue::Glands);
            }
            if let Some(d) = tongue.at(&p) {
                lay(d, flat(60.0), Tissue::Tongue);
            }
            let air = airway.at(&p);
            if let Some(d) = air {
                lay((d - 2.6).max(s + 1.0), flat(45.0), Tissue::Mucosa);
            }
            if let Some(d) = cartilage_regions.at(&p) {
                lay(d.max(s + 1.8), flat(110.0), Tissue::Cartilage);
            }
            if let Some(d) = cartilages.at(&p) {
                lay(d.max(s + 2.5), flat(110.0), Tissue::Cartilage);
            }

            // Bone. The vault is a shell about the cavity.
            let hollow = cavity.at(&p);
            let tube = canal.at(&p);
            let cranium = hollow.map(|c| {
                let thickness = 4.0 + ((p.plain.z - 2.0) * (1.0 / 30.0)).clamp(0.0, 1.0)[0] * 2.6;
                c - thickness
            });
            let mut bone = face_bones.at(&p);
            if let Some(vault) = cranium {
                bone = Some(bone.map_or(vault, |face| smooth_min(face, vault, 8.0)));
            }
            let sinus = sinuses.at(&p);
            bone = bone.map(|mut bone| {
                if let Some(open) = openings.at(&p) {
                    bone = bone.max(-open);
                }
                if let Some(air) = air {
                    bone = bone.max(flat(1.2) - air);
                }
                if let Some(sinus) = sinus {
                    bone = bone.max(-sinus);
                }
                if let Some(c) = hollow {
                    bone = bone.max(-c);
                }
                bone
            });
            if let Some(vault) = cranium {
                // Sutures are engraved in the outer table only.
                if let Some(d) = bone.as_mut().filter(|_| {
                    block.center().z > 0.0 && vault.lowest() < 3.0 && vault.highest() > -3.5
                }) {
                    let outer = (vault * (1.0 / 3.0) + 1.0).clamp(0.0, 1.0);
                    *d += head_skull::sutures(&p) * outer;
                }
            }
            if let Some(lower) = lower_bones.at(&p) {
                bone = Some(bone.map_or(lower, |bone| bone.min(lower)));
            }
            if let (Some(d), Some(tube)) = (bone, tube) {
                bone = Some(d.max(-tube));
            }
            if let Some(d) = bone {
                // Soft tissue covers bone by some millimetres, least on the bridge of the nose.
                let nose = (flat(1.0)
                    - p.plain.x * p.plain.x * (1.0 / 196.0)
                    - (p.plain.z - 8.0) * (p.plain.z - 8.0) * (1.0 / 600.0))
                    .max(flat(0.0));
                let nose = nose * ((p.plain.y - 84.0) * 0.1).clamp(0.0, 1.0);
                let mut under = s + 5.2 - nose * 2.6;
                if let (Some(temple), Some(hollow)) = (temples.at(&p), hollow) {
                    // Room for the temporal muscle, as far as the vault keeps a wall.
                    let high = ((p.plain.z - 4.0) * 0.1).clamp(0.0, 1.0);
                    let room = s + 5.2 + (temple * -0.5).clamp(0.0, 2.8) * high;
                    under = under.max(room.min(hollow - 3.6f32.max(2.2 * block.spacing)));
                }
                let d = d.max(under);
                // Compact outside, spongy inside.
                let spongy = ((-d - 1.5) * 0.8).clamp(0.0, 1.0);
                lay(d, flat(1250.0).mix(flat(420.0), spongy), Tissue::Bone);
            }
            if let Some(d) = teeth.at(&p) {
                let dentine = ((-d - 1.0) * 0.8).clamp(0.0, 1.0);
                lay(
                    d.max(s + 3.5),
                    flat(2300.0).mix(flat(1700.0), dentine),
                    Tissue::Teeth,
                );
            }

            let [vein, artery] = [&veins, &arteries].map(|vessels| vessels.at(&p));
            // What the skull and the canal hold.
            let contents = match (hollow, tube) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
            if let Some(d) = contents {
                let d = d.max(s + 2.6);
                lay(d, flat(8.0), Tissue::Csf);
                let inside = d + 0.5;
                if inside.lowest() < width {
                    if let Some(solid) = hemispheres.at(&p) {
                        let gap = fissure.at(&p).unwrap_or(flat(1e3));
                        let mut d = self.cortex.distance(&p.plain, solid, gap).max(inside);
                        if self.revision == Revision::Second {
                            for vessel in [vein, artery].into_iter().flatten() {
                                let groove = flat(GROOVE_MM) - vessel;
                                d = d.max(groove.min(inside + GROOVE_DEPTH_MM));
                            }
                        }
                        lay(d, flat(38.0), Tissue::Brain);
                        lay(d + 3.1, flat(29.0), Tissue::WhiteMatter);
                        if let Some(c) = callosum.at(&p) {
                            lay(c, flat(29.0), Tissue::WhiteMatter);
                        }
                        if let Some(c) = deep_grey.at(&p) {
                            lay(c, flat(38.0), Tissue::Brain);
                        }
                    }
                    let trunk = stem.at(&p);
                    if let Some(body) = cerebellum.at(&p) {
                        let under = tentorium.at(&p).unwrap_or(flat(1e3)) + 1.5;
                        let mut d = body.max(under).max(inside + 1.2);
                        if let Some(trunk) = trunk {
                            d = d.max(flat(0.5) - trunk);
                        }
                        let d = head_brain::folia(&p.plain, d);
                        lay(d, flat(40.0), Tissue::Cerebellum);
                        lay(d + 1.9, flat(30.0), Tissue::WhiteMatter);
                    }
                    if let Some(d) = trunk {
                        lay(d.max(inside + 1.0), flat(32.0), Tissue::BrainStem);
                    }
                    if hollow.is_some() {
                        let under = tentorium.at(&p).unwrap_or(flat(1e3));
                        lay(
                            head_brain::dura(&p.plain, under).max(d),
                            flat(50.0),
                            Tissue::Dura,
                        );
                    }
                    if let Some(c) = hollow {
                        let d = head_soft::sagittal_sinus(&p.plain, c).max(d);
                        lay(d, flat(180.0), Tissue::Veins);
                    }
                    if let Some(d) = ventricles.at(&p) {
                        lay(d.max(inside), flat(6.0), Tissue::Ventricles);
                    }
                }
            }

            if let Some(d) = nerves.at(&p) {
                lay(d.max(s + 3.2), flat(32.0), Tissue::Nerves);
            }
            // Vessels run within the vault or outside it, never in its bone; whole ones in grooves where the scalp is
            // thin.
            let beside_vault = match (hollow, cranium) {
                (Some(c), Some(vault)) if block.center().z > base => {
                    let outside = match self.revision {
                        Revision::First => -vault,
                        Revision::Second => flat(1.5) - c,
                    };
                    (c + 0.3).min(outside)
                }
                _ => flat(-1e3),
            };
            for (vessel, value, tissue) in [
                (vein, 180.0, Tissue::Veins),
                (artery, 230.0, Tissue::Arteries),
            ] {
                if let Some(d) = vessel {
                    lay(d.max(s + 2.6).max(beside_vault), flat(value), tissue);
                }
            }

            let red = lips.at(&p).map(|d| d - 0.5);

            if let Some(d) = hair.at(&p) {
                lay(d.max((s - 0.1).abs() - 0.9), flat(20.0), Tissue::Hair);
            }
            // No sinus opens outwards: its soft border stays away from the skin.
            let sinus = sinus.map(|d| match self.revision {
                Revision::First => d,
                Revision::Second => d.max(s + 3.4),
            });
            for air in [air, sinus].into_iter().flatten() {
                lay(air.max(s), flat(-1000.0), Tissue::Airway);
            }
            if let Some(d) = eye {
                let wall = (-d - 1.2).clamp(0.0, 1.0);
                lay(d, flat(55.0).mix(flat(12.0), wall), Tissue::Eyes);
                if let Some(lens) = lens.at(&p) {
                    lay(lens, flat(95.0), Tissue::Lens);
                }
                let front = d.max(-(d + 2.6));
                if let Some(ring) = iris.at(&p) {
                    lay(ring.max(front), flat(55.0), Tissue::Iris);
                }
                if let Some(hole) = pupil.at(&p) {
                    lay(hole.max(front), flat(50.0), Tissue::Pupil);
                }
            }
            // What is drawn as the surface lies between voxels inside and voxels outside: those outside take the colour
            // too.
            let rim = 0.6 * block.spacing;
            if let Some(d) = eye {
                let before = (d - rim).max(flat(rim) - s);
                for (part, tissue) in [(&pupil, Tissue::Pupil), (&iris, Tissue::Iris)] {
                    if let Some(part) = part.at(&p) {
                        out.claim(row, before.max(part), tissue as u8);
                    }
                }
                out.claim(row, before, Tissue::Eyes as u8);
            }
            if let Some(d) = red {
                // Their red is skin too: only the label differs.
                out.relabel(
                    row,
                    (d - 0.5 * rim).max(s - rim).max(-(s + skin_thickness)),
                    Tissue::Lips as u8,
                );
            }
            out.claim(row, s - rim, Tissue::Skin as u8);
            // The neck ends in a clean section.
            let section = p.plain.z - head_skin::NECK_END_MM;
            if section.lowest() < width {
                out.lay(row, section, width, flat(-1000.0), 0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Leaving out the steps that are far from a block must not show: within the band, a block's distances are those of
    /// the whole field. Without the distance that later roundings reach, they are not.
    #[test]
    fn culling_changes_nothing_that_is_looked_at() {
        let width = border_width(1.1);
        let mut compared = 0;
        // With the bands that `paint` asks for.
        for (field, band) in [
            (head_skin::skin(), 16.0 + width),
            (head_skull::mandible(), 4.0 + width),
            (head_skull::cavity(), 12.0 + width),
        ] {
            let whole = field.everywhere();
            let mut near = Near::default();
            for index in 0..4000u32 {
                // Blocks all over the head, by steps that share no divisor with the box.
                let place = |step: u32, low: f32, high: f32| {
                    low + (high - low) * ((index * step) % 4001) as f32 / 4001.0
                };
                let block = Block {
                    origin: Vec3::new(
                        place(1, -95.0, 90.0),
                        place(61, -99.0, 120.0),
                        place(977, -144.0, 130.0),
                    ),
                    spacing: 1.1,
                };
                field.near(&block, band, &mut near);
                for row in [0, 27, 63] {
                    let p = Places::new(block.row(row));
                    let all = whole.distance(&p);
                    let some = if near.is_empty() {
                        Lanes::splat(1e3)
                    } else {
                        near.distance(&p)
                    };
                    for i in 0..8 {
                        if all[i].abs() < 1.6 {
                            compared += 1;
                            assert!(
                                (all[i] - some[i]).abs() < 0.02,
                                "{} and {} at {:?}",
                                all[i],
                                some[i],
                                block.origin
                            );
                        }
                    }
                }
            }
        }
        assert!(compared > 2_000, "surfaces were met: {compared}");
    }
}
