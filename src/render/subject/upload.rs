//! Subjects on their way to the GPU. The one file here that tells kinds apart: each of them has files of its own, and
//! becomes [`SubjectTextures`].

use super::mesh::MeshUpload;
use super::reduce::reduced_to_fit;
use super::textures::SubjectTextures;
use super::volume;
use super::volume_upload::VolumeUpload;
use crate::data::{Reduction, Segmentation, Subject};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;

/// A subject on its way to the GPU, piece by piece.
#[derive(Debug)]
pub(crate) enum Upload {
    Volume(Box<VolumeUpload>),
    Mesh(Box<MeshUpload>),
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
            Some((small, reduction)) => (Subject::from(small), Some(reduction)),
            None => (subject.clone(), None),
        }),
        Subject::Mesh(_) => Ok((subject.clone(), None)),
    }
}

/// A subject with other segments than it came with. `subject` is the one that was uploaded as `textures`.
///
/// # Errors
/// [`RenderError::TooLarge`] if the device does not take the segments.
pub(crate) fn with_segmentation(
    textures: &SubjectTextures,
    gpu: &Gpu,
    layouts: &Layouts,
    subject: &Subject,
    segmentation: Option<&Segmentation>,
) -> Result<SubjectTextures, RenderError> {
    match subject {
        Subject::Space(space) => {
            volume::with_labels(textures, gpu, layouts, &space.volume, segmentation)
        }
        // The segments of a mesh are its parts.
        Subject::Mesh(surface) => {
            let mut upload = MeshUpload::new(gpu, surface)?;
            while !upload.advance(gpu) {}
            Ok(upload.finish(gpu, layouts))
        }
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
            )?))),
            Subject::Mesh(surface) => Ok(Self::Mesh(Box::new(MeshUpload::new(gpu, surface)?))),
        }
    }

    /// Fraction done, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        match self {
            Self::Volume(upload) => upload.progress(),
            Self::Mesh(upload) => upload.progress(),
        }
    }

    /// Converts and hands over the next piece. True when all is handed over.
    pub(crate) fn advance(&mut self, gpu: &Gpu) -> bool {
        match self {
            Self::Volume(upload) => upload.advance(gpu),
            Self::Mesh(upload) => upload.advance(gpu),
        }
    }

    /// The subject, once [`Upload::advance`] said that all is handed over.
    pub(crate) fn finish(self, gpu: &Gpu, layouts: &Layouts) -> SubjectTextures {
        match self {
            Self::Volume(upload) => upload.finish(gpu, layouts),
            Self::Mesh(upload) => upload.finish(gpu, layouts),
        }
    }
}
