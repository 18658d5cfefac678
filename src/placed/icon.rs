use crate::displace::Holds;
use crate::document::{
    Camera, ControlPoints, ParamValue, PlacedTemplate, TemplateData, TemplateKind,
};
use crate::math::Placement;
use glam::{Quat, Vec3};

/// Far enough for the opened cube to fit.
const DISTANCE: f32 = 3.4;

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
