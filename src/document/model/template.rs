//! A placed template and everything that belongs to it.

use super::clay::Clay;
use super::curve::Curve;
use super::object::{ObjectPlacement, ObjectSource, SceneObject};
use crate::displace::{
    Amount, ControlPoints, Holds, MAX_GRIDS, MAX_PIECES, MAX_SWEEP_STEPS, MOST_STEPS, ParamValue,
    Shrinking, SweepTools, Sweeping, TemplateKind, ToolShape,
};
use crate::document::limits::MAX_CARVERS;
use crate::math::{Bent, Placement};
use glam::{Quat, Vec2, Vec3};

/// A template of the document with its place and parameters, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedTemplate {
    /// Index in the document's `templates`, which may also hold kinds that this version does not know.
    pub index: usize,
    /// The kind of deformation.
    pub kind: TemplateKind,
    /// The author's name for it, or empty.
    pub name: String,
    /// Where its cube lies in subject space.
    pub placement: Placement,
    /// The line that the top of the template lies along; `None` if the template is straight.
    pub curve: Option<Curve>,
    /// One value per entry of `kind.spec().params`, in that order.
    pub params: Vec<ParamValue>,
    /// How much of the deformation is done, from 0 (none) to 1 (as the parameters say); see [`PlacedTemplate::acting`].
    pub amount: f32,
    /// False: the template is left out.
    pub enabled: bool,
    /// How it joins the template before it.
    pub mode: TemplateMode,
    /// The tissue that the template leaves where it is.
    pub align: Align,
    /// The tissue towards which its displacement fades, if any.
    pub constrain: Option<Constrain>,
    /// Control points, the file of a field, an object or tools, for the kinds that have them.
    pub data: TemplateData,
}

impl PlacedTemplate {
    /// A straight template with the default parameters of its kind, fully done and composed with the template before
    /// it. Control points and files are added by the caller.
    pub fn new(kind: TemplateKind, placement: Placement) -> Self {
        let params = kind.spec().params.iter();
        Self {
            index: 0,
            kind,
            name: String::new(),
            placement,
            curve: None,
            params: params.map(|param| param.kind.default_value()).collect(),
            amount: 1.0,
            enabled: true,
            mode: TemplateMode::Compose,
            align: Align::Axis,
            constrain: None,
            data: match kind.facts().holds {
                Holds::Tools => TemplateData::Tools(SweepTools::default()),
                _ => TemplateData::None,
            },
        }
    }

    /// This template with its amount worked in, as its kind says ([`Amount`]); the amount is 1 then. At 0 every kind is
    /// the identity or switched off.
    pub fn acting(&self) -> Self {
        let mut acting = self.clone();
        if self.amount >= 1.0 {
            return acting;
        }
        let part = self.amount.max(0.0);
        acting.amount = 1.0;
        let facts = self.kind.facts();
        if matches!(facts.amount, Amount::ParametersOrNone) {
            acting.enabled &= part > 0.0;
        }
        match facts.amount {
            Amount::Parameters | Amount::ParametersOrNone => {
                let main = self.kind.spec().main_param;
                for (i, value) in acting.params.iter_mut().enumerate() {
                    *value = match *value {
                        ParamValue::Number(value) if main == Some(i) => {
                            ParamValue::Number(value * part)
                        }
                        ParamValue::Vector(value) if main == Some(i) => {
                            ParamValue::Vector(value * part)
                        }
                        ParamValue::Rotation(turn) => {
                            ParamValue::Rotation(Quat::IDENTITY.slerp(turn, part))
                        }
                        other => other,
                    };
                }
            }
            Amount::Box(shrinking) => {
                acting.enabled &= part > 0.0;
                // A box without a size has no inverse.
                acting.shrink(shrinking(&self.params), part.max(1e-3));
            }
        }
        acting
    }

    /// The object that a `carve` cuts by; `None` for one without an object, and for any other kind.
    pub fn carves_by(&self) -> Option<&FoundObject> {
        match &self.data {
            TemplateData::Object(held) => held.found.as_ref(),
            _ => None,
        }
    }

