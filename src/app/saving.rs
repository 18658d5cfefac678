//! Saving a picture: drawn once more for a file while the window goes on, then given to the user.

use crate::app::canvas::saved::{Saving, file_size};
use crate::app::picture::host::Picture;
use crate::app::services::TextToSet;
use crate::app::session::{Gravity, SaveFile};
use crate::app::window::App;
use crate::app::words;

impl App {
    /// Starts making the picture for a file.
    pub(crate) fn start_saving(&mut self, pixels_per_point: f32) {
        let Some(picture) = &mut self.picture else {
            return;
        };
        let illustration = self.session.shown_as_seen();
        let shown_px = self.viewport.size_px(pixels_per_point);
        let is_for_script = std::mem::take(&mut self.wants_shown_size);
        // A script asks for the picture as the window shows it, without lettering.
        let size_px = if is_for_script {
            shown_px
        } else {
            let (camera, longer_px) = (&illustration.camera, self.session.picture_px);
            file_size(shown_px, camera, picture.bounds(), longer_px)
        };
        picture.start_file(&illustration, size_px);
        let is_lettered = self.session.is_lettering && !is_for_script;
        self.saving = Some(Saving {
            illustration,
            name: format!("{}.png", self.session.file_stem()),
            captions: is_lettered.then(|| self.viewport.caption_places()),
            mm_per_unit: self.session.view.known_mm_per_unit(),
            is_for_script,
        });
    }

    /// Stops making the picture for a file, unless a script waits for it.
    pub(crate) fn stop_saving(&mut self) {
        if self
            .saving
            .take_if(|saving| !saving.is_for_script)
            .is_some()
        {
            self.picture.iter_mut().for_each(Picture::stop_file);
            let text = words::messages::w().saving_stopped;
            self.session.notify(Gravity::Info, text, "");
        }
    }

    /// Hands the picture for a file over once it is drawn, and shows until then how far it is.
    pub(crate) fn advance_saving(&mut self, ctx: &egui::Context) {
        let image = self.picture.as_mut().and_then(Picture::poll_file);
        if let Some(image) = image
            && let Some(saving) = self.saving.take()
        {
            let set = |text: &TextToSet| self.services.set_text(text);
            match image.and_then(|image| saving.encoded((ctx, &set), image)) {
                Ok(bytes) => self.services.save_file(SaveFile {
                    name: saving.name,
                    mime: "image/png",
                    bytes,
                }),
                Err(error) => {
                    let text = words::messages::w().picture_failed;
                    self.session.notify(Gravity::Error, text, error.to_string());
                }
            }
        }
        let progress = self.picture.as_ref().and_then(Picture::file_progress);
        let is_seen = |saving: &Saving| !saving.is_for_script;
        self.session.saving = progress.filter(|_| self.saving.as_ref().is_some_and(is_seen));
    }
}
