//! Wavefront OBJ.

use std::fmt::Write as _;

use super::export::{Export, y_up_from_ras};
use super::title::{name, remark, signed};

/// An OBJ of one object. Numbers are the shortest that are read as the same 32-bit float. It
/// refers to no other file.
pub(super) fn obj(export: &Export<'_>) -> Vec<u8> {
    let mut text = format!(
        "# {}\n# millimetres; x left, y up, z forward\no {}\n",
        signed(export.title),
        name(remark(export.title))
    );
    // Writing to a string does not fail.
    for (position, _) in export.vertices() {
        let [x, y, z] = y_up_from_ras(position).to_array();
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for (_, normal) in export.vertices() {
        let [x, y, z] = y_up_from_ras(normal).to_array();
        let _ = writeln!(text, "vn {x} {y} {z}");
    }
    for triangle in export.whole_triangles() {
        let [a, b, c] = triangle.map(|i| u64::from(i) + 1);
        let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use crate::clay::write::testing::{TITLES, export, long_title, mesh, numbers};

    #[test]
    fn it_is_read_back_to_the_same_floats() {
        let mesh = mesh();
        for title in TITLES
            .iter()
            .map(|&title| title.to_owned())
            .chain([long_title()])
        {
            let bytes = export(&mesh, &title).obj();
            let text = std::str::from_utf8(&bytes).expect("text");
            assert_eq!(text.lines().count(), 3 + 4 + 4 + 4, "{text}");
            assert!(!text.contains("SPACE=") && !text.contains("\\\n"), "{text}");
            let values = |keyword: &str| -> Vec<[f32; 3]> {
                let lines = text.lines().filter(|line| line.starts_with(keyword));
                // Back to RAS+.
                lines
                    .map(|line| numbers(line, 1))
                    .map(|n| [0.0 - n[0], n[2], n[1]])
                    .collect()
            };
            assert_eq!(values("v "), mesh.0.map(|p| p.to_array()));
            assert_eq!(values("vn "), mesh.1.map(|p| p.to_array()));
            let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
            assert_eq!(
                faces,
                [
                    "f 1//1 3//3 2//2",
                    "f 1//1 2//2 4//4",
                    "f 2//2 3//3 4//4",
                    "f 3//3 1//1 4//4"
                ]
            );
        }
        let bytes = export(&mesh, "Eine Hand für\nJedermann").obj();
        let head = "# Fabrica: Eine Hand für Jedermann\n# millimetres; x left, y up, z forward\n\
                    o Eine Hand für Jedermann\nv ";
        assert!(
            bytes.starts_with(head.as_bytes()),
            "{}",
            String::from_utf8_lossy(&bytes)
        );
        assert!(
            export(&mesh, "").obj().starts_with(b"# Fabrica\n"),
            "no title"
        );
    }
}
