//! What a clay is before its first stroke where it begins with a mesh file (spec/sweepers.md, B and C).

use glam::{DVec3, Vec3};

use super::error::{ClayError, MAX_FILE_TRIANGLES, MAX_START_TRIANGLES};
use super::mend::Mended;
use super::mesh::{ClayMesh, Vertex};
use super::refine::area_normal;
use super::shaping::{Shaping, Still};
use super::smooth::normal_by_angle;
use super::space::Space;
use crate::data::Mesh;
use crate::document::Clay;

/// Triangles no higher than this count as without area, subject units: as fine as places are rounded.
const FLAT: f64 = 1.0 / (1 << 23) as f64;
/// Rounds in which triangles without area are looked for, since one hides behind another.
const FLAT_ROUNDS: usize = 8;
/// Triangles around a vertex that is merged with another one: with more the work would grow with their square.
const MAX_FAN: usize = 256;
/// Rounds in which edges with the same two ends are split: few are enough but for triangles that lie upon each other.
const DOUBLED_ROUNDS: usize = 32;
/// No shape has edges as long as a sixteenth of half of this, subject units: with more nothing more collapses.
const COARSEST: f64 = 64.0;
/// A pass that takes a smaller part of the triangles away than this has done what it can with its detail.
const WORTH: f64 = 0.01;

