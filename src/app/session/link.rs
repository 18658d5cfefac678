//! The link to the document: when it is renewed, copied and kept.

use super::clipboard::Copied;
use super::effect::{Effect, SaveFile};
use super::notices::Gravity;
use super::session::{STORED_DOCUMENT, Session, payload_of};
use crate::app::words::{fill, messages};
use crate::link::ADVISED_LENGTH;

/// Seconds of rest before the link in the address bar is renewed.
pub(super) const LINK_DELAY: f64 = 0.35;

impl Session {
    /// What stands behind the `#` of the link: the payload, and the step that is shown.
    pub fn link_tail(&self) -> String {
        match self.step() {
            0 => self.payload.clone(),
            step => format!("{}&step={step}", self.payload),
        }
    }

    /// True if the link is better passed on as a file.
    pub fn is_link_long(&self) -> bool {
        self.payload.len() > ADVISED_LENGTH
    }

    pub(super) fn renew_link(&mut self) {
        self.link_stale_since = None;
        let camera = match self.step() {
            0 => self.glide.map_or(self.camera, |glide| glide.to),
            _ => self.illustration().camera,
        };
        self.payload = payload_of(self.document(), &camera);
        let tail = self.link_tail();
        self.effect(Effect::SetLink(tail.clone(), self.link_change));
        self.store(STORED_DOCUMENT, tail);
    }

    pub(super) fn copy_link(&mut self) {
        self.clipboard.last = Copied::Link;
        // The last of the hint's three steps.
        self.put_hint_away();
        self.renew_link();
        self.effect(Effect::CopyLink(self.link_tail()));
    }

    /// Tells the user that the clipboard took the copy, or refused it.
    pub fn copied(&mut self, outcome: Result<(), String>) {
        let w = messages::w();
        match (outcome, self.clipboard.last) {
            (Err(error), _) => self.notify(Gravity::Error, w.clipboard_refused, error),
            (Ok(()), Copied::Templates(number)) => {
                let text = fill(crate::app::words::authoring::w().on_clipboard, &[&number]);
                self.notify(Gravity::Success, text, "");
            }
            (Ok(()), Copied::Link) => {
                self.copied_at = Some(self.now);
                self.notify(Gravity::Success, w.link_on_clipboard, "");
                if self.is_link_long() {
                    let text = fill(w.link_long, &[&self.payload.len()]);
                    self.notify(Gravity::Warning, text, "");
                }
            }
        }
    }

    pub(super) fn save_document(&mut self) {
        let file = SaveFile {
            name: format!("{}.json", self.file_stem()),
            mime: "application/json",
            bytes: self.document_as_seen().to_json().into_bytes(),
        };
        self.effect(Effect::Save(file));
    }

    /// File name without an ending, out of the title.
    pub fn file_stem(&self) -> String {
        let title = &self.illustration().title;
        let mut stem: String = title
            .chars()
            .map(|c| {
                if c.is_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '-'
                }
            })
            .take(60)
            .collect();
        while stem.contains("--") {
            stem = stem.replace("--", "-");
        }
        match stem.trim_matches('-') {
            "" => "fabrica".to_owned(),
            stem => stem.to_owned(),
        }
    }
}
