//! A surface as a few flat arrays, which travel between threads that share no memory.

use std::sync::Arc;

use glam::{DAffine3, UVec3, Vec3};

use super::carver::{Carver, CarverLevel};
use super::field::{FIELD_MARGIN, SurfaceField};
use super::tree::{Tree, TreeNode};
use super::triangle::Triangle;
use super::whole::{LID, MAX_SURFACE_SEGMENTS, Surface, SurfaceSegment, frame_of, segmentation_of};
use crate::data::Grid;
use crate::math::Aabb;

/// A surface in flat arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceArrays {
    /// Names of the segments.
    pub names: Vec<String>,
    /// Where the grids lie: twice twelve numbers, columns of an affine map.
    pub places: Vec<f64>,
    /// Corners and normals of triangles, boxes of nodes, depths, opacities of segments.
    pub numbers: Vec<f32>,
    /// Counts, voxels along the axes, nodes, sets, order of the triangles.
    pub indices: Vec<u32>,
    /// Colours and segments of triangles, fills of voxels, colours of segments and whether they are closed.
    pub bytes: Vec<u8>,
    /// Of an object that carves: half its box, cells, least distance, room and steps of its levels.
    pub carver_numbers: Vec<f32>,
    /// Of an object that carves: nodes of its levels along the axes; four numbers each, the last where they begin.
    pub carver_levels: Vec<u32>,
    /// Of an object that carves: the nodes of its levels.
    pub carver_texels: Vec<u32>,
}

impl SurfaceArrays {
    /// The arrays of a surface.
    pub fn of(surface: &Surface) -> Self {
        let (field, grid) = (&surface.field, &surface.segmentation.grid);
        let mut arrays = Self {
            places: [grid.world_from_voxel, field.rest_from_voxel]
                .iter()
                .flat_map(DAffine3::to_cols_array)
                .collect(),
            ..Self::default()
        };
        let counts = [
            surface.triangles.len(),
            surface.tree.nodes.len(),
            field.sets.len(),
        ];
        arrays.indices.extend(counts.map(|count| count as u32));
        arrays.indices.extend(grid.dims.to_array());
        arrays.indices.extend(field.dims.to_array());
        for node in &surface.tree.nodes {
            arrays.numbers.extend(node.bounds.min.to_array());
            arrays.numbers.extend(node.bounds.max.to_array());
            arrays.indices.extend([node.skip, node.first, node.count]);
        }
        for &set in &field.sets {
            let words = (0..4).map(|word| (set >> (32 * word)) as u32);
            arrays.indices.extend(words);
        }
        arrays.indices.extend(&surface.tree.order);
        for (triangle, normals) in surface.triangles.iter().zip(&surface.normals) {
            let all = triangle.0.iter().chain(normals);
            arrays
                .numbers
                .extend(all.flat_map(|place| place.to_array()));
        }
        arrays.numbers.extend(&field.depths);
        arrays
            .bytes
            .extend(surface.colors.as_flattened().as_flattened());
        arrays.bytes.extend(&surface.owners);
        arrays.bytes.extend(&field.fills);
        for segment in &surface.segments {
            arrays.names.push(segment.name.clone());
            arrays.numbers.push(segment.opacity);
            arrays.bytes.push(u8::from(segment.is_closed));
            arrays.bytes.extend(segment.mean_srgb);
        }
        if let Some(carver) = &surface.carver {
            let numbers = &mut arrays.carver_numbers;
            numbers.extend(carver.half.to_array());
            numbers.extend([carver.cell, carver.least, carver.room]);
            for level in &carver.levels {
                numbers.push(level.step);
                arrays.carver_levels.extend(level.nodes.to_array());
                arrays.carver_levels.push(level.first);
            }
            arrays.carver_texels.clone_from(&carver.texels);
        }
        arrays
    }

    /// What carves of the arrays, if it is whole.
    fn carver(&self) -> Option<Carver> {
        let (&[x, y, z, cell, least, room], steps) =
            self.carver_numbers.split_first_chunk::<6>()?;
        let (levels, []) = self.carver_levels.as_chunks::<4>() else {
            return None;
        };
        let mut total = 0;
        let mut level_of = |(&[x, y, z, first], &step): (&[u32; 4], &f32)| {
            let nodes = UVec3::new(x, y, z);
            let fits = u64::from(first) == total && nodes.max_element() < 1024;
            total += nodes.as_u64vec3().element_product();
            fits.then_some(CarverLevel { nodes, first, step })
        };
        let levels: Option<Vec<CarverLevel>> =
            levels.iter().zip(steps).map(&mut level_of).collect();
        let is_whole = steps.len() == levels.as_ref()?.len()
            && 4 * steps.len() == self.carver_levels.len()
            && total == self.carver_texels.len() as u64;
        is_whole.then(|| Carver {
            half: Vec3::new(x, y, z),
            cell,
            levels: levels.unwrap_or_default(),
            least,
            room,
            texels: self.carver_texels.clone(),
        })
    }

