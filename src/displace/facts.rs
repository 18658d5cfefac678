//! The facts about a kind of template, in the form in which the file of each kind gives them.

use super::points::{ControlPoint, ControlPoints};
use super::spec::{MAX_PARAM_FLOATS, ParamValue, TemplateSpec};
use super::tools::SweepTools;
use crate::math::Aabb;
use glam::{Vec2, Vec3};

/// Stands for a side of a box without an end.
pub(super) const INF: f32 = f32::INFINITY;

/// Where a template changes anything, template space. Conservative: outside of both boxes source = q and A ≥ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Two boxes, since a bed and its flap, or the two sides of a bend, lie apart. Sides may be infinite; either may be
    /// empty.
    pub boxes: [Aabb; 2],
    /// Where moved material can be.
    pub material: Material,
    /// Half side of the largest box (template units) in which differences across the box still tell how the map changes
    /// in it.
    pub detail: f32,
    /// True if the map jumps at a face of the first box, between displaced material and material at rest.
    pub is_torn: bool,
    /// Of a map that differences across a box do not tell enough of: a box is asked by the corners of its parts, no
    /// more than so many along each side, and `detail` is half the side of the largest part. 0 for other maps.
    pub parts: u32,
    /// Of a map in steps that may be finer than a cell of the skip grid: how far, at most, the displacement at a place
    /// lies from that of the step beside it, along each axis, template space.
    pub ripple: Option<Vec3>,
}

/// Where the material that a template moves can be afterwards, template space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Material stays in place or is removed.
    Stays,
    /// Moved by no less than `min` and no more than `max` on each axis (forwards, so the negative of D).
    Shifted(Aabb),
    /// Material of the unit cube ends in this box.
    Within(Aabb),
    /// Rolled about an axis along x: material beyond the arc follows, however far away.
    Bent(Arc),
}

/// The arc of a bend, in the y-z plane, metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Where along y it starts, subject units from y = 0.
    pub start: f32,
    /// Length along the middle plane, subject units.
    pub length: f32,
    /// Angle of the arc, radians, above 0.
    pub turn: f32,
    /// 1: towards -z, -1: towards +z.
    pub side: f32,
    /// Size of the template's box, subject units.
    pub size: Vec3,
}

impl Reach {
    /// The reach of a template that changes nothing.
    pub const NONE: Self = Self {
        boxes: [Aabb::EMPTY; 2],
        material: Material::Stays,
        detail: 0.5,
        is_torn: false,
        parts: 0,
        ripple: None,
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

    /// This reach with another `detail`.
    pub(super) fn with_detail(self, detail: f32) -> Self {
        Self { detail, ..self }
    }

    /// This reach for a map that is asked by corners, see [`Reach::parts`].
    pub(super) fn by_parts(self, detail: f32, parts: u32) -> Self {
        Self {
            detail,
            parts,
            ..self
        }
    }

    /// This reach for a map in steps, see [`Reach::ripple`].
    pub(super) fn rippled(self, ripple: Vec3) -> Self {
        Self {
            ripple: Some(ripple),
            ..self
        }
    }

    /// This reach, torn at the faces of its first box.
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

/// One template as its kind sees it: no place in a subject, no name, numbers in the order of the parameters.
#[derive(Clone, Debug)]
pub struct Given {
    /// Sides of its box, subject units; along a curve, of the box laid along it.
    pub size: Vec3,
    /// Parameters as packed for the GPU.
    pub p: [f32; MAX_PARAM_FLOATS],
    /// The control points of an `rbf`.
    pub points: Option<ControlPoints>,
    /// The samples of a `field`, once they have been read.
    pub samples: Option<Samples>,
    /// The object of a `carve`, once it has been read.
    pub tool: Option<Tool>,
    /// The tools of a `sweep`.
    pub tools: Option<SweepTools>,
}

/// What bounds the object of a `carve`.
#[derive(Clone, Copy, Debug)]
pub struct Tool {
    /// Half the sides of its box, template space.
    pub half: Vec3,
    /// The farthest that it lets tissue be pushed into it, template space.
    pub room: f32,
    /// Side of a cell of its finest grid, template space.
    pub cell: f32,
}

/// What bounds the samples of a `field`.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// Samples along the axis that has most.
    pub most: u32,
    /// Least and greatest displacement along each axis, template space.
    pub shift: [Vec3; 2],
}

/// All that is known about a kind besides its formula.
#[derive(Debug)]
pub struct Facts {
    /// Name, meaning and parameters.
    pub spec: TemplateSpec,
    /// What the template holds besides its parameters.
    pub holds: Holds,
    /// How it is done in part.
    pub amount: Amount,
    /// Finds what the template reaches with the given parameters and data.
    pub reach: fn(&Given) -> Reach,
    /// Where it is grabbed.
    pub grip: Grip,
    /// How its icon is drawn.
    pub icon: Icon,
    /// How its mirror image is made.
    pub mirror: Mirror,
    /// Group in the catalogue and place in the group, from 0; `None` for a kind that the catalogue does not offer.
    pub catalogue: Option<(Group, u32)>,
    /// Proportions of a new one.
    pub shape: Shape,
}

/// What a template holds besides its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Nothing: the parameters say all.
    Parameters,
    /// Control points.
    Points,
    /// A file with the samples of a displacement field. Such a template cannot be mirrored.
    File,
    /// Tools and their paths.
    Tools,
    /// The name of an object of the scene, which gives the template its place. Such a template cannot be mirrored.
    Object,
}