    /// Makes its box smaller, to a part of its size.
    fn shrink(&mut self, shrinking: Shrinking, part: f32) {
        let size = self.placement.size;
        let (scale, towards) = match shrinking {
            Shrinking::ToCentre => (Vec2::splat(part), Vec2::splat(0.5)),
            Shrinking::ToTop => (Vec2::new(1.0, part), Vec2::ONE),
        };
        let curve = self.curve.take();
        self.curve = curve.map(|curve| curve.in_part(scale, towards));
        match shrinking {
            Shrinking::ToCentre => self.placement.size = size * part,
            Shrinking::ToTop => {
                self.placement.size.z = size.z * part;
                let down = 0.5 * size.z * (1.0 - part);
                self.placement.at += self.placement.rotate * Vec3::new(0.0, 0.0, down);
            }
        }
    }

    /// Value of a number parameter by name; 0 if there is none of that name.
    pub fn number(&self, name: &str) -> f32 {
        let found = self.kind.spec().params.iter().position(|p| p.name == name);
        match found.and_then(|i| self.params.get(i)) {
            Some(ParamValue::Number(value)) => *value,
            _ => 0.0,
        }
    }
}

/// How a template joins the one before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TemplateMode {
    /// Deforms what the templates before it left.
    Compose,
    /// The displacement is added to that of the template before this one.
    Add,
}

impl TemplateMode {
    /// All modes; the first is the default.
    pub(crate) const ALL: [Self; 2] = [Self::Compose, Self::Add];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 2] = ["compose", "add"];
}

/// A displacement that fades towards kept tissue, so that no other tissue is drawn through it (dissertation, section
/// 5.7).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constrain {
    /// The quantity that fades.
    pub by: ConstrainBy,
    /// Segments that stay where they are: names, or label numbers written as text.
    pub keep: Vec<String>,
}

impl Constrain {
    /// The sets of segments that count as one each: all of them together, or of bodies each for itself.
    pub fn sets(&self) -> Vec<Vec<String>> {
        match self.by {
            ConstrainBy::Bodies => keep_set(&self.keep)
                .into_iter()
                .map(|name| vec![name])
                .collect(),
            _ => vec![keep_set(&self.keep)],
        }
    }
}

/// The quantity of a template that fades towards kept tissue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstrainBy {
    /// The length of the displacement (section 5.7.1).
    Displacement,
    /// The main parameter, which stands for the template's own coordinate: a twist turns less (section 5.7.2).
    Coordinate,
    /// The kept segments move rigidly (least-squares fit to the displacement); nearby tissue blends into that motion
    /// (section 5.7.2, second part).
    Rigid,
    /// As [`ConstrainBy::Rigid`], but each of the kept segments moves by its own motion, as bones do at a joint.
    Bodies,
    /// As [`ConstrainBy::Bodies`], but each connected part of them moves by its own motion: of a segment that holds
    /// several bones, each bone. As many of the largest as there are sets left; what is smaller goes with the largest.
    Parts,
}

impl ConstrainBy {
    /// All ways; the first is the default.
    pub(crate) const ALL: [Self; 5] = [
        Self::Displacement,
        Self::Coordinate,
        Self::Rigid,
        Self::Bodies,
        Self::Parts,
    ];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 5] =
        ["displacement", "coordinate", "rigid", "bodies", "parts"];
}

/// The tissue that a template leaves where it is (dissertation, section 5.4).
#[derive(Clone, Debug, PartialEq)]
pub enum Align {
    /// None: the template moves everything.
    Axis,
    /// Tissue that lies deeper than `depth` under the outer surface.
    Surface {
        /// Depth under the outer surface from where on tissue is kept, subject units.
        depth: f32,
        /// Width of the blend between moved and kept tissue, subject units.
        thickness: f32,
    },
    /// Tissue of the segments that `keep` names.
    Segment {
        /// Segment names, or label numbers written as text.
        keep: Vec<String>,
        /// Width of the blend between moved and kept tissue, subject units.
        thickness: f32,
    },
}

