//! Meshes of a GLB: triangles, strips and fans, with their materials.

use std::collections::BTreeMap;

use glam::{DMat3, DMat4, DVec2, DVec3, Vec3};
use serde_json::Value;

use super::draft::Draft;
use super::error::MeshError;
use super::glb_accessor::{component_count, read, view};
use super::glb_json::{Gltf, index, numbers};
use super::report::Aside;
use crate::data::{Coloring, MeshMaterial, NO_INDEX, Wrap};

/// What primitives share.
pub(super) struct Primitives {
    /// What is done to the texture coordinates of each material.
    transforms: Vec<UvTransform>,
}

/// `KHR_texture_transform`: scale, then turn, then offset.
#[derive(Clone, Copy)]
struct UvTransform {
    offset: DVec2,
    rotation: f64,
    scale: DVec2,
}

impl UvTransform {
    const NONE: Self = Self {
        offset: DVec2::ZERO,
        rotation: 0.0,
        scale: DVec2::ONE,
    };

    fn apply(&self, uv: DVec2) -> DVec2 {
        let (sin, cos) = (libm::sin(self.rotation), libm::cos(self.rotation));
        let scaled = uv * self.scale;
        // v points down, so that a turn to the left in the picture goes from v to u.
        self.offset
            + DVec2::new(
                cos * scaled.x + sin * scaled.y,
                cos * scaled.y - sin * scaled.x,
            )
    }
}

impl Primitives {
    /// Reads all materials into the draft, in the order of the file.
    pub(super) fn new(gltf: &Gltf, draft: &mut Draft) -> Self {
        draft.coloring = Coloring::Product;
        let mut textures = BTreeMap::new();
        let mut transforms = Vec::new();
        for material in gltf.list("materials") {
            let (material, transform) = read_material(gltf, material, draft, &mut textures);
            draft.materials.push(material);
            transforms.push(transform);
        }
        Self { transforms }
    }
}

fn read_material(
    gltf: &Gltf,
    material: &Value,
    draft: &mut Draft,
    textures: &mut BTreeMap<usize, Option<u32>>,
) -> (MeshMaterial, UvTransform) {
    let is_other = |key: &str| material.get(key).is_some();
    let pbr = material.get("pbrMetallicRoughness").unwrap_or(&Value::Null);
    if is_other("normalTexture")
        || is_other("occlusionTexture")
        || is_other("emissiveTexture")
        || pbr.get("metallicRoughnessTexture").is_some()
    {
        draft.leave(Aside::OtherTextures);
    }
    let factor = numbers::<4>(pbr, "baseColorFactor");
    let [r, g, b, a] = factor.unwrap_or([1.0; 4]).map(|x| x.clamp(0.0, 1.0) as f32);
    let is_blended = material.get("alphaMode").and_then(Value::as_str) == Some("BLEND");
    let mut transform = UvTransform::NONE;
    let mut picture = None;
    if let Some(info) = pbr.get("baseColorTexture") {
        let extension = info
            .get("extensions")
            .and_then(|all| all.get("KHR_texture_transform"));
        let set = extension.and_then(|extension| index(extension, "texCoord"));
        if set.or(index(info, "texCoord")).unwrap_or(0) > 0 {
            draft.leave(Aside::OtherTextures);
        } else if let Some(number) = index(info, "index") {
            picture = *textures
                .entry(number)
                .or_insert_with(|| read_texture(gltf, number, draft));
        }
        if let Some(extension) = extension {
            transform = UvTransform {
                offset: numbers(extension, "offset").map_or(DVec2::ZERO, DVec2::from_array),
                rotation: extension
                    .get("rotation")
                    .and_then(Value::as_f64)
                    .unwrap_or(0.0),
                scale: numbers(extension, "scale").map_or(DVec2::ONE, DVec2::from_array),
            };
        }
    }
    let material = MeshMaterial {
        color: Vec3::new(r, g, b),
        has_color: factor.is_some(),
        opacity: if is_blended { a } else { 1.0 },
        texture: picture,
    };
    (material, transform)
}

/// A texture whose picture is in the file.
fn read_texture(gltf: &Gltf, number: usize, draft: &mut Draft) -> Option<u32> {
    let described = gltf.list("textures").get(number);
    let image = described
        .and_then(|described| gltf.list("images").get(index(described, "source")?))
        .and_then(|image| index(image, "bufferView"))
        .and_then(|bytes| view(gltf, bytes).ok());
    let (Some(described), Some(bytes)) = (described, image) else {
        draft.leave(Aside::NoPicture);
        return None;
    };
    let sampler =
        index(described, "sampler").and_then(|sampler| gltf.list("samplers").get(sampler));
    let wrap = |key| match sampler.and_then(|sampler| index(sampler, key)) {
        Some(33_071) => Wrap::Clamp,
        Some(33_648) => Wrap::Mirror,
        _ => Wrap::Repeat,
    };
    if let Err(why) = draft.has_room_for_picture(bytes.len() as u64) {
        draft.leave(why);
        return None;
    }
    draft.add_texture(gltf.bytes[bytes].to_vec(), [wrap("wrapS"), wrap("wrapT")])
}

