//! Vessels little thicker than a voxel are whole in the picture, whichever way they run.

use crate::align::labelled_block;
use crate::gpu::{software, studio_of};
use crate::long::long_or;
use crate::pieces::pieces;
use crate::scatter::Random;
use fabrica::data::{Segmentation, Volume, Voxels};
use fabrica::document::{Document, Illustration};
use fabrica::render::{Studio, View};
use glam::{DVec3, IVec3, Quat, UVec3, Vec2, Vec3};

/// Voxels along a side of the phantom.
const SIDE: u32 = 40;
/// Half the diameter of the tube, voxels.
const RADIUS: f64 = 0.6;
/// From the middle of the tube to either end, voxels.
const REACH: f64 = 15.0;
/// Places along each side of a voxel at which it is asked whether the tube is there.
const PARTS: u32 = 6;
/// A voxel belongs to the tube where this much of it is filled. It is what makes voxels hang together by their faces at
/// every direction: of a tube along the diagonal of the cube every other voxel is filled by less than a fifth.
const LEAST_SHARE: f64 = 0.14;
/// Value of the tissue around the tube, and of the tube.
const VALUES: [f64; 2] = [60.0, 200.0];
const SIZE: [u32; 2] = [300, 300];
/// Pictures of kept tubes that still have gaps, of all 46: what is kept of one voxel is 0.57 voxels thick, and some
/// rays step over it. Of the directions that are always asked none has.
const STILL_TORN: usize = 2;

/// A straight tube in voxels from the middle of the first.
#[derive(Clone, Copy, Debug)]
struct Tube {
    middle: DVec3,
    /// Unit.
    along: DVec3,
}

impl Tube {
    fn holds(&self, voxel: DVec3) -> bool {
        let from = voxel - self.middle;
        let way = from.dot(self.along);
        way.abs() <= REACH && (from - self.along * way).length_squared() <= RADIUS * RADIUS
    }

    /// How much of a voxel the tube fills, 0 to 1.
    fn share(&self, voxel: UVec3) -> f64 {
        let from = voxel.as_dvec3() - self.middle;
        let off = (from - self.along * from.dot(self.along)).length();
        if off > RADIUS + 0.87 {
            return 0.0;
        }
        let filled = (0..PARTS.pow(3)).filter(|i| {
            let part = UVec3::new(i % PARTS, i / PARTS % PARTS, i / (PARTS * PARTS));
            let inside = (part.as_dvec3() + 0.5) / f64::from(PARTS) - 0.5;
            self.holds(voxel.as_dvec3() + inside)
        });
        filled.count() as f64 / f64::from(PARTS.pow(3))
    }

    /// A block of tissue with the tube in it, values and labels by the share of each voxel that the tube fills.
    fn phantom(&self) -> Volume {
        let voxel = |i: u32| UVec3::new(i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE));
        let shares: Vec<f64> = (0..SIDE.pow(3)).map(|i| self.share(voxel(i))).collect();
        let share = |at: UVec3| shares[(at.x + SIDE * (at.y + SIDE * at.z)) as usize];
        let label = |at| if share(at) >= LEAST_SHARE { 1 } else { 2 };
        let mut volume = labelled_block(SIDE, label, &["tube", "rest"]);
        let value = |share: &f64| (VALUES[0] + (VALUES[1] - VALUES[0]) * share).round() as u8;
        volume.voxels = Voxels::U8(shares.iter().map(value).collect());
        volume
    }

    /// One of its two ends, subject space.
    fn end(&self, sign: f64) -> Vec3 {
        let voxel = self.middle + self.along * (sign * REACH);
        ((voxel + 0.5) / f64::from(SIDE) - 0.5).as_vec3()
    }
}

/// How the tube is drawn alone: nothing else is kept, or nothing else is a body that is seen, or all else is hidden, or
/// only its values are seen.
const ALONE: [(&str, &str); 4] = [
    (
        "kept",
        r##""look":{"transfer":[{"value":19,"color":"#ffffff","opacity":0},{"value":21,"color":"#ffffff","opacity":1}],"background":"none"},
        "templates":[{"kind":"cut","size":[3,3,3],"align":{"to":"segment","keep":["tube"]}}]"##,
    ),
    (
        "a body",
        r##""look":{"transfer":[{"value":19,"color":"#ffffff","opacity":0},{"value":21,"color":"#ffffff","opacity":1}],"background":"none",
        "segments":{"tube":1,"rest":0}}"##,
    ),
    (
        "the rest hidden",
        r##""look":{"transfer":[{"value":19,"color":"#ffffff","opacity":0},{"value":21,"color":"#ffffff","opacity":1}],"background":"none",
        "segments":{"rest":0}}"##,
    ),
    (
        "by value",
        r##""look":{"transfer":[{"value":79,"color":"#ffffff","opacity":0},{"value":81,"color":"#ffffff","opacity":1}],"background":"none"}"##,
    ),
];

