//! WGSL numbers against the plain f64 reading in `reference/`: every template alone, lists of them, `add` groups.
//!
//! **Bound.** 1e-3 of a subject unit is promised (spec/templates.md, "Precision"), 1e-4 is the aim and what is asserted
//! here.
//!
//! **Points left out.** f32 cannot say on which side of a jump a point lies that is nearer to it than the rounding of
//! its own coordinates. So the reference is asked again with the point moved, before each template, to the corners of a
//! box as large as that rounding (a few units in the last place of the terms that make up q), and with every parameter
//! moved by one unit in its last place (a flap turned by exactly a quarter has a tie of A all over its gap). If the
//! reference itself then moves by more than a quarter of the bound, the point says nothing about the shader and is left
//! out. It is counted, and only few may be.

use crate::firm::{BOUND, difference, firm};
use crate::gpu::gpu;
use crate::long::long_or;
use crate::reference::as_reference;
use crate::scatter::{Random, defaults, placed};
use fabrica::data::Resources;
use fabrica::document::{Curve, ParamValue, PlacedTemplate, TemplateKind, TemplateMode};
use fabrica::math::{Aabb, Placement};
use fabrica::placed;
use fabrica::render::gpu_types::Templates;
use fabrica::render::{Gpu, Probe, Sample};
use glam::{Vec2, Vec3};

/// Open the software device as strictly as a browser would; without one the test fails.
fn probe() -> (Gpu, Probe) {
    let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
    (gpu().clone(), probe)
}

fn ask(probe: &Probe, list: &[PlacedTemplate], points: &[Vec3]) -> Vec<Sample> {
    pollster::block_on(probe.samples_of(&Templates::pack(list, &Resources::default()), points))
        .expect("samples")
}

/// What a comparison came to.
#[derive(Default, Debug)]
struct Tally {
    compared: usize,
    left_out: usize,
    moved: usize,
    in_gaps: usize,
    worst: f64,
    worst_case: String,
}

impl Tally {
    fn add(&mut self, list: &[PlacedTemplate], points: &[Vec3], samples: &[Sample]) {
        let plain = as_reference(list);
        for (point, sample) in points.iter().zip(samples) {
            let Some(expected) = firm(&plain, point.as_dvec3()) else {
                self.left_out += 1;
                continue;
            };
            self.compared += 1;
            self.moved += usize::from((expected.0 - point.as_dvec3()).length() > 1e-3);
            self.in_gaps += usize::from(expected.1 < 0.0);
            let got = (sample.pos_in_rest.as_dvec3(), f64::from(sample.continuity));
            let d = difference(expected, got);
            if d > self.worst {
                self.worst = d;
                self.worst_case =
                    format!("{list:?}\n at {point:?}: expected {expected:?}, got {got:?}");
            }
        }
    }
    fn check(&self, what: &str) {
        self.check_with(what, 0.03);
    }
    /// `most_left_out`: share of the points.
    fn check_with(&self, what: &str, most_left_out: f64) {
        println!(
            "{what}: {} points, largest difference {:.1e}, {} moved, {} in gaps, {} left out",
            self.compared, self.worst, self.moved, self.in_gaps, self.left_out
        );
        assert!(
            self.worst <= BOUND,
            "{what}: {:e}\n{}",
            self.worst,
            self.worst_case
        );
        let share = self.left_out as f64 / (self.left_out + self.compared) as f64;
        assert!(
            share < most_left_out,
            "{what}: {share} of the points were left out, which proves little"
        );
        assert!(
            self.moved + self.in_gaps > self.compared / 50,
            "{what}: hardly any point was touched"
        );
    }
}

