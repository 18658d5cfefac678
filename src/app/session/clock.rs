//! What goes with the clock.

use super::link::LINK_DELAY;
use super::notices::Gravity;
use super::session::Session;
use crate::app::words::messages;

/// Seconds for which the button of the link says “Copied”.
const COPIED_SECONDS: f64 = 2.0;

impl Session {
    /// Goes on to a time, seconds on the clock of the interface: glides the camera, goes on with a passage, puts old
    /// messages away, renews the link. True if it wants to be called again at once.
    pub fn advance(&mut self, now: f64) -> bool {
        self.now = now;
        self.notices.expire(now);
        self.advance_tissues();
        self.tell_unshaped();
        if self.copied_at.is_some_and(|at| now - at > COPIED_SECONDS) {
            self.copied_at = None;
        }
        if self
            .link_stale_since
            .is_some_and(|since| now - since >= LINK_DELAY)
        {
            self.renew_link();
        }
        let is_walking = self.mode.is_moving();
        if is_walking {
            if let Some(camera) = self.mode.advance(self.history.document(), now) {
                self.camera = camera;
            }
            self.revision += 1;
        }
        let is_going_on = self.advance_playing();
        self.advance_glide() || is_walking || is_going_on
    }

    /// Says which captions the program cannot set, when there are more of them than before.
    fn tell_unshaped(&mut self) {
        if self.has_shaped_texts {
            return;
        }
        let found: Vec<String> = self
            .illustration()
            .unshaped_captions()
            .map(|(_, text)| text.to_owned())
            .collect();
        if found.len() > self.unshaped {
            self.notify(Gravity::Warning, messages::w().unshaped, found.join("\n"));
        }
        self.unshaped = found.len();
    }

    /// Seconds until [`Self::advance`] has something to do although nothing else happens.
    pub fn seconds_to_next_change(&self) -> Option<f64> {
        let link = self
            .link_stale_since
            .map(|since| since + LINK_DELAY - self.now);
        let copied = self.copied_at.map(|at| at + COPIED_SECONDS - self.now);
        let glimpse = self.seconds_of_glimpse();
        [
            self.seconds_to_next_step(),
            link,
            copied,
            glimpse,
            self.notices.seconds_to_expiry(self.now),
        ]
        .into_iter()
        .flatten()
        .map(|seconds| seconds.max(0.0) + 0.01)
        .min_by(f64::total_cmp)
    }
}
