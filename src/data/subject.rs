use std::sync::Arc;

use super::frame::SubjectFrame;
use super::plate::Plate;
use super::surface::{DistanceGrid, Surface, SurfaceSegment};
use super::volume::{Segment, Segmentation, Volume};

/// Label of the first segment of meshes beside a volume, whose own labels are below.
pub const FIRST_MESH_LABEL: u16 = 256;

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
    /// The picture of a figure. How it is divided and bent stands in the document.
    Figure(Arc<Plate>),
}

/// A subject in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// The scalars and segments of a scan or of a built-in subject.
    pub volume: Arc<Volume>,
    /// Meshes beside it: they move with the volume, and lie in its subject space.
    pub meshes: Option<Arc<Surface>>,
    /// Segments of the volume, and behind them those of the meshes.
    segments: Arc<Vec<Segment>>,
}

impl Space {
    fn new(volume: Arc<Volume>, meshes: Option<Arc<Surface>>) -> Self {
        let own = volume.segmentation.as_ref();
        let own = own.map_or(&[][..], |segmentation| &segmentation.segments);
        let segments = Arc::new(match &meshes {
            Some(surface) => with_mesh_segments(own, surface),
            None => own.to_vec(),
        });
        Self {
            volume,
            meshes,
            segments,
        }
    }
}

/// The segments of a volume, and behind them those of the meshes beside it, from [`FIRST_MESH_LABEL`] on. A name that
/// is taken gets a number.
pub fn with_mesh_segments(own: &[Segment], meshes: &Surface) -> Vec<Segment> {
    let mut all = own.to_vec();
    for (segment, label) in meshes.segments.iter().zip(FIRST_MESH_LABEL..) {
        let numbered = (2..).map(|number| format!("{} {number}", segment.name));
        let mut names = std::iter::once(segment.name.clone()).chain(numbered);
        let is_free = |name: &String| all.iter().all(|other| other.name != *name);
        // There is always another number.
        let name = names.find(is_free).unwrap_or_default();
        all.push(Segment {
            label,
            name,
            color_srgb: Some(segment.mean_srgb),
        });
    }
    all
}

/// What the segments of meshes beside a volume are, by their names in a list of [`with_mesh_segments`].
pub fn called_as_in(all: &[Segment], meshes: &Surface) -> Vec<SurfaceSegment> {
    let names = all.iter().filter(|s| s.label >= FIRST_MESH_LABEL);
    let pairs = meshes.segments.iter().zip(names);
    let named = pairs.map(|(segment, called)| SurfaceSegment {
        name: called.name.clone(),
        ..segment.clone()
    });
    named.collect()
}

impl Subject {
    /// Where the subject lies and how fine it is.
    pub fn frame(&self) -> SubjectFrame {
        match self {
            Self::Space(space) => space.volume.grid.frame(),
            Self::Mesh(surface) => surface.frame,
            Self::Figure(plate) => plate.frame(),
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
            Self::Figure(_) => None,
        }
    }

    /// Named parts that the subject came with, in the order of its file; none if it has no parts.
    pub fn segments(&self) -> &[Segment] {
        match self {
            Self::Space(space) => &space.segments,
            Self::Mesh(surface) => &surface.segmentation.segments,
            Self::Figure(_) => &[],
        }
    }

    /// The meshes of the subject, alone or beside its volume.
    pub fn surface(&self) -> Option<&Arc<Surface>> {
        match self {
            Self::Space(space) => space.meshes.as_ref(),
            Self::Mesh(surface) => Some(surface),
            Self::Figure(_) => None,
        }
    }

    /// Of a clay, itself after the strokes that its tools are made of.
    pub fn baked(&self) -> Vec<(u32, Arc<DistanceGrid>)> {
        match self {
            Self::Mesh(surface) => surface.grids.clone(),
            Self::Space(_) | Self::Figure(_) => Vec::new(),
        }
    }

    /// What the segments of its meshes are, by the names that they have in this subject.
    pub fn mesh_segments(&self) -> Vec<SurfaceSegment> {
        match self {
            Self::Space(space) => (space.meshes.as_ref())
                .map_or_else(Vec::new, |surface| called_as_in(&space.segments, surface)),
            Self::Mesh(surface) => surface.segments.clone(),
            Self::Figure(_) => Vec::new(),
        }
    }

    /// The picture of the figure, if the subject is one.
    pub fn plate(&self) -> Option<&Arc<Plate>> {
        match self {
            Self::Figure(plate) => Some(plate),
            Self::Space(_) | Self::Mesh(_) => None,
        }
    }

    /// The same subject with these meshes beside its volume; a subject without a volume stays as it is.
    pub fn with_meshes(self, meshes: Option<Arc<Surface>>) -> Self {
        match self {
            Self::Space(space) => Self::Space(Space::new(space.volume, meshes)),
            other => other,
        }
    }

    /// Which of its parts are where, those of meshes beside a volume left out; `None` if it has no parts.
    pub fn segmentation(&self) -> Option<&Segmentation> {
        match self {
            Self::Space(space) => space.volume.segmentation.as_ref(),
            Self::Mesh(surface) => Some(&surface.segmentation),
            Self::Figure(_) => None,
        }
    }

    /// Scalars on a grid, which windows, transfer functions, thresholds and recipes are about; `None` if the subject
    /// has none.
    pub fn values(&self) -> Option<&Arc<Volume>> {
        match self {
            Self::Space(space) => Some(&space.volume),
            Self::Mesh(_) | Self::Figure(_) => None,
        }
    }

    /// The same subject with other segments over its values; as it is where it has no values. Copies the values if
    /// somebody else holds them too.
    pub fn with_segmentation(self, segmentation: Option<Segmentation>) -> Self {
        match self {
            Self::Space(mut space) => {
                Arc::make_mut(&mut space.volume).segmentation = segmentation;
                Self::Space(Space::new(space.volume, space.meshes))
            }
            other => other,
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
            (Self::Space(a), Self::Space(b)) => {
                let meshes = match (&a.meshes, &b.meshes) {
                    (Some(a), Some(b)) => Arc::ptr_eq(a, b),
                    (a, b) => a.is_none() && b.is_none(),
                };
                Arc::ptr_eq(&a.volume, &b.volume) && meshes
            }
            (Self::Mesh(a), Self::Mesh(b)) => Arc::ptr_eq(a, b),
            (Self::Figure(a), Self::Figure(b)) => Arc::ptr_eq(a, b),
            (Self::Space(_) | Self::Mesh(_) | Self::Figure(_), _) => false,
        }
    }
}

impl From<Arc<Volume>> for Subject {
    fn from(volume: Arc<Volume>) -> Self {
        Self::Space(Space::new(volume, None))
    }
}

impl From<Arc<Surface>> for Subject {
    fn from(surface: Arc<Surface>) -> Self {
        Self::Mesh(surface)
    }
}

impl From<Plate> for Subject {
    fn from(plate: Plate) -> Self {
        Self::Figure(Arc::new(plate))
    }
}

impl From<Volume> for Subject {
    fn from(volume: Volume) -> Self {
        Self::from(Arc::new(volume))
    }
}