#[test]
fn every_template_alone_agrees_with_the_reference() {
    let (gpu, probe) = probe();
    println!("on {} ({})", gpu.info.name, gpu.info.driver_info);
    for kind in TemplateKind::FORMULAS {
        let mut random = Random(0x5EED_0001 + kind as u64);
        let mut tally = Tally::default();
        for _ in 0..200 {
            let list = [random.template(kind)];
            let points: Vec<Vec3> = (0..100).map(|_| random.point(&list)).collect();
            tally.add(&list, &points, &ask(&probe, &list, &points));
        }
        // In a box 25 times as high as it is long, the finest teeth of a crack are 10,000 in a row: 3.3 % of the
        // points lie nearer to another tooth than their rounding.
        let most_left_out = if kind == TemplateKind::Crack {
            0.05
        } else {
            0.03
        };
        tally.check_with(kind.spec().name, most_left_out);
    }
}

#[test]
fn lists_and_add_groups_agree_with_the_reference() {
    let (_gpu, probe) = probe();
    for add_share in [0.0, 0.5] {
        let mut random = Random(0xC0FFEE);
        let mut tally = Tally::default();
        for _ in 0..400 {
            let count = 2 + random.index(7);
            let mut list = Vec::new();
            for _ in 0..count {
                let kind = TemplateKind::FORMULAS[random.index(TemplateKind::FORMULAS.len())];
                let mut template = random.template(kind);
                if random.unit() < add_share {
                    template.mode = TemplateMode::Add;
                }
                template.enabled = random.unit() < 0.85;
                list.push(template);
            }
            let points: Vec<Vec3> = (0..60).map(|_| random.point(&list)).collect();
            tally.add(&list, &points, &ask(&probe, &list, &points));
        }
        tally.check(if add_share == 0.0 {
            "composed"
        } else {
            "composed and added"
        });
    }
}

#[test]
fn templates_along_curves_agree_with_the_reference() {
    let (_gpu, probe) = probe();
    for kind in TemplateKind::FORMULAS {
        let mut random = Random(0xC0_0001 + kind as u64);
        let mut tally = Tally::default();
        for _ in 0..long_or(60, 30) {
            let mut template = random.template(kind);
            template.curve = Some(random.curve(template.placement.size));
            let list = [template];
            let points: Vec<Vec3> = (0..100).map(|_| random.point(&list)).collect();
            tally.add(&list, &points, &ask(&probe, &list, &points));
        }
        // Far from a sharp corner a small step along the line is a long one: 5 % for the peeler, which tears at the
        // faces.
        tally.check_with(&format!("{} along a curve", kind.spec().name), 0.07);
    }
}

#[test]
fn lists_along_curves_agree_with_the_reference() {
    let (_gpu, probe) = probe();
    let mut random = Random(0xC0FF_EEC0);
    let mut tally = Tally::default();
    for _ in 0..200 {
        let count = 2 + random.index(5);
        let mut list = Vec::new();
        for _ in 0..count {
            let kind = TemplateKind::FORMULAS[random.index(TemplateKind::FORMULAS.len())];
            let mut template = random.template(kind);
            if random.unit() < 0.6 {
                template.curve = Some(random.curve(template.placement.size));
            }
            if random.unit() < 0.25 {
                template.mode = TemplateMode::Add;
            }
            list.push(template);
        }
        let points: Vec<Vec3> = (0..60).map(|_| random.point(&list)).collect();
        tally.add(&list, &points, &ask(&probe, &list, &points));
    }
    tally.check("lists along curves");
    // Every template of a full document along its own curve: all of them find room.
    let list: Vec<PlacedTemplate> = (0..32)
        .map(|i| {
            let mut template = random.template(TemplateKind::FORMULAS[i % 18]);
            template.placement.size = Vec3::splat(0.05);
            template.curve = Some(random.curve(template.placement.size));
            template
        })
        .collect();
    assert!(
        Templates::pack(&list, &Resources::default())
            .items
            .iter()
            .all(|t| t.curve != 0)
    );
}

