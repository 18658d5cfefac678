//! From the corners and faces of a file to a mesh that the rest can rely on.

use glam::{DMat3, DVec3, Vec3};

use super::draft::{Corner, Draft};
use super::error::MeshError;
use super::report::Repair;
use super::turn::{face_normal, turn};
use super::weld::weld;
use crate::data::mesh::polygon::triangulate;
use crate::data::{Corners, Mesh, NO_INDEX};

/// Repairs a draft and takes it to millimetres, RAS+. Parts are those of the file, with their names as they are.
///
/// # Errors
/// [`MeshError::NoTriangle`] and [`MeshError::NoSize`].
pub(super) fn repair(
    draft: Draft,
    name: &str,
    ras_from_file: DMat3,
    mm_per_unit: f64,
) -> Result<(Mesh, Repair), MeshError> {
    let mut done = Repair {
        short_faces: draft.short_faces,
        ..Repair::default()
    };
    let mm: Vec<Vec3> = draft
        .positions
        .iter()
        .map(|position| (ras_from_file * position.as_dvec3() * mm_per_unit).as_vec3())
        .collect();
    // Welded as the file has them: a change of units may round two places into one.
    let mut welded = weld(&draft.positions);
    for (first, place) in welded.iter_mut().zip(&mm) {
        if !place.is_finite() {
            *first = NO_INDEX;
        }
    }
    let mut soup = Soup::default();
    for (face, corners) in draft.faces() {
        soup.add_face(corners, &welded, &mm, face.part, face.material, &mut done);
    }
    soup.drop_doubles(&mut done);
    if soup.corners.is_empty() {
        return Err(match is_one_place(&draft, &welded) {
            true => MeshError::NoSize {
                name: name.to_owned(),
            },
            false => MeshError::NoTriangle {
                name: name.to_owned(),
                found: draft.found(),
            },
        });
    }
    Ok((
        soup.into_mesh(draft, &welded, &mm, ras_from_file, &mut done),
        done,
    ))
}

/// True if there are faces and all their vertices lie at one place.
fn is_one_place(draft: &Draft, welded: &[u32]) -> bool {
    let mut places = draft
        .corners
        .iter()
        .map(|corner| welded[corner.position as usize]);
    let first = places.next();
    first.is_some_and(|first| first != NO_INDEX && places.all(|place| place == first))
}

/// Triangles as they are found, not yet in order.
#[derive(Default)]
struct Soup {
    /// The corners as the file has them.
    corners: Vec<[Corner; 3]>,
    /// Welded positions, by the index of the first of them in the file.
    places: Vec<[u32; 3]>,
    part_of: Vec<u32>,
    material_of: Vec<u32>,
}

impl Soup {
    fn add_face(
        &mut self,
        corners: &[Corner],
        welded: &[u32],
        mm: &[Vec3],
        part: u32,
        material: u32,
        done: &mut Repair,
    ) {
        let place = |corner: &Corner| welded[corner.position as usize];
        if corners.iter().any(|corner| place(corner) == NO_INDEX) {
            done.not_finite_faces += 1;
            return;
        }
        if let &[a, b, c] = corners {
            self.add([a, b, c], welded, part, material, done);
            return;
        }
        let mut kept: Vec<Corner> = Vec::with_capacity(corners.len());
        for corner in corners {
            if kept.last().is_none_or(|last| place(last) != place(corner)) {
                kept.push(*corner);
            }
        }
        while kept.len() > 1 && kept.first().map(place) == kept.last().map(place) {
            kept.pop();
        }
        done.repeated_corners += (corners.len() - kept.len()) as u64;
        if kept.len() < 3 {
            done.short_faces += 1;
            return;
        }
        let outline: Vec<DVec3> = kept
            .iter()
            .map(|c| mm[place(c) as usize].as_dvec3())
            .collect();
        for triangle in triangulate(&outline) {
            self.add(triangle.map(|i| kept[i]), welded, part, material, done);
        }
    }

    fn add(
        &mut self,
        corners: [Corner; 3],
        welded: &[u32],
        part: u32,
        material: u32,
        done: &mut Repair,
    ) {
        let places = corners.map(|corner| welded[corner.position as usize]);
        let [a, b, c] = places;
        if a == b || b == c || c == a {
            done.degenerate += 1;
            return;
        }
        self.corners.push(corners);
        self.places.push(places);
        self.part_of.push(part);
        self.material_of.push(material);
    }

    /// Drops all but the first of triangles with the same corners in the same turn.
    fn drop_doubles(&mut self, done: &mut Repair) {
        let keys = self.places.iter().zip(0u32..).map(|(&places, index)| {
            let [a, b, c] = places;
            let least = a.min(b).min(c);
            let turned = match least {
                least if least == a => [a, b, c],
                least if least == b => [b, c, a],
                _ => [c, a, b],
            };
            (turned, index)
        });
        let mut keys: Vec<([u32; 3], u32)> = keys.collect();
        keys.sort_unstable();
        let mut is_double = vec![false; keys.len()];
        for group in keys.chunk_by(|a, b| a.0 == b.0) {
            for (_, index) in &group[1..] {
                is_double[*index as usize] = true;
                done.duplicate += 1;
            }
        }
        if done.duplicate == 0 {
            return;
        }
        keep(&mut self.corners, &is_double);
        keep(&mut self.places, &is_double);
        keep(&mut self.part_of, &is_double);
        keep(&mut self.material_of, &is_double);
    }

