//! Trees, triangles and pictures of meshes as texels, as shaders/subject/mesh.wgsl, shaders/objects.wgsl and
//! shaders/textures.wgsl read them.

use std::ops::Range;

use glam::{Vec2, Vec3};

use crate::data::{Surface, TreeNode, Wrap};
use crate::math::Aabb;
use crate::pictures::Picture;

/// Bits of a leaf that hold the number of triangles in it, and the bit that marks a leaf.
const COUNT_BITS: u32 = 4;
const LEAF: u32 = 1 << 31;
/// Texels of a tree before its nodes: the box that the boxes of the nodes are parts of.
pub(crate) const ROOT_TEXELS: u32 = 2;
/// Parts of that box along each axis, to which the boxes of nodes are rounded outwards.
const NODE_PARTS: f32 = 65535.0;

/// Where the triangles of a mesh begin among its texels: behind the box of its tree and a texel for each node.
pub(crate) fn triangles_at(surface: &Surface) -> u32 {
    ROOT_TEXELS + surface.tree.nodes.len() as u32
}

/// How many texels the tree and the triangles of a mesh take: four per triangle.
pub(crate) fn texels_of(surface: &Surface) -> u32 {
    triangles_at(surface) + 4 * surface.triangles.len() as u32
}

/// Items of a piece at most: as many as are packed within a few milliseconds.
const ITEMS_OF_PIECE: usize = 1 << 14;

/// What a mesh's texels are made of: the box of its tree, nodes, triangles, sets of segments, and of its pictures the
/// places of triangles in them, and for each its header and the pixels of its copies.
#[derive(Clone, Debug)]
enum Piece {
    Root,
    Nodes(Range<usize>),
    Triangles(Range<usize>),
    Sets,
    Places(Range<usize>),
    Header(usize),
    Pixels(usize, usize, Range<usize>),
}

/// The texels of a mesh, piece by piece, so that no frame waits for all of them.
#[derive(Debug)]
pub(crate) struct MeshTexels {
    pieces: std::vec::IntoIter<Piece>,
    count: usize,
    /// Places of the pictures' headers, counted from the first texel of the pictures.
    headers: Vec<u32>,
}

impl MeshTexels {
    /// Of a mesh's tree and triangles, `with_sets` its sets of segments behind them, and `with_pictures` its pictures.
    pub(crate) fn of(surface: &Surface, with_sets: bool, with_pictures: bool) -> Self {
        let mut pieces = vec![Piece::Root];
        let ranges = |count: usize| {
            let starts = (0..count).step_by(ITEMS_OF_PIECE);
            starts.map(move |start| start..(start + ITEMS_OF_PIECE).min(count))
        };
        pieces.extend(ranges(surface.tree.nodes.len()).map(Piece::Nodes));
        pieces.extend(ranges(surface.triangles.len()).map(Piece::Triangles));
        if with_sets {
            pieces.push(Piece::Sets);
        }
        let mut headers = Vec::new();
        if let Some(textures) = surface.textures.as_ref().filter(|_| with_pictures) {
            pieces.extend(ranges(textures.uvs.len()).map(Piece::Places));
            let mut next = 2 * textures.uvs.len() as u32;
            for (index, picture) in textures.pictures.iter().enumerate() {
                headers.push(next);
                next += 1 + picture.copies.iter().map(texels_of_copy).sum::<u32>();
                pieces.push(Piece::Header(index));
                for (number, copy) in picture.copies.iter().enumerate() {
                    let ranges = ranges(copy.pixels.len());
                    pieces.extend(ranges.map(|range| Piece::Pixels(index, number, range)));
                }
            }
        }
        Self {
            count: pieces.len(),
            pieces: pieces.into_iter(),
            headers,
        }
    }

    /// Fraction done, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        1.0 - self.pieces.len() as f32 / self.count.max(1) as f32
    }

    /// Adds the texels of the next piece of the mesh that this was made of. False if there is none.
    pub(crate) fn pack_next(&mut self, surface: &Surface, texels: &mut Vec<[u32; 4]>) -> bool {
        let Some(piece) = self.pieces.next() else {
            return false;
        };
        self.pack(surface, piece, texels);
        true
    }

    /// Adds all texels that are left.
    pub(crate) fn pack_all(mut self, surface: &Surface, texels: &mut Vec<[u32; 4]>) {
        while self.pack_next(surface, texels) {}
    }

    fn pack(&self, surface: &Surface, piece: Piece, texels: &mut Vec<[u32; 4]>) {
        match (piece, &surface.textures) {
            (Piece::Root, _) => {
                let root = root_of(surface);
                texels.extend([with(root.min, 0), with(root.max, 0)]);
            }
            (Piece::Nodes(range), _) => {
                let root = root_of(surface);
                texels.extend(
                    surface.tree.nodes[range]
                        .iter()
                        .map(|n| packed_node(n, root)),
                );
            }
            (Piece::Triangles(range), _) => range.for_each(|i| pack_triangle(surface, i, texels)),
            (Piece::Sets, _) => texels.extend(
                (surface.field.sets.iter())
                    .map(|set| std::array::from_fn(|word| (set >> (32 * word)) as u32)),
            ),
            (Piece::Places(range), Some(textures)) => {
                let all = textures.uvs.iter().zip(&textures.picture_of);
                for ([a, b, c], &picture) in all.skip(range.start).take(range.len()) {
                    let index = usize::from(picture).checked_sub(1);
                    let header = index.map_or(0, |index| self.headers[index]);
                    texels.push([a.x, a.y, b.x, b.y].map(f32::to_bits));
                    texels.push([c.x.to_bits(), c.y.to_bits(), header, 0]);
                }
            }
            (Piece::Header(index), Some(textures)) => {
                let picture = &textures.pictures[index];
                let [width, height] = picture.copies.first().map_or([0; 2], |copy| copy.size);
                let [u, v] = picture.wrap.map(|wrap| match wrap {
                    Wrap::Repeat => 0,
                    Wrap::Mirror => 1,
                    Wrap::Clamp => 2,
                });
                let rest = u32::from_le_bytes([u, v, picture.copies.len() as u8, 0]);
                texels.push([width, height, rest, self.headers[index] + 1]);
            }
            (Piece::Pixels(index, copy, range), Some(textures)) => {
                let copy = &textures.pictures[index].copies[copy];
                texels.extend(copy.pixels[range].chunks(4).map(|four| {
                    let word = |rgba: &[u8; 4]| u32::from_le_bytes(*rgba);
                    std::array::from_fn(|k| four.get(k).map_or(0, word))
                }));
            }
            // Pieces of pictures are made of those that are there.
            (_, None) => {}
        }
    }
}

