use std::sync::Arc;

use glam::Vec2;

use crate::data::{Plate, Sheet};
use crate::document::figure::Region;

/// What a click on a figure makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureTool {
    /// A pin, which holds a point.
    Pin,
    /// A line along a limb; each click is a point of it.
    Line,
    /// A region of like pixels, or of the shape of a drawing, around the click.
    Region,
    /// A region within a polygon; each click is a corner of it, and a drag draws freely.
    Polygon,
    /// A point whose arrangement with others is kept, or taken over from another picture.
    Landmark,
    /// The polygon outside which handles move nothing.
    Only,
}

impl FigureTool {
    /// True if clicks are collected until the line or polygon is done.
    pub fn draws(self) -> bool {
        matches!(self, Self::Line | Self::Polygon | Self::Only)
    }
}

/// What is drawn over a figure while it is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Borders between regions.
    Outlines,
    /// Rigidity, as hatching.
    Rigidity,
    /// Edges of all triangles.
    Mesh,
    /// Pins, lines and their rings.
    Handles,
    /// Vertices: held, fixed, free.
    Vertices,
}

impl Overlay {
    /// All of them, in the order of the panel.
    pub const ALL: [Self; 5] = [
        Self::Outlines,
        Self::Handles,
        Self::Rigidity,
        Self::Mesh,
        Self::Vertices,
    ];
}

/// What is taken over from another picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Takes {
    /// The places of the landmarks, in their order.
    #[default]
    Landmarks,
    /// The outline of the selected region.
    Outline,
}

/// Another picture beside the figure, of which places are taken over: only they go into the document.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Its pixels are shown and never kept.
    pub plate: Arc<Plate>,
    /// What is taken over.
    pub takes: Takes,
    /// The places that were clicked, its plane.
    pub points: Vec<Vec2>,
}

/// What is done with the picture beside the figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReferenceCommand {
    /// Asks for a picture.
    Open,
    /// Puts it away.
    Close,
    /// Other things are taken over from now on.
    For(Takes),
    /// Adds a place of its plane.
    Click(Vec2),
    /// Takes the last place back.
    TakeBack,
    /// Writes the places into the document.
    Take,
}

/// What is done with a figure, beside edits of its document.
#[derive(Clone, Debug, PartialEq)]
pub enum FigureCommand {
    /// Takes a tool in hand, or puts it away if it is.
    Take(FigureTool),
    /// Uses the tool at a place of the bent figure; true: as one more of what is selected.
    Use(Vec2, bool),
    /// Draws on freely to a place of the bent figure.
    Draw(Vec2),
    /// Ends the line or polygon that is drawn.
    Finish,
    /// Takes back the last corner that was drawn.
    TakeBack,
    /// Sets the tolerance of the selected region's flood, as a part of a drag.
    Widen(f64),
    /// Selects a region by its name.
    SelectRegion(Option<String>),
    /// Selects a handle by its index; true: beside those that are selected, or no longer.
    SelectHandle(Option<usize>, bool),
    /// Moves the selected handles, and this one, as a part of a drag.
    MoveHandles(usize, Vec2),
    /// Moves a point of a line to a place of the bent figure, as a part of a drag.
    MoveLinePoint(usize, usize, Vec2),
    /// Lets a handle move the region of this name as a whole.
    HoldRegion(String),
    /// Makes regions of all shapes of a drawing that are none yet.
    TakeShapes,
    /// Handles go back to where they hold the figure at rest: this one, or all.
    Rest(Option<usize>),
    /// Removes the landmarks.
    DropLandmarks,
    /// Shows or hides an overlay.
    Show(Overlay),
    /// Takes places over from another picture.
    Refer(ReferenceCommand),
    /// Stops the bending of a figure that takes long.
    Stop,
    /// Goes on with what was stopped.
    GoOn,
}

/// A figure as it is made.
#[derive(Debug)]
pub struct FigureView {
    /// The figure as it is bent now.
    pub sheet: Option<Sheet>,
    /// The plate that is bent.
    pub plate: Option<Arc<Plate>>,
    /// The regions with what the source adds, from behind to front, as of the last pose at rest.
    pub regions: Arc<Vec<Region>>,
    /// Name of the selected region.
    pub region: Option<String>,
    /// Indices of the selected handles, the last that was selected at the end.
    pub handles: Vec<usize>,
    /// The line or polygon that is drawn, or landmarks that are too few so far: places of the bent figure.
    pub draft: Vec<Vec2>,
    /// How much of a pose that takes long is done, 0 to 1.
    pub progress: Option<f32>,
    /// The figure is not bent as the document has it, since that was stopped.
    pub is_stopped: bool,
    /// Another picture, of which places are taken over.
    pub reference: Option<Reference>,
    /// The next picture that is opened is that one.
    pub(in crate::app::session) wants_reference: bool,
    shown: Vec<Overlay>,
}

impl Default for FigureView {
    fn default() -> Self {
        Self {
            sheet: None,
            plate: None,
            regions: Arc::default(),
            region: None,
            handles: Vec::new(),
            draft: Vec::new(),
            progress: None,
            is_stopped: false,
            reference: None,
            wants_reference: false,
            shown: vec![Overlay::Outlines, Overlay::Handles],
        }
    }
}

impl FigureView {
    /// True if an overlay is shown.
    pub fn shows(&self, overlay: Overlay) -> bool {
        self.shown.contains(&overlay)
    }

    /// Shows an overlay, or hides it.
    pub(super) fn toggle(&mut self, overlay: Overlay) {
        match self.shown.iter().position(|shown| *shown == overlay) {
            Some(index) => {
                self.shown.remove(index);
            }
            None => self.shown.push(overlay),
        }
    }

    /// Another subject is shown; none if it is no figure.
    pub(in crate::app::session) fn set_plate(&mut self, plate: Option<Arc<Plate>>) {
        self.let_go();
        self.reference = None;
        self.plate = plate;
        self.sheet = None;
        self.regions = Arc::default();
    }

    /// Nothing is selected, and nothing is drawn.
    pub(in crate::app::session) fn let_go(&mut self) {
        self.region = None;
        self.handles.clear();
        self.draft.clear();
    }

    /// True if regions are found in the pixels of the plate, not in shapes.
    pub fn has_pixels(&self) -> bool {
        self.plate.as_ref().is_some_and(|plate| plate.has_pixels())
    }

    /// A region by its name, with what the source adds.
    pub fn region_named(&self, name: &str) -> Option<&Region> {
        self.regions.iter().find(|region| region.name == name)
    }

    /// The selected region, with what the source adds.
    pub fn selected_region(&self) -> Option<&Region> {
        self.region_named(self.region.as_deref()?)
    }
}
