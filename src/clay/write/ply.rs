//! PLY: vertices with normals, and triangles.

use std::fmt::Write as _;

use super::export::{Export, Form};
use super::title::{ascii, signed};

/// A PLY. The title stands in a comment; the header is ASCII, as its readers expect (the Python package `plyfile`
/// refuses the whole file otherwise).
pub(super) fn ply(export: &Export<'_>, form: Form) -> Vec<u8> {
    let vertices = export.positions_mm.len();
    let triangles = export.whole_triangles().count();
    let format = match form {
        Form::Binary => "binary_little_endian",
        Form::Text => "ascii",
    };
    let head = format!(
        "ply\nformat {format} 1.0\ncomment {}\ncomment millimetres; x right, y anterior, z superior\n\
         element vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         property float nx\nproperty float ny\nproperty float nz\n\
         element face {triangles}\nproperty list uchar uint vertex_indices\nend_header\n",
        ascii(&signed(export.title))
    );
    match form {
        Form::Binary => binary(export, head.into_bytes()),
        Form::Text => text(export, head).into_bytes(),
    }
}

fn binary(export: &Export<'_>, mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.reserve(24 * export.positions_mm.len() + 13 * export.triangles.len());
    for (position, normal) in export.vertices() {
        for place in [position, normal] {
            bytes.extend(place.to_array().map(f32::to_le_bytes).as_flattened());
        }
    }
    for triangle in export.whole_triangles() {
        bytes.push(3);
        bytes.extend(triangle.map(u32::to_le_bytes).as_flattened());
    }
    bytes
}

fn text(export: &Export<'_>, mut text: String) -> String {
    // Writing to a string does not fail.
    for (position, normal) in export.vertices() {
        let [[x, y, z], [nx, ny, nz]] = [position, normal].map(|place| place.to_array());
        let _ = writeln!(text, "{x} {y} {z} {nx} {ny} {nz}");
    }
    for [a, b, c] in export.whole_triangles() {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::write::testing::{TITLES, export, floats, long_title, mesh, numbers, word};

    #[test]
    fn both_forms_are_read_back_to_the_same_floats() {
        let mesh = mesh();
        let expected: Vec<[f32; 6]> = std::iter::zip(mesh.0, mesh.1)
            .map(|(p, n)| [p.x, p.y, p.z, n.x, n.y, n.z])
            .collect();
        for title in TITLES
            .iter()
            .map(|&title| title.to_owned())
            .chain([long_title()])
        {
            let bytes = export(&mesh, &title).ply(Form::Text);
            let text = std::str::from_utf8(&bytes).expect("text");
            let (head, body) = text.split_once("end_header\n").expect("a header");
            assert!(text.is_ascii() && head.lines().count() == 13, "{head}");
            assert!(
                head.lines().all(|line| line.len() < 4096) && !head.contains("SPACE="),
                "{head}"
            );
            assert!(
                head.starts_with("ply\nformat ascii 1.0\ncomment Fabrica"),
                "{head}"
            );
            assert!(
                head.contains("\nelement vertex 4\n") && head.contains("\nelement face 4\n"),
                "{head}"
            );
            let lines: Vec<&str> = body.lines().collect();
            assert_eq!(
                lines[..4]
                    .iter()
                    .map(|line| numbers(line, 0))
                    .collect::<Vec<_>>(),
                expected
            );
            assert_eq!(lines[4..], ["3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3"]);

            let bytes = export(&mesh, &title).ply(Form::Binary);
            let end = bytes.len() - 4 * 24 - 4 * 13;
            let same_head = head.replace("ascii", "binary_little_endian") + "end_header\n";
            assert_eq!(std::str::from_utf8(&bytes[..end]).expect("text"), same_head);
            for (i, vertex) in expected.iter().enumerate() {
                assert_eq!(floats::<6>(&bytes, end + 24 * i), *vertex);
            }
            for (i, triangle) in mesh.2.iter().enumerate() {
                let at = end + 4 * 24 + 13 * i;
                assert_eq!(bytes[at], 3);
                assert_eq!([1, 5, 9].map(|k| word(&bytes, at + k)), *triangle);
            }
        }
    }
}
