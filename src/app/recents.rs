//! Pictures of recent documents: the picture that is shown is read back once it has been at rest for a while, made
//! small, and kept with the document when that makes room for another.

use std::time::Duration;

use crate::app::picture::host::Picture;
use crate::app::picture::small::small_png;
use crate::app::session::{
    RecentChange, STORED_PICTURE, STORED_RECENT, STORED_RECENT_PICTURES, SmallPicture,
    changed_pictures, changed_recent, picture_of,
};
use crate::app::window::App;

/// Seconds at rest after which the picture is read back: not while somebody works.
const REST_SECONDS: f64 = 2.0;

impl App {
    /// Changes the list of documents that were open before, and their pictures.
    pub(crate) fn change_recent(&mut self, change: &RecentChange) {
        let services = self.services.as_mut();
        let kept = services.stored(STORED_RECENT).unwrap_or_default();
        let list = changed_recent(&kept, change);
        if list != kept {
            services.store(STORED_RECENT, &list);
        }
        let kept = services.stored(STORED_RECENT_PICTURES).unwrap_or_default();
        let pictures = changed_pictures(&kept, &list, change, self.open_picture.small.as_ref());
        if pictures != kept {
            services.store(STORED_RECENT_PICTURES, &pictures);
        }
        if matches!(change, RecentChange::Add(_)) {
            // It went with its document.
            self.open_picture.small = None;
        }
        if self.session.library.is_open {
            self.session
                .library
                .take_recent(&list, |tail| picture_of(&pictures, tail));
        }
    }

    /// Reads the picture back once it has been at rest for a while, unless that was done.
    pub(crate) fn advance_open_picture(&mut self, ctx: &egui::Context) {
        let now = self.session.now;
        let of = (
            self.session.opened,
            self.session.revision,
            self.session.payload.clone(),
        );
        let open = &mut self.open_picture;
        if open.of.as_ref().is_some_and(|before| before.0 != of.0) {
            // Another document: the picture went with the one that it was of.
            open.small = None;
        }
        if open.of.as_ref() != Some(&of) {
            (open.of, open.since) = (Some(of.clone()), Some(now));
            self.picture.iter_mut().for_each(Picture::stop_reading);
        }
        let is_reading = self.picture.as_ref().is_some_and(Picture::is_reading);
        if is_reading {
            ctx.request_repaint();
            let read = self.picture.as_mut().and_then(Picture::poll_reading);
            // A picture that cannot be had leaves a plain tile.
            if let Some(Ok(image)) = read
                && let Some(png) = small_png(&image)
            {
                let small = SmallPicture::new(&of.2, &png);
                self.services.store(STORED_PICTURE, &small.to_text());
                self.open_picture.small = Some(small);
            }
            return;
        }
        let Some(since) = self.open_picture.since else {
            return;
        };
        let tissues = &self.session.tissues;
        let is_whole = self.is_at_rest() && !self.shows_earlier_object();
        let is_whole = is_whole && tissues.alone.is_none() && tissues.glimpse.is_none();
        if !is_whole {
            self.open_picture.since = Some(now);
            return;
        }
        let rest = since + REST_SECONDS - now;
        if rest > 0.0 {
            ctx.request_repaint_after(Duration::from_secs_f64(rest + 0.01));
        } else if let Some(picture) = &mut self.picture {
            self.open_picture.since = None;
            picture.start_reading();
            ctx.request_repaint();
        }
    }
}
