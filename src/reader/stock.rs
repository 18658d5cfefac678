//! The data of documents: a subject with its segments, on the GPU once for all pictures that show it.

use std::sync::Arc;

use crate::assets::{Assets, Bending, Data, LoadEvent, Role, TissueWork, Want, Wanted};
use crate::data::{Plate, Resources, Subject, SubjectBuilder, SubjectSink as _};
use crate::document::{Illustration, Recipe, SegmentsRef, SubjectRef};
use crate::load::{FieldFile, LabelFile};
use crate::render::{Clock, Gpu, RenderError, Renderer};

/// What a stock is made of: pictures with equal keys share one.
#[derive(Clone, Debug, PartialEq)]
pub struct StockKey {
    subject: SubjectRef,
    segments: Vec<SegmentsRef>,
    recipes: Vec<Recipe>,
    /// What relative addresses start from, for a document that has any.
    base: String,
    /// The picture that alone has it, of a clay: pictures may show different strokes.
    picture: Option<u32>,
}

impl StockKey {
    /// The key of an illustration whose relative addresses start from `base`, for the picture of this number.
    pub fn new(illustration: &Illustration, base: &str, picture: u32) -> Self {
        let is_clay = matches!(illustration.subject, SubjectRef::Clay(_));
        let has_addresses = illustration.subject.has_file() || !illustration.segments.is_empty();
        Self {
            subject: illustration.subject.clone(),
            segments: illustration.segments.clone(),
            recipes: illustration.recipes.clone(),
            base: if has_addresses { base } else { "" }.to_owned(),
            picture: is_clay.then_some(picture),
        }
    }

    /// True if the subject is a clay.
    pub fn is_of_clay(&self) -> bool {
        self.picture.is_some()
    }

    /// What relative addresses start from.
    pub fn base(&self) -> &str {
        &self.base
    }
}

/// Why a picture is not what its document says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// One line in plain words.
    pub message: String,
    /// There is no subject at all.
    pub is_fatal: bool,
}

/// A subject with its segments. Somebody else fetches: [`Stock::next_want`] says what, [`Stock::take`] hears what
/// comes.
pub struct Stock {
    key: StockKey,
    /// A document of this key; only its subject, segments and recipes are looked at.
    illustration: Illustration,
    assets: Assets,
    resources: Resources,
    work: TissueWork,
    /// Holds the subject on the GPU and draws nothing.
    host: Renderer,
    incoming: SubjectBuilder,
    incoming_labels: Vec<LabelFile>,
    /// What is under way.
    loading: Option<Want>,
    /// How far that is, 0 to 1.
    fraction: f32,
    is_whole: bool,
    /// Pieces of the subject are on their way to the GPU.
    is_uploading: bool,
    /// A drawing is shown with more pixels than it came with.
    is_finer: bool,
    troubles: Vec<Trouble>,
    /// Grows when the pictures have to be drawn anew.
    revision: u64,
}

impl Stock {
    /// An empty stock for an illustration.
    pub fn new(gpu: &Gpu, clock: Clock, key: StockKey, illustration: &Illustration) -> Self {
        Self {
            key,
            illustration: illustration.clone(),
            assets: Assets::default(),
            resources: Resources::default(),
            work: TissueWork::new(clock),
            host: Renderer::new(gpu.clone(), clock),
            incoming: SubjectBuilder::default(),
            incoming_labels: Vec::new(),
            loading: None,
            fraction: 0.0,
            is_whole: false,
            is_uploading: false,
            is_finer: false,
            troubles: Vec::new(),
            revision: 0,
        }
    }

    /// Which documents it serves.
    pub fn key(&self) -> &StockKey {
        &self.key
    }

    /// The renderer that has the subject on the GPU.
    pub fn host(&self) -> &Renderer {
        &self.host
    }

