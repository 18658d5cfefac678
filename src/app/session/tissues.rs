//! Which tissues are edited or shown alone, and the recipes of those that are made here.

use glam::{Quat, Vec3};

use crate::document::{Align, Illustration, PlacedTemplate, Recipe, RecipeSource, TemplateKind};
use crate::math::Placement;

/// What of the tissues is being edited or shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tissues {
    /// Index in `subject.features` of the recipe that is open for editing.
    pub open: Option<usize>,
    /// Name of the segment that is shown alone.
    pub alone: Option<String>,
    /// Name of the segment whose look is edited.
    pub look: Option<String>,
    /// Voxels of each recipe's segment, as last counted.
    pub counts: Vec<u64>,
    /// How far the work under way is, 0 to 1.
    pub progress: Option<f32>,
}

/// Something done with tissues that is no change of the document.
#[derive(Clone, Debug, PartialEq)]
pub enum TissueCommand {
    /// Opens the recipe of this index for editing, or closes the one that is open.
    Open(Option<usize>),
    /// Shows the segment of this name alone, or all again.
    Alone(Option<String>),
    /// Opens the look of the segment of this name for editing, or closes it.
    Look(Option<String>),
    /// Clicks add seeds to the recipe that is open, or not.
    Seed(bool),
}

impl Tissues {
    /// The illustration while a segment is shown alone: everything else is cut away. `None` while all are shown.
    pub fn alone_in(&self, shown: &Illustration) -> Option<Illustration> {
        let name = self.alone.clone()?;
        let placement = Placement {
            at: Vec3::ZERO,
            rotate: Quat::IDENTITY,
            size: Vec3::splat(2.5),
        };
        let cut = PlacedTemplate {
            align: Align::Segment {
                keep: vec![name],
                thickness: 0.01,
            },
            ..PlacedTemplate::new(TemplateKind::Cut, placement)
        };
        Some(Illustration {
            templates: vec![cut],
            ..shown.clone()
        })
    }
}

/// The recipe with another range of values.
pub fn with_range(recipe: &Recipe, range: [f32; 2]) -> Recipe {
    let mut new = recipe.clone();
    match &mut new.from {
        RecipeSource::Threshold { range: old } | RecipeSource::Grow { range: old, .. } => {
            *old = range;
        }
    }
    new
}

/// The recipe growing from other seeds, rest space.
pub fn with_seeds(recipe: &Recipe, seeds: Vec<Vec3>) -> Recipe {
    Recipe {
        from: RecipeSource::Grow {
            seeds,
            range: recipe.from.range(),
        },
        ..recipe.clone()
    }
}
