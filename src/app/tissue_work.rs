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
use crate::document::FeatureRecipe;
use crate::render::Clock;

/// Seconds of each frame that go into it.
const SHARE: f64 = 0.008;

/// See the module.
pub(crate) struct TissueWork {
    clock: Clock,
    volume: Option<Arc<Volume>>,
    /// Label volumes beside it, with the hash of their files.
    pub(crate) files: Vec<(String, Arc<LabelVolume>)>,
    /// What the segments that are shown were made of.
    made_of: Option<Vec<FeatureRecipe>>,
    job: Option<Job>,
    /// Voxels of each recipe, in order, as of the last result.
    pub(crate) counts: Vec<u64>,
}

struct Job {
    recipes: Vec<FeatureRecipe>,
    until: Rc<Cell<f64>>,
    turns: Turns,
    work: Pending<Segmented>,
}

impl TissueWork {
    pub(crate) fn new(clock: Clock) -> Self {
        Self {
            clock,
            volume: None,
            files: Vec::new(),
            made_of: None,
            job: None,
            counts: Vec::new(),
        }
    }

    /// Another volume is shown, with the segments that it came with.
    pub(crate) fn set_volume(&mut self, volume: Arc<Volume>) {
        self.volume = Some(volume);
        self.job = None;
        self.made_of = self.files.is_empty().then(Vec::new);
        self.counts.clear();
    }

    /// Takes a label volume in addition, in place of one from the same file.
    pub(crate) fn add_file(&mut self, sha256: String, labels: LabelVolume) {
        self.files.retain(|(known, _)| *known != sha256);
        self.files.push((sha256, Arc::new(labels)));
        self.job = None;
        self.made_of = None;
    }

    /// Keeps only the label volumes that the document names, in its order.
    pub(crate) fn keep_files(&mut self, wanted: &[String]) {
        let before: Vec<String> = self.files.iter().map(|(hash, _)| hash.clone()).collect();
        self.files.retain(|(hash, _)| wanted.contains(hash));
        self.files
            .sort_by_key(|(hash, _)| wanted.iter().position(|w| w == hash));
        if !self.files.iter().map(|(hash, _)| hash).eq(&before) {
            self.job = None;
            self.made_of = None;
        }
    }

    /// True while the segments that are shown are not yet those of these recipes.
    pub(crate) fn is_behind(&self, wanted: &[FeatureRecipe]) -> bool {
        self.volume.is_some() && self.made_of.as_deref() != Some(wanted)
    }

    /// How far the work under way is, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.turns.progress())
    }

    /// Goes on for its share of a frame. A result is to be shown. `is_dragging`: more changes are about to come; what has begun is then
    /// ended first, so that something is seen on the way.
    pub(crate) fn advance(
        &mut self,
        wanted: &[FeatureRecipe],
        is_dragging: bool,
    ) -> Option<Segmented> {
        let volume = self.volume.as_ref()?;
        if !is_dragging && self.job.as_ref().is_some_and(|job| job.recipes != wanted) {
            self.job = None;
        }
        if self.job.is_none() {
            if self.made_of.as_deref() == Some(wanted) {
                return None;
            }
            let (clock, until) = (self.clock, Rc::new(Cell::new(0.0)));
            let deadline = Rc::clone(&until);
            let turns = Turns::until(move || clock() > deadline.get());
            let files = self.files.iter().map(|(_, labels)| Arc::clone(labels));
            let work = segment(
                Arc::clone(volume),
                files.collect(),
                wanted.to_vec(),
                turns.clone(),
            );
            self.job = Some(Job {
                recipes: wanted.to_vec(),
                until,
                turns,
                work: Box::pin(work),
            });
        }
        let job = self.job.as_mut()?;
        job.until.set((self.clock)() + SHARE);
        let made = poll_once(&mut job.work)?;
        self.made_of = self.job.take().map(|job| job.recipes);
        self.counts.clone_from(&made.counts);
        Some(made)
    }
}
