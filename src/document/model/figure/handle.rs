use glam::DVec2;

/// Something that holds vertices and moves them.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// The point, region or line that moves with it.
    pub hold: Hold,
    /// Vertices within this of its point or line are held, 0.001 to 0.2.
    pub radius: f64,
    /// Where it takes them.
    pub motion: Move,
    /// False: as if it were not there.
    pub enabled: bool,
}

impl Handle {
    /// A pin at a point that moves by `by` and whose turn is open.
    pub fn pin(at: DVec2, by: DVec2) -> Self {
        Self {
            name: None,
            hold: Hold::Point(at),
            radius: 0.01,
            motion: Move {
                by,
                ..Move::default()
            },
            enabled: true,
        }
    }
}

/// What a handle holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Hold {
    /// The tissue around a point.
    Point(DVec2),
    /// A region, by its name.
    Region(String),
    /// The tissue along a line of 2 to 32 points, and where its points go (as many) if the line is bent.
    Line {
        /// The line at rest.
        points: Vec<DVec2>,
        /// Where its points go; none: it moves as a whole.
        to: Option<Vec<DVec2>>,
    },
}

/// How a handle moves what it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// How far, each -4 to 4.
    pub by: DVec2,
    /// By which angle, radians counter-clockwise, -4π to 4π; none: open for a point, 0 for a region or a line (which
    /// a document gives as 0).
    pub turn: Option<f64>,
    /// By which factor, 0.05 to 20.
    pub scale: f64,
}

impl Default for Move {
    /// No move, and no turn given.
    fn default() -> Self {
        Self {
            by: DVec2::ZERO,
            turn: None,
            scale: 1.0,
        }
    }
}

/// How turns and scales spread from handles to the rest of the figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Propagation {
    /// As smoothly as the rigidities allow: turns change in soft tissue, not in bone.
    Harmonic,
    /// Those of the nearest handle.
    Nearest,
    /// Means of all, whose weights fall linearly between two handles.
    Linear,
    /// Means of all, whose weights fall as a Gaussian between two handles.
    Gaussian,
}

/// Whether turns are found by the solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rotations {
    /// Each triangle takes the turn that suits it best.
    Found,
    /// Each triangle has the turn that spreads from the handles: the paper's way.
    Propagated,
}

impl Propagation {
    /// All of them; the first is the default.
    pub const ALL: [Self; 4] = [Self::Harmonic, Self::Nearest, Self::Linear, Self::Gaussian];
    /// Their names in documents, in the same order.
    pub const NAMES: [&'static str; 4] = ["harmonic", "nearest", "linear", "gaussian"];

    /// Its name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

impl Rotations {
    /// All of them; the first is the default.
    pub const ALL: [Self; 2] = [Self::Found, Self::Propagated];
    /// Their names in documents, in the same order.
    pub const NAMES: [&'static str; 2] = ["found", "propagated"];

    /// Its name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}