impl Shaping {
    /// The clay of a mesh file before its first stroke: all parts are one, colours are left aside. Takes seconds for a
    /// million triangles. `go_on` hears how far it is, 0 to 1, and stops it by `false`.
    ///
    /// # Errors
    /// [`ClayError`], where there are too many triangles or it was stopped.
    pub fn of_mesh(
        clay: &Clay,
        mesh: &Mesh,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Self, ClayError> {
        let found = mesh.triangles.len();
        if found > MAX_FILE_TRIANGLES {
            return Err(ClayError::ManyTriangles(found));
        }
        let nothing = || ClayError::NoSurface("the clay's file has no surface".to_owned());
        let space = Space::around(&mesh.positions).ok_or_else(nothing)?;
        let positions: Vec<Vec3> = mesh.positions.iter().map(|p| space.from_mm(*p)).collect();
        let mended = Mended::of(positions, mesh.triangles.clone());
        let mut told = vec![
            (
                mended.parted_edges,
                "edges with more than two triangles parted",
            ),
            (mended.turned_pieces, "pieces turned inside out"),
        ];
        let surface = surface_of(mended).ok_or_else(nothing)?;
        let mut shaping = Self::of(surface, space, clay.detail);
        if !go_on(0.5) {
            return Err(ClayError::Stopped);
        }
        told.push((shaping.collapse_flat(), "triangles without area collapsed"));
        shaping.reduce(found, go_on)?;
        // Without the free places of what is gone.
        let left = shaping.mesh.triangle_count();
        let (vertices, triangles, _) = shaping.mesh.compact();
        let surface = ClayMesh::new(vertices, triangles).ok_or_else(nothing)?;
        let border = surface.border_count();
        let mut start = Self::of(surface, space, clay.detail);
        start.start_notices = notices(&told, found, left, border);
        Ok(start)
    }

    /// Takes triangles without area away, whose normal would be none: their shortest edge collapses if it has no
    /// length, else the longest turns over to the triangle beyond it. Those at a border stay. Gives how many are gone.
    fn collapse_flat(&mut self) -> usize {
        let mut gone = 0;
        for _ in 0..FLAT_ROUNDS {
            let before = gone;
            for triangle in 0..self.mesh.triangle_places() {
                let Some([shortest, longest]) = self.flat(triangle) else {
                    continue;
                };
                if shortest.0 <= FLAT * FLAT {
                    gone += self.merge(shortest.1);
                } else if self.is_flip_flat(longest.1) && self.mesh.flip(longest.1).is_some() {
                    gone += 1;
                }
            }
            if gone == before {
                break;
            }
        }
        gone
    }

    /// Makes the ends of an edge without length one vertex, if the surface stays whole. Gives how many triangles go.
    fn merge(&mut self, half: u32) -> usize {
        let ends = [self.mesh.from(half), self.mesh.to(half)];
        if ends
            .iter()
            .any(|end| self.mesh.fan(*end).nth(MAX_FAN).is_some())
        {
            return 0;
        }
        let mut stepping = self.stepping();
        // No edge is too long here.
        stepping.detail = f64::INFINITY;
        let count = stepping.mesh.triangle_count();
        stepping.collapse(half, &Still);
        count - stepping.mesh.triangle_count()
    }

    /// The shortest and the longest edge of a triangle without area: their squares and half-edges.
    fn flat(&self, triangle: u32) -> Option<[(f64, u32); 2]> {
        let corners = self.mesh.triangle(triangle)?;
        let [a, b, c] = corners.map(|v| self.mesh.vertices[v as usize].pos());
        let lengths = [
            a.distance_squared(b),
            b.distance_squared(c),
            c.distance_squared(a),
        ];
        let edges = [0, 1, 2].map(|k| (lengths[k], 3 * triangle + k as u32));
        let shortest = edges
            .into_iter()
            .reduce(|a, b| if b.0 < a.0 { b } else { a })?;
        let longest = edges
            .into_iter()
            .reduce(|a, b| if b.0 > a.0 { b } else { a })?;
        let is_flat = area_normal([a, b, c]).length_squared() <= FLAT * FLAT * longest.0;
        is_flat.then_some([shortest, longest])
    }

    /// True if the longest edge of a triangle without area may turn over: both triangles that come look the way of the
    /// one that was beyond it.
    fn is_flip_flat(&self, half: u32) -> bool {
        let Some(other) = self.mesh.twin(half) else {
            return false;
        };
        let at = |vertex: u32| self.mesh.vertices[vertex as usize].pos();
        let [a, b] = [at(self.mesh.from(half)), at(self.mesh.to(half))];
        let [c, d] = [at(self.mesh.across(half)), at(self.mesh.across(other))];
        let beyond = area_normal([b, a, d]);
        [[c, d, b], [d, c, a]]
            .into_iter()
            .all(|new| area_normal(new).dot(beyond) > 0.0)
    }

    /// Collapses edges until there are few enough triangles to begin with, by a detail that is doubled each time.
    pub(super) fn reduce(
        &mut self,
        found: usize,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<(), ClayError> {
        let mut detail = self.detail;
        let mut left = self.mesh.triangle_count();
        while left > MAX_START_TRIANGLES {
            let many = (left - MAX_START_TRIANGLES) as f32 / (found - MAX_START_TRIANGLES) as f32;
            if !go_on(1.0 - 0.5 * many.min(1.0)) {
                return Err(ClayError::Stopped);
            }
            if detail > COARSEST {
                return Err(ClayError::Irreducible { found, left });
            }
            let before = left;
            left = self.collapse_all(detail);
            if ((before - left) as f64) < WORTH * before as f64 {
                detail *= 2.0;
            }
        }
        Ok(())
    }

    /// Collapses all edges that are short for a detail. Gives how many triangles are left.
    pub(super) fn collapse_all(&mut self, detail: f64) -> usize {
        let mut stepping = self.stepping();
        stepping.detail = detail;
        for vertex in 0..stepping.mesh.vertex_places() {
            if stepping.mesh.is_vertex(vertex) {
                stepping.touch(vertex);
            }
        }
        stepping.collapse_short(&Still);
        stepping.mesh.triangle_count()
    }
}

/// The mesh of mended triangles, with the mean normal of the triangles at each vertex.
fn surface_of(mended: Mended) -> Option<ClayMesh> {
    let vertices = mended.positions.into_iter();
    let vertices = vertices.map(|pos| Vertex {
        pos,
        normal: Vec3::Z,
    });
    let mut mesh = ClayMesh::joined(vertices.collect(), mended.triangles, mended.twins)?;
    // Surfaces that were parted along an edge may have both its ends in common still.
    for _ in 0..DOUBLED_ROUNDS {
        let doubled = mesh.doubled();
        if doubled.is_empty() {
            break;
        }
        for half in doubled {
            let [a, b] = [mesh.from(half), mesh.to(half)];
            let [a, b] = [a, b].map(|end| mesh.vertices[end as usize].pos());
            mesh.split(half, Vertex::new((a + b) * 0.5, DVec3::Z));
        }
    }
    give_normals(&mut mesh);
    Some(mesh)
}

/// Gives every vertex the mean normal of its triangles.
pub(super) fn give_normals(mesh: &mut ClayMesh) {
    for vertex in 0..mesh.vertex_places() {
        if mesh.is_vertex(vertex) {
            let normal = normal_by_angle(mesh, vertex).normalize_or(DVec3::Z);
            let pos = mesh.vertices[vertex as usize].pos();
            mesh.vertices[vertex as usize] = Vertex::new(pos, normal);
        }
    }
}

/// What was done to a file, in words.
fn notices(told: &[(usize, &str)], found: usize, left: usize, border: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let done: Vec<String> = told
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if !done.is_empty() {
        lines.push(format!(
            "the file's mesh was made a clay: {}",
            done.join(", ")
        ));
    }
    if found > MAX_START_TRIANGLES {
        lines.push(format!(
            "the file's {found} triangles were reduced to {left}: a clay begins with at most {MAX_START_TRIANGLES}"
        ));
    }
    if border > 0 {
        lines.push(format!(
            "the file's mesh is open ({border} edges have one triangle), and so is the clay: it has no inside"
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::check::Check;
    use crate::clay::shaping::Shaped;
    use crate::clay::suite::{ball, place, stroke};
    use crate::data::mesh::testing::cube;
    use crate::document::ClayStroke;

    fn mesh_of(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
        Mesh {
            positions,
            triangles,
            ..Mesh::default()
        }
    }

    fn begin(mesh: &Mesh) -> Shaping {
        Shaping::of_mesh(&Clay::default(), mesh, &mut |_| true).unwrap()
    }

    fn check(shaped: &Shaped) -> Check {
        Check::of(&shaped.positions, &shaped.triangles, None)
    }

    /// A start after one stroke.
    fn struck(mut start: Shaping, stroke: ClayStroke) -> Shaped {
        let clay = Clay {
            tools: vec![ball(0.1, 0.1)],
            strokes: vec![stroke],
            ..Clay::default()
        };
        start.stroke(&clay, &mut |_| true).unwrap();
        assert!(start.left_out().is_empty());
        start.shaped()
    }

    fn pulled_up() -> ClayStroke {
        stroke(&[[0, 0, 440], [0, 0, 640]].map(place))
    }

    #[test]
    fn a_clay_lies_where_its_file_lies() {
        let (positions, triangles) = cube();
        let placed = positions.iter();
        let placed: Vec<Vec3> = placed
            .map(|p| *p * Vec3::new(50.0, 20.0, 40.0) + Vec3::new(10.0, -20.0, 300.0))
            .collect();
        let start = begin(&mesh_of(placed.clone(), triangles.clone()));
        assert_eq!(start.notices(), [""; 0]);
        let shaped = start.shaped();
        assert_eq!(shaped.space.mm_per_unit, 50.0);
        assert_eq!(shaped.space.middle_mm, DVec3::new(35.0, -10.0, 320.0));
        assert_eq!(shaped.triangles, triangles);
        for (back, place) in shaped.positions_mm().into_iter().zip(&placed) {
            assert!(back.distance(*place) < 1e-5, "{back} for {place}");
        }
        for (pos, normal) in shaped.positions.iter().zip(&shaped.normals) {
            assert!((normal.length() - 1.0).abs() < 1e-6);
            assert!(
                (*normal * pos.signum()).min_element() > 0.3,
                "{normal} at {pos}"
            );
        }
        let pulled = struck(start, stroke(&[[0, 0, 340], [0, 0, 540]].map(place)));
        let found = check(&pulled);
        assert!(
            found.is_two_manifold() && found.crossing == 0,
            "{}",
            found.lines()
        );
        assert_eq!((found.euler, found.border_edges), (2, 0));
        let top = pulled.positions_mm().into_iter().map(|p| p.z);
        assert!(
            top.reduce(f32::max).unwrap() > 345.0,
            "millimetres of the file"
        );
    }

    #[test]
    fn an_open_mesh_stays_open() {
        let (positions, triangles) = cube();
        // Without its bottom.
        let start = begin(&mesh_of(positions, triangles[2..].to_vec()));
        let said = start.notices();
        assert!(said.len() == 1 && said[0].contains("4 edges"), "{said:?}");
        let found = check(&struck(start, pulled_up()));
        assert!(found.is_two_manifold(), "{}", found.lines());
        assert_eq!(
            (found.border_edges, found.euler, found.volume),
            (4, 1, None)
        );
    }

    #[test]
    fn triangles_without_area_go_and_the_shape_stays() {
        let (mut positions, mut triangles) = cube();
        // A vertex on an edge of the upper face, which the next face does not know.
        let [a, b] = [4, 5];
        positions.push(Vec3::new(0.4, 0.0, 1.0));
        let upper = triangles.iter().position(|t| *t == [4, 5, 7]).unwrap();
        triangles[upper] = [8, b, 7];
        triangles.extend([[a, 8, 7], [a, b, 8]]);
        // One that is as good as another.
        positions.push(Vec3::new(1e-9, 0.0, 0.0));
        let lower = triangles.iter().position(|t| *t == [0, 2, 3]).unwrap();
        triangles[lower] = [9, 2, 3];
        triangles.extend([[0, 2, 9]]);
        let next = triangles.iter().position(|t| *t == [0, 3, 1]).unwrap();
        triangles[next] = [9, 3, 1];
        let side = triangles.iter().position(|t| *t == [0, 1, 5]).unwrap();
        triangles[side] = [9, 1, 5];
        triangles.push([0, 9, 5]);
        let start = begin(&mesh_of(positions, triangles));
        let said = start.notices();
        assert_eq!(
            said,
            ["the file's mesh was made a clay: 3 triangles without area collapsed"]
        );
        let found = check(&start.shaped());
        assert!(
            found.is_two_manifold() && found.flat_triangles == 0,
            "{}",
            found.lines()
        );
        assert_eq!((found.euler, found.vertices), (2, 9));
        assert!((found.volume.unwrap() - 1.0).abs() < 1e-6);
    }

    /// Cubes on a grid without the walls between them.
    fn voxels(all: &[[i32; 3]]) -> Mesh {
        let (corners, faces) = cube();
        let mut mesh = Mesh::default();
        for at in all {
            for face in &faces {
                let places = face.map(|i| corners[i as usize]);
                let middle = (places[0] + places[1] + places[2]) / 3.0;
                let out = (middle - 0.5).to_array().map(|x| (2.0 * x) as i32);
                let beyond = [0, 1, 2].map(|axis| at[axis] + out[axis]);
                if all.contains(&beyond) {
                    continue;
                }
                let offset = Vec3::from_array(at.map(|x| x as f32));
                mesh.triangles.push(places.map(|place| {
                    let place = place + offset;
                    let known = mesh.positions.iter().position(|other| *other == place);
                    known.unwrap_or_else(|| {
                        mesh.positions.push(place);
                        mesh.positions.len() - 1
                    }) as u32
                }));
            }
        }
        mesh
    }

    /// Two columns that touch along an edge stand on one floor and carry one roof: parted along the edge its ends are
    /// the same vertices still.
    #[test]
    fn edges_that_two_sheets_share_get_vertices_of_their_own() {
        let mut all = vec![[0, 0, 1], [1, 1, 1]];
        for z in [0, 2] {
            all.extend([[0, 0, z], [0, 1, z], [1, 0, z], [1, 1, z]]);
        }
        let start = begin(&voxels(&all));
        assert_eq!(
            start.notices(),
            ["the file's mesh was made a clay: 1 edges with more than two triangles parted"]
        );
        let found = check(&start.shaped());
        assert!(found.is_two_manifold(), "{}", found.lines());
        // One can go around a column.
        assert_eq!((found.border_edges, found.pieces, found.euler), (0, 1, 0));
        let volume = found.volume.unwrap() * 27.0;
        assert!((volume - 10.0).abs() < 1e-4, "{volume}");
        let found = check(&struck(start, pulled_up()));
        assert!(
            found.is_two_manifold() && found.euler == 0,
            "{}",
            found.lines()
        );
    }

    #[test]
    fn triangles_back_to_back_are_a_surface() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let start = begin(&mesh_of(positions, vec![[0, 1, 2], [0, 2, 1]]));
        let found = check(&start.shaped());
        assert!(
            found.is_two_manifold() && found.euler == 2,
            "{}",
            found.lines()
        );
        let found = check(&struck(start, stroke(&[[0, 0, 0], [0, 0, 60]].map(place))));
        assert!(
            found.is_two_manifold() && found.euler == 2,
            "{}",
            found.lines()
        );
    }

    #[test]
    fn whatever_triangles_come_a_surface_comes_of_them() {
        // Number 83 has triangles back to back, which broke once.
        for seed in 60..100_u32 {
            let mut state = seed;
            let mut below = |n: u32| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 8) % n
            };
            let count = 4 + below(12);
            let positions: Vec<Vec3> = (0..count)
                .map(|i| Vec3::new(below(3) as f32, below(3) as f32, i as f32 / 16.0))
                .collect();
            let mut triangles = std::collections::BTreeSet::new();
            for _ in 0..4 + below(80) {
                let [a, b, c] = [below(count), below(count), below(count)];
                if a != b && b != c && c != a {
                    let least = a.min(b).min(c);
                    triangles.insert(match least {
                        least if least == a => [a, b, c],
                        least if least == b => [b, c, a],
                        _ => [c, a, b],
                    });
                }
            }
            if triangles.is_empty() {
                continue;
            }
            let triangles: Vec<[u32; 3]> = triangles.into_iter().collect();
            let start = begin(&mesh_of(positions, triangles));
            let found = check(&start.shaped());
            assert!(found.is_two_manifold(), "{seed}: {}", found.lines());
            let found = check(&struck(start, stroke(&[[0, 0, 0], [0, 0, 60]].map(place))));
            assert!(found.is_two_manifold(), "{seed}: {}", found.lines());
        }
    }

    /// A torus of this many vertices around and across, 300 mm wide.
    fn torus(around: u32, across: u32) -> Mesh {
        let mut mesh = Mesh::default();
        for i in 0..around {
            let turn = f64::from(i) / f64::from(around) * std::f64::consts::TAU;
            for j in 0..across {
                let tilt = f64::from(j) / f64::from(across) * std::f64::consts::TAU;
                let out = 100.0 + 50.0 * tilt.cos();
                let place = DVec3::new(out * turn.cos(), out * turn.sin(), 50.0 * tilt.sin());
                mesh.positions.push(place.as_vec3());
                let at = |i: u32, j: u32| (i % around) * across + j % across;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    #[test]
    fn a_fine_mesh_is_reduced_and_says_so() {
        let fine = torus(480, 240);
        assert_eq!(fine.triangles.len(), 230_400);
        let mut heard = Vec::new();
        let start = Shaping::of_mesh(&Clay::default(), &fine, &mut |part| {
            heard.push(part);
            true
        });
        assert!(heard.len() > 1 && heard.is_sorted(), "{heard:?}");
        let start = start.unwrap();
        let shaped = start.shaped();
        let left = shaped.triangles.len();
        assert!(left <= MAX_START_TRIANGLES && left > 1000, "{left}");
        let [said] = &start.notices()[..] else {
            panic!("{:?}", start.notices())
        };
        assert!(
            said.contains("230400") && said.contains(&left.to_string()),
            "{said}"
        );
        let found = check(&shaped);
        assert!(
            found.is_two_manifold() && found.border_edges == 0,
            "{}",
            found.lines()
        );
        assert_eq!((found.euler, found.crossing), (0, 0));
        for place in shaped.positions_mm() {
            let out = place.truncate().length() - 100.0;
            let off = (out.hypot(place.z) - 50.0).abs();
            assert!(off < 0.5, "{off} mm off at {place}");
        }
        let mut asked = 0;
        let stopped = Shaping::of_mesh(&Clay::default(), &fine, &mut |_| {
            asked += 1;
            asked < 2
        });
        assert_eq!(stopped.unwrap_err(), ClayError::Stopped);
    }

    #[test]
    fn what_is_too_much_is_refused_with_the_number() {
        let many = mesh_of(cube().0, vec![[0, 1, 2]; MAX_FILE_TRIANGLES + 1]);
        let refused = Shaping::of_mesh(&Clay::default(), &many, &mut |_| true);
        assert_eq!(refused.unwrap_err(), ClayError::ManyTriangles(1_000_001));
        // Each triangle by itself: nothing of it may collapse.
        let loose = 200_001;
        let positions = (0..3 * loose).map(|i| {
            let corner = [Vec3::ZERO, Vec3::X, Vec3::Y][i % 3];
            corner + Vec3::Z * (i / 3) as f32
        });
        let triangles = (0..loose as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        let loose = mesh_of(positions.collect(), triangles.collect());
        let refused = Shaping::of_mesh(&Clay::default(), &loose, &mut |_| true).unwrap_err();
        let left = 200_001;
        assert_eq!(refused, ClayError::Irreducible { found: left, left });
        assert!(refused.to_string().contains("200001"), "{refused}");
        let nothing = Shaping::of_mesh(&Clay::default(), &Mesh::default(), &mut |_| true);
        assert!(matches!(nothing, Err(ClayError::NoSurface(_))));
    }
}
