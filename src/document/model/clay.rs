//! A clay: a starting shape, tools, and the strokes that shape it (spec/sweepers.md, B). The document holds this recipe
//! and never the mesh.

use super::clay_volume::{ClayFile, ClayVolume, VoxelSource};
use super::mesh::{MeshParts, MeshReading, MeshRef};
use super::reading::Reading;
use crate::displace::{ToolFile, ToolShape};
use crate::math::{Screw, Similarity};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A clay as its document describes it. Lengths are subject units: 1 is the longest side of the starting shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Clay {
    /// What it is before the first stroke.
    pub from: ClayStart,
    /// Longest edge of its triangles where strokes come, [`Clay::DETAIL`].
    pub detail: f64,
    /// The tools that strokes name by their places in this list, at most [`Clay::MAX_TOOLS`].
    pub tools: Vec<ClayTool>,
    /// One after the other, at most [`Clay::MAX_STROKES`]. Those that are off are counted too.
    pub strokes: Vec<ClayStroke>,
}

impl Clay {
    /// Range of [`Clay::detail`].
    pub const DETAIL: [f64; 2] = [0.004, 0.1];
    /// Most tools.
    pub const MAX_TOOLS: usize = 16;
    /// Most strokes.
    pub const MAX_STROKES: usize = 2000;
    /// Most keys of one path of a stroke.
    pub const MAX_KEYS: usize = 64;
    /// Most tools that act at once, mirror images counted.
    pub const MAX_AT_ONCE: usize = 8;
    /// Millimetres of a subject unit of the built-in starting shapes.
    pub const MM_PER_UNIT: f64 = 100.0;
}

impl Clay {
    /// This clay with its first strokes only, those that are off counted.
    #[must_use]
    pub fn cut(self: &Arc<Self>, strokes: u32) -> Arc<Self> {
        let strokes = strokes as usize;
        if strokes >= self.strokes.len() {
            return Arc::clone(self);
        }
        Arc::new(Self {
            from: self.from.clone(),
            detail: self.detail,
            tools: self.tools.clone(),
            strokes: self.strokes[..strokes].to_vec(),
        })
    }

    /// How many of the first strokes do the same in both, if both begin with the same mesh.
    pub fn strokes_shared(&self, other: &Self) -> Option<usize> {
        if self.from != other.from || self.detail != other.detail {
            return None;
        }
        let is_same_tool = |one: &ClayMove| self.tools.get(one.tool) == other.tools.get(one.tool);
        let both = self.strokes.iter().zip(&other.strokes);
        let shared = both.take_while(|(a, b)| a == b && a.moves.iter().all(is_same_tool));
        Some(shared.count())
    }

    /// The file that it begins with, a mesh or a scan; `None` where it begins with something else.
    pub fn file(&self) -> Option<ClayFile<'_>> {
        let (src, sha256, name) = match &self.from {
            ClayStart::Mesh(mesh) => (&mesh.src, &mesh.sha256, &mesh.name),
            ClayStart::Volume(volume) => match &volume.of {
                VoxelSource::Builtin { .. } => return None,
                VoxelSource::File {
                    src, sha256, name, ..
                } => (src, sha256, name),
            },
            ClayStart::Shape(_) | ClayStart::Unknown(_) => return None,
        };
        Some(ClayFile {
            src: src.as_deref(),
            sha256: sha256.as_deref(),
            name,
        })
    }

    /// The mesh file that it begins with; `None` where it begins with something else.
    pub fn mesh(&self) -> Option<&MeshRef> {
        match &self.from {
            ClayStart::Mesh(mesh) => Some(mesh),
            ClayStart::Shape(_) | ClayStart::Volume(_) | ClayStart::Unknown(_) => None,
        }
    }

    /// The voxels that it begins with; `None` where it begins with something else.
    pub fn volume(&self) -> Option<&ClayVolume> {
        match &self.from {
            ClayStart::Volume(volume) => Some(volume),
            ClayStart::Shape(_) | ClayStart::Mesh(_) | ClayStart::Unknown(_) => None,
        }
    }

    /// The files of its tools that are meshes.
    pub fn tool_files(&self) -> impl Iterator<Item = &ToolFile> {
        let shapes = self.tools.iter().filter_map(|tool| tool.shape.as_ref());
        shapes.filter_map(ToolShape::file)
    }

    /// This clay with another file in place of what it begins with, read as that was: a scan in place of voxels, else a
    /// mesh. The strokes stay.
    #[must_use]
    pub fn with_file(&self, src: Option<String>, sha256: Option<String>) -> Self {
        let from = match &self.from {
            ClayStart::Volume(volume) => ClayStart::Volume(Box::new(ClayVolume {
                of: VoxelSource::File {
                    src,
                    sha256,
                    name: String::new(),
                    reading: match &volume.of {
                        VoxelSource::Builtin { .. } => Reading::default(),
                        VoxelSource::File { reading, .. } => reading.clone(),
                    },
                },
                ..ClayVolume::clone(volume)
            })),
            other => ClayStart::Mesh(MeshRef {
                index: 0,
                src,
                sha256,
                name: String::new(),
                reading: match other {
                    ClayStart::Mesh(mesh) => mesh.reading,
                    _ => MeshReading {
                        parts: MeshParts::Whole,
                        ..MeshReading::default()
                    },
                },
            }),
        };
        Self {
            from,
            ..self.clone()
        }
    }

    /// True if both begin with the same mesh and have the same tools: one may be the other with more strokes.
    pub fn is_like(&self, other: &Self) -> bool {
        self.from == other.from && self.detail == other.detail && self.tools == other.tools
    }
}

