//! Displacements that are drawn (`rbf`) or imported (`field`): WGSL numbers against plain f64 readings.

#[path = "reference/rbf.rs"]
mod reference;
mod scatter;

use fabrica::document::{
    ControlPoint, ControlPoints, Document, ParamValue, PlacedTemplate, TemplateData, TemplateKind,
};
use fabrica::math::Placement;
use fabrica::render::{Gpu, GpuOptions, Probe, Sample};
use glam::{DVec3, Quat, Vec2, Vec3};
use reference::Rbf;
use scatter::{Random, placed};

fn probe() -> Probe {
    let options = GpuOptions {
        adapter: None,
        is_strict: true,
    };
    let gpu = pollster::block_on(Gpu::open(&options)).expect("an adapter (lavapipe is enough)");
    pollster::block_on(Probe::new(&gpu)).expect("the probe program compiles")
}

fn ask(probe: &Probe, list: &[PlacedTemplate], points: &[Vec3]) -> Vec<Sample> {
    let mut illustration = Document::new().illustration().clone();
    illustration.templates = list.to_vec();
    pollster::block_on(probe.samples(&illustration, points)).expect("samples")
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
    let numbers = [
        random.number(0.5, 1.0, 1.0),
        random.number(0.1, 0.3, 0.2),
        [-0.5, -1.0, 0.5][random.index(3)],
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
        // Too few points of one side do not determine its polynomial; what is drawn then is no matter of the source.
        return rbf(random, with_cut);
    }
    template.data = TemplateData::Points(ControlPoints { points, cut });
    (template, plain)
}

/// Largest difference over points of the box, in subject units and in continuity, and how many lie in gaps. Points from which a step of
/// the rounding of their own coordinates changes the answer are left out.
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
            // What is wrong must be seen: points moved elsewhere.
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
        let reach = fabrica::displace::reach(&template);
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

#[test]
fn hard_systems_of_points_stay_tame() {
    // Very soft, close together, doubled, in a line: finite, and near the points' displacements where they do not contradict.
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
