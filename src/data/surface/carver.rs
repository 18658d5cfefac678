//! What a template `carve` reads of an object: distances to its surface, and how deep in it tissue may have stood, on
//! grids that grow coarser away from it (spec/surfaces.md, "carve").
//!
//! ```text
//!   +-----------------------+   each level has cells twice as large as the one inside it and eight of them around the
//!   |   +-----------+       |   object's box; so far away cells are large and near cells are small, a needle with a
//!   |   | +-------+ |       |   wide reach takes little, and nothing depends on the reach or on where the object is
//!   |   | |  box  | |       |
//!   |   | +-------+ |       |   d: exact at the nodes, and corrected there so that the quadratic B-spline through them
//!   |   +-----------+       |   (shaders/displace/carve.wgsl) has the right value and the right slope between them
//!   +-----------------------+
//! ```

use glam::{UVec3, Vec3};

/// Cells of each level around the box, on each side.
pub const CARVER_MARGIN: u32 = 8;
/// A place is read from a level down to so many cells from the end of its margin.
pub(super) const FADED: f32 = 5.0;

/// The grids of an object, in its own space: its box about the origin, its longest side 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Carver {
    /// Half the sides of the object's box.
    pub half: Vec3,
    /// Side of a cell of the finest level; each further level has cells twice as large.
    pub cell: f32,
    /// From the finest to the coarsest.
    pub levels: Vec<CarverLevel>,
    /// Least distance of all, the greatest depth negated.
    pub least: f32,
    /// Greatest way that tissue may be pushed into the object anywhere.
    pub room: f32,
    /// The nodes of all levels, one level behind the other, x fastest: in the upper 20 bits the distance (0 is
    /// `least`), in the lower 12 how deep in the object tissue may have stood (4095 is `room`).
    pub texels: Vec<u32>,
}

/// One grid of a [`Carver`]; its middle node or nodes lie at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarverLevel {
    /// Nodes along each axis.
    pub nodes: UVec3,
    /// The first of its nodes among all.
    pub first: u32,
    /// Distance of one step of a texel.
    pub step: f32,
}

impl Carver {
    /// Bits of a texel that hold the room; the others hold the distance.
    pub const ROOM_BITS: u32 = 12;

    /// False for an object that is thinner than a cell everywhere, and cuts nothing.
    pub fn cuts(&self) -> bool {
        self.least < -0.25 * self.cell
    }

    /// How many of the levels are read within a reach, as a multiple of the object's longest side.
    pub fn levels_within(&self, reach: f32) -> usize {
        let is_enough = |&index: &usize| {
            let cell = self.cell * (index as f32).exp2();
            (CARVER_MARGIN as f32 - FADED) * cell >= reach
        };
        let last = (0..self.levels.len()).find(is_enough);
        last.map_or(self.levels.len(), |last| last + 1)
    }
}