impl Default for Clay {
    /// A ball that nothing has touched.
    fn default() -> Self {
        Self {
            from: ClayStart::Shape(ClayShape::Ball),
            detail: 0.02,
            tools: vec![ClayTool::default()],
            strokes: Vec::new(),
        }
    }
}

/// What a clay is before its first stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum ClayStart {
    /// One of the built-in shapes.
    Shape(ClayShape),
    /// A mesh file.
    Mesh(MeshRef),
    /// A segment or an isosurface of a volume.
    Volume(Box<ClayVolume>),
    /// What this version makes no clay of, by its name or key in the document: it is kept.
    Unknown(String),
}

/// A built-in starting shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClayShape {
    /// Radius ½.
    Ball,
    /// Side 1, edges rounded by 0.02.
    Cube,
    /// 1 × 1 × 0.15 (z), edges rounded by 0.02.
    Plate,
    /// About z, ring 0.35, radius 0.15.
    Torus,
}

impl ClayShape {
    /// All shapes; the first is the default.
    pub const ALL: [Self; 4] = [Self::Ball, Self::Cube, Self::Plate, Self::Torus];
    /// Names in documents, in the order of [`Self::ALL`].
    pub const NAMES: [&'static str; 4] = ["ball", "cube", "plate", "torus"];

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// A tool for strokes; the lengths of its shape are subject units.
#[derive(Clone, Debug, PartialEq)]
pub struct ClayTool {
    /// Its form; `None` for one that this version does not have.
    pub shape: Option<ToolShape>,
    /// Width of its coating.
    pub coat: f64,
}

impl ClayTool {
    /// True if it is there before the stroke of this index: what is baked is, if it is made of earlier strokes alone.
    pub fn is_made_before(&self, stroke: usize) -> bool {
        match self.shape {
            Some(ToolShape::Clay { strokes, .. }) => strokes as usize <= stroke,
            _ => true,
        }
    }
}

impl Default for ClayTool {
    /// A small ball with as wide a coating.
    fn default() -> Self {
        Self {
            shape: Some(ToolShape::Ball { radius: 0.1 }),
            coat: 0.1,
        }
    }
}

/// A stroke: tools that move through the clay, all at once.
#[derive(Clone, Debug, PartialEq)]
pub struct ClayStroke {
    /// The stroke's own tool and way, then those of `with`.
    pub moves: Vec<ClayMove>,
    /// For x, y and z: every tool has an image beyond the middle plane of the starting shape.
    pub mirror: [bool; 3],
    /// Strength of a stroke that smooths, 1 to 100; `None` for one that moves.
    pub smooth: Option<u32>,
    /// True: it is counted and left out.
    pub is_off: bool,
}

impl ClayStroke {
    /// Names in documents of what a stroke does; the first is the default.
    pub(crate) const NAMES: [&'static str; 2] = ["sweep", "smooth"];
    /// Strength of a stroke that smooths and does not say how strongly.
    pub const DEFAULT_STRENGTH: u32 = 50;
}

/// A tool of a stroke, and how it goes.
#[derive(Clone, Debug, PartialEq)]
pub struct ClayMove {
    /// Index in [`Clay::tools`]; one beyond the list names no tool.
    pub tool: usize,
    /// At least one pose.
    pub keys: Vec<ClayKey>,
    /// True: screws join the keys; else a smooth curve does from three keys on.
    pub is_straight: bool,
}

/// A pose on the way of a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClayKey {
    /// Place of the tool's origin, thousandths of a subject unit. The document holds the way from the key before.
    pub at: [i32; 3],
    /// Turn about the tool's origin since the key before, since its rest for the first: rotation vector, degrees,
    /// subject axes.
    pub turn: [i32; 3],
    /// Size, per cent of the tool's own.
    pub percent: i32,
}

impl ClayKey {
    /// How a tool stands at each of its keys, from the first on: 64-bit floats, the same bits on every machine.
    pub fn poses(keys: &[Self]) -> Vec<Similarity> {
        let mut turn = DQuat::IDENTITY;
        let poses = keys.iter().map(|key| {
            let degrees = DVec3::from_array(key.turn.map(f64::from));
            let by = Screw {
                turn: degrees * (std::f64::consts::PI / 180.0),
                ..Screw::NONE
            };
            turn = by.exp().turn * turn;
            let place = DVec3::from_array(key.at.map(|thousandth| f64::from(thousandth) / 1000.0));
            Similarity::new(f64::from(key.percent) / 100.0, turn, place)
        });
        poses.collect()
    }
}
