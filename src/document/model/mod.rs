//! Plain types: what a document means. No JSON.

mod clay;
mod clay_volume;
mod curve;
pub mod figure;
mod illustration;
mod light;
mod look;
mod mesh;
mod object;
mod preset;
mod reading;
mod recipe;
mod script;
mod style;
mod style_preset;
mod subject;
mod surface;
mod template;

pub use crate::displace::{
    ControlPoint, ControlPoints, MAX_GRIDS, MAX_KEYS, MAX_PARAM_FLOATS, MAX_TOOLS, ParamKind,
    ParamSpec, ParamValue, PathKey, SweepTool, SweepTools, TemplateKind, TemplateSpec, ToolFile,
    ToolShape,
};
pub use clay::{Clay, ClayKey, ClayMove, ClayShape, ClayStart, ClayStroke, ClayTool};
pub use clay_volume::{ClayFile, ClayVolume, VoxelPart, VoxelSource};
pub use curve::Curve;
pub use illustration::{Camera, Caption, Control, ControlRange, FIGURE_FRONT, Illustration, Step};
pub use light::Light;
pub use look::{
    Background, Look, OpacityMode, SegmentLook, SegmentSurface, Transfer, TransferPoint, Window,
};
pub use mesh::{MeshAxes, MeshParts, MeshReading, MeshRef, MeshUnits, SubjectBox};
pub use object::{ObjectPlacement, ObjectSource, SceneObject};
pub use preset::{PRESETS, Preset, PresetSubject, preset, presets};
pub use reading::{RawVoxels, Reading};
pub use recipe::{CleanStep, Recipe, RecipeSource, Stroke};
pub use script::needs_shaping;
pub use style::{Ghost, GhostBy, Hatch, HatchBy, Outline, Stipple, Style, Tone};
pub use style_preset::{STYLE_PRESETS, StylePreset, style_preset};
pub(in crate::document) use subject::DRAWN;
pub use subject::{SegmentsRef, SubjectRef, is_drawn_name};
pub use surface::{BodyKind, Layer, SurfaceChange, SurfaceLook};
pub use template::{
    Align, Constrain, ConstrainBy, FieldRef, FoundObject, NotCarving, ObjectRef, PlacedTemplate,
    TemplateData, TemplateMode, keep_set, keep_sets,
};
pub(in crate::document) use template::{join_objects, limit_grids, limit_sweeps};
