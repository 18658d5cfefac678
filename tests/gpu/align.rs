//! Kept tissue: what the object has at a point when templates leave tissue alone, against a plain recursive reading of
//! spec/contract.md ("Meaning" of `align`); distances against brute force.

use crate::firm::{BOUND, difference, firm};
use crate::gpu::{builtin, gpu, studio_of};
use crate::long::{is_long, long_or};
use crate::reference::{Placed, as_reference};
use crate::scatter::Random;
use fabrica::data::{
    Grid, KeptLabels, Resources, Segment, Segmentation, TimeSlices, Volume, Voxels, segment,
};
use fabrica::document::{
    Align, Constrain, ConstrainBy, Illustration, PlacedTemplate, TemplateKind, TemplateMode,
};
use fabrica::math::Placement;
use fabrica::render::{Sample, Studio};
use glam::{DAffine3, DMat3, DVec3, Quat, UVec3, Vec3};

fn illustration(templates: Vec<PlacedTemplate>) -> Illustration {
    let mut illustration = Illustration::document_default();
    illustration.templates = templates;
    illustration
}

pub(crate) fn probe(studio: &Studio, templates: &[PlacedTemplate], points: &[Vec3]) -> Vec<Sample> {
    let scene = illustration(templates.to_vec());
    pollster::block_on(studio.probe_object(&scene, points)).expect("samples")
}

/// Labels at points of rest space, the nearest voxel's; 0 outside.
pub(crate) struct Labels<'a> {
    pub(crate) volume: &'a Segmentation,
    voxel_from_rest: DAffine3,
}

impl<'a> Labels<'a> {
    pub(crate) fn new(volume: &'a Volume) -> Self {
        let labels = volume.segmentation.as_ref().expect("a subject with labels");
        let world = volume.grid.world_from_voxel * volume.grid.subject_from_voxel().inverse();
        Self {
            volume: labels,
            voxel_from_rest: labels.grid.world_from_voxel.inverse() * world,
        }
    }

    fn at_voxel(&self, voxel: DVec3) -> u8 {
        let dims = self.volume.grid.dims;
        if voxel.cmplt(DVec3::ZERO).any() || voxel.cmpge(dims.as_dvec3()).any() {
            return 0;
        }
        let v = voxel.as_u64vec3();
        let index = v.x + u64::from(dims.x) * (v.y + u64::from(dims.y) * v.z);
        self.volume.labels[index as usize]
    }

    pub(crate) fn at(&self, rest: DVec3) -> u8 {
        self.at_voxel((self.voxel_from_rest.transform_point3(rest) + 0.5).floor())
    }

    /// The label, if all labels within the error of the position agree.
    fn firm_at(&self, rest: DVec3) -> Option<u8> {
        let label = self.at(rest);
        let corners = (0..8u32)
            .map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)));
        let mut around = corners.map(|c| self.at(rest + (c * 2.0 - 1.0) * BOUND));
        around.all(|l| l == label).then_some(label)
    }

    /// True if a place lies within the smooth surface about these labels, if all places within a fiftieth of a voxel
    /// agree: a texture is read at one of 256 places between two voxels.
    pub(crate) fn firmly_kept(&self, rest: DVec3, kept: &[u8]) -> Option<bool> {
        let kept = KeptLabels::new(|label| u8::from(kept.contains(&label)));
        let voxel = self.voxel_from_rest.transform_point3(rest);
        let is_in = |at| kept.sets_at(self.volume, at) != 0;
        let corner =
            |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        let mut around = (0..8).map(|i| is_in(voxel + (corner(i) * 2.0 - 1.0) * 0.02));
        let own = is_in(voxel);
        around.all(|other| other == own).then_some(own)
    }

    pub(crate) fn number(&self, name: &str) -> u8 {
        let segment = self.volume.segments.iter().find(|s| s.name == name);
        segment.expect("a segment of that name").label as u8
    }
}

/// The depth under the outer surface as the GPU made it (held against brute force by itself), read between voxels.
struct Depths {
    dims: UVec3,
    values: Vec<f64>,
    voxel_from_rest: DAffine3,
}

impl Depths {
    fn new(studio: &Studio, volume: &Volume) -> Self {
        let template = peel(Align::Surface {
            depth: 0.1,
            thickness: 0.01,
        });
        let scene = illustration(vec![template]);
        let (size, texels) = pollster::block_on(studio.distances(&scene)).expect("distances");
        let dims = UVec3::new(size[0], size[1], size[2] / 2);
        assert_eq!(dims, volume.grid.dims, "small enough for full resolution");
        let behind = texels.len() / 2;
        Self {
            dims,
            values: texels[behind..].iter().map(|t| f64::from(t[0])).collect(),
            voxel_from_rest: volume.grid.subject_from_voxel().inverse(),
        }
    }

    fn at(&self, rest: DVec3) -> Option<f64> {
        let at = self.voxel_from_rest.transform_point3(rest);
        let last = self.dims.as_dvec3() - 1.0;
        if at.cmplt(DVec3::splat(-0.5)).any() || at.cmpgt(last + 0.5).any() {
            return None;
        }
        let at = at.clamp(DVec3::ZERO, last);
        let (low, part) = (at.floor(), at.fract());
        let mut sum = 0.0;
        for i in 0..8u32 {
            let corner = DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
            let weight = (corner * part + (1.0 - corner) * (1.0 - part)).element_product();
            let v = (low + corner).min(last).as_uvec3();
            sum += weight * self.values[(v.x + self.dims.x * (v.y + self.dims.y * v.z)) as usize];
        }
        Some(sum)
    }
}

/// One group: a composed template and those added to it.
struct Group {
    templates: Vec<Placed>,
    kept: Vec<u8>,
    depth: Option<f64>,
}

/// Rounding decides here: the point says nothing.
#[derive(Debug)]
struct Unsure;

