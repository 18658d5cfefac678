use std::borrow::Cow;
use std::sync::Arc;

use glam::{Quat, Vec3};

use super::{
    Carver, FieldSamples, Grids, Segment, Segmentation, Sheet, Subject, SubjectFrame, Surface,
};
use crate::displace::Holds;
use crate::document::{
    Clay, FoundObject, ObjectSource, ParamValue, PlacedTemplate, SceneObject, TemplateData,
};
use crate::math::Placement;

/// The data of the files that a document names, as far as they have arrived. An
/// [`Illustration`](crate::document::Illustration) only names the files, so drawing and measuring take both. Cheap to
/// clone.
#[derive(Clone, Debug, Default)]
pub struct Resources {
    /// The subject, as its file has it.
    pub subject: Option<Subject>,
    /// Segments of the subject's own file under the author's names, where the author names any.
    pub own_segments: Option<Arc<Vec<Segment>>>,
    /// Label volumes beside the subject, in the order of the document, under the author's names.
    pub segmentations: Vec<Arc<Segmentation>>,
    /// Samples of displacement fields, by file and reading.
    pub fields: Vec<(FieldKey, FieldSamples)>,
    /// Meshes of the objects that have arrived, by where each comes from.
    pub objects: ObjectMeshes,
    /// Where the subject lies; of use where an object that a template carves by lies where its file says.
    pub frame: Option<SubjectFrame>,
    /// The figure as its document bends it, once that is known.
    pub sheet: Option<Sheet>,
    /// The recipe of the subject that is here, if it is a clay: captions go with its strokes.
    pub clay: Option<Arc<Clay>>,
    /// The grids that tools are made of, as far as they are here.
    pub grids: Grids,
}

/// Meshes of objects, by where each comes from.
pub type ObjectMeshes = Vec<(ObjectSource, Arc<Surface>)>;

/// The key of a field's samples: the file, and how the template reads its vectors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldKey {
    /// `FieldRef::key` of the template.
    pub file: String,
    /// Index of the unit in the catalogue: 1 for subject units, else millimetres.
    pub unit: u32,
    /// Index of the directions in the catalogue: those of the file, left posterior superior, right anterior superior.
    pub axes: u32,
}

impl FieldKey {
    /// The key for a template that names the file of a field; `None` for any other template.
    pub fn of(template: &PlacedTemplate) -> Option<Self> {
        let TemplateData::Field(field) = &template.data else {
            return None;
        };
        let choice = |i: usize| match template.params.get(i) {
            Some(ParamValue::Choice(choice)) => *choice,
            _ => 0,
        };
        Some(Self {
            file: field.key()?.to_owned(),
            unit: choice(1),
            axes: choice(2),
        })
    }
}

impl Resources {
    /// The samples for a `field` template, if they have arrived.
    pub fn field(&self, template: &PlacedTemplate) -> Option<&FieldSamples> {
        if self.fields.is_empty() {
            return None;
        }
        let key = FieldKey::of(template)?;
        let found = self.fields.iter().find(|(known, _)| *known == key);
        found.map(|(_, samples)| samples)
    }

    /// Adds the samples of a field.
    pub fn add_field(&mut self, key: FieldKey, samples: FieldSamples) {
        self.fields.retain(|(known, _)| *known != key);
        self.fields.push((key, samples));
    }

    /// The mesh of an object, if it has arrived.
    pub fn object(&self, object: &SceneObject) -> Option<&Arc<Surface>> {
        let found = self
            .objects
            .iter()
            .find(|(source, _)| *source == object.source);
        found.map(|(_, mesh)| mesh)
    }

    /// What a `carve` cuts by, if its object has arrived.
    pub fn carver(&self, template: &PlacedTemplate) -> Option<&Arc<Carver>> {
        let found = template.carves_by()?;
        let mut meshes = self.objects.iter();
        let (_, mesh) = meshes.find(|(source, _)| *source == found.source)?;
        mesh.carver.as_ref()
    }

    /// The cube of a `carve` whose object lies where its file says.
    fn cube_of_file(&self, found: &FoundObject) -> Option<Placement> {
        let frame = self.frame?;
        let mut meshes = self.objects.iter();
        let (_, mesh) = meshes.find(|(source, _)| *source == found.source)?;
        let away = (mesh.frame.middle_mm - frame.middle_mm) / frame.mm_per_unit;
        Some(Placement {
            at: away.as_vec3(),
            rotate: Quat::IDENTITY,
            size: Vec3::splat((mesh.frame.mm_per_unit / frame.mm_per_unit) as f32),
        })
    }

    /// The template as it acts ([`PlacedTemplate::acting`]). A `field` that the document gives no place lies where its
    /// file says, and a `carve` where its object lies; without an object it is switched off.
    pub fn acting(&self, template: &PlacedTemplate) -> PlacedTemplate {
        let mut acting = template.acting();
        if template.kind.facts().holds == Holds::Object {
            let place = |found: &FoundObject| match found.placement {
                Some(placement) => Some(placement.cube()),
                None => self.cube_of_file(found),
            };
            let place = template.carves_by().and_then(place);
            acting.enabled &= place.is_some() && self.carver(template).is_some();
            acting.placement = place.unwrap_or(acting.placement);
        }
        if let TemplateData::Field(field) = &template.data
            && !field.is_placed
            && let Some(FieldSamples(samples)) = self.field(template)
        {
            acting.placement = samples.placement;
        }
        acting
    }

    /// True if both have the same meshes for objects.
    pub fn has_objects_of(&self, other: &Self) -> bool {
        let pairs = self.objects.iter().zip(&other.objects);
        self.objects.len() == other.objects.len()
            && pairs
                .into_iter()
                .all(|((a, mesh), (b, theirs))| a == b && Arc::ptr_eq(mesh, theirs))
    }

    /// The label volume of the subject's own file, under the author's names.
    pub fn own_segmentation(&self) -> Option<Cow<'_, Segmentation>> {
        let own = self.subject.as_ref()?.values()?.segmentation.as_ref()?;
        Some(match &self.own_segments {
            Some(segments) => Cow::Owned(Segmentation {
                segments: segments.to_vec(),
                ..own.clone()
            }),
            None => Cow::Borrowed(own),
        })
    }
}

/// Two values are equal if they share volumes, labels and samples in memory; the contents are never compared.
impl PartialEq for Resources {
    fn eq(&self, other: &Self) -> bool {
        fn both<T>(a: &Option<T>, b: &Option<T>, is_same: impl Fn(&T, &T) -> bool) -> bool {
            match (a, b) {
                (Some(a), Some(b)) => is_same(a, b),
                (a, b) => a.is_none() && b.is_none(),
            }
        }
        let segmentations = self.segmentations.iter().zip(&other.segmentations);
        both(&self.subject, &other.subject, Subject::is_same)
            && both(&self.own_segments, &other.own_segments, Arc::ptr_eq)
            && self.segmentations.len() == other.segmentations.len()
            && segmentations.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
            && self.fields == other.fields
            && self.has_objects_of(other)
            && self.frame == other.frame
            && Sheet::are_same(self.sheet.as_ref(), other.sheet.as_ref())
            && both(&self.clay, &other.clay, Arc::ptr_eq)
            && self.grids == other.grids
    }
}
