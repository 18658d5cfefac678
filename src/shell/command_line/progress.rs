//! How far a long work is, on standard error.

use std::io::{self, IsTerminal as _, Write as _};

use super::output::notice;
use crate::render::system_clock;

/// Seconds until something is told, and between one time and the next: on a terminal, and in a file, where each is a
/// line.
const ON_TERMINAL: f64 = 1.0;
const IN_FILE: f64 = 15.0;

/// Tells how far a work is, if it takes long. What stands on a terminal goes away with it.
pub(super) struct Progress {
    told: f64,
    has_told: bool,
    is_on_terminal: bool,
    /// What is done to the work.
    done: &'static str,
}

impl Progress {
    pub(super) fn start() -> Self {
        Self::of("drawn")
    }

    /// Of a work that is not drawing.
    pub(super) fn of(done: &'static str) -> Self {
        Self {
            done,
            told: system_clock(),
            has_told: false,
            is_on_terminal: io::stderr().is_terminal(),
        }
    }

    /// `part` of the work is done, 0 to 1.
    pub(super) fn tell(&mut self, part: f32) {
        let wait = if self.is_on_terminal {
            ON_TERMINAL
        } else {
            IN_FILE
        };
        let now = system_clock();
        if now - self.told < wait {
            return;
        }
        self.told = now;
        self.has_told = true;
        let percent = (100.0 * part).floor();
        if self.is_on_terminal {
            self.write(&format!("\r{percent} % {}", self.done));
        } else {
            notice(format!("{percent} % {}", self.done));
        }
    }

    fn write(&self, text: &str) {
        let mut out = io::stderr().lock();
        // A terminal that is gone shows nothing.
        let _unseen = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.has_told && self.is_on_terminal {
            self.write("\r\x1b[K");
        }
    }
}
