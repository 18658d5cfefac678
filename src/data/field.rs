use std::sync::Arc;

use glam::Vec3;

use crate::math::Placement;

/// A displacement field on a grid that fills the box of its template, from outer edge to outer edge.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledField {
    /// Samples along each axis, x fastest.
    pub dims: [u32; 3],
    /// Displacement (template space) and continuity as 16-bit floats, four per sample.
    pub texels: Vec<u16>,
    /// Least and greatest displacement along each axis, template space.
    pub shift: [Vec3; 2],
    /// Where the file says that the box lies, subject space.
    pub placement: Placement,
}

/// A shared [`SampledField`]. Two are equal if they are the same one: samples are never compared one by one.
#[derive(Clone, Debug)]
pub struct FieldSamples(pub Arc<SampledField>);

impl PartialEq for FieldSamples {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
