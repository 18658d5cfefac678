// What the meshes of a subject have at a place: its triangles, found by a tree of boxes, and what is inside of them.
// The field of depths is a map to the triangles, never the truth (spec/surfaces.md).
//
// Texels of `mesh_texels`:
//   tree        lowest corner of all | highest corner
//   node        see triangles.wgsl
//   triangle    for each corner: place, normal | sRGB colours of the corners, owner (8 bits) and opacity (8 bits)
//   set         two bits for each of 64 segments: how often a place is inside of it
// needs: types.wgsl affine.wgsl triangles.wgsl bind/subject.wgsl subject/place.wgsl

/// Texture space of the field of depths from a point of rest space.
fn field_from_rest(rest: vec3f) -> vec3f {
    return apply_affine(subject.field_from_rest, rest);
}

/// Depth under the surface of the meshes at a point of rest space, subject units, by the field alone; below 0 outside.
fn field_at(rest: vec3f) -> f32 {
    return textureSampleLevel(mesh_depths, linear_sampler, field_from_rest(rest), 0.0).x;
}

fn mesh_texel(index: u32) -> vec4u {
    return textureLoad(mesh_texels, vec2u(index % MESH_ROW, index / MESH_ROW), 0);
}

fn mesh_root() -> TreeRoot {
    return tree_root(mesh_texel(0u), mesh_texel(1u));
}

fn mesh_node(index: u32, root: TreeRoot) -> TreeNode {
    return tree_node(mesh_texel(ROOT_TEXELS + index), index, root);
}

/// A triangle met by a line.
struct TriangleCrossing {
    /// Index of the triangle, or NO_TRIANGLE.
    triangle: u32,
    /// Where on the way, 0 to 1.
    part: f32,
    /// Weights of the corners.
    weights: vec3f,
    is_front: bool,
}

/// The corner of a triangle, rest space.
fn corner_of(triangle: u32, corner: u32) -> vec3f {
    return bitcast<vec3f>(mesh_texel(subject.triangles_at + 4u * triangle + corner).xyz);
}

/// Normal of a triangle's front, unit, rest space.
fn face_of(triangle: u32) -> vec3f {
    let a = corner_of(triangle, 0u);
    return normalize(cross(corner_of(triangle, 1u) - a, corner_of(triangle, 2u) - a));
}

/// Segment of a triangle, from 0; with LID added if the triangle is part of a lid.
fn owner_of(triangle: u32) -> u32 {
    return mesh_texel(subject.triangles_at + 4u * triangle + 3u).w & 255u;
}

/// Segment of a triangle, from 0.
fn segment_of(triangle: u32) -> u32 {
    return owner_of(triangle) & ~LID;
}

/// Opacity of a triangle by the file, 0 to 1.
fn opacity_of_triangle(triangle: u32) -> f32 {
    return f32((mesh_texel(subject.triangles_at + 4u * triangle + 3u).w >> 8u) & 255u) / 255.0;
}

/// Linear RGB of a triangle at a point of these weights.
fn color_of_triangle(triangle: u32, weights: vec3f) -> vec3f {
    return color_between(mesh_texel(subject.triangles_at + 4u * triangle + 3u).xyz, weights);
}

/// Smooth normal of a triangle at a point of these weights, unit, rest space, on the side of its front.
fn normal_of_triangle(triangle: u32, weights: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    for (var corner = 0u; corner < 3u; corner++) {
        let packed = mesh_texel(subject.triangles_at + 4u * triangle + corner).w;
        sum += from_octahedron(unpack2x16snorm(packed)) * weights[corner];
    }
    return normalize(sum);
}

/// Where a line from `start` along `way` crosses a triangle.
fn crossing_of(triangle: u32, start: vec3f, way: vec3f) -> TriangleCrossing {
    let found = line_crossing(
        corner_of(triangle, 0u) - start,
        corner_of(triangle, 1u) - start,
        corner_of(triangle, 2u) - start,
        way,
    );
    let is_met = found.is_met && found.part <= 1.0;
    return TriangleCrossing(select(NO_TRIANGLE, triangle, is_met), found.part, found.weights, found.is_front);
}

/// How often a place is inside of segments by a set, with the triangles between the place and the middle of the voxel
/// that the set is of. Returns the set of the place.
fn set_beside(times: vec4u, place: vec3f, middle: vec3f) -> vec4u {
    let way = middle - place;
    let inverse_way = inverse_of(way);
    var more = array<u32, 4>(times.x, times.y, times.z, times.w);
    let root = mesh_root();
    var index = 0u;
    while index < subject.node_count {
        // On to the next leaf (see `first_crossing`).
        var left = 0u;
        var triangle = 0u;
        while left == 0u && index < subject.node_count {
            let node = mesh_node(index, root);
            let span = part_in_box(place, inverse_way, node.low, node.high, 1.0);
            let is_met = span.x <= span.y;
            left = select(0u, node.count, is_met);
            triangle = node.first;
            index = select(node.skip, index + 1u, is_met);
        }
        while left > 0u {
            left--;
            let crossing = crossing_of(triangle, place, way);
            if crossing.triangle != NO_TRIANGLE {
                let segment = segment_of(triangle);
                let word = segment >> 4u;
                let shift = 2u * (segment & 15u);
                let before = (more[word] >> shift) & 3u;
                // Who comes from the front of a triangle was outside of it, once less than behind it.
                let now = select(min(before + 1u, 3u), max(before, 1u) - 1u, crossing.is_front);
                more[word] = (more[word] & ~(3u << shift)) | (now << shift);
            }
            triangle++;
        }
    }
    return vec4u(more[0], more[1], more[2], more[3]);
}