/// The contract's words, read plainly.
struct Reading<'a> {
    groups: Vec<Group>,
    labels: &'a Labels<'a>,
    depths: &'a Depths,
}

impl<'a> Reading<'a> {
    fn new(list: &[PlacedTemplate], labels: &'a Labels<'a>, depths: &'a Depths) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        for (template, plain) in list.iter().zip(as_reference(list)) {
            if !plain.is_added || groups.is_empty() {
                groups.push(Group {
                    templates: Vec::new(),
                    kept: Vec::new(),
                    depth: None,
                });
            }
            let group = groups.last_mut().expect("just pushed");
            group.templates.push(plain);
            match &template.align {
                Align::Axis => {}
                Align::Surface { depth, .. } => group.depth = Some(f64::from(*depth)),
                Align::Segment { keep, .. } => {
                    group.kept = keep.iter().map(|name| labels.number(name)).collect();
                }
            }
        }
        Self {
            groups,
            labels,
            depths,
        }
    }

    fn is_kept(&self, group: &Group, rest: DVec3) -> Result<bool, Unsure> {
        if !group.kept.is_empty() && self.labels.firmly_kept(rest, &group.kept).ok_or(Unsure)? {
            return Ok(true);
        }
        let (Some(wanted), Some(depth)) = (group.depth, self.depths.at(rest)) else {
            return Ok(false);
        };
        // Distances are smooth to one, and kept as half floats.
        if (depth - wanted).abs() < 2.0 * BOUND {
            return Err(Unsure);
        }
        Ok(depth >= wanted)
    }

    /// What the object has at a point after the first `n` groups: where it was at rest.
    fn object(&self, n: usize, pos: DVec3) -> Result<Option<DVec3>, Unsure> {
        let Some(group) = n.checked_sub(1).map(|i| &self.groups[i]) else {
            return Ok(Some(pos));
        };
        let before = self.object(n - 1, pos)?;
        if let Some(rest) = before
            && self.is_kept(group, rest)?
        {
            return Ok(before);
        }
        let (source, continuity) = firm(&group.templates, pos).ok_or(Unsure)?;
        if continuity < 0.0 {
            return Ok(None);
        }
        match self.object(n - 1, source)? {
            Some(rest) if self.is_kept(group, rest)? => Ok(None),
            found => Ok(found),
        }
    }
}

/// Some way to leave tissue alone.
fn alignment(random: &mut Random, choices: usize) -> Align {
    let keep = |names: &[&str]| Align::Segment {
        keep: names.iter().map(|&n| n.to_owned()).collect(),
        thickness: 0.01,
    };
    match random.index(choices) {
        0 => keep(&["bone", "brain"]),
        1 => Align::Surface {
            depth: random.between(0.02, 0.12),
            thickness: 0.01,
        },
        2 => Align::Axis,
        _ => keep(&["muscle"]),
    }
}

/// Templates whose places lie in the head.
fn list(random: &mut Random, count: usize, choices: usize) -> Vec<PlacedTemplate> {
    let kinds = TemplateKind::FORMULAS;
    let mut list: Vec<PlacedTemplate> = (0..count)
        .map(|_| {
            let kind = kinds[random.index(kinds.len())];
            let mut template = random.template(kind);
            template.placement.at *= 0.7;
            template.align = alignment(random, choices);
            if random.unit() < 0.3 {
                template.curve = Some(random.curve(template.placement.size));
            }
            template
        })
        .collect();
    if count > 1 && random.unit() < 0.2 {
        list[1].mode = TemplateMode::Add;
        list[1].align = list[0].align.clone();
    }
    list
}

#[derive(Default, Debug)]
struct Tally {
    compared: usize,
    left_out: usize,
    stayed: usize,
    moved: usize,
    nothing: usize,
    wrong: Vec<String>,
}

impl Tally {
    fn compare(
        &mut self,
        studio: &Studio,
        reading: &Reading<'_>,
        list: &[PlacedTemplate],
        points: &[Vec3],
    ) {
        for (point, sample) in points.iter().zip(probe(studio, list, points)) {
            let pos = point.as_dvec3();
            let Ok(expected) = reading.object(reading.groups.len(), pos) else {
                self.left_out += 1;
                continue;
            };
            let found = (sample.continuity >= 0.0).then_some(sample.pos_in_rest.as_dvec3());
            // Nothing and a place outside the scan look alike.
            let label_of = |rest: Option<DVec3>| match rest {
                Some(rest) => reading.labels.firm_at(rest),
                None => Some(0),
            };
            let (Some(expected_label), Some(found_label)) = (label_of(expected), label_of(found))
            else {
                self.left_out += 1;
                continue;
            };
            self.compared += 1;
            let is_right = match (expected, found) {
                (Some(a), Some(b)) => {
                    difference((a, 1.0), (b, 1.0)) < 4.0 * BOUND && expected_label == found_label
                }
                (None, None) => true,
                _ => false,
            };
            match expected {
                None => self.nothing += 1,
                Some(rest) if rest == pos => self.stayed += 1,
                Some(_) => self.moved += 1,
            }
            if !is_right {
                self.wrong.push(format!("{list:?}\n at {point:?}: expected {expected:?} (label {expected_label}), got {sample:?} (label {found_label})"));
            }
        }
    }

    fn check(&self, what: &str) {
        println!(
            "{what}: {} compared, {} left out, {} stayed, {} moved, {} nothing, {} wrong",
            self.compared,
            self.left_out,
            self.stayed,
            self.moved,
            self.nothing,
            self.wrong.len()
        );
        assert!(
            self.wrong.is_empty(),
            "{what}: {} wrong, such as {}",
            self.wrong.len(),
            self.wrong[0]
        );
        assert!(
            self.left_out * 4 < self.compared,
            "{what}: {} of {} left out",
            self.left_out,
            self.compared + self.left_out
        );
        for count in [self.stayed, self.moved, self.nothing] {
            assert!(
                count * 50 > self.compared,
                "{what}: all three cases occur: {self:?}"
            );
        }
    }
}

