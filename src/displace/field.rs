use super::facts::{Facts, Grip, Icon, Reach};
use crate::document::{FieldRef, TemplateData};
use crate::math::Aabb;
use glam::Vec3;

/// Everything about field but its file.
pub(super) const FACTS: Facts = Facts {
    reach: |given| {
        let TemplateData::Field(FieldRef {
            samples: Some(samples),
            ..
        }) = &given.data
        else {
            return Reach::NONE;
        };
        let strength = given.p[0];
        if strength == 0.0 {
            return Reach::NONE;
        }
        let [least, most] = samples.0.shift.map(|shift| shift * strength);
        let finest = samples.0.dims.iter().copied().max().unwrap_or(1);
        // Forwards is the negative.
        let (min, max) = ((-most).min(Vec3::ZERO), (-least).max(Vec3::ZERO));
        let reach = Reach::shifted(Aabb::UNIT, min, max).with_detail(1.5 / finest as f32);
        if given.p[3] > 0.0 {
            reach
        } else {
            reach.torn()
        }
    },
    grip: Grip::None,
    icon: Icon::PLAIN,
};
