//! Layer 2: volumes as values. No files, no GPU.

mod volume;

pub use volume::{Grid, LabelVolume, Segment, Volume, VolumeSink, Voxels};
