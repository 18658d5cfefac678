//! Displacements that are drawn (`rbf`) or imported (`field`): WGSL numbers against plain f64 readings.

use crate::gpu::gpu;
use crate::long::long_or;
use crate::rbf::Rbf;
use crate::scatter::{Random, placed};
use fabrica::data::{FieldKey, FieldSamples, Grid, Resources};
use fabrica::document::{
    ControlPoint, ControlPoints, Document, FieldRef, ParamValue, PlacedTemplate, TemplateData,
    TemplateKind,
};
use fabrica::load::{FieldFile, FieldUse, MemoryFiles, read_field};
use fabrica::math::Placement;
use fabrica::render::{Probe, Sample};
use glam::{DAffine3, DQuat, DVec3, Quat, UVec3, Vec2, Vec3};
use std::sync::Arc;

fn probe() -> Probe {
    pollster::block_on(Probe::new(gpu())).expect("the probe program compiles")
}

fn ask(probe: &Probe, list: &[PlacedTemplate], points: &[Vec3]) -> Vec<Sample> {
    ask_with(probe, list, &Resources::default(), points)
}

fn ask_with(
    probe: &Probe,
    list: &[PlacedTemplate],
    resources: &Resources,
    points: &[Vec3],
) -> Vec<Sample> {
    let mut illustration = Document::new().illustration().clone();
    illustration.templates = list.to_vec();
    pollster::block_on(probe.samples(&illustration, resources, points)).expect("samples")
}

/// Places well apart, with displacements that keep tissue from folding much.
fn points(random: &mut Random, count: usize, is_flat: bool) -> Vec<ControlPoint> {
    let mut points: Vec<ControlPoint> = Vec::new();
    while points.len() < count {
        let at = random.vector(0.0, 1.0);
        let way = |p: &ControlPoint| {
            (p.at - at)
                * if is_flat {
                    Vec3::new(1.0, 1.0, 0.0)
                } else {
                    Vec3::ONE
                }
        };
        if points.iter().all(|p| way(p).length() > 0.1) {
            points.push(ControlPoint {
                at,
                shift: random.vector(-0.1, 0.1),
            });
        }
    }
    points
}

fn rbf(random: &mut Random, with_cut: bool) -> (PlacedTemplate, Rbf) {
    let extrude = random.unit() < 0.3;
    let count = 10 + random.index(20);
    let points = points(random, count, extrude);
    let middle = random.between(0.4, 0.6);
    let cut = match with_cut {
        true => vec![
            Vec2::new(middle, 0.1),
            Vec2::new(middle + random.between(-0.15, 0.15), 0.5),
            Vec2::new(middle, 0.9),
        ],
        false => Vec::new(),
    };
    let softness = random.number(0.1, 0.3, 0.2);
    let exponent = [-0.5, -1.0, 0.5][random.index(3)];
    let numbers = [
        random.number(0.5, 1.0, 1.0),
        // Where the basis grows, so many points as soft as this have no sum that 32 bits hold without noise.
        if exponent > 0.0 {
            0.5 * softness
        } else {
            softness
        },
        exponent,
        0.0,
        random.number(0.0, 1.0, 0.3),
        [0.0, 0.2][random.index(2)],
    ];
    let mut params: Vec<ParamValue> = numbers.map(ParamValue::Number).to_vec();
    params[3] = ParamValue::Flag(extrude);
    let placement = Placement {
        at: random.vector(-0.2, 0.2),
        rotate: random.rotation(),
        size: random.vector(0.3, 0.9),
    };
    let mut template = placed(TemplateKind::Rbf, placement, params);
    let plain = Rbf {
        points: points
            .iter()
            .map(|p| (p.at.as_dvec3(), p.shift.as_dvec3()))
            .collect(),
        softness: numbers[1].into(),
        exponent: numbers[2].into(),
        strength: numbers[0].into(),
        extrude,
        falloff: numbers[4].into(),
        edge: numbers[5].into(),
        cut: cut.iter().map(|p: &Vec2| p.as_dvec2()).collect(),
    };
    let left = |p: &&(DVec3, DVec3)| plain.is_left(p.0.truncate());
    let n_left = plain.points.iter().filter(left).count();
    if with_cut && (n_left < 5 || n_left + 5 > plain.points.len()) {
        // Too few points on one side do not determine its polynomial; the source does not tell what to draw then.
        return rbf(random, with_cut);
    }
    template.data = TemplateData::Points(ControlPoints { points, cut });
    (template, plain)
}

