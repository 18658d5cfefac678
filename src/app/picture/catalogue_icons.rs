//! The catalogue's pictures, drawn by the program's own renderer on its own cube: once, one after the other, while
//! nothing else is to be drawn.

use egui::{ColorImage, TextureHandle, TextureOptions};

use super::host::Picture;
use super::pending::{Pending, poll_once};
use crate::data::{Subject, VolumeBuilder};
use crate::document::{Background, Document, Illustration, TemplateKind};
use crate::render::{Image, RenderError, Studio};

/// Pixels of an icon's side: twice its size in points.
const SIDE_PX: u32 = 112;
/// Samples per pixel.
const SAMPLES: u32 = 4;
/// Voxels along the cube.
const RESOLUTION: u32 = 48;

/// Icons as far as they are drawn. Built once per window.
#[derive(Default)]
pub(crate) struct CatalogueIcons {
    studio: Option<Studio>,
    textures: Vec<(TemplateKind, TextureHandle)>,
    pending: Option<(TemplateKind, Pending<Result<Image, RenderError>>)>,
    has_failed: bool,
}

impl CatalogueIcons {
    /// Texture of a kind's icon, once it is drawn.
    pub(crate) fn texture(&self, kind: TemplateKind) -> Option<egui::TextureId> {
        self.textures
            .iter()
            .find(|(drawn, _)| *drawn == kind)
            .map(|(_, texture)| texture.id())
    }

    /// Drops what lies on a lost device; the icons that are drawn stay.
    pub(crate) fn device_lost(&mut self) {
        self.studio = None;
        self.pending = None;
    }

    /// Goes one step on with the icons of these kinds. Called once per frame while there is time. True if it waits
    /// for the GPU.
    pub(crate) fn advance(
        &mut self,
        ctx: &egui::Context,
        picture: &Picture,
        mut kinds: impl Iterator<Item = TemplateKind>,
    ) -> bool {
        if self.has_failed {
            return false;
        }
        if let Some((kind, pending)) = &mut self.pending {
            let kind = *kind;
            match poll_once(pending) {
                None => return true,
                Some(Ok(image)) => {
                    let size = image.size.map(|side| side as usize);
                    let pixels = ColorImage::from_rgba_unmultiplied(size, &image.rgba);
                    let name = format!("icon {}", kind.spec().name);
                    self.textures
                        .push((kind, ctx.load_texture(name, pixels, TextureOptions::LINEAR)));
                    self.pending = None;
                }
                Some(Err(_)) => {
                    // The outlines stay: an icon is no reason to bother anyone.
                    self.has_failed = true;
                    self.pending = None;
                    return false;
                }
            }
        }
        let next = kinds.find(|kind| self.texture(*kind).is_none());
        let Some(kind) = next else {
            self.studio = None;
            return false;
        };
        if self.studio.is_none() {
            self.studio = cube_studio(picture);
            self.has_failed = self.studio.is_none();
        }
        if let Some(studio) = &self.studio {
            let future = studio.render_image(&icon_illustration(kind), [SIDE_PX, SIDE_PX], SAMPLES);
            self.pending = Some((kind, Box::pin(future)));
        }
        true
    }
}

/// The cube on the device.
fn cube_studio(picture: &Picture) -> Option<Studio> {
    let mut cube = VolumeBuilder::new();
    crate::subjects::generate_cube(RESOLUTION, &mut cube).ok()?;
    let cube = Subject::from(cube.finish().ok()?);
    Studio::new(picture.gpu(), &cube, true).ok()
}

/// The cube with one template, without anything behind it.
fn icon_illustration(kind: TemplateKind) -> Illustration {
    let (template, camera) = crate::placed::icon(kind);
    let mut illustration = Document::new().illustration().clone();
    illustration.templates = vec![template];
    illustration.camera = camera;
    illustration.look.background = Background::None;
    illustration
}
