//! How a file is read where the file leaves a choice.

use super::mesh::{MeshReading, MeshRef, SubjectBox};

/// How a file is read where the file leaves a choice: `frame`, `raw`, `units`, `axes`, `parts` and `smooth` of a
/// document's `subject`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Which of the volumes in the file, counted from 0: a time point, a component, a layer.
    pub frame: u64,
    /// The layout of the voxels in a file that does not describe it.
    pub raw: Option<RawVoxels>,
    /// How a file is read that holds a mesh.
    pub mesh: MeshReading,
    /// The box that gives a mesh its origin and unit; `None` takes that of its vertices.
    pub bounds: Option<SubjectBox>,
    /// All meshes of a subject that has several, the one that this is the reading of first; else none.
    pub meshes: Vec<MeshRef>,
    /// True for the mesh of an object by which a template carves: what that takes is made besides.
    pub carves: bool,
    /// True for the mesh of a tool: its grid of distances is made besides.
    pub sweeps: bool,
}

/// The layout of a file that holds bare voxels, as its author describes it.
///
/// In a document: `{ "size": [128, 128, 256], "type": "int16", "order": "big", "spacing": [1, 1, 1], "skip": 0 }`.
#[derive(Clone, Debug, PartialEq)]
pub struct RawVoxels {
    /// Voxels along each axis, x fastest.
    pub size: [u32; 3],
    /// Type of a voxel: one of [`RawVoxels::ELEMENTS`].
    pub element: &'static str,
    /// True if the high byte comes first.
    pub big_endian: bool,
    /// Size of a voxel, mm.
    pub spacing_mm: [f64; 3],
    /// Bytes before the first voxel, after unpacking.
    pub skip_bytes: u64,
}

impl RawVoxels {
    /// Types that bare voxels may have; the first is the default.
    pub const ELEMENTS: [&'static str; 10] = [
        "uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64", "float32",
        "float64",
    ];
    /// The type of voxels whose document names none.
    pub const DEFAULT_ELEMENT: &'static str = Self::ELEMENTS[0];
    /// Names of the byte orders; the first is the default.
    pub(crate) const ORDERS: [&'static str; 2] = ["little", "big"];
}