/// Largest difference over points of the box, in subject units and in continuity, and how many lie in gaps. Points from
/// which a step of the rounding of their own coordinates changes the answer are left out.
fn compare(
    template: &PlacedTemplate,
    plain: &Rbf,
    at: &[Vec3],
    got: &[Sample],
) -> (f64, usize, usize) {
    let p = template.placement;
    let size = p.size.as_dvec3();
    let rotate = glam::DQuat::from_array(p.rotate.to_array().map(f64::from)).normalize();
    let (mut worst, mut gaps, mut left_out) = (0.0_f64, 0, 0);
    for (pos, sample) in at.iter().zip(got) {
        let q = rotate.inverse() * (pos.as_dvec3() - p.at.as_dvec3()) / size + 0.5;
        let (source, continuity) = plain.source(q);
        let is_firm = [DVec3::X, DVec3::Y, DVec3::Z].iter().all(|axis| {
            [-1e-6, 1e-6].iter().all(|by| {
                let (near, a) = plain.source(q + *axis * *by);
                near.distance(source) < 1e-4 && (a - continuity).abs() < 1e-4
            })
        });
        if !is_firm {
            left_out += 1;
            continue;
        }
        gaps += usize::from(continuity < 0.0);
        let expected = pos.as_dvec3() + rotate * (size * (source - q));
        let off = expected.distance(sample.pos_in_rest.as_dvec3());
        let off = off.max((f64::from(sample.continuity) - continuity).abs());
        worst = worst.max(off);
    }
    (worst, gaps, left_out)
}

#[test]
fn control_points_agree_with_the_reference() {
    let probe = probe();
    for with_cut in [false, true] {
        let mut random = Random(0x0B5E_55ED + u64::from(with_cut));
        let (mut worst, mut gaps, mut left_out, mut count) = (0.0_f64, 0, 0, 0);
        for _ in 0..60 {
            let (template, plain) = rbf(&mut random, with_cut);
            let at: Vec<Vec3> = (0..100)
                .map(|_| {
                    let q = random.vector(-0.1, 1.1);
                    template.placement.subject_from_template(q)
                })
                .collect();
            let got = ask(&probe, std::slice::from_ref(&template), &at);
            let (off, in_gaps, out) = compare(&template, &plain, &at, &got);
            if off > 1e-3 {
                println!("{off:e} off: {plain:?}");
            }
            worst = worst.max(off);
            gaps += in_gaps;
            left_out += out;
            count += at.len();
            // Negative control: points that are moved elsewhere must be seen as wrong.
            let mut wrong = plain.clone();
            wrong.points.iter_mut().for_each(|p| p.1 += 0.1);
            let (off, ..) = compare(&template, &wrong, &at, &got);
            assert!(off > 1e-2, "a wrong displacement is not noticed");
        }
        println!(
            "cut {with_cut}: {count} points, off by {worst:.1e}, {gaps} in gaps, {left_out} left out"
        );
        assert!(worst < 1e-3, "{worst:e}");
        assert!(left_out < count / 20);
        assert!(!with_cut || gaps > 50, "hardly a gap was looked at");
    }
}

#[test]
fn control_points_act_within_what_is_said_of_them() {
    let probe = probe();
    let mut random = Random(0xB0B0);
    for i in 0..40 {
        let (template, _) = rbf(&mut random, i % 2 == 0);
        let reach = fabrica::placed::reach(&template, &Resources::default());
        let fabrica::displace::Material::Shifted(shift) = reach.material else {
            panic!("an rbf shifts");
        };
        let at: Vec<Vec3> = (0..400)
            .map(|_| {
                let q = random.vector(0.0, 1.0);
                template.placement.subject_from_template(q)
            })
            .collect();
        for (pos, sample) in at
            .iter()
            .zip(ask(&probe, std::slice::from_ref(&template), &at))
        {
            let p = template.placement;
            let forward =
                p.template_from_subject(*pos) - p.template_from_subject(sample.pos_in_rest);
            let is_held =
                forward.cmpge(shift.min - 1e-4).all() && forward.cmple(shift.max + 1e-4).all();
            assert!(is_held, "{forward} is not in {shift:?}");
        }
    }
}

/// A template of these points in a box of one unit.
fn rbf_of(
    points: Vec<ControlPoint>,
    cut: Vec<Vec2>,
    softness: f32,
    exponent: f32,
) -> PlacedTemplate {
    let placement = Placement {
        at: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        size: Vec3::ONE,
    };
    let numbers = [1.0, softness, exponent, 0.0, 0.3, 0.0];
    let mut params: Vec<ParamValue> = numbers.map(ParamValue::Number).to_vec();
    params[3] = ParamValue::Flag(false);
    let mut template = placed(TemplateKind::Rbf, placement, params);
    template.data = TemplateData::Points(ControlPoints { points, cut });
    template
}

