//! Surfaces between the voxels inside and those outside (Lorensen and Cline, *Marching cubes*, 1987). Where a face of a
//! cell has its inside corners across from each other, those stay apart: so the triangles of neighbouring cells always
//! meet, and every surface is closed and two-manifold.
//!
//! Corner k of a cell lies at the bits of k: x, y, z. Edge 4·axis + u + 2·v runs along an axis from the corner that the
//! next axis has at u and the one after it at v.

use glam::{DVec3, USizeVec3};

/// Vertices keep this part of an edge away from its ends, so that none coincide.
const CLOSEST: f64 = 1.0 / 64.0;

/// Values on a grid, x fastest, and which of them are inside. The outermost layer has to be outside.
pub(super) struct Field<'a> {
    /// Values along each axis.
    pub(super) dims: USizeVec3,
    /// At least 0 inside, below 0 outside; where a value is not finite, the surface is half way to it.
    pub(super) values: &'a [f32],
    /// Which values are inside. Of two neighbours that differ here, the signs differ too.
    pub(super) is_inside: &'a [bool],
}

/// A surface: places in steps of the grid from its first value, and triangles counter-clockwise seen from outside.
#[derive(Debug, Default)]
pub(super) struct Walls {
    pub(super) places: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The triangles of every cell, by the bits of its corners that are inside: three edges each.
pub(super) struct Cells {
    triangles: Vec<Vec<[u8; 3]>>,
}

impl Field<'_> {
    fn index(&self, at: USizeVec3) -> usize {
        at.x + self.dims.x * (at.y + self.dims.y * at.z)
    }

    /// The corners of a cell that are inside, as bits.
    fn bits(&self, cell: USizeVec3) -> usize {
        let is_in = |corner: usize| self.is_inside[self.index(cell + corner_at(corner))];
        let bits = (0..8).map(|corner| usize::from(is_in(corner)) << corner);
        bits.sum()
    }

    /// Calls with every cell that the surface runs through and its bits, in the order of the grid.
    fn each_cell(&self, z: usize, mut call: impl FnMut(USizeVec3, usize)) {
        for y in 0..self.dims.y - 1 {
            for x in 0..self.dims.x - 1 {
                let cell = USizeVec3::new(x, y, z);
                match self.bits(cell) {
                    0 | 0xff => {}
                    bits => call(cell, bits),
                }
            }
        }
    }

    /// How many triangles the surface has.
    pub(super) fn count(&self, cells: &Cells) -> usize {
        let mut count = 0;
        for z in 0..self.dims.z - 1 {
            self.each_cell(z, |_, bits| count += cells.triangles[bits].len());
        }
        count
    }

    /// The surface. `go_on` hears how far it is, 0 to 1, and stops it by `false`: `None`.
    pub(super) fn walls(&self, cells: &Cells, go_on: &mut dyn FnMut(f32) -> bool) -> Option<Walls> {
        let area = self.dims.x * self.dims.y;
        let mut walls = Walls::default();
        // Vertices on the edges that leave the values of one layer, by axis; the layer above is in the other list.
        let mut layers = [vec![0_u32; 3 * area], vec![0_u32; 3 * area]];
        self.vertices_of(0, &mut layers[0], &mut walls.places);
        for z in 0..self.dims.z - 1 {
            self.vertices_of(z + 1, &mut layers[(z + 1) % 2], &mut walls.places);
            let triangles = &mut walls.triangles;
            self.each_cell(z, |cell, bits| {
                let vertex = |edge: u8| {
                    let (corner, axis) = edge_at(usize::from(edge));
                    let at = cell + corner_at(corner);
                    layers[at.z % 2][axis * area + at.x + self.dims.x * at.y]
                };
                triangles.extend(cells.triangles[bits].iter().map(|t| t.map(vertex)));
            });
            if !go_on((z + 1) as f32 / self.dims.z as f32) {
                return None;
            }
        }
        Some(walls)
    }

