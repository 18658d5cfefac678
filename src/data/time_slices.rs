//! Long computations that share a thread with the interface.

use std::cell::Cell;
use std::fmt;
use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll};

/// Cooperative time slices for a long computation: between two slices of the volume the computation asks whether its
/// time slice is over and, if so, gives way (its future is pending until it is polled again). Holds the progress too.
#[derive(Clone)]
pub struct TimeSlices {
    is_over: Rc<dyn Fn() -> bool>,
    progress: Rc<Cell<f32>>,
    step: Rc<Cell<Step>>,
    /// What of the step under way is done with these time slices, 0 to 1: from where to where.
    within: [f32; 2],
}

/// The step under way of a computation in several steps.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    /// Progress at its beginning, 0 to 1.
    from: f32,
    /// What it is of the whole, 0 to 1.
    share: f32,
}

impl fmt::Debug for TimeSlices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TimeSlices")
            .field("progress", &self.progress)
            .finish_non_exhaustive()
    }
}

impl TimeSlices {
    /// One time slice without an end: the computation runs through.
    pub fn unlimited() -> Self {
        Self::until(|| false)
    }

    /// Time slices that are over when `is_over` returns true; polled again, the computation goes on.
    pub fn until(is_over: impl Fn() -> bool + 'static) -> Self {
        Self {
            is_over: Rc::new(is_over),
            progress: Rc::default(),
            step: Rc::default(),
            within: [0.0, 1.0],
        }
    }

    /// How far the work is, 0 to 1.
    pub fn progress(&self) -> f32 {
        self.progress.get()
    }

    /// The work is a number of steps of one length each. Without them it has no progress within a step.
    pub(super) fn set_steps(&self, count: usize) {
        let share = 1.0 / count.max(1) as f32;
        self.step.set(Step { share, from: 0.0 });
    }

    /// A step begins: so much of the whole is done, 0 to 1.
    pub(super) fn set_progress(&self, fraction: f32) {
        self.progress.set(fraction);
        let share = self.step.get().share;
        let from = fraction;
        self.step.set(Step { share, from });
    }

    /// For a part of what is done with these: it begins and ends at these fractions of it.
    pub(super) fn part(&self, from: f32, to: f32) -> Self {
        let [start, end] = self.within;
        let place = |part: f32| start + part * (end - start);
        Self {
            within: [place(from), place(to)],
            ..self.clone()
        }
    }

    /// So many of the lines, slices or other pieces are done that the part of the step under way is made of.
    pub(super) fn has_done(&self, count: usize, of: usize) {
        let [start, end] = self.within;
        let part = start + (end - start) * (count as f32 / of.max(1) as f32).min(1.0);
        let step = self.step.get();
        // Rounding must not lead back.
        let progress = (step.from + step.share * part).min(1.0);
        self.progress.set(self.progress.get().max(progress));
    }

    /// Gives way once if the time slice is over.
    pub(super) fn give_way(&self) -> Pass {
        Pass {
            is_due: (self.is_over)(),
        }
    }
}

/// Pending once, or not at all.
pub(super) struct Pass {
    is_due: bool,
}

impl Future for Pass {
    type Output = ();

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<()> {
        if std::mem::take(&mut self.is_due) {
            context.waker().wake_by_ref();
            Poll::Pending
        } else {
            Poll::Ready(())
        }
    }
}
