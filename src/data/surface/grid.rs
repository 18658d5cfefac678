//! Meshes as grids of distances, for tools that are meshes (spec/sweepers.md, A.4).
//!
//! ```text
//!   +-----------------+   48 nodes along the longest side of the mesh's box, grown by a quarter of that side
//!   |                 |   all round; at the nodes the exact distance, 0 inside, as a 16-bit float; linear
//!   |     .----.      |   between them
//!   |    ( mesh )     |
//!   |     '----'      |   beyond the grid: the distance at its nearest point, and the way to that point
//!   +-----------------+
//! ```

use std::sync::Arc;

use glam::{DVec3, UVec3, Vec3};

use super::rims::rims;
use crate::displace::ToolShape;

/// Nodes along the longest side.
pub(super) const NODES: u32 = 48;
/// Room around the mesh on each side, as a part of its longest side.
pub(super) const MARGIN: f64 = 0.25;

/// Distances to a mesh in its own space: its box about the origin, its longest side 1.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceGrid {
    pub(super) nodes: UVec3,
    /// x fastest; each a number that a 16-bit float holds.
    pub(super) values: Vec<f32>,
    pub(super) is_open: bool,
    /// Closed lines that show its form, in its own space.
    rims: Vec<Vec<Vec3>>,
}

impl DistanceGrid {
    /// Side of a cell.
    pub const CELL: f64 = (1.0 + 2.0 * MARGIN) / (NODES - 1) as f64;

    /// A grid of parts that were [`DistanceGrid::nodes`] and [`DistanceGrid::values`]; `None` if they do not fit.
    pub fn from_parts(nodes: UVec3, values: Vec<f32>, is_open: bool) -> Option<Self> {
        let fits = nodes.min_element() >= 2
            && nodes.max_element() <= NODES
            && values.len() == nodes.element_product() as usize
            && values.iter().all(|value| value.is_finite());
        fits.then(|| Self {
            rims: rims(nodes, &values, Self::CELL as f32),
            nodes,
            values,
            is_open,
        })
    }

    /// Nodes along each axis.
    pub fn nodes(&self) -> UVec3 {
        self.nodes
    }

    /// The distances at the nodes, x fastest.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// True if a part of the mesh is open: it acts as a sheet.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// The distance of a place.
    pub fn distance(&self, q: DVec3) -> f64 {
        let last = (self.nodes - 1).as_dvec3();
        let at = q / Self::CELL + 0.5 * last;
        let near = at.clamp(DVec3::ZERO, last);
        let low = near.as_uvec3().min(self.nodes - 2);
        let part = near - low.as_dvec3();
        let [row, slice] = [self.nodes.x, self.nodes.x * self.nodes.y].map(|n| n as usize);
        let first = low.x as usize + row * low.y as usize + slice * low.z as usize;
        let value = |step: usize| f64::from(self.values[first + step]);
        let mix = |a: f64, b: f64, part: f64| a + (b - a) * part;
        let along_x = |step: usize| mix(value(step), value(step + 1), part.x);
        let along_y = |step: usize| mix(along_x(step), along_x(step + row), part.y);
        let own = mix(along_y(0), along_y(slice), part.z);
        own + (at - near).length() * Self::CELL
    }

    /// The distance of a place, and its gradient: differences over a cell, so that cells show no facets.
    pub fn distance_and_gradient(&self, q: DVec3) -> (f64, DVec3) {
        let across = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
            let half = axis * (0.5 * Self::CELL);
            (self.distance(q + half) - self.distance(q - half)) / Self::CELL
        });
        (self.distance(q), DVec3::from_array(across))
    }

    /// The grid as its shader reads it (shaders/displace/tools.wgsl): for each node but the last ones along x and y its
    /// value and those of its neighbours along x, along y and along both.
    pub fn texels(&self) -> impl Iterator<Item = [f32; 4]> + '_ {
        let [width, height, depth] = self.nodes.to_array().map(|n| n as usize);
        let value = move |x: usize, y: usize, z: usize| self.values[x + width * (y + height * z)];
        (0..depth).flat_map(move |z| {
            (0..height - 1).flat_map(move |y| {
                (0..width - 1).map(move |x| {
                    [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| value(x + i, y + j, z))
                })
            })
        })
    }

    /// Number of [`DistanceGrid::texels`].
    pub fn texel_count(&self) -> usize {
        let cells = self.nodes - UVec3::new(1, 1, 0);
        cells.element_product() as usize
    }
}

/// Grids of meshes, by the keys of their files ([`ToolFile::key`](crate::displace::ToolFile::key)).
pub type MeshGrids = Vec<(String, Arc<DistanceGrid>)>;

/// True if two lists have the same keys and share their grids in memory.
pub fn share_grids<K: PartialEq>(
    a: &[(K, Arc<DistanceGrid>)],
    b: &[(K, Arc<DistanceGrid>)],
) -> bool {
    let mut pairs = a.iter().zip(b);
    a.len() == b.len() && pairs.all(|((a, one), (b, other))| a == b && Arc::ptr_eq(one, other))
}

/// The grids that the tools of a document are made of, as far as they are there. Two are equal if they share their
/// grids in memory.
#[derive(Clone, Debug, Default)]
pub struct Grids {
    /// The grids of mesh files, by the files they come from.
    pub files: MeshGrids,
    /// Of the clay after so many of its strokes.
    pub baked: Vec<(u32, Arc<DistanceGrid>)>,
}

impl Grids {
    /// The grid of a tool of this shape, and its longest side; `None` for other shapes and for one that is not there.
    pub fn of(&self, shape: &ToolShape) -> Option<(&Arc<DistanceGrid>, f32)> {
        match shape {
            ToolShape::Mesh { file, longest } => {
                let key = file.key()?;
                let found = self.files.iter().find(|(known, _)| known == key);
                found.map(|(_, grid)| (grid, *longest))
            }
            ToolShape::Clay { strokes, longest } => {
                let found = self.baked.iter().find(|(known, _)| known == strokes);
                found.map(|(_, grid)| (grid, *longest))
            }
            _ => None,
        }
    }

    /// Lines that show the form of a tool, as [`ToolShape::outline`]; of a mesh whose grid is there the rims of its
    /// shadows along its axes.
    pub fn outline(&self, shape: &ToolShape) -> Vec<Vec<Vec3>> {
        match self.of(shape) {
            Some((grid, longest)) => {
                let sized = |line: &Vec<Vec3>| line.iter().map(|p| longest * *p).collect();
                grid.rims.iter().map(sized).collect()
            }
            None => shape.outline(),
        }
    }
}

impl PartialEq for Grids {
    fn eq(&self, other: &Self) -> bool {
        share_grids(&self.files, &other.files) && share_grids(&self.baked, &other.baked)
    }
}
