//! The facts about each kind, compared with its formula: the main parameter, as constraints by
//! coordinate scale it, and the mirror image.

use crate::gpu::{builtin, gpu, studio_of};
use crate::reference::{self, as_reference};
use crate::scatter::{Random, placed};
use fabrica::data::Resources;
use fabrica::document::{
    Constrain, ConstrainBy, Illustration, ParamValue, PlacedTemplate, Plane, TemplateKind, mirrored,
};
use fabrica::math::Placement;
use fabrica::placed::max_displacement;
use fabrica::render::gpu_types::Templates;
use fabrica::render::{Probe, Sample};
use glam::{DVec3, Quat, Vec3};
use std::ops::Range;

/// Farther off than this (subject units) is wrong: ten times the bound of the formulas, since a part of a displacement
/// is measured.
const BOUND: f64 = 1e-3;
/// Share of points that may be wrong: those at a jump of the map.
const AT_JUMPS: f64 = 0.03;

/// Where the main parameter lies among the floats of a kind, written out once more.
fn main_floats(kind: TemplateKind) -> Range<usize> {
    match kind {
        TemplateKind::Cut => 0..0,
        TemplateKind::Pull | TemplateKind::Move => 0..3,
        TemplateKind::Slices => 3..4,
        _ => 0..1,
    }
}

/// Where the template takes a point from if a part of its main parameter is done.
fn done_partly(template: &PlacedTemplate, main: Range<usize>, part: f64, pos: DVec3) -> DVec3 {
    let mut plain = as_reference(std::slice::from_ref(template));
    plain[0].params[main].iter_mut().for_each(|p| *p *= part);
    reference::map(&plain, pos).0
}

/// Constraint by coordinate does a part of the main parameter, and of nothing else. The part comes from the constraint
/// by displacement, which scales the displacement by the same part.
#[test]
fn constraints_by_coordinate_scale_the_main_parameter() {
    let volume = builtin("knee", 64);
    let studio = studio_of(gpu(), &volume, false);
    let bounds = volume.grid.subject_bounds();
    let keep: Vec<String> = ["femur", "tibia"].map(str::to_owned).to_vec();
    let mut random = Random(0x0b01_e5ec);
    for kind in TemplateKind::FORMULAS {
        let placement = Placement {
            at: Vec3::ZERO,
            rotate: Quat::IDENTITY,
            size: Vec3::new(0.5, 0.5, 0.9),
        };
        let mut free = PlacedTemplate::new(kind, placement);
        if kind == TemplateKind::Crack {
            // By default it is narrower than what is asked about here.
            free.params[0] = ParamValue::Number(0.4);
        }
        // Around the box as well: an open flap stands above it.
        let points: Vec<Vec3> = (0..3000)
            .map(|_| free.subject_from_template(random.vector(-0.5, 1.5)))
            .collect();
        let constrained = |by| {
            let mut scene = Illustration::document_default();
            let constrain = Some(Constrain {
                by,
                keep: keep.clone(),
            });
            scene.templates = vec![PlacedTemplate {
                constrain,
                ..free.clone()
            }];
            pollster::block_on(studio.probe_object(&scene, &points)).expect("samples")
        };
        let by_displacement = constrained(ConstrainBy::Displacement);
        let by_coordinate = constrained(ConstrainBy::Coordinate);
        let longest = f64::from(max_displacement(&free, &Resources::default(), bounds));
        let (mut asked, mut wrong, mut wrong_unscaled) = (0, 0, 0);
        for ((point, one), other) in points.iter().zip(&by_displacement).zip(&by_coordinate) {
            let pos = point.as_dvec3();
            let whole = done_partly(&free, 0..0, 1.0, pos) - pos;
            let part = (one.pos_in_rest.as_dvec3() - pos).length() / whole.length();
            let is_there = one.continuity >= 0.0 && other.continuity >= 0.0;
            if whole.length() < 0.02 || !(0.05..0.95).contains(&part) || !is_there {
                continue;
            }
            asked += 1;
            let off = |main: Range<usize>| {
                let way = done_partly(&free, main, part, pos) - pos;
                let limited = way.clamp_length_max(part * longest);
                (pos + limited).distance(other.pos_in_rest.as_dvec3())
            };
            wrong += usize::from(off(main_floats(kind)) > BOUND);
            wrong_unscaled += usize::from(off(0..0) > BOUND);
        }
        println!("{kind:?}: {asked} asked, {wrong} wrong, {wrong_unscaled} if nothing were scaled");
        if kind == TemplateKind::Cut {
            assert_eq!(asked, 0, "a cut moves nothing");
            continue;
        }
        assert!(asked > 20, "{kind:?}: only {asked} points");
        let most = AT_JUMPS * f64::from(asked);
        assert!(wrong as f64 <= most, "{kind:?}: {wrong} of {asked} wrong");
        assert!(
            wrong_unscaled as f64 > 0.3 * f64::from(asked),
            "{kind:?}: the comparison would not see another main parameter"
        );
    }
}

fn ask(probe: &Probe, template: &PlacedTemplate, points: &[Vec3]) -> Vec<Sample> {
    let packed = Templates::pack(std::slice::from_ref(template), &Resources::default());
    pollster::block_on(probe.samples_of(&packed, points)).expect("samples")
}

/// The mirror image of a template is the mirror image of its map.
#[test]
fn mirror_images_are_those_of_the_map() {
    let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
    let mut random = Random(0x0b01_e5ed);
    let reflected = |v: Vec3| Vec3::new(-v.x, v.y, v.z);
    for kind in TemplateKind::FORMULAS {
        // Some of the random ones do nothing.
        let (mut asked, mut wrong, mut wrong_unmirrored) = (0, 0, 0);
        for _ in 0..4 {
            let template = random.template(kind);
            let placement = Placement {
                size: Vec3::new(0.5, 0.6, 0.7),
                ..template.placement
            };
            let mut params = template.params;
            if kind == TemplateKind::Crack {
                // Its teeth and waves stay as they are: no parameter tells them from those of the mirror image.
                let names = kind.spec().params.iter().map(|param| param.name);
                for (value, name) in params.iter_mut().zip(names) {
                    if name == "roughness" || name == "ripple" {
                        *value = ParamValue::Number(0.0);
                    }
                }
            }
            let template = placed(kind, placement, params);
            let (placement, params) = mirrored(&template, Plane::Sagittal);
            let image = placed(kind, placement, params);
            let points: Vec<Vec3> = (0..200)
                .map(|_| template.subject_from_template(random.vector(-0.3, 1.3)))
                .collect();
            let seen_in_mirror: Vec<Vec3> = points.iter().copied().map(reflected).collect();
            let here = ask(&probe, &template, &points);
            let count_wrong = |samples: &[Sample]| {
                let pairs = here.iter().zip(samples);
                let is_wrong = |(a, b): &(&Sample, &Sample)| {
                    let away = reflected(a.pos_in_rest).distance(b.pos_in_rest);
                    f64::from(away) > BOUND || (a.continuity < 0.0) != (b.continuity < 0.0)
                };
                pairs.filter(is_wrong).count()
            };
            asked += points.len();
            wrong += count_wrong(&ask(&probe, &image, &seen_in_mirror));
            wrong_unmirrored += count_wrong(&ask(&probe, &template, &seen_in_mirror));
        }
        println!("{kind:?}: {wrong} wrong, {wrong_unmirrored} unmirrored");
        let most = (AT_JUMPS * asked as f64) as usize;
        assert!(wrong <= most, "{kind:?}: {wrong} of {asked}");
        assert!(wrong_unmirrored > most, "{kind:?} is seen to be mirrored");
    }
}
