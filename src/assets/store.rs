use std::sync::Arc;

use glam::DVec3;

use super::naming::rename;
use super::news::ResourceNews;
use super::want::{OtherFile, Role, Source, Want, Wanted, tool_files};
use crate::data::{
    FieldKey, FieldSamples, Grid, Grids, MeshGrids, ObjectMeshes, Resources, Segment, Segmentation,
    Subject, Surface, share_grids,
};
use crate::document::{
    Clay, Illustration, SegmentsRef, SubjectBox, SubjectRef, TemplateData, ToolFile,
};
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
    /// The mesh of an object, or the meshes beside a volume. `sha256` is that of the file, or of the first; a built-in
    /// one has none.
    Object {
        /// The mesh in its own space; beside a volume in that of the volume.
        mesh: Arc<Surface>,
        /// SHA-256 of the file, lower-case hex.
        sha256: Option<String>,
    },
}

impl Data {
    /// SHA-256 of the file with these data, lower-case hex; `None` for a built-in subject.
    pub fn sha256(&self) -> Option<&str> {
        match self {
            Self::Subject { sha256, .. } | Self::Object { sha256, .. } => sha256.as_deref(),
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
    /// The recipe of the subject, if it is a clay.
    clay: Option<Arc<Clay>>,
    /// Where the subject's voxels lie.
    grid: Option<Grid>,
    segments: Vec<Held<LabelFile>>,
    fields: Vec<Held<FieldFile>>,
    /// The grids with which the clay was made, and those with which it was last asked for.
    clay_meshes: MeshGrids,
    asked_meshes: MeshGrids,
    /// Meshes of objects, of tools and those beside the subject, each with the want that it met.
    meshes: Vec<(Want, Arc<Surface>)>,
    /// It was told that the meshes beside the present subject are not drawn.
    has_told_kept: bool,
    /// Label volumes that no document names; they come after those that the document names.
    added: Vec<Arc<Segmentation>>,
    /// Wants that cannot be met.
    refused: Vec<Want>,
    /// Label volumes under the author's names.
    named: Vec<(SegmentsRef, Arc<Segmentation>)>,
    /// Segments of the subject's own file, with the names that the author gives them.
    own_named: Option<(Vec<SegmentsRef>, Arc<Vec<Segment>>)>,
    /// Fields over the present subject; `None` for one that does not fit.
    fitted: Vec<(FieldKey, Option<FieldSamples>)>,
    /// Templates and objects of which it was told that they are too thin.
    thin: Vec<(usize, String)>,
    /// Keys of files of tools of which it was told that they have no inside.
    sheets: Vec<String>,
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
        let data = match (data, &want.source) {
            (Data::Subject { subject, sha256 }, Source::File { name, .. }) => Data::Subject {
                subject: subject.called(name),
                sha256,
            },
            (data, _) => data,
        };
        match data {
            Data::Object { mesh, .. } => {
                self.meshes.retain(|(met, _)| !met.is_same_mesh(want));
                let named = match &want.source {
                    // The only segment of a mesh of the subject takes the author's name for it.
                    Source::File { name, .. } if want.role == Role::Mesh => {
                        Subject::Mesh(mesh).called(name)
                    }
                    _ => Subject::Mesh(mesh),
                };
                if let Subject::Mesh(mesh) = named {
                    self.meshes.push((want.clone(), mesh));
                }
            }
            data => self.hold(want.src().map(str::to_owned), data),
        }
        if want.role == Role::Subject {
            self.clay = want.clay().cloned();
            self.clay_meshes.clone_from(&want.meshes);
        }
        Ok(())
    }

    /// Takes a file that the reader gave unasked: it is found by its hash from now on. A subject takes the place of the
    /// present one.
    pub fn give(&mut self, data: Data) {
        self.hold(None, data);
    }

    /// Takes the present subject; `clay` is its recipe if it is one.
    pub fn give_subject(&mut self, data: Data, clay: Option<Arc<Clay>>) {
        self.hold(None, data);
        self.clay = clay;
        self.clay_meshes.clone_from(&self.asked_meshes);
    }

    /// What is to be asked for to have a subject: of a clay with the grids of its tools that are there.
    pub fn subject_want(&self, subject: &SubjectRef) -> Want {
        self.with_meshes(Want::subject(subject))
    }

    /// This is asked for now. A subject that comes next is made with its grids.
    pub fn asked_for(&mut self, want: &Want) {
        if want.role == Role::Subject {
            self.asked_meshes.clone_from(&want.meshes);
        }
    }

    /// True if meshes have come since a clay was last asked for that its tools are made of.
    pub fn has_new_tools(&self, clay: &Clay) -> bool {
        !share_grids(&self.meshes_of(clay), &self.asked_meshes)
    }

    fn with_meshes(&self, want: Want) -> Want {
        let meshes = want.clay().map(|clay| self.meshes_of(clay));
        Want {
            meshes: meshes.unwrap_or_default(),
            ..want
        }
    }

    /// The grids of a clay's tools that are there, each once.
    fn meshes_of(&self, clay: &Clay) -> MeshGrids {
        self.grids_of(clay.tool_files())
    }

    fn grids_of<'a>(&self, files: impl Iterator<Item = &'a ToolFile>) -> MeshGrids {
        let mut meshes = MeshGrids::new();
        for file in files {
            if let (Some(key), Some(want)) = (file.key(), Want::tool(file))
                && meshes.iter().all(|(known, _)| known != key)
                && let Some((_, grid)) = self.mesh(&want).and_then(|mesh| mesh.grids.first())
            {
                meshes.push((key.to_owned(), Arc::clone(grid)));
            }
        }
        meshes
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
                let grid = subject.values().map(|volume| volume.grid);
                let own = || subject.segmentation().map(|segmentation| segmentation.grid);
                self.place(grid.or_else(own));
                self.own_named = None;
                self.has_told_kept = false;
                self.clay = None;
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
            // An object is nothing without the want that it meets.
            Data::Object { .. } => {}
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

    /// A want that could not be met can be met now.
    pub fn ask_again(&mut self, want: &Want) {
        self.refused.retain(|refused| refused != want);
    }

    /// True if a want could not be met.
    pub fn is_refused(&self, want: &Want) -> bool {
        self.refused.contains(want)
    }

    /// Another document is opened, perhaps from another place: an address in it may mean another file than before.
    pub fn forget_addresses(&mut self) {
        self.refused.clear();
        self.named.clear();
        self.own_named = None;
        self.fitted.clear();
        self.segments.iter_mut().for_each(|one| one.src = None);
        self.fields.iter_mut().for_each(|one| one.src = None);
        let is_by_hash = |met: &Want| {
            let further = &met.reading.meshes;
            (met.src().is_none() || met.sha256().is_some())
                && further.iter().all(|mesh| mesh.sha256.is_some())
        };
        self.meshes.retain(|(met, _)| is_by_hash(met));
    }

    /// True if the file of this want has arrived. Only one subject is held at a time.
    pub fn has(&self, want: &Want) -> bool {
        match want.role {
            Role::Subject => {
                let is_made =
                    |clay: &Arc<Clay>| share_grids(&self.meshes_of(clay), &self.clay_meshes);
                self.subject.is_some()
                    && self.clay.as_ref() == want.clay()
                    && self.clay.as_ref().is_none_or(is_made)
            }
            Role::Segments => find(&self.segments, want).is_some(),
            Role::Field => find(&self.fields, want).is_some(),
            Role::Object => {
                let is_enough = |mesh: &Arc<Surface>| mesh.carver.is_some() || !want.reading.carves;
                self.mesh(want).is_some_and(is_enough)
            }
            Role::Mesh | Role::Tool => self.mesh(want).is_some(),
        }
    }

    fn mesh(&self, want: &Want) -> Option<&Arc<Surface>> {
        let found = self.meshes.iter().find(|(met, _)| met.is_same_mesh(want));
        found.map(|(_, mesh)| mesh)
    }

    /// What has not come, in the order in which it is wanted.
    pub fn missing(&self, illustration: &Illustration) -> Vec<Want> {
        let mut wants = Wanted::of(illustration).0;
        // Those beside the subject are read in one, once it is known where they lie.
        wants.retain(|want| want.role != Role::Mesh && !self.has(want));
        let mut wants: Vec<Want> = wants.into_iter().map(|w| self.with_meshes(w)).collect();
        let beside = self.meshes_wanted(illustration);
        wants.extend(beside.filter(|want| !self.has(want)));
        wants
    }

    /// What the meshes beside a volume are read by, those left out whose file nobody has. `None` without such meshes,
    /// and before it is known where the volume lies.
    pub fn meshes_wanted(&self, illustration: &Illustration) -> Option<Want> {
        self.subject.as_ref()?.values()?;
        let frame = self.grid?.frame();
        let middle = match illustration.subject {
            // Of a built-in subject they lie from its centre.
            SubjectRef::Builtin { .. } => DVec3::ZERO,
            _ => frame.middle_mm,
        };
        let half = DVec3::splat(0.5 * frame.mm_per_unit);
        let bounds = SubjectBox {
            min_mm: middle - half,
            max_mm: middle + half,
        };
        let meshes = &illustration.meshes_beside;
        let starts = (0..meshes.len()).filter_map(|k| Want::meshes(meshes.get(k..)?, bounds));
        starts.into_iter().find(|want| !self.is_refused(want))
    }

    /// A file has come that meshes beside the subject may have waited for: they are read again.
    pub fn ask_for_meshes_again(&mut self) {
        self.refused.retain(|refused| refused.role != Role::Mesh);
        self.meshes.retain(|(met, _)| met.role != Role::Mesh);
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

    /// The data of the files that a document names: its subject with the meshes beside it, its label volumes under the
    /// author's names, and the
    /// fields of templates that act, laid over the subject. Files that have not arrived are left out. There are no
    /// fields before the grid of the subject is known.
    ///
    /// The news come once each: when a label volume or a subject is given its names, and when a field is laid over a
    /// subject. Cheap where nothing has changed.
    pub fn resources(&mut self, illustration: &Illustration) -> (Resources, Vec<ResourceNews>) {
        let mut news = Vec::new();
        let (own_segments, segmentations) = self.named_segments(illustration, &mut news);
        let wanted = self.meshes_wanted(illustration);
        let meshes = wanted.and_then(|want| self.mesh(&want)).cloned();
        let is_mesh = self.subject.as_ref().is_some_and(|s| s.values().is_none());
        if is_mesh && !illustration.meshes_beside.is_empty() && !self.has_told_kept {
            self.has_told_kept = true;
            news.push(ResourceNews::MeshesKept);
        }
        let resources = Resources {
            subject: (self.subject.clone()).map(|subject| subject.with_meshes(meshes)),
            own_segments,
            segmentations,
            fields: self.field_samples(illustration, &mut news),
            objects: self.object_meshes(illustration),
            frame: self.subject.as_ref().map(Subject::frame),
            sheet: None,
            clay: self.clay.clone(),
            grids: self.grids(illustration, &mut news),
        };
        self.tell_of_thin(illustration, &resources, &mut news);
        (resources, news)
    }

    /// Tells once of each `carve` whose object cuts nothing.
    fn tell_of_thin(
        &mut self,
        illustration: &Illustration,
        resources: &Resources,
        news: &mut Vec<ResourceNews>,
    ) {
        for template in illustration.templates.iter().filter(|t| t.enabled) {
            let TemplateData::Object(held) = &template.data else {
                continue;
            };
            let told = (template.index, held.name.clone());
            let is_thin = resources
                .carver(template)
                .is_some_and(|carver| !carver.cuts());
            if is_thin && !self.thin.contains(&told) {
                news.push(ResourceNews::TooThin {
                    template: told.0,
                    object: told.1.clone(),
                });
                self.thin.push(told);
            }
        }
    }

    /// The grids of tools that are here. Tells once of each that is a sheet.
    fn grids(&mut self, illustration: &Illustration, news: &mut Vec<ResourceNews>) -> Grids {
        let files = tool_files(illustration);
        let grids = Grids {
            files: self.grids_of(files.iter().map(|(_, file)| *file)),
            baked: self.subject.as_ref().map_or_else(Vec::new, Subject::baked),
        };
        for (key, _) in grids.files.iter().filter(|(_, grid)| grid.is_open()) {
            if !self.sheets.contains(key) {
                self.sheets.push(key.clone());
                let mut files = files.iter();
                let Some((pointer, file)) = files.find(|(_, file)| file.key() == Some(key)) else {
                    continue;
                };
                let name = match file.name.as_str() {
                    "" => key,
                    name => name,
                };
                news.push(ResourceNews::ToolIsSheet {
                    pointer: pointer.clone(),
                    name: name.to_owned(),
                });
            }
        }
        grids
    }

    /// The meshes of objects that are here, each once.
    fn object_meshes(&self, illustration: &Illustration) -> ObjectMeshes {
        let mut meshes = ObjectMeshes::new();
        for object in &illustration.objects {
            if meshes.iter().all(|(known, _)| *known != object.source)
                && let Some(want) = Want::object(object, illustration)
                && let Some(mesh) = self.mesh(&want)
            {
                meshes.push((object.source.clone(), Arc::clone(mesh)));
            }
        }
        meshes
    }

    /// The segments of the subject's own file, where the author names any, and the label volumes that are here.
    fn named_segments(
        &mut self,
        illustration: &Illustration,
        news: &mut Vec<ResourceNews>,
    ) -> (Option<Arc<Vec<Segment>>>, Vec<Arc<Segmentation>>) {
        let is_own =
            |named: &&SegmentsRef| Want::segments(named).is_none() && !named.names.is_empty();
        let names: Vec<SegmentsRef> = illustration
            .segments
            .iter()
            .filter(is_own)
            .cloned()
            .collect();
        let own_segments = self.subject.as_ref().map(Subject::segments);
        let is_named = |(known, _): &&(Vec<SegmentsRef>, _)| *known == names;
        let mut own = match own_segments.filter(|_| !names.is_empty()) {
            Some(segments) if self.own_named.as_ref().filter(is_named).is_none() => {
                Some(segments.to_vec())
            }
            // Nothing is named, or it is known already.
            _ => None,
        };
        let has_own = own_segments.is_some() && !names.is_empty();
        let mut segmentations = Vec::new();
        for (index, named) in illustration.segments.iter().enumerate() {
            // A document may hold one by itself, as the first versions wrote it.
            let pointer = match illustration.segments.len() {
                1 => "/subject/segments".to_owned(),
                _ => format!("/subject/segments/{index}"),
            };
            match (Want::segments(named), &mut own) {
                (Some(want), _) => {
                    segmentations.extend(self.named_file(&want, named, &pointer, news));
                }
                (None, Some(own)) => {
                    let number_of = |_: usize, segment: &_| number_of_own(segment);
                    news.extend(rename(own, number_of, &named.names, &pointer));
                }
                (None, None) => {}
            }
        }
        segmentations.extend(self.added.iter().cloned());
        if let Some(own) = own {
            self.own_named = Some((names, Arc::new(own)));
        }
        let own = self.own_named.as_ref().filter(|_| has_own);
        (own.map(|(_, own)| Arc::clone(own)), segmentations)
    }

    /// A label volume under the author's names, if it is here.
    fn named_file(
        &mut self,
        want: &Want,
        named: &SegmentsRef,
        pointer: &str,
        news: &mut Vec<ResourceNews>,
    ) -> Option<Arc<Segmentation>> {
        let file = find(&self.segments, want)?;
        if let Some((_, known)) = self.named.iter().find(|(known, _)| known == named) {
            return Some(Arc::clone(known));
        }
        let mut segmentation = file.segmentation.clone();
        let number_of = |i: usize, segment: &_| {
            let number = file.numbers.get(i).copied().map(u32::from);
            number.unwrap_or_else(|| number_of_own(segment))
        };
        news.extend(rename(
            &mut segmentation.segments,
            number_of,
            &named.names,
            pointer,
        ));
        let segmentation = Arc::new(segmentation);
        self.named.push((named.clone(), Arc::clone(&segmentation)));
        Some(segmentation)
    }

    /// The fields of templates that act, laid over the subject.
    fn field_samples(
        &mut self,
        illustration: &Illustration,
        news: &mut Vec<ResourceNews>,
    ) -> Vec<(FieldKey, FieldSamples)> {
        let mut fields = Vec::new();
        let Some(grid) = self.grid else {
            return fields;
        };
        for template in illustration.templates.iter().filter(|t| t.enabled) {
            let TemplateData::Field(field) = &template.data else {
                continue;
            };
            let (Some(key), Some(want)) = (FieldKey::of(template), Want::field(field)) else {
                continue;
            };
            if fields.iter().any(|(known, _)| *known == key) {
                continue;
            }
            let known = self.fitted.iter().find(|(known, _)| *known == key);
            let samples = match known {
                Some((_, samples)) => samples.clone(),
                None => {
                    let Some(file) = find(&self.fields, &want) else {
                        continue;
                    };
                    let samples = laid(file, &field_use(&key, &grid), template.index, news);
                    self.fitted.push((key.clone(), samples.clone()));
                    samples
                }
            };
            fields.extend(samples.map(|samples| (key, samples)));
        }
        fields
    }
}

/// The samples of a field over a subject, for the template of this index; `None` if it does not fit.
fn laid(
    file: &FieldFile,
    field_use: &FieldUse<'_>,
    template: usize,
    news: &mut Vec<ResourceNews>,
) -> Option<FieldSamples> {
    match file.fit(field_use) {
        Ok((samples, notices)) => {
            let notices = notices.into_iter();
            news.extend(notices.map(|line| ResourceNews::FieldNotice { template, line }));
            Some(FieldSamples(Arc::new(samples)))
        }
        Err(why) => {
            news.push(ResourceNews::FieldRefused { template, why });
            None
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::{cube, in_one_part};
    use crate::data::{SubjectPart, SubjectSink as _, Surface, Volume, VolumeBuilder, Voxels};
    use crate::document::Document;
    use glam::{DAffine3, UVec3};

    /// Two voxels, of the segments 1 and 2.
    fn subject() -> Arc<Volume> {
        let grid = Grid {
            dims: UVec3::new(2, 1, 1),
            world_from_voxel: DAffine3::IDENTITY,
        };
        let segment = |label: u16| Segment {
            label,
            name: format!("segment {label}"),
            color_srgb: None,
        };
        let header = Volume {
            has_size: true,
            grid,
            voxels: Voxels::U8(Vec::new()),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 1.0],
            segmentation: Some(Segmentation {
                grid,
                labels: Vec::new(),
                segments: vec![segment(1), segment(2)],
            }),
        };
        let mut builder = VolumeBuilder::new();
        for part in [
            SubjectPart::header(header),
            SubjectPart::Scalars(Voxels::U8(vec![0, 1])),
            SubjectPart::Labels(vec![1, 2]),
        ] {
            builder.take(part).expect("a small volume");
        }
        Arc::new(builder.finish().expect("whole"))
    }

    #[test]
    fn own_segments_are_named_and_news_are_told_once() {
        let text = r#"{ "fabrica": 1, "subject": { "builtin": "cube",
            "segments": { "names": { "2": "nail", "7": "horn" } } } }"#;
        let document = Document::from_json(text).expect("a document");
        let illustration = document.illustration();
        let mut assets = Assets::default();
        assert_eq!(assets.resources(illustration).1, [], "nothing has come");
        let volume = subject();
        let data = || Data::Subject {
            subject: Subject::from(Arc::clone(&volume)),
            sha256: None,
        };
        assets.give(data());
        let (first, news) = assets.resources(illustration);
        let lines: Vec<String> = news.iter().map(ToString::to_string).collect();
        assert_eq!(
            lines,
            [
                "/subject/segments/names/7: the file has no segment of this number; “horn” names nothing"
            ]
        );
        let own = first.own_segmentation().expect("its own segments");
        let names: Vec<&str> = own.segments.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["segment 1", "nail"]);
        assert_eq!(own.labels, [1, 2]);
        let is_shared = first
            .subject
            .as_ref()
            .is_some_and(|s| s.is_same(&Subject::from(Arc::clone(&volume))));
        assert!(is_shared, "voxels are not copied for names");
        // Nothing has changed: the same things, and no news.
        let again = assets.resources(illustration);
        assert_eq!(again, (first, Vec::new()));
        // Another document does not name them.
        let plain = Document::new();
        let (resources, news) = assets.resources(plain.illustration());
        assert_eq!((resources.own_segments, news), (None, Vec::new()));
        // A subject that comes anew is named anew.
        assets.give(data());
        assert_eq!(assets.resources(illustration).1.len(), 1);
    }

