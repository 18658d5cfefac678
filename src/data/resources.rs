use std::borrow::Cow;
use std::sync::Arc;

use super::{FieldSamples, Segment, Segmentation, Volume};
use crate::document::{ParamValue, PlacedTemplate, TemplateData};

/// What has come of the files that a document names. It stands beside the
/// [`Illustration`](crate::document::Illustration), which only names them: whoever draws or measures takes both. Cheap
/// to clone.
#[derive(Clone, Debug, Default)]
pub struct Resources {
    /// The subject, as its file has it.
    pub volume: Option<Arc<Volume>>,
    /// Segments of the subject's own file under the author's names, where the author names any.
    pub own_segments: Option<Arc<Vec<Segment>>>,
    /// Label volumes beside the subject, in the order of the document, under the author's names.
    pub segmentations: Vec<Arc<Segmentation>>,
    /// Samples of displacement fields, by file and reading.
    pub fields: Vec<(FieldKey, FieldSamples)>,
}

/// What tells the samples of one `field` from those of another: the file, and how the template reads its vectors.
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
    /// Of a template that names the file of a field; `None` for any other.
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
    /// The samples of a `field`, if they are there.
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

    /// The template as it acts ([`PlacedTemplate::acting`]). A `field` that the document gives no place lies where its
    /// file says.
    pub fn acting(&self, template: &PlacedTemplate) -> PlacedTemplate {
        let mut acting = template.acting();
        if let TemplateData::Field(field) = &template.data
            && !field.is_placed
            && let Some(FieldSamples(samples)) = self.field(template)
        {
            acting.placement = samples.placement;
        }
        acting
    }

    /// The label volume of the subject's own file, under the author's names.
    pub fn own_segmentation(&self) -> Option<Cow<'_, Segmentation>> {
        let own = self.volume.as_ref()?.segmentation.as_ref()?;
        Some(match &self.own_segments {
            Some(segments) => Cow::Owned(Segmentation {
                segments: segments.to_vec(),
                ..own.clone()
            }),
            None => Cow::Borrowed(own),
        })
    }
}

/// The same things, not things that are alike: what is shared is never compared voxel by voxel.
impl PartialEq for Resources {
    fn eq(&self, other: &Self) -> bool {
        fn is_same<T>(a: &Option<Arc<T>>, b: &Option<Arc<T>>) -> bool {
            match (a, b) {
                (Some(a), Some(b)) => Arc::ptr_eq(a, b),
                (a, b) => a.is_none() && b.is_none(),
            }
        }
        let segmentations = self.segmentations.iter().zip(&other.segmentations);
        is_same(&self.volume, &other.volume)
            && is_same(&self.own_segments, &other.own_segments)
            && self.segmentations.len() == other.segmentations.len()
            && segmentations.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
            && self.fields == other.fields
    }
}
