//! Objects: tools and neighbours of the subject, which stand in the scene and are never displaced.

use super::mesh::MeshReading;
use glam::{Quat, Vec3};

/// An entry of `objects`.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneObject {
    /// Its index in the document's list, which counts those too that are not drawn.
    pub index: usize,
    /// The author's name for it, else `object N`, N from 1; never empty. Of several objects of one name the first
    /// counts where a name is asked for; all are drawn.
    pub name: String,
    /// Where its triangles come from.
    pub source: ObjectSource,
    /// Where it lies; `None` is where its file says, in the subject's millimetres.
    pub placement: Option<ObjectPlacement>,
    /// sRGB bytes; `None`: the file's own.
    pub color_srgb: Option<[u8; 3]>,
    /// Colour of back sides, sRGB bytes; `None`: 0.75 of the colour of the point, in linear light.
    pub inside_srgb: Option<[u8; 3]>,
    /// Opacity of one crossing, 0 to 1.
    pub opacity: f32,
    /// 0 to 1.
    pub gloss: f32,
    /// False: it is not drawn, and nothing is carved by it.
    pub enabled: bool,
}

/// Where the triangles of an object come from.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjectSource {
    /// A tool that the program generates, one of [`SceneObject::BUILTINS`].
    Builtin(&'static str),
    /// A mesh file that the document names.
    File {
        /// The address, relative to the document or absolute; without one the reader supplies it.
        src: Option<String>,
        /// SHA-256 of its bytes, lower-case hex, if given.
        sha256: Option<String>,
        /// How it is read; `parts` says nothing here.
        reading: MeshReading,
    },
}

/// Where an object lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectPlacement {
    /// Centre of its unturned box, subject space.
    pub at: Vec3,
    /// Its turn about that centre.
    pub rotate: Quat,
    /// Its longest side before the turn, subject units.
    pub size: f32,
}

impl SceneObject {
    /// The tools that the program generates.
    pub const BUILTINS: [&'static str; 4] = ["scalpel", "forceps", "retractor", "needle"];
    /// Gloss of an object that does not say.
    pub const DEFAULT_GLOSS: f32 = 0.5;
}

impl ObjectPlacement {
    /// The placement of an object that gives none (surfaces.md, "objects").
    pub const DOCUMENT_DEFAULT: Self = Self {
        at: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        size: 0.3,
    };
}