    /// Grows when the pictures have to be drawn anew.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Follows the picture that it is for: of a clay so many strokes are wanted as are shown.
    pub fn follow(&mut self, shown: &Illustration) {
        if self.key.picture.is_some() {
            self.illustration.look.strokes = shown.look.strokes;
        }
    }

    /// True if the subject that is there is the one that is shown, of a clay as far as its strokes go.
    fn has_shown(&self) -> bool {
        let shown = &self.illustration;
        self.key.picture.is_none() || self.assets.has(&Want::subject(&shown.subject_shown()))
    }

    /// Takes what should be fetched next, if anything, and counts it as under way: the subject, then label volumes.
    pub fn next_want(&mut self) -> Option<Want> {
        if self.loading.is_some() || self.has_failed() {
            return None;
        }
        let mut missing = self.assets.missing(&self.illustration);
        missing.retain(|want| match want.role {
            Role::Subject => true,
            Role::Segments => self.is_whole && want.src().is_some(),
            Role::Field | Role::Mesh | Role::Object | Role::Tool => false,
        });
        missing.retain(|want| !self.assets.is_refused(want));
        self.loading = missing.into_iter().next();
        self.fraction = 0.0;
        if let Some(want) = &self.loading {
            self.assets.asked_for(want);
        }
        self.loading.clone()
    }

    /// Takes an object or meshes that an illustration shows and that have not come as what should be fetched next, and
    /// counts it
    /// as under way.
    pub fn next_object(&mut self, shown: &Illustration) -> Option<Want> {
        if self.loading.is_some() || !self.is_whole {
            return None;
        }
        let mut missing = self.assets.missing(shown);
        let is_one = |want: &Want| matches!(want.role, Role::Object | Role::Mesh | Role::Tool);
        missing.retain(|want| is_one(want) && !self.assets.is_refused(want));
        self.loading = missing.into_iter().next();
        self.fraction = 0.0;
        self.loading.clone()
    }

    /// A displacement field that an illustration shows and that has not come, if it was not refused.
    pub fn missing_fields(&self, shown: &Illustration) -> Vec<Want> {
        let mut missing = self.assets.missing(shown);
        missing.retain(|want| want.role == Role::Field && !self.assets.is_refused(want));
        missing
    }

    /// The plate of the figure, if the subject is one.
    pub fn plate(&self) -> Option<&Arc<Plate>> {
        self.assets.subject().and_then(Subject::plate)
    }

    /// True if a drawing is shown with more pixels than it came with.
    pub fn is_finer(&self) -> bool {
        self.is_finer
    }

    /// True if the subject is there, and is no figure.
    pub fn is_in_space(&self) -> bool {
        self.is_whole && self.assets.subject().is_some() && self.plate().is_none()
    }

    /// Shows a drawing with more pixels once they are there, also after a device was lost.
    pub fn show_finer(&mut self, bending: &mut Bending) {
        let Some(finer) = bending.take_finer() else {
            return;
        };
        let Some(plate) = self.plate().filter(|_| !self.is_finer) else {
            return;
        };
        let finer = Subject::from(plate.redrawn(finer));
        // One that does not fit is shown with the pixels that it had.
        if self.host.set_subject(finer).is_ok() {
            (self.is_finer, self.is_uploading) = (true, true);
            self.revision += 1;
        }
    }

    /// Millimetres in one subject unit, once there is a subject.
    pub fn mm_per_unit(&self) -> Option<f64> {
        let subject = self.assets.subject()?;
        Some(subject.frame().mm_per_unit)
    }

    /// Millimetres in one subject unit, once there is a subject whose file says how large it is.
    pub fn known_mm_per_unit(&self) -> Option<f64> {
        self.assets.subject()?.mm_per_unit()
    }

    /// What is under way, and how far it is, 0 to 1.
    pub fn loading(&self) -> Option<(&Want, f32)> {
        self.loading.as_ref().map(|want| (want, self.fraction))
    }

