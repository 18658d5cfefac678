//! What `"do": "smooth"` does at a moment (spec/sweepers.md, B): vertices go towards the mean of their neighbours. No
//! deformation of space, and not in the paper.

use glam::DVec3;

use super::mesh::{ClayMesh, Vertex};

/// Farthest that a vertex goes, as a part of its shortest edge.
const FARTHEST: f64 = 0.25;

/// Smooths some vertices, `part` of the way for each place, and gives those that moved, with new normals.
pub(super) fn smoothed(
    mesh: &mut ClayMesh,
    vertices: &[u32],
    part: &dyn Fn(DVec3) -> f64,
) -> Vec<u32> {
    let mut moves = Vec::new();
    for vertex in vertices {
        if mesh.is_border(*vertex) {
            continue;
        }
        let pos = mesh.vertices[*vertex as usize].pos();
        let part = part(pos);
        if part <= 0.0 {
            continue;
        }
        let (mut sum, mut count, mut shortest) = (DVec3::ZERO, 0.0, f64::INFINITY);
        for other in mesh.ring(*vertex) {
            let other = mesh.vertices[other as usize].pos();
            sum += other;
            count += 1.0;
            shortest = shortest.min(other.distance(pos));
        }
        let way = (sum / count - pos) * part;
        let way = way.clamp_length_max(FARTHEST * shortest);
        let new = (pos + way).as_vec3();
        if new != mesh.vertices[*vertex as usize].pos {
            moves.push((*vertex, new));
        }
    }
    // All at once, from their old places.
    for (vertex, pos) in &moves {
        mesh.vertices[*vertex as usize].pos = *pos;
    }
    let moved: Vec<u32> = moves.into_iter().map(|(vertex, _)| vertex).collect();
    for vertex in &moved {
        let old = mesh.vertices[*vertex as usize];
        let normal = normal_by_angle(mesh, *vertex).normalize_or(old.normal());
        mesh.vertices[*vertex as usize] = Vertex::new(old.pos(), normal);
    }
    moved
}

/// The sum of the normals of the triangles at a vertex, each by its angle there.
pub(super) fn normal_by_angle(mesh: &ClayMesh, vertex: u32) -> DVec3 {
    let at = |v: u32| mesh.vertices[v as usize].pos();
    let pos = at(vertex);
    let mut sum = DVec3::ZERO;
    for half in mesh.fan(vertex) {
        let (u, v) = (at(mesh.to(half)) - pos, at(mesh.across(half)) - pos);
        let normal = u.cross(v);
        let length = normal.length();
        if length > 0.0 {
            sum += normal * (libm::atan2(length, u.dot(v)) / length);
        }
    }
    sum
}
