//! Layer 2: volumes as values. No files, no GPU.
//!
//! A reader or generator pushes pieces into a [`VolumeSink`]: [`VolumeBuilder`] collects them into a [`Volume`]; a
//! browser's worker posts them to the page. [`Statistics`] counts as they pass; a [`Reducer`] in between makes what
//! is too large coarser. [`segment`] finds the segments that the recipes of a document describe, and joins them with
//! the segments of label volumes.

mod builder;
mod field;
mod frame;
mod mask;
mod reduce;
mod resources;
mod segmented;
mod statistics;
mod volume;

pub use builder::{BuildError, VolumeBuilder};
pub use field::{FieldSamples, SampledField};
pub use frame::SubjectFrame;
pub use mask::{Mask, Turns};
pub use reduce::{Reducer, Reduction, VolumeLimits, dims_that_fit, resized};
pub use resources::{FieldKey, Resources};
pub use segmented::{RECIPE_COLORS_SRGB, Segmented, segment};
pub use statistics::{Histogram, Statistics};
pub use volume::{Grid, Segment, Segmentation, Volume, VolumeSink, Voxels};
