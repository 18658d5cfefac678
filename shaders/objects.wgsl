// Objects of the scene on a line: triangles that no template moves, found by the trees of their meshes.
// needs: types.wgsl affine.wgsl triangles.wgsl textures.wgsl bind/objects.wgsl march/overrides.wgsl

/// Stands for no object.
const NO_OBJECT: u32 = 0xffffffffu;

/// Where a line meets an object.
struct ObjectCrossing {
    /// Index of the object, or NO_OBJECT.
    object: u32,
    triangle: u32,
    /// Where on the way; 1 is its end.
    part: f32,
    /// Weights of the corners.
    weights: vec3f,
    is_front: bool,
}

fn object_texel(index: u32) -> vec4u {
    return textureLoad(object_texels, vec2u(index % MESH_ROW, index / MESH_ROW), 0);
}

/// The corner of an object's triangle, the object's own space.
fn object_corner(object: u32, triangle: u32, corner: u32) -> vec3f {
    return bitcast<vec3f>(object_texel(objects.items[object].triangles_at + 4u * triangle + corner).xyz);
}

/// The first place on a way, from a part of it to another, at which an object is met.
fn object_on(origin: vec3f, way: vec3f, after: f32, until: f32) -> ObjectCrossing {
    var found = ObjectCrossing(NO_OBJECT, NO_TRIANGLE, until, vec3f(0.0), false);
    for (var k = 0u; k < objects.count; k++) {
        let map = objects.items[k].object_from_subject;
        let along = apply_linear(map, way);
        let inverse_along = inverse_of(along);
        let nodes_at = objects.items[k].nodes_at;
        let root = tree_root(object_texel(nodes_at), object_texel(nodes_at + 1u));
        let from_after = apply_affine(map, origin + way * after);
        let high = root.low + NODE_PARTS * root.part;
        let span = part_in_box(from_after, inverse_along, root.low, high, found.part - after);
        // From where the line enters the box: numbers far away from a small object are too coarse.
        let first = after + span.x;
        let start = from_after + along * span.x;
        var index = select(objects.items[k].node_count, 0u, span.x <= span.y);
        while index < objects.items[k].node_count {
            // On to the next leaf (see `first_crossing` in subject/crossing.wgsl).
            var left = 0u;
            var triangle = 0u;
            while left == 0u && index < objects.items[k].node_count {
                let node = tree_node(object_texel(nodes_at + ROOT_TEXELS + index), index, root);
                let inner = part_in_box(start, inverse_along, node.low, node.high, found.part - first);
                let is_met = inner.x <= inner.y;
                left = select(0u, node.count, is_met);
                triangle = node.first;
                index = max(select(node.skip, index + 1u, is_met), index + 1u);
            }
            while left > 0u {
                left--;
                let crossing = line_crossing(
                    object_corner(k, triangle, 0u) - start,
                    object_corner(k, triangle, 1u) - start,
                    object_corner(k, triangle, 2u) - start,
                    along,
                );
                // What closes the holes of an open object is not seen.
                let owner = object_texel(objects.items[k].triangles_at + 4u * triangle + 3u).w & 255u;
                if crossing.is_met && first + crossing.part < found.part && owner < LID {
                    found = ObjectCrossing(k, triangle, first + crossing.part, crossing.weights, crossing.is_front);
                }
                triangle++;
            }
        }
    }
    return found;
}

/// Linear RGB of an object from outside, where a line meets it.
fn object_color(met: ObjectCrossing, footprint: Footprint) -> vec3f {
    let at = objects.items[met.object].triangles_at + 4u * met.triangle + 3u;
    let color = objects.items[met.object].color;
    var own = color_between(object_texel(at).xyz, met.weights);
    if has_textures != 0u {
        own *= picture_on(object_texels, objects.items[met.object].textures_at, met.triangle, footprint);
    }
    return select(own, color.rgb, color.a >= 0.0);
}

/// How much of the light along a way objects take.
fn object_cover(origin: vec3f, way: vec3f) -> f32 {
    let met = object_on(origin, way, 0.0, 1.0);
    if met.object == NO_OBJECT {
        return 0.0;
    }
    return objects.items[met.object].opacity * mix(1.0, 0.4, met.part);
}
