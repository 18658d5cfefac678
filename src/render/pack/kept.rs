//! Kept tissue: which labels a document's templates leave alone.

use super::gpu_types::{
    CONSTRAIN_COORDINATE, CONSTRAIN_DISPLACEMENT, CONSTRAIN_LATE, CONSTRAIN_MANY,
    CONSTRAIN_NOTHING, CONSTRAIN_RIGID, KEEPS_DEEP, KeptGroup, LabelSets, MAX_TEMPLATES,
};
use super::notice::RenderNotice;
use crate::data::{KeptLabels, Resources, Segment};
use crate::document::{
    Align, Constrain, ConstrainBy, MAX_KEEP_SETS, PlacedTemplate, TemplateMode, keep_set, keep_sets,
};
use crate::math::Aabb;
use crate::placed::max_displacement;

/// Labels are below this: those of a volume, and behind them those of the segments of meshes.
const END_OF_LABELS: u16 = 32 * size_of::<LabelSets>() as u16 / 16;

/// What of the labels a document's templates keep.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptTissue {
    /// Sets of each label, four bits each, as the shaders take it.
    pub label_sets: LabelSets,
    /// Number of different `keep` sets, at most `document::MAX_KEEP_SETS`.
    pub set_count: u32,
    /// Of each set, a bit for each of those that are connected parts of the same segments, itself among them; 0 for a
    /// set that is whole.
    pub parts: [u32; MAX_KEEP_SETS],
    /// Sets that end at the smooth surface of their shares, a bit for each: those that alignments keep or displacements
    /// give way to. What moves as a whole ends at its label voxels.
    pub shared_sets: u32,
    /// No label belongs to two of the sets.
    pub shares_add: bool,
    /// Some template keeps what lies deep under the outer surface.
    pub keeps_deep: bool,
    /// Per enabled template, in order.
    pub items: [KeptGroup; MAX_TEMPLATES],
    /// Names in `keep` that the subject has no segment for.
    pub unknown: Vec<String>,
    /// What the pipeline constant `align_mode` has to be. 0: nothing is kept or gives way; 1: the list is one group;
    /// 2: the first templates of the list keep the same; 3: any; 4: the list is one group that gives way and keeps
    /// nothing.
    pub align_mode: u32,
    /// How displacements give way, a bit for each `CONSTRAIN_` mode that occurs, for [`CONSTRAIN_LATE`] and for
    /// [`CONSTRAIN_MANY`].
    pub constraints: u32,
}

/// The labels that a name or number in `keep` means; those of meshes beside a volume have names only.
pub(crate) fn labels_of(name: &str, segments: &[Segment]) -> Vec<u16> {
    let named: Vec<u16> = segments
        .iter()
        .filter(|s| s.name == name && s.label < END_OF_LABELS)
        .map(|s| s.label)
        .collect();
    if !named.is_empty() {
        return named;
    }
    // Names may differ in case only where files were written by several programs.
    let similar: Vec<u16> = segments
        .iter()
        .filter(|s| s.name.eq_ignore_ascii_case(name) && s.label < END_OF_LABELS)
        .map(|s| s.label)
        .collect();
    if !similar.is_empty() {
        return similar;
    }
    match name.parse::<u8>() {
        Ok(label) if label > 0 => {
            let label = u16::from(label);
            // Where the segment overlaps others it stands under labels of their own.
            let own = segments.iter().find(|s| s.label == label);
            let stands_for = |label: u16| segments.iter().filter(|s| s.label == label).count();
            let overlaps = segments
                .iter()
                .filter(|s| own.is_some_and(|own| s.name == own.name) && stands_for(s.label) > 1)
                .map(|s| s.label)
                .filter(|&label| label < END_OF_LABELS);
            std::iter::once(label).chain(overlaps).collect()
        }
        _ => Vec::new(),
    }
}