#[test]
fn a_straight_curve_changes_nothing_and_a_mirrored_one_is_another() {
    let (_gpu, probe) = probe();
    for kind in TemplateKind::FORMULAS {
        let mut random = Random(0x57 + kind as u64);
        let (mut compared, mut worst, mut differing) = (0, 0.0_f32, 0);
        for _ in 0..20 {
            let plain = random.template(kind);
            let mut straight = plain.clone();
            let places = [0.0, 0.3, 0.8, 1.0].map(|x| Vec2::new(x, 1.0));
            straight.curve = Some(Curve::spline(places.to_vec()));
            let mut round = plain.clone();
            round.curve = Some(random.curve(plain.placement.size));
            let mut mirrored = round.clone();
            mirrored.curve = round.curve.as_ref().map(Curve::mirrored);
            let one = std::slice::from_ref(&plain);
            let points: Vec<Vec3> = (0..100).map(|_| random.point(one)).collect();
            let expected = ask(&probe, one, &points);
            let got = ask(&probe, &[straight], &points);
            let reference = as_reference(one);
            for ((point, a), b) in points.iter().zip(expected).zip(got) {
                // Where rounding alone decides between two readings nothing is compared.
                if firm(&reference, point.as_dvec3()).is_some() {
                    compared += 1;
                    worst = worst.max(a.pos_in_rest.distance(b.pos_in_rest));
                }
            }
            let (one, other) = (
                ask(&probe, &[round], &points),
                ask(&probe, &[mirrored], &points),
            );
            let pairs = one.iter().zip(&other);
            differing += pairs
                .filter(|(a, b)| a.pos_in_rest.distance(b.pos_in_rest) > 10.0 * BOUND as f32)
                .count();
        }
        println!("{kind:?}: {compared} points, at most {worst:.1e} from the one without a curve");
        assert!(worst < 1e-5, "{kind:?}: a straight curve moves by {worst}");
        assert!(
            kind == TemplateKind::Cut || differing > 20,
            "{kind:?}: {differing}"
        );
    }
}

#[test]
fn a_planted_sign_error_is_caught() {
    // The comparison must fail when one side is wrong. Every template whose sign can be turned by a parameter gets it
    // turned; the others (those without a direction) are compared with a neighbouring parameter.
    let (_gpu, probe) = probe();
    for kind in TemplateKind::FORMULAS {
        let mut random = Random(0xBAD + kind as u64);
        let right = PlacedTemplate::new(kind, Placement::DOCUMENT_DEFAULT);
        let mut wrong = right.clone();
        match wrong.params.first_mut() {
            Some(ParamValue::Number(v)) if kind == TemplateKind::Slices => *v += 1.0,
            Some(ParamValue::Number(v)) => *v = -*v,
            Some(ParamValue::Vector(v)) => *v = -*v,
            Some(ParamValue::Choice(c)) => *c = 1,
            other => panic!("{kind:?} begins with {other:?}"),
        }
        let points: Vec<Vec3> = (0..400)
            .map(|_| random.point(std::slice::from_ref(&right)))
            .collect();
        let samples = ask(&probe, &[wrong], &points);
        let mut tally = Tally::default();
        tally.add(&[right], &points, &samples);
        assert!(
            tally.worst > 10.0 * BOUND,
            "{kind:?}: a planted error of {:e} went unseen",
            tally.worst
        );
    }
}

#[test]
fn no_template_is_the_identity() {
    let (_gpu, probe) = probe();
    let mut random = Random(7);
    let points: Vec<Vec3> = (0..500).map(|_| random.vector(-2.0, 2.0)).collect();
    for (point, sample) in points.iter().zip(ask(&probe, &[], &points)) {
        assert_eq!(sample.pos_in_rest, *point);
        assert_eq!(sample.continuity, 1.0);
    }
}

/// Parameters at which a template does nothing, where it has such.
fn closed(kind: TemplateKind) -> Option<Vec<ParamValue>> {
    let mut params = defaults(kind);
    match kind {
        TemplateKind::Cut => return None,
        TemplateKind::Pull | TemplateKind::Move => params[0] = ParamValue::Vector(Vec3::ZERO),
        TemplateKind::Slices => params[3] = ParamValue::Number(0.0),
        _ => params[0] = ParamValue::Number(0.0),
    }
    Some(params)
}