    /// Makes the vertices on all edges that leave the values of a layer along an axis.
    fn vertices_of(&self, z: usize, layer: &mut [u32], places: &mut Vec<DVec3>) {
        let area = self.dims.x * self.dims.y;
        for y in 0..self.dims.y {
            for x in 0..self.dims.x {
                let at = USizeVec3::new(x, y, z);
                for (axis, step) in USizeVec3::AXES.into_iter().enumerate() {
                    let end = at + step;
                    if end.cmpge(self.dims).any() {
                        continue;
                    }
                    let [a, b] = [at, end].map(|at| self.index(at));
                    if self.is_inside[a] == self.is_inside[b] {
                        continue;
                    }
                    layer[axis * area + x + self.dims.x * y] = places.len() as u32;
                    let part = part_of(self.values[a].into(), self.values[b].into());
                    places.push(at.as_dvec3() + step.as_dvec3() * part);
                }
            }
        }
    }
}

/// Where a value is 0 between two of different signs, as a part of the way.
fn part_of(a: f64, b: f64) -> f64 {
    match a.is_finite() && b.is_finite() && a != b {
        true => (a / (a - b)).clamp(CLOSEST, 1.0 - CLOSEST),
        false => 0.5,
    }
}

/// Where a corner of a cell lies.
fn corner_at(corner: usize) -> USizeVec3 {
    USizeVec3::new(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1)
}

/// The corner at which an edge begins, and its axis.
fn edge_at(edge: usize) -> (usize, usize) {
    let axis = edge / 4;
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    (((edge & 1) << u) | (((edge >> 1) & 1) << v), axis)
}

/// The edge between two corners that differ in one bit.
fn edge_of(a: usize, b: usize) -> u8 {
    let axis = (a ^ b).trailing_zeros() as usize;
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    (4 * axis + ((a >> u) & 1) + 2 * ((a >> v) & 1)) as u8
}

/// The corners of the six faces, each counter-clockwise seen from outside the cell.
fn faces() -> [[usize; 4]; 6] {
    std::array::from_fn(|face| {
        let [axis, side] = [face / 2, face % 2];
        let [u, v] = [1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3)];
        let base = side << axis;
        match side {
            0 => [base, base | v, base | u | v, base | u],
            _ => [base, base | u, base | u | v, base | v],
        }
    })
}

/// Number of the edges of a cell.
const EDGES: usize = 12;

impl Cells {
    /// The triangles of all 256 kinds of cells.
    pub(super) fn new() -> Self {
        Self {
            triangles: (0..256).map(triangles_of).collect(),
        }
    }
}

/// The triangles of a cell with these corners inside.
fn triangles_of(bits: usize) -> Vec<[u8; 3]> {
    let is_in = |corner: usize| (bits >> corner) & 1 == 1;
    // On each face the line about a run of inside corners leads from the edge before the run to the one behind it; the
    // face beyond either edge takes it up there.
    let mut next = [None; EDGES];
    for face in faces() {
        for k in 0..4 {
            let corner = |i: usize| face[(k + i) % 4];
            if is_in(corner(0)) || !is_in(corner(1)) {
                continue;
            }
            let last = (1..4).take_while(|i| is_in(corner(*i))).last().unwrap_or(1);
            let entry = edge_of(corner(0), corner(1));
            next[usize::from(entry)] = Some(edge_of(corner(last), corner(last + 1)));
        }
    }
    let mut triangles = Vec::new();
    for start in 0..EDGES {
        let mut line = Vec::new();
        let mut edge = start;
        while let Some(following) = next[edge].take() {
            line.push(edge as u8);
            edge = usize::from(following);
        }
        let count = line.len();
        let apex = (0..count).find(|apex| is_fan_inside(&line, *apex));
        for i in 2..count {
            let of = |k: usize| line[(apex.unwrap_or(0) + k) % count];
            triangles.push([of(0), of(i - 1), of(i)]);
        }
    }
    triangles
}

