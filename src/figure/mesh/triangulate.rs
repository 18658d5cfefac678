use std::collections::BTreeSet;

use glam::{DVec2, dvec2};

use super::delaunay::{Delaunay, NONE};
use super::refine::{Aim, refine};
use crate::document::figure::{Figure, Rest};
use crate::figure::notice::Notice;
use crate::figure::outlines::{Edge, OUTSIDE, Outlines};
use crate::figure::plane::Plane;
use crate::figure::progress::Progress;
use crate::figure::regions::{Canvas, Pixels, REST, RegionMap};

/// Label of triangles that none has reached yet.
const UNKNOWN: u8 = 254;
/// The largest triangle is this many times the mean one that a detail means.
const AREA_FACTOR: f64 = 1.3;
/// No triangle has to be smaller than this, square pixels, however little is drawn: the outlines would have edges
/// without end.
const LEAST_AREA: f64 = 1.0 / 16.0;
/// The longest edge of an outline, in square roots of the largest area.
const EDGE_FACTOR: f64 = 1.5;
/// How often the least size of parts may be doubled: then it is more than the largest map has pixels.
const MAX_COARSER: u32 = 26;

/// Parts of the work that are done when regions are found, and when outlines are drawn.
const OF_REGIONS: f32 = 0.5;
const OF_OUTLINES: f32 = 0.7;

/// The picture's rectangle in triangles, each with the label of its region, and the map that they come from.
pub(crate) struct Triangulation {
    /// The triangles; points are in figure space.
    pub(crate) mesh: Delaunay,
    /// The map of regions.
    pub(crate) map: RegionMap,
}

/// The pixels of a document's regions, their outlines and the triangles between them. None if that was stopped.
pub(crate) fn triangulate(
    canvas: &Canvas<'_>,
    figure: &Figure,
    notices: &mut Vec<Notice>,
    progress: &mut Progress<'_>,
) -> Option<Triangulation> {
    let pixels = Pixels::new(canvas, &figure.regions, notices, &mut |part| {
        progress(OF_REGIONS * part)
    })?;
    let (mut map, mut outlines) = (pixels.laid(0), None);
    for coarser in 0..=MAX_COARSER {
        if !progress(OF_REGIONS) {
            return None;
        }
        if coarser > 0 {
            map = pixels.laid(coarser);
        }
        outlines = Outlines::new(&map, &figure.regions, coarser);
        if outlines.is_some() {
            if coarser > 0 {
                let least = pixels.least(coarser);
                notices.push(Notice::RaggedOutlines { least });
            }
            break;
        }
    }
    let is_drawn = drawn_labels(figure);
    let mut mesh = Delaunay::new(DVec2::ZERO, DVec2::ONE);
    if let Some(mut outlines) = outlines {
        let drawn: usize = map
            .counts()
            .iter()
            .zip(&is_drawn)
            .filter(|(_, drawn)| **drawn)
            .map(|(n, _)| n)
            .sum();
        let frame = Frame::new(&canvas.plane);
        let area = drawn as f64 * frame.aspect / f64::from(figure.detail) * AREA_FACTOR;
        let area = area.max(LEAST_AREA);
        loop {
            let (points, edges) = outlines.network();
            let divided;
            (mesh, divided) = frame.meshed(&points, &edges, EDGE_FACTOR * area.sqrt());
            let wrong = label(&mut mesh, &divided);
            if wrong.is_empty() || !outlines.refine(wrong) {
                break;
            }
        }
        let aim = Aim {
            area,
            points: 2 * figure.detail as usize + 2000,
        };
        let mut of_refinement = |part: f32| progress(OF_OUTLINES + (1.0 - OF_OUTLINES) * part);
        if drawn > 0 && !refine(&mut mesh, &is_drawn, aim, &mut of_refinement)? {
            notices.push(Notice::MeshLimit);
        }
        for point in &mut mesh.points {
            *point = frame.figure_from_frame(*point, &canvas.plane);
        }
    }
    Some(Triangulation { mesh, map })
}

/// By label, whether it is part of the figure.
pub(crate) fn drawn_labels(figure: &Figure) -> [bool; 256] {
    let mut is_drawn = [false; 256];
    for (region, is_drawn) in figure.regions.iter().zip(&mut is_drawn) {
        *is_drawn = !region.hide;
    }
    is_drawn[usize::from(REST)] = figure.rest != Rest::Drop;
    is_drawn
}

/// The plane in which the mesh is made: the map's, with y up, and stretched along y so that angles are those of the
/// figure where a reduced side had to be rounded.
struct Frame {
    /// Width and height, in widths of a pixel.
    size: DVec2,
    /// Height of a pixel in its width.
    aspect: f64,
}