#[test]
fn an_unopened_template_is_exactly_the_identity() {
    let (_gpu, probe) = probe();
    let mut random = Random(11);
    for kind in TemplateKind::FORMULAS {
        let Some(params) = closed(kind) else { continue };
        for _ in 0..8 {
            let mut template = random.template(kind);
            template.params = params.clone();
            let list = [template];
            let points: Vec<Vec3> = (0..100).map(|_| random.point(&list)).collect();
            for (point, sample) in points.iter().zip(ask(&probe, &list, &points)) {
                assert_eq!(sample.pos_in_rest, *point, "{kind:?}");
                assert_eq!(sample.continuity, 1.0, "{kind:?}");
            }
        }
    }
}

#[test]
fn beyond_a_rest_end_nothing_moves() {
    use TemplateKind as K;
    // Axis ends that rest: x low, x high, y low, y high, z low, z high (spec/templates.md; the rest of the kinds is
    // defined everywhere).
    let kinds = [
        (K::Poke, "xXyYz"),
        (K::Twist, "xXyYz"),
        (K::Wave, "xXzZ"),
        (K::Squeeze, "zZ"),
        (K::Dilate, "zZ"),
        (K::Split, "z"),
        (K::Retractor, "xXyYz"),
        (K::Cutquad, "xXyYz"),
        (K::Peeler, "xXyYz"),
        (K::Hole, "xXyY"),
        (K::Crack, "xXyYz"),
    ];
    let (_gpu, probe) = probe();
    let mut random = Random(13);
    for (kind, ends) in kinds {
        let template = PlacedTemplate::new(kind, random.template(kind).placement);
        for end in ends.chars() {
            let axis = "xyz".find(end.to_ascii_lowercase()).expect("an axis");
            let points: Vec<Vec3> = (0..100)
                .map(|_| {
                    let mut q = random.vector(-0.5, 1.5);
                    let beyond = random.between(0.001, 1.0);
                    q[axis] = if end.is_lowercase() {
                        -beyond
                    } else {
                        1.0 + beyond
                    };
                    template.placement.subject_from_template(q)
                })
                .collect();
            for (point, sample) in
                points
                    .iter()
                    .zip(ask(&probe, std::slice::from_ref(&template), &points))
            {
                assert_eq!(sample.pos_in_rest, *point, "{kind:?} beyond {end}");
                assert_eq!(sample.continuity, 1.0, "{kind:?} beyond {end}");
            }
        }
    }
}

#[test]
fn order_matters_and_an_add_with_nothing_before_it_composes() {
    let (_gpu, probe) = probe();
    let mut random = Random(17);
    let peel = placed(
        TemplateKind::Peel,
        Placement::DOCUMENT_DEFAULT,
        defaults(TemplateKind::Peel),
    );
    let twist = placed(
        TemplateKind::Twist,
        Placement::DOCUMENT_DEFAULT,
        defaults(TemplateKind::Twist),
    );
    let one = [peel.clone(), twist.clone()];
    let other = [twist.clone(), peel.clone()];
    let points: Vec<Vec3> = (0..500).map(|_| random.point(&one)).collect();
    let first = ask(&probe, &one, &points);
    let second = ask(&probe, &other, &points);
    let differing = first.iter().zip(&second).filter(|(a, b)| a != b).count();
    assert!(differing > 50, "only {differing} points tell the order");

    let mut alone = twist.clone();
    alone.mode = TemplateMode::Add;
    let mut off = peel;
    off.enabled = false;
    assert_eq!(
        ask(&probe, &[off, alone], &points),
        ask(&probe, &[twist], &points)
    );
}

