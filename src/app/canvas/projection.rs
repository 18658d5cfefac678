//! Where a point of the object lands in the window, and what a place of the window shows.

use egui::{Pos2, Rect, Vec2};
use glam::Vec3;

use crate::app::session::camera::axes;
use crate::document::Camera;

/// Zoom per point of the wheel, exponent; by as much a tool grows that the wheel sizes.
pub(crate) const ZOOM_PER_POINT: f32 = 0.0022;

/// Where in a picture of so many pixels a place of the window is, if the picture fills this rectangle.
pub(crate) fn pixels_of(rect: Rect, size: [u32; 2]) -> impl Fn(Pos2) -> [f32; 2] {
    let scale = size[0] as f32 / rect.width().max(1.0);
    move |pos| [(pos.x - rect.min.x) * scale, (pos.y - rect.min.y) * scale]
}

/// Moves the target so that the picture follows the pointer by `delta` points.
pub(crate) fn pan(camera: &mut Camera, view: &Projection, delta: Vec2) {
    let unit = 1.0 / view.points_per_unit(camera.target);
    camera.target += (view.up * delta.y - view.right * delta.x) * unit;
    camera.target = camera.target.clamp(Vec3::splat(-2.0), Vec3::splat(2.0));
}

/// How subject space lands in a rectangle of the window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// Rectangle of the picture in the window, points.
    pub rect: Rect,
    /// The eye, subject space.
    pub eye: Vec3,
    /// To the right in the picture, unit length.
    pub right: Vec3,
    /// Up in the picture, unit length.
    pub up: Vec3,
    /// Towards the viewer, unit length.
    pub back: Vec3,
    /// Points per unit at distance 1.
    scale: f32,
}

impl Projection {
    /// The projection of a camera into a rectangle, points.
    pub(crate) fn new(camera: &Camera, rect: Rect) -> Self {
        let [right, up, back] = axes(camera.rotate);
        let half_fov = 0.5 * camera.fov_deg.to_radians();
        Self {
            rect,
            eye: camera.target + back * camera.distance,
            right,
            up,
            back,
            scale: 0.5 * rect.width().min(rect.height()) / half_fov.tan().max(1e-4),
        }
    }

    /// Unit vector towards the eye, subject space.
    pub(crate) fn back(&self) -> Vec3 {
        self.back
    }

    /// Where a point is seen. `None` behind the eye or all but in it.
    pub(crate) fn ui_from_subject(&self, pos: Vec3) -> Option<Pos2> {
        let to = pos - self.eye;
        let depth = -to.dot(self.back);
        (depth > 1e-3).then(|| {
            let k = self.scale / depth;
            self.rect.center() + Vec2::new(to.dot(self.right) * k, -to.dot(self.up) * k)
        })
    }

    /// Direction of the ray through a place of the window, unit length; it starts at the eye.
    pub(crate) fn ray(&self, pos: Pos2) -> Vec3 {
        let offset = (pos - self.rect.center()) / self.scale;
        (self.right * offset.x - self.up * offset.y - self.back).normalize_or(-self.back)
    }

    /// Points that one subject unit takes, across the line of sight, at a place.
    pub(crate) fn points_per_unit(&self, pos: Vec3) -> f32 {
        self.scale / (-(pos - self.eye).dot(self.back)).max(1e-3)
    }

    /// Where the ray through a place of the window meets a plane. `None` if it is seen edge-on or lies behind.
    pub(crate) fn on_plane(&self, pos: Pos2, origin: Vec3, normal: Vec3) -> Option<Vec3> {
        let ray = self.ray(pos);
        let facing = ray.dot(normal);
        if facing.abs() < 1e-3 {
            return None;
        }
        let t = (origin - self.eye).dot(normal) / facing;
        (t > 0.0).then(|| self.eye + ray * t)
    }

    /// Parameter along the line `origin + t · axis` nearest to the ray through a place of the window.
    /// `None` if the line points at the eye.
    pub(crate) fn along_line(&self, pos: Pos2, origin: Vec3, axis: Vec3) -> Option<f32> {
        let ray = self.ray(pos);
        let between = origin - self.eye;
        let (aa, ar) = (axis.length_squared(), axis.dot(ray));
        let denominator = aa - ar * ar;
        if denominator < 1e-4 * aa {
            return None;
        }
        Some((ar * ray.dot(between) - axis.dot(between)) / denominator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::camera;
    use egui::{pos2, vec2};

    fn view(camera: &Camera) -> Projection {
        Projection::new(
            camera,
            Rect::from_min_size(pos2(10.0, 20.0), vec2(400.0, 300.0)),
        )
    }

    #[test]
    fn the_patients_right_is_on_the_left_of_a_picture_from_the_front() {
        let view = view(&Camera::DOCUMENT_DEFAULT);
        let at = |pos| view.ui_from_subject(pos).expect("in front of the eye");
        assert!(at(Vec3::X * 0.3).x < view.rect.center().x, "right is left");
        assert!(at(Vec3::Z * 0.3).y < view.rect.center().y, "superior is up");
        assert!(
            view.ui_from_subject(Vec3::Y * 3.0).is_none(),
            "behind the eye"
        );
    }

    #[test]
    fn a_ray_goes_through_the_point_it_was_made_from() {
        let mut camera = Camera::DOCUMENT_DEFAULT;
        camera::orbit(&mut camera, glam::vec2(0.7, 0.4));
        let view = view(&camera);
        let pos = Vec3::new(0.2, -0.1, 0.35);
        let seen = view.ui_from_subject(pos).expect("in front of the eye");
        let met = view
            .on_plane(seen, pos, view.back)
            .expect("the plane faces the eye");
        assert!(met.distance(pos) < 1e-4, "{met}");
        let along = view.along_line(seen, Vec3::new(0.2, -0.1, 0.0), Vec3::Z);
        assert!(
            (along.expect("not along the ray") - 0.35).abs() < 1e-3,
            "along z"
        );
    }

    #[test]
    fn dragging_turns_the_near_side_with_the_hand() {
        let mut turned = Camera::DOCUMENT_DEFAULT;
        camera::orbit(&mut turned, glam::vec2(0.1, 0.1));
        let seen = view(&turned)
            .ui_from_subject(Vec3::Y * 0.4)
            .expect("in front");
        let was = view(&Camera::DOCUMENT_DEFAULT)
            .ui_from_subject(Vec3::Y * 0.4)
            .expect("in front");
        assert!(
            seen.x > was.x && seen.y > was.y,
            "follows to the right and down: {was:?} {seen:?}"
        );
    }

    #[test]
    fn panning_moves_the_picture_by_as_many_points() {
        let mut camera = Camera::DOCUMENT_DEFAULT;
        let before = view(&camera);
        pan(&mut camera, &before, vec2(30.0, -12.0));
        let after = view(&camera).ui_from_subject(Vec3::ZERO).expect("in front");
        assert!(
            (after - before.rect.center() - vec2(30.0, -12.0)).length() < 0.01,
            "{after:?}"
        );
    }
}
