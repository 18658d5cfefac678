//! Recipes: how the program finds a segment in a scan that comes without labels for it.
//!
//! ```json
//! { "subject": { "sha256": "…", "features": [
//!     { "name": "bone", "color": "#eadfc4", "from": { "threshold": [200, 3000] },
//!       "clean": [ { "largest": 1 }, { "close": 2 }, { "fill": true }, { "smooth": 1 } ] },
//!     { "name": "aorta", "from": { "grow": { "seeds": [[0.02, 0.05, 0.1]], "range": [150, 400] } },
//!       "paint": [ { "radius": 3, "path": [20, 50, 100, 12, 0, -4] },
//!                  { "erase": true, "radius": 2, "path": [21, 52, 99] } ] } ] } }
//! ```
//!
//! Values are the scan's own (Hounsfield units for a CT), seeds lie in the undeformed subject, lengths of the clean-up
//! are millimetres. The steps of the clean-up run in the order in which they are listed, then the strokes of a ball
//! that paints or erases. A stroke's places are whole thousandths of a subject unit in the undeformed subject: the
//! first, then each less the one before. A recipe that has `paint` needs no `from`: then all of the tissue is painted.
//! The result depends on the recipe and the voxels alone and is the same on every machine, bit for bit.

use glam::{DVec3, IVec3, Vec3};

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
    /// What was painted and erased after that, in this order.
    pub paint: Vec<Stroke>,
}

/// The way of a ball through the undeformed subject: all that it touches is added to a segment, or taken out of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// True: what the ball touches is taken out.
    pub erases: bool,
    /// Radius of the ball, mm.
    pub radius_mm: f32,
    /// Where the ball went, straight from each to the next, thousandths of a subject unit in rest space.
    pub places: Vec<IVec3>,
}

impl Stroke {
    /// Places in one subject unit.
    pub const PER_UNIT: f64 = 1000.0;

    /// A place in rest space, subject units.
    pub fn in_rest(place: IVec3) -> DVec3 {
        place.as_dvec3() / Self::PER_UNIT
    }
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
    /// No voxel: all of the segment is painted.
    Nothing,
}

impl RecipeSource {
    /// Lowest and highest value, ends included; `None` where values do not count.
    pub fn range(&self) -> Option<[f32; 2]> {
        match self {
            Self::Threshold { range } | Self::Grow { range, .. } => Some(*range),
            Self::Nothing => None,
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
