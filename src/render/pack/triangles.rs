//! Trees and triangles of meshes as texels, as shaders/subject/mesh.wgsl and shaders/march/objects.wgsl read them.

use glam::{Vec2, Vec3};

use crate::data::Surface;

/// Bits of a node that hold the number of triangles in it.
const COUNT_BITS: u32 = 4;

/// How many texels the tree and the triangles of a mesh take: two per node, then four per triangle.
pub(crate) fn texels_of(surface: &Surface) -> u32 {
    (2 * surface.tree.nodes.len() + 4 * surface.triangles.len()) as u32
}

/// Adds the texels of a mesh's tree and triangles.
pub(crate) fn pack_triangles(surface: &Surface, texels: &mut Vec<[u32; 4]>) {
    let with = |place: Vec3, last: u32| {
        let [x, y, z] = place.to_array().map(f32::to_bits);
        [x, y, z, last]
    };
    for node in &surface.tree.nodes {
        texels.push(with(node.bounds.min, node.skip));
        texels.push(with(node.bounds.max, node.first << COUNT_BITS | node.count));
    }
    for (i, triangle) in surface.triangles.iter().enumerate() {
        for (corner, normal) in triangle.0.iter().zip(surface.normals[i]) {
            texels.push(with(*corner, octahedral(normal)));
        }
        let [a, b, c] = surface.colors[i].map(|[r, g, b]| u32::from_le_bytes([r, g, b, 255]));
        let opacity = surface.segments[surface.segment_of(i)].opacity;
        let opacity = (opacity.clamp(0.0, 1.0) * 255.0).round() as u8;
        let last = u32::from_le_bytes([surface.owners[i], opacity, 0, 0]);
        texels.push([a, b, c, last]);
    }
}

/// A unit vector as its place on the unfolded octahedron, two numbers of 16 bits (Cigolle et al. 2014).
fn octahedral(normal: Vec3) -> u32 {
    let n = normal / normal.abs().element_sum().max(1e-9);
    let sign = |v: f32| if v >= 0.0 { 1.0 } else { -1.0 };
    let at = if n.z >= 0.0 {
        Vec2::new(n.x, n.y)
    } else {
        Vec2::new((1.0 - n.y.abs()) * sign(n.x), (1.0 - n.x.abs()) * sign(n.y))
    };
    let [x, y] = (at * 32767.0).round().to_array().map(|v| v as i16 as u16);
    u32::from(x) | u32::from(y) << 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_survive_packing() {
        for i in 0..1000 {
            let t = i as f32 * 0.37;
            let normal = Vec3::new(t.sin(), (t * 1.7).cos(), (t * 0.61).sin()).normalize();
            let packed = octahedral(normal);
            let part = |bits: u32| f32::from(bits as u16 as i16) / 32767.0;
            let at = Vec2::new(part(packed), part(packed >> 16));
            // As the shader unpacks it.
            let up = 1.0 - at.x.abs() - at.y.abs();
            let fold = (-up).max(0.0);
            let back = |v: f32| v + if v >= 0.0 { -fold } else { fold };
            let unpacked = Vec3::new(back(at.x), back(at.y), up).normalize();
            assert!(unpacked.distance(normal) < 1e-4, "{normal} {unpacked}");
        }
    }
}
