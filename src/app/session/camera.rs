//! The camera of the document as the user turns and zooms it, and the views that have names.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::{Quat, Vec2, Vec3};

use crate::data::Site;
use crate::document::{Camera, DISTANCE_RANGE};

pub use crate::document::{axes, between, orbit, roll, shift, zoom};

/// A part of the subject whose centroid lies nearer to the middle has no side of its own: subject units, and a share of
/// how far the part reaches.
const NO_SIDE: (f32, f32) = (0.08, 0.6);
/// A part that lies so much to a side, in parts of its height over the middle, is not above or below.
const ASIDE: f32 = 0.4;
/// How much of a part's reach has to be in the picture: few parts are round.
const SEEN: f32 = 0.7;
/// Room around a part that the camera goes to.
const ROOM: f32 = 1.2;

/// A direction from which anatomists look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardView {
    /// From anterior: the face of a head.
    Front,
    /// From posterior: the back of a head.
    Back,
    /// From the patient's right.
    Right,
    /// From the patient's left.
    Left,
    /// From superior: the crown of a head.
    Top,
    /// From inferior: the chin of a head.
    Bottom,
}

impl StandardView {
    /// In the order of the number keys.
    pub const ALL: [Self; 6] = [
        Self::Front,
        Self::Back,
        Self::Right,
        Self::Left,
        Self::Top,
        Self::Bottom,
    ];

    /// As on the button: `Front`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "Front",
            Self::Back => "Back",
            Self::Right => "Right",
            Self::Left => "Left",
            Self::Top => "Top",
            Self::Bottom => "Bottom",
        }
    }

    /// What radiologists call the side, one letter.
    pub fn letter(self) -> &'static str {
        match self {
            Self::Front => "A",
            Self::Back => "P",
            Self::Right => "R",
            Self::Left => "L",
            Self::Top => "S",
            Self::Bottom => "I",
        }
    }

    /// The side it looks from, subject space.
    pub fn direction(self) -> Vec3 {
        match self {
            Self::Front => Vec3::Y,
            Self::Back => Vec3::NEG_Y,
            Self::Right => Vec3::X,
            Self::Left => Vec3::NEG_X,
            Self::Top => Vec3::Z,
            Self::Bottom => Vec3::NEG_Z,
        }
    }

    /// [`Camera::rotate`] of the view. From above and below the patient's right stays where it is from the front.
    pub fn rotation(self) -> Quat {
        match self {
            Self::Front => Quat::IDENTITY,
            Self::Back => Quat::from_rotation_z(PI),
            Self::Right => Quat::from_rotation_z(-FRAC_PI_2),
            Self::Left => Quat::from_rotation_z(FRAC_PI_2),
            Self::Top => Quat::from_rotation_x(FRAC_PI_2),
            Self::Bottom => Quat::from_rotation_x(-FRAC_PI_2),
        }
    }
}

/// [`Camera::rotate`] of the view from a direction, upright. From straight above or below the patient's right stays
/// where it is in the view before.
fn rotation_from(direction: Vec3, before: Quat) -> Quat {
    let direction = direction.normalize_or(axes(before)[2]);
    let right = axes(before)[0];
    let turn = if direction.truncate().length() > 1e-3 {
        (-direction.x).atan2(direction.y)
    } else {
        (-right.y).atan2(-right.x)
    };
    let elevation = direction.z.clamp(-1.0, 1.0).asin();
    (Quat::from_rotation_z(turn) * Quat::from_rotation_x(elevation)).normalize()
}

