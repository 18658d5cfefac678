//! A shaped clay as the mesh that is drawn and written: millimetres, one part.

use glam::Vec3;

use super::shaping::Shaped;
use super::write::{Export, Form, MeshFormat};
use crate::data::{Corners, Mesh, MeshPart};

/// The name of a clay's only segment.
pub const SEGMENT: &str = "clay";

impl Shaped {
    /// Vertices, mm.
    pub fn positions_mm(&self) -> Vec<Vec3> {
        let positions = self.positions.iter();
        positions.map(|pos| self.space.to_mm(*pos)).collect()
    }

    /// The mesh as the bytes of a file; `form` counts where the format has two.
    pub fn file(&self, format: MeshFormat, form: Form, title: &str) -> Vec<u8> {
        let export = Export {
            positions_mm: &self.positions_mm(),
            normals: &self.normals,
            triangles: &self.triangles,
            title,
        };
        export.file(format, form)
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
