//! The segments of the subject in the making: what its label volumes bring and what the document's recipes find in its
//! voxels, computed between frames, so that nothing ever waits for it.
//!
//! On the processor and not on the GPU: parts that hang together are found in one pass over the voxels there, which a
//! GPU needs hundreds of rounds for, and the result is the same bit for bit on every device. A thread would need the
//! voxels a second time in the page.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use super::store::Assets;
use crate::data::{
    KnownMasks, Pending, Resources, Segmentation, Segmented, TimeSlices, poll_once, segment_with,
};
use crate::document::{Illustration, Recipe, SegmentsRef};

/// Seconds of each frame that go into it.
const SHARE: f64 = 0.008;

/// The work under way, and what the last result was made of.
pub struct TissueWork {
    clock: fn() -> f64,
    /// What the segments that are shown were made of.
    made_of: Option<MadeOf>,
    job: Option<Job>,
    /// What was not to be found: it is not begun again by itself.
    stopped: Option<MadeOf>,
    /// What the clean-up of recipes left, while one is edited: a stroke does not cost it again.
    known: Option<KnownMasks>,
    /// Voxels of each recipe, in order, as of the last result.
    pub counts: Vec<u64>,
    /// The segments of the last result.
    segmentation: Option<Arc<Segmentation>>,
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
    /// Nothing is under way. `clock` tells seconds since any fixed moment.
    pub fn new(clock: fn() -> f64) -> Self {
        Self {
            clock,
            made_of: None,
            job: None,
            stopped: None,
            known: None,
            counts: Vec::new(),
            segmentation: None,
        }
    }

    /// The segments that are shown: those of the last result, else those that the subject came with.
    pub fn segmentation<'a>(&'a self, assets: &'a Assets) -> Option<&'a Segmentation> {
        let own = || assets.subject()?.values()?.segmentation.as_ref();
        self.segmentation.as_deref().or_else(own)
    }

    /// Another subject is shown, with the segments that it came with.
    pub fn restart(&mut self) {
        (self.job, self.stopped) = (None, None);
        self.known = None;
        self.made_of = Some(MadeOf::default());
        self.counts.clear();
        self.segmentation = None;
    }

    /// True while the segments that are shown are not yet those that the document describes, but will be.
    pub fn is_behind(&self, assets: &Assets, illustration: &Illustration) -> bool {
        if !has_values(assets) {
            return false;
        }
        let wanted = Some(MadeOf::of(assets, illustration));
        self.made_of != wanted && self.stopped != wanted
    }

    /// True if the segments that the document describes are not found because that was stopped.
    pub fn is_stopped(&self, assets: &Assets, illustration: &Illustration) -> bool {
        self.stopped
            .as_ref()
            .is_some_and(|stopped| *stopped == MadeOf::of(assets, illustration))
    }

    /// Stops finding the segments that the document describes; those that are shown stay.
    pub fn stop(&mut self, assets: &Assets, illustration: &Illustration) {
        if self.is_behind(assets, illustration) {
            self.job = None;
            self.stopped = Some(MadeOf::of(assets, illustration));
        }
    }

    /// Goes on after a stop.
    pub fn find(&mut self) {
        self.stopped = None;
    }

    /// The recipes whose tissues are shown.
    pub fn found(&self) -> &[Recipe] {
        self.made_of
            .as_ref()
            .map_or(&[], |made_of| &made_of.recipes)
    }

    /// How far the work under way is, 0 to 1.
    pub fn progress(&self) -> Option<f32> {
        self.job.as_ref().map(|job| job.time_slices.progress())
    }

    /// A recipe is edited, or none is any more.
    pub fn set_edited(&mut self, is_edited: bool) {
        if !is_edited {
            self.known = None;
        } else if self.known.is_none() {
            self.known = Some(KnownMasks::default());
        }
    }

    /// Goes on for its share of a frame. A result is to be shown. `resources` is what has come of the files of the
    /// illustration. `is_dragging`: more changes are about to come; what has begun is then ended first, so that
    /// something is seen on the way.
    pub fn advance(
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
        if self.stopped.as_ref() == Some(&made_of) {
            return None;
        }
        self.stopped = None;
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
        self.segmentation.clone_from(&made.segmentation);
        Some(made)
    }

    fn start(&self, resources: &Resources, made_of: MadeOf) -> Job {
        let (clock, until) = (self.clock, Rc::new(Cell::new(0.0)));
        let deadline = Rc::clone(&until);
        let time_slices = TimeSlices::until(move || clock() > deadline.get());
        let recipes = made_of.recipes.clone();
        let known = self.known.clone();
        let work = segment_with(resources.clone(), recipes, known, time_slices.clone());
        Job {
            made_of,
            until,
            time_slices,
            work: Box::pin(work),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use glam::{DAffine3, UVec3};

    use super::super::store::Data;
    use super::*;
    use crate::data::{Grid, Subject, Volume, Voxels};
    use crate::document::Document;

    /// A second later each time, so that no work is done within its share.
    fn hasty() -> f64 {
        static NOW: AtomicU64 = AtomicU64::new(0);
        NOW.fetch_add(1, Ordering::Relaxed) as f64
    }

    fn illustration(low: f32) -> Illustration {
        let json = format!(
            r#"{{ "fabrica": 1, "subject": {{ "builtin": "cube", "features": [
                {{ "name": "bone", "from": {{ "threshold": [{low}] }} }} ] }} }}"#
        );
        let document = Document::from_json(&json).expect("a valid document");
        document.illustration().clone()
    }

    #[test]
    fn what_was_stopped_waits_until_it_is_wanted() {
        let subject = Subject::from(Volume {
            has_size: true,
            grid: Grid {
                dims: UVec3::splat(4),
                world_from_voxel: DAffine3::IDENTITY,
            },
            voxels: Voxels::U8((0..64).collect()),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 63.0],
            segmentation: None,
        });
        let resources = Resources {
            subject: Some(subject.clone()),
            ..Resources::default()
        };
        let mut assets = Assets::default();
        let sha256 = None;
        assets.give(Data::Subject { subject, sha256 });
        let mut work = TissueWork::new(hasty);
        work.restart();
        let wanted = illustration(60.0);
        let go_on = |work: &mut TissueWork, wanted: &Illustration| {
            work.advance(&assets, &resources, wanted, false).is_some()
        };
        assert!(!go_on(&mut work, &wanted), "it takes its time");
        assert!(work.progress().is_some() && work.is_behind(&assets, &wanted));
        work.stop(&assets, &wanted);
        assert!(work.is_stopped(&assets, &wanted) && !work.is_behind(&assets, &wanted));
        for _ in 0..100 {
            assert!(!go_on(&mut work, &wanted), "it is stopped");
        }
        assert_eq!(work.progress(), None);
        // Other values are another search.
        let other = illustration(50.0);
        assert!((0..100).any(|_| go_on(&mut work, &other)));
        assert_eq!(work.counts, [14]);
        assert!(!work.is_behind(&assets, &other) && !work.is_stopped(&assets, &other));
        assert!(!go_on(&mut work, &wanted));
        work.stop(&assets, &wanted);
        work.find();
        assert!((0..100).any(|_| go_on(&mut work, &wanted)), "it goes on");
        assert_eq!(work.counts, [4]);
    }
}
