//! What becomes a part: what the file names, pieces, or the whole.

use glam::{DVec3, Vec3};

use super::options::PartsMode;
use crate::data::Mesh;
use crate::data::mesh::{pieces, volume, winding_number};

/// The name of a part that has none.
const UNNAMED: &str = "surface";
/// Triangles that are looked at to find the body around a cavity, per mesh: beyond it a cavity is a part of its own.
const MAX_LOOKS: usize = 200_000_000;

/// Groups a mesh, whose parts are those of its file, as asked for, and gives every part a name of its own.
pub(super) fn divide(mesh: &mut Mesh, mode: PartsMode) {
    match mode {
        PartsMode::Named => {}
        PartsMode::Pieces => {
            let part_of = by_piece(mesh);
            mesh.group(&part_of, &[]);
        }
        PartsMode::Whole => {
            let part_of = vec![0; mesh.triangles.len()];
            mesh.group(&part_of, &[]);
        }
    }
    name(mesh);
}

/// A single part is not called what the file calls it: that is often a patient's name.
fn name(mesh: &mut Mesh) {
    let is_one = mesh.parts.len() == 1;
    let mut taken = std::collections::BTreeMap::<String, u32>::new();
    for part in &mut mesh.parts {
        if is_one || part.name.is_empty() {
            part.name = UNNAMED.to_owned();
        }
        let plain = part.name.clone();
        let count = taken.get(&plain).copied().unwrap_or(0);
        let mut number = count + 1;
        if count > 0 {
            while taken.contains_key(&format!("{plain} {number}")) {
                number += 1;
            }
            part.name = format!("{plain} {number}");
            taken.insert(part.name.clone(), 1);
        }
        taken.insert(plain, number);
    }
}

struct Piece {
    triangles: Vec<[u32; 3]>,
    bounds: [Vec3; 2],
    volume: f64,
}

impl Piece {
    fn size(&self) -> Vec3 {
        self.bounds[1] - self.bounds[0]
    }

    /// By their volumes; flat boxes by their diagonals.
    fn is_larger_than(&self, other: &Self) -> std::cmp::Ordering {
        let key = |piece: &Self| {
            let size = piece.size().as_dvec3();
            (size.element_product(), size.length())
        };
        let ((a, b), (c, d)) = (key(self), key(other));
        a.total_cmp(&c).then(b.total_cmp(&d))
    }

    fn may_hold(&self, other: &Self) -> bool {
        self.bounds[0].cmple(other.bounds[0]).all() && other.bounds[1].cmple(self.bounds[1]).all()
    }
}

