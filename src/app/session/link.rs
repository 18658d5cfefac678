//! The link to the document: when it is renewed, copied and kept.

use super::clipboard::Copied;
use super::effect::{Effect, SaveFile};
use super::notices::Gravity;
use super::session::{STORED_DOCUMENT, Session, payload_of};
use crate::app::words::{fill, lang, messages, share};
use crate::assets::{Want, Wanted};
use crate::describe::{Snippet, snippet};
use crate::document::SubjectRef;
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
            (Ok(()), Copied::Snippet) => {
                self.notify(Gravity::Success, share::w().on_clipboard, "");
                self.tell_own_file();
            }
            (Ok(()), Copied::Link) => {
                self.copied_at = Some(self.now);
                self.notify(Gravity::Success, w.link_on_clipboard, "");
                if self.is_link_long() {
                    let text = fill(w.link_long, &[&self.payload.len()]);
                    self.notify(Gravity::Warning, text, "");
                }
                self.tell_own_file();
            }
        }
    }

    /// Says so where others cannot open what was copied.
    fn tell_own_file(&mut self) {
        if self.needs_own_file() {
            self.notify(Gravity::Warning, share::w().local, "");
        }
    }

    pub(super) fn toggle_share(&mut self) {
        self.is_share_open = !self.is_share_open;
        if self.is_share_open {
            self.renew_link();
        }
    }

    pub(super) fn copy_snippet(&mut self, form: Snippet) {
        self.clipboard.last = Copied::Snippet;
        self.effect(Effect::CopySnippet(form));
    }

    /// HTML of the illustration as it is seen, for a page; `page` is the address that links open at. Empty where the
    /// document has no such step, which cannot be.
    pub fn snippet(&self, form: Snippet, page: &str) -> String {
        let lang = lang().of_descriptions();
        let html = snippet(&self.document_as_seen(), self.step(), page, form, lang);
        html.unwrap_or_default()
    }

    /// True if the illustration needs a file that a link does not bring to others: one that the reader supplies, or one
    /// of this machine.
    pub fn needs_own_file(&self) -> bool {
        let wanted = Wanted::of(self.illustration()).0;
        let is_own = |want: &Want| want.is_supplied() || want.src().is_some_and(is_local);
        wanted.iter().any(is_own)
    }

    pub(super) fn save_document(&mut self) {
        let file = SaveFile {
            name: format!("{}.json", self.file_stem()),
            mime: "application/json",
            bytes: self.document_as_seen().to_json().into_bytes(),
        };
        self.effect(Effect::Save(file));
    }

    /// True if a clay is shown whole, which can be saved as a mesh.
    pub fn has_mesh_to_save(&self) -> bool {
        matches!(self.shown().subject, SubjectRef::Clay(_)) && self.load.is_none()
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

/// True for an address that begins at the root of a machine, and not of a host: `/home/a.nii`, `C:\a.nii`, `file:…`.
fn is_local(src: &str) -> bool {
    let drive = src.as_bytes().get(1) == Some(&b':');
    let scheme = src.get(..5).unwrap_or_default();
    let is_rooted = src.starts_with('/') && !src.starts_with("//");
    is_rooted || drive || src.starts_with('\\') || scheme.eq_ignore_ascii_case("file:")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_this_machine_are_told_from_addresses() {
        for src in [
            "/home/a.nii",
            "C:\\a.nii",
            "c:/a.nii",
            "file:///a.nii",
            "FILE:/a",
            "\\\\host\\a",
        ] {
            assert!(is_local(src), "{src}");
        }
        for src in [
            "a.nii",
            "scans/a.nii",
            "../a.nii",
            "https://h.example/a.nii",
            "//h.example/a",
            "",
            "é",
        ] {
            assert!(!is_local(src), "{src}");
        }
    }
}
