//! GLB: glTF 2.0 in one binary file. The container, and which nodes are drawn.
//!
//! What the accessors and materials hold is read by their own files. Nothing outside the file is opened.

use glam::{DMat4, DQuat, DVec3};
use serde_json::Value;

use super::draft::Draft;
use super::error::MeshError;
use super::glb_json::{Gltf, index, numbers};
use super::glb_primitive::{Primitives, add_mesh};
use super::input::{Input, shown};
use super::report::Aside;

/// The largest description, and the largest block of bytes: beyond any mesh that can be opened, with its pictures.
const MAX_JSON_BYTES: u64 = 64 << 20;
const MAX_BYTES: u64 = 512 << 20;
/// Primitives that are drawn, counted once for each node that draws them.
const MAX_DRAWN: usize = 1 << 20;

/// Reads a GLB.
pub(super) fn read(
    input: &mut Input<'_, '_>,
    draft: &mut Draft,
    name: &str,
) -> Result<(), MeshError> {
    let gltf = container(input, draft, name)?;
    check_extensions(&gltf)?;
    if !gltf.list("animations").is_empty() {
        draft.leave(Aside::Animations);
    }
    let mut primitives = Primitives::new(&gltf, draft);
    let scene = index(&gltf.json, "scene").unwrap_or(0);
    let roots: Vec<usize> = match gltf.list("scenes") {
        [] => roots_without_scene(&gltf),
        _ => {
            let nodes = gltf
                .item("scenes", scene)?
                .get("nodes")
                .and_then(Value::as_array);
            nodes
                .into_iter()
                .flatten()
                .filter_map(node_number)
                .collect()
        }
    };
    let mut to_do: Vec<(usize, DMat4)> = roots
        .into_iter()
        .rev()
        .map(|n| (n, DMat4::IDENTITY))
        .collect();
    let mut is_done = vec![false; gltf.list("nodes").len()];
    let mut drawn = 0;
    while let Some((number, scene_from_parent)) = to_do.pop() {
        let node = gltf.item("nodes", number)?;
        // By the standard no node has two parents; where one has, or is its own ancestor, it is drawn once.
        if std::mem::replace(&mut is_done[number], true) {
            continue;
        }
        let scene_from_node = scene_from_parent * parent_from_node(node);
        if node.get("skin").is_some() {
            draft.leave(Aside::Skins);
        }
        if let Some(mesh) = index(node, "mesh") {
            let part = draft.add_part(node.get("name").and_then(Value::as_str).unwrap_or_default());
            drawn += add_mesh(&gltf, &mut primitives, draft, mesh, part, scene_from_node)?;
            if drawn > MAX_DRAWN {
                return Err(gltf.wrong(format!("more than {MAX_DRAWN} primitives are drawn")));
            }
        }
        let children = node.get("children").and_then(Value::as_array);
        let children = children.into_iter().flatten().rev().filter_map(node_number);
        to_do.extend(children.map(|child| (child, scene_from_node)));
    }
    Ok(())
}

fn node_number(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|n| usize::try_from(n).ok())
}

/// Nodes that are nobody's children: what is shown of a file without scenes.
fn roots_without_scene(gltf: &Gltf) -> Vec<usize> {
    let nodes = gltf.list("nodes");
    let mut is_child = vec![false; nodes.len()];
    for node in nodes {
        let children = node.get("children").and_then(Value::as_array);
        for child in children.into_iter().flatten().filter_map(node_number) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
    }
    (0..nodes.len()).filter(|&node| !is_child[node]).collect()
}

