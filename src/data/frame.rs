use crate::math::Aabb;
use glam::DVec3;

/// Where a subject lies and how fine it is: all that cameras, placement and captions need to know about it, whatever
/// its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubjectFrame {
    /// Box of the untouched subject, subject space: its middle at the origin, its longest side 1, but for meshes whose
    /// document gives another box.
    pub bounds: Aabb,
    /// Millimetres in one subject unit.
    pub mm_per_unit: f64,
    /// Where the origin of subject space lies in world space, mm, RAS+.
    pub middle_mm: DVec3,
    /// Length of its finest detail, subject units. Of a volume: the smallest distance between the centres of
    /// neighbouring voxels.
    pub detail: f32,
}
