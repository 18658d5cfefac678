//! A surface as a few flat arrays, which travel between threads that share no memory. Those of triangles and voxels
//! become the surface's own without a copy, so that the thread that draws does not wait for them.

use std::sync::Arc;

use bytemuck::allocation::try_cast_vec;
use glam::{DAffine3, UVec3, Vec2, Vec3};

use super::carver::{Carver, CarverLevel};
use super::field::{FIELD_MARGIN, SurfaceField};
use super::grid::DistanceGrid;
use super::textures::{SurfacePicture, SurfaceTextures};
use super::tree::{Tree, TreeNode};
use super::triangle::Triangle;
use super::whole::{LID, MAX_SURFACE_SEGMENTS, Surface, SurfaceSegment, frame_of, segmentation_of};
use crate::data::{Grid, Wrap};
use crate::math::Aabb;
use crate::pictures::Picture;

/// A surface in flat arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceArrays {
    /// Names of the segments.
    pub names: Vec<String>,
    /// Where the grids lie: twice twelve numbers, columns of an affine map; then the opacities of the segments.
    pub places: Vec<f64>,
    /// Voxels along the axes of both grids, the number of sets, the sets, the number of pictures, and for each picture
    /// its size and how it goes on outside; then the colour of each segment and whether it is closed.
    pub indices: Vec<u32>,
    /// Nodes of the tree: least and greatest place as bits, skip, first and count.
    pub nodes: Vec<u32>,
    /// Order of the triangles.
    pub order: Vec<u32>,
    /// Corners of the triangles.
    pub corners: Vec<f32>,
    /// Normals at the corners.
    pub normals: Vec<f32>,
    /// Colours at the corners.
    pub colors: Vec<u8>,
    /// Segments of the triangles.
    pub owners: Vec<u8>,
    /// Depths of the field's voxels.
    pub depths: Vec<f32>,
    /// Fills of the field's voxels.
    pub fills: Vec<u8>,
    /// Places of the corners in pictures; empty if there are no pictures.
    pub uvs: Vec<f32>,
    /// The picture of each triangle; empty if there are no pictures.
    pub picture_of: Vec<u16>,
    /// Pixels of pictures and their copies.
    pub pixels: Vec<u8>,
    /// Of an object that carves: half its box, cells, least distance, room and steps of its levels.
    pub carver_numbers: Vec<f32>,
    /// Of an object that carves: nodes of its levels along the axes; four numbers each, the last where they begin.
    pub carver_levels: Vec<u32>,
    /// Of an object that carves: the nodes of its levels.
    pub carver_texels: Vec<u32>,
    /// Of each grid of distances the strokes, the nodes along the axes, and 1 if it is open.
    pub grid_sides: Vec<u32>,
    /// The nodes of all grids of distances.
    pub grid_values: Vec<f32>,
}

