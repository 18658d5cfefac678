use glam::DVec2;

use super::super::anderson::Anderson;
use super::{MAX_ROUNDS, State, TOLERANCE};
use crate::figure::progress::Progress;

/// Rounds.
impl State {
    /// All that rounds change, as numbers.
    pub(super) fn pack(&self) -> Vec<f64> {
        let mut packed = Vec::with_capacity(2 * self.places.len() + 3 * self.open.len() + 2);
        packed.extend(self.places.iter().flat_map(|place| [place.x, place.y]));
        packed.extend(
            self.open
                .iter()
                .flat_map(|open| [open.place.x, open.place.y, open.angle]),
        );
        packed.extend([self.similarity.x, self.similarity.y]);
        packed
    }

    pub(super) fn unpack(&mut self, packed: &[f64]) {
        let (places, rest) = packed.split_at(2 * self.places.len());
        for (place, values) in self.places.iter_mut().zip(places.chunks_exact(2)) {
            *place = DVec2::new(values[0], values[1]);
        }
        let (open, similarity) = rest.split_at(3 * self.open.len());
        for (open, values) in self.open.iter_mut().zip(open.chunks_exact(3)) {
            open.place = DVec2::new(values[0], values[1]);
            open.angle = values[2];
        }
        self.similarity = DVec2::new(similarity[0], similarity[1]);
        self.turn_places();
    }

    /// A few plain rounds, as a frame of a drag has.
    pub(crate) fn relax(&mut self, rounds: u32) {
        for _ in 0..rounds {
            self.turn_bodies();
            self.turn_open();
            self.solve();
            self.turn_places();
        }
    }

    /// Rounds until no vertex moves by more than the tolerance in one, accelerated. Gives their number. They end
    /// early where `progress` says so.
    pub(crate) fn find_turns(&mut self, progress: &mut Progress<'_>) -> u32 {
        let mut anderson = Anderson::default();
        let mut plain: Option<Vec<f64>> = None;
        let mut before = f64::INFINITY;
        for round in 1..=MAX_ROUNDS {
            let mut energy = self.turn_bodies();
            if energy > before * (1.0 + 1e-12)
                && let Some(last) = plain.take()
            {
                self.unpack(&last);
                anderson.forget();
                energy = self.turn_bodies();
            }
            before = energy;
            let start = self.pack();
            self.turn_open();
            self.solve();
            self.turn_places();
            let end = self.pack();
            let moved = |i: usize| {
                DVec2::new(end[2 * i] - start[2 * i], end[2 * i + 1] - start[2 * i + 1]).length()
            };
            let most = (0..self.places.len()).map(moved).fold(0.0, f64::max);
            let is_wanted = progress(round as f32 / MAX_ROUNDS as f32);
            if most <= TOLERANCE || round == MAX_ROUNDS || !is_wanted {
                return round;
            }
            plain = None;
            if let Some(mixed) = anderson.mixed(&start, &end) {
                self.unpack(&mixed);
                plain = Some(end);
            }
        }
        MAX_ROUNDS
    }

    /// Takes over the turns of a pose before, of the same parts and handles, and solves once.
    pub(crate) fn go_on_from(&mut self, before: &Self) {
        self.turns.clone_from(&before.turns);
        for (open, before) in self.open.iter_mut().zip(&before.open) {
            open.angle = before.angle;
        }
        self.turn_places();
        self.solve();
        self.turn_places();
    }
}
