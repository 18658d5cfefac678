//! What is kept ends at a smooth surface through the border of its labels: how exactly, that nothing thin is lost, and
//! that picture and probe have the same border.

use crate::align::{giving_way, labelled_block, probe};
use crate::gpu::{gpu, studio_of};
use crate::scatter::Random;
use fabrica::data::{KeptLabels, Segmentation, Volume};
use fabrica::document::{
    Align, ConstrainBy, Illustration, ParamValue, PlacedTemplate, TemplateKind,
};
use fabrica::math::Placement;
use fabrica::render::Studio;
use glam::{DVec3, IVec3, Quat, UVec3, Vec3};

/// Voxels along each side of the volumes here, unless a test has its own.
const SIDE: u32 = 48;

/// Number and name of what is kept.
const KEPT: u8 = 1;

/// A block of one value; `is_kept` by the index of a voxel.
fn block(side: u32, is_kept: impl Fn(UVec3) -> bool) -> Volume {
    let label_of = |voxel| if is_kept(voxel) { KEPT } else { 2 };
    labelled_block(side, label_of, &["kept", "rest"])
}

/// Label voxels, from the middle of the first, of a place of rest space in a block of so many along each side.
fn voxel_at(rest: DVec3, side: u32) -> DVec3 {
    (rest + 0.5) * f64::from(side) - 0.5
}

fn rest_at(voxel: DVec3, side: u32) -> DVec3 {
    (voxel + 0.5) / f64::from(side) - 0.5
}

/// Templates that take all of a block away from what they keep.
fn templates() -> [PlacedTemplate; 3] {
    let placed = |kind, size: f32, numbers: &[(usize, f32)]| {
        let placement = Placement {
            at: Vec3::ZERO,
            rotate: Quat::IDENTITY,
            size: Vec3::splat(size),
        };
        let mut template = PlacedTemplate::new(kind, placement);
        for (index, value) in numbers {
            template.params[*index] = ParamValue::Number(*value);
        }
        template.align = Align::Segment {
            keep: vec!["kept".to_owned()],
            thickness: 0.01,
        };
        template
    };
    let mut split = placed(TemplateKind::Split, 1.2, &[(0, 0.6)]);
    split.params[2] = ParamValue::Flag(false);
    [
        placed(
            TemplateKind::Peel,
            1.3,
            &[(0, 1.0), (1, 1.0), (2, 0.05), (3, 3.0)],
        ),
        placed(TemplateKind::Flap, 1.3, &[(1, 1.0)]),
        split,
    ]
}

fn illustration(template: &PlacedTemplate) -> Illustration {
    let mut illustration = Illustration::document_default();
    illustration.templates = vec![template.clone()];
    illustration
}

/// How far places lie from where they should, label voxels.
#[derive(Debug)]
struct Misses(Vec<f64>);

impl Misses {
    fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }

    fn at_99(&mut self) -> f64 {
        self.0.sort_by(f64::total_cmp);
        self.0[self.0.len() * 99 / 100]
    }
}

/// Rays from all around towards the middle of a block, subject space.
fn rays(count: usize) -> Vec<(Vec3, Vec3)> {
    let mut random = Random(0x0b01_1717);
    (0..count)
        .map(|_| {
            let from = random.vector(-1.0, 1.0).normalize_or(Vec3::X) * 1.6;
            let to = random.vector(-0.45, 0.45);
            (from, (to - from).normalize())
        })
        .collect()
}

/// Where the rays of a picture meet what is kept, against an exact surface: `distance` is that of a place to it, label
/// voxels. With what the border of the labels misses, on the same rays.
fn misses(
    studio: &Studio,
    template: &PlacedTemplate,
    labels: &Segmentation,
    distance: &dyn Fn(DVec3) -> f64,
) -> (Misses, Misses) {
    let rays = rays(12_000);
    let events = pollster::block_on(studio.events(&illustration(template), &rays)).expect("events");
    let (mut smooth, mut stairs) = (Vec::new(), Vec::new());
    let by_labels = KeptLabels::none();
    for ((from, dir), event) in rays.iter().zip(events) {
        let Some(event) = event else { continue };
        let met = *from + *dir * event.distance;
        let voxel = voxel_at(event.pos_in_rest.as_dvec3(), SIDE);
        let is_inside = (voxel - 0.5 * f64::from(SIDE - 1)).abs().max_element() < 20.5;
        // What was taken away has moved.
        if met.distance(event.pos_in_rest) > 1e-3 || !is_inside || distance(voxel).abs() > 2.0 {
            continue;
        }
        smooth.push(distance(voxel).abs());
        let along = dir.as_dvec3();
        let mut steps = (-150..150).map(|i| voxel + along * 0.02 * f64::from(i));
        let first = steps.find(|at| by_labels.label_at(labels, *at) == Some(KEPT));
        stairs.extend(first.map(|at| distance(at).abs()));
    }
    (Misses(smooth), Misses(stairs))
}