fn with(place: Vec3, last: u32) -> [u32; 4] {
    let [x, y, z] = place.to_array().map(f32::to_bits);
    [x, y, z, last]
}

fn pack_triangle(surface: &Surface, i: usize, texels: &mut Vec<[u32; 4]>) {
    let corners = surface.triangles[i].0.iter();
    for (corner, normal) in corners.zip(surface.normals[i]) {
        texels.push(with(*corner, octahedral(normal)));
    }
    let [a, b, c] = surface.colors[i].map(|[r, g, b]| u32::from_le_bytes([r, g, b, 255]));
    let opacity = surface.segments[surface.segment_of(i)].opacity;
    let opacity = (opacity.clamp(0.0, 1.0) * 255.0).round() as u8;
    let last = u32::from_le_bytes([surface.owners[i], opacity, 0, 0]);
    texels.push([a, b, c, last]);
}

/// How many texels the pictures on a mesh's triangles take; 0 if there are none.
pub(crate) fn texels_of_textures(surface: &Surface) -> u32 {
    surface.textures.as_ref().map_or(0, |textures| {
        let pictures = textures.pictures.iter();
        let texels =
            pictures.map(|picture| 1 + picture.copies.iter().map(texels_of_copy).sum::<u32>());
        2 * surface.triangles.len() as u32 + texels.sum::<u32>()
    })
}

/// Texels of a picture or a copy: four pixels each.
fn texels_of_copy(copy: &Picture) -> u32 {
    copy.pixels.len().div_ceil(4) as u32
}

/// The box of all nodes.
fn root_of(surface: &Surface) -> Aabb {
    let root = surface.tree.nodes.first();
    root.map_or(Aabb::from_points([Vec3::ZERO]), |node| node.bounds)
}

/// A node as one texel: its box in parts of the root's box, 16 bits each (low x, y, z, then high), and what it leads
/// to: of a leaf its triangles, of others the node behind their branch. Behind a leaf is the next node.
fn packed_node(node: &TreeNode, root: Aabb) -> [u32; 4] {
    let parts =
        |at: Vec3| (at - root.min) / root.size().max(Vec3::splat(f32::MIN_POSITIVE)) * NODE_PARTS;
    // A hair more than rounding: the shader computes the places anew.
    let low = (parts(node.bounds.min) - 0.02)
        .floor()
        .max(Vec3::ZERO)
        .as_uvec3();
    let high = (parts(node.bounds.max) + 0.02)
        .ceil()
        .min(Vec3::splat(NODE_PARTS))
        .as_uvec3();
    let leads_to = match node.count {
        0 => node.skip,
        count => LEAF | node.first << COUNT_BITS | count,
    };
    [
        low.x | low.y << 16,
        low.z | high.x << 16,
        high.y | high.z << 16,
        leads_to,
    ]
}

/// A unit vector as its place on the unfolded octahedron, two numbers of 16 bits (Cigolle et al. 2014).
fn octahedral(normal: Vec3) -> u32 {
    let n = normal / normal.abs().element_sum().max(1e-9);
    let sign = |v: f32| if v >= 0.0 { 1.0 } else { -1.0 };
    let at = if n.z >= 0.0 {
        Vec2::new(n.x, n.y)
    } else {
        Vec2::new((1.0 - n.y.abs()) * sign(n.x), (1.0 - n.x.abs()) * sign(n.y))
    };
    let [x, y] = (at * 32767.0).round().to_array().map(|v| v as i16 as u16);
    u32::from(x) | u32::from(y) << 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_survive_packing() {
        for i in 0..1000 {
            let t = i as f32 * 0.37;
            let normal = Vec3::new(t.sin(), (t * 1.7).cos(), (t * 0.61).sin()).normalize();
            let packed = octahedral(normal);
            let part = |bits: u32| f32::from(bits as u16 as i16) / 32767.0;
            let at = Vec2::new(part(packed), part(packed >> 16));
            // As the shader unpacks it.
            let up = 1.0 - at.x.abs() - at.y.abs();
            let fold = (-up).max(0.0);
            let back = |v: f32| v + if v >= 0.0 { -fold } else { fold };
            let unpacked = Vec3::new(back(at.x), back(at.y), up).normalize();
            assert!(unpacked.distance(normal) < 1e-4, "{normal} {unpacked}");
        }
    }
}
