//! Recipes: how the program finds a segment in a scan that comes without labels for it.
//!
//! ```json
//! { "subject": { "sha256": "…", "features": [
//!     { "name": "bone", "color": "#eadfc4", "from": { "threshold": [200, 3000] },
//!       "clean": [ { "largest": 1 }, { "close": 2 }, { "fill": true }, { "smooth": 1 } ] },
//!     { "name": "aorta", "from": { "grow": { "seeds": [[0.02, 0.05, 0.1]], "range": [150, 400] } } } ] } }
//! ```
//!
//! Values are the scan's own (Hounsfield units for a CT), seeds lie in the undeformed subject, lengths of the clean-up
//! are millimetres. The steps of the clean-up run in the order in which they are listed. The result depends on the
//! recipe and the voxels alone and is the same on every machine, bit for bit.

use glam::Vec3;

/// How one segment is found in the voxels of a scan.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// Index in the document's `subject.features`, which may also hold recipes that this version does not know.
    pub index: usize,
    /// The segment's name, as `keep` uses it; never empty.
    pub name: String,
    /// The segment's colour where segments tint, sRGB bytes; `None`: the program picks one.
    pub color_srgb: Option<[u8; 3]>,
    /// The first draft of the segment.
    pub from: RecipeSource,
    /// The clean-up of the draft, in this order.
    pub clean: Vec<CleanStep>,
}

/// The first draft of a segment.
#[derive(Clone, Debug, PartialEq)]
pub enum RecipeSource {
    /// All voxels with a value in the range, ends included.
    Threshold {
        /// Lowest and highest value.
        range: [f32; 2],
    },
    /// The voxels with a value in the range that are connected, over faces, to the voxel of a seed.
    Grow {
        /// Rest space, subject units.
        seeds: Vec<Vec3>,
        /// Lowest and highest value, ends included.
        range: [f32; 2],
    },
}

impl RecipeSource {
    /// Lowest and highest value, ends included.
    pub fn range(&self) -> [f32; 2] {
        match self {
            Self::Threshold { range } | Self::Grow { range, .. } => *range,
        }
    }
}

/// One step of a clean-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CleanStep {
    /// Keeps this many of the largest parts (a part is connected over faces). Of parts of equal size, the one that
    /// comes first in the file is kept first.
    Largest(u32),
    /// Fills cavities that the segment encloses on all sides.
    Fill,
    /// Closes gaps up to twice this width: grows by this many mm and shrinks again.
    Close(f32),
    /// Smooths the outline by a Gaussian of this standard deviation, mm.
    Smooth(f32),
    /// Adds every voxel that is at most this many mm away.
    Grow(f32),
    /// Removes every voxel that is at most this many mm from the outside.
    Shrink(f32),
}
