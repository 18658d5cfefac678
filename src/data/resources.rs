use std::sync::Arc;

use super::{Segmentation, Subject};
use crate::document::{
    FieldSamples, Illustration, ParamValue, PlacedTemplate, SampledField, TemplateData,
};

/// The data of the files that a document names, as far as they have arrived. An [`Illustration`] only names the files,
/// so drawing and measuring take both. Cheap to clone.
#[derive(Clone, Debug, Default)]
pub struct Resources {
    /// The subject, with the segments of its own file under the author's names.
    pub subject: Option<Subject>,
    /// Label volumes beside the subject, in the order of the document, under the author's names.
    pub segmentations: Vec<Arc<Segmentation>>,
    /// Samples of displacement fields, by file and reading.
    pub fields: Vec<(FieldKey, Arc<SampledField>)>,
}

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
    pub fn field(&self, template: &PlacedTemplate) -> Option<&Arc<SampledField>> {
        if self.fields.is_empty() {
            return None;
        }
        let key = FieldKey::of(template)?;
        let found = self.fields.iter().find(|(known, _)| *known == key);
        found.map(|(_, samples)| samples)
    }

    /// Adds the samples of a field.
    pub fn add_field(&mut self, key: FieldKey, samples: Arc<SampledField>) {
        self.fields.retain(|(known, _)| *known != key);
        self.fields.push((key, samples));
    }

    /// Gives each `field` template its samples; a template without a placement in the document is placed as the file
    /// says.
    pub fn attach_fields(&self, illustration: &mut Illustration) {
        for template in &mut illustration.templates {
            let Some(samples) = self.field(template).cloned() else {
                continue;
            };
            if let TemplateData::Field(field) = &mut template.data {
                if !field.is_placed {
                    template.placement = samples.placement;
                }
                field.samples = Some(FieldSamples(samples));
            }
        }
    }
}

/// Two values are equal if they share volumes, labels and samples in memory; the contents are never compared.
impl PartialEq for Resources {
    fn eq(&self, other: &Self) -> bool {
        let is_same_subject = match (&self.subject, &other.subject) {
            (Some(a), Some(b)) => a.is_same(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        let segmentations = self.segmentations.iter().zip(&other.segmentations);
        let fields = self.fields.iter().zip(&other.fields);
        is_same_subject
            && self.segmentations.len() == other.segmentations.len()
            && self.fields.len() == other.fields.len()
            && segmentations.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
            && fields
                .into_iter()
                .all(|((k, a), (l, b))| k == l && Arc::ptr_eq(a, b))
    }
}