/// Lists of one to four templates, each with its own alignment, at random points.
#[test]
fn the_object_is_what_the_contract_says() {
    let volume = builtin("head", 64);
    let studio = studio_of(gpu(), &volume, false);
    let labels = Labels::new(&volume);
    let depths = Depths::new(&studio, &volume);
    let mut random = Random(0x5eed_0a11_9e00_0001);
    // Each list is a program of its own, which takes longer to compile than the points to be asked.
    let (rounds, points) = if is_long() { (16, 150) } else { (8, 300) };
    // One set at the bottom (a chain); several, mixed with templates that keep nothing (asking back).
    for (what, choices) in [("one set", 1), ("mixed", 4)] {
        let mut tally = Tally::default();
        for round in 0..rounds {
            let list = list(&mut random, 1 + round % 4, choices);
            let points: Vec<Vec3> = (0..points).map(|_| random.point(&list)).collect();
            let reading = Reading::new(&list, &labels, &depths);
            tally.compare(&studio, &reading, &list, &points);
        }
        tally.check(what);
    }
}

/// Negative control: a reading that forgets what is kept is caught.
#[test]
fn a_wrong_reading_is_caught() {
    let volume = builtin("head", 64);
    let studio = studio_of(gpu(), &volume, false);
    let labels = Labels::new(&volume);
    let depths = Depths::new(&studio, &volume);
    let mut random = Random(77);
    let list = vec![peel(Align::Segment {
        keep: vec!["bone".to_owned(), "brain".to_owned()],
        thickness: 0.01,
    })];
    let points: Vec<Vec3> = (0..4000).map(|_| random.point(&list)).collect();
    let mut reading = Reading::new(&list, &labels, &depths);
    let mut tally = Tally::default();
    tally.compare(&studio, &reading, &list, &points);
    assert!(tally.wrong.is_empty(), "{}", tally.wrong[0]);
    reading.groups[0].kept.clear();
    tally.compare(&studio, &reading, &list, &points);
    assert!(
        tally.wrong.len() > 5,
        "only {} differ where nothing is kept",
        tally.wrong.len()
    );
}

/// A peel that opens the front of the head.
fn peel(align: Align) -> PlacedTemplate {
    let placement = Placement {
        at: Vec3::new(0.0, 0.2, 0.2),
        rotate: Quat::from_rotation_x(-0.6),
        size: Vec3::new(0.5, 0.5, 0.4),
    };
    let mut template = PlacedTemplate::new(TemplateKind::Peel, placement);
    template.align = align;
    template
}

