//! Where places of a bent figure lie at rest, and where places at rest go (spec/figures.md, "The command line" and
//! "Drawing").

use std::cmp::Ordering;

use glam::DVec2;

use super::mesh::{Grid, Mesh, Part, weights};
use crate::document::figure::{Figure, Rest};

/// A place of a figure that was probed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    /// The other place: at rest of what is seen somewhere, or where a place at rest goes.
    pub place: DVec2,
    /// The triangle that it lies in; none: nothing is there, and the place is the one that was asked for.
    pub triangle: Option<usize>,
}

/// Where a place at rest goes when the vertices have these places: with the region in front, if several sheets have it.
pub fn forward(mesh: &Mesh, places: &[DVec2], at: DVec2) -> Probed {
    match mesh.at_rest(at) {
        Some(found) => Probed {
            place: mesh.carried(found, places),
            triangle: Some(found.0),
        },
        None => Probed {
            place: at,
            triangle: None,
        },
    }
}

/// What is seen of a bent figure, and where. Built once for a pose.
#[derive(Clone, Debug)]
pub struct Seen<'a> {
    mesh: &'a Mesh,
    places: &'a [DVec2],
    grid: Grid,
    /// Per triangle its place in the order of drawing; larger is in front.
    rank: Vec<u32>,
}

impl<'a> Seen<'a> {
    /// What is seen when the vertices have these places.
    pub fn new(mesh: &'a Mesh, figure: &Figure, places: &'a [DVec2]) -> Self {
        let mut rank = vec![0; mesh.triangle_count()];
        for (triangle, number) in drawing_order(mesh, figure, places).into_iter().zip(0..) {
            rank[triangle as usize] = number;
        }
        Self {
            grid: Grid::new(places, &mesh.triangles),
            mesh,
            places,
            rank,
        }
    }

    /// The place at rest of what is seen at a deformed place.
    pub fn at(&self, at: DVec2) -> Probed {
        let mut front: Option<(u32, usize, [f64; 3])> = None;
        for triangle in self.grid.candidates(at) {
            let triangle = *triangle as usize;
            let rank = self.rank[triangle];
            if front.is_none_or(|(least, ..)| rank > least)
                && let Some(weights) = weights(self.mesh.corners(triangle, self.places), at)
            {
                front = Some((rank, triangle, weights));
            }
        }
        match front {
            Some((_, triangle, weights)) => Probed {
                place: self.mesh.carried((triangle, weights), &self.mesh.vertices),
                triangle: Some(triangle),
            },
            None => Probed {
                place: at,
                triangle: None,
            },
        }
    }
}

/// The triangles in the order of drawing, from behind to front: by `order`, then by place in the list (the rest first),
/// then those turned over before the others, then as they are in the mesh. A rest that is kept is behind all.
pub fn drawing_order(mesh: &Mesh, figure: &Figure, places: &[DVec2]) -> Vec<u32> {
    // Soft tissue behind a cut region is never in front of it, and else where regions are that have no order.
    let order = |part: Part| match part {
        Part::Region(i) => figure.regions[i].order,
        Part::Behind(i) => figure.regions[i].order.min(0.0),
        Part::Rest if figure.rest == Rest::Keep => f64::NEG_INFINITY,
        Part::Rest => 0.0,
    };
    let last = mesh.tissues.len() - 1;
    let by_tissue: Vec<(f64, usize)> = mesh
        .tissues
        .iter()
        .enumerate()
        .map(|(i, tissue)| (order(tissue.part), (i + 1) % (last + 1)))
        .collect();
    let is_upright = |triangle: u32| {
        let [a, b, c] = mesh.corners(triangle as usize, places);
        (b - a).perp_dot(c - a) >= 0.0
    };
    let mut keyed: Vec<(usize, bool, u32)> = (0..mesh.triangle_count() as u32)
        .map(|t| (usize::from(mesh.tissue_of[t as usize]), is_upright(t), t))
        .collect();
    keyed.sort_by(|a, b| {
        let ((order_a, list_a), (order_b, list_b)) = (by_tissue[a.0], by_tissue[b.0]);
        let by_order: Ordering = order_a.total_cmp(&order_b).then(list_a.cmp(&list_b));
        by_order.then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2))
    });
    keyed.into_iter().map(|(.., triangle)| triangle).collect()
}
