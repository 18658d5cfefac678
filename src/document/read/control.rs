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
        let can_be_set = keys.first().is_some_and(|first| !is_fixed(first));
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

#[cfg(test)]
mod tests {
    use crate::document::{ControlRange, Document};
    use serde_json::json;

    fn document(controls: serde_json::Value) -> Result<Document, String> {
        let value = json!({ "fabrica": 1, "subject": { "builtin": "cube" },
            "templates": [{ "kind": "peel" }, { "kind": "move" }], "controls": controls });
        Document::from_value(value).map_err(|error| error.to_string())
    }

    #[test]
    fn values_that_a_step_may_set_are_controls() {
        let document = document(json!([
            { "pointer": "/templates/0/params/progress", "name": "Peel" },
            { "pointer": "/templates/0/params/progress", "min": 0.2, "max": 7 },
            { "pointer": "/templates/1/enabled" },
            { "pointer": "/templates/1/params/offset/2", "min": -1, "max": 0.5 },
            { "pointer": "/templates/0/at/0", "name": "Where", "min": -0.5, "max": 0.5 },
        ]))
        .expect("a document");
        assert!(document.notices().is_empty(), "{:?}", document.notices());
        let controls = &document.illustration().controls;
        let names: Vec<&str> = controls.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["Peel", "progress", "enabled", "2", "Where"]);
        let range = |index: usize| match controls[index].range {
            ControlRange::Number { min, max, .. } => [min, max],
            ControlRange::Flag(_) => panic!("a number"),
        };
        assert_eq!(range(0), [0.0, 1.0]);
        assert_eq!(range(1), [0.2, 1.0], "within the range of the value");
        assert_eq!(controls[2].range, ControlRange::Flag(true));
        assert_eq!(range(4), [-0.5, 0.5]);
        let text = document.to_json_compact();
        let again = Document::from_json(&text).expect("a document");
        assert_eq!(again.illustration().controls, *controls);
    }

    #[test]
    fn other_controls_are_kept_and_named() {
        for (control, why) in [
            (
                json!({ "pointer": "/templates/0/at/0" }),
                "needs `min` and `max`",
            ),
            (
                json!({ "pointer": "/templates/9/params/progress" }),
                "no number",
            ),
            (
                json!({ "pointer": "/templates/0/params/nothing" }),
                "no number",
            ),
            (json!({ "pointer": "/templates/0/kind" }), "no number"),
            (json!({ "pointer": "/steps/0/seconds" }), "no number"),
            (json!({ "pointer": "/controls/0/min" }), "no number"),
            (json!({ "pointer": "nowhere" }), "no number"),
            (json!({ "pointer": "" }), "no number"),
            (
                json!({ "pointer": "/camera/fov", "min": 60, "max": 20 }),
                "not below",
            ),
        ] {
            let document = document(json!([control])).expect("a document");
            assert!(document.illustration().controls.is_empty(), "{control}");
            let notice = document.notices().first().map(ToString::to_string);
            let notice = notice.unwrap_or_default();
            assert!(
                notice.starts_with("/controls/0") && notice.contains(why),
                "{control}: {notice}"
            );
            assert!(
                document.to_json_compact().contains("controls"),
                "it is kept"
            );
        }
        let many = vec![json!({ "pointer": "/camera/fov" }); 17];
        assert!(document(json!(many)).is_err_and(|why| why.contains("/controls")));
        for wrong in [
            json!(7),
            json!([7]),
            json!([{ "pointer": 7 }]),
            json!([{ "min": "a" }]),
        ] {
            assert!(document(wrong.clone()).is_err(), "{wrong}");
        }
    }
}