/// The head with a segment made from its values by a recipe; the segment overlaps the head's own ones.
fn head_with_recipe() -> Volume {
    let recipe = r#"[{"name":"made","from":{"threshold":[-150,20]},"clean":[{"largest":2},{"grow":4},{"smooth":3}]}]"#;
    let text = format!(r#"{{"fabrica":1,"subject":{{"features":{recipe}}}}}"#);
    let document = fabrica::document::Document::from_json(&text).expect("a document");
    let recipes = document.illustration().recipes.clone();
    let mut volume = builtin("head", 64);
    let resources = Resources {
        subject: Some(volume.clone().into()),
        ..Resources::default()
    };
    let made = pollster::block_on(segment(resources, recipes, TimeSlices::unlimited()));
    let labels = made.segmentation.expect("labels");
    volume.segmentation = Some(Segmentation::clone(&labels));
    volume
}

/// No point of a kept segment changes, whatever the template, wherever it stands; segments made here included.
#[test]
fn kept_tissue_is_untouched() {
    let volume = head_with_recipe();
    let studio = studio_of(gpu(), &volume, false);
    let labels = Labels::new(&volume);
    let depths = Depths::new(&studio, &volume);
    let mut random = Random(0x1ead_5afe);
    let keep = ["bone", "brain", "made"].map(str::to_owned).to_vec();
    let is_kept = |segment: &&Segment| keep.contains(&segment.name);
    let kept: Vec<u8> = labels
        .volume
        .segments
        .iter()
        .filter(is_kept)
        .map(|s| s.label as u8)
        .collect();
    assert!(
        kept.len() > 3,
        "some of it lies in other segments: {kept:?}"
    );
    let rest_from_voxel = volume.grid.subject_from_voxel();
    let (mut in_segment, mut in_depth) = (Vec::new(), Vec::new());
    while in_segment.len() < 300 || in_depth.len() < 300 {
        let dims = volume.grid.dims;
        let voxel = UVec3::new(
            random.index(dims.x as usize) as u32,
            random.index(dims.y as usize) as u32,
            random.index(dims.z as usize) as u32,
        );
        let pos = rest_from_voxel.transform_point3(voxel.as_dvec3());
        if kept.contains(&labels.at(pos)) {
            in_segment.push(pos.as_vec3());
        }
        if depths.at(pos).is_some_and(|d| d > 0.05 + BOUND) {
            in_depth.push(pos.as_vec3());
        }
    }
    // Each list is a program of its own: each kind alone and in all ways where there is time, else three kinds at once
    // and one way after the other.
    let is_long = is_long();
    let (mut moved_without, mut count) = (0, 0);
    let kinds = TemplateKind::FORMULAS.chunks(if is_long { 1 } else { 3 });
    for (turn, kinds) in kinds.enumerate() {
        for round in 0..2 {
            let mut drawn = |kind: &TemplateKind| {
                let mut template = random.template(*kind);
                template.placement.at *= 0.6;
                if round == 1 {
                    template.curve = Some(random.curve(template.placement.size));
                }
                template
            };
            let list: Vec<PlacedTemplate> = kinds.iter().map(&mut drawn).collect();
            moved_without += probe(&studio, &list, &in_segment)
                .iter()
                .zip(&in_segment)
                .filter(|(s, p)| s.pos_in_rest.distance(**p) > 1e-3)
                .count();
            let aligned = |align: Align| {
                let with = |template: &PlacedTemplate| PlacedTemplate {
                    align: align.clone(),
                    ..template.clone()
                };
                list.iter().map(with).collect::<Vec<_>>()
            };
            let constrained = |by: ConstrainBy| {
                let with = |template: &PlacedTemplate| PlacedTemplate {
                    constrain: Some(Constrain {
                        by,
                        keep: keep.clone(),
                    }),
                    ..template.clone()
                };
                list.iter().map(with).collect::<Vec<_>>()
            };
            let segment = Align::Segment {
                keep: keep.clone(),
                thickness: 0.01,
            };
            let surface = Align::Surface {
                depth: 0.05,
                thickness: 0.01,
            };
            let ways = [
                (aligned(segment), &in_segment),
                (aligned(surface), &in_depth),
                (constrained(ConstrainBy::Displacement), &in_segment),
                (constrained(ConstrainBy::Coordinate), &in_segment),
            ];
            let first = (2 * turn + round) % ways.len();
            let count_of = if is_long { ways.len() } else { 1 };
            for (list, points) in ways.into_iter().cycle().skip(first).take(count_of) {
                for (sample, point) in probe(&studio, &list, points).iter().zip(points) {
                    assert!(
                        sample.pos_in_rest == *point && sample.continuity >= 0.0,
                        "{list:?} moves {point:?}: {sample:?}"
                    );
                    count += 1;
                }
            }
        }
    }
    println!("{count} points of kept tissue, {moved_without} of them move where nothing is kept");
    assert!(
        moved_without > 1000,
        "the templates reach kept tissue: {moved_without}"
    );
}

/// A volume with labels strewn about it, in air; `axes` are the sides of a voxel, mm.
fn strewn(dims: UVec3, axes: DMat3) -> Volume {
    let mut random = Random(0xd157_a9ce);
    let balls: Vec<(Vec3, f32)> = (0..6)
        .map(|_| (random.vector(0.2, 0.8), random.between(0.05, 0.2)))
        .collect();
    let (mut values, mut labels) = (Vec::new(), Vec::new());
    for z in 0..dims.z {
        for y in 0..dims.y {
            for x in 0..dims.x {
                let p = (UVec3::new(x, y, z).as_vec3() + 0.5) / dims.as_vec3();
                let which = balls.iter().position(|(c, r)| c.distance(p) < *r);
                // A hollow that is shut, and one that is not.
                let from_middle = p.distance(Vec3::splat(0.5));
                let is_body = (0.2..0.4).contains(&from_middle)
                    && !(p.x < 0.5 && (p.y - 0.5).abs() < 0.06 && (p.z - 0.5).abs() < 0.06);
                labels.push(which.map_or(0, |i| 1 + i as u8 % 2));
                values.push(if is_body || which.is_some() { 200u8 } else { 0 });
            }
        }
    }
    let grid = Grid {
        dims,
        world_from_voxel: DAffine3::from_mat3(DMat3::from_rotation_z(0.3) * axes),
    };
    let segment = |label: u16, name: &str| Segment {
        label,
        name: name.to_owned(),
        color_srgb: None,
    };
    Volume {
        has_size: true,
        grid,
        voxels: Voxels::U8(values),
        slope: 1.0,
        intercept: 0.0,
        value_range: [0.0, 200.0],
        segmentation: Some(Segmentation {
            grid,
            labels,
            segments: vec![segment(1, "odd"), segment(2, "even")],
        }),
    }
}

/// The boxes of the voxels of a label, rest space: middle and half edges.
struct Boxes {
    middles: Vec<DVec3>,
    /// Half the edges of a voxel, by columns.
    half: DMat3,
}

impl Boxes {
    fn of(volume: &Volume, is_member: &dyn Fn(usize) -> bool) -> Self {
        let rest_from_voxel = volume.grid.subject_from_voxel();
        let dims = volume.grid.dims;
        let voxel = |i: usize| {
            let i = i as u32;
            UVec3::new(i % dims.x, i / dims.x % dims.y, i / (dims.x * dims.y)).as_dvec3()
        };
        let members = (0..volume.grid.voxel_count()).filter(|i| is_member(*i));
        Self {
            middles: members
                .map(|i| rest_from_voxel.transform_point3(voxel(i)))
                .collect(),
            half: rest_from_voxel.matrix3 * 0.5,
        }
    }

    /// Way from a place to the nearest box, subject units: exact for perpendicular edges, else found by projecting onto
    /// one edge after the other until nothing changes.
    fn distance(&self, at: DVec3) -> f64 {
        let edges = [self.half.x_axis, self.half.y_axis, self.half.z_axis];
        let way = |middle: &DVec3| {
            let mut part = DVec3::ZERO;
            for _ in 0..60 {
                let before = part;
                for axis in 0..3 {
                    let left = at - *middle - self.half * part;
                    let edge = edges[axis];
                    let along = left.dot(edge) / edge.length_squared();
                    part[axis] = (part[axis] + along).clamp(-1.0, 1.0);
                }
                if (part - before).length() < 1e-12 {
                    break;
                }
            }
            at.distance(*middle + self.half * part)
        };
        // Only the boxes that may be nearest are projected onto.
        let reach = edges.iter().map(|edge| edge.length()).sum::<f64>();
        let nearest = self
            .middles
            .iter()
            .map(|m| m.distance(at))
            .fold(f64::INFINITY, f64::min);
        let near = self
            .middles
            .iter()
            .filter(|m| m.distance(at) <= nearest + 2.0 * reach);
        near.map(way).fold(f64::INFINITY, f64::min)
    }
}

/// Voxels below the threshold that are connected with a side, voxel by voxel through faces.
fn outside(volume: &Volume) -> Vec<bool> {
    let dims = volume.grid.dims;
    let Voxels::U8(values) = &volume.voxels else {
        panic!("bytes")
    };
    let mut is_out = vec![false; values.len()];
    let index = |v: UVec3| (v.x + dims.x * (v.y + dims.y * v.z)) as usize;
    loop {
        let mut changed = false;
        for i in 0..values.len() as u32 {
            let v = UVec3::new(i % dims.x, i / dims.x % dims.y, i / (dims.x * dims.y));
            if is_out[index(v)] || values[index(v)] != 0 {
                continue;
            }
            // The sides, not the ends at head and foot.
            let is_side = v.x == 0 || v.y == 0 || v.x + 1 == dims.x || v.y + 1 == dims.y;
            let steps = [UVec3::X, UVec3::Y, UVec3::Z];
            let touches = steps.iter().any(|&s| {
                let up = v + s;
                (up.cmplt(dims).all() && is_out[index(up)])
                    || (v.cmpge(s).all() && is_out[index(v - s)])
            });
            if is_side || touches {
                is_out[index(v)] = true;
                changed = true;
            }
        }
        if !changed {
            return is_out;
        }
    }
}

/// A template that gives way to a segment.
pub(crate) fn giving_way(
    mut template: PlacedTemplate,
    by: ConstrainBy,
    name: &str,
) -> PlacedTemplate {
    template.constrain = Some(Constrain {
        by,
        keep: vec![name.to_owned()],
    });
    template
}

/// Distances to two sets and the depth under the outer surface, at every sample, against the boxes of voxels: exact but
/// for the 16 bits that hold them, whatever the spacing.
#[test]
fn distances_agree_with_brute_force() {
    for sides in [
        [1.0, 1.4, 0.8],
        [1.0, 1.0, 1.0],
        [1.0, 1.0, 4.0],
        [3.0, 1.0, 1.0],
    ] {
        let sides = DVec3::from_array(sides);
        let dims = (DVec3::splat(20.0) / sides)
            .ceil()
            .as_uvec3()
            .max(UVec3::splat(5));
        let volume = strewn(dims, DMat3::from_diagonal(sides));
        let studio = studio_of(gpu(), &volume, false);
        let mut deep = giving_way(peel(Align::Axis), ConstrainBy::Displacement, "even");
        deep.align = Align::Surface {
            depth: 0.1,
            thickness: 0.01,
        };
        let odd = giving_way(peel(Align::Axis), ConstrainBy::Displacement, "odd");
        let scene = illustration(vec![odd, deep]);
        let (size, texels) = pollster::block_on(studio.distances(&scene)).expect("distances");
        // Several samples in the height of a thick slice.
        let parts = (sides / sides.min_element()).round();
        let samples = (dims.as_dvec3() * parts).as_uvec3();
        assert_eq!(
            size,
            [samples.x, samples.y, 3 * samples.z],
            "smooth, exact, depth"
        );
        let labels = &volume.segmentation.as_ref().expect("labels").labels;
        let is_out = outside(&volume);
        let is_cubic = sides == DVec3::ONE;
        let boxes = |is_member: &dyn Fn(usize) -> bool| {
            [
                Boxes::of(&volume, is_member),
                Boxes::of(&volume, &|k| !is_member(k)),
            ]
        };
        let wanted = [
            boxes(&|k| labels[k] == 1),
            boxes(&|k| labels[k] == 2),
            boxes(&|k| is_out[k]),
        ];
        let rest_from_voxel = volume.grid.subject_from_voxel();
        let count = samples.element_product();
        let (mut worst, mut worst_smooth, mut wrong_set) = ([0.0_f64; 3], 0.0_f64, 0.0_f64);
        for i in (0..count).step_by(7) {
            let at = UVec3::new(
                i % samples.x,
                i / samples.x % samples.y,
                i / (samples.x * samples.y),
            );
            let voxel = (at.as_dvec3() + 0.5) / parts - 0.5;
            let pos = rest_from_voxel.transform_point3(voxel);
            let [odd, even, depth] = [0, 1, 2].map(|k: usize| {
                let [inside, outside] = &wanted[k];
                let [to, from] = [inside.distance(pos), outside.distance(pos)];
                to - from
            });
            let (n, i) = (count as usize, i as usize);
            let found = [texels[n + i][0], texels[n + i][1], texels[2 * n + i][0]].map(f64::from);
            for (k, expected) in [odd, even, depth].into_iter().enumerate() {
                worst[k] = worst[k].max((found[k] - expected).abs());
            }
            worst_smooth = worst_smooth.max((f64::from(texels[i][0]) - odd).abs());
            wrong_set = wrong_set.max((found[0] - even).abs());
        }
        println!(
            "{sides}: worst {worst:.5?}, smoothed {worst_smooth:.1e}, another set {wrong_set:.2}"
        );
        let cell = (volume.grid.spacing_mm() / volume.grid.mm_per_unit() / parts).max_element();
        for (k, worst) in worst.into_iter().enumerate() {
            // Cubes count as balls where nothing gives way to them: less than half a side of it.
            let most = if is_cubic && k == 2 { 0.5 * cell } else { 1e-3 };
            assert!(worst <= most, "{sides}, {k}: off by {worst}");
        }
        assert!(
            worst_smooth < 2.5 * cell,
            "smoothing moves surfaces by voxels"
        );
        assert!(wrong_set > 4.0 * cell, "the comparison tells sets apart");
    }
}

/// Every spacing and sheared grids: no point of kept tissue is entered, none is shown twice, tissue moves along its
/// displacement and no farther than the way there is.
#[test]
fn constraints_hold_on_every_grid() {
    let documents = long_or(50, 6);
    let mut random = Random(0x0b01_71c4);
    let shear = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.0, 0.35, 1.0));
    let (mut asked, mut moved, mut limited, mut through) = (0, 0, 0, 0);
    for round in 0..documents {
        let high = [1.0, 2.0, 3.0, 4.0, 5.0, 8.0][round % 6];
        let axes = DMat3::from_diagonal(DVec3::new(1.0, 1.0, high));
        let axes = if round % 2 == 1 { shear * axes } else { axes };
        let dims = UVec3::new(24, 22, ((24.0 / high).ceil() as u32).max(4));
        let volume = strewn(dims, axes);
        let studio = studio_of(gpu(), &volume, false);
        let labels = Labels::new(&volume);
        let number = labels.number("odd");
        let boxes = Boxes::of(&volume, &|k| labels.volume.labels[k] == number);
        let kinds = [
            TemplateKind::Twist,
            TemplateKind::Bend,
            TemplateKind::Poke,
            TemplateKind::Pull,
            TemplateKind::Lens,
        ];
        let kind = kinds[random.index(kinds.len())];
        let mut free = random.template(kind);
        free.placement.at *= 0.4;
        free.placement.size = random.vector(0.5, 1.1);
        let points: Vec<Vec3> = (0..2000).map(|_| random.vector(-0.5, 0.5)).collect();
        let whole = probe(&studio, std::slice::from_ref(&free), &points);
        for by in [ConstrainBy::Displacement, ConstrainBy::Coordinate] {
            let template = giving_way(free.clone(), by, "odd");
            let found = probe(&studio, &[template], &points);
            for ((pos, sample), whole) in points.iter().zip(&found).zip(&whole) {
                let (from, to) = (pos.as_dvec3(), sample.pos_in_rest.as_dvec3());
                asked += 1;
                let Some(is_kept) = labels.firmly_kept(from, &[number]) else {
                    continue;
                };
                if is_kept {
                    assert_eq!(sample.pos_in_rest, *pos, "kept tissue stays");
                    continue;
                }
                let way = boxes.distance(from);
                let (step, full) = (to - from, whole.pos_in_rest.as_dvec3() - from);
                moved += usize::from(step.length() > 1e-3);
                limited += usize::from(full.length() > way);
                through += usize::from(labels.firmly_kept(from + full, &[number]) == Some(true));
                assert!(
                    step.length() <= way + 1e-5,
                    "{round} {by:?}, 1 : 1 : {high}: {from} goes {} of {way}",
                    step.length()
                );
                assert_ne!(
                    labels.firmly_kept(to, &[number]),
                    Some(true),
                    "{round}: {from} is drawn from kept tissue"
                );
                if by == ConstrainBy::Displacement && full.length() > 1e-4 {
                    let along = full.normalize();
                    let aside = (step - along * step.dot(along)).length();
                    assert!(aside < 1e-5, "{round}: {aside} off its displacement");
                }
            }
        }
    }
    println!(
        "{asked} points in {documents} documents: {moved} moved, {limited} limited, {through} through kept tissue else"
    );
    assert!(moved * 10 > asked && limited * 20 > asked && through > 100);
}

