//! What stands at the edges of a picture where its author wishes it: a scale bar, and the letters of the patient's
//! sides.

use crate::describe::side_letters;
use crate::document::{Camera, Illustration};
use glam::Vec3;

use super::view::View;

/// Greatest length of a scale bar, of the picture's width.
const LONGEST: f64 = 0.25;

/// A bar of a round length, by which sizes in a picture are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaleBar {
    /// What it stands for, mm: 1, 2 or 5 times a power of ten.
    pub mm: f64,
    /// Its length in the picture, pixels.
    pub length_px: f32,
}

impl ScaleBar {
    /// The longest round bar that is at most a quarter of the picture's width. The camera is a perspective one, so one
    /// length has one size at one depth only: the bar holds in the plane through the camera's target that faces the
    /// eye. What is nearer is larger than the bar says. `None` where no length can be told.
    pub fn of(camera: &Camera, size_px: [u32; 2], mm_per_unit: f64) -> Option<Self> {
        let view = View::new(camera, size_px);
        let distance = view.eye().distance(camera.target);
        let mm_per_px = f64::from(view.units_per_pixel(distance)) * mm_per_unit;
        let most = LONGEST * f64::from(view.size_px.x) * mm_per_px;
        if !(most.is_finite() && most > 1e-9) {
            return None;
        }
        let mut power = 10.0_f64.powf(most.log10().floor());
        // The logarithm may be off by one at a power of ten.
        power *= if power > most { 0.1 } else { 1.0 };
        let mm = [5.0, 2.0, 1.0].map(|digit| digit * power);
        let mm = mm.into_iter().find(|mm| *mm <= most).unwrap_or(power);
        Some(Self {
            mm,
            length_px: (mm / mm_per_px) as f32,
        })
    }

    /// What it stands for, as text: `50 mm`.
    pub fn text(&self) -> String {
        let decimals = (-self.mm.log10().floor()).clamp(0.0, 12.0) as usize;
        format!("{:.decimals$}\u{a0}mm", self.mm)
    }
}

/// What stands at the edges of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// None: it is not wished, or nobody knows how large the subject is.
    pub bar: Option<ScaleBar>,
    /// Letters of the patient's sides at the middles of the left, right, upper and lower edge, if they are wished: `R`,
    /// or two where the direction lies between, as in `RA`.
    pub sides: Option<[String; 4]>,
}

impl Marks {
    /// The marks of an illustration as its camera sees it. `mm_per_unit`: millimetres in one subject unit, if known.
    pub fn of(shown: &Illustration, size_px: [u32; 2], mm_per_unit: Option<f64>) -> Self {
        let bar = mm_per_unit.filter(|_| shown.look.scale_bar);
        let axes = View::new(&shown.camera, size_px).subject_from_view.matrix3;
        let [right, up]: [Vec3; 2] = [axes.x_axis, axes.y_axis].map(Vec3::from);
        let letters = || [-right, right, up, -up].map(side_letters);
        Self {
            bar: bar.and_then(|mm| ScaleBar::of(&shown.camera, size_px, mm)),
            sides: shown.look.sides.then(letters),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    fn camera(distance: f32, fov_deg: f32) -> Camera {
        Camera {
            target: Vec3::new(0.1, -0.2, 0.05),
            rotate: Quat::from_xyzw(0.1, 0.7, -0.2, 0.678_233).normalize(),
            distance,
            fov_deg,
        }
    }

    #[test]
    fn a_bar_is_as_long_as_its_length_in_the_plane_of_the_target() {
        for (distance, fov, size, mm_per_unit) in [
            (2.5, 30.0, [800, 600], 240.0),
            (0.4, 30.0, [800, 600], 240.0),
            (2.5, 60.0, [300, 900], 41.3),
            (900.0, 1.5, [1920, 1080], 0.7),
            (0.0, 30.0, [64, 64], 1000.0),
        ] {
            let camera = camera(distance, fov);
            let bar = ScaleBar::of(&camera, size, mm_per_unit).expect("a bar");
            let view = View::new(&camera, size);
            // As far apart as the bar says, in the plane through the target that faces the eye.
            let across: Vec3 = view.subject_from_view.matrix3.x_axis.into();
            let half = across * (0.5 * bar.mm / mm_per_unit) as f32;
            let pixel = |pos| view.pixel_from_subject(pos).expect("before the eye");
            let apart = pixel(camera.target + half).distance(pixel(camera.target - half));
            let off = (apart - bar.length_px).abs();
            assert!(
                off < 0.02 + 1e-3 * apart,
                "{bar:?}: {apart} px at {distance}"
            );
            let share = bar.length_px / size[0] as f32;
            assert!((0.09..=0.2501).contains(&share), "{bar:?} of {size:?}");
            let digit = bar.mm / 10.0_f64.powf((bar.mm.log10() + 1e-9).floor());
            let is_round = [1.0, 2.0, 5.0].iter().any(|d| (d - digit).abs() < 1e-6);
            assert!(is_round, "{bar:?}");
        }
        for mm_per_unit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(
                ScaleBar::of(&camera(2.5, 30.0), [80, 60], mm_per_unit),
                None
            );
        }
    }

    #[test]
    fn lengths_are_told_in_millimetres() {
        let text = |mm| ScaleBar { mm, length_px: 1.0 }.text();
        assert_eq!(text(200.0), "200\u{a0}mm");
        assert_eq!(text(1.0), "1\u{a0}mm");
        assert_eq!(text(0.5), "0.5\u{a0}mm");
        assert_eq!(text(0.02), "0.02\u{a0}mm");
    }

    #[test]
    fn letters_change_as_the_camera_turns() {
        let mut shown = Illustration::document_default();
        assert_eq!(Marks::of(&shown, [80, 60], Some(240.0)), Marks::default());
        shown.look.sides = true;
        let mut letters = |rotate| {
            shown.camera.rotate = rotate;
            Marks::of(&shown, [80, 60], None).sides.expect("letters")
        };
        assert_eq!(letters(Quat::IDENTITY), ["R", "L", "S", "I"]);
        let behind = letters(Quat::from_rotation_z(std::f32::consts::PI));
        assert_eq!(behind, ["L", "R", "S", "I"]);
        // From the patient's left, then from above with the right where it was.
        let left = letters(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2));
        assert_eq!(left, ["A", "P", "S", "I"]);
        let above = letters(Quat::from_rotation_x(std::f32::consts::FRAC_PI_2));
        assert_eq!(above, ["R", "L", "P", "A"]);
        let between = letters(Quat::from_rotation_z(0.5));
        assert_eq!(between, ["RA", "LP", "S", "I"]);
    }

    #[test]
    fn a_bar_needs_the_wish_and_a_size() {
        let mut shown = Illustration::document_default();
        shown.look.scale_bar = true;
        assert!(Marks::of(&shown, [80, 60], Some(240.0)).bar.is_some());
        assert_eq!(Marks::of(&shown, [80, 60], None), Marks::default());
    }
}