    /// Tries again what could not be had, for example because the reader gives a file now. True if the subject is
    /// wanted.
    pub fn retry(&mut self) -> bool {
        self.troubles.clear();
        self.assets.forget_addresses();
        (self.loading, self.incoming) = (None, SubjectBuilder::default());
        !self.is_whole
    }

    /// True if everything can be had again: nothing of it is a file that only the reader has.
    pub fn can_come_again(&self) -> bool {
        let wanted = Wanted::of(&self.illustration).0;
        !wanted.iter().any(Want::is_supplied)
    }

    /// What is wrong, the newest last.
    pub fn troubles(&self) -> &[Trouble] {
        &self.troubles
    }

    /// There will be no subject.
    pub fn has_failed(&self) -> bool {
        self.troubles.iter().any(|trouble| trouble.is_fatal)
    }

    /// True when everything has come that will come, and is on the GPU.
    pub fn is_settled(&self) -> bool {
        let is_made = !self.work.is_behind(&self.assets, &self.illustration);
        let is_there = self.is_whole && !self.is_uploading;
        self.has_failed() || (is_there && self.loading.is_none() && is_made && self.has_shown())
    }

    /// Nothing more will come of what is under way, and why.
    pub fn fail(&mut self, message: String) {
        (self.incoming, self.incoming_labels) = (SubjectBuilder::default(), Vec::new());
        let want = self.loading.take();
        let is_fatal = want
            .as_ref()
            .map_or(!self.is_whole, |want| want.role == Role::Subject);
        if let Some(want) = want {
            self.assets.refuse(&want);
        }
        let trouble = Trouble { message, is_fatal };
        if self.troubles.last() != Some(&trouble) {
            self.troubles.push(trouble);
        }
        self.revision += 1;
    }

    /// Hears what has come of what is under way.
    pub fn take(&mut self, event: LoadEvent) {
        match event {
            LoadEvent::Part(part) => {
                if let Err(why) = self.incoming.take(part) {
                    self.fail(why);
                }
            }
            LoadEvent::Progress { fraction, .. } => self.fraction = fraction,
            // An object is shown when it is whole.
            LoadEvent::Coarse => {
                if self
                    .loading
                    .as_ref()
                    .is_some_and(|want| want.role == Role::Subject)
                {
                    self.show_incoming(None);
                }
            }
            LoadEvent::LabelFile(file) => self.incoming_labels.push(*file),
            LoadEvent::Done { sha256 } => self.take_end(sha256),
            // Each part of a clay that is shown says the same again.
            LoadEvent::Notice(message) => {
                let trouble = Trouble {
                    message,
                    is_fatal: false,
                };
                if !self.troubles.contains(&trouble) {
                    self.troubles.push(trouble);
                }
            }
            LoadEvent::Failed { message, .. } => self.fail(message),
            LoadEvent::AskRaw(_) => {
                self.fail("The file does not say how its voxels lie".to_owned());
            }
            LoadEvent::Cancelled => self.fail("Loading was stopped".to_owned()),
            LoadEvent::Frames { .. } | LoadEvent::Modality(_) | LoadEvent::Written(_) => {}
        }
    }

    /// A load has ended well.
    fn take_end(&mut self, sha256: Option<String>) {
        let Some(want) = self.loading.clone() else {
            return;
        };
        if want.role == Role::Subject {
            if let Some(found) = &sha256
                && let Err(other) = want.check(found)
            {
                return self.fail(other.to_string());
            }
            self.show_incoming(sha256.clone());
            self.is_whole = !self.has_failed();
        }
        self.loading = None;
        if matches!(want.role, Role::Object | Role::Mesh | Role::Tool) {
            self.take_mesh(&want, sha256);
        }
        for file in std::mem::take(&mut self.incoming_labels) {
            let data = Data::Segments(file);
            match want.role {
                Role::Segments => {
                    if let Err(other) = self.assets.take(&want, data) {
                        self.troubles.push(Trouble {
                            message: other.to_string(),
                            is_fatal: false,
                        });
                    }
                }
                _ => self.assets.give(data),
            }
        }
        self.revision += 1;
    }