impl SurfaceArrays {
    /// The arrays of a surface.
    pub fn of(surface: &Surface) -> Self {
        let (field, grid) = (&surface.field, &surface.segmentation.grid);
        let floats = |corners: &[[Vec3; 3]]| bytemuck::cast_slice(corners).to_vec();
        let mut arrays = Self {
            places: [grid.world_from_voxel, field.rest_from_voxel]
                .iter()
                .flat_map(DAffine3::to_cols_array)
                .collect(),
            order: surface.tree.order.clone(),
            corners: bytemuck::cast_slice(&surface.triangles).to_vec(),
            normals: floats(&surface.normals),
            colors: surface.colors.as_flattened().as_flattened().to_vec(),
            owners: surface.owners.clone(),
            depths: field.depths.clone(),
            fills: field.fills.clone(),
            ..Self::default()
        };
        for node in &surface.tree.nodes {
            let places = [node.bounds.min, node.bounds.max];
            let bits = places.iter().flat_map(|place| place.to_array());
            arrays.nodes.extend(bits.map(f32::to_bits));
            arrays.nodes.extend([node.skip, node.first, node.count]);
        }
        let indices = &mut arrays.indices;
        indices.extend(grid.dims.to_array());
        indices.extend(field.dims.to_array());
        indices.push(field.sets.len() as u32);
        for &set in &field.sets {
            indices.extend((0..4).map(|word| (set >> (32 * word)) as u32));
        }
        let textures = surface.textures.as_ref();
        indices.push(textures.map_or(0, |textures| textures.pictures.len() as u32));
        if let Some(textures) = textures {
            for picture in &textures.pictures {
                indices.extend(picture.copies.first().map_or([0; 2], |copy| copy.size));
                indices.extend(picture.wrap.map(|wrap| wrap as u32));
                for copy in &picture.copies {
                    arrays.pixels.extend(copy.pixels.as_flattened());
                }
            }
            arrays.uvs = bytemuck::cast_slice(&textures.uvs).to_vec();
            arrays.picture_of.clone_from(&textures.picture_of);
        }
        for segment in &surface.segments {
            arrays.names.push(segment.name.clone());
            arrays.places.push(segment.opacity.into());
            let [r, g, b] = segment.mean_srgb;
            let closed = u8::from(segment.is_closed);
            indices.push(u32::from_le_bytes([r, g, b, closed]));
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
        for (strokes, grid) in &surface.grids {
            arrays.grid_sides.push(*strokes);
            arrays.grid_sides.extend(grid.nodes().to_array());
            arrays.grid_sides.push(grid.is_open().into());
            arrays.grid_values.extend(grid.values());
        }
        arrays
    }

    /// Takes what carves out of the arrays, if it is whole.
    fn carver(&mut self) -> Option<Carver> {
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
            texels: std::mem::take(&mut self.carver_texels),
        })
    }

    /// The grids of distances of the arrays, if they are whole.
    fn grids(&self) -> Option<Vec<(u32, Arc<DistanceGrid>)>> {
        let (sides, []) = self.grid_sides.as_chunks::<5>() else {
            return None;
        };
        let mut values = self.grid_values.as_slice();
        let mut grid_of = |&[strokes, x, y, z, is_open]: &[u32; 5]| {
            let nodes = UVec3::new(x, y, z);
            let count = usize::try_from(nodes.as_u64vec3().element_product()).ok()?;
            let (own, rest) = values.split_at_checked(count)?;
            values = rest;
            let grid = DistanceGrid::from_parts(nodes, own.to_vec(), is_open != 0)?;
            Some((strokes, Arc::new(grid)))
        };
        let grids: Option<Vec<_>> = sides.iter().map(&mut grid_of).collect();
        grids.filter(|_| values.is_empty())
    }

    /// The surface of the arrays; `None` if they are not those of a surface.
    pub fn into_surface(mut self) -> Option<Surface> {
        let carver = match self.carver_numbers.is_empty() {
            true => None,
            false => Some(Arc::new(self.carver()?)),
        };
        let grids = self.grids()?;
        let (places, opacities) = self.places.split_at_checked(24)?;
        let places = places.as_chunks::<12>().0;
        let [world_from_voxel, rest_from_voxel] =
            [places.first()?, places.get(1)?].map(DAffine3::from_cols_array);
        let mut indices = self.indices.iter().copied();
        let mut index = || indices.next();
        let mut dims = || Some(UVec3::new(index()?, index()?, index()?));
        let grid = Grid {
            dims: dims()?,
            world_from_voxel,
        };
        let field_dims = dims()?;
        let voxels = field_dims.as_u64vec3().element_product() as usize;
        if field_dims.max_element() > 1024 {
            return None;
        }
        let mut sets = Vec::new();
        for _ in 0..index()? {
            let mut set = 0_u128;
            for word in 0..4 {
                set |= u128::from(index()?) << (32 * word);
            }
            sets.push(set);
        }
        let mut sizes = Vec::new();
        for _ in 0..index()? {
            let size = [index()?, index()?];
            sizes.push((size, [wrap_of(index()?)?, wrap_of(index()?)?]));
        }
        let mut segments = Vec::new();
        for (name, opacity) in self.names.iter().zip(opacities) {
            let [r, g, b, closed] = index()?.to_le_bytes();
            segments.push(SurfaceSegment {
                name: name.clone(),
                opacity: *opacity as f32,
                is_closed: closed != 0,
                mean_srgb: [r, g, b],
            });
        }
        let nodes = self.nodes.as_chunks::<9>().0.iter().map(|node| {
            let [a, b, c, d, e, f, skip, first, count] = *node;
            let place = |bits: [u32; 3]| Vec3::from(bits.map(f32::from_bits));
            TreeNode {
                bounds: Aabb {
                    min: place([a, b, c]),
                    max: place([d, e, f]),
                },
                skip,
                first,
                count,
            }
        });
        let nodes = nodes.collect();
        let triangles: Vec<Triangle> = try_cast_vec(self.corners).ok()?;
        let normals: Vec<[Vec3; 3]> = try_cast_vec(self.normals).ok()?;
        let colors: Vec<[[u8; 3]; 3]> = try_cast_vec(self.colors).ok()?;
        let count = triangles.len();
        let textures = match sizes.is_empty() {
            true => None,
            false => Some(SurfaceTextures {
                pictures: pictures_of(&sizes, &self.pixels)?,
                picture_of: self.picture_of,
                uvs: try_cast_vec::<f32, [Vec2; 3]>(self.uvs).ok()?,
            }),
        };
        let has_pictures = |textures: &SurfaceTextures| {
            let known = |of: &u16| usize::from(*of) <= textures.pictures.len();
            let counts = [textures.picture_of.len(), textures.uvs.len()];
            counts == [count; 2] && textures.picture_of.iter().all(known)
        };
        let field = SurfaceField {
            dims: field_dims,
            rest_from_voxel,
            depths: self.depths,
            fills: self.fills,
            sets,
        };
        let counts = [
            self.order.len(),
            self.owners.len(),
            normals.len(),
            colors.len(),
        ];
        let is_whole = counts == [count; 4]
            && textures.as_ref().is_none_or(has_pictures)
            && field.depths.len() == voxels
            && field.fills.len() == voxels
            && segments.len() == self.names.len()
            && segments.len() <= MAX_SURFACE_SEGMENTS
            && self
                .owners
                .iter()
                .all(|&owner| usize::from(owner & !LID) < segments.len())
            && field
                .fills
                .iter()
                .all(|&f| usize::from(f) < field.sets.len())
            && grid.dims + 2 * FIELD_MARGIN == field.dims;
        let segmentation = is_whole.then(|| segmentation_of(grid, &field, &segments))?;
        Some(Surface {
            frame: frame_of(&grid, field.rest_from_inner_voxel()),
            triangles,
            normals,
            colors,
            textures,
            owners: self.owners,
            tree: Tree {
                nodes,
                order: self.order,
            },
            field,
            segments,
            segmentation,
            carver,
            grids,
        })
    }
}

