//! The part `figure` of a document as plain values, with its defaults and limits (spec/figures.md, "The document").

mod handle;
mod region;
mod shape;

pub use handle::{Handle, Hold, Move, Propagation, Rotations};
pub use region::{Behind, Flood, Region, Rigidity, Source};
pub use shape::{Context, Contour, Rest};

use glam::DVec2;

/// Regions at most.
pub const MAX_REGIONS: usize = 64;
/// Handles at most.
pub const MAX_HANDLES: usize = 64;
/// Contours at most.
pub const MAX_CONTOURS: usize = 8;
/// Points of all floods together at most.
pub const MAX_FLOOD_POINTS: usize = 256;
/// Points of one flood at most.
pub const MAX_FLOOD_SEEDS: usize = 16;
/// Corners of a region's polygon at most.
pub const MAX_POLYGON: usize = 512;
/// Points of a line at most.
pub const MAX_LINE: usize = 32;
/// Corners of the polygon outside which handles move nothing, at most.
pub const MAX_ONLY: usize = 64;
/// Points of the context at most.
pub const MAX_LANDMARKS: usize = 64;
/// Points of another outline at most.
pub const MAX_OUTLINE: usize = 256;
/// How far a handle moves what it holds at most, along each axis.
pub const MAX_MOVE: f64 = 4.0;
/// By which angle a handle turns it at most: two full turns either way, radians.
pub const MAX_TURN: f64 = 4.0 * std::f64::consts::PI;
/// Ends of the range of factors by which a handle scales.
pub const SCALE_RANGE: [f64; 2] = [0.05, 20.0];
/// Least and greatest rigidity that a region may have.
pub const RIGIDITY_RANGE: [f64; 2] = [0.1, 100.0];
/// Triangles aimed at if a document does not say.
pub const DEFAULT_DETAIL: u32 = 6000;

/// How a picture or drawing is divided and bent. Points are those of the figure's plane at rest: origin in the middle
/// of the picture, x to the right, y up, 1 is the picture's longest side.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The regions, from behind to front.
    pub regions: Vec<Region>,
    /// What bends the figure, in the order in which vertices are given to them.
    pub handles: Vec<Handle>,
    /// A polygon outside which handles move nothing; none: they act everywhere.
    pub only: Option<Vec<DVec2>>,
    /// How turns and scales spread from handles.
    pub propagation: Propagation,
    /// How far handles act, 0 to 2; 0: everywhere.
    pub reach: f64,
    /// Whether turns are found by the solve.
    pub rotations: Rotations,
    /// Points whose arrangement is kept or taken from another picture.
    pub context: Option<Context>,
    /// Outlines that take the style of others.
    pub contours: Vec<Contour>,
    /// What becomes of what lies in no region.
    pub rest: Rest,
    /// Triangles aimed at, 500 to 60 000.
    pub detail: u32,
}

impl Default for Figure {
    /// A figure without regions and handles: the picture as it is.
    fn default() -> Self {
        Self {
            regions: Vec::new(),
            handles: Vec::new(),
            only: None,
            propagation: Propagation::Harmonic,
            reach: 0.0,
            rotations: Rotations::Found,
            context: None,
            contours: Vec::new(),
            rest: Rest::Bend,
            detail: DEFAULT_DETAIL,
        }
    }
}
