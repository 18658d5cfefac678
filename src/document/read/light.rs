//! Reads where the light comes from and how it falls.

use super::object::Object;
use super::reader::Reader;
use crate::document::model::Light;
use crate::document::schema::Kind;
use crate::document::text::DocumentError;
use glam::{DVec3, Vec3};

impl Reader {
    /// The key `light` of `look`; `None` if the document does not have it.
    pub(super) fn light(&mut self, look: &Object<'_>) -> Result<Option<Light>, DocumentError> {
        let Some(light) = self.part(look, "light")? else {
            return Ok(None);
        };
        Ok(Some(Light {
            from: self.light_from(&light)?,
            soft: self.number(&light, "soft")?,
            contact: self.number(&light, "contact")?,
            skin: self.number(&light, "skin")?,
        }))
    }

    /// Towards the key light. Where the numbers are no direction, or one from straight behind, it is the default.
    fn light_from(&mut self, light: &Object<'_>) -> Result<Vec3, DocumentError> {
        let Kind::Vector { default, min, max } = light.kind("from") else {
            debug_assert!(false, "the schema has no vector for the direction of light");
            return Ok(Light::DOCUMENT_DEFAULT.from);
        };
        let values = light.numbers("from", "a list of three numbers")?;
        let values = values.unwrap_or(default);
        let inside = values.map(|v| v.clamp(min, max));
        let from = direction(inside).filter(|from| from.z >= Light::LEAST_TO_VIEWER);
        let drawn = if from.is_some() { inside } else { default };
        self.clamped(|| light.at("from"), values, drawn);
        Ok(from.map_or(Light::DOCUMENT_DEFAULT.from, |from| from.as_vec3()))
    }
}

/// The unit vector of finite numbers; `None` if all are 0.
fn direction(values: [f64; 3]) -> Option<DVec3> {
    let vector = DVec3::from_array(values);
    // Scaled first, so that no square vanishes.
    let largest = vector.abs().max_element();
    (largest > 0.0).then(|| (vector / largest).normalize())
}
