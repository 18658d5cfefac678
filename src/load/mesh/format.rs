//! Which kind of mesh a file is, by its first bytes and its name. The only part of this room that readers of scans
//! use: they say what it is that they were given.

use std::fmt;

/// Formats of meshes that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL, binary or ASCII.
    Stl,
    /// PLY, ASCII or binary.
    Ply,
    /// glTF 2.0 in one binary file.
    Glb,
}

impl MeshFormat {
    /// All formats that are read.
    pub const ALL: [Self; 4] = [Self::Obj, Self::Stl, Self::Ply, Self::Glb];

    /// What a reader of scans says of such a file.
    pub(in crate::load) fn not_a_scan(self) -> &'static str {
        match self {
            Self::Obj => "a surface mesh (OBJ), not a scan: open it by itself",
            Self::Stl => "a surface mesh (STL), not a scan: open it by itself",
            Self::Ply => "a surface mesh (PLY), not a scan: open it by itself",
            Self::Glb => "a surface mesh (GLB), not a scan: open it by itself",
        }
    }

    fn ending(self) -> &'static str {
        match self {
            Self::Obj => ".obj",
            Self::Stl => ".stl",
            Self::Ply => ".ply",
            Self::Glb => ".glb",
        }
    }
}

impl fmt::Display for MeshFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Glb => "GLB",
        })
    }
}

/// What a file is, if it is a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::load) enum MeshKind {
    /// A format that is read.
    Read(MeshFormat),
    /// A format that is known and not read: what to do, in words.
    Refused(&'static str),
}

/// A mesh that is not read: how the file begins, how its name ends, and what is said of it.
type Refusal = (
    &'static [&'static [u8]],
    &'static [&'static str],
    &'static str,
);

/// Meshes that are not read.
const REFUSED: [Refusal; 6] = [
    (
        &[
            b"OFF\n", b"OFF\r", b"OFF ", b"COFF", b"NOFF", b"CNOFF", b"STOFF",
        ],
        &[".off"],
        "OFF meshes are not read: save as PLY or GLB",
    ),
    (
        &[],
        &[".3mf"],
        "3MF meshes are not read: save as PLY or GLB",
    ),
    (
        &[b"Kaydara FBX", b"; FBX"],
        &[".fbx"],
        "FBX meshes are not read: save as PLY or GLB",
    ),
    (
        &[b"OCTM"],
        &[".ctm"],
        "OpenCTM (CTM) meshes are not read: save as PLY or GLB",
    ),
    (
        &[b"<VTKFile", b"<?xml version=\"1.0\"?>\n<VTKFile"],
        &[".vtp", ".vtu", ".vtk"],
        "VTK meshes are not read: save as PLY or GLB",
    ),
    (
        &[b"BLENDER"],
        &[".blend"],
        "Blender files (.blend) are not read: save as PLY or GLB",
    ),
];

const GLTF_TEXT: &str = "glTF in text (.gltf) is not read: save as .glb";

/// Tells a mesh by its first bytes (unpacked) and, where they are not clear, by its name (in lower case, without
/// `.gz`). `byte_len` is the length of the file if it is not packed: binary STL has no other mark.
pub(in crate::load) fn sniff(start: &[u8], name: &str, byte_len: Option<u64>) -> Option<MeshKind> {
    by_content(start, byte_len).or_else(|| by_name(name))
}

/// Tells a mesh by its first bytes alone.
pub(in crate::load) fn by_content(start: &[u8], byte_len: Option<u64>) -> Option<MeshKind> {
    use MeshKind::{Read, Refused};
    if start.starts_with(b"glTF") {
        return Some(Read(MeshFormat::Glb));
    }
    if start.starts_with(b"ply\n") || start.starts_with(b"ply\r") {
        return Some(Read(MeshFormat::Ply));
    }
    for (signs, _, words) in REFUSED {
        if signs.iter().any(|sign| start.starts_with(sign)) {
            return Some(Refused(words));
        }
    }
    let is_zip = start.starts_with(b"PK\x03\x04");
    if is_zip && contains(start, b"3D/3dmodel.model") {
        return Some(Refused(REFUSED[1].2));
    }
    let text = start.trim_ascii_start();
    if text.starts_with(b"{") && contains(text, b"\"asset\"") {
        return Some(Refused(GLTF_TEXT));
    }
    if begins_solid(text) && (contains(text, b"facet") || contains(text, b"endsolid")) {
        return Some(Read(MeshFormat::Stl));
    }
    if byte_len.is_some() && byte_len == stl_len(start) {
        return Some(Read(MeshFormat::Stl));
    }
    is_obj(start).then_some(Read(MeshFormat::Obj))
}

