//! Reading of the curve that a template is laid along.

use super::object::Object;
use super::reader::Reader;
use crate::document::model::Curve;
use crate::document::text::{DocumentError, NoticeKind};
use crate::math::{NotBent, OnLine};
use glam::Vec3;

impl Reader {
    /// The curve of a template with a box of this size, of which it moves a layer (fraction of z) under the top.
    pub(super) fn curve(
        &mut self,
        template: &Object<'_>,
        size: Vec3,
        layer: f32,
    ) -> Result<Option<Curve>, DocumentError> {
        if !template.map.contains_key("curve") {
            return Ok(None);
        }
        let object = template.child("curve")?;
        self.unknown_keys(&object);
        let is_spline = object.flag("spline")?;
        let points = self.pairs(&object, "points")?;
        if points.is_empty() {
            return Ok(None);
        }
        let curve = Curve {
            points,
            is_spline,
            on_line: OnLine::TOP,
        };
        let what = match curve.bent(size) {
            Ok(bent) if bent.is_folded(layer) => {
                "the curve is bent more sharply than the template is deep; nothing is moved beyond the fold"
            }
            Ok(_) => return Ok(Some(curve)),
            Err(NotBent::TooShort) => {
                "a curve has at least two points apart from each other; the template is drawn straight"
            }
            Err(NotBent::TurnsBack) => {
                "the curve turns back on itself; the template is drawn straight"
            }
        };
        self.note(object.at("points"), NoticeKind::Curve { what });
        Ok(Some(curve))
    }
}
