//! Work on whole templates: mirroring across a plane of the patient, groups, copies between documents as text.

use glam::{Mat3, Quat, Vec3};
use serde_json::{Value, json};

use super::limits::{FORMAT, MAX_BYTES};
use super::model::{ParamValue, PlacedTemplate, TemplateData};
use super::text::{DocumentError, json as reading};
use super::tree::Document;
use super::write::Edit;
use crate::displace::Holds;
use crate::math::Placement;

/// A plane through the middle of the subject, by its name in anatomy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Divides right and left: x = 0.
    Sagittal,
    /// Divides front and back: y = 0.
    Coronal,
    /// Divides above and below: z = 0.
    Axial,
}

impl Plane {
    /// All planes, in the order of the axes x, y, z that are normal to them.
    pub const ALL: [Self; 3] = [Self::Sagittal, Self::Coronal, Self::Axial];

    /// Index of the axis of subject space that is normal to the plane.
    pub fn axis(self) -> usize {
        match self {
            Self::Sagittal => 0,
            Self::Coronal => 1,
            Self::Axial => 2,
        }
    }
}

/// The reflection that reverses one axis.
fn reversing(axis: usize) -> Mat3 {
    let mut signs = Vec3::ONE;
    signs[axis] = -1.0;
    Mat3::from_diagonal(signs)
}

/// The value of a parameter that has a hand, seen in a mirror across an axis.
fn other_hand(value: ParamValue, axis: usize) -> ParamValue {
    match value {
        ParamValue::Number(value) => ParamValue::Number(-value),
        ParamValue::Vector(v) => ParamValue::Vector(reversing(axis) * v),
        // F R F: about the axis as it is, about the others backwards.
        ParamValue::Rotation(q) => {
            let about = -(reversing(axis) * Vec3::new(q.x, q.y, q.z));
            ParamValue::Rotation(Quat::from_xyzw(about.x, about.y, about.z, q.w))
        }
        other => other,
    }
}

/// Placement and parameters of the mirror image of a template: it does on the other side of the plane what the template
/// does on this side.
///
/// With M the reflection of the subject, the mirrored map is M T M. M R alone is no rotation, so one axis of the
/// template's cube is reversed as well (F): the placement M R F is proper again, and the kind must do F D F in its
/// cube. Most kinds are symmetric about one of their middle planes and do that unchanged; the others have parameters
/// with a hand (`Mirror::handed`), which change.
pub fn mirrored(template: &PlacedTemplate, plane: Plane) -> (Placement, Vec<ParamValue>) {
    let mirror = &template.kind.facts().mirror;
    let specs = template.kind.spec().params.iter();
    let params = specs.zip(&template.params).map(|(spec, value)| {
        if mirror.handed.contains(&spec.name) {
            other_hand(*value, mirror.axis)
        } else {
            *value
        }
    });
    let placement = template.placement;
    let reflect = reversing(plane.axis());
    let rotate = reflect * Mat3::from_quat(placement.rotate) * reversing(mirror.axis);
    let placement = Placement {
        at: reflect * placement.at,
        rotate: Quat::from_mat3(&rotate).normalize(),
        size: placement.size,
    };
    (placement, params.collect())
}

/// The edits that mirror a template, or a copy of it that is inserted after it.
///
/// There are none for a template that holds a file or an object, or a tool that is a mesh: samples, objects and meshes
/// cannot be mirrored.
pub fn mirror(template: &PlacedTemplate, plane: Plane, as_copy: bool) -> Vec<Edit> {
    let is_held = match &template.data {
        TemplateData::Tools(tools) => !tools.can_be_mirrored(),
        _ => matches!(template.kind.facts().holds, Holds::File | Holds::Object),
    };
    if is_held {
        return Vec::new();
    }
    let (placement, params) = mirrored(template, plane);
    let index = template.index + usize::from(as_copy);
    let mut edits = Vec::new();
    if as_copy {
        edits.push(Edit::DuplicateTemplate {
            template: template.index,
        });
    }
    edits.push(Edit::SetPlacement {
        template: index,
        placement,
    });
    if let Some(curve) = &template.curve
        && template.kind.facts().mirror.axis == 0
    {
        edits.push(Edit::SetCurve {
            template: index,
            curve: Some(curve.mirrored()),
        });
    }
    if let TemplateData::Points(points) = &template.data {
        let mut points = points.clone();
        for point in &mut points.points {
            point.at.x = 1.0 - point.at.x;
            point.shift.x = -point.shift.x;
        }
        for place in &mut points.cut {
            place.x = 1.0 - place.x;
        }
        edits.push(Edit::SetControlPoints {
            template: index,
            points,
        });
    }
    if let TemplateData::Tools(tools) = &template.data {
        edits.push(Edit::SetTools {
            template: index,
            tools: tools.mirrored(),
        });
    }
    let specs = template.kind.spec().params;
    for ((spec, old), new) in specs.iter().zip(&template.params).zip(params) {
        if *old != new {
            edits.push(Edit::SetParam {
                template: index,
                param: spec.name,
                value: new,
            });
        }
    }
    edits
}

/// Name of the group of an entry of `templates`; empty for none.
pub fn group_of(document: &Document, template: usize) -> &str {
    let group = document.get(&format!("/templates/{template}/group"));
    group.and_then(Value::as_str).unwrap_or_default()
}

