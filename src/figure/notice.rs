use std::fmt;

/// Something about a figure that the user should know; the figure is drawn all the same.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Notice {
    /// A handle or contour names a region that the figure does not have; it is not used.
    UnknownRegion {
        /// JSON pointer of the name.
        pointer: String,
        /// What it is called in the document.
        name: String,
    },
    /// Nothing is left of a region.
    EmptyRegion {
        /// Name of the region.
        name: String,
    },
    /// The polygon of a region crosses itself.
    SelfCrossing {
        /// Name of the region.
        name: String,
    },
    /// A region by flood in a figure without pixels (an SVG, a drawing).
    FloodWithoutPixels {
        /// Name of the region.
        name: String,
    },
    /// A region by an element or shape that the file does not have.
    UnknownPath {
        /// Name of the region.
        name: String,
    },
    /// A handle lies outside the figure, or others hold all that it would; it is not used.
    HandleOutside {
        /// Its number in the list, from 0.
        index: usize,
    },
    /// Points of the context on one vertex, or all on one line: `used` of them count, 0 if there is no context.
    ContextPoints {
        /// How many points count.
        used: usize,
    },
    /// Handles of one rigid part that no rigid motion suits.
    BoneMisfit {
        /// Name of the region.
        region: String,
        /// By how much the worst is missed, figure units.
        by: f64,
    },
    /// Triangles that are turned over.
    Folded {
        /// Number of triangles.
        count: usize,
    },
    /// Outlines with too many points; small parts were left out, and the rest was simplified.
    RaggedOutlines {
        /// Parts and holes of fewer pixels are left out.
        least: u32,
    },
    /// More rigid parts than are kept rigid; the smaller ones count as elastic bone.
    RigidParts {
        /// How many there are.
        count: usize,
    },
    /// The polygon `only` crosses a rigid part, which moves as a whole.
    OnlyCrossesRigid {
        /// Name of the region.
        region: String,
    },
    /// The mesh has as many vertices as it may have, and is coarser than it should be.
    MeshLimit,
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownRegion { pointer, name } => {
                write!(f, "{pointer}: there is no region “{name}”; it is not used")
            }
            Self::EmptyRegion { name } => write!(f, "nothing is left of the region “{name}”"),
            Self::SelfCrossing { name } => {
                write!(f, "the polygon of the region “{name}” crosses itself")
            }
            Self::FloodWithoutPixels { name } => {
                write!(
                    f,
                    "the region “{name}” cannot be flooded in a drawing without pixels"
                )
            }
            Self::UnknownPath { name } => {
                write!(f, "the file has no such shape for the region “{name}”")
            }
            Self::HandleOutside { index } => write!(
                f,
                "handle {} takes hold of nothing; it is not used",
                index + 1
            ),
            Self::ContextPoints { used: 0 } => {
                write!(f, "the context's points lie on one line; they are not used")
            }
            Self::ContextPoints { used } => {
                write!(
                    f,
                    "points of the context lie on one vertex; {used} of them are used"
                )
            }
            Self::BoneMisfit { region, by } => {
                write!(
                    f,
                    "handles of a bone of “{region}” do not fit it; one is missed by {by:.3}"
                )
            }
            Self::Folded { count } => write!(f, "{count} triangles are turned over"),
            Self::RaggedOutlines { least } => {
                write!(
                    f,
                    "the outlines are ragged; parts below {least} pixels are left out"
                )
            }
            Self::RigidParts { count } => {
                write!(
                    f,
                    "there are {count} rigid parts; the smaller ones count as elastic"
                )
            }
            Self::OnlyCrossesRigid { region } => {
                write!(
                    f,
                    "a rigid part of “{region}” crosses the border of “only” and moves as a whole"
                )
            }
            Self::MeshLimit => write!(
                f,
                "the mesh has as many points as it may have and is coarser than it should be"
            ),
        }
    }
}
