//! The files of a mesh, one function a format.

use super::export::{Export, Form};
use super::{glb, obj, ply, stl};

impl Export<'_> {
    /// An STL: triangles with their own normals, for printers.
    pub fn stl(&self, form: Form) -> Vec<u8> {
        match form {
            Form::Binary => stl::binary(self),
            Form::Text => stl::text(self),
        }
    }

    /// A Wavefront OBJ: one object, named by the title.
    pub fn obj(&self) -> Vec<u8> {
        obj::obj(self)
    }

    /// A PLY; the binary form is little-endian.
    pub fn ply(&self, form: Form) -> Vec<u8> {
        ply::ply(self, form)
    }

    /// A GLB (glTF 2.0): one mesh in one node, named by the title.
    pub fn glb(&self) -> Vec<u8> {
        glb::glb(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn triangles_without_corners_are_in_no_file() {
        let export = Export {
            positions_mm: &[Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: &[],
            triangles: &[[0, 1, 3], [0, 1, 2]],
            title: "",
        };
        assert_eq!(export.stl(Form::Binary).len(), 84 + 50);
    }
}