impl Align {
    /// Names in documents: axis, surface, segment; the first is the default.
    pub(crate) const NAMES: [&'static str; 3] = ["axis", "surface", "segment"];
    /// `depth` of a document that gives none, subject units.
    pub const DEFAULT_DEPTH: f32 = 0.02;
    /// `thickness` of a document that gives none, subject units.
    pub const DEFAULT_THICKNESS: f32 = 0.01;
}

impl PlacedTemplate {
    /// The bent space that the template acts in; `None` if the template is straight.
    pub fn bent(&self) -> Option<Bent> {
        self.curve.as_ref()?.bent(self.placement.size).ok()
    }

    /// Template space to subject space, along the curve if there is one.
    pub fn subject_from_template(&self, q: Vec3) -> Vec3 {
        let straight = self.bent().map_or(q, |bent| bent.bend(q));
        self.placement.subject_from_template(straight)
    }

    /// Subject space to template space, along the curve if there is one. Points that the bent space does not reach are
    /// mapped as if the template were straight.
    pub fn template_from_subject(&self, pos: Vec3) -> Vec3 {
        let straight = self.placement.template_from_subject(pos);
        let own = self.bent().and_then(|bent| bent.unbend(straight));
        own.unwrap_or(straight)
    }
}

/// What a template holds besides its parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum TemplateData {
    /// No data: the parameters are all.
    #[default]
    None,
    /// The control points of an `rbf`.
    Points(ControlPoints),
    /// The file of a `field`.
    Field(FieldRef),
    /// The object of a `carve`.
    Object(ObjectRef),
    /// The tools of a `sweep`.
    Tools(SweepTools),
}

/// The object of a `carve`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjectRef {
    /// Its name, as the document writes it.
    pub name: String,
    /// The object that has this name, if it may carve.
    pub found: Option<FoundObject>,
}

/// What a template takes from its object. The place of the template is that of the object.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundObject {
    /// The object's index in the document's list.
    pub index: usize,
    /// Where the triangles of the object come from.
    pub source: ObjectSource,
    /// Where the object lies; `None` is where its file says.
    pub placement: Option<ObjectPlacement>,
}

impl ObjectPlacement {
    /// The cube of a template that an object with this placement gives it.
    pub fn cube(&self) -> Placement {
        Placement {
            at: self.at,
            rotate: self.rotate,
            size: Vec3::splat(self.size),
        }
    }
}

/// Why a `carve` does nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotCarving {
    /// It names nothing.
    Nameless,
    /// No object has the name.
    Unknown,
    /// The object of this name is disabled.
    Disabled,
    /// More objects carve than may.
    TooMany,
}

impl NotCarving {
    /// In plain words.
    pub fn why(self) -> &'static str {
        match self {
            Self::Nameless => "the template names no object to carve by",
            Self::Unknown => "no object has this name",
            Self::Disabled => "the object of this name is disabled",
            Self::TooMany => "more than four objects carve",
        }
    }
}

/// Gives each `carve` the object that it names, and with it its place. Says which of them do nothing, by their index,
/// and why.
pub(in crate::document) fn join_objects(
    templates: &mut [PlacedTemplate],
    objects: &[SceneObject],
) -> Vec<(usize, NotCarving)> {
    let mut without = Vec::new();
    let mut carving: Vec<&str> = Vec::new();
    for template in templates {
        let TemplateData::Object(held) = &mut template.data else {
            continue;
        };
        held.found = None;
        let object = objects.iter().find(|object| object.name == held.name);
        let object = match object {
            _ if held.name.is_empty() => Err(NotCarving::Nameless),
            None => Err(NotCarving::Unknown),
            Some(object) if !object.enabled => Err(NotCarving::Disabled),
            Some(object) => Ok(object),
        };
        let object = object.and_then(|object| {
            let is_known = carving.contains(&object.name.as_str());
            if template.enabled && !is_known {
                if carving.len() == MAX_CARVERS {
                    return Err(NotCarving::TooMany);
                }
                carving.push(&object.name);
            }
            Ok(object)
        });
        match object {
            Ok(object) => {
                held.found = Some(FoundObject {
                    index: object.index,
                    source: object.source.clone(),
                    placement: object.placement,
                });
                template.placement = match object.placement {
                    Some(placement) => placement.cube(),
                    None => template.placement,
                };
                template.curve = None;
            }
            Err(why) => without.push((template.index, why)),
        }
    }
    without
}