/// The bar with its core kept: the outermost shell goes four fifths of its way and more.
#[test]
fn far_tissue_goes_its_way() {
    let volume = builtin("bar", 64);
    let studio = studio_of(gpu(), &volume, false);
    let mut random = Random(0x0b01_71c5);
    // Bar runs along y.
    let along = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let placed = |kind, rotate, size, value: Option<f32>| {
        let mut template = PlacedTemplate::new(
            kind,
            Placement {
                at: Vec3::ZERO,
                rotate,
                size,
            },
        );
        if let Some(value) = value {
            template.params[0] = fabrica::document::ParamValue::Number(value);
        }
        template
    };
    let labels = Labels::new(&volume);
    let core = labels.number("core");
    let boxes = Boxes::of(&volume, &|k| labels.volume.labels[k] == core);
    let cases = [
        placed(
            TemplateKind::Twist,
            along,
            Vec3::new(0.6, 0.6, 1.0),
            Some(0.5),
        ),
        placed(
            TemplateKind::Bend,
            Quat::IDENTITY,
            Vec3::new(0.6, 1.0, 0.6),
            Some(0.2),
        ),
        placed(
            TemplateKind::Peel,
            Quat::IDENTITY,
            Vec3::new(0.6, 0.6, 0.3),
            None,
        ),
    ];
    let points: Vec<Vec3> = (0..20_000).map(|_| random.vector(-0.5, 0.5)).collect();
    let farthest = points
        .iter()
        .filter(|p| labels.at(p.as_dvec3()) != 0)
        .map(|p| boxes.distance(p.as_dvec3()))
        .fold(0.0, f64::max);
    for free in cases {
        let kept = giving_way(free.clone(), ConstrainBy::Displacement, "core");
        let pairs = probe(&studio, &[kept], &points).into_iter().zip(probe(
            &studio,
            std::slice::from_ref(&free),
            &points,
        ));
        let (mut share, mut count) = (0.0, 0);
        for (pos, (kept, free)) in points.iter().zip(pairs) {
            let way = free.pos_in_rest.distance(*pos);
            let is_shell =
                labels.at(pos.as_dvec3()) != 0 && boxes.distance(pos.as_dvec3()) > 0.6 * farthest;
            if is_shell && free.continuity >= 0.0 && way > 1e-3 {
                share += kept.pos_in_rest.distance(*pos) / way;
                count += 1;
            }
        }
        share /= count as f32;
        println!(
            "{:?}: {count} places of the shell go {:.0} % of their way (shell from {farthest:.3})",
            free.kind,
            100.0 * share
        );
        assert!(count > 20 && share >= 0.8, "{:?}: {share}", free.kind);
    }
}

