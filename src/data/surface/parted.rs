//! A surface with more triangles, for measurements.

use super::tree::{Tree, in_order};
use super::triangle::Triangle;
use super::whole::Surface;

impl Surface {
    /// The same surface with each triangle parted in four at the middles of its sides. Field and segments stay.
    pub fn parted(&self) -> Self {
        let count = 4 * self.triangles.len();
        let mut triangles = Vec::with_capacity(count);
        let mut normals = Vec::with_capacity(count);
        let mut colors = Vec::with_capacity(count);
        let mut owners = Vec::with_capacity(count);
        for (i, Triangle(corners)) in self.triangles.iter().enumerate() {
            let places = quarters(*corners, |a, b| (a + b) * 0.5);
            triangles.extend(places.map(Triangle));
            normals.extend(quarters(self.normals[i], |a, b| (a + b).normalize_or(a)));
            let mean = |a: [u8; 3], b: [u8; 3]| std::array::from_fn(|k| a[k].midpoint(b[k]));
            colors.extend(quarters(self.colors[i], mean));
            owners.extend([self.owners[i]; 4]);
        }
        let textures = self.textures.as_ref();
        let textures =
            textures.map(|of| of.parted(|places| quarters(places, |a, b| (a + b) * 0.5)));
        let tree = Tree::new(&triangles);
        Self {
            textures: textures.map(|textures| textures.in_order(&tree.order)),
            triangles: in_order(&tree.order, &triangles),
            normals: in_order(&tree.order, &normals),
            colors: in_order(&tree.order, &colors),
            owners: in_order(&tree.order, &owners),
            tree,
            ..self.clone()
        }
    }
}

/// The corners of the four parts of a triangle, by what lies in the middle between two corners.
fn quarters<T: Copy>([a, b, c]: [T; 3], middle: impl Fn(T, T) -> T) -> [[T; 3]; 4] {
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;
    use crate::data::{Mesh, MeshPart};
    use glam::Vec3;

    #[test]
    fn a_parted_surface_is_the_same_surface() {
        let (positions, triangles) = cube();
        let mesh = Mesh {
            positions,
            triangles,
            parts: vec![MeshPart {
                name: "cube".to_owned(),
                triangles: 0..12,
            }],
            ..Mesh::default()
        };
        let whole = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
        let parted = whole.parted().parted();
        assert_eq!(parted.triangles.len(), 16 * whole.triangles.len());
        let area = |surface: &Surface| -> f32 {
            let areas = surface.triangles.iter().map(|t| t.area_normal().length());
            areas.sum()
        };
        assert!((area(&parted) - area(&whole)).abs() < 1e-4 * area(&whole));
        for place in [Vec3::ZERO, Vec3::splat(0.3), Vec3::new(0.9, 0.1, 0.2)] {
            let off = (parted.depth_at(place) - whole.depth_at(place)).abs();
            assert!(off < 1e-6, "{place}: {off}");
        }
    }
}
