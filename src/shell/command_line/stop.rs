//! Stopping from outside: by Ctrl+C, or a signal that asks a program to end.

use std::sync::atomic::{AtomicBool, Ordering};

static IS_WISHED: AtomicBool = AtomicBool::new(false);

/// From now on such a signal does not end the program, but [`is_wished`] tells of it.
pub(super) fn watch() {
    // Where it cannot be watched, the signal ends the program as ever.
    let _unwatched = ctrlc::set_handler(|| IS_WISHED.store(true, Ordering::Relaxed));
}

/// Somebody wishes the program to end.
pub(super) fn is_wished() -> bool {
    IS_WISHED.load(Ordering::Relaxed)
}
