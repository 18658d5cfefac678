use super::reach::given;
use crate::displace::Grip;
use crate::document::{ObjectRef, ParamKind, ParamValue, PlacedTemplate, TemplateData};
use glam::Vec3;

/// Where the main parameter is dragged in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Index of the parameter in `kind.spec().params`.
    pub param: usize,
    /// Where it is now, subject space (deformed).
    pub at: Vec3,
    /// Direction in which the value grows, unit length, subject space; `None` if the handle is dragged in any
    /// direction.
    pub along: Option<Vec3>,
}

/// Values tried at first along a handle's path; then the best is refined.
const COARSE_STEPS: usize = 96;
/// Halvings of the interval about the best coarse value: past f32's resolution of any range.
const REFINEMENTS: usize = 24;

/// Below this amount a handle stands where it would at the whole amount: a drag could not be divided by it.
const LEAST_AMOUNT: f32 = 0.01;

/// The template as it is held, with the amount that is worked into it.
fn held(template: &PlacedTemplate) -> (PlacedTemplate, f32) {
    if template.amount < LEAST_AMOUNT {
        let whole = PlacedTemplate {
            amount: 1.0,
            ..template.clone()
        };
        return (whole, 1.0);
    }
    (template.acting(), template.amount)
}

/// The value to be set so that at this amount it acts as given.
fn set_from_acting(template: &PlacedTemplate, acting: ParamValue, amount: f32) -> ParamValue {
    let spec = template.kind.spec();
    let kind = spec.main_param.and_then(|i| spec.params.get(i));
    match (acting, kind.map(|spec| spec.kind)) {
        (ParamValue::Number(value), Some(ParamKind::Number { min, max, .. })) => {
            ParamValue::Number((value / amount).clamp(min, max))
        }
        (
            ParamValue::Vector(value),
            Some(ParamKind::Vector {
                min,
                max,
                max_length,
                ..
            }),
        ) => {
            let clamped = (value / amount).clamp(Vec3::splat(min), Vec3::splat(max));
            ParamValue::Vector(clamped.clamp_length_max(max_length))
        }
        (other, _) => other,
    }
}

/// The handle of a template, as much as it does; `None` if its kind has no main parameter, or if it has no place
/// without the data of its object.
pub fn handle(template: &PlacedTemplate) -> Option<Handle> {
    let is_placed = |held: &ObjectRef| held.found.as_ref().is_some_and(|f| f.placement.is_some());
    if let TemplateData::Object(held) = &template.data
        && !is_placed(held)
    {
        return None;
    }
    let (template, _) = &held(template);
    let param = template.kind.spec().main_param?;
    let at = match &template.kind.facts().grip {
        Grip::None => return None,
        Grip::Vector => {
            let ParamValue::Vector(offset) = *template.params.get(param)? else {
                return None;
            };
            return Some(Handle {
                param,
                at: template.subject_from_template(offset + 0.5),
                along: None,
            });
        }
        Grip::Number(..) => path_point(template, current(template, param)?)?,
    };
    let (min, max) = range(template, param)?;
    let value = current(template, param)?;
    // A hundredth of the range, towards whichever side has room.
    let step = 0.01 * (max - min);
    let (below, above) = ((value - step).max(min), (value + step).min(max));
    let along = path_point(template, above)? - path_point(template, below)?;
    Some(Handle {
        param,
        at,
        along: along.try_normalize(),
    })
}

/// The main parameter's value that puts the handle nearest to a point (subject space).
pub fn dragged(template: &PlacedTemplate, to: Vec3) -> Option<ParamValue> {
    let (acting, amount) = held(template);
    let value = nearest(&acting, to, |pos| pos.distance_squared(to))?;
    Some(set_from_acting(&acting, value, amount))
}

/// The main parameter's value that puts the handle nearest to a ray, such as the one under the pointer (subject space).
/// A vector moves in the plane through the handle that faces the ray.
pub fn dragged_along_ray(
    template: &PlacedTemplate,
    origin: Vec3,
    direction: Vec3,
) -> Option<ParamValue> {
    let direction = direction.try_normalize()?;
    let (acting, amount) = held(template);
    let at = handle(&acting)?.at;
    let on_plane = origin + direction * (at - origin).dot(direction);
    let value = nearest(&acting, on_plane, |pos| {
        let from = pos - origin;
        (from - direction * from.dot(direction)).length_squared()
    })?;
    Some(set_from_acting(&acting, value, amount))
}

/// Puts a value into the main parameter.
pub fn set_main(template: &mut PlacedTemplate, value: ParamValue) {
    let main = template.kind.spec().main_param;
    if let Some(slot) = main.and_then(|i| template.params.get_mut(i)) {
        *slot = value;
    }
}

fn nearest(
    template: &PlacedTemplate,
    to: Vec3,
    distance: impl Fn(Vec3) -> f32,
) -> Option<ParamValue> {
    let param = template.kind.spec().main_param?;
    let furthest = match &template.kind.facts().grip {
        Grip::None => return None,
        Grip::Vector => {
            let offset = template.template_from_subject(to) - 0.5;
            let ParamKind::Vector {
                min,
                max,
                max_length,
                ..
            } = template.kind.spec().params.get(param)?.kind
            else {
                return None;
            };
            let clamped = offset.clamp(Vec3::splat(min), Vec3::splat(max));
            return clamped
                .is_finite()
                .then(|| ParamValue::Vector(clamped.clamp_length_max(max_length)));
        }
        Grip::Number(_, furthest) => *furthest,
    };
    let (min, max) = range(template, param)?;
    let value = current(template, param)?;
    let (min, max) = (min.max(value - furthest), max.min(value + furthest));
    let away = |v: f32| path_point(template, v).map_or(f32::INFINITY, &distance);
    let step = (max - min) / COARSE_STEPS as f32;
    let mut best = (away(value), value);
    for i in 0..=COARSE_STEPS {
        let v = (min + step * i as f32).min(max);
        let d = away(v);
        if d < best.0 {
            best = (d, v);
        }
    }
    let mut width = step;
    for _ in 0..REFINEMENTS {
        for v in [best.1 - width, best.1 + width] {
            let v = v.clamp(min, max);
            let d = away(v);
            if d < best.0 {
                best = (d, v);
            }
        }
        width *= 0.5;
    }
    Some(ParamValue::Number(best.1))
}