/// What the points of a set want.
#[derive(Clone, Copy, Debug)]
enum Motion {
    /// Each something else.
    Rough,
    /// Waves longer than the box, as tissue moves.
    Smooth,
}

/// Points anywhere in the box; the second beside the first if `beside` is not 0.
fn point_set(random: &mut Random, motion: Motion, count: usize, beside: Vec3) -> Vec<ControlPoint> {
    let waves = [(); 3].map(|()| {
        (
            random.vector(-3.0, 3.0),
            random.between(0.0, std::f32::consts::TAU),
        )
    });
    let mut places: Vec<Vec3> = (0..count).map(|_| random.vector(0.05, 0.95)).collect();
    if beside != Vec3::ZERO {
        places[1] = places[0] + beside;
    }
    let points = places.into_iter().map(|at| {
        let shift = match motion {
            Motion::Rough => random.vector(-0.1, 0.1),
            Motion::Smooth => {
                Vec3::from_array(waves.map(|(way, phase)| 0.1 * (way.dot(at) + phase).sin()))
            }
        };
        ControlPoint { at, shift }
    });
    points.collect()
}

/// A sixth of the softnesses are ends of their range.
fn softness_and_exponent(random: &mut Random) -> (f32, f32) {
    let softness = 0.01 * 200.0_f32.powf(random.number(0.0, 1.0, 0.565));
    let exponents = [
        -2.0, -1.5, -1.0, -0.7, -0.5, -0.3, -0.2, -0.1, 0.0, 0.1, 0.5, 0.7, 0.9,
    ];
    (
        softness.clamp(0.01, 2.0),
        exponents[random.index(exponents.len())],
    )
}

/// Points of every number, rough and smooth, close, over all softnesses and exponents, in boxes of other sizes,
/// stronger and weaker, with and without a cut: met to 1e-3 subject units, or named with the miss.
#[test]
fn control_points_are_met_or_named() {
    let probe = probe();
    let mut random = Random(0x0b01_71c6);
    let rounds = long_or(400, 80);
    for motion in [Motion::Rough, Motion::Smooth] {
        let (mut met, mut named, mut worst, mut untrue) = (0, 0, 0.0_f64, 0.0_f64);
        for round in 0..rounds {
            let count = 2 + random.index(63);
            let (softness, exponent) = softness_and_exponent(&mut random);
            // Two close, and every third time two at one place that want something else.
            let beside = random.vector(-1.0, 1.0).normalize_or_zero() * 0.005;
            let mut points = point_set(&mut random, motion, count, beside);
            if round % 3 == 0 && count > 3 {
                points[3].at = points[2].at + beside * 0.1;
                points[3].shift += random.vector(-0.1, 0.1);
            }
            let middle = random.between(0.4, 0.6);
            let cut = match round % 2 {
                0 => Vec::new(),
                _ => vec![Vec2::new(middle, 0.0), Vec2::new(middle, 1.0)],
            };
            let mut template = rbf_of(points.clone(), cut.clone(), softness, exponent);
            let (strength, edge) = (random.number(0.3, 2.0, 1.0), [0.0, 0.2][random.index(2)]);
            let is_flat = random.unit() < 0.25;
            template.params[0] = ParamValue::Number(strength);
            template.params[3] = ParamValue::Flag(is_flat);
            template.params[5] = ParamValue::Number(edge);
            template.placement = Placement {
                at: random.vector(-0.2, 0.2),
                rotate: random.rotation(),
                size: random.vector(0.2, 2.0),
            };
            let missed = fabrica::placed::missed_points(&template);
            let placement = template.placement;
            let at: Vec<Vec3> = points
                .iter()
                .map(|p| placement.subject_from_template(p.at))
                .collect();
            let got = ask(&probe, std::slice::from_ref(&template), &at);
            for (i, (point, sample)) in points.iter().zip(&got).enumerate() {
                // On the cut itself either side may answer.
                if !cut.is_empty() && (point.at.x - middle).abs() < 1e-5 {
                    continue;
                }
                let eased = |t: f32| {
                    let t = t.clamp(0.0, 1.0);
                    t * t * (3.0 - 2.0 * t)
                };
                let near = point.at.min(1.0 - point.at).to_array();
                let inner: f32 = match edge > 0.0 {
                    true => near.map(|away| eased(away / edge)).iter().product(),
                    false => 1.0,
                };
                // The falloff is 0.3.
                let across = match is_flat {
                    true => 1.0 - eased(((point.at.z - 0.5).abs() - 0.35) / 0.15),
                    false => 1.0,
                };
                let way = point.shift * placement.size * (strength * inner * across);
                let wanted = at[i] + placement.rotate * way;
                let miss = sample.pos_in_rest.as_dvec3().distance(wanted.as_dvec3());
                match missed.iter().find(|missed| missed.point == i) {
                    Some(told) => {
                        named += 1;
                        untrue = untrue.max((miss - f64::from(told.by)).abs() / miss);
                    }
                    None => {
                        met += 1;
                        worst = worst.max(miss);
                        assert!(
                            miss < 1e-3,
                            "{motion:?} {round}: {softness} {exponent} {count}: missed by {miss} without a word"
                        );
                    }
                }
            }
        }
        println!(
            "{motion:?}: {met} met, off by {worst:.1e} at most, {named} named, to {untrue:.1e} of the miss"
        );
        assert!(untrue < 0.1, "a miss is told wrong by {untrue} of it");
        assert!(named > 5 && met > 20 * named, "{named} named, {met} met");
    }
}