/// A ball and a tilted plate, kept under three templates: their outlines in the picture are smooth.
#[test]
fn rims_lie_at_the_exact_surface() {
    let middle = DVec3::splat(0.5 * f64::from(SIDE - 1)) + DVec3::new(0.13, -0.21, 0.37);
    let ball = move |voxel: DVec3| voxel.distance(middle) - 20.0;
    let across = DVec3::new(0.36, 0.2, 0.9).normalize();
    let plate = move |voxel: DVec3| (voxel - middle).dot(across).abs() - 1.0;
    let shapes: [(&str, &dyn Fn(DVec3) -> f64); 2] = [("ball", &ball), ("plate", &plate)];
    for (name, distance) in shapes {
        let volume = block(SIDE, |voxel| distance(voxel.as_dvec3()) < 0.0);
        let labels = volume.segmentation.as_ref().expect("labels");
        let studio = studio_of(gpu(), &volume, true);
        for template in templates() {
            let (mut smooth, mut stairs) = misses(&studio, &template, labels, distance);
            let what = format!("{name}, {:?}", template.kind);
            println!(
                "{what}: {} places, off by {:.3} in the mean and {:.3} at 99 of 100; the labels {:.3} and {:.3}",
                smooth.0.len(),
                smooth.mean(),
                smooth.at_99(),
                stairs.mean(),
                stairs.at_99(),
            );
            assert!(smooth.0.len() > 40, "{what}: {} places", smooth.0.len());
            assert!(smooth.mean() < 0.15, "{what}: {}", smooth.mean());
            assert!(smooth.at_99() < 0.35, "{what}: {}", smooth.at_99());
            // Negative control: stairs are told from a smooth surface.
            assert!(stairs.mean() > 0.2, "{what}: {}", stairs.mean());
        }
    }
}

/// Steps from a voxel to the next along each axis.
const STEPS: [IVec3; 3] = [IVec3::X, IVec3::Y, IVec3::Z];

/// Things of one voxel: each of their voxels stays, and so does the way from one to the next.
#[test]
fn thin_things_are_whole() {
    let side = 32;
    let rod_along = |axis: usize| {
        move |v: UVec3| v[(axis + 1) % 3] == 15 && v[(axis + 2) % 3] == 12 && v[axis] > 3
    };
    // By voxels that hang together by faces.
    let oblique = |v: UVec3| {
        v.z == 14 && (v.y == v.x / 2 + 6 || (v.x.is_multiple_of(2) && v.y == v.x / 2 + 5))
    };
    let plate = |v: UVec3| v.x + v.y == 30 || v.x + v.y == 31;
    let shell = |v: UVec3| {
        let way = (v.as_dvec3() - 15.5).length();
        (10.0..11.3).contains(&way)
    };
    let flat = |v: UVec3| v.z == 17;
    type Shape<'a> = (&'a str, &'a dyn Fn(UVec3) -> bool);
    let [x, y, z] = [rod_along(0), rod_along(1), rod_along(2)];
    let shapes: [Shape<'_>; 7] = [
        ("a rod along x", &x),
        ("a rod along y", &y),
        ("a rod along z", &z),
        ("an oblique rod", &oblique),
        ("a flat plate", &flat),
        ("an oblique plate", &plate),
        ("a shell", &shell),
    ];
    let [_, _, split] = templates();
    for (name, is_kept) in shapes {
        let studio = studio_of(gpu(), &block(side, is_kept), false);
        let is_member = |at: IVec3| {
            let is_there = at.min_element() >= 0 && at.max_element() < side as i32;
            is_there && is_kept(at.as_uvec3())
        };
        let voxels =
            (0..side.pow(3)).map(|i| UVec3::new(i % side, i / side % side, i / (side * side)));
        let mut points = Vec::new();
        for voxel in voxels.map(UVec3::as_ivec3).filter(|v| is_member(*v)) {
            for step in STEPS.into_iter().filter(|step| is_member(voxel + *step)) {
                for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let at = voxel.as_dvec3() + step.as_dvec3() * part;
                    points.push(rest_at(at, side).as_vec3());
                }
            }
        }
        let found = probe(&studio, std::slice::from_ref(&split), &points);
        let torn = points.iter().zip(&found);
        let torn = torn.filter(|(p, s)| s.pos_in_rest != **p || s.continuity < 0.0);
        assert_eq!(torn.count(), 0, "{name}: of {} places", points.len());
        assert!(points.len() > 100, "{name}: {} places", points.len());
    }
}

