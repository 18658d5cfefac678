//! What the picture still waits for before it shows what the document describes.

use crate::app::picture::host::Picture;
use crate::app::session::LoadOf;
use crate::app::window::App;
use crate::app::words::picture::w;
use crate::assets::Role;

/// Seconds for which the picture waits without a word.
const PATIENCE: f64 = 0.3;

impl App {
    /// Why the picture is not yet what the document describes, in words; `None` when it is. What is over at once is not
    /// told.
    pub(crate) fn provisional(&mut self, ctx: &egui::Context) -> Option<&'static str> {
        let Some(text) = self.reason() else {
            self.provisional_since = None;
            return None;
        };
        let now = self.session.now;
        let since = *self.provisional_since.get_or_insert(now);
        let rest = since + PATIENCE - now;
        if rest > 0.0 {
            ctx.request_repaint_after(std::time::Duration::from_secs_f64(rest));
        }
        (rest <= 0.0).then_some(text)
    }

    fn reason(&mut self) -> Option<&'static str> {
        let uploading = |picture: &Picture| picture.state.uploading.is_some();
        self.is_other_uploading &= self.picture.as_ref().is_some_and(uploading);
        let w = w();
        if self.shows_earlier_object() {
            let is_coming = self.session.load.is_some() || self.is_other_uploading;
            return Some(if is_coming {
                w.earlier_object
            } else {
                w.object_missing
            });
        }
        if self.session.awaits_clay() {
            return Some(w.shaping);
        }
        let load = self.session.load.as_ref();
        if load.is_some_and(|load| load.is_coarse) {
            return Some(w.coarse);
        }
        if let Some(LoadOf::Beside(want)) = load.map(|load| &load.of) {
            return Some(match want.role {
                Role::Object => w.object_coming,
                Role::Mesh => w.mesh_coming,
                Role::Tool => w.tool_coming,
                _ => w.segments_coming,
            });
        }
        let shown = self.session.shown();
        let is_field = self.services.is_reading()
            && self
                .assets
                .missing(shown)
                .iter()
                .any(|want| want.role == Role::Field && self.fields_asked.contains(want));
        if is_field {
            return Some(w.field_coming);
        }
        let is_behind = self.tissue.is_behind(&self.assets, shown);
        is_behind.then_some(w.tissues_coming)
    }

    /// True while the picture shows an object that is not the document's.
    pub(crate) fn shows_earlier_object(&self) -> bool {
        self.is_other_uploading || self.session.shows_earlier_object()
    }
}
