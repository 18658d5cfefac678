use std::sync::Arc;

use super::frame::SubjectFrame;
use super::surface::Surface;
use super::volume::{Segment, Segmentation, Volume};

/// What is illustrated. Cheap to clone.
///
/// Code that draws, measures or lists a subject asks the methods here and never for the kind: a subject without values
/// or without segments answers that it has none. Only code that makes a subject or brings one to the GPU matches on the
/// kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// Lies in space.
    Space(Space),
    /// A mesh alone.
    Mesh(Arc<Surface>),
}

/// A subject in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// The scalars and segments of a scan or of a built-in subject.
    pub volume: Arc<Volume>,
}

impl Subject {
    /// Where the subject lies and how fine it is.
    pub fn frame(&self) -> SubjectFrame {
        match self {
            Self::Space(space) => space.volume.grid.frame(),
            Self::Mesh(surface) => surface.frame,
        }
    }

    /// Millimetres in one subject unit, if its file says how large it is.
    pub fn mm_per_unit(&self) -> Option<f64> {
        match self {
            Self::Space(space) => {
                let volume = &space.volume;
                volume.has_size.then(|| volume.grid.mm_per_unit())
            }
            Self::Mesh(surface) => Some(surface.frame.mm_per_unit),
        }
    }

    /// Named parts that the subject came with, in the order of its file; none if it has no parts.
    pub fn segments(&self) -> &[Segment] {
        self.segmentation()
            .map_or(&[], |segmentation| &segmentation.segments)
    }

    /// Which of its parts are where; `None` if it has no parts.
    pub fn segmentation(&self) -> Option<&Segmentation> {
        match self {
            Self::Space(space) => space.volume.segmentation.as_ref(),
            Self::Mesh(surface) => Some(&surface.segmentation),
        }
    }

    /// Scalars on a grid, which windows, transfer functions, thresholds and recipes are about; `None` if the subject
    /// has none.
    pub fn values(&self) -> Option<&Arc<Volume>> {
        match self {
            Self::Space(space) => Some(&space.volume),
            Self::Mesh(_) => None,
        }
    }

    /// The same subject with other segments over its values; as it is where it has no values. Copies the values if
    /// somebody else holds them too.
    pub fn with_segmentation(self, segmentation: Option<Segmentation>) -> Self {
        match self {
            Self::Space(mut space) => {
                Arc::make_mut(&mut space.volume).segmentation = segmentation;
                Self::Space(space)
            }
            mesh @ Self::Mesh(_) => mesh,
        }
    }

    /// The same subject by the author's name for it, which the segment of a mesh with one part takes; without a name it
    /// stays as it is.
    pub fn called(self, name: &str) -> Self {
        match self {
            Self::Mesh(mut surface) if !name.is_empty() && surface.segments.len() == 1 => {
                Arc::make_mut(&mut surface).name_only_segment(name);
                Self::Mesh(surface)
            }
            subject => subject,
        }
    }

    /// True if both are one thing in memory, and not merely alike: nothing is compared voxel by voxel.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Space(a), Self::Space(b)) => Arc::ptr_eq(&a.volume, &b.volume),
            (Self::Mesh(a), Self::Mesh(b)) => Arc::ptr_eq(a, b),
            (Self::Space(_), Self::Mesh(_)) | (Self::Mesh(_), Self::Space(_)) => false,
        }
    }
}

impl From<Arc<Volume>> for Subject {
    fn from(volume: Arc<Volume>) -> Self {
        Self::Space(Space { volume })
    }
}

impl From<Arc<Surface>> for Subject {
    fn from(surface: Arc<Surface>) -> Self {
        Self::Mesh(surface)
    }
}

impl From<Volume> for Subject {
    fn from(volume: Volume) -> Self {
        Self::from(Arc::new(volume))
    }
}