/// The map has no noise between places 1e-5 apart: over all softnesses and exponents, at any number of points.
#[test]
fn the_map_of_points_has_no_noise() {
    let probe = probe();
    let mut random = Random(0x0b01_71cf);
    let rounds = long_or(1000, 200);
    let (mut noise, mut slope_of_all) = (0.0_f64, 0.0_f64);
    for round in 0..rounds {
        let count = 2 + random.index(63);
        // Half of them broad: there the sums are large.
        let (softness, exponent) = softness_and_exponent(&mut random);
        let softness = if round % 2 == 0 {
            softness.max(0.3)
        } else {
            softness
        };
        let motion = [Motion::Rough, Motion::Smooth][random.index(2)];
        let points = point_set(&mut random, motion, count, Vec3::ZERO);
        let mut template = rbf_of(points, Vec::new(), softness, exponent);
        let strength = random.number(0.5, 2.0, 1.0);
        template.params[0] = ParamValue::Number(strength);
        // Three places in a row: what a straight line does not explain. And two farther apart, for the slope; the steps
        // themselves are rounded by up to 1 %.
        let steps = [-1e-5, 0.0, 1e-5, -2e-4, 2e-4].map(|step| Vec3::X * step);
        let rows: Vec<Vec3> = (0..60)
            .map(|_| random.vector(-0.49, 0.49))
            .flat_map(|center| steps.map(|step| center + step))
            .collect();
        let got = ask(&probe, &[template], &rows);
        for (row, at) in got.chunks_exact(5).zip(rows.chunks_exact(5)) {
            let [a, b, c, low, high] =
                [0, 1, 2, 3, 4].map(|k| (row[k].pos_in_rest - at[k]).as_dvec3());
            let off = (0.5 * (a + c) - b).length();
            let slope = (high - b).length().max((b - low).length()) / 2e-4;
            noise = noise.max(off);
            slope_of_all = slope_of_all.max(slope);
            for step in [a - b, c - b] {
                assert!(
                    step.length() < 1e-5 + 1.01e-5 * slope,
                    "{softness} {exponent} {count} {motion:?} {strength}: places beside each other differ by {} at a \
                     slope of {slope}",
                    step.length()
                );
            }
        }
    }
    println!("noise {noise:.1e}, slopes up to {slope_of_all:.1}");
    assert!(noise < 1e-5, "places beside each other differ by {noise:e}");
}

/// What stands on one side of a cut changes nothing on the other, to the bit.
#[test]
fn the_sides_of_a_cut_are_independent() {
    let probe = probe();
    let mut random = Random(0x0b01_71c7);
    let cut = vec![Vec2::new(0.5, 0.0), Vec2::new(0.5, 1.0)];
    for (softness, exponent) in [
        (0.05, -0.5),
        (1.0, -0.5),
        (0.3, -2.0),
        (1.0, 0.0),
        (0.3, 0.5),
        (1.0, 0.9),
    ] {
        let side = |random: &mut Random, low: f32| -> Vec<ControlPoint> {
            (0..12)
                .map(|_| ControlPoint {
                    at: random.vector(0.0, 1.0) * Vec3::new(0.4, 1.0, 1.0) + Vec3::X * low,
                    shift: random.vector(-0.1, 0.1),
                })
                .collect()
        };
        let (left, right, other) = (
            side(&mut random, 0.05),
            side(&mut random, 0.55),
            side(&mut random, 0.55),
        );
        let with = |right: &[ControlPoint]| {
            rbf_of([&left, right].concat(), cut.clone(), softness, exponent)
        };
        let at: Vec<Vec3> = (0..400).map(|_| random.vector(-0.5, 0.5)).collect();
        let (one, two) = (
            ask(&probe, &[with(&right)], &at),
            ask(&probe, &[with(&other)], &at),
        );
        let (mut same, mut differing) = (0, 0);
        for (pos, (one, two)) in at.iter().zip(one.iter().zip(&two)) {
            if pos.x < 0.0 {
                assert_eq!(one, two, "{pos} is left of the cut");
                same += 1;
            } else {
                differing += usize::from(one != two);
            }
        }
        assert!(same > 100 && differing > 100, "{same}, {differing}");
    }
}

