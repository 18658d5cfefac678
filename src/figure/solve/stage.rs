use glam::DVec2;

use super::context::ContextSheet;
use super::element::Element;
use super::factor::{Factor, Matrix, NONE};
use super::hold::Holding;
use super::propagate::Spread;
use super::rigid::{Parts, Stiffness};
use crate::document::figure::Propagation;
use crate::figure::mesh::{Mesh, hanging_together};

/// A triangle that gives way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    /// Index of the triangle.
    pub(crate) triangle: u32,
    /// Squares of the resistance of the deformed x and y.
    pub(crate) k2: DVec2,
    /// The rigid part whose turn it has, or [`NONE`] if it has its own.
    pub(crate) part: u32,
}

/// What hangs together and is held nowhere: it keeps its centroid.
#[derive(Clone, Debug)]
pub(crate) struct Floating {
    /// Its vertices, each with its part of the area.
    pub(crate) shares: Vec<(u32, f64)>,
    /// The rigid parts in it.
    pub(crate) parts: Vec<u32>,
}

/// A stage of the solve with all that does not depend on where handles go: its matrices are factored once. Built for a
/// mesh, the rigidities, what handles hold and the context's points and strength.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    /// Triangles of the mesh with their gradients.
    pub(crate) elements: Vec<Element>,
    pub(crate) parts: Parts,
    pub(crate) holding: Holding,
    pub(crate) spread: Spread,
    /// The triangles that give way.
    pub(crate) bodies: Vec<Body>,
    pub(crate) context: Option<ContextSheet>,
    /// Per vertex its unknown; that of its rigid part's place; [`NONE`] if it is held.
    pub(crate) unknown_of: Vec<u32>,
    /// Per part the unknown of its place, or [`NONE`].
    pub(crate) unknown_of_part: Vec<u32>,
    pub(crate) floating: Vec<Floating>,
    /// Where the bodies at each vertex begin in `bodies_at`; one more than there are vertices.
    pub(crate) body_starts: Vec<u32>,
    /// The bodies at each vertex.
    pub(crate) bodies_at: Vec<u32>,
    factor_x: Factor,
    /// That of y, if it is another.
    factor_y: Option<Factor>,
}

impl Stage {
    pub(crate) fn new(
        mesh: &Mesh,
        parts: Parts,
        holding: Holding,
        context: Option<ContextSheet>,
        propagation: Propagation,
        reach: f64,
    ) -> Self {
        let corners = |t: usize| mesh.corners(t, &mesh.vertices);
        let elements: Vec<Element> = (0..mesh.triangle_count())
            .map(|t| Element::new(mesh.triangles[t], corners(t)))
            .collect();
        let spread = Spread::new(mesh, &elements, &parts, &holding, propagation, reach);
        let mut bodies = Vec::new();
        for (stiffness, triangle) in parts.stiffness.iter().zip(0..) {
            let (k2, part) = match stiffness {
                Stiffness::Soft([kx, ky]) => (DVec2::new(kx * kx, ky * ky), NONE),
                Stiffness::Border(part) => (DVec2::ONE, *part),
                Stiffness::Inside(_) => continue,
            };
            bodies.push(Body { triangle, k2, part });
        }
        let (floating, grounded) = floating(mesh, &elements, &parts, &holding, context.as_ref());
        let unknowns = Unknowns::new(mesh, &parts, &holding, &grounded);
        let is_even = bodies.iter().all(|body| body.k2.x == body.k2.y);
        let matrix = |axis: usize| {
            let mut matrix = Matrix::new(unknowns.places.len());
            let of = |element: &Element| {
                element
                    .vertices
                    .map(|vertex| unknowns.of_vertex[vertex as usize])
            };
            for body in &bodies {
                let element = &elements[body.triangle as usize];
                matrix.add(
                    of(element),
                    &element.gradients,
                    body.k2[axis] * element.area,
                );
            }
            if let Some(context) = &context {
                for element in &context.elements {
                    matrix.add(
                        of(element),
                        &element.gradients,
                        context.lambda * element.area,
                    );
                }
            }
            matrix.factor(&unknowns.places)
        };
        let (factor_x, factor_y) = (matrix(0), (!is_even).then(|| matrix(1)));
        let (body_starts, bodies_at) = bodies_at_vertices(mesh, &bodies);
        Self {
            elements,
            spread,
            bodies,
            unknown_of: unknowns.of_vertex,
            unknown_of_part: unknowns.of_part,
            floating,
            body_starts,
            bodies_at,
            factor_x,
            factor_y,
            parts,
            holding,
            context,
        }
    }

    /// Number of unknowns along an axis.
    pub(crate) fn unknown_count(&self) -> usize {
        self.factor_x.len()
    }

