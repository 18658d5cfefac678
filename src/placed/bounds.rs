use super::reach::reach;
use crate::data::Resources;
use crate::displace::Material;
use crate::document::{PlacedTemplate, TemplateMode};
use crate::math::{Aabb, Bent};
use glam::Vec3;

/// Beyond this from the origin nothing is followed any more: a list of moves can throw a box a hundred subjects away,
/// where nobody looks.
const FARTHEST: f32 = 64.0;

/// Box (subject space) of where the object can be after all enabled templates, given its box at rest. Conservative,
/// never empty for a box that is not.
///
/// Each template's moved part is boxed in its own space and the box of that added in subject space, so that a chain
/// grows by what is moved, not by the turning of boxes within boxes.
pub fn deformed_bounds(templates: &[PlacedTemplate], resources: &Resources, at_rest: Aabb) -> Aabb {
    let mut object = at_rest;
    let mut group: Vec<&PlacedTemplate> = Vec::new();
    let acting: Vec<PlacedTemplate> = templates.iter().map(|t| resources.acting(t)).collect();
    for template in acting.iter().filter(|t| t.enabled) {
        if template.mode == TemplateMode::Compose || group.is_empty() {
            object = after(&group, resources, object);
            group.clear();
        }
        group.push(template);
    }
    after(&group, resources, object).intersection(Aabb {
        min: Vec3::splat(-FARTHEST),
        max: Vec3::splat(FARTHEST),
    })
}

/// An upper bound of how far a template moves any material of a box (subject space), subject units.
pub fn max_displacement(template: &PlacedTemplate, resources: &Resources, object: Aabb) -> f32 {
    let template = resources.acting(template);
    if let Some(bent) = template.bent() {
        return longest_bent(&template, resources, &bent, object);
    }
    let shift = shift(&template, resources, object);
    if shift.is_empty() {
        return 0.0;
    }
    let farthest = shift.min.abs().max(shift.max.abs());
    (farthest * template.placement.size).length()
}

/// The object's box after one group (a template and the adds that follow it).
fn after(group: &[&PlacedTemplate], resources: &Resources, object: Aabb) -> Aabb {
    match group {
        [] => object,
        [one] => object.union(moved(one, resources, object)),
        many => {
            // The displacements are summed at one point: at most the sum of the boxes, each with "none" in it.
            let sum = many.iter().fold(
                Aabb {
                    min: Vec3::ZERO,
                    max: Vec3::ZERO,
                },
                |sum, template| {
                    if let Some(bent) = template.bent() {
                        let any = Vec3::splat(longest_bent(template, resources, &bent, object));
                        return Aabb {
                            min: sum.min - any,
                            max: sum.max + any,
                        };
                    }
                    let shift = shift(template, resources, object);
                    if shift.is_empty() {
                        return sum;
                    }
                    let placement = template.placement;
                    let in_subject = Aabb::from_points(
                        shift
                            .corners()
                            .map(|v| placement.rotate * (placement.size * v))
                            .into_iter()
                            .chain([Vec3::ZERO]),
                    );
                    Aabb {
                        min: sum.min + in_subject.min,
                        max: sum.max + in_subject.max,
                    }
                },
            );
            Aabb {
                min: object.min + sum.min,
                max: object.max + sum.max,
            }
        }
    }
}

/// The object's box in template space: of a template along a curve, in its own.
fn in_template(template: &PlacedTemplate, object: Aabb) -> Aabb {
    let corners = object.corners();
    let straight =
        Aabb::from_points(corners.map(|pos| template.placement.template_from_subject(pos)));
    template
        .bent()
        .map_or(straight, |bent| bent.unbent_box(straight))
}

/// As [`max_displacement`], of a template along a curve.
fn longest_bent(
    template: &PlacedTemplate,
    resources: &Resources,
    bent: &Bent,
    object: Aabb,
) -> f32 {
    let material = in_template(template, object);
    let size = template.placement.size;
    // From anywhere in one box to anywhere in another.
    let between =
        |a: Aabb, b: Aabb| (bent.bent_box(a).union(bent.bent_box(b)).size() * size).length();
    match reach(template, resources).material {
        Material::Stays => 0.0,
        Material::Shifted(shift) => {
            let farthest = shift.min.abs().max(shift.max.abs());
            let z = [material.min.z - farthest.z, material.max.z + farthest.z];
            let by = farthest * bent.size();
            let flat = by.with_y(0.0).length() * bent.widening(z);
            by.y.hypot(flat)
        }
        Material::Within(to) => between(Aabb::UNIT, to),
        Material::Bent(arc) => between(material, arc.bounds(&material)),
    }
}

/// Box (subject space) of where a template puts what it moves.
fn moved(template: &PlacedTemplate, resources: &Resources, object: Aabb) -> Aabb {
    let material = in_template(template, object);
    let reach = reach(template, resources);
    let to = match reach.material {
        Material::Stays => Aabb::EMPTY,
        Material::Shifted(shift) => {
            let spread = Aabb {
                min: material.min + shift.min.min(Vec3::ZERO),
                max: material.max + shift.max.max(Vec3::ZERO),
            };
            reach.boxes.iter().fold(Aabb::EMPTY, |all, part| {
                all.union(part.intersection(spread))
            })
        }
        // The bed holds nothing of the object, so nothing was taken out of it.
        Material::Within(_) if reach.boxes[0].intersection(material).is_empty() => Aabb::EMPTY,
        Material::Within(to) => to,
        Material::Bent(arc) => arc.bounds(&material),
    };
    if to.is_empty() {
        return Aabb::EMPTY;
    }
    let Some(bent) = template.bent() else {
        let corners = to.corners();
        return Aabb::from_points(corners.map(|q| template.placement.subject_from_template(q)));
    };
    let corners = bent.bent_box(to).corners();
    let seen = Aabb::from_points(corners.map(|q| template.placement.subject_from_template(q)));
    // The box of a bent layer holds much that is not: nothing goes farther than the farthest.
    seen.intersection(object.expanded(longest_bent(template, resources, &bent, object)))
}

/// Least and greatest forward displacement of material of the box, template space; empty if nothing moves.
fn shift(template: &PlacedTemplate, resources: &Resources, object: Aabb) -> Aabb {
    match reach(template, resources).material {
        Material::Stays => Aabb::EMPTY,
        Material::Shifted(shift) => shift,
        // From anywhere in the cube to anywhere in the box.
        Material::Within(to) => Aabb {
            min: to.min - 1.0,
            max: to.max,
        },
        Material::Bent(arc) => {
            let material = in_template(template, object);
            let to = arc.bounds(&material);
            Aabb {
                min: to.min - material.max,
                max: to.max - material.min,
            }
        }
    }
}
