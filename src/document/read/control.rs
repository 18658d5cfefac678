//! Values that readers may move.

use super::object::Object;
use super::reader::Reader;
use crate::document::model::{Control, ControlRange, TemplateKind};
use crate::document::schema::{FAR, Scalar, is_fixed, scalar_at};
use crate::document::text::{DocumentError, NoticeKind, pointer};

impl Reader {
    /// An entry of `controls`; `None` with a notice where its value cannot be moved. `kind_of` gives the kind of a
    /// template.
    pub(super) fn control(
        &mut self,
        object: &Object<'_>,
        kind_of: impl Fn(usize) -> Option<TemplateKind>,
    ) -> Result<Option<Control>, DocumentError> {
        self.unknown_keys(object);
        let (pointer, name) = (object.string("pointer")?, object.string("name")?);
        let (min, max) = (object.number("min")?, object.number("max")?);
        let keys = pointer::keys(&pointer).unwrap_or_default();
        let template = match keys.as_slice() {
            [list, index, ..] if list == "templates" => pointer::index(index).and_then(kind_of),
            _ => None,
        };
        let can_be_set = !keys.is_empty() && !is_fixed(&keys);
        let range = match scalar_at(&keys, template).filter(|_| can_be_set) {
            None => Err("no number and no truth value that a step may set stands there"),
            Some(Scalar::Flag(default)) => Ok(ControlRange::Flag(default)),
            Some(Scalar::Number {
                default,
                min: least,
                max: most,
                is_whole,
            }) => {
                let has_range = most - least < FAR;
                let lowest = min.or(Some(least).filter(|_| has_range));
                let highest = max.or(Some(most).filter(|_| has_range));
                match (lowest, highest) {
                    (Some(lowest), Some(highest)) => {
                        let (min, max) = (lowest.clamp(least, most), highest.clamp(least, most));
                        match min < max {
                            true => Ok(ControlRange::Number {
                                default,
                                min,
                                max,
                                is_whole,
                            }),
                            false => Err("its `min` is not below its `max`"),
                        }
                    }
                    _ => Err("its value has no range of its own, so it needs `min` and `max`"),
                }
            }
        };
        let range = match range {
            Ok(range) => range,
            Err(why) => {
                self.note(object.pointer.clone(), NoticeKind::NoControl { why });
                return Ok(None);
            }
        };
        let own = || keys.last().cloned().unwrap_or_default();
        let name = Some(name).filter(|name| !name.trim().is_empty());
        Ok(Some(Control {
            name: name.unwrap_or_else(own),
            pointer,
            range,
        }))
    }
}