#[test]
fn hard_systems_of_points_stay_tame() {
    // Very soft, close together, doubled, in a line: finite, and near the points' displacements where they do not
    // contradict.
    let probe = probe();
    let mut random = Random(77);
    for softness in [0.01, 0.2, 2.0] {
        for spread in [0.0, 1e-4, 0.02, 1.0] {
            for exponent in [-2.0, -0.5, 0.0, 0.5, 0.9] {
                let points: Vec<ControlPoint> = (0..64)
                    .map(|i| ControlPoint {
                        at: Vec3::splat(0.5) + random.vector(-0.5, 0.5) * spread,
                        shift: Vec3::new(0.1, 0.0, -0.05) * if i % 3 == 0 { 1.0 } else { 0.9 },
                    })
                    .collect();
                let placement = Placement {
                    at: Vec3::ZERO,
                    rotate: Quat::IDENTITY,
                    size: Vec3::ONE,
                };
                let numbers = [1.0, softness, exponent, 0.0, 0.3, 0.0];
                let mut params: Vec<ParamValue> = numbers.map(ParamValue::Number).to_vec();
                params[3] = ParamValue::Flag(false);
                let mut template = placed(TemplateKind::Rbf, placement, params);
                let at: Vec<Vec3> = points.iter().map(|p| p.at - 0.5).collect();
                template.data = TemplateData::Points(ControlPoints {
                    points,
                    cut: Vec::new(),
                });
                for (pos, sample) in at.iter().zip(ask(&probe, &[template], &at)) {
                    let shift = sample.pos_in_rest - *pos;
                    assert!(shift.is_finite(), "{softness} {spread} {exponent}");
                    let off = shift.distance(Vec3::new(0.095, 0.0, -0.0475));
                    assert!(off < 0.1, "{softness} {spread} {exponent}: {shift}");
                }
            }
        }
    }
}

// ------------------------------------------------------------------------------------------------ files

/// A grid of 100 mm, 50 voxels along each side, in the middle of the world.
fn subject() -> Grid {
    Grid {
        dims: UVec3::splat(50),
        world_from_voxel: DAffine3::from_scale_rotation_translation(
            DVec3::splat(2.0),
            DQuat::IDENTITY,
            DVec3::splat(-49.0),
        ),
    }
}

fn used(subject: &Grid) -> FieldUse<'_> {
    FieldUse {
        is_subject_units: false,
        is_lps: None,
        subject,
    }
}

/// An NRRD of 8 x 10 x 12 samples of 10 mm, left posterior superior, with these numbers per sample.
fn nrrd(components: usize, value: impl Fn(usize, [usize; 3]) -> f32) -> Vec<u8> {
    let mut bytes = format!(
        "NRRD0004\ntype: float\ndimension: 4\nspace: left-posterior-superior\nsizes: {components} 8 10 12\n\
         space directions: none (-10,0,0) (0,-10,0) (0,0,10)\nkinds: vector domain domain domain\n\
         endian: little\nencoding: raw\nspace origin: (35,45,-55)\n\n"
    )
    .into_bytes();
    for z in 0..12 {
        for y in 0..10 {
            for x in 0..8 {
                for c in 0..components {
                    bytes.extend(value(c, [x, y, z]).to_le_bytes());
                }
            }
        }
    }
    bytes
}

