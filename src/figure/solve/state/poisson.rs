use std::sync::Arc;

use glam::DVec2;

use super::super::context::ContextSheet;
use super::super::element::Rows;
use super::super::factor::NONE;
use super::super::stage::Floating;
use super::{Kept, State};

/// Round (c): the Poisson equation (Chen et al., eq. 7 and 8).
impl State {
    /// What the context's rows and responses are for the places that it keeps.
    pub(super) fn kept(&self, context: &ContextSheet, places: Vec<DVec2>) -> Kept {
        let rows = context.rows(&places);
        let respond = |unit: DVec2| {
            let mut sides = vec![[0.0; 2]; self.stage.unknown_count()];
            for (element, rows) in context.elements.iter().zip(&rows) {
                self.add(
                    &mut sides,
                    element,
                    &rows.turned(unit),
                    DVec2::splat(context.lambda * element.area),
                );
            }
            self.stage.solve(&mut sides);
            let mut response: Vec<DVec2> = vec![DVec2::ZERO; self.places.len()];
            for (vertex, value) in response.iter_mut().enumerate() {
                let unknown = self.stage.unknown_of[vertex];
                if unknown != NONE {
                    *value = DVec2::from(sides[unknown as usize]);
                }
            }
            for (floating, shift) in self.stage.floating.iter().zip(self.shifts(&response, None)) {
                floating
                    .shares
                    .iter()
                    .for_each(|(vertex, _)| response[*vertex as usize] += shift);
            }
            let feedback = ContextSheet::similarity(&places, &context.places(&response));
            (sides, feedback)
        };
        let (re, im) = (respond(DVec2::X), respond(DVec2::Y));
        Kept {
            rows,
            responses: [re.0, im.0],
            feedback: [re.1, im.1],
            places,
        }
    }

    /// How far what floats is to be shifted, so that its centroid is that of `wanted` (none: the origin).
    pub(super) fn shifts(&self, places: &[DVec2], wanted: Option<&[DVec2]>) -> Vec<DVec2> {
        let shift = |floating: &Floating| {
            let (mut sum, mut total) = (DVec2::ZERO, 0.0);
            for (vertex, share) in &floating.shares {
                let want = wanted.map_or(DVec2::ZERO, |wanted| wanted[*vertex as usize]);
                sum += *share * (want - places[*vertex as usize]);
                total += share;
            }
            if total > 0.0 {
                sum / total
            } else {
                DVec2::ZERO
            }
        };
        self.stage.floating.iter().map(shift).collect()
    }

    /// Round (c): the places with the least energy for the turns as they are. What is solved for is the change, so that
    /// held places need no matrix of their own.
    pub(super) fn solve(&mut self) {
        let stage = Arc::clone(&self.stage);
        let mut sides = vec![[0.0; 2]; stage.unknown_count()];
        for (i, body) in stage.bodies.iter().enumerate() {
            let element = &stage.elements[body.triangle as usize];
            let lack = self.wanted(i).minus(&element.rows(&self.places));
            self.add(&mut sides, element, &lack, body.k2 * element.area);
        }
        if let (Some(context), Some(_)) = (&stage.context, &self.kept) {
            for element in &context.elements {
                let lack = Rows(DVec2::ZERO, DVec2::ZERO).minus(&element.rows(&self.places));
                self.add(
                    &mut sides,
                    element,
                    &lack,
                    DVec2::splat(context.lambda * element.area),
                );
            }
        }
        stage.solve(&mut sides);
        self.change(&sides, 1.0);
        self.center();
        if let (Some(context), Some(kept)) = (&stage.context, self.kept.take()) {
            let start = ContextSheet::similarity(&kept.places, &context.places(&self.places));
            // a = start + Re a · feedback[0] + Im a · feedback[1].
            let [re, im] = kept.feedback;
            let columns = glam::DMat2::from_cols(DVec2::X - re, DVec2::Y - im);
            let similarity = if columns.determinant() != 0.0 {
                columns.inverse() * start
            } else {
                start
            };
            self.similarity = similarity;
            self.change(&kept.responses[0], similarity.x);
            self.change(&kept.responses[1], similarity.y);
            self.center();
            self.kept = Some(kept);
        }
    }

    /// Changes places by solutions.
    pub(super) fn change(&mut self, changes: &[[f64; 2]], factor: f64) {
        for (place, unknown) in self.places.iter_mut().zip(&self.stage.unknown_of) {
            if *unknown != NONE {
                *place += factor * DVec2::from(changes[*unknown as usize]);
            }
        }
        for open in &mut self.open {
            if open.unknown != NONE {
                open.place += factor * DVec2::from(changes[open.unknown as usize]);
            }
        }
    }

    /// Puts the centroids of what floats where they are in the base shape.
    pub(super) fn center(&mut self) {
        let shifts = self.shifts(&self.places, Some(&self.base));
        let stage = Arc::clone(&self.stage);
        for (floating, shift) in stage.floating.iter().zip(shifts) {
            floating
                .shares
                .iter()
                .for_each(|(vertex, _)| self.places[*vertex as usize] += shift);
            for open in self
                .open
                .iter_mut()
                .filter(|open| floating.parts.contains(&open.part))
            {
                open.place += shift;
            }
        }
    }
}