/// Pieces of the rest of at most 27 voxels count as kept, larger ones do not, whatever their form.
#[test]
fn crumbs_are_kept_and_larger_pieces_are_not() {
    let side = 40;
    let cube = |v: UVec3, at: IVec3| {
        let from = v.as_ivec3() - at;
        from.min_element() >= 0 && from.max_element() < 3
    };
    // A cube of 27 voxels, one with a voxel more, a rod of 27 and one of 28 along x across a word of bits, and a piece
    // at the edge of the labels.
    let rod = |v: UVec3, y: u32, count: u32| v.y == y && v.z == 30 && (8..8 + count).contains(&v.x);
    let larger = IVec3::new(20, 6, 6);
    let is_rest = move |v: UVec3| {
        cube(v, IVec3::new(6, 6, 6))
            || cube(v, larger)
            || v.as_ivec3() == larger + IVec3::new(3, 1, 1)
            || rod(v, 10, 27)
            || rod(v, 20, 28)
            || cube(v, IVec3::new(0, 20, 6))
    };
    let studio = studio_of(gpu(), &block(side, |v| !is_rest(v)), false);
    let [_, _, split] = templates();
    let stays = |at: [i32; 3]| {
        let point = rest_at(IVec3::from(at).as_dvec3(), side).as_vec3();
        let found = probe(&studio, std::slice::from_ref(&split), &[point]);
        found[0].pos_in_rest == point && found[0].continuity >= 0.0
    };
    assert!(stays([7, 7, 7]), "a cube of 27");
    assert!(!stays([21, 7, 7]), "of 28");
    assert!(stays([8, 10, 30]) && stays([34, 10, 30]), "a rod of 27");
    assert!(!stays([9, 20, 30]) && !stays([34, 20, 30]), "of 28");
    assert!(stays([1, 21, 7]), "at the edge");
}

