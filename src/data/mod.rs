//! Layer 2: subjects as values. No files, no GPU.
//!
//! [`Subject`] is what is illustrated, whatever its kind. A reader or generator hands it over in pieces:
//! [`SubjectPart`] lists them all, and a [`SubjectSink`] takes them one by one. [`SubjectBuilder`] makes a [`Subject`]
//! of the pieces, [`VolumeBuilder`] a [`Volume`]; a browser's worker posts them to the page. [`Statistics`] counts
//! voxels as they pass; a [`Reducer`] in between makes a volume that is too large coarser and passes any other piece
//! on. So a new kind of subject adds its piece to the list, and an arm where that piece is used: in [`SubjectBuilder`]
//! and in the worker's messages.
//!
//! [`Limited`] is a number of a benchmark beside its limit.
//!
//! [`segment`] finds the segments that the recipes of a document describe, and joins them with the segments of label
//! volumes; a [`Site`] tells where a segment lies.

mod axes;
mod ball;
mod bench;
mod builder;
mod field;
mod frame;
mod inside;
mod kept_labels;
mod made;
mod mask;
mod material;
pub(crate) mod mesh;
mod parts;
mod patterns;
mod pending;
mod plate;
mod reduce;
mod resources;
mod segmented;
mod sheet;
mod site;
mod statistics;
mod subject;
mod subject_builder;
mod surface;
mod time_slices;
mod volume;

pub use axes::long_axes;
pub use bench::{Limited, median};
pub use builder::{BuildError, VolumeBuilder};
pub use field::{FieldSamples, SampledField};
pub use frame::SubjectFrame;
pub use inside::CoarseLabels;
pub use kept_labels::{KeptLabels, MOST_SHARED_VOXELS};
pub use made::KnownMasks;
pub use mask::Mask;
pub use material::Material;
pub use mesh::{
    Coloring, Corners, Measure, Mesh, MeshMaterial, MeshPart, MeshTexture, NO_INDEX, Wrap, measure,
    pieces, volume, winding_number,
};
pub use parts::{SubjectPart, SubjectSink};
pub use patterns::stroke_patterns;
pub use pending::{Pending, poll_once};
pub use plate::{Plate, PlateOrigin, PlateShape, PlateWord};
pub use reduce::{Reducer, Reduction, VolumeLimits, dims_that_fit, resized};
pub use resources::{FieldKey, ObjectMeshes, Resources};
pub use segmented::{RECIPE_COLORS_SRGB, Segmented, segment, segment_with};
pub use sheet::{Sheet, SheetMesh};
pub use site::Site;
pub use statistics::{Histogram, Statistics};
pub use subject::{FIRST_MESH_LABEL, Space, Subject, called_as_in, with_mesh_segments};
pub use subject_builder::SubjectBuilder;
pub use surface::{
    CARVER_MARGIN, Carver, CarverLevel, DistanceGrid, FIELD_MARGIN, FIELD_VOXELS, Grids,
    MAX_SURFACE_SEGMENTS, MeshGrids, Nearest, PLAIN_SRGB, Surface, SurfaceArrays, SurfaceError,
    SurfaceField, SurfacePicture, SurfaceSegment, SurfaceTextures, Tree, TreeNode, Triangle,
    share_grids, times_inside,
};
pub use time_slices::TimeSlices;
pub use volume::{Grid, Segment, Segmentation, Volume, Voxels};
