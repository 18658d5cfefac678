//! The surface along a template: where it is asked for, and the curve through what is found.

use glam::{Vec2, Vec3};

use crate::document::{Curve, PlacedTemplate};
use crate::math::{Bent, OnLine};

/// Places of the surface that are asked for along a template.
pub(super) const PLACES: usize = 7;
/// The surface is looked for so far over and under the box, in parts of its height: what lies farther away is another
/// surface.
const REACH: [f32; 2] = [-1.0, 2.0];

/// What has been found of the surface along a template so far.
#[derive(Debug)]
pub(super) struct Tracing {
    template: usize,
    /// Answers that have not come.
    open: usize,
    /// Points found on the surface, subject space, in the order of [`places`].
    found: [Option<Vec3>; PLACES],
}

impl Tracing {
    /// For the template of this index, nothing found yet.
    pub(super) fn new(template: usize) -> Self {
        Self {
            template,
            open: PLACES,
            found: [None; PLACES],
        }
    }

    /// The index of the template.
    pub(super) fn template(&self) -> usize {
        self.template
    }

    /// Takes the answer at one of the places, subject space. True once every answer has come.
    pub(super) fn take(&mut self, index: usize, pos: Option<Vec3>) -> bool {
        if let Some(slot) = self.found.get_mut(index) {
            *slot = pos;
            self.open = self.open.saturating_sub(1);
        }
        self.open == 0
    }

    /// The curve through what was found about the middle, as high over the surface as a template of this kind stands.
    /// `None` where too little was found, or what was found cannot be laid along.
    pub(super) fn curve(&self, template: &PlacedTemplate) -> Option<Curve> {
        let near = |pos: Option<Vec3>| {
            let q = template.placement.template_from_subject(pos?);
            let is_near = q.z > REACH[0] && q.z < REACH[1];
            is_near.then_some(Vec2::new(q.x, q.z))
        };
        let (low, high) = self.found.split_at(PLACES / 2);
        let mut places: Vec<Vec2> = low.iter().rev().map_while(|pos| near(*pos)).collect();
        places.reverse();
        places.extend(high.iter().map_while(|pos| near(*pos)));
        let size = template.placement.size;
        let surface = Bent::new(&places, false, size, OnLine::TOP).ok()?;
        let top = surface.beside(template.kind.facts().shape.above * size.z);
        let curve = Curve::spline(top);
        (places.len() > 2 && curve.bent(size).is_ok()).then_some(curve)
    }
}

/// Where along a template's top the surface is asked for, subject space.
pub(super) fn places(template: &PlacedTemplate) -> [Vec3; PLACES] {
    std::array::from_fn(|i| {
        let x = i as f32 / (PLACES - 1) as f32;
        template
            .placement
            .subject_from_template(Vec3::new(x, 0.5, 1.0))
    })
}
