//! Where the grids of tools lie in the texture of sweeps.

use std::sync::Arc;

use crate::data::{DistanceGrid, MeshGrids, Resources, share_grids};
use crate::displace::GridPlace;
use crate::document::{PlacedTemplate, TemplateData, ToolFile};

/// The grids of distances that sweeps read, each once, as they lie before the steps in the texture of sweeps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Laid(MeshGrids);

/// Two are equal if they share their grids in memory.
impl PartialEq for Laid {
    fn eq(&self, other: &Self) -> bool {
        share_grids(&self.0, &other.0)
    }
}

impl Laid {
    /// The grids of the sweeps that act, as far as they are there.
    pub(crate) fn of(placed: &[PlacedTemplate], resources: &Resources) -> Self {
        let mut laid = Self::default();
        for template in placed.iter().filter(|t| resources.acting(t).enabled) {
            let TemplateData::Tools(tools) = &template.data else {
                continue;
            };
            for shape in tools.acting().filter_map(|tool| tool.shape.as_ref()) {
                if let Some(key) = shape.file().and_then(ToolFile::key)
                    && laid.0.iter().all(|(known, _)| known != key)
                    && let Some((grid, _)) = resources.grids.of(shape)
                {
                    laid.0.push((key.to_owned(), Arc::clone(grid)));
                }
            }
        }
        laid
    }

    /// The grids in the order in which they lie.
    pub(crate) fn grids(&self) -> impl Iterator<Item = &DistanceGrid> {
        self.0.iter().map(|(_, grid)| &**grid)
    }

    /// Texels that all of them take.
    pub(super) fn texels(&self) -> usize {
        self.grids().map(DistanceGrid::texel_count).sum()
    }

    /// Where the grid of a file lies, if it is there.
    pub(super) fn place(&self, file: &ToolFile) -> Option<GridPlace> {
        let key = file.key()?;
        let at = self.0.iter().position(|(known, _)| known == key)?;
        let before = self.grids().take(at).map(DistanceGrid::texel_count);
        Some(GridPlace {
            first: before.sum(),
            nodes: self.0.get(at)?.1.nodes(),
        })
    }
}
