//! Pictures on the triangles of a surface.

use glam::{Vec2, Vec3};

use super::tree::in_order;
use crate::data::mesh::{Mesh, Wrap};
use crate::math::linear_from_srgb;
use crate::pictures::{Picture, smaller_copies};

/// Places in a picture farther from it than this, in pictures, are no places: a shader counts texels in 32-bit floats.
const MAX_PLACE: f32 = 1e4;
/// The mean of a picture over a triangle is taken from a copy in which the triangle has no more texels than this.
const TEXELS_OF_MEAN: f32 = 8.0;

/// The pictures of a surface, and where each triangle lies in them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceTextures {
    /// The pictures that triangles use.
    pub pictures: Vec<SurfacePicture>,
    /// For each triangle an index into `pictures`, from 1; 0 for none.
    pub picture_of: Vec<u16>,
    /// Places of the corners of each triangle in its picture, u to the right and v down, 0 to 1 over the picture.
    pub uvs: Vec<[Vec2; 3]>,
}

/// A picture on triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePicture {
    /// What is there outside 0 to 1, along u and v.
    pub wrap: [Wrap; 2],
    /// The picture, and copies of it, each half as large as the one before; all opaque.
    pub copies: Vec<Picture>,
}

impl SurfaceTextures {
    /// Those of several meshes, whose triangles follow each other; `None` if no triangle has a picture.
    pub(super) fn of(meshes: &[(&Mesh, Option<f32>)]) -> Option<Self> {
        let mut all = Self::default();
        for (mesh, _) in meshes {
            let mut number_of = vec![0; mesh.textures.len()];
            for triangle in 0..mesh.triangles.len() {
                let (number, places) = match placed(mesh, triangle) {
                    None => (0, [Vec2::ZERO; 3]),
                    Some((texture, picture, places)) => {
                        if number_of[texture] == 0 {
                            all.pictures.push(SurfacePicture {
                                wrap: mesh.textures[texture].wrap,
                                copies: smaller_copies(picture.clone()),
                            });
                            number_of[texture] = all.pictures.len() as u16;
                        }
                        (number_of[texture], places)
                    }
                };
                all.picture_of.push(number);
                all.uvs.push(places);
            }
        }
        (!all.pictures.is_empty()).then_some(all)
    }

    /// Bytes of the pictures and their smaller copies.
    pub fn byte_len(&self) -> u64 {
        let copies = self.pictures.iter().flat_map(|picture| &picture.copies);
        copies.map(Picture::byte_len).sum()
    }

    /// The picture of a triangle.
    fn picture(&self, triangle: usize) -> Option<&SurfacePicture> {
        let number = usize::from(*self.picture_of.get(triangle)?);
        self.pictures.get(number.checked_sub(1)?)
    }

    /// Mean of the picture over a triangle, linear light; white where there is none.
    pub(super) fn mean_over(&self, triangle: usize) -> Vec3 {
        let Some(picture) = self.picture(triangle) else {
            return Vec3::ONE;
        };
        let [a, b, c] = self.uvs[triangle];
        let size_of = |copy: &Picture| Vec2::from(copy.size.map(|side| side as f32));
        let area_in = |copy: &Picture| {
            let size = size_of(copy);
            0.5 * ((b - a) * size).perp_dot((c - a) * size).abs()
        };
        let coarse_enough = |copy: &&Picture| area_in(copy) <= TEXELS_OF_MEAN;
        let copy = picture.copies.iter().find(coarse_enough);
        let Some(copy) = copy.or(picture.copies.last()) else {
            return Vec3::ONE;
        };
        // In the middle of each quarter.
        let places = [
            (a + b + c) / 3.0,
            a * (2.0 / 3.0) + (b + c) / 6.0,
            b * (2.0 / 3.0) + (c + a) / 6.0,
            c * (2.0 / 3.0) + (a + b) / 6.0,
        ];
        let sum: Vec3 = places
            .iter()
            .map(|place| {
                let at = (*place * size_of(copy)).floor().to_array();
                let [x, y] = [0, 1]
                    .map(|axis| wrapped(at[axis] as i64, copy.size[axis], picture.wrap[axis]));
                let [r, g, b, _] = copy.pixels[(x + copy.size[0] * y) as usize];
                Vec3::from([r, g, b].map(linear_from_srgb))
            })
            .sum();
        sum / places.len() as f32
    }

