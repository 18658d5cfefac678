use super::facts::{Amount, Facts, Grip, Holds, Icon, Mirror, Reach, Shape};
use super::spec::{ParamKind, ParamSpec, TemplateSpec, number};
use crate::math::Aabb;
use glam::Vec3;

/// All that is known about field.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "field",
        summary: "A displacement field from a file",
        params: &[
            number("strength", "Times the displacement", 1.0, 0.0, 2.0),
            ParamSpec {
                name: "units",
                summary: "Of the vectors in the file",
                kind: ParamKind::Choice {
                    names: &["mm", "subject"],
                },
            },
            ParamSpec {
                name: "axes",
                summary: "Directions of the vectors in the file",
                kind: ParamKind::Choice {
                    names: &["auto", "lps", "ras"],
                },
            },
            number(
                "edge",
                "Width over which it ends at the faces of the box",
                0.0,
                0.0,
                0.5,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::File,
    amount: Amount::Parameters,
    reach: |given| {
        let Some(samples) = &given.samples else {
            return Reach::NONE;
        };
        let strength = given.p[0];
        if strength == 0.0 {
            return Reach::NONE;
        }
        let [least, most] = samples.shift.map(|shift| shift * strength);
        // Forwards is the negative.
        let (min, max) = ((-most).min(Vec3::ZERO), (-least).max(Vec3::ZERO));
        let reach = Reach::shifted(Aabb::UNIT, min, max).with_detail(1.5 / samples.most as f32);
        if given.p[3] > 0.0 {
            reach
        } else {
            reach.torn()
        }
    },
    grip: Grip::None,
    icon: Icon::PLAIN,
    mirror: Mirror::ACROSS_X,
    catalogue: None,
    shape: Shape::CUBE,
};