/// The knee: bones stay, and soft tissue comes from where the way to it is free of bone.
#[test]
fn nothing_is_drawn_through_bone() {
    let volume = builtin("knee", 64);
    let studio = studio_of(gpu(), &volume, false);
    let labels = Labels::new(&volume);
    let keep: Vec<String> = ["femur", "tibia", "fibula", "patella"]
        .map(str::to_owned)
        .to_vec();
    let bones: Vec<u8> = keep.iter().map(|name| labels.number(name)).collect();
    let mut random = Random(0x0b01_e5ea);
    for kind in [TemplateKind::Bend, TemplateKind::Twist, TemplateKind::Poke] {
        let placement = Placement {
            at: Vec3::new(0.0, 0.0, 0.0),
            rotate: Quat::IDENTITY,
            size: Vec3::new(0.5, 0.5, 0.9),
        };
        let free = PlacedTemplate::new(kind, placement);
        let points: Vec<Vec3> = (0..600).map(|_| random.vector(-0.4, 0.4)).collect();
        let passed_bone = |template: &PlacedTemplate| {
            let (mut passed, mut moved) = (0, 0);
            for (sample, point) in probe(&studio, std::slice::from_ref(template), &points)
                .iter()
                .zip(&points)
            {
                let (from, to) = (point.as_dvec3(), sample.pos_in_rest.as_dvec3());
                let is_bone = bones.contains(&labels.at(from));
                moved += usize::from(from.distance(to) > 1e-3);
                let mut way = (1..=24).map(|i| from.lerp(to, f64::from(i) / 24.0));
                let meets = way.any(|at| labels.firm_at(at).is_some_and(|l| bones.contains(&l)));
                passed += usize::from(if is_bone { from != to } else { meets });
            }
            (passed, moved)
        };
        let (unconstrained, _) = passed_bone(&free);
        for by in [ConstrainBy::Displacement, ConstrainBy::Coordinate] {
            let mut template = free.clone();
            let keep = keep.clone();
            template.constrain = Some(Constrain { by, keep });
            let (passed, moved) = passed_bone(&template);
            println!(
                "{kind:?} {by:?}: {moved} moved, {passed} through bone, {unconstrained} without a constraint"
            );
            assert_eq!(passed, 0, "{kind:?} {by:?}");
            assert!(moved > 30, "{kind:?} {by:?} moves {moved} points only");
        }
        assert!(unconstrained > 5, "{kind:?} reaches bone: {unconstrained}");
    }
}

