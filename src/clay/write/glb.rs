//! GLB: glTF 2.0 in one binary file (Khronos, glTF 2.0 specification, section 4).

use glam::Vec3;
use serde_json::{Value, json};

use super::export::{Export, y_up_from_ras};
use super::title::{name, one_line};

/// Numbers that the standard has for the types of numbers and the use of bytes.
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// A GLB: one mesh of one primitive in one node. Without a triangle the node is empty, since nothing in a glTF may have
/// the length 0.
pub(super) fn glb(export: &Export<'_>) -> Vec<u8> {
    let name = name(one_line(export.title));
    let mut json = json!({
        "asset": { "version": "2.0", "generator": "Fabrica" },
        "scene": 0,
        "scenes": [{ "name": name, "nodes": [0] }],
        "nodes": [{ "name": name }],
    });
    let bytes = bytes_of(export);
    if export.whole_triangles().next().is_some() {
        json["nodes"][0]["mesh"] = json!(0);
        describe(export, &name, bytes.len(), &mut json);
    }
    // Chunks have lengths that are multiples of four: the text is filled up with spaces, the bytes are in fours.
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let chunks = [(b"JSON", text), (b"BIN\0", bytes)];
    let chunks = chunks.iter().filter(|(_, chunk)| !chunk.is_empty());
    let len = 12
        + chunks
            .clone()
            .map(|(_, chunk)| 8 + chunk.len())
            .sum::<usize>();
    let word = |n: usize| u32::try_from(n).unwrap_or(u32::MAX).to_le_bytes();
    let mut file = Vec::with_capacity(len);
    file.extend(b"glTF");
    file.extend(word(2));
    file.extend(word(len));
    for (kind, chunk) in chunks {
        file.extend(word(chunk.len()));
        file.extend(*kind);
        file.extend(chunk);
    }
    file
}

/// A position as a GLB has it: metres.
fn metres(position_mm: Vec3) -> Vec3 {
    y_up_from_ras(position_mm) / 1000.0
}

/// All positions, all normals, all indices.
fn bytes_of(export: &Export<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    if export.whole_triangles().next().is_none() {
        return bytes;
    }
    bytes.reserve(24 * export.positions_mm.len() + 12 * export.triangles.len());
    let positions = export.vertices().map(|(position, _)| metres(position));
    let normals = export.vertices().map(|(_, normal)| y_up_from_ras(normal));
    for place in positions.chain(normals) {
        bytes.extend(place.to_array().map(f32::to_le_bytes).as_flattened());
    }
    for triangle in export.whole_triangles() {
        bytes.extend(triangle.map(u32::to_le_bytes).as_flattened());
    }
    bytes
}

/// A part of the bytes.
fn part(at: usize, len: usize, target: u32) -> Value {
    json!({ "buffer": 0, "byteOffset": at, "byteLength": len, "target": target })
}

