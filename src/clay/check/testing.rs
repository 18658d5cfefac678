//! Meshes that the tests of the check share.

use glam::{DVec3, Vec3};

pub(super) const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

pub(super) fn places<const N: usize>(of: [[f32; 3]; N]) -> Vec<Vec3> {
    of.map(Vec3::from_array).to_vec()
}

pub(super) fn tetrahedron() -> Vec<Vec3> {
    places([[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]])
}

/// A torus of `n` times `m` squares, each of two triangles.
pub(super) fn torus(n: u32, m: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut mesh = (Vec::new(), Vec::new());
    let turn = |i: u32, n: u32| f64::from(i) / f64::from(n) * std::f64::consts::TAU;
    for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
        let [u, v] = [turn(i, n), turn(j, m)];
        let r = 0.35 + 0.15 * libm::cos(v);
        mesh.0
            .push(DVec3::new(r * libm::cos(u), r * libm::sin(u), 0.15 * libm::sin(v)).as_vec3());
        let at = |i: u32, j: u32| i % n * m + j % m;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        mesh.1.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}