/// A volume of nothing but a ball, of 96 voxels along each side.
pub(crate) fn ball(center: DVec3, radius: f64) -> Volume {
    balls(96, &[(center, radius)])
}

/// A volume of nothing but balls of one segment, of so many voxels along each side.
pub(crate) fn balls(side: u32, balls: &[(DVec3, f64)]) -> Volume {
    let label_of = |voxel: UVec3| {
        let at = (voxel.as_dvec3() + 0.5) / f64::from(side) - 0.5;
        let mut balls = balls.iter();
        u8::from(balls.any(|(center, radius)| at.distance(*center) < *radius))
    };
    labelled_block(side, label_of, &["ball"])
}

/// A volume of one value, of so many voxels along each side, with labels by their indices, and names of the labels from
/// 1 on.
pub(crate) fn labelled_block(side: u32, label_of: impl Fn(UVec3) -> u8, names: &[&str]) -> Volume {
    let grid = Grid {
        dims: UVec3::splat(side),
        world_from_voxel: DAffine3::IDENTITY,
    };
    let voxel = |i: u32| UVec3::new(i % side, i / side % side, i / (side * side));
    let labels: Vec<u8> = (0..side.pow(3)).map(|i| label_of(voxel(i))).collect();
    let segments = (1..).zip(names).map(|(label, name)| Segment {
        label,
        name: (*name).to_owned(),
        color_srgb: None,
    });
    Volume {
        has_size: true,
        grid,
        voxels: Voxels::U8(vec![200; labels.len()]),
        slope: 1.0,
        intercept: 0.0,
        value_range: [0.0, 200.0],
        segmentation: Some(Segmentation {
            grid,
            labels,
            segments: segments.collect(),
        }),
    }
}

/// A list of a move and a template that gives way: what the move brought somewhere is guarded there.
#[test]
fn moved_tissue_is_guarded_where_it_is() {
    let center = DVec3::new(-0.12, 0.0, 0.0);
    let kinds = [TemplateKind::Bend, TemplateKind::Poke, TemplateKind::Twist];
    let place = (center.as_vec3(), 0.12);
    assert_moved_tissue_is_guarded(&ball(center, 0.12), "ball", place, &kinds);
    // A stretch of a long bone: the move tears it out of the rest of the bone.
    let knee = builtin("knee", 96);
    let femur = center_of(&knee, "femur");
    let kinds = long_or(&kinds[..], &kinds[..1]);
    assert_moved_tissue_is_guarded(&knee, "femur", (femur, 0.12), kinds);
}

/// The mean place of the label voxels of a segment, in rest space.
fn center_of(volume: &Volume, name: &str) -> Vec3 {
    let labels = Labels::new(volume);
    let label = labels.number(name);
    let UVec3 { x, y, .. } = labels.volume.grid.dims;
    let voxels = (0_u32..).zip(&labels.volume.labels);
    let of_label = voxels.filter(|(_, l)| **l == label);
    let places = of_label.map(|(i, _)| UVec3::new(i % x, i / x % y, i / (x * y)).as_dvec3());
    let (sum, count) = places.fold((DVec3::ZERO, 0), |(sum, n), at| (sum + at, n + 1));
    let rest_from_voxel = labels.voxel_from_rest.inverse();
    rest_from_voxel
        .transform_point3(sum / f64::from(count.max(1)))
        .as_vec3()
}

