use glam::DVec2;

use super::element::{Element, Rows};
use crate::document::figure::{Context, Figure, Rest};
use crate::figure::complex::conj_mul;
use crate::figure::mesh::{Mesh, Part, triangulated};
use crate::figure::notice::Notice;

/// Points that are this near to a line, in their size, lie on it.
const FLAT: f64 = 1e-6;

/// The vertices of a shape context and the sheet between them (Chen et al., section 3.3). It depends on the mesh and
/// the points; built once for these.
#[derive(Clone, Debug)]
pub(crate) struct ContextSheet {
    /// Vertices of the mesh that the points took.
    pub(crate) vertices: Vec<u32>,
    /// Per vertex the number of its point.
    pub(crate) points: Vec<usize>,
    /// Its triangles as they are among `vertices`.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Triangles of the sheet over these vertices.
    pub(crate) elements: Vec<Element>,
    /// Square of the strength.
    pub(crate) lambda: f64,
}

impl ContextSheet {
    /// The sheet of a figure's context; none if there is none, if its points lie on a line, or if it has no strength.
    pub(crate) fn new(mesh: &Mesh, figure: &Figure, notices: &mut Vec<Notice>) -> Option<Self> {
        let context = figure.context.as_ref()?;
        let (vertices, points) = nearest_vertices(mesh, figure, context);
        let places: Vec<DVec2> = vertices
            .iter()
            .map(|vertex| mesh.vertices[*vertex as usize])
            .collect();
        let triangles = triangulated(&places);
        if context.strength <= 0.0 {
            return None;
        }
        if triangles.is_empty() || is_flat(&context.points) || is_flat(&places) {
            notices.push(Notice::ContextPoints { used: 0 });
            return None;
        }
        if vertices.len() < context.points.len() {
            notices.push(Notice::ContextPoints {
                used: vertices.len(),
            });
        }
        let element = |corners: &[u32; 3]| {
            let at = corners.map(|corner| vertices[corner as usize]);
            Element::new(at, at.map(|vertex| mesh.vertices[vertex as usize]))
        };
        Some(Self {
            elements: triangles.iter().map(element).collect(),
            lambda: context.strength * context.strength,
            vertices,
            points,
            triangles,
        })
    }

    /// The similarity, as a complex number about the means, that brings `from` nearest to `to` (eq. 9 in closed form);
    /// both by vertex of the context.
    pub(crate) fn similarity(from: &[DVec2], to: &[DVec2]) -> DVec2 {
        let n = from.len() as f64;
        let (mean_from, mean_to) = (from.iter().sum::<DVec2>() / n, to.iter().sum::<DVec2>() / n);
        let mut product = DVec2::ZERO;
        let mut square = 0.0;
        for (a, b) in from.iter().zip(to) {
            product += conj_mul(*a - mean_from, *b - mean_to);
            square += (*a - mean_from).length_squared();
        }
        if square > 0.0 {
            product / square
        } else {
            DVec2::X
        }
    }

    /// Gradients of the places to be kept, per triangle.
    pub(crate) fn rows(&self, kept: &[DVec2]) -> Vec<Rows> {
        let rows = |(element, corners): (&Element, &[u32; 3])| {
            let mut rows = Rows(DVec2::ZERO, DVec2::ZERO);
            for (corner, gradient) in corners.iter().zip(&element.gradients) {
                let place = kept[*corner as usize];
                rows.0 += place.x * *gradient;
                rows.1 += place.y * *gradient;
            }
            rows
        };
        self.elements
            .iter()
            .zip(&self.triangles)
            .map(rows)
            .collect()
    }

    /// Places of the context's vertices among those of all.
    pub(crate) fn places(&self, all: &[DVec2]) -> Vec<DVec2> {
        self.vertices
            .iter()
            .map(|vertex| all[*vertex as usize])
            .collect()
    }
}

/// The vertex nearest to each point, each taken once, and the numbers of the points that have one.
fn nearest_vertices(mesh: &Mesh, figure: &Figure, context: &Context) -> (Vec<u32>, Vec<usize>) {
    let mut is_movable = vec![false; mesh.vertices.len()];
    for t in 0..mesh.triangle_count() {
        if figure.rest != Rest::Keep || mesh.tissue(t).part != Part::Rest {
            mesh.triangles[t]
                .iter()
                .for_each(|vertex| is_movable[*vertex as usize] = true);
        }
    }
    let (mut vertices, mut points) = (Vec::new(), Vec::new());
    for (number, point) in context.points.iter().enumerate() {
        let mut least = f64::INFINITY;
        let mut nearest = None;
        for (vertex, place) in (0_u32..).zip(&mesh.vertices) {
            let distance = place.distance_squared(*point);
            if is_movable[vertex as usize] && distance < least {
                least = distance;
                nearest = Some(vertex);
            }
        }
        if let Some(vertex) = nearest.filter(|vertex| !vertices.contains(vertex)) {
            vertices.push(vertex);
            points.push(number);
        }
    }
    (vertices, points)
}

/// Whether points lie on one line.
fn is_flat(points: &[DVec2]) -> bool {
    let n = points.len() as f64;
    let mean = points.iter().sum::<DVec2>() / n;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for point in points {
        let d = *point - mean;
        (xx, xy, yy) = (xx + d.x * d.x, xy + d.x * d.y, yy + d.y * d.y);
    }
    // The smaller eigenvalue of their spread, against the larger.
    let (half, difference) = (
        (xx + yy) / 2.0,
        ((xx - yy) * (xx - yy) / 4.0 + xy * xy).sqrt(),
    );
    half - difference <= FLAT * FLAT * (half + difference)
}
