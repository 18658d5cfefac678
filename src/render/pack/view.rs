use crate::document::Camera;
use glam::{Affine3A, Mat3A, Vec2, Vec3, Vec3A};

/// A camera together with the size of its picture. A view turns pixels into rays, and points of subject space into
/// pixels. A view is cheap to make, so each frame makes a new one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// View space (camera at the origin, looking along -z, y up) to subject space. Rigid.
    pub subject_from_view: Affine3A,
    /// Tangents of half the field of view across width and height.
    pub lens: Vec2,
    /// Width and height of the picture, pixels.
    pub size_px: Vec2,
}

/// Least distance between the eye and the target, subject units. A document may give the distance 0, which would put
/// the eye into the target.
const LEAST_DISTANCE: f32 = 1e-3;

impl View {
    /// The view of a camera for a picture size (each side at least 1 pixel). The field of view spans the shorter side.
    pub fn new(camera: &Camera, size_px: [u32; 2]) -> Self {
        let size = Vec2::new(size_px[0].max(1) as f32, size_px[1].max(1) as f32);
        let half = (camera.fov_deg.clamp(1.0, 150.0).to_radians() * 0.5).tan();
        // With the identity as its rotation, the camera looks from +y towards -y, and +z is up. So the x axis of view
        // space is the -x axis of subject space.
        let at_rest = Mat3A::from_cols(Vec3A::NEG_X, Vec3A::Z, Vec3A::Y);
        let turned = Mat3A::from_quat(camera.rotate) * at_rest;
        let back = turned.z_axis;
        Self {
            subject_from_view: Affine3A {
                matrix3: turned,
                translation: Vec3A::from(camera.target)
                    + back * camera.distance.max(LEAST_DISTANCE),
            },
            lens: size / size.min_element() * half,
            size_px: size,
        }
    }

    /// One pixel that looks along a ray of subject space, `dir` a unit vector.
    pub(crate) fn along(origin: Vec3, dir: Vec3) -> Self {
        let back = -dir;
        let side = back.any_orthonormal_vector();
        let turned = Mat3A::from_cols(side.into(), back.cross(side).into(), back.into());
        Self {
            subject_from_view: Affine3A {
                matrix3: turned,
                translation: origin.into(),
            },
            lens: Vec2::splat(1e-4),
            size_px: Vec2::ONE,
        }
    }

    /// The eye, subject space.
    pub fn eye(&self) -> Vec3 {
        self.subject_from_view.translation.into()
    }

    /// Ray through a point of the picture (pixels, origin top left): eye and unit direction, subject space.
    pub fn ray(&self, pixel: Vec2) -> (Vec3, Vec3) {
        let ndc = pixel / self.size_px * 2.0 - 1.0;
        let dir = Vec3A::new(ndc.x * self.lens.x, -ndc.y * self.lens.y, -1.0);
        let turned = self.subject_from_view.matrix3 * dir;
        (self.eye(), Vec3::from(turned).normalize_or(Vec3::NEG_Y))
    }

    /// Where a point of subject space falls in the picture, pixels; `None` behind the eye.
    pub fn pixel_from_subject(&self, pos: Vec3) -> Option<Vec2> {
        let in_view = self
            .subject_from_view
            .matrix3
            .transpose()
            .mul_vec3a(Vec3A::from(pos) - self.subject_from_view.translation);
        if in_view.z > -1e-6 {
            return None;
        }
        let ndc = Vec2::new(in_view.x / self.lens.x, -in_view.y / self.lens.y) / -in_view.z;
        Some((ndc + 1.0) * 0.5 * self.size_px)
    }

    /// Subject units that one pixel spans at this distance from the eye.
    pub fn units_per_pixel(&self, distance: f32) -> f32 {
        2.0 * self.lens.x * distance / self.size_px.x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    const CAMERA: Camera = Camera {
        target: Vec3::new(0.1, -0.2, 0.05),
        rotate: Quat::from_xyzw(0.1, 0.7, -0.2, 0.678_233),
        distance: 2.5,
        fov_deg: 30.0,
    };

    #[test]
    fn identity_looks_from_the_front_with_superior_up() {
        let camera = Camera {
            target: Vec3::ZERO,
            rotate: Quat::IDENTITY,
            ..CAMERA
        };
        let view = View::new(&camera, [200, 100]);
        assert!((view.eye() - Vec3::new(0.0, 2.5, 0.0)).length() < 1e-6);
        let up = view.pixel_from_subject(Vec3::new(0.0, 0.0, 0.1)).unwrap();
        assert!(up.y < 50.0 && (up.x - 100.0).abs() < 1e-3);
        // The patient's right (+x) is on the viewer's left.
        let right = view.pixel_from_subject(Vec3::new(0.1, 0.0, 0.0)).unwrap();
        assert!(right.x < 100.0);
    }

    #[test]
    fn pixels_and_rays_agree() {
        let view = View::new(&CAMERA, [317, 211]);
        for pixel in [
            Vec2::new(3.0, 200.0),
            Vec2::new(158.5, 105.5),
            Vec2::new(300.0, 7.0),
        ] {
            let (eye, dir) = view.ray(pixel);
            let back = view.pixel_from_subject(eye + dir * 1.7).unwrap();
            assert!(
                (back - pixel).length() < 1e-2,
                "{pixel} came back as {back}"
            );
        }
    }
}