/// Moves what lies about `center` and asks at places within `reach` of its new one: kept tissue fills them in part.
fn assert_moved_tissue_is_guarded(
    volume: &Volume,
    keep: &str,
    (center, reach): (Vec3, f32),
    kinds: &[TemplateKind],
) {
    let studio = studio_of(gpu(), volume, false);
    let labels = Labels::new(volume);
    let label = labels.number(keep);
    let placement = |at: Vec3, size: f32| Placement {
        at,
        rotate: Quat::IDENTITY,
        size: Vec3::splat(size),
    };
    let mut first = PlacedTemplate::new(TemplateKind::Move, placement(center, 0.3));
    let offset = Vec3::new(0.9, 0.2, 0.1);
    first.params = vec![
        fabrica::document::ParamValue::Vector(offset),
        fabrica::document::ParamValue::Rotation(Quat::from_rotation_z(0.4)),
    ];
    let mut random = Random(0x0b01_71cb);
    // Of the many, half lie in the kept tissue.
    let count = long_or(40_000, 4000);
    let at_new_place: Vec<Vec3> = (0..count)
        .map(|_| center + offset * 0.3 + random.vector(-reach, reach))
        .collect();
    let moved = probe(&studio, std::slice::from_ref(&first), &at_new_place);
    let is_kept = |sample: &Sample| {
        sample.continuity >= 0.0 && labels.firm_at(sample.pos_in_rest.as_dvec3()) == Some(label)
    };
    for &kind in kinds {
        let free = PlacedTemplate::new(kind, placement(Vec3::ZERO, 1.1));
        let unguarded = probe(&studio, &[first.clone(), free.clone()], &at_new_place);
        for by in [ConstrainBy::Displacement, ConstrainBy::Coordinate] {
            let list = [first.clone(), giving_way(free.clone(), by, keep)];
            let guarded = probe(&studio, &list, &at_new_place);
            let (mut held, mut lost) = (0, 0);
            for ((before, after), without) in moved.iter().zip(&guarded).zip(&unguarded) {
                if !is_kept(before) {
                    continue;
                }
                let is_same = |s: &Sample| {
                    s.continuity >= 0.0 && s.pos_in_rest.distance(before.pos_in_rest) < 1e-6
                };
                assert!(
                    is_same(after),
                    "{keep} {kind:?} {by:?}: {before:?} became {after:?}"
                );
                held += 1;
                lost += usize::from(!is_same(without));
            }
            // Elsewhere nothing of it is seen a second time.
            let around: Vec<Vec3> = (0..count).map(|_| random.vector(-0.6, 0.6)).collect();
            let once = probe(&studio, std::slice::from_ref(&first), &around);
            let found = probe(&studio, &list, &around);
            let twice = once
                .iter()
                .zip(&found)
                .filter(|(a, b)| !is_kept(a) && is_kept(b))
                .count();
            println!(
                "{keep} {kind:?} {by:?}: {held} places held, {lost} lost without the constraint, {twice} seen twice"
            );
            assert!(held > 500 && lost * 2 > held && twice == 0);
        }
    }
}

/// Draws a template with and without the grid, and fails if the grid hides something.
fn assert_nothing_is_hidden(volume: &Volume, template: &PlacedTemplate) {
    const SIZE: [u32; 2] = [80, 80];
    let studio = studio_of(gpu(), volume, true);
    let draw = |studio: &Studio| {
        let picture = studio.render_image(&illustration(vec![template.clone()]), SIZE, 1);
        pollster::block_on(picture).expect("a picture").rgba
    };
    let (with, without) = (draw(&studio), draw(&studio.with_grid(false)));
    let lost = |from: &[u8], by: &[u8]| {
        let pairs = from.chunks_exact(4).zip(by.chunks_exact(4));
        pairs
            .filter(|(a, b)| a.iter().any(|c| *c < 223) && b.iter().all(|c| *c == 255))
            .count()
    };
    let drawn = without
        .chunks_exact(4)
        .filter(|p| p.iter().any(|c| *c < 223));
    assert!(drawn.count() > 400, "there is something");
    let (by_grid, by_none) = (lost(&without, &with), lost(&with, &without));
    println!("{by_grid} pixels are lost by the grid, {by_none} without it");
    assert!(
        by_grid <= 6 + 2 * by_none,
        "the grid hides {by_grid} pixels"
    );
}

/// The grid leaps over nothing that a segment's own motion brings or takes: pictures with and without it agree.
#[test]
fn the_grid_follows_rigid_segments() {
    let placement = Placement {
        at: Vec3::ZERO,
        rotate: Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2),
        size: Vec3::splat(0.9),
    };
    let mut template = PlacedTemplate::new(TemplateKind::Bend, placement);
    template.constrain = Some(Constrain {
        by: ConstrainBy::Rigid,
        keep: vec!["tibia".to_owned(), "fibula".to_owned()],
    });
    assert_nothing_is_hidden(&builtin("knee", 64), &template);
}

/// Slices 24 times as thick as their voxels are wide, and kept tissue one slice thick, with all else cut away.
#[test]
fn the_grid_finds_kept_tissue_between_thick_slices() {
    let dims = UVec3::new(120, 120, 5);
    let plane = (dims.x * dims.y) as usize;
    let is_kept = |i: usize| i / plane == 2;
    let count = plane * dims.z as usize;
    let grid = Grid {
        dims,
        world_from_voxel: DAffine3::from_scale(DVec3::new(1.0, 1.0, 24.0)),
    };
    let volume = Volume {
        has_size: true,
        grid,
        voxels: Voxels::U8(vec![200; count]),
        slope: 1.0,
        intercept: 0.0,
        value_range: [0.0, 200.0],
        segmentation: Some(Segmentation {
            grid,
            labels: (0..count).map(|i| u8::from(is_kept(i))).collect(),
            segments: vec![Segment {
                label: 1,
                name: "plate".to_owned(),
                color_srgb: None,
            }],
        }),
    };
    let placement = Placement {
        at: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        size: Vec3::splat(1.2),
    };
    let mut template = PlacedTemplate::new(TemplateKind::Cut, placement);
    template.align = Align::Segment {
        keep: vec!["plate".to_owned()],
        thickness: 0.01,
    };
    assert_nothing_is_hidden(&volume, &template);
}