/// The picture has its border where the probe has it, and no displacement that gives way to tissue jumps there.
#[test]
fn picture_and_probe_have_one_border() {
    let lumps = |voxel: DVec3| {
        let from = voxel - 23.0;
        from.length() - 14.0 - 3.0 * (0.9 * from.x).sin() * (0.7 * from.y).cos()
    };
    let volume = block(SIDE, |voxel| lumps(voxel.as_dvec3()) < 0.0);
    let labels = volume.segmentation.as_ref().expect("labels");
    let studio = studio_of(gpu(), &volume, true);
    let kept = KeptLabels::new(|label| u8::from(label == KEPT));
    let rays = rays(12_000);
    let [peel, _, split] = templates();
    for template in [&peel, &split] {
        let events = pollster::block_on(studio.events(&illustration(template), &rays));
        let mut points = Vec::new();
        for ((from, dir), event) in rays.iter().zip(events.expect("events")) {
            let Some(event) = event else { continue };
            let met = *from + *dir * event.distance;
            let voxel = voxel_at(met.as_dvec3(), SIDE);
            let is_by_kept = lumps(voxel).abs() < 1.0;
            if is_by_kept && met.distance(event.pos_in_rest) < 1e-3 {
                // A twentieth of a voxel before and behind.
                let step = *dir * 0.05 / SIDE as f32;
                points.extend([met - step, met + step]);
            }
        }
        let found = probe(&studio, std::slice::from_ref(template), &points);
        let agree = points.chunks(2).zip(found.chunks(2)).filter(|(p, s)| {
            let stays = |i: usize| s[i].pos_in_rest == p[i] && s[i].continuity >= 0.0;
            let told = kept.sets_at(labels, voxel_at(p[1].as_dvec3(), SIDE));
            !stays(0) && stays(1) && told == 1
        });
        let (agree, count) = (agree.count(), points.len() / 2);
        println!("{:?}: {agree} of {count} borders agree", template.kind);
        assert!(
            count > 100 && agree * 50 >= count * 49,
            "{agree} of {count}"
        );
    }
    let mut random = Random(0x0b01_1718);
    for by in [ConstrainBy::Displacement, ConstrainBy::Coordinate] {
        for kind in [TemplateKind::Twist, TemplateKind::Bend, TemplateKind::Poke] {
            let placement = Placement {
                at: Vec3::new(0.05, 0.02, 0.1),
                rotate: Quat::IDENTITY,
                size: Vec3::splat(0.9),
            };
            let free = PlacedTemplate::new(kind, placement);
            let mut points = Vec::new();
            while points.len() < 800 {
                let dir = random.vector(-1.0, 1.0).as_dvec3().normalize_or(DVec3::X);
                let is_in = |way: f64| kept.sets_at(labels, DVec3::splat(23.0) + dir * way) == 1;
                let (mut low, mut high) = (0.0, 20.0);
                for _ in 0..30 {
                    let middle = 0.5 * (low + high);
                    if is_in(middle) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                let at = |way: f64| rest_at(DVec3::splat(23.0) + dir * way, SIDE).as_vec3();
                points.extend([at(low - 0.02), at(high + 0.02)]);
            }
            let found = probe(&studio, &[giving_way(free.clone(), by, "kept")], &points);
            let without = probe(&studio, &[free], &points);
            let longest = |found: &[fabrica::render::Sample]| {
                let ways = points
                    .iter()
                    .zip(found)
                    .map(|(p, s)| s.pos_in_rest.distance(*p));
                ways.fold(0.0, f32::max)
            };
            println!(
                "{kind:?} {by:?}: {} at the border, else {}",
                longest(&found),
                longest(&without)
            );
            assert!(
                longest(&found) < 1e-3,
                "{kind:?} {by:?}: {}",
                longest(&found)
            );
            assert!(longest(&without) > 0.02, "{kind:?} reaches it");
        }
    }
}

/// Of sets that exclude each other and leave nothing out, each place has one: where two surfaces meet there is no gap
/// and no overlap.
#[test]
fn sets_that_exclude_each_other_part_the_places() {
    let lumps = |voxel: DVec3| {
        let from = voxel - 23.0;
        from.length() - 14.0 - 3.0 * (0.9 * from.x).sin() * (0.7 * from.y).cos()
    };
    let label = |voxel: UVec3| match (lumps(voxel.as_dvec3()) < 0.0, voxel.x + voxel.y < 46) {
        (true, _) => 1,
        (false, true) => 2,
        (false, false) => 3,
    };
    let names = ["lumps", "left", "right"];
    let studio = studio_of(gpu(), &labelled_block(SIDE, label, &names), false);
    let [_, _, split] = templates();
    let mut random = Random(0x0b01_171b);
    // Within two voxels of the border of the lumps.
    let mut points = Vec::new();
    while points.len() < 4000 {
        let voxel = DVec3::splat(23.0) + random.vector(-19.0, 19.0).as_dvec3();
        if lumps(voxel).abs() < 2.0 {
            points.push(rest_at(voxel, SIDE).as_vec3());
        }
    }
    let kept = |keep: &[&str]| -> Vec<bool> {
        let mut split = split.clone();
        split.align = Align::Segment {
            keep: keep.iter().map(|name| (*name).to_owned()).collect(),
            thickness: 0.01,
        };
        let found = probe(&studio, std::slice::from_ref(&split), &points);
        let stays = points.iter().zip(found);
        stays
            .map(|(point, sample)| sample.pos_in_rest == *point && sample.continuity >= 0.0)
            .collect()
    };
    let count = |sets: &[Vec<bool>], wanted: fn(usize) -> bool| {
        let of = |i: usize| sets.iter().filter(|set| set[i]).count();
        (0..points.len()).filter(|i| wanted(of(*i))).count()
    };
    let halves = [kept(&["lumps"]), kept(&["left", "right"])];
    // A share is a byte: in half a step of it about the border both or none may be.
    let both = count(&halves, |n| n == 2);
    let none = count(&halves, |n| n == 0);
    println!("two sets: {both} places in both, {none} in none");
    assert!(both + none <= points.len() / 200, "{both} and {none}");
    let inside = halves[0].iter().filter(|is_in| **is_in).count();
    assert!((1000..3000).contains(&inside), "{inside} within");
    // Of three sets none needs to have half of a place, and no two have.
    let thirds = names.map(|name| kept(&[name]));
    let both = count(&thirds, |n| n > 1);
    println!("three sets: {both} places in two");
    assert!(both <= points.len() / 200, "{both}");
    // Negative control.
    let overlapping = [kept(&["lumps", "left"]), kept(&["left", "right"])];
    assert!(count(&overlapping, |n| n == 2) > 500, "an overlap is seen");
}