/// How often a point of rest space is inside of each segment: a set, with the texels' two bits for each. Exact near
/// triangles, where the way to the middle of the nearest voxel is asked.
fn set_at(rest: vec3f) -> vec4u {
    let at = field_from_rest(rest);
    if any(at < vec3f(0.0)) || any(at > vec3f(1.0)) {
        return vec4u(0u);
    }
    let voxel = min(floor(at * subject.field_dims.xyz), subject.field_dims.xyz - 1.0);
    let inner = clamp(floor(apply_affine(subject.fill_from_rest, rest) * subject.fill_dims.xyz), vec3f(0.0), subject.fill_dims.xyz - 1.0);
    let label = textureLoad(mesh_fills, vec3i(inner), 0).x;
    let depth = textureLoad(mesh_depths, vec3i(voxel), 0).x;
    // A voxel's corner is so far from its middle at most: 0.87 of its side.
    if abs(depth) > subject.field_detail {
        return select(mesh_texel(subject.sets_at + label), vec4u(0u), depth < 0.0);
    }
    // Voxels beside the segmentation's are empty.
    let is_beside = any(floor(apply_affine(subject.fill_from_rest, rest) * subject.fill_dims.xyz) != inner);
    let times_there = select(mesh_texel(subject.sets_at + label), vec4u(0u), is_beside);
    let step = (voxel + 0.5) / subject.field_dims.xyz - at;
    return set_beside(times_there, rest, rest + step * rest_from_field());
}

/// Takes the first segment of a set, from 1; NO_LABEL if the set is empty.
fn take_segment(left: ptr<function, vec4u>) -> u32 {
    let first = first_of(*left);
    if first == NO_LABEL {
        return NO_LABEL;
    }
    (*left)[first >> 4u] &= ~(3u << (2u * (first & 15u)));
    return first + 1u;
}

/// Sides of the field's box, rest space: its grid is not turned.
fn rest_from_field() -> vec3f {
    return 1.0 / vec3f(subject.field_from_rest.row0.x, subject.field_from_rest.row1.y, subject.field_from_rest.row2.z);
}

/// The point of a triangle that is nearest to a place (Ericson, Real-Time Collision Detection, section 5.1.5).
fn nearest_on(triangle: u32, place: vec3f) -> vec3f {
    let a = corner_of(triangle, 0u);
    let b = corner_of(triangle, 1u);
    let c = corner_of(triangle, 2u);
    let ab = b - a;
    let ac = c - a;
    let d1 = dot(ab, place - a);
    let d2 = dot(ac, place - a);
    let d3 = dot(ab, place - b);
    let d4 = dot(ac, place - b);
    let d5 = dot(ab, place - c);
    let d6 = dot(ac, place - c);
    let va = d3 * d6 - d5 * d4;
    let vb = d5 * d2 - d1 * d6;
    let vc = d1 * d4 - d3 * d2;
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    return a + (ab * vb + ac * vc) / (va + vb + vc);
}

/// From a place of rest space to the nearest point of a segment's triangles (from 0), lids left out, if that is nearer
/// than `within`; w is the distance, or `within`.
fn to_nearest(rest: vec3f, within: f32, segment: u32) -> vec4f {
    var nearest = vec4f(0.0, 0.0, 0.0, within);
    let root = mesh_root();
    var index = 0u;
    while index < subject.node_count {
        // On to the next leaf (see `first_crossing`).
        var left = 0u;
        var triangle = 0u;
        while left == 0u && index < subject.node_count {
            let node = mesh_node(index, root);
            let away = clamp(rest, node.low, node.high) - rest;
            let is_near = dot(away, away) < nearest.w * nearest.w;
            left = select(0u, node.count, is_near);
            triangle = node.first;
            index = select(node.skip, index + 1u, is_near);
        }
        while left > 0u {
            left--;
            let way = nearest_on(triangle, rest) - rest;
            let far = length(way);
            if far < nearest.w && owner_of(triangle) == segment {
                nearest = vec4f(way, far);
            }
            triangle++;
        }
    }
    return nearest;
}

/// The first segment of a set, from 0.
fn first_of(times: vec4u) -> u32 {
    for (var word = 0u; word < 4u; word++) {
        if times[word] != 0u {
            return 16u * word + (firstTrailingBit(times[word]) >> 1u);
        }
    }
    return NO_LABEL;
}

/// A distance that a point of rest space is away from all triangles at least, subject units.
fn clearance_at(rest: vec3f) -> f32 {
    let outside = max(subject.mesh_min.xyz - rest, rest - subject.mesh_max.xyz);
    let beside = length(max(outside, vec3f(0.0)));
    // Between voxels the field is off by a part of a voxel.
    let within = abs(field_at(rest)) - 0.6 * subject.field_detail;
    return max(max(beside, within), 0.0);
}
