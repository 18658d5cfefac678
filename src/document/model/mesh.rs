//! Meshes of the subject: which files, and how they are read.

use glam::DVec3;

/// A mesh of the subject: an entry of `subject.meshes`.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshRef {
    /// Its index in the document's list, which counts entries without a file too.
    pub index: usize,
    /// The address of the file, relative to the document or absolute; without one the reader supplies it.
    pub src: Option<String>,
    /// SHA-256 of its bytes, lower-case hex, if given.
    pub sha256: Option<String>,
    /// The author's name for it, or empty: then the segment of a file with one part is called `surface`.
    pub name: String,
    /// How the file is read.
    pub reading: MeshReading,
}

/// How a mesh is read where its file leaves a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshReading {
    /// One unit of the file; `None` takes the format's own.
    pub units: Option<MeshUnits>,
    /// Directions of the file's axes; `None` takes what the file says, else the format's own.
    pub axes: Option<MeshAxes>,
    /// What becomes a segment.
    pub parts: MeshParts,
    /// Edges sharper than this stay sharp, degrees, 0 to 180. `None` takes the file's own normals, and
    /// [`MeshReading::DEFAULT_SMOOTH_DEG`] where it has none.
    pub smooth_deg: Option<f32>,
}

impl MeshReading {
    /// Edges sharper than this stay sharp in a mesh without normals of its own, degrees.
    pub const DEFAULT_SMOOTH_DEG: f32 = 40.0;
}

/// The length of one unit of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshUnits {
    /// 1 mm.
    Millimetre,
    /// 10 mm.
    Centimetre,
    /// 1000 mm.
    Metre,
    /// 25.4 mm.
    Inch,
}

impl MeshUnits {
    /// All units, in the order of [`Self::NAMES`].
    pub(crate) const ALL: [Self; 4] = [Self::Millimetre, Self::Centimetre, Self::Metre, Self::Inch];
    /// Names in documents.
    pub(crate) const NAMES: [&'static str; 4] = ["mm", "cm", "m", "in"];

    /// The one of a name in documents.
    pub fn from_name(name: &str) -> Option<Self> {
        let index = Self::NAMES.iter().position(|known| *known == name)?;
        Some(Self::ALL[index])
    }

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The directions of a file's axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshAxes {
    /// x right, y anterior, z superior.
    Ras,
    /// x left, y posterior, z superior.
    Lps,
    /// x left, y up, z forward, as glTF has it.
    YUp,
}

impl MeshAxes {
    /// All directions, in the order of [`Self::NAMES`].
    pub(crate) const ALL: [Self; 3] = [Self::Ras, Self::Lps, Self::YUp];
    /// Names in documents.
    pub(crate) const NAMES: [&'static str; 3] = ["ras", "lps", "y-up"];

    /// The one of a name in documents.
    pub fn from_name(name: &str) -> Option<Self> {
        let index = Self::NAMES.iter().position(|known| *known == name)?;
        Some(Self::ALL[index])
    }

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// What becomes a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeshParts {
    /// Each part that the file names.
    #[default]
    Named,
    /// Each piece that hangs together.
    Pieces,
    /// The whole file is one segment.
    Whole,
}

impl MeshParts {
    /// All ways; the first is the default.
    pub(crate) const ALL: [Self; 3] = [Self::Named, Self::Pieces, Self::Whole];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 3] = ["named", "pieces", "whole"];

    /// The one of a name in documents.
    pub fn from_name(name: &str) -> Option<Self> {
        let index = Self::NAMES.iter().position(|known| *known == name)?;
        Some(Self::ALL[index])
    }

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The box that says where a subject of meshes alone has its origin, and how long its unit is (`subject.box`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubjectBox {
    /// Least coordinates, mm, RAS+.
    pub min_mm: DVec3,
    /// Greatest coordinates, mm, RAS+; none is below that of `min_mm`, and one at least is above.
    pub max_mm: DVec3,
}

impl SubjectBox {
    /// The origin of subject space, mm, RAS+.
    pub fn middle_mm(&self) -> DVec3 {
        (self.min_mm + self.max_mm) / 2.0
    }

    /// Millimetres in one subject unit: the longest side.
    pub fn mm_per_unit(&self) -> f64 {
        (self.max_mm - self.min_mm).max_element()
    }
}
