//! Meshes as values: welded triangles in millimetres, with what the file gives their corners.

use std::ops::Range;

use glam::{Vec2, Vec3};

use crate::pictures::Picture;

/// Stands for an index where there is none.
pub const NO_INDEX: u32 = u32::MAX;

/// A surface of triangles, repaired. It is never changed afterwards: templates move what is drawn of it.
///
/// Triangles of one part follow each other. Every position is used by a triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Welded vertices, mm, RAS+; finite, no two of them equal.
    pub positions: Vec<Vec3>,
    /// Indices of three different positions for each triangle, counter-clockwise seen from its front.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals, RAS+, at most 90° off their triangle; at corners without one the renderer makes them.
    pub normals: Option<Corners<Vec3>>,
    /// Places in the texture, u to the right and v down, 0 to 1 over the picture.
    pub uvs: Option<Corners<Vec2>>,
    /// Vertex colours, linear light.
    pub colors: Option<Corners<Vec3>>,
    /// How colours of texture, vertices and material go together.
    pub coloring: Coloring,
    /// The parts, at least one, in the order of the file.
    pub parts: Vec<MeshPart>,
    /// Material of each triangle, an index into [`Mesh::materials`] or [`NO_INDEX`]; empty if there is no material.
    pub material_of: Vec<u32>,
    /// The materials that the file names.
    pub materials: Vec<MeshMaterial>,
    /// The pictures that materials name.
    pub textures: Vec<MeshTexture>,
}

/// Values at the corners of triangles. A value may be shared by many corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Corners<T> {
    /// The values, in the order of the file.
    pub values: Vec<T>,
    /// For each corner of each triangle an index into [`Corners::values`], or [`NO_INDEX`].
    pub at: Vec<[u32; 3]>,
}

impl<T: Copy> Corners<T> {
    /// The value at a corner, 0 to 2, of a triangle; `None` where the file has none.
    pub fn get(&self, triangle: usize, corner: usize) -> Option<T> {
        let index = *self.at.get(triangle)?.get(corner)?;
        self.values.get(index as usize).copied()
    }

    /// True if some corner has a value.
    pub fn has_any(&self) -> bool {
        self.at.iter().flatten().any(|&index| index != NO_INDEX)
    }
}

/// How the colour of a point comes from those that the file gives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coloring {
    /// The first of texture, vertex colour and material colour.
    #[default]
    First,
    /// The product of the three, as glTF has it.
    Product,
}

/// A named part of a mesh: one segment of the subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshPart {
    /// A name that no other part of the mesh has; `surface` where the file gives none.
    pub name: String,
    /// The triangles of the part.
    pub triangles: Range<usize>,
}

/// The material of triangles, as far as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshMaterial {
    /// Colour, linear light; white where the file gives none.
    pub color: Vec3,
    /// True if the file gives the colour.
    pub has_color: bool,
    /// Opacity of one crossing, 0 to 1.
    pub opacity: f32,
    /// Index of the picture, if there is one.
    pub texture: Option<u32>,
}

/// A picture on triangles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshTexture {
    /// The file of the picture: PNG or JPEG. Empty when it has been unpacked.
    pub packed: Vec<u8>,
    /// Its pixels, opaque; `None` before it is unpacked, and if that is not possible.
    pub picture: Option<Picture>,
    /// Width and height by the picture's header, pixels.
    pub size: [u32; 2],
    /// What is there outside 0 to 1, along u and v.
    pub wrap: [Wrap; 2],
}

/// How a texture goes on outside its picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The picture again, every second time mirrored.
    Mirror,
    /// The colour of its border.
    Clamp,
}

impl Mesh {
    /// The three places of a triangle, mm, RAS+.
    pub fn corners_of(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        // Every index of a repaired mesh is there.
        triangle.map(|index| self.positions[index as usize])
    }

    /// Index of the texture of a triangle that has places in it at all corners.
    pub fn texture_of(&self, triangle: usize) -> Option<usize> {
        let uvs = self.uvs.as_ref()?;
        let material = *self.material_of.get(triangle)?;
        let texture = self.materials.get(material as usize)?.texture?;
        let has_places = (0..3).all(|corner| uvs.get(triangle, corner).is_some());
        has_places.then_some(texture as usize)
    }

    /// Orders the triangles by parts: `part_of` has an index into `names` for each triangle. Parts without triangles
    /// are left out; the order within a part stays.
    pub fn group(&mut self, part_of: &[u32], names: &[String]) {
        let mut order: Vec<u32> = (0..self.triangles.len() as u32).collect();
        order.sort_by_key(|&triangle| part_of[triangle as usize]);
        let sorted = |of: &[[u32; 3]]| order.iter().map(|&i| of[i as usize]).collect();
        self.triangles = sorted(&self.triangles);
        if let Some(normals) = &mut self.normals {
            normals.at = sorted(&normals.at);
        }
        if let Some(uvs) = &mut self.uvs {
            uvs.at = sorted(&uvs.at);
        }
        if let Some(colors) = &mut self.colors {
            colors.at = sorted(&colors.at);
        }
        if !self.material_of.is_empty() {
            let sorted = order.iter().map(|&i| self.material_of[i as usize]);
            self.material_of = sorted.collect();
        }
        self.parts.clear();
        let mut start = 0;
        for run in order.chunk_by(|&a, &b| part_of[a as usize] == part_of[b as usize]) {
            let name = names.get(part_of[run[0] as usize] as usize);
            self.parts.push(MeshPart {
                name: name.cloned().unwrap_or_default(),
                triangles: start..start + run.len(),
            });
            start += run.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grouping_takes_everything_of_a_triangle_along() {
        let mut mesh = Mesh {
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
            colors: Some(Corners {
                values: vec![Vec3::X, Vec3::Y],
                at: vec![[0; 3], [1; 3], [NO_INDEX; 3]],
            }),
            material_of: vec![5, 6, 7],
            ..Mesh::default()
        };
        mesh.group(&[2, 0, 2], &["a".into(), "none".into(), "c".into()]);
        assert_eq!(mesh.triangles, [[3, 4, 5], [0, 1, 2], [6, 7, 8]]);
        assert_eq!(mesh.material_of, [6, 5, 7]);
        let colors = mesh.colors.expect("kept");
        assert_eq!(colors.get(0, 2), Some(Vec3::Y));
        assert_eq!((colors.get(1, 0), colors.get(2, 0)), (Some(Vec3::X), None));
        let parts: Vec<_> = mesh
            .parts
            .iter()
            .map(|p| (&*p.name, p.triangles.clone()))
            .collect();
        assert_eq!(parts, [("a", 0..1), ("c", 1..3)]);
    }
}
