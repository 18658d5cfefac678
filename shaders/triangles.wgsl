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
    var sum = vec3f(0.0);
    for (var corner = 0u; corner < 3u; corner++) {
        sum += linear_from_srgb(unpack4x8unorm(packed[corner]).rgb) * weights[corner];
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
