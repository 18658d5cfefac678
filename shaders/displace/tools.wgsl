// Tools: the shapes of which a sweep's tools are made, and the field about them. Each in its own frame, in subject
// units; the points of curves and the grids of meshes lie in the texture of sweeps.
// Source: Angelidis, Wyvill and Cani, Sweepers, section 3.1; spec/sweepers.md, A.1 and A.4.
//
//   ball      ellipsoid     capsule    box       torus      curve      1 +--.
//    ___        ____          _        +---+      ____        /        field  \      the slope is steepest at half
//   (   )     (______)       | |       |   |     (____)   ___/                 \     the coating: 15/8
//    ---                     |_|       +---+                          0          '---
//                             z                 about z                 0   coat   distance
//
// Differs from the source: the field is 1 inside too, and the polynomial is written without a difference of like
// numbers.
// needs: bind/templates.wgsl

/// Texels in a row of `sweeps`.
const SWEEP_ROW: u32 = 1024u;
/// The number of the shape that is an ellipsoid.
const ELLIPSOID_SHAPE: u32 = 1u;
/// The number of the shape that is a ring.
const TORUS_SHAPE: u32 = 4u;
/// The number of the shape that is a curve.
const CURVE_SHAPE: u32 = 5u;
/// The number of the shape that is a mesh.
const MESH_SHAPE: u32 = 6u;
/// Side of a cell of a grid, as a part of the longest side of its mesh.
const GRID_CELL: f32 = 1.5 / 47.0;
/// Bits of the nodes of a grid along one axis.
const NODE_BITS: u32 = 6u;
/// Pieces of a curve that are asked at once.
const CURVE_PIECES: u32 = 4u;

/// A texel of the texture of sweeps.
fn sweep_texel(index: u32) -> vec4f {
    return textureLoad(sweeps, vec2u(index % SWEEP_ROW, index / SWEEP_ROW), 0);
}

/// The field at a distance in coatings: 1 from 0 down, 0 from 1 up.
fn tool_field(x: f32) -> f32 {
    let t = clamp(x, 0.0, 1.0);
    let left = 1.0 - t;
    return left * left * left * (1.0 + t * (3.0 + 6.0 * t));
}

/// Three steps of Newton towards the root of sum (a q / (a² + t))² = 1, from its left.
fn ellipsoid_steps(left: f32, radii: vec3f, q: vec3f) -> f32 {
    return ellipsoid_step(ellipsoid_step(ellipsoid_step(left, radii, q), radii, q), radii, q);
}

/// One of these steps.
fn ellipsoid_step(t: f32, radii: vec3f, q: vec3f) -> f32 {
    let part = 1.0 / (radii * radii + t);
    let ratio = radii * q * part;
    let square = ratio * ratio;
    let slope = 2.0 * dot(square, part);
    return t + max((dot(square, vec3f(1.0)) - 1.0) / max(slope, 1e-30), 0.0);
}

/// Distance to an ellipsoid about the origin, 0 inside. `q`: the place, no coordinate below 0.
fn ellipsoid_distance(q: vec3f, radii: vec3f) -> f32 {
    let inside = q / radii;
    if dot(inside, inside) <= 1.0 {
        return 0.0;
    }
    let least = radii * (q - radii);
    var t = max(max(least.x, 0.0), max(least.y, least.z));
    // Twelve are enough for all ranges. No loop: see displace/sweep.wgsl.
    t = ellipsoid_steps(ellipsoid_steps(t, radii, q), radii, q);
    t = ellipsoid_steps(ellipsoid_steps(t, radii, q), radii, q);
    return t * length(q / (radii * radii + t));
}

/// Distance to a straight piece.
fn piece_distance(q: vec3f, a: vec3f, b: vec3f) -> f32 {
    let along = b - a;
    let part = clamp(dot(q - a, along) / max(dot(along, along), 1e-20), 0.0, 1.0);
    return length(q - a - along * part);
}

/// Distance to some of the straight pieces between points, from one of the points on; `last` is the last point.
fn pieces_distance(q: vec3f, from_point: u32, last: u32) -> f32 {
    let a = sweep_texel(min(from_point, last)).xyz;
    let b = sweep_texel(min(from_point + 1u, last)).xyz;
    let c = sweep_texel(min(from_point + 2u, last)).xyz;
    let d = sweep_texel(min(from_point + 3u, last)).xyz;
    let e = sweep_texel(min(from_point + CURVE_PIECES, last)).xyz;
    let first_two = min(piece_distance(q, a, b), piece_distance(q, b, c));
    return min(first_two, min(piece_distance(q, c, d), piece_distance(q, d, e)));
}

/// Distance to a mesh by its grid, linear between nodes; beyond the grid the way to it is added. `form`: the first
/// texel, the nodes along the axes, the longest side of the mesh. A texel holds the values of a node, of the next along
/// x, along y and along both.
fn grid_distance(p: vec3f, form: vec4f) -> f32 {
    let sides = vec3u(u32(form.y)) >> vec3u(0u, NODE_BITS, 2u * NODE_BITS);
    let nodes = sides & vec3u((1u << NODE_BITS) - 1u);
    let last = vec3f(nodes - 1u);
    let cell = GRID_CELL * form.z;
    let at = p / cell + 0.5 * last;
    let near = clamp(at, vec3f(0.0), last);
    let low = min(vec3u(near), nodes - 2u);
    let part = near - vec3f(low);
    let slice = (nodes.x - 1u) * (nodes.y - 1u);
    let first = u32(form.x) + low.x + (nodes.x - 1u) * low.y + slice * low.z;
    let four = mix(sweep_texel(first), sweep_texel(first + slice), part.z);
    let two = mix(four.xy, four.zw, part.y);
    return mix(two.x, two.y, part.x) * form.z + length(at - near) * cell;
}

/// Distance to a tool that is no curve, 0 inside. `shape` and `form` as src/displace/sweeping.rs packs them: balls,
/// rods and blocks are all that lies within a radius (w) of a block with sharp edges.
fn tool_distance(p: vec3f, shape: u32, form: vec4f) -> f32 {
    let q = abs(p);
    switch shape {
        case ELLIPSOID_SHAPE: {
            return ellipsoid_distance(q, form.xyz);
        }
        case MESH_SHAPE: {
            return grid_distance(p, form);
        }
        default: {
            let from_ring = vec3f(length(q.xy) - form.x, 0.0, q.z);
            let from_core = select(max(q - form.xyz, vec3f(0.0)), from_ring, shape == TORUS_SHAPE);
            return max(length(from_core) - form.w, 0.0);
        }
    }
}
