//! What a clay is before its first stroke where it begins with a mesh file (spec/sweepers.md, B and C).

use glam::{DVec3, Vec3};

use super::body::Space;
use super::mend::Mended;
use super::mesh::{ClayMesh, Vertex};
use super::refine::area_normal;
use super::shaping::{ClayError, Shaping, Still};
use super::smooth::normal_by_angle;
use crate::data::Mesh;
use crate::document::Clay;

/// Most triangles of a file.
pub const MAX_FILE_TRIANGLES: usize = 1_000_000;
/// A mesh of more triangles is reduced.
pub const MAX_START_TRIANGLES: usize = 200_000;
/// Triangles no higher than this count as without area, subject units: as fine as places are rounded.
const FLAT: f64 = 1.0 / (1 << 23) as f64;
/// Rounds in which triangles without area are looked for, since one hides behind another.
const FLAT_ROUNDS: usize = 8;
/// Rounds in which edges with the same two ends are split: one is enough but for triangles that lie upon each other.
const DOUBLED_ROUNDS: usize = 16;
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
                    let mut stepping = self.stepping();
                    // No edge is too long here.
                    stepping.detail = f64::INFINITY;
                    let count = stepping.mesh.triangle_count();
                    stepping.collapse(shortest.1, &Still);
                    gone += count - stepping.mesh.triangle_count();
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
    fn reduce(
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
            let mut stepping = self.stepping();
            stepping.detail = detail;
            for vertex in 0..stepping.mesh.vertex_places() {
                if stepping.mesh.is_vertex(vertex) {
                    stepping.touch(vertex);
                }
            }
            stepping.collapse_short(&Still);
            let before = left;
            left = stepping.mesh.triangle_count();
            if ((before - left) as f64) < WORTH * before as f64 {
                detail *= 2.0;
            }
        }
        Ok(())
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
    for vertex in 0..mesh.vertex_places() {
        if mesh.is_vertex(vertex) {
            let normal = normal_by_angle(&mesh, vertex).normalize_or(DVec3::Z);
            let pos = mesh.vertices[vertex as usize].pos();
            mesh.vertices[vertex as usize] = Vertex::new(pos, normal);
        }
    }
    Some(mesh)
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