/// Tells a mesh by the ending of its name, in lower case and without `.gz`.
pub(in crate::load) fn by_name(name: &str) -> Option<MeshKind> {
    if let Some(format) = MeshFormat::ALL
        .into_iter()
        .find(|f| name.ends_with(f.ending()))
    {
        return Some(MeshKind::Read(format));
    }
    if name.ends_with(".gltf") {
        return Some(MeshKind::Refused(GLTF_TEXT));
    }
    let refused = REFUSED
        .iter()
        .find(|(_, endings, _)| endings.iter().any(|e| name.ends_with(e)));
    refused.map(|(_, _, words)| MeshKind::Refused(words))
}

/// True if a text begins with the word `solid`, as ASCII STL does.
pub(in crate::load) fn begins_solid(text: &[u8]) -> bool {
    let word = text
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    word && text.get(5).is_none_or(u8::is_ascii_whitespace)
}

/// The length that a binary STL has by its count of triangles; `None` for less than a header, and for no triangle.
pub(in crate::load) fn stl_len(start: &[u8]) -> Option<u64> {
    let count = u32::from_le_bytes(start.get(80..84)?.try_into().ok()?);
    (count > 0).then_some(84 + 50 * u64::from(count))
}

fn contains(text: &[u8], sign: &[u8]) -> bool {
    text.windows(sign.len()).any(|window| window == sign)
}

/// True for text whose first statement is one of OBJ: a vertex with three numbers, or a material library.
fn is_obj(start: &[u8]) -> bool {
    let text: Vec<u8> = match start {
        [0xff, 0xfe, rest @ ..] => rest.iter().step_by(2).copied().collect(),
        [0xfe, 0xff, rest @ ..] => rest.iter().skip(1).step_by(2).copied().collect(),
        [0xef, 0xbb, 0xbf, rest @ ..] => rest.to_vec(),
        _ => start.to_vec(),
    };
    let text = String::from_utf8_lossy(&text);
    for line in text.split(['\n', '\r']) {
        let mut words = line.split_whitespace();
        match words.next() {
            None => {}
            Some(word) if word.starts_with('#') => {}
            // Names may stand before the first vertex.
            Some("o" | "g" | "s" | "usemtl") => {}
            Some("mtllib") => return true,
            Some("v") => {
                let numbers = words.map_while(|word| word.parse::<f32>().ok());
                return numbers.count() >= 3;
            }
            Some(_) => return false,
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_are_told_by_content_then_by_name() {
        use MeshFormat::{Glb, Obj, Ply, Stl};
        let mut binary = vec![0; 80];
        binary.extend(1u32.to_le_bytes());
        let cases: [(&[u8], &str, Option<MeshFormat>); 12] = [
            (b"glTF\x02\0\0\0", "a.obj", Some(Glb)),
            (b"ply\r\nformat", "a", Some(Ply)),
            (b"solid x\nfacet normal", "a", Some(Stl)),
            (b"\n  solid\nendsolid", "a.txt", Some(Stl)),
            (b"solid rock", "a.stl", Some(Stl)),
            (b"solid rock", "a.txt", None),
            (&binary, "a", Some(Stl)),
            (b"# by hand\no a\nv 1 2 3\n", "a", Some(Obj)),
            (b"\xfe\xff\0v\0 \x001\0 \x002\0 \x003\0\n", "a", Some(Obj)),
            (b"v one two three\n", "a", None),
            (b"", "b.glb", Some(Glb)),
            (b"Dear Sir", "letter.txt", None),
        ];
        for (start, name, format) in cases {
            let len = (start.len() == 84).then_some(134);
            assert_eq!(
                sniff(start, name, len),
                format.map(MeshKind::Read),
                "{name}"
            );
        }
    }

    #[test]
    fn formats_that_are_not_read_are_named() {
        let cases: [(&[u8], &str, &str); 10] = [
            (b"OFF\n8 6 0\n", "a", "OFF"),
            (b"COFF\n", "a", "OFF"),
            (b"PK\x03\x04....3D/3dmodel.model", "a", "3MF"),
            (b"PK\x03\x04....", "a.3mf", "3MF"),
            (b"Kaydara FBX Binary  ", "a", "FBX"),
            (b"OCTM\x05", "a", "CTM"),
            (b"<VTKFile type=", "a", "VTK"),
            (b"\x28\xb5\x2f\xfd", "a.blend", ".blend"),
            (b"BLENDER-v300", "a", ".blend"),
            (b"{ \"asset\": {} }", "a", "save as .glb"),
        ];
        for (start, name, words) in cases {
            let Some(MeshKind::Refused(text)) = sniff(start, name, None) else {
                panic!("{words} is known");
            };
            assert!(text.contains(words) && text.contains("save as"), "{text}");
        }
    }
}