    /// A cube, or one without its lid, as a tool.
    fn tool(is_open: bool) -> Arc<Surface> {
        let (positions, mut triangles) = cube();
        if is_open {
            triangles.truncate(10);
        }
        let mesh = in_one_part(positions, triangles);
        let surface = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
        Arc::new(surface.sweeping(&mut |_| true).expect("not stopped"))
    }

    #[test]
    fn a_clay_is_asked_for_again_when_its_tools_have_come() {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "tools": [{ "shape": "mesh", "src": "a.stl" }] } },
            "templates": [{ "kind": "sweep", "params": { "tools": [{ "shape": "mesh", "src": "b.stl", "name": "lid" }] } }] }"#;
        let document = Document::from_json(text).expect("a document");
        let illustration = document.illustration();
        let SubjectRef::Clay(clay) = &illustration.subject else {
            panic!("a clay")
        };
        let mut assets = Assets::default();
        let roles = |assets: &Assets| -> Vec<Role> {
            let missing = assets.missing(illustration).into_iter();
            missing.map(|want| want.role).collect()
        };
        let shaped = |assets: &mut Assets| {
            let want = assets.subject_want(&illustration.subject);
            assets.asked_for(&want);
            let data = Data::Subject {
                subject: Subject::Mesh(tool(false)),
                sha256: None,
            };
            assets.give_subject(data, Some(Arc::clone(clay)));
            want.meshes.len()
        };
        assert_eq!(shaped(&mut assets), 0);
        assert!(!assets.has_new_tools(clay));
        assert_eq!(roles(&assets), [Role::Tool, Role::Tool]);
        let take = |assets: &mut Assets, is_open: bool| {
            let mut missing = assets.missing(illustration).into_iter();
            let want = missing.find(|want| want.role == Role::Tool).expect("one");
            let data = Data::Object {
                mesh: tool(is_open),
                sha256: None,
            };
            assets.take(&want, data).expect("no hash is given");
        };
        take(&mut assets, false);
        assert!(assets.has_new_tools(clay));
        assert_eq!(roles(&assets), [Role::Subject, Role::Tool]);
        assert_eq!(shaped(&mut assets), 1);
        assert!(!assets.has_new_tools(clay));
        // The tool of a template is none of the clay's. That it is a sheet is told once.
        take(&mut assets, true);
        assert!(!assets.has_new_tools(clay) && roles(&assets).is_empty());
        let (resources, news) = assets.resources(illustration);
        let keys: Vec<&str> = resources
            .grids
            .files
            .iter()
            .map(|(key, _)| &**key)
            .collect();
        assert_eq!(keys, ["a.stl", "b.stl"]);
        let lines: Vec<String> = news.iter().map(ToString::to_string).collect();
        let told =
            "/templates/0/params/tools/0: “lid” is open and has no inside: as a tool it is a sheet";
        assert_eq!(lines, [told]);
        assert_eq!(assets.resources(illustration), (resources, Vec::new()));
    }
}