/// Says what lies where in the bytes.
fn describe(export: &Export<'_>, name: &str, byte_len: usize, json: &mut Value) {
    let vertices = export.positions_mm.len();
    let indices = 3 * export.whole_triangles().count();
    let [mut least, mut greatest] = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    for position in export.positions_mm.iter().filter(|p| p.is_finite()) {
        least = least.min(metres(*position));
        greatest = greatest.max(metres(*position));
    }
    json["meshes"] = json!([{
        "name": name,
        "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 0 }],
    }]);
    // What the standard takes without a material is bare metal, which most programs show black. No colour is given.
    json["materials"] =
        json!([{ "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0.75 } }]);
    json["accessors"] = json!([
        {
            "bufferView": 0, "componentType": FLOAT, "count": vertices, "type": "VEC3",
            "min": least.to_array(), "max": greatest.to_array(),
        },
        { "bufferView": 1, "componentType": FLOAT, "count": vertices, "type": "VEC3" },
        { "bufferView": 2, "componentType": UNSIGNED_INT, "count": indices, "type": "SCALAR" },
    ]);
    json["bufferViews"] = json!([
        part(0, 12 * vertices, ARRAY_BUFFER),
        part(12 * vertices, 12 * vertices, ARRAY_BUFFER),
        part(24 * vertices, 4 * indices, ELEMENT_ARRAY_BUFFER),
    ]);
    json["buffers"] = json!([{ "byteLength": byte_len }]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::write::testing::{TITLES, export, floats, long_title, mesh, word};

    /// The two chunks, after a look at all lengths.
    fn chunks(bytes: &[u8]) -> (Value, &[u8]) {
        assert_eq!((&bytes[..4], word(bytes, 4)), (&b"glTF"[..], 2));
        assert_eq!((word(bytes, 8) as usize, bytes.len() % 4), (bytes.len(), 0));
        let len = word(bytes, 12) as usize;
        assert_eq!((len % 4, &bytes[16..20]), (0, &b"JSON"[..]));
        let json = serde_json::from_slice(&bytes[20..20 + len]).expect("JSON");
        let rest = &bytes[20 + len..];
        if rest.is_empty() {
            return (json, rest);
        }
        assert_eq!(
            (word(rest, 0) as usize, &rest[4..8]),
            (rest.len() - 8, &b"BIN\0"[..])
        );
        (json, &rest[8..])
    }

    #[test]
    fn it_is_read_back_to_the_same_floats() {
        let mesh = mesh();
        for title in TITLES
            .iter()
            .map(|&title| title.to_owned())
            .chain([long_title()])
        {
            let bytes = export(&mesh, &title).glb();
            let (json, block) = chunks(&bytes);
            assert_eq!(
                json["asset"],
                json!({ "version": "2.0", "generator": "Fabrica" })
            );
            let name = json["nodes"][0]["name"].as_str().expect("a name");
            assert!(
                !name.is_empty() && !name.chars().any(char::is_control),
                "{name}"
            );
            assert_eq!(json["buffers"][0]["byteLength"], block.len());
            assert_eq!(block.len(), 24 * 4 + 12 * 4);
            let views = json["bufferViews"].as_array().expect("a list");
            let at = |i: usize| views[i]["byteOffset"].as_u64().expect("a number") as usize;
            let mut end = 0;
            for (i, view) in views.iter().enumerate() {
                assert_eq!((at(i), at(i) % 4), (end, 0));
                end += view["byteLength"].as_u64().expect("a number") as usize;
            }
            assert_eq!(end, block.len());
            let ras = |[x, y, z]: [f32; 3]| [0.0 - x, z, y];
            for i in 0..4 {
                let position = ras(floats(block, at(0) + 12 * i));
                assert_eq!(position, (mesh.0[i] / 1000.0).to_array());
                assert_eq!(ras(floats(block, at(1) + 12 * i)), mesh.1[i].to_array());
                assert_eq!(
                    [0, 4, 8].map(|k| word(block, at(2) + 12 * i + k)),
                    mesh.2[i]
                );
            }
            let bounds = |key: &str| -> [f32; 3] {
                let list = &json["accessors"][0][key];
                [0, 1, 2].map(|i| list[i].as_f64().expect("a number") as f32)
            };
            let positions: [[f32; 3]; 4] = std::array::from_fn(|i| floats(block, 12 * i));
            for axis in 0..3 {
                let along = positions.map(|p| p[axis]);
                assert_eq!(
                    bounds("min")[axis],
                    along.into_iter().fold(f32::MAX, f32::min)
                );
                assert_eq!(
                    bounds("max")[axis],
                    along.into_iter().fold(f32::MIN, f32::max)
                );
            }
        }
        let bytes = export(&mesh, "Schädel\n\"1\"").glb();
        let (json, _) = chunks(&bytes);
        assert_eq!(
            (&json["nodes"][0]["name"], &json["meshes"][0]["name"]),
            (&json!("Schädel \"1\""), &json!("Schädel \"1\""))
        );
    }

    #[test]
    fn without_triangles_it_is_an_empty_node() {
        let (positions, normals, _) = mesh();
        for positions_mm in [&positions[..], &[]] {
            let export = Export {
                positions_mm,
                normals: &normals,
                triangles: &[[0, 1, 9]],
                title: "",
            };
            let bytes = export.glb();
            let (json, block) = chunks(&bytes);
            assert!(block.is_empty() && json.get("meshes").is_none(), "{json}");
            assert_eq!(json["nodes"], json!([{ "name": "clay" }]));
        }
    }
}
