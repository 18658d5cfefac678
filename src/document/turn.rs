//! Turning a camera by hand, and the way between two cameras.

use super::model::Camera;
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::FRAC_PI_2;

/// Nearest and farthest distance of a camera that is moved by hand, subject units.
pub const DISTANCE_RANGE: (f32, f32) = (0.08, 20.0);

/// Right, up and backward (towards the viewer) of a camera, subject space.
pub fn axes(rotate: Quat) -> [Vec3; 3] {
    // The identity looks from +y towards -y with +z up, so the patient's right (+x) is on the viewer's left.
    [rotate * Vec3::NEG_X, rotate * Vec3::Z, rotate * Vec3::Y]
}

/// Turns the camera about its target. `delta` in radians: x to the right, y down, as the pointer moves.
/// The patient's long axis stays upright and the camera does not go over the poles.
pub fn orbit(camera: &mut Camera, delta: Vec2) {
    let [_, up, back] = axes(camera.rotate);
    // A camera hanging upside down (a document may say so) is turned the way the hand expects.
    let yaw = if up.z < -1e-3 { -delta.x } else { delta.x };
    let elevation = back.z.clamp(-1.0, 1.0).asin();
    let pitch = if up.z > -1e-3 {
        (elevation + delta.y).clamp(-FRAC_PI_2, FRAC_PI_2) - elevation
    } else {
        delta.y
    };
    let turned = Quat::from_rotation_z(-yaw) * camera.rotate * Quat::from_rotation_x(pitch);
    camera.rotate = turned.normalize();
}

/// Moves what is seen in the picture: parts of the picture's shorter side to the right and down.
pub fn shift(camera: &mut Camera, by: Vec2) {
    let [right, up, _] = axes(camera.rotate);
    let side = 2.0 * camera.distance * (0.5 * camera.fov_deg.to_radians()).tan();
    camera.target += (up * by.y - right * by.x) * side;
}

/// Rolls the camera about its line of sight, radians, clockwise picture for positive.
pub fn roll(camera: &mut Camera, angle: f32) {
    camera.rotate = (camera.rotate * Quat::from_rotation_y(angle)).normalize();
}

/// Comes closer by a factor above 1, goes away by one below.
pub fn zoom(camera: &mut Camera, factor: f32) {
    if factor.is_finite() && factor > 0.0 {
        camera.distance = (camera.distance / factor).clamp(DISTANCE_RANGE.0, DISTANCE_RANGE.1);
    }
}

/// Between two cameras, `t` from 0 to 1; used to glide to a view instead of jumping.
pub fn between(from: &Camera, to: &Camera, t: f32) -> Camera {
    let ease = t * t * (3.0 - 2.0 * t);
    Camera {
        target: from.target.lerp(to.target, ease),
        rotate: from.rotate.slerp(to.rotate, ease).normalize(),
        distance: from.distance + (to.distance - from.distance) * ease,
        fov_deg: from.fov_deg + (to.fov_deg - from.fov_deg) * ease,
    }
}
