//! The facts about each kind, compared with its formula: the main parameter, as constraints by
//! coordinate scale it, and the mirror image.

use crate::gpu::{builtin, gpu, studio_of};
use crate::long::{is_long, long_or};
use crate::reference::{self, as_reference};
use crate::scatter::{Random, placed};
use fabrica::data::{FieldKey, FieldSamples, Grid, Resources};
use fabrica::document::{
    Constrain, ConstrainBy, ControlPoint, ControlPoints, FieldRef, Illustration, ParamValue,
    PlacedTemplate, Plane, TemplateData, TemplateKind, mirrored,
};
use fabrica::load::{FieldUse, MemoryFiles, read_field};
use fabrica::math::{Aabb, Placement};
use fabrica::placed::{deformed_bounds, max_displacement};
use fabrica::render::{Probe, Sample};
use glam::{DVec3, Quat, UVec3, Vec3};
use std::ops::Range;
use std::sync::Arc;

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

/// Constraint by coordinate does a part of the main parameter, and of nothing else: what it finds lies where some part
/// of the template alone would take it from, or nearer on the way there.
#[test]
fn constraints_by_coordinate_scale_the_main_parameter() {
    let volume = builtin("knee", 64);
    let studio = studio_of(gpu(), &volume, false);
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
        let by_coordinate = constrained(ConstrainBy::Coordinate);
        let (mut asked, mut wrong, mut wrong_unscaled) = (0, 0, 0);
        for (point, found) in points.iter().zip(&by_coordinate) {
            let pos = point.as_dvec3();
            let whole = done_partly(&free, 0..0, 1.0, pos) - pos;
            let way = found.pos_in_rest.as_dvec3() - pos;
            let is_between = way.length() > 3e-3 && (whole - way).length() > 3e-3;
            if !is_between || found.continuity < 0.0 {
                continue;
            }
            asked += 1;
            // The distance of the way from those of all parts, each shortened to it.
            let off = |main: Range<usize>| {
                let at = |part: f64| {
                    let full = done_partly(&free, main.clone(), part, pos) - pos;
                    full.clamp_length_max(way.length()).distance(way)
                };
                let best = (0..=200).map(|i| f64::from(i) / 200.0);
                let best = best.min_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap_or(0.0);
                let near = (-40..=40).map(|i| at((best + f64::from(i) / 8000.0).clamp(0.0, 1.0)));
                near.fold(f64::INFINITY, f64::min)
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
        // Where a displacement keeps its direction as it is done, any part of it looks alike.
        let is_straight = !matches!(
            kind,
            TemplateKind::Twist | TemplateKind::Bend | TemplateKind::Peel | TemplateKind::Flap
        );
        assert!(
            is_straight || wrong_unscaled as f64 > 0.3 * f64::from(asked),
            "{kind:?}: the comparison would not see another main parameter"
        );
    }
}

/// A constraint by coordinate does the part that the way to kept tissue is of the longest displacement of any material:
/// of that itself and no loose bound. It is found from kinds that do a part by shortening their displacement: there the
/// part says it, and the constraint by displacement says the way.
#[test]
fn the_longest_displacement_is_the_longest() {
    /// How many times the displacement the way has to be, as in shaders/march/constrain.wgsl.
    const HEADROOM: f32 = 1.25;
    let volume = builtin("knee", 64);
    let studio = studio_of(gpu(), &volume, false);
    let bounds = volume.grid.subject_bounds();
    let keep = vec!["femur".to_owned()];
    let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
    let rounds = long_or(200, 8);
    let mut random = Random(0x0b01_71cc);
    let kinds = [TemplateKind::Poke, TemplateKind::Wave];
    for kind in kinds {
        let (mut asked, mut least, mut most, mut loose) = (0, f32::INFINITY, 0.0_f32, 0.0_f32);
        for round in 0..rounds {
            let mut free = random.template(kind);
            free.placement.at *= 0.3;
            free.placement.size = random.vector(0.3, 1.0);
            if round % 3 == 2 {
                free.curve = Some(random.curve(free.placement.size));
            }
            let around = (0..24_000).map(|i| match i % 2 {
                0 => random.vector(-0.7, 0.7),
                _ => free.subject_from_template(random.vector(-0.2, 1.5)),
            });
            let points: Vec<Vec3> = around.collect();
            let ask = |by: Option<ConstrainBy>| {
                let mut scene = Illustration::document_default();
                let constrain = by.map(|by| Constrain {
                    by,
                    keep: keep.clone(),
                });
                scene.templates = vec![PlacedTemplate {
                    constrain,
                    ..free.clone()
                }];
                pollster::block_on(studio.probe_object(&scene, &points)).expect("samples")
            };
            let whole = ask(None);
            let (by_displacement, by_coordinate) = (
                ask(Some(ConstrainBy::Displacement)),
                ask(Some(ConstrainBy::Coordinate)),
            );
            let way = |samples: &[Sample], i: usize| samples[i].pos_in_rest.distance(points[i]);
            let is_there =
                |i: &usize| whole[*i].continuity >= 0.0 && bounds.contains(whole[*i].pos_in_rest);
            let longest = (0..points.len())
                .filter(is_there)
                .map(|i| way(&whole, i))
                .fold(0.0, f32::max);
            if longest < 0.01 {
                continue;
            }
            // A narrow one falls between the points.
            let all = (&free, &Resources::default());
            let longest = longest.max(longest_asked(&probe, all, bounds, &mut random));
            for i in 0..points.len() {
                let (full, short, part) = (
                    way(&whole, i),
                    way(&by_displacement, i),
                    way(&by_coordinate, i),
                );
                // Where both give way, and the way is long enough to be measured.
                if short > 5e-3
                    && short < 0.99 * full
                    && part > 5e-3
                    && part < 0.99 * full
                    && part < 0.99 * HEADROOM * short
                {
                    let said = HEADROOM * short * full / part;
                    asked += 1;
                    least = least.min(said / longest);
                    most = most.max(said / longest);
                    loose =
                        loose.max(max_displacement(&free, &Resources::default(), bounds) / longest);
                }
            }
        }
        println!(
            "{kind:?}: {asked} places say {least:.3} to {most:.3} of the longest; the box of it is up to {loose:.2}"
        );
        assert!(asked > 30, "{kind:?}: {asked}");
        assert!(least > 0.97 && most < 1.1, "{kind:?}: {least} to {most}");
    }
}

/// The longest displacement that a constraint by coordinate divides by is found for every kind: within a tenth of the
/// longest that a search finds by asking the map alone, and at a place where the map does move tissue so far.
#[test]
fn the_longest_displacement_is_found_for_every_kind() {
    let volume = builtin("knee", 32);
    let studio = studio_of(gpu(), &volume, false);
    let bounds = volume.grid.subject_bounds();
    let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
    let rounds = long_or(200, 3);
    let mut random = Random(0x0b01_71d0);
    let kinds = TemplateKind::FORMULAS
        .into_iter()
        .chain([TemplateKind::Rbf, TemplateKind::Field]);
    let mut wrong = Vec::new();
    for kind in kinds.filter(|kind| *kind != TemplateKind::Cut) {
        let (mut least, mut most, mut loose) = (f32::INFINITY, 0.0_f32, 0.0_f32);
        let mut asked = 0;
        for round in 0..rounds {
            let (free, resources) = laid(kind, round, &volume.grid, &mut random);
            let way_at = |pos: Vec3| {
                let found = ask(&probe, &free, &resources, &[pos])[0];
                // It may lie at a side of the subject, or at a tear: on either side by rounding.
                let off = found.pos_in_rest - found.pos_in_rest.clamp(bounds.min, bounds.max);
                let is_there = found.continuity > -1e-4 && off.length() < 1e-5;
                is_there.then(|| found.pos_in_rest.distance(pos))
            };
            let searched = longest_asked(&probe, (&free, &resources), bounds, &mut random);
            let mut scene = Illustration::document_default();
            scene.templates = vec![PlacedTemplate {
                constrain: Some(Constrain {
                    by: ConstrainBy::Coordinate,
                    keep: vec!["femur".to_owned()],
                }),
                ..free.clone()
            }];
            let studio = studio.clone().with_resources(resources.clone());
            let found = pollster::block_on(studio.motions(&scene)).expect("what was found");
            let [x, y, z, _] = found[0].row1;
            let (said, way) = (found[0].row0[0], way_at(Vec3::new(x, y, z)));
            if searched < 0.01 {
                continue;
            }
            let is_at = way.is_some_and(|way| (way - said).abs() < 1e-3 * said.max(1.0));
            if !is_at {
                println!("{kind:?}: not {said} but {way:?} at {x} {y} {z}: {free:?}");
                wrong.push(kind);
            }
            let true_longest = searched
                .max(way.unwrap_or(0.0))
                .max(known_longest(&free, bounds));
            let ratio = said / true_longest;
            if !(0.9..1.1).contains(&ratio) {
                println!("{ratio:.3} of {true_longest:.3}: {free:?}");
            }
            asked += 1;
            least = least.min(ratio);
            most = most.max(ratio);
            loose = loose.max(max_displacement(&free, &resources, bounds) / true_longest);
        }
        println!(
            "{kind:?}: {asked} asked, {least:.3} to {most:.3} of the longest; the box of it is up to {loose:.2}"
        );
        // Some of the random ones hardly move anything.
        if asked * 10 <= rounds || least < 0.9 || most > 1.1 {
            wrong.push(kind);
        }
    }
    assert!(wrong.is_empty(), "not found for {wrong:?}");
}

/// A template of a kind at random: every third one along a curve.
fn laid(
    kind: TemplateKind,
    round: u32,
    grid: &Grid,
    random: &mut Random,
) -> (PlacedTemplate, Resources) {
    let mut free = random.template(kind);
    free.placement.at *= 0.3;
    free.placement.size = random.vector(0.3, 1.0);
    let mut resources = Resources::default();
    match kind {
        TemplateKind::Rbf => {
            let moves = (0..3 + random.index(6)).map(|_| ControlPoint {
                at: random.vector(0.1, 0.9),
                shift: random.vector(-0.3, 0.3),
            });
            free.data = TemplateData::Points(ControlPoints {
                points: moves.collect(),
                cut: Vec::new(),
            });
        }
        TemplateKind::Field => {
            let mut file = MemoryFiles::new([("waves.nrrd", waves(random))]);
            let file = read_field(&mut file, "waves.nrrd").expect("a field");
            let given = FieldUse {
                is_subject_units: false,
                is_lps: None,
                subject: grid,
            };
            let (samples, _) = file.fit(&given).expect("it fits");
            free.data = TemplateData::Field(FieldRef {
                sha256: Some(file.sha256.clone()),
                is_placed: true,
                ..FieldRef::default()
            });
            free.params[0] = ParamValue::Number(random.between(0.5, 2.0));
            let key = FieldKey::of(&free).expect("it names a file");
            resources.add_field(key, FieldSamples(Arc::new(samples)));
        }
        _ => {}
    }
    if round % 3 == 2 && is_curved_here(kind) {
        free.curve = Some(random.curve(free.placement.size));
    }
    (free, resources)
}

/// A field of 8 samples a side over a cube of 1 mm: waves at random, up to a tenth of it high.
fn waves(random: &mut Random) -> Vec<u8> {
    let mut bytes = b"NRRD0004\ntype: float\ndimension: 4\nspace: right-anterior-superior\nsizes: 3 8 8 8\n\
        space directions: none (0.125,0,0) (0,0.125,0) (0,0,0.125)\nkinds: vector domain domain domain\n\
        endian: little\nencoding: raw\nspace origin: (-0.4375,-0.4375,-0.4375)\n\n"
        .to_vec();
    let (along, high) = (random.vector(-0.8, 0.8), random.vector(-0.1, 0.1));
    for index in 0..512 {
        let at = UVec3::new(index % 8, index / 8 % 8, index / 64).as_vec3();
        let value = high * (at.dot(along) + Vec3::new(0.0, 1.0, 2.0)).map(f32::sin);
        bytes.extend(value.to_array().into_iter().flat_map(f32::to_le_bytes));
    }
    bytes
}

/// How far straight slices move tissue at most, in closed form; 0 for other templates.
fn known_longest(free: &PlacedTemplate, bounds: Aabb) -> f32 {
    if free.kind != TemplateKind::Slices || free.curve.is_some() {
        return 0.0;
    }
    let packed = as_reference(std::slice::from_ref(free));
    let [count, gap, shift, progress] = [0, 1, 2, 3].map(|k| packed[0].params[k]);
    let slabs = count.round().clamp(1.0, 32.0);
    let highest = (0..8).map(|corner: u32| {
        let part = Vec3::new(
            (corner & 1) as f32,
            (corner >> 1 & 1) as f32,
            (corner >> 2) as f32,
        );
        let corner = bounds.min + bounds.size() * part;
        f64::from(free.template_from_subject(corner).z)
    });
    let highest = highest.fold(f64::NEG_INFINITY, f64::max);
    let last = ((slabs * highest).ceil() - 1.0).clamp(0.0, slabs - 1.0);
    let size = free.placement.size.as_dvec3();
    (last * progress * DVec3::new(shift * size.x, 0.0, gap * size.z).length()) as f32
}

/// Which kinds are laid along curves, each a program of its own: a few, or all where there is time.
fn is_curved_here(kind: TemplateKind) -> bool {
    is_long()
        || matches!(
            kind,
            TemplateKind::Poke | TemplateKind::Peel | TemplateKind::Slices | TemplateKind::Crack
        )
}

/// The longest displacement of what lies in a box, found by asking at random, and then ever closer about the longest of
/// several regions.
fn longest_asked(
    probe: &Probe,
    (free, resources): (&PlacedTemplate, &Resources),
    bounds: Aabb,
    random: &mut Random,
) -> f32 {
    /// Regions, and how far they are apart at least.
    const REGIONS: usize = 8;
    const APART: f32 = 0.06;
    let list = std::slice::from_ref(free);
    let all = deformed_bounds(list, resources, bounds);
    let ways = |points: &[Vec3]| -> Vec<f32> {
        let way = |(pos, sample): (&Vec3, Sample)| {
            let is_there = sample.continuity >= 0.0 && bounds.contains(sample.pos_in_rest);
            f32::from(u8::from(is_there)) * sample.pos_in_rest.distance(*pos)
        };
        let found = ask(probe, free, resources, points);
        points.iter().zip(found).map(way).collect()
    };
    let points: Vec<Vec3> = (0..40_000)
        .map(|i| match i % 3 {
            0 => random.vector(-0.7, 0.7),
            1 => all.min + all.size() * random.vector(0.0, 1.0),
            _ => free.subject_from_template(random.vector(-0.3, 1.6)),
        })
        .collect();
    let mut by_way: Vec<(f32, Vec3)> = ways(&points).into_iter().zip(points).collect();
    by_way.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best: Vec<(f32, Vec3)> = Vec::new();
    for (way, pos) in by_way {
        if best.len() < REGIONS && best.iter().all(|(_, other)| other.distance(pos) > APART) {
            best.push((way, pos));
        }
    }
    for turn in 0..8 {
        let reach = 0.1 * 0.4_f32.powi(turn);
        let points: Vec<Vec3> = (0..200 * best.len())
            .map(|i| best[i % best.len()].1 + random.vector(-reach, reach))
            .collect();
        for (i, (way, pos)) in ways(&points).into_iter().zip(points).enumerate() {
            let region = i % best.len();
            if way > best[region].0 {
                best[region] = (way, pos);
            }
        }
    }
    best.iter().map(|(way, _)| *way).fold(0.0, f32::max)
}

fn ask(
    probe: &Probe,
    template: &PlacedTemplate,
    resources: &Resources,
    points: &[Vec3],
) -> Vec<Sample> {
    let mut scene = Illustration::document_default();
    scene.templates = vec![template.clone()];
    pollster::block_on(probe.samples(&scene, resources, points)).expect("samples")
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
        let ask = |template: &PlacedTemplate, points: &[Vec3]| {
            ask(&probe, template, &Resources::default(), points)
        };
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
            let here = ask(&template, &points);
            let count_wrong = |samples: &[Sample]| {
                let pairs = here.iter().zip(samples);
                let is_wrong = |(a, b): &(&Sample, &Sample)| {
                    let away = reflected(a.pos_in_rest).distance(b.pos_in_rest);
                    f64::from(away) > BOUND || (a.continuity < 0.0) != (b.continuity < 0.0)
                };
                pairs.filter(is_wrong).count()
            };
            asked += points.len();
            wrong += count_wrong(&ask(&image, &seen_in_mirror));
            wrong_unmirrored += count_wrong(&ask(&template, &seen_in_mirror));
        }
        println!("{kind:?}: {wrong} wrong, {wrong_unmirrored} unmirrored");
        let most = (AT_JUMPS * asked as f64) as usize;
        assert!(wrong <= most, "{kind:?}: {wrong} of {asked}");
        assert!(wrong_unmirrored > most, "{kind:?} is seen to be mirrored");
    }
}
