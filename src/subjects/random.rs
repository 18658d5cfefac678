//! Numbers by chance that are the same on every machine.

/// A generator, by its state (Numerical Recipes, *Quick and dirty generators*).
pub(super) struct Random(pub(super) u32);

impl Random {
    /// The next number, from 0 to 1.
    pub(super) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / 16_777_216.0
    }
}
