//! Layer 2: subjects as values. No files, no GPU.
//!
//! [`Subject`] is what is illustrated, whatever its kind. A reader or generator pushes the pieces of a volume into a
//! [`VolumeSink`]: [`VolumeBuilder`] collects them into a [`Volume`]; a browser's worker posts them to the page as
//! [`SubjectPart`]s, of which [`SubjectBuilder`] makes a [`Subject`]. [`Statistics`] counts as they pass; a [`Reducer`]
//! in between makes what is too large coarser. [`segment`] finds the segments that the recipes of a document describe,
//! and joins them with the segments of label volumes; a [`Site`] tells where a segment lies.

mod ball;
mod builder;
mod field;
mod frame;
mod inside;
mod made;
mod mask;
mod material;
mod parts;
mod pending;
mod reduce;
mod resources;
mod segmented;
mod site;
mod statistics;
mod subject;
mod time_slices;
mod volume;

pub use builder::{BuildError, VolumeBuilder};
pub use field::{FieldSamples, SampledField};
pub use frame::SubjectFrame;
pub use inside::CoarseLabels;
pub use made::KnownMasks;
pub use mask::Mask;
pub use material::Material;
pub use parts::{SubjectBuilder, SubjectPart};
pub use pending::{Pending, poll_once};
pub use reduce::{Reducer, Reduction, VolumeLimits, dims_that_fit, resized};
pub use resources::{FieldKey, Resources};
pub use segmented::{RECIPE_COLORS_SRGB, Segmented, segment, segment_with};
pub use site::Site;
pub use statistics::{Histogram, Statistics};
pub use subject::{Space, Subject};
pub use time_slices::TimeSlices;
pub use volume::{Grid, Segment, Segmentation, Volume, VolumeSink, Voxels};