    /// All factors: of x, of y if it is another, of the harmonic propagation.
    pub(crate) fn factors(&self) -> impl Iterator<Item = &Factor> {
        [
            Some(&self.factor_x),
            self.factor_y.as_ref(),
            self.spread.factor(),
        ]
        .into_iter()
        .flatten()
    }

    /// Solves for x and y; right sides become solutions.
    pub(crate) fn solve(&self, sides: &mut [[f64; 2]]) {
        let Some(factor_y) = &self.factor_y else {
            self.factor_x.solve(sides);
            return;
        };
        for (axis, factor) in [(0, &self.factor_x), (1, factor_y)] {
            let mut side: Vec<[f64; 1]> = sides.iter().map(|side| [side[axis]]).collect();
            factor.solve(&mut side);
            sides
                .iter_mut()
                .zip(side)
                .for_each(|(to, from)| to[axis] = from[0]);
        }
    }
}

/// Numbers of the unknowns.
struct Unknowns {
    of_vertex: Vec<u32>,
    of_part: Vec<u32>,
    /// Where they lie; none of whole parts.
    places: Vec<Option<DVec2>>,
}

impl Unknowns {
    /// Free vertices, then the places of rigid parts that nothing holds; what is grounded has none.
    fn new(mesh: &Mesh, parts: &Parts, holding: &Holding, grounded: &[u32]) -> Self {
        let mut is_grounded = vec![false; mesh.vertices.len()];
        grounded
            .iter()
            .for_each(|vertex| is_grounded[*vertex as usize] = true);
        let mut places = Vec::new();
        let mut of_vertex = vec![NONE; mesh.vertices.len()];
        for (vertex, unknown) in of_vertex.iter_mut().enumerate() {
            let is_free = holding.holder[vertex] == NONE && parts.part_of[vertex] == NONE;
            if is_free && !is_grounded[vertex] {
                *unknown = places.len() as u32;
                places.push(Some(mesh.vertices[vertex]));
            }
        }
        let mut of_part = vec![NONE; parts.parts.len()];
        for (part, unknown) in parts.parts.iter().zip(&mut of_part) {
            let is_free = holding.holder[part.vertices[0] as usize] == NONE;
            if is_free
                && !part
                    .vertices
                    .iter()
                    .any(|vertex| is_grounded[*vertex as usize])
            {
                *unknown = places.len() as u32;
                places.push(None);
                part.vertices
                    .iter()
                    .for_each(|vertex| of_vertex[*vertex as usize] = *unknown);
            }
        }
        Self {
            of_vertex,
            of_part,
            places,
        }
    }
}

/// What floats, and of each the vertex that stays where it is during a solve.
fn floating(
    mesh: &Mesh,
    elements: &[Element],
    parts: &Parts,
    holding: &Holding,
    context: Option<&ContextSheet>,
) -> (Vec<Floating>, Vec<u32>) {
    // The context's sheet joins what it lies on.
    let joining: Vec<[u32; 3]> = context
        .iter()
        .flat_map(|context| &context.elements)
        .map(|e| e.vertices)
        .collect();
    let component_of = hanging_together(mesh.vertices.len(), mesh.triangles.iter().chain(&joining));
    let count = component_of
        .iter()
        .max()
        .map_or(0, |last| *last as usize + 1);
    let mut is_held = vec![false; count];
    for (component, holder) in component_of.iter().zip(&holding.holder) {
        is_held[*component as usize] |= *holder != NONE;
    }
    let mut mass = vec![0.0; mesh.vertices.len()];
    for element in elements {
        element
            .vertices
            .iter()
            .for_each(|vertex| mass[*vertex as usize] += element.area / 3.0);
    }
    let mut found: Vec<Floating> = vec![
        Floating {
            shares: Vec::new(),
            parts: Vec::new(),
        };
        count
    ];
    for (vertex, component) in (0_u32..).zip(&component_of) {
        found[*component as usize]
            .shares
            .push((vertex, mass[vertex as usize]));
    }
    for (part, number) in parts.parts.iter().zip(0..) {
        found[component_of[part.vertices[0] as usize] as usize]
            .parts
            .push(number);
    }
    let mut is_held = is_held.into_iter();
    found.retain(|_| is_held.next() == Some(false));
    let grounded = found.iter().map(|floating| floating.shares[0].0).collect();
    (found, grounded)
}

/// The bodies at each vertex.
fn bodies_at_vertices(mesh: &Mesh, bodies: &[Body]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; mesh.vertices.len() + 1];
    let corners = |body: &Body| mesh.triangles[body.triangle as usize];
    for vertex in bodies.iter().flat_map(corners) {
        starts[vertex as usize + 1] += 1;
    }
    for vertex in 0..mesh.vertices.len() {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut at = vec![0; 3 * bodies.len()];
    for (number, body) in (0_u32..).zip(bodies) {
        for vertex in corners(body) {
            at[next[vertex as usize] as usize] = number;
            next[vertex as usize] += 1;
        }
    }
    (starts, at)
}
