//! GLB files of a few triangles.

use glam::Vec3;
use serde_json::{Value, json};

use super::{bad, good, read_as};
use crate::data::{Coloring, Wrap};
use crate::load::mesh::{Aside, MeshError, MeshOptions, Origin, Units};

/// A file of a description and bytes.
fn glb(json: &Value, bytes: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bytes.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let whole = 12 + 8 + text.len() + 8 + bin.len();
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((whole as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bin)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A square of four corners (48 bytes), then the indices 0, 1, 2, 3 and 0, 2, 3 as 16 bits.
fn square() -> (Value, Vec<u8>) {
    let mut bytes = floats(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]);
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    let json = json!({
        "asset": { "version": "2.0", "generator": "Jane Doe" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": "plate" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "buffers": [{ "byteLength": 60 }],
    });
    (json, bytes)
}

/// The square with one key changed.
fn changed(pointer: &str, value: Value) -> Vec<u8> {
    let (mut json, bytes) = square();
    put(&mut json, pointer, value);
    glb(&json, &bytes)
}

fn put(json: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    match json.pointer_mut(parent).expect("a parent") {
        Value::Array(list) => list[key.parse::<usize>().expect("a number")] = value,
        parent => parent[key] = value,
    }
}

#[test]
fn a_square_is_read_in_metres() {
    let (json, bytes) = square();
    let (mesh, report) = good("a.glb", glb(&json, &bytes));
    assert_eq!((mesh.triangles.len(), mesh.positions.len()), (2, 4));
    assert_eq!(report.units, (Units::Metre, Origin::Format));
    assert_eq!(mesh.positions[2], Vec3::new(-1000.0, 0.0, 1000.0));
    assert_eq!(mesh.coloring, Coloring::Product);
    assert!(!format!("{mesh:?}{report:?}").contains("Jane"));
}

#[test]
fn strips_fans_and_bare_corners_are_triangles() {
    let normals = |file: Vec<u8>| -> Vec<f32> {
        let (mesh, report) = good("a.glb", file);
        assert_eq!(report.repair.disagreeing_edges, 0, "they agree");
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = mesh.corners_of(*t);
            (b - a).cross(c - a).normalize().y
        };
        mesh.triangles.iter().map(normal).collect()
    };
    // Out of the square (z of the file, forward) is anterior.
    let (json, bytes) = square();
    assert_eq!(normals(glb(&json, &bytes)), [1.0, 1.0]);
    let without = |mode: u32| {
        let mut json = json.clone();
        put(
            &mut json,
            "/meshes/0/primitives/0",
            json!({ "attributes": { "POSITION": 0 }, "mode": mode }),
        );
        normals(glb(&json, &bytes))
    };
    assert_eq!(without(6), [1.0, 1.0], "a fan");
    assert_eq!(without(4), [1.0], "three of the four corners");
    let mut strip = json.clone();
    put(&mut strip, "/meshes/0/primitives/0/mode", json!(5));
    put(&mut strip, "/accessors/1/count", json!(4));
    let mut order = bytes.clone();
    for (i, index) in [0u16, 1, 3, 2].iter().enumerate() {
        order[48 + 2 * i..50 + 2 * i].copy_from_slice(&index.to_le_bytes());
    }
    assert_eq!(normals(glb(&strip, &order)), [1.0, 1.0], "a strip");
    for (mode, aside) in [(0, Aside::Points), (1, Aside::Lines)] {
        let mut json = json.clone();
        let other = json!({ "attributes": { "POSITION": 0 }, "mode": mode });
        json["meshes"][0]["primitives"]
            .as_array_mut()
            .expect("a list")
            .push(other);
        assert_eq!(good("a.glb", glb(&json, &bytes)).1.aside, [aside]);
    }
    bad(
        "a.glb",
        changed("/meshes/0/primitives/0/mode", json!(7)),
        &["mode 7"],
    );
}

#[test]
fn nodes_place_and_mirror() {
    let (mut json, bytes) = square();
    json["scenes"] = json!([{ "nodes": [1] }, { "nodes": [0] }]);
    json["nodes"] = json!([
        { "mesh": 0, "name": "plate", "scale": [2, 2, 2] },
        { "children": [0, 2], "translation": [0, 0, 1] },
        { "mesh": 0, "name": "plate", "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1] },
    ]);
    let (mesh, _) = good("a.glb", glb(&json, &bytes));
    let names: Vec<&str> = mesh.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["plate", "plate 2"]);
    assert_eq!(
        mesh.positions.iter().map(|p| p.x).fold(0.0, f32::min),
        -2000.0
    );
    assert!(mesh.positions.iter().all(|p| p.y == 1000.0));
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners_of(*triangle);
        assert!(
            (b - a).cross(c - a).y > 0.0,
            "the mirrored one looks forward too"
        );
    }
    json["scene"] = json!(1);
    assert_eq!(
        good("a.glb", glb(&json, &bytes)).0.triangles.len(),
        2,
        "the default scene"
    );
    // A node that is its own grandchild is drawn once.
    json["nodes"][0]["children"] = json!([1]);
    assert_eq!(good("a.glb", glb(&json, &bytes)).0.triangles.len(), 4);
    json["nodes"][1]["children"] = json!([0, 7]);
    bad(
        "a.glb",
        glb(&json, &bytes),
        &["nodes 7 is out of range", "there are 3"],
    );
}

