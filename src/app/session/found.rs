//! What a question to the picture finds.

use glam::Vec3;

/// A point of the object's surface as the picture shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Where the surface is, subject space (deformed).
    pub pos: Vec3,
    /// Unit normal towards the eye, subject space; zero where the surface has none to speak of.
    pub normal: Vec3,
    /// Where this tissue is before any template acts, rest space.
    pub pos_in_rest: Vec3,
    /// Value of the subject at the point, in the units of its scan.
    pub value: f32,
    /// Label of the segment that the tissue belongs to, if it belongs to one.
    pub segment: Option<u16>,
    /// The object of the scene that is seen there, an index in the document; `None` where the subject is seen.
    pub object: Option<usize>,
}
