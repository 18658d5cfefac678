//! Reads what the bodies of meshes are made of: keys of `look` that its entries in `look.segments` have too.

use super::object::Object;
use super::reader::Reader;
use crate::document::model::{BodyKind, Layer, SubjectRef, SurfaceChange, SurfaceLook};
use crate::document::text::DocumentError;

/// What a notice says in place of a colour that is none.
pub(super) const DEFAULT: &str = "the default";

impl Reader {
    /// The keys of `look`. Without `layers` those of the subject itself count.
    pub(super) fn surface(
        &mut self,
        look: &Object<'_>,
        subject: &SubjectRef,
    ) -> Result<SurfaceLook, DocumentError> {
        let own = match subject {
            SubjectRef::Builtin { name, .. } if !look.map.contains_key("layers") => {
                Layer::of_builtin(name)
            }
            _ => Vec::new(),
        };
        Ok(SurfaceLook {
            body: BodyKind::ALL[self.choice(look, "body")?],
            thickness: self.number(look, "thickness")?,
            inside_srgb: self.color(look, "inside", DEFAULT)?,
            layers: match own.is_empty() {
                true => self.layers(look)?,
                false => own,
            },
            gloss: self.number(look, "gloss")?,
        })
    }

    /// The keys of an entry of `look.segments`.
    pub(super) fn surface_change(
        &mut self,
        look: &Object<'_>,
    ) -> Result<SurfaceChange, DocumentError> {
        let has = |key| look.map.contains_key(key);
        let body = self.choice_if_any(look, "body", "that of the look")?;
        Ok(SurfaceChange {
            body: body.map(|i| BodyKind::ALL[i]),
            thickness: match has("thickness") {
                true => Some(self.number(look, "thickness")?),
                false => None,
            },
            inside_srgb: self.color(look, "inside", DEFAULT)?,
            layers: match has("layers") {
                true => Some(self.layers(look)?),
                false => None,
            },
            gloss: match has("gloss") {
                true => Some(self.number(look, "gloss")?),
                false => None,
            },
        })
    }

    fn layers(&mut self, look: &Object<'_>) -> Result<Vec<Layer>, DocumentError> {
        let mut layers = Vec::new();
        for (index, object) in look.children("layers")?.enumerate() {
            let object = object?;
            self.unknown_keys(&object);
            layers.push(Layer {
                index,
                depth: self.number(&object, "depth")?,
                name: object.string("name")?,
                color_srgb: self.color(&object, "color", DEFAULT)?,
                grain: self.number(&object, "grain")?,
            });
        }
        Layer::sort(&mut layers);
        Ok(layers)
    }
}
