// Lines against triangles and boxes, and what the texels of a triangle hold.
// needs: srgb.wgsl octahedron.wgsl

/// Texels in a row of a texture of triangles.
const MESH_ROW: u32 = 4096u;
/// Stands for no triangle.
const NO_TRIANGLE: u32 = 0xffffffffu;
/// Marks the owner of a triangle that is part of a lid: what closes the hole of an open body.
const LID: u32 = 128u;
/// How much of its own colour a back side or a cut face has.
const INSIDE_SHARE: f32 = 0.75;
/// A line that passes this much beside a triangle, as a part of its size, counts as crossing it: so that none slips
/// through between two of them.
const EDGE_SLACK: f32 = 1e-6;

/// Texels of a tree before its nodes: the lowest and the highest corner of the box of all.
const ROOT_TEXELS: u32 = 2u;
/// Parts of that box along each axis in which the boxes of nodes are told.
const NODE_PARTS: f32 = 65535.0;
/// Marks a leaf.
const LEAF: u32 = 0x80000000u;

/// The box over all triangles of a tree.
struct TreeRoot {
    low: vec3f,
    /// Sides of a part.
    part: vec3f,
}

/// A box over some of a mesh's triangles, as its texel tells it.
struct TreeNode {
    low: vec3f,
    high: vec3f,
    /// The node that follows if this one is left out.
    skip: u32,
    /// The first of its triangles and how many there are: 0 in nodes that are no leaf, whose first child is the next.
    first: u32,
    count: u32,
}

/// The box of a tree by its two texels.
fn tree_root(low: vec4u, high: vec4u) -> TreeRoot {
    let from_corner = bitcast<vec3f>(low.xyz);
    return TreeRoot(from_corner, (bitcast<vec3f>(high.xyz) - from_corner) / NODE_PARTS);
}

/// A node by its texel (src/render/pack/triangles.rs) and index.
fn tree_node(texel: vec4u, index: u32, root: TreeRoot) -> TreeNode {
    let low = vec3u(texel.x & 0xffffu, texel.x >> 16u, texel.y & 0xffffu);
    let high = vec3u(texel.y >> 16u, texel.z & 0xffffu, texel.z >> 16u);
    let is_leaf = (texel.w & LEAF) != 0u;
    return TreeNode(
        root.low + vec3f(low) * root.part,
        root.low + vec3f(high) * root.part,
        select(texel.w, index + 1u, is_leaf),
        (texel.w & ~LEAF) >> 4u,
        select(0u, texel.w & 15u, is_leaf),
    );
}

/// Where a line crosses the plane of a triangle.
struct LineCrossing {
    /// False if the line passes beside the triangle, or the triangle lies before its start.
    is_met: bool,
    /// Where on the way; 1 is its end.
    part: f32,
    /// Weights of the corners.
    weights: vec3f,
    is_front: bool,
}

/// Where a line along `way` crosses a triangle, whose corners are seen from the line's start (signed volumes of
/// tetrahedra).
fn line_crossing(a: vec3f, b: vec3f, c: vec3f, way: vec3f) -> LineCrossing {
    let sides = vec3f(dot(way, cross(c, b)), dot(way, cross(a, c)), dot(way, cross(b, a)));
    let sum = sides.x + sides.y + sides.z;
    let slack = EDGE_SLACK * (abs(sides.x) + abs(sides.y) + abs(sides.z));
    let is_in = all(sides >= vec3f(-slack)) || all(sides <= vec3f(slack));
    let weights = sides / select(sum, 1.0, sum == 0.0);
    let met = a * weights.x + b * weights.y + c * weights.z;
    let part = dot(met, way) / dot(way, way);
    let is_met = is_in && sum != 0.0 && part >= 0.0;
    return LineCrossing(is_met, part, weights, dot(way, cross(b - a, c - a)) < 0.0);
}

/// The part of a line, from 0 to `most`, that lies in a box; empty if x > y.
fn part_in_box(start: vec3f, inverse_way: vec3f, low: vec3f, high: vec3f, most: f32) -> vec2f {
    let a = (low - 1e-6 - start) * inverse_way;
    let b = (high + 1e-6 - start) * inverse_way;
    let near = min(a, b);
    let far = max(a, b);
    return vec2f(max(max(near.x, near.y), max(near.z, 0.0)), min(min(far.x, far.y), min(far.z, most)));
}

/// One over each component of a way; large, where a component is 0.
fn inverse_of(way: vec3f) -> vec3f {
    let least = vec3f(1e-20);
    return 1.0 / select(way, select(-least, least, way >= vec3f(0.0)), abs(way) < least);
}

/// Linear RGB at a point of a triangle of these weights, from the packed sRGB colours of its corners.
fn color_between(packed: vec3u, weights: vec3f) -> vec3f {
    // Of one colour one corner is enough.
    let is_one = packed.x == packed.y && packed.y == packed.z;
    let shares = select(weights, vec3f(1.0, 0.0, 0.0), is_one);
    var sum = vec3f(0.0);
    for (var corner = select(3u, 1u, is_one); corner > 0u; corner--) {
        sum += linear_from_srgb(unpack4x8unorm(packed[corner - 1u]).rgb) * shares[corner - 1u];
    }
    return sum;
}

/// A smooth normal as a ray sees it: on the side of the triangle's plane on which the eye is, and bent back to the edge
/// of what the eye sees where it points away. All directions in one space; `face` is the normal of the plane.
fn normal_to_eye(smooth_normal: vec3f, face: vec3f, dir: vec3f) -> vec3f {
    let side = select(1.0, -1.0, dot(face, dir) > 0.0);
    let normal = normalize(side * smooth_normal);
    return normalize(normal - dir * max(dot(normal, dir), 0.0) * 1.02);
}
