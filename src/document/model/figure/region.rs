use glam::DVec2;

/// A part of the figure that has its own stiffness and place in the order.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its name, unlike any other's.
    pub name: String,
    /// Which pixels it takes; none: nothing (a built-in figure and an SVG fill this in by the region's name).
    pub from: Option<Source>,
    /// Pixels of the map that it is grown by, -32 to 32; a negative number shrinks it.
    pub grow: f64,
    /// Pixels of the map over which its outline is smoothed, 0 to 32.
    pub smooth: f64,
    /// Whether holes become part of it; none: they do unless it is hidden.
    pub fill: Option<bool>,
    /// Parts of fewer pixels are left out, 0 to 1 000 000.
    pub least: u32,
    /// How strongly it resists.
    pub rigidity: Rigidity,
    /// Whether it stays where it is.
    pub fixed: bool,
    /// Place in the order of drawing, -100 to 100; larger is in front.
    pub order: f64,
    /// Whether it is a sheet of its own that can leave what lies around it.
    pub cut: bool,
    /// What is seen where a cut region lay.
    pub behind: Behind,
    /// Whether it is no part of the figure (paper, a scale bar).
    pub hide: bool,
    /// Of a region without `from` the keys that its document gives: the others are those of the source's own region.
    pub given: Vec<&'static str>,
}

impl Region {
    /// A soft region of this name that takes nothing yet.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            from: None,
            grow: 0.0,
            smooth: 1.5,
            fill: None,
            least: 16,
            rigidity: Rigidity::SOFT,
            fixed: false,
            order: 0.0,
            cut: false,
            behind: Behind::None,
            hide: false,
            given: Vec::new(),
        }
    }

    /// This region laid over the source's own of the same name: without `from`, what the document does not give is the
    /// source's.
    pub fn over(&self, own: &Self) -> Self {
        if self.from.is_some() {
            return self.clone();
        }
        let mut laid = own.clone();
        for key in &self.given {
            match *key {
                "grow" => laid.grow = self.grow,
                "smooth" => laid.smooth = self.smooth,
                "fill" => laid.fill = self.fill,
                "least" => laid.least = self.least,
                "rigidity" => laid.rigidity = self.rigidity,
                "fixed" => laid.fixed = self.fixed,
                "order" => laid.order = self.order,
                "cut" => laid.cut = self.cut,
                "behind" => laid.behind = self.behind,
                "hide" => laid.hide = self.hide,
                _ => {}
            }
        }
        laid.given.clone_from(&self.given);
        laid
    }

    /// Whether holes become part of it.
    pub fn fills_holes(&self) -> bool {
        self.fill.unwrap_or(!self.hide)
    }
}

/// What says which pixels a region takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// Pixels of like colour around points.
    Flood(Flood),
    /// A polygon, filled by the non-zero rule.
    Polygon(Vec<DVec2>),
    /// An element of an SVG by its id, or a filled shape by its number.
    Path(String),
}

/// Pixels of like colour around points.
#[derive(Clone, Debug, PartialEq)]
pub struct Flood {
    /// Where it begins, 1 to 16 points.
    pub at: Vec<DVec2>,
    /// Difference in any of red, green and blue up to which a pixel is like the first, 0 to 255.
    pub tolerance: f64,
    /// Unlike pixels are grown by this before the flood, so that it does not leak through gaps of an outline, 0 to 16
    /// pixels.
    pub gap: f64,
    /// Whether it reaches neighbours only; otherwise all like pixels are taken.
    pub connected: bool,
}

impl Flood {
    /// A flood from these points with the tolerance and gap that a document has if it does not say.
    pub fn new(at: Vec<DVec2>) -> Self {
        Self {
            at,
            tolerance: 24.0,
            gap: 0.0,
            connected: true,
        }
    }
}

/// How strongly a region resists deformation (Chen et al., section 3.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rigidity {
    /// Resistance of the deformed x and of the deformed y, each 0.1 to 100: 1 is fat, 10 is bone.
    Elastic([f64; 2]),
    /// Each part moves as a whole; not in the paper.
    Rigid,
}

impl Rigidity {
    /// That of fat, and of what lies in no region.
    pub const SOFT: Self = Self::Elastic([1.0, 1.0]);
    /// What rigid parts count as where they cannot be exactly rigid.
    pub const BONE: [f64; 2] = [10.0, 10.0];
}

/// What is seen where a cut region lay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Behind {
    /// Nothing: there is a hole.
    None,
    /// Soft tissue of this colour (sRGB).
    Color([u8; 3]),
    /// Soft tissue in colours interpolated from around the region.
    Smooth,
}