    /// Turns a triangle over.
    pub(super) fn swap(&mut self, triangle: usize) {
        self.uvs[triangle].swap(1, 2);
    }

    /// The same with each triangle in as many parts; `parts_of` has the places of the parts by those of a triangle.
    pub(super) fn parted<const N: usize>(
        &self,
        parts_of: impl Fn([Vec2; 3]) -> [[Vec2; 3]; N],
    ) -> Self {
        Self {
            pictures: self.pictures.clone(),
            picture_of: self.picture_of.iter().flat_map(|&of| [of; N]).collect(),
            uvs: self
                .uvs
                .iter()
                .flat_map(|&places| parts_of(places))
                .collect(),
        }
    }

    /// Adds a triangle without a picture.
    pub(super) fn push_plain(&mut self) {
        self.picture_of.push(0);
        self.uvs.push([Vec2::ZERO; 3]);
    }

    /// The same triangles in another order.
    pub(super) fn in_order(mut self, order: &[u32]) -> Self {
        self.picture_of = in_order(order, &self.picture_of);
        self.uvs = in_order(order, &self.uvs);
        self
    }
}

/// The texture of a triangle that has been unpacked, its picture, and the places of the corners in it. Those of
/// repeated pictures are taken near to the picture, where floats are fine.
pub(super) fn placed(mesh: &Mesh, triangle: usize) -> Option<(usize, &Picture, [Vec2; 3])> {
    let index = mesh.texture_of(triangle)?;
    let texture = mesh.textures.get(index)?;
    let picture = texture.picture.as_ref()?;
    let uvs = mesh.uvs.as_ref()?;
    let mut places = [Vec2::ZERO; 3];
    for (corner, place) in places.iter_mut().enumerate() {
        *place = uvs.get(triangle, corner)?;
    }
    let least = places[0].min(places[1]).min(places[2]).to_array();
    let shift = [0, 1].map(|axis| match texture.wrap[axis] {
        Wrap::Repeat => least[axis].floor(),
        Wrap::Mirror => 2.0 * (0.5 * least[axis]).floor(),
        Wrap::Clamp => 0.0,
    });
    let places = places.map(|place| place - Vec2::from(shift));
    let is_near = |place: &Vec2| place.abs().max_element() <= MAX_PLACE;
    places
        .iter()
        .all(is_near)
        .then_some((index, picture, places))
}

/// The texel that stands for one outside of a picture, along one axis; shaders/textures.wgsl does the same.
fn wrapped(texel: i64, size: u32, wrap: Wrap) -> u32 {
    let size = i64::from(size);
    let inside = match wrap {
        Wrap::Repeat => texel.rem_euclid(size),
        Wrap::Mirror => {
            let in_two = texel.rem_euclid(2 * size);
            in_two.min(2 * size - 1 - in_two)
        }
        Wrap::Clamp => texel.clamp(0, size - 1),
    };
    inside as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_outside_are_those_of_the_picture() {
        let row = |wrap| [-3, -1, 0, 3, 4, 9].map(|texel| wrapped(texel, 4, wrap));
        assert_eq!(row(Wrap::Repeat), [1, 3, 0, 3, 0, 1]);
        assert_eq!(row(Wrap::Mirror), [2, 0, 0, 3, 3, 1]);
        assert_eq!(row(Wrap::Clamp), [0, 0, 0, 3, 3, 3]);
    }
}
