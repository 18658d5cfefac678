//! Reading of what templates hold besides parameters: control points, a cut, a file.

use super::object::Object;
use super::reader::Reader;
use crate::displace::Holds;
use crate::document::model::{
    ControlPoint, ControlPoints, FieldRef, ObjectRef, TemplateData, TemplateKind,
};
use crate::document::text::DocumentError;
use crate::document::text::pointer::join;

impl Reader {
    pub(super) fn data(
        &mut self,
        kind: TemplateKind,
        template: &Object<'_>,
        params: &Object<'_>,
    ) -> Result<TemplateData, DocumentError> {
        Ok(match kind.facts().holds {
            Holds::Points => TemplateData::Points(self.control_points(params)?),
            Holds::File => TemplateData::Field(FieldRef {
                src: params.text("src")?.map(str::to_owned),
                sha256: params.hash()?,
                name: params.string("name")?,
                is_placed: ["at", "rotate", "size"]
                    .iter()
                    .any(|key| template.map.contains_key(*key)),
            }),
            // Which object has the name is found once all are read.
            Holds::Object => TemplateData::Object(ObjectRef {
                name: params.string("object")?,
                found: None,
            }),
            Holds::Tools => TemplateData::Tools(self.sweep_tools(params)?),
            Holds::Parameters => TemplateData::None,
        })
    }

    fn control_points(&mut self, params: &Object<'_>) -> Result<ControlPoints, DocumentError> {
        let mut points = Vec::new();
        let (at, keys) = (params.at("points"), params.kind("points").keys());
        for (i, value) in self.first(params, "points")?.iter().enumerate() {
            let object = Object::new(join(&at, &i.to_string()), value, keys)?;
            self.unknown_keys(&object);
            points.push(ControlPoint {
                at: self.vector(&object, "at")?,
                shift: self.vector(&object, "move")?,
            });
        }
        Ok(ControlPoints {
            points,
            cut: self.pairs(params, "cut")?,
        })
    }
}
