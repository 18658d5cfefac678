//! Normals at the corners of triangles: smooth within the crease angle, sharp beyond it.

use glam::Vec3;

use crate::data::{Mesh, NO_INDEX};

/// Normals of all corners. `crease_degrees`: triangles that meet at a corner share their normals up to this angle;
/// `None` takes the file's own normals, and 40° where it has none (spec/surfaces.md, `smooth`).
pub(super) fn corner_normals(mesh: &Mesh, crease_degrees: Option<f32>) -> Vec<[Vec3; 3]> {
    let faces: Vec<Vec3> = mesh
        .triangles
        .iter()
        .map(|&triangle| {
            let [a, b, c] = mesh.corners_of(triangle);
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    let least = crease_degrees.unwrap_or(40.0).to_radians().cos();
    let around = Around::new(mesh);
    let one = |triangle: usize, corner: usize| {
        let own = mesh.normals.as_ref().filter(|_| crease_degrees.is_none());
        if let Some(normal) = own.and_then(|normals| normals.get(triangle, corner)) {
            return normal;
        }
        let face = faces[triangle];
        let mut sum = Vec3::ZERO;
        for &(other, at) in around.of(mesh.triangles[triangle][corner]) {
            let normal = faces[other as usize];
            if other as usize == triangle || normal.dot(face) >= least {
                sum += normal * angle_at(mesh, other as usize, at as usize);
            }
        }
        let normal = sum.normalize_or(face);
        // Where a fan closes on itself the mean may point behind the triangle.
        if normal.dot(face) > 0.0 { normal } else { face }
    };
    (0..mesh.triangles.len())
        .map(|triangle| std::array::from_fn(|corner| one(triangle, corner)))
        .collect()
}

/// The angle of a triangle at a corner, radians.
fn angle_at(mesh: &Mesh, triangle: usize, corner: usize) -> f32 {
    let places = mesh.corners_of(mesh.triangles[triangle]);
    let at = places[corner];
    let [one, other] = [places[(corner + 1) % 3] - at, places[(corner + 2) % 3] - at];
    one.angle_between(other)
}

/// The corners of triangles at each vertex.
struct Around {
    starts: Vec<u32>,
    /// Triangle and corner.
    corners: Vec<(u32, u8)>,
}

impl Around {
    fn new(mesh: &Mesh) -> Self {
        let mut starts = vec![0_u32; mesh.positions.len() + 1];
        for &index in mesh.triangles.iter().flatten() {
            starts[index as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut corners = vec![(NO_INDEX, 0); 3 * mesh.triangles.len()];
        for (triangle, indices) in (0..).zip(&mesh.triangles) {
            for (corner, &index) in (0..).zip(indices) {
                corners[next[index as usize] as usize] = (triangle, corner);
                next[index as usize] += 1;
            }
        }
        Self { starts, corners }
    }

    fn of(&self, vertex: u32) -> &[(u32, u8)] {
        let vertex = vertex as usize;
        &self.corners[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;

    #[test]
    fn edges_of_a_cube_stay_sharp_until_they_are_told_not_to() {
        let (positions, triangles) = cube();
        let mesh = Mesh {
            positions,
            triangles,
            ..Mesh::default()
        };
        for normals in corner_normals(&mesh, None) {
            assert!(normals.iter().all(|n| n.abs().max_element() > 0.9999));
        }
        for normals in corner_normals(&mesh, Some(180.0)) {
            for normal in normals {
                assert!((normal.abs() - Vec3::splat(0.577_35)).abs().max_element() < 1e-4);
            }
        }
    }
}
