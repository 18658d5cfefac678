use std::sync::Arc;

use super::frame::SubjectFrame;
use super::volume::{Segment, Segmentation, Volume};

/// What is illustrated. Cheap to clone.
///
/// Code that draws, measures or lists a subject asks the methods here and never for the kind: a subject without values
/// or without segments answers that it has none. Only code that makes a subject or brings one to the GPU matches on the
/// kind. This is an enum although it has one variant: flat figures will be the second, and the compiler then lists the
/// matches that need another line.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// Lies in space.
    Space(Space),
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
        }
    }

    /// Named parts that the subject came with, in the order of its file; none if it has no parts.
    pub fn segments(&self) -> &[Segment] {
        match self {
            Self::Space(space) => match &space.volume.segmentation {
                Some(segmentation) => &segmentation.segments,
                None => &[],
            },
        }
    }

    /// Scalars on a grid, which windows, transfer functions, thresholds and recipes are about; `None` if the subject
    /// has none.
    pub fn values(&self) -> Option<&Arc<Volume>> {
        match self {
            Self::Space(space) => Some(&space.volume),
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
        }
    }

    /// True if both are one thing in memory, and not merely alike: nothing is compared voxel by voxel.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Space(a), Self::Space(b)) => Arc::ptr_eq(&a.volume, &b.volume),
        }
    }
}

impl From<Arc<Volume>> for Subject {
    fn from(volume: Arc<Volume>) -> Self {
        Self::Space(Space { volume })
    }
}

impl From<Volume> for Subject {
    fn from(volume: Volume) -> Self {
        Self::from(Arc::new(volume))
    }
}
