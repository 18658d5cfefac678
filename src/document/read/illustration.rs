//! From the tree to what it means: every type checked, every default filled in, every value brought into its range.

use super::object::{Object, wrong};
use super::reader::Reader;
use crate::document::limits::{FORMAT, MAX_FIELDS, MAX_KEEP_SETS};
use crate::document::model::{
    Camera, Caption, FIGURE_FRONT, Illustration, PlacedTemplate, Step, SubjectRef, TemplateData,
    join_objects, keep_sets, limit_grids, limit_sweeps,
};
use crate::document::schema::ROOT;
use crate::document::text::json::number_text;
use crate::document::text::{DocumentError, Notice, NoticeKind};
use serde_json::{Map, Value};

/// Checks a tree and reads what it means.
///
/// # Errors
/// The first fault, by pointer.
pub(crate) fn resolve(
    root: &Map<String, Value>,
) -> Result<(Illustration, Vec<Notice>), DocumentError> {
    let mut reader = Reader::default();
    version(root)?;
    let illustration = reader.illustration(root)?;
    Ok((illustration, reader.notices))
}

fn version(root: &Map<String, Value>) -> Result<(), DocumentError> {
    let found = root.get("fabrica").ok_or(DocumentError::NoVersion)?;
    let Value::Number(number) = found else {
        return Err(wrong("/fabrica", "the format's number", found));
    };
    match number.as_u64() {
        Some(version) if version == u64::from(FORMAT) => Ok(()),
        Some(version) if version > u64::from(FORMAT) => Err(DocumentError::TooNew {
            found: number_text(number),
        }),
        _ if number.as_f64().is_some_and(|n| n > f64::from(FORMAT)) => Err(DocumentError::TooNew {
            found: number_text(number),
        }),
        _ => Err(wrong("/fabrica", "the format's number", found)),
    }
}

impl Reader {
    fn illustration(&mut self, root: &Map<String, Value>) -> Result<Illustration, DocumentError> {
        let root = Object {
            pointer: String::new(),
            map: root,
            keys: ROOT,
        };
        self.unknown_keys(&root);
        let subject_object = root.child("subject")?;
        let (subject, meshes_beside) = self.subject(&subject_object)?;
        let segments = self.segments(&subject_object)?;
        let recipes = self.recipes(&subject_object)?;
        let objects = self.objects(&root)?;
        let mut templates = Vec::new();
        for (index, object) in root.children("templates")?.enumerate() {
            templates.extend(self.template(index, &object?)?);
        }
        for (index, why) in join_objects(&mut templates, &objects) {
            let at = format!("/templates/{index}/params/object");
            self.note(at, NoticeKind::NotCarving { why: why.why() });
        }
        for index in limit_sweeps(&mut templates) {
            let what = "sweeps with more than 256 pieces of paths or 1,024 steps in all are";
            self.note(format!("/templates/{index}"), NoticeKind::NotDrawn { what });
        }
        let clay = match &subject {
            SubjectRef::Clay(clay) => Some(&**clay),
            _ => None,
        };
        for [template, tool] in limit_grids(&mut templates, clay) {
            let what = "more than sixteen different meshes as tools are";
            let at = format!("/templates/{template}/params/tools/{tool}");
            self.note(at, NoticeKind::NotDrawn { what });
        }
        let is_field = |t: &&PlacedTemplate| matches!(t.data, TemplateData::Field(_)) && t.enabled;
        if let Some(over) = templates.iter().filter(is_field).nth(MAX_FIELDS) {
            let what = "more than four fields are";
            self.note(
                format!("/templates/{}", over.index),
                NoticeKind::NotDrawn { what },
            );
        }
        let sets = keep_sets(&templates).len();
        if sets > MAX_KEEP_SETS {
            return Err(DocumentError::TooMany {
                pointer: "/templates".to_owned(),
                what: "different sets of kept tissue",
                found: sets,
                limit: MAX_KEEP_SETS,
            });
        }
        let figure = self.figure(&root.child("figure")?)?;
        let look = self.look(&root.child("look")?, &subject)?;
        let camera = self.camera(&root.child("camera")?)?;
        let mut captions = Vec::new();
        for object in root.children("labels")? {
            let object = object?;
            self.unknown_keys(&object);
            captions.push(Caption {
                at: self.vector(&object, "at")?,
                text: object.string("text")?,
                enabled: object.flag("enabled")?,
            });
        }
        let mut controls = Vec::new();
        for object in root.children("controls")? {
            let kind_of = |index| {
                let template = templates
                    .iter()
                    .find(|t: &&PlacedTemplate| t.index == index)?;
                Some(template.kind)
            };
            controls.extend(self.control(&object?, kind_of)?);
        }
        let mut steps = Vec::new();
        for object in root.children("steps")? {
            steps.push(self.step(&object?)?);
        }
        let mut illustration = Illustration {
            title: root.string("title")?,
            legend: root.string("caption")?,
            alt: self.limited_text(&root, "alt")?,
            credit: root.string("credit")?,
            lang: root.string("lang")?,
            subject,
            meshes_beside,
            segments,
            recipes,
            objects,
            templates,
            figure: root.map.contains_key("figure").then_some(figure),
            is_in_space: false,
            look,
            camera,
            captions,
            controls,
            steps,
        };
        if illustration.is_of_figure() {
            illustration.camera.rotate *= FIGURE_FRONT;
        }
        if let Some(is_figure) = illustration.subject.is_figure() {
            let what = ["a subject that is no figure", "a figure"][usize::from(is_figure)];
            for pointer in illustration.left_beside(is_figure) {
                self.note(pointer, NoticeKind::Beside { what });
            }
        }
        Ok(illustration)
    }

    fn camera(&mut self, object: &Object<'_>) -> Result<Camera, DocumentError> {
        self.unknown_keys(object);
        Ok(Camera {
            target: self.vector(object, "target")?,
            rotate: self.rotation(object, "rotate")?,
            distance: self.number(object, "distance")?,
            fov_deg: self.number(object, "fov")?,
        })
    }

    fn step(&mut self, object: &Object<'_>) -> Result<Step, DocumentError> {
        self.unknown_keys(object);
        // Only its shape: the values are checked where the steps are walked.
        object.child("set")?;
        Ok(Step {
            title: object.string("title")?,
            legend: object.string("caption")?,
            alt: self.limited_text(object, "alt")?,
            seconds: self.number(object, "seconds")?,
            hold_seconds: self.number(object, "hold")?,
            notes: object.string("notes")?,
        })
    }
}
