//! The triangles of a bent figure on the GPU.

use glam::{DVec2, Vec2};

use crate::data::Sheet;
use crate::render::device::buffers::vertex_buffer;
use crate::render::device::gpu::Gpu;
use crate::render::pack::gpu_types::SheetCorner;

/// The triangles of a sheet.
#[derive(Debug)]
pub(crate) struct SheetBuffers {
    /// What is drawn.
    pub sheet: Sheet,
    /// Three [`SheetCorner`]s of each triangle, in the order of drawing.
    pub corners: wgpu::Buffer,
    /// How many corners there are.
    pub count: u32,
}

impl SheetBuffers {
    pub(crate) fn new(gpu: &Gpu, sheet: &Sheet) -> Self {
        let corners: Vec<SheetCorner> = corners(sheet).flatten().collect();
        Self {
            corners: vertex_buffer(gpu, "sheet", &corners),
            count: corners.len() as u32,
            sheet: sheet.clone(),
        }
    }

    /// Gives the memory back. A browser would do so late.
    pub(crate) fn destroy(&self) {
        self.corners.destroy();
    }
}

/// The corners of the triangles, from behind to front.
fn corners(sheet: &Sheet) -> impl Iterator<Item = [SheetCorner; 3]> {
    let mesh = &sheet.mesh;
    let in_order = sheet.order.iter();
    in_order.filter_map(|triangle| {
        let corners = mesh.triangles.get(*triangle as usize)?;
        let [a, b, c] = corners.map(|vertex| vertex as usize);
        let of = |all: &[Vec2]| Some([*all.get(a)?, *all.get(b)?, *all.get(c)?]);
        let (rest, places) = (of(&mesh.rest)?, of(&sheet.places)?);
        let corner = |vertex: usize| {
            Some(SheetCorner {
                places: places.map(|place| place.to_array()),
                rest: rest[0].to_array(),
                rest_from_place: rest_from_place(rest, places).map(|column| column.to_array()),
                color: *mesh.colors.get(vertex)?,
            })
        };
        Some([corner(a)?, corner(b)?, corner(c)?])
    })
}

/// Columns of the map that takes directions in a bent triangle to those at rest; 0 where it has no area and is not
/// seen.
fn rest_from_place(rest: [Vec2; 3], places: [Vec2; 3]) -> [Vec2; 2] {
    let sides = |[a, b, c]: [Vec2; 3]| [b, c].map(|to| to.as_dvec2() - a.as_dvec2());
    let ([r, s], [p, q]) = (sides(rest), sides(places));
    let area = p.perp_dot(q);
    if area.abs() < 1e-14 {
        return [Vec2::ZERO; 2];
    }
    let columns: [DVec2; 2] = [(r * q.y - s * p.y) / area, (s * p.x - r * q.x) / area];
    columns.map(|column| column.as_vec2())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::SheetMesh;
    use std::sync::Arc;

    #[test]
    fn corners_lead_back_to_rest() {
        let rest = [[0.0, 0.0], [0.3, 0.1], [0.1, 0.4], [0.5, 0.5]].map(Vec2::from_array);
        let places = [[0.1, 0.2], [0.1, 0.6], [-0.4, 0.3], [-0.4, 0.3]].map(Vec2::from_array);
        let sheet = Sheet {
            mesh: Arc::new(SheetMesh {
                rest: rest.to_vec(),
                colors: vec![[0.0; 4]; 4],
                triangles: vec![[0, 1, 2], [1, 3, 2], [0, 1, 9]],
                region_of: vec![0; 3],
                regions: vec!["all".to_owned()],
            }),
            places: Arc::new(places.to_vec()),
            // One that is not there and one with a vertex that is not there are left out.
            order: Arc::new(vec![2, 7, 1, 0]),
            base: None,
        };
        let found: Vec<[SheetCorner; 3]> = corners(&sheet).collect();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0][0].rest_from_place, [[0.0; 2]; 2], "it has no area");
        for corner in found[1] {
            assert_eq!(
                corner.places,
                [places[0], places[1], places[2]].map(|place| place.to_array())
            );
            let [x, y] = corner.rest_from_place.map(Vec2::from_array);
            for i in 0..3 {
                let by = places[i] - places[0];
                let back = Vec2::from_array(corner.rest) + x * by.x + y * by.y;
                assert!(back.distance(rest[i]) < 1e-6, "{back} and {}", rest[i]);
            }
        }
    }
}