#[test]
fn accessors_are_sparse_and_of_whole_numbers() {
    // The last corner moved by a sparse part.
    let (mut json, mut bytes) = square();
    bytes.extend([3u8, 0, 0, 0]);
    bytes.extend(floats(&[0.0, 5.0, 0.0]));
    let views = json["bufferViews"].as_array_mut().expect("a list");
    views.push(json!({ "buffer": 0, "byteOffset": 60, "byteLength": 4 }));
    views.push(json!({ "buffer": 0, "byteOffset": 64, "byteLength": 12 }));
    json["accessors"][0]["sparse"] = json!({ "count": 1, "indices": { "bufferView": 2, "componentType": 5121 }, "values": { "bufferView": 3 } });
    let (mesh, _) = good("a.glb", glb(&json, &bytes));
    assert_eq!(
        mesh.positions.iter().map(|p| p.z).fold(0.0, f32::max),
        5000.0
    );
    json["accessors"][0]["sparse"]["indices"]["componentType"] = json!(5126);
    bad(
        "a.glb",
        glb(&json, &bytes),
        &["accessor 0", "whole numbers"],
    );
    json["accessors"][0]["sparse"]["indices"]["componentType"] = json!(5121);
    bytes[60] = 4;
    bad(
        "a.glb",
        glb(&json, &bytes),
        &["accessor 0", "sparse index out of range"],
    );
    // Positions as bytes, normalised or not, four bytes apart.
    let (mut json, _) = square();
    let mut bytes = vec![0u8, 0, 0, 9, 255, 0, 0, 9, 255, 255, 0, 9, 0, 255, 0, 9];
    bytes.resize(48, 0);
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    json["extensionsRequired"] = json!(["KHR_mesh_quantization", "KHR_materials_unlit"]);
    json["bufferViews"][0]["byteStride"] = json!(4);
    json["accessors"][0]["componentType"] = json!(5121);
    let (mesh, _) = good("a.glb", glb(&json, &bytes));
    assert_eq!(mesh.positions[1].x, -255_000.0);
    json["accessors"][0]["normalized"] = json!(true);
    let (mesh, _) = good("a.glb", glb(&json, &bytes));
    assert_eq!(mesh.positions[1].x, -1000.0);
}

#[test]
fn what_cannot_be_is_named() {
    bad(
        "a.glb",
        changed("/extensionsRequired", json!(["KHR_draco_mesh_compression"])),
        &["KHR_draco_mesh_compression"],
    );
    bad(
        "a.glb",
        changed("/extensionsRequired", json!(["EXT_meshopt_compression"])),
        &["EXT_meshopt_compression"],
    );
    bad(
        "a.glb",
        changed("/accessors/0/count", json!(5)),
        &["accessor 0 reaches beyond its buffer"],
    );
    bad(
        "a.glb",
        changed("/accessors/0/byteOffset", json!(u64::MAX)),
        &["accessor 0 reaches beyond"],
    );
    bad(
        "a.glb",
        changed("/accessors/0/count", json!(u32::MAX)),
        &["accessor 0 has 4294967295 elements"],
    );
    bad(
        "a.glb",
        changed("/accessors/1/count", json!(u32::MAX)),
        &["triangles so far are more than the 2000000"],
    );
    bad(
        "a.glb",
        changed("/bufferViews/0/byteLength", json!(61)),
        &["bufferView 0 reaches beyond"],
    );
    bad(
        "a.glb",
        changed("/bufferViews/0/buffer", json!(1)),
        &["buffers 1 is out of range"],
    );
    bad(
        "a.glb",
        changed("/buffers/0/uri", json!("Jane.bin")),
        &["buffer 0 is not in the file"],
    );
    bad(
        "a.glb",
        changed("/accessors/0/type", json!("VEC2")),
        &["accessor 0 should be of the type VEC3"],
    );
    bad(
        "a.glb",
        changed("/accessors/0/componentType", json!(1)),
        &["accessor 0"],
    );
    bad(
        "a.glb",
        changed("/meshes/0/primitives/0/indices", json!(9)),
        &["accessors 9 is out of range"],
    );
    bad(
        "a.glb",
        changed("/meshes/0/primitives/0/material", json!(0)),
        &["materials 0 is out of range"],
    );
    bad(
        "a.glb",
        changed("/nodes/0/mesh", json!(3)),
        &["meshes 3 is out of range"],
    );
    bad(
        "a.glb",
        changed("/scene", json!(2)),
        &["scenes 2 is out of range"],
    );
    bad(
        "a.glb",
        changed("/nodes/0/mesh", json!(null)),
        &["no triangle", "no faces"],
    );
    let (json, mut bytes) = square();
    bytes[48] = 4;
    bad(
        "a.glb",
        glb(&json, &bytes),
        &["index 4 in accessor 1", "there are 4 vertices"],
    );
    let whole = glb(&json, &square().1);
    for len in 4..whole.len() {
        bad("a.glb", &whole[..len], &["the file ends"]);
    }
    let mut longer = whole.clone();
    longer.push(1);
    assert_eq!(good("a.glb", longer).1.aside, [Aside::TrailingBytes]);
    let mut old = whole.clone();
    old[4] = 1;
    bad("a.glb", old, &["byte 4", "glTF 1"]);
    let mut broken = whole;
    broken[20] = b'x';
    bad("a.glb", broken, &["byte 20", "no JSON"]);
    bad("a.gltf", json.to_string(), &["save as .glb"]);
    let zeros = changed(
        "/accessors/0",
        json!({ "componentType": 5126, "count": 5_000_000, "type": "VEC3" }),
    );
    bad("a.glb", zeros, &["more elements than the file has bytes"]);
}