/// True if no edge between the triangles of a fan lies in a face, where that of a neighbour could lie too.
fn is_fan_inside(line: &[u8], apex: usize) -> bool {
    let count = line.len();
    let mut inner = (2..count.saturating_sub(1)).map(|k| line[(apex + k) % count]);
    inner.all(|edge| !have_face(edge, line[apex]))
}

/// True if two edges are edges of one face.
fn have_face(one: u8, two: u8) -> bool {
    let ends = |edge: u8| {
        let (corner, axis) = edge_at(usize::from(edge));
        [corner, corner | (1 << axis)]
    };
    let has = |face: &[usize; 4], edge: u8| ends(edge).iter().all(|end| face.contains(end));
    faces().iter().any(|face| has(face, one) && has(face, two))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::mesh::{ClayMesh, Vertex};
    use glam::Vec3;

    fn closed(walls: &Walls) -> ClayMesh {
        let vertices = walls.places.iter().map(|place| Vertex {
            pos: place.as_vec3(),
            normal: Vec3::Z,
        });
        let mesh = ClayMesh::new(vertices.collect(), walls.triangles.clone());
        let mesh = mesh.expect("two-manifold");
        assert_eq!(mesh.border_count(), 0);
        mesh
    }

    /// Every kind of cell beside every other one, as random voxels bring them.
    #[test]
    fn any_voxels_have_closed_walls() {
        let dims = USizeVec3::new(12, 11, 13);
        let cells = Cells::new();
        let mut state = 1_u32;
        for percent in [10, 35, 50, 65, 90] {
            let mut is_inside = vec![false; dims.element_product()];
            for (i, is_in) in is_inside.iter_mut().enumerate() {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let at = USizeVec3::new(i % dims.x, i / dims.x % dims.y, i / (dims.x * dims.y));
                let is_outermost = at.cmpeq(USizeVec3::ZERO).any() || (at + 1).cmpge(dims).any();
                *is_in = !is_outermost && (state >> 8) % 100 < percent;
            }
            let values = is_inside
                .iter()
                .map(|is_in| if *is_in { 1.0 } else { -1.0 });
            let values: Vec<f32> = values.collect();
            let field = Field {
                dims,
                values: &values,
                is_inside: &is_inside,
            };
            let walls = field.walls(&cells, &mut |_| true).expect("not stopped");
            assert_eq!(walls.triangles.len(), field.count(&cells));
            closed(&walls);
            // Their outside is outside: the volume is about that of the voxels.
            let place = |vertex: u32| walls.places[vertex as usize];
            let six = walls.triangles.iter().map(|t| {
                let [a, b, c] = t.map(place);
                a.dot(b.cross(c))
            });
            let volume = six.sum::<f64>() / 6.0;
            let count = is_inside.iter().filter(|is_in| **is_in).count() as f64;
            assert!(
                volume > 0.1 * count && volume < 1.1 * count,
                "{volume} for {count}"
            );
            assert!(field.walls(&cells, &mut |_| false).is_none(), "stopped");
        }
    }

    #[test]
    fn a_single_voxel_is_an_octahedron() {
        let dims = USizeVec3::splat(3);
        let mut values = vec![-1.0; 27];
        values[13] = 3.0;
        values[14] = f32::NEG_INFINITY;
        let is_inside: Vec<bool> = values.iter().map(|value| *value > 0.0).collect();
        let field = Field {
            dims,
            values: &values,
            is_inside: &is_inside,
        };
        let walls = field.walls(&Cells::new(), &mut |_| true).expect("a wall");
        assert_eq!((walls.places.len(), walls.triangles.len()), (6, 8));
        closed(&walls);
        let at = |x: f64, y: f64, z: f64| walls.places.contains(&DVec3::new(x, y, z));
        assert!(at(0.25, 1.0, 1.0) && at(1.0, 1.75, 1.0), "{walls:?}");
        assert!(
            at(1.5, 1.0, 1.0),
            "half way to what has no value: {walls:?}"
        );
    }
}