/// The group of an object, by its index; empty if it is in none.
pub fn object_group_of(document: &Document, object: usize) -> &str {
    let group = document.get(&format!("/objects/{object}/group"));
    group.and_then(Value::as_str).unwrap_or_default()
}

/// Names of the groups of templates and objects, in the order in which they first occur.
pub fn groups(document: &Document) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let lists = ["/templates", "/objects"].map(|at| document.get(at).and_then(Value::as_array));
    for entry in lists.into_iter().flatten().flatten() {
        let name = entry.get("group").and_then(Value::as_str);
        if let Some(name) = name.filter(|name| !name.is_empty())
            && !names.iter().any(|known| known == name)
        {
            names.push(name.to_owned());
        }
    }
    names
}

/// A name for a group that is not taken yet: the wanted name, with a number if need be.
pub fn free_group_name(wanted: &str, taken: &[String]) -> String {
    let is_free = |name: &String| !taken.contains(name);
    let numbered = (2..).map(|number| format!("{wanted} {number}"));
    std::iter::once(wanted.to_owned())
        .chain(numbered)
        .find(is_free)
        .unwrap_or_default()
}

/// The key that marks templates on the clipboard.
const MARK: &str = "fabrica-templates";

/// Templates of a document as text for the clipboard: `{"fabrica-templates":[…]}`, unknown kinds and keys included.
pub fn templates_to_text(document: &Document, templates: &[usize]) -> String {
    let found = templates
        .iter()
        .filter_map(|index| document.get(&format!("/templates/{index}")));
    json!({ MARK: found.cloned().collect::<Vec<Value>>() }).to_string()
}

/// Reads templates from a text that [`templates_to_text`] wrote, checked by the rules of a document. `None` if the text
/// is another one.
///
/// # Errors
/// The first fault, named by its place; see [`DocumentError`].
pub fn templates_from_text(text: &str) -> Option<Result<Vec<Value>, DocumentError>> {
    let text = text.trim();
    let head: String = text
        .chars()
        .filter(|c| !c.is_whitespace())
        .take(MARK.len() + 4)
        .collect();
    if !head.starts_with(&format!("{{\"{MARK}\":")) {
        return None;
    }
    if text.len() > MAX_BYTES {
        return Some(Err(DocumentError::TooLarge {
            found: text.len(),
            limit: MAX_BYTES,
        }));
    }
    Some(read(text))
}

fn read(text: &str) -> Result<Vec<Value>, DocumentError> {
    let mut value = reading::read(text)?;
    let list = value.get_mut(MARK).map(Value::take).unwrap_or_default();
    let document = Document::from_value(json!({ "fabrica": FORMAT, "templates": list }))?;
    let list = document.get("/templates").and_then(Value::as_array);
    Ok(list.cloned().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::model::TemplateKind;

    fn placed(json: &str) -> Document {
        Document::from_json(&format!(r#"{{"fabrica":1,"templates":[{json}]}}"#))
            .expect("a document")
    }

    #[test]
    fn mirroring_twice_is_nothing() {
        for kind in TemplateKind::ALL {
            let document = placed(&format!(
                r#"{{"kind":"{}","at":[0.1,0.2,-0.3],"rotate":[0.1826,0.3651,0.5477,0.7303]}}"#,
                kind.spec().name
            ));
            let template = &document.illustration().templates[0];
            for plane in Plane::ALL {
                let (placement, params) = mirrored(template, plane);
                let axis = plane.axis();
                assert_eq!(placement.at[axis], -template.placement.at[axis]);
                let once = PlacedTemplate {
                    placement,
                    params,
                    ..template.clone()
                };
                let (back, params) = mirrored(&once, plane);
                assert!(
                    back.rotate.dot(template.placement.rotate).abs() > 1.0 - 1e-5,
                    "{kind:?} {plane:?}"
                );
                assert_eq!(params, template.params, "{kind:?} {plane:?}");
            }
        }
    }

    #[test]
    fn templates_travel_as_text() {
        let document = placed(
            r#"{"kind":"peel","name":"scalp","group":"opening","params":{"depth":0.2},"later":[1]},{"kind":"newer"}"#,
        );
        let text = templates_to_text(&document, &[0, 1, 7]);
        let templates = templates_from_text(&text)
            .expect("it is such a text")
            .expect("it is right");
        assert_eq!(templates.len(), 2, "{text}");
        let other = Edit::InsertTemplates {
            index: usize::MAX,
            templates,
        };
        let other = other.apply(&Document::new()).expect("it takes them");
        assert_eq!(other.get("/templates"), document.get("/templates"));
    }

    #[test]
    fn wrong_text_is_refused_in_words() {
        assert!(templates_from_text(r#"{"fabrica":1}"#).is_none());
        assert!(templates_from_text("").is_none());
        for wrong in [
            r#"{"fabrica-templates":3}"#,
            r#"{"fabrica-templates":[{"kind":"peel","at":[0,0]}]}"#,
            r#"{"fabrica-templates":[{"kind":"peel","size":"large"}]}"#,
            r#"{"fabrica-templates":[{}"#,
        ] {
            let result = templates_from_text(wrong).expect("it says that it is such a text");
            assert!(result.is_err(), "{wrong}");
        }
        let many = format!(
            r#"{{"fabrica-templates":[{}]}}"#,
            vec![r#"{"kind":"peel"}"#; 33].join(",")
        );
        assert!(templates_from_text(&many).expect("such a text").is_err());
    }
}