#[test]
fn one_mesh_drawn_by_many_nodes_meets_the_limit() {
    let (mut json, bytes) = square();
    json["nodes"] = json!(vec![json!({ "mesh": 0 }); 100]);
    json["scenes"][0]["nodes"] = json!((0..100).collect::<Vec<_>>());
    let options = MeshOptions {
        max_triangles: 150,
        ..MeshOptions::default()
    };
    let file = glb(&json, &bytes);
    let error = read_as(&[("a.glb", &file)], &options).expect_err("200 triangles");
    assert!(
        matches!(
            error,
            MeshError::TooManyTriangles {
                count: 152,
                limit: 150,
                ..
            } | MeshError::TooManyValues { .. }
        ),
        "{error}"
    );
    let options = MeshOptions {
        max_triangles: 200,
        ..options
    };
    read_as(&[("a.glb", &file)], &options).expect("just so many");
}

#[test]
fn colours_textures_and_what_is_left_aside() {
    let (mut json, mut bytes) = square();
    bytes.extend(floats(&[0.25, 0.5, 0., 0., 0., 0., 0., 0.]));
    bytes.extend([255u8, 0, 0, 255].repeat(4));
    let picture = bytes.len();
    bytes.extend(b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x03\0\0\0\x02");
    let views = json["bufferViews"].as_array_mut().expect("a list");
    views.push(json!({ "buffer": 0, "byteOffset": 60, "byteLength": 32 }));
    views.push(json!({ "buffer": 0, "byteOffset": 92, "byteLength": 16 }));
    views.push(json!({ "buffer": 0, "byteOffset": picture, "byteLength": 24 }));
    let accessors = json["accessors"].as_array_mut().expect("a list");
    accessors.push(json!({ "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" }));
    accessors.push(json!({ "bufferView": 3, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" }));
    json["meshes"][0]["primitives"][0] = json!({
        "attributes": { "POSITION": 0, "TEXCOORD_0": 2, "COLOR_0": 3 }, "indices": 1, "material": 0,
        "targets": [{ "POSITION": 0 }],
    });
    json["materials"] = json!([{
        "alphaMode": "BLEND",
        "emissiveTexture": { "index": 0 },
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 1, 0.75],
            "baseColorTexture": { "index": 0, "extensions": { "KHR_texture_transform": { "offset": [0.5, 1], "scale": [2, -1] } } },
        },
    }]);
    json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    json["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648 }]);
    json["images"] = json!([{ "bufferView": 4, "mimeType": "image/png" }]);
    json["animations"] = json!([{}]);
    let (mesh, report) = good("a.glb", glb(&json, &bytes));
    assert_eq!(
        report.aside,
        [Aside::Animations, Aside::OtherTextures, Aside::Skins]
    );
    let material = mesh.materials[0];
    assert_eq!(
        (material.color, material.opacity),
        (Vec3::new(0.5, 0.25, 1.0), 0.75)
    );
    assert_eq!(
        (mesh.textures[0].size, mesh.textures[0].wrap),
        ([3, 2], [Wrap::Clamp, Wrap::Mirror])
    );
    assert_eq!(mesh.colors.expect("there").get(0, 0), Some(Vec3::X));
    let uv = mesh.uvs.expect("there").get(0, 0).expect("there");
    assert_eq!(uv.to_array(), [0.5 + 2.0 * 0.25, 1.0 - 0.5]);
    json["materials"][0]["alphaMode"] = json!("OPAQUE");
    json["images"] = json!([{ "uri": "Jane.png" }]);
    let (mesh, report) = good("a.glb", glb(&json, &bytes));
    assert_eq!(
        (mesh.materials[0].opacity, mesh.materials[0].texture),
        (1.0, None)
    );
    assert!(report.aside.contains(&Aside::NoPicture));
}
