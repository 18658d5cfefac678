//! Subjects on their way to the GPU. The one file here that tells kinds apart: each of them has files of its own, and
//! becomes [`SubjectTextures`].

use super::mesh::MeshUpload;
use super::plate::PlateTexture;
use super::reduce::reduced_to_fit;
use super::textures::{MeshTextures, SubjectTextures};
use super::volume;
use super::volume_upload::VolumeUpload;
use crate::data::{Reduction, Segmentation, Subject};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use std::sync::Arc;

/// A subject on its way to the GPU, piece by piece.
#[derive(Debug)]
pub(crate) enum Upload {
    Volume(Box<VolumeUpload>),
    Mesh(Box<MeshUpload>),
    /// A plate is handed over at once.
    Figure(Box<PlateTexture>),
}

/// The subject as the device takes it: made coarser where it is too large, with the notice that says so.
///
/// # Errors
/// [`RenderError::TooLarge`].
pub(crate) fn fitting(
    gpu: &Gpu,
    subject: &Subject,
) -> Result<(Subject, Option<Reduction>), RenderError> {
    match subject {
        Subject::Space(space) => Ok(match reduced_to_fit(gpu, &space.volume)? {
            Some((small, reduction)) => {
                let small = Subject::from(small).with_meshes(space.meshes.clone());
                (small, Some(reduction))
            }
            None => (subject.clone(), None),
        }),
        Subject::Mesh(_) | Subject::Figure(_) => Ok((subject.clone(), None)),
    }
}

/// A subject with other segments than it came with, or other meshes beside its volume. The values of `subject` are
/// those that were uploaded as `textures`.
///
/// # Errors
/// [`RenderError::TooLarge`] if the device does not take the segments or the meshes.
pub(crate) fn with_segmentation(
    textures: &SubjectTextures,
    gpu: &Gpu,
    layouts: &Layouts,
    subject: &Subject,
    segmentation: Option<&Segmentation>,
) -> Result<SubjectTextures, RenderError> {
    match subject {
        Subject::Space(space) => {
            let is_there = |there: &&Arc<MeshTextures>| {
                let meshes = space.meshes.as_ref();
                meshes.is_some_and(|meshes| Arc::ptr_eq(meshes, &there.surface))
            };
            let meshes = match (textures.meshes.as_ref().filter(is_there), &space.meshes) {
                (Some(there), _) => Some(Arc::clone(there)),
                (None, Some(meshes)) => Some(Arc::new(MeshTextures::new(gpu, meshes)?)),
                (None, None) => None,
            };
            volume::with_labels(textures, gpu, layouts, &space.volume, segmentation, meshes)
        }
        // The segments of a mesh are its parts.
        Subject::Mesh(surface) => Ok(MeshTextures::new(gpu, surface)?.alone(gpu, layouts)),
        Subject::Figure(plate) => Ok(PlateTexture::new(gpu, plate)?.alone(gpu, layouts)),
    }
}

impl Upload {
    /// Makes the textures. The subject must fit (see [`fitting`]) and be whole.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if it is not whole.
    pub(crate) fn new(gpu: &Gpu, subject: &Subject) -> Result<Self, RenderError> {
        match subject {
            Subject::Space(space) => Ok(Self::Volume(Box::new(VolumeUpload::new(
                gpu,
                &space.volume,
                space.meshes.as_ref(),
            )?))),
            Subject::Mesh(surface) => Ok(Self::Mesh(Box::new(MeshUpload::new(gpu, surface)?))),
            Subject::Figure(plate) => Ok(Self::Figure(Box::new(PlateTexture::new(gpu, plate)?))),
        }
    }

    /// Fraction done, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        match self {
            Self::Volume(upload) => upload.progress(),
            Self::Mesh(upload) => upload.progress(),
            Self::Figure(_) => 1.0,
        }
    }

    /// Converts and hands over the next piece. True when all is handed over.
    pub(crate) fn advance(&mut self, gpu: &Gpu) -> bool {
        match self {
            Self::Volume(upload) => upload.advance(gpu),
            Self::Mesh(upload) => upload.advance(gpu),
            Self::Figure(_) => true,
        }
    }

    /// The subject, once [`Upload::advance`] said that all is handed over.
    pub(crate) fn finish(self, gpu: &Gpu, layouts: &Layouts) -> SubjectTextures {
        match self {
            Self::Volume(upload) => upload.finish(gpu, layouts),
            Self::Mesh(upload) => upload.finish().alone(gpu, layouts),
            Self::Figure(plate) => plate.alone(gpu, layouts),
        }
    }
}
