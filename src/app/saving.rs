//! Saving a picture: drawn once more for a file while the window goes on, then given to the user.

use std::rc::Rc;

use crate::app::canvas::lettering::Lettering;
use crate::app::canvas::saved::{SavedRows, Saving, file_size};
use crate::app::picture::host::Picture;
use crate::app::services::TextToSet;
use crate::app::session::{Gravity, PicturePaper, SaveFile};
use crate::app::window::App;
use crate::app::words;
use crate::document::Background;

impl App {
    /// Starts making the picture for a file.
    pub(crate) fn start_saving(&mut self, ctx: &egui::Context) {
        let Some(picture) = &mut self.picture else {
            return;
        };
        let mut illustration = self.session.shown_as_seen();
        let shown_px = self.viewport.size_px(ctx.pixels_per_point());
        let is_for_script = std::mem::take(&mut self.wants_shown_size);
        // A script asks for the picture as the window shows it, without lettering.
        let paper = match is_for_script {
            true => PicturePaper::Background,
            false => self.session.picture_paper,
        };
        let has_shadow = matches!(paper, PicturePaper::Shadow | PicturePaper::ClearShadow);
        if matches!(paper, PicturePaper::Clear | PicturePaper::ClearShadow) {
            illustration.look.background = Background::None;
        }
        let size_px = if is_for_script {
            shown_px
        } else {
            let (camera, longer_px) = (&illustration.camera, self.session.picture_px);
            file_size(shown_px, camera, picture.bounds(), longer_px)
        };
        let lettering = (!is_for_script).then(|| {
            let set = |text: &TextToSet| self.services.set_text(text);
            let mut lettering = Lettering::new(&illustration, size_px);
            let mm_per_unit = self.session.view.known_mm_per_unit();
            lettering.mark(ctx, &illustration, mm_per_unit);
            if self.session.is_lettering {
                let places = self.viewport.caption_places();
                lettering.letter((ctx, &set), &illustration, &places);
            }
            lettering
        });
        let dpi = (!is_for_script).then_some(self.session.picture_dpi as f32);
        let progress = Rc::default();
        let rows = SavedRows::new(size_px, dpi, lettering, Rc::clone(&progress));
        let size_and_shadow = (size_px, has_shadow);
        picture.start_file(
            &illustration,
            size_and_shadow,
            (rows, progress),
            SavedRows::finish,
        );
        self.saving = Some(Saving {
            name: format!("{}.png", self.session.file_stem()),
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
    pub(crate) fn advance_saving(&mut self) {
        let bytes = self.picture.as_mut().and_then(Picture::poll_file);
        if let Some(bytes) = bytes
            && let Some(saving) = self.saving.take()
        {
            match bytes {
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
