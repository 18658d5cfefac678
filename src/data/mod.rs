//! Layer 2: volumes as values. No files, no GPU.
//!
//! A reader or generator pushes pieces into a [`VolumeSink`]: [`VolumeBuilder`] collects them into a [`Volume`]; a
//! browser's worker posts them to the page. [`Statistics`] counts as they pass.

mod builder;
mod statistics;
mod volume;

pub use builder::{BuildError, VolumeBuilder};
pub use statistics::{Histogram, Statistics};
pub use volume::{Grid, LabelVolume, Segment, Volume, VolumeSink, Voxels};