/// A NIfTI with five dimensions and an intent: 4 x 5 x 6 samples of 10 mm about 0, a constant vector.
fn nifti(intent: i16, vector: [f32; 3]) -> Vec<u8> {
    let mut bytes = vec![0; 352];
    let mut put = |at: usize, part: &[u8]| bytes[at..at + part.len()].copy_from_slice(part);
    put(0, &348i32.to_le_bytes());
    for (i, n) in [5i16, 4, 5, 6, 1, 3].into_iter().enumerate() {
        put(40 + 2 * i, &n.to_le_bytes());
    }
    put(68, &intent.to_le_bytes());
    put(70, &16i16.to_le_bytes());
    put(72, &32i16.to_le_bytes());
    for i in 0..6 {
        put(
            76 + 4 * i,
            &(if i == 0 { 1f32 } else { 10.0 }).to_le_bytes(),
        );
    }
    put(108, &352f32.to_le_bytes());
    put(123, &[2]);
    put(254, &1i16.to_le_bytes());
    for (row, origin) in [-15f32, -20.0, -25.0].into_iter().enumerate() {
        put(280 + 16 * row + 4 * row, &10f32.to_le_bytes());
        put(280 + 16 * row + 12, &origin.to_le_bytes());
    }
    put(344, b"n+1\0");
    for component in vector {
        for _ in 0..4 * 5 * 6 {
            bytes.extend(component.to_le_bytes());
        }
    }
    bytes
}

fn field(name: &str, bytes: Vec<u8>) -> Result<FieldFile, String> {
    read_field(&mut MemoryFiles::new([(name, bytes)]), name).map_err(|error| error.to_string())
}

/// The template that a file makes where it says itself, with its samples.
fn laid(file: &FieldFile, given: &FieldUse<'_>) -> (PlacedTemplate, Resources, Vec<String>) {
    let (samples, notices) = file.fit(given).expect("it fits");
    let params = crate::scatter::defaults(TemplateKind::Field);
    // The document says nothing of its place.
    let mut template = placed(TemplateKind::Field, Placement::DOCUMENT_DEFAULT, params);
    template.data = TemplateData::Field(FieldRef {
        sha256: Some(file.sha256.clone()),
        ..FieldRef::default()
    });
    let mut resources = Resources::default();
    let key = FieldKey::of(&template).expect("it names a file");
    resources.add_field(key, FieldSamples(Arc::new(samples)));
    (template, resources, notices)
}

#[test]
fn fields_move_as_their_files_say() {
    let probe = probe();
    let grid = subject();
    let at = [
        Vec3::new(0.1, 0.05, -0.2),
        Vec3::new(-0.15, 0.1, 0.15),
        Vec3::splat(0.49),
    ];
    // 10 mm to the left and 5 mm up, growing with z: linear, so that it is drawn exactly.
    let file = field(
        "warp.nrrd",
        nrrd(3, |c, [_, _, z]| [10.0, 0.0, 0.5 * z as f32][c]),
    )
    .expect("read");
    let (template, resources, notices) = laid(&file, &used(&grid));
    assert_eq!(notices, Vec::<String>::new());
    // Without its samples it is at rest.
    for (pos, got) in at
        .iter()
        .zip(ask(&probe, std::slice::from_ref(&template), &at))
    {
        assert_eq!(got.pos_in_rest, *pos);
    }
    for (pos, got) in at
        .iter()
        .zip(ask_with(&probe, &[template], &resources, &at))
    {
        // The third lies beyond the field's faces.
        let is_inside = pos.x < 0.4;
        let slice = ((pos.z * 100.0 + 55.0) / 10.0).clamp(0.0, 11.0);
        let expected = match is_inside {
            true => *pos + Vec3::new(-0.1, 0.0, 0.005 * slice),
            false => *pos,
        };
        let off = got.pos_in_rest.distance(expected);
        assert!(
            off < 2e-4,
            "{pos}: {} instead of {expected}",
            got.pos_in_rest
        );
    }
    // NIfTI vectors are left posterior superior as ITK writes them, but right anterior superior by intent 1006, and as
    // the document says.
    for (intent, is_lps, sign) in [
        (1007, None, -1.0),
        (1006, None, 1.0),
        (1007, Some(false), 1.0),
        (1006, Some(true), -1.0),
    ] {
        let file = field("warp.nii", nifti(intent, [5.0, 10.0, 2.0])).expect("read");
        let (template, resources, _) = laid(
            &file,
            &FieldUse {
                is_lps,
                ..used(&grid)
            },
        );
        let at = [Vec3::new(0.01, 0.02, 0.03)];
        let got = ask_with(&probe, &[template], &resources, &at)[0].pos_in_rest;
        let expected = Vec3::new(0.01 + sign * 0.05, 0.02 + sign * 0.1, 0.05);
        assert!(got.distance(expected) < 2e-4, "{intent} {is_lps:?}: {got}");
    }
    // The fourth number is the continuity.
    let file = field(
        "a.nrrd",
        nrrd(4, |c, [x, ..]| if c == 3 { x as f32 - 3.5 } else { 0.0 }),
    )
    .expect("read");
    let (template, resources, _) = laid(&file, &used(&grid));
    let got = ask_with(
        &probe,
        &[template],
        &resources,
        &[Vec3::new(-0.05, 0.0, 0.0), Vec3::new(0.05, 0.0, 0.0)],
    );
    assert!(
        (got[0].continuity + 0.5).abs() < 1e-3 && (got[1].continuity - 0.5).abs() < 1e-3,
        "{got:?}"
    );
}

