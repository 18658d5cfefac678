//! The segments of the subject in the making: what its label volumes bring and what the document's recipes find in its
//! voxels, computed between frames, so that nothing ever waits for it.
//!
//! On the processor and not on the GPU: parts that hang together are found in one pass over the voxels there, which a
//! GPU needs hundreds of rounds for, and the result is the same bit for bit on every device. A thread would need the
//! voxels a second time in the page.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use crate::app::picture::pending::{Pending, poll_once};
use crate::assets::Assets;
use crate::data::{Segmented, Turns, segment};
use crate::document::{Illustration, Recipe, SegmentsRef};
use crate::render::Clock;

/// Seconds of each frame that go into it.
const SHARE: f64 = 0.008;

/// The work under way, and what the last result was made of.
pub(crate) struct TissueWork {
    clock: Clock,
    /// What the segments that are shown were made of.
    made_of: Option<Wanted>,
    job: Option<Job>,
    /// Voxels of each recipe, in order, as of the last result.
    pub(crate) counts: Vec<u64>,
}

/// Inputs of the segments: the label volumes of the document that have arrived, and the recipes.
#[derive(Clone, Debug, Default, PartialEq)]
struct Wanted {
    segments: Vec<SegmentsRef>,
    recipes: Vec<Recipe>,
}

impl Wanted {
    fn of(assets: &Assets, illustration: &Illustration) -> Self {
        Self {
            segments: assets.segments_here(illustration),
            recipes: illustration.recipes.clone(),
        }
    }
}

/// Segments are made of values: a subject without them keeps the ones that it came with.
fn has_values(assets: &Assets) -> bool {
    assets.subject().is_some_and(|s| s.values().is_some())
}

struct Job {
    wanted: Wanted,
    /// Notices about the author's names for labels.
    notices: Vec<String>,
    until: Rc<Cell<f64>>,
    turns: Turns,
    work: Pending<Segmented>,
}

impl TissueWork {
    pub(crate) fn new(clock: Clock) -> Self {
        Self {
            clock,
            made_of: None,
            job: None,
            counts: Vec::new(),
        }
    }

    /// Another subject is shown, with the segments that it came with.
    pub(crate) fn restart(&mut self) {
        self.job = None;
        self.made_of = Some(Wanted::default());
        self.counts.clear();
    }

    /// True while the segments that are shown are not yet those that the document describes.
    pub(crate) fn is_behind(&self, assets: &Assets, illustration: &Illustration) -> bool {
        has_values(assets) && self.made_of.as_ref() != Some(&Wanted::of(assets, illustration))
    }

    /// How far the work under way is, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.turns.progress())
    }

    /// Goes on for its share of a frame. A result is to be shown. `is_dragging`: more changes are about to come; what
    /// has begun is then ended first, so that something is seen on the way.
    pub(crate) fn advance(
        &mut self,
        assets: &mut Assets,
        illustration: &Illustration,
        is_dragging: bool,
    ) -> Option<Segmented> {
        if !has_values(assets) {
            return None;
        }
        let wanted = Wanted::of(assets, illustration);
        if !is_dragging && self.job.as_ref().is_some_and(|job| job.wanted != wanted) {
            self.job = None;
        }
        if self.job.is_none() {
            if self.made_of.as_ref() == Some(&wanted) {
                return None;
            }
            self.job = self.start(assets, illustration, wanted);
        }
        let job = self.job.as_mut()?;
        job.until.set((self.clock)() + SHARE);
        let mut made = poll_once(&mut job.work)?;
        let job = self.job.take()?;
        made.notices.splice(0..0, job.notices);
        self.made_of = Some(job.wanted);
        self.counts.clone_from(&made.counts);
        Some(made)
    }

    fn start(
        &self,
        assets: &mut Assets,
        illustration: &Illustration,
        wanted: Wanted,
    ) -> Option<Job> {
        let (clock, until) = (self.clock, Rc::new(Cell::new(0.0)));
        let deadline = Rc::clone(&until);
        let turns = Turns::until(move || clock() > deadline.get());
        let (resources, mut notices) = assets.segment_resources(illustration);
        if self.made_of.as_ref().map(|made| &made.segments) == Some(&wanted.segments) {
            // Their notices were shown when the names arrived.
            notices.clear();
        }
        let volume = Arc::clone(resources.subject.as_ref()?.values()?);
        let files = resources.segmentations;
        let work = segment(volume, files, wanted.recipes.clone(), turns.clone());
        Some(Job {
            wanted,
            notices,
            until,
            turns,
            work: Box::pin(work),
        })
    }
}
