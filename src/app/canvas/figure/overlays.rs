use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{Color32, Painter, Pos2, Stroke};
use glam::Vec2;

use super::hatching;
use super::plane::{place, seen};
use crate::app::canvas::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::Session;
use crate::app::session::figure::Overlay;
use crate::data::{Sheet, SheetMesh};
use crate::document::figure::{Handle, Hold};

/// Free vertices.
const PLAIN: Color32 = Color32::from_gray(235);
/// Vertices that are held, and those of regions that stay, as in the paper's figures.
const HELD: Color32 = Color32::from_rgb(250, 205, 40);
const FIXED: Color32 = Color32::from_rgb(225, 50, 45);

/// The edges of a mesh, and those between regions.
#[derive(Debug)]
pub(super) struct Borders {
    mesh: Arc<SheetMesh>,
    /// Corners, and the regions at both sides; at the figure's end one twice.
    borders: Vec<([u32; 2], [u16; 2])>,
    edges: Vec<[u32; 2]>,
}

impl Borders {
    pub(super) fn new(mesh: &Arc<SheetMesh>) -> Self {
        let mut sides: BTreeMap<[u32; 2], Vec<u16>> = BTreeMap::new();
        for ([a, b, c], region) in mesh.triangles.iter().zip(&mesh.region_of) {
            for [p, q] in [[a, b], [b, c], [c, a]] {
                let edge = [*p.min(q), *p.max(q)];
                sides.entry(edge).or_default().push(*region);
            }
        }
        let border = |(edge, regions): (&[u32; 2], &Vec<u16>)| match regions[..] {
            [one] => Some((*edge, [one, one])),
            [one, other] if one != other => Some((*edge, [one, other])),
            _ => None,
        };
        Self {
            mesh: Arc::clone(mesh),
            borders: sides.iter().filter_map(border).collect(),
            edges: sides.keys().copied().collect(),
        }
    }

    pub(super) fn are_of(&self, mesh: &Arc<SheetMesh>) -> bool {
        Arc::ptr_eq(&self.mesh, mesh)
    }
}

/// Points of a line that is found under the hand, at most.
const POINTED: usize = 120;

/// Paints around the shape of a drawing that a click at `pos` would take.
pub(super) fn paint_shape(
    painter: &Painter,
    view: &Projection,
    sheet: &Sheet,
    session: &Session,
    pos: Pos2,
) {
    let at_rest = place(view, pos).and_then(|at| sheet.back(at));
    let plate = session.view.figure.plate.as_ref();
    let Some(shape) = plate
        .zip(at_rest)
        .and_then(|(plate, (_, at))| plate.shape_at(at))
    else {
        return;
    };
    for line in &shape.lines {
        let points = line.iter().step_by(line.len() / POINTED + 1);
        let places = points.filter_map(|at| Some(sheet.forward(*at)?.1));
        let mut spots: Vec<Pos2> = places.filter_map(|at| seen(view, at)).collect();
        spots.extend(spots.first().copied());
        for stroke in [Stroke::new(3.5, ink::HALO_DARK), Stroke::new(1.5, ink::HOT)] {
            painter.line(spots.clone(), stroke);
        }
    }
}

/// Paints what is shown of the figure's making, but for handles.
pub(super) fn paint(
    painter: &Painter,
    view: &Projection,
    (sheet, borders): (&Sheet, &Borders),
    session: &Session,
) {
    let figure = &session.view.figure;
    let spots: Vec<Option<Pos2>> = sheet.places.iter().map(|at| seen(view, *at)).collect();
    let spot = |vertex: u32| spots.get(vertex as usize).copied().flatten();
    let line = |[a, b]: [u32; 2], stroke: Stroke| {
        if let (Some(a), Some(b)) = (spot(a), spot(b)) {
            painter.line_segment([a, b], stroke);
        }
    };
    if figure.shows(Overlay::Rigidity) {
        hatching::paint(painter, sheet, session, &spot);
    }
    if figure.shows(Overlay::Mesh) {
        let stroke = Stroke::new(0.6, Color32::from_black_alpha(110));
        borders.edges.iter().for_each(|edge| line(*edge, stroke));
    }
    let mut names = sheet.mesh.regions.iter();
    let chosen = names.position(|name| figure.region.as_ref() == Some(name));
    let is_chosen = |region: u16| chosen == Some(usize::from(region));
    if figure.shows(Overlay::Outlines) || chosen.is_some() {
        let plain = Stroke::new(0.8, ink::HANDLE.gamma_multiply(0.6));
        for (edge, [one, other]) in &borders.borders {
            if is_chosen(*one) || is_chosen(*other) {
                line(*edge, Stroke::new(4.0, ink::HALO_DARK));
                line(*edge, Stroke::new(2.2, ink::HOT));
            } else if figure.shows(Overlay::Outlines) {
                line(*edge, plain);
            }
        }
    }
    if figure.shows(Overlay::Vertices) {
        for (spot, color) in spots.iter().zip(vertex_colors(sheet, session)) {
            if let Some(spot) = spot {
                let radius = if color == PLAIN { 1.2 } else { 2.4 };
                painter.circle_filled(*spot, radius, color);
            }
        }
    }
}

/// Of each vertex whether it is held, stays or is free.
fn vertex_colors(sheet: &Sheet, session: &Session) -> Vec<Color32> {
    let mut colors = vec![PLAIN; sheet.places.len()];
    let mut of_region = |name: &str, color: Color32| {
        for (triangle, corners) in sheet.mesh.triangles.iter().enumerate() {
            if sheet.region(triangle) == name {
                corners.iter().for_each(|v| colors[*v as usize] = color);
            }
        }
    };
    let regions = &session.view.figure.regions;
    for region in regions.iter().filter(|region| region.fixed) {
        of_region(&region.name, FIXED);
    }
    let figure = session.figure();
    for handle in figure.handles.iter().filter(|handle| handle.enabled) {
        if let Hold::Region(name) = &handle.hold {
            of_region(name, HELD);
        }
    }
    let handles = figure.handles.iter().filter(|handle| handle.enabled);
    for (handle, at) in handles.flat_map(|handle| points(handle).map(move |at| (handle, at))) {
        let near = sheet.mesh.rest.iter().zip(&mut colors);
        let radius = handle.radius as f32;
        near.filter(|(rest, _)| rest.distance(at) <= radius)
            .for_each(|(_, color)| *color = HELD);
        if let Some((triangle, _)) = sheet.forward(at) {
            let corners = sheet.mesh.triangles[triangle];
            corners.iter().for_each(|v| colors[*v as usize] = HELD);
        }
    }
    colors
}

/// The points that a handle holds, at rest.
fn points(handle: &Handle) -> impl Iterator<Item = Vec2> {
    let points = match &handle.hold {
        Hold::Point(at) => std::slice::from_ref(at),
        Hold::Line { points, .. } => points.as_slice(),
        Hold::Region(_) => &[],
    };
    points.iter().map(|at| at.as_vec2())
}