/// The tube from aside: `turn` in radians about its length.
fn from_aside(tube: &Tube, how: &str, turn: f32) -> Illustration {
    let along = tube.along.as_vec3();
    let aside = Quat::from_axis_angle(along, turn) * along.any_orthonormal_vector();
    let [x, y, z, w] = Quat::from_rotation_arc(Vec3::Y, aside).to_array();
    let json =
        format!(r#"{{"fabrica":1,{how},"camera":{{"rotate":[{x},{y},{z},{w}],"distance":2.2}}}}"#);
    let document = Document::from_json(&json).expect("a document");
    document.illustration().clone()
}

/// What a picture of a tube lacks: pieces beside the first, and how far the first ends before either end, voxels.
fn lacks(studio: &Studio, tube: &Tube, how: &str, turn: f32) -> (usize, f32) {
    let shown = from_aside(tube, how, turn);
    let image = pollster::block_on(studio.render_image(&shown, SIZE, 4)).expect("a picture");
    let view = View::new(&shown.camera, SIZE);
    let pieces = pieces(SIZE[0], &image.rgba);
    let px = |pos| view.pixel_from_subject(pos).expect("in sight");
    let per_voxel = px(tube.end(1.0)).distance(px(tube.end(-1.0))) / (2.0 * REACH as f32);
    let short = [-1.0, 1.0].map(|sign| {
        let end = px(tube.end(sign));
        let pixels = pieces.first().into_iter().flatten();
        let ways = pixels.map(|&(x, y)| Vec2::new(x as f32 + 0.5, y as f32 + 0.5).distance(end));
        ways.fold(f32::MAX, f32::min) / per_voxel
    });
    (pieces.len().saturating_sub(1), short[0].max(short[1]))
}

/// Axes, diagonals of faces and of the cube, and ten random directions.
fn directions() -> Vec<DVec3> {
    let mut directions = vec![DVec3::X, DVec3::Y, DVec3::Z];
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        for sign in [-1.0, 1.0] {
            let mut way = DVec3::ZERO;
            way[a] = 1.0;
            way[b] = sign;
            directions.push(way);
        }
    }
    for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        directions.push(DVec3::new(x, y, 1.0));
    }
    let mut random = Random(0x0b01_1719);
    directions.extend((0..10).map(|_| random.rotation().as_dquat() * DVec3::X));
    directions.iter().map(|way| way.normalize()).collect()
}

/// True if the voxels of a tube hang together by their faces.
fn hangs_together(tube: &Tube) -> bool {
    let is_tube = |at: IVec3| {
        let is_there = at.min_element() >= 0 && at.max_element() < SIDE as i32;
        is_there && tube.share(at.as_uvec3()) >= LEAST_SHARE
    };
    let voxels = (0..SIDE.pow(3)).map(|i| UVec3::new(i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)));
    let mut open: Vec<IVec3> = voxels
        .map(UVec3::as_ivec3)
        .filter(|at| is_tube(*at))
        .collect();
    let mut next: Vec<IVec3> = open.pop().into_iter().collect();
    while let Some(at) = next.pop() {
        let (beside, rest) = open
            .iter()
            .partition(|other| (**other - at).abs().element_sum() == 1);
        open = rest;
        next.extend::<Vec<IVec3>>(beside);
    }
    open.is_empty()
}

/// Takes the label off voxels of the tube halfway to one end.
fn torn(mut volume: Volume, tube: &Tube) -> Volume {
    let at = tube.middle + tube.along * (0.5 * REACH);
    if let Some(Segmentation { labels, .. }) = &mut volume.segmentation {
        for (i, label) in (0..).zip(labels) {
            let voxel = UVec3::new(i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)).as_dvec3();
            if voxel.distance(at) < 2.5 {
                *label = 2;
            }
        }
    }
    volume
}

/// A tube of 1.2 voxels drawn alone is one piece from end to end in the picture, at every direction: right through the
/// middles of voxels, and anywhere between them.
#[test]
fn thin_tubes_have_no_gap() {
    let mut random = Random(0x0b01_171a);
    let (mut count, mut gaps) = (0, Vec::new());
    let every = long_or(1, 5);
    for (i, along) in (0..).zip(directions().into_iter().step_by(every)) {
        let half = DVec3::splat(0.5 * f64::from(SIDE));
        for middle in [half, half + random.vector(-0.5, 0.5).as_dvec3()] {
            let tube = Tube { middle, along };
            assert!(
                hangs_together(&tube),
                "the phantom's voxels, along {along:.2}"
            );
            let studio = studio_of(software(), &tube.phantom(), true);
            for (name, how) in ALONE {
                let (beside, short) = lacks(&studio, &tube, how, 0.3 + 0.7 * i as f32);
                count += 1;
                if beside > 0 || short > 1.0 {
                    gaps.push(format!(
                        "{name}, along {along:.2} through {middle:.2}: {beside} pieces beside, {short:.1} voxels short"
                    ));
                }
            }
        }
    }
    println!(
        "{count} pictures, {} with gaps:\n{}",
        gaps.len(),
        gaps.join("\n")
    );
    let others = gaps.iter().filter(|gap| !gap.starts_with("kept"));
    assert_eq!(others.count(), 0, "of {count}:\n{}", gaps.join("\n"));
    assert!(
        gaps.len() <= long_or(STILL_TORN, 0),
        "{} of {count} have gaps:\n{}",
        gaps.len(),
        gaps.join("\n")
    );
    // Negative control: a gap is seen.
    let tube = Tube {
        middle: DVec3::splat(20.2),
        along: DVec3::new(1.0, 2.0, 3.0).normalize(),
    };
    let studio = studio_of(software(), &torn(tube.phantom(), &tube), true);
    let (beside, _) = lacks(&studio, &tube, ALONE[0].1, 0.3);
    assert!(beside > 0, "a torn tube is in pieces");
}