    fn into_mesh(
        mut self,
        mut draft: Draft,
        welded: &[u32],
        mm: &[Vec3],
        ras_from_file: DMat3,
        done: &mut Repair,
    ) -> Mesh {
        // Only what is used gets a number, in the order of its first use.
        let mut number = vec![NO_INDEX; welded.len()];
        let mut positions = Vec::new();
        for place in self.places.iter_mut().flatten() {
            let number = &mut number[*place as usize];
            if *number == NO_INDEX {
                *number = positions.len() as u32;
                positions.push(mm[*place as usize]);
            }
            *place = *number;
        }
        let turned = turn(&positions, &self.places);
        done.disagreeing_edges = turned.disagreed;
        done.one_sided_edges = turned.disagree;
        for (triangle, _) in turned
            .is_turned
            .iter()
            .enumerate()
            .filter(|(_, turn)| **turn)
        {
            done.turned += 1;
            self.places[triangle].swap(1, 2);
            self.corners[triangle].swap(1, 2);
        }
        let at = |of: &dyn Fn(&Corner) -> u32| -> Vec<[u32; 3]> {
            let corners = self.corners.iter();
            corners.map(|corners| corners.each_ref().map(of)).collect()
        };
        let normals = (!draft.normals.is_empty()).then(|| Corners {
            values: draft
                .normals
                .iter()
                .map(|n| (ras_from_file * n.as_dvec3()).normalize_or_zero().as_vec3())
                .collect(),
            at: at(&|corner| corner.normal),
        });
        let uvs = (!draft.uvs.is_empty()).then(|| Corners {
            at: at(&|corner| match draft.uvs.get(corner.uv as usize) {
                Some(uv) if uv.is_finite() => corner.uv,
                _ => NO_INDEX,
            }),
            values: draft.uvs.clone(),
        });
        let colors = (!draft.colors.is_empty()).then(|| Corners {
            at: at(&|corner| match draft.colors.get(corner.position as usize) {
                Some(Some(_)) => corner.position,
                _ => NO_INDEX,
            }),
            values: draft
                .colors
                .iter()
                .map(|color| color.unwrap_or_default())
                .collect(),
        });
        let has_material = self.material_of.iter().any(|&index| index != NO_INDEX);
        let mut mesh = Mesh {
            positions,
            triangles: self.places,
            normals,
            uvs: uvs.filter(Corners::has_any),
            colors: colors.filter(Corners::has_any),
            coloring: draft.coloring,
            parts: Vec::new(),
            material_of: if has_material {
                self.material_of
            } else {
                Vec::new()
            },
            materials: std::mem::take(&mut draft.materials),
            textures: std::mem::take(&mut draft.textures),
        };
        check_normals(&mut mesh, done);
        mesh.group(&self.part_of, &draft.parts);
        mesh
    }
}

/// Keeps what is not marked.
fn keep<T>(list: &mut Vec<T>, is_gone: &[bool]) {
    let mut gone = is_gone.iter();
    list.retain(|_| gone.next() == Some(&false));
}

