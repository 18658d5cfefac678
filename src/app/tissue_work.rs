//! The segments of the subject in the making: what its label volumes bring and what the document's recipes find in its
//! voxels, computed between frames, so that nothing ever waits for it.
//!
//! On the processor and not on the GPU: parts that hang together are found in one pass over the voxels there, which a
//! GPU needs hundreds of rounds for, and the result is the same bit for bit on every device. A thread would need the
//! voxels a second time in the page.

use std::cell::Cell;
use std::rc::Rc;

use crate::app::picture::pending::{Pending, poll_once};
use crate::assets::Assets;
use crate::data::{Resources, Segmented, TimeSlices, segment};
use crate::document::{Illustration, Recipe, SegmentsRef};
use crate::render::Clock;

/// Seconds of each frame that go into it.
const SHARE: f64 = 0.008;

/// The work under way, and what the last result was made of.
pub(crate) struct TissueWork {
    clock: Clock,
    /// What the segments that are shown were made of.
    made_of: Option<MadeOf>,
    job: Option<Job>,
    /// Voxels of each recipe, in order, as of the last result.
    pub(crate) counts: Vec<u64>,
}

/// Inputs of the segments: the label volumes of the document that have arrived, and the recipes.
#[derive(Clone, Debug, Default, PartialEq)]
struct MadeOf {
    segments: Vec<SegmentsRef>,
    recipes: Vec<Recipe>,
}

impl MadeOf {
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
    made_of: MadeOf,
    until: Rc<Cell<f64>>,
    time_slices: TimeSlices,
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
        self.made_of = Some(MadeOf::default());
        self.counts.clear();
    }

    /// True while the segments that are shown are not yet those that the document describes.
    pub(crate) fn is_behind(&self, assets: &Assets, illustration: &Illustration) -> bool {
        has_values(assets) && self.made_of.as_ref() != Some(&MadeOf::of(assets, illustration))
    }

    /// How far the work under way is, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.time_slices.progress())
    }

    /// Goes on for its share of a frame. A result is to be shown. `resources` is what has come of the files of the
    /// illustration. `is_dragging`: more changes are about to come; what has begun is then ended first, so that
    /// something is seen on the way.
    pub(crate) fn advance(
        &mut self,
        assets: &Assets,
        resources: &Resources,
        illustration: &Illustration,
        is_dragging: bool,
    ) -> Option<Segmented> {
        if !has_values(assets) {
            return None;
        }
        let made_of = MadeOf::of(assets, illustration);
        if !is_dragging && self.job.as_ref().is_some_and(|job| job.made_of != made_of) {
            self.job = None;
        }
        if self.job.is_none() {
            if self.made_of.as_ref() == Some(&made_of) {
                return None;
            }
            self.job = Some(self.start(resources, made_of));
        }
        let job = self.job.as_mut()?;
        job.until.set((self.clock)() + SHARE);
        let made = poll_once(&mut job.work)?;
        let job = self.job.take()?;
        self.made_of = Some(job.made_of);
        self.counts.clone_from(&made.counts);
        Some(made)
    }

    fn start(&self, resources: &Resources, made_of: MadeOf) -> Job {
        let (clock, until) = (self.clock, Rc::new(Cell::new(0.0)));
        let deadline = Rc::clone(&until);
        let time_slices = TimeSlices::until(move || clock() > deadline.get());
        let recipes = made_of.recipes.clone();
        let work = segment(resources.clone(), recipes, time_slices.clone());
        Job {
            made_of,
            until,
            time_slices,
            work: Box::pin(work),
        }
    }
}
