//! The formats that meshes are written in.

use super::{Export, Form};

/// A format that meshes are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// For printing; triangles alone.
    Stl,
    /// For modelling programs.
    Obj,
    /// For measuring and mesh tools.
    Ply,
    /// For web pages and viewers.
    Glb,
}

impl MeshFormat {
    /// All formats, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Stl, Self::Obj, Self::Ply, Self::Glb];

    /// The end of the names of its files, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Stl => "stl",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Glb => "glb",
        }
    }

    /// The media type of its files.
    pub fn mime(self) -> &'static str {
        match self {
            Self::Stl => "model/stl",
            Self::Obj => "model/obj",
            Self::Ply => "application/octet-stream",
            Self::Glb => "model/gltf-binary",
        }
    }

    /// The format whose files end so, whatever the case; `None` for another end.
    pub fn of_extension(end: &str) -> Option<Self> {
        let mut all = Self::ALL.into_iter();
        all.find(|format| format.extension().eq_ignore_ascii_case(end))
    }
}

/// A file that a clay is to become.
#[derive(Clone, Debug, PartialEq)]
pub struct Writing {
    /// What programs are to read.
    pub format: MeshFormat,
    /// What the picture is called; may be empty.
    pub title: String,
}

impl Export<'_> {
    /// The file of a format; `form` counts where the format has two.
    pub fn file(&self, format: MeshFormat, form: Form) -> Vec<u8> {
        match format {
            MeshFormat::Stl => self.stl(form),
            MeshFormat::Obj => self.obj(),
            MeshFormat::Ply => self.ply(form),
            MeshFormat::Glb => self.glb(),
        }
    }
}
