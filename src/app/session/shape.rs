//! Where and how large a new template lies on a surface.

use glam::{Mat3, Quat, Vec3};

use super::camera;
use crate::displace::Shape;
use crate::document::{Camera, TemplateKind};
use crate::math::Placement;

/// How much of the plane through its target a camera sees across the picture's shorter side, subject units.
pub(super) fn seen_across(camera: &Camera) -> f32 {
    2.0 * camera.distance * (0.5 * camera.fov_deg.to_radians()).tan()
}

/// The box of a new template that is put on a surface: its z axis along the normal, its y axis up in the picture as far
/// as that goes, its top a little above the surface. `pos` in subject space; `normal` points out of the object.
pub fn placement_on_surface(
    kind: TemplateKind,
    pos: Vec3,
    normal: Vec3,
    camera: &Camera,
) -> Placement {
    // The size follows the view: about a quarter of the picture's shorter side, within reason.
    let side = (0.25 * seen_across(camera)).clamp(0.08, 0.5);
    let z = normal.normalize_or(Vec3::Y);
    let [right, up, _] = camera::axes(camera.rotate);
    let y = (up - z * up.dot(z))
        .try_normalize()
        .or_else(|| (right - z * right.dot(z)).try_normalize());
    let y = y.unwrap_or_else(|| z.any_orthonormal_vector());
    let x = y.cross(z);
    let rotate = Quat::from_mat3(&Mat3::from_cols(x, y, z)).normalize();
    let Shape { size, above } = kind.facts().shape;
    let size = Vec3::from_array(size) * side;
    // `above` of the box stands over the surface, the rest reaches into the object.
    let at = pos + z * size.z * (above - 0.5);
    Placement { at, rotate, size }
}

/// A camera that looks at a box along its z axis from above, from outside of any subject.
pub(super) fn camera_along(placement: &Placement) -> Camera {
    let z = (placement.rotate * Vec3::Z).normalize_or(Vec3::Z);
    // The camera's identity looks from +y towards −y with +z up.
    let rotate = Quat::from_rotation_arc(Vec3::Y, z);
    Camera {
        target: placement.at,
        rotate,
        distance: 3.0,
        fov_deg: 20.0,
    }
}
