use crate::displace::Holds;
use crate::document::{
    Background, Camera, ControlPoints, Document, DocumentError, Edit, ObjectPlacement, ObjectRef,
    ParamValue, PlacedTemplate, SubjectRef, SweepTools, TemplateData, TemplateKind,
};
use crate::math::Placement;
use glam::{Quat, Vec3};
use serde_json::json;

/// Far enough for the opened cube to fit.
const DISTANCE: f32 = 3.4;

/// The tool by which a template carves in its icon, and where it stands in the cube.
const TOOL: &str = "retractor";
const TOOL_AT: ObjectPlacement = ObjectPlacement {
    at: Vec3::new(0.0, 0.0, 0.4),
    rotate: Quat::IDENTITY,
    size: 1.2,
};

/// Pixels along an icon's side in the sheet of icons: twice its size in the catalogue in points.
pub const ICON_PX: u32 = 112;
/// Icons in a row of the sheet of icons.
pub const ICON_COLUMNS: u32 = 6;

/// The kinds that the catalogue offers, in the order in which the sheet of icons shows them, row by row.
pub fn icon_kinds() -> impl Iterator<Item = TemplateKind> {
    let is_offered = |kind: &TemplateKind| kind.facts().catalogue.is_some();
    TemplateKind::ALL.into_iter().filter(is_offered)
}

/// The template and the camera of a kind's icon, to be drawn on the built-in `cube`.
pub fn icon(kind: TemplateKind) -> (PlacedTemplate, Camera) {
    let spec = kind.spec();
    let icon = &kind.facts().icon;
    let params = spec.params.iter().map(|param| {
        let given = icon.params.iter().find(|(name, _)| *name == param.name);
        match (given, param.kind.default_value()) {
            (Some((_, value)), ParamValue::Number(_)) => ParamValue::Number(*value),
            (_, default) => default,
        }
    });
    let data = match kind.facts().holds {
        Holds::Points => TemplateData::Points(ControlPoints {
            points: icon.points.to_vec(),
            cut: Vec::new(),
        }),
        Holds::Object => TemplateData::Object(ObjectRef {
            name: TOOL.to_owned(),
            found: None,
        }),
        Holds::Tools => TemplateData::Tools(SweepTools::default()),
        Holds::Parameters | Holds::File => TemplateData::None,
    };
    let placement = Placement {
        at: Vec3::from_array(icon.at),
        rotate: Quat::IDENTITY,
        size: Vec3::from_array(icon.size),
    };
    let template = PlacedTemplate {
        params: params.collect(),
        data,
        ..PlacedTemplate::new(kind, placement)
    };
    let [yaw, pitch] = icon.yaw_pitch_deg.map(f32::to_radians);
    let camera = Camera {
        target: Vec3::ZERO,
        rotate: Quat::from_rotation_z(yaw) * Quat::from_rotation_x(pitch),
        distance: DISTANCE,
        fov_deg: 30.0,
    };
    (template, camera)
}

/// The document that a kind's icon shows: the built-in `cube` with the template of [`icon`], nothing behind the cube.
///
/// # Errors
/// A value of the icon that the document refuses: a fault in the facts of the kind.
pub fn icon_document(kind: TemplateKind) -> Result<Document, DocumentError> {
    let (template, camera) = icon(kind);
    let mut edits = vec![
        Edit::SetSubject(SubjectRef::newest("cube")),
        Edit::SetBackground(Background::None),
        Edit::SetCamera(camera),
        Edit::AddTemplate {
            index: 0,
            kind,
            placement: template.placement,
        },
    ];
    let params = kind.spec().params.iter().zip(&template.params);
    edits.extend(params.map(|(param, value)| Edit::SetParam {
        template: 0,
        param: param.name,
        value: *value,
    }));
    if let TemplateData::Object(held) = &template.data {
        edits.push(Edit::AddObject {
            index: 0,
            object: json!({ "builtin": held.name, "name": held.name }),
        });
        edits.push(Edit::PlaceObject {
            object: 0,
            placement: TOOL_AT,
        });
        edits.push(Edit::Set {
            pointer: "/templates/0/params/object".to_owned(),
            value: json!(held.name),
            name: String::new(),
        });
    }
    if let TemplateData::Points(points) = template.data {
        edits.push(Edit::SetControlPoints {
            template: 0,
            points,
        });
    }
    let name = String::new();
    Edit::All { name, edits }.apply(&Document::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A document has decimals of limited length, so that values may differ a little from those of the icon.
    #[test]
    fn the_document_shows_the_icon() {
        for kind in icon_kinds() {
            let (icon, camera) = icon(kind);
            let document = icon_document(kind).expect("good facts");
            let shown = document.illustration();
            let [template] = shown.templates.as_slice() else {
                panic!("{kind:?}: {:?}", shown.templates);
            };
            let is_same = |(a, b): (&ParamValue, &ParamValue)| match (a, b) {
                (ParamValue::Number(a), ParamValue::Number(b)) => (a - b).abs() < 1e-4,
                (a, b) => a == b,
            };
            let pairs = || template.params.iter().zip(&icon.params);
            assert!(pairs().all(is_same), "{kind:?}: {:?}", template.params);
            if kind == TemplateKind::Carve {
                // Its object gives it its place.
                let found = template.carves_by().expect("the tool");
                assert_eq!(found.placement, Some(TOOL_AT));
                continue;
            }
            assert_eq!(template.data, icon.data, "{kind:?}");
            assert!(template.placement.at.distance(icon.placement.at) < 1e-4);
            assert!(template.placement.size.distance(icon.placement.size) < 1e-4);
            assert!(shown.camera.rotate.angle_between(camera.rotate) < 1e-3);
            assert!((shown.camera.distance - camera.distance).abs() < 1e-4);
        }
        assert_eq!(
            icon_kinds().count(),
            TemplateKind::ALL.len() - 1,
            "but field"
        );
    }
}
