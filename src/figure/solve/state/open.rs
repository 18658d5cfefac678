use std::sync::Arc;

use glam::DVec2;

use super::super::element::{Element, Rows, energy_of_turn, turned_about};
use super::super::factor::NONE;
use super::super::moves::Moved;
use super::super::rigid::RigidPart;
use super::super::trigonometric::Trigonometric;
use super::{Open, PartTurn, State};
use crate::figure::complex::{arg, continued, polar};

/// How often open turns are found one after another in a round.
const SWEEPS: u32 = 4;

/// What turns as a whole.
impl State {
    /// Takes up rigid parts that nothing holds, with the mean turn and scale over their triangles.
    pub(super) fn open_parts(&mut self, mean: impl Fn(usize) -> [f64; 2]) {
        let stage = Arc::clone(&self.stage);
        for (number, part) in (0_u32..).zip(&stage.parts.parts) {
            if stage.holding.part_holder[number as usize] != NONE {
                continue;
            }
            let (mut spin, mut centroid, mut total) = ([0.0; 2], DVec2::ZERO, 0.0);
            for t in &part.triangles {
                let (element, of) = (&stage.elements[*t as usize], mean(*t as usize));
                let corners = element.vertices.map(|vertex| self.base[vertex as usize]);
                spin = [
                    spin[0] + element.area * of[0],
                    spin[1] + element.area * of[1],
                ];
                centroid += element.area * (corners[0] + corners[1] + corners[2]) / 3.0;
                total += element.area;
            }
            let pivot = centroid / total;
            let (bodies, context) = self.beside(&part.vertices, number);
            self.open.push(Open {
                vertices: part.vertices.clone(),
                pivot,
                place: pivot,
                unknown: stage.unknown_of_part[number as usize],
                scale: libm::exp(spin[1] / total),
                angle: spin[0] / total,
                part: number,
                grip: NONE,
                bodies,
                context,
            });
        }
    }

    /// Takes up handles whose turns are open.
    pub(super) fn open_pins(&mut self, moved: &Moved) {
        for pin in &moved.open {
            let part = pin
                .vertices
                .first()
                .map_or(NONE, |vertex| self.stage.parts.part_of[*vertex as usize]);
            let (bodies, context) = self.beside(&pin.vertices, part);
            self.open.push(Open {
                vertices: pin.vertices.clone(),
                pivot: pin.pivot,
                place: pin.place,
                unknown: NONE,
                scale: pin.scale,
                angle: pin.turn,
                part: NONE,
                grip: pin.grip,
                bodies,
                context,
            });
        }
    }

    /// Bodies and triangles of the context that have one of these vertices, or the turn of a part.
    pub(super) fn beside(&self, vertices: &[u32], part: u32) -> (Vec<u32>, Vec<u32>) {
        let stage = Arc::clone(&self.stage);
        let at = |vertex: &u32| {
            let range = stage.body_starts[*vertex as usize] as usize
                ..stage.body_starts[*vertex as usize + 1] as usize;
            stage.bodies_at[range].iter().copied()
        };
        let mut bodies: Vec<u32> = vertices.iter().flat_map(at).collect();
        if part != NONE {
            bodies.extend(
                (0..)
                    .zip(&stage.bodies)
                    .filter(|(_, body)| body.part == part)
                    .map(|(number, _)| number),
            );
        }
        bodies.sort_unstable();
        bodies.dedup();
        let mut context = Vec::new();
        if let Some(sheet) = &stage.context {
            let has = |element: &Element| element.vertices.iter().any(|v| vertices.contains(v));
            context.extend(
                (0..)
                    .zip(&sheet.elements)
                    .filter(|(_, element)| has(element))
                    .map(|(number, _)| number),
            );
        }
        (bodies, context)
    }