#[test]
fn hostile_placements_and_points_do_no_harm() {
    let (gpu, probe) = probe();
    let mut random = Random(19);
    for kind in TemplateKind::FORMULAS {
        for (at, size) in [
            (1e30, 1e-30),
            (-1e38, 1e38),
            (0.0, f32::MIN_POSITIVE),
            (0.0, 1e38),
            (1e6, 1e-6),
        ] {
            let mut template = random.template(kind);
            template.placement.at = Vec3::splat(at);
            template.placement.size = Vec3::splat(size);
            let points = [
                Vec3::ZERO,
                Vec3::splat(0.3),
                Vec3::splat(at),
                Vec3::splat(1e38),
                Vec3::NAN,
                Vec3::INFINITY,
            ];
            let samples = ask(&probe, &[template], &points);
            assert_eq!(samples.len(), points.len());
        }
    }
    // It still answers, and rightly.
    let template = placed(
        TemplateKind::Peel,
        Placement::DOCUMENT_DEFAULT,
        defaults(TemplateKind::Peel),
    );
    let points: Vec<Vec3> = (0..100)
        .map(|_| random.point(std::slice::from_ref(&template)))
        .collect();
    let mut tally = Tally::default();
    let samples = ask(&probe, std::slice::from_ref(&template), &points);
    tally.add(&[template], &points, &samples);
    tally.check("after hostile input");
    assert_eq!(gpu.take_errors(), Vec::<String>::new());
}

#[test]
fn any_number_of_points_is_answered() {
    let (_gpu, probe) = probe();
    let list = [placed(
        TemplateKind::Cut,
        Placement::DOCUMENT_DEFAULT,
        defaults(TemplateKind::Cut),
    )];
    for count in [0, 1, 63, 65, 300_000] {
        let points: Vec<Vec3> = (0..count).map(|i| Vec3::splat(i as f32 * 1e-5)).collect();
        let samples = ask(&probe, &list, &points);
        assert_eq!(samples.len(), count);
        if let (Some(point), Some(sample)) = (points.last(), samples.last()) {
            assert_eq!(sample.pos_in_rest, *point);
        }
    }
}

/// The untouched object of the bounds tests.
const OBJECT: Aabb = Aabb {
    min: Vec3::new(-0.5, -0.4, -0.45),
    max: Vec3::new(0.5, 0.4, 0.45),
};

fn inside(aabb: Aabb, pos: Vec3) -> bool {
    // Material on the very edge of the object is not argued about.
    aabb.expanded(-1e-3).contains(pos)
}

#[test]
fn outside_its_reach_a_template_changes_nothing() {
    let (_gpu, probe) = probe();
    for kind in TemplateKind::FORMULAS {
        let mut random = Random(0xA11 + kind as u64);
        let (mut outside, mut changed_inside) = (0, 0);
        for _ in 0..200 {
            let template = random.template(kind);
            let reach = placed::reach(&template, &Resources::default());
            let points: Vec<Vec3> = (0..200)
                .map(|_| random.point(std::slice::from_ref(&template)))
                .collect();
            for (point, sample) in
                points
                    .iter()
                    .zip(ask(&probe, std::slice::from_ref(&template), &points))
            {
                let is_changed =
                    sample.pos_in_rest.distance(*point) > 1e-5 || sample.continuity < -1e-5;
                let q = template.placement.template_from_subject(*point);
                // Rounding of q itself.
                let is_outside = !reach.boxes.iter().any(|b| b.expanded(1e-4).contains(q));
                if is_outside {
                    outside += 1;
                    assert!(
                        !is_changed,
                        "{template:?}\n reaches {q} (subject {point}): {sample:?}"
                    );
                } else {
                    changed_inside += usize::from(is_changed);
                }
            }
        }
        println!("{kind:?}: {outside} points outside the reach, {changed_inside} changed inside");
        assert!(
            changed_inside > 100,
            "{kind:?}: the reach was hardly entered"
        );
    }
}