/// Where the handle would be at another value, subject space.
fn path_point(template: &PlacedTemplate, value: f32) -> Option<Vec3> {
    let Grip::Number(position, _) = &template.kind.facts().grip else {
        return None;
    };
    let mut given = given(template, None, None);
    // Every main number so far has only numbers before it, one float each.
    *given.p.get_mut(template.kind.spec().main_param?)? = value;
    Some(template.subject_from_template(position(&given)))
}

fn current(template: &PlacedTemplate, param: usize) -> Option<f32> {
    match template.params.get(param)? {
        ParamValue::Number(value) => Some(*value),
        _ => None,
    }
}

fn range(template: &PlacedTemplate, param: usize) -> Option<(f32, f32)> {
    match template.kind.spec().params.get(param)?.kind {
        ParamKind::Number { min, max, .. } => Some((min, max)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::TemplateKind;
    use crate::placed::icon;

    #[test]
    fn every_kind_but_cut_is_grabbed_and_gives_back_its_value() {
        for kind in TemplateKind::FORMULAS {
            let (mut template, _) = icon(kind);
            let Some(grip) = handle(&template) else {
                assert_eq!(kind, TemplateKind::Cut, "{kind:?} has no handle");
                continue;
            };
            let before = template.params[grip.param];
            let same = dragged(&template, grip.at).expect("a value");
            match (before, same) {
                (ParamValue::Number(a), ParamValue::Number(b)) => {
                    assert!((a - b).abs() < 1e-3, "{kind:?}: {a} became {b}");
                }
                (ParamValue::Vector(a), ParamValue::Vector(b)) => {
                    assert!((a - b).length() < 1e-5, "{kind:?}: {a} became {b}");
                }
                other => panic!("{kind:?}: {other:?}"),
            }
            // Dragged along, the value follows the handle (backwards where it stands at its end).
            if let (Some(along), ParamValue::Number(a)) = (grip.along, before) {
                let (_, max) = range(&template, grip.param).expect("a range");
                let way = if a < max { 1.0 } else { -1.0 };
                let to = grip.at + 0.02 * way * along;
                let Some(ParamValue::Number(b)) = dragged(&template, to) else {
                    panic!("{kind:?} gave no number");
                };
                assert!((b - a) * way > 0.0, "{kind:?}: {a} became {b}");
                set_main(&mut template, ParamValue::Number(b));
                let now = handle(&template).expect("still a handle").at;
                assert!(now.distance(to) < 0.01, "{kind:?}: {now} is not at {to}");
            }
        }
    }

    #[test]
    fn at_half_the_amount_the_handle_is_where_the_tissue_is() {
        for kind in TemplateKind::FORMULAS {
            let (whole, _) = icon(kind);
            let half = PlacedTemplate {
                amount: 0.5,
                ..whole.clone()
            };
            let (Some(grip), Some(far)) = (handle(&half), handle(&whole)) else {
                continue;
            };
            assert!(grip.at.distance(far.at) > 1e-4, "{kind:?} does not move");
            let (a, b) = (half.params[grip.param], dragged(&half, grip.at));
            match (a, b.expect("a value")) {
                (ParamValue::Number(a), ParamValue::Number(b)) => {
                    assert!((a - b).abs() < 2e-3, "{kind:?}: {a} became {b}");
                }
                (ParamValue::Vector(a), ParamValue::Vector(b)) => {
                    assert!((a - b).length() < 1e-5, "{kind:?}: {a} became {b}");
                }
                other => panic!("{kind:?}: {other:?}"),
            }
        }
    }

    #[test]
    fn a_ray_through_the_handle_keeps_the_value() {
        for kind in TemplateKind::FORMULAS {
            let (template, camera) = icon(kind);
            let Some(grip) = handle(&template) else {
                continue;
            };
            let eye = camera.rotate * Vec3::Y * camera.distance;
            let value = dragged_along_ray(&template, eye, grip.at - eye).expect("a value");
            let mut moved = template.clone();
            set_main(&mut moved, value);
            let now = handle(&moved).expect("a handle").at;
            let off = (now - eye)
                .normalize_or_zero()
                .distance((grip.at - eye).normalize_or_zero());
            assert!(off < 1e-3, "{kind:?}: {off} off the ray");
        }
    }

    #[test]
    fn garbage_from_the_pointer_gives_nothing_or_a_value_in_range() {
        for kind in TemplateKind::FORMULAS {
            let (template, _) = icon(kind);
            for to in [Vec3::NAN, Vec3::INFINITY, Vec3::splat(1e30)] {
                if let Some(ParamValue::Number(v)) = dragged(&template, to) {
                    assert!(v.is_finite(), "{kind:?}");
                }
                assert_eq!(dragged_along_ray(&template, to, Vec3::ZERO), None);
            }
        }
    }
}
