//! Shapes for the tests of this room.

use glam::Vec3;

use super::value::{Mesh, MeshPart};

/// A cube of side 1 from the origin: eight vertices, x fastest, and twelve triangles, their fronts outside.
pub(crate) fn cube() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let bit = |i: u32, b: u32| ((i >> b) & 1) as f32;
    let positions = (0..8)
        .map(|i| Vec3::new(bit(i, 0), bit(i, 1), bit(i, 2)))
        .collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    (positions, triangles)
}

/// A mesh in one part.
pub(crate) fn in_one_part(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    let parts = vec![MeshPart {
        name: "part".to_owned(),
        triangles: 0..triangles.len(),
    }];
    Mesh {
        positions,
        triangles,
        parts,
        ..Mesh::default()
    }
}
