use std::fmt;

use glam::{DMat3, DVec3};

use crate::document::{MeshAxes, MeshParts, MeshReading, MeshUnits};

/// Triangles in all meshes and objects of a document, at most.
pub const MAX_TRIANGLES: u64 = 2_000_000;

/// How a mesh is read where the document says more than the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshOptions {
    /// One unit of the file; `None` takes the format's own: millimetres, in a GLB metres.
    pub units: Option<Units>,
    /// Directions of the file's axes; `None` takes what the file says, else the format's own.
    pub axes: Option<Axes>,
    /// What becomes a part.
    pub parts: PartsMode,
    /// More triangles are refused before memory is asked for. Smaller where other meshes are there already.
    pub max_triangles: u64,
}

impl Default for MeshOptions {
    fn default() -> Self {
        Self {
            units: None,
            axes: None,
            parts: PartsMode::Named,
            max_triangles: MAX_TRIANGLES,
        }
    }
}

impl From<&MeshReading> for MeshOptions {
    /// As a document says, with as many triangles as can be opened.
    fn from(reading: &MeshReading) -> Self {
        Self {
            units: reading.units.map(|units| match units {
                MeshUnits::Millimetre => Units::Millimetre,
                MeshUnits::Centimetre => Units::Centimetre,
                MeshUnits::Metre => Units::Metre,
                MeshUnits::Inch => Units::Inch,
            }),
            axes: reading.axes.map(|axes| match axes {
                MeshAxes::Ras => Axes::Ras,
                MeshAxes::Lps => Axes::Lps,
                MeshAxes::YUp => Axes::YUp,
            }),
            parts: match reading.parts {
                MeshParts::Named => PartsMode::Named,
                MeshParts::Pieces => PartsMode::Pieces,
                MeshParts::Whole => PartsMode::Whole,
            },
            ..Self::default()
        }
    }
}

/// The length of one unit of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// 1 mm.
    Millimetre,
    /// 10 mm.
    Centimetre,
    /// 1000 mm.
    Metre,
    /// 25.4 mm.
    Inch,
}

impl Units {
    /// Length of one unit, mm.
    pub fn mm(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Centimetre => 10.0,
            Self::Metre => 1000.0,
            Self::Inch => 25.4,
        }
    }
}

impl fmt::Display for Units {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
            Self::Inch => "in",
        })
    }
}

/// The directions of a file's axes. All three are right-handed: none of them mirrors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// x right, y anterior, z superior.
    Ras,
    /// x left, y posterior, z superior.
    Lps,
    /// x left, y up, z forward, as glTF has it.
    YUp,
}

impl Axes {
    /// What takes a direction of the file to RAS+.
    pub fn ras_from_file(self) -> DMat3 {
        match self {
            Self::Ras => DMat3::IDENTITY,
            Self::Lps => DMat3::from_diagonal(DVec3::new(-1.0, -1.0, 1.0)),
            Self::YUp => DMat3::from_cols(-DVec3::X, DVec3::Z, DVec3::Y),
        }
    }
}

impl fmt::Display for Axes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ras => "RAS",
            Self::Lps => "LPS",
            Self::YUp => "y-up",
        })
    }
}

/// What becomes a part of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PartsMode {
    /// What the file names: objects or groups of an OBJ, solids of an ASCII STL, nodes of a GLB.
    #[default]
    Named,
    /// What hangs together over welded vertices, the largest box first; cavities go with the body around them.
    Pieces,
    /// All of it is one part.
    Whole,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_turn_and_do_not_mirror() {
        for axes in [Axes::Ras, Axes::Lps, Axes::YUp] {
            assert_eq!(axes.ras_from_file().determinant(), 1.0, "{axes}");
        }
        let up = Axes::YUp.ras_from_file() * DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(up, DVec3::new(-1.0, 3.0, 2.0), "RAS = −x, z, y");
        let lps = Axes::Lps.ras_from_file() * DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(lps, DVec3::new(-1.0, -2.0, 3.0));
    }
}