impl KeptTissue {
    /// What the templates keep of a subject with these segments. `bounds` is the box of the subject at rest.
    pub fn of(
        templates: &[PlacedTemplate],
        resources: &Resources,
        segments: &[Segment],
        bounds: Aabb,
    ) -> Self {
        let mut kept = Self {
            label_sets: LabelSets::default(),
            set_count: 0,
            parts: [0; MAX_KEEP_SETS],
            shared_sets: 0,
            shares_add: true,
            keeps_deep: false,
            items: [KeptGroup::default(); MAX_TEMPLATES],
            unknown: Vec::new(),
            align_mode: 0,
            constraints: 0,
        };
        let acting: Vec<PlacedTemplate> = templates
            .iter()
            .map(|template| resources.acting(template))
            .filter(|t| t.enabled)
            .take(MAX_TEMPLATES)
            .collect();
        let enabled: Vec<&PlacedTemplate> = acting.iter().collect();
        let sets = keep_sets(&acting);
        let members = kept.divide(&sets, &enabled);
        for (set, names) in sets.iter().take(MAX_KEEP_SETS).enumerate() {
            for name in names {
                let labels = labels_of(name, segments);
                if labels.is_empty() && !kept.unknown.contains(name) {
                    kept.unknown.push(name.clone());
                }
                for label in labels.into_iter().map(usize::from) {
                    kept.label_sets[label / 32][label / 8 % 4] |= members[set] << (4 * (label % 8));
                }
            }
        }
        let bit = |keep: &[String]| {
            let wanted = keep_set(keep);
            let sets = sets.iter().zip(members);
            let mut found = sets.filter(|(set, _)| **set == wanted);
            found.next().map_or(0, |(_, members)| members)
        };
        let mut head = 0;
        for (index, template) in enabled.iter().enumerate() {
            if index == 0 || template.mode == TemplateMode::Compose {
                head = index;
            }
            let longest = max_displacement(template, resources, bounds);
            let item = &mut kept.items[head];
            item.longest += longest;
            match &template.align {
                Align::Axis => {}
                Align::Surface { depth, thickness } => {
                    // Two depths in one group: what either keeps.
                    let is_first = item.aligned & KEEPS_DEEP == 0;
                    item.depth = if is_first {
                        *depth
                    } else {
                        item.depth.min(*depth)
                    };
                    item.blend = item.blend.max(*thickness);
                    item.aligned |= KEEPS_DEEP;
                    kept.keeps_deep = true;
                }
                Align::Segment { keep, thickness } => {
                    item.blend = item.blend.max(*thickness);
                    item.aligned |= bit(keep);
                }
            }
            let given = template.constrain.iter().flat_map(Constrain::sets);
            let given = given.fold(0, |bits, set| bits | bit(&set));
            if let Some(constrain) = template.constrain.as_ref().filter(|_| given != 0) {
                item.gives_way_to |= given;
                item.constraint = match constrain.by {
                    ConstrainBy::Displacement => CONSTRAIN_DISPLACEMENT,
                    ConstrainBy::Coordinate => CONSTRAIN_COORDINATE,
                    ConstrainBy::Rigid | ConstrainBy::Bodies | ConstrainBy::Parts => {
                        CONSTRAIN_RIGID
                    }
                };
                kept.constraints |= 1 << item.constraint;
            }
        }
        for item in kept
            .items
            .iter_mut()
            .filter(|i| i.constraint == CONSTRAIN_RIGID)
        {
            // The motion nearest to a displacement goes farther than it in places, and what lies about a segment that
            // turns goes farther than the segment.
            item.longest = 2.0 * item.longest + 0.02;
        }
        for item in &mut kept.items {
            item.keeps = item.aligned;
        }
        kept.guard_late(&enabled);
        kept.find_runs(&enabled);
        kept.find_shared();
        for (head, item) in kept.items.iter_mut().enumerate() {
            item.before = match item.constraint {
                CONSTRAIN_NOTHING => 0,
                CONSTRAIN_RIGID => head as u32,
                _ => item.run,
            };
            let is_many = item.constraint == CONSTRAIN_RIGID && item.gives_way_to != 1;
            kept.constraints |= u32::from(item.before != 0) << CONSTRAIN_LATE
                | u32::from(is_many) << CONSTRAIN_MANY;
        }
        kept
    }

    /// Which labels of a volume belong to the sets that end at the smooth surface of their shares.
    pub fn labels(
        templates: &[PlacedTemplate],
        resources: &Resources,
        segments: &[Segment],
    ) -> KeptLabels {
        let kept = Self::of(templates, resources, segments, Aabb::UNIT);
        let words = kept.label_sets.as_flattened();
        KeptLabels::new(|label| {
            let word = words[usize::from(label) / 8];
            (word >> (4 * (label % 8)) & kept.shared_sets) as u8
        })
    }