impl Frame {
    fn new(plane: &Plane) -> Self {
        let scale = plane.pixels_per_unit();
        let aspect = if plane.source == plane.map_size() {
            1.0
        } else {
            scale.x / scale.y
        };
        Self {
            size: plane.map_size() * dvec2(1.0, aspect),
            aspect,
        }
    }

    fn frame_from_map(&self, pos: DVec2) -> DVec2 {
        dvec2(pos.x, self.size.y - pos.y * self.aspect)
    }

    fn figure_from_frame(&self, pos: DVec2, plane: &Plane) -> DVec2 {
        plane.figure_from_map(dvec2(pos.x, (self.size.y - pos.y) / self.aspect))
    }

    /// A triangulation with a network's edges, divided so that none is longer than `longest`; and the divided edges.
    fn meshed(&self, points: &[DVec2], edges: &[Edge], longest: f64) -> (Delaunay, Vec<Edge>) {
        let mut mesh = Delaunay::new(DVec2::ZERO, self.size);
        let indices: Vec<u32> = points
            .iter()
            .map(|point| mesh.insert(self.frame_from_map(*point)))
            .collect();
        let mut divided = Vec::with_capacity(edges.len());
        for edge in edges {
            let [from, to] = edge.ends.map(|end| indices[end as usize]);
            let (a, b) = (mesh.point(from), mesh.point(to));
            let parts = (a.distance(b) / longest).ceil().max(1.0);
            let mut last = from;
            for i in 1..=parts as u32 {
                let is_end = f64::from(i) >= parts;
                let next = if is_end {
                    to
                } else {
                    mesh.insert(a + (b - a) * (f64::from(i) / parts))
                };
                divided.push(Edge {
                    ends: [last, next],
                    ..*edge
                });
                last = next;
            }
        }
        for edge in &divided {
            mesh.fix(edge.ends[0], edge.ends[1]);
        }
        (mesh, divided)
    }
}

/// Gives each triangle the label that the edges around it have on its side. Gives the lines around those places where
/// they do not agree: there a line has been smoothed past something.
fn label(mesh: &mut Delaunay, edges: &[Edge]) -> BTreeSet<usize> {
    for triangle in &mut mesh.triangles {
        triangle.label = UNKNOWN;
    }
    // The lines beside each triangle, to be named if labels do not agree.
    let mut beside: Vec<(u32, u32)> = Vec::new();
    let mut stack = Vec::new();
    let mut wrong = BTreeSet::new();
    for edge in edges {
        let [a, b] = edge.ends;
        for (from, to, label) in [(a, b, edge.left), (b, a, edge.right)] {
            let Some((t, _)) = mesh.edge_between(from, to) else {
                continue;
            };
            let found = &mut mesh.triangles[t as usize].label;
            if label == OUTSIDE || *found != UNKNOWN && *found != label {
                wrong.insert(edge.line as usize);
            }
            *found = label;
            stack.push(t);
            beside.push((t, edge.line));
        }
    }
    // Triangles whose neighbours without an edge between have another label.
    let mut torn = BTreeSet::new();
    while let Some(t) = stack.pop() {
        let triangle = *mesh.triangle(t);
        for (next, fixed) in triangle.next.into_iter().zip(triangle.fixed) {
            if fixed || next == NONE {
                continue;
            }
            let found = &mut mesh.triangles[next as usize].label;
            if *found == UNKNOWN {
                *found = triangle.label;
                stack.push(next);
            } else if *found != triangle.label {
                torn.insert(t);
            }
        }
    }
    if !torn.is_empty() {
        let faces = faces_of(mesh, &torn);
        wrong.extend(
            beside
                .iter()
                .filter(|(t, _)| faces[*t as usize])
                .map(|(_, line)| *line as usize),
        );
    }
    wrong
}

/// Which triangles hang together with some of these without a fixed edge between.
fn faces_of(mesh: &Delaunay, some: &BTreeSet<u32>) -> Vec<bool> {
    let mut is_reached = vec![false; mesh.triangles.len()];
    let mut stack: Vec<u32> = some.iter().copied().collect();
    while let Some(t) = stack.pop() {
        if !std::mem::replace(&mut is_reached[t as usize], true) {
            let triangle = mesh.triangle(t);
            let open = triangle
                .next
                .into_iter()
                .zip(triangle.fixed)
                .filter(|(next, fixed)| !fixed && *next != NONE);
            stack.extend(open.map(|(next, _)| next));
        }
    }
    is_reached
}