/// The matrix of a node, or the product of its translation, rotation and scale.
fn parent_from_node(node: &Value) -> DMat4 {
    if let Some(matrix) = numbers::<16>(node, "matrix") {
        return DMat4::from_cols_array(&matrix);
    }
    let translation = numbers(node, "translation").map_or(DVec3::ZERO, DVec3::from_array);
    let scale = numbers(node, "scale").map_or(DVec3::ONE, DVec3::from_array);
    let rotation = numbers(node, "rotation").map_or(DQuat::IDENTITY, DQuat::from_array);
    let rotation = match rotation.length_squared() > 0.0 {
        true => rotation.normalize(),
        false => DQuat::IDENTITY,
    };
    DMat4::from_scale_rotation_translation(scale, rotation, translation)
}

/// The two chunks.
fn container(input: &mut Input<'_, '_>, draft: &mut Draft, name: &str) -> Result<Gltf, MeshError> {
    let word = |bytes: [u8; 12], i: usize| {
        u32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]])
    };
    let header: [u8; 12] = input.exact("the header of a GLB")?;
    if !header.starts_with(b"glTF") {
        return Err(input.at_byte(0, "a GLB begins with glTF".to_owned()));
    }
    if word(header, 4) != 2 {
        return Err(input.at_byte(
            4,
            format!("glTF {} is not read: save as glTF 2.0", word(header, 4)),
        ));
    }
    let whole = u64::from(word(header, 8));
    let chunk = |input: &mut Input<'_, '_>,
                 kind: &[u8; 4],
                 most: u64|
     -> Result<Vec<u8>, MeshError> {
        let at = input.position();
        let head: [u8; 8] = input.exact("the head of a chunk")?;
        let len = u64::from(u32::from_le_bytes([head[0], head[1], head[2], head[3]]));
        if head[4..] != *kind {
            let kind = String::from_utf8_lossy(kind)
                .trim_end_matches('\0')
                .to_owned();
            return Err(input.at_byte(at + 4, format!("expected the chunk {kind}")));
        }
        if len > most {
            return Err(input.at_byte(at, format!("a chunk of {len} bytes: {most} are the most")));
        }
        let bytes = input.take(len)?;
        match bytes.len() as u64 == len {
            true => Ok(bytes),
            false => Err(input.ends(&format!("a chunk of {len} bytes"))),
        }
    };
    let at = input.position() + 8;
    let json = chunk(input, b"JSON", MAX_JSON_BYTES)?;
    let json = serde_json::from_slice(&json).map_err(|error| {
        // Its message may hold words of the file.
        input.at_byte(
            at,
            format!(
                "the description is no JSON (its line {}, column {})",
                error.line(),
                error.column()
            ),
        )
    })?;
    // The rest of the length belongs to the block of bytes and to chunks of extensions.
    let mut bytes = Vec::new();
    if whole > input.position() {
        bytes = chunk(input, b"BIN\0", MAX_BYTES)?;
        let left = whole.saturating_sub(input.position());
        if left > 0 && input.skip(left)? < left {
            return Err(input.ends("the chunks of extensions"));
        }
    }
    if !input.peek(1)?.is_empty() {
        draft.leave(Aside::TrailingBytes);
    }
    Ok(Gltf {
        name: name.to_owned(),
        json,
        bytes,
        most_elements: draft.most_values(),
    })
}

fn check_extensions(gltf: &Gltf) -> Result<(), MeshError> {
    for name in gltf
        .list("extensionsRequired")
        .iter()
        .filter_map(Value::as_str)
    {
        let is_known = matches!(name, "KHR_mesh_quantization" | "KHR_texture_transform")
            || name.starts_with("KHR_materials_");
        if !is_known {
            return Err(gltf.wrong(format!(
                "the file needs the extension {}, which is not read: save as GLB without compression",
                shown_extension(name)
            )));
        }
    }
    Ok(())
}

/// Names of extensions are letters, digits and underscores.
fn shown_extension(name: &str) -> String {
    let plain = name
        .chars()
        .filter(|c| c.is_ascii_alphanumeric() || *c == '_');
    match plain.take(60).collect::<String>() {
        empty if empty.is_empty() => shown(name),
        plain => plain,
    }
}