#[test]
fn what_is_wrong_with_a_field_is_said() {
    let grid = subject();
    let plain = |c: usize, _: [usize; 3]| [10.0, 0.0, 0.0][c];
    for (name, bytes, part) in [
        ("two.nrrd", nrrd(2, plain), "it has 2 numbers per sample"),
        (
            "five.nrrd",
            nrrd(5, |_, _| 0.0),
            "it has 5 numbers per sample",
        ),
        (
            "nan.nrrd",
            nrrd(3, |c, at| {
                if at == [1, 2, 3] {
                    f32::NAN
                } else {
                    plain(c, at)
                }
            }),
            "1 of its samples are no numbers",
        ),
        (
            "short.nrrd",
            nrrd(3, plain)[..4000].to_vec(),
            "ends too early",
        ),
        ("empty.nrrd", Vec::new(), "empty"),
        ("no.nrrd", b"hello".to_vec(), "not a volume file"),
        (
            "few.csv",
            b"x,y,z,dx,dy,dz\n1,2,3,0,0,0\n".to_vec(),
            "1 nodes make no field",
        ),
        (
            "odd.csv",
            b"1,2,3,0,0,0\n1,2,3,4\n".to_vec(),
            "line 2 should be",
        ),
        ("nan.csv", b"1,2,3,0,0,nan\n".to_vec(), "line 1 holds"),
        (
            "one.csv",
            "5 5 5 0 0 0\n".repeat(9).into_bytes(),
            "at one place",
        ),
        ("text.csv", vec![b'x'; 1 << 16], "line"),
        ("bytes.csv", vec![0; 100], "0 nodes"),
    ] {
        let message = field(name, bytes).expect_err(name);
        assert!(
            message.contains(part) && message.contains(name),
            "{name}: {message}"
        );
    }
    let refused = |bytes: Vec<u8>, part: &str| {
        let file = field("f.nrrd", bytes).expect("read");
        let message = file.fit(&used(&grid)).expect_err(part);
        assert!(message.contains(part), "{message}");
    };
    let text = |from: &str, to: &str| {
        let bytes = nrrd(3, plain);
        let at = bytes
            .windows(from.len())
            .position(|part| part == from.as_bytes())
            .expect(from);
        [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()
    };
    refused(
        text("(35,45,-55)", "(35,45,900)"),
        "lies beside the subject",
    );
    refused(text("(0,-10,0)", "(3,-10,0)"), "skewed");
    refused(nrrd(3, |_, _| 1e9), "the unit is another one");
    // Folding: neighbours change places.
    let file = field(
        "f.nrrd",
        nrrd(3, |c, [x, ..]| if c == 0 && x == 4 { 25.0 } else { 0.0 }),
    )
    .expect("read");
    let (_, _, notices) = laid(&file, &used(&grid));
    assert!(
        notices
            .iter()
            .any(|line| line.contains("folds space over itself")),
        "{notices:?}"
    );
}

#[test]
fn nodes_of_a_simulation_are_regularised() {
    // A bar pulled to twice its length along x and shifted: forwards x' = 2x + 10 mm, so back x = (x' - 10)/2.
    let mut table = String::from("# a bar\nx; y; z; ux; uy; uz\n");
    for i in 0..10 * 10 * 10 {
        let at = [i % 10, i / 10 % 10, i / 100].map(|k| k as f64 * 3.0 - 13.5);
        table.push_str(&format!(
            "{}; {}; {}; {}; 0; 0\n",
            at[0],
            at[1],
            at[2],
            at[0] + 10.0
        ));
    }
    let grid = subject();
    let file = field("bar.csv", table.into_bytes()).expect("a table");
    let (template, resources, notices) = laid(&file, &used(&grid));
    assert!(notices[0].starts_with("1000 nodes"), "{notices:?}");
    let mut random = Random(5);
    let at: Vec<Vec3> = (0..200)
        .map(|_| {
            Vec3::new(
                random.between(-0.15, 0.35),
                random.between(-0.13, 0.13),
                random.between(-0.13, 0.13),
            )
        })
        .collect();
    let (mut worst, mut mean) = (0.0_f32, 0.0);
    for (pos, got) in at
        .iter()
        .zip(ask_with(&probe(), &[template], &resources, &at))
    {
        let expected = Vec3::new((pos.x - 0.1) / 2.0, pos.y, pos.z);
        let off = got.pos_in_rest.distance(expected);
        worst = worst.max(off);
        mean += off / at.len() as f32;
    }
    println!("nodes: off by {worst} at most, {mean} in the mean");
    // Shepard's interpolation is off by a part of the way between nodes (6 mm), most between two layers.
    assert!(worst < 0.02 && mean < 0.006, "{worst} {mean}");
}

#[test]
fn an_exported_map_is_the_same_map_when_it_comes_back() {
    let folder = std::env::temp_dir().join(format!("fabrica-fields-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let run = |args: &[&str], input: &str| {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_fabrica"))
            .args(args)
            .current_dir(&folder)
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::piped())
            .spawn()
            .expect("the program");
        std::io::Write::write_all(&mut child.stdin.take().expect("open"), input.as_bytes())
            .expect("taken");
        let out = child.wait_with_output().expect("it ends");
        assert!(out.status.success(), "{args:?}");
        String::from_utf8(out.stdout).expect("text")
    };
    let numbers = |text: &str| -> Vec<Vec<f64>> {
        text.lines()
            .map(|line| {
                line.split(',')
                    .map(|x| x.parse().expect("a number"))
                    .collect()
            })
            .collect()
    };
    std::fs::write(
        folder.join("back.json"),
        r#"{"fabrica":1,"subject":{"builtin":"bar"},"templates":[{"kind":"field","params":{"src":"map.nrrd"}}]}"#,
    )
    .expect("written");
    let mut random = Random(11);
    let points: String = (0..3000)
        .map(|_| {
            let p = random.vector(-0.2, 0.2) * Vec3::new(1.0, 2.2, 1.0);
            format!("{},{},{}\n", p.x, p.y, p.z)
        })
        .collect();
    // Smooth templates, and one that opens a gap; a sweep.
    let opened = r#"
        {"kind":"twist","rotate":[0.7071,0,0,0.7071],"size":[0.6,0.6,1],"params":{"angle":0.8}},
        {"kind":"pull","size":[0.6,0.9,0.6],"params":{"offset":[0,0,0.2]}},
        {"kind":"split","size":[0.5,0.8,0.5],"params":{"amount":0.1,"lens":1}}"#;
    let swept = r#"{"kind":"sweep","params":{"tools":[{"radius":0.15,"path":[{"at":[0.4,0.5,0.5]},{"at":[0.6,0.6,0.5]}]}]}}"#;
    for (templates, has_gap) in [(opened, true), (swept, false)] {
        let document =
            format!(r#"{{"fabrica":1,"subject":{{"builtin":"bar"}},"templates":[{templates}]}}"#);
        std::fs::write(folder.join("doc.json"), document).expect("written");
        let to = ["-o", "map.nrrd", "--size", "96"];
        run(&[&["export-field", "doc.json"][..], &to].concat(), "");
        let was = numbers(&run(&["probe", "doc.json"], &points));
        let is = numbers(&run(&["probe", "back.json"], &points));
        let moved = was.iter().filter(|row| row[..3] != row[3..6]).count();
        assert!(moved > 500, "{moved} points are moved");
        assert_it_came_back(&was, &is, has_gap);
    }
    let _left = std::fs::remove_dir_all(&folder);
}

