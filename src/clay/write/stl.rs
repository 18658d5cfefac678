//! STL: each triangle for itself, with the normal of its plane.

use std::fmt::Write as _;

use glam::Vec3;

use super::export::Export;
use super::title::{ascii, remark, signed};

/// Bytes of the header, and of a triangle.
const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// Normal and corners of each triangle; the normal of one without an area is 0, as the format has it.
fn facets(export: &Export<'_>) -> impl Iterator<Item = (Vec3, [Vec3; 3])> {
    export.whole_triangles().map(|triangle| {
        let corners = triangle.map(|i| export.positions_mm[i as usize]);
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
        (normal, corners)
    })
}

/// A binary STL. Its header never begins with the word that begins a text.
pub(super) fn binary(export: &Export<'_>) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + 4 + TRIANGLE * export.triangles.len());
    let header = signed(export.title);
    bytes.extend(&header.as_bytes()[..header.floor_char_boundary(HEADER)]);
    bytes.resize(HEADER, b' ');
    let count = u32::try_from(export.whole_triangles().count()).unwrap_or(u32::MAX);
    bytes.extend(count.to_le_bytes());
    for (normal, corners) in facets(export) {
        for place in [normal].iter().chain(&corners) {
            bytes.extend(place.to_array().map(f32::to_le_bytes).as_flattened());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

/// A text STL of one solid. It is ASCII, and its first line short: both is what programs tell the two forms by.
pub(super) fn text(export: &Export<'_>) -> Vec<u8> {
    let mut name = ascii(&remark(export.title));
    name.truncate(60);
    let name = name.trim_end_matches(['\\', ' ']);
    let space = if name.is_empty() { "" } else { " " };
    let mut text = format!("solid{space}{name}\n");
    for (normal, corners) in facets(export) {
        // Writing to a string does not fail.
        let [x, y, z] = normal.to_array();
        let _ = write!(text, "facet normal {x} {y} {z}\nouter loop\n");
        for [x, y, z] in corners.map(|corner| corner.to_array()) {
            let _ = writeln!(text, "vertex {x} {y} {z}");
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str(&format!("endsolid{space}{name}\n"));
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::super::Form;
    use super::*;
    use crate::clay::write::testing::{TITLES, export, floats, long_title, mesh, numbers, word};

    #[test]
    fn binary_has_its_length_and_the_same_floats() {
        let mesh = mesh();
        for title in TITLES
            .iter()
            .map(|&title| title.to_owned())
            .chain([long_title()])
        {
            let bytes = export(&mesh, &title).stl(Form::Binary);
            assert_eq!(bytes.len(), 84 + 4 * 50);
            assert_eq!(word(&bytes, 80), 4);
            let header = std::str::from_utf8(&bytes[..80]).expect("whole characters");
            assert!(
                header.starts_with("Fabrica") && !header.contains("SPACE="),
                "{header}"
            );
            for (i, triangle) in mesh.2.iter().enumerate() {
                for (corner, &index) in triangle.iter().enumerate() {
                    let read: [f32; 3] = floats(&bytes, 84 + 50 * i + 12 * (corner + 1));
                    assert_eq!(read, mesh.0[index as usize].to_array());
                }
                assert_eq!(bytes[84 + 50 * i + 48..84 + 50 * i + 50], [0, 0]);
            }
        }
        let bytes = export(&mesh, "A hand").stl(Form::Binary);
        assert!(bytes.starts_with(b"Fabrica: A hand   "), "{bytes:?}");
    }

    #[test]
    fn normals_are_those_of_the_triangles() {
        let positions_mm = [Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 1e-3];
        let normals = [Vec3::X; 3];
        let triangles = [[0, 1, 2], [0, 2, 1], [0, 1, 1]];
        let export = Export {
            positions_mm: &positions_mm,
            normals: &normals,
            triangles: &triangles,
            title: "",
        };
        let bytes = export.stl(Form::Binary);
        let found = [0, 1, 2].map(|i| floats::<3>(&bytes, 84 + 50 * i));
        assert_eq!(found, [[0., 0., 1.], [0., 0., -1.], [0.; 3]]);
    }

    #[test]
    fn text_is_read_back_to_the_same_floats() {
        let mesh = mesh();
        for title in TITLES
            .iter()
            .map(|&title| title.to_owned())
            .chain([long_title()])
        {
            let bytes = export(&mesh, &title).stl(Form::Text);
            let text = std::str::from_utf8(&bytes).expect("text");
            assert!(
                text.is_ascii() && text.lines().count() == 2 + 7 * 4,
                "{text}"
            );
            let first = text.lines().next().expect("a line");
            let name = first.strip_prefix("solid").expect("it begins with it");
            assert!(text.ends_with(&format!("endsolid{name}\n")), "{text}");
            let vertices = text.lines().filter(|line| line.starts_with("vertex "));
            let read: Vec<Vec<f32>> = vertices.map(|line| numbers(line, 1)).collect();
            let expected: Vec<Vec<f32>> = mesh
                .2
                .as_flattened()
                .iter()
                .map(|&i| mesh.0[i as usize].to_array().to_vec())
                .collect();
            assert_eq!(read, expected);
        }
        let text = export(&mesh, "A hand").stl(Form::Text);
        assert!(text.starts_with(b"solid A hand\nfacet normal "), "{text:?}");
    }
}
