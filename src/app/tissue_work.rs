//! The segments of the subject in the making: what its label volumes bring and what the document's recipes find in its voxels, computed
//! between frames, so that nothing ever waits for it.
//!
//! On the processor and not on the GPU: parts that hang together are found in one pass over the voxels there, which a GPU needs hundreds of
//! rounds for, and the result is the same bit for bit on every device. A thread would need the voxels a second time in the page.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use super::picture::{Pending, poll_once};
use crate::data::{LabelVolume, Segmented, Turns, Volume, segment};
use crate::document::{FeatureRecipe, Illustration, SegmentsRef};
use crate::render::Clock;

/// Seconds of each frame that go into it.
const SHARE: f64 = 0.008;

/// See the module.
pub(crate) struct TissueWork {
    clock: Clock,
    volume: Option<Arc<Volume>>,
    /// Label volumes that were opened, with the hash of their files. They stay, so that undo and redo have them.
    known: Vec<(String, Arc<LabelVolume>)>,
    /// What the segments that are shown were made of.
    made_of: Option<Wanted>,
    job: Option<Job>,
    /// Voxels of each recipe, in order, as of the last result.
    pub(crate) counts: Vec<u64>,
}

/// What segments are made of: what the document says of label volumes that are here, and its recipes.
#[derive(Clone, Debug, Default, PartialEq)]
struct Wanted {
    segments: Vec<SegmentsRef>,
    recipes: Vec<FeatureRecipe>,
}

struct Job {
    wanted: Wanted,
    until: Rc<Cell<f64>>,
    turns: Turns,
    work: Pending<Segmented>,
}

impl TissueWork {
    pub(crate) fn new(clock: Clock) -> Self {
        Self {
            clock,
            volume: None,
            known: Vec::new(),
            made_of: None,
            job: None,
            counts: Vec::new(),
        }
    }

    /// Another volume is shown, with the segments that it came with.
    pub(crate) fn set_volume(&mut self, volume: Arc<Volume>) {
        self.volume = Some(volume);
        self.job = None;
        self.made_of = Some(Wanted::default());
        self.counts.clear();
    }

    /// Takes a label volume that was opened.
    pub(crate) fn add_file(&mut self, sha256: String, labels: LabelVolume) {
        if self.known.iter().all(|(hash, _)| *hash != sha256) {
            self.known.push((sha256, Arc::new(labels)));
        }
    }

    fn file(&self, named: &SegmentsRef) -> Option<&Arc<LabelVolume>> {
        let wanted = named.sha256.as_ref()?;
        let found = self.known.iter().find(|(hash, _)| hash == wanted);
        found.map(|(_, labels)| labels)
    }

    /// True if the document names a label volume that nobody has opened.
    pub(crate) fn lacks_files(&self, illustration: &Illustration) -> bool {
        let is_file = |named: &&SegmentsRef| named.sha256.is_some() || named.src.is_some();
        let mut named = illustration.segments.iter().filter(is_file);
        named.any(|named| self.file(named).is_none())
    }

    fn wanted(&self, illustration: &Illustration) -> Wanted {
        let is_here = |named: &&SegmentsRef| {
            self.file(named).is_some() || (named.sha256.is_none() && named.src.is_none())
        };
        let segments = illustration.segments.iter().filter(is_here);
        Wanted {
            segments: segments.cloned().collect(),
            recipes: illustration.features.clone(),
        }
    }

    /// True while the segments that are shown are not yet those that the document describes.
    pub(crate) fn is_behind(&self, illustration: &Illustration) -> bool {
        self.volume.is_some() && self.made_of.as_ref() != Some(&self.wanted(illustration))
    }

    /// How far the work under way is, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.turns.progress())
    }

    /// Goes on for its share of a frame. A result is to be shown. `is_dragging`: more changes are about to come; what has begun is then
    /// ended first, so that something is seen on the way.
    pub(crate) fn advance(
        &mut self,
        illustration: &Illustration,
        is_dragging: bool,
    ) -> Option<Segmented> {
        let volume = Arc::clone(self.volume.as_ref()?);
        let wanted = self.wanted(illustration);
        if !is_dragging && self.job.as_ref().is_some_and(|job| job.wanted != wanted) {
            self.job = None;
        }
        if self.job.is_none() {
            if self.made_of.as_ref() == Some(&wanted) {
                return None;
            }
            self.job = Some(self.start(volume, wanted));
        }
        let job = self.job.as_mut()?;
        job.until.set((self.clock)() + SHARE);
        let made = poll_once(&mut job.work)?;
        self.made_of = self.job.take().map(|job| job.wanted);
        self.counts.clone_from(&made.counts);
        Some(made)
    }

    fn start(&self, mut volume: Arc<Volume>, wanted: Wanted) -> Job {
        let (clock, until) = (self.clock, Rc::new(Cell::new(0.0)));
        let deadline = Rc::clone(&until);
        let turns = Turns::until(move || clock() > deadline.get());
        let mut files = Vec::new();
        for named in &wanted.segments {
            match self.file(named) {
                Some(labels) if named.names.is_empty() => files.push(Arc::clone(labels)),
                Some(labels) => {
                    let mut labels = LabelVolume::clone(labels);
                    rename(&mut labels, named);
                    files.push(Arc::new(labels));
                }
                // For the segments in the scan's own file.
                None if volume.labels.is_some() => {
                    if let Some(labels) = &mut Arc::make_mut(&mut volume).labels {
                        rename(labels, named);
                    }
                }
                None => {}
            }
        }
        let work = segment(volume, files, wanted.recipes.clone(), turns.clone());
        Job {
            wanted,
            until,
            turns,
            work: Box::pin(work),
        }
    }
}

/// The author's names go before those of the file.
fn rename(labels: &mut LabelVolume, named: &SegmentsRef) {
    for (label, name) in &named.names {
        for segment in &mut labels.segments {
            if u32::from(segment.label) == *label {
                segment.name.clone_from(name);
            }
        }
    }
}