    /// Counts the sets, and divides what is left of [`MAX_KEEP_SETS`] among those whose connected parts move each by
    /// itself, in turn. Returns a bit for each set that stands for one of the given: for itself, and for its parts.
    fn divide(
        &mut self,
        sets: &[Vec<String>],
        enabled: &[&PlacedTemplate],
    ) -> [u32; MAX_KEEP_SETS] {
        let count = sets.len().min(MAX_KEEP_SETS);
        let mut members = std::array::from_fn(|set| if set < count { 1 << set } else { 0 });
        let constraints = enabled.iter().filter_map(|t| t.constrain.as_ref());
        let parted: Vec<Vec<String>> = constraints
            .filter(|constrain| constrain.by == ConstrainBy::Parts)
            .flat_map(Constrain::sets)
            .collect();
        let parted: Vec<usize> = (0..count)
            .filter(|set| parted.contains(&sets[*set]))
            .collect();
        self.set_count = if parted.is_empty() {
            count
        } else {
            MAX_KEEP_SETS
        } as u32;
        for (free, set) in (count..MAX_KEEP_SETS).zip(parted.iter().cycle()) {
            members[*set] |= 1 << free;
        }
        for (set, parts) in self.parts.iter_mut().enumerate() {
            let of_it = members.iter().filter(|members| *members >> set & 1 != 0);
            let own: u32 = of_it.sum();
            *parts = if own.count_ones() > 1 { own } else { 0 };
        }
        members
    }

    /// A displacement that gives way to tissue which templates before it have moved guards it as an alignment does, by
    /// asking what the object has where the template acts: it stays there, and nothing comes from it. Where nothing
    /// acts before, the way to the tissue at rest says all.
    fn guard_late(&mut self, enabled: &[&PlacedTemplate]) {
        let yields = |item: &KeptGroup| {
            [CONSTRAIN_DISPLACEMENT, CONSTRAIN_COORDINATE].contains(&item.constraint)
        };
        let is_late = |i: usize| {
            let is_head = enabled[i].mode == TemplateMode::Compose;
            i > 0 && is_head && yields(&self.items[i])
        };
        if (0..enabled.len()).any(is_late) {
            for item in self.items.iter_mut().filter(|item| yields(item)) {
                item.keeps |= item.gives_way_to;
            }
        }
    }

    fn find_shared(&mut self) {
        let sets_of = |item: &KeptGroup| match item.constraint {
            CONSTRAIN_DISPLACEMENT | CONSTRAIN_COORDINATE => item.keeps | item.gives_way_to,
            _ => item.keeps,
        };
        let shared = self.items.iter().fold(0, |sets, item| sets | sets_of(item));
        self.shared_sets = shared & (KEEPS_DEEP - 1);
        let words = self.label_sets.as_flattened().iter();
        let mut of_labels = words.flat_map(|word| (0..8).map(move |i| word >> (4 * i) & 15));
        self.shares_add = of_labels.all(|sets| (sets & shared).count_ones() <= 1);
    }

    fn find_runs(&mut self, enabled: &[&PlacedTemplate]) {
        let is_head = |i: usize, t: &PlacedTemplate| i == 0 || t.mode == TemplateMode::Compose;
        let heads: Vec<usize> = enabled
            .iter()
            .enumerate()
            .filter(|(i, t)| is_head(*i, t))
            .map(|(i, _)| i)
            .collect();
        let (mut base, mut before) = (0, None);
        for &head in &heads {
            let item = &mut self.items[head];
            let same = (item.keeps, item.depth.to_bits());
            if before != Some(same) {
                base = head;
                before = Some(same);
            }
            item.run = base as u32;
        }
        let keeping: Vec<usize> = heads
            .iter()
            .copied()
            .filter(|&i| self.items[i].keeps != 0)
            .collect();
        self.align_mode = match heads.len() {
            _ if keeping.is_empty() && self.constraints == 0 => 0,
            1 if keeping.is_empty() => 4,
            1 => 1,
            _ if keeping.iter().all(|&i| self.items[i].run == 0) => 2,
            _ => 3,
        };
    }

    /// A notice for each name that the subject has no segment for.
    pub fn notices(&self) -> Vec<RenderNotice> {
        let unknown = self.unknown.iter().cloned();
        unknown.map(RenderNotice::UnknownKept).collect()
    }

    /// True if nothing is kept and nothing gives way.
    pub fn is_nothing(&self) -> bool {
        self.align_mode == 0
    }

    /// True if something about the whole map has to be found: motions, or longest displacements.
    pub fn needs_fit(&self) -> bool {
        self.constraints & (1 << CONSTRAIN_COORDINATE) != 0 || self.has_rigid()
    }

    /// True if some segment moves as a whole.
    pub fn has_rigid(&self) -> bool {
        self.constraints & (1 << CONSTRAIN_RIGID) != 0
    }

    /// What the pipeline constant `kept_by` has to be: bit 0 for segments, bit 1 for the depth, bit 2 for connected
    /// parts.
    pub fn kept_by(&self) -> u32 {
        let has_parts = self.parts.iter().any(|parts| *parts != 0);
        u32::from(self.set_count > 0) | u32::from(self.keeps_deep) << 1 | u32::from(has_parts) << 2
    }
}