    /// The mesh of an object or those beside the subject have come.
    fn take_mesh(&mut self, want: &Want, sha256: Option<String>) {
        let message = match std::mem::take(&mut self.incoming).finish() {
            Some(Ok((Subject::Mesh(mesh), _))) => {
                let taken = self.assets.take(want, Data::Object { mesh, sha256 });
                taken.err().map(|other| other.to_string())
            }
            _ => {
                self.assets.refuse(want);
                let what = match want.role {
                    Role::Mesh => "A mesh of the subject",
                    Role::Tool => "The mesh of a tool",
                    _ => "An object",
                };
                Some(format!(
                    "{what} has to be a surface mesh: OBJ, STL, PLY or GLB"
                ))
            }
        };
        self.troubles.extend(message.map(|message| Trouble {
            message,
            is_fatal: false,
        }));
    }

    /// A displacement field has come, or why there is none.
    pub fn take_field(&mut self, want: &Want, outcome: Result<FieldFile, String>) {
        let refused = match outcome {
            Ok(file) => self
                .assets
                .take(want, Data::Field(file))
                .map_err(|other| other.to_string()),
            Err(why) => {
                self.assets.refuse(want);
                Err(why)
            }
        };
        if let Err(message) = refused {
            self.troubles.push(Trouble {
                message,
                is_fatal: false,
            });
        }
        self.revision += 1;
    }

    /// The samples of the fields that an illustration shows, laid over the subject.
    pub fn resources(&mut self, shown: &Illustration) -> Resources {
        self.assets.resources(shown).0
    }

    /// Brings the pieces that have come to the GPU and makes segments, for about `budget` seconds. True if there is
    /// more to do.
    ///
    /// # Errors
    /// Those of the renderer; a lost device has to be replaced by [`Stock::recover`].
    pub fn advance(&mut self, budget: f32) -> Result<bool, RenderError> {
        let state = self.host.draw([0, 0], budget, false)?;
        self.is_uploading = state.uploading.is_some();
        let mut is_busy = self.is_uploading;
        if self.assets.subject().is_some() {
            let (resources, news) = self.assets.resources(&self.illustration);
            if let Some(Subject::Space(space)) = &resources.subject {
                self.host.set_meshes(space.meshes.as_ref());
            }
            self.resources = resources;
            self.troubles.extend(news.into_iter().map(|news| Trouble {
                message: news.to_string(),
                is_fatal: false,
            }));
            let shown = &self.illustration;
            let made = self
                .work
                .advance(&self.assets, &self.resources, shown, false);
            if let Some(made) = made {
                self.host.set_segmentation(made.segmentation)?;
                self.revision += 1;
            }
            is_busy |= self.work.is_behind(&self.assets, shown);
        }
        Ok(is_busy)
    }

    /// Goes on with another device after the old one was lost.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn recover(&mut self, gpu: Gpu) -> Result<(), RenderError> {
        self.revision += 1;
        self.is_uploading = true;
        self.host.recover(gpu)
    }

    fn show_incoming(&mut self, sha256: Option<String>) {
        match std::mem::take(&mut self.incoming).finish() {
            Some(Ok((subject, _))) => {
                let shown = subject.clone();
                (self.is_uploading, self.is_finer) = (true, false);
                let data = Data::Subject { subject, sha256 };
                let clay = self.loading.as_ref().and_then(Want::clay);
                self.assets.give_subject(data, clay.cloned());
                self.work.restart();
                if let Err(error) = self.host.set_subject(shown) {
                    self.fail(error.to_string());
                }
                self.revision += 1;
            }
            Some(Err(error)) => self.fail(error.to_string()),
            None => {}
        }
    }
}