/// Leaves out the sweeps with which a document would have more pieces of paths or more steps than it may. Says which,
/// by their index.
pub(in crate::document) fn limit_sweeps(templates: &mut [PlacedTemplate]) -> Vec<usize> {
    let mut used = [0, 0];
    let mut over = Vec::new();
    let mut counts = vec![0; templates.len()];
    for (template, count) in templates.iter_mut().zip(&mut counts) {
        let bent = template.bent();
        let size = bent.map_or(template.placement.size, |bent| bent.size());
        let TemplateData::Tools(tools) = &mut template.data else {
            continue;
        };
        tools.is_left_out = false;
        let [pieces, steps] = Sweeping::counted(tools, size, MAX_PIECES - used[0]);
        let all = [used[0] + pieces, used[1] + steps];
        tools.is_left_out = all[0] > MAX_PIECES || all[1] > MAX_SWEEP_STEPS;
        match tools.is_left_out {
            true => over.push(template.index),
            false => (used, *count) = (all, steps),
        }
    }
    // Each is done in as many steps as is its share of those that are counted.
    for (template, count) in templates.iter_mut().zip(counts) {
        if let TemplateData::Tools(tools) = &mut template.data {
            tools.most_steps = (MOST_STEPS * count).div_ceil(used[1].max(1));
        }
    }
    over
}

/// Leaves out the tools with which a document would have more different meshes as tools than it may; those of a clay
/// come first. Says which, by the index of their template and their own.
pub(in crate::document) fn limit_grids(
    templates: &mut [PlacedTemplate],
    clay: Option<&Clay>,
) -> Vec<[usize; 2]> {
    let of_clay = clay.iter().flat_map(|clay| &clay.tools);
    let of_clay = of_clay.filter_map(|tool| tool.shape.as_ref()?.file()?.key());
    let mut known: Vec<String> = of_clay.map(str::to_owned).collect();
    known.sort();
    known.dedup();
    let mut over = Vec::new();
    for template in templates {
        let TemplateData::Tools(tools) = &mut template.data else {
            continue;
        };
        for tool in &mut tools.tools {
            let Some(ToolShape::Mesh { file, .. }) = &mut tool.shape else {
                continue;
            };
            file.is_left_out = false;
            let Some(key) = file.key().map(str::to_owned) else {
                continue;
            };
            if !known.contains(&key) {
                file.is_left_out = known.len() == MAX_GRIDS;
                match file.is_left_out {
                    true => over.push([template.index, tool.index]),
                    false => known.push(key),
                }
            }
        }
    }
    over
}

/// The file of a `field`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldRef {
    /// The address of the file, relative to the document or absolute; without one the reader supplies the file.
    pub src: Option<String>,
    /// SHA-256 of its bytes, lower-case hex, if given.
    pub sha256: Option<String>,
    /// The author's name for it, or empty.
    pub name: String,
    /// True if the document places the box; false if the file does.
    pub is_placed: bool,
}

impl FieldRef {
    /// The key that tells this file from other files: its hash, else its address.
    pub fn key(&self) -> Option<&str> {
        self.sha256.as_deref().or(self.src.as_deref())
    }
}

/// The different sets of segments that templates keep (`align`, `constrain`), each sorted, in the order in which they
/// first occur. Empty sets keep nothing and are left out.
pub fn keep_sets(templates: &[PlacedTemplate]) -> Vec<Vec<String>> {
    let mut sets: Vec<Vec<String>> = Vec::new();
    for template in templates {
        let aligned = match &template.align {
            Align::Segment { keep, .. } => Some(keep),
            Align::Axis | Align::Surface { .. } => None,
        };
        let constrained = template.constrain.iter().flat_map(Constrain::sets);
        for set in aligned
            .map(|keep| keep_set(keep))
            .into_iter()
            .chain(constrained)
        {
            if !set.is_empty() && !sets.contains(&set) {
                sets.push(set);
            }
        }
    }
    sets
}

/// The names of one `keep` list, sorted, each once.
pub fn keep_set(keep: &[String]) -> Vec<String> {
    let mut set = keep.to_vec();
    set.sort();
    set.dedup();
    set
}