/// Pictures of these sizes, with their copies; `None` if there are not enough pixels.
fn pictures_of(sizes: &[([u32; 2], [Wrap; 2])], mut pixels: &[u8]) -> Option<Vec<SurfacePicture>> {
    let mut pictures = Vec::new();
    for &(mut size, wrap) in sizes {
        let mut copies = Vec::new();
        loop {
            let bytes = u64::from(size[0]) * u64::from(size[1]);
            let bytes = usize::try_from(bytes.checked_mul(4)?).ok()?;
            let (own, rest) = pixels.split_at_checked(bytes)?;
            pixels = rest;
            copies.push(Picture {
                size,
                pixels: own.as_chunks().0.to_vec(),
                is_of_inks: false,
            });
            if size.iter().all(|side| *side <= 1) {
                break;
            }
            size = size.map(|side| (side / 2).max(1));
        }
        pictures.push(SurfacePicture { wrap, copies });
    }
    Some(pictures)
}

/// What is there outside of a picture, from its number.
fn wrap_of(number: u32) -> Option<Wrap> {
    let all = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
    all.into_iter().find(|wrap| *wrap as u32 == number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;
    use crate::data::{Corners, Mesh, MeshMaterial, MeshPart, MeshTexture};

    /// A cube, two sides of which have a picture.
    fn painted() -> Surface {
        let (positions, triangles) = cube();
        let picture = Picture {
            size: [3, 2],
            pixels: (0..6).map(|k| [40 * k, 7, 9, 255]).collect(),
            is_of_inks: false,
        };
        let material = |texture| MeshMaterial {
            color: Vec3::ONE,
            has_color: false,
            opacity: 0.5,
            texture,
        };
        let mesh = Mesh {
            positions,
            uvs: Some(Corners {
                values: vec![Vec2::ZERO, Vec2::X, Vec2::new(2.25, -0.5)],
                at: vec![[0, 1, 2]; triangles.len()],
            }),
            material_of: (0..12).map(|k| u32::from(k < 4)).collect(),
            materials: vec![material(None), material(Some(0))],
            textures: vec![MeshTexture {
                packed: Vec::new(),
                size: picture.size,
                wrap: [Wrap::Mirror, Wrap::Clamp],
                picture: Some(picture),
            }],
            triangles,
            parts: vec![MeshPart {
                name: "cube".to_owned(),
                triangles: 0..12,
            }],
            ..Mesh::default()
        };
        Surface::new(&mesh, None, &mut |_| true).expect("it has a size")
    }

    #[test]
    fn a_surface_survives_its_arrays() {
        let surface = painted();
        let textures = surface.textures.as_ref().expect("pictures");
        let painted = textures.picture_of.iter().filter(|of| **of == 1).count();
        assert_eq!((painted, textures.pictures[0].copies.len()), (4, 2));
        let plain = Surface {
            textures: None,
            ..surface.clone()
        };
        let carving = surface.clone().carving(&mut |_| true).expect("not stopped");
        assert!(carving.carver.is_some());
        let sweeping = surface
            .clone()
            .sweeping(&mut |_| true)
            .expect("not stopped");
        for surface in [&surface, &plain, &carving, &sweeping] {
            let arrays = SurfaceArrays::of(surface);
            assert_eq!(arrays.into_surface().as_ref(), Some(surface));
        }
        // What is cut short anywhere is no surface, and nothing else happens.
        let arrays = SurfaceArrays::of(&surface);
        let cuts: [&dyn Fn(&mut SurfaceArrays); 15] = [
            &|arrays| arrays.places.truncate(20),
            &|arrays| arrays.places.truncate(24),
            &|arrays| arrays.names.clear(),
            &|arrays| arrays.indices.truncate(5),
            &|arrays| arrays.indices.truncate(13),
            &|arrays| arrays.order.truncate(3),
            &|arrays| arrays.corners.truncate(9),
            &|arrays| arrays.corners.truncate(8),
            &|arrays| arrays.normals.truncate(9),
            &|arrays| arrays.colors.truncate(9),
            &|arrays| arrays.owners.truncate(3),
            &|arrays| arrays.depths.truncate(100),
            &|arrays| arrays.fills.truncate(100),
            &|arrays| arrays.uvs.truncate(6),
            &|arrays| arrays.pixels.truncate(20),
        ];
        for (number, cut) in cuts.iter().enumerate() {
            let mut short = arrays.clone();
            cut(&mut short);
            // A surface of another number of segments is told by the owners of its triangles.
            assert_eq!(short.into_surface(), None, "cut {number}");
        }
        assert_eq!(SurfaceArrays::default().into_surface(), None);
        let arrays = SurfaceArrays::of(&carving);
        let cuts: [&dyn Fn(&mut SurfaceArrays); 3] = [
            &|arrays| {
                arrays
                    .carver_texels
                    .truncate(arrays.carver_texels.len() - 1)
            },
            &|arrays| {
                arrays
                    .carver_levels
                    .truncate(arrays.carver_levels.len() - 1)
            },
            &|arrays| {
                arrays
                    .carver_numbers
                    .truncate(arrays.carver_numbers.len() - 1)
            },
        ];
        for (number, cut) in cuts.iter().enumerate() {
            let mut short = arrays.clone();
            cut(&mut short);
            assert_eq!(short.into_surface(), None, "cut {number} of what carves");
        }
        let of_tool = SurfaceArrays::of(&sweeping);
        let cuts: [&dyn Fn(&mut SurfaceArrays); 4] = [
            &|arrays| arrays.grid_values.truncate(7),
            &|arrays| arrays.grid_values.push(0.0),
            &|arrays| arrays.grid_sides.truncate(4),
            &|arrays| arrays.grid_sides[1] = u32::MAX,
        ];
        for (number, cut) in cuts.iter().enumerate() {
            let mut short = of_tool.clone();
            cut(&mut short);
            assert_eq!(short.into_surface(), None, "cut {number} of a grid");
        }
        let without = SurfaceArrays {
            carver_numbers: Vec::new(),
            ..arrays
        };
        assert_eq!(without.into_surface().expect("whole without").carver, None);
    }

    #[test]
    fn pictures_are_on_the_triangles_that_they_came_with() {
        let textures = painted().textures.expect("pictures");
        let first = textures.picture_of.iter().position(|of| *of == 1);
        let [a, ..] = textures.uvs[first.expect("a painted one")];
        // Mirrored along u: two pictures further is the same place.
        assert!(a.x >= 0.0 && a.x < 2.0, "{a}");
        let mean = textures.mean_over(first.expect("a painted one"));
        assert!(mean.x > 0.0 && mean.x < 1.0 && mean.y < 0.01, "{mean}");
    }
}
