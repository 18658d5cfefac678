//! The light of a picture: where it comes from, how its shadows end, and how far it goes under what it falls on.

use glam::Vec3;

/// Where the light of a picture comes from and how it falls (`look.light`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Towards the key light in the camera's axes (right, up, to the viewer), unit. It never comes from straight
    /// behind: the third number is -0.999 or more.
    pub from: Vec3,
    /// How soft the shadow of the key light is, 0 to 1.
    pub soft: f32,
    /// How dark creases and cuts are where surfaces meet, 0 to 1.
    pub contact: f32,
    /// How far light goes under the surface, as under skin, 0 to 1.
    pub skin: f32,
}

impl Light {
    /// The light of an object that says nothing.
    pub const DOCUMENT_DEFAULT: Self = Self {
        from: Vec3::new(-0.507_673_1, 0.609_207_7, 0.609_207_7),
        soft: 0.5,
        contact: 0.5,
        skin: 0.0,
    };
    /// [`Light::from`] of [`Self::DOCUMENT_DEFAULT`] as a document would write it, not of length 1.
    pub(crate) const WRITTEN_FROM: [f64; 3] = [-0.5, 0.6, 0.6];
    /// Least third number of [`Light::from`]: straighter from behind, there is no telling from which side it comes.
    pub(crate) const LEAST_TO_VIEWER: f64 = -0.999;
}