/// The part of each triangle: the largest box first, a piece of negative volume with the smallest that holds it.
fn by_piece(mesh: &Mesh) -> Vec<u32> {
    let (piece_of, count) = pieces(mesh.positions.len(), &mesh.triangles);
    let mut all: Vec<Piece> = (0..count)
        .map(|_| Piece {
            triangles: Vec::new(),
            bounds: [Vec3::INFINITY, Vec3::NEG_INFINITY],
            volume: 0.0,
        })
        .collect();
    for (&triangle, &piece) in mesh.triangles.iter().zip(&piece_of) {
        let piece = &mut all[piece as usize];
        piece.triangles.push(triangle);
        for position in mesh.corners_of(triangle) {
            piece.bounds = [piece.bounds[0].min(position), piece.bounds[1].max(position)];
        }
    }
    for piece in &mut all {
        let center: DVec3 = ((piece.bounds[0] + piece.bounds[1]) * 0.5).as_dvec3();
        piece.volume = volume(&mesh.positions, &piece.triangles, center);
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| all[b].is_larger_than(&all[a]).then(a.cmp(&b)));
    let mut rank = vec![0; count];
    for (place, &piece) in order.iter().enumerate() {
        rank[piece] = place as u32;
    }
    let mut part = rank.clone();
    let mut looks = 0;
    for (place, &piece) in order.iter().enumerate() {
        if all[piece].volume >= 0.0 {
            continue;
        }
        let Some(&first) = all[piece].triangles.first() else {
            continue;
        };
        let vertex = mesh.positions[first[0] as usize].as_dvec3();
        // From the smallest upwards.
        let holder = order[..place].iter().rev().find(|&&other| {
            looks += 1;
            if looks > MAX_LOOKS || all[other].volume <= 0.0 || !all[other].may_hold(&all[piece]) {
                return false;
            }
            looks += all[other].triangles.len();
            winding_number(&mesh.positions, &all[other].triangles, vertex) > 0.5
        });
        if let Some(&holder) = holder {
            part[piece] = rank[holder];
        }
    }
    piece_of.iter().map(|&piece| part[piece as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;

    /// Cubes by their lowest corners and sides; those of negative side are inside out.
    fn cubes(all: &[([f32; 3], f32)]) -> Mesh {
        let (positions, triangles) = cube();
        let mut mesh = Mesh::default();
        for (at, side) in all {
            let before = mesh.positions.len() as u32;
            let placed = positions
                .iter()
                .map(|p| Vec3::from_array(*at) + *p * side.abs());
            mesh.positions.extend(placed);
            mesh.triangles
                .extend(triangles.iter().map(|&[a, b, c]| match *side < 0.0 {
                    true => [a + before, c + before, b + before],
                    false => [a + before, b + before, c + before],
                }));
        }
        mesh.group(&vec![0; mesh.triangles.len()], &[]);
        mesh
    }

    #[test]
    fn cavities_go_with_the_body_around_them() {
        // A small body, a large one with a cavity, a small one in the cavity with a cavity of its own.
        let mut mesh = cubes(&[
            ([50.0, 0.0, 0.0], 1.0),
            ([2.0, 2.0, 2.0], -6.0),
            ([0.0, 0.0, 0.0], 10.0),
            ([4.0, 4.0, 4.0], 2.0),
            ([4.5, 4.5, 4.5], -1.0),
            ([70.0, 0.0, 0.0], -3.0),
        ]);
        divide(&mut mesh, PartsMode::Pieces);
        let parts: Vec<(String, usize)> = mesh
            .parts
            .iter()
            .map(|part| (part.name.clone(), part.triangles.len()))
            .collect();
        let expected = [
            ("surface", 24),
            ("surface 2", 12),
            ("surface 3", 24),
            ("surface 4", 12),
        ];
        assert_eq!(parts, expected.map(|(name, n)| (name.to_owned(), n)));
        let x =
            |part: usize| mesh.corners_of(mesh.triangles[mesh.parts[part].triangles.start])[0].x;
        assert!(
            x(1) >= 70.0,
            "inside out alone is a part of its own, larger than the rest"
        );
        assert_eq!(x(3).floor(), 50.0);
        divide(&mut mesh, PartsMode::Whole);
        assert_eq!(mesh.parts.len(), 1);
    }

    #[test]
    fn every_part_has_a_name_of_its_own_and_a_single_one_none_of_the_file() {
        let names = |given: &[&str]| {
            let mut mesh = cubes(&vec![([0.0; 3], 1.0); given.len()]);
            let part_of: Vec<u32> = (0..given.len() as u32).flat_map(|i| [i; 12]).collect();
            let given: Vec<String> = given.iter().map(|name| (*name).to_owned()).collect();
            mesh.group(&part_of, &given);
            divide(&mut mesh, PartsMode::Named);
            mesh.parts
                .into_iter()
                .map(|part| part.name)
                .collect::<Vec<_>>()
        };
        assert_eq!(names(&["Jane Doe"]), ["surface"]);
        assert_eq!(
            names(&["talus", "", "talus", "", "skin"]),
            ["talus", "surface", "talus 2", "surface 2", "skin"]
        );
        assert_eq!(names(&["a", "a 2", "a", "a"]), ["a", "a 2", "a 3", "a 4"]);
    }
}
