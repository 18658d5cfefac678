//! Holds a mesh file back until the reader has said what it is to be.

use crate::app::window::App;
use crate::data::{SubjectBuilder, SubjectPart, SubjectSink as _};

impl App {
    /// Holds the mesh of a load that is done back and asks what it is to be. False if the load is to go on.
    pub(crate) fn holds_back(&mut self, sha256: &str) -> bool {
        let Some(surface) = self.incoming.surface().cloned() else {
            return false;
        };
        if !self.session.ask_about_mesh(sha256, surface.frame) {
            return false;
        }
        self.incoming = SubjectBuilder::default();
        self.held_mesh = Some(surface);
        true
    }

    /// The mesh that was held back becomes the subject: its load ends as it would have ended.
    pub(crate) fn show_held_mesh(&mut self, sha256: String) {
        let Some(surface) = self.held_mesh.take() else {
            return self.session.load_ended();
        };
        if self.incoming.take(SubjectPart::Surface(surface)).is_ok() {
            self.end_load(Some(sha256));
        }
    }
}