    /// The surface of the arrays; `None` if they are not those of a surface.
    pub fn surface(&self) -> Option<Surface> {
        let places = self.places.as_chunks::<12>().0;
        let [world_from_voxel, rest_from_voxel] =
            [places.first()?, places.get(1)?].map(DAffine3::from_cols_array);
        let mut indices = self.indices.iter().copied();
        let mut index = || indices.next();
        let [triangle_count, node_count, set_count] = [index()?, index()?, index()?];
        let mut dims = || Some(UVec3::new(index()?, index()?, index()?));
        let grid = Grid {
            dims: dims()?,
            world_from_voxel,
        };
        let field_dims = dims()?;
        let voxels = field_dims.as_u64vec3().element_product() as usize;
        if field_dims.max_element() > 1024 || self.bytes.len() < voxels {
            return None;
        }

        let mut numbers = self.numbers.iter().copied();
        let mut place = || Some(Vec3::new(numbers.next()?, numbers.next()?, numbers.next()?));
        let mut nodes = Vec::new();
        for _ in 0..node_count {
            let bounds = Aabb {
                min: place()?,
                max: place()?,
            };
            nodes.push(TreeNode {
                bounds,
                skip: indices.next()?,
                first: indices.next()?,
                count: indices.next()?,
            });
        }
        let mut sets = Vec::new();
        for _ in 0..set_count {
            let mut set = 0_u128;
            for word in 0..4 {
                set |= u128::from(indices.next()?) << (32 * word);
            }
            sets.push(set);
        }
        let order: Vec<u32> = indices.by_ref().take(triangle_count as usize).collect();
        let (mut triangles, mut normals) = (Vec::new(), Vec::new());
        for _ in 0..triangle_count {
            triangles.push(Triangle([place()?, place()?, place()?]));
            normals.push([place()?, place()?, place()?]);
        }
        let depths: Vec<f32> = numbers.by_ref().take(voxels).collect();

        let mut bytes = self.bytes.iter().copied();
        let mut color = || Some([bytes.next()?, bytes.next()?, bytes.next()?]);
        let mut colors = Vec::new();
        for _ in 0..triangle_count {
            colors.push([color()?, color()?, color()?]);
        }
        let owners: Vec<u8> = bytes.by_ref().take(triangle_count as usize).collect();
        let fills: Vec<u8> = bytes.by_ref().take(voxels).collect();
        let mut segments = Vec::new();
        for name in &self.names {
            segments.push(SurfaceSegment {
                name: name.clone(),
                opacity: numbers.next()?,
                is_closed: bytes.next()? != 0,
                mean_srgb: [bytes.next()?, bytes.next()?, bytes.next()?],
            });
        }
        let field = SurfaceField {
            dims: field_dims,
            rest_from_voxel,
            depths,
            fills,
            sets,
        };
        let is_whole = order.len() == triangles.len()
            && owners.len() == triangles.len()
            && field.depths.len() == voxels
            && field.fills.len() == voxels
            && segments.len() <= MAX_SURFACE_SEGMENTS
            && owners
                .iter()
                .all(|&owner| usize::from(owner & !LID) < segments.len())
            && field
                .fills
                .iter()
                .all(|&f| usize::from(f) < field.sets.len())
            && grid.dims + 2 * FIELD_MARGIN == field.dims;
        let segmentation = is_whole.then(|| segmentation_of(grid, &field, &segments))?;
        let carver = match self.carver_numbers.is_empty() {
            true => None,
            false => Some(Arc::new(self.carver()?)),
        };
        Some(Surface {
            frame: frame_of(&grid, field.rest_from_inner_voxel()),
            triangles,
            normals,
            colors,
            owners,
            tree: Tree { nodes, order },
            field,
            segments,
            segmentation,
            carver,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;
    use crate::data::{Mesh, MeshPart};

    #[test]
    fn a_surface_survives_its_arrays() {
        let (positions, triangles) = cube();
        let mesh = Mesh {
            positions,
            triangles,
            parts: vec![MeshPart {
                name: "cube".to_owned(),
                triangles: 0..12,
            }],
            ..Mesh::default()
        };
        let surface = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
        let surface = surface.carving(&mut |_| true).expect("not stopped");
        let arrays = SurfaceArrays::of(&surface);
        assert_eq!(arrays.surface().as_ref(), Some(&surface));
        // What is cut short anywhere is no surface, and nothing else happens.
        let mut short = arrays.clone();
        short.bytes.truncate(1000);
        assert_eq!(short.surface(), None);
        let mut short = arrays.clone();
        short.numbers.truncate(1000);
        assert_eq!(short.surface(), None);
        for len in [0, 2, 8, 20] {
            let mut short = arrays.clone();
            short.indices.truncate(len);
            assert_eq!(short.surface(), None);
        }
        assert_eq!(SurfaceArrays::default().surface(), None);
        let mut short = arrays.clone();
        short.carver_texels.pop();
        assert_eq!(short.surface(), None);
        let mut short = arrays.clone();
        short.carver_levels.pop();
        assert_eq!(short.surface(), None);
        let plain = SurfaceArrays {
            carver_numbers: Vec::new(),
            ..arrays
        };
        let plain = plain.surface().expect("whole without");
        assert_eq!(plain.carver, None);
    }
}