#[test]
fn no_material_leaves_the_deformed_bounds() {
    let (_gpu, probe) = probe();
    let mut random = Random(0xB0B);
    let (mut material, mut filled) = (0, 0.0);
    for round in 0..600 {
        let count = if round < 360 { 1 } else { 2 + random.index(5) };
        let mut list: Vec<PlacedTemplate> = Vec::new();
        for i in 0..count {
            let kind = TemplateKind::FORMULAS[if count == 1 {
                round % 18
            } else {
                random.index(18)
            }];
            let mut template = random.template(kind);
            if round % 3 == 1 {
                template.curve = Some(random.curve(template.placement.size));
            }
            // Two bends in one sum are the one case that is not bounded.
            if i > 0 && kind != TemplateKind::Bend && random.unit() < 0.3 {
                template.mode = TemplateMode::Add;
            }
            list.push(template);
        }
        let bounds = placed::deformed_bounds(&list, &Resources::default(), OBJECT);
        let farthest = placed::max_displacement(&list[0], &Resources::default(), OBJECT);
        let around = bounds.expanded(0.3 * bounds.size().max_element());
        let points: Vec<Vec3> = (0..300)
            .map(|_| {
                if random.unit() < 0.5 {
                    around.min + around.size() * random.vector(0.0, 1.0)
                } else {
                    random.point(&list)
                }
            })
            .collect();
        let mut held = Aabb::EMPTY;
        for (point, sample) in points.iter().zip(ask(&probe, &list, &points)) {
            if sample.continuity < 0.0 || !inside(OBJECT, sample.pos_in_rest) {
                continue;
            }
            material += 1;
            held = held.union(Aabb::from_points([*point]));
            assert!(
                bounds.expanded(1e-3).contains(*point),
                "{list:?}\n {point} is outside {bounds:?} but from {sample:?}"
            );
            if count == 1 {
                let moved = sample.pos_in_rest.distance(*point);
                assert!(
                    moved <= farthest * 1.001 + 1e-4,
                    "{list:?} moves {point} by {moved}, more than {farthest}"
                );
            }
        }
        if !held.is_empty() {
            filled += held.size().max_element() / bounds.size().max_element();
        }
    }
    println!(
        "{material} points with material, all in the bounds; their longest side filled to {:.2} on average",
        filled / 600.0
    );
}

/// The crack of the page, for five seeds and both signs of `cycles`, in boxes of several shapes. At an amount of 0 its
/// walls fit into each other: nothing is moved, and there is no gap.
#[test]
fn cracks_are_those_of_the_page() {
    let (_gpu, probe) = probe();
    let mut random = Random(0xC4AC_0001);
    for seed in [0.0, 1.0, 7.0, 500.0, 999.0] {
        for cycles in [-3.5, 5.0] {
            for size in [Vec3::splat(0.5), Vec3::new(0.6, 0.3, 0.9)] {
                let mut crack = random.template(TemplateKind::Crack);
                crack.placement.size = size;
                let values = [0.4, 0.8, 0.9, 0.2, 0.15, seed, 0.1, cycles];
                crack.params = values.map(ParamValue::Number).to_vec();
                let list = [crack];
                let points: Vec<Vec3> = (0..500).map(|_| random.point(&list)).collect();
                let mut tally = Tally::default();
                tally.add(&list, &points, &ask(&probe, &list, &points));
                tally.check(&format!("crack, seed {seed}, {cycles} waves"));
                // Another seed is another crack: the comparison would see it.
                let mut other = list.clone();
                other[0].params[5] = ParamValue::Number(seed + 1.0);
                let pairs = ask(&probe, &list, &points)
                    .into_iter()
                    .zip(ask(&probe, &other, &points));
                let is_off =
                    |(a, b): &(Sample, Sample)| a.pos_in_rest.distance(b.pos_in_rest) > 1e-3;
                let differing = pairs.filter(is_off).count();
                assert!(differing > 25, "only {differing} points tell seed {seed}");
                // The handle is where the wall is: both have the same noise.
                let grip = placed::handle(&list[0]).expect("a crack has a handle").at;
                let at_wall = ask(&probe, &list, &[grip])[0].continuity;
                assert!(at_wall.abs() < 1e-4, "the handle is {at_wall} off the wall");
                let mut closed = list.clone();
                closed[0].params[0] = ParamValue::Number(0.0);
                for (point, sample) in points.iter().zip(ask(&probe, &closed, &points)) {
                    assert_eq!((sample.pos_in_rest, sample.continuity), (*point, 1.0));
                }
            }
        }
    }
}
