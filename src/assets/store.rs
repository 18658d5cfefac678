use std::sync::Arc;

use super::naming::rename;
use super::want::{OtherFile, Role, Want, Wanted};
use crate::data::{FieldKey, Grid, Resources, Segment, Segmentation, Subject};
use crate::document::{Illustration, SampledField, SegmentsRef, TemplateData};
use crate::load::{FieldFile, FieldUse, LabelFile};

/// What a file turned out to hold.
#[derive(Clone, Debug)]
pub enum Data {
    /// A subject. `sha256` is that of its file; a built-in one has none.
    Subject {
        /// The subject with all its values and segments.
        subject: Subject,
        /// SHA-256 of the file, lower-case hex.
        sha256: Option<String>,
    },
    /// A label volume, from a file of its own.
    Segments(LabelFile),
    /// The samples of a displacement field.
    Field(FieldFile),
}

impl Data {
    /// SHA-256 of the file with these data, lower-case hex; `None` for a built-in subject.
    pub fn sha256(&self) -> Option<&str> {
        match self {
            Self::Subject { sha256, .. } => sha256.as_deref(),
            Self::Segments(file) => Some(&file.sha256),
            Self::Field(file) => Some(&file.sha256),
        }
    }
}

/// A file that has arrived; found again by the hash of its bytes or by the address that it was fetched from.
#[derive(Clone, Debug)]
struct Held<T> {
    src: Option<String>,
    sha256: String,
    file: Arc<T>,
}

fn find<'a, T>(held: &'a [Held<T>], want: &Want) -> Option<&'a Arc<T>> {
    let is_it = |one: &&Held<T>| match want.sha256() {
        Some(wanted) => one.sha256.eq_ignore_ascii_case(wanted),
        None => one.src.is_some() && one.src.as_deref() == want.src(),
    };
    held.iter().find(is_it).map(|one| &one.file)
}

/// Files that documents wanted and that have arrived. Files of earlier documents stay, so that undo finds them again.
#[derive(Debug, Default)]
pub struct Assets {
    subject: Option<Subject>,
    /// Where the subject's voxels lie.
    grid: Option<Grid>,
    segments: Vec<Held<LabelFile>>,
    fields: Vec<Held<FieldFile>>,
    /// Label volumes that no document names; they come after those that the document names.
    added: Vec<Arc<Segmentation>>,
    /// Wants that cannot be met.
    refused: Vec<Want>,
    /// Label volumes under the author's names.
    named: Vec<(SegmentsRef, Arc<Segmentation>)>,
    /// Fields over the present subject; `None` for one that does not fit.
    fitted: Vec<(FieldKey, Option<Arc<SampledField>>)>,
}

impl Assets {
    /// Takes the file that was fetched or supplied for a want.
    ///
    /// # Errors
    /// [`OtherFile`] if the document means a file of another hash. The want counts as refused then, and nothing is
    /// taken.
    pub fn take(&mut self, want: &Want, data: Data) -> Result<(), OtherFile> {
        if let Some(found) = data.sha256()
            && let Err(other) = want.check(found)
        {
            self.refuse(want);
            return Err(other);
        }
        self.refused.retain(|refused| refused != want);
        self.hold(want.src().map(str::to_owned), data);
        Ok(())
    }

    /// Takes a file that the reader gave unasked: it is found by its hash from now on. A subject takes the place of the
    /// present one.
    pub fn give(&mut self, data: Data) {
        self.hold(None, data);
    }

    /// Takes a label volume that goes with the subject although no document names it.
    pub fn add_segments(&mut self, file: LabelFile) {
        self.added.push(Arc::new(file.segmentation));
    }

    fn hold(&mut self, src: Option<String>, data: Data) {
        fn put<T>(held: &mut Vec<Held<T>>, src: Option<String>, sha256: String, file: T) {
            held.retain(|one| one.sha256 != sha256 || (one.src.is_some() && one.src != src));
            let file = Arc::new(file);
            held.push(Held { src, sha256, file });
        }
        match data {
            Data::Subject { subject, .. } => {
                self.place(subject.values().map(|volume| volume.grid));
                self.subject = Some(subject);
            }
            Data::Segments(file) => {
                self.named.clear();
                put(&mut self.segments, src, file.sha256.clone(), file);
            }
            Data::Field(file) => {
                self.fitted.clear();
                put(&mut self.fields, src, file.sha256.clone(), file);
            }
        }
    }

    /// Says where the voxels of the subject lie, for fields where the subject itself is not needed.
    pub fn set_grid(&mut self, grid: Grid) {
        self.place(Some(grid));
    }

    fn place(&mut self, grid: Option<Grid>) {
        if self.grid != grid {
            self.grid = grid;
            self.fitted.clear();
        }
    }

    /// Nobody can meet this want: it is not asked for again until [`Assets::forget_addresses`].
    pub fn refuse(&mut self, want: &Want) {
        if !self.refused.contains(want) {
            self.refused.push(want.clone());
        }
    }

    /// True if a want could not be met.
    pub fn is_refused(&self, want: &Want) -> bool {
        self.refused.contains(want)
    }

    /// Another document is opened, perhaps from another place: an address in it may mean another file than before.
    pub fn forget_addresses(&mut self) {
        self.refused.clear();
        self.named.clear();
        self.fitted.clear();
        self.segments.iter_mut().for_each(|one| one.src = None);
        self.fields.iter_mut().for_each(|one| one.src = None);
    }

