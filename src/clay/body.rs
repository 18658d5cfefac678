//! A shaped clay as the mesh that is drawn and written: millimetres, one part.

use glam::{DVec3, Vec3};

use super::shaping::Shaped;
use crate::data::{Corners, Mesh, MeshPart};
use crate::document::Clay;

/// The name of a clay's only segment.
pub const SEGMENT: &str = "clay";

impl Shaped {
    /// Vertices, mm: subject units of the built-in shapes have a hundred.
    pub fn positions_mm(&self) -> Vec<Vec3> {
        let mm = |pos: &Vec3| (pos.as_dvec3() * Clay::MM_PER_UNIT).as_vec3();
        self.positions.iter().map(mm).collect()
    }

    /// The mesh, with the normals that its strokes have carried.
    pub fn mesh(&self) -> Mesh {
        Mesh {
            positions: self.positions_mm(),
            triangles: self.triangles.clone(),
            normals: Some(Corners {
                values: self.normals.clone(),
                at: self.triangles.clone(),
            }),
            parts: vec![MeshPart {
                name: SEGMENT.to_owned(),
                triangles: 0..self.triangles.len(),
            }],
            ..Mesh::default()
        }
    }
}

/// The box that gives a clay origin and unit, mm: that of the starting shape, whatever strokes do.
pub fn box_mm() -> [DVec3; 2] {
    let half = DVec3::splat(0.5 * Clay::MM_PER_UNIT);
    [-half, half]
}
