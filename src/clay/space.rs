//! Where a clay lies in millimetres.

use glam::{DVec3, Vec3};

use crate::document::Clay;

/// Where the space of a clay lies in millimetres: that of the starting shape, whatever strokes do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space {
    /// The origin: the middle of the starting shape's box, mm.
    pub middle_mm: DVec3,
    /// The longest side of that box.
    pub mm_per_unit: f64,
}

impl Default for Space {
    /// That of the built-in shapes.
    fn default() -> Self {
        Self {
            middle_mm: DVec3::ZERO,
            mm_per_unit: Clay::MM_PER_UNIT,
        }
    }
}

impl Space {
    /// That of a clay of these vertices, mm; `None` if they have no size.
    pub(super) fn around(positions_mm: &[Vec3]) -> Option<Self> {
        let least = positions_mm.iter().copied().reduce(Vec3::min)?.as_dvec3();
        let most = positions_mm.iter().copied().reduce(Vec3::max)?.as_dvec3();
        let mm_per_unit = (most - least).max_element();
        (mm_per_unit > 0.0).then_some(Self {
            middle_mm: (least + most) * 0.5,
            mm_per_unit,
        })
    }

    /// A place of the clay in millimetres.
    pub fn to_mm(&self, pos: Vec3) -> Vec3 {
        (pos.as_dvec3() * self.mm_per_unit + self.middle_mm).as_vec3()
    }

    /// A place in millimetres in the clay.
    pub fn from_mm(&self, pos: Vec3) -> Vec3 {
        ((pos.as_dvec3() - self.middle_mm) / self.mm_per_unit).as_vec3()
    }

    /// The box that gives the clay origin and unit when it is drawn, mm.
    pub fn box_mm(&self) -> [DVec3; 2] {
        let half = DVec3::splat(0.5 * self.mm_per_unit);
        [self.middle_mm - half, self.middle_mm + half]
    }
}
