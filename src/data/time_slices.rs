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
        }
    }

    /// How far the work is, 0 to 1.
    pub fn progress(&self) -> f32 {
        self.progress.get()
    }

    pub(super) fn set_progress(&self, fraction: f32) {
        self.progress.set(fraction);
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