/// How a template is done in part, by an amount from 0 (it is the identity) to 1.
#[derive(Debug)]
pub enum Amount {
    /// The main parameter is scaled by the amount, and a rotation turns by that part of its angle.
    Parameters,
    /// As `Parameters`; at 0 it is switched off, since its other parameters still do something.
    ParametersOrNone,
    /// Its box shrinks, in the way that the parameters (those of its spec, in their order) decide. At 0 it is switched
    /// off.
    Box(fn(&[ParamValue]) -> Shrinking),
}

/// How the box of a template shrinks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shrinking {
    /// On all sides, towards its centre.
    ToCentre,
    /// In its height only, towards its top.
    ToTop,
}

/// How the mirror image of a template is made: one axis of its cube is reversed, and parameters that have a hand take
/// the other.
#[derive(Debug)]
pub struct Mirror {
    /// Index of the axis of its cube about whose middle plane the kind is symmetric, but for `handed`.
    pub axis: usize,
    /// Names of parameters that have a hand. A number changes its sign, a vector its component along `axis`, a rotation
    /// is seen in the mirror.
    pub handed: &'static [&'static str],
}

impl Mirror {
    /// Symmetric in x: the mirrored template has the same parameters.
    pub(super) const ACROSS_X: Self = Self {
        axis: 0,
        handed: &[],
    };
    /// Begins at its x = 0 edge or goes off along x; symmetric in y.
    pub(super) const ACROSS_Y: Self = Self {
        axis: 1,
        handed: &[],
    };
}

/// Groups in which the catalogue is shown: what one wants to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Kinds that open something up: peel, retractor and their like.
    OpenUp,
    /// Kinds that take something apart: split, slices and their like.
    TakeApart,
    /// Kinds that carve and shape: poke, squeeze and their like.
    Carve,
    /// Kinds that bend and twist the tissue.
    Bend,
}

/// Proportions of a new template that is laid on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Sides of its box, in parts of the sensible side.
    pub size: [f32; 3],
    /// Part of its height that stands above the surface, 0 to 1.
    pub above: f32,
}

impl Shape {
    /// A layer, wide and flat: the top just over the skin, so that on a curved surface the layer still reaches it at
    /// the edges.
    pub(super) const LAYER: Self = Self {
        size: [1.0, 0.8, 0.6],
        above: 0.06,
    };
    /// An opening, as deep as wide, the top over the skin.
    pub(super) const OPENING: Self = Self {
        size: [1.0, 1.0, 0.8],
        above: 0.15,
    };
    /// A cube about the place.
    pub(super) const CUBE: Self = Self {
        size: [1.0; 3],
        above: 0.5,
    };
    /// A cube that holds the whole of what turns or bends.
    pub(super) const WHOLE: Self = Self {
        size: [1.5; 3],
        above: 0.5,
    };
}

/// Where a template is grabbed, template space.
#[derive(Debug)]
pub enum Grip {
    /// Nowhere: it has no main parameter.
    None,
    /// At the point that the main number puts there. The second number is how far, at most, one drag may take the value
    /// from where it is (angles that come round to the same place).
    Number(fn(&Given) -> Vec3, f32),
    /// At the middle of the cube plus the main vector.
    Vector,
}

/// How an icon is drawn: on a cube of one subject unit.
#[derive(Debug)]
pub struct Icon {
    /// Centre of the template's box.
    pub at: [f32; 3],
    /// Side lengths of the template's box, subject units.
    pub size: [f32; 3],
    /// Parameters that differ from their defaults.
    pub params: &'static [(&'static str, f32)],
    /// Control points of a kind that holds any.
    pub points: &'static [ControlPoint],
    /// Camera: turned about z from the front, and raised, degrees.
    pub yaw_pitch_deg: [f32; 2],
}

impl Icon {
    /// The whole cube with default parameters, from its lower left corner (x = 0, y = 0), raised.
    pub(super) const PLAIN: Self = Self {
        at: [0.0; 3],
        size: [1.0; 3],
        params: &[],
        points: &[],
        yaw_pitch_deg: [148.0, 28.0],
    };
}

/// Where material goes on an arc: `angle` from straight down at distance `across` from the centre, as (towards -u, up).
pub(super) fn on_arc(angle: f32, across: f32) -> Vec2 {
    Vec2::new(-across * angle.sin(), -across * angle.cos())
}

/// Box (in the plane of the arc, relative to its centre) of a ring sector: angles 0 to `turn`, distances `inner` to
/// `outer`, and of the straight part of length `tail` that continues it.
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