    /// True if the file of this want has arrived. Only one subject is held at a time.
    pub fn has(&self, want: &Want) -> bool {
        match want.role {
            Role::Subject => self.subject.is_some(),
            Role::Segments => find(&self.segments, want).is_some(),
            Role::Field => find(&self.fields, want).is_some(),
        }
    }

    /// What has not come, in the order in which it is wanted.
    pub fn missing(&self, illustration: &Illustration) -> Vec<Want> {
        let mut wants = Wanted::of(illustration).0;
        wants.retain(|want| !self.has(want));
        wants
    }

    /// The subject that is held.
    pub fn subject(&self) -> Option<&Subject> {
        self.subject.as_ref()
    }

    /// Where the voxels of the subject lie, once that is known; `None` too if the subject has none.
    pub fn grid(&self) -> Option<&Grid> {
        self.grid.as_ref()
    }

    /// Label volumes that the document names and that are here, with the names for segments of the subject's own file:
    /// what the segments of the picture are made of.
    pub fn segments_here(&self, illustration: &Illustration) -> Vec<SegmentsRef> {
        let is_here = |named: &&SegmentsRef| match Want::segments(named) {
            Some(want) => self.has(&want),
            None => true,
        };
        let named = illustration.segments.iter().filter(is_here);
        named.cloned().collect()
    }

    /// The subject and the label volumes of a document, under the author's names, with a notice for each name of a
    /// number that does not occur. What has not come is left out; fields are attached by whoever draws.
    pub fn segment_resources(&mut self, illustration: &Illustration) -> (Resources, Vec<String>) {
        let mut notices = Vec::new();
        let mut subject = self.subject.clone();
        let mut segmentations = Vec::new();
        for (index, named) in illustration.segments.iter().enumerate() {
            // A document may hold one by itself, as the first versions wrote it.
            let pointer = match illustration.segments.len() {
                1 => "/subject/segments".to_owned(),
                _ => format!("/subject/segments/{index}"),
            };
            let Some(want) = Want::segments(named) else {
                if let Some(subject) = subject.as_mut().filter(|_| !named.names.is_empty()) {
                    let number_of = |_: usize, segment: &_| number_of_own(segment);
                    let segments = subject.segments_mut();
                    notices.extend(rename(segments, number_of, &named.names, &pointer));
                }
                continue;
            };
            let Some(file) = find(&self.segments, &want) else {
                continue;
            };
            let known = self.named.iter().find(|(known, _)| known == named);
            if let Some((_, segmentation)) = known {
                segmentations.push(Arc::clone(segmentation));
                continue;
            }
            let mut segmentation = file.segmentation.clone();
            let number_of = |i: usize, segment: &_| {
                let number = file.numbers.get(i).copied().map(u32::from);
                number.unwrap_or_else(|| number_of_own(segment))
            };
            let segments = &mut segmentation.segments;
            notices.extend(rename(segments, number_of, &named.names, &pointer));
            let segmentation = Arc::new(segmentation);
            self.named.push((named.clone(), Arc::clone(&segmentation)));
            segmentations.push(segmentation);
        }
        segmentations.extend(self.added.iter().cloned());
        let resources = Resources {
            subject,
            segmentations,
            ..Resources::default()
        };
        (resources, notices)
    }

    /// The fields of templates that act, laid over the subject, and news about fields that were laid over the subject
    /// for the first time. Both are empty before there is a subject.
    pub fn field_resources(&mut self, illustration: &Illustration) -> (Resources, Vec<FieldNews>) {
        let (mut resources, mut news) = (Resources::default(), Vec::new());
        let Some(grid) = self.grid else {
            return (resources, news);
        };
        for template in illustration.templates.iter().filter(|t| t.enabled) {
            let TemplateData::Field(field) = &template.data else {
                continue;
            };
            let (Some(key), Some(want)) = (FieldKey::of(template), Want::field(field)) else {
                continue;
            };
            let known = self.fitted.iter().find(|(known, _)| *known == key);
            if let Some((_, samples)) = known {
                if let Some(samples) = samples {
                    resources.add_field(key, Arc::clone(samples));
                }
                continue;
            }
            let Some(file) = find(&self.fields, &want) else {
                continue;
            };
            let fitted = file.fit(&field_use(&key, &grid));
            let samples = match fitted {
                Ok((samples, notices)) => {
                    let template = template.index;
                    news.extend(
                        notices
                            .into_iter()
                            .map(|line| FieldNews::Notice(template, line)),
                    );
                    Some(Arc::new(samples))
                }
                Err(why) => {
                    news.push(FieldNews::Refused(template.index, why));
                    None
                }
            };
            self.fitted.push((key.clone(), samples.clone()));
            if let Some(samples) = samples {
                resources.add_field(key, samples);
            }
        }
        (resources, news)
    }
}

/// News about a field that was laid over a subject, with the index of its template in the document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FieldNews {
    /// The field is drawn, but not quite as its file has it; a line for the user.
    Notice(usize, String),
    /// The field cannot be used with this subject; the reason for the user.
    Refused(usize, String),
}

/// How a template reads the vectors of its file over a subject of this grid.
fn field_use<'a>(key: &FieldKey, subject: &'a Grid) -> FieldUse<'a> {
    FieldUse {
        is_subject_units: key.unit == 1,
        is_lps: match key.axes {
            1 => Some(true),
            2 => Some(false),
            _ => None,
        },
        subject,
    }
}

/// Number of a segment of the subject's own file, which is its label.
fn number_of_own(segment: &Segment) -> u32 {
    u32::from(segment.label)
}
