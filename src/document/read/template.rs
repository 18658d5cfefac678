//! Reads templates: the entries of `templates`.

use super::object::Object;
use super::reader::Reader;
use crate::document::model::{
    Align, Constrain, ConstrainBy, ParamValue, PlacedTemplate, TemplateKind, TemplateMode,
};
use crate::document::schema::{Kind, params_of};
use crate::document::text::{DocumentError, NoticeKind, pointer, shortened};
use crate::math::Placement;

impl Reader {
    /// A template; `None` if its kind is unknown, which a notice names.
    pub(super) fn template(
        &mut self,
        index: usize,
        object: &Object<'_>,
    ) -> Result<Option<PlacedTemplate>, DocumentError> {
        self.unknown_keys(object);
        let placement = Placement {
            at: self.vector(object, "at")?,
            rotate: self.rotation(object, "rotate")?,
            size: self.vector(object, "size")?,
        };
        let name = object.string("name")?;
        // Only checked: nothing that is drawn depends on the group.
        object.string("group")?;
        let amount = self.number(object, "amount")?;
        let enabled = object.flag("enabled")?;
        let mode = TemplateMode::ALL[self.choice(object, "mode")?];
        let align = self.align(&object.child("align")?)?;
        let constrain = match object.map.contains_key("constrain") {
            true => self.constrain(&object.child("constrain")?)?,
            false => None,
        };
        let mut params = object.child("params")?;
        let kind_name = object.text("kind")?.unwrap_or_default();
        let Some(kind) = TemplateKind::from_name(kind_name) else {
            let kind = NoticeKind::UnknownTemplate {
                kind: shortened(kind_name, 40),
            };
            let at = match object.map.get("kind") {
                Some(_) => object.at("kind"),
                None => object.pointer.clone(),
            };
            self.note(at, kind);
            return Ok(None);
        };
        let spec = kind.spec();
        params.keys = params_of(Some(kind));
        let data = self.data(kind, object, &params)?;
        for key in params.map.keys() {
            let is_known = spec.params.iter().any(|param| param.name == key)
                || params.keys.iter().any(|known| known.name == key);
            if !is_known {
                let at = pointer::shortened(&params.at(key));
                self.note(at, NoticeKind::UnknownParam { kind: spec.name });
            }
        }
        let values = spec.params.iter().map(|param| self.param(&params, param));
        let values = values.collect::<Result<Vec<_>, _>>()?;
        // Of the box, a kind with a depth moves that layer only.
        let layer = spec.params.iter().position(|param| param.name == "depth");
        let layer = match layer.and_then(|i| values.get(i)) {
            Some(ParamValue::Number(depth)) => *depth,
            _ => 1.0,
        };
        let curve = self.curve(object, placement.size, layer)?;
        Ok(Some(PlacedTemplate {
            index,
            kind,
            name,
            placement,
            curve,
            params: values,
            amount,
            enabled,
            mode,
            align,
            constrain,
            data,
        }))
    }

    fn align(&mut self, object: &Object<'_>) -> Result<Align, DocumentError> {
        self.unknown_keys(object);
        let depth = self.number(object, "depth")?;
        let thickness = self.number(object, "thickness")?;
        let keep = Self::segment_names(object)?;
        Ok(match Align::NAMES[self.choice(object, "to")?] {
            "surface" => Align::Surface { depth, thickness },
            "segment" => Align::Segment { keep, thickness },
            _ => Align::Axis,
        })
    }

    /// A constraint; `None` if its way is unknown, which a notice names: another way would deform other tissue.
    fn constrain(&mut self, object: &Object<'_>) -> Result<Option<Constrain>, DocumentError> {
        self.unknown_keys(object);
        let keep = Self::segment_names(object)?;
        let by = match (object.text("by")?, object.kind("by")) {
            (Some(name), Kind::Name(names)) => {
                let found = names.iter().position(|known| *known == name);
                if found.is_none() {
                    self.unknown_value(object.at("by"), name, "nothing");
                }
                found
            }
            _ => Some(0),
        };
        Ok(by.map(|by| Constrain {
            by: ConstrainBy::ALL[by],
            keep,
        }))
    }
}