/// The sources of points by a map, and by the file that was written of the map.
fn assert_it_came_back(was: &[Vec<f64>], is: &[Vec<f64>], has_gap: bool) {
    let (mut smooth, mut other_side, mut count, mut gaps) = (0.0_f64, 0, 0, 0);
    for (was, is) in was.iter().zip(is) {
        gaps += usize::from(was[6] < 0.0);
        // A gap is found to within a sample; its edges are where the map bends.
        other_side += usize::from((was[6] < 0.0) != (is[6] < 0.0));
        if was[6] > 0.05 {
            let off = (3..6).map(|i| (was[i] - is[i]).powi(2)).sum::<f64>().sqrt();
            smooth = smooth.max(off);
            count += 1;
        }
    }
    println!(
        "exported: off by {smooth:.1e} at {count} points; {gaps} in gaps, {other_side} on the other side"
    );
    assert!(count > 1500 && (gaps > 20) == has_gap, "{count}, {gaps}");
    // A hundredth of a side per sample: half the second derivative times its square, and steps where templates end.
    assert!(smooth < 6e-3, "{smooth}");
    match has_gap {
        true => assert!(other_side * 5 < gaps, "{other_side} of {gaps}"),
        false => assert_eq!((gaps, other_side), (0, 0), "nothing is opened"),
    }
}
