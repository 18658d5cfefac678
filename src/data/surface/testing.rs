//! Triangles and places for the tests of this room.

use glam::Vec3;

/// Pseudo-random numbers, the same on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// From -1 to 1.
    pub(crate) fn number(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }

    /// In the cube from -1 to 1.
    pub(crate) fn place(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }
}

/// Corners of triangles anywhere in the cube from -1 to 1.
pub(crate) fn soup(count: usize, seed: u64) -> Vec<[Vec3; 3]> {
    let mut random = Random(seed);
    (0..count)
        .map(|_| {
            let at = random.place();
            [at, at + random.place() * 0.3, at + random.place() * 0.3]
        })
        .collect()
}