    /// Finds what turns each rigid part.
    pub(super) fn find_part_turns(&mut self, moved: &Moved) {
        let turn = |(number, part): (usize, &RigidPart)| {
            let first = part.vertices[0] as usize;
            let holder = self.stage.holding.part_holder[number];
            let is_of = |open: &Open| {
                if holder == NONE {
                    open.part == number as u32
                } else {
                    open.grip == holder
                }
            };
            match self.open.iter().position(is_of) {
                Some(open) => PartTurn::Open(open),
                None => PartTurn::Given(polar(
                    libm::exp(moved.spins[first][1]),
                    moved.spins[first][0],
                )),
            }
        };
        self.part_turns = self
            .stage
            .parts
            .parts
            .iter()
            .enumerate()
            .map(turn)
            .collect();
    }

    /// Puts the vertices of what turns as a whole where their turn takes them.
    pub(super) fn turn_places(&mut self) {
        for i in 0..self.open.len() {
            self.turn_place(i);
        }
    }

    pub(super) fn turn_place(&mut self, i: usize) {
        let open = &self.open[i];
        let z = polar(open.scale, open.angle);
        for vertex in &open.vertices {
            let at = self.base[*vertex as usize];
            self.places[*vertex as usize] = turned_about(open.pivot, open.place, z, at);
        }
    }

    /// Round (b): what turns as a whole takes the angles of least energy, one after another.
    pub(super) fn turn_open(&mut self) {
        for _ in 0..SWEEPS {
            for i in 0..self.open.len() {
                let energy = self.energy_of(i);
                let best = arg(energy.least());
                if energy != Trigonometric::default() {
                    self.open[i].angle = continued(best, self.open[i].angle);
                }
                self.turn_place(i);
            }
        }
    }

    /// The energy as it depends on the angle of what turns as a whole.
    pub(super) fn energy_of(&self, i: usize) -> Trigonometric {
        let (stage, open) = (&self.stage, &self.open[i]);
        let mut energy = Trigonometric::default();
        let z = polar(open.scale, open.angle);
        let mut add =
            |element: &Element, wanted: &Rows, own: Option<&Rows>, k2: DVec2, weight: f64| {
                let mut arms = Rows(DVec2::ZERO, DVec2::ZERO);
                for (vertex, gradient) in element.vertices.iter().zip(&element.gradients) {
                    if self.open_of[*vertex as usize] == i as u32 {
                        let arm = self.base[*vertex as usize] - open.pivot;
                        arms = Rows(arms.0 + arm.x * *gradient, arms.1 + arm.y * *gradient);
                    }
                }
                // Less what depends on the angle now.
                let mut left = element.rows(&self.places).minus(&arms.turned(z));
                match own {
                    Some(base) => arms = arms.minus(base),
                    None => left = left.minus(wanted),
                }
                energy.add(&energy_of_turn(&left, &arms, open.scale, k2, weight));
            };
        for number in &open.bodies {
            let body = &stage.bodies[*number as usize];
            let element = &stage.elements[body.triangle as usize];
            let is_own = body.part != NONE
                && matches!(self.part_turns[body.part as usize], PartTurn::Open(of) if of == i);
            let base = &self.base_rows[*number as usize];
            add(
                element,
                &self.wanted(*number as usize),
                is_own.then_some(base),
                body.k2,
                element.area,
            );
        }
        if let (Some(context), Some(kept)) = (&stage.context, &self.kept) {
            for number in &open.context {
                let element = &context.elements[*number as usize];
                let wanted = kept.rows[*number as usize].turned(self.similarity);
                add(
                    element,
                    &wanted,
                    None,
                    DVec2::ONE,
                    context.lambda * element.area,
                );
            }
        }
        energy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::complex::{conj_mul, mul};

    #[test]
    fn turning_about_a_pivot_is_a_product() {
        let z = polar(1.5, 0.7);
        let (pivot, place, at) = (
            DVec2::new(1.0, 2.0),
            DVec2::new(-1.0, 0.5),
            DVec2::new(3.0, 1.0),
        );
        let carried = turned_about(pivot, place, z, at);
        assert!(
            (conj_mul(at - pivot, carried - place) - z * (at - pivot).length_squared()).length()
                < 1e-12,
            "z"
        );
        assert_eq!(carried, place + mul(z, at - pivot), "a product");
    }
}
