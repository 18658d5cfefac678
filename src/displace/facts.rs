use crate::document::{MAX_PARAM_FLOATS, PlacedTemplate, TemplateData};
use crate::math::Aabb;
use glam::{Vec2, Vec3};

/// No end on this side.
pub(super) const INF: f32 = f32::INFINITY;

/// Where a template changes anything, template space. Conservative: outside of both boxes source = q and A ≥ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Two boxes, since a bed and its flap, or the two sides of a bend, lie apart. Sides may be infinite; either may be empty.
    pub boxes: [Aabb; 2],
    /// Where moved material can be.
    pub material: Material,
    /// Half side of the largest box (template units) in which differences across the box still tell how the map changes in it.
    pub detail: f32,
    /// True if the map jumps at a face of the first box, where it meets what is at rest.
    pub is_torn: bool,
}

/// Where the material that a template moves can be afterwards, template space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// It is only removed.
    Stays,
    /// Moved by no less than `min` and no more than `max` on each axis (forwards, so the negative of D).
    Shifted(Aabb),
    /// It comes from the unit cube and ends in this box.
    Within(Aabb),
    /// Rolled about an axis along x: what lies beyond the arc follows it, however far away.
    Bent(Arc),
}

/// The arc of a bend, in the y-z plane, metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Where along y it starts, subject units from y = 0.
    pub start: f32,
    /// Length along the middle plane, subject units.
    pub length: f32,
    /// Its turn, radians, above 0.
    pub turn: f32,
    /// 1: towards -z, -1: towards +z.
    pub side: f32,
    /// Size of the template's box, subject units.
    pub size: Vec3,
}

impl Reach {
    /// Nothing is changed.
    pub const NONE: Self = Self {
        boxes: [Aabb::EMPTY; 2],
        material: Material::Stays,
        detail: 0.5,
        is_torn: false,
    };

    /// One box in which material is shifted by `min` to `max`.
    pub(super) fn shifted(bounds: Aabb, min: Vec3, max: Vec3) -> Self {
        Self {
            boxes: [bounds, Aabb::EMPTY],
            material: Material::Shifted(Aabb { min, max }),
            ..Self::NONE
        }
    }

    /// A gap in one box, its material in another.
    pub(super) fn taken_out(bed: Aabb, to: Aabb) -> Self {
        Self {
            boxes: [bed, to],
            material: Material::Within(to),
            ..Self::NONE
        }
    }

    /// With this `detail`.
    pub(super) fn with_detail(self, detail: f32) -> Self {
        Self { detail, ..self }
    }

    /// Torn from what is around it.
    pub(super) fn torn(self) -> Self {
        Self {
            is_torn: true,
            ..self
        }
    }

    /// True if nothing is changed anywhere.
    pub fn is_none(&self) -> bool {
        self.boxes.iter().all(Aabb::is_empty)
    }

    /// True if the point may be changed.
    pub fn contains(&self, q: Vec3) -> bool {
        self.boxes.iter().any(|b| b.contains(q))
    }
}

/// A box by its lowest and highest corner.
pub(super) const fn aabb(min: [f32; 3], max: [f32; 3]) -> Aabb {
    Aabb {
        min: Vec3::from_array(min),
        max: Vec3::from_array(max),
    }
}

/// Size and parameters of one placed template as numbers.
#[derive(Clone, Debug)]
pub(super) struct Given {
    /// Subject units.
    pub(super) size: Vec3,
    /// As packed for the GPU.
    pub(super) p: [f32; MAX_PARAM_FLOATS],
    /// What is no number.
    pub(super) data: TemplateData,
}

impl Given {
    pub(super) fn new(template: &PlacedTemplate) -> Self {
        let mut floats = Vec::with_capacity(MAX_PARAM_FLOATS);
        template.params.iter().for_each(|v| v.pack(&mut floats));
        floats.resize(MAX_PARAM_FLOATS, 0.0);
        Self {
            size: template
                .bent()
                .map_or(template.placement.size, |bent| bent.size()),
            p: std::array::from_fn(|i| floats[i]),
            data: template.data.clone(),
        }
    }
}

/// What is known about a kind besides its formula.
pub(super) struct Facts {
    /// What it reaches.
    pub(super) reach: fn(&Given) -> Reach,
    /// Where it is grabbed.
    pub(super) grip: Grip,
    /// How its icon is drawn.
    pub(super) icon: Icon,
}

/// Where a template is grabbed, template space.
pub(super) enum Grip {
    /// Nowhere: it has no main parameter.
    None,
    /// At the point that the main number puts there. The second number is how far, at most, one drag may take the value from where it
    /// is (angles that come round to the same place).
    Number(fn(&Given) -> Vec3, f32),
    /// At the middle of the cube plus the main vector.
    Vector,
}

/// How an icon is drawn: on a cube of one subject unit.
pub(super) struct Icon {
    /// Centre of the template's box.
    pub(super) at: [f32; 3],
    /// Its size.
    pub(super) size: [f32; 3],
    /// Parameters that differ from their defaults.
    pub(super) params: &'static [(&'static str, f32)],
    /// Camera: turned about z from the front, and raised, degrees.
    pub(super) yaw_pitch_deg: [f32; 2],
}

impl Icon {
    /// The whole cube with default parameters, from its lower left corner (x = 0, y = 0), raised.
    pub(super) const PLAIN: Self = Self {
        at: [0.0; 3],
        size: [1.0; 3],
        params: &[],
        yaw_pitch_deg: [148.0, 28.0],
    };
}

/// Where material goes on an arc: `angle` from straight down at distance `across` from the centre, as (towards -u, up).
pub(super) fn on_arc(angle: f32, across: f32) -> Vec2 {
    Vec2::new(-across * angle.sin(), -across * angle.cos())
}

/// Box (in the plane of the arc, relative to its centre) of a ring sector: angles 0 to `turn`, distances `inner` to `outer`, and of the
/// straight part of length `tail` that continues it.
pub(super) fn sector(turn: f32, inner: f32, outer: f32, tail: f32) -> (Vec2, Vec2) {
    use std::f32::consts::FRAC_PI_2;
    let (mut min, mut max) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    let mut add = |p: Vec2| {
        min = min.min(p);
        max = max.max(p);
    };
    let quarters = (0..=4).map(|i| i as f32 * FRAC_PI_2).filter(|a| *a < turn);
    for angle in quarters.chain([turn]) {
        for across in [inner, outer] {
            add(on_arc(angle, across));
        }
    }
    let along = Vec2::new(-turn.cos(), turn.sin()) * tail;
    for across in [inner, outer] {
        add(on_arc(turn, across) + along);
    }
    (min, max)
}
