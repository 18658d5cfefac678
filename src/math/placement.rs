use glam::{Quat, Vec3};

/// Where a template's unit cube lies in subject space.
///
/// `P(q) = at + rotate · (size ∘ (q − ½))` takes template space to subject space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Centre of the cube, subject space.
    pub at: Vec3,
    /// Unit quaternion that turns template axes into subject axes.
    pub rotate: Quat,
    /// Side lengths, subject units, all above 0.
    pub size: Vec3,
}

impl Placement {
    /// The placement of a template without one in the document (contract, "Defaults").
    pub const DOCUMENT_DEFAULT: Self = Self {
        at: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        size: Vec3::splat(0.5),
    };

    /// Template space to subject space.
    pub fn subject_from_template(&self, q: Vec3) -> Vec3 {
        self.at + self.rotate * (self.size * (q - 0.5))
    }

    /// Subject space to template space.
    pub fn template_from_subject(&self, pos: Vec3) -> Vec3 {
        (self.rotate.conjugate() * (pos - self.at)) / self.size + 0.5
    }
}