/// The camera turned about the subject to the side on which a part of it lies. A part in the middle is seen from
/// anywhere: the direction stays. Target and distance stay too, unless the part would not be in the picture.
pub fn turned_to(camera: &Camera, site: &Site) -> Camera {
    let mut turned = *camera;
    // The middle of the subject is the origin.
    let off_middle = site.centroid.length();
    if off_middle > NO_SIDE.0.max(NO_SIDE.1 * site.reach) {
        let mut side = site.centroid;
        // Rather from a side than from above or below, as long as the part is at a side at all.
        if side.truncate().length() > ASIDE * side.z.abs() {
            side.z *= 0.5;
        }
        turned.rotate = rotation_from(side, camera.rotate);
    }
    let from_target = site.centroid - turned.target;
    let [right, up, back] = axes(turned.rotate);
    let aside = Vec2::new(from_target.dot(right), from_target.dot(up)).length();
    let depth = turned.distance - from_target.dot(back);
    let seen = SEEN * site.reach;
    let half_angle = 0.5 * turned.fov_deg.to_radians();
    let is_seen = depth > seen
        && aside.atan2(depth) + (seen / depth.hypot(aside)).min(1.0).asin() <= half_angle;
    if !is_seen {
        turned.target = site.centroid;
        let needed = ROOM * seen / half_angle.sin().max(1e-3);
        turned.distance = turned.distance.max(needed);
        turned.distance = turned.distance.clamp(DISTANCE_RANGE.0, DISTANCE_RANGE.1);
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;

    #[test]
    fn each_standard_view_looks_from_its_side() {
        for standard in StandardView::ALL {
            let [right, up, back] = axes(standard.rotation());
            assert!(back.distance(standard.direction()) < 1e-5, "{standard:?}");
            assert!(
                right.cross(up).distance(back) < 1e-5,
                "right-handed, {standard:?}"
            );
        }
    }

    #[test]
    fn orbiting_keeps_the_patient_upright_and_stops_at_the_poles() {
        let mut camera = Camera::DOCUMENT_DEFAULT;
        orbit(&mut camera, vec2(1.0, 9.0));
        let [_, up, back] = axes(camera.rotate);
        assert!(back.z > 0.999, "above, not beyond: {back}");
        assert!(up.z > -1e-3, "upright: {up}");
        orbit(&mut camera, vec2(0.0, -9.0));
        assert!(axes(camera.rotate)[2].z < -0.999, "and below");
    }

    fn site(centroid: Vec3, reach: f32) -> Site {
        Site {
            middle: centroid,
            centroid,
            reach,
        }
    }

    #[test]
    fn the_view_turns_to_the_side_on_which_a_part_lies() {
        let mut camera = Camera::DOCUMENT_DEFAULT;
        orbit(&mut camera, vec2(0.4, 0.2));
        for standard in StandardView::ALL {
            let turned = turned_to(&camera, &site(standard.direction() * 0.3, 0.1));
            let [_, up, back] = axes(turned.rotate);
            assert!(back.distance(standard.direction()) < 1e-3, "{standard:?}");
            assert!(up.z > -1e-3, "upright, {standard:?}: {up}");
            assert_eq!(turned.target, camera.target, "{standard:?}");
            assert_eq!(turned.distance, camera.distance, "{standard:?}");
        }
        let right = turned_to(&camera, &site(Vec3::X * 0.3, 0.1));
        let sameness = right.rotate.dot(StandardView::Right.rotation()).abs();
        assert!(sameness > 0.9999, "as from the right: {sameness}");
    }

    #[test]
    fn a_part_in_the_middle_is_seen_from_where_one_is() {
        let camera = Camera::DOCUMENT_DEFAULT;
        for part in [
            site(Vec3::new(0.0, -0.05, 0.0), 0.02),
            site(Vec3::new(0.1, 0.0, 0.2), 0.5),
        ] {
            assert_eq!(turned_to(&camera, &part), camera, "{part:?}");
        }
    }

    #[test]
    fn the_camera_goes_only_as_far_as_it_has_to() {
        let near = Camera {
            target: Vec3::new(0.0, 0.4, 0.3),
            distance: 0.3,
            ..Camera::DOCUMENT_DEFAULT
        };
        // A small part out of the picture is brought to its middle, as close as one was.
        let small = turned_to(&near, &site(Vec3::new(0.0, 0.0, -0.4), 0.02));
        assert_eq!((small.target, small.distance), (Vec3::Z * -0.4, 0.3));
        // A large one needs distance; all of the object is seen from there.
        let large = turned_to(&near, &site(Vec3::new(0.0, 0.0, 0.05), 0.6));
        assert_eq!(large.target, Vec3::Z * 0.05);
        assert!((1.5..2.5).contains(&large.distance), "{large:?}");
        assert_eq!(large.rotate, near.rotate);
    }
}
