use glam::DVec2;

/// Points whose arrangement is kept under deformation, or is taken from another picture (Chen et al., sections 3.3 and
/// 4.2).
#[derive(Clone, Debug, PartialEq)]
pub struct Context {
    /// The points, 3 to 64.
    pub points: Vec<DVec2>,
    /// How strongly they act, 0 to 10: the rigidity of a sheet between them.
    pub strength: f64,
    /// Whether a pose keeps their arrangement.
    pub keep: bool,
    /// The same points of another picture in any unit; none: nothing is taken over.
    pub like: Option<Vec<DVec2>>,
    /// How much of the other's arrangement is taken over, 0 to 1.
    pub amount: f64,
}

/// An outline that takes the style of another (Chen et al., section 4.1).
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// Name of the region whose outline it is.
    pub region: String,
    /// The other outline, 3 to 256 points in any unit.
    pub like: Vec<DVec2>,
    /// How much of it is taken over, 0 to 1.
    pub amount: f64,
    /// Whether the other outline is mirrored in x first.
    pub mirror: bool,
    /// Places of the outline that stay, up to 16 points.
    pub keep: Vec<DVec2>,
}

/// What becomes of what lies in no region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rest {
    /// It is a soft region behind all others.
    Bend,
    /// It is a sheet of its own that nothing moves, with holes where regions lay.
    Keep,
    /// It is left out.
    Drop,
}

impl Rest {
    /// All of them; the first is the default.
    pub const ALL: [Self; 3] = [Self::Bend, Self::Keep, Self::Drop];
    /// Their names in documents, in the same order.
    pub const NAMES: [&'static str; 3] = ["bend", "keep", "drop"];

    /// Its name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}