/// Adds the triangles of a mesh, placed by a node. Returns how many primitives it has.
pub(super) fn add_mesh(
    gltf: &Gltf,
    shared: &mut Primitives,
    draft: &mut Draft,
    mesh: usize,
    part: u32,
    scene_from_node: DMat4,
) -> Result<usize, MeshError> {
    let mesh = gltf.item("meshes", mesh)?;
    let primitives = mesh.get("primitives").and_then(Value::as_array);
    let primitives = primitives.map_or(&[][..], Vec::as_slice);
    for primitive in primitives {
        if primitive.get("targets").is_some() {
            draft.leave(Aside::Skins);
        }
        let mode = index(primitive, "mode").unwrap_or(4);
        match mode {
            0 => {
                draft.point_count += 1;
                draft.leave(Aside::Points);
            }
            1..=3 => {
                draft.line_count += 1;
                draft.leave(Aside::Lines);
            }
            4..=6 => add_primitive(gltf, shared, draft, primitive, mode, part, scene_from_node)?,
            _ => {
                return Err(gltf.wrong(format!(
                    "a primitive has the mode {mode}, which glTF does not know"
                )));
            }
        }
    }
    // An empty mesh counts too: time went into it.
    Ok(primitives.len().max(1))
}

fn add_primitive(
    gltf: &Gltf,
    shared: &Primitives,
    draft: &mut Draft,
    primitive: &Value,
    mode: usize,
    part: u32,
    scene_from_node: DMat4,
) -> Result<(), MeshError> {
    let triangles = |corners: usize| match mode {
        4 => corners as u64 / 3,
        _ => (corners as u64).saturating_sub(2),
    };
    let attribute = |key: &str| primitive.get("attributes").and_then(|all| index(all, key));
    // By the standard a primitive without positions is not drawn.
    let Some(positions) = attribute("POSITION") else {
        return Ok(());
    };
    let first = draft.positions.len();
    let positions = read::<3>(gltf, positions)?;
    let count = positions.len();
    for position in positions {
        let placed = scene_from_node.transform_point3(DVec3::from_array(position));
        draft.add_position(placed.as_vec3())?;
    }
    let same_count = |n: usize, what: &str| match n == count {
        true => Ok(()),
        false => Err(gltf.wrong(format!("a primitive has {count} positions and {n} {what}"))),
    };
    let mut normals_at = None;
    if let Some(accessor) = attribute("NORMAL") {
        let normals = read::<3>(gltf, accessor)?;
        same_count(normals.len(), "normals")?;
        normals_at = Some(draft.normals.len());
        let from_node = DMat3::from_mat4(scene_from_node);
        // A matrix that flattens has no inverse: its normals become no numbers, and are replaced.
        let normal_from_node = from_node.inverse().transpose();
        for normal in normals {
            let normal = normal_from_node * DVec3::from_array(normal);
            draft.add_normal(normal.normalize_or_zero().as_vec3())?;
        }
    }
    let material = index(primitive, "material");
    if let Some(material) = material {
        gltf.item("materials", material)?;
    }
    let mut uvs_at = None;
    if let Some(accessor) = attribute("TEXCOORD_0") {
        let uvs = read::<2>(gltf, accessor)?;
        same_count(uvs.len(), "texture coordinates")?;
        uvs_at = Some(draft.uvs.len());
        let transform = material.and_then(|material| shared.transforms.get(material));
        let transform = transform.copied().unwrap_or(UvTransform::NONE);
        for uv in uvs {
            draft.add_uv(transform.apply(DVec2::from_array(uv)).as_vec2())?;
        }
    }
    if let Some(accessor) = attribute("COLOR_0") {
        let colors: Vec<Vec3> = match component_count(gltf, accessor)? {
            4 => read::<4>(gltf, accessor)?
                .iter()
                .map(|c| DVec3::new(c[0], c[1], c[2]).as_vec3())
                .collect(),
            _ => read::<3>(gltf, accessor)?
                .iter()
                .map(|c| DVec3::from_array(*c).as_vec3())
                .collect(),
        };
        same_count(colors.len(), "colours")?;
        draft.colors.resize(first, None);
        let clamped = |color: &Vec3| {
            color
                .is_finite()
                .then(|| color.clamp(Vec3::ZERO, Vec3::ONE))
        };
        draft.colors.extend(colors.iter().map(clamped));
    }
    let indices: Vec<u32> = match index(primitive, "indices") {
        None => (0..count as u32).collect(),
        Some(accessor) => {
            let promised = index(gltf.item("accessors", accessor)?, "count").unwrap_or(0);
            draft.has_room_for(triangles(promised))?;
            let mut indices = Vec::new();
            for [number] in read::<1>(gltf, accessor)? {
                if !(number >= 0.0 && number < count as f64) {
                    return Err(gltf.wrong(format!(
                        "index {number} in accessor {accessor} is out of range: there are {count} vertices"
                    )));
                }
                indices.push(number as u32);
            }
            indices
        }
    };
    let corner = |index: u32| {
        let at = |first: Option<usize>| first.map_or(NO_INDEX, |first| first as u32 + index);
        super::draft::Corner {
            position: first as u32 + index,
            uv: at(uvs_at),
            normal: at(normals_at),
        }
    };
    let material = material.map_or(NO_INDEX, |material| material as u32);
    // A node that mirrors turns its triangles over.
    let is_mirrored = scene_from_node.determinant() < 0.0;
    let mut add = |[a, b, c]: [u32; 3]| {
        let triangle = if is_mirrored { [a, c, b] } else { [a, b, c] };
        draft.add_face(&triangle.map(corner), part, material)
    };
    match mode {
        4 => {
            for triangle in indices.chunks_exact(3) {
                add([triangle[0], triangle[1], triangle[2]])?;
            }
        }
        5 => {
            for (i, triangle) in indices.windows(3).enumerate() {
                let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
                add(if i % 2 == 0 { [a, b, c] } else { [a, c, b] })?;
            }
        }
        _ => {
            for pair in indices.get(1..).unwrap_or_default().windows(2) {
                add([pair[0], pair[1], indices[0]])?;
            }
        }
    }
    Ok(())
}
