//! What a click in the picture does. Exactly one tool is active at a time.

use glam::Vec3;

use super::figure::FigureTool;
use crate::document::TemplateKind;

/// The tool in the author's hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Tool {
    /// Clicks select templates; drags turn the object.
    #[default]
    Look,
    /// The next click on the object places a template of this kind.
    Place(TemplateKind),
    /// The next click on the object fastens a caption to its tissue.
    Caption,
    /// Clicks on the object add seeds to the recipe of this index in `subject.features`.
    Seed(usize),
    /// Drags paint tissue with a ball.
    Paint {
        /// Index in `subject.features` of the recipe that is painted.
        recipe: usize,
        /// The ball takes away what it touches.
        erases: bool,
    },
    /// Clicks measure distances. Holds the first point of the distance under way, subject space.
    Measure(Option<Vec3>),
    /// Drags over slices widen and raise the window of values.
    Level,
    /// Clicks make handles and regions of a figure.
    Figure(FigureTool),
    /// Drags shape the clay.
    Clay,
}

impl Tool {
    /// The kind of the template that is being placed.
    pub fn placing(self) -> Option<TemplateKind> {
        match self {
            Self::Place(kind) => Some(kind),
            _ => None,
        }
    }

    /// True if the tool waits for a click, which the middle of the picture can stand in for: placing, captioning, a
    /// tool of a figure.
    pub fn wants_place(self) -> bool {
        matches!(self, Self::Place(_) | Self::Caption | Self::Figure(_))
    }

    /// True while clicks measure.
    pub fn is_measuring(self) -> bool {
        matches!(self, Self::Measure(_))
    }

    /// True while drags over slices change the window of values.
    pub fn is_levelling(self) -> bool {
        matches!(self, Self::Level)
    }

    /// The tool that makes handles and regions of a figure, if it is one.
    pub fn for_figure(self) -> Option<FigureTool> {
        match self {
            Self::Figure(tool) => Some(tool),
            _ => None,
        }
    }

    /// True if the tool works on a tissue.
    pub fn is_for_tissue(self) -> bool {
        matches!(self, Self::Seed(_) | Self::Paint { .. })
    }

    /// Whether the ball in hand erases; `None` while there is none in hand.
    pub fn ball(self) -> Option<bool> {
        match self {
            Self::Paint { erases, .. } => Some(erases),
            _ => None,
        }
    }

    /// True if every click counts, however quickly the clicks come: ends of distances, seeds.
    pub fn adds_up(self) -> bool {
        matches!(self, Self::Seed(_) | Self::Measure(_))
    }

    /// True if the tool changes the document, so that it cannot be used in a lesson.
    pub fn is_for_authors(self) -> bool {
        self.is_for_tissue() || self.wants_place() || self == Self::Clay
    }
}