/// Takes normals away that are zero (or were no numbers) or more than 90° off their triangle. Triangles without an area
/// have no side that a normal could be off.
fn check_normals(mesh: &mut Mesh, done: &mut Repair) {
    let Some(mut normals) = mesh.normals.take() else {
        return;
    };
    for (triangle, corners) in mesh.triangles.iter().zip(&mut normals.at) {
        let face = face_normal(triangle.map(|i| mesh.positions[i as usize]));
        for index in corners {
            let Some(normal) = normals.values.get(*index as usize) else {
                continue;
            };
            if *normal == Vec3::ZERO || normal.as_dvec3().dot(face) < 0.0 {
                *index = NO_INDEX;
                done.bad_normals += 1;
            }
        }
    }
    mesh.normals = Some(normals).filter(Corners::has_any);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;

    fn mended(draft: Draft) -> (Mesh, Repair) {
        repair(draft, "a", DMat3::IDENTITY, 1.0).expect("a mesh")
    }

    /// A draft of triangles.
    fn draft(positions: &[Vec3], triangles: &[[u32; 3]]) -> Draft {
        let mut draft = Draft::new("a", 1000);
        for &position in positions {
            draft.add_position(position).expect("room");
        }
        let part = draft.add_part("");
        for &triangle in triangles {
            draft.add_triangle(triangle, part, NO_INDEX).expect("room");
        }
        draft
    }

    #[test]
    fn a_cube_needs_no_repair() {
        let (positions, triangles) = cube();
        let (mesh, done) = mended(draft(&positions, &triangles));
        assert_eq!((mesh.triangles.len(), mesh.positions.len()), (12, 8));
        assert_eq!(done, Repair::default());
    }

    #[test]
    fn a_soup_is_welded_also_across_the_sign_of_zero() {
        let (positions, triangles) = cube();
        let mut soup = Vec::new();
        for (i, index) in triangles.iter().flatten().enumerate() {
            let place = positions[*index as usize];
            // Every second zero is a negative one.
            soup.push(
                place
                    * if i % 2 == 0 {
                        Vec3::ONE
                    } else {
                        place.map(|x| if x == 0.0 { -1.0 } else { 1.0 })
                    },
            );
        }
        let loose: Vec<[u32; 3]> = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let (mesh, done) = mended(draft(&soup, &loose));
        assert_eq!((mesh.triangles.len(), mesh.positions.len()), (12, 8));
        assert_eq!(done, Repair::default());
    }

    #[test]
    fn what_is_no_triangle_is_dropped_and_counted() {
        let (mut positions, mut triangles) = cube();
        positions.extend([Vec3::NAN, positions[3]]);
        triangles.extend([[0, 1, 1], [3, 9, 2], [0, 1, 8]]);
        // The first triangle again, begun elsewhere; turned over it is another one.
        let [a, b, c] = triangles[0];
        triangles.extend([[b, c, a], [c, a, b]]);
        let (mesh, done) = mended(draft(&positions, &triangles));
        assert_eq!((mesh.triangles.len(), mesh.positions.len()), (12, 8));
        let expected = Repair {
            degenerate: 2,
            not_finite_faces: 1,
            duplicate: 2,
            ..Repair::default()
        };
        assert_eq!(done, expected);
        let (mesh, done) = mended(draft(&positions, &[[a, b, c], [a, c, b]]));
        assert_eq!((mesh.triangles.len(), done.duplicate), (2, 0));
    }

    #[test]
    fn numbers_that_overflow_in_millimetres_are_not_finite() {
        let (mut positions, triangles) = cube();
        positions[7] = Vec3::splat(1e36);
        let around = triangles.iter().filter(|t| t.contains(&7)).count() as u64;
        let draft = draft(&positions, &triangles);
        let (_, done) = repair(draft, "a", DMat3::IDENTITY, 1000.0).expect("the rest");
        assert_eq!(done.not_finite_faces, around);
    }

    #[test]
    fn corners_that_repeat_their_neighbour_are_dropped() {
        let (positions, _) = cube();
        let mut draft = draft(&positions, &[]);
        let corners = |indices: &[u32]| -> Vec<Corner> {
            let corner = |&index| Corner {
                position: index,
                uv: NO_INDEX,
                normal: NO_INDEX,
            };
            indices.iter().map(corner).collect()
        };
        for face in [&[0, 0, 1, 3, 3, 3, 2, 0][..], &[4, 5, 5, 4], &[4, 5]] {
            draft.add_face(&corners(face), 0, NO_INDEX).expect("room");
        }
        let (mesh, done) = mended(draft);
        assert_eq!(mesh.triangles.len(), 2);
        assert_eq!((done.repeated_corners, done.short_faces), (4 + 2, 2));
        assert_eq!((done.degenerate, done.duplicate), (0, 0));
    }

    #[test]
    fn normals_that_cannot_be_are_taken_away() {
        let (positions, triangles) = cube();
        let mut draft = draft(&positions, &[]);
        for normal in [Vec3::Z, -Vec3::Z, Vec3::ZERO, Vec3::NAN, Vec3::X] {
            draft.add_normal(normal).expect("room");
        }
        let up = triangles
            .iter()
            .find(|t| t.iter().all(|&i| positions[i as usize].z == 1.0));
        let up = *up.expect("the top");
        for normals in [[0, 1, 2], [3, 4, 0]] {
            let corners = [0, 1, 2].map(|i| Corner {
                position: up[i],
                uv: NO_INDEX,
                normal: normals[i],
            });
            // Twice the same would be dropped.
            let corners = if normals[0] == 0 {
                corners
            } else {
                [corners[0], corners[2], corners[1]]
            };
            draft.add_face(&corners, 0, NO_INDEX).expect("room");
        }
        let (mesh, done) = mended(draft);
        let normals = mesh.normals.expect("some are right");
        assert_eq!(
            (normals.get(0, 0), normals.get(0, 1), normals.get(0, 2)),
            (Some(Vec3::Z), None, None)
        );
        // The second looks down: only the one to the side is right.
        assert_eq!(normals.at[1].iter().filter(|i| **i != NO_INDEX).count(), 1);
        assert_eq!(done.bad_normals, 4);
    }

    #[test]
    fn nothing_to_draw_is_an_error_that_says_what_is_there() {
        let (positions, _) = cube();
        let error = |draft| {
            repair(draft, "a", DMat3::IDENTITY, 1.0)
                .expect_err("nothing")
                .to_string()
        };
        assert_eq!(
            error(draft(&positions, &[])),
            "there is no triangle: 8 points, no faces (a)"
        );
        assert_eq!(
            error(draft(&positions, &[[0, 1, 0]])),
            "there is no triangle: 8 vertices, 1 faces, none of them usable (a)"
        );
        let one = [Vec3::ONE; 4];
        assert!(error(draft(&one, &[[0, 1, 2], [1, 2, 3]])).contains("has no size"));
    }
}
