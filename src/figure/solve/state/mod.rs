mod open;
mod poisson;
mod rounds;

use std::sync::Arc;

use glam::DVec2;

use super::context::ContextSheet;
use super::element::{Element, Rows, best_turn};
use super::factor::NONE;
use super::moves::Moved;
use super::stage::{Body, Stage};
use crate::figure::complex::{arg, polar};

/// Rounds at most, when rotations are found.
pub const MAX_ROUNDS: u32 = 300;
/// Rounds end when no vertex moves further in one, figure units.
pub const TOLERANCE: f64 = 1e-6;

/// Something that turns as a whole by an angle that is to be found: a rigid part that nothing holds, or what a point
/// handle without a turn holds.
#[derive(Clone, Debug)]
pub(crate) struct Open {
    /// Vertices of the mesh that turn with it.
    pub(crate) vertices: Vec<u32>,
    /// What it turns about, in the base shape.
    pivot: DVec2,
    /// Where that goes.
    place: DVec2,
    /// The unknown of its place, or [`NONE`].
    unknown: u32,
    scale: f64,
    pub(crate) angle: f64,
    /// The rigid part, if it is one that nothing holds.
    part: u32,
    /// The grip, if it is what a handle holds.
    grip: u32,
    /// The bodies and triangles of the context that have a vertex of it, or its turn.
    bodies: Vec<u32>,
    context: Vec<u32>,
}

/// The turn of a rigid part.
#[derive(Clone, Copy, Debug)]
enum PartTurn {
    Given(DVec2),
    Open(usize),
}

/// A deformation on its way to the least energy.
#[derive(Clone, Debug)]
pub(crate) struct State {
    stage: Arc<Stage>,
    /// The base shape.
    base: Vec<DVec2>,
    /// Per body its gradients in the base shape.
    base_rows: Vec<Rows>,
    /// Where vertices go.
    pub(crate) places: Vec<DVec2>,
    /// Per body cosine and sine of its turn.
    turns: Vec<DVec2>,
    /// Per body its scale.
    scales: Vec<f64>,
    /// What turns as a whole: rigid parts, then handles.
    pub(crate) open: Vec<Open>,
    part_turns: Vec<PartTurn>,
    /// The open one that turns a vertex, or [`NONE`].
    open_of: Vec<u32>,
    kept: Option<Kept>,
    /// The similarity of the context.
    pub(crate) similarity: DVec2,
}

/// The places that a context keeps.
#[derive(Clone, Debug)]
struct Kept {
    /// By vertex of the context.
    places: Vec<DVec2>,
    rows: Vec<Rows>,
    /// Per unknown how it answers to the real and to the imaginary part of the similarity.
    responses: [Vec<[f64; 2]>; 2],
    /// What the context's vertices do then, as the similarity nearest to it.
    feedback: [DVec2; 2],
}

impl State {
    /// The deformation with turns as they spread from the handles, solved once. `kept` are the places that the context
    /// keeps, by its vertices.
    pub(crate) fn propagated(
        stage: &Arc<Stage>,
        base: &[DVec2],
        moved: &Moved,
        kept: Option<Vec<DVec2>>,
    ) -> Self {
        let spins = stage
            .spread
            .spins(&stage.elements, &stage.holding, &moved.spins);
        let mean = |t: usize| {
            let [a, b, c] = stage.elements[t]
                .vertices
                .map(|vertex| spins[vertex as usize]);
            [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0]
        };
        let of_bodies: Vec<[f64; 2]> = stage
            .bodies
            .iter()
            .map(|body| mean(body.triangle as usize))
            .collect();
        let rows = |body: &Body| stage.elements[body.triangle as usize].rows(base);
        let mut state = Self {
            stage: Arc::clone(stage),
            base: base.to_vec(),
            base_rows: stage.bodies.iter().map(rows).collect(),
            places: moved.places.clone(),
            turns: of_bodies.iter().map(|spin| polar(1.0, spin[0])).collect(),
            scales: of_bodies.iter().map(|spin| libm::exp(spin[1])).collect(),
            open: Vec::new(),
            part_turns: Vec::new(),
            open_of: vec![NONE; base.len()],
            kept: None,
            similarity: DVec2::X,
        };
        state.open_parts(mean);
        state.open_pins(moved);
        for (number, open) in (0_u32..).zip(&state.open) {
            open.vertices
                .iter()
                .for_each(|vertex| state.open_of[*vertex as usize] = number);
        }
        state.find_part_turns(moved);
        state.turn_places();
        if let (Some(context), Some(kept)) = (&stage.context, kept) {
            state.similarity = ContextSheet::similarity(&kept, &context.places(&state.places));
            state.kept = Some(state.kept(context, kept));
        }
        state.solve();
        state
    }

    /// What the gradients of a body should be.
    fn wanted(&self, body: usize) -> Rows {
        let part = self.stage.bodies[body].part;
        let z = if part == NONE {
            self.scales[body] * self.turns[body]
        } else {
            match self.part_turns[part as usize] {
                PartTurn::Given(z) => z,
                PartTurn::Open(i) => polar(self.open[i].scale, self.open[i].angle),
            }
        };
        self.base_rows[body].turned(z)
    }

    /// Adds a triangle's part of a divergence to right sides.
    fn add(&self, sides: &mut [[f64; 2]], element: &Element, rows: &Rows, weight: DVec2) {
        for (vertex, gradient) in element.vertices.iter().zip(&element.gradients) {
            let unknown = self.stage.unknown_of[*vertex as usize];
            if unknown != NONE {
                let side = &mut sides[unknown as usize];
                side[0] += weight.x * gradient.dot(rows.0);
                side[1] += weight.y * gradient.dot(rows.1);
            }
        }
    }

    /// Round (a): every triangle takes the turn that suits it best. Gives the energy then.
    fn turn_bodies(&mut self) -> f64 {
        let stage = Arc::clone(&self.stage);
        let mut energy = 0.0;
        for (i, body) in stage.bodies.iter().enumerate() {
            let element = &stage.elements[body.triangle as usize];
            let rows = element.rows(&self.places);
            if body.part == NONE {
                self.turns[i] = best_turn(&rows, &self.base_rows[i], body.k2, self.scales[i]);
            }
            energy += element.area * rows.minus(&self.wanted(i)).energy(body.k2);
        }
        if let (Some(context), Some(kept)) = (&stage.context, &self.kept) {
            for (element, rows) in context.elements.iter().zip(&kept.rows) {
                let lack = element
                    .rows(&self.places)
                    .minus(&rows.turned(self.similarity));
                energy += context.lambda * element.area * lack.energy(DVec2::ONE);
            }
        }
        energy
    }

    /// The base shape.
    pub(crate) fn base(&self) -> &[DVec2] {
        &self.base
    }

    /// Turn and scale of the context.
    pub(crate) fn context_found(&self) -> Option<[f64; 2]> {
        self.kept
            .as_ref()
            .map(|_| [arg(self.similarity), self.similarity.length()])
    }
}
